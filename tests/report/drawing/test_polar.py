import math

import matplotlib as mpl
import numpy as np
import pandas as pd
import pytest

from albedo_lab.pictures.base import Curve
from albedo_lab.pictures.polar import Polar
from albedo_lab.report.drawing import render
from albedo_lab.report.drawing.discs import MOST_RINGS, REACH, Radius, place
from albedo_lab.report.drawing.polar import draw
from albedo_lab.report.drawing.style import INK, OKABE_ITO, STYLE, power_of_ten

LABELS = ("first", "second")
VIEWERS = np.linspace(-89.0, 89.0, 179)


def data_of(picture, value=lambda curve, light: 1.0, mirrors=()):
    """Made-up data: no model is asked."""
    sections = [
        pd.DataFrame(
            {"curve": c.label, "light_deg": t, "viewer_deg": VIEWERS, "value": value(c.label, t) * np.ones(len(VIEWERS))}
        )
        for c in picture.curves
        for t in picture.theta_deg
    ]
    return {"": pd.concat(sections), "mirrors": pd.DataFrame(mirrors, columns=["curve", "light_deg", "reflectance"])}


def picture_of(**options):
    return Polar(tuple(Curve(label, "lambert") for label in LABELS), **options)


def drawn(picture, data):
    with mpl.rc_context(STYLE):
        return draw(picture, data)


def curves(axes):
    return [line for line in axes.get_lines() if line.get_label() in LABELS or str(line.get_label()).startswith("light")]


def texts(axes):
    return [text.get_text() for text in axes.texts]


def test_a_panel_for_each_light():
    picture = picture_of()
    figure = drawn(picture, data_of(picture))
    assert [axes.get_title() for axes in figure.axes] == ["light at 0°", "light at 40°", "light at 80°"]
    assert [text.get_text() for text in figure.legends[0].texts] == list(LABELS)
    assert figure.get_supxlabel().split("\n") == [
        "radius: BRDF in 1/sr",
        "angle: the viewer's, from the normal, negative on the light's side",
    ]


def test_no_text_is_of_another_black():
    picture = picture_of()
    figure = drawn(picture, data_of(picture, mirrors=[("first", 40.0, 1.0)]))
    written = [text for text in figure.findobj(mpl.text.Text) if text.get_text() and text.get_visible()]
    assert {mpl.colors.to_hex(text.get_color()) for text in written} == {INK, OKABE_ITO[0].lower()}


def test_a_panel_for_each_curve():
    picture = picture_of(panels="curve", quantity="radiance")
    figure = drawn(picture, data_of(picture))
    assert [axes.get_title() for axes in figure.axes] == list(LABELS)
    assert [text.get_text() for text in figure.legends[0].texts] == ["light at 0°", "light at 40°", "light at 80°"]
    arrows = [text.arrow_patch for text in figure.axes[0].texts if getattr(text, "arrow_patch", None)]
    assert [mpl.colors.to_hex(arrow.get_edgecolor()) for arrow in arrows] == [colour.lower() for colour in OKABE_ITO[:3]]


def test_the_light_comes_from_the_left_and_points_inwards():
    picture = picture_of(theta_deg=(40.0,))
    (axes,) = drawn(picture, data_of(picture)).axes
    (arrow,) = [text for text in axes.texts if getattr(text, "arrow_patch", None)]
    assert mpl.colors.to_hex(arrow.arrow_patch.get_edgecolor()) == INK
    for end in (arrow.xy, arrow.get_position()):
        assert math.degrees(math.atan2(end[0], end[1])) == pytest.approx(-40.0)
    assert REACH < math.hypot(*arrow.xy) < math.hypot(*arrow.get_position())
    assert "−30°" not in texts(axes)
    assert {"−60°", "0°", "30°", "60°", "90°", "−90°"} <= set(texts(axes))


def test_a_viewer_on_the_mirrors_side_is_on_the_right():
    picture = picture_of(theta_deg=(40.0,))
    data = data_of(picture)
    data[""]["value"] = np.where(data[""].viewer_deg == 40.0, 2.0, 1.0)
    (axes,) = drawn(picture, data).axes
    x, y = curves(axes)[0].get_data()
    top = np.argmax(np.hypot(x, y))
    assert (x[top], y[top]) == pytest.approx(place(40.0, REACH))
    assert x[top] > 0.0


@pytest.mark.parametrize(("ratio", "radii"), [(5.0, [REACH / 5.0, REACH]), (50.0, [REACH, REACH])])
def test_panels_share_a_scale_unless_one_would_vanish(ratio, radii):
    picture = picture_of(theta_deg=(0.0, 40.0))
    figure = drawn(picture, data_of(picture, lambda curve, light: ratio if light else 1.0))
    assert [np.hypot(*curves(axes)[0].get_data()).max() for axes in figure.axes] == pytest.approx(radii)


def test_panels_that_are_not_to_be_compared_have_scales_of_their_own():
    picture = picture_of(theta_deg=(0.0, 40.0), alike=False)
    figure = drawn(picture, data_of(picture, lambda curve, light: 5.0 if light else 1.0))
    assert [np.hypot(*curves(axes)[0].get_data()).max() for axes in figure.axes] == pytest.approx([REACH, REACH])


def test_the_radius_may_be_a_logarithm():
    picture = picture_of(theta_deg=(0.0,), log=True, decades=4.0)
    (axes,) = drawn(picture, data_of(picture, lambda curve, light: 100.0 if curve == "first" else 1.0)).axes
    assert [np.hypot(*line.get_data()).max() for line in curves(axes)] == pytest.approx([REACH, REACH / 2.0])
    assert {"100", "10", "1", "0.1", "0.01"} <= set(texts(axes))
    assert "logarithmic" in axes.figure.get_supxlabel()


def test_radii():
    assert Radius(2.0).of([0.0, 1.0, 2.0]).tolist() == pytest.approx([0.0, 0.5 * REACH, REACH])
    assert Radius(10.0, 2.0).of([0.0, 0.1, 1.0, 10.0]).tolist() == pytest.approx([0.0, 0.0, 0.5 * REACH, REACH])
    assert np.isnan(Radius(2.0).of([-1.0, np.nan])).all()
    assert np.isnan(Radius(2.0, 3.0).of([-1.0, np.nan])).all()


@pytest.mark.parametrize(
    "radius", [Radius(5.76), Radius(1.0), Radius(3.1e4), Radius(2e-9), Radius(7.0, 3.0), Radius(1e-3, 5.0), Radius(10.0, 9.0)]
)
def test_rings_lie_in_the_disc_and_are_named_after_their_values(radius):
    rings, names = radius.rings()
    assert 2 <= len(rings) <= MOST_RINGS
    assert all(0.0 <= r <= 1.0 for r in radius.of(rings))
    supers = str.maketrans("⁻⁰¹²³⁴⁵⁶⁷⁸⁹", "-0123456789")
    read = [float(n) if n.translate(supers) == n else 10.0 ** int(n[2:].translate(supers)) for n in names]
    assert read == pytest.approx(rings)


def test_the_centre_is_named_where_it_is_a_power_of_ten():
    assert Radius(100.0, 4.0).rings()[1] == ["100", "10", "1", "0.1", "0.01"]
    assert Radius(70.0, 2.0).rings()[1] == ["10", "1"]


def test_powers_of_ten():
    assert [power_of_ten(k) for k in (-12, -3, -2, 0, 2, 3)] == ["10⁻¹²", "10⁻³", "0.01", "1", "100", "10³"]


def test_a_dirac_part_is_written_at_its_direction():
    picture = picture_of(theta_deg=(30.0, 60.0))
    figure = drawn(picture, data_of(picture, mirrors=[("second", 60.0, 0.61234)]))
    assert not any("mirror" in text for text in texts(figure.axes[0]))
    (text,) = [text for text in figure.axes[1].texts if text.get_text() == "mirror 0.612"]
    assert text.get_color() == OKABE_ITO[1]
    assert text.get_position()[0] > 0.5


def test_what_leaves_the_disc_is_cut():
    picture = picture_of(theta_deg=(60.0,))
    data = data_of(picture)
    data[""]["value"] = np.where(data[""].viewer_deg > 88.0, 1e3, 1.0)
    (axes,) = drawn(picture, data).axes
    first = curves(axes)[0]
    assert np.hypot(*first.get_data()).max() > 100.0
    assert first.get_clip_path() is not None
    assert axes.get_xlim()[1] < 1.5


@pytest.mark.parametrize("value", [0.0, np.nan, -1.0])
@pytest.mark.parametrize("log", [False, True])
def test_nothing_to_be_seen_is_drawn_all_the_same(value, log):
    picture = picture_of(log=log)
    assert len(render(picture, data_of(picture, lambda curve, light: value), ("svg",))["svg"]) > 1000


@pytest.mark.parametrize(("lights", "shape"), [(1, (8.0, 1)), (2, (11.5, 2)), (4, (11.5, 4)), (5, (11.5, 5))])
def test_as_many_panels_as_lights(lights, shape):
    picture = picture_of(theta_deg=tuple(float(i) for i in range(lights)))
    figure = drawn(picture, data_of(picture))
    assert (figure.get_figwidth(), len(figure.axes)) == shape
