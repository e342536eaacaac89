"""Sampling the cosine, a lobe about an axis and a cosine power of half-vectors; the last two with their exact densities."""

from __future__ import annotations

from math import pi, sqrt

from albedo_lab.optics.frame import Direction, about_axis, cosine_power, length, normal_power
from albedo_lab.optics.maths import log, sincos2pi
from albedo_lab.optics.profiles import power_lobe


def sample_cosine(u1: float, u2: float) -> Direction:
    """A direction with density cos / pi about the normal."""
    s, (sp, cp) = sqrt(1.0 - u1), sincos2pi(u2)
    return Direction(s * cp, s * sp, sqrt(u1))


def sample_lobe(axis: Direction, n: float, u1: float, u2: float) -> Direction:
    """A direction with density (n+1)/(2 pi) cos^n about the axis (neumann1999 eq. 20 to 22); it may lie below the horizon."""
    s, c = power_lobe(log(u1), n)
    return about_axis(axis, s, c, sincos2pi(u2))


def lobe_pdf(axis: Direction, w: Direction, n: float) -> float:
    """Density of sample_lobe (neumann1999 eq. 19)."""
    return (n + 1.0) / (2.0 * pi) * cosine_power(axis, w, n)


def sample_power_normal(n: float, u1: float, u2: float) -> Direction:
    """A microfacet normal with density (n+1)/(2 pi) cos^n about the surface normal."""
    s, c = power_lobe(log(u1), n)
    sp, cp = sincos2pi(u2)
    return Direction(s * cp, s * sp, c)


def power_normal_pdf(v: Direction, n: float) -> float:
    """Density per solid angle of wi reflected at sample_power_normal; v = wi + wo is 2 (wo.h) long, the Jacobian 4 (wo.h)."""
    return (n + 1.0) / (2.0 * pi) * normal_power(v, n) / (2.0 * length(v))
