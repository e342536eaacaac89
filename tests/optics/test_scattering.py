"""The series over the orders of scattering, against high precision and against what it sums up to."""

from __future__ import annotations

import math
from itertools import pairwise

import mpmath
import pytest
from scipy.integrate import quad
from scipy.special import j0

from albedo_lab.optics.scattering import ASYMPTOTIC, DIRECT, lambert_w, scattering_orders


@pytest.mark.parametrize("exponent", [*range(-300, 301, 25), *range(-10, 11)])
def test_lambert_w(exponent: int) -> None:
    for factor in (1.0, 2.7, 6.3):
        z = factor * 10.0**exponent
        assert math.isclose(lambert_w(z), float(mpmath.lambertw(z).real), rel_tol=1e-15)


def test_lambert_w_at_zero() -> None:
    assert lambert_w(0.0) == 0.0


def by_definition(g: float, x: float) -> mpmath.mpf:
    """The terms within 16 deviations of the largest; where these are many, the trapezoidal rule for their integral.

    40 digits, and a step of 1/2.2 deviations, whose error is exp(-2 pi^2 2.2^2) = 3e-42 of a Gaussian.
    """
    with mpmath.workdps(40):
        gg, xx = mpmath.mpf(g), mpmath.mpf(x)
        w = mpmath.lambertw(2 * xx / gg**2).real / 2
        middle = gg * mpmath.exp(w)
        deviation = mpmath.sqrt(middle / (1 + 2 * w))

        def term(m: mpmath.mpf) -> mpmath.mpf:
            return mpmath.exp(-gg + (m - 1) * mpmath.log(gg) - mpmath.loggamma(m + 1) - mpmath.log(m) - xx / m)

        first, last = int(max(1, middle - 16 * deviation - 5)), int(middle + 20 * deviation + 40)
        if last - first < 1500:
            return mpmath.fsum(term(mpmath.mpf(m)) for m in range(first, last + 1))
        step = deviation / mpmath.mpf(2.2)
        return step * mpmath.fsum(term(middle + k * step) for k in range(-36, 37))


SEAMS = (0.98 * DIRECT, 1.02 * DIRECT, 0.98 * ASYMPTOTIC, 1.02 * ASYMPTOTIC)


@pytest.mark.parametrize("g", [1e-50, 1e-12, 1e-3, 0.1, 1.0, 6.3, 30.0, *SEAMS, 150.0, 1e4, 1e9, 1e13])
def test_against_high_precision(g: float) -> None:
    """From the middle of the lobe to where nothing is left of it: the logarithm falls by 1e-3 to 690."""
    seen = 0
    for depth in (0.0, 1e-3, 0.3, 3.0, 12.0, 40.0, 150.0, 400.0, 650.0):
        # for large g the value falls like exp(-x/g), for small g like exp(-2 sqrt(x log 1/g)) or faster
        x = depth * (1.0 + g) if g > 1.0 else depth * (1.0 + 0.25 * depth / (1.0 - math.log(g)))
        expected = by_definition(g, x)
        if expected > 1e-280:
            seen += 1
            assert abs(scattering_orders(g, x) / expected - 1) < 1e-11
        else:
            assert scattering_orders(g, x) < 1e-279
    assert seen >= 7


@pytest.mark.parametrize(("g", "order"), [(1e-8, 15.0), (1e-3, 35.0), (0.05, 45.0), (17.9, 42.86), (30.0, 60.0), (1e3, 1100.0)])
def test_far_above_the_order_that_roughness_alone_prefers(g: float, order: float) -> None:
    x = order * order * math.log(order / g)
    assert abs(scattering_orders(g, x) / by_definition(g, x) - 1) < 1e-10


@pytest.mark.parametrize("g", [1e-3, 1.0, 20.0, 39.9, 40.1, 300.0])
def test_in_the_mirror_direction(g: float) -> None:
    """The sum of g^m / (m! m) is Ei(g) - log g - Euler's constant."""
    with mpmath.workdps(30):
        expected = mpmath.exp(-g) * (mpmath.ei(g) - mpmath.log(g) - mpmath.euler) / g
    assert math.isclose(scattering_orders(g, 0.0), float(expected), rel_tol=1e-11)


EDGES = (0.0, 0.5, 2.0, 6.0, 15.0, 40.0, 100.0)


@pytest.mark.parametrize("g", [0.01, 1.0, 6.0, 50.0, 1e3, 1e8])
def test_all_directions_together(g: float) -> None:
    """exp(-x/m) integrates to m, and the Poisson law without m = 0 to 1 - e^-g."""
    scale = 1.0 + g
    pieces = [quad(lambda x: scattering_orders(g, x), a * scale, b * scale, epsabs=0.0)[0] for a, b in pairwise(EDGES)]
    total = g * math.fsum(pieces)
    assert math.isclose(total, -math.expm1(-g), rel_tol=1e-9)


@pytest.mark.parametrize("g", [0.1, 2.0, 60.0])
@pytest.mark.parametrize("x", [0.0, 0.5, 4.0])
def test_is_the_spectrum_of_the_phase(g: float, x: float) -> None:
    """Where the series comes from: the Hankel transform of exp(-g (1 - C(r))) - exp(-g), C = exp(-r^2)."""

    def integrand(r: float) -> float:
        return 2.0 * r * float(j0(2.0 * math.sqrt(x) * r)) * math.exp(-g) * math.expm1(g * math.exp(-r * r))

    expected = quad(integrand, 0.0, 7.0, limit=200, epsabs=1e-14)[0] / g
    assert math.isclose(scattering_orders(g, x), expected, rel_tol=1e-9, abs_tol=1e-13)


def test_extremes_stay_between_0_and_1_and_fall_with_x() -> None:
    for g in (0.0, 1e-300, 1e-100, 1e-30, 1e-8, 1.0, 39.0, 41.0, 1e5, 1e8, 1e15):
        values = [scattering_orders(g, x) for x in (0.0, *(10.0**k for k in range(-8, 16)))]
        assert all(0.0 <= v <= 1.0 for v in values)
        assert all(b <= a * (1 + 2e-11) for a, b in pairwise(values))
        assert values[-1] == 0.0 or g > 1e12


def test_no_roughness_leaves_the_first_order() -> None:
    for x in (0.0, 1.0, 100.0):
        assert math.isclose(scattering_orders(0.0, x), math.exp(-x), rel_tol=1e-14)
        assert math.isclose(scattering_orders(1e-60, x), math.exp(-x), rel_tol=1e-14)
