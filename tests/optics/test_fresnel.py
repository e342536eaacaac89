"""Fresnel reflectance against the complex amplitudes of Snell's and Fresnel's laws, and at its landmarks."""

import math

import mpmath
import pytest
from hypothesis import given
from hypothesis import strategies as st

from albedo_lab.optics import fresnel

COSINES = (1.0, 0.9, 0.5, 0.1, 1e-3, 1e-9, 1e-12)
CONDUCTORS = [
    (0.05, 3.6),
    (0.43, 2.46),
    (0.79, 5.85),
    (1.47, 1.95),
    (2.4, 8.1),
    (0.01, 100.0),
    (100.0, 0.1),
    (1.0, 0.1),
    (1.5, 1e-6),
]
cosines = st.sampled_from(COSINES) | st.floats(-27.0, 0.0).map(math.exp)


def precise(eta: float, k: float, c: float) -> float:
    """Half |r_s|^2 + |r_p|^2, the amplitudes by Snell's law in complex numbers of 60 digits."""
    with mpmath.workdps(60):
        index, cosine = mpmath.mpc(eta, k), mpmath.mpf(c)
        inside = mpmath.sqrt(1 - (1 - cosine**2) / index**2)
        r_s = (cosine - index * inside) / (cosine + index * inside)
        r_p = (index * cosine - inside) / (index * cosine + inside)
        return float((abs(r_s) ** 2 + abs(r_p) ** 2) / 2)


@pytest.mark.parametrize(("eta", "k"), CONDUCTORS)
def test_conductors(eta: float, k: float) -> None:
    """1e-13 absolute and relative to what is not reflected: near F = 1 no formula in doubles has more than the former."""
    for c in COSINES:
        expected = precise(eta, k, c)
        assert math.isclose(fresnel.conductor(eta, k, c), expected, rel_tol=1e-11, abs_tol=1e-13), (c, expected)


@pytest.mark.parametrize("eta", [1.0003, 1.33, 1.5, 2.4, 10.0, 0.7])
def test_dielectrics(eta: float) -> None:
    for c in COSINES:
        expected = precise(eta, 0.0, c)
        # (eta - 1) enters the reflectance twice: a last bit of eta is 1e-13 of it at 1.0003
        assert math.isclose(fresnel.dielectric(eta, c), expected, rel_tol=1e-11, abs_tol=1e-15), (c, expected)


@given(st.floats(1.001, 100.0), cosines)
def test_a_conductor_that_does_not_absorb_is_a_dielectric(eta: float, c: float) -> None:
    assert fresnel.conductor(eta, 0.0, c) == pytest.approx(fresnel.dielectric(eta, c), rel=1e-7, abs=1e-13)


@given(st.floats(0.01, 100.0), st.floats(0.0, 100.0), cosines)
def test_neither_more_light_nor_less_than_none(eta: float, k: float, c: float) -> None:
    f = fresnel.conductor(eta, k, c)
    assert -1e-15 <= f <= 1.0 + 1e-14
    assert f == pytest.approx(precise(eta, k, c), rel=1e-6, abs=1e-12)  # a square root at the critical angle


def test_total_reflection() -> None:
    """From glass to air, beyond arcsin(1/1.5) = 41.8 degrees; just before it less than all."""
    critical = math.asin(1.0 / 1.5)
    assert fresnel.dielectric(1.0 / 1.5, math.cos(critical + 0.01)) == 1.0
    assert fresnel.dielectric(1.0 / 1.5, math.cos(critical - 0.01)) < 0.7
    assert fresnel.conductor(1.0 / 1.5, 0.0, math.cos(critical + 0.01)) == pytest.approx(1.0, abs=1e-12)


def test_brewster() -> None:
    """At tan(theta) = eta the parallel polarisation vanishes; half of sin^2(theta_i - theta_t) is left, their sum being 90."""
    for eta in (1.33, 1.5, 2.4):
        theta = math.atan(eta)
        expected = 0.5 * math.sin(2.0 * theta - math.pi / 2.0) ** 2
        assert fresnel.dielectric(eta, math.cos(theta)) == pytest.approx(expected, rel=1e-13)


def test_normal_incidence_and_grazing() -> None:
    """Glass reflects 4 %; at grazing angles F is 1 in the limit."""
    assert fresnel.normal_reflectance(1.5, 0.0) == pytest.approx(0.04, rel=1e-15)
    for eta, k in CONDUCTORS:
        assert fresnel.conductor(eta, k, 1.0) == pytest.approx(fresnel.normal_reflectance(eta, k), rel=1e-12, abs=1e-15)
        assert fresnel.conductor(eta, k, 1e-14) == pytest.approx(1.0, abs=1e-11)
    for eta in (1.33, 1.5, 2.4):
        # s loses 4c/g and p loses 4c eta^2/g of the light, g = sqrt(eta^2 - 1)
        lost = 2.0 * 1e-6 * (1.0 + eta * eta) / math.sqrt(eta * eta - 1.0)
        assert 1.0 - fresnel.dielectric(eta, 1e-6) == pytest.approx(lost, rel=1e-4)


def test_schlick_meets_both_ends_and_stays_near_glass() -> None:
    """His paper: within 1 % of full light for usual materials; 0.04 is glass."""
    assert fresnel.schlick(0.04, 1.0) == 0.04
    assert fresnel.schlick(0.04, 0.0) == 1.0
    assert fresnel.schlick(0.04, 0.5) == pytest.approx(0.04 + 0.96 / 32, rel=1e-15)
    assert fresnel.schlick(0.3, 1.0 + 1e-16) == 0.3  # a cosine above 1 by rounding
    worst = max(abs(fresnel.schlick(0.04, i / 100) - fresnel.dielectric(1.5, i / 100)) for i in range(1, 101))
    assert 0.01 < worst < 0.04
    assert fresnel.one(0.3) == 1.0
