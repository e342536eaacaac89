"""Negative controls: each sick model is convicted by the checks that should, each healthy one of what is true of it only."""

from __future__ import annotations

from collections.abc import Sequence

import pytest

from albedo_lab import catalogue
from albedo_lab.analysis.verdict import Finding, Verdict
from tests.controls.court import convictions, findings, table
from tests.controls.healthy import TRUE_FINDINGS, UNDECIDED
from tests.controls.record import Sick
from tests.controls.sick import SICK
from tests.models import trial

POINTWISE = {"finiteness", "positivity", "reciprocity"}
QUICK = [sick for sick in SICK if set(sick.convicted_by) <= POINTWISE]
QUICK += [sick for sick in SICK if sick.name in ("lambert_1001", "stretched_phong_1001", "lambert_pdf_1.001", "weight_no_pdf")]
"""Checks of pairs of directions cost next to nothing; of those that integrate or sample, a few."""
QUICK_HEALTHY = ("lambert", "mirror", "phong_original")
SEEDS = 3


def named(sick: Sick) -> str:
    return sick.name


def assert_convicted(sick: Sick) -> None:
    told = convictions(findings(sick.model, sick.values, only=sick.convicted_by))
    print(table([(sick, told)]).splitlines()[-1])
    assert set(told) == set(sick.convicted_by), f"{sick.injected}: convicted by {', '.join(told) or 'nothing'}"
    assert all(finding.witness for finding in told.values())


def assert_only_what_is_true(name: str, seed: int) -> None:
    found = findings(catalogue.find(name), trial.SPECIMENS[name][0], seed=seed)
    expected = TRUE_FINDINGS.get(name, {})
    false = [f for f in found if f.verdict is Verdict.FAIL and f.check not in expected]
    assert not false, [f"{f.check}: {f.statement}; p = {f.p_value}" for f in false]
    assert set(convictions(found)) == set(expected), "a true fault was not found"
    open_ = undecided(found)
    assert {f.check for f in open_} == set(UNDECIDED.get(name, {})), [f"{f.check}: {f.statement}" for f in open_]


def undecided(found: Sequence[Finding]) -> list[Finding]:
    return [f for f in found if f.verdict in (Verdict.INCONCLUSIVE, Verdict.OPEN)]


def test_there_are_enough_controls() -> None:
    assert len({sick.name for sick in SICK}) == len(SICK) >= 30
    checks = {check for sick in SICK for check in sick.convicted_by}
    assert checks == {"finiteness", "positivity", "energy", "reciprocity", "sampler", "claims"}


@pytest.mark.parametrize("sick", QUICK, ids=named)
def test_a_sick_model_is_convicted(sick: Sick) -> None:
    assert_convicted(sick)


@pytest.mark.slow
@pytest.mark.parametrize("sick", [sick for sick in SICK if sick not in QUICK], ids=named)
def test_every_sick_model_is_convicted(sick: Sick) -> None:
    assert_convicted(sick)


@pytest.mark.parametrize("name", QUICK_HEALTHY)
def test_a_healthy_model_is_convicted_of_what_is_true_only(name: str) -> None:
    assert_only_what_is_true(name, 0)


@pytest.mark.slow
@pytest.mark.parametrize("name", trial.SPECIMENS)
@pytest.mark.parametrize("seed", range(SEEDS))
def test_every_healthy_model_is_convicted_of_what_is_true_only(name: str, seed: int) -> None:
    assert_only_what_is_true(name, seed)
