"""Phong as first published, over the cosine of the light (neumann1999 section 2.2): not reciprocal."""

from __future__ import annotations

import math

import pytest

from albedo_lab.models.phong import MODEL as PHONG
from albedo_lab.models.phong_original import MODEL, Phong, evaluate
from tests.models import trial

EXPONENTS = (0.0, 1.0, 2.5, 20.0)
every_exponent = pytest.mark.parametrize("n", EXPONENTS)


@every_exponent
def test_formula(n: float) -> None:
    def printed(light: float, viewer: float, turn: float) -> float:
        return trial.mirror_lobe(light, viewer, turn, n) / math.cos(light)

    trial.assert_formula(MODEL, Phong(n), printed)


def test_not_reciprocal() -> None:
    with pytest.raises(AssertionError):
        trial.assert_reciprocal(MODEL, Phong(5.0))


@every_exponent
def test_reciprocal_once_the_cosine_of_the_light_is_given_back(n: float) -> None:
    for a, b in trial.random_pairs():
        forth, back = evaluate(Phong(n), a, b) * a.z, evaluate(Phong(n), b, a) * b.z
        assert math.isclose(forth, back, rel_tol=1e-12)


@every_exponent
def test_normal_incidence_in_both_orders(n: float) -> None:
    """For a fixed viewer the cosine of the light cancels; for a fixed light at the normal it is 1."""
    trial.assert_close(trial.wide_albedo(MODEL, Phong(n), 1.0, "wi"), 2 * math.pi / (n + 1))
    trial.assert_close(trial.wide_albedo(MODEL, Phong(n), 1.0, "wo"), 2 * math.pi / (n + 2))


@pytest.mark.parametrize("theta", [0.3, 1.0, 1.5])
def test_exponent_zero_is_the_lune_of_two_hemispheres(theta: float) -> None:
    """Directions that both the surface and the mirror direction see: a lune of solid angle 2 (pi - theta)."""
    trial.assert_close(trial.narrow_albedo(MODEL, Phong(0.0), math.cos(theta)), 2 * (math.pi - theta))


@pytest.mark.parametrize("mu", [0.9, 0.3])
def test_for_a_fixed_light_it_is_phong_over_the_cosine(mu: float) -> None:
    trial.assert_close(trial.wide_albedo(MODEL, Phong(3.0), mu, "wo"), trial.wide_albedo(PHONG, Phong(3.0), mu) / mu, 1e-12)


@every_exponent
def test_grazing_limit_for_a_fixed_viewer(n: float) -> None:
    """Half of the lobe."""
    trial.assert_close(trial.narrow_albedo(MODEL, Phong(n), 1e-9), math.pi / (n + 1))
