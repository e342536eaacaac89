"""Draws previews: a column for each curve, a row for each shape and light, in sRGB, with what the screen cannot show marked."""

from __future__ import annotations

import textwrap
from typing import Any, cast

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.image import AxesImage
from matplotlib.lines import Line2D
from numpy.typing import NDArray

from albedo_lab.optics.colour import encode
from albedo_lab.pictures.base import Data
from albedo_lab.pictures.previews import LAMPS, Previews, faults
from albedo_lab.pictures.scene import VIEWER
from albedo_lab.report.drawing.style import GRID, INK, OKABE_ITO, WIDTH

Array = NDArray[np.float64]

NAMES = {"directional": "light from the\nupper left", "eye": "light at\nthe eye", "sky": "uniform sky"}
MARKS = {
    "clipped": (OKABE_ITO[1], "above 1, clipped"),
    "negative": (OKABE_ITO[0], "below 0"),
    "not_finite": (OKABE_ITO[3], "not finite"),
}
"""The line around such pixels, and what the key says of them."""
SIDE = 1.75
"""Inches of an image, if there is room."""
BESIDE = 2.1
"""Inches for the names of the rows."""
LETTER = 0.105
"""Inches of a letter in a title."""
ARROW = (1.22, 0.98)
"""Its ends, in units of the shape."""
SMALL = 11


class Pixels(AxesImage):
    """An image that stands in a file with the pixels that it has, where what shows the file can resample them itself."""

    def draw(self, renderer: Any) -> None:
        """As other images, but for their pixels."""
        self.set_interpolation("none" if renderer.option_scale_image() else "antialiased")
        super().draw(renderer)


def draw(picture: Previews, data: Data) -> Figure:
    """Images, each with the share of its pixels that cannot be shown."""
    table, radiance, coverage = cast(pd.DataFrame, data[""]), cast(Array, data["radiance"]), cast(Array, data["coverage"])
    rows = [(j, k) for j in range(len(picture.shapes)) for k in range(len(picture.lights))]
    columns = len(picture.curves)
    side = min(SIDE * 1.4 if columns < 4 else SIDE, (WIDTH - BESIDE) / columns)
    titles = ["\n".join(textwrap.wrap(curve.label, int(side / LETTER))) for curve in picture.curves]
    figure = Figure(
        figsize=(side * columns + BESIDE, (side + 0.32) * len(rows) + 0.25 * max(t.count("\n") + 1 for t in titles) + 0.6)
    )
    panels = figure.subplots(len(rows), columns, squeeze=False)
    for row, (j, k) in enumerate(rows):
        for i, title in enumerate(titles):
            axes = panels[row, i]
            told = table.iloc[(i * len(picture.shapes) + j) * len(picture.lights) + k]
            image(axes, radiance[i, j, k], coverage[j])
            arrow(axes, picture.lights[k], picture.size)
            axes.set_xlabel(shares(told), fontsize=SMALL)
            if row == 0:
                axes.set_title(title)
        panels[row, 0].set_ylabel(
            f"{picture.shapes[j]}\n{NAMES[picture.lights[k]]}", rotation=0, ha="right", va="center", labelpad=8
        )
    key(figure, table)
    return figure


def image(axes: Axes, radiance: Array, coverage: Array) -> None:
    """One shape: linear light to sRGB, on no ground; lines go around what is above 1, below 0 or no number."""
    axes.set(xticks=[], yticks=[])
    axes.grid(False)
    axes.spines[:].set_visible(False)
    known = np.nan_to_num(radiance, nan=0.0, posinf=1.0, neginf=0.0)
    rgba = np.concatenate([encode(np.clip(known, 0.0, 1.0)), coverage[..., None]], axis=-1)
    shown = Pixels(axes, interpolation="antialiased", interpolation_stage="rgba")
    shown.set_data(rgba)
    shown.set_extent(shown.get_extent())
    axes.add_image(shown)
    axes.set_aspect("equal")
    outline(axes, coverage, GRID)  # or a black surface is lost on a dark ground, a white one on a white
    for name, mask in faults(radiance).items():
        if mask.any():
            outline(axes, mask.astype(np.float64), MARKS[name][0])


def outline(axes: Axes, share: Array, color: str) -> None:
    """A line around what is covered for one half and more; of lines that bend little only few corners are kept."""
    around = axes.contour(share, levels=[0.5])
    for corners in around.allsegs[0]:
        axes.plot(*corners.T, color=color, linewidth=0.9)
    around.remove()


def arrow(axes: Axes, light: str, size: int) -> None:
    """Where a light beside the viewer comes from, in the empty corner of an image."""
    across = np.array(LAMPS.get(light, VIEWER))[:2]
    if not across.any():
        return
    tail, tip = (0.5 * size * (1.0 + r * across / np.hypot(*across) * [1.0, -1.0]) for r in ARROW)
    style: dict[str, Any] = {"arrowstyle": "-|>,head_width=0.24,head_length=0.4", "color": INK, "linewidth": 1.8}
    axes.annotate("", tuple(tip), tuple(tail), arrowprops=style | {"shrinkA": 0, "shrinkB": 0}, annotation_clip=False)


def shares(told: Any) -> str:
    """What cannot be shown of an image, in words."""
    return "\n".join(f"{100.0 * told[name]:.2g} % {name.replace('_', ' ')}" for name in MARKS if told[name] > 0.0)


def key(figure: Figure, table: pd.DataFrame) -> None:
    """What the lines in the images mean."""
    entries = [
        Line2D([], [], color=color, linewidth=1.6, label=label)
        for name, (color, label) in MARKS.items()
        if table[name].max() > 0.0
    ]
    if entries:
        figure.legend(handles=entries, loc="outside lower center", ncols=len(entries))
