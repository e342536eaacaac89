import itertools

import matplotlib as mpl
import numpy as np
import pandas as pd
import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg

from albedo_lab.pictures.base import Curve
from albedo_lab.pictures.lobes import Lobes
from albedo_lab.report.drawing import render
from albedo_lab.report.drawing.lobes import CUT, draw, enlargement, seen, turned
from albedo_lab.report.drawing.style import GRID, INK, OKABE_ITO, STYLE

THETA, PHI = (part.ravel() for part in np.meshgrid([0.0, 30.0, 60.0, 89.0], np.arange(0.0, 361.0, 45.0), indexing="ij"))


def data_of(picture, values, mirror=0.0, isotropic=True):
    """Lobes with a value for each light, the same towards all viewers, or an array of them."""
    tables, mirrors = [], []
    for curve in picture.curves:
        for light, value in zip(picture.theta_deg, values, strict=True):
            table = {"curve": curve.label, "light_deg": light, "viewer_deg": THETA, "viewer_phi_deg": PHI}
            tables.append(pd.DataFrame({**table, "value": value * np.ones(len(THETA))}))
            mirrors.append({"curve": curve.label, "light_deg": light, "reflectance": mirror})
    axes = pd.DataFrame([{"curve": curve.label, "isotropic": isotropic} for curve in picture.curves])
    return {"": pd.concat(tables, ignore_index=True), "mirrors": pd.DataFrame(mirrors), "axes": axes}


def drawn(values, **options):
    picture = Lobes((Curve("first", "lambert"), Curve("second", "lambert")), (15.0, 45.0, 75.0))
    with mpl.rc_context(STYLE):
        return draw(picture, data_of(picture, values, **options))


def words(figure):
    return [next(text.get_text() for text in axes.texts if text.get_text()) for axes in figure.axes]


def reach(axes):
    """The farthest corner of a lobe from the point, as far as it is seen."""
    (lobe,) = axes.collections
    return max(np.abs(path.vertices[:, 0]).max() for path in lobe.get_paths())


def test_a_row_for_each_curve_and_a_column_for_each_light():
    figure = drawn((1.0, 0.5, 0.4))
    assert [axes.get_title(loc="left") for axes in figure.axes] == ["first", "", "", "second", "", ""]
    assert words(figure)[:3] == ["light at 15°\nup to 1", "light at 45°\nup to 0.5", "light at 75°\nup to 0.4"]
    assert "1/sr" in figure.get_supxlabel()
    assert reach(figure.axes[0]) == pytest.approx(2.0 * reach(figure.axes[1])) == pytest.approx(2.5 * reach(figure.axes[2]))


def test_a_small_lobe_is_enlarged_and_says_so():
    figure = drawn((1.0, 0.12, 0.5))
    assert words(figure)[1] == "light at 45°\nup to 0.12\nenlarged 5 times"
    assert reach(figure.axes[1]) == pytest.approx(0.6 * reach(figure.axes[0]))


@pytest.mark.parametrize(("top", "factor"), [(1.0, 1.0), (0.34, 1.0), (0.24, 2.0), (0.19, 5.0), (0.01, 100.0), (0.0, 1.0)])
def test_enlargement(top, factor):
    assert enlargement(top, 1.0) == factor


def test_what_cannot_be_drawn_is_told():
    shooting = np.where(THETA == 89.0, 100.0, 1.0)
    figure = drawn((shooting, -1.0, np.where(THETA == 0.0, np.nan, 0.5)))
    told = words(figure)
    assert "up to 100, cut at" in told[0]
    assert "down to -1" in told[1]
    assert "not finite in places" in told[2]
    assert reach(figure.axes[0]) <= CUT


def test_a_dirac_part_is_an_arrow_in_the_mirror_direction():
    for mirror in (0.0, 0.25):
        axes = drawn((1.0, 1.0, 1.0), mirror=mirror).axes[1]
        arrows = [text for text in axes.texts if getattr(text, "arrow_patch", None)]
        assert len(arrows) == (2 if mirror else 1)
        light = np.array([-1.0, 0.0, 1.0]) / np.sqrt(2.0)
        np.testing.assert_allclose(arrows[0].xy, seen(light), atol=1e-12)
        if mirror:
            np.testing.assert_allclose(arrows[1].xy, seen(CUT * light * [-1.0, 1.0, 1.0]), atol=1e-12)
    assert "mirror 0.25" in words(drawn((1.0, 1.0, 1.0), mirror=0.25))[0]


def test_grooves_are_drawn_and_turned():
    plain, grooved = (drawn((1.0, 1.0, 1.0), isotropic=isotropic).axes[0] for isotropic in (True, False))
    assert len(grooved.get_lines()) > len(plain.get_lines())
    np.testing.assert_allclose(turned(np.array([[1.0, 0.0, 0.5]]), 90.0), [[0.0, 1.0, 0.5]], atol=1e-12)


def test_no_other_black_and_the_colours_of_curves():
    figure = drawn((1.0, 0.5, 0.25), mirror=0.5)
    written = {mpl.colors.to_hex(text.get_color()) for text in figure.findobj(mpl.text.Text) if text.get_text()}
    lines = {mpl.colors.to_hex(line.get_color()) for axes in figure.axes for line in axes.get_lines()}
    assert written == {INK}
    assert lines == {INK, GRID}
    brightest = figure.axes[3].collections[0].get_facecolor()[:, :3].max(axis=0)
    assert np.all(brightest <= np.array(mpl.colors.to_rgb(OKABE_ITO[1])) + 1e-12)


def test_the_same_bytes():
    picture = Lobes((Curve("Ward", "ward", {"m_x": 0.1, "m_y": 0.4}),), (30.0,), phi_deg=20.0)
    first, second = (render(picture, picture.trace()) for _ in range(2))
    assert first == second
    assert first["png"].startswith(b"\x89PNG")


def test_nothing_that_is_written_lies_outside_or_on_something_else_written():
    figure = drawn((1.0, 0.12, 0.5), mirror=0.5)
    FigureCanvasAgg(figure).draw()
    written = [*(text for axes in figure.axes for text in [axes._left_title, *axes.texts]), *figure.texts]
    boxes = [text.get_window_extent() for text in written if text.get_text()]
    assert len(boxes) == 2 + 6 + 1
    assert all(figure.bbox.x0 <= box.x0 and box.x1 <= figure.bbox.x1 for box in boxes)
    assert all(figure.bbox.y0 <= box.y0 and box.y1 <= figure.bbox.y1 for box in boxes)
    assert not any(one.overlaps(other) for one, other in itertools.combinations(boxes, 2))
