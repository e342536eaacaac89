"""Minnaert: his own law, and the one that losasso prints under his name."""

from __future__ import annotations

import math

import mpmath
import pytest

from albedo_lab.models.lambert import MODEL as LAMBERT
from albedo_lab.models.minnaert import MODEL, Minnaert, make
from tests.models import trial

PRINTED = make(as_printed="yes")
EXPONENTS = (0.0, 0.5, 1.0, 3.0, 10.0)
PRINTED_EXPONENTS = (0.0, 0.3, 0.5, 1.0)
every_exponent = pytest.mark.parametrize("k", EXPONENTS)
every_printed_exponent = pytest.mark.parametrize("k", PRINTED_EXPONENTS)


@every_exponent
def test_formula(k: float) -> None:
    """The radiance (N.L)^k (N.V)^(k-1) under an irradiance pi N.L."""

    def law(light: float, viewer: float, turn: float) -> float:
        return math.cos(light) ** k * math.cos(viewer) ** (k - 1) / (math.pi * math.cos(light))

    trial.assert_formula(MODEL, Minnaert(k), law)


@every_printed_exponent
def test_printed_formula(k: float) -> None:
    """N.L (N.L)^k (1 - N.E)^(1-k) where Lambert's law is N.L."""

    def printed(light: float, viewer: float, turn: float) -> float:
        n_l, n_e = math.cos(light), math.cos(viewer)
        return n_l * n_l**k * (1 - n_e) ** (1 - k) / (math.pi * n_l)

    trial.assert_formula(PRINTED, Minnaert(k), printed)


@pytest.mark.parametrize("tilt", [1e-3, 1e-7, 1e-30])
def test_the_printed_law_keeps_its_digits_near_the_normal(tilt: float) -> None:
    """1 - N.E is tilt^2 / 2, which 1 - cos would round away."""
    f = PRINTED.evaluate(Minnaert(0.3), trial.at(0.5), trial.direction(tilt))
    with mpmath.workdps(80):
        expected = 0.5**0.3 * float((1 - mpmath.cos(tilt)) ** mpmath.mpf(0.7)) / math.pi
    assert math.isclose(f, expected, rel_tol=1e-13)


def test_reciprocal() -> None:
    trial.assert_reciprocal(MODEL, *map(Minnaert, EXPONENTS))
    assert MODEL.reciprocal


@every_printed_exponent
def test_the_printed_law_is_not_reciprocal(k: float) -> None:
    assert not PRINTED.reciprocal
    with pytest.raises(AssertionError):
        trial.assert_reciprocal(PRINTED, Minnaert(k))


def test_exponent_one_is_lamberts_law_but_not_as_printed() -> None:
    white = LAMBERT.bind({"albedo": 1.0})
    for wi, wo in trial.random_pairs():
        f = LAMBERT.evaluate(white, wi, wo)
        assert math.isclose(MODEL.evaluate(Minnaert(1.0), wi, wo), f, rel_tol=1e-15)
        assert math.isclose(PRINTED.evaluate(Minnaert(1.0), wi, wo), f * wi.z, rel_tol=1e-15)


def test_the_printed_law_is_black_to_a_viewer_at_the_normal() -> None:
    """As losasso describes his pictures, for all k < 1; Minnaert's never is."""
    for wi, _ in trial.random_pairs():
        assert PRINTED.evaluate(Minnaert(0.5), wi, trial.at(1.0)) == 0.0
        assert MODEL.evaluate(Minnaert(0.5), wi, trial.at(1.0)) >= 1 / math.pi


def test_the_two_laws_share_neither_factor() -> None:
    """(N.E)^(k-1) in place of (1 - N.E)^(1-k) would not do: N.L is printed once too often."""
    k = 0.5
    for wi, wo in trial.random_pairs():
        repaired = PRINTED.evaluate(Minnaert(k), wi, wo) / (1 - wo.z) ** (1 - k) * wo.z ** (k - 1)
        assert math.isclose(repaired, MODEL.evaluate(Minnaert(k), wi, wo) * wi.z, rel_tol=1e-7)  # 1 - z, of a z near 1


# Albedos: powers integrate in closed form


@pytest.mark.parametrize("mu", [1.0, 0.3, 1e-6])
@every_exponent
def test_albedo(k: float, mu: float) -> None:
    """It diverges at grazing angles for k < 1."""
    trial.assert_close(trial.wide_albedo(MODEL, Minnaert(k), mu), 2 / (k + 1) * mu ** (k - 1), 1e-5)


@pytest.mark.parametrize("mu", [1.0, 0.3, 1e-6])
@every_printed_exponent
def test_printed_albedo_in_both_orders(k: float, mu: float) -> None:
    """2 / (k+2) (1-mu)^(1-k) for a fixed viewer, and mu^k times 2 B(2, 2-k) for a fixed light: both at most 1."""
    for_viewer, for_light = 2 / (k + 2) * (1 - mu) ** (1 - k), 2 * mu**k / ((2 - k) * (3 - k))
    trial.assert_close(trial.wide_albedo(PRINTED, Minnaert(k), mu, "wi"), for_viewer, 1e-5)
    trial.assert_close(trial.wide_albedo(PRINTED, Minnaert(k), mu, "wo"), for_light, 1e-5)
    assert max(for_viewer, for_light) <= 1.0


# Samplers


@pytest.mark.parametrize("mu", trial.GRAZING)
@every_exponent
def test_every_sample_weighs_the_albedo(k: float, mu: float) -> None:
    p, wo = Minnaert(k), trial.at(mu)
    for u1, u2 in ((2.0**-50, 0.1), (1e-9, 0.5), (0.3, 0.9), (1 - 2.0**-33, 0.0)):
        wi = MODEL.sample(p, wo, u1, u2)
        w = MODEL.evaluate(p, wi, wo) * wi.z / MODEL.pdf(p, wi, wo)
        assert math.isclose(w, 2 / (k + 1) * mu ** (k - 1), rel_tol=1e-12)


@every_printed_exponent
def test_printed_weights_are_at_most_one_in_both_orders(k: float) -> None:
    p = Minnaert(k)
    for u1 in (2.0**-50, 1e-9, 0.3, 1 - 2.0**-33):
        for mu in trial.GRAZING:
            fixed = trial.at(mu)
            moving = PRINTED.sample(p, fixed, u1, 0.3)
            share = moving.z / PRINTED.pdf(p, moving, fixed)
            assert 0 <= PRINTED.evaluate(p, moving, fixed) * share <= 1 + 1e-15
            assert 0 <= PRINTED.evaluate(p, fixed, moving) * share <= 1 + 1e-15


@pytest.mark.parametrize("k", [0.0, 2.5])
def test_samples_follow_the_density(k: float) -> None:
    trial.assert_normalised(MODEL, Minnaert(k), 0.5)
    trial.assert_follows_density(MODEL, Minnaert(k), 0.5, 3)


def test_printed_samples_follow_the_density() -> None:
    trial.assert_normalised(PRINTED, Minnaert(0.5), 0.5)
    trial.assert_follows_density(PRINTED, Minnaert(0.5), 0.5, 3)


def test_members_have_domains_of_their_own() -> None:
    assert MODEL is make(as_printed="no")
    assert MODEL.member({"as_printed": True, "k": 0.2}) == (PRINTED, {"k": 0.2})
    assert MODEL.parameters[0].high == 10.0
    assert PRINTED.parameters[0].high == 1.0
