"""Albedo curves and colours as pictures: one style for all, without pyplot, the same bytes from the same data."""

from __future__ import annotations

import io
from collections.abc import Iterator, Sequence
from typing import Any

import matplotlib as mpl
import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.ticker import NullLocator

from albedo_lab.papers.audit import Curve, Plot, Spectra

OKABE_ITO = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9")
STYLE: Any = {
    "font.family": "DejaVu Sans",
    "font.size": 13,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.grid": True,
    "grid.color": "#dddddd",
    "axes.axisbelow": True,
    "lines.linewidth": 2.2,
    "lines.solid_capstyle": "round",
    "legend.framealpha": 1.0,
    "legend.edgecolor": "white",
    "legend.borderaxespad": 0.8,
    "savefig.dpi": 150,
    "figure.constrained_layout.use": True,
    "figure.constrained_layout.w_pad": 0.1,
    "figure.constrained_layout.h_pad": 0.1,
    "svg.hashsalt": "albedo-lab",
}
DASHED: dict[str, Any] = {"color": "black", "linestyle": (0, (5, 3)), "linewidth": 1.6}


def picture(plot: Plot, data: pd.DataFrame, printed: Sequence[tuple[float, float]] = ()) -> dict[str, bytes]:
    """The plot as svg and png. `printed` are the cosines and albedos of its points."""
    with mpl.rc_context(STYLE):
        figure = Figure(figsize=(11.5, 5.9) if plot.to_grazing else (8.0, 5.2))
        left, *right = figure.subplots(1, 2 if plot.to_grazing else 1, squeeze=False)[0]
        against_angle(left, plot, data)
        for axes in right:
            against_cosine(axes, plot, data, printed)
        if right:
            figure.legend(*left.get_legend_handles_labels(), loc="outside upper center", ncols=3)
        else:
            left.legend(loc="lower left")
        return {kind: _saved(figure, kind) for kind in ("svg", "png")}


def spectra_picture(spectra: Spectra, albedos: pd.DataFrame, colours: pd.DataFrame) -> dict[str, bytes]:
    """A panel for each metal as svg and png: a curve for each wavelength, under the colour that they make at every angle."""
    with mpl.rc_context(STYLE):
        figure = Figure(figsize=(11.5, 8.6))
        hues = mpl.colormaps["viridis"](np.linspace(0.0, 0.92, len(spectra.wavelengths)))
        panels = figure.subplots(2, 2, sharex=True, sharey=True).ravel()
        for axes, metal in zip(panels, spectra.metals, strict=True):
            own = albedos[albedos.metal == metal]
            for wavelength, hue in zip(spectra.wavelengths, hues, strict=True):
                points = own[own.wavelength == wavelength]
                axes.plot(points.theta_deg, points.albedo, color=hue, label=f"{wavelength:g} nm")
            band(axes, colours[colours.metal == metal])
            axes.set_title(metal, loc="left", fontweight="bold")
            axes.set(xlim=(0, 90), ylim=(0, 1.14))
            axes.set_xticks(range(0, 91, 15))
            axes.set_yticks([0.0, 0.2, 0.4, 0.6, 0.8, 1.0])
        for axes in panels[2:]:
            axes.set_xlabel("incident angle θ (degrees)")
        for axes in panels[::2]:
            axes.set_ylabel("albedo a(θ)")
        figure.legend(*panels[0].get_legend_handles_labels(), loc="outside right center", title="wavelength")
        return {kind: _saved(figure, kind) for kind in ("svg", "png")}


BAND = (1.05, 1.13)
"""Where a panel shows colours, above an albedo of 1."""


def band(axes: Axes, colours: pd.DataFrame) -> None:
    """The colour of the light reflected at each angle of incidence, half-way to the next."""
    theta = colours.theta_deg.to_numpy()
    borders = np.concatenate([[0.0], 0.5 * (theta[1:] + theta[:-1]), [90.0]])
    low, high = BAND
    axes.bar(borders[:-1], high - low, np.diff(borders), low, align="edge", color=colours.hex.tolist(), linewidth=0, zorder=3)
    axes.bar(0.0, high - low, 90.0, low, align="edge", fill=False, edgecolor="#999999", linewidth=0.8, zorder=4)


def against_angle(axes: Axes, plot: Plot, data: pd.DataFrame) -> None:
    """Albedo from normal incidence to 90 degrees, with the limits there as dots."""
    for curve, style in _styled(plot):
        points = data[data.curve == curve.label]
        axes.plot(points.theta_deg, points.albedo, label=curve.label, **style)
        if curve.model and curve.limit is not None:
            axes.plot(90.0, curve.limit, "o", color=style["color"], markersize=7, clip_on=False, zorder=4)
    axes.set(xlabel="incident angle θ (degrees)", ylabel="albedo a(θ)", xlim=(0, 91), ylim=(0, 1.1))
    axes.set_xticks(range(0, 91, 15))
    axes.set_yticks([0.0, 0.2, 0.4, 0.6, 0.8, 1.0])


def against_cosine(axes: Axes, plot: Plot, data: pd.DataFrame, printed: Sequence[tuple[float, float]]) -> None:
    """Albedo towards grazing incidence: the cosine falls to the right. Above 1, energy is created."""
    for curve, style in _styled(plot):
        points = data[data.curve == curve.label]
        axes.plot(points.mu, points.albedo, **style)
    axes.axhline(1.0, **DASHED, zorder=1.5)
    for mu, albedo in printed:
        axes.plot(
            mu,
            albedo,
            "o",
            markersize=9,
            markerfacecolor="white",
            markeredgecolor="black",
            markeredgewidth=1.6,
            zorder=5,
        )
    axes.set(xlabel="cosine of the incident angle, cos θ", ylabel="albedo a(θ)", xscale="log", yscale="log", xlim=(1, 1e-7))
    axes.xaxis.set_minor_locator(NullLocator())
    axes.yaxis.set_major_formatter("{x:g}")
    axes.legend(handles=_key(bool(printed)), loc="upper left")


def _styled(plot: Plot) -> Iterator[tuple[Curve, dict[str, Any]]]:
    """Every curve with its line: a colour for a model, dashes for a constant."""
    for i, curve in enumerate(plot.curves):
        yield curve, {"color": OKABE_ITO[i]} if curve.model else DASHED


def _key(points: bool) -> list[Line2D]:
    """What the lines and circles of the right panel mean, beyond its curves."""
    circle: dict[str, Any] = {
        "marker": "o",
        "markersize": 9,
        "markerfacecolor": "white",
        "markeredgecolor": "black",
        "linestyle": "",
    }
    energy = Line2D([], [], label="all light reflected", **DASHED)
    return [energy, Line2D([], [], label="printed in the paper", **circle)] if points else [energy]


def _saved(figure: Figure, kind: str) -> bytes:
    stream = io.BytesIO()
    figure.savefig(stream, format=kind, metadata={"svg": {"Date": None, "Creator": None}, "png": {"Software": None}}[kind])
    return stream.getvalue()
