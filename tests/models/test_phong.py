"""Phong, reciprocal (neumann1999 eq. 5, 6)."""

from __future__ import annotations

import math

import pytest
from scipy.special import beta

from albedo_lab.models.phong import MODEL, Phong, largest_constant
from tests.models import trial

EXPONENTS = (0.0, 1.0, 2.5, 20.0)
every_exponent = pytest.mark.parametrize("n", EXPONENTS)


@every_exponent
def test_formula(n: float) -> None:
    def printed(light: float, viewer: float, turn: float) -> float:
        return trial.mirror_lobe(light, viewer, turn, n)

    trial.assert_formula(MODEL, Phong(n), printed)


def test_reciprocal() -> None:
    trial.assert_reciprocal(MODEL, *map(Phong, EXPONENTS))


@every_exponent
def test_normal_incidence(n: float) -> None:
    """2 pi times the integral of c^n c dc: ineq. 6 is an equation there."""
    albedo = trial.narrow_albedo(MODEL, Phong(n), 1.0)
    trial.assert_close(albedo, 2 * math.pi / (n + 2))
    trial.assert_close(largest_constant(Phong(n)) * albedo, 1.0)


@pytest.mark.parametrize("theta", [0.3, 1.0, 1.5])
def test_the_two_lowest_exponents_in_closed_form(theta: float) -> None:
    """n = 0 is half of each of two hemispheres' projections; n = 1 is the cosine kernel of diffuse shading."""
    trial.assert_close(trial.narrow_albedo(MODEL, Phong(0.0), math.cos(theta)), math.pi / 2 * (1 + math.cos(theta)))
    kernel = 2 / 3 * (math.sin(theta) + (math.pi - theta) * math.cos(theta))
    trial.assert_close(trial.narrow_albedo(MODEL, Phong(1.0), math.cos(theta)), kernel)


@pytest.mark.parametrize("mu", [0.9, 0.5, 0.1])
def test_a_sharp_lobe_darkens_like_the_cosine(mu: float) -> None:
    p = Phong(1e8)
    trial.assert_close(largest_constant(p) * trial.narrow_albedo(MODEL, p, mu), mu)


@pytest.mark.parametrize("n", [1.0, 20.0])
def test_grazing_limit(n: float) -> None:
    """Half a lobe whose axis lies in the surface: the integral of cos^n sin^2 dalpha cos(psi) dpsi is B((n+1)/2, 3/2)."""
    trial.assert_close(trial.narrow_albedo(MODEL, Phong(n), 1e-9), beta((n + 1) / 2, 1.5))


@every_exponent
def test_dimmer_the_lower_the_light(n: float) -> None:
    albedos = [trial.narrow_albedo(MODEL, Phong(n), mu) for mu in (1.0, 0.8, 0.4, 0.1, 1e-6)]
    assert albedos == sorted(albedos, reverse=True)
