"""Radial profiles of lobes and of microfacet normals: how samples spread about an axis, and in which variable that is smooth.

A direction about an axis is written by its slope, the tangent rho of its angle. A profile gives rho from the logarithm of the
survival (the share of samples farther out): samplers feed it log(u), quadrature feeds it -y^2, so one formula serves both.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from math import asinh, atan, pi, sqrt

from albedo_lab.optics.frame import Direction
from albedo_lab.optics.maths import exp, expm1, log1p, sincos2pi


def power_lobe(log_survival: float, n: float) -> tuple[float, float]:
    """Sine and cosine of the angle whose density per solid angle is (n+1)/(2 pi) cos^n (neumann1999 eq. 20).

    The survival is cos^(n+1); 1 - cos comes from expm1, so that n = 1e8 loses no digits.
    """
    below = expm1(log_survival / (n + 1.0))
    return sqrt(-below * (2.0 + below)), 1.0 + below


def normal_from_slopes(x: float, y: float) -> Direction:
    """The microfacet normal with slopes x and y (tangents of its angle along both axes)."""
    cosine = 1.0 / sqrt(1.0 + x * x + y * y)
    return Direction(x * cosine, y * cosine, cosine)


@dataclass(frozen=True)
class Profile:
    """A radial coordinate y in [0, end] in which a family of lobes is smooth, whatever its width.

    `slope(y, n)` returns rho and rho * drho/dy; `coordinate(rho, n)` is its inverse. What lies beyond `end` is
    below e^-49 of the lobe, or empty.
    """

    slope: Callable[[float, float], tuple[float, float]]
    coordinate: Callable[[float, float], float]
    end: float


def power_slope(y: float, n: float) -> tuple[float, float]:
    """cos^(n+1) = exp(-y^2)."""
    s, _ = power_lobe(-y * y, n)
    c = exp(-y * y / (n + 1.0))  # 1 + expm1 would be 0 at the far end of a wide lobe
    return s / c, 2.0 * y / ((n + 1.0) * c * c)


def power_coordinate(rho: float, n: float) -> float:
    """Inverse of power_slope."""
    return sqrt(0.5 * (n + 1.0) * log1p(rho * rho))


def gauss_slope(y: float, n: float) -> tuple[float, float]:
    """Slopes of a Gaussian surface, in units of m."""
    return y, y


def gauss_coordinate(rho: float, n: float) -> float:
    """Inverse of gauss_slope."""
    return rho


def tangent_slope(y: float, n: float) -> tuple[float, float]:
    """rho = tan y: for wide survivals 1/(1 + rho^2), and for the plain polar angle."""
    s, c = sincos2pi(y / (2.0 * pi))
    rho = s / c
    return rho, rho * (1.0 + rho * rho)


def tangent_coordinate(rho: float, n: float) -> float:
    """Inverse of tangent_slope."""
    return atan(rho)


def tail_slope(y: float, n: float) -> tuple[float, float]:
    """rho = sinh y: a survival 1/(1 + rho^2) falls like exp(-2 y), each decade of slopes as long as any other.

    Half of such slopes exceed the width, and the tail goes on to slopes of mu and of 1, where the horizon and the masking of the
    light leave their marks. The arctangent folds these into its last bit: with it the bounds of quadrature were up to three times
    too small, in 23 of 1056 albedos of ggx from alpha = 1e-5 to 1.
    """
    e = expm1(y)
    s, c = 0.5 * (e + e / (1.0 + e)), 0.5 * (1.0 + e + 1.0 / (1.0 + e))
    return s, s * c


def tail_coordinate(rho: float, n: float) -> float:
    """Inverse of tail_slope."""
    return asinh(rho)


POWER = Profile(power_slope, power_coordinate, 7.0)
GAUSS = Profile(gauss_slope, gauss_coordinate, 7.0)
TANGENT = Profile(tangent_slope, tangent_coordinate, 0.5 * pi)
TAIL = Profile(tail_slope, tail_coordinate, 26.0)
