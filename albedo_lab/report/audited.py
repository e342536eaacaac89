"""A document after its trial: what was found of every figure and statement, and the data of every picture."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import pandas as pd

from albedo_lab.papers import find_paper
from albedo_lab.papers.examine import examine, hear
from albedo_lab.papers.record import Evidence, Figure, Finding, Paper, Statement, Table
from albedo_lab.papers.verdict import Kind
from albedo_lab.pictures import Data

LONGEST = 10_000
SOUND = (Kind.AGREES, Kind.HOLDS)
"""The verdicts that leave a document as it is."""


@dataclass(frozen=True)
class Audited:
    """Findings by their table's name, evidence by its statement's, data by their figure's."""

    paper: Paper
    findings: Mapping[str, Sequence[Finding]]
    evidence: Mapping[str, Evidence]
    data: Mapping[str, Data]

    def __reduce__(self) -> tuple[Callable[..., Audited], tuple[Any, ...]]:
        """Pickled by the document's name: recipes and trials are functions that cannot be."""
        found = {name: [(f.ours, f.again, f.verdict) for f in findings] for name, findings in self.findings.items()}
        return _of_paper, (self.paper.name, found, dict(self.evidence), dict(self.data))

    def tables(self) -> Iterator[tuple[Table, Sequence[Finding]]]:
        """Every table with its findings."""
        return ((table, self.findings[table.name]) for table in self.paper.tables)

    def statements(self) -> Iterator[tuple[Statement, Evidence]]:
        """Every statement with its evidence."""
        return ((statement, self.evidence[statement.name]) for statement in self.paper.statements)

    def figures(self) -> Iterator[tuple[Figure, Data]]:
        """Every figure with its data."""
        return ((figure, self.data[figure.name]) for figure in self.paper.figures)

    def tally(self) -> Counter[Kind]:
        """How many verdicts of each kind there are, on figures and statements together."""
        return sum((tally(found) for found in self.findings.values()), tally(self.evidence.values()))


def _of_paper(name: str, found: Mapping[str, Any], evidence: Mapping[str, Evidence], data: Mapping[str, Data]) -> Audited:
    paper = find_paper(name)
    findings = {
        table.name: [Finding(cell, *figures) for cell, figures in zip(table.cells, found[table.name], strict=True)]
        for table in paper.tables
    }
    return Audited(paper, findings, evidence, data)


def tally(found: Iterable[Finding | Evidence]) -> Counter[Kind]:
    """How many verdicts of each kind there are."""
    return Counter(each.verdict.kind for each in found)


def frames(data: Data) -> dict[str, pd.DataFrame]:
    """What of a picture's data are tables that somebody may read, by name; one of more than LONGEST rows, a mesh, is none."""
    return {name: table for name, table in data.items() if isinstance(table, pd.DataFrame) and 0 < len(table) <= LONGEST}


def steps(paper: Paper) -> int:
    """How often `audit` tells its progress."""
    return sum(len(table.cells) for table in paper.tables) + len(paper.statements) + len(paper.figures)


def audit(paper: Paper, seed: int = 0, threads: int | None = None, step: Callable[[], None] = lambda: None) -> Audited:
    """The document's trial: every figure recomputed and judged, every statement heard, every picture's data computed."""
    findings: dict[str, list[Finding]] = {table.name: [] for table in paper.tables}
    for table in paper.tables:
        for finding in examine(table.cells, seed, threads):
            findings[table.name].append(finding)
            step()
    evidence = {}
    for statement, found in hear(paper.statements, seed, threads):
        evidence[statement.name] = found
        step()
    data = {}
    for figure in paper.figures:
        data[figure.name] = figure.picture.trace(threads)
        step()
    return Audited(paper, findings, evidence, data)
