"""Findings as JUnit XML, which build servers read. Computes nothing."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Sequence
from typing import NamedTuple
from xml.etree import ElementTree

from albedo_lab.analysis.verdict import Finding, Verdict

UNPRINTABLE = re.compile("[^\t\n\r\x20-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")
"""What no XML 1.0 document may hold, escaped or not."""


class Case(NamedTuple):
    """A finding with the model's name and its parameters in words."""

    model: str
    parameters: str
    finding: Finding


def junit_xml(cases: Sequence[Case]) -> str:
    """A test suite per model with its parameters, a test case per finding; every time is 0, so that equal runs give equal files.

    FAIL is a failure, INCONCLUSIVE an error, SKIPPED skipped; what is only reported passes.
    """
    suites: dict[str, list[Case]] = {}
    for case in cases:
        suites.setdefault(f"{case.model} {case.parameters}".strip(), []).append(case)
    root = ElementTree.Element("testsuites", _counts("albedo-lab check", cases))
    for name, members in suites.items():
        skipped = str(sum(case.finding.verdict is Verdict.SKIPPED for case in members))
        suite = ElementTree.SubElement(root, "testsuite", _counts(name, members) | {"skipped": skipped})
        suite.extend(_case(case, title) for case, title in zip(members, _titles(members), strict=True))
    ElementTree.indent(root)
    return f'<?xml version="1.0" encoding="UTF-8"?>\n{ElementTree.tostring(root, encoding="unicode")}\n'


def _counts(name: str, cases: Sequence[Case]) -> dict[str, str]:
    verdicts = Counter(case.finding.verdict for case in cases)
    failures, errors = str(verdicts[Verdict.FAIL]), str(verdicts[Verdict.INCONCLUSIVE])
    return {"name": _clean(name), "tests": str(len(cases)), "failures": failures, "errors": errors, "time": "0"}


def _titles(cases: Sequence[Case]) -> list[str]:
    """The names of test cases, of which no two of a suite may be the same: build servers follow them from run to run."""
    of_check = Counter(case.finding.check for case in cases)
    seen: Counter[str] = Counter()
    titles = []
    for case in cases:
        check = case.finding.check
        seen[check] += 1
        title = f"{check} {seen[check]}" if of_check[check] > 1 else check
        titles.append(f"{title}, {case.parameters}" if case.parameters else title)
    return titles


def _case(case: Case, title: str) -> ElementTree.Element:
    finding = case.finding
    element = ElementTree.Element(
        "testcase", {"classname": _clean(f"albedo_lab.{case.model}"), "name": _clean(title), "time": "0"}
    )
    tag = {Verdict.FAIL: "failure", Verdict.INCONCLUSIVE: "error", Verdict.SKIPPED: "skipped"}.get(finding.verdict)
    if tag is None:
        ElementTree.SubElement(element, "system-out").text = _clean(details(finding))
        return element
    outcome = ElementTree.SubElement(element, tag, {"type": _clean(finding.check), "message": _clean(finding.statement)})
    if tag != "skipped":
        outcome.text = _clean(details(finding))
    return element


def details(finding: Finding) -> str:
    """All that a finding says, a line each."""
    known = [
        ("found", finding.statement),
        ("claimed", finding.claim),
        ("witness", finding.witness),
        ("figure", "" if finding.figure != finding.figure else repr(finding.figure)),
        ("threshold", "" if finding.threshold != finding.threshold else repr(finding.threshold)),
        ("p-value", "" if finding.p_value is None else repr(finding.p_value)),
    ]
    return "\n".join(f"{name}: {text}" for name, text in known if text)


def _clean(text: str) -> str:
    """The text with what XML cannot hold told in words of Python."""
    return UNPRINTABLE.sub(lambda found: ascii(found[0])[1:-1], text)
