"""A question about a model, and the figure that answers it with its error."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Any

from albedo_lab.model import Model
from albedo_lab.tables import plain

NORMAL_975 = 1.959963984540054


@dataclass(frozen=True, slots=True)
class Question:
    """Which albedo of which model.

    `mu` and `phi` (radians) give the fixed direction; mu = None asks for the mean over all of them. `order` says which direction
    the integral runs over: "wi" (for a fixed viewer) or "wo" (for a fixed light, eq. 2 of neumann1999); for a reciprocal
    model both are the same. The answer is for the shape, without the constant `scale`.
    """

    model: Model
    p: Any
    mu: float | None
    phi: float = 0.0
    order: str = "wi"

    @property
    def values(self) -> tuple[Any, ...]:
        """The parameters as kernels take them."""
        return tuple(map(plain, self.p))


@dataclass(frozen=True, slots=True)
class Tolerance:
    """How wide half the 95 % interval may be: `absolute`, or `relative` times the figure where that is more."""

    absolute: float
    relative: float = 0.0

    def at(self, value: float) -> float:
        """The half-width allowed for a figure of that size."""
        return max(self.absolute, self.relative * abs(value))

    def over(self, scale: float) -> Tolerance:
        """The tolerance of a figure that is yet to be multiplied by scale."""
        return Tolerance(self.absolute / scale, self.relative)


@dataclass(frozen=True, slots=True)
class Estimate:
    """A figure with its standard error and 95 % interval.

    `samples` counts evaluations, `non_finite` the weights among them that were NaN or infinite (they are in the sum: a figure
    that holds any is not finite itself). For quadrature the interval is a bound, and the standard error that of a
    normal law with the same interval.
    """

    value: float
    standard_error: float
    low: float
    high: float
    samples: int
    method: str
    seed: int | None = None
    non_finite: int = 0

    @property
    def half_width(self) -> float:
        """Half the 95 % interval; the larger side where it is not symmetric."""
        return max(self.high - self.value, self.value - self.low)

    def reaches(self, tolerance: Tolerance) -> bool:
        """Whether the interval is as narrow as asked; never for a figure that is not finite."""
        return self.half_width <= tolerance.at(self.value)

    def scaled(self, scale: Estimate) -> Estimate:
        """This figure times a constant that is itself known with an error."""
        value = self.value * scale.value
        error = math.hypot(self.standard_error * scale.value, self.value * scale.standard_error)
        width = self.half_width * abs(scale.value) + abs(self.value) * scale.half_width
        return replace(self, value=value, standard_error=error, low=value - width, high=value + width)


def bounded(value: float, bound: float, samples: int, method: str) -> Estimate:
    """A figure known within a bound."""
    return Estimate(value, bound / NORMAL_975, value - bound, value + bound, samples, method)


def exact(value: float, method: str = "closed form") -> Estimate:
    """A figure without error."""
    return Estimate(value, 0.0, value, value, 0, method)
