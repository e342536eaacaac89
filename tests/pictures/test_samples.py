import math
from dataclasses import replace

import numpy as np
import pytest

from albedo_lab import catalogue
from albedo_lab.analysis.albedo import albedo
from albedo_lab.analysis.sampler import quality
from albedo_lab.analysis.verdict import Trial
from albedo_lab.errors import BadInput
from albedo_lab.pictures.base import Curve
from albedo_lab.pictures.evaluation import subject
from albedo_lab.pictures.samples import DRAWN, GRID, Samples, from_disc, to_disc


def traced(model, theta=60.0, seed=0, count=500, **parameters):
    return Samples((Curve("it", model, parameters),), (theta,), count, seed).trace()


def test_equal_areas_of_the_disc_are_equal_solid_angles():
    rng = np.random.default_rng(1)
    x, y = rng.uniform(-1.0, 1.0, (2, 20_000))
    inside = x * x + y * y < 1.0
    x, y = x[inside], y[inside]
    w = from_disc(x, y)
    np.testing.assert_allclose(np.sum(w * w, axis=1), 1.0, rtol=1e-14)
    np.testing.assert_allclose(to_disc(w), (x, y), rtol=1e-12, atol=1e-15)
    # of a uniform sphere the height is uniform (Archimedes): five standard errors of its first two moments
    assert np.mean(w[:, 2]) == pytest.approx(0.5, abs=5.0 / math.sqrt(12.0 * len(x)))
    assert np.mean(w[:, 2] ** 2) == pytest.approx(1.0 / 3.0, abs=5.0 * math.sqrt(4.0 / 45.0 / len(x)))


def test_the_weights_average_to_the_albedo_and_rejection_to_what_the_density_lacks():
    told = traced("stretched_phong", 80.0, n=20.0)["quality"].iloc[0]
    expected = albedo("stretched_phong", theta_deg=80.0, n=20.0, method="quadrature").albedo[0]
    assert told.albedo == pytest.approx(expected, abs=5.0 * expected / math.sqrt(DRAWN))
    # the share of the power lobe about R that lies below the horizon, in steps of the angle from R
    alpha = np.linspace(0.0, 0.5 * np.pi, 20_001)
    edge = np.clip(np.cos(np.radians(80.0)) * np.cos(alpha[1:]) / (np.sin(np.radians(80.0)) * np.sin(alpha[1:])), -1.0, 1.0)
    share = np.concatenate([[0.0], np.arccos(edge) / np.pi])
    below = np.trapezoid(21.0 * np.cos(alpha) ** 20 * np.sin(alpha) * share, alpha)
    assert told.rejected == pytest.approx(below, abs=5.0 * math.sqrt(below / DRAWN))


@pytest.mark.parametrize(("model", "parameters"), [("stretched_phong", {"n": 20.0}), ("schlick_isotropic", {"r": 0.3})])
def test_efficiency_is_what_the_check_of_samplers_measures_with_samples_of_both(model, parameters):
    """The check draws cosine samples; here their variance comes from the model's own."""
    found = {
        round(f.details["mu"], 9): f.details for f in quality(subject(Curve("it", model, parameters)), Trial(budget=1 << 20))
    }
    details = found[round(math.cos(math.radians(45.0)), 9)]
    told = traced(model, 45.0, **parameters)["quality"].iloc[0]
    assert told.efficiency == pytest.approx(details["efficiency"], rel=0.08)  # of 2^15 cosine samples each
    assert told.rejected == pytest.approx(details["rejected"], abs=0.01)


def test_a_sampler_without_variance_and_a_model_without_a_lobe():
    assert traced("lambert")["quality"].efficiency[0] == math.inf
    assert math.isnan(traced("mirror")["quality"].efficiency[0])


def test_a_model_without_a_sampler_is_sampled_by_the_cosine():
    bare = replace(catalogue.find("phong"), sample=None, pdf=None, weight=None)
    told = traced(bare, 30.0, n=5.0)["quality"].iloc[0]
    assert (told.own, told.rejected, told.efficiency) == (False, 0.0, 1.0)
    expected = albedo("phong", theta_deg=30.0, n=5.0, method="quadrature").albedo[0]
    assert told.albedo == pytest.approx(expected, rel=0.03)


def test_the_dots_are_the_samples_above_the_horizon():
    data = traced("stretched_phong", 85.0, count=2000, n=10.0)
    table = data[""]
    share = len(table) / 2000
    assert share == pytest.approx(1.0 - data["quality"].rejected[0], abs=5.0 * math.sqrt(0.25 / 2000))
    assert (table.x**2 + table.y**2 < 1.0).all()
    assert table.x.mean() < -0.7  # about the mirror direction: the viewer stands towards +x


def test_the_ground_is_f_cos():
    ground = traced("lambert", albedo=0.5)["f cos"]
    assert ground.shape == (1, 1, GRID, GRID)
    middle = GRID // 2
    assert ground[0, 0, middle, middle] == pytest.approx(0.5 / math.pi)
    assert ground[0, 0, middle, middle + middle // 2] == pytest.approx(0.5 / math.pi * 0.75)  # cos = 1 - r^2
    assert np.isnan(ground[0, 0, 0, 0])


def test_the_seed_makes_the_samples():
    same, again, other = (traced("ward", seed=seed)[""] for seed in (3, 3, 4))
    assert same.equals(again)
    assert not same.equals(other)


@pytest.mark.parametrize(
    ("name", "options"), [("count", {"count": 0}), ("count", {"count": DRAWN + 1}), ("theta_deg", {"theta": 90.0})]
)
def test_bad_input(name, options):
    with pytest.raises(BadInput, match=name):
        traced("lambert", **options)
