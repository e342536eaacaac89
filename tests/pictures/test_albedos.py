import math

import numpy as np
import pytest

from albedo_lab.errors import BadInput
from albedo_lab.estimate.record import Tolerance
from albedo_lab.pictures import albedos
from albedo_lab.pictures.albedos import Albedos
from albedo_lab.pictures.base import Curve


def traced(model, **parameters):
    return Albedos((Curve("it", model, parameters),)).trace()[""]


def test_the_curve_is_the_closed_form():
    table = traced("phong", n=1, scale=0.25)
    theta = np.arccos(table.mu)
    expected = 0.25 * 2.0 / 3.0 * (np.sin(theta) + (math.pi - theta) * np.cos(theta))
    assert np.all(np.abs(table.albedo - expected) <= table.ci95_high - table.albedo + 1e-15)
    assert np.all(table.ci95_high - table.ci95_low <= 2.0 * np.maximum(1e-6, 1e-6 * table.albedo))
    np.testing.assert_allclose(np.radians(table.theta_deg), theta, rtol=1e-7, atol=1e-9)
    assert table.columns.tolist() == ["curve", "theta_deg", "mu", "albedo", "ci95_low", "ci95_high", "order"]
    assert table.mu.iloc[0] == 1.0
    assert table.mu.iloc[-1] == pytest.approx(1e-7)


def test_a_model_that_is_not_reciprocal_has_both_orders():
    table = traced("phong_original", n=20, scale=1.0)
    light, viewer = (table[table.order == order] for order in ("wo", "wi"))
    assert len(light) == len(viewer) == len(albedos.COSINES)
    # for a fixed light f cos = lobe * cos(viewer) / cos(light): the reciprocal model's albedo, over that cosine
    np.testing.assert_allclose(light.albedo * light.mu, traced("phong", n=20, scale=1.0).albedo, atol=3e-6)
    assert viewer.albedo.iloc[-1] == pytest.approx(math.pi / 21.0, rel=1e-4)


def test_an_interval_that_stays_wide_is_kept(monkeypatch):
    monkeypatch.setattr(albedos, "TOLERANCE", Tolerance(1e-300))
    monkeypatch.setattr(albedos, "COSINES", np.array([0.5]))
    table = traced("stretched_phong", n=30)
    assert 0.0 < table.ci95_high[0] - table.ci95_low[0] < 1e-9


def test_a_curve_is_one_model_at_one_set_of_parameters():
    with pytest.raises(BadInput, match="curve = 'it'"):
        traced("phong", n=[1, 2])
