"""What all analyses share: parameter grids, checked options, the constant of a model, and rows of a table."""

from __future__ import annotations

import itertools
import math
import os
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from albedo_lab.analysis.supremum import supremum
from albedo_lab.catalogue import find
from albedo_lab.errors import BadInput, Inconclusive
from albedo_lab.estimate.methods import METHODS
from albedo_lab.estimate.record import NORMAL_975, Estimate, Tolerance, exact
from albedo_lab.model import Maximum, Model, Parameter

SCALE = Parameter("scale", "constant of the printed equation", default=math.nan, low=0.0, high=1e300)
DEFAULT_TOLERANCE = Tolerance(1e-5, 1e-5)
Progress = Callable[[int, int], None]


@dataclass(frozen=True, slots=True)
class Effort:
    """How precisely, by which method and with which means."""

    tolerance: Tolerance
    method: str
    seed: int
    threads: int


def effort(tolerance: float | None, method: str, seed: int, threads: int | None) -> Effort:
    """The checked options. Raises BadInput.

    `tolerance` defaults to 1e-5, relative for figures above 1; `threads` to the processors at hand.
    """
    if tolerance is not None and (not _is_number(tolerance) or not 0.0 < tolerance < math.inf):
        raise BadInput("tolerance", tolerance, "must be a finite number above 0")
    if method not in METHODS:
        raise BadInput("method", method, f"must be one of {', '.join(METHODS)}")
    if not _is_integer(seed) or not 0 <= seed < 2**64:
        raise BadInput("seed", seed, "must be an integer in [0, 2^64)")
    if threads is None:
        threads = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1
    if not _is_integer(threads) or not 1 <= threads <= 1024:
        raise BadInput("threads", threads, "must be an integer in [1, 1024]")
    within = DEFAULT_TOLERANCE if tolerance is None else Tolerance(float(tolerance))
    return Effort(within, method, int(seed), int(threads))


def model_of(model: Model | str) -> Model:
    """A model, or the one of that name."""
    return find(model) if isinstance(model, str) else model


def sequence(name: str, value: object) -> list[Any]:
    """One value or several, as a list. Raises BadInput for none at all."""
    several = isinstance(value, Iterable) and not isinstance(value, str)
    values = list(value) if several else [value]  # type: ignore[call-overload]
    if not values:
        raise BadInput(name, value, "must hold at least one value")
    return values


def grid(model: Model, parameters: Mapping[str, object]) -> Iterator[tuple[Any, float | None]]:
    """Every combination of the parameters' values, the first varying slowest: the model's named tuple, and the scale if given."""
    several = {name: sequence(name, value) for name, value in parameters.items()}
    for values in itertools.product(*several.values()):
        named = dict(zip(several, values, strict=True))
        scale = SCALE.parse(named.pop("scale")) if "scale" in named else None
        yield model.bind(named), scale


def constant(model: Model, p: Any, given: float | None) -> Estimate:
    """The constant `scale` of a model: as given, as its source prescribes, or the largest that energy balance allows."""
    if given is not None:
        return exact(given)
    if isinstance(model.scale, Maximum):
        return largest_constant(supremum(model, p).value)
    return exact(model.scale(p))


def largest_constant(largest_albedo: Estimate) -> Estimate:
    """The reciprocal of the largest albedo of the shape; 0 where that is unbounded, infinite where it is 0."""
    if math.isinf(largest_albedo.value):
        return exact(0.0, largest_albedo.method)
    if largest_albedo.value <= 0.0:
        return exact(math.inf, largest_albedo.method)
    value = 1.0 / largest_albedo.value
    low = 1.0 / largest_albedo.high
    high = 1.0 / largest_albedo.low if largest_albedo.low > 0.0 else math.inf
    error = (high - low) / (2.0 * NORMAL_975)
    return Estimate(
        value,
        error,
        low,
        high,
        largest_albedo.samples,
        largest_albedo.method,
        largest_albedo.seed,
        largest_albedo.non_finite,
    )


def orders(model: Model) -> Sequence[str]:
    """The orders of integration that have to be reported."""
    return ("wi",) if model.reciprocal else ("wi", "wo")


def parameter_columns(model: Model, p: Any, quantity: str) -> dict[str, float]:
    """A column per parameter; one that bears the quantity's name, as Lambert's albedo does, is called `<name>_parameter`."""
    return {f"{name}_parameter" if name == quantity else name: value for name, value in model.columns(p).items()}


def figures(quantity: str, e: Estimate) -> dict[str, Any]:
    """The columns of a quantity, in the order that every table has."""
    return {
        quantity: e.value,
        "standard_error": e.standard_error,
        "ci95_low": e.low,
        "ci95_high": e.high,
        "samples": e.samples,
        "method": e.method,
        "seed": e.seed,
        "non_finite": e.non_finite,
    }


def conclude(e: Estimate, tolerance: Tolerance, cell: str) -> Estimate:
    """The estimate, when it is as narrow as asked; one that holds non-finite weights is a finding and passes as well.

    Raises Inconclusive.
    """
    if e.reaches(tolerance) or e.non_finite or not math.isfinite(e.value):
        return e
    raise Inconclusive(
        f"tolerance = {tolerance.at(e.value):g}: not reached within the budget at {cell}: "
        f"half-width {e.half_width:.2g} about {e.value:.6g} after {e.samples} evaluations"
    )


def label(model: Model, row: Mapping[str, Any]) -> str:
    """A cell in words, for a message."""
    return ", ".join([model.name, *(f"{name} = {value:g}" for name, value in row.items() if _is_number(value))])


def track(cells: Sequence[Any], progress: Progress | None) -> Iterator[Any]:
    """The cells one by one, with progress told."""
    for done, cell in enumerate(cells):
        if progress is not None:
            progress(done, len(cells))
        yield cell
    if progress is not None:
        progress(len(cells), len(cells))


def _is_number(value: object) -> bool:
    return isinstance(value, int | float | np.number) and not isinstance(value, bool)


def _is_integer(value: object) -> bool:
    return isinstance(value, int | np.integer) and not isinstance(value, bool)
