import matplotlib as mpl
import numpy as np
import pytest

from albedo_lab.lookup.axes import parse_axes
from albedo_lab.pictures.deviations import Deviations
from albedo_lab.report.drawing import render
from albedo_lab.report.drawing.deviations import draw, numbers, scale, signed
from albedo_lab.report.drawing.style import STYLE

AXES = parse_axes(["F0=6", "sqrt(alpha)=8", "mu=5"])


def picture(deviation, axes, forgiven=1e-4):
    truth = np.full_like(deviation, 0.5)
    return Deviations("a table", axes, ("scale", "bias")[: deviation.shape[-1]], truth + deviation, truth, forgiven)


def drawn(of):
    with mpl.rc_context(STYLE):
        return draw(of, of.trace())


def panels(figure):
    return [axes for axes in figure.axes if axes.images and axes.get_visible()]


def test_the_deviation_is_signed_and_nan_where_either_is_none():
    of = picture(np.array([[[1e-3], [-1e-3]], [[np.nan], [np.inf]]]), AXES[1:])
    found = of.trace()["deviation"][..., 0]
    assert found[0] == pytest.approx([1e-3, -1e-3])
    assert np.isnan(found[1]).all()


def test_a_map_shows_each_cell_of_the_table_as_it_lies_in_memory():
    deviation = np.zeros((8, 5, 1))
    deviation[6, 1] = 3e-3
    (axes,) = panels(drawn(picture(deviation, AXES[1:])))
    shown = axes.images[0].get_array()
    assert shown.shape == (8, 5)
    assert np.argmax(np.abs(shown)) == 6 * 5 + 1
    assert axes.get_ylim() == (7.5, -0.5)
    assert axes.get_ylabel() == "row, and alpha, linear in sqrt(alpha)"
    assert axes.get_xlabel() == "column, and mu"
    assert [label.get_text() for label in axes.get_xticklabels()][-1] == "4\n1"


def test_a_panel_for_each_channel_or_slice():
    assert [axes.get_title(loc="left") for axes in panels(drawn(picture(np.zeros((8, 5, 2)), AXES[1:])))] == ["scale", "bias"]
    titles = [axes.get_title(loc="left") for axes in panels(drawn(picture(np.zeros((6, 8, 5, 1)), AXES)))]
    assert titles == ["F0 = 0", "F0 = 0.4", "F0 = 0.6", "F0 = 1"]


def test_one_axis_is_a_line_over_the_band_of_what_is_forgiven():
    figure = drawn(picture(np.linspace(-1e-3, 1e-3, 8)[:, None], AXES[1:2]))
    (axes,) = figure.axes
    assert axes.get_lines()[0].get_ydata() == pytest.approx(np.linspace(-1e-3, 1e-3, 8))
    assert [text.get_text() for text in figure.legends[0].texts] == ["forgiven", "scale"]


@pytest.mark.parametrize(
    ("largest", "forgiven", "top", "least"),
    [(3e-3, 1e-4, 1e-2, 1e-4), (1e-7, 1e-4, 1e-3, 1e-4), (0.7, 1e-6, 1.0, 1e-4), (0.0, 1e-4, 1e-3, 1e-4)],
)
def test_the_scale_is_symmetric_and_linear_where_a_deviation_is_forgiven(largest, forgiven, top, least):
    norm = scale(np.array([largest, np.nan]), forgiven)
    assert [norm.vmin, norm.vmax, norm.linthresh] == pytest.approx([-top, top, least])
    assert norm(0.0) == 0.5


def test_the_numbers_of_the_scale():
    assert [signed(n) for n in numbers(scale(np.array([5e-3]), 1e-3))] == ["−0.01", "−10⁻³", "0", "+10⁻³", "+0.01"]


def test_cells_that_are_no_number_are_told():
    deviation = np.zeros((8, 5, 1))
    assert not drawn(picture(deviation, AXES[1:])).legends
    deviation[2, 2] = np.nan
    (legend,) = drawn(picture(deviation, AXES[1:])).legends
    assert [text.get_text() for text in legend.texts] == ["not a number, or truth unknown"]


def test_the_same_data_give_the_same_bytes():
    of = picture(np.full((8, 5, 1), 1e-3), AXES[1:])
    first, second = (render(of, of.trace(), ("png",))["png"] for _ in range(2))
    assert first == second
