"""The front page of the reports in Markdown, which code hosts show beside the files."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence

from albedo_lab.papers.verdict import RULE, Kind
from albedo_lab.pictures import Data
from albedo_lab.report.audit_tables import DOUBTER, doubter_rows
from albedo_lab.report.audited import SOUND, Audited, frames, tally
from albedo_lab.report.formats import as_markdown
from albedo_lab.report.statements import HEARD, heard_row, literal, page_of, topics

TITLE = "The documents on trial"
HOW = """\
Ours comes from adaptive quadrature where a figure is an integral; the number after ± bounds its error, and is shown no finer than
a thousandth of the last printed unit. Every figure is found again by another way that shares no integration with the first,
mostly randomised quasi-Monte Carlo (rqmc, ± half of its 95 % interval); limits are argued, and approached by quadrature.
The csv files hold both, with every digit."""
STATED = """\
A statement without digits **holds** or is **refuted**. It **cannot be decided** where the text leaves open what it means or how
close is close, where it does not claim what was measured, or where nobody can repeat what was done; the reason is given."""
HEAD = f"""\
# {TITLE}

Every printed figure, formula and claim below was put on trial, and each figure of ours carries its error. `make reports` writes
these pages again, the same byte for byte. [index.html](index.html) shows all of it on one page, with the pictures.
"""
COLUMNS = ("document", *Kind, "all")


def front_page(audits: Sequence[Audited], models: Mapping[str, str], timed: Mapping[str, str], league: bool = False) -> str:
    """Counts for each document, then each document: its verdicts, all that does not hold, its pictures.

    `models` are the pages of the model cards by the models' names, `timed` the pages of measured times by what they show;
    `league` says whether there is one.
    """
    counts = [[f"[{audited.paper.name}](#{audited.paper.name})", *counted(audited.tally())] for audited in audits]
    counts.append(["**all**", *(f"**{number}**" for number in counted(sum((a.tally() for a in audits), Counter())))])
    errata = sum(len(audited.paper.errata) for audited in audits)
    beside = [f"- **[Errata](errata.md)**: {errata} corrections, each with its numbers ([csv](errata.csv), [tex](errata.tex))"]
    beside += [f"- **[{topic.capitalize()}]({page_of(topic)})**, of all documents side by side" for topic in topics(audits)]
    if league:
        beside.append("- **[The league](league.md)**: every model side by side ([csv](league.csv), [svg](league.svg))")
        beside.append(
            "- **[Ward's model and its descendants](wards.md)**: their grazing laws ([csv](wards.csv), [svg](wards.svg))"
        )
    if models:
        beside.append("- **Model cards**: " + ", ".join(f"[{name}]({page})" for name, page in models.items()))
    if timed:
        beside.append(
            "- **[Times and costs](timings/README.md)**, measured: " + ", ".join(f"[{said}]({p})" for said, p in timed.items())
        )
    beside.append("- Every table in LaTeX: [tables.tex](tables.tex); versions, seed and digests: [manifest.json](manifest.json)")
    parts = [HEAD, as_markdown(COLUMNS, counts), "\n".join(beside), f"## How a figure is judged\n\n{HOW}\n\n{RULE}\n\n{STATED}"]
    return "\n\n".join(part.strip() for part in [*parts, *map(section, audits)]) + "\n"


def counted(count: Counter[Kind]) -> list[str]:
    """How many verdicts there are of each kind, and of all."""
    return [str(count[kind]) for kind in Kind] + [str(count.total())]


def section(audited: Audited) -> str:
    """What the front page says of a document."""
    paper = audited.paper
    parts = [f"## {paper.name}", f"{paper.citation}.", paper.note]
    parts.append(as_markdown(("place", "what", *Kind, "all", "files"), contents(audited)))
    failures = [
        [table.place, *row]
        for table, findings in audited.tables()
        for row in doubter_rows([f for f in findings if f.verdict.kind not in SOUND])
    ]
    if failures:
        parts += ["### Figures that do not hold", as_markdown(("place", *DOUBTER), failures)]
    refuted = [heard_row(s, e) for s, e in audited.statements() if e.verdict.kind in (Kind.OFF, Kind.REFUTED)]
    if refuted:
        parts += ["### Statements that do not hold", as_markdown(HEARD, [[row[0], literal(row[1]), *row[2:]] for row in refuted])]
    for figure, data in audited.figures():
        files = ", ".join(f"[{said}]({paper.name}/{name})" for said, name in figure_files(figure.name, data).items())
        parts += [
            f"### {figure.place[:1].upper()}{figure.place[1:]}",
            f"![{figure.title}]({paper.name}/{figure.name}.png)",
            f"{figure.caption} Files: {files}.",
        ]
    return "\n\n".join(part.strip() for part in parts)


def contents(audited: Audited) -> list[list[str]]:
    """The tables of a document and its statements, each with its verdicts and its files."""
    name = audited.paper.name
    rows = [
        [
            table.place,
            f"[{table.title}]({name}/{table.name}.md)",
            *counted(tally(findings)),
            links(name, table.name, "csv", "tex"),
        ]
        for table, findings in audited.tables()
    ]
    if audited.evidence:
        files = links(name, "statements", "csv", "tex")
        rows.append(["", f"[Statements]({name}/statements.md)", *counted(tally(audited.evidence.values())), files])
    return [*rows, ["", "**all**", *(f"**{number}**" for number in counted(audited.tally())), ""]]


def figure_files(name: str, data: Data) -> dict[str, str]:
    """The files of a picture by what a link to them says: the picture itself, and every table of its data."""
    tables = {f"{table} csv".strip(): f"{name}_{table}.csv" if table else f"{name}.csv" for table in frames(data)}
    return {"svg": f"{name}.svg", "png": f"{name}.png", **tables}


def links(folder: str, name: str, *kinds: str) -> str:
    """Markdown links to the files of a table or a picture."""
    return ", ".join(f"[{kind}]({folder}/{name}.{kind})" for kind in kinds)
