"""GGX: the formula in angles, two ways to draw one density, the mirror that it tends to, its oracle, its domain."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from itertools import pairwise, product
from typing import Any

import numpy as np
import pytest
from scipy.special import chdtrc

from albedo_lab.analysis import sampler as page
from albedo_lab.analysis.verdict import Subject, Trial, Verdict, judged
from albedo_lab.catalogue import find
from albedo_lab.errors import BadInput
from albedo_lab.estimate.methods import estimate
from albedo_lab.estimate.record import Estimate, Question, exact
from albedo_lab.model import Model
from albedo_lab.models.ggx import MODEL
from albedo_lab.models.microfacet import MODEL as MICROFACET
from albedo_lab.optics import fresnel
from albedo_lab.optics.frame import Direction
from albedo_lab.optics.profiles import tail_coordinate, tail_slope
from tests.models import trial
from tests.models.test_cook_torrance import half_angle_cosine
from tests.models.trial import PI, member
from tests.oracles import catalogue_albedo as oracle

FRESNEL: dict[str, tuple[dict[str, float], Callable[[float], float]]] = {
    "one": ({}, lambda u: 1.0),
    "schlick": ({"F0": 0.04}, lambda u: 0.04 + 0.96 * (1 - u) ** 5),
    "dielectric": ({"eta": 1.5}, lambda u: fresnel.dielectric(1.5, u)),
    "conductor": ({"eta": 0.2, "k": 3.9}, lambda u: fresnel.conductor(0.2, 3.9, u)),
}
ROUND = {"alpha": 0.3}
ELLIPTIC = {"alpha_x": 0.3, "alpha_y": 0.7}
SMALLEST = {"alpha": 1e-5}
LONGEST = {"alpha_x": 1.0, "alpha_y": 1e-5}
MUS = (1.0, 0.5, 0.1, 1e-3, 1e-5, 1e-9)


# The formula


def widths_of(values: dict[str, float]) -> tuple[float, float]:
    return values.get("alpha_x", values.get("alpha", 0.0)), values.get("alpha_y", values.get("alpha", 0.0))


def in_angles(
    D: Callable[[float], float], Lambda: Callable[[float], float], values: dict[str, float], G: str, F: Callable[[float], float]
) -> trial.Formula:
    """F D G / (4 v v') with the viewer at azimuth 0, the light at the azimuth `turn`.

    D(x) is that of width 1 times cos^4, x the tangent of the normal's angle over the width along its azimuth; Lambda(a) is the
    masking of width 1, a the cotangent over the width that a direction meets.
    """
    a_x, a_y = widths_of(values)

    def width(phi: float) -> float:
        return math.hypot(a_x * math.cos(phi), a_y * math.sin(phi))

    def formula(light: float, viewer: float, turn: float) -> float:
        x = math.sin(viewer) + math.sin(light) * math.cos(turn)
        y = math.sin(light) * math.sin(turn)
        delta, phi = math.atan2(math.hypot(x, y), math.cos(light) + math.cos(viewer)), math.atan2(y, x)
        slope = math.tan(delta) * math.hypot(math.cos(phi) / a_x, math.sin(phi) / a_y)
        density = D(slope) / (a_x * a_y * math.cos(delta) ** 4)
        hidden = [Lambda(1 / (width(at) * math.tan(max(theta, 1e-9)))) for theta, at in ((light, turn), (viewer, 0.0))]
        masking = 1 / (1 + sum(hidden)) if G == "smith_correlated" else 1 / ((1 + hidden[0]) * (1 + hidden[1]))
        u = half_angle_cosine(light, viewer, turn)
        return F(u) * density * masking / (4 * math.cos(light) * math.cos(viewer))

    return formula


def assert_is(model: Model, D: Callable[[float], float], Lambda: Callable[[float], float]) -> None:
    for values, G, F in product((ROUND, ELLIPTIC), ("smith", "smith_correlated"), FRESNEL):
        indices, reflectance = FRESNEL[F]
        chosen, p = member(model, {**values, **indices, "G": G, "F": F})
        trial.assert_formula(chosen, p, in_angles(D, Lambda, values, G, reflectance))


def test_formula() -> None:
    assert_is(MODEL, lambda x: 1 / (PI * (1 + x * x) ** 2), lambda a: (math.sqrt(1 + 1 / (a * a)) - 1) / 2)


def assert_agrees_with_microfacet(model: Model, D: str, width: str) -> None:
    """Round, it is the member of `microfacet` of that name."""
    for G, (F, (indices, _)) in product(("smith", "smith_correlated"), FRESNEL.items()):
        mine = member(model, {"alpha": 0.3, **indices, "G": G, "F": F})
        other = member(MICROFACET, {"D": D, width: 0.3, **indices, "G": G, "F": F})
        for wi, wo in trial.random_pairs(20):
            for f in ("evaluate", "pdf"):
                values = [getattr(m, f)(p, wi, wo) for m, p in (mine, other)]
                assert math.isclose(*values, rel_tol=1e-11)


def test_round_it_is_microfacets_ggx() -> None:
    assert_agrees_with_microfacet(MODEL, "ggx", "alpha")


def test_the_axes_are_x_and_y() -> None:
    """Widths swapped and directions mirrored at x = y give the same."""
    p, q = MODEL.bind({"alpha_x": 0.1, "alpha_y": 0.4}), MODEL.bind({"alpha_x": 0.4, "alpha_y": 0.1})
    wi, wo = trial.at(0.7, 0.3), trial.at(0.4, 2.5)
    wi_, wo_ = (Direction(w.y, w.x, w.z) for w in (wi, wo))
    assert math.isclose(MODEL.evaluate(p, wi, wo), MODEL.evaluate(q, wi_, wo_), rel_tol=1e-13)
    assert not math.isclose(MODEL.evaluate(p, wi, wo), MODEL.evaluate(q, wi, wo), rel_tol=0.1)
    # alpha_x spreads the normals along x
    assert MODEL.evaluate(q, trial.at(0.9, 0.0), trial.at(1.0)) > MODEL.evaluate(q, trial.at(0.9, 0.5 * PI), trial.at(1.0))


def test_alpha_is_shorthand_for_both() -> None:
    assert MODEL.bind({"alpha": 0.2}) == MODEL.bind({"alpha_x": 0.2, "alpha_y": 0.2})
    assert MODEL.bind({"alpha": 0.2, "alpha_y": 0.3}) == MODEL.bind({"alpha_x": 0.2, "alpha_y": 0.3})
    with pytest.raises(BadInput, match="alpha_y"):
        MODEL.bind({"alpha_y": 1e-6})


# Albedos


def quadrature(model: Model, p: Any, mu: float, tolerance: float = 1e-6, phi: float = 0.0) -> Estimate:
    return estimate(Question(model, p, mu, phi), trial.relative(tolerance), "quadrature", 0, 1)


@pytest.mark.parametrize("mu", [1.0, 0.5, 0.1, 1e-3, 1e-9])
def test_uniform_normals(mu: float) -> None:
    """alpha = 1 is D = 1/pi: 2 (1 - log 2) / (1 + mu) with independent masking, 1 - mu log(1 + 1/mu) with correlated."""
    for G, expected in (("smith", 2 * (1 - math.log(2)) / (1 + mu)), ("smith_correlated", 1 - mu * math.log1p(1 / mu))):
        answer = quadrature(*member(MODEL, {"alpha": 1.0, "G": G}), mu, 1e-8)
        assert answer.half_width < 2e-8
        assert abs(answer.value - expected) <= answer.half_width


def assert_bounds_hold(model: Model, cases: list[tuple[dict[str, float], float]]) -> None:
    """Quadrature at the tolerance of a table against the oracle, over the whole domain of the widths."""
    for values, mu in cases:
        a_x, a_y = widths_of(values)
        phi = 0.0 if a_x == a_y else 0.8
        for G in ("smith", "smith_correlated"):
            value, error = oracle.albedo(model.name, {"G": G, "F": "one", "alpha_x": a_x, "alpha_y": a_y}, mu, phi)
            answer = quadrature(*member(model, {"alpha_x": a_x, "alpha_y": a_y, "G": G}), mu, 1e-6, phi)
            assert error < 1e-8
            assert abs(answer.value - value) <= answer.half_width + error, (values, mu, G)
            assert answer.half_width <= 3e-6  # 1e-6 that was asked for, and what the rounding of directions leaves


def test_bounds_hold_over_the_domain() -> None:
    """Where the arctangent of the slope misses its bound (see the module) among them."""
    missed = [({"alpha": 3e-4}, 1.0), ({"alpha": 3e-4}, 1e-5), ({"alpha": 1e-4}, 0.5)]
    assert_bounds_hold(MODEL, [*missed, (SMALLEST, 1e-5), (SMALLEST, 0.1), (LONGEST, 0.3), (ELLIPTIC, 1e-6)])


def test_coordinate_of_the_tail() -> None:
    """Its inverse, its measure, and what is left beyond its end."""
    for y in (1e-9, 0.1, 3.0, 26.0):
        rho, measure = tail_slope(y, 0.0)
        assert math.isclose(rho, math.sinh(y), rel_tol=1e-13)
        assert math.isclose(measure, math.sinh(y) * math.cosh(y), rel_tol=1e-13)
        assert math.isclose(tail_coordinate(rho, 0.0), y, rel_tol=1e-13)
    assert 1 / (1 + tail_slope(MODEL.smooth_in.profile.end, 0.0)[0] ** 2) < math.exp(-49)


def assert_oracle_is_sound(name: str, values: dict[str, Any]) -> None:
    """The oracle's formula over plain angles, and over random vectors: 5 standard errors, one in 2 million by chance."""
    for G, F in (("smith", {"F": "one"}), ("smith_correlated", {"F": "schlick", "F0": 0.1})):
        p = {**values, "G": G, **F}
        for mu in (0.6, 1e-4):
            value, error = oracle.albedo(name, p, mu, 0.3, effort=1)
            assert error < 1e-7 * value
            assert math.isclose(oracle.second_opinion(name, p, mu, 0.3), value, rel_tol=1e-7)
        u, azimuth = np.random.default_rng(1).random((2, 100_000))
        s = np.sqrt(u)
        light = np.stack((s * np.cos(2 * PI * azimuth), s * np.sin(2 * PI * azimuth), np.sqrt(1 - u)), axis=-1)
        viewer = np.array(trial.at(0.6, 0.3))
        f = PI * oracle.evaluate(name, p, light, viewer)
        assert abs(np.mean(f) - oracle.albedo(name, p, 0.6, 0.3, effort=1)[0]) < 5 * np.std(f) / math.sqrt(len(f))
        chosen, q = member(find(name), p)
        ours = [chosen.evaluate(q, Direction(*w), Direction(*viewer)) for w in light[:50]]
        np.testing.assert_allclose(PI * np.array(ours), f[:50], rtol=1e-9)


def test_the_oracle() -> None:
    assert_oracle_is_sound("ggx", {"alpha_x": 0.3, "alpha_y": 0.5})


# Its samplers


STEP = 1e-4


def assert_density_is_the_jacobian(model: Model, **choice: str) -> None:
    """pdf |dwi/du1 x dwi/du2| = 1: what is drawn has the density that is told, wherever one looks.

    Central differences err by STEP^2 times a third derivative, 1e-5 and less here, and by the rounding of directions, which a
    narrow lobe divides by its width, grazing light by its cosine, and the difference by STEP.
    """
    chosen = model.member(choice)[0]
    assert chosen.sample is not None
    assert chosen.pdf is not None
    rng = np.random.default_rng(3)
    for values, mu in product((ROUND, ELLIPTIC, SMALLEST, {"alpha": 1.0}), MUS):
        p, wo = chosen.bind(values), trial.at(mu, 0.4)
        width = min(widths_of(values))
        tolerance = 2e-5 + 2.0**-52 / (width * max(mu, width) * STEP)
        for u1, u2 in rng.uniform(0.02, 0.98, (12, 2)).tolist():
            wi = chosen.sample(p, wo, u1, u2)
            d1, d2 = (
                np.subtract(chosen.sample(p, wo, u1 + a, u2 + b), chosen.sample(p, wo, u1 - a, u2 - b)) / (2 * STEP)
                for a, b in ((STEP, 0.0), (0.0, STEP))
            )
            area = math.sqrt(float(np.sum(np.cross(d1, d2) ** 2)))
            if wi.z > 0.0:
                assert abs(area * chosen.pdf(p, wi, wo) - 1.0) < tolerance, (values, mu, u1, u2)


WAYS = MODEL.choices[-1].options  # type: ignore[union-attr]


@pytest.mark.parametrize("way", WAYS)
def test_density_is_exact(way: str) -> None:
    assert_density_is_the_jacobian(MODEL, sampling=way)


@pytest.mark.parametrize("way", WAYS)
def test_a_density_that_is_off_is_caught(way: str) -> None:
    """By a thousandth."""
    chosen = MODEL.member({"sampling": way})[0]
    assert chosen.pdf is not None
    pdf = chosen.pdf
    off = replace(chosen, pdf=lambda p, wi, wo: 1.001 * pdf(p, wi, wo), choices=(), make=None)
    with pytest.raises(AssertionError):
        assert_density_is_the_jacobian(off)


@pytest.mark.parametrize("values", [{"alpha": 1.0}, ELLIPTIC, {"alpha": 0.01}])
def test_both_ways_draw_the_same(values: dict[str, float]) -> None:
    """Counts of either way in cells of the other's height of the normal and its azimuth, in slopes over widths."""
    p, counts = MODEL.bind(values), []
    a_x, a_y = widths_of(values)
    for mu in (0.8, 0.05):
        wo, drawn = trial.at(mu, 0.4), []
        for way, seed in zip(WAYS, (5, 6), strict=True):
            chosen = MODEL.member({"sampling": way})[0]
            assert chosen.sample is not None
            uniforms = np.random.default_rng(seed).random((20_000, 2)).tolist()
            h = np.array([chosen.sample(p, wo, u1, u2) for u1, u2 in uniforms]) + np.array(wo)
            x, y = h[:, 0] / (a_x * h[:, 2]), h[:, 1] / (a_y * h[:, 2])
            drawn.append((1 / (1 + x * x + y * y), np.arctan2(y, x)))
        edges = [np.quantile(np.concatenate(both), np.linspace(0, 1, 13)) for both in zip(*drawn, strict=True)]
        counts = [np.histogram2d(z, phi, edges)[0].ravel() for z, phi in drawn]
        total = counts[0] + counts[1]
        enough = total > 20
        statistic = float(np.sum((counts[0] - counts[1])[enough] ** 2 / total[enough]))
        assert chdtrc(int(np.sum(enough)) - 1, statistic) > trial.sidak(6)


def test_samples_of_the_projected_half_sphere() -> None:
    """The way that is not the default, where the tests of every model do not look."""
    chosen = MODEL.member({"sampling": "heitz2018"})[0]
    trial.assert_weight_is_contract(chosen, *(chosen.bind(values) for values in (ROUND, ELLIPTIC, SMALLEST)))
    for values, mu in ((ELLIPTIC, 0.3), (SMALLEST, 1e-9), ({"alpha": 1.0}, 1e-4)):
        trial.assert_normalised(chosen, chosen.bind(values), mu)


def assert_weight_is_masking_of_the_light(model: Model) -> None:
    """F G2 / G1: with F = 1 at most 1, for independent masking G1 of the light."""
    for values, G in product((ROUND, ELLIPTIC, SMALLEST, {"alpha": 1.0}), ("smith", "smith_correlated")):
        chosen, p = member(model, {**values, "G": G})
        assert chosen.weight is not None
        trial.assert_weight_is_contract(chosen, p)
        for mu, (u1, u2) in product(MUS, ((1e-9, 0.3), (0.3, 0.7), (0.999, 0.01))):
            assert 0.0 <= chosen.weight(p, trial.at(mu, 0.4), u1, u2) <= 1.0
    for F, (indices, _) in FRESNEL.items():
        chosen, p = member(model, {**ELLIPTIC, **indices, "F": F})
        trial.assert_weight_is_contract(chosen, p)


def test_weight() -> None:
    assert_weight_is_masking_of_the_light(MODEL)


HUNDRED_MILLION = 1526 << 16
CASES_AT_A_HUNDRED_MILLION: list[tuple[dict[str, Any], float]] = [
    ({"alpha": 0.3}, page.VIEWERS[1]),
    ({"alpha_x": 0.1, "alpha_y": 0.6}, page.VIEWERS[2]),
]


def assert_acquitted_at_a_hundred_million(patch: pytest.MonkeyPatch, model: Model, values: dict[str, Any], mu: float) -> None:
    """Chi-square over 576 cells and the rejected samples, the density's integral, and the estimators of the albedo."""
    patch.setattr(page, "VIEWERS", (mu,))
    patch.setattr(page, "SAMPLES", HUNDRED_MILLION)
    patch.setattr(page, "PILOTS", HUNDRED_MILLION // page.LEAST_PILOT)
    patch.setattr(page, "OTHERS", 64)
    subject = Subject(*member(model, values), exact(1.0))
    findings = judged(page.sampler(subject, Trial(budget=page.EVALUATIONS_PER_SAMPLE * HUNDRED_MILLION, threads=2)), 1e-4)
    page.measure.cache_clear()
    for finding in findings:
        print(model.name, values, finding.verdict, finding.p_value, finding.statement)
    assert {finding.verdict for finding in findings} == {Verdict.PASS}


@pytest.mark.slow
@pytest.mark.parametrize(("values", "mu"), CASES_AT_A_HUNDRED_MILLION)
@pytest.mark.parametrize("way", WAYS)
def test_samples_follow_the_density_at_a_hundred_million(
    monkeypatch: pytest.MonkeyPatch, way: str, values: dict[str, Any], mu: float
) -> None:
    assert_acquitted_at_a_hundred_million(monkeypatch, MODEL, {**values, "sampling": way}, mu)


# The mirror


def steepest(F: Callable[[float], float]) -> float:
    """The largest slope of F over the cosine, from differences over a grid that crowds at grazing."""
    c = [(i / 2000) ** 2 for i in range(2001)]
    return max(abs(F(b) - F(a)) / (b - a) for a, b in pairwise(c))


def assert_tends_to_a_mirror(model: Model, smallest: float, mean_slope: float, lost: Callable[[float, float], float]) -> None:
    """|albedo - F(mu)| <= max|F'| E|u - mu| + the share of the light that is lost below the horizon or to masking.

    A facet of slope x, its normal off the vertical by less than x, has |u - mu| <= x. Of the visible ones slope x has at most
    the weight 1 + x / mu, so that E|u - mu| <= E x + E x^2 / mu, the latter cut off at 1, since |u - mu| is never more. `lost`
    bounds the share: in order alpha^2 / mu^2 for ggx.
    """
    for F, (indices, reflectance) in FRESNEL.items():
        chosen, p = member(model, {"alpha": smallest, **indices, "F": F})
        assert chosen.mirror_limit is not None
        name, mirror = chosen.mirror_limit
        assert name == "alpha"
        for mu in (1.0, 0.5, 0.1):
            assert math.isclose(mirror(p, mu), reflectance(mu), rel_tol=1e-12)
            if F in ("one", "schlick"):
                answer = quadrature(chosen, p, mu, 1e-9)
                albedo, error = answer.value, answer.half_width
            else:  # a kernel takes seconds to compile
                albedo, error = trial.narrow_albedo(chosen, p, mu), 1e-4
            off = steepest(reflectance) * (mean_slope + smallest**2 / mu * (2 + math.log(1 / smallest**2))) + lost(smallest, mu)
            assert off < 1e-3
            assert abs(albedo - reflectance(mu)) <= off + error, (F, mu)


def test_tends_to_a_mirror() -> None:
    """E x = pi / 2 alpha. Light is missed or half as high as the mirror's only by facets steeper than mu/4, 24 alpha^2 / mu^2 of
    the visible; above that Lambda <= alpha^2 / mu^2."""
    assert_tends_to_a_mirror(MODEL, 1e-5, 0.5 * PI * 1e-5, lambda alpha, mu: 25 * alpha**2 / mu**2)


def test_limits_of_microfacet() -> None:
    """The same field where a distribution narrows to the normal; gtr does not for every gamma, nor does a print that is off."""
    for D, width in (("ggx", "alpha"), ("beckmann", "m"), ("trowbridge_reitz", "alpha")):
        chosen, p = member(MICROFACET, {"D": D, "G": "v_cavity", "F": "schlick", width: 1e-4, "F0": 0.04})
        assert chosen.mirror_limit is not None
        name, mirror = chosen.mirror_limit
        assert name == width
        assert math.isclose(mirror(p, 0.3), FRESNEL["schlick"][1](0.3), rel_tol=1e-12)
        # trowbridge_reitz draws near by one over the logarithm of alpha only
        albedo = trial.narrow_albedo(chosen, p, 0.3)
        assert abs(albedo - mirror(p, 0.3)) < (0.2 if D == "trowbridge_reitz" else 2e-3)
    misprint = {"D": "trowbridge_reitz", "as_printed": "yes"}
    for words in ({"D": "gtr"}, {"D": "blinn_phong"}, {"G": "none"}, {"diffuse": "lambert"}, misprint):
        assert MICROFACET.member(words)[0].mirror_limit is None
