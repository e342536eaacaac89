"""The paper's equations on arrays of directions, as they are printed: what stands on trial, and a second method for the models.

Directions are (count, 3) arrays of unit vectors, L to the light and V to the viewer; the normal N is z. A BRDF here is its shape,
without c_n, C_n and C_max.
"""

from __future__ import annotations

from collections.abc import Callable
from math import pi

import numpy as np
from numpy.polynomial.legendre import leggauss
from numpy.typing import NDArray

Array = NDArray[np.float64]
Brdf = Callable[[Array, Array], Array]
N = np.array([0.0, 0.0, 1.0])


def hemisphere(seed: int, count: int) -> Array:
    """Directions above the surface, uniform in solid angle."""
    z, turn = np.random.default_rng(seed).random((2, count))
    s, phi = np.sqrt(1.0 - z * z), 2.0 * pi * turn
    return np.stack([s * np.cos(phi), s * np.sin(phi), z], axis=-1)


def dot(a: Array, b: Array) -> Array:
    """Scalar products, pair by pair."""
    return np.asarray(np.sum(a * b, axis=-1))


def mirrored(L: Array) -> Array:
    """Eq. 8."""
    return np.asarray(2.0 * L[:, 2:] * N - L)


def halfway(L: Array, V: Array) -> Array:
    """The unit vector H between L and V."""
    return np.asarray((L + V) / np.linalg.norm(L + V, axis=-1, keepdims=True))


def cos_alpha(L: Array, V: Array) -> Array:
    """(R.V)^+."""
    return np.maximum(dot(mirrored(L), V), 0.0)


def larger(L: Array, V: Array) -> Array:
    """The cosine of Theta_min, by its definition in eq. 3."""
    return np.asarray(np.cos(np.minimum(np.arccos(L[:, 2]), np.arccos(V[:, 2]))))


def phong(n: float) -> Brdf:
    """Eq. 5."""
    return lambda L, V: np.asarray(cos_alpha(L, V) ** n)


def stretched(n: float, p: float = 1.0) -> Brdf:
    """Eq. 7, and eq. 12 for another p."""
    return lambda L, V: np.asarray(cos_alpha(L, V) ** n / larger(L, V) ** p)


def stretched_by_products(n: float) -> Brdf:
    """Eq. 10, of dot products alone."""
    return lambda L, V: np.asarray(np.maximum(2.0 * L[:, 2] * V[:, 2] - dot(L, V), 0.0) ** n / np.maximum(L[:, 2], V[:, 2]))


def retro(n: float) -> Brdf:
    """Eq. 13."""
    return lambda L, V: np.asarray(np.maximum(dot(L, V), 0.0) ** n / np.maximum(L[:, 2], V[:, 2]))


def lafortune(C: tuple[float, float, float], n: float) -> Brdf:
    """Eq. 14 as printed, without ( )^+."""
    return lambda L, V: np.asarray(dot(mirrored(L) * np.array(C), V) ** n)


def blinn(n: float) -> Brdf:
    """Eq. 31."""
    return lambda L, V: np.asarray(halfway(L, V)[:, 2] ** n)


def stretched_blinn(n: float) -> Brdf:
    """Eq. 32."""
    return lambda L, V: np.asarray(halfway(L, V)[:, 2] ** n / np.maximum(L[:, 2], V[:, 2]))


def gaussian(m: float, L: Array, V: Array) -> Array:
    """exp(-tan^2 delta / m^2) / (4 pi m^2), delta = arccos(N.H)."""
    delta = np.arccos(halfway(L, V)[:, 2])
    return np.asarray(np.exp(-(np.tan(delta) ** 2) / m**2) / (4.0 * pi * m * m))


def ward(m: float) -> Brdf:
    """Eq. 34."""
    return lambda L, V: np.asarray(gaussian(m, L, V) / np.sqrt(L[:, 2] * V[:, 2]))


def modified_ward(m: float) -> Brdf:
    """Eq. 35."""
    return lambda L, V: np.asarray(gaussian(m, L, V) / np.maximum(L[:, 2], V[:, 2]))


def cook_torrance(m: float) -> Brdf:
    """Beckmann's distribution, V-cavities and F = 1; the paper only names it."""

    def f(L: Array, V: Array) -> Array:
        H = halfway(L, V)
        c, up = H[:, 2], 2.0 * H[:, 2] / dot(V, H)
        D = np.exp(-(np.tan(np.arccos(c)) ** 2) / m**2) / (pi * m * m * c**4)
        return np.asarray(D * np.minimum(1.0, up * np.minimum(L[:, 2], V[:, 2])) / (4.0 * L[:, 2] * V[:, 2]))

    return f


def schlick(r: float) -> Brdf:
    """Eq. 36."""

    def f(L: Array, V: Array) -> Array:
        zenith = r / (1.0 - (1.0 - r) * halfway(L, V)[:, 2] ** 2) ** 2
        return np.asarray(zenith / (4.0 * pi) / (r + (1.0 - r) * L[:, 2]) / (r + (1.0 - r) * V[:, 2]))

    return f


def fresnel(kappa: complex, c: Array) -> Array:
    """Reflectance of unpolarised light for a complex index, by its two amplitudes."""
    inside = np.sqrt(kappa**2 - 1.0 + c * c + 0j)
    s, p = (c - inside) / (c + inside), (kappa**2 * c - inside) / (kappa**2 * c + inside)
    return np.asarray(0.5 * (np.abs(s) ** 2 + np.abs(p) ** 2))


def reflected(f: Brdf, theta_deg: float) -> float:
    """The albedo of a broad lobe by a product rule about the normal: Gauss-Legendre in the cosine, equal steps in azimuth."""
    theta = np.radians(theta_deg)
    nodes, weights = leggauss(120)
    phi = 2.0 * pi * (np.arange(480) + 0.5) / 480
    total = 0.0
    for low, high in ((0.0, np.cos(theta)), (np.cos(theta), 1.0)):
        z = 0.5 * (low + high) + 0.5 * (high - low) * nodes
        s = np.sqrt(1.0 - z * z)
        V = np.stack([np.outer(s, np.cos(phi)), np.outer(s, np.sin(phi)), np.outer(z, np.ones_like(phi))], axis=-1).reshape(-1, 3)
        L = np.broadcast_to([np.sin(theta), 0.0, np.cos(theta)], V.shape)
        along = (f(L, V) * V[:, 2]).reshape(len(z), -1).mean(axis=1) * 2.0 * pi
        total += 0.5 * (high - low) * float(weights @ along)
    return total


def lobe(n: float, theta_deg: float, nodes: int = 600) -> tuple[Array, Array]:
    """Cosines of the sampled directions of eq. 20 for a viewer at an angle, and weights that sum to 1: midpoints of (u, v)."""
    theta = np.radians(theta_deg)
    u, v = np.meshgrid((np.arange(nodes) + 0.5) / nodes, (np.arange(nodes) + 0.5) / nodes)
    c = u ** (1.0 / (n + 1.0))
    z = c * np.cos(theta) + np.sqrt(1.0 - c * c) * np.sin(theta) * np.cos(2.0 * pi * v)
    return z.ravel(), np.full(z.size, 1.0 / z.size)
