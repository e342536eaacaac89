"""Blinn (neumann1999 eq. 31)."""

from __future__ import annotations

import math

import pytest

from albedo_lab.models.blinn import MODEL, Blinn, evaluate
from tests.models import trial

EXPONENTS = (0.0, 1.0, 2.5, 20.0)
every_exponent = pytest.mark.parametrize("n", EXPONENTS)


@every_exponent
def test_formula(n: float) -> None:
    def printed(light: float, viewer: float, turn: float) -> float:
        return trial.half_cosine(light, viewer, turn) ** n

    trial.assert_formula(MODEL, Blinn(n), printed)


def test_reciprocal() -> None:
    trial.assert_reciprocal(MODEL, *map(Blinn, EXPONENTS))


@every_exponent
def test_normal_incidence(n: float) -> None:
    """With x = cos(theta/2), c = 2 x^2 - 1 and dc = 4 x dx: 8 pi times the integral of x^(n+1) (2 x^2 - 1) from sqrt(1/2)."""
    upper, lower = (1 - 2 ** (-(n + 4) / 2)) / (n + 4), (1 - 2 ** (-(n + 2) / 2)) / (n + 2)
    trial.assert_close(trial.narrow_albedo(MODEL, Blinn(n), 1.0), 8 * math.pi * (2 * upper - lower))


@pytest.mark.parametrize("mu", trial.GRAZING)
def test_exponent_zero_is_diffuse(mu: float) -> None:
    trial.assert_close(trial.wide_albedo(MODEL, Blinn(0.0), mu), math.pi, 1e-7)


def test_exponent_two_in_the_limit_of_grazing_light() -> None:
    """(N.H)^2 z = z^3 / (2 (1 + x)), x along the light's horizontal: half of sqrt(1-x^2) (1-x) dx times cos^3 psi dpsi."""
    trial.assert_close(trial.wide_albedo(MODEL, Blinn(2.0), 1e-9), math.pi / 3)


@pytest.mark.parametrize("mu", [0.9, 0.5, 0.1])
def test_a_sharp_lobe_darkens_like_the_square_of_the_cosine(mu: float) -> None:
    """The reflection stretches solid angles 4 mu times, and the light's cosine is mu."""
    albedo = trial.narrow_albedo(MODEL, Blinn(1e8), mu)
    trial.assert_close(albedo, 2 * math.pi / (1e8 + 1) * 4 * mu * mu)


def test_not_more_than_one() -> None:
    for wi, wo in trial.random_pairs():
        assert 0.0 <= evaluate(Blinn(20.0), wi, wo) <= 1.0
