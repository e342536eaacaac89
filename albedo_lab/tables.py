"""Tables among a model's parameters: read-only arrays that hash by identity, so that answers about them can be kept."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray


class Table(np.ndarray[Any, np.dtype[np.float64]]):
    """A read-only array of doubles; two are equal when they are one and the same."""

    def __eq__(self, other: object) -> bool:
        return self is other

    def __ne__(self, other: object) -> bool:
        return self is not other

    def __hash__(self) -> int:  # type: ignore[override]
        return id(self)


def table(values: ArrayLike) -> Table:
    """The values as a table; a memory-mapped array stays mapped."""
    made = np.asarray(values, dtype=np.float64).view(Table)
    made.flags.writeable = False
    return made


def plain(value: Any) -> float | NDArray[np.float64]:
    """A parameter as a kernel takes it."""
    return value.view(np.ndarray) if isinstance(value, Table) else float(value)
