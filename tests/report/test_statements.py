import csv
import io
import shutil
import subprocess

import pytest

from albedo_lab.papers import find_paper, paper_names
from albedo_lab.papers.record import Erratum, Paper
from albedo_lab.papers.verdict import Kind
from albedo_lab.report.audit_tables import latex_table
from albedo_lab.report.audited import audit, steps
from albedo_lab.report.build import ALL_TABLES
from albedo_lab.report.statements import (
    csv_errata,
    csv_statements,
    heard_row,
    latex_errata,
    latex_statements,
    markdown_errata,
    markdown_statements,
    sides,
)
from albedo_lab.report.tex import tex
from tests.report.small import NASTY, PAPER


@pytest.fixture(scope="module")
def audited():
    return audit(PAPER)


def rows(text):
    return list(csv.DictReader(io.StringIO(text)))


def test_an_audit_tells_every_step_and_counts_every_verdict():
    told = []
    audited = audit(PAPER, step=lambda: told.append(1))
    assert len(told) == steps(PAPER) == 8
    assert audited.tally() == {Kind.AGREES: 1, Kind.HOLDS: 1, Kind.OFF: 2, Kind.REFUTED: 2, Kind.UNDECIDED: 1}


def test_csv_keeps_every_statement_as_it_is(audited):
    read = rows(csv_statements(audited))
    assert [row["name"] for row in read] == [statement.name for statement in PAPER.statements]
    assert read[0]["printed"] == NASTY
    assert [row["verdict"] for row in read] == [
        "refuted",
        "holds",
        "off by 2 units in the last digit",
        "cannot be decided from the text",
    ]
    assert (read[1]["models"], read[2]["units_off"], read[3]["why"]) == ("phong ward", "2", "A matter of taste.")


def test_markdown_shows_what_does_not_hold_first_and_quotes_literally(audited):
    text = markdown_statements(audited)
    assert text.index("## What does not hold") < text.index("§3") < text.index("## What holds") < text.index("## Undecided")
    assert r"\[a\_b] \<script>" in text
    assert r"\*c\* \`d\`" in text
    lines = [line for line in text.splitlines() if line.startswith("| §")]
    assert len(lines) == 4
    assert {line.replace(r"\|", "").count("|") for line in lines} == {7}


def test_a_row_says_method_and_reason(audited):
    row = heard_row(PAPER.statements[0], audited.evidence["nasty"])
    assert row[3:] == ["0.5 ± 0.1 (quadrature)", "0.50 ± 0.02 (rqmc)", "refuted: because α < β"]


def test_an_erratum_has_the_numbers_of_its_statement_or_of_the_wrong_cells(audited):
    nasty, table = (sides(audited, erratum) for erratum in PAPER.errata)
    assert (nasty.ours, nasty.verdict.kind) == ("0.5 ± 0.1", Kind.REFUTED)
    assert table.ours.startswith("phong, n = 2: 0.363800 ± 0.000001, printed 0.368; ward, m = 0.1, θ = 89.5°")
    assert "n = 1:" not in table.ours
    assert table.verdict.kind is Kind.REFUTED


def test_an_erratum_without_evidence_is_an_error(audited):
    with pytest.raises(KeyError, match="nowhere"):
        sides(audited, Erratum("nowhere", "", "", "", "", PAPER.errata[0].cause))


def test_errata_in_markdown_and_csv(audited):
    text = markdown_errata([audited])
    assert "### eq. 2" in text
    assert "| cause | misprint: Its dimension is wrong. |" in text
    assert [row["evidence"] for row in rows(csv_errata([audited]))] == ["nasty", "table_1"]


def test_latex_is_ascii_whatever_the_documents_say(audited):
    for text in (latex_statements(audited), latex_errata([audited])):
        assert text.isascii()
        assert text.count(r"\begin{longtable}") == text.count(r"\end{longtable}") == 1
    assert tex("ã é ⁻³ ₙ Δ λ ½ “x”") == r"\~{a} \'{e} $^-$$^3$ $_n$ $\Delta$ $\lambda$ $\frac12$ ``x''"
    assert tex("♞") == "[U+265E]"


@pytest.mark.parametrize("name", paper_names())
def test_every_character_of_the_documents_has_a_spelling(name):
    paper: Paper = find_paper(name)
    texts = [text for s in paper.statements for text in (s.place, s.printed, s.asks)]
    texts += [text for e in paper.errata for text in (e.place, e.printed, e.correct, e.how, e.why_cause)]
    texts += [text for t in paper.tables for text in (t.title, t.place)]
    assert [text for text in texts if "[U+" in tex(text)] == []


@pytest.mark.skipif(shutil.which("pdflatex") is None, reason="needs pdflatex")
def test_latex_compiles(audited, tmp_path):
    table, findings = next(audited.tables())
    parts = [latex_table("small-table_1", table, findings), latex_statements(audited), latex_errata([audited])]
    (tmp_path / "all.tex").write_text(ALL_TABLES + "\\clearpage\n".join(parts) + "\\end{document}\n", encoding="ascii")
    command = ["pdflatex", "-interaction=nonstopmode", "-halt-on-error", "all.tex"]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, check=False, timeout=60)
    assert done.returncode == 0, done.stdout.decode(errors="replace")[-2000:]
