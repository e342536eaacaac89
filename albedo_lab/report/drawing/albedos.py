"""Draws albedo curves against the angle, and towards grazing incidence against its cosine."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any, cast

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator, NullLocator

from albedo_lab.pictures.albedos import Albedos
from albedo_lab.pictures.base import Data
from albedo_lab.report.drawing.style import INK, NARROW, REFERENCE, WIDTH, error_band, legend_above, line, logarithmic

OVER = {"wo": "for a light", "wi": "for a viewer"}
"""Which direction the angle is of, where it makes a difference."""
DARK = 0.25
"""A picture all of whose albedos are below shows them larger."""
MOST, SHOOTING_FROM = 4.0, 85.0
"""An albedo that grows larger is seen up to that angle, and may leave the picture beyond."""
CIRCLE: dict[str, Any] = {
    "marker": "o",
    "markersize": 9,
    "markerfacecolor": "none",
    "markeredgecolor": INK,
    "markeredgewidth": 1.6,
    "linestyle": "",
}
"""A printed figure."""


def draw(picture: Albedos, data: Data) -> Figure:
    """A panel from normal to grazing incidence; beside it, where asked for, one against the cosine."""
    table = cast(pd.DataFrame, data[""])
    figure = Figure(figsize=(WIDTH, 5.9) if picture.to_grazing else (NARROW, 5.2))
    left, *right = figure.subplots(1, 2 if picture.to_grazing else 1, squeeze=False)[0]
    against_angle(left, picture, table)
    for axes in right:
        against_cosine(axes, picture, table)
    legend_above(figure, left, *right)
    return figure


def against_angle(axes: Axes, picture: Albedos, table: pd.DataFrame) -> None:
    """Albedo from normal incidence to 90 degrees, with the limits there as dots."""
    for name, own, style in styled(picture, table):
        axes.plot(own.theta_deg, own.albedo, label=name, **style)
    for i, curve in enumerate(picture.curves):
        if curve.label in picture.limits:
            color = line(i)["color"]
            axes.plot(90.0, picture.limits[curve.label], "o", color=color, markersize=7, clip_on=False, zorder=4)
    for name, albedo in picture.constants.items():
        axes.axhline(albedo, label=name, **REFERENCE)
    if picture.to_grazing or table.ci95_low.max() > 1.0:
        all_light(axes, picture)
    axes.set(xlabel="incident angle θ (degrees)", ylabel="albedo a(θ)", xlim=(0, 91), ylim=(0, ceiling(picture, table)))
    axes.set_xticks(range(0, 91, 15))
    axes.yaxis.set_major_locator(MaxNLocator(nbins=7, steps=[1, 2, 5, 10]))
    for _, own, style in styled(picture, table):
        error_band(axes, own.theta_deg, own.ci95_low, own.ci95_high, style["color"])


def all_light(axes: Axes, picture: Albedos) -> None:
    """A line at 1, above which energy is created, unless the picture has one of another name there."""
    if 1.0 not in picture.constants.values():
        axes.axhline(1.0, label="all light reflected", **REFERENCE)


def ceiling(picture: Albedos, table: pd.DataFrame) -> float:
    """The highest albedo shown: 1.1 unless all are far below it, or one is above before it shoots up."""
    known = table.albedo[np.isfinite(table.albedo)]
    if known.max() > MOST:
        known = known[table.theta_deg <= SHOOTING_FROM]
    largest = max([float(known.max()) if len(known) else 1.0, *picture.limits.values(), *picture.constants.values()])
    return 1.1 if DARK <= largest <= 1.05 or largest <= 0.0 else 1.08 * largest


def against_cosine(axes: Axes, picture: Albedos, table: pd.DataFrame) -> None:
    """Albedo towards grazing incidence: the cosine falls to the right. Above 1, energy is created."""
    for _, own, style in styled(picture, table):
        axes.plot(own.mu, own.albedo, **style)
    all_light(axes, picture)
    if picture.points:
        axes.plot(*zip(*picture.points, strict=True), zorder=5, label="printed in the paper", **CIRCLE)
    seen = table.albedo[np.isfinite(table.albedo) & (table.albedo > 0.0)]
    axes.set(xlabel="cosine of the incident angle, cos θ", ylabel="albedo a(θ)", xscale="log", yscale="log", xlim=(1, 1e-7))
    axes.set_ylim(0.7 * min(0.5, seen.min()), 1.4 * max(1.0, seen.max()))
    for axis in (axes.xaxis, axes.yaxis):
        logarithmic(axis)
    axes.xaxis.set_minor_locator(NullLocator())
    for _, own, style in styled(picture, table):
        error_band(axes, own.mu, own.ci95_low, own.ci95_high, style["color"])


def styled(picture: Albedos, table: pd.DataFrame) -> Iterator[tuple[str, pd.DataFrame, dict[str, Any]]]:
    """Every curve with its name and its line; of a model that is not reciprocal two, that for a light dashed."""
    for i, curve in enumerate(picture.curves):
        own = table[table.curve == curve.label]
        several = own.order.nunique() > 1
        for order, part in own.groupby("order", sort=False):
            name = f"{curve.label}, {OVER[str(order)]}" if several else curve.label
            yield name, part, line(i) | ({"linestyle": (0, (2, 1.2))} if several and order == "wo" else {})
