"""The two models that every comparison is about, and albedo_lab as the benchmarks call it."""

from __future__ import annotations

import os
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from albedo_lab.catalogue import find
from albedo_lab.estimate.quadrature import quadrature
from albedo_lab.estimate.record import Question, Tolerance
from albedo_lab.estimate.sampling import incident
from albedo_lab.kernels.sampling import BLOCK, SQUARES, SUM, sampling_kernel
from albedo_lab.model import Model
from tests.benchmarks.moments import Moments

THETA_DEG = 60
MU = 0.5
KEYS = tuple(np.random.SeedSequence(20).generate_state(4))


def processors() -> int:
    """How many of the machine's processors this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


def averaging(model: Model, p: Any, samples: int, scrambled: bool, generic: bool, stream: int = 0) -> Callable[[], Moments]:
    """A call that averages so many sample weights (rounded up to whole blocks) with the compiled kernel."""
    kernel = sampling_kernel(model, False, scrambled, generic=generic)
    values, direction, blocks = tuple(map(float, p)), incident(MU, 0.0), -(-samples // BLOCK)

    def run() -> Moments:
        moments = np.zeros(3)
        kernel(0, blocks, np.uint32(stream), KEYS, values, direction, moments)
        count = blocks * BLOCK
        return Moments(count, moments[SUM], moments[SQUARES] + moments[SUM] ** 2 / count)

    return run


@dataclass(frozen=True)
class Subject:
    """A model with its one parameter, at 60 degrees."""

    name: str
    parameter: str
    value: float

    def __str__(self) -> str:
        return f"{self.name} {self.parameter} = {self.value:g}"

    @cached_property
    def model(self) -> Model:
        return find(self.name)

    @cached_property
    def p(self) -> Any:
        return self.model.bind({self.parameter: self.value})

    @cached_property
    def scale(self) -> float:
        """The constant that the model carries; kernels and baselines of samples/s leave it out."""
        assert callable(self.model.scale)
        return float(self.model.scale(self.p))

    @property
    def question(self) -> Question:
        return Question(self.model, self.p, MU)

    def tolerance(self, absolute: float) -> Tolerance:
        """What the shape must reach, so that the albedo reaches `absolute`."""
        return Tolerance(absolute).over(self.scale)

    def sampler(self, samples: int, scrambled: bool = False, generic: bool = True) -> Callable[[], Moments]:
        return averaging(self.model, self.p, samples, scrambled, generic)

    def integral(self, tolerance: float) -> Callable[[], float]:
        """A call that integrates the albedo, its constant included, to a bound of `tolerance`."""
        return lambda: quadrature(self.question, self.tolerance(tolerance)).value * self.scale

    @cached_property
    def albedo(self) -> float:
        """The albedo, its constant included, by quadrature to 1e-13."""
        return self.integral(1e-13)()


SUBJECTS = (Subject("stretched_phong", "n", 100.0), Subject("ward", "m", 0.1))
