"""Ward-Dür (Dür 2006): formula, the mirror that a smooth surface is, and what grazing light is multiplied by."""

from __future__ import annotations

import math

import pytest
from scipy.integrate import quad

from albedo_lab.models.modified_ward import MODEL as MODIFIED
from albedo_lab.models.ward import MODEL as WARD
from albedo_lab.models.ward import Ward
from albedo_lab.models.ward_duer import MODEL, evaluate
from tests.models import trial

every_width = pytest.mark.parametrize("m", [0.05, 0.3, 1.0])
ANISOTROPIC = Ward(0.1, 0.4)


@every_width
def test_formula(m: float) -> None:
    def printed(light: float, viewer: float, turn: float) -> float:
        tan_delta = math.tan(math.acos(min(trial.half_cosine(light, viewer, turn), 1.0)))
        return math.exp(-((tan_delta / m) ** 2)) / (4 * math.pi * m * m) / (math.cos(light) * math.cos(viewer))

    trial.assert_formula(MODEL, Ward(m, m), printed)


def test_anisotropic_formula() -> None:
    """Ward's, with another denominator."""
    for wi, wo in trial.random_pairs():
        expected = WARD.evaluate(ANISOTROPIC, wi, wo) / math.sqrt(wi.z * wo.z)
        assert math.isclose(evaluate(ANISOTROPIC, wi, wo), expected, rel_tol=1e-12, abs_tol=1e-300)


def test_weight() -> None:
    trial.assert_weight_is_contract(MODEL, ANISOTROPIC, Ward(1.0, 1.0), Ward(1e-4, 1e-4))


@every_width
def test_normal_incidence(m: float) -> None:
    """With t = tan^2(theta/2), f cos is that of Ward over sqrt((1-t)/(1+t)): exp(-t/m^2) / m^2 / (1+t)^2 up to t = 1."""
    expected = quad(lambda t: math.exp(-t / (m * m)) / (m * m) / (1 + t) ** 2, 0.0, 1.0)[0]
    trial.assert_close(trial.wide_albedo(MODEL, Ward(m, m), 1.0), expected)


@pytest.mark.parametrize("mu", [1.0, 0.5, 0.1])
def test_a_smooth_surface_is_a_mirror(mu: float) -> None:
    """Where Ward's darkens like mu."""
    p = Ward(1e-4, 1e-4)
    assert MODEL.mirror_limit is not None
    trial.assert_close(trial.narrow_albedo(MODEL, p, mu), MODEL.mirror_limit[1](p, mu))


@every_width
def test_diverges_like_one_over_the_cosine(m: float) -> None:
    """With slopes (x, y), f cos / pdf tends to x / (1 + x^2 + y^2)^2 / mu for x > 0: modified Ward's limit, over mu."""
    y = quad(lambda y: 2 * y * y * math.exp(-y * y) * m / (1 + (m * y) ** 2) ** 2 / math.pi, 0.0, 7.0)[0]
    p = Ward(m, m)
    trial.assert_close(1e-9 * trial.narrow_albedo(MODEL, p, 1e-9), y)
    trial.assert_close(trial.narrow_albedo(MODIFIED, p, 1e-9), y)
