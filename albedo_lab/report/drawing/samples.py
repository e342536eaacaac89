"""Draws where samples fall: dots over f cos in the disc of equal solid angles, with what the sampler is worth."""

from __future__ import annotations

import math
import textwrap
from typing import Any, cast

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.colors import LinearSegmentedColormap, LogNorm
from matplotlib.figure import Figure
from numpy.typing import NDArray

from albedo_lab.pictures.base import Data
from albedo_lab.pictures.samples import Samples
from albedo_lab.report.drawing.style import GRID, INK, OKABE_ITO, WIDTH

DECADES = 4.0
"""Of f cos, below its largest value in a panel."""
LIGHT = LinearSegmentedColormap.from_list("light", [f"{OKABE_ITO[5]}00", OKABE_ITO[5]])
"""From nothing, whatever the ground, to blue."""
DOTS = OKABE_ITO[1]
RINGS = (30, 60, 90)
"""Polar angles in degrees that circles stand for."""


def draw(picture: Samples, data: Data) -> Figure:
    """A row for each curve, a column for each viewer."""
    table, quality, f_cos = (
        cast(pd.DataFrame, data[""]),
        cast(pd.DataFrame, data["quality"]),
        cast(NDArray[np.float64], data["f cos"]),
    )
    rows, columns = len(picture.curves), len(picture.theta_deg)
    side = WIDTH / max(columns, 2)
    figure = Figure(figsize=(side * columns, (0.93 * side + 1.3) * rows + 0.6))
    panels = figure.subplots(rows, columns, squeeze=False, gridspec_kw={"hspace": 0.1})
    for i, curve in enumerate(picture.curves):
        for j, theta_deg in enumerate(picture.theta_deg):
            axes = panels[i, j]
            own = table[(table.curve == curve.label) & (table.viewer_deg == theta_deg)]
            told = quality[(quality.curve == curve.label) & (quality.viewer_deg == theta_deg)].iloc[0]
            disc(axes, f_cos[i, j])
            if not math.isnan(told.efficiency):
                axes.plot(own.x, own.y, ".", color=DOTS, markersize=2.0, markeredgewidth=0.0, rasterized=True, zorder=2.0)
            at = radius(theta_deg)
            axes.plot(at, 0.0, "o", markersize=9, markerfacecolor="none", markeredgecolor=INK, markeredgewidth=1.6, zorder=3.0)
            axes.plot(-at, 0.0, "x", markersize=8, color=INK, markeredgewidth=1.6, zorder=3.0)
            axes.text(0.0, -1.1, f"viewer at {theta_deg:g}°\n{worth(told)}", ha="center", va="top")
        panels[i, 0].set_title("\n".join(textwrap.wrap(curve.label, int(side / 0.115))))
    figure.supxlabel("dots: directions drawn; blue: f cos θ, in logarithms; ○ viewer, × its mirror direction", fontsize=13)
    return figure


def radius(theta_deg: float) -> float:
    """Of a polar angle, where equal areas are equal solid angles: sqrt(1 - cos theta)."""
    return math.sqrt(2.0) * math.sin(math.radians(0.5 * theta_deg))


def disc(axes: Axes, f_cos: NDArray[np.float64]) -> None:
    """The hemisphere from above, with what there is to be found."""
    axes.set(aspect="equal", xlim=(-1.06, 1.06), ylim=(-1.06, 1.06))
    axes.set_axis_off()
    top = np.nanmax(np.where(np.isfinite(f_cos), f_cos, 0.0))
    if top > 0.0:
        shown = np.ma.masked_invalid(np.maximum(f_cos, 10.0**-DECADES * top))
        edge = 1.0 + 1.0 / (len(f_cos) - 1)
        norm = LogNorm(10.0**-DECADES * top, top)
        axes.imshow(
            shown, norm=norm, cmap=LIGHT, origin="lower", extent=(-edge, edge, -edge, edge), interpolation="none", zorder=0.2
        )
    turn = np.linspace(0.0, 2.0 * math.pi, 181)
    for angle in RINGS:
        r = radius(angle)
        axes.plot(r * np.cos(turn), r * np.sin(turn), color=GRID, linewidth=1.0, zorder=0.5)
        if angle < max(RINGS):
            axes.text(0.0, r, f"{angle}°", ha="center", va="center", fontsize=10, zorder=1.0)


def worth(told: Any) -> str:
    """Efficiency and rejection in words, a line each."""
    if math.isnan(told.efficiency):
        return "no lobe to be sampled\n"
    if not told.own:
        return "no sampler of its own:\nby the cosine"
    times = "without variance" if math.isinf(told.efficiency) else f"{rounded(told.efficiency)} × cosine sampling"
    return f"{times}\n{100.0 * told.rejected:.2g} % rejected"


def rounded(x: float) -> str:
    """To three digits, in groups of three where it is large.

    >>> rounded(0.12345), rounded(12.345), rounded(134567.0)
    ('0.123', '12.3', '135 000')
    """
    return f"{float(f'{x:.3g}'):,.0f}".replace(",", " ") if x >= 1000.0 else f"{x:.3g}"
