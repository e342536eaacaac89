"""The committed reports: whole, by their manifest, and a sample of their figures found again, word for word."""

from __future__ import annotations

import csv
import io
import json
import os
from collections.abc import Iterable, Sequence
from pathlib import Path

import pytest

from albedo_lab import find
from albedo_lab.analysis.check import everyone
from albedo_lab.analysis.spread import comparable
from albedo_lab.papers import find_paper, paper_names
from albedo_lab.papers.examine import examine, hear
from albedo_lab.papers.record import Paper
from albedo_lab.report.audit_tables import csv_table
from albedo_lab.report.formats import as_csv
from albedo_lab.report.manifest import NAME, digest
from albedo_lab.report.statements import RECORDED, record
from albedo_lab.report.timings import FOLDER

REPORTS = Path(os.environ.get("ALBEDO_LAB_REPORTS", Path(__file__).parents[2] / "reports"))
"""Another build can be put on trial by that variable."""
EVERY = 12
PAPERS = [find_paper(name) for name in paper_names()]


@pytest.fixture(scope="module")
def manifest() -> dict[str, object]:
    found: dict[str, object] = json.loads((REPORTS / NAME).read_text(encoding="utf-8"))
    return found


def parsed(text: str) -> list[dict[str, str]]:
    return list(csv.DictReader(io.StringIO(text)))


def committed(name: str) -> list[dict[str, str]]:
    return parsed((REPORTS / name).read_bytes().decode())


def sample(several: Sequence[object], start: int) -> Iterable[int]:
    return range(min(start, len(several) - 1), len(several), EVERY) if several else ()


def filled(row: dict[str, str]) -> dict[str, str]:
    """Without its empty cells: a sample of a table may lack a parameter that other cells have."""
    return {name: cell for name, cell in row.items() if cell}


def by_name(paper: Paper) -> str:
    return paper.name


def test_every_file_has_the_digest_of_the_manifest(manifest):
    wrong = [name for name, of_it in manifest["sha256"].items() if digest((REPORTS / name).read_bytes()) != of_it]
    assert wrong == []


def test_no_file_is_there_that_the_manifest_does_not_know(manifest):
    there = {path.relative_to(REPORTS).as_posix() for path in REPORTS.rglob("*") if path.is_file()}
    assert {name for name in there - set(manifest["sha256"]) - {NAME} if not name.startswith(f"{FOLDER}/")} == set()


@pytest.mark.parametrize("paper", PAPERS, ids=by_name)
def test_the_statements_of_today_are_the_committed_ones(paper):
    """What a trial does not compute, of every statement: nothing is added, dropped or reworded since."""
    ours = [(s.name, s.place, s.printed, s.asks, " ".join(s.models)) for s in paper.statements]
    assert [tuple(row[column] for column in RECORDED[:5]) for row in committed(f"{paper.name}/statements.csv")] == ours


def test_the_errata_of_today_are_the_committed_ones():
    ours = [(p.name, e.place, e.printed, e.correct, e.how, str(e.cause), e.why_cause) for p in PAPERS for e in p.errata]
    columns = ("document", "place", "printed", "correct", "how", "cause", "why_cause")
    assert [tuple(row[column] for column in columns) for row in committed("errata.csv")] == ours


@pytest.mark.parametrize("paper", PAPERS, ids=by_name)
def test_statements_are_heard_again(paper, manifest):
    chosen = [paper.statements[i] for i in sample(paper.statements, EVERY // 2)]
    again = parsed(as_csv(RECORDED, [record(s, e) for s, e in hear(chosen, manifest["seed"])]))
    before = {row["name"]: row for row in committed(f"{paper.name}/statements.csv")}
    assert again == [before[row["name"]] for row in again]
    assert again


@pytest.mark.parametrize("paper", [paper for paper in PAPERS if paper.tables], ids=by_name)
def test_cells_are_found_again(paper, manifest):
    for table in paper.tables:
        chosen = list(sample(table.cells, 1))
        again = parsed(csv_table(list(examine([table.cells[i] for i in chosen], manifest["seed"]))))
        before = committed(f"{paper.name}/{table.name}.csv")
        assert len(before) == len(table.cells)
        for row, index in zip(again, chosen, strict=True):
            assert {name: cell for name, cell in before[index].items() if cell} == {
                name: cell for name, cell in row.items() if cell
            }


def test_the_league_has_every_model_with_its_times_and_its_parameter_is_found_again():
    league = {row["model"]: row for row in committed("league.csv")}
    assert list(league) == everyone()
    assert [name for name, row in league.items() if not row["ns_evaluation"]] == [], "albedo-lab report --timings measures them"
    for name in list(league)[::EVERY]:
        again = comparable(find(name))
        assert (league[name]["wide_parameter"], league[name]["wide_value"]) == (
            (again.parameter, str(again.value)) if again else ("", "")
        )


def test_the_readme_counts_as_the_reports_do():
    front = (REPORTS / "README.md").read_text(encoding="utf-8")
    row = next(line for line in front.splitlines() if line.startswith("| **all** |"))
    agree, hold, off, refuted, undecided, everything = (int(cell.strip(" *")) for cell in row.split("|")[2:-1])
    errata = len(committed("errata.csv"))
    said = " ".join((Path(__file__).parents[2] / "README.md").read_text(encoding="utf-8").split())
    assert f"{everything} figures, formulas and sentences" in said
    assert f"{agree + hold} agree or hold, {off} are off in the last digit, {refuted} are refuted, {undecided} cannot" in said
    assert f"and {errata} [errata]" in said
