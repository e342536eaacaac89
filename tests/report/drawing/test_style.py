import io
import re
import subprocess
import sys

import matplotlib as mpl
import numpy as np
import pytest
from matplotlib.figure import Figure

from albedo_lab.pictures.functions import Function, Functions
from albedo_lab.report.drawing import render
from albedo_lab.report.drawing.style import GRID, INK, OKABE_ITO, STYLE, error_band, legend_above, line

PICTURE = Functions((Function("cosine", np.cos), Function("sine", np.sin, reference=True)), (0.0, 1.5), "x (radians)", "f")


@pytest.fixture(scope="module")
def files():
    return render(PICTURE, PICTURE.trace(), ("svg", "png", "pdf"))


@pytest.fixture
def axes():
    with mpl.rc_context(STYLE):
        yield Figure(figsize=(8.0, 5.0)).subplots()


def test_the_same_data_give_the_same_bytes(files):
    assert render(PICTURE, PICTURE.trace(), ("svg", "png", "pdf")) == files


def test_files_are_what_they_are_called_and_bear_no_date(files):
    assert files["png"].startswith(b"\x89PNG")
    assert files["pdf"].startswith(b"%PDF")
    assert b"<svg" in files["svg"]
    for content in files.values():
        assert not re.search(rb"Matplotlib v|20\d\d-\d\d-\d\d|/CreationDate", content)


def test_a_page_can_replace_every_colour_that_is_none_of_a_curve(files):
    colours = set(re.findall(r"#[0-9a-fA-F]{6}\b", files["svg"].decode()))
    assert {INK, GRID, OKABE_ITO[0].lower()} == {colour.lower() for colour in colours}
    # a path without a fill of its own is black, unless its group says otherwise
    assert b"fill: #1b1b1b" in files["svg"]


def test_only_png_has_a_ground(files):
    assert b"fill: #ffffff" not in files["svg"]
    pixels = mpl.image.imread(io.BytesIO(files["png"]))
    assert pixels[0, 0].tolist() == [1.0, 1.0, 1.0, 1.0]


def test_curves_are_told_apart():
    styles = [(style["color"], style["linestyle"]) for style in map(line, range(24))]
    assert len(set(styles)) == 24
    assert all(linestyle == "solid" for _, linestyle in styles[:6])


def test_an_error_band_is_seen_only_where_the_line_does_not_cover_it(axes):
    x = np.linspace(0.0, 1.0, 11)
    axes.set(xlim=(0, 1), ylim=(0, 1))
    error_band(axes, x, np.full(11, 0.4999), np.full(11, 0.5001), "#0072B2")
    assert not axes.collections
    error_band(axes, x, np.where(x > 0.5, 0.3, 0.5), np.full(11, 0.5), "#0072B2")
    (band,) = axes.collections
    assert band.get_datalim(axes.transData).x0 > 0.5


def test_an_error_band_counts_in_logarithms_where_they_are_drawn(axes):
    axes.set(xlim=(0, 1), yscale="log", ylim=(1e-6, 1))
    error_band(axes, [0.0, 1.0], [1e-5, 1e-5], [1e-4, 1e-4], "#0072B2")
    assert len(axes.collections) == 1


def test_a_legend_has_as_many_columns_as_its_names_leave_room_for(axes):
    for i in range(6):
        axes.plot([0, 1], [i, i], label=f"a name of 33 characters, number {i}")
    legend_above(axes.figure, axes)
    (legend,) = axes.figure.legends
    assert legend._ncols == 2


@pytest.mark.parametrize("names", [[f"{w} nm" for w in range(400, 800, 50)], ["WWWWWWWW"] * 9, ["a long name, " * 4, "b"]])
def test_a_legend_is_no_wider_than_the_picture(axes, names):
    for i, name in enumerate(names):
        axes.plot([0, 1], [i, i], label=f"{name}{i}")
    legend_above(axes.figure, axes)
    axes.figure.draw_without_rendering()
    (legend,) = axes.figure.legends
    box = legend.get_window_extent()
    assert 0.0 <= box.x0 < box.x1 <= axes.figure.bbox.x1


def test_a_legend_names_each_line_once(axes):
    for name in ("one", "two", "one"):
        axes.plot([0, 1], label=name)
    legend_above(axes.figure, axes, axes)
    assert [text.get_text() for text in axes.figure.legends[0].texts] == ["one", "two"]


def test_only_the_kind_that_is_needed_is_imported():
    code = (
        "import sys, numpy as np, albedo_lab.report.drawing as d; from albedo_lab.pictures.functions import *;"
        "p = Functions((Function('f', np.cos),), (0., 1.), 'x', 'f'); d.render(p, p.trace(), ());"
        "print([m for m in sys.modules if m.startswith('albedo_lab.report.drawing.') or m == 'matplotlib.pyplot'])"
    )
    told = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout
    names = {name.rpartition(".")[2] for name in re.findall(r"'(.*?)'", told)}
    assert names == {"style", "functions", "discs"}
