"""What is wrong with f and the density of a model at a crowd of direction pairs."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from albedo_lab.analysis import crowd
from albedo_lab.estimate.record import Question
from albedo_lab.kernels.search import GIVEN, sample_kernel, value_kernel
from albedo_lab.model import Model

NON_FINITE, NEGATIVE, BAD_DENSITY = range(3)
CHUNK = 1 << 17


def unsound(model: Model, p: Any, count: int) -> NDArray[np.float64]:
    """How many of so many pairs give an f that is not finite, a negative f, a density that is neither finite nor positive."""
    tally, rng, values = np.zeros(3), np.random.default_rng(7), Question(model, p, None).values
    for first in range(0, count, CHUNK):
        pairs = crowd.scattered(min(CHUNK, count - first), rng)
        f, density = np.empty((2, len(pairs)))
        value_kernel(model)(values, pairs.wi, pairs.wo, f)
        sample_kernel(model)(values, np.full((len(pairs), 2), GIVEN), pairs.wi, pairs.wo, density)
        tally[NON_FINITE] += np.sum(~np.isfinite(f))
        tally[NEGATIVE] += np.sum(f < 0.0)
        tally[BAD_DENSITY] += np.sum(~((density >= 0.0) & (density < np.inf)))
    return tally
