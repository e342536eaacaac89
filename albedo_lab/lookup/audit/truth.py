"""What a table should hold: exact cells, kept once computed, and surfaces through a few cells to look among many layouts."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from itertools import product

import numpy as np
from scipy.interpolate import CubicSpline

from albedo_lab.analysis.request import Effort
from albedo_lab.errors import BadInput, Inconclusive
from albedo_lab.lookup.audit.layouts import Run
from albedo_lab.lookup.audit.variants import Form, Variant
from albedo_lab.lookup.axes import MAPPINGS, Floats
from albedo_lab.lookup.source import F0, GAUSS_W, GAUSS_X, MU, Source

SMALLEST = 1e-4
"""Surfaces begin there instead of at 0, where limits would have to be taken."""
ALONG = {1: 25, 2: 25, 3: 13}
"""Nodes of a surface along each axis, by the number of a table's axes; 5 along F0, in which Schlick's reflectance is linear."""


@lru_cache(maxsize=1 << 18)
def cell(source: Source, names: tuple[str, ...], point: tuple[float, ...]) -> tuple[float, float]:
    """A figure and its half-width; both NaN where there is none: outside the model's domain, or where its limit is infinite."""
    if any(map(math.isnan, point)):
        return np.nan, np.nan
    try:
        found = source.at(dict(zip(names, point, strict=True)))[0]
    except (BadInput, Inconclusive):
        return np.nan, np.nan
    return found.value, found.half_width


@dataclass(frozen=True)
class Lab:
    """How precisely cells are computed, in which order of integration and at which azimuth (radians)."""

    want: Effort
    order: str = "wi"
    phi: float = 0.0

    def exact(self, variant: Variant, form: Form, names: Sequence[str], values: Sequence[Floats]) -> tuple[Floats, Floats] | None:
        """A form of a variant over the grid of the values of all variables, and its bounds: shape (*sizes, channels).

        None where the variant has no such form.
        """
        shape = tuple(len(v) for v in values)
        known: dict[str, Floats] = {}
        for field in form.fields:
            source = variant.source(field, self.want, self.order, self.phi)
            if source is None:
                return None
            cells = [cell(source, tuple(names), point) for point in product(*(tuple(map(float, v)) for v in values))]
            known[field] = np.array(cells).reshape(*shape, 2)
        return (
            np.stack([c + sum(k * known[field][..., 0] for field, k in factors) for _, c, factors in form.channels], axis=-1),
            np.stack([sum(abs(k) * known[field][..., 1] for field, k in factors) for _, _, factors in form.channels], axis=-1),
        )

    def surface(self, variant: Variant, field: str, runs: tuple[Run, ...]) -> Floats | None:
        """A field at the nodes of a surface over the runs; the median of all others where it has no value."""
        over = (Run(MU, 0.0, 1.0, ("x",)),) if field == "mean" else ()
        source = variant.source("white" if over else field, self.want, self.order, self.phi)
        if source is None:
            return None
        found = _surface(source, (*runs, *over), len(runs))
        return found @ mean_weights(over[0], len(runs)) if over else found


@lru_cache(maxsize=256)
def _surface(source: Source, runs: tuple[Run, ...], axes: int) -> Floats:
    names = tuple(run.name for run in runs)
    grids = [grid(run, axes) for run in runs]
    found = np.array([cell(source, names, point)[0] for point in product(*(tuple(map(float, g)) for g in grids))])
    finite = found[np.isfinite(found)]
    return np.where(np.isfinite(found), found, np.median(finite) if finite.size else 0.0).reshape([len(g) for g in grids])


def spread(run: Run) -> str:
    """The mapping in which a surface's nodes are evenly spread: the root of what ends at 0, for there albedos change quickly."""
    return run.mappings[0] if run.name == F0 or run.low > 0.0 else "sqrt(x)"


def grid(run: Run, axes: int) -> Floats:
    """The values of the variable at the nodes of a surface."""
    count = 5 if run.name == F0 else ALONG[axes]
    mapping = MAPPINGS[spread(run)]
    ends = mapping.forward(np.array([_start(run), run.high]))
    return mapping.inverse(np.linspace(float(ends[0]), float(ends[1]), count))


def weights(run: Run, axes: int, values: Floats) -> Floats:
    """The matrix that turns a field at the nodes of a surface into its spline at the values, shape (values, nodes)."""
    forward = MAPPINGS[spread(run)].forward
    at = forward(grid(run, axes))
    order = np.argsort(at)
    wanted = np.clip(forward(np.clip(values, _start(run), run.high)), at.min(), at.max())
    return np.asarray(CubicSpline(at[order], np.eye(len(at))[order])(wanted), dtype=np.float64)


def mean_weights(run: Run, axes: int) -> Floats:
    """The weights of 2 ∫ E mu dmu over the nodes of a surface along mu."""
    t = 0.5 + 0.5 * GAUSS_X
    mu = t * t
    return (4.0 * 0.5 * GAUSS_W * mu * t) @ weights(run, axes, mu)


def _start(run: Run) -> float:
    return max(run.low, SMALLEST) if run.name != F0 else run.low
