"""Disney 2012: the formula in angles, lobe by lobe and all together, and how much energy they make."""

from __future__ import annotations

import math
from typing import Any

import pytest
from scipy.integrate import quad

from albedo_lab.estimate.methods import estimate
from albedo_lab.estimate.record import Estimate, Question
from albedo_lab.models.disney import LOBES, MODEL
from tests.models import trial
from tests.models.trial import PI, member

MIXED: dict[str, float] = {
    "baseColor": 0.7,
    "metallic": 0.3,
    "subsurface": 0.4,
    "specular": 0.6,
    "roughness": 0.6,
    "anisotropic": 0.5,
    "sheen": 0.8,
    "clearcoat": 0.9,
    "clearcoatGloss": 0.2,
}
ALONE = {"subsurface": {"subsurface": 1.0}, "metallic": {"metallic": 1.0}}


def mix(a: float, b: float, t: float) -> float:
    return a + t * (b - a)


def in_angles(lobe: str) -> trial.Formula:
    """The viewer at azimuth 0, the light at the azimuth `turn`; of a lobe alone, the others' amounts are 0."""
    kept = {name: MIXED[name] for name in LOBES[lobe][2]} | ALONE.get(lobe, {})
    p = dict.fromkeys(MIXED, 0.0) | kept

    def formula(light: float, viewer: float, turn: float) -> float:
        n_l, n_v = math.cos(light), math.cos(viewer)
        x = math.sin(viewer) + math.sin(light) * math.cos(turn)
        y = math.sin(light) * math.sin(turn)
        size = math.sqrt(x * x + y * y + (n_l + n_v) ** 2)
        x, y, n_h, l_h = x / size, y / size, (n_l + n_v) / size, size / 2
        f_l, f_v, f_h = ((1 - c) ** 5 for c in (n_l, n_v, l_h))
        d90, ss90 = 0.5 + 2 * l_h**2 * p["roughness"], l_h**2 * p["roughness"]
        f_d = mix(1, d90, f_l) * mix(1, d90, f_v)
        f_ss = mix(1, ss90, f_l) * mix(1, ss90, f_v)
        ss = 1.25 * (f_ss * (1 / (n_l + n_v) - 0.5) + 0.5)
        below = (1 - p["metallic"]) * (p["baseColor"] / PI * mix(f_d, ss, p["subsurface"]) + p["sheen"] * f_h)
        aspect = math.sqrt(1 - 0.9 * p["anisotropic"])
        a_x, a_y = max(0.001, p["roughness"] ** 2 / aspect), max(0.001, p["roughness"] ** 2 * aspect)
        d_s = 1 / (PI * a_x * a_y * ((x / a_x) ** 2 + (y / a_y) ** 2 + n_h**2) ** 2)
        f_s = mix(mix(0.08 * p["specular"], p["baseColor"], p["metallic"]), 1, f_h)
        a_r = mix(0.1, 0.001, p["clearcoatGloss"])
        d_r = (a_r**2 - 1) / (PI * math.log(a_r**2) * (1 + (a_r**2 - 1) * n_h**2))
        f_r = mix(0.04, 1, f_h)

        def g(a: float) -> float:
            return math.prod(1 / (c + math.sqrt(a * a + c * c - a * a * c * c)) for c in (n_l, n_v))

        highlight = d_s * f_s * g((0.5 + p["roughness"] / 2) ** 2) if lobe in ("all", "specular", "metallic") else 0.0
        return below + highlight + 0.25 * p["clearcoat"] * d_r * f_r * g(0.25)

    return formula


def mixed(lobe: str) -> trial.Member:
    return member(MODEL, {"lobe": lobe, **{name: MIXED[name] for name in LOBES[lobe][2]}})


@pytest.mark.parametrize("lobe", LOBES)
def test_formula(lobe: str) -> None:
    trial.assert_formula(*mixed(lobe), in_angles(lobe))


def albedo(values: dict[str, Any], mu: float, phi: float = 0.0) -> Estimate:
    return estimate(Question(*member(MODEL, values), mu, phi), trial.relative(1e-8), "quadrature", 0, 1)


def test_together_they_are_the_sum_of_what_they_are_alone() -> None:
    """No lobe takes light from another."""
    common = {"baseColor": 0.5, "roughness": 0.6, "anisotropic": 0.4}
    whole = member(MODEL, {**common, "specular": 0.7, "sheen": 0.3, "clearcoat": 0.8, "clearcoatGloss": 0.5})
    alone = [
        member(MODEL, {"lobe": "diffuse", "baseColor": 0.5, "roughness": 0.6}),
        member(MODEL, {"lobe": "specular", "specular": 0.7, "roughness": 0.6, "anisotropic": 0.4}),
        member(MODEL, {"lobe": "sheen", "sheen": 0.3}),
        member(MODEL, {"lobe": "clearcoat", "clearcoat": 0.8, "clearcoatGloss": 0.5}),
    ]
    for wi, wo in trial.random_pairs(50):
        total = math.fsum(model.evaluate(p, wi, wo) for model, p in alone)
        assert math.isclose(whole.model.evaluate(whole.p, wi, wo), total, rel_tol=1e-12)


def test_albedos_at_normal_incidence() -> None:
    """Diffuse 1 - 1/42 + 5 roughness / 84; sheen 2 pi int (1 - sqrt((1 + z) / 2))^5 z dz; both from u^2 = (1 + z) / 2."""
    for roughness in (0.0, 0.5, 1.0):
        found = albedo({"lobe": "diffuse", "baseColor": 1.0, "roughness": roughness}, 1.0)
        assert abs(found.value - (1 - 1 / 42 + 5 * roughness / 84)) <= found.half_width
    sheen = 2 * PI * quad(lambda z: (1 - math.sqrt((1 + z) / 2)) ** 5 * z, 0.0, 1.0)[0]
    found = albedo({"lobe": "sheen", "sheen": 1.0}, 1.0)
    assert abs(found.value - sheen) <= found.half_width + 1e-12


def test_the_energy_that_it_makes() -> None:
    """Of white near grazing: rough diffuse light 1.56 times what falls in, from below the surface 1.51, all lobes together 1.76.

    The highlight is as bright as its facets are seen, where it has one width; where it has two, its masking knows of neither.
    """
    grazing = 1e-6
    for lobe, most in (("diffuse", 1.55754), ("subsurface", 1.51258)):
        assert math.isclose(albedo({"lobe": lobe, "baseColor": 1.0, "roughness": 1.0}, grazing).value, most, abs_tol=1e-4)
    everything = {"baseColor": 1.0, "roughness": 1.0, "specular": 1.0, "sheen": 1.0, "clearcoat": 1.0, "clearcoatGloss": 0.0}
    assert math.isclose(albedo(everything, grazing).value, 1.76193, abs_tol=1e-4)
    assert albedo({"lobe": "subsurface", "baseColor": 1.0, "roughness": 0.0}, 0.239).low > 1.21
    assert albedo({"lobe": "diffuse", "baseColor": 1.0, "roughness": 0.25}, grazing).high < 1.0
    metal = {"lobe": "metallic", "baseColor": 1.0, "roughness": 1.0}
    found = albedo(metal, 1e-12)
    assert abs(found.value - 2 * (1 - math.log(2))) <= found.half_width + 1e-9  # uniform normals, independent masking
    assert albedo({**metal, "anisotropic": 1.0}, grazing).low > 1.63


def test_samples_of_the_clearcoat_follow_the_density() -> None:
    """The others are among those of every model."""
    trial.assert_follows_density(*mixed("clearcoat"), 0.4, 1)
