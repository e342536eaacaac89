"""Plus-Phong (neumann1999 section 2.2)."""

from __future__ import annotations

import math

import pytest

from albedo_lab.models.plus_phong import MODEL, Phong, evaluate, largest_constant
from albedo_lab.models.stretched_phong import MODEL as STRETCHED
from tests.models import trial

EXPONENTS = (0.0, 1.0, 2.5, 20.0)
every_exponent = pytest.mark.parametrize("n", EXPONENTS)


@every_exponent
def test_formula(n: float) -> None:
    def printed(light: float, viewer: float, turn: float) -> float:
        return trial.mirror_lobe(light, viewer, turn, n) * 2.0 / (math.cos(light) + math.cos(viewer))

    trial.assert_formula(MODEL, Phong(n), printed)


def test_reciprocal() -> None:
    trial.assert_reciprocal(MODEL, *map(Phong, EXPONENTS))


@every_exponent
def test_between_stretched_phong_and_twice_that(n: float) -> None:
    """max(a, b) <= a + b <= 2 max(a, b)."""
    stretched, p = STRETCHED.evaluate, Phong(n)
    trial.assert_between(
        lambda wi, wo: stretched(p, wi, wo),
        lambda wi, wo: evaluate(p, wi, wo),
        lambda wi, wo: 2 * stretched(p, wi, wo),
    )


def test_normal_incidence() -> None:
    """4 pi times the integral of c^(n+1) / (1+c) dc."""
    trial.assert_close(trial.narrow_albedo(MODEL, Phong(0.0), 1.0), 4 * math.pi * (1 - math.log(2)))
    trial.assert_close(trial.narrow_albedo(MODEL, Phong(1.0), 1.0), 4 * math.pi * (math.log(2) - 0.5))


@every_exponent
def test_grazing_limit(n: float) -> None:
    """Twice the stretched Phong's, for the viewer's cosine no longer counts."""
    trial.assert_close(trial.narrow_albedo(MODEL, Phong(n), 1e-9), 2 * math.pi / (n + 1))


@pytest.mark.parametrize("mu", [1.0, 0.5, 0.1])
def test_a_sharp_lobe_is_a_mirror(mu: float) -> None:
    p = Phong(1e8)
    trial.assert_close(largest_constant(p) * trial.narrow_albedo(MODEL, p, mu), 1.0, 1e-3)
