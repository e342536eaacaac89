"""Ward (neumann1999 eq. 34), and its anisotropic form; and what the modified model has in common with it."""

from __future__ import annotations

import math

import pytest
from scipy.integrate import quad

from albedo_lab.model import Model
from albedo_lab.models.modified_ward import MODEL as MODIFIED
from albedo_lab.models.ward import MODEL, Ward, evaluate
from albedo_lab.optics.frame import Direction
from tests.models import trial

WIDTHS = (0.05, 0.3, 1.0)
every_width = pytest.mark.parametrize("m", WIDTHS)
both_models = pytest.mark.parametrize("model", [MODEL, MODIFIED], ids=lambda model: model.name)
ANISOTROPIC = Ward(0.1, 0.4)


@every_width
def test_formula(m: float) -> None:
    def printed(light: float, viewer: float, turn: float) -> float:
        tan_delta = math.tan(math.acos(min(trial.half_cosine(light, viewer, turn), 1.0)))
        return math.exp(-((tan_delta / m) ** 2)) / (4 * math.pi * m * m) / math.sqrt(math.cos(light) * math.cos(viewer))

    trial.assert_formula(MODEL, Ward(m, m), printed)


@pytest.mark.parametrize("phi", [0.0, 0.5, math.pi / 2])
def test_anisotropic_formula_for_a_viewer_at_the_normal(phi: float) -> None:
    """The half-vector then has the light's azimuth and half its angle."""
    theta = 0.6
    width = (math.cos(phi) / 0.1) ** 2 + (math.sin(phi) / 0.4) ** 2
    expected = math.exp(-(math.tan(theta / 2) ** 2) * width) / (4 * math.pi * 0.1 * 0.4) / math.sqrt(math.cos(theta))
    assert math.isclose(evaluate(ANISOTROPIC, trial.direction(theta, phi), trial.at(1.0)), expected, rel_tol=1e-12)


@both_models
def test_a_quarter_turn_swaps_the_widths(model: Model) -> None:
    for wi, wo in trial.random_pairs():
        turned = Direction(-wi.y, wi.x, wi.z), Direction(-wo.y, wo.x, wo.z)
        expected = model.evaluate(Ward(0.4, 0.1), *turned)
        assert math.isclose(model.evaluate(ANISOTROPIC, wi, wo), expected, rel_tol=1e-12)


@both_models
def test_m_sets_both_widths(model: Model) -> None:
    assert model.bind({"m": 0.3}) == Ward(0.3, 0.3)
    assert model.bind({"m": 0.3, "m_y": 0.2}) == Ward(0.3, 0.2)
    assert model.isotropic(Ward(0.3, 0.3))
    assert not model.isotropic(ANISOTROPIC)


@both_models
def test_reciprocal(model: Model) -> None:
    trial.assert_reciprocal(model, ANISOTROPIC, *(Ward(m, m) for m in WIDTHS))


@both_models
def test_weight(model: Model) -> None:
    trial.assert_weight_is_contract(model, ANISOTROPIC, *(Ward(m, m) for m in (*WIDTHS, 1e-4)))


@every_width
def test_normal_incidence(m: float) -> None:
    """With t = tan^2(theta/2), c = (1-t)/(1+t) and dc = 2 dt / (1+t)^2."""

    def integrand(t: float) -> float:
        return math.exp(-t / (m * m)) / (m * m) * math.sqrt((1 - t) / (1 + t)) / (1 + t) ** 2

    trial.assert_close(trial.wide_albedo(MODEL, Ward(m, m), 1.0), quad(integrand, 0.0, 1.0)[0])


@pytest.mark.parametrize("mu", [1.0, 0.5, 0.1])
def test_a_smooth_surface_darkens_like_the_cosine(mu: float) -> None:
    """Of (wo.h) cos^3(delta) sqrt(z/mu) there stays mu: the constant 1 / (4 pi m^2) is one for normal incidence."""
    trial.assert_close(trial.narrow_albedo(MODEL, Ward(1e-4, 1e-4), mu), mu)


@pytest.mark.parametrize("p", [Ward(0.1, 0.1), Ward(1.0, 1.0), ANISOTROPIC])
def test_diverges_like_the_root_of_one_over_the_cosine(p: Ward) -> None:
    rise = trial.narrow_albedo(MODEL, p, 1e-8, 0.3) / trial.narrow_albedo(MODEL, p, 1e-6, 0.3)
    trial.assert_close(rise, 10.0, 1e-3)


@every_width
def test_at_least_the_modified_model(m: float) -> None:
    """The geometric mean of the cosines is not above the larger one."""
    for wi, wo in trial.random_pairs():
        assert evaluate(Ward(m, m), wi, wo) >= MODIFIED.evaluate(Ward(m, m), wi, wo) * (1 - 1e-12)
