"""Draws the deviations of a table: a map with a signed logarithmic scale, beside how they are distributed; lines for one axis."""

from __future__ import annotations

import math
import textwrap
from collections.abc import Callable
from typing import cast

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import LinearSegmentedColormap, SymLogNorm
from matplotlib.figure import Figure
from matplotlib.image import AxesImage
from matplotlib.patches import Patch
from matplotlib.ticker import FixedLocator, FuncFormatter, NullLocator
from numpy.typing import NDArray

from albedo_lab.lookup.axes import Axis
from albedo_lab.pictures.base import Data
from albedo_lab.pictures.deviations import Deviations
from albedo_lab.report.drawing.style import GRID, INK, NARROW, OKABE_ITO, REFERENCE, WIDTH, legend_above, power_of_ten

LOW, HIGH = OKABE_ITO[0], OKABE_ITO[1]
SIGNED = LinearSegmentedColormap.from_list("signed", [LOW, "#ffffff", HIGH])
"""Too low is blue, too high is orange; what is forgiven is white."""
UNKNOWN = OKABE_ITO[3]
"""Where the table or the truth is no number."""
MOST_DECADES = 4
TICKS = 5
"""With numbers along an axis; 3 in panels narrower than half of the page."""
LETTER = 0.115
"""Inches of a letter in a title."""


def draw(picture: Deviations, data: Data) -> Figure:
    """A map for each channel and slice, or a line for each channel where there is one axis only."""
    deviation = cast(NDArray[np.float64], data["deviation"])
    return lines(picture, deviation) if len(picture.axes) == 1 else maps(picture, deviation)


def scale(deviation: NDArray[np.float64], forgiven: float) -> SymLogNorm:
    """Symmetric about 0, a logarithm beyond what is forgiven, and as wide as the largest deviation."""
    largest = float(np.nanmax(np.abs(deviation), initial=0.0))
    top = max(10.0 ** math.ceil(math.log10(max(largest, 1e-300))), 10.0 * forgiven)
    least = max(forgiven, top * 10.0**-MOST_DECADES)
    return SymLogNorm(linthresh=least, linscale=0.5, vmin=-top, vmax=top, base=10)


def maps(picture: Deviations, deviation: NDArray[np.float64]) -> Figure:
    """Rows of the table downwards, as they lie in memory, columns to the right."""
    *slow, down, right = picture.axes
    slices = [None] if not slow else np.unique(np.rint(np.linspace(0, slow[0].size - 1, picture.shown)).astype(int)).tolist()
    norm = scale(deviation, picture.forgiven)
    count = len(slices) * len(picture.channels)
    columns = min(count, 4)
    rows = -(-count // columns)
    side = min((WIDTH - 2.6) / columns, 6.4)
    figure = Figure(figsize=(side * columns + 2.6, (side + 0.8) * rows + 0.9))
    panels = figure.subplots(rows, columns, squeeze=False)
    image = None
    for axes, (channel, at) in zip(panels.ravel(), ((c, i) for c in range(len(picture.channels)) for i in slices), strict=False):
        own = deviation[..., channel] if at is None else deviation[at, ..., channel]
        image = panel(axes, own, norm, down, right, TICKS if columns < 3 else 3)
        if axes not in panels[:, 0]:
            axes.set_ylabel("")
        words = [picture.channels[channel]] if len(picture.channels) > 1 else []
        words += [f"{slow[0].name} = {slow[0].nodes[at]:.3g}"] if at is not None else []
        axes.set_title(", ".join(words))
    for axes in panels.ravel()[count:]:
        axes.set_visible(False)
    assert image is not None
    bar = figure.colorbar(image, ax=panels, label="table minus truth", aspect=25)
    bar.outline.set_visible(False)
    ticks = numbers(norm)
    bar.ax.yaxis.set_major_locator(FixedLocator(ticks))
    bar.ax.yaxis.set_minor_locator(NullLocator())
    bar.ax.yaxis.set_major_formatter(FuncFormatter(lambda value, _: signed(value)))
    head(figure, picture, side * columns + 2.6)
    if not np.all(np.isfinite(deviation)):
        figure.legend(handles=[Patch(facecolor=UNKNOWN, label="not a number, or truth unknown")], loc="outside lower center")
    return figure


def panel(axes: Axes, own: NDArray[np.float64], norm: SymLogNorm, down: Axis, right: Axis, ticks: int) -> AxesImage:
    """One slice, cell by cell, with the indices and the values of the variables at its sides."""
    axes.set_facecolor(UNKNOWN)
    image = axes.imshow(np.ma.masked_invalid(own), cmap=SIGNED, norm=norm, interpolation="nearest", aspect="auto")
    for side, axis in ((axes.yaxis, down), (axes.xaxis, right)):
        side.set_major_locator(FixedLocator(places(axis, ticks)))
        side.set_major_formatter(FuncFormatter(labelled(axis)))
    axes.set_ylabel(f"row, and {of_axis(down)}" if ticks == TICKS else f"row, and {down.name}")
    axes.set_xlabel(f"column, and {of_axis(right)}")
    for spine in axes.spines.values():
        spine.set(visible=True, edgecolor=GRID)
    axes.grid(False)
    return image


def places(axis: Axis, count: int) -> list[int]:
    """Indices that have numbers, both ends among them."""
    return [int(i) for i in np.unique(np.rint(np.linspace(0, axis.size - 1, min(count, axis.size))))]


def of_axis(axis: Axis) -> str:
    """What runs along an axis, in words."""
    return axis.name if axis.label == axis.name else f"{axis.name}, linear in {axis.label}"


def labelled(axis: Axis) -> Callable[[float, int], str]:
    """What stands at a node: its index, and the value of the variable."""
    values = axis.values(np.clip(axis.coordinates, 0.0, 1.0))

    def words(place: float, _: int) -> str:
        return f"{round(place)}\n{values[round(place)]:.3g}" if 0 <= round(place) < axis.size else ""

    return words


def lines(picture: Deviations, deviation: NDArray[np.float64]) -> Figure:
    """Deviations over the one axis, with the band of what is forgiven."""
    (axis,) = picture.axes
    figure = Figure(figsize=(NARROW, 5.0))
    axes = figure.subplots()
    x = np.arange(axis.size)
    axes.axhspan(-picture.forgiven, picture.forgiven, color=GRID, linewidth=0, label="forgiven")
    for channel, name in enumerate(picture.channels):
        axes.plot(x, deviation[..., channel], "o-", color=OKABE_ITO[channel], markersize=5, linewidth=1.2, label=name)
    axes.axhline(0.0, **REFERENCE)
    axes.set(xlabel=f"index, and {of_axis(axis)}", ylabel="table minus truth")
    axes.xaxis.set_major_locator(
        FixedLocator(np.unique(np.rint(np.linspace(0, axis.size - 1, 2 * TICKS - 1)).astype(int)).tolist())
    )
    axes.xaxis.set_major_formatter(FuncFormatter(labelled(axis)))
    axes.ticklabel_format(axis="y", style="sci", scilimits=(-3, 3), useMathText=True)
    legend_above(figure, axes)
    axes.set_title("\n".join(textwrap.wrap(picture.title, int(NARROW / LETTER))), fontweight="normal")
    return figure


def head(figure: Figure, picture: Deviations, width: float) -> None:
    """What is compared with what."""
    figure.suptitle("\n".join(textwrap.wrap(picture.title, int(width / LETTER))), x=0.02, ha="left", fontsize=13, color=INK)


def numbers(norm: SymLogNorm) -> list[float]:
    """The powers of ten of the scale, to both sides, and 0."""
    top, least = float(norm.vmax or 1.0), float(norm.linthresh)
    powers = [10.0**k for k in range(math.ceil(math.log10(least) - 1e-9), round(math.log10(top)) + 1)]
    return [*(-p for p in reversed(powers)), 0.0, *powers]


def signed(value: float) -> str:
    """A number of the scale as people write it."""
    if value == 0.0:
        return "0"
    return f"{'+' if value > 0 else '−'}{power_of_ten(round(math.log10(abs(value))))}"
