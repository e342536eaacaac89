"""Energy compensation from a table of albedos: the terms of Kulla and Conty and of Turquin, what they leave, what they cost.

A microfacet model loses the light that facets reflect more than once. Kulla and Conty add a lobe that returns what a table of the
albedo E says is lost [Revisiting Physically Based Shading at Imageworks, SIGGRAPH 2017 course]; Turquin scales the model itself
[Practical multiple scattering compensation for microfacet models, 2019]. Both take E for facets that reflect all light, F = 1.

With the exact E and its exact mean, what Kulla and Conty add to a white model makes the albedo 1 in every direction:
E_o + (1 - E_o) ∫ (1 - E_i) cos_i dw_i / (pi (1 - E_avg)) = E_o + (1 - E_o), since the integral is pi (1 - E_avg). So does
Turquin's factor 1 / E_o. With F < 1 what is left of 1 is light that the facets absorb, and neither is exact: Kulla and Conty take
every reflection after the first for one of the mean reflectance from a mean direction, Turquin all of them for one more of F0.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
import pandas as pd
from numpy.typing import ArrayLike

from albedo_lab.analysis.request import sequence
from albedo_lab.analysis.rows import Progress, track
from albedo_lab.errors import BadInput
from albedo_lab.lookup.axes import Axis, Floats
from albedo_lab.lookup.interpolation import interpolated, truth
from albedo_lab.lookup.request import refuse_values
from albedo_lab.lookup.source import F0 as FREE
from albedo_lab.lookup.source import MU, Source
from albedo_lab.lookup.table import Table, mean_beside, tabulated
from albedo_lab.optics import compensation as terms

COSINES = (1.0, 0.95, 0.9, 0.8, 0.7, 0.6, 0.5, 0.4, 0.3, 0.2, 0.1, 0.05, 0.02, 0.01, 1e-3)
COLOURS = (1.0, 0.5)
BETWEEN = np.arange(1, 17) / 16.0
"""Texture coordinates at which an axis of a parameter is tried: between the nodes of most tables."""
GAUSS_X, GAUSS_W = np.polynomial.legendre.leggauss(16)


def kulla_conty(E_i: ArrayLike, E_o: ArrayLike, E_avg: ArrayLike, F_avg: ArrayLike = 1.0) -> Floats:
    """f_ms = (1 - E_i) (1 - E_o) / (pi (1 - E_avg)) in 1/sr, times F_avg^2 E_avg / (1 - F_avg (1 - E_avg)) for coloured facets.

    E_i, E_o and E_avg are the albedos for F = 1 of light and viewer and their mean, F_avg the mean reflectance 2 ∫ F(mu) mu dmu
    (`terms.schlick_mean`); of any shapes that fit together. Where nothing is lost nothing is added: 0 for a numerator of 0.
    """
    E_i, E_o, E_avg, F_avg = (np.asarray(x, np.float64) for x in (E_i, E_o, E_avg, F_avg))
    return _lobe(E_o, 1.0 - E_i, E_avg, F_avg) / math.pi


def turquin(E_o: ArrayLike, F0: ArrayLike = 1.0) -> Floats:
    """The factor 1 + F0 (1 - E_o) / E_o of f, with the viewer's albedo for F = 1; infinite for an albedo of 0.

    It knows one of the two directions only: the product is not reciprocal.
    """
    E_o, F0 = np.asarray(E_o, np.float64), np.asarray(F0, np.float64)
    with np.errstate(divide="ignore"):
        found: Floats = terms.turquin(F0, 1.0 - E_o)
    return found


def compensation(
    table: Table,
    mean: Table | None = None,
    *,
    mu: float | Sequence[float] = COSINES,
    F0: float | Sequence[float] = COLOURS,
    values: Mapping[str, float | Sequence[float]] | None = None,
    progress: Progress | None = None,
) -> pd.DataFrame:
    """What is left of 1 after compensation from a table, direction by direction, and how far from reciprocal it is.

    Parameters
    ----------
    table
        Albedos, or 1 - E, of a reciprocal model whose facets reflect all light, over mu and parameters.
    mean
        Their means over the same parameters, as a renderer reads them; by default they are computed and tabulated beside.
    mu
        Cosines of the viewer, in (0, 1].
    F0
        Reflectances at normal incidence, in [0, 1]; 1 is white. Where the model has Schlick's reflectance they are its F0, and
        the mean reflectance is F0 + (1 - F0) / 21; where not, facets reflect F0 from every direction.
    values
        Values of the parameters, by name; by default sixteen along each axis, most of them between nodes.
    progress
        Called with the number of cells done and of all.

    Returns
    -------
    DataFrame
        One row per parameters, F0 and mu: model, parameters, F0, fresnel ("schlick" or "constant"), mu; E, the albedo for F = 1,
        its E_bound, and E_read from the table; residual_none, that is 1 - E_total without compensation; residual_kulla_conty and
        residual_turquin with what is read from the tables, and, with _exact, with E and E_avg themselves; residual_bound, how far
        any of them can be off. asymmetry_kulla_conty and asymmetry_turquin are the largest |f(wi, wo) - f(wo, wi)| over the mean
        of both, for a light at any of the cosines asked for: of f_ms, and of the compensated f, in which f itself cancels;
        asymmetry_turquin_mu is where that light stands.

    Raises
    ------
    BadInput
        For a table of anything else, and for values outside their domains.
    Inconclusive
        Where an albedo cannot be had.
    """
    asked = _Asked.of(table.source, table.axes, mu, F0, values)
    white = _inverted(table, "energy-loss", "albedo")
    names = [axis.name for axis in table.axes if axis.name != MU]
    means = _inverted(mean, "mean-energy-loss", "mean-albedo") if mean is not None else mean_beside(white, "mean")
    if means is not None and [axis.name for axis in means.axes] != names:
        raise BadInput("mean", [axis.name for axis in means.axes], "must be over the same parameters as the table")
    rows: list[dict[str, Any]] = []
    for cell in track(asked.cells, progress):
        surface = _Cell.of(white, means, dict(zip(names, cell, strict=True)), asked.cosines)
        for f0 in asked.colours:
            rows += surface.rows(f0, white.source)
    return pd.DataFrame(rows)


def compensation_of(
    source: Source,
    axes: Sequence[Axis],
    *,
    mu: float | Sequence[float] = COSINES,
    F0: float | Sequence[float] = COLOURS,
    values: Mapping[str, float | Sequence[float]] | None = None,
    progress: Progress | None = None,
) -> pd.DataFrame:
    """`compensation` from the table that a source fills over these axes, made once nothing of what is asked can be refused."""
    _Asked.of(source, axes, mu, F0, values)
    return compensation(tabulated("E", source, axes), mu=mu, F0=F0, values=values, progress=progress)


def largest_residuals(found: pd.DataFrame) -> pd.DataFrame:
    """Of what `compensation` gives, the residuals that are farthest from 0 over all directions: a row per parameters and F0.

    After what tells the row, each residual (signed) is followed by the cosine where it stands, then come the largest asymmetries.
    """
    told = list(found.columns[: found.columns.get_loc(MU)])
    rows = []
    for key, group in found.groupby(told, sort=False):
        row: dict[str, Any] = dict(zip(told, key, strict=True))
        for name in (name for name in found.columns if name.startswith("residual_") and name != "residual_bound"):
            worst = int(group[name].abs().argmax())
            row |= {name: group[name].iloc[worst], f"{name}_mu": group[MU].iloc[worst]}
        rows.append(row | {name: group[name].max() for name in ("asymmetry_kulla_conty", "asymmetry_turquin")})
    return pd.DataFrame(rows)


@dataclass(frozen=True, eq=False)
class _Asked:
    """For which cosines, reflectances and surfaces, one value a parameter along an axis, an answer is asked."""

    cosines: Floats
    colours: list[float]
    cells: list[tuple[float, ...]]

    @classmethod
    def of(cls, source: Source, axes: Sequence[Axis], mu: object, F0: object, values: Mapping[str, object] | None) -> _Asked:
        """What is asked of a table of the albedos of a reciprocal model for F = 1. Raises BadInput for any other."""
        if source.quantity not in ("albedo", "energy-loss"):
            raise BadInput("quantity", source.quantity, "must be albedo or energy-loss: compensation begins with these")
        member = source.member
        if not member.reciprocal:
            reason = "is not reciprocal; these terms take it that the albedo of light and viewer is one"
            raise BadInput("model", member.title, reason)
        if member.chosen.get("F", "one") != "one":
            raise BadInput("F", member.chosen["F"], "must be one: these terms take the albedo of facets that reflect all light")
        cosines = np.array(_numbers(MU, mu, lambda x: 0.0 < x <= 1.0, "must be in (0, 1]"))
        colours = _numbers("F0", F0, lambda x: 0.0 <= x <= 1.0, "must be in [0, 1]")
        axes = [axis for axis in axes if axis.name != MU]
        asked = values or {}
        if not set(asked) <= {axis.name for axis in axes}:
            raise BadInput("values", sorted(asked), f"must be of {', '.join(axis.name for axis in axes) or 'no parameter'}")
        several = []
        for axis in axes:
            given = sequence(axis.name, asked[axis.name]) if axis.name in asked else axis.values(BETWEEN).tolist()
            refuse_values(source, axis.name, given)
            several.append([float(x) for x in given])
        return cls(cosines, colours, list(itertools.product(*several)))


@dataclass(frozen=True, eq=False)
class _Cell:
    """The albedos of one surface for F = 1 at some cosines, and their means: the true ones, and those read from tables.

    `row_mean_read` is the mean over all directions of what is read; `mean_read`, which comes from a table of its own, may differ.
    """

    at: dict[str, float]
    mu: Floats
    E: Floats
    E_width: Floats
    E_read: Floats
    mean: float
    mean_width: float
    mean_read: float
    row_mean_read: float

    @classmethod
    def of(cls, table: Table, means: Table | None, at: dict[str, float], mu: Floats) -> _Cell:
        """The surface with these parameters."""
        seen = [truth(table.source, at | {MU: float(x)})[0] for x in mu]
        (mean,) = truth(replace(table.source, quantity="mean-albedo"), at)
        return cls(
            at,
            mu,
            np.array([e.value for e in seen]),
            np.array([e.half_width for e in seen]),
            interpolated(table, {**at, MU: mu})[:, 0],
            mean.value,
            mean.half_width,
            mean.value if means is None else float(interpolated(means, at)[0, 0]),
            row_mean(table, at),
        )

    def rows(self, F0: float, source: Source) -> list[dict[str, Any]]:
        """A row per cosine for facets of that reflectance."""
        schlick = _takes_schlick(source)
        F_avg = float(terms.schlick_mean(F0)) if schlick else F0
        once, width = F0 * self.E, F0 * self.E_width
        if schlick and F0 != 1.0:
            coloured = replace(source, fixed=(*(pair for pair in source.fixed if pair[0] != "F"), ("F", "schlick"), (FREE, F0)))
            seen = [truth(coloured, self.at | {MU: float(x)})[0] for x in self.mu]
            once, width = np.array([e.value for e in seen]), np.array([e.half_width for e in seen])
        with np.errstate(divide="ignore", invalid="ignore"):
            added = _lobe(self.E_read, 1.0 - self.row_mean_read, self.mean_read, F_avg)
            added_exact = _lobe(self.E, 1.0 - self.mean, self.mean, F_avg)
            factor, factor_exact = turquin(self.E_read, F0), turquin(self.E, F0)
            lobes = kulla_conty(self.E_read[:, None], self.E_read[None, :], self.mean_read, F_avg)
            by_lobe, by_factor = _asymmetry(lobes, lobes.T), _asymmetry(factor[:, None], factor[None, :])
            # by their first derivatives; that of the lobe by E_avg is that of F^2 E_avg / (1 - F (1 - E_avg))
            colour_slope = F_avg**2 * (1.0 - F_avg) / (1.0 - F_avg * (1.0 - self.mean)) ** 2
            off_by_lobe = width + self.E_width + colour_slope * self.mean_width * (1.0 - self.E)
            off_by_factor = width * np.maximum(factor, factor_exact) + once * F0 * self.E_width / self.E**2
        columns = {
            "mu": self.mu,
            "E": self.E,
            "E_bound": self.E_width,
            "E_read": self.E_read,
            "residual_none": 1.0 - once,
            "residual_kulla_conty": 1.0 - once - added,
            "residual_turquin": 1.0 - once * factor,
            "residual_kulla_conty_exact": 1.0 - once - added_exact,
            "residual_turquin_exact": 1.0 - once * factor_exact,
            "residual_bound": np.maximum(off_by_lobe, off_by_factor),
            "asymmetry_kulla_conty": by_lobe.max(axis=0),
            "asymmetry_turquin": by_factor.max(axis=0),
            "asymmetry_turquin_mu": self.mu[by_factor.argmax(axis=0)],
        }
        head = {"model": source.member.name, **self.at, "F0": F0, "fresnel": "schlick" if schlick else "constant"}
        return [head | {name: float(column[i]) for name, column in columns.items()} for i in range(len(self.mu))]


def row_mean(table: Table, at: Mapping[str, float]) -> float:
    """The mean 2 ∫ E mu dmu of what is read from a table of albedos at these parameters.

    Between nodes E is linear in t; ∫ E d(mu^2) is had by parts, with Gauss's rule for ∫ mu^2 dt, in which every mapping is
    smooth. Beyond the outermost nodes E is constant.
    """
    (axis,) = (axis for axis in table.axes if axis.name == MU)
    t = axis.coordinates
    w = np.square(axis.values(t))
    E = interpolated(table, {**at, MU: axis.nodes})[:, 0]
    step = np.diff(t)
    inner = t[:-1, None] + step[:, None] * (0.5 + 0.5 * GAUSS_X)
    integral = step * (np.square(axis.values(inner)) @ (0.5 * GAUSS_W))
    between = np.diff(E * w) - np.diff(E) / step * integral
    first, last = (0.0, 1.0) if w[0] < w[-1] else (1.0, 0.0)
    return math.fsum([*between, E[0] * (w[0] - first), E[-1] * (last - w[-1])]) * (1.0 if w[0] < w[-1] else -1.0)


def _lobe(E_o: ArrayLike, lost: ArrayLike, E_avg: ArrayLike, F_avg: ArrayLike) -> Floats:
    """(1 - E_o) lost / (1 - E_avg), coloured: pi f_ms for lost = 1 - E_i, its albedo for the mean of that."""
    E_o, lost, E_avg, F_avg = (np.asarray(x, np.float64) for x in (E_o, lost, E_avg, F_avg))
    product = (1.0 - E_o) * lost
    with np.errstate(divide="ignore", invalid="ignore"):
        returned = math.pi * terms.kulla_conty(lost, 1.0 - E_o, 1.0 - E_avg)
        found: Floats = np.where(product == 0.0, 0.0, terms.colour(F_avg, 1.0 - E_avg) * returned)
    return found


def _asymmetry(one: Floats, other: Floats) -> Floats:
    """|a - b| over the mean of both; 0 for two zeros."""
    found: Floats = np.where(one == other, 0.0, np.abs(one - other) / (0.5 * (one + other)))
    return found


def _inverted(table: Table, loss: str, share: str) -> Table:
    """A table of what is reflected, made of one of what is lost."""
    if table.source.quantity != loss:
        return table
    return replace(table, values=1.0 - table.values, source=replace(table.source, quantity=share))


def _takes_schlick(source: Source) -> bool:
    """Whether the model can have Schlick's reflectance."""
    return any(choice.name == "F" and "schlick" in getattr(choice, "options", ()) for choice in source.model.choices)


def _numbers(name: str, given: object, inside: Callable[[float], bool], domain: str) -> list[float]:
    """One or several numbers of a domain. Raises BadInput."""
    found = []
    for value in sequence(name, given):
        if isinstance(value, bool) or not isinstance(value, int | float | np.number) or not inside(float(value)):
            raise BadInput(name, value, domain)
        found.append(float(value))
    return found
