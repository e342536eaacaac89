"""The printed equations as they stand, of arrays of cosines, and plain integration over V′: they share no code with the models.

The cosines are those of section 2: t of H and N, u of V and H, v and v_ of N and V or V′, w of H's azimuth, the scratch at 0.
"""

from __future__ import annotations

from collections.abc import Callable
from itertools import pairwise
from math import pi
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.integrate import quad
from scipy.special import erfc

from albedo_lab.estimate.record import Estimate, bounded

Array = NDArray[np.float64]
NODES = 40
"""Of Gauss and Legendre, in each of three variables; twice as many tell the error."""
NIL = 1e-300


class Cosines(NamedTuple):
    """Of a pair of directions, as arrays of one shape."""

    t: Array
    u: Array
    v: Array
    v_: Array
    w: Array


Directional = Callable[[Cosines], Array]


def ward_slope(m: float, n: float, t: Array, w: Array) -> Array:
    """D of eq. 8."""
    return np.exp((t**2 - 1.0) / t**2 * (w**2 / m**2 + (1.0 - w**2) / n**2)) / (m * n)


def beckmann(m: float | Array, t: Array) -> Array:
    """Eq. 6."""
    return np.exp((t**2 - 1.0) / (m**2 * t**2)) / (m**2 * t**4)


def smith(m: float, v: Array, remainder: bool = False) -> Array:
    """Eq. 7; with exp(-h) in place of its 1, as Smith has it, where the `remainder` is asked for."""
    h = v**2 / (2.0 * m**2 * np.maximum(1.0 - v**2, NIL))
    g = np.sqrt(h * pi) * (2.0 - erfc(np.sqrt(h)))
    return g / (g + (np.exp(-h) if remainder else 1.0))


def exact_fresnel(n: complex, u: Array) -> Array:
    """Fresnel's reflectance of unpolarised light, for an index n relative to the medium of the light, by complex amplitudes."""
    g = np.sqrt(np.asarray(n, dtype=np.complex128) ** 2 - 1.0 + u * u)
    return np.asarray(0.5 * (np.abs((u - g) / (u + g)) ** 2 + np.abs((n * n * u - g) / (n * n * u + g)) ** 2))


def S(C: float, u: Array) -> Array:
    """Eq. 11."""
    return C + (1 - C) * (1 - u) ** 5


def Z(r: float, t: Array) -> Array:
    """Eq. 14."""
    return r / (1 + r * t**2 - t**2) ** 2


def A(p: float, w: Array) -> Array:
    """Eq. 14."""
    return np.sqrt(p / (p**2 - p**2 * w**2 + w**2))


def G(r: float, v: Array) -> Array:
    """Eq. 16."""
    return v / (r - r * v + v)


def lobe(r: float, p: float, c: Cosines) -> Array:
    """Eq. 12."""
    return Z(r, c.t) * A(p, c.w) / (4.0 * pi * c.v * c.v_)


def seen(r: float, c: Cosines) -> Array:
    """G(v) G(v′)."""
    return G(r, c.v) * G(r, c.v_)


def eq12(r: float, p: float = 1.0) -> Directional:
    """The lobe alone."""
    return lambda c: lobe(r, p, c)


def eq15(r: float, p: float = 1.0) -> Directional:
    """The lobe, obstructed."""
    return lambda c: seen(r, c) * lobe(r, p, c)


def eq17(r: float, p: float = 1.0) -> Directional:
    """The lobe and a diffuse term, weighted by the roughness."""
    return lambda c: r / pi * A(p, c.w) + (1.0 - r) * lobe(r, p, c)


def eq18(r: float, p: float = 1.0) -> Directional:
    """The lobe and a diffuse term, weighted by the obstruction."""
    return lambda c: (1.0 - seen(r, c)) / pi * A(p, c.w) + seen(r, c) * lobe(r, p, c)


DIRECTIONAL = {"eq12": eq12, "eq15": eq15, "eq17": eq17, "eq18": eq18}


def albedo(f: Directional, v: float, phi: float = 0.0) -> Estimate:
    """The integral of eq. 3, of f v′ over V′, for the viewer at cosine v and azimuth phi (radians).

    Nodes crowd about the mirror direction, where the half-vector turns fastest; for lobes no narrower than that of r = 0.01.
    """
    coarse, fine = (_integral(f, v, phi, n) for n in (NODES, 2 * NODES))
    return bounded(fine, 2.0 * abs(fine - coarse) + 1e-12 * abs(fine), 8 * NODES**2, "Gauss-Legendre over V′")


def at(v: float | Array, phi: float | Array, v_: Array, turn: Array) -> Cosines:
    """The cosines of V at (v, phi) and V′ at v_, turned by `turn` from the azimuth of the mirror direction (radians)."""
    s, s_ = np.sqrt((1.0 - v) * (1.0 + v)), np.sqrt((1.0 - v_) * (1.0 + v_))
    # along the azimuth of V; s - s′ loses its digits near the mirror
    along = (v_ - v) * (v_ + v) / np.maximum(s + s_, NIL) + 2.0 * s_ * np.sin(0.5 * turn) ** 2
    across, up = -s_ * np.sin(turn), v + v_
    flat = np.maximum(np.hypot(along, across), NIL)
    norm = np.hypot(flat, up)
    w = (along * np.cos(phi) - across * np.sin(phi)) / flat
    return Cosines(up / norm, 0.5 * norm, np.full_like(norm, v), v_ + 0.0 * norm, w)


def _integral(f: Directional, v: float, phi: float, n: int) -> float:
    x, weight = np.polynomial.legendre.leggauss(n)
    x, weight = 0.5 * (1.0 + x), 0.5 * weight
    total = 0.0
    # from the mirror's cosine up and down, cubed; and from its azimuth to both sides, cubed
    for end in (1.0, 0.0):
        v_, dv = v + (end - v) * x**3, 3.0 * abs(end - v) * weight * x**2
        for side in (1.0, -1.0):
            turn, dturn = side * pi * x**3, 3.0 * pi * weight * x**2
            value = f(at(v, phi, v_[:, None], turn[None, :])) * v_[:, None]
            total += float(dv @ value @ dturn)
    return total


def directions(seed: int, n: int) -> Array:
    """Unit vectors (n, 3) above the surface, evenly spread by the cosine."""
    z, turn = np.random.default_rng(seed).random((2, n))
    z = 0.01 + 0.99 * z
    s = np.sqrt(1.0 - z * z)
    return np.stack([s * np.cos(2.0 * pi * turn), s * np.sin(2.0 * pi * turn), z], axis=-1)


def halves(V: Array, V_: Array) -> Array:
    """H of both."""
    H: Array = V + V_
    H /= np.linalg.norm(H, axis=-1, keepdims=True)
    return H


def pairs(seed: int, n: int = 10_000) -> Cosines:
    """The cosines of random pairs, v and v' evenly spread from 0.02 on."""
    v, v_, phi, turn = np.random.default_rng(seed).random((4, n))
    return at(0.02 + 0.98 * v, 2.0 * pi * phi, 0.02 + 0.98 * v_, 2.0 * pi * turn - pi)


def quarter_turn(f: Callable[[Array], Array]) -> float:
    """The mean over the azimuth of a function of w that is even in it, and may be narrow where w is 0."""
    edges = (0.0, 1e-5, 1e-4, 1e-3, 1e-2, 0.1, 0.5, 0.5 * pi)
    pieces = [quad(lambda d: float(f(np.array(np.sin(d)))), a, b, epsrel=1e-11, epsabs=0.0)[0] for a, b in pairwise(edges)]
    return float(sum(pieces)) / (0.5 * pi)
