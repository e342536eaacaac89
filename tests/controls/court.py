"""The checks of one model at the default budget, and the table of what became of every control."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from typing import Any

from albedo_lab.analysis.check import run
from albedo_lab.analysis.verdict import Finding, Verdict
from albedo_lab.model import Model
from tests.controls.record import Sick


def findings(model: Model | str, values: Mapping[str, Any], only: Sequence[str] = (), seed: int = 0) -> list[Finding]:
    """What the checks, all of them or some, say of a model, as one run judges it."""
    return [finding for _, finding in run(model, values, only=only, seed=seed)]


def convictions(found: Iterable[Finding]) -> dict[str, Finding]:
    """Of every check that convicts, by its name, the conviction that is the least likely by chance."""
    told: dict[str, Finding] = {}
    for finding in found:
        if finding.verdict is Verdict.FAIL and chance(finding) < chance(told.get(finding.check)):
            told[finding.check] = finding
    return told


def chance(finding: Finding | None) -> float:
    """The probability of a finding of a sound model; of none at all more than 1."""
    return 2.0 if finding is None else finding.p_value or 0.0


HEAD = """\
# Negative controls

Sound models of the catalogue, each with one thing made wrong, before all checks of `albedo-lab check` at the default budget:
{tried} tried, {missed} missed. `python -m tests.controls` writes this page again; `make test-slow` tries every control, and
demands that each is convicted by the check that should.

The figure is the check's statistic, the threshold what it must not exceed; where chance has a part, p is the probability that
a sound model looks as bad.

"""


def page(rows: Sequence[tuple[Sick, Mapping[str, Finding]]]) -> str:
    """The table as a page of its own."""
    missed = sum(not set(sick.convicted_by) <= set(told) for sick, told in rows)
    return HEAD.format(tried=len(rows), missed=missed) + table(rows) + "\n"


def table(rows: Iterable[tuple[Sick, Mapping[str, Finding]]]) -> str:
    """The negative controls as Markdown: what was injected, which check convicted, with which figure."""
    lines = [
        "| control | model | injected | convicted by | figure | threshold | p | also convicted by | missed by |",
        "|---|---|---|---|---|---|---|---|---|",
    ]
    for sick, told in rows:
        by = next((name for name in sick.convicted_by if name in told), None)
        figures = ["", "", ""] if by is None else [number(x) for x in (told[by].figure, told[by].threshold, told[by].p_value)]
        also = ", ".join(name for name in told if name != by)
        missed = ", ".join(name for name in sick.convicted_by if name not in told)
        cells = [sick.name, sick.model.name, sick.injected, by or "nothing", *figures, also, missed]
        lines.append(f"| {' | '.join(cells)} |")
    return "\n".join(lines)


def number(x: float | None) -> str:
    """Five digits; nothing where there is no figure."""
    return "" if x is None or math.isnan(x) else f"{x:.5g}"
