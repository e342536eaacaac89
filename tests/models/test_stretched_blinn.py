"""Stretched Blinn (neumann1999 eq. 32)."""

from __future__ import annotations

import math

import pytest

from albedo_lab.models.blinn import MODEL as BLINN
from albedo_lab.models.stretched_blinn import MODEL, Blinn, evaluate
from tests.models import trial

EXPONENTS = (0.0, 1.0, 2.5, 20.0)
every_exponent = pytest.mark.parametrize("n", EXPONENTS)


@every_exponent
def test_formula(n: float) -> None:
    def printed(light: float, viewer: float, turn: float) -> float:
        return trial.half_cosine(light, viewer, turn) ** n / trial.larger_cosine(light, viewer)

    trial.assert_formula(MODEL, Blinn(n), printed)


def test_reciprocal() -> None:
    trial.assert_reciprocal(MODEL, *map(Blinn, EXPONENTS))


@every_exponent
def test_normal_incidence_is_that_of_blinn(n: float) -> None:
    expected = trial.narrow_albedo(BLINN, Blinn(n), 1.0)
    trial.assert_close(trial.narrow_albedo(MODEL, Blinn(n), 1.0), expected, 1e-12)


@pytest.mark.parametrize("mu", [1.0, 0.7, 0.3, 1e-4])
def test_exponent_zero(mu: float) -> None:
    """2 pi times the integral of z / max(z, mu): mu/2 up to mu, 1 - mu above."""
    trial.assert_close(trial.wide_albedo(MODEL, Blinn(0.0), mu), math.pi * (2 - mu), 1e-7)


def test_exponent_two_in_the_limit_of_grazing_light() -> None:
    """(N.H)^2 = z^2 / (2 (1 + x)), x along the light's horizontal: 1/2 of (1-x) dx, which is 2, times cos^2 psi dpsi, pi/2."""
    trial.assert_close(trial.wide_albedo(MODEL, Blinn(2.0), 1e-9), math.pi / 2)


@pytest.mark.parametrize("mu", [0.9, 0.5, 0.1])
def test_a_sharp_lobe_darkens_like_the_cosine(mu: float) -> None:
    """And so is no mirror: its mean albedo tends to 2/3 where table 3 prints 1."""
    albedo = trial.narrow_albedo(MODEL, Blinn(1e8), mu)
    trial.assert_close(albedo, 2 * math.pi / (1e8 + 1) * 4 * mu, 1e-3)


@every_exponent
def test_at_least_blinn(n: float) -> None:
    for wi, wo in trial.random_pairs():
        assert evaluate(Blinn(n), wi, wo) >= BLINN.evaluate(Blinn(n), wi, wo)
