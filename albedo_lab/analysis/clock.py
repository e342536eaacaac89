"""Timing on a noisy machine: contenders take turns, a figure is a median, a ratio a median of ratios within a round."""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np

Clock = Callable[[], float]
Measure = Callable[[], float]
"""Does the work once more and returns the seconds it took."""
Times = dict[str, list[float]]

CPU: Clock = time.thread_time
"""CPU time of this thread: what other programs take of the machine does not count."""
WALL: Clock = time.perf_counter
"""For work that is spread over threads."""
SHORTEST = 2e-3


@dataclass(frozen=True, slots=True)
class Ratio:
    """How many times longer one work took than another: the median over the rounds, and the quartiles."""

    value: float
    low: float
    high: float


def timed(work: Callable[[], object], clock: Clock = CPU) -> Measure:
    """Measures `work`, warmed up, in repeats that together last long enough for the clock."""
    work()
    start = clock()
    work()
    repeats = max(1, math.ceil(SHORTEST / max(clock() - start, 1e-7)))

    def measure() -> float:
        start = clock()
        for _ in range(repeats):
            work()
        return (clock() - start) / repeats

    return measure


def interleave(measures: Mapping[str, Measure], rounds: int) -> Times:
    """So many rounds in which everybody has one turn, forwards and backwards alternately."""
    times: Times = {name: [] for name in measures}
    order = list(measures)
    for _ in range(rounds):
        for name in order:
            times[name].append(measures[name]())
        order.reverse()
    return times


def ratio(times: Times, slower: str, faster: str) -> Ratio:
    """How many times longer `slower` took, round by round."""
    each = np.array(times[slower]) / np.array(times[faster])
    low, value, high = np.quantile(each, (0.25, 0.5, 0.75))
    return Ratio(float(value), float(low), float(high))
