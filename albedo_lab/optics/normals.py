"""Distributions of microfacet normals: D, and the slope of normals drawn with density D cos.

Each D is a function of the bisector v = wi + wo, not normalised, through the slope of v: a width of 1e-4 at grazing light keeps
its digits. All are normalised, the integral of D cos over the hemisphere being 1. With z = cos^2 of the normal's angle, so that
D cos dw = pi D dz, the share of normals steeper than a slope x (the survival S) is, with 1 / z = 1 + x^2:

    blinn_phong           D = (n+2) / (2 pi) z^(n/2)                        S = z^((n+2)/2)
    beckmann              D = exp(-x^2 / m^2) / (pi m^2 z^2)                S = exp(-x^2 / m^2)
    ggx                   D = alpha^2 / (pi q^2)                            S = alpha^2 z / q
    trowbridge_reitz      D = (1 - alpha^2) / (pi L q)                      S = log(1/q) / L
    gtr                   D = g (1 - alpha^2) / (pi E q^gamma)              S = (q^-g - 1) / E

where q = alpha^2 z + 1 - z, L = log(1 / alpha^2), g = gamma - 1 and E = alpha^(-2 g) - 1. gtr is trowbridge_reitz for gamma = 1,
ggx for gamma = 2, and uniform, 1 / pi, for gamma = 0 and for alpha = 1. Both g and L tend to 0 there; what is written with
log(1/q), expm1 and log1p needs no case of its own. Half of the normals are steeper than alpha for ggx, than sqrt(alpha) for
trowbridge_reitz: its normals are spread evenly over the logarithm of the slope, from alpha to 1.
"""

from __future__ import annotations

from math import pi, sqrt
from typing import NamedTuple

from albedo_lab.optics.frame import Direction, normal_power
from albedo_lab.optics.maths import exp, expm1, log, log1p
from albedo_lab.optics.profiles import power_lobe

NIL = 1e-30
"""Stands for a g or an L of 0: expm1(g L) and log1p are exact down to there."""


class Tails(NamedTuple):
    """What gtr needs besides its parameters: L, g, E as above, and the constant of D."""

    L: float
    g: float
    E: float
    norm: float


def tails(alpha: float, gamma: float) -> Tails:
    """The constants of gtr."""
    L = max(-2.0 * log(alpha), NIL)
    g = gamma - 1.0 if abs(gamma - 1.0) > NIL else NIL
    E = expm1(g * L)
    return Tails(L, g, E, -g * expm1(-L) / (pi * E))


def blinn_phong(n: float, v: Direction) -> float:
    """(n+2) / (2 pi) cos^n (nuaj_models, Specularity)."""
    return (n + 2.0) / (2.0 * pi) * normal_power(v, n)


def beckmann(m: float, v: Direction) -> float:
    """exp(-tan^2 / m^2) / (pi m^2 cos^4) (nuaj_models, schlick1993 eq. 6); m^2 is the mean of the squared slope."""
    x, y = v.x / (m * v.z), v.y / (m * v.z)
    xx = x * x + y * y
    k = 1.0 + m * m * xx
    return exp(-xx) * k * k / (pi * m * m)


def beckmann_elliptic(m_x: float, m_y: float, v: Direction) -> float:
    """exp(-(x / m_x)^2 - (y / m_y)^2) / (pi m_x m_y cos^4), x and y the slopes of the normal (Heitz 2014)."""
    x, y = v.x / v.z, v.y / v.z
    k = 1.0 + x * x + y * y
    x, y = x / m_x, y / m_y
    return exp(-x * x - y * y) * k * k / (pi * m_x * m_y)


def ggx(alpha: float, v: Direction) -> float:
    """alpha^2 / (pi (alpha^2 cos^2 + sin^2)^2) (nuaj_models with gamma = 2)."""
    xy, zz = v.x * v.x + v.y * v.y, v.z * v.z
    k = alpha * (xy + zz) / (xy + alpha * alpha * zz)
    return k * k / pi


def ggx_elliptic(alpha_x: float, alpha_y: float, v: Direction) -> float:
    """1 / (pi alpha_x alpha_y ((h.x / alpha_x)^2 + (h.y / alpha_y)^2 + h.z^2)^2), h = v/|v| (Heitz 2014)."""
    x, y, zz = v.x / alpha_x, v.y / alpha_y, v.z * v.z
    k = (v.x * v.x + v.y * v.y + zz) / (x * x + y * y + zz)
    return k * k / (pi * alpha_x * alpha_y)


def log_inverse_q(alpha: float, v: Direction) -> float:
    """log(1 / (alpha^2 cos^2 + sin^2))."""
    xy, zz = v.x * v.x + v.y * v.y, v.z * v.z
    return log1p((1.0 - alpha) * (1.0 + alpha) * zz / (xy + alpha * alpha * zz))


def gtr(alpha: float, gamma: float, norm: float, v: Direction) -> float:
    """norm / (alpha^2 cos^2 + sin^2)^gamma (nuaj_models)."""
    return norm * exp(gamma * log_inverse_q(alpha, v))


def blinn_phong_slope(n: float, u: float) -> float:
    """The slope whose survival is u, as in the functions below."""
    s, c = power_lobe(log(u), n + 1.0)
    return s / c


def beckmann_slope(m: float, u: float) -> float:
    """x^2 = -m^2 log u."""
    return m * sqrt(-log(u))


def ggx_slope(alpha: float, u: float) -> float:
    """x^2 = alpha^2 (1 - u) / u."""
    return alpha * sqrt((1.0 - u) / u)


def gtr_slope(L: float, g: float, E: float, u: float) -> float:
    """x^2 = (1 - alpha^2 / q) / (1 / q - 1), with q^-g = 1 + u E."""
    inverse_q = min(log1p(u * E) / g, L)
    return sqrt(-expm1(inverse_q - L) / expm1(inverse_q))


def gtr_median(L: float, g: float, E: float) -> float:
    """Half of the normals are steeper."""
    return gtr_slope(L, g, E, 0.5)
