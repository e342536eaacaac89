"""Lambert: the same radiance everywhere, and its parameter is its albedo."""

from __future__ import annotations

import math

import pytest

from albedo_lab.models.lambert import MODEL, Lambert, evaluate, pdf, sample
from tests.models import trial

WHITE, GREY = Lambert(1.0), Lambert(0.18)


@pytest.mark.parametrize("p", [WHITE, GREY])
def test_formula(p: Lambert) -> None:
    trial.assert_formula(MODEL, p, lambda light, viewer, turn: p.albedo / math.pi)


def test_reciprocal() -> None:
    trial.assert_reciprocal(MODEL, WHITE, GREY)


@pytest.mark.parametrize("mu", trial.GRAZING)
def test_albedo_is_the_parameter(mu: float) -> None:
    trial.assert_close(trial.wide_albedo(MODEL, GREY, mu), 0.18, 1e-7)


def test_every_sample_weighs_the_albedo() -> None:
    wo = trial.at(0.3)
    for u1, u2 in ((0.1, 0.2), (0.5, 0.9), (1e-9, 0.5), (1 - 1e-9, 0.0)):
        wi = sample(GREY, wo, u1, u2)
        assert math.isclose(evaluate(GREY, wi, wo) * wi.z / pdf(GREY, wi, wo), 0.18, rel_tol=1e-12)


def test_black_reflects_nothing() -> None:
    assert evaluate(Lambert(0.0), trial.at(0.5), trial.at(0.1)) == 0.0
