"""SciPy's integrators on the albedo in plain spherical coordinates, as a user writes it, constant included.

Azimuths are counted from the mirror's plane. `plain` takes the whole hemisphere; `careful` uses the symmetry and splits
where max() has its kink. For `dblquad` integrands are scalar Python (math, not NumPy, which would be slower), for
`cubature` arrays.
"""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray
from scipy.integrate import cubature, dblquad

Array = NDArray[np.float64]
HALF_PI = 0.5 * math.pi


def scalar_integrand(model: str, parameter: float, mu: float) -> Callable[[float, float], float]:
    """f cos sin(theta) of (theta, phi)."""
    si = math.sqrt(1 - mu * mu)

    def stretched_phong(theta: float, phi: float) -> float:
        c, s = math.cos(theta), math.sin(theta)
        rv = mu * c + si * s * math.cos(phi)
        return (parameter + 2) / (2 * math.pi) * rv**parameter / max(c, mu) * c * s if rv > 0 else 0.0

    def ward(theta: float, phi: float) -> float:
        c, s = math.cos(theta), math.sin(theta)
        x, y, z = s * math.cos(phi) - si, s * math.sin(phi), c + mu
        tan2 = (x * x + y * y) / (z * z)
        return math.exp(-tan2 / parameter**2) / (4 * math.pi * parameter**2 * math.sqrt(c * mu)) * c * s

    return {"stretched_phong": stretched_phong, "ward": ward}[model]


def array_integrand(model: str, parameter: float, mu: float) -> Callable[[Array], Array]:
    """The same of an array of shape (points, 2)."""
    si = math.sqrt(1 - mu * mu)

    def stretched_phong(x: Array) -> Array:
        c, s = np.cos(x[:, 0]), np.sin(x[:, 0])
        rv = np.maximum(mu * c + si * s * np.cos(x[:, 1]), 0)
        return (parameter + 2) / (2 * math.pi) * rv**parameter / np.maximum(c, mu) * c * s

    def ward(x: Array) -> Array:
        c, s = np.cos(x[:, 0]), np.sin(x[:, 0])
        hx, hy, hz = s * np.cos(x[:, 1]) - si, s * np.sin(x[:, 1]), c + mu
        tan2 = (hx**2 + hy**2) / hz**2
        return np.exp(-tan2 / parameter**2) / (4 * math.pi * parameter**2 * np.sqrt(c * mu)) * c * s

    return {"stretched_phong": stretched_phong, "ward": ward}[model]


def rectangles(careful: bool, mu: float) -> tuple[int, list[tuple[float, float, float]]]:
    """By what to multiply the sum, and the pieces: theta from, theta to, |phi| up to."""
    if careful:
        kink = math.acos(mu)
        return 2, [(0.0, kink, math.pi), (kink, HALF_PI, math.pi)]
    return 1, [(0.0, HALF_PI, math.pi)]


def by_dblquad(model: str, parameter: float, mu: float, tolerance: float, careful: bool) -> float:
    f = scalar_integrand(model, parameter, mu)
    times, pieces = rectangles(careful, mu)
    error = tolerance / (times * len(pieces))
    total = 0.0
    for low, high, end in pieces:
        total += dblquad(f, 0.0 if careful else -end, end, low, high, epsabs=error, epsrel=0)[0]
    return times * total


def by_cubature(model: str, parameter: float, mu: float, tolerance: float, careful: bool) -> float:
    f = array_integrand(model, parameter, mu)
    times, pieces = rectangles(careful, mu)
    error = tolerance / (times * len(pieces))
    total = 0.0
    for low, high, end in pieces:
        corner = [low, 0.0 if careful else -end]
        total += float(cubature(f, corner, [high, end], atol=error, rtol=0).estimate)
    return times * total
