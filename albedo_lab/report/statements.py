"""Statements and errata as pages for people (Markdown, LaTeX) and as rows for machines (CSV)."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import NamedTuple

from albedo_lab.papers.record import Erratum, Evidence, Statement
from albedo_lab.papers.verdict import Kind, Verdict
from albedo_lab.report.audit_tables import again, as_printed, ours, place
from albedo_lab.report.audited import SOUND, Audited
from albedo_lab.report.formats import as_csv, as_markdown
from albedo_lab.report.tex import tex

HEARD = ("place", "the document says", "on trial", "ours", "by another way", "verdict")
RECORDED = ("name", "place", "printed", "asks", "models", "verdict", "units_off", "ours", "method", "again", "why")
HEARD_WIDTHS = (1.8, 4.6, 4.8, 4.2, 4.2, 4.6)
CORRECTED = ("document", "place", "printed", "correct", "ours", "by another way", "how found", "cause")
CORRECTED_WIDTHS = (1.8, 1.8, 3.6, 3.6, 3.7, 3.3, 3.6, 2.4)
"""Centimetres of a page across."""
PARTS = {"What does not hold": (Kind.REFUTED, Kind.OFF), "What holds": SOUND, "Undecided": (Kind.UNDECIDED,)}
"""How a page of statements is divided."""
LITERAL = str.maketrans({character: f"\\{character}" for character in r"\`*_<[~"})


class Sides(NamedTuple):
    """The numbers behind an erratum, ours and by a second method; `anchor` is the table or the statement that they come from."""

    anchor: str
    ours: str
    again: str
    verdict: Verdict


def sides(audited: Audited, erratum: Erratum) -> Sides:
    """What was found of the statement, or of all wrong cells of the table, that an erratum names. Raises KeyError for another."""
    if erratum.statement in audited.evidence:
        found = audited.evidence[erratum.statement]
        return Sides(erratum.statement, found.ours, found.again, found.verdict)
    cells = audited.findings[erratum.statement]
    wrong = [f for f in cells if f.verdict.kind not in SOUND] or list(cells)
    worst = max((f.verdict for f in wrong), key=lambda verdict: list(Kind).index(verdict.kind))
    numbers = "; ".join(f"{f.cell.model}, {place(f.cell)}: {ours(f)}, printed {as_printed(f.cell.printed.text)}" for f in wrong)
    return Sides(erratum.statement, numbers, "; ".join(again(f) for f in wrong), worst)


def one_line(text: str) -> str:
    """The text without line breaks, as a cell of a table must be."""
    return " ".join(text.split())


def literal(text: str) -> str:
    """A quotation in Markdown: no character of it is read as markup."""
    return one_line(text).translate(LITERAL)


def heard_row(statement: Statement, evidence: Evidence) -> list[str]:
    """A statement as a person reads it, under HEARD."""
    method = "" if evidence.method in ("", "—") else f" ({evidence.method})"
    verdict = f"{evidence.verdict}: {evidence.why}" if evidence.why else str(evidence.verdict)
    words = (statement.place, statement.printed, statement.asks, evidence.ours + method, evidence.again, verdict)
    return [one_line(text) for text in words]


def markdown_statements(audited: Audited) -> str:
    """A page of every statement with its verdict; those that do not hold first."""
    rows = [(evidence.verdict.kind, heard_row(statement, evidence)) for statement, evidence in audited.statements()]
    parts = [f"# Statements of {audited.paper.name}", f"{audited.paper.citation}."]
    for title, kinds in PARTS.items():
        chosen = [[row[0], literal(row[1]), *row[2:]] for kind, row in rows if kind in kinds]
        if chosen:
            parts += [f"## {title}", as_markdown(HEARD, chosen)]
    return "\n\n".join(part.strip() for part in parts) + "\n"


def latex_statements(audited: Audited) -> str:
    """The same as one table over several pages."""
    rows = [heard_row(statement, evidence) for statement, evidence in audited.statements()]
    caption = f"Statements of {audited.paper.name}, each put on trial."
    return longtable(caption, f"{audited.paper.name}-statements", HEARD, HEARD_WIDTHS, rows)


def csv_statements(audited: Audited) -> str:
    """The same for machines, in the document's order."""
    return as_csv(RECORDED, [record(statement, evidence) for statement, evidence in audited.statements()])


def topics(audits: Sequence[Audited]) -> list[str]:
    """What statements of several documents, or several of one, are about, where they say so."""
    return sorted({statement.topic for audited in audits for statement in audited.paper.statements if statement.topic})


def markdown_topic(topic: str, audits: Sequence[Audited]) -> str:
    """A page of every statement about a topic, document by document, with its verdict."""
    rows = [
        [audited.paper.name, row[0], literal(row[1]), *row[2:]]
        for audited in audits
        for statement, evidence in audited.statements()
        if statement.topic == topic
        for row in [heard_row(statement, evidence)]
    ]
    return f"# {topic.capitalize()}\n\n{as_markdown(('document', *HEARD), rows)}"


def page_of(topic: str) -> str:
    """The name of a topic's page."""
    return f"{topic.replace(' ', '_')}.md"


def record(s: Statement, e: Evidence) -> list[object]:
    """A statement with its evidence as a row for machines, under RECORDED."""
    words = (s.name, s.place, s.printed, s.asks, " ".join(s.models))
    return [*words, str(e.verdict), e.verdict.units, e.ours, e.method, e.again, e.why]


def corrected(audits: Sequence[Audited]) -> Iterator[tuple[Audited, Erratum, Sides]]:
    """Every erratum of the documents, with its numbers."""
    for audited in audits:
        for erratum in audited.paper.errata:
            yield audited, erratum, sides(audited, erratum)


def markdown_errata(audits: Sequence[Audited]) -> str:
    """A page of errata: the printed and the corrected form, the numbers on both sides, how each was found, and its cause."""
    parts = ["# Errata", "What the documents should have printed, and the numbers that say so."]
    for audited in audits:
        parts += [f"## {audited.paper.name}", f"{audited.paper.citation}."] if audited.paper.errata else []
        for _, erratum, found in corrected([audited]):
            rows = [
                ["printed", literal(erratum.printed)],
                ["correct", literal(erratum.correct)],
                ["ours", found.ours],
                ["by another way", found.again],
                ["verdict", str(found.verdict)],
                ["how found", erratum.how],
                ["cause", cause_of(erratum)],
            ]
            parts += [f"### {erratum.place}", as_markdown(("", "what is known"), [[name, one_line(text)] for name, text in rows])]
    return "\n\n".join(part.strip() for part in parts) + "\n"


def latex_errata(audits: Sequence[Audited]) -> str:
    """The same as one table over several pages."""
    rows = [
        [a.paper.name, e.place, e.printed, e.correct, found.ours, found.again, e.how, cause_of(e)]
        for a, e, found in corrected(audits)
    ]
    return longtable(
        "Errata of the documents.", "errata", CORRECTED, CORRECTED_WIDTHS, [[one_line(c) for c in row] for row in rows]
    )


def csv_errata(audits: Sequence[Audited]) -> str:
    """The same for machines."""
    names = ("document", "place", "printed", "correct", "verdict", "ours", "again", "how", "cause", "why_cause", "evidence")
    rows = [
        [a.paper.name, e.place, e.printed, e.correct, str(s.verdict), s.ours, s.again, e.how, str(e.cause), e.why_cause, s.anchor]
        for a, e, s in corrected(audits)
    ]
    return as_csv(names, rows)


def cause_of(erratum: Erratum) -> str:
    """Where the error comes from, and how that can be known."""
    return f"{erratum.cause}: {erratum.why_cause}" if erratum.why_cause else str(erratum.cause)


def longtable(caption: str, label: str, names: Sequence[str], widths: Sequence[float], rows: Sequence[Sequence[str]]) -> str:
    """A table of the packages longtable and booktabs, with columns of those widths in cm; a title line on every page."""
    columns = "".join(rf">{{\raggedright\arraybackslash}}p{{{width}cm}}" for width in widths)
    head = " & ".join(map(tex, names)) + r" \\"
    lines = [
        r"% \usepackage{array,booktabs,longtable}",
        r"\begingroup\scriptsize\setlength{\tabcolsep}{4pt}\setlength{\LTpre}{0pt}",
        rf"\begin{{longtable}}{{{columns}}}",
        rf"\caption{{{tex(caption)}}}\label{{tab:{label}}}\\",
        rf"\toprule {head} \midrule \endfirsthead",
        rf"\toprule {head} \midrule \endhead",
        r"\bottomrule \endlastfoot",
        *(" & ".join(map(tex, row)) + r" \\ \addlinespace[2pt]" for row in rows),
        r"\end{longtable}",
        r"\endgroup",
    ]
    return "\n".join(lines) + "\n"
