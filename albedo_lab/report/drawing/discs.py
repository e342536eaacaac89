"""Polar pictures: the angle from the vertical, clockwise, and a radius that is a value or its logarithm.

Drawn on plain axes, the disc of radius 1: matplotlib's polar axes leave half of a half disc's room empty, and no place for
the light.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.patches import Circle
from matplotlib.ticker import MaxNLocator
from numpy.typing import ArrayLike, NDArray

from albedo_lab.report.drawing.style import GRID, INK, power_of_ten

REACH = 0.95
"""Where in the disc the largest value lies."""
LABELS = 1.1
"""Radius at which angles are written."""
HALF, WHOLE = (-0.16, 1.28), (-1.5, 1.2)
"""What a half and a whole disc take of the vertical."""
ACROSS = 1.3
"""What any disc takes to either side."""
CROWDED = 13.0
"""Degrees within which an arrow displaces the angle's name."""
MOST_RINGS = 5
CENTRE = 1e-9
"""Powers of ten that lie no farther from the centre, in decades, are named there: the disc starts with them."""
SMALL = 11


@dataclass(frozen=True)
class Radius:
    """Values up to `top`, in proportion, or where `decades` are given by their logarithms, so many decades down."""

    top: float
    decades: float | None = None

    def of(self, values: ArrayLike) -> NDArray[np.float64]:
        """The radii of values; what is too small for its logarithm lies in the centre, what is negative nowhere."""
        known = np.asarray(values, dtype=np.float64)
        share = np.where(known >= 0.0, known / self.top, np.nan)
        if self.decades is not None:
            share = 1.0 + np.log10(np.maximum(share, 10.0**-self.decades)) / self.decades
        return np.asarray(REACH * share)

    def rings(self) -> tuple[list[float], list[str]]:
        """Values at which the grid has circles, and how they are written."""
        if self.decades is None:
            ticks = MaxNLocator(nbins=4, steps=[1, 2, 2.5, 5, 10]).tick_values(0.0, self.top / REACH)
            rings = [float(t) for t in ticks if 0.0 < self.of(t) <= 1.0]
            return rings, [f"{ring:.10g}" for ring in rings]
        last = math.floor(math.log10(self.top) + self.decades * (1.0 / REACH - 1.0) + 1e-9)
        first = math.ceil(math.log10(self.top) - self.decades - CENTRE)
        powers = range(last, first - 1, -(1 + (last - first) // MOST_RINGS))
        return [10.0**k for k in powers], [power_of_ten(k) for k in powers]


def height(width: float, half: bool) -> float:
    """The height of a disc's axes, in the unit of their width."""
    low, high = HALF if half else WHOLE
    return width * (high - low) / (2.0 * ACROSS)


def disc(axes: Axes, radius: Radius, half: bool, taken: Iterable[float] = ()) -> None:
    """A half disc from -90 to 90 degrees, or a whole one: rays, circles, and a scale below. Angles near `taken` are not named."""
    axes.set(aspect="equal", xlim=(-ACROSS, ACROSS), ylim=HALF if half else WHOLE)
    axes.set_axis_off()
    grid: dict[str, Any] = {"color": GRID, "linewidth": 1.0, "zorder": 0.5}
    for angle in range(-90, 91, 30) if half else range(0, 360, 30):
        axes.plot(*place(angle, np.array([0.0, 1.0])), **grid)
        if all(abs(angle - other) > CROWDED for other in taken):
            beside = half and abs(angle) == 90
            x, y = place(angle, 1.03 if beside else LABELS)
            aligned = "center" if not beside else "left" if angle > 0 else "right"
            axes.text(x, y, f"{angle}°".replace("-", "−"), ha=aligned, va="center")
    turn = np.linspace(-90.0, 90.0, 181) if half else np.linspace(0.0, 360.0, 361)
    rings, names = radius.rings()
    base = 0.0 if half else -1.28
    axes.plot([-1.0 if half else 0.0, 1.0], [base, base], color=INK, linewidth=1.2, zorder=1.0)
    for r, name in zip(radius.of(rings), names, strict=True):
        axes.plot(*place(turn, r), **grid)
        axes.plot([r, r], [base, base - 0.025], color=INK, linewidth=1.2)
        axes.text(r, base - 0.05, name, ha="center", va="top", fontsize=SMALL)


def curve(axes: Axes, angle_deg: ArrayLike, radii: NDArray[np.float64], **style: Any) -> None:
    """A line; where it leaves the disc it ends."""
    (drawn,) = axes.plot(*place(angle_deg, radii), **style)
    drawn.set_clip_path(Circle((0.0, 0.0), 1.0, transform=axes.transData))


def arrow(axes: Axes, angle_deg: float, color: str) -> None:
    """Light that comes in, outside of the disc."""
    style: dict[str, Any] = {"arrowstyle": "-|>,head_width=0.28,head_length=0.5", "color": color, "linewidth": 2.2}
    tip, tail = place(angle_deg, 1.0), place(angle_deg, 1.24)
    axes.annotate("", tip, tail, arrowprops=style | {"shrinkA": 0, "shrinkB": 0}, annotation_clip=False)


def place(angle_deg: ArrayLike, r: ArrayLike) -> tuple[Any, Any]:
    """x and y of points at angles from the vertical, clockwise, and radii."""
    angle = np.radians(angle_deg)
    return r * np.sin(angle), r * np.cos(angle)
