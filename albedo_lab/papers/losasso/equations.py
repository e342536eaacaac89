"""The lighting equations as they are printed, on arrays of directions: a second way that shares no code with the models.

A direction is an array (..., 3) of unit vectors, the normal being (0, 0, 1); L points to the light, E to the eye. An intensity I
is that of one light at a distance that does not attenuate it (f_att = 1), without the ambient term k_a, for a coefficient k_d or
k_s of 1. Angles are in radians. Nothing is clamped that the document does not clamp.
"""

from __future__ import annotations

from collections.abc import Callable
from math import pi
from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Equation = Callable[[Array, Array], Array]
"""I(L, E), of shape (...)."""

NODES = 200


def direction(theta: float | Array, phi: float | Array = 0.0) -> Array:
    """The unit vector of these polar angles."""
    s = np.sin(theta)
    return np.stack(np.broadcast_arrays(s * np.cos(phi), s * np.sin(phi), np.cos(theta)), axis=-1)


def hemisphere(seed: int, count: int) -> Array:
    """Directions uniform over the hemisphere, none of them lower than a degree above the horizon, (count, 3)."""
    u = np.random.default_rng(seed).random((2, count))
    return direction(np.arccos(np.sin(np.radians(1.0)) + (1.0 - np.sin(np.radians(1.0))) * u[0]), 2.0 * pi * u[1])


def dot(a: Array, b: Array) -> Array:
    """Scalar product."""
    return np.asarray(np.sum(a * b, axis=-1))


def half_vector(L: Array, E: Array) -> Array:
    """H = normalize(L + E); the table prints L + V."""
    v = L + E
    return np.asarray(v / np.sqrt(dot(v, v))[..., None])


def reflection_vector(L: Array) -> Array:
    """R = 2 (L.N) N - L."""
    N = np.array([0.0, 0.0, 1.0])
    return np.asarray(2.0 * L[..., 2:] * N - L)


def turned(w: Array, turn: Array) -> Array:
    """Directions (n, 3) turned about the normal by angles (n,)."""
    c, s = np.cos(turn), np.sin(turn)
    return np.stack([c * w[:, 0] - s * w[:, 1], s * w[:, 0] + c * w[:, 1], w[:, 2]], axis=-1)


def lambert(L: Array, E: Array) -> Array:
    """N.L."""
    return np.asarray(L[..., 2] + 0.0 * E[..., 2])


def phong(n: float) -> Equation:
    """(E.R)^n, specular part; an integer n, for E.R may be negative."""
    return lambda L, E: dot(E, reflection_vector(L)) ** int(n)


def beckmann(m: float, t: Array | float) -> Array:
    """D of the Cook-Torrance model, exp(-tan^2(beta) / m^2) / (4 m^2 cos^4(beta)), t = cos(beta)."""
    return np.asarray(np.exp(-(1.0 - t * t) / (m * t) ** 2) / (4.0 * m**2 * t**4))


def ellipsoids(c: float, t: Array | float) -> Array:
    """D of the Blinn model, (c^2 / (t^2 (c^2 - 1) + 1))^2, t = N.H."""
    return np.asarray((c * c / (t * t * (c * c - 1.0) + 1.0)) ** 2)


def cavities(L: Array, E: Array) -> Array:
    """G = min(1, 2 (N.H) (N.E) / (E.H), 2 (N.H) (N.L) / (E.H)); the last is printed over V.H."""
    H = half_vector(L, E)
    k = 2.0 * H[..., 2] / dot(E, H)
    return np.asarray(np.minimum(1.0, k * np.minimum(E[..., 2], L[..., 2])))


def fresnel(n: float, c: Array | float, printed: bool = False) -> Array:
    """The Fresnel term; g = sqrt(n^2 + c^2 - 1), or sqrt(n^2 + c^2) - 1 as it is printed. 1 beyond a critical angle."""
    g = np.sqrt(n * n + c * c) - 1.0 if printed else np.sqrt(np.maximum(n * n + c * c - 1.0, 0.0))
    return np.asarray(0.5 * ((g - c) / (g + c)) ** 2 * (1.0 + ((c * (g + c) - 1.0) / (c * (g - c) + 1.0)) ** 2))


def cheap_fresnel(n: float, c: Array | float) -> Array:
    """The approximation as printed, (1 - x) + n x with x = (1 - c)^5."""
    x = (1.0 - c) ** 5
    return np.asarray((1.0 - x) + n * x)


def cook_torrance(m: float) -> Equation:
    """D G / (pi (E.N)), specular part with F = 1."""
    return lambda L, E: beckmann(m, half_vector(L, E)[..., 2]) * cavities(L, E) / (pi * E[..., 2])


def blinn(c: float) -> Equation:
    """D G / (E.N) with F = 1."""
    return lambda L, E: ellipsoids(c, half_vector(L, E)[..., 2]) * cavities(L, E) / E[..., 2]


def rough_A(sigma: float | Array) -> Any:
    """A of the Oren-Nayar model."""
    return 1.0 - 0.5 * sigma**2 / (sigma**2 + 0.33)


def rough_B(sigma: float | Array) -> Any:
    """B of the Oren-Nayar model."""
    return 0.45 * sigma**2 / (sigma**2 + 0.09)


def oren_nayar(sigma: float | Array) -> Equation:
    """(1/pi) cos(theta_i) (A + B max(0, cos(phi_r - phi_i)) sin(alpha) tan(beta)), from angles, for rho = E_0 = 1."""

    def intensity(L: Array, E: Array) -> Array:
        theta_i, theta_r = np.arccos(L[..., 2]), np.arccos(E[..., 2])
        turn = np.cos(np.arctan2(E[..., 1], E[..., 0]) - np.arctan2(L[..., 1], L[..., 0]))
        alpha, beta = np.maximum(theta_i, theta_r), np.minimum(theta_i, theta_r)
        rise = np.maximum(0.0, turn) * np.sin(alpha) * np.tan(beta)
        return np.asarray(np.cos(theta_i) / pi * (rough_A(sigma) + rough_B(sigma) * rise))

    return intensity


def minnaert(k: float) -> Equation:
    """(N.L) (N.L)^k (1 - N.E)^(1-k)."""
    return lambda L, E: L[..., 2] * L[..., 2] ** k * (1.0 - E[..., 2]) ** (1.0 - k)


def ward(alpha_x: float, alpha_y: float) -> Equation:
    """The specular term of Ward's model."""

    def intensity(L: Array, E: Array) -> Array:
        H = half_vector(L, E)
        square = (H[..., 0] / alpha_x) ** 2 + (H[..., 1] / alpha_y) ** 2
        lobe = np.exp(-2.0 * square / (1.0 + H[..., 2]))
        return np.asarray(L[..., 2] / np.sqrt(L[..., 2] * E[..., 2]) * lobe / (4.0 * alpha_x * alpha_y))

    return intensity


def reflected(intensity: Equation, theta: float, irradiance: float) -> float:
    """The share of the light from the angle theta that an equation sends back: I cos over all viewers, over the irradiance.

    `irradiance` is what the light brings to a surface that faces it. Gauss' rule in the polar angle, the trapezoid's in azimuth.
    """
    x, w = np.polynomial.legendre.leggauss(NODES)
    polar, w = 0.25 * pi * (1.0 + x), 0.25 * pi * w
    phi = 2.0 * pi * (np.arange(NODES) + 0.5) / NODES
    E = direction(polar[:, None], phi[None, :])
    seen = intensity(np.broadcast_to(direction(theta), E.shape), E)
    return float(np.sum(w * np.sin(polar) * np.cos(polar) * np.mean(seen, axis=1)) * 2.0 * pi / (irradiance * np.cos(theta)))
