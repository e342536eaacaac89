"""How models end at grazing incidence, against what is known in closed form or printed."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from typing import Any

import pytest

from albedo_lab.analysis.constant import constant
from albedo_lab.analysis.grazing import grazing, grazing_check, law
from albedo_lab.analysis.verdict import Subject, Trial, Verdict
from albedo_lab.catalogue import find
from albedo_lab.errors import BadInput, Inconclusive
from albedo_lab.model import Model
from albedo_lab.models import lambert
from albedo_lab.optics.frame import Direction
from tests.models.trial import member


def subject(model: Model, scale: float | None = None, **values: Any) -> Subject:
    chosen, p = member(model, values)
    return Subject(chosen, p, constant(chosen, p, scale))


DIVERGENT: list[tuple[str, dict[str, Any], float]] = [
    ("ward", {}, -0.5),
    ("ward", {"m": 1e-4}, -0.5),
    ("ward", {"m_x": 0.1, "m_y": 0.4}, -0.5),
    ("ward", {"form": "half_vector"}, -0.5),
    ("product_phong", {"n": 1e8}, -1.0),
    ("product_phong", {"n": 1.0}, -1.0),
    ("sqrt_phong", {}, -0.5),
    ("schlick", {"directional": "eq12"}, -1.0),
    ("schlick", {"directional": "eq12", "r": 1e-6}, -1.0),
    ("cook_torrance", {"geometry": "none"}, -1.0),
    ("minnaert", {"k": 0.3}, -0.7),
    ("minnaert", {"k": 0.9}, -0.1),
]


@pytest.mark.parametrize(("name", "values", "exponent"), DIVERGENT)
def test_divergent(name: str, values: dict[str, Any], exponent: float) -> None:
    found = law(subject(find(name), **values))
    assert found.behaviour == "diverges"
    assert found.exponent.low <= exponent <= found.exponent.high
    assert found.exponent.half_width < 1e-3
    assert found.limit == math.inf


BOUNDED: list[tuple[str, float | None, dict[str, Any], float]] = [
    ("cook_torrance", None, {}, 1.0),
    ("cook_torrance", None, {"m": 1e-4}, 1.0),
    ("mirror", None, {"F": 0.3}, 0.3),
    ("lambert", None, {"albedo": 0.7}, 0.7),
    ("minnaert", None, {"k": 1.0}, 1.0),
    ("stretched_phong", None, {"n": 1.0}, 3.0 / 4.0),  # (n + 2) / (2 (n + 1)), eq. 26
    ("stretched_phong", None, {"n": 20.0}, 22.0 / 42.0),
    ("phong", None, {"n": 0.0}, 0.5),
    ("phong", None, {"n": 1.0}, 1.0 / math.pi),  # 3/(2 pi) times the integral of sin^2 theta cos theta cos phi over cos phi > 0
    ("plus_phong", None, {"n": 100.0}, 102.0 / 101.0),
    ("blinn", 1.0 / (2.0 * math.pi), {"n": 2.0}, 1.0 / 6.0),
    ("schlick_isotropic", None, {}, 1.0),
    ("schlick_isotropic", None, {"r": 1e-6}, 1.0),
    ("p_phong", None, {"p": 1.0, "n": 20.0}, 22.0 / 42.0),
]


@pytest.mark.parametrize(("name", "scale", "values", "limit"), BOUNDED)
def test_bounded(name: str, scale: float | None, values: dict[str, Any], limit: float) -> None:
    found = law(subject(find(name), scale, **values))
    assert found.behaviour == "bounded"
    assert found.exponent.low <= 0.0 <= found.exponent.high
    assert abs(found.limit - limit) <= found.limit_error + 1e-15
    assert found.limit_error < 1e-3


@pytest.mark.parametrize("name", ["oren_nayar", "modified_ward", "schlick", "phong_blend", "microfacet", "plastic"])
def test_bounded_by_something(name: str) -> None:
    found = law(subject(find(name)))
    assert found.behaviour == "bounded"
    assert found.limit > 0.0
    assert found.limit_error < 1e-8


@pytest.mark.parametrize("values", [{}, {"fresnel": "one"}, {"sigma0": 5.0, "tau": 10.0}])
def test_he_torrance_vanishes_like_a_logarithm(values: dict[str, Any]) -> None:
    """Slower than any power: the interval on s holds 0, and the limit is 0 all the same."""
    found = law(subject(find("he_torrance"), **values))
    assert found.behaviour == "vanishes"
    assert found.limit == 0.0
    assert found.exponent.low <= 0.0 <= found.exponent.high


def dirac(f: Callable[[float], float]) -> Model:
    """A model with an albedo of any kind: all of it is in the Dirac part."""
    return replace(lambert.MODEL, evaluate=nothing, mirror=lambda p, mu: f(mu))


def nothing(p: Any, wi: Direction, wo: Direction) -> float:
    return 0.0


def logarithm(mu: float) -> float:
    return -math.log(mu)


@pytest.mark.parametrize(
    ("f", "behaviour", "exponent", "limit"),
    [
        (lambda mu: 0.3 + mu, "bounded", 0.0, 0.3),
        (lambda mu: 0.3 + mu**0.5 + mu, "bounded", 0.0, 0.3),
        (lambda mu: 0.3 - 0.2 * mu**0.25, "bounded", 0.0, 0.3),
        (lambda mu: 0.3 + 0.5 / logarithm(mu), "bounded", 0.0, 0.3),
        (lambda mu: 0.3 + mu * logarithm(mu), "bounded", 0.0, 0.3),
        (lambda mu: -0.3 + mu, "bounded", 0.0, -0.3),
        (lambda mu: 1.0 / logarithm(mu), "vanishes", 0.0, 0.0),
        (lambda mu: 1.0 / (1.0 + logarithm(mu)) ** 2, "vanishes", 0.0, 0.0),
        (lambda mu: mu**0.3 + mu, "vanishes", 0.3, 0.0),
        (lambda mu: mu * logarithm(mu), "vanishes", 1.0, 0.0),
        (lambda mu: 0.0, "vanishes", math.nan, 0.0),
        (logarithm, "diverges", 0.0, math.inf),
        (lambda mu: 1.0 + 1e-3 * mu**-0.5, "diverges", -0.5, math.inf),
        (lambda mu: mu**-0.5 * logarithm(mu), "diverges", -0.5, math.inf),
        (lambda mu: mu**-0.5 * (1.0 + mu**0.5), "diverges", -0.5, math.inf),
        (lambda mu: mu**-0.02, "diverges", -0.02, math.inf),
        (lambda mu: math.nan if mu < 1e-9 else 1.0, "undefined", math.nan, math.nan),
        (lambda mu: math.inf if mu < 1e-9 else 1.0, "undefined", math.nan, math.nan),
        (lambda mu: math.sin(1.0 / mu), "undecided", math.nan, math.nan),
    ],
)
def test_laws_known_in_closed_form(f: Callable[[float], float], behaviour: str, exponent: float, limit: float) -> None:
    found = law(subject(dirac(f), 1.0))
    assert found.behaviour == behaviour, found
    if not math.isnan(exponent):
        assert found.exponent.low <= exponent <= found.exponent.high
    if math.isfinite(limit):
        assert abs(found.limit - limit) <= found.limit_error + 1e-15
    elif not math.isnan(limit):
        assert found.limit == limit


def test_the_constant_scales_the_limit_and_its_error() -> None:
    once, twice = law(subject(find("oren_nayar"), 1.0)), law(subject(find("oren_nayar"), 2.0))
    assert (twice.limit, twice.limit_error) == (2.0 * once.limit, 2.0 * once.limit_error)
    assert twice.exponent == once.exponent
    assert math.isnan(law(subject(find("ward"), 0.0)).limit)


def test_the_check_reports_every_order() -> None:
    found = grazing_check(subject(find("phong_original")), Trial())
    assert [(f.verdict, f.details["order"], f.details["behaviour"]) for f in found] == [
        (Verdict.REPORTED, "wi", "bounded"),
        (Verdict.REPORTED, "wo", "diverges"),
    ]
    assert found[1].figure == pytest.approx(-1.0)


def test_the_table() -> None:
    table = grazing("ward", m_x=0.1, m_y=[0.1, 0.4], phi_deg=[0.0, 45.0])
    columns = "model form as_printed m m_x m_y scale phi_deg exponent standard_error ci95_low ci95_high samples method seed"
    assert list(table.columns) == [*columns.split(), "behaviour", "limit", "limit_error", "order"]
    assert list(zip(table.m_y, table.phi_deg, strict=True)) == [(0.1, 0.0), (0.4, 0.0), (0.4, 45.0)]
    assert set(table.behaviour) == {"diverges"}
    assert "phi_deg" not in grazing("phong", n=[1.0, 2.0]).columns
    assert list(grazing("phong_original").order) == ["wi", "wo"]


def test_what_is_refused() -> None:
    with pytest.raises(BadInput, match="method"):
        grazing("ward", method="rqmc")
    with pytest.raises(BadInput, match="phi_deg"):
        grazing("ward", phi_deg=[0.0, math.inf])
    with pytest.raises(BadInput, match="no such parameter"):
        grazing("ward", n=1.0)
    with pytest.raises(Inconclusive, match="tolerance"):
        grazing("he_torrance", tolerance=1e-6)
    assert grazing("ward", tolerance=1e-6).behaviour[0] == "diverges"
