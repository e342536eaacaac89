"""What every sampling contender returns, so that one can see that all of them answer the same question."""

from __future__ import annotations

import math
from typing import NamedTuple


class Moments(NamedTuple):
    """Number, sum and sum of squares of sample weights."""

    samples: int
    total: float
    squares: float

    @property
    def mean(self) -> float:
        return self.total / self.samples

    @property
    def deviation(self) -> float:
        """Standard deviation of one sample weight."""
        return math.sqrt(max(0.0, self.squares / self.samples - self.mean**2))

    @property
    def standard_error(self) -> float:
        return self.deviation / math.sqrt(self.samples)
