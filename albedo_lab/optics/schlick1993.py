"""The zenith, azimuth and obstruction factors of schlick1993 (eq. 14, 16), and normals that follow the first two.

A facet's normal is given by any vector v along it, such as the bisector of both directions. Azimuth 0, the x axis, is the
scratch; w is the cosine of the azimuth. The density Z A t / pi of normals, t = N.H, integrates to 1 when the integral of 2 t Z dt
over [0, 1] is 1 and the mean of A over the azimuth is 1, that is, when A(w) / sqrt(1 - w^2) integrates to pi/2 over [0, 1].

Z meets the first condition. The second is printed (eq. 13) with the root as a factor, which not even A = 1 meets: it gives pi/4.
Nor does A of eq. 14 meet it, unless p = 1: its mean is sqrt(p) / agm(1, p) = (2/pi) sqrt(p) K(1 - p^2), which vanishes with p.
Its square, which is eq. 14 without the root, would meet it.
"""

from __future__ import annotations

from math import pi, sqrt

from albedo_lab.optics.frame import Direction
from albedo_lab.optics.maths import sincos2pi
from albedo_lab.optics.profiles import normal_from_slopes

SPECK = 1e-300
"""Stands in for the azimuth of a facet that lies flat, which has none: half-way between the axes."""


def Z(r: float, v: Direction) -> float:
    """r / (1 + r t^2 - t^2)^2, t = v.z/|v|; written so that 1 - t^2 is not taken from 1."""
    xy, zz = v.x * v.x + v.y * v.y, v.z * v.z
    k = (xy + zz) / (xy + r * zz)
    return r * k * k


def A(p: float, v: Direction) -> float:
    """sqrt(p / (p^2 - p^2 w^2 + w^2)), w^2 = v.x^2 / (v.x^2 + v.y^2): from 1/sqrt(p) across the scratch to sqrt(p) along it."""
    xx, yy = v.x * v.x + SPECK, v.y * v.y + SPECK
    return sqrt(p * (xx + yy) / (p * p * yy + xx))


def mean_of_A(p: float) -> float:
    """The mean of A over the azimuth, sqrt(p) over the arithmetic-geometric mean of 1 and p."""
    a, g = 1.0, p
    for _ in range(8):
        a, g = 0.5 * (a + g), sqrt(a * g)
    return sqrt(p) / a


def G(r: float, c: float) -> float:
    """c / (r - r c + c): the share of light at cosine c that is not obstructed."""
    return c / (r + (1.0 - r) * c)


def obstructed(r: float, c: float, c_: float) -> float:
    """1 - G(c) G(c'), for which nothing near 1 is taken from 1."""
    first, second = r + (1.0 - r) * c, r + (1.0 - r) * c_
    return (r * (1.0 - c) + c * r * (1.0 - c_) / second) / first


def slope_of_lobe(r: float, u: float) -> float:
    """The slope whose survival is r / (r + slope^2): that of normals with density Z t / pi."""
    return sqrt(r * (1.0 - u) / u)


def slope_of_hemisphere(u: float) -> float:
    """The slope of normals that are spread evenly over the hemisphere."""
    return sqrt((1.0 - u) * (1.0 + u)) / u


def normal_of_slope(slope: float, p: float, u: float) -> Direction:
    """A normal with that slope, its azimuth spread like that of points on an ellipse with axes as sqrt(p) to 1.

    A is then nowhere more than 2 pi times the density of the azimuth, and 2 pi times on both axes.
    """
    sp, cp = sincos2pi(u)
    x, y = sqrt(p) * cp, sp
    slope /= sqrt(x * x + y * y)
    return normal_from_slopes(slope * x, slope * y)


def azimuth_density(p: float, v: Direction) -> float:
    """Density of the azimuth of normal_of_slope."""
    xx, yy, k = v.x * v.x + SPECK, v.y * v.y + SPECK, sqrt(p)
    return k * (xx + yy) / (2.0 * pi * (p * yy + xx))
