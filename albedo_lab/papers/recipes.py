"""How a printed figure is recomputed: recipes, each from the means to an estimate."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import Any

import pandas as pd

from albedo_lab.analysis.albedo import albedo
from albedo_lab.analysis.mean_albedo import mean_albedo
from albedo_lab.analysis.normalise import normalise
from albedo_lab.estimate.record import NORMAL_975, Estimate, exact

NEAR_GRAZING = (1e-6, 1e-9)


@dataclass(frozen=True, slots=True)
class Means:
    """By which method, how precisely, from which seed and with how many threads a figure is recomputed."""

    tolerance: float
    method: str
    seed: int = 0
    threads: int | None = None

    @property
    def options(self) -> dict[str, Any]:
        """As the analyses take them."""
        return {"tolerance": self.tolerance, "method": self.method, "seed": self.seed, "threads": self.threads}


Recipe = Callable[[Means], Estimate]


def figure(table: pd.DataFrame, quantity: str) -> Estimate:
    """The figure of a table's only row."""
    (row,) = table.to_dict("records")
    return Estimate(
        row[quantity],
        row["standard_error"],
        row["ci95_low"],
        row["ci95_high"],
        row["samples"],
        row["method"],
        row["seed"],
        row["non_finite"],
    )


def largest_constant_of(model: str, **parameters: Any) -> Recipe:
    """The constant under which the largest albedo is 1."""
    return lambda means: figure(normalise(model, **means.options, **parameters), "constant")


def mean_albedo_of(model: str, **parameters: Any) -> Recipe:
    """The mean albedo with the constant that the source prescribes."""
    return lambda means: figure(mean_albedo(model, **means.options, **parameters), "mean_albedo")


def albedo_of(model: str, theta_deg: float, **parameters: Any) -> Recipe:
    """The directional albedo with the constant that the source prescribes."""
    return lambda means: figure(albedo(model, theta_deg=theta_deg, **means.options, **parameters), "albedo")


def grazing_albedo_of(model: str, **parameters: Any) -> Recipe:
    """The limit of the albedo as mu -> 0: that at mu = 1e-9, widened by its distance from that at 1e-6.

    That distance is more than what remains beyond 1e-9 for every approach like mu^k with k >= 0.1.
    """

    def recipe(means: Means) -> Estimate:
        before, last = (figure(albedo(model, mu=mu, **means.options, **parameters), "albedo") for mu in NEAR_GRAZING)
        return widened(last, abs(last.value - before.value))

    return recipe


def limit(value: Fraction) -> Recipe:
    """A limit that is argued, not computed."""
    return lambda means: exact(float(value), "limit")


def widened(e: Estimate, by: float) -> Estimate:
    """The figure with an interval that is wider on both sides."""
    return replace(e, low=e.low - by, high=e.high + by, standard_error=e.standard_error + by / NORMAL_975)
