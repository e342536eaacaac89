"""Draws characteristic slices: f as a colour over theta_h and theta_d, on one logarithmic scale for all panels."""

from __future__ import annotations

import textwrap
from typing import cast

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.colors import ListedColormap, LogNorm
from matplotlib.figure import Figure
from matplotlib.image import AxesImage
from matplotlib.patches import Patch, Rectangle

from albedo_lab.measured.cells import SHAPE
from albedo_lab.pictures.base import Data
from albedo_lab.pictures.slices import Slices
from albedo_lab.report.drawing.style import GRID, OKABE_ITO, WIDTH

MOST_DECADES = 6.0
"""Below the largest value; what is smaller has the last colour."""
MOST_COLUMNS = 4
THETA_H, THETA_D = (0, 5, 15, 30, 60, 90), (0, 30, 60, 90)
"""Degrees at the axes. Cells of theta_h are closer together towards 0, as the root of the angle is."""
IMPOSSIBLE = OKABE_ITO[1]
"""Where f is negative or no number."""
BESIDE = 2.8
"""Inches for the scale and what stands at the axes."""
LETTER = 0.115
"""Inches of a letter in a title."""


def draw(picture: Slices, data: Data) -> Figure:
    """A panel for each curve and each phi_d; several phi_d of a curve stand in a row as far as there is room."""
    table = cast(pd.DataFrame, data[""])
    keys = [(curve.label, phi) for curve in picture.curves for phi in picture.phi_d_deg]
    stack = len(picture.phi_d_deg)
    columns = stack if 1 < stack <= MOST_COLUMNS else min(len(keys), MOST_COLUMNS)
    rows = -(-len(keys) // columns)
    side = (WIDTH - BESIDE) / max(columns, 2)
    titles = [
        [
            *(textwrap.wrap(label, int(side / LETTER)) if phi == picture.phi_d_deg[0] else []),
            *([rf"$\phi_d$ = {phi:g}°"] if stack > 1 else []),
        ]
        for label, phi in keys
    ]
    lines = max(len(title) for title in titles)
    figure = Figure(figsize=(side * columns + BESIDE, rows * (side + 0.1 + 0.22 * lines) + 1.0))
    panels = figure.subplots(rows, columns, squeeze=False, sharex=True, sharey=True)
    shown = panels.ravel()[: len(keys)].tolist()
    norm, smaller = scale(table)
    for axes, (label, phi_d_deg), title in zip(shown, keys, titles, strict=True):
        own = table[(table.curve == label) & (table.phi_d_deg == phi_d_deg)]
        image = panel(axes, own, norm)
        axes.set_title("\n".join(title))
    for axes in panels.ravel()[len(keys) :]:
        axes.set_visible(False)
    for axes in shown[::columns]:
        axes.set_ylabel(r"$\theta_d$ (degrees)")
    for axes in shown[-columns:]:
        axes.set_xlabel(r"$\theta_h$ (degrees)")
        axes.tick_params(labelbottom=True)
    bar = figure.colorbar(image, ax=panels, extend="min" if smaller else "neither", label="f in 1/sr", aspect=25)
    bar.outline.set_visible(False)
    key(figure, table)
    return figure


def scale(table: pd.DataFrame) -> tuple[LogNorm, bool]:
    """Colours for all values above 0, if they are not too many decades; and whether smaller ones are left, 0 among them."""
    known = table.value[np.isfinite(table.value) & (table.value >= 0.0)]
    top = float(known.max()) if known.max() > 0.0 else 1.0
    least = float(known[known > 0.0].min()) if known.max() > 0.0 else top
    low = max(min(least, 0.1 * top), top * 10.0**-MOST_DECADES)
    return LogNorm(low, top), bool((known < low).any())


def panel(axes: Axes, own: pd.DataFrame, norm: LogNorm) -> AxesImage:
    """One slice, cell by cell, over the hatched ground of what lies below the horizon."""
    theta_h, theta_d, _ = SHAPE
    value = own.value.to_numpy().reshape(theta_h, theta_d).T
    impossible = own.above.to_numpy().reshape(theta_h, theta_d).T & ~((value >= 0.0) & np.isfinite(value))
    square = (0.0, 90.0, 0.0, 90.0)
    axes.add_patch(Rectangle((0.0, 0.0), 90.0, 90.0, facecolor="none", edgecolor=GRID, hatch="////", linewidth=0.0, zorder=0.5))
    image = axes.imshow(
        np.ma.masked_invalid(np.maximum(value, norm.vmin or 0.0)),
        norm=norm,
        origin="lower",
        extent=square,
        interpolation="nearest",
        zorder=1.0,
    )
    wrong = np.ma.masked_equal(impossible.astype(np.float64), 0.0)
    axes.imshow(wrong, cmap=ListedColormap([IMPOSSIBLE]), origin="lower", extent=square, interpolation="nearest", zorder=1.1)
    axes.set(xticks=[90.0 * (angle / 90.0) ** 0.5 for angle in THETA_H], xticklabels=THETA_H, yticks=THETA_D)
    axes.grid(False)
    return image


def key(figure: Figure, table: pd.DataFrame) -> None:
    """What is no colour of the scale."""
    faults = table[table.above & ~((table.value >= 0.0) & np.isfinite(table.value))]
    entries = []
    if not table.above.all():
        entries.append(Patch(facecolor="none", edgecolor=GRID, hatch="////", label="light or viewer below the horizon"))
    if len(faults):
        entries.append(Patch(facecolor=IMPOSSIBLE, label="f negative or not finite"))
    if entries:
        figure.legend(handles=entries, loc="outside lower center", ncols=len(entries))
