"""How far a table is from the truth, cell by cell, as an audit found it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from albedo_lab.lookup.axes import Axis, Floats
from albedo_lab.pictures.base import Data


@dataclass(frozen=True, eq=False)
class Deviations:
    """A table and its truth over one to three axes, both of shape (*sizes, channels), NaN where the truth is not known.

    `forgiven` is what storage may have changed and what a cell may be off: deviations up to it are drawn as none. `shown`, of
    three axes, is the number of the slices of the first one that stand side by side.
    """

    title: str
    axes: tuple[Axis, ...]
    channels: tuple[str, ...]
    table: Floats
    truth: Floats
    forgiven: float
    shown: int = 4

    def trace(self, threads: int | None = None) -> Data:
        """The signed deviation, table minus truth, and both of them, in the table's shape."""
        deviation = np.where(np.isfinite(self.table), self.table, np.nan) - self.truth
        return {"deviation": deviation, "table": self.table, "truth": self.truth}
