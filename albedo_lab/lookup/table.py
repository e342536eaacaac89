"""A table: the values of a quantity at the nodes of its axes, every cell with its error."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import product

import numpy as np

from albedo_lab.analysis.rows import Progress, track
from albedo_lab.lookup.axes import Axis, Floats
from albedo_lab.lookup.source import MU, QUANTITIES, Source


@dataclass(frozen=True, eq=False)
class Table:
    """A quantity at the nodes of one to three axes, the first of which varies slowest.

    values, half_widths
        Shape (*sizes, channels): every figure, and half of its 95 % interval (a bound, for quadrature).
    standard_errors
        The same shape.
    samples
        How many evaluations the whole table took.
    """

    name: str
    source: Source
    axes: tuple[Axis, ...]
    values: Floats
    half_widths: Floats
    standard_errors: Floats
    samples: int

    @property
    def sizes(self) -> tuple[int, ...]:
        """How many nodes each axis has."""
        return tuple(axis.size for axis in self.axes)

    @property
    def stored(self) -> Floats:
        """The values as a file holds them: without the last axis where there is one channel only."""
        return self.values[..., 0] if self.values.shape[-1] == 1 else self.values


def tabulated(name: str, source: Source, axes: Sequence[Axis], progress: Progress | None = None) -> Table:
    """The table of a source over all nodes of its axes.

    `progress` is called with the number of cells done and of all. Raises BadInput for a node outside the domain of what runs
    along its axis, and where a limit is infinite; Inconclusive where the tolerance is out of reach.
    """
    axes = tuple(axes)
    source = source.checked(tuple(axis.name for axis in axes))
    cells = list(product(*(axis.nodes for axis in axes)))
    shape = (*(axis.size for axis in axes), len(source.channels))
    found = [source.at(dict(zip((axis.name for axis in axes), map(float, cell), strict=True))) for cell in track(cells, progress)]
    values, widths, errors = (
        np.array([[getattr(e, what) for e in figures] for figures in found]).reshape(shape)
        for what in ("value", "half_width", "standard_error")
    )
    return Table(name, source, axes, values, widths, errors, sum(e.samples for figures in found for e in figures))


def mean_beside(table: Table, name: str, progress: Progress | None = None) -> Table | None:
    """The mean of a table of albedos or losses over the axes that are parameters; None where there are none, or no mean."""
    axes = [axis for axis in table.axes if axis.name != MU]
    mean = QUANTITIES[table.source.quantity].mean
    return tabulated(name, replace(table.source, quantity=mean), axes, progress) if mean and axes else None
