"""Blinn's model with Trowbridge and Reitz's facets (losasso)."""

from __future__ import annotations

import math
from itertools import product

import pytest

from albedo_lab.model import Model
from albedo_lab.models.blinn_trowbridge_reitz import MODEL, Blinn
from albedo_lab.optics.fresnel import conductor
from tests.models import trial
from tests.models.test_cook_torrance import cavities, half_angle_cosine

ECCENTRICITIES = (0.05, 0.3, 1.0)
every_eccentricity = pytest.mark.parametrize("c", ECCENTRICITIES)


def member(**choices: str) -> Model:
    return MODEL.member(choices)[0]


@every_eccentricity
def test_the_print(c: float) -> None:
    """D G F / ((E.N) (L.N)) with a D of 1 at its peak; the model is this over 4 pi c^2."""

    def printed(light: float, viewer: float, turn: float) -> float:
        t = min(trial.half_cosine(light, viewer, turn), 1.0)
        D = (c * c / (t * t * (c * c - 1) + 1)) ** 2
        # t^2 (c^2 - 1) + 1 takes numbers near 1 from each other where c is small: 1e-11 allows c = 0.05
        return D * cavities(light, viewer, turn) / (math.cos(light) * math.cos(viewer))

    trial.assert_formula(member(as_printed="yes"), Blinn(c), printed)
    trial.assert_formula(MODEL, Blinn(c), lambda *angles: printed(*angles) / (4 * math.pi * c * c))


def test_fresnel_factors() -> None:
    p = Blinn(0.3, 0.04, 0.2, 3.9)
    for (wi, wo), as_printed in product(list(trial.random_pairs(20)), ("no", "yes")):
        base = member(as_printed=as_printed).evaluate(p, wi, wo)
        light, viewer = math.acos(wi.z), math.acos(wo.z)
        u = half_angle_cosine(light, viewer, math.atan2(wi.y, wi.x) - math.atan2(wo.y, wo.x))
        schlick = member(fresnel="schlick", as_printed=as_printed).evaluate(p, wi, wo)
        exact = member(fresnel="exact", as_printed=as_printed).evaluate(p, wi, wo)
        assert math.isclose(schlick, base * (0.04 + 0.96 * (1 - u) ** 5), rel_tol=1e-7)
        assert math.isclose(exact, base * conductor(0.2, 3.9, u), rel_tol=1e-7)


def test_reciprocal() -> None:
    for fresnel, as_printed in product(("one", "schlick", "exact"), ("no", "yes")):
        trial.assert_reciprocal(member(fresnel=fresnel, as_printed=as_printed), Blinn(0.3, 0.04, 0.2, 3.9))


@pytest.mark.parametrize("degrees", [0.0, 30.0, 60.0, 80.0])
def test_a_smooth_surface_is_a_mirror(degrees: float) -> None:
    """Heavy tails: of order c is lost to cavities. As printed it would be 4 pi c^2 times as bright."""
    mu = math.cos(math.radians(degrees))
    trial.assert_close(trial.narrow_albedo(MODEL, Blinn(1e-3), mu), 1.0, 5e-3)


@every_eccentricity
def test_the_albedo_stays_below_1(c: float) -> None:
    for mu in (1.0, 0.3, 1e-3, 1e-6):
        assert trial.narrow_albedo(MODEL, Blinn(c), mu) < 1.0 + 2e-3


@pytest.mark.parametrize(("c", "mu"), [(0.1, 0.3), (1.0, 0.8), (1.0, 0.05)])
def test_density_is_normalised(c: float, mu: float) -> None:
    trial.assert_normalised(MODEL, Blinn(c), mu)


def test_samples_follow_the_density(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(trial, "SAMPLES", 20_000)
    trial.assert_follows_density(MODEL, Blinn(0.5), 0.3, 1)


def test_weights_are_at_most_1() -> None:
    assert MODEL.sample is not None
    assert MODEL.pdf is not None
    for c, mu in product((1e-3, 0.1, 1.0), (1.0, 0.5, 1e-3, 1e-9, 1e-12)):
        p, wo = Blinn(c), trial.at(mu, 0.4)
        for u1, u2 in product((1e-12, 0.2, 0.6, 0.999999), (1e-9, 0.3, 0.8)):
            wi = MODEL.sample(p, wo, u1, u2)
            if wi.z > 0.0:
                assert 0.0 <= MODEL.evaluate(p, wi, wo) * wi.z / MODEL.pdf(p, wi, wo) <= 1.0 + 1e-9
