"""Where a model's albedo is largest, over every direction of incidence and both ends, and how large it is there.

Quadrature does the search. Elevation is walked in t = asinh(tan theta), mu = sech t: t is the angle near the normal and
-log(mu / 2) near grazing, so that what happens within 1e-4 of either end is as wide as the rest. The neighbourhood of every
candidate is then replaced by a Chebyshev interpolant: its coefficients tell its error, and its maximum is found in closed form.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import lru_cache, partial
from typing import Any

import numpy as np
from numpy.polynomial import Chebyshev

from albedo_lab.estimate.quadrature import quadrature
from albedo_lab.estimate.record import Estimate, Question, Tolerance, bounded
from albedo_lab.model import Model

NEAR_NORMAL = np.geomspace(1e-6, 0.2, 27)
TO_GRAZING = np.arange(0.25, 28.0, 0.25)
WALK = np.concatenate([[0.0], NEAR_NORMAL, TO_GRAZING])
AZIMUTHS = 24
COARSE = 1e-8
COARSE_AZIMUTH = 1e-4
FINE = 1e-11
NODES = 17
MOST_ROUNDS = 6
NEARLY = 1e-6
GRAZING = (1e-8, 1e-10, 1e-12)
STILL_GROWING = 0.95
ROUNDING = 1e-13
"""Relative: what the sums of quadrature and the interpolation leave, where their own bounds are smaller."""


@dataclass(frozen=True, slots=True)
class Supremum:
    """The largest albedo of a shape: a bounded figure, and the direction (mu, phi) that has it; mu = 0 is the limit.

    `location_error` is the part of the bound that comes from not knowing the place exactly. Where the albedo diverges at
    grazing angles, `behaviour` is "diverges" and the value infinite; where it is NaN anywhere, "undefined" and the value NaN.
    """

    value: Estimate
    mu: float
    phi: float
    location_error: float
    behaviour: str


@lru_cache(maxsize=4096)
def supremum(model: Model, p: Any, order: str = "wi") -> Supremum:
    """The supremum of the directional albedo of the shape (scale = 1) over all directions of incidence."""
    phi = 0.0 if model.isotropic(p) else _best_azimuth(model, p, order)
    limit = grazing_limit(model, p, phi, order)
    if math.isinf(limit.value):
        return Supremum(limit, 0.0, phi, 0.0, "diverges")
    samples = limit.samples

    def at(t: float, azimuth: float, relative: float) -> Estimate:
        nonlocal samples
        within = Tolerance(0.0, max(relative, model.smooth_in.finest))
        found = quadrature(Question(model, p, 1.0 / math.cosh(t), azimuth, order), within)
        samples += found.samples
        return found

    coarse = np.array([at(t, phi, COARSE).value for t in WALK])
    best = max(float(coarse.max()), limit.value)
    if math.isnan(best):
        return Supremum(bounded(math.nan, math.nan, samples, "quadrature"), 1.0, phi, 0.0, "undefined")
    found: list[tuple[float, float, float, float]] = []
    for i, value in enumerate(coarse):
        neighbours = coarse[max(i - 1, 0) : i + 2]
        if value == neighbours.max() and value >= best * (1.0 - NEARLY):
            low, high = WALK[max(i - 1, 0)], WALK[min(i + 1, len(WALK) - 1)]
            found.append(_maximum(partial(at, azimuth=phi, relative=FINE), low, high))
    if not found or limit.value > max(peak for _, peak, _, _ in found):
        return Supremum(replace(limit, samples=samples), 0.0, phi, 0.0, "bounded")
    t, peak, error, bound = max(found, key=lambda candidate: candidate[1])
    if not model.isotropic(p):
        for _ in range(3):
            width = math.pi / AZIMUTHS
            phi, peak, error, bound = _maximum(partial(at, t, relative=FINE), phi - width, phi + width)
            t, peak, error_t, bound = _maximum(partial(at, azimuth=phi, relative=FINE), max(t - 0.25, 0.0), t + 0.25)
            error = max(error, error_t)
    at_normal = at(0.0, phi, FINE).value
    if at_normal >= peak - error - bound:
        t, peak = 0.0, max(peak, at_normal)
    within = error + bound + ROUNDING * abs(peak)
    return Supremum(bounded(peak, within, samples, "quadrature"), 1.0 / math.cosh(t), phi, error, "bounded")


def grazing_limit(model: Model, p: Any, phi: float, order: str) -> Estimate:
    """lim a(mu) as mu -> 0, with the error of the extrapolation; infinite where the albedo still grows over the last decades."""
    within = Tolerance(0.0, max(COARSE, model.smooth_in.finest))
    a = [quadrature(Question(model, p, mu, phi, order), within) for mu in GRAZING]
    before, after = a[1].value - a[0].value, a[2].value - a[1].value
    noise = sum(e.half_width for e in a)
    samples = sum(e.samples for e in a)
    if after > noise and after > STILL_GROWING * before:
        return bounded(math.inf, 0.0, samples, "quadrature")
    ratio = min(abs(after / before), 0.9) if abs(before) > noise else 0.0
    rest = after * ratio / (1.0 - ratio)
    return bounded(a[2].value + rest, a[2].half_width + abs(after) + abs(rest), samples, "quadrature")


def _maximum(a: Callable[[float], Estimate], low: float, high: float) -> tuple[float, float, float, float]:
    """Place, value, error of place and bound of the maximum of a smooth function on [low, high], by Chebyshev interpolation.

    The interval shrinks about the maximum until the last coefficients, which are the interpolant's error, drown in the bounds.
    """
    for _ in range(MOST_ROUNDS):
        x = 0.5 * (low + high) + 0.5 * (high - low) * np.cos(np.pi * np.arange(NODES) / (NODES - 1))
        nodes = [a(float(t)) for t in x]
        values = np.array([node.value for node in nodes])
        bound = max(node.half_width for node in nodes)
        curve = Chebyshev.fit(x, values, NODES - 1, domain=[low, high])
        error = float(np.abs(curve.coef[-3:]).sum())
        roots = curve.deriv().roots()
        inside = [r.real for r in map(complex, roots) if abs(r.imag) < 1e-6 * (high - low) and low <= r.real <= high]
        places = np.array([low, high, *inside])
        place = float(places[np.argmax(curve(places))])
        if error <= bound:
            break
        quarter = 0.25 * (high - low)
        low, high = max(low, place - 0.5 * quarter), min(high, place + 0.5 * quarter)
    return place, float(curve(place)), error, bound


def _best_azimuth(model: Model, p: Any, order: str) -> float:
    """The azimuth near which the largest albedo lies, by a walk over the whole hemisphere."""
    azimuths = 2.0 * math.pi * np.arange(AZIMUTHS) / AZIMUTHS

    def largest(phi: float) -> float:
        elevations = np.concatenate([[0.0], TO_GRAZING[::4]])
        questions = (Question(model, p, 1.0 / math.cosh(t), phi, order) for t in elevations)
        return max(quadrature(q, Tolerance(0.0, COARSE_AZIMUTH)).value for q in questions)

    return float(max(azimuths, key=lambda phi: round(largest(float(phi)), 9)))
