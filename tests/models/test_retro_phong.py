"""Retro-reflective stretched Phong (neumann1999 eq. 13)."""

from __future__ import annotations

import math

import pytest

from albedo_lab.models.retro_phong import MODEL, Phong, evaluate
from albedo_lab.models.stretched_phong import MODEL as STRETCHED
from albedo_lab.optics.frame import mirror_of
from tests.models import trial

EXPONENTS = (0.0, 1.0, 2.5, 20.0)
every_exponent = pytest.mark.parametrize("n", EXPONENTS)


@every_exponent
def test_formula(n: float) -> None:
    """L.V is R.V with the light turned by half a turn about the normal."""

    def printed(light: float, viewer: float, turn: float) -> float:
        return trial.mirror_lobe(light, viewer, turn + math.pi, n) / trial.larger_cosine(light, viewer)

    trial.assert_formula(MODEL, Phong(n), printed)


def test_reciprocal() -> None:
    trial.assert_reciprocal(MODEL, *map(Phong, EXPONENTS))


@every_exponent
def test_mirror_image_of_stretched_phong(n: float) -> None:
    """So both have the same albedo, that of eq. 26 at grazing angles."""
    for wi, wo in trial.random_pairs():
        mirrored = STRETCHED.evaluate(Phong(n), mirror_of(wi), wo)
        assert math.isclose(evaluate(Phong(n), wi, wo), mirrored, rel_tol=1e-12)
    for mu in (1.0, 0.4, 1e-9):
        albedo = trial.narrow_albedo(MODEL, Phong(n), mu)
        trial.assert_close(albedo, trial.narrow_albedo(STRETCHED, Phong(n), mu), 1e-12)
    trial.assert_close(albedo, math.pi / (n + 1))


@every_exponent
def test_the_peak_points_back_at_the_light(n: float) -> None:
    for wi, wo in trial.random_pairs():
        assert evaluate(Phong(n), wi, wo) <= 1 / wo.z
        assert evaluate(Phong(n), wo, wo) == 1 / wo.z
