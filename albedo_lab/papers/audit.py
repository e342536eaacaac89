"""What a document prints, where, and how each of its figures is recomputed: the vocabulary of this room."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from fractions import Fraction
from typing import Any

import numpy as np
import pandas as pd

from albedo_lab.analysis.albedo import albedo
from albedo_lab.analysis.colour import colour
from albedo_lab.analysis.mean_albedo import mean_albedo
from albedo_lab.analysis.normalise import normalise
from albedo_lab.estimate.record import NORMAL_975, Estimate, exact
from albedo_lab.papers.verdict import Printed, Verdict, judge

FINEST = 1e-8
NEAR_GRAZING = (1e-6, 1e-9)


@dataclass(frozen=True, slots=True)
class Means:
    """By which method, how precisely, from which seed and with how many threads a figure is recomputed."""

    tolerance: float
    method: str
    seed: int = 0
    threads: int | None = None

    @property
    def options(self) -> dict[str, Any]:
        """As the analyses take them."""
        return {"tolerance": self.tolerance, "method": self.method, "seed": self.seed, "threads": self.threads}


Recipe = Callable[[Means], Estimate]


@dataclass(frozen=True)
class Cell:
    """A printed figure: its quantity, its model and at which parameters (an angle among them); and how to recompute it.

    `again` recomputes it in other ways, for the reader who doubts the first; by default the same recipe by rqmc.
    """

    quantity: str
    model: str
    parameters: Mapping[str, float]
    printed: Printed
    recipe: Recipe
    again: Mapping[str, Recipe] = field(default_factory=dict)


@dataclass(frozen=True)
class Table:
    """Cells that stand together. `note` is Markdown: what a reader must know beyond the cells."""

    name: str
    title: str
    place: str
    cells: tuple[Cell, ...]
    note: str = ""


@dataclass(frozen=True, slots=True)
class Curve:
    """The directional albedo of a model, and its limit at 90 degrees; without a model, the constant `limit`."""

    label: str
    model: str = ""
    parameters: Mapping[str, Any] = field(default_factory=dict)
    limit: float | None = None


@dataclass(frozen=True)
class Plot:
    """Albedo curves against the incident angle; with `to_grazing` also against its cosine on a logarithmic axis.

    `points` are printed figures that lie on it: cells with an angle.
    """

    name: str
    title: str
    caption: str
    place: str
    curves: tuple[Curve, ...]
    points: tuple[Cell, ...] = ()
    to_grazing: bool = False


@dataclass(frozen=True)
class Spectra:
    """Albedo curves of several metals at several wavelengths (nm), and the colours that they make together.

    `parameters` are those of the model `metal`.
    """

    name: str
    title: str
    caption: str
    place: str
    metals: tuple[str, ...]
    wavelengths: tuple[float, ...]
    parameters: Mapping[str, float] = field(default_factory=dict)


@dataclass(frozen=True)
class Paper:
    """A document on trial. `note` is Markdown: what the trial found."""

    name: str
    citation: str
    note: str
    tables: tuple[Table, ...]
    plots: tuple[Plot, ...]
    spectra: tuple[Spectra, ...] = ()


@dataclass(frozen=True)
class Finding:
    """A cell with our figure, the same figure by other ways, and the verdict."""

    cell: Cell
    ours: Estimate
    again: Mapping[str, Estimate]
    verdict: Verdict


def examine(cells: Sequence[Cell], seed: int = 0, threads: int | None = None) -> Iterator[Finding]:
    """Recomputes cell after cell and judges it.

    The judge is quadrature, whose interval is a bound: of some eighty 95 % intervals four miss their value.
    """
    for cell in cells:
        unit = float(cell.printed.resolution)
        judged = Means(min(FINEST, unit / 1000.0), "quadrature", seed, threads)
        doubted = Means(unit / 100.0, "rqmc", seed, threads)
        ours = cell.recipe(judged)
        again = {way: recipe(judged) for way, recipe in cell.again.items()} or {"rqmc": cell.recipe(doubted)}
        yield Finding(cell, ours, again, judge(cell.printed, ours))


def trace(plot: Plot, threads: int | None = None) -> pd.DataFrame:
    """The points of a plot's curves, as columns curve, theta_deg, mu, albedo, ci95_low, ci95_high."""
    mu = np.concatenate([np.cos(np.radians(np.arange(0.0, 89.0, 0.5))), np.geomspace(math.cos(math.radians(89.0)), 1e-7, 121)])
    tables = []
    for curve in plot.curves:
        if curve.model:
            options = {**Means(1e-6, "quadrature", threads=threads).options, **curve.parameters}
            found = albedo(curve.model, mu=mu.tolist(), **options)
        else:
            constant = dict.fromkeys(("albedo", "ci95_low", "ci95_high"), curve.limit)
            found = pd.DataFrame({"theta_deg": np.degrees(np.arccos(mu))} | constant)
        tables.append(found.assign(curve=curve.label, mu=mu))
    return pd.concat(tables, ignore_index=True)[["curve", "theta_deg", "mu", "albedo", "ci95_low", "ci95_high"]]


def trace_spectra(spectra: Spectra, threads: int | None = None) -> tuple[pd.DataFrame, pd.DataFrame]:
    """The points of the albedo curves, and the colours along them, each with the table's own columns."""
    theta_deg = [*np.arange(0.0, 89.0, 2.0).tolist(), 89.0, 89.5, 89.9]
    asked: dict[str, Any] = {"metal": list(spectra.metals), **spectra.parameters, "theta_deg": theta_deg}
    means = Means(1e-6, "quadrature", threads=threads).options
    wavelengths = list(spectra.wavelengths)
    return albedo("metal", wavelength=wavelengths, **asked, **means), colour("metal", wavelength=wavelengths, **asked, **means)


def printed_points(plot: Plot) -> list[tuple[float, float]]:
    """The printed figures that lie on a plot: cosine and albedo."""
    return [(math.sin(math.radians(90.0 - c.parameters["theta_deg"])), float(c.printed.value)) for c in plot.points]


def figure(table: pd.DataFrame, quantity: str) -> Estimate:
    """The figure of a table's only row."""
    (row,) = table.to_dict("records")
    return Estimate(
        row[quantity],
        row["standard_error"],
        row["ci95_low"],
        row["ci95_high"],
        row["samples"],
        row["method"],
        row["seed"],
        row["non_finite"],
    )


def largest_constant_of(model: str, **parameters: Any) -> Recipe:
    """The constant under which the largest albedo is 1."""
    return lambda means: figure(normalise(model, **means.options, **parameters), "constant")


def mean_albedo_of(model: str, **parameters: Any) -> Recipe:
    """The mean albedo with the constant that the source prescribes."""
    return lambda means: figure(mean_albedo(model, **means.options, **parameters), "mean_albedo")


def albedo_of(model: str, theta_deg: float, **parameters: Any) -> Recipe:
    """The directional albedo with the constant that the source prescribes."""
    return lambda means: figure(albedo(model, theta_deg=theta_deg, **means.options, **parameters), "albedo")


def grazing_albedo_of(model: str, **parameters: Any) -> Recipe:
    """The limit of the albedo as mu -> 0: that at mu = 1e-9, widened by its distance from that at 1e-6.

    That distance is more than what remains beyond 1e-9 for every approach like mu^k with k >= 0.1.
    """

    def recipe(means: Means) -> Estimate:
        before, last = (figure(albedo(model, mu=mu, **means.options, **parameters), "albedo") for mu in NEAR_GRAZING)
        return widened(last, abs(last.value - before.value))

    return recipe


def limit(value: Fraction) -> Recipe:
    """A limit that is argued, not computed."""
    return lambda means: exact(float(value), "limit")


def widened(e: Estimate, by: float) -> Estimate:
    """The figure with an interval that is wider on both sides."""
    return replace(e, low=e.low - by, high=e.high + by, standard_error=e.standard_error + by / NORMAL_975)
