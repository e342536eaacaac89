"""Schlick's isotropic model (neumann1999 eq. 36)."""

from __future__ import annotations

import math

import pytest
from scipy.integrate import quad

from albedo_lab.models.schlick_isotropic import MODEL, Schlick, evaluate
from albedo_lab.optics.frame import mirror_of
from tests.models import trial

FACTORS = (1e-3, 0.1, 0.5, 1.0)
every_factor = pytest.mark.parametrize("r", FACTORS)


@every_factor
def test_formula(r: float) -> None:
    def printed(light: float, viewer: float, turn: float) -> float:
        zenith = r / (1 - (1 - r) * trial.half_cosine(light, viewer, turn) ** 2) ** 2
        return zenith / (4 * math.pi * (r + (1 - r) * math.cos(light)) * (r + (1 - r) * math.cos(viewer)))

    trial.assert_formula(MODEL, Schlick(r), printed)


def test_reciprocal() -> None:
    trial.assert_reciprocal(MODEL, *map(Schlick, FACTORS))


@pytest.mark.parametrize("mu", trial.GRAZING)
def test_the_roughest_is_a_quarter_of_white(mu: float) -> None:
    """r = 1 leaves 1 / (4 pi)."""
    for wi, wo in trial.random_pairs():
        assert math.isclose(evaluate(Schlick(1.0), wi, wo), 1 / (4 * math.pi), rel_tol=1e-12)
    trial.assert_close(trial.wide_albedo(MODEL, Schlick(1.0), mu), 0.25, 1e-7)


@pytest.mark.parametrize("r", [0.03, 0.1, 0.5, 1.0])
def test_normal_incidence(r: float) -> None:
    """2 cos^2(delta) = 1 + c there: 2 r times the integral of c / ((1+r - (1-r) c)^2 (r + (1-r) c))."""

    def integrand(c: float) -> float:
        return 2 * r * c / ((1 + r - (1 - r) * c) ** 2 * (r + (1 - r) * c))

    trial.assert_close(trial.wide_albedo(MODEL, Schlick(r), 1.0), quad(integrand, 0.0, 1.0)[0])


@pytest.mark.parametrize("mu", [1.0, 0.5, 0.1])
def test_the_smoothest_is_a_mirror_with_its_own_constant(mu: float) -> None:
    """Z is normalised, the reflection stretches 4 mu times, and mu^2 of the shadowing cancels: 1, less a tail of order r."""
    trial.assert_close(trial.narrow_albedo(MODEL, Schlick(1e-6), mu), 1.0)


@every_factor
def test_the_mirror_direction(r: float) -> None:
    for _, wo in trial.random_pairs():
        peak = 1 / (4 * math.pi * r * (r + (1 - r) * wo.z) ** 2)
        assert math.isclose(evaluate(Schlick(r), mirror_of(wo), wo), peak, rel_tol=1e-12)
