import io

import matplotlib as mpl
import numpy as np
import pandas as pd
import pytest

from albedo_lab.optics.colour import encode
from albedo_lab.pictures.base import Curve
from albedo_lab.pictures.previews import Previews
from albedo_lab.report.drawing import render
from albedo_lab.report.drawing.previews import MARKS, draw
from albedo_lab.report.drawing.style import GRID, INK, STYLE

SIZE = 16


def drawn(radiance=0.5, lights=("directional", "eye", "sky"), shapes=("sphere",), labels=("first", "second"), **shares):
    picture = Previews(tuple(Curve(label, "lambert") for label in labels), lights, shapes, SIZE)
    values = np.broadcast_to(np.asarray(radiance, dtype=float), (len(labels), len(shapes), len(lights), SIZE, SIZE, 3))
    told = {"clipped": 0.0, "negative": 0.0, "not_finite": 0.0, **shares}
    rows = [{"curve": c, "shape": s, "light": li, **told} for c in labels for s in shapes for li in lights]
    coverage = np.ones((len(shapes), SIZE, SIZE))
    coverage[:, :2] = 0.25
    with mpl.rc_context(STYLE):
        return draw(picture, {"": pd.DataFrame(rows), "radiance": values, "coverage": coverage})


def arrows(axes):
    return [text for text in axes.texts if getattr(text, "arrow_patch", None)]


def test_columns_are_curves_and_rows_shapes_and_lights():
    figure = drawn(shapes=("sphere", "cylinder"))
    assert len(figure.axes) == 12
    assert [axes.get_title(loc="left") for axes in figure.axes[:4]] == ["first", "second", "", ""]
    rows = [axes.get_ylabel().split("\n", 1) for axes in figure.axes[::2]]
    assert [row[0] for row in rows] == ["sphere"] * 3 + ["cylinder"] * 3
    assert [row[1].replace("\n", " ") for row in rows[:3]] == ["light from the upper left", "light at the eye", "uniform sky"]
    assert not figure.legends


def test_linear_light_becomes_srgb_and_coverage_opacity():
    (image,) = drawn([0.1, 0.5, 2.0]).axes[0].images
    rgba = image.get_array()
    np.testing.assert_allclose(rgba[8, 8], [*encode([0.1, 0.5, 1.0]), 1.0])
    assert rgba[0, 0, 3] == 0.25


@pytest.mark.parametrize(("name", "value"), [("clipped", 1.5), ("negative", -0.2), ("not_finite", np.nan)])
def test_what_cannot_be_shown_is_outlined_and_told(name, value):
    radiance = np.full((SIZE, SIZE, 3), 0.5)
    radiance[4:8, 4:8, 1] = value
    figure = drawn(radiance, **{name: 0.0625})
    axes = figure.axes[0]
    around = {mpl.colors.to_hex(line.get_color()): line.get_xydata() for line in axes.get_lines()}
    assert set(around) == {GRID, MARKS[name][0].lower()}
    corners = around[MARKS[name][0].lower()]
    np.testing.assert_array_equal([corners.min(axis=0), corners.max(axis=0)], [[3.5, 3.5], [7.5, 7.5]])
    assert axes.get_xlabel() == f"6.2 % {name.replace('_', ' ')}"
    assert [text.get_text() for text in figure.legends[0].texts] == [MARKS[name][1]]


def test_only_a_light_beside_the_viewer_has_an_arrow():
    figure = drawn()
    assert [len(arrows(axes)) for axes in figure.axes] == [1, 1, 0, 0, 0, 0]
    (arrow,) = arrows(figure.axes[0])
    middle = 0.5 * SIZE
    assert arrow.xyann[0] < arrow.xy[0] < middle  # from the left
    assert arrow.xyann[1] < arrow.xy[1] < middle  # from above: rows count downwards


def test_no_other_black():
    written = {mpl.colors.to_hex(text.get_color()) for text in drawn(2.0, clipped=1.0).findobj(mpl.text.Text) if text.get_text()}
    assert written == {INK}


def test_the_same_bytes():
    picture = Previews((Curve("Ward", "ward"),), size=24)
    first, second = (render(picture, picture.trace(threads)) for threads in (1, 2))
    assert first == second
    assert mpl.image.imread(io.BytesIO(first["png"])).shape[2] == 4


def test_pixels_are_stored_once_and_left_to_be_resampled():
    picture = Previews((Curve("Lambert", "lambert"),), ("eye",), ("sphere",), 24)
    svg = render(picture, picture.trace(), ("svg",))["svg"]
    assert b'width="24" height="24"' in svg
    assert b"pixelated" not in svg
