"""What is asked of a model: which parameters, how precisely, by which means. What comes from outside is checked here."""

from __future__ import annotations

import itertools
import math
import os
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from albedo_lab.catalogue import find
from albedo_lab.errors import BadInput
from albedo_lab.estimate.methods import METHODS
from albedo_lab.estimate.record import Tolerance
from albedo_lab.model import Choice, Model, Parameter

SCALE = Parameter("scale", "constant of the printed equation", default=math.nan, low=0.0, high=1e300)
DEFAULT_TOLERANCE = Tolerance(1e-5, 1e-5)


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


def values_of(model: Model, parameters: Mapping[str, object]) -> dict[str, list[Any]]:
    """The values of every parameter by its name; a choice that is swept and not given has all its options, and comes first."""
    swept = {c.name: list(c.options) for c in model.choices if isinstance(c, Choice) and c.swept and c.name not in parameters}
    return swept | {name: sequence(name, value) for name, value in parameters.items()}


def grid(model: Model, parameters: Mapping[str, object]) -> Iterator[tuple[Model, Any, float | None]]:
    """Every combination of the parameters' values, the first varying slowest.

    Each with the member of the model's family that its choices select, its named tuple, and the scale if given. A choice that is
    swept and not given takes all its options, slowest of all.
    """
    several = values_of(model, parameters)
    for values in itertools.product(*several.values()):
        named = dict(zip(several, values, strict=True))
        scale = SCALE.parse(named.pop("scale")) if "scale" in named else None
        member, numbers = model.member(named)
        yield member, member.bind(numbers), scale


def orders(model: Model) -> Sequence[str]:
    """The orders of integration that have to be reported."""
    return ("wi",) if model.reciprocal else ("wi", "wo")


def _is_number(value: object) -> bool:
    return isinstance(value, int | float | np.number) and not isinstance(value, bool)


def _is_integer(value: object) -> bool:
    return isinstance(value, int | np.integer) and not isinstance(value, bool)
