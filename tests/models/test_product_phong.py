"""Phong over the product of both cosines (neumann1999 section 2.2): rejected, for it diverges like 1/mu."""

from __future__ import annotations

import math

import pytest

from albedo_lab.models.product_phong import MODEL, Phong
from tests.models import trial

EXPONENTS = (0.0, 1.0, 2.5, 20.0)
every_exponent = pytest.mark.parametrize("n", EXPONENTS)


@every_exponent
def test_formula(n: float) -> None:
    def printed(light: float, viewer: float, turn: float) -> float:
        return trial.mirror_lobe(light, viewer, turn, n) / (math.cos(light) * math.cos(viewer))

    trial.assert_formula(MODEL, Phong(n), printed)


def test_reciprocal() -> None:
    trial.assert_reciprocal(MODEL, *map(Phong, EXPONENTS))


@every_exponent
def test_normal_incidence(n: float) -> None:
    trial.assert_close(trial.narrow_albedo(MODEL, Phong(n), 1.0), 2 * math.pi / (n + 1))


@pytest.mark.parametrize("theta", [0.3, 1.0, 1.5])
def test_exponent_zero_is_a_lune_over_the_cosine(theta: float) -> None:
    """The moving cosine cancels, and what is left is the part of the lobe above the surface: 2 (pi - theta) of it."""
    albedo = trial.narrow_albedo(MODEL, Phong(0.0), math.cos(theta))
    trial.assert_close(albedo, 2 * (math.pi - theta) / math.cos(theta))


@every_exponent
@pytest.mark.parametrize("mu", [1e-5, 1e-9])
def test_diverges_like_one_over_the_cosine(n: float, mu: float) -> None:
    trial.assert_close(mu * trial.narrow_albedo(MODEL, Phong(n), mu), math.pi / (n + 1), 1e-3)


def test_no_constant_conserves_energy() -> None:
    assert MODEL.paper_constant(Phong(5.0)) == 0.0
