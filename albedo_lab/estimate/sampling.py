"""Averages of sample weights: randomised quasi-Monte Carlo (independent Owen scrambles of Sobol points) and plain Monte Carlo."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable
from concurrent.futures import ThreadPoolExecutor
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from albedo_lab.estimate.record import NORMAL_975, Estimate, Question, Tolerance
from albedo_lab.kernels.sampling import BLOCK, NON_FINITE, SQUARES, SUM, sampling_kernel

REPLICATES = 64
STUDENT_975 = 1.998340542520741
"""0.975 quantile of Student's t with REPLICATES - 1 degrees of freedom."""
FIRST_POINTS = 1 << 9
FIRST_SAMPLES = 1 << 16
CHUNK = 1 << 18
BUDGET = 1 << 32
RESOLUTION = 2.0**-32
"""Relative floor of a half-width: uniforms stand at centres of cells of this size, scrambled or random."""
FASTEST_RATE = 1.5
"""No integrand here converges faster than N^-1.5; an hopeless tolerance is recognised by it before the budget is spent."""

UNSEEN = 2.0
"""Samples times tolerance over value, at least: a sliver of the domain that no sample hit could hold about value / samples."""
GRAZING_SAMPLES = 10.0
GRAZING_UNSEEN = 8.0
"""Near grazing there is such a sliver: the light's horizon cuts a lobe within an azimuth of the order of mu, and what lies on one
side of the cut counts up to twice the mean, on the other nothing. With fewer than GRAZING_SAMPLES / mu samples it may have been
missed (one time in 40 it is -ln 0.025 = 3.7 hits wide), so the interval is widened by GRAZING_UNSEEN * value / samples."""


def rqmc(question: Question, tolerance: Tolerance, seed: int, threads: int, budget: int = BUDGET) -> Estimate:
    """Scrambled Sobol points, doubled until Student's interval over 64 scrambles is narrow enough, or the budget is spent."""
    kernel = sampling_kernel(question.model, question.mu is None, True, question.order)
    constant = _constant(question)
    sums = np.zeros(REPLICATES)
    non_finite = 0
    points, target = 0, FIRST_POINTS
    while True:
        jobs = [
            (first, min(CHUNK, target - first), 0, _keys(seed, r), r)
            for r in range(REPLICATES)
            for first in range(points, target, CHUNK)
        ]
        for job, moments in zip(jobs, _run(kernel, question, jobs, threads), strict=True):
            sums[job[-1]] += moments[SUM]
            non_finite += int(moments[NON_FINITE])
        points = target
        means = sums / points
        with np.errstate(invalid="ignore", over="ignore"):
            sampled, error = float(np.mean(means)), float(np.std(means, ddof=1)) / math.sqrt(REPLICATES)
        half_width = STUDENT_975 * error + _blind(question, sampled, points * REPLICATES)
        value = sampled + constant
        estimate = Estimate(value, error, value - half_width, value + half_width, points * REPLICATES, "rqmc", seed, non_finite)
        wanted = _wanted(estimate, tolerance, FASTEST_RATE)
        if non_finite or wanted <= estimate.samples or not wanted <= budget:
            return estimate
        target = 2 * points


def monte_carlo(question: Question, tolerance: Tolerance, seed: int, threads: int, budget: int = BUDGET) -> Estimate:
    """Independent random samples, as many as the measured variance asks for."""
    kernel = sampling_kernel(question.model, question.mu is None, False, question.order)
    constant = _constant(question)
    count, mean, squares, non_finite, target = 0, 0.0, 0.0, 0, FIRST_SAMPLES
    while True:
        jobs = [
            (0, min(CHUNK, target - first), first // FIRST_SAMPLES, _keys(seed, REPLICATES), 0)
            for first in range(count, target, CHUNK)
        ]
        for job, moments in zip(jobs, _run(kernel, question, jobs, threads), strict=True):
            n = job[1]
            delta = moments[SUM] / n - mean
            mean += delta * n / (count + n)
            squares += moments[SQUARES] + delta * delta * count * n / (count + n)
            count += n
            non_finite += int(moments[NON_FINITE])
        error = math.sqrt(squares / (count - 1) / count)
        half_width = NORMAL_975 * error + _blind(question, mean, count)
        value = mean + constant
        estimate = Estimate(value, error, value - half_width, value + half_width, count, "mc", seed, non_finite)
        wanted = _wanted(estimate, tolerance, 0.5)
        if non_finite or wanted <= count or not wanted <= budget:
            return estimate
        target = count + CHUNK * math.ceil((1.02 * wanted - count) / CHUNK)


def _constant(question: Question) -> float:
    """What needs no samples: the Dirac part of one direction; that of the mean is in the samples."""
    return 0.0 if question.mu is None else float(question.model.mirror(question.p, question.mu))


def _blind(question: Question, value: float, samples: int) -> float:
    """What an interval must leave for things that no sample can have told."""
    grazing = question.mu is not None and samples * question.mu < GRAZING_SAMPLES
    return (RESOLUTION + (GRAZING_UNSEEN / samples if grazing else 0.0)) * abs(value)


def _wanted(estimate: Estimate, tolerance: Tolerance, rate: float) -> float:
    """How many samples the tolerance wants, at a rate of convergence; infinite where none would be enough."""
    allowed = tolerance.at(estimate.value)
    if not RESOLUTION * abs(estimate.value) <= allowed:
        return math.inf
    if allowed == 0.0:  # relative to an albedo of 0
        return 0.0 if estimate.half_width == 0.0 else math.inf
    by_error: float = estimate.samples * math.pow(max(estimate.half_width, 1e-300) / allowed, 1.0 / rate)
    return max(by_error, UNSEEN * abs(estimate.value) / allowed)


@lru_cache(maxsize=4096)
def _keys(seed: int, replicate: int) -> tuple[np.uint32, ...]:
    """Four keys, one per dimension. They do not depend on the question: cells of a table share their random numbers."""
    return tuple(np.random.SeedSequence([seed, replicate]).generate_state(4))


def _run(kernel: Callable[..., Any], question: Question, jobs: list[Any], threads: int) -> Iterable[NDArray[np.float64]]:
    """The moments of every job, in order, whatever the number of threads."""
    values = question.values
    direction = (0.0, 0.0, 1.0) if question.mu is None else incident(question.mu, question.phi)

    def work(job: Any) -> NDArray[np.float64]:
        first, count, stream, keys, _ = job
        moments = np.zeros(3)
        kernel(first, count // BLOCK, np.uint32(stream), keys, values, direction, moments)
        return moments

    return map(work, jobs) if threads == 1 else _pool(threads).map(work, jobs)


def incident(mu: float, phi: float) -> tuple[float, float, float]:
    """The unit vector of cosine mu and azimuth phi."""
    s = math.sqrt((1.0 - mu) * (1.0 + mu))
    return s * math.cos(phi), s * math.sin(phi), mu


@lru_cache(maxsize=8)
def _pool(threads: int) -> ThreadPoolExecutor:
    return ThreadPoolExecutor(threads)
