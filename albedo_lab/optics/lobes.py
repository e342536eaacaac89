"""Sampling the cosine and its kin, a lobe about an axis and a cosine power of half-vectors, with their exact densities."""

from __future__ import annotations

from math import pi, sqrt

from albedo_lab.optics.frame import Direction, about_axis, cosine_power, length, normal_power
from albedo_lab.optics.maths import log, sincos2pi
from albedo_lab.optics.profiles import power_lobe


def sample_cosine(u1: float, u2: float) -> Direction:
    """A direction with density cos / pi about the normal."""
    s, (sp, cp) = sqrt(1.0 - u1), sincos2pi(u2)
    return Direction(s * cp, s * sp, sqrt(u1))


def sample_raised_cosine(A: float, b: float, u1: float, u2: float) -> Direction:
    """A direction with density (A z + b) / (pi (A + 2 b)): for what stays bright towards the horizon."""
    # the root of A z^2 + 2 b z = (A + 2 b) u1
    z = (A + 2.0 * b) * u1 / (b + sqrt(b * b + A * (A + 2.0 * b) * u1))
    return at_height(z, u2)


def raised_cosine_pdf(A: float, b: float, w: Direction) -> float:
    """Density of sample_raised_cosine."""
    return (A * w.z + b) / (pi * (A + 2.0 * b))


def sample_limb(mu: float, u1: float, u2: float) -> Direction:
    """A direction with density (1 + mu) z (z + 2 mu) / (2 pi (z + mu)^2), mu the cosine of the other direction.

    It follows z / (z + mu), which volumes scatter, within a factor of 2 for any mu, and its integral can be inverted: it is that
    of the derivative of z^2 / (z + mu).
    """
    u = u1 / (1.0 + mu)
    return at_height(0.5 * (u + sqrt(u * (u + 4.0 * mu))), u2)


def limb_pdf(mu: float, w: Direction) -> float:
    """Density of sample_limb."""
    both = w.z + mu
    return (1.0 + mu) * w.z * (w.z + 2.0 * mu) / (2.0 * pi * both * both)


def at_height(z: float, u2: float) -> Direction:
    """The direction of cosine z at an azimuth of u2 turns."""
    s, (sp, cp) = sqrt(max((1.0 - z) * (1.0 + z), 0.0)), sincos2pi(u2)
    return Direction(s * cp, s * sp, z)


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
