import math

import matplotlib as mpl
import numpy as np
import pandas as pd
import pytest

from albedo_lab.pictures.base import Curve
from albedo_lab.pictures.samples import GRID as POINTS
from albedo_lab.pictures.samples import Samples
from albedo_lab.report.drawing import render
from albedo_lab.report.drawing.samples import DOTS, draw, radius
from albedo_lab.report.drawing.style import INK, STYLE


def drawn(efficiency=12.345, own=True, rejected=0.0123):
    picture = Samples((Curve("first", "lambert"), Curve("second", "lambert")), (0.0, 60.0))
    keys = [(label, theta) for label in ("first", "second") for theta in picture.theta_deg]
    told = [{"own": own, "rejected": rejected, "albedo": 1.0, "efficiency": efficiency}] * 4
    quality = [{"curve": curve, "viewer_deg": theta, **row} for (curve, theta), row in zip(keys, told, strict=True)]
    dots = [{"curve": c, "viewer_deg": t, "x": 0.1 * i, "y": 0.2, "weight": 1.0} for i, (c, t) in enumerate(keys)]
    data = {"": pd.DataFrame(dots), "quality": pd.DataFrame(quality), "f cos": np.ones((2, 2, POINTS, POINTS))}
    with mpl.rc_context(STYLE):
        return draw(picture, data)


def words(axes):
    return next(text.get_text() for text in axes.texts if text.get_text().startswith("viewer"))


def dots(axes):
    return [line for line in axes.get_lines() if line.get_color() == DOTS]


def test_a_row_for_each_curve_and_a_column_for_each_viewer():
    figure = drawn()
    assert [axes.get_title(loc="left") for axes in figure.axes] == ["first", "", "second", ""]
    assert words(figure.axes[1]) == "viewer at 60°\n12.3 × cosine sampling\n1.2 % rejected"
    assert [float(dots(axes)[0].get_xdata()[0]) for axes in figure.axes] == pytest.approx([0.0, 0.1, 0.2, 0.3])


@pytest.mark.parametrize(
    ("options", "told"),
    [
        ({"efficiency": math.inf}, "without variance"),
        ({"efficiency": 134567.0}, "135 000 × cosine sampling"),
        ({"own": False, "efficiency": 1.0}, "no sampler of its own"),
        ({"efficiency": math.nan}, "no lobe to be sampled"),
    ],
)
def test_what_a_sampler_is_worth(options, told):
    axes = drawn(**options).axes[0]
    assert told in words(axes)
    assert len(dots(axes)) == (0 if told.startswith("no lobe") else 1)


def test_viewer_and_mirror_direction_lie_opposite_each_other():
    axes = drawn().axes[1]
    marks = {line.get_marker(): float(np.asarray(line.get_xdata()).ravel()[0]) for line in axes.get_lines()}
    assert marks["o"] == -marks["x"] == pytest.approx(math.sqrt(0.5))  # sqrt(1 - cos 60)
    assert radius(90.0) == pytest.approx(1.0)


def test_no_other_black():
    written = {mpl.colors.to_hex(text.get_color()) for text in drawn().findobj(mpl.text.Text) if text.get_text()}
    assert written == {INK}


def test_the_same_bytes():
    picture = Samples((Curve("Ward", "ward"),), (45.0,), count=200)
    first, second = (render(picture, picture.trace()) for _ in range(2))
    assert first == second
