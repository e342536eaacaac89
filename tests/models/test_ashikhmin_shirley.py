"""Ashikhmin-Shirley: formula, the diffuse albedo in closed form, limits, and the inequality that keeps the energy balance."""

from __future__ import annotations

import math

import pytest

from albedo_lab.models.ashikhmin_shirley import MODEL, TERMS, AshikhminShirley, evaluate, sample_half_vector
from tests.models import trial

SPECULAR, DIFFUSE = TERMS
SETS = [AshikhminShirley(n, n, 0.05, 0.5) for n in (0.0, 1.0, 50.0, 1e4)]
ANISOTROPIC = AshikhminShirley(5.0, 80.0, 0.3, 0.8)


def printed(p: AshikhminShirley, exponent: float, t: float, light: float, viewer: float, l_v: float) -> float:
    """Both parts, for an exponent of N.H = t."""
    k_h = math.sqrt(0.5 + 0.5 * l_v)
    F = p.R_s + (1 - p.R_s) * (1 - k_h) ** 5
    front = math.sqrt((p.n_u + 1) * (p.n_v + 1)) / (8 * math.pi)
    specular = front * t**exponent / (k_h * trial.larger_cosine(light, viewer)) * F
    shade = (1 - (1 - math.cos(light) / 2) ** 5) * (1 - (1 - math.cos(viewer) / 2) ** 5)
    return specular + 28 * p.R_d / (23 * math.pi) * (1 - p.R_s) * shade


@pytest.mark.parametrize("p", SETS)
def test_formula(p: AshikhminShirley) -> None:
    def formula(light: float, viewer: float, turn: float) -> float:
        l_v = math.cos(light) * math.cos(viewer) + math.sin(light) * math.sin(viewer) * math.cos(turn)
        return printed(p, p.n_u, min(trial.half_cosine(light, viewer, turn), 1.0), light, viewer, l_v)

    trial.assert_formula(MODEL, p, formula)


@pytest.mark.parametrize("phi", [0.0, 0.5, 0.5 * math.pi, 2.5])
def test_anisotropic_formula_for_a_viewer_at_the_normal(phi: float) -> None:
    """The half-vector then has the light's azimuth and half its angle."""
    theta = 0.6
    exponent = 5.0 * math.cos(phi) ** 2 + 80.0 * math.sin(phi) ** 2
    expected = printed(ANISOTROPIC, exponent, math.cos(theta / 2), theta, 0.0, math.cos(theta))
    assert math.isclose(evaluate(ANISOTROPIC, trial.direction(theta, phi), trial.at(1.0)), expected, rel_tol=1e-12)


def test_n_sets_both_exponents() -> None:
    assert MODEL.bind({"n": 3.0, "R_s": 0.1}) == AshikhminShirley(3.0, 3.0, 0.1, 0.5)
    assert MODEL.bind({"n": 3.0, "n_v": 9.0}) == AshikhminShirley(3.0, 9.0, 0.05, 0.5)
    assert not MODEL.isotropic(ANISOTROPIC)


def test_half_vectors_have_the_printed_azimuths() -> None:
    """tan(phi) = sqrt((n_u+1) / (n_v+1)) tan(2 pi u2), in the quadrant of u2; u1 is cos^(e+1) of the angle."""
    for u1, u2 in ((0.9, 0.1), (0.3, 0.3), (0.5, 0.6), (0.1, 0.95)):
        h = sample_half_vector(ANISOTROPIC, u1, u2)
        phi = math.atan2(h.y, h.x)
        assert math.isclose(math.tan(phi), math.sqrt(6.0 / 81.0) * math.tan(2 * math.pi * u2), rel_tol=1e-12)
        assert h.x * math.cos(2 * math.pi * u2) > 0.0
        e = 5.0 * math.cos(phi) ** 2 + 80.0 * math.sin(phi) ** 2
        assert math.isclose(h.z ** (e + 1), u1, rel_tol=1e-12)


@pytest.mark.parametrize("mu", [1.0, 0.3, 1e-9])
def test_the_diffuse_albedo(mu: float) -> None:
    """R_d (1 - R_s) (1 - (1 - mu/2)^5): the 28/23 is the reciprocal of 1 - 2 ∫ mu (1 - mu/2)^5 dmu."""
    closed = 0.8 * 0.7 * -math.expm1(5 * math.log1p(-0.5 * mu))
    trial.assert_close(trial.narrow_albedo(DIFFUSE, ANISOTROPIC, mu), closed, 1e-5)


@pytest.mark.parametrize("mu", [1.0, 0.5, 0.1])
def test_a_sharp_lobe_is_a_mirror(mu: float) -> None:
    """Of Schlick's reflectance, up to the width of the lobe, 1e-4."""
    p = AshikhminShirley(1e8, 1e8, 0.05, 0.0)
    trial.assert_close(trial.narrow_albedo(SPECULAR, p, mu), 0.05 + 0.95 * (1 - mu) ** 5, 1e-3)


@pytest.mark.parametrize("n", [0.0, 20.0, 1e4])
def test_half_of_the_light_is_left_at_grazing_angles(n: float) -> None:
    """Of white facets those that face the viewer, with weight 1; the diffuse part has nothing left."""
    trial.assert_close(trial.narrow_albedo(SPECULAR, AshikhminShirley(n, n, 1.0, 1.0), 1e-9), 0.5)


def test_each_part_keeps_its_share_of_the_energy() -> None:
    """k.h >= (n.k) / 2 for both directions, hence F <= R_s + (1 - R_s) (1 - (n.k)/2)^5; and the sum of both at its worst."""
    for wi, wo in trial.random_pairs(2000):
        k_h = math.sqrt(max(0.5 + 0.5 * (wi.x * wo.x + wi.y * wo.y + wi.z * wo.z), 0.0))
        assert k_h >= 0.5 * max(wi.z, wo.z) * (1 - 1e-12)
    for n, mu in ((0.0, 0.9), (0.0, 0.1), (1e8, 0.1), (20.0, 0.03)):
        p = AshikhminShirley(n, n, 0.0, 1.0)
        assert sum(trial.narrow_albedo(part, p, mu) for part in TERMS) < 1.0
