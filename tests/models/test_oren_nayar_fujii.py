"""Fujii's Oren-Nayar: both pairs of constants, and what he and the authors of EON say of its albedo."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.integrate import quad

from albedo_lab.model import Model
from albedo_lab.models.oren_nayar import MODEL as OREN_NAYAR
from albedo_lab.models.oren_nayar import make as oren_nayar
from albedo_lab.models.oren_nayar_fujii import MODEL, OrenNayarFujii, make
from tests.models import trial

MATCHED = make(form="matched")
SURFACES = (OrenNayarFujii(1.0, 0.0), OrenNayarFujii(0.7, 0.3), OrenNayarFujii(1.0, 1.0))
both_forms = pytest.mark.parametrize("model", [MODEL, MATCHED], ids=lambda model: model.chosen["form"])


def constants(model: Model, p: OrenNayarFujii) -> tuple[float, float]:
    """A and B, as Fujii prints them."""
    if model is MODEL:
        A = 1 / (math.pi + (math.pi / 2 - 2 / 3) * p.sigma)
        return A, p.sigma * A
    ss = p.sigma**2
    A = (1 - 0.5 * ss / (ss + 0.33) + 0.17 * p.rho * ss / (ss + 0.13)) / math.pi
    return A, 0.45 * ss / (ss + 0.09) / math.pi


@both_forms
@pytest.mark.parametrize("p", SURFACES)
def test_formula(model: Model, p: OrenNayarFujii) -> None:
    def printed(light: float, viewer: float, turn: float) -> float:
        A, B = constants(model, p)
        n_l, n_v = math.cos(light), math.cos(viewer)
        s = math.sin(light) * math.sin(viewer) * math.cos(turn)
        return p.rho * (A + B * s / (max(n_l, n_v) if s > 0 else 1))

    trial.assert_formula(model, p, printed)


def grazing_gain(mu: float) -> float:
    """What s / t adds to the albedo, over pi: the azimuths below 90 degrees leave 2 sin sin / t, those beyond -2 sin sin."""
    viewer = math.acos(mu)

    def integrand(light: float) -> float:
        return 2 * math.sin(viewer) * math.sin(light) ** 2 * math.cos(light) * (1 / math.cos(min(light, viewer)) - 1)

    return (quad(integrand, 0, viewer)[0] + quad(integrand, viewer, math.pi / 2)[0]) / math.pi


@both_forms
@pytest.mark.parametrize("mu", [1.0, 0.6, 1e-6])
def test_albedo(model: Model, mu: float) -> None:
    for p in SURFACES:
        A, B = constants(model, p)
        expected = p.rho * math.pi * (A + B * grazing_gain(mu))
        trial.assert_close(trial.wide_albedo(model, p, mu), expected, 1e-6)


def test_the_gain_is_largest_at_grazing_incidence_where_the_mixing_form_reflects_rho() -> None:
    """Fujii: the factor keeps the intensity at V.N = 0, which is the maximum, so that no energy is made."""
    gains = [grazing_gain(mu) for mu in np.linspace(1e-9, 1.0, 60)]
    assert gains == sorted(gains, reverse=True)
    assert gains[0] == pytest.approx(0.5 - 2 / (3 * math.pi), rel=1e-7)
    A, B = constants(MODEL, SURFACES[1])
    assert math.pi * (A + B * gains[0]) == pytest.approx(1.0, rel=1e-8)


def test_the_matched_form_makes_energy_beyond_rho_097() -> None:
    """As Fujii says; at the worst sigma the limit is 0.9736."""

    def worst(rho: float) -> float:
        sigmas = np.linspace(0.01, math.pi / 2, 2000)
        return max(rho * math.pi * (A + B * grazing) for A, B in (constants(MATCHED, OrenNayarFujii(rho, s)) for s in sigmas))

    grazing = grazing_gain(1e-9)
    assert worst(0.97) < worst(0.973) < 1.0 < worst(0.974)
    assert worst(1.0) == pytest.approx(1.0287, abs=1e-4)


def test_facing_azimuths_are_those_of_the_qualitative_form() -> None:
    """s / t is cos(dphi) sin(alpha) tan(beta); Fujii adds interreflection to A, and what is negative."""
    p = OrenNayarFujii(1e-9, 0.5)
    for light, viewer, turn in ((0.3, 0.9, 0.0), (1.2, 0.4, 1.0), (0.7, 0.7, 1.5)):
        wi, wo = trial.direction(light, turn), trial.direction(viewer)
        f = OREN_NAYAR.evaluate(OREN_NAYAR.bind({"rho": 1e-9, "sigma": 0.5}), wi, wo)
        assert math.isclose(MATCHED.evaluate(p, wi, wo), f, rel_tol=1e-8)
    assert oren_nayar(form="qualitative") is OREN_NAYAR


@both_forms
def test_smooth_is_lamberts_law_and_nothing_is_negative(model: Model) -> None:
    for wi, wo in trial.random_pairs():
        assert math.isclose(model.evaluate(OrenNayarFujii(0.7, 0.0), wi, wo), 0.7 / math.pi, rel_tol=1e-15)
        assert model.evaluate(OrenNayarFujii(0.7, 1.0), wi, wo) >= 0.0
    trial.assert_reciprocal(model, *SURFACES)


def test_opposite_azimuths_keep_their_digits() -> None:
    """sigma = 1: (cos^2 + cos'^2) / 2 is left for a sine of 1 - 1e-20, where 1 + s would round to 0 or below."""
    for mu, other in ((1e-10, 1e-10), (1e-10, 1e-12), (1e-3, 1e-10)):
        f = MODEL.evaluate(OrenNayarFujii(1.0, 1.0), trial.at(mu, 0.3), trial.at(other, 0.3 + math.pi))
        assert math.isclose(f, (mu * mu + other * other) / 2 * constants(MODEL, SURFACES[2])[0], rel_tol=1e-6)


@both_forms
def test_the_density_is_whole(model: Model) -> None:
    for p in SURFACES:
        trial.assert_normalised(model, p, 0.2)
