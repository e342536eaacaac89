"""Directions in the local frame with normal z, and the cosines that BRDFs are made of.

Narrow lobes (n = 1e8, m = 1e-4) and grazing light lose their digits in 1 - cos; what follows never subtracts two numbers near 1.
"""

from __future__ import annotations

from math import sqrt
from typing import NamedTuple

from albedo_lab.optics.maths import exp, log1p


class Direction(NamedTuple):
    """A unit vector away from the surface; z is its cosine with the normal."""

    x: float
    y: float
    z: float


def dot(a: Direction, b: Direction) -> float:
    """Scalar product."""
    return a.x * b.x + a.y * b.y + a.z * b.z


def mirror_of(w: Direction) -> Direction:
    """The mirror direction R of w: 2 (N.w) N - w (neumann1999 eq. 8)."""
    return Direction(-w.x, -w.y, w.z)


def reflect(w: Direction, h: Direction) -> Direction:
    """w mirrored about h: 2 (w.h) h - w."""
    k = 2.0 * dot(w, h)
    return Direction(k * h.x - w.x, k * h.y - w.y, k * h.z - w.z)


def bisector(wi: Direction, wo: Direction) -> Direction:
    """wi + wo, the half-vector before it is normalised; its length is 2 (wo.h)."""
    return Direction(wi.x + wo.x, wi.y + wo.y, wi.z + wo.z)


def cosine_power(a: Direction, b: Direction, n: float) -> float:
    """[(a.b)^+]^n. For n = 0 the limit n -> 0+: 1 where a.b > 0, else 0.

    a.b = 1 - |a - b|^2 / 2, so that a lobe of n = 1e8 keeps 11 digits where the dot product would keep 8.
    """
    x, y, z = a.x - b.x, a.y - b.y, a.z - b.z
    deficit = 0.5 * (x * x + y * y + z * z)
    return exp(n * log1p(-deficit)) if deficit < 1.0 else 0.0


def normal_power(v: Direction, n: float) -> float:
    """(N.H)^n for the bisector v, from the tangent of the half-vector's angle rather than from its cosine."""
    return exp(-0.5 * n * log1p((v.x * v.x + v.y * v.y) / (v.z * v.z)))


def length(v: Direction) -> float:
    """Euclidean length."""
    return sqrt(dot(v, v))


def about_axis(axis: Direction, s: float, c: float, sincos: tuple[float, float]) -> Direction:
    """Direction at angle (sine s, cosine c) from an axis with z >= 0, at an azimuth given by its sine and cosine.

    Azimuth 0 lies in the plane of axis and normal, on the normal's side, when axis.y = 0 (basis of Frisvad 2012).
    """
    sp, cp = sincos
    k = -1.0 / (1.0 + axis.z)
    xy = axis.x * axis.y * k
    t, b = s * cp, s * sp
    return Direction(
        t * (1.0 + axis.x * axis.x * k) + b * xy + c * axis.x,
        t * xy + b * (1.0 + axis.y * axis.y * k) + c * axis.y,
        c * axis.z - t * axis.x - b * axis.y,
    )
