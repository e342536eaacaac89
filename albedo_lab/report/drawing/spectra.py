"""Draws albedo curves of metals at several wavelengths, under the colours that they make together."""

from __future__ import annotations

import math
from typing import cast

import matplotlib as mpl
import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from albedo_lab.pictures.base import Data
from albedo_lab.pictures.spectra import Spectra
from albedo_lab.report.drawing.style import GRID, WIDTH, legend_above

BAND = (1.05, 1.13)
"""Where a panel shows colours, above an albedo of 1."""


def draw(picture: Spectra, data: Data) -> Figure:
    """A panel for each metal, two in a row."""
    albedos, colours = cast(pd.DataFrame, data[""]), cast(pd.DataFrame, data["colours"])
    rows = -(-len(picture.metals) // 2)
    figure = Figure(figsize=(WIDTH, 4.3 * rows))
    hues = mpl.colormaps["viridis"](np.linspace(0.33, 0.86, len(picture.wavelengths)))
    lowest = 0.2 * math.floor(min(1.0, float(albedos.albedo.min())) / 0.2)
    panels = figure.subplots(rows, 2, sharex=True, sharey=True, squeeze=False)
    for axes, metal in zip(panels.ravel(), picture.metals, strict=False):
        own = albedos[albedos.metal == metal]
        for wavelength, hue in zip(picture.wavelengths, hues, strict=True):
            points = own[own.wavelength == wavelength]
            axes.plot(points.theta_deg, points.albedo, color=hue, label=f"{wavelength:g} nm")
        band(axes, colours[colours.metal == metal])
        axes.set_title(metal)
        axes.set(xlim=(0, 90), ylim=(lowest, 1.14))
        axes.set_xticks(range(0, 91, 15))
        axes.set_yticks(np.arange(lowest, 1.01, 0.2))
    for axes in panels.ravel()[len(picture.metals) - 2 : len(picture.metals)]:
        axes.set_xlabel("incident angle θ (degrees)")
        axes.tick_params(labelbottom=True)
    for axes in panels[:, 0]:
        axes.set_ylabel("albedo a(θ)")
    for axes in panels.ravel()[len(picture.metals) :]:
        axes.remove()
    legend_above(figure, panels[0, 0])
    return figure


def band(axes: Axes, colours: pd.DataFrame) -> None:
    """The colour of the light reflected at each angle of incidence, from half-way after the last to half-way to the next.

    Each is drawn up to the end, under the next: between bars that only touch, the ground would shine through.
    """
    theta = colours.theta_deg.to_numpy()
    starts = np.concatenate([[0.0], 0.5 * (theta[1:] + theta[:-1])])
    low, high = BAND
    axes.bar(starts, high - low, 90.0 - starts, low, align="edge", color=colours.hex.tolist(), linewidth=0, zorder=3)
    axes.bar(0.0, high - low, 90.0, low, align="edge", fill=False, edgecolor=GRID, linewidth=0.8, zorder=4)
