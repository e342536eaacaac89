"""The mean albedo by quadrature over all directions of incidence, each node an adaptive quadrature of its own."""

from __future__ import annotations

import heapq
import math
from dataclasses import replace

import numpy as np

from albedo_lab.estimate.quadrature import quadrature
from albedo_lab.estimate.record import Estimate, Question, Tolerance, bounded
from albedo_lab.kernels.kronrod import GAUSS, KRONROD, NODES

MOST_PANELS = 200
LAST = 28.0
"""mu = sech(28) = 1.4e-12; below it an albedo that grows no faster than 1/mu holds less than 1e-11 of the mean."""
FIRST_AZIMUTHS = 8
MOST_AZIMUTHS = 256


def mean_by_quadrature(question: Question, tolerance: Tolerance) -> Estimate:
    """2 ∫ a(mu) mu dmu (neumann1999 eq. 33) in the variable t of mu = sech t, in which both ends are smooth.

    The bound is the difference of K31 and G15 over all panels, worst first, plus the bounds of the nodes integrated along.
    """
    node_tolerance = Tolerance(tolerance.absolute / 4.0, tolerance.relative / 4.0)
    samples = 0

    def panel(a: float, b: float) -> tuple[float, float, float, float, float]:
        nonlocal samples
        t = 0.5 * (a + b) + 0.5 * (b - a) * NODES[:-1]
        nodes = [_over_azimuths(replace(question, mu=1.0 / math.cosh(x)), node_tolerance) for x in t]
        samples += sum(node.samples for node in nodes)
        density = 2.0 * np.tanh(t) / np.cosh(t) ** 2 * 0.5 * (b - a)
        values = np.array([node.value for node in nodes]) * density
        widths = np.array([node.half_width for node in nodes]) * density
        value = float(KRONROD[:-1] @ values)
        error = abs(value - float(GAUSS[:-1] @ values))
        return -error, a, b, value, float(KRONROD[:-1] @ widths)

    panels = [panel(a, b) for a, b in ((0.0, 1.0), (1.0, 4.0), (4.0, LAST))]
    heapq.heapify(panels)
    while len(panels) < MOST_PANELS:
        if not -sum(p[0] for p in panels) > 0.5 * tolerance.at(sum(p[3] for p in panels)):
            break  # narrow enough, or NaN
        _, a, b, _, _ = heapq.heappop(panels)
        middle = 0.5 * (a + b)
        for half in (panel(a, middle), panel(middle, b)):
            heapq.heappush(panels, half)
    value = math.fsum(p[3] for p in panels)
    return bounded(value, math.fsum(p[4] - p[0] for p in panels) + 1e-15 * abs(value), samples, "quadrature")


def _over_azimuths(question: Question, tolerance: Tolerance) -> Estimate:
    """The albedo averaged over the azimuth of incidence: equidistant nodes, doubled until the mean stands still."""
    if question.model.isotropic(question.p):
        return quadrature(question, tolerance)
    values: list[Estimate] = []
    count, before = FIRST_AZIMUTHS, math.nan
    while True:
        step = 2.0 * math.pi / count
        fresh = range(count) if not values else range(1, count, 2)
        values += [quadrature(replace(question, phi=step * i), tolerance) for i in fresh]
        mean = math.fsum(v.value for v in values) / count
        change = abs(mean - before)
        if change <= 0.1 * tolerance.at(mean) or count >= MOST_AZIMUTHS:
            bound = max(v.half_width for v in values) + change
            return bounded(mean, bound, sum(v.samples for v in values), "quadrature")
        count, before = 2 * count, mean
