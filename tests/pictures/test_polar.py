import math

import numpy as np
import pytest

from albedo_lab.errors import BadInput
from albedo_lab.pictures.base import Curve
from albedo_lab.pictures.polar import FARTHEST, Polar, summit


def traced(model, quantity="brdf", theta=40.0, log=False, **parameters):
    """Viewers in degrees and values of a section."""
    table = Polar((Curve("it", model, parameters),), (theta,), quantity, log).trace()[""]
    return table.viewer_deg.to_numpy(), table.value.to_numpy()


def lobe(viewer_deg, theta, n):
    """[(R.V)^+]^n in the plane, where angles just subtract."""
    return np.maximum(np.cos(np.radians(viewer_deg - theta)), 0.0) ** n


def test_a_section_is_the_printed_formula():
    viewers, f = traced("phong", n=20)
    np.testing.assert_allclose(f, 22.0 / (2.0 * math.pi) * lobe(viewers, 40.0, 20), rtol=1e-12, atol=1e-15)
    assert viewers[0] == -FARTHEST
    assert viewers[-1] == FARTHEST
    assert np.all(np.diff(viewers) > 0.0)


def test_the_light_is_the_first_of_both_directions():
    viewers, f = traced("phong_original", n=20, scale=1.0)
    np.testing.assert_allclose(f, lobe(viewers, 40.0, 20) / math.cos(math.radians(40.0)), rtol=1e-12, atol=1e-15)


def test_the_mirror_lies_on_the_positive_side_and_the_light_on_the_other():
    for model, side in (("phong", 1.0), ("retro_phong", -1.0)):
        viewers, f = traced(model, n=1e5)
        assert viewers[np.argmax(f)] == side * 40.0


def test_radiance_has_the_cosine_of_the_light_and_normalised_the_value_in_the_normal():
    viewers, f = traced("stretched_phong", n=100, theta=80.0)
    radiance = traced("stretched_phong", "radiance", n=100, theta=80.0)[1]
    normalised = traced("stretched_phong", "normalised", n=100, theta=80.0)[1]
    np.testing.assert_allclose(radiance, f * math.cos(math.radians(80.0)), rtol=1e-12)
    expected = lobe(viewers, 80.0, 100) / np.maximum(np.cos(np.radians(viewers)), math.cos(math.radians(80.0)))
    np.testing.assert_allclose(normalised, expected, rtol=1e-12, atol=1e-15)


@pytest.mark.parametrize("n", [1.0, 300.0, 1e8])
def test_chords_between_viewers_follow_the_curve(n):
    viewers, f = traced("phong", n=n, scale=1.0)
    between = np.unique(np.concatenate([np.linspace(-89.0, 89.0, 5001), 40.0 + np.linspace(-0.05, 0.05, 5001)]))
    assert np.max(np.abs(np.interp(between, viewers, f) - lobe(between, 40.0, n))) < 2e-3


def test_chords_follow_a_lobe_that_is_neither_at_the_mirror_nor_at_the_light():
    viewers, f = traced("lafortune", C_z=0.7, n=1000, scale=1.0)
    between = np.linspace(-89.0, 89.0, 5001)
    light, viewer = math.radians(40.0), np.radians(between)
    expected = np.maximum(math.sin(light) * np.sin(viewer) + 0.7 * math.cos(light) * np.cos(viewer), 0.0) ** 1000
    assert between[np.argmax(expected)] > 45.0
    assert np.max(np.abs(np.interp(between, viewers, f) - expected)) < 2e-3 * np.max(expected)


def test_chords_follow_the_logarithm_where_that_is_drawn():
    viewers, f = traced("phong", n=300.0, log=True, scale=1.0)
    between = np.linspace(-89.0, 89.0, 5001)
    radii = [1.0 + np.log10(np.maximum(values, 1e-3)) / 3.0 for values in (f, lobe(between, 40.0, 300.0))]
    assert np.max(np.abs(np.interp(between, viewers, radii[0]) - radii[1])) < 3e-3


def test_a_dirac_part_is_told_beside_the_section():
    data = Polar((Curve("mirror", "mirror", {"scale": 0.75}), Curve("matt", "lambert")), (0.0, 60.0)).trace()
    assert np.all(data[""].value[data[""].curve == "mirror"] == 0.0)
    assert data["mirrors"].values.tolist() == [["mirror", 0.0, 0.75], ["mirror", 60.0, 0.75]]


def test_the_summit_is_before_the_curve_shoots_up():
    viewers = np.array([-89.9, -30.0, 0.0, 30.0, 89.9])
    assert summit(viewers, np.array([0.0, 1.0, 2.0, 3.0, 1e3]), 30.0, log=False) == 3.0
    assert summit(viewers, np.array([0.0, 1.0, 2.0, 3.0, 4.0]), 30.0, log=False) == 4.0
    assert summit(viewers, np.array([0.0, 1.0, 2.0, 3.0, 1e3]), 30.0, log=True) == 1e3
    assert summit(viewers, np.array([0.0, 1.0, np.nan, np.inf, 1.0]), 30.0, log=False) == 1.0
    assert summit(viewers, np.zeros(5), 30.0, log=False) == 0.0


def test_a_divergent_model_is_followed_where_it_is_drawn():
    viewers, f = traced("cook_torrance", geometry="none", m=0.1, theta=60.0)
    assert f[-1] > 2.0 * np.max(f[np.abs(viewers) < 85.0])
    assert np.max(np.abs(np.diff(f[np.abs(viewers) < 85.0]))) < 0.2 * np.max(f[np.abs(viewers) < 85.0])


@pytest.mark.parametrize("theta", [90.0, -1.0, math.nan, "steep"])
def test_a_light_below_the_horizon_is_bad_input(theta):
    with pytest.raises(BadInput, match=r"theta_deg = .* must be in \[0, 90\) degrees"):
        traced("phong", theta=theta)


def test_a_curve_is_one_model_at_one_set_of_parameters():
    with pytest.raises(BadInput, match=r"curve = 'it': must be one model .* and is 2"):
        traced("phong", n=[1, 2])
