"""Kelemen and Szirmay-Kalos: formula with an albedo of its own integration, the sum that a white matte part completes to 1."""

from __future__ import annotations

import math
from functools import cache

import pytest
from scipy.integrate import quad

from albedo_lab.model import Model
from albedo_lab.models.kelemen import MODEL, TERMS, sample_grazing, to_matte
from albedo_lab.models.ward import Ward
from albedo_lab.models.ward import pdf as facets_pdf
from albedo_lab.models.ward_bounded import evaluate as bounded
from tests.models import trial
from tests.oracles.catalogue_albedo import albedo as oracle

SPECULAR, MATTE = TERMS
SETS = [MODEL.bind(values) for values in ({"m": 0.3}, {"m": 1.0, "F0": 1.0, "r_m": 1.0}, {"m": 0.6, "F0": 0.5, "r_m": 0.2})]
every_set = pytest.mark.parametrize("p", SETS, ids=[f"{p.m}, {p.F0}, {p.r_m}" for p in SETS])


@cache
def specular_albedo(m: float, F0: float, mu: float) -> float:
    """By the oracle's mesh, in angles of the half-vector: with r_m = 0 its figure is that of the specular part."""
    return oracle("kelemen", {"m": m, "F0": F0, "r_m": 0.0}, mu, effort=1)[0]


@every_set
def test_formula(p: object) -> None:
    """P_H F / (4 (L.H)^2) and r_m (1 - a) (1 - a') / (pi (1 - a_mean))."""
    m, F0, r_m = p.m, p.F0, p.r_m  # type: ignore[attr-defined]
    # in sqrt(mu), which is smooth enough for a rule of 24 points where a(mu) has mu log mu
    mean = sum(w * 4 * x**3 * specular_albedo(m, F0, x * x) for x, w in trial.panels(0.0, 1.0, 0.25, 6))

    def printed(light: float, viewer: float, turn: float) -> float:
        t = trial.half_cosine(light, viewer, turn)
        l_v = math.cos(light) * math.cos(viewer) + math.sin(light) * math.sin(viewer) * math.cos(turn)
        u = math.sqrt(0.5 + 0.5 * l_v)
        P_H = math.exp(min(1 - 1 / (t * t), 0.0) / (m * m)) / (math.pi * m * m * t**4)
        a, b = (specular_albedo(m, F0, math.cos(theta)) for theta in (light, viewer))
        matte = r_m * (1 - a) * (1 - b) / (math.pi * (1 - mean))
        return P_H * (F0 + (1 - F0) * (1 - u) ** 5) / (4 * u * u) + matte

    for light, viewer, turn in trial.GEOMETRIES:
        f = MODEL.evaluate(p, trial.direction(light, turn), trial.direction(viewer))
        assert math.isclose(f, printed(light, viewer, turn), rel_tol=1e-6)


def test_the_specular_part_is_the_bounded_ward_of_2010() -> None:
    p = MODEL.bind({"m": 0.3, "F0": 1.0})
    for wi, wo in trial.random_pairs():
        assert math.isclose(SPECULAR.evaluate(p, wi, wo), bounded(Ward(0.3, 0.3), wi, wo), rel_tol=1e-13)


@every_set
@pytest.mark.parametrize("mu", [1.0, 0.3, 1e-3])
def test_the_matte_part_returns_its_share_of_what_is_left(p: object, mu: float) -> None:
    """a_m = r_m (1 - a): so a white matte part makes the sum 1, the albedo of no other one exceeds it."""
    a = specular_albedo(p.m, p.F0, mu)  # type: ignore[attr-defined]
    # the plain integral is good to 4e-4 of a wide lobe near grazing
    trial.assert_close(trial.narrow_albedo(SPECULAR, p, mu), a, 1e-3)
    matte = trial.narrow_albedo(MATTE, p, mu)
    assert math.isclose(matte, p.r_m * (1 - a), rel_tol=1e-4, abs_tol=1e-9)  # type: ignore[attr-defined]


def test_the_light_that_white_facets_lose_is_drawn_near_grazing() -> None:
    """cos^2 = m^2 ((1 + 1/m^2)^u - 1): 2 cos / ((cos^2 + m^2) log(1 + 1/m^2)) integrates to u."""
    p = MODEL.bind({"m": 0.01, "F0": 1.0})
    for u in (0.1, 0.5, 0.9):
        w = sample_grazing(p, u, 0.3)
        assert math.isclose(w.x**2 + w.y**2 + w.z**2, 1.0, rel_tol=1e-14)
        below = quad(lambda z: 2 * z / ((z * z + 1e-4) * math.log1p(1e4)), 0.0, w.z, points=[1e-3])[0]
        assert math.isclose(below, u, rel_tol=1e-9)


@pytest.mark.parametrize("values", [{"m": 0.01, "F0": 1.0}, {"m": 0.5, "F0": 0.5}])
def test_the_density_is_a_mixture_of_normalised_ones(values: dict[str, float]) -> None:
    """What stands beside the facets' depends on the cosine alone, and integrates to 1."""
    p, wo = MODEL.bind(values), trial.at(0.4)
    share = to_matte(p, wo.z)

    def of_matte(z: float) -> float:
        wi = trial.at(z, 1.0)
        return 2 * math.pi * (MODEL.pdf(p, wi, wo) - (1 - share) * facets_pdf(Ward(p.m, p.m), wi, wo)) / share  # type: ignore[misc]

    assert math.isclose(quad(of_matte, 0.0, 1.0, points=[p.m, 5 * p.m] if p.m < 0.1 else None)[0], 1.0, rel_tol=1e-8)


@pytest.mark.parametrize("values", [{"m": 1e-4, "F0": 1.0, "r_m": 1.0}, {"m": 0.4, "F0": 0.2}])
def test_no_sample_weighs_much(values: dict[str, float]) -> None:
    """F <= 1, the weight of facets is below 2, that of the matte part below 2 of its albedo's share."""
    model: Model = MODEL
    p = model.bind(values)
    assert model.sample is not None
    assert model.pdf is not None
    for mu in (1.0, 0.3, 1e-4, 1e-9):
        wo = trial.at(mu)
        for i in range(1, 200):
            wi = model.sample(p, wo, i / 200, (0.618 * i) % 1.0)
            if wi.z > 0.0:
                assert 0.0 <= model.evaluate(p, wi, wo) * wi.z / model.pdf(p, wi, wo) < 4.0
