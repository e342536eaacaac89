"""Findings of an audit as rows: for people (Markdown, LaTeX) and for machines (CSV)."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence

from albedo_lab.digits import with_error
from albedo_lab.estimate.record import Estimate
from albedo_lab.papers.record import Cell, Finding, Table
from albedo_lab.papers.verdict import Kind
from albedo_lab.report.formats import as_csv, as_latex, as_markdown
from albedo_lab.report.tex import TEX, tex

READER = ("model", "at", "printed", "ours", "verdict")
DOUBTER = (*READER[:-1], "by another way", READER[-1])
QUANTITIES = {
    "overshoot": "largest albedo − 1",
    "overshoot_angle_deg": "its angle in degrees",
    "grazing_albedo": "albedo at 90°",
}
ANSWERED = ("constant", "mean_albedo", "albedo")
"""Quantities that the table's title names."""
SYMBOLS = {"theta_deg": "θ"}
SUPERSCRIPTS = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


def place(cell: Cell) -> str:
    """Where in the space of parameters a cell stands: "n = 1", "m = 0.1, θ = 89.995°"; and its quantity, if that must be said."""
    words = []
    for name, value in cell.parameters.items():
        number = "∞" if value == float("inf") else f"{value:.10g}"
        words.append(f"{SYMBOLS.get(name, name)} = {number}{'°' * name.endswith('_deg')}".replace("= ∞", "→ ∞"))
    if cell.quantity not in ANSWERED:
        words.append(QUANTITIES.get(cell.quantity, cell.quantity.replace("_", " ")))
    return ", ".join(words)


def as_printed(text: str) -> str:
    """A number as the document sets it: 7.8e-3 is 7.8·10⁻³ there."""
    return re.sub(r"e(.+)", lambda power: "·10" + power[1].translate(SUPERSCRIPTS), text)


def ours(finding: Finding) -> str:
    """Our figure, to a thousandth of the printed unit at most; an argued limit says that it is one."""
    if finding.ours.method == "limit":
        return f"{with_error(finding.ours)} (limit)"
    return with_error(finding.ours, float(finding.cell.printed.resolution) / 1000.0)


def again(finding: Finding) -> str:
    """The same figure by other ways."""
    finest = float(finding.cell.printed.resolution) / 1000.0
    return "; ".join(f"{with_error(e, finest)} ({way})" for way, e in finding.again.items())


def reader_rows(findings: Iterable[Finding]) -> list[list[str]]:
    """A line for every cell, under READER."""
    return [[f.cell.model, place(f.cell), as_printed(f.cell.printed.text), ours(f), str(f.verdict)] for f in findings]


def doubter_rows(findings: Iterable[Finding]) -> list[list[str]]:
    """The same with the other ways before the verdict, under DOUBTER."""
    return [[*row[:-1], again(f), row[-1]] for f in findings for row in reader_rows([f])]


def csv_table(findings: Sequence[Finding]) -> str:
    """Every digit, the second way included."""
    parameters = list(dict.fromkeys(name for f in findings for name in f.cell.parameters))
    rows = [csv_row(f, parameters) for f in findings]
    return as_csv(list(rows[0]), [list(row.values()) for row in rows])


def csv_row(f: Finding, parameters: Sequence[str]) -> dict[str, object]:
    """A cell as columns, one for each parameter of its table. Of several other ways the last is the best."""
    way, second = list(f.again.items())[-1]
    return {
        "model": f.cell.model,
        **{name: float(f.cell.parameters[name]) if name in f.cell.parameters else None for name in parameters},
        "quantity": f.cell.quantity,
        "printed": f.cell.printed.text,
        **figures("ours", f.ours),
        "method": f.ours.method,
        "verdict": str(f.verdict),
        "units_off": f.verdict.units,
        **figures("again", second, "again_"),
        "again_method": way if way == second.method else f"{second.method}, {way}",
        "again_seed": second.seed,
    }


def figures(name: str, e: Estimate, prefix: str = "") -> dict[str, object]:
    """A figure with its error as columns."""
    columns: dict[str, object] = {
        "standard_error": e.standard_error,
        "ci95_low": e.low,
        "ci95_high": e.high,
        "samples": e.samples,
    }
    return {name: e.value, **{prefix + column: value for column, value in columns.items()}}


def markdown_table(table: Table, findings: Sequence[Finding]) -> str:
    """A page: title, the note, the cells, and the doubted cells once more by other ways."""
    parts = [f"# {table.title}: {table.place}", table.note, as_markdown(READER, reader_rows(findings))]
    doubted = [f for f in findings if f.verdict.kind is not Kind.AGREES or len(f.again) > 1]
    if doubted:
        parts += ["## By another way", as_markdown(DOUBTER, doubter_rows(doubted))]
    return "\n\n".join(part.strip() for part in parts) + "\n"


def latex_table(label: str, table: Table, findings: Sequence[Finding]) -> str:
    """A floating table for a document that uses booktabs, its model named once."""
    rows = reader_rows(findings)
    for row, before in reversed(list(zip(rows[1:], rows, strict=False))):
        row[0] = "" if row[0] == before[0] else row[0]
    head, body = as_latex(READER, rows).translate(TEX).split("\n", 1)
    caption = tex(f"{table.title} ({table.place}): as printed, and recomputed with an error bound.")
    return (
        f"{head}\n\\begin{{table}}\n\\centering\\footnotesize\n\\caption{{{caption}}}\\label{{tab:{label}}}\n"
        f"{body}\\end{{table}}\n"
    )
