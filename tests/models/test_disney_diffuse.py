"""Disney's diffuse term and Frostbite's: the formula, the albedo as the polynomial it is, and the energy they make."""

from __future__ import annotations

import math

import numpy as np
import pytest

from albedo_lab.model import Model
from albedo_lab.models.disney_diffuse import MODEL, DisneyDiffuse, make
from tests.models import trial

FROSTBITE = make(form="frostbite")
both_forms = pytest.mark.parametrize("model", [MODEL, FROSTBITE], ids=lambda model: model.chosen["form"])
ROUGHNESSES = (0.0, 0.3, 1.0)


@both_forms
@pytest.mark.parametrize("roughness", ROUGHNESSES)
def test_formula(model: Model, roughness: float) -> None:
    def printed(light: float, viewer: float, turn: float) -> float:
        opening = math.acos(
            min(1.0, math.cos(light) * math.cos(viewer) + math.sin(light) * math.sin(viewer) * math.cos(turn)),
        )
        bias = 0.5 if model is MODEL else 0.5 * roughness
        F_D90 = bias + 2 * math.cos(opening / 2) ** 2 * roughness
        factor = 1.0 if model is MODEL else (1 - roughness) + roughness / 1.51
        shades = [1 + (F_D90 - 1) * (1 - math.cos(theta)) ** 5 for theta in (light, viewer)]
        return 0.8 / math.pi * factor * shades[0] * shades[1]

    trial.assert_formula(model, DisneyDiffuse(0.8, roughness), printed)


def moment(k: int) -> float:
    """2 * integral of z^(1 + k) (1 - z)^5: twice Beta(2 + k, 6)."""
    return 2 * math.gamma(2 + k) * math.gamma(6) / math.gamma(8 + k)


def closed_albedo(model: Model, roughness: float, mu: float) -> float:
    """F_D90 - 1 is m + q cos(dphi), m = c + roughness z mu, q = roughness s s': its mean is m, its square's m^2 + q^2 / 2."""
    c = roughness - 0.5 if model is MODEL else 1.5 * roughness - 1
    d, q = roughness * mu, (1 - mu) ** 5
    sq = 0.5 * roughness**2 * (1 - mu * mu)
    mean = c * moment(0) + d * moment(1)
    squares = (c * c + sq) * moment(0) + 2 * c * d * moment(1) + (d * d - sq) * moment(2)
    total = 1 + mean + q * (c + 2 / 3 * d) + q * squares
    return total * (1.0 if model is MODEL else 1 - roughness * 0.51 / 1.51)


@both_forms
@pytest.mark.parametrize("mu", [1.0, 0.5, 0.1, 1e-6])
def test_albedo(model: Model, mu: float) -> None:
    for roughness in ROUGHNESSES:
        expected = closed_albedo(model, roughness, mu)
        assert trial.wide_albedo(model, DisneyDiffuse(1.0, roughness), mu) == pytest.approx(expected, rel=1e-6, abs=2e-6)


def test_how_much_energy_they_make() -> None:
    """At grazing incidence and roughness 1, 1 + 11/21 + 1/84 + 11/504; Frostbite's factor of 1 / 1.51 is 3 % too large for it.

    Along the normal Burley's white surface has 1 + (5 roughness - 2) / 84, which is 1 at 0.4.
    """
    most = 1 + 11 / 21 + 1 / 84 + 11 / 504
    assert closed_albedo(MODEL, 1.0, 0.0) == pytest.approx(most, rel=1e-12)
    assert closed_albedo(FROSTBITE, 1.0, 0.0) == pytest.approx(most / 1.51, rel=1e-12)
    assert most / 1.51 == pytest.approx(1.0315, abs=1e-4)
    cosines = np.linspace(0.0, 1.0, 101)
    for roughness, white in ((0.39, True), (0.41, False)):
        assert closed_albedo(MODEL, roughness, 1.0) == pytest.approx(1 + (5 * roughness - 2) / 84, rel=1e-12)
        assert (max(closed_albedo(MODEL, roughness, mu) for mu in cosines) < 1.0) == white
    assert max(closed_albedo(FROSTBITE, 0.94, mu) for mu in cosines) < 1.0 < closed_albedo(FROSTBITE, 0.95, 0.0)


@both_forms
def test_reciprocal_and_positive(model: Model) -> None:
    trial.assert_reciprocal(model, *(DisneyDiffuse(1.0, x) for x in ROUGHNESSES))
    for wi, wo in trial.random_pairs():
        assert model.evaluate(DisneyDiffuse(1.0, 0.0), wi, wo) >= 0.0
