"""Finiteness, positivity and reciprocity: sound models are acquitted, sick twins convicted with a witness that reproduces."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from albedo_lab import catalogue
from albedo_lab.analysis import crowd
from albedo_lab.analysis.pointwise import ASYMMETRY, finiteness, positivity, reciprocity, witness_text
from albedo_lab.analysis.verdict import Finding, Subject, Trial, Verdict
from albedo_lab.estimate.record import exact
from albedo_lab.model import Model
from albedo_lab.optics.frame import Direction
from tests.models import trial

NAMES = [name for name in catalogue.names() if name != "merl"]
CHECKS = (finiteness, positivity, reciprocity)
FAST_MEMBERS = 1
"""Of a family; each takes two kernels."""

Check = Callable[[Subject, Trial], list[Finding]]
Evaluate = Callable[[Any, Direction, Direction], float]
Change = Callable[[float, Direction, Direction], float]


def subject(model: Model, p: Any) -> Subject:
    return Subject(model, p, exact(1.0))


def found(check: Check, accused: Subject, seed: int = 0) -> Finding:
    (finding,) = check(accused, Trial(seed=seed))
    return finding


def twin(name: str, change: Change, **values: Any) -> Subject:
    """A model whose f is changed."""
    model, p = trial.member(catalogue.find(name), values)
    evaluate = model.evaluate

    def changed(p: Any, wi: Direction, wo: Direction) -> float:
        return change(evaluate(p, wi, wo), wi, wo)

    return subject(replace(model, evaluate=changed), p)


def own(evaluate: Evaluate) -> Subject:
    """A model of one's own, without a sampler."""
    return subject(replace(catalogue.find("mirror"), name="own", evaluate=evaluate), catalogue.find("mirror").bind({}))


def assert_convicted(check: Check, accused: Subject, seeds: range = range(2)) -> Finding:
    for seed in seeds:
        finding = found(check, accused, seed)
        assert finding.verdict is Verdict.FAIL, finding
        assert finding.figure > finding.threshold
        assert finding.witness
    return finding


# The crowd


def test_every_pair_is_two_unit_vectors_above_the_surface() -> None:
    rng = np.random.default_rng(1)
    under_sky, weights = crowd.sky(4096, rng)
    scattered = crowd.scattered(4096, rng)
    for pairs in (crowd.corners(), scattered, under_sky, crowd.around(scattered, rng)):
        for w in (pairs.wi, pairs.wo):
            assert np.allclose(np.sum(w * w, axis=1), 1.0, rtol=0.0, atol=1e-14)
            assert np.all(w[:, 2] >= 0.999e-12)
    assert len(weights) == len(under_sky)
    assert np.all(weights >= 0.0)


def test_the_crowd_holds_what_it_promises() -> None:
    """Exactly normal, exactly mirrored, exactly retro, exactly on an axis; within 1e-8 of them; and as grazing as 1e-11."""
    pairs = crowd.scattered(1 << 16, np.random.default_rng(3))
    level = np.hypot(pairs.wi[:, 0], pairs.wi[:, 1])
    mirrored = np.max(np.abs(pairs.wi + pairs.wo * [1, 1, -1]), axis=1)
    retro = np.max(np.abs(pairs.wi - pairs.wo), axis=1)
    for distance in (level, mirrored, retro, np.abs(pairs.wo[:, 1]), np.abs(pairs.wi[:, 0])):
        assert np.sum(distance == 0.0) > 30
        assert np.sum((distance > 0.0) & (distance < 1e-7)) > 30
    for w in (pairs.wi, pairs.wo):
        assert np.sum(w[:, 2] < 1e-11) > 300


def test_weights_under_the_sky_integrate() -> None:
    """1, and zi^2 zo^2, whose mean under cos cos / pi^2 is 1/4; errors of the mean from the spread of the summands."""
    pairs, weights = crowd.sky(1 << 16, np.random.default_rng(5))
    for values, expected in ((np.ones(len(pairs)), 1.0), (pairs.wi[:, 2] ** 2 * pairs.wo[:, 2] ** 2, 0.25)):
        error = math.sqrt(len(pairs)) * float(np.std(weights * values))
        assert abs(float(np.sum(weights * values)) - expected) < 5.0 * error
        assert error < 0.01


# Sound models


def assert_acquitted(model: Model, p: Any) -> None:
    for check in CHECKS:
        finding = found(check, subject(model, p))
        if check is reciprocity and not model.reciprocal:
            assert finding.verdict is Verdict.FAIL
            assert finding.claim.startswith("not reciprocal")
        elif check is positivity and not model.positive:
            assert finding.claim == "not promised"
        else:
            assert finding.verdict is Verdict.PASS, (model.title, p, finding)
            assert not finding.witness


@pytest.mark.parametrize("name", NAMES)
def test_sound_models_are_acquitted(name: str) -> None:
    specimens = trial.specimens(catalogue.find(name))
    few = list(dict.fromkeys(model for model, _ in specimens))[:FAST_MEMBERS]
    for model, p in specimens:
        if model in few:
            assert_acquitted(model, p)


@pytest.mark.slow
@pytest.mark.parametrize("name", NAMES)
def test_all_specimens_are_acquitted(name: str) -> None:
    for model, p in trial.specimens(catalogue.find(name)):
        assert_acquitted(model, p)


@pytest.mark.parametrize("name", ["phong", "blinn", "modified_ward", "schlick", "oren_nayar", "lafortune"])
def test_reciprocal_models_are_so_to_the_last_digits(name: str) -> None:
    """The threshold is 1e5 times what rounding does to any of them."""
    for model, p in trial.specimens(catalogue.find(name)):
        assert found(reciprocity, subject(model, p)).figure < 1e-5 * ASYMMETRY


def textbook(width: float) -> Evaluate:
    """Cook and Torrance as they write it, with dot products of a normalised half-vector, and V.H where L.H would do as well."""

    def evaluate(p: Any, wi: Direction, wo: Direction) -> float:
        x, y, z = wi.x + wo.x, wi.y + wo.y, wi.z + wo.z
        size = math.sqrt(x * x + y * y + z * z)
        nh = z / size
        vh = (wo.x * x + wo.y * y + wo.z * z) / size
        tangent = (1.0 - nh * nh) / (nh * nh)
        d = math.exp(-tangent / (width * width)) / (math.pi * width * width * nh**4)
        g = min(1.0, 2.0 * nh * wo.z / vh, 2.0 * nh * wi.z / vh) if vh > 0.0 else 0.0
        return d * g / (4.0 * wi.z * wo.z) * (0.04 + 0.96 * abs(1.0 - vh) ** 5)

    return evaluate


@pytest.mark.parametrize("width", [1e-3, 0.1, 0.5])
def test_rounding_of_dot_products_is_forgiven(width: float) -> None:
    """V.H and L.H differ by an ulp of 1, which at grazing mirror directions is many ulps of themselves."""
    for seed in range(3):
        finding = found(reciprocity, own(textbook(width)), seed)
        assert finding.verdict is Verdict.PASS, finding


def test_negative_by_rounding_is_forgiven() -> None:
    """A sine squared as a difference is now and then below 0 near the normal; so is what should be 0 and is 1e-17 of the mean."""
    accused = own(lambda p, wi, wo: 1.0 - (wi.x * wi.x + wi.y * wi.y) - wi.z * wi.z + (0.0 if wi.z == wo.z else 1.0))
    finding = found(positivity, accused)
    assert finding.details["negative"] > 0
    assert finding.verdict is Verdict.PASS, finding
    assert found(positivity, own(lambda p, wi, wo: 1.0 if wi.x > 0.0 else -1e-17)).verdict is Verdict.PASS


def test_negative_next_to_something_bright_is_not_forgiven() -> None:
    """Among neighbours of 1e10, f = -0.01 is as negative as elsewhere."""
    accused = own(lambda p, wi, wo: -0.01 if wi.x < 0.0 < wo.x else 1.0 / (wi.z + wo.z))
    assert assert_convicted(positivity, accused).figure > 1e-3


# Sick ones


def lobe_of_two_degrees(wi: Direction, wo: Direction) -> bool:
    return (wi.x + wo.x) ** 2 + (wi.y + wo.y) ** 2 + (wi.z - wo.z) ** 2 < math.radians(2.0) ** 2


NOT_FINITE: dict[str, Change] = {
    "NaN where the light is exactly normal": lambda f, wi, wo: math.nan if wi.z == 1.0 else f,
    "NaN where the viewer is exactly normal": lambda f, wi, wo: math.nan if wo.z == 1.0 else f,
    "NaN below mu = 1e-6": lambda f, wi, wo: math.nan if wi.z < 1e-6 else f,
    "NaN below mu = 2e-12, both": lambda f, wi, wo: math.nan if max(wi.z, wo.z) < 2e-12 else f,
    "infinite where light and viewer are the same": lambda f, wi, wo: math.inf if wi.x == wo.x and wi.y == wo.y else f,
    "infinite in the exact mirror direction": lambda f, wi, wo: math.inf if wi.x == -wo.x and wi.y == -wo.y else f,
    "minus infinity on an axis": lambda f, wi, wo: -math.inf if wi.y == 0.0 and wi.x < 0.0 else f,
    "NaN everywhere": lambda f, wi, wo: math.nan,
}


@pytest.mark.parametrize("sickness", NOT_FINITE)
def test_what_is_not_finite_is_convicted(sickness: str) -> None:
    finding = assert_convicted(finiteness, twin("phong", NOT_FINITE[sickness], n=20.0))
    assert "nan" in finding.witness or "inf" in finding.witness
    for check in (positivity, reciprocity):  # they must cope
        found(check, twin("phong", NOT_FINITE[sickness], n=20.0))


def test_nothing_finite_leaves_the_others_open() -> None:
    for check in (positivity, reciprocity):
        assert found(check, twin("phong", NOT_FINITE["NaN everywhere"], n=20.0)).verdict is Verdict.INCONCLUSIVE


NEGATIVE: dict[str, Change] = {
    "a narrow lobe about the mirror direction": lambda f, wi, wo: -0.01 if lobe_of_two_degrees(wi, wo) else f,
    "a little too much taken off": lambda f, wi, wo: f - 1e-9,
    "at grazing light": lambda f, wi, wo: f - 0.001 if wi.z < 1e-5 else f,
    "everywhere": lambda f, wi, wo: -1.0 - f,
    "in one corner": lambda f, wi, wo: -0.1 if wi.x > 0.9 and wo.y > 0.9 else f,
}


@pytest.mark.parametrize("sickness", NEGATIVE)
def test_what_is_negative_is_convicted(sickness: str) -> None:
    finding = assert_convicted(positivity, twin("phong", NEGATIVE[sickness], n=20.0))
    assert "= -" in finding.witness
    assert found(finiteness, twin("phong", NEGATIVE[sickness], n=20.0)).verdict is Verdict.PASS


ASYMMETRIC: dict[str, tuple[Change, float]] = {
    "a thousandth": (lambda f, wi, wo: f * (1.0 + 1e-3 * wi.z), 0.99e-3),
    "a hundred-millionth": (lambda f, wi, wo: f * (1.0 + 1e-8 * wi.z), 0.9e-8),
    "a factor of one cosine": (lambda f, wi, wo: f * wi.z, 0.99),
    "only near grazing": (lambda f, wi, wo: f * 1.01 if wi.z < 1e-4 else f, 0.0099),
    "one-sided azimuth": (lambda f, wi, wo: f if wi.x > 0.0 else 0.0, 1.0),
    "a lobe that the light alone is near": (lambda f, wi, wo: f + (1.0 if wi.z > 0.9999 else 0.0), 0.99),
    "only in the mirror direction": (lambda f, wi, wo: f * (1.2 if lobe_of_two_degrees(wi, wo) and wi.x > 0.0 else 1.0), 0.16),
}


@pytest.mark.parametrize("sickness", ASYMMETRIC)
def test_what_is_not_reciprocal_is_convicted(sickness: str) -> None:
    change, at_least = ASYMMETRIC[sickness]
    finding = assert_convicted(reciprocity, twin("phong", change, n=20.0))
    assert at_least <= finding.figure <= 1.0
    assert finding.claim.startswith("reciprocal (neumann1999")


def test_a_thousandth_in_the_narrowest_lobe_is_convicted() -> None:
    finding = assert_convicted(reciprocity, twin("phong", lambda f, wi, wo: f * (1.001 if wi.x > 0.0 else 1.0), n=1e8))
    assert math.isclose(finding.figure, 1e-3, rel_tol=0.02)


@pytest.mark.parametrize(
    ("accused", "norm"),
    [
        # integral of |x - y| x y over the unit square 1/15, of (x + y)/2 x y 1/6
        (own(lambda p, wi, wo: wi.z), 0.4),
        # a lobe as narrow as 1e-4 sees its own mirror direction: one of the two is 1.5, the other 1
        (twin("phong", lambda f, wi, wo: f * (1.5 if wi.x > 0.0 else 1.0), n=1e8), 0.4),
    ],
)
def test_white_sky_norm(accused: Subject, norm: float) -> None:
    details = assert_convicted(reciprocity, accused).details
    assert abs(details["white_sky_norm"] - norm) < 4.0 * details["white_sky_norm_error"] + 1e-4
    assert details["white_sky_norm_error"] < 0.02


SICK_SAMPLERS: dict[str, dict[str, Any]] = {
    "density negative at grazing viewers": {"pdf": lambda p, wi, wo: -1.0 if wo.z < 1e-6 else wi.z / math.pi},
    "density infinite at the normal": {"pdf": lambda p, wi, wo: math.inf if wi.z == 1.0 else wi.z / math.pi},
    "density 0 where it samples": {"pdf": lambda p, wi, wo: 0.0 if wi.x > 0.0 else wi.z / math.pi},
    "samples NaN for a viewer at the normal": {
        "sample": lambda p, wo, u1, u2: Direction(math.nan if wo.z == 1.0 else 0.0, 0.0, 1.0)
    },
    "samples too long": {"sample": lambda p, wo, u1, u2: Direction(0.01, 0.0, 1.0)},
    "samples NaN for the rarest uniforms": {"sample": lambda p, wo, u1, u2: Direction(0.0, 0.0, math.nan if u1 < 1e-14 else 1.0)},
}


@pytest.mark.parametrize("sickness", SICK_SAMPLERS)
def test_what_is_wrong_with_a_sampler_is_convicted(sickness: str) -> None:
    model = catalogue.find("lambert")
    assert_convicted(finiteness, subject(replace(model, **SICK_SAMPLERS[sickness]), model.bind({})))


def test_a_sick_dirac_part_is_convicted() -> None:
    model = catalogue.find("mirror")
    p = model.bind({})
    for value in (math.nan, -0.1):
        accused = subject(replace(model, mirror=lambda p, mu, r=value: r if mu < 1e-8 else 1.0), p)
        assert_convicted(finiteness if math.isnan(value) else positivity, accused)
    divided = replace(model, mirror=lambda p, mu: 1.0 / (1.0 - mu))
    assert "nan" in assert_convicted(finiteness, subject(divided, p)).witness


def test_a_sampler_without_a_density_and_the_other_way_round() -> None:
    model = catalogue.find("lambert")
    for without in ({"sample": None}, {"pdf": None}, {"sample": None, "pdf": None}):
        finding = found(finiteness, subject(replace(model, **without), model.bind({})))  # type: ignore[arg-type]
        assert finding.verdict is Verdict.PASS
        assert ("no sampler" in finding.statement) == ("sample" in without)


# Witnesses


@pytest.mark.parametrize(("name", "values"), [("phong_original", {"n": 20.0}), ("minnaert", {"as_printed": "yes", "k": 0.5})])
def test_a_witness_reproduces(name: str, values: dict[str, Any]) -> None:
    """The line of Python gives the value that stands before it."""
    witness = assert_convicted(reciprocity, subject(*trial.member(catalogue.find(name), values))).witness
    told, line = witness.split("; ", 1)
    scope: dict[str, Any] = {"find": catalogue.find, "Direction": Direction}
    setup, expression = line.split("; ")
    exec(setup, scope)
    assert math.isclose(eval(expression, scope), float(told.split("f(wi, wo) = ")[1].split(",")[0]), rel_tol=1e-8)


def test_a_witness_is_no_more_extreme_than_it_must_be() -> None:
    """phong_original is not reciprocal anywhere; the witness is not at 1e-12, nor where the lobe has underflowed."""
    finding = found(reciprocity, subject(*trial.member(catalogue.find("phong_original"), {"n": 20.0})))
    assert float(finding.witness.split("f(wo, wi) = ")[1].split(";")[0]) > 1e-3


def test_a_witness_tells_grazing_directions_by_their_cosine() -> None:
    accused = subject(*trial.member(catalogue.find("ward"), {"m_x": 0.1, "m_y": 0.2}))
    text = witness_text(accused, trial.at(1e-9, math.pi / 2), trial.at(0.5, -math.pi / 2), {"f(wi, wo)": -1.0})
    assert text.startswith(
        "wi at mu 1e-09, phi 90 deg, wo at theta 60 deg, phi 270 deg: f(wi, wo) = -1; m = find('ward').member("
    )
    assert "m.bind({'m_x': 0.1, 'm_y': 0.2})" in text


def test_a_model_of_ones_own_is_not_looked_up() -> None:
    witness = assert_convicted(positivity, own(lambda p, wi, wo: -1.0)).witness
    assert "m = model;" in witness


def test_same_seed_same_finding_whatever_was_checked_before() -> None:
    accused = subject(*trial.member(catalogue.find("phong_original"), {"n": 20.0}))
    first = found(reciprocity, accused, 7)
    found(reciprocity, subject(*trial.member(catalogue.find("phong"), {"n": 1.0})), 7)
    found(finiteness, accused, 8)
    again = found(reciprocity, accused, 7)
    assert first == again
    assert first != found(reciprocity, accused, 8)


def test_a_small_budget_is_kept() -> None:
    accused = subject(*trial.member(catalogue.find("phong"), {"n": 1.0}))
    (finding,) = reciprocity(accused, Trial(budget=1 << 10))
    assert finding.details["pairs"] <= len(crowd.corners()) + (1 << 6)
