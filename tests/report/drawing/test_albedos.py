import matplotlib as mpl
import numpy as np
import pandas as pd
import pytest

from albedo_lab.pictures.albedos import Albedos
from albedo_lab.pictures.base import Curve
from albedo_lab.report.drawing.albedos import draw
from albedo_lab.report.drawing.style import OKABE_ITO, STYLE

THETA = np.array([0.0, 30.0, 60.0, 80.0, 89.0, 89.99])


def data_of(**values):
    """Made-up albedos of curves by their names."""
    several = []
    for name, albedo in values.items():
        for order in albedo if isinstance(albedo, dict) else ("wi",):
            a = np.asarray(albedo[order] if isinstance(albedo, dict) else albedo) * np.ones(6)
            mu = np.cos(np.radians(THETA))
            table = {"curve": name, "theta_deg": THETA, "mu": mu, "albedo": a, "ci95_low": a, "ci95_high": a, "order": order}
            several.append(pd.DataFrame(table))
    return {"": pd.concat(several, ignore_index=True)}


def drawn(data, **options):
    picture = Albedos(tuple(Curve(name, "lambert") for name in data[""].curve.unique()), **options)
    with mpl.rc_context(STYLE):
        return draw(picture, data)


def named(axes):
    return {line.get_label(): line for line in axes.get_lines() if not line.get_label().startswith("_")}


def test_one_panel_or_two():
    assert len(drawn(data_of(a=0.5)).axes) == 1
    left, right = drawn(data_of(a=0.5), to_grazing=True).axes
    assert left.get_xlabel() == "incident angle θ (degrees)"
    assert right.get_xlim() == (1.0, 1e-7)
    assert (right.get_xscale(), right.get_yscale()) == ("log", "log")


def test_limits_are_dots_at_90_degrees_in_the_colour_of_their_curve():
    (axes,) = drawn(data_of(a=0.5, b=0.7), limits={"b": 0.4}).axes
    (dot,) = [line for line in axes.get_lines() if line.get_marker() == "o"]
    assert [float(x) for x in (*dot.get_xdata(), *dot.get_ydata())] == [90.0, 0.4]
    assert dot.get_color() == OKABE_ITO[1]


def test_constants_are_dashed_lines_with_their_names():
    figure = drawn(data_of(a=0.5), constants={"mirror": 1.0})
    line = named(figure.axes[0])["mirror"]
    assert line.is_dashed()
    assert set(line.get_ydata()) == {1.0}
    assert [text.get_text() for text in figure.legends[0].texts] == ["a", "mirror"]


def test_a_line_at_1_where_an_albedo_is_above_or_where_the_picture_goes_to_grazing():
    def lines(albedo, **options):
        return ["all light reflected" in named(axes) for axes in drawn(data_of(a=albedo), **options).axes]

    assert lines(0.9) == [False]
    assert lines(1.3) == [True]
    assert lines(0.9, to_grazing=True) == [True, True]
    assert lines(1.3, to_grazing=True, constants={"mirror": 1.0}) == [False, False]


def test_what_both_panels_show_is_named_once():
    (legend,) = drawn(data_of(a=0.5, b=0.7), to_grazing=True).legends
    assert [text.get_text() for text in legend.texts] == ["a", "b", "all light reflected"]


def test_few_decades_towards_grazing_have_numbers_between_the_powers_of_ten():
    def numbers(*albedos):
        axes = drawn(data_of(**{f"a{i}": a for i, a in enumerate(albedos)}), to_grazing=True).axes[1]
        low, high = axes.get_ylim()
        written = axes.yaxis.get_major_formatter()
        return [written(tick) for tick in axes.get_yticks() if low <= tick <= high]

    assert numbers(0.8) == ["0.4", "0.6", "0.8", "1"]
    assert numbers(0.3, 2.0) == ["0.5", "1", "2"]
    assert numbers(1e-3, 50.0) == ["10⁻³", "0.01", "0.1", "1", "10"]


def test_printed_figures_are_open_circles():
    figure = drawn(data_of(a=0.5), to_grazing=True, points=((1e-4, 1.2), (1e-5, 2.6)))
    circles = named(figure.axes[1])["printed in the paper"]
    assert circles.get_markerfacecolor() == "none"
    assert circles.get_data()[0].tolist() == [1e-4, 1e-5]
    assert [text.get_text() for text in figure.legends[0].texts] == ["a", "all light reflected", "printed in the paper"]


def test_both_orders_of_a_model_that_is_not_reciprocal():
    (axes,) = drawn(data_of(a={"wi": 0.5, "wo": 0.9}, b=0.3)).axes
    lines = named(axes)
    assert list(lines) == ["a, for a viewer", "a, for a light", "b"]
    assert [line.get_color() for line in lines.values()] == [OKABE_ITO[0], OKABE_ITO[0], OKABE_ITO[1]]
    assert [line.is_dashed() for line in lines.values()] == [False, True, False]


@pytest.mark.parametrize(
    ("albedo", "top"),
    [
        (0.9, 1.1),
        (0.3, 1.1),
        (0.02, 1.08 * 0.02),
        (1.3, 1.08 * 1.3),
        ([0.9, 0.9, 0.9, 0.9, 5.0, 50.0], 1.1),
        ([0.9, 0.9, 0.9, 0.9, 1.2, 1.69], 1.08 * 1.69),
        (0.0, 1.1),
        (np.nan, 1.1),
        ([0.9, 0.9, np.inf, 0.9, 0.9, 0.9], 1.1),
    ],
)
def test_the_highest_albedo_shown(albedo, top):
    assert drawn(data_of(a=albedo)).axes[0].get_ylim() == pytest.approx((0.0, top))


def test_a_band_where_the_interval_is_wide():
    data = data_of(a=0.5, b=0.7)
    wide = data[""].curve == "b"
    data[""].loc[wide, "ci95_low"] -= 0.05
    data[""].loc[wide, "ci95_high"] += 0.05
    for axes in drawn(data, to_grazing=True).axes:
        (band,) = axes.collections
        assert mpl.colors.to_hex(band.get_facecolor()[0]) == OKABE_ITO[1].lower()


def test_an_albedo_of_nothing_has_a_picture_towards_grazing():
    right = drawn(data_of(a=0.0), to_grazing=True).axes[1]
    assert right.get_ylim()[0] < 0.5 < 1.0 < right.get_ylim()[1]
