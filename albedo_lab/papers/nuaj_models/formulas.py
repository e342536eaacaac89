"""The page's formulas as functions of arrays, and what several of its trials share."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from albedo_lab.estimate.record import Estimate, bounded

Array = NDArray[np.float64]
WATER, GLASS, DIAMOND = 1.333, 1.5, 2.417
"""Refractive indices in yellow light; the page prints none."""
NODES, WEIGHTS = np.polynomial.legendre.leggauss(400)


def integral(f: Callable[[Array], Array], low: float, high: float) -> Estimate:
    """The integral of a smooth f by Gauss and Legendre, 400 points in each half of the range; the error is the distance from the
    same over the whole.
    """

    def panel(a: float, b: float) -> float:
        return float(0.5 * (b - a) * np.sum(WEIGHTS * f(0.5 * (a + b) + 0.5 * (b - a) * NODES)))

    middle = 0.5 * (low + high)
    value = panel(low, middle) + panel(middle, high)
    return bounded(value, abs(value - panel(low, high)) + 1e-14 * abs(value), 1200, "quadrature")


def projected(D: Callable[[Array], Array]) -> Estimate:
    """The area of all facets seen from above, the integral of D cos over the hemisphere: 1 for a distribution of normals."""
    return integral(lambda theta: 2.0 * np.pi * D(theta) * np.cos(theta) * np.sin(theta), 0.0, 0.5 * np.pi)


# Distributions of normals, as printed


def phong(n: float, theta: Array) -> Array:
    """D_phong, (2 + n) / (2 pi) cos^n."""
    return (2.0 + n) / (2.0 * np.pi) * np.cos(theta) ** n


def beckmann(m: float, theta: Array) -> Array:
    """D_beckmann, exp(-tan^2 / m^2) / (pi m^2 cos^4)."""
    D: Array = np.exp(-((np.tan(theta) / m) ** 2)) / (np.pi * m**2 * np.cos(theta) ** 4)
    return D


def generalised(alpha: float, gamma: float, theta: Array) -> Array:
    """D_generalizedTR, alpha^2 / (pi (alpha^2 cos^2 + sin^2)^gamma); D_TR is that with gamma = 1."""
    D: Array = alpha**2 / (np.pi * (alpha**2 * np.cos(theta) ** 2 + np.sin(theta) ** 2) ** gamma)
    return D


def excess(alpha: float, gamma: float) -> float:
    """The area of all facets of `generalised` seen from above, in closed form: what it must be divided by.

    With q = alpha^2 cos^2 + sin^2, cos sin dtheta = dq / (2 (1 - alpha^2)) and q runs from alpha^2 to 1.
    """
    if gamma == 1.0:
        return float(alpha**2 * -2.0 * np.log(alpha) / (1.0 - alpha**2))
    return float(alpha**2 * (alpha ** (2.0 - 2.0 * gamma) - 1.0) / ((gamma - 1.0) * (1.0 - alpha**2)))


# Fresnel


def schlick(F0: float, c: Array) -> Array:
    """Eq. 5."""
    return F0 + (1.0 - F0) * (1.0 - c) ** 5


def polarised(n: complex, c: Array) -> tuple[Array, Array]:
    """Fresnel's reflectances for light across and in the plane of incidence, from a medium of index 1 into one of index n."""
    inside = np.sqrt(n * n - (1.0 - c * c) + 0j)
    s = (c - inside) / (c + inside)
    p = (n * n * c - inside) / (n * n * c + inside)
    return np.abs(s) ** 2, np.abs(p) ** 2


def fresnel(n: complex, c: Array) -> Array:
    """The reflectance for unpolarised light."""
    s, p = polarised(n, c)
    return 0.5 * (s + p)


def white_sky(n: float) -> Estimate:
    """The share of uniform light that a smooth surface of index n reflects: the integral of F over cos^2."""
    return integral(lambda c: 2.0 * c * fresnel(n, c), 0.0, 1.0)


# Directions


def directions(count: int, seed: int) -> Array:
    """Unit vectors (count, 3), even over the hemisphere."""
    u = np.random.default_rng([seed, count]).random((count, 2))
    z, phi = u[:, 0], 2.0 * np.pi * u[:, 1]
    s = np.sqrt(1.0 - z * z)
    return np.stack([s * np.cos(phi), s * np.sin(phi), z], axis=-1)
