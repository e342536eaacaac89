"""The constant that a model carries, and the largest that it may."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

from albedo_lab.analysis.supremum import supremum
from albedo_lab.errors import BadInput
from albedo_lab.estimate.record import NORMAL_975, Estimate, bounded, exact
from albedo_lab.model import Maximum, Model


def constant(model: Model, p: Any, given: float | None) -> Estimate:
    """The constant `scale` of a model: as given, as its source prescribes, or the largest that energy balance allows.

    Raises BadInput for a shape without light, of which no constant is the largest.
    """
    if given is not None:
        return exact(given)
    if isinstance(model.scale, Maximum):
        largest = largest_constant(supremum(model, p).value)
        if math.isinf(largest.value):
            raise BadInput("scale", largest.value, f"must be given: {model.title} reflects nothing, whatever its constant")
        return largest
    return exact(model.scale(p))


def largest_constant(largest_albedo: Estimate) -> Estimate:
    """The reciprocal of the largest albedo of the shape; 0 where that is unbounded, infinite where it is 0."""
    if math.isinf(largest_albedo.value):
        return bounded(0.0, 0.0, largest_albedo.samples, largest_albedo.method)
    if math.isnan(largest_albedo.value):
        return largest_albedo
    if largest_albedo.value <= 0.0:
        return exact(math.inf, largest_albedo.method)
    value = 1.0 / largest_albedo.value
    low = 1.0 / largest_albedo.high
    high = 1.0 / largest_albedo.low if largest_albedo.low > 0.0 else math.inf
    error = (high - low) / (2.0 * NORMAL_975)
    return replace(largest_albedo, value=value, standard_error=error, low=low, high=high)
