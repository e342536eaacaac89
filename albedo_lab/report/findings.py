"""Findings as a table for a person. Computes nothing."""

from __future__ import annotations

import itertools
import textwrap
from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import replace

from albedo_lab.analysis.verdict import Finding, Verdict
from albedo_lab.report.junit import Case

HEAD = ("model", "parameters", "check", "verdict", "figure", "limit", "p", "found")
VERDICT, FOUND = HEAD.index("verdict"), HEAD.index("found")
GAP = "  "
NARROWEST = 40
COLOURS = {Verdict.PASS: 32, Verdict.FAIL: 31, Verdict.INCONCLUSIVE: 33, Verdict.SKIPPED: 2, Verdict.REPORTED: 2}
"""Green, red, yellow and faint, as the terminals' standard (ECMA-48) numbers them."""
ORDER = (Verdict.PASS, Verdict.FAIL, Verdict.INCONCLUSIVE, Verdict.SKIPPED, Verdict.REPORTED)
WORDS = {
    Verdict.PASS: "passed",
    Verdict.FAIL: "failed",
    Verdict.INCONCLUSIVE: "inconclusive",
    Verdict.SKIPPED: "skipped",
    Verdict.REPORTED: "reported",
}


def findings_text(cases: Sequence[Case], coloured: bool = False, width: int | None = None) -> str:
    """A line per finding, then a line per model; of tests that passed together only the one that came nearest to failing.

    Lines longer than `width` go on below; None lets them be as long as they are.
    """
    shown = list(_condensed(cases))
    rows = [(case.model, case.parameters, *_cells(case.finding)) for case in shown]
    used = [i for i, name in enumerate(HEAD) if name in ("check", "verdict", "found") or any(row[i] for row in rows)]
    widths = {i: max(len(line[i]) for line in (HEAD, *rows)) for i in used}
    indent = sum(widths[i] + len(GAP) for i in used[:-1])
    room = None if width is None else max(width - indent, NARROWEST)
    text = [GAP.join(HEAD[i].ljust(widths[i]) for i in used).rstrip()]
    for case, row in zip(shown, rows, strict=True):
        cells = {i: row[i].ljust(widths[i]) for i in used}
        if coloured:
            cells[VERDICT] = _colour(cells[VERDICT], case.finding.verdict)
        cells[FOUND] = row[FOUND] if room is None else f"\n{' ' * indent}".join(textwrap.wrap(row[FOUND], room))
        text.append(GAP.join(cells.values()).rstrip())
    return "\n".join([*text, "", *_summaries(cases, coloured), ""])


def _condensed(cases: Sequence[Case]) -> Iterator[Case]:
    """The cases, those tests of a check that passed being told as one."""
    for _, group in itertools.groupby(cases, lambda case: (case.model, case.parameters, case.finding.check)):
        members = list(group)
        passed = [case for case in members if case.finding.p_value is not None and case.finding.verdict is Verdict.PASS]
        nearest = min(passed, key=lambda case: case.finding.p_value or 0.0, default=None)
        for case in members:
            if case is nearest and len(passed) > 1:
                statement = f"nearest of {len(passed)} tests: {case.finding.statement}"
                yield case._replace(finding=replace(case.finding, statement=statement))
            elif case is nearest or not any(case is other for other in passed):
                yield case


def _cells(finding: Finding) -> tuple[str, ...]:
    """A finding's cells from the check's name on; what is claimed stands before what is found, the witness after it."""
    words = [f"claimed: {finding.claim}; found: {finding.statement}" if finding.claim else finding.statement]
    words += [f"witness: {finding.witness}"] if finding.witness else []
    said = " ".join("; ".join(words).split())
    p_value = "" if finding.p_value is None else f"{finding.p_value:.2g}"
    return finding.check, finding.verdict.value, _number(finding.figure), _number(finding.threshold), p_value, said


def _number(value: float) -> str:
    return "" if value != value else f"{value:.7g}"


def _summaries(cases: Sequence[Case], coloured: bool) -> list[str]:
    of_model: dict[str, list[Finding]] = {}
    for case in cases:
        of_model.setdefault(case.model, []).append(case.finding)
    width = max(map(len, of_model), default=0)
    return [f"{model.ljust(width)}  {_summary(findings, coloured)}" for model, findings in of_model.items()]


def _summary(findings: Sequence[Finding], coloured: bool) -> str:
    """The model's verdict, how many findings are of which kind, and which checks are to blame."""
    count = Counter(finding.verdict for finding in findings)
    verdict = next((bad for bad in (Verdict.FAIL, Verdict.INCONCLUSIVE) if count[bad]), Verdict.PASS)
    counts = ", ".join(f"{count[kind]} {WORDS[kind]}" for kind in ORDER if count[kind])
    blamed = ", ".join(dict.fromkeys(finding.check for finding in findings if finding.verdict is verdict))
    word = verdict.value.ljust(len(Verdict.INCONCLUSIVE))
    blame = "" if verdict is Verdict.PASS else f": {blamed}"
    return f"{_colour(word, verdict) if coloured else word}  {counts}{blame}"


def _colour(text: str, verdict: Verdict) -> str:
    return f"\x1b[{COLOURS[verdict]}m{text}\x1b[0m"
