"""Plus-Blinn (neumann1999 section 2.2)."""

from __future__ import annotations

import math

import pytest

from albedo_lab.models.plus_blinn import MODEL, Blinn, evaluate
from albedo_lab.models.stretched_blinn import MODEL as STRETCHED
from tests.models import trial

EXPONENTS = (0.0, 1.0, 2.5, 20.0)
every_exponent = pytest.mark.parametrize("n", EXPONENTS)


@every_exponent
def test_formula(n: float) -> None:
    def printed(light: float, viewer: float, turn: float) -> float:
        return trial.half_cosine(light, viewer, turn) ** n * 2.0 / (math.cos(light) + math.cos(viewer))

    trial.assert_formula(MODEL, Blinn(n), printed)


def test_reciprocal() -> None:
    trial.assert_reciprocal(MODEL, *map(Blinn, EXPONENTS))


@every_exponent
def test_between_stretched_blinn_and_twice_that(n: float) -> None:
    """max(a, b) <= a + b <= 2 max(a, b)."""
    stretched, p = STRETCHED.evaluate, Blinn(n)
    trial.assert_between(
        lambda wi, wo: stretched(p, wi, wo),
        lambda wi, wo: evaluate(p, wi, wo),
        lambda wi, wo: 2 * stretched(p, wi, wo),
    )


@pytest.mark.parametrize("n", [1.0, 2.5, 20.0])
def test_normal_incidence(n: float) -> None:
    """With x = cos(theta/2), f = x^(n-2): 8 pi times the integral of x^(n-1) (2 x^2 - 1) from 1/sqrt(2) to 1."""
    upper, lower = (1 - 2 ** (-(n + 2) / 2)) / (n + 2), (1 - 2 ** (-n / 2)) / n
    trial.assert_close(trial.narrow_albedo(MODEL, Blinn(n), 1.0), 8 * math.pi * (2 * upper - lower))


def test_exponent_two_is_diffuse_at_normal_incidence() -> None:
    for wi, _ in trial.random_pairs():
        assert math.isclose(evaluate(Blinn(2.0), wi, trial.at(1.0)), 1.0, rel_tol=1e-12)


def test_exponent_two_in_the_limit_of_grazing_light() -> None:
    """Twice the stretched Blinn's pi / 2."""
    trial.assert_close(trial.wide_albedo(MODEL, Blinn(2.0), 1e-9), math.pi)
