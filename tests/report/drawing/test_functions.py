import math

import matplotlib as mpl
import numpy as np
import pytest

from albedo_lab.pictures.functions import Function, Functions
from albedo_lab.report.drawing.discs import REACH
from albedo_lab.report.drawing.functions import draw
from albedo_lab.report.drawing.style import INK, OKABE_ITO, STYLE


def drawn(*functions, x=(0.0, 1.5), **options):
    picture = Functions(functions, x, "angle (radians)", "value", **options)
    with mpl.rc_context(STYLE):
        figure = draw(picture, picture.trace())
    return figure, {line.get_label(): line for line in figure.axes[0].get_lines() if not line.get_label().startswith("_")}


def test_one_reference_is_dashed_ink():
    _, lines = drawn(Function("cosine", np.cos), Function("exact", np.sin, reference=True))
    assert lines["cosine"].get_color() == OKABE_ITO[0]
    assert lines["exact"].get_color() == INK
    assert lines["exact"].is_dashed()
    assert not lines["cosine"].is_dashed()


def test_several_references_have_the_colours_of_what_approximates_them():
    ours = [Function(f"a{i}", np.cos) for i in range(2)]
    theirs = [Function(f"b{i}", np.sin, reference=True) for i in range(2)]
    _, lines = drawn(*ours, *theirs)
    assert [lines[name].get_color() for name in ("a0", "a1", "b0", "b1")] == [*OKABE_ITO[:2], *OKABE_ITO[:2]]
    assert [lines[name].is_dashed() for name in ("a0", "a1", "b0", "b1")] == [False, False, True, True]


def test_axes_are_labelled_and_scaled_as_asked():
    figure, _ = drawn(Function("f", lambda x: x), x=(1e-3, 1.0), log_x=True, log_y=True)
    (axes,) = figure.axes
    assert (axes.get_xlabel(), axes.get_ylabel()) == ("angle (radians)", "value")
    assert (axes.get_xscale(), axes.get_yscale()) == ("log", "log")
    assert axes.get_xlim() == (1e-3, 1.0)


def test_an_axis_in_degrees_has_numbers_at_parts_of_a_right_angle():
    def ticks(x, label):
        picture = Functions((Function("f", np.cos),), x, label, "value")
        with mpl.rc_context(STYLE):
            axes = draw(picture, picture.trace()).axes[0]
        return [tick for tick in axes.get_xticks() if x[0] <= tick <= x[1]]

    assert ticks((0.0, 90.0), "θ (degrees)") == [0.0, 15.0, 30.0, 45.0, 60.0, 75.0, 90.0]
    assert ticks((0.0, 180.0), "φ in degrees") == [0.0, 30.0, 60.0, 90.0, 120.0, 150.0, 180.0]
    assert 20.0 in ticks((0.0, 90.0), "slope")


def test_a_function_and_what_it_stands_for_are_in_one_column_of_the_legend():
    def columns(*kinds):
        functions = [Function(f"a name as long as number {i}", np.cos, reference=kind) for i, kind in enumerate(kinds)]
        (legend,) = drawn(*functions)[0].legends
        return len(legend.texts) // legend._ncols

    assert columns(False, True, False, True, False, True) == 4
    assert columns(False, False, False, True, True, True) == 3


def test_the_window_of_the_values():
    assert drawn(Function("f", np.cos))[0].axes[0].get_ylim()[0] == 0.0
    assert drawn(Function("f", lambda x: np.cos(x) - 2.0))[0].axes[0].get_ylim()[0] < -1.5
    assert drawn(Function("f", lambda x: 1.0 / x), x=(1e-9, 1.0), y=(0.5, 3.0))[0].axes[0].get_ylim() == (0.5, 3.0)


def test_polar_angles_run_clockwise_from_the_vertical():
    _, lines = drawn(Function("f", lambda x: 1.0 + x), x=(0.0, math.pi / 2), polar=True)
    x, y = lines["f"].get_data()
    assert (x[0], y[0]) == pytest.approx((0.0, REACH / (1.0 + math.pi / 2)))
    assert (x[-1], y[-1]) == pytest.approx((REACH, 0.0), abs=1e-12)


def test_a_symmetric_function_is_drawn_on_both_sides():
    _, lines = drawn(Function("f", np.cos), x=(0.0, math.pi / 2), polar=True, symmetric=True)
    x, y = lines["f"].get_data()
    np.testing.assert_allclose(x, -x[::-1], atol=1e-15)
    np.testing.assert_allclose(y, y[::-1], atol=1e-15)


def test_the_disc_is_whole_where_angles_go_beyond_the_horizon():
    half = drawn(Function("f", np.cosh), x=(0.0, math.pi / 2), polar=True)[0].axes[0]
    whole = drawn(Function("f", np.cosh), x=(0.0, 2.0 * math.pi), polar=True)[0].axes[0]
    assert half.get_ylim()[0] > -0.5
    assert whole.get_ylim()[0] < -1.0
    assert "180°" in [text.get_text() for text in whole.texts]
    assert "−90°" in [text.get_text() for text in half.texts]


def test_a_logarithmic_radius_has_as_many_decades_as_the_values_but_not_too_many():
    _, lines = drawn(
        Function("f", lambda x: np.where(x < 0.5, 1e3, 1e1)), Function("least", lambda x: 0.1), polar=True, log_radius=True
    )
    radii = np.hypot(*lines["f"].get_data())
    assert [radii[0], radii[-1]] == pytest.approx([REACH, REACH * 0.5])
    assert np.hypot(*lines["least"].get_data()).max() == pytest.approx(0.0, abs=1e-12)
    assert lines["f"].figure.get_supxlabel() == "radius: value, logarithmic; angle: angle (radians)"
    _, lines = drawn(
        Function("f", lambda x: np.where(x < 0.5, 1.0, 1e-3)), Function("least", lambda x: 1e-30), polar=True, log_radius=True
    )
    assert np.hypot(*lines["f"].get_data())[-1] == pytest.approx(REACH * 0.5)
