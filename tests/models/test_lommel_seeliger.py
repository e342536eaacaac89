"""Lommel-Seeliger: the law, its closed albedos, and a sampler whose weights vary by a factor of 2."""

from __future__ import annotations

import math

import pytest
from scipy.integrate import quad

from albedo_lab.models.lommel_seeliger import MODEL, LommelSeeliger
from tests.models import trial

DUST = LommelSeeliger(0.7)


def test_formula() -> None:
    trial.assert_formula(MODEL, DUST, lambda light, viewer, turn: 0.7 / (4 * math.pi * (math.cos(light) + math.cos(viewer))))
    trial.assert_reciprocal(MODEL, DUST)


def closed_albedo(w: float, mu: float) -> float:
    """w / 2 (1 - mu log(1 + 1 / mu))."""
    return w / 2 * (1 - mu * math.log(1 + 1 / mu))


@pytest.mark.parametrize("mu", [1.0, 0.3, 1e-3, 1e-8])
def test_albedo(mu: float) -> None:
    trial.assert_close(trial.wide_albedo(MODEL, DUST, mu), closed_albedo(0.7, mu), 1e-6)


def test_mean_albedo() -> None:
    """2/3 (1 - log 2) w, the spherical albedo."""
    assert quad(lambda mu: 2 * mu * closed_albedo(0.7, mu), 0, 1)[0] == pytest.approx(2 / 3 * (1 - math.log(2)) * 0.7, rel=1e-9)


def test_weights() -> None:
    trial.assert_weight_is_contract(MODEL, DUST)
    for mu in (1.0, 0.1, 1e-9):
        w = [MODEL.weight(DUST, trial.at(mu), u, 0.0) for u in (1e-12, 0.1, 0.5, 1 - 1e-9)]  # type: ignore[misc]
        assert w == sorted(w)
        assert w[-1] < 2 * w[0]


@pytest.mark.parametrize("mu", [1.0, 1e-3])
def test_the_density_is_whole(mu: float) -> None:
    trial.assert_normalised(MODEL, DUST, mu)
