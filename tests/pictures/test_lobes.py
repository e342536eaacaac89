import math

import numpy as np
import pytest

from albedo_lab.analysis.albedo import albedo
from albedo_lab.errors import BadInput
from albedo_lab.pictures.base import Curve
from albedo_lab.pictures.lobes import Lobes


def traced(model, theta=45.0, phi=0.0, cosine=True, **parameters):
    return Lobes((Curve("it", model, parameters),), (theta,), phi, cosine).trace()


def vectors(theta_deg, phi_deg):
    theta, phi = np.radians(theta_deg), np.radians(phi_deg)
    return np.stack([np.sin(theta) * np.cos(phi), np.sin(theta) * np.sin(phi), np.cos(theta)], axis=-1)


def test_a_white_surface_sends_as_much_everywhere():
    for theta in (0.0, 60.0):
        value = traced("lambert", theta)[""].value
        np.testing.assert_allclose(value, math.cos(math.radians(theta)) / math.pi, rtol=1e-14)
    np.testing.assert_allclose(traced("lambert", 60.0, cosine=False)[""].value, 1.0 / math.pi, rtol=1e-14)


def test_a_lobe_is_the_printed_formula_at_any_azimuth():
    table = traced("phong", 50.0, phi=70.0, n=8)[""]
    mirror = vectors(50.0, 250.0)
    expected = 10.0 / (2.0 * math.pi) * np.maximum(vectors(table.viewer_deg, table.viewer_phi_deg) @ mirror, 0.0) ** 8
    np.testing.assert_allclose(table.value, expected * math.cos(math.radians(50.0)), rtol=1e-10, atol=1e-14)


def test_the_light_is_the_first_of_both_directions():
    table = traced("phong_original", 50.0, n=8, scale=1.0)[""]
    other = traced("phong", 50.0, n=8, scale=1.0, cosine=False)[""]
    np.testing.assert_allclose(table.value, other.value, rtol=1e-12, atol=1e-15)


def test_the_viewers_make_a_closed_grid_that_holds_the_mirror_and_the_light():
    table = traced("lambert", 37.5, phi=20.0)[""]
    polar, azimuths = table.viewer_deg.nunique(), table.viewer_phi_deg.nunique()
    assert len(table) == polar * azimuths
    theta, phi = (table[name].to_numpy().reshape(polar, azimuths) for name in ("viewer_deg", "viewer_phi_deg"))
    assert np.all(np.diff(theta, axis=0) > 0.0)
    assert np.all(np.diff(phi, axis=1) > 0.0)
    assert (theta.min(), phi.min(), phi.max()) == (0.0, 20.0, 380.0)
    for azimuth in (20.0, 200.0):
        assert ((table.viewer_deg == 37.5) & (table.viewer_phi_deg == azimuth)).any()


@pytest.mark.parametrize(("model", "parameters"), [("stretched_phong", {"n": 2000.0}), ("ward", {"m_x": 0.1, "m_y": 0.4})])
def test_all_that_a_lobe_sends_is_the_albedo(model, parameters):
    theta = 40.0
    table = traced(model, theta, phi=30.0, cosine=False, **parameters)[""]
    shape = (table.viewer_deg.nunique(), -1)
    viewer, phi = (np.radians(table[name].to_numpy().reshape(shape)) for name in ("viewer_deg", "viewer_phi_deg"))
    value = table.value.to_numpy().reshape(shape)
    sent = np.trapezoid(np.trapezoid(value, phi, axis=1) * np.sin(viewer[:, 0]) * np.cos(viewer[:, 0]), viewer[:, 0])
    expected = albedo(model, theta_deg=theta, phi_deg=30.0, method="quadrature", **parameters).albedo[0]
    assert sent == pytest.approx(expected, rel=0.03)  # trapezia as wide as the grid; a lobe between its points would be lost


def test_dirac_parts_and_grooves_are_told():
    data = traced("mirror", 30.0)
    assert data["mirrors"].reflectance.tolist() == [1.0]
    assert traced("lambert")["mirrors"].reflectance.tolist() == [0.0]
    assert [bool(traced("ward", m_x=0.1, m_y=m_y)["axes"].isotropic[0]) for m_y in (0.1, 0.2)] == [True, False]


@pytest.mark.parametrize("theta", [-1.0, 90.0, math.nan])
def test_no_light_from_below(theta):
    with pytest.raises(BadInput, match=r"theta_deg = .*: must be in \[0, 90\)"):
        traced("lambert", theta)


def test_no_light_from_nowhere():
    with pytest.raises(BadInput, match="phi_deg = nan"):
        traced("lambert", 40.0, phi=math.nan)


@pytest.mark.parametrize("model", ["phong", "retro_phong"])
def test_a_narrow_lobe_has_viewers_to_all_sides(model):
    table = traced(model, 50.0, phi=10.0, n=1e4)[""]
    bright = table[table.value > 0.3 * table.value.max()]
    assert bright.viewer_deg.nunique() >= 5
    assert bright.viewer_phi_deg.nunique() >= 5
