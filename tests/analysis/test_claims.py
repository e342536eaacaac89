"""What the sources say of their models, found or refuted."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

import pytest

from albedo_lab.analysis.claims import claims, holds
from albedo_lab.analysis.constant import constant
from albedo_lab.analysis.verdict import Finding, Subject, Trial, Verdict
from albedo_lab.catalogue import find
from albedo_lab.model import Claim, DivergesAtGrazing, EnergyConserving, GrazingAlbedo, Model, Reciprocal
from albedo_lab.models import lambert, mirror
from tests.models.trial import member


def subject(model: Model, scale: float | None = None, **values: Any) -> Subject:
    chosen, p = member(model, values)
    return Subject(chosen, p, constant(chosen, p, scale))


def judged(model: Model, findings: list[Finding] | None = None, scale: float | None = None, **values: Any) -> dict[str, Finding]:
    """What becomes of every claim, by the first words of its source."""
    tried = subject(model, scale, **values)
    found = claims(tried, Trial(), findings or [])
    assert all(f.check == "claims" for f in found)
    return {type(claim).__name__: f for claim, f in zip(tried.model.claims, found, strict=True)}


@pytest.mark.parametrize(
    ("name", "values", "expected"),
    [
        ("ward", {}, {"Reciprocal": "PASS", "EnergyConserving": "FAIL", "DivergesAtGrazing": "PASS"}),
        ("ward", {"m": 0.3}, {"Reciprocal": "PASS", "EnergyConserving": "SKIPPED", "DivergesAtGrazing": "PASS"}),
        ("cook_torrance", {}, {"EnergyConserving": "PASS", "DivergesAtGrazing": "FAIL"}),
        ("stretched_phong", {"n": 5.0}, {"Reciprocal": "PASS", "EnergyConserving": "PASS", "GrazingAlbedo": "PASS"}),
        ("stretched_phong", {"n": 1.0}, {"Reciprocal": "PASS", "EnergyConserving": "FAIL", "GrazingAlbedo": "PASS"}),
        ("product_phong", {}, {"Reciprocal": "PASS", "DivergesAtGrazing": "PASS"}),
        ("mirror", {"F": 0.5}, {"EnergyConserving": "PASS", "GrazingAlbedo": "PASS"}),
        ("mirror", {"F": 0.0}, {"EnergyConserving": "PASS", "GrazingAlbedo": "PASS"}),
        ("schlick", {}, {"Reciprocal": "PASS", "EnergyConserving": "FAIL"}),
        ("phong_original", {}, {}),
    ],
)
def test_the_catalogue(name: str, values: dict[str, Any], expected: dict[str, str]) -> None:
    found = judged(find(name), **values)
    assert {claim: str(f.verdict) for claim, f in found.items()} == expected
    for f in found.values():
        assert f.claim
        words = {"PASS": "found: ", "FAIL": "refuted: ", "SKIPPED": "says nothing"}[str(f.verdict)]
        assert f.statement.startswith(words)
        assert bool(f.witness) == (f.verdict is Verdict.FAIL)


def test_a_claim_is_told_in_the_words_of_its_source() -> None:
    found = judged(find("ward"))["EnergyConserving"]
    assert found.claim.startswith("neumann1999 §6.2, citing Ward: where m < 0.2: The albedo of the model")


def test_what_other_checks_have_found_is_not_searched_for_again() -> None:
    """A finding that no check would come to by itself."""
    known = [
        Finding("reciprocity", Verdict.FAIL, 0.5, 1e-9, "one-sided", "f(a, b) = 1, f(b, a) = 2"),
        Finding("energy", Verdict.PASS, 1.0, 1.0, "sound"),
        Finding("energy", Verdict.INCONCLUSIVE, 1.0, 1.0, "the other order is not known"),
    ]
    found = judged(lambert.MODEL, known)
    assert (found["Reciprocal"].verdict, found["Reciprocal"].witness) == (Verdict.FAIL, known[0].witness)
    assert found["EnergyConserving"].verdict is Verdict.INCONCLUSIVE
    assert found["EnergyConserving"].statement == "left open: the other order is not known"


def test_claims_are_about_the_default_constant() -> None:
    """With a constant of the user's own, the energy found is not what the source speaks of."""
    known = [Finding("energy", Verdict.FAIL, 2.0, 1.0, "too bright")]
    assert judged(lambert.MODEL, known, 2.0)["EnergyConserving"].verdict is Verdict.PASS
    assert judged(mirror.MODEL, scale=0.5, F=0.5)["GrazingAlbedo"].verdict is Verdict.PASS


def with_claims(*said: Claim) -> Model:
    return replace(lambert.MODEL, claims=said)


def test_false_claims() -> None:
    found = judged(with_claims(DivergesAtGrazing("here"), GrazingAlbedo("here", value=lambda p: 0.999)))
    assert found["DivergesAtGrazing"].verdict is Verdict.FAIL
    assert found["GrazingAlbedo"].verdict is Verdict.FAIL
    assert found["GrazingAlbedo"].figure == pytest.approx(0.001, abs=1e-9)
    assert "0.999 is claimed" in found["GrazingAlbedo"].witness


def test_claims_that_cannot_be_decided() -> None:
    silent = with_claims(GrazingAlbedo("here"), Claim("here"))
    assert {f.verdict for f in judged(silent).values()} == {Verdict.INCONCLUSIVE}
    vague = with_claims(DivergesAtGrazing("here", where="sunny days"), EnergyConserving("here", where="sunny days"))
    found = judged(vague, albedo=0.5)
    assert found["DivergesAtGrazing"].verdict is Verdict.INCONCLUSIVE
    assert "could not be decided" in found["DivergesAtGrazing"].statement
    assert found["EnergyConserving"].verdict is Verdict.PASS
    nowhere = judged(replace(lambert.MODEL, mirror=lambda p, mu: math.nan, claims=(DivergesAtGrazing("here"),)))
    assert nowhere["DivergesAtGrazing"].verdict is Verdict.INCONCLUSIVE


def test_reciprocity_is_looked_for_where_no_check_has() -> None:
    claimed = replace(find("phong_original"), claims=(Reciprocal("nobody"),))
    assert judged(claimed)["Reciprocal"].verdict is Verdict.FAIL


@pytest.mark.parametrize(
    ("name", "values", "where", "expected"),
    [
        ("phong", {"n": 1.0}, "n >= 1", True),
        ("phong", {"n": 0.9}, "n >= 1", False),
        ("phong", {"n": 5.0}, "1 <= n < 5", False),
        ("phong", {"n": 5.0}, "n = 5", True),
        ("phong", {"n": 5.0}, "n == 5 and not n != 5", True),
        ("phong", {"n": 5.0}, "n < 1 or n > 4", True),
        ("ward", {"m_x": 0.1, "m_y": 0.3}, "m < 0.2", False),
        ("ward", {"m_x": 0.1, "m_y": 0.15}, "m < 0.2", True),
        ("ward", {}, "form = 'tangent'", True),
        ("plastic", {"a_d": 0.5, "a_s": 0.4}, "a_s + a_d <= 1", True),
        ("plastic", {"a_d": 0.7, "a_s": 0.4}, "a_s + a_d <= 1", False),
        ("he_torrance", {"a_d": 0.0}, "a_d = 0", True),
        ("phong", {}, "n / 0 > 1", None),
        ("phong", {}, "m < 0.2", None),
        ("phong", {}, "n", None),
        ("phong", {}, "for large n", None),
        ("phong", {}, "__import__('os').getcwd() == 'x'", None),
        ("phong", {}, "n < 'x'", None),
        ("phong", {}, "n ** 2 > 0", None),
    ],
)
def test_where_a_claim_holds(name: str, values: dict[str, Any], where: str, expected: bool | None) -> None:
    assert holds(where, subject(find(name), 1.0, **values)) is expected
