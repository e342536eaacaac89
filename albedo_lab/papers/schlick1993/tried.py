"""How the statements of this document are tried: a proposition with the figures that decide it."""

from __future__ import annotations

from collections.abc import Callable, Iterable

import numpy as np
from numpy.typing import NDArray

from albedo_lab.digits import with_error
from albedo_lab.estimate.record import Estimate

EQUATIONS = "the printed equations"
MANY = 10_000
CLOSE = 0.05
"""What counts as close where the document gives no number: §4 has global illumination done at 5 %."""


def told(e: Estimate) -> str:
    """An estimate for a cell, to about six digits."""
    return with_error(e, 1e-6)


def spread(f: NDArray[np.float64]) -> float:
    """The largest value over the smallest."""
    return float(np.max(f) / np.min(f))


def over(xs: Iterable[float], f: Callable[[float], float]) -> list[tuple[float, float]]:
    """Pairs of x and f(x), for `row`."""
    return [(x, f(x)) for x in xs]


def row(name: str, pairs: Iterable[tuple[float, float]], digits: int = 6) -> str:
    """A series for a cell: "a = 1.5, 0.2 for n = 1, 10"."""
    xs, ys = zip(*pairs, strict=True)
    return f"{', '.join(f'{y:.{digits}g}' for y in ys)} for {name} {', '.join(f'{x:g}' for x in xs)}"
