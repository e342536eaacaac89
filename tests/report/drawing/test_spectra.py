import itertools

import matplotlib as mpl
import numpy as np
import pandas as pd
import pytest

from albedo_lab.pictures.spectra import Spectra
from albedo_lab.report.drawing.spectra import BAND, draw
from albedo_lab.report.drawing.style import STYLE

THETA = [0.0, 30.0, 60.0, 89.0]


@pytest.fixture
def figure():
    picture = Spectra(("gold", "silver", "copper"), (400.0, 700.0))
    rows = [(m, w, t, 0.5) for m, w, t in itertools.product(picture.metals, picture.wavelengths, THETA)]
    albedos = pd.DataFrame(rows, columns=["metal", "wavelength", "theta_deg", "albedo"])
    colours = pd.DataFrame(
        [(m, t, f"#{i}{i}0000") for m in picture.metals for i, t in enumerate(THETA)], columns=["metal", "theta_deg", "hex"]
    )
    with mpl.rc_context(STYLE):
        return draw(picture, {"": albedos, "colours": colours})


def test_a_panel_for_each_metal_with_a_curve_for_each_wavelength(figure):
    assert [axes.get_title(loc="left") for axes in figure.axes] == ["gold", "silver", "copper"]
    assert [len(axes.get_lines()) for axes in figure.axes] == [2, 2, 2]
    assert [text.get_text() for text in figure.legends[0].texts] == ["400 nm", "700 nm"]


def test_the_lowest_panel_of_each_column_says_what_the_angle_is(figure):
    assert [axes.get_xlabel() != "" for axes in figure.axes] == [False, True, True]


def test_each_angle_has_its_colour_half_way_to_the_next_without_seams(figure):
    bars = [bar for bar in figure.axes[0].patches if bar.get_fill()]
    assert [bar.get_x() for bar in bars] == [0.0, 15.0, 45.0, 74.5]
    assert {bar.get_x() + bar.get_width() for bar in bars} == {90.0}
    assert [mpl.colors.to_hex(bar.get_facecolor()) for bar in bars] == [f"#{i}{i}0000" for i in range(4)]
    assert np.all(np.diff([bar.get_zorder() for bar in bars]) == 0)
    assert {(bar.get_y(), bar.get_y() + bar.get_height()) for bar in bars} == {BAND}


def test_the_albedos_fill_the_panels(figure):
    assert all(axes.get_ylim() == pytest.approx((0.4, 1.14)) for axes in figure.axes)
    assert figure.axes[0].get_yticks().tolist() == pytest.approx([0.4, 0.6, 0.8, 1.0])
