"""One style for every picture: readable at half size, by colour-blind readers, and on light and on dark ground.

Everything that is neither a curve nor a colour of the data is INK or GRID, and the ground is left open: the report's page turns
these two into colours of its theme. No picture may use another black, grey or white.
"""

from __future__ import annotations

import io
import math
import re
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.axis import Axis
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.textpath import TextPath
from matplotlib.ticker import LogLocator, NullFormatter, NullLocator
from numpy.typing import ArrayLike

INK = "#1b1b1b"
"""Text, axes, arrows and lines of reference."""
GRID = "#d9d9d9"

OKABE_ITO = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9")
"""Colours that colour-blind readers tell apart (Okabe and Ito 2008), without the black and the yellow that need one ground."""
DASHES: tuple[Any, ...] = ("solid", (0, (4, 1.5)), (0, (1, 1.2)), (0, (5, 1.2, 1, 1.2)))
"""One after the other for each further round of colours."""

WIDTH = 11.5
"""Inches of a picture across the whole page; one of a single panel has NARROW."""
NARROW = 8.0

STYLE: Any = {
    "font.family": "DejaVu Sans",
    "font.size": 13,
    "text.color": INK,
    "figure.facecolor": "none",
    "savefig.facecolor": "auto",
    "savefig.edgecolor": "none",
    "axes.facecolor": "none",
    "axes.edgecolor": INK,
    "axes.labelcolor": INK,
    "axes.titlecolor": INK,
    "axes.titlelocation": "left",
    "axes.titlesize": 13,
    "axes.titleweight": "bold",
    "axes.unicode_minus": True,
    "xtick.color": INK,
    "ytick.color": INK,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.grid": True,
    "grid.color": GRID,
    "axes.axisbelow": True,
    "hatch.color": GRID,
    "image.cmap": "viridis",
    "lines.linewidth": 2.2,
    "lines.solid_capstyle": "round",
    "legend.frameon": False,
    "legend.handlelength": 1.65,
    "legend.labelcolor": INK,
    "legend.borderaxespad": 0.8,
    "savefig.dpi": 150,
    "figure.constrained_layout.use": True,
    "figure.constrained_layout.w_pad": 0.1,
    "figure.constrained_layout.h_pad": 0.1,
    "svg.hashsalt": "albedo-lab",
}
REFERENCE: dict[str, Any] = {"color": INK, "linestyle": (0, (5, 3)), "linewidth": 1.6}
"""A line of reference: what others are compared with."""

PLACES = re.compile(rb'\b(?:d|x|y|x1|x2|y1|y2|points)="[^"]*"')
"""The attributes of an SVG element that hold places."""
SUPERSCRIPTS = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")
BETWEEN = {5.0: (1.0, 2.0, 3.0, 4.0, 6.0, 8.0), 50.0: (1.0, 2.0, 5.0)}
"""What a logarithmic axis has numbers at besides the powers of ten, where its ends differ by a smaller factor."""
BESIDE = STYLE["legend.handlelength"] + 0.8 + 2.0
"""What a name in a legend has beside it, in heights of its letters: its line, and a gap to either side."""
ENDS = 2.0 - 0.8
"""No gap is needed after the last name of a row, only the legend's own edge, in the same unit."""
LONG = re.compile(rb"-?\d+\.\d{3,}")
COARSE = b' style="image-rendering:crisp-edges;image-rendering:pixelated"'
"""Of an image that is not resampled: its pixels would be seen."""
UNDATED: dict[str, dict[str, None]] = {
    "svg": {"Date": None, "Creator": None},
    "png": {"Software": None},
    "pdf": {"Creator": None, "Producer": None, "CreationDate": None},
}
"""What makes the bytes depend on the day, or on who drew them."""


def line(i: int) -> dict[str, Any]:
    """The style of the curve of number `i`: a colour of its own, and dashes from the seventh curve on."""
    return {"color": OKABE_ITO[i % len(OKABE_ITO)], "linestyle": DASHES[i // len(OKABE_ITO) % len(DASHES)]}


def error_band(axes: Axes, x: ArrayLike, low: ArrayLike, high: ArrayLike, color: str) -> None:
    """Shades what lies between the bounds where the line does not cover it; for axes whose scales and limits are set."""
    x, low, high = (np.asarray(values, dtype=np.float64) for values in (x, low, high))
    figure = axes.get_figure(root=True)
    inches = 0.0 if figure is None else axes.get_position().height * figure.get_figheight()
    ends = [(axes.transScale + axes.transLimits).transform(np.column_stack([x, y]))[:, 1] for y in (low, high)]
    with np.errstate(invalid="ignore"):  # infinite bounds lie nowhere
        wider = (ends[1] - ends[0]) * inches * 72.0 > STYLE["lines.linewidth"]
    if np.any(wider):
        axes.fill_between(x, low, high, where=wider.tolist(), color=color, alpha=0.3, linewidth=0)


def logarithmic(axis: Axis) -> None:
    """Numbers at the ticks of an axis whose scale is a logarithm and whose ends are set, written as everywhere else."""
    low, high = sorted(map(float, axis.get_view_interval()))
    multiples = next((numbers for factor, numbers in BETWEEN.items() if high < factor * low), None)
    if multiples is not None:
        axis.set_major_locator(LogLocator(subs=multiples))
        axis.set_minor_locator(NullLocator())
    axis.set_major_formatter(lambda value, _: written(value))
    axis.set_minor_formatter(NullFormatter())


def written(value: float) -> str:
    """A number at a logarithmic axis.

    >>> written(1e-5), written(0.2), written(5.0)
    ('10⁻⁵', '0.2', '5')
    """
    k = round(math.log10(value))
    return power_of_ten(k) if math.isclose(value, 10.0**k) else f"{value:g}"


def power_of_ten(k: int) -> str:
    """As people write it.

    >>> power_of_ten(-5), power_of_ten(-1), power_of_ten(2)
    ('10⁻⁵', '0.1', '100')
    """
    return f"{10.0**k:g}" if -2 <= k <= 2 else f"10{str(k).translate(SUPERSCRIPTS)}"


def legend_above(figure: Figure, *panels: Axes, together: int = 1) -> None:
    """What the lines of the panels are, above the picture, in rows as long as the names allow and no longer than needed.

    A name that several panels share stands once. So many names as belong `together` stay in one column.
    """
    named: dict[str, Any] = {}
    for axes in panels:
        for handle, label in zip(*axes.get_legend_handles_labels(), strict=True):
            named.setdefault(label, handle)
    widest = max(TextPath((0.0, 0.0), label, size=STYLE["font.size"]).get_extents().width for label in named)
    most = max(1, int((figure.get_figwidth() * 72.0 + ENDS * STYLE["font.size"]) / (widest + BESIDE * STYLE["font.size"])))
    rows = together * -(-len(named) // (most * together))
    columns = -(-len(named) // rows)
    handles, labels = list(named.values()), list(named)
    if together > 1:  # matplotlib makes columns of like length
        handles += [Line2D([], [], linestyle="")] * (rows * columns - len(named))
        labels += [""] * (rows * columns - len(named))
    figure.legend(handles, labels, loc="outside upper center", ncols=columns)


def saved(figure: Figure, kind: str) -> bytes:
    """The picture as a file of the kind "svg", "png" or "pdf"; png has a white ground, the others none."""
    stream = io.BytesIO()
    figure.savefig(stream, format=kind, metadata=UNDATED[kind], facecolor="white" if kind == "png" else "none")
    return compact(stream.getvalue()) if kind == "svg" else stream.getvalue()


def compact(svg: bytes) -> bytes:
    """The same picture with places to a hundredth of a point, which nobody sees, in half as many bytes; images stay smooth."""
    svg = svg.replace(COARSE, b"")
    return PLACES.sub(lambda places: LONG.sub(lambda number: b"%g" % round(float(number[0]), 2), places[0]), svg)
