"""Draws sections through the plane of incidence as half discs, with the light's direction."""

from __future__ import annotations

from typing import Any, cast

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from albedo_lab.pictures.base import Data
from albedo_lab.pictures.polar import Polar, summit
from albedo_lab.report.drawing import discs
from albedo_lab.report.drawing.discs import Radius, place
from albedo_lab.report.drawing.style import INK, NARROW, WIDTH, legend_above, line

RADIUS = {
    "brdf": "radius: BRDF in 1/sr",
    "radiance": "radius: radiance in 1/sr, under a light whose irradiance is 1 at normal incidence",
    "normalised": "radius: BRDF over its value with light and viewer in the normal",
}
ANGLE = "angle: the viewer's, from the normal, negative on the light's side"
BESIDE = 0.06
"""How far to the right of a spike its reflectance is written, clear of the arrow of a light at 0 degrees."""
ALIKE = 10.0
"""Panels share one scale unless their largest values differ by more than that factor."""


def draw(picture: Polar, data: Data) -> Figure:
    """A half disc for each light, or for each curve; an arrow shows where the light comes from."""
    table, mirrors = cast(pd.DataFrame, data[""]), cast(pd.DataFrame, data["mirrors"])
    labels = [curve.label for curve in picture.curves]
    by_light = picture.panels == "angle"
    column, other = ("light_deg", "curve") if by_light else ("curve", "light_deg")
    keys: list[Any] = list(picture.theta_deg) if by_light else labels
    names: list[Any] = labels if by_light else list(picture.theta_deg)
    figure, panels = _panels(len(keys))
    radii = scales(picture, [table[table[column] == key] for key in keys])
    for axes, key, radius in zip(panels, keys, radii, strict=True):
        own, flashes = table[table[column] == key], mirrors[mirrors[column] == key]
        lights = [key] if by_light else names
        discs.disc(axes, radius, half=True, taken=[*(-light for light in lights), *flashes.light_deg])
        axes.set_title(_light(key) if by_light else key, loc="center")
        for i, name in enumerate(names):
            section = own[own[other] == name]
            label = name if by_light else _light(name)
            discs.curve(axes, section.viewer_deg, radius.of(section.value), label=label, **line(i))
        for k, flash in enumerate(flashes.itertuples()):
            color = line(names.index(getattr(flash, other)))["color"]
            _spike(axes, float(flash.light_deg), float(flash.reflectance), color, k if by_light else 0)
        for i, light in enumerate(lights):
            discs.arrow(axes, -light, INK if by_light else line(i)["color"])
    legend_above(figure, panels[0])
    radius_of = RADIUS[picture.quantity] + (", logarithmic" if picture.log else "")
    figure.supxlabel(f"{radius_of}\n{ANGLE}", fontsize=13)
    return figure


def scales(picture: Polar, panels: list[pd.DataFrame]) -> list[Radius]:
    """The radius of every panel: the same for all where their largest values are alike."""
    tops = [
        max(
            summit(part.viewer_deg.to_numpy(), part.value.to_numpy(), float(part.light_deg.iloc[0]), picture.log)
            for part in parts
        )
        for parts in ([part for _, part in own.groupby(["curve", "light_deg"])] for own in panels)
    ]
    tops = [top or 1.0 for top in tops]
    if picture.log or (picture.alike and max(tops) <= ALIKE * min(tops)):
        tops = [max(tops)] * len(tops)
    return [Radius(top, picture.decades if picture.log else None) for top in tops]


def _panels(number: int) -> tuple[Figure, list[Axes]]:
    """As many axes, at most three in a row, four two by two."""
    columns = 2 if number == 4 else min(number, 3)
    rows = -(-number // columns)
    width = WIDTH if columns > 1 else NARROW
    figure = Figure(figsize=(width, rows * (discs.height(0.96 * width / columns, half=True) + 0.4) + 1.2))
    panels = figure.subplots(rows, columns, squeeze=False).ravel().tolist()
    for axes in panels[number:]:
        axes.remove()
    return figure, panels[:number]


def _light(theta_deg: float) -> str:
    return f"light at {theta_deg:g}°"


def _spike(axes: Axes, light_deg: float, reflectance: float, color: str, line_of_text: int) -> None:
    """A Dirac part: no length could show it, so its reflectance is written at it."""
    axes.plot(*place(light_deg, np.array([0.0, 1.0])), color=color, linewidth=1.4, marker="^", markevery=[1], markersize=7)
    x, y = place(light_deg, 1.06)
    axes.text(x + BESIDE, y + 0.02 - 0.1 * line_of_text, f"mirror {reflectance:.3g}", color=color, fontsize=discs.SMALL)
