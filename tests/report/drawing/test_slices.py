import matplotlib as mpl
import numpy as np
import pandas as pd
import pytest

from albedo_lab.pictures.base import Curve
from albedo_lab.pictures.slices import Slices, cells
from albedo_lab.report.drawing import render
from albedo_lab.report.drawing.slices import IMPOSSIBLE, draw, scale
from albedo_lab.report.drawing.style import STYLE


def data_of(picture, value):
    tables = []
    for curve in picture.curves:
        for phi in picture.phi_d_deg:
            at, above = cells(phi)
            theta_h, theta_d, _ = np.degrees(at).T
            known = np.where(above, value(theta_h, theta_d), np.nan)
            table = {"curve": curve.label, "phi_d_deg": phi, "theta_h_deg": theta_h, "theta_d_deg": theta_d}
            tables.append(pd.DataFrame({**table, "above": above, "value": known}))
    return {"": pd.concat(tables, ignore_index=True)}


def drawn(*phi_d_deg, value=lambda h, d: 1.0 + 0.0 * h, labels=("first", "second")):
    picture = Slices(tuple(Curve(label, "lambert") for label in labels), phi_d_deg)
    with mpl.rc_context(STYLE):
        return draw(picture, data_of(picture, value))


def panels(figure):
    return [axes for axes in figure.axes if axes.images and axes.get_visible()]


def test_a_panel_for_each_curve():
    figure = drawn(90.0)
    assert [axes.get_title(loc="left") for axes in panels(figure)] == ["first", "second"]
    assert "degrees" in panels(figure)[0].get_ylabel()
    assert figure.axes[-1].get_ylabel() == "f in 1/sr"
    assert not figure.legends  # nothing lies below the horizon


def test_a_row_for_each_stack():
    figure = drawn(0.0, 45.0, 90.0)
    titles = [axes.get_title(loc="left") for axes in panels(figure)]
    assert [title.partition("=")[2] for title in titles] == [" 0°", " 45°", " 90°"] * 2
    assert titles[0].startswith("first\n")
    assert titles[3].startswith("second\n")
    assert [text.get_text() for text in figure.legends[0].texts] == ["light or viewer below the horizon"]


def test_more_panels_than_fit_in_a_row():
    figure = drawn(*np.arange(0.0, 91.0, 15.0).tolist(), labels=("it",))
    assert len(panels(figure)) == 7
    assert sum("degrees" in axes.get_xlabel() for axes in panels(figure)) == 4


def test_theta_h_lies_to_the_right_in_the_cells_of_a_table_and_theta_d_upwards():
    (axes,) = panels(drawn(90.0, value=lambda h, d: h + 1000.0 * d, labels=("it",)))
    shown = axes.images[0].get_array()
    assert axes.images[0].origin == "lower"
    assert shown[3, 7] == pytest.approx(7.5**2 / 90.0 + 3500.0)
    place = dict(zip([int(t.get_text()) for t in axes.get_xticklabels()], axes.get_xticks(), strict=True))
    assert place[90] == 90.0
    assert place[15] == pytest.approx(90.0 * np.sqrt(15.0 / 90.0))


def test_the_scale_ends_and_tells_of_what_is_smaller():
    def ends(*values):
        norm, smaller = scale(pd.DataFrame({"value": values}))
        return norm.vmin, norm.vmax, smaller

    assert ends(1.0, 100.0) == (1.0, 100.0, False)
    assert ends(1.0, 100.0, 0.0) == (1.0, 100.0, True)
    assert ends(1e-9, 100.0) == (pytest.approx(1e-4), 100.0, True)
    assert ends(2.0, 2.0, np.nan) == (pytest.approx(0.2), 2.0, False)
    assert ends(0.0, 0.0)[2]


def test_negative_and_infinite_values_have_a_colour_of_their_own():
    figure = drawn(0.0, value=lambda h, d: np.where(h < 1.0, -1.0, np.where(d < 1.0, np.inf, 2.0)), labels=("it",))
    (axes,) = panels(figure)
    wrong = ~np.ma.getmaskarray(axes.images[1].get_array())
    assert wrong[0].all() or wrong[0].sum() == 90
    assert wrong[:, 0].sum() == 90
    assert not wrong[40, 40]
    entries = dict(zip([t.get_text() for t in figure.legends[0].texts], figure.legends[0].get_patches(), strict=True))
    assert mpl.colors.to_hex(entries["f negative or not finite"].get_facecolor()) == IMPOSSIBLE.lower()


def test_the_same_bytes():
    picture = Slices((Curve("Ward", "ward"),), (30.0,))
    first, second = (render(picture, picture.trace()) for _ in range(2))
    assert first == second
