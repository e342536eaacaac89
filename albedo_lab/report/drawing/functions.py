"""Draws functions of one variable: in a plain panel, or about the vertical in polar coordinates."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Any, cast

import numpy as np
import pandas as pd
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from albedo_lab.pictures.base import Data
from albedo_lab.pictures.functions import Function, Functions
from albedo_lab.report.drawing import discs
from albedo_lab.report.drawing.discs import Radius
from albedo_lab.report.drawing.style import NARROW, REFERENCE, legend_above, line, logarithmic

MOST_DECADES = 6.0
ANGLES: dict[str, Any] = {"nbins": 7, "steps": [1, 1.5, 3, 10]}
"""Where an axis in degrees has numbers: at 15, 30, 45 and so on, or at 30, 60, 90."""


def draw(picture: Functions, data: Data) -> Figure:
    """One panel, with a legend."""
    table = cast(pd.DataFrame, data[""])
    if picture.polar:
        return about_the_vertical(picture, table)
    figure = Figure(figsize=(NARROW, 5.4))
    axes = figure.subplots()
    for function, style in styled(picture):
        own = table[table.function == function.label]
        axes.plot(own.x, own.value, label=function.label, **style)
    axes.set(xlabel=picture.x_label, ylabel=picture.y_label, xlim=picture.x)
    axes.set(xscale="log" if picture.log_x else "linear", yscale="log" if picture.log_y else "linear")
    if picture.y is not None:
        axes.set_ylim(picture.y)
    elif not picture.log_y and table.value.min() >= 0.0:
        axes.set_ylim(bottom=0.0)
    for axis in (axes.xaxis, axes.yaxis):
        if axis.get_scale() == "log":
            logarithmic(axis)
    if "degrees" in picture.x_label and not picture.log_x:
        axes.xaxis.set_major_locator(MaxNLocator(**ANGLES))
    legend_above(figure, axes, together=2 if in_pairs(picture) else 1)
    return figure


def about_the_vertical(picture: Functions, table: pd.DataFrame) -> Figure:
    """A half disc where no angle is beyond 90 degrees, else a whole one."""
    half = max(map(abs, picture.x)) <= 0.5 * math.pi + 1e-9
    figure = Figure(figsize=(NARROW, discs.height(0.93 * NARROW, half) + 0.9))
    axes = figure.subplots()
    known = table.value[np.isfinite(table.value) & (table.value > 0.0)]
    low, top = picture.y or (known.min(), known.max())
    decades = min(max(math.log10(top / low), 1.0), MOST_DECADES)
    radius = Radius(top, decades if picture.log_radius else None)
    discs.disc(axes, radius, half)
    for function, style in styled(picture):
        own = table[table.function == function.label]
        x, r = np.degrees(own.x.to_numpy()), radius.of(own.value)
        if picture.symmetric:
            x, r = np.concatenate([-x[::-1], x]), np.concatenate([r[::-1], r])
        discs.curve(axes, x, r, label=function.label, **style)
    kind = ", logarithmic" if picture.log_radius else ""
    figure.supxlabel(f"radius: {picture.y_label}{kind}; angle: {picture.x_label}", fontsize=13)
    legend_above(figure, axes)
    return figure


def in_pairs(picture: Functions) -> bool:
    """Whether every function is followed by what it stands for."""
    kinds = [function.reference for function in picture.functions]
    return kinds == [False, True] * (len(kinds) // 2)


def styled(picture: Functions) -> Iterator[tuple[Function, dict[str, Any]]]:
    """Every function with its line: references are dashed; where there are several, in the colours of what approximates them."""
    references = [f for f in picture.functions if f.reference]
    others = [f for f in picture.functions if not f.reference]
    for function in picture.functions:
        if not function.reference:
            yield function, line(others.index(function))
        elif len(references) == 1:
            yield function, REFERENCE
        else:
            yield function, REFERENCE | {"color": line(references.index(function))["color"]}
