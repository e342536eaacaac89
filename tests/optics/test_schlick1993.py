"""The factors of schlick1993, and the conditions that they are to meet (eq. 13): as printed, and as energy balance asks."""

from __future__ import annotations

import math
from collections.abc import Callable
from itertools import pairwise

import mpmath  # type: ignore[import-untyped]
import pytest
from scipy.integrate import quad
from scipy.special import ellipkm1

from albedo_lab.optics.frame import Direction
from albedo_lab.optics.schlick1993 import (
    A,
    G,
    Z,
    azimuth_density,
    mean_of_A,
    normal_of_slope,
    obstructed,
    slope_of_hemisphere,
    slope_of_lobe,
)

HALF_PI = 0.5 * math.pi
FACTORS = (1e-6, 1e-3, 0.1, 0.5, 1.0)
ISOTROPIES = (1e-3, 0.05, 0.3, 0.999, 1.0)
every_r = pytest.mark.parametrize("r", FACTORS)
every_p = pytest.mark.parametrize("p", ISOTROPIES)


def flat(phi: float) -> Direction:
    """A facet's normal at that azimuth, of any length and tilt."""
    return Direction(3.0 * math.cos(phi), 3.0 * math.sin(phi), 0.7)


def printed_A(p: float, w: float) -> float:
    return math.sqrt(p / (p**2 - p**2 * w**2 + w**2))


def over_azimuth(p: float, g: Callable[[float], float]) -> float:
    """The integral over a quarter turn, in pieces that grow from the width p of A's peak."""
    edges = [HALF_PI - d for d in (HALF_PI, 0.5, 0.1, 0.01, 0.001, 0.0)]
    return sum(quad(g, a, b, epsrel=1e-11, epsabs=0.0)[0] for a, b in pairwise(edges))


@every_r
@pytest.mark.parametrize("tilt", [0.0, 1e-4, 0.3, 1.2, 1.5])
def test_Z(r: float, tilt: float) -> None:
    """r / (1 + r t^2 - t^2)^2 at 40 digits, since 1 - t^2 would lose them all."""
    with mpmath.workdps(40):
        t = mpmath.cos(mpmath.mpf(tilt))
        expected = float(r / (1 + r * t**2 - t**2) ** 2)
    assert math.isclose(Z(r, Direction(2.0 * math.sin(tilt), 0.0, 2.0 * math.cos(tilt))), expected, rel_tol=1e-12)


@every_r
def test_Z_meets_its_condition(r: float) -> None:
    """2 t Z dt = ds r / (1 - (1-r) s)^2 with s = t^2; and with x = tan^2, 1 - s = x / (1 + x), a survival r / (r + x)."""

    def integrand(log_x: float) -> float:
        x = math.exp(log_x)
        return Z(r, Direction(math.sqrt(x), 0.0, 1.0)) * x / (1.0 + x) ** 2

    pieces = [(k, k + 5.0) for k in range(-45, 40, 5)]
    assert math.isclose(sum(quad(integrand, a, b, epsrel=1e-10)[0] for a, b in pieces), 1.0, rel_tol=1e-9)


@every_p
@pytest.mark.parametrize("phi", [0.0, 0.4, 1.5, HALF_PI, 3.0, -2.0])
def test_A(p: float, phi: float) -> None:
    """Of both signs of w alike; the cosine of a right angle is off by 1e-16, which p = 1e-3 makes 1e-13."""
    assert math.isclose(A(p, flat(phi)), printed_A(p, math.cos(phi)), rel_tol=1e-10)


@every_p
def test_A_is_large_across_the_scratch(p: float) -> None:
    """p is the ratio of the slopes along it (azimuth 0) to those across."""
    assert math.isclose(A(p, Direction(1.0, 0.0, 1.0)), math.sqrt(p), rel_tol=1e-12)
    assert math.isclose(A(p, Direction(0.0, 1.0, 1.0)), 1.0 / math.sqrt(p), rel_tol=1e-12)


@every_p
def test_A_is_finite_where_there_is_no_azimuth(p: float) -> None:
    assert math.isclose(A(p, Direction(0.0, 0.0, 2.0)), math.sqrt(2.0 * p / (1.0 + p * p)), rel_tol=1e-12)


@every_p
def test_the_mean_of_A(p: float) -> None:
    """The integral of A(w) / sqrt(1 - w^2) is that of A(cos phi) over a quarter turn: sqrt(p) K, of parameter 1 - p^2."""
    integral = over_azimuth(p, lambda phi: A(p, flat(phi)))
    assert math.isclose(integral, math.sqrt(p) * ellipkm1(p * p), rel_tol=1e-9)
    assert math.isclose(mean_of_A(p), integral / HALF_PI, rel_tol=1e-9)


def test_A_meets_the_condition_only_where_it_is_1() -> None:
    assert mean_of_A(1.0) == 1.0
    assert [round(mean_of_A(p), 3) for p in (0.5, 0.1, 0.01, 0.001)] == [0.971, 0.744, 0.381, 0.167]


@every_p
def test_without_its_root_A_would_meet_the_condition(p: float) -> None:
    assert math.isclose(over_azimuth(p, lambda phi: A(p, flat(phi)) ** 2), HALF_PI, rel_tol=1e-9)


def test_the_condition_as_printed_is_not_even_met_by_1() -> None:
    """With the root as a factor, sqrt(1 - w^2) A(w) dw, A = 1 gives a quarter of a circle; and no p gives pi/2 = 1.57."""
    assert math.isclose(quad(lambda w: math.sqrt(1.0 - w * w) * printed_A(1.0, w), 0.0, 1.0)[0], math.pi / 4.0, rel_tol=1e-9)

    def as_printed(p: float) -> float:
        return over_azimuth(p, lambda phi: math.sin(phi) ** 2 * A(p, flat(phi)))

    assert max(map(as_printed, (0.001, 0.03, 0.1, 0.2, 0.3, 0.6))) < 0.95


def test_G() -> None:
    """r = 0 obstructs nothing, and of r = 1 the cosine is left."""
    assert G(0.0, 0.3) == 1.0
    assert G(1.0, 0.3) == 0.3
    assert math.isclose(G(0.2, 0.3), 0.3 / (0.2 - 0.2 * 0.3 + 0.3), rel_tol=1e-15)


@every_r
def test_the_obstructed_share_keeps_its_digits(r: float) -> None:
    for v, v_ in ((1.0, 1.0), (1.0, 0.4), (0.3, 0.7), (1e-7, 0.5), (1e-9, 1e-9)):
        with mpmath.workdps(40):
            a, b, c = mpmath.mpf(v), mpmath.mpf(v_), mpmath.mpf(r)
            expected = float(1 - a / (c - c * a + a) * (b / (c - c * b + b)))
        assert math.isclose(obstructed(r, v, v_), expected, rel_tol=1e-12)


@every_r
def test_slopes_have_the_survival_of_Z(r: float) -> None:
    for u in (1e-9, 0.2, 0.999):
        assert math.isclose(r / (r + slope_of_lobe(r, u) ** 2), u, rel_tol=1e-12)


def test_evenly_spread_normals_have_evenly_spread_cosines() -> None:
    for u in (1e-9, 0.2, 0.999):
        assert math.isclose(math.cos(math.atan(slope_of_hemisphere(u))), u, rel_tol=1e-12, abs_tol=1e-16)


@every_p
def test_azimuths_follow_their_density(p: float) -> None:
    """The integral of the density up to the azimuth of u is u, in all four quadrants; and the slope is what was asked for."""

    def density(phi: float) -> float:
        return azimuth_density(p, flat(phi))

    for quadrant in range(4):
        for part in (0.1, 0.5, 0.97):
            h = normal_of_slope(0.3, p, 0.25 * (quadrant + part))
            assert math.isclose(math.hypot(h.x, h.y) / h.z, 0.3, rel_tol=1e-12)
            assert math.isclose(math.hypot(h.x, h.y, h.z), 1.0, rel_tol=1e-12)
            start = quadrant * HALF_PI
            phi = math.atan2(h.y, h.x) % (2.0 * math.pi)
            assert start < phi < start + HALF_PI
            share = quad(density, start, phi, epsrel=1e-10, epsabs=0.0)[0]
            assert math.isclose(share, 0.25 * part, rel_tol=1e-8)


@every_p
def test_the_azimuth_density_keeps_up_with_A(p: float) -> None:
    """As the sampler's bound on its weights wants it: A is at most 2 pi times the density, and as much on the axes."""
    ratios = [
        A(p, flat(phi)) / (2.0 * math.pi * azimuth_density(p, flat(phi))) for phi in (0.0, 1e-3, 0.03, 0.3, 1.0, 1.5, HALF_PI)
    ]
    assert max(ratios) < 1.0 + 1e-9
    assert min(ratios) > 2.0 * math.sqrt(p) / (1.0 + p) * (1.0 - 1e-9)
    assert math.isclose(ratios[0], 1.0, rel_tol=1e-12)
    assert math.isclose(ratios[-1], 1.0, rel_tol=1e-12)
