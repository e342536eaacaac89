"""How small a table may be: which mappings and how many nodes keep the error of interpolation under a bound."""

from __future__ import annotations

import itertools
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np
import pandas as pd

from albedo_lab.analysis.rows import Progress
from albedo_lab.errors import BadInput
from albedo_lab.lookup.axes import MAPPINGS, Axis
from albedo_lab.lookup.interpolation import (
    FEWEST,
    MOST,
    Interpolation,
    default_points,
    enough,
    interpolation_error,
    neighbours,
    truth,
)
from albedo_lab.lookup.request import refuse_nodes
from albedo_lab.lookup.source import MU, Source
from albedo_lab.lookup.table import tabulated

SIZES = (8, 12, 16, 24, 32, 48, 64, 96, 128)
OF_MU = ("x", "sqrt(x)", "sqrt(1-x)", "acos(x)")
OF_PARAMETERS = ("x", "sqrt(x)", "sqrt(sqrt(x))", "log(x)")
"""What is tried unless one says; a mapping that is infinite at an end of its axis is left out."""
NORMS = ("largest", "rms")
MOST_CELLS = 1 << 15
"""Larger tables are not tried: 128 x 128, or 32 x 32 x 32, are within."""
SCREENING = 1 << 10
"""Places at which a table is measured while others may turn out better; the advice itself rests on as many as any table."""
FASTEST = 3.0
"""A size is skipped where even an error that falls with that power of the nodes, one above interpolation's, is too large."""
WITNESSES = 16
"""Places where tables failed that others are tried at first."""
SHRUNK = 3
"""Of the mappings that keep the bound with equal sizes, so many of the best are tried with unequal ones."""
Layout = tuple[Axis, ...]


def advise(
    source: Source,
    axes: Sequence[Axis],
    bound: float,
    *,
    norm: str = "largest",
    sizes: Sequence[int] = SIZES,
    mappings: Mapping[str, Sequence[str]] | None = None,
    points: int | None = None,
    seed: int = 0,
    progress: Progress | None = None,
) -> pd.DataFrame:
    """The smallest table, of those tried, whose multilinear interpolation errs by no more than a bound.

    Equal sizes of all axes come first, ascending, under every mapping, until one keeps the bound; then one axis after the other
    is shrunk as far as the bound allows. What is advised was measured like any finished table. Another may be smaller still:
    sizes between those listed, and long and narrow tables.

    Parameters
    ----------
    source
        What the table is to hold.
    axes
        One to three: their variables, ends and sampling count, their mappings and sizes do not.
    bound
        The error allowed, absolute.
    norm
        "largest" or "rms": which error has to keep the bound. It has to do so with its own uncertainty added: the bounds of the
        cells and of the truth, or two standard errors.
    sizes
        How many nodes an axis may have, ascending.
    mappings
        Those to try by variable, with x for it, as in `axes.MAPPINGS`; by default some that are usual.
    points, seed
        As in `interpolation_error`, for the table advised.
    progress
        Called with the number of tables tried and the most there may be.

    Returns
    -------
    DataFrame
        One row per table tried: axes (as the command line takes them), mapping and nodes of each, cells, largest, largest_bound,
        rms, rms_error, points, within, advised. The first row is the one advised, and only there `advised` is true; where no
        table keeps the bound there is none, and the first row is that with the smallest error. That is not an error: "none of
        these" is an answer, and its rows say why. Near a corner such as alpha = 0, mu = 0 of GGX no size helps. Of a table that
        misses the bound at a place where another did worst, `largest` is the error there, at one point, and no RMS is known.

    Raises
    ------
    BadInput
        For an option outside its domain, for a bound that the tolerance of the cells leaves no room for, and where every table
        has a node at which there is no value (one that has is left out otherwise).
    Inconclusive
        Where a cell or the truth between cannot be had.
    """
    axes = tuple(axes)
    source = source.checked(tuple(axis.name for axis in axes))
    tolerance = source.want.tolerance.absolute
    if not 2.0 * tolerance < bound < math.inf:
        raise BadInput("bound", bound, f"must be finite, and more than twice the cells' tolerance, which is {tolerance:g}")
    if norm not in NORMS:
        raise BadInput("norm", norm, f"must be one of {', '.join(NORMS)}")
    if not (points is None or enough(points)):
        raise BadInput("points", points, f"must be an integer from {FEWEST} to {MOST}")
    usable = _usable(sizes, len(axes))
    ways = list(itertools.product(*(_mapped(axis, mappings) for axis in axes)))
    trial = _Trial(source, bound, norm, seed, progress, len(ways) * len(usable))
    for layout in _equal(trial, ways, usable)[:SHRUNK]:
        for first in range(len(axes)):
            _shrink(trial, layout, [*range(first, len(axes)), *range(first)], usable)
    if not trial.found:
        raise next(iter(trial.refused.values()))
    advised = trial.confirmed(points)
    rows = sorted(trial.found, key=lambda layout: (layout != advised, *trial.rank(layout)))
    if progress is not None:
        progress(trial.most, trial.most)
    return pd.DataFrame([trial.row(layout) | {"advised": layout == advised} for layout in rows])


@dataclass
class _Trial:
    """The tables tried, each measured once or, if it is to be advised, once more at more places.

    One with a node at which the source has no value is refused: the smallest alpha of a fine mapping may be below all but 0.
    """

    source: Source
    bound: float
    norm: str
    seed: int
    progress: Progress | None
    most: int
    found: dict[Layout, Interpolation] = field(default_factory=dict)
    refused: dict[Layout, BadInput] = field(default_factory=dict)
    witnesses: list[dict[str, float]] = field(default_factory=list)

    def error(self, layout: Layout) -> float:
        """The error that counts, its own uncertainty added."""
        if layout not in self.found and layout not in self.refused:
            try:
                if not self._fails_like_others(layout):
                    self.measure(layout, SCREENING)
            except BadInput as wrong:
                self.refused[layout] = wrong
        if layout in self.refused:
            return math.inf
        seen = self.found[layout]
        if math.isnan(seen.rms):
            return seen.largest
        return seen.largest + seen.largest_bound if self.norm == "largest" else seen.rms + 2.0 * seen.rms_error

    def measure(self, layout: Layout, points: int | None) -> None:
        """Fills a table and looks between its nodes."""
        refuse_nodes(self.source, layout)
        table = tabulated("tried", self.source, layout)
        if points is not None:
            points = min(points, default_points(self.source, len(layout)))
        self.found[layout] = seen = interpolation_error(table, points, self.seed)
        if self.bound < seen.largest < math.inf and len(self.witnesses) < WITNESSES:
            self.witnesses.append(seen.largest_at)
        if self.progress is not None:
            self.progress(min(len(self.found), self.most), self.most)

    def _fails_like_others(self, layout: Layout) -> bool:
        """Whether a table misses the bound where another did worst, which takes no more than the nodes around to tell.

        The error there stands for its largest, and no RMS.
        """
        if self.norm != "largest":
            return False
        for at in reversed(self.witnesses):
            index = np.stack([axis.index(np.array([at[axis.name]])) for axis in layout], axis=-1)
            read = np.zeros(len(self.source.channels))
            for nodes, weight in neighbours(layout, index):
                node = {axis.name: float(axis.nodes[i]) for axis, i in zip(layout, nodes[0], strict=True)}
                read += weight[0] * np.array([e.value for e in self.source.at(node)])
            right = truth(self.source, at)
            error = float(np.max(np.abs(read - [e.value for e in right])))
            bound = max(e.half_width for e in right) + self.source.want.tolerance.absolute
            if error > self.bound + bound:
                self.found[layout] = Interpolation(error, at, bound, math.nan, math.nan, 1, {})
                return True
        return False

    def within(self, layout: Layout) -> bool:
        """Whether a table keeps the bound."""
        return self.error(layout) <= self.bound

    def rank(self, layout: Layout) -> tuple[float, ...]:
        """What keeps the bound comes first, by its cells; then what misses it, by its error; last what was tried at one point."""
        error = self.error(layout)
        if error <= self.bound:
            return 0.0, math.prod(axis.size for axis in layout), error
        return 1.0, float(math.isnan(self.found[layout].rms)), error

    def confirmed(self, points: int | None) -> Layout | None:
        """The smallest table that keeps the bound when measured at as many places as one that is finished."""
        for layout in sorted(self.found, key=self.rank):
            if self.within(layout):
                self.measure(layout, points)
                if self.within(layout):
                    return layout
        return None

    def row(self, layout: Layout) -> dict[str, Any]:
        """A line of the answer."""
        seen = self.found[layout]
        return {
            "axes": " ".join(f"{axis.label}={axis.size}@{_shortest(axis.first)}:{_shortest(axis.last)}" for axis in layout),
            **{f"{axis.name}_mapping": axis.label for axis in layout},
            **{f"{axis.name}_nodes": axis.size for axis in layout},
            "cells": math.prod(axis.size for axis in layout),
            "largest": seen.largest,
            "largest_bound": seen.largest_bound,
            **{f"{name}_of_largest": value for name, value in seen.largest_at.items()},
            "rms": seen.rms,
            "rms_error": seen.rms_error,
            "points": seen.points,
            "within": self.within(layout),
        }


def _equal(trial: _Trial, ways: Sequence[Layout], sizes: Sequence[int]) -> list[Layout]:
    """The tables of the smallest equal size at which any keeps the bound, best first; none where no size does."""
    last: dict[Layout, tuple[int, float]] = {}
    for size in sizes:
        kept = []
        for way in ways:
            before, error = last.get(way, (size, 0.0))
            if size < sizes[-1] and error * (before / size) ** FASTEST > trial.bound:
                continue
            layout = _sized(way, [size] * len(way))
            last[way] = size, trial.error(layout)
            if trial.within(layout):
                kept.append(layout)
        if kept:
            return sorted(kept, key=trial.error)
    return []


def _shrink(trial: _Trial, layout: Layout, order: Sequence[int], sizes: Sequence[int]) -> None:
    """Tries smaller sizes of one axis after the other, as far as the bound allows, by halving what is left to try."""
    counts = [axis.size for axis in layout]
    for i in order:
        low, high = 0, sizes.index(counts[i])
        while low < high:
            middle = (low + high) // 2
            tried = _sized(layout, [*counts[:i], sizes[middle], *counts[i + 1 :]])
            low, high = (low, middle) if trial.within(tried) else (middle + 1, high)
        counts[i] = sizes[high]


def _sized(layout: Layout, counts: Sequence[int]) -> Layout:
    """The same axes with so many nodes."""
    return tuple(replace(axis, size=count) for axis, count in zip(layout, counts, strict=True))


def _shortest(x: float) -> str:
    """The shortest text that reads back to the same number.

    >>> _shortest(0.1), _shortest(1.0)
    ('0.1', '1')
    """
    return repr(float(x)).removesuffix(".0")


def _usable(sizes: Sequence[int], axes: int) -> list[int]:
    """The sizes whose equal tables are not too large. Raises BadInput."""
    found = sorted({int(size) for size in sizes if isinstance(size, int | np.integer) and size >= 2})
    usable = [size for size in found if size**axes <= MOST_CELLS]
    if len(found) < len(set(sizes)) or not usable:
        raise BadInput("sizes", list(sizes), f"must be integers of at least 2, one of them with no more than {MOST_CELLS} cells")
    return usable


def _mapped(axis: Axis, mappings: Mapping[str, Sequence[str]] | None) -> list[Axis]:
    """An axis under every mapping to try. Raises BadInput for one that is unknown or infinite at an end."""
    if mappings is not None and axis.name in mappings:
        for mapping in mappings[axis.name]:
            if mapping not in MAPPINGS:
                raise BadInput("mapping", mapping, f"must be one of {', '.join(MAPPINGS)}")
        return [replace(axis, mapping=mapping).checked(mapping) for mapping in mappings[axis.name]]
    ends = np.array([axis.first, axis.last])
    with np.errstate(invalid="ignore", divide="ignore"):
        usual = [
            name for name in (OF_MU if axis.name == MU else OF_PARAMETERS) if np.all(np.isfinite(MAPPINGS[name].forward(ends)))
        ]
    return [replace(axis, mapping=mapping) for mapping in usual]
