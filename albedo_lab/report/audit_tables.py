"""Findings of an audit as rows: for people (Markdown, LaTeX) and for machines (CSV)."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from decimal import ROUND_UP, Decimal
from fractions import Fraction

from albedo_lab.estimate.record import Estimate
from albedo_lab.papers.audit import Cell, Finding, Table
from albedo_lab.papers.verdict import Kind
from albedo_lab.report.formats import LATEX, as_csv, as_latex, as_markdown

READER = ("model", "at", "printed", "ours", "verdict")
DOUBTER = (*READER[:-1], "by another way", READER[-1])
QUANTITIES = {
    "overshoot": "largest albedo − 1",
    "overshoot_angle_deg": "its angle in degrees",
    "grazing_albedo": "albedo at 90°",
}
SYMBOLS = {"theta_deg": "θ"}
SUPERSCRIPTS = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")
TEX = str.maketrans(
    {
        "±": r"$\pm$",
        "·": r"$\cdot$",
        "∞": r"$\infty$",
        "→": r"$\to$",
        "−": "$-$",
        "θ": r"$\theta$",
        "μ": r"$\mu$",
        "°": r"$^\circ$",
        "∫": r"$\int$",
        "ₙ": "$_n$",
        "§": r"\S",
        "ã": r"\~a",
        "⁻": "$^-$",
    }
    | {character: f"$^{digit}$" for digit, character in enumerate("⁰¹²³⁴⁵⁶⁷⁸⁹")}
)


def place(cell: Cell) -> str:
    """Where in the space of parameters a cell stands: "n = 1", "m = 0.1, θ = 89.995°"."""
    words = []
    for name, value in cell.parameters.items():
        number = "∞" if value == float("inf") else f"{value:.10g}"
        words.append(f"{SYMBOLS.get(name, name)} = {number}{'°' * name.endswith('_deg')}".replace("= ∞", "→ ∞"))
    if cell.quantity in QUANTITIES:
        words.append(QUANTITIES[cell.quantity])
    return ", ".join(words)


def as_printed(text: str) -> str:
    """A number as the document sets it: 7.8e-3 is 7.8·10⁻³ there."""
    return re.sub(r"e(.+)", lambda power: "·10" + power[1].translate(SUPERSCRIPTS), text)


def with_error(e: Estimate, finest: float = 0.0) -> str:
    """The figure ± half of its interval, to one digit, rounded up, and not finer than `finest`; a limit as a fraction.

    >>> with_error(Estimate(5.33417739, 3e-13, 5.334177389, 5.334177391, 99, "quadrature"), finest=1e-5)
    '5.33418 ± 0.00001'
    """
    if e.half_width == 0.0:
        fraction = Fraction(e.value).limit_denominator(100)
        return str(fraction) if float(fraction) == e.value else f"{e.value:.7g}"
    last = Decimal(1).scaleb(Decimal(max(e.half_width, finest) * (1.0 + 1e-9)).adjusted())
    value = Decimal(e.value).quantize(last)
    half_width = max(Decimal(e.high) - value, value - Decimal(e.low)).quantize(last, ROUND_UP)
    return f"{value:f} ± {half_width:f}"


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
    """A page: title, the cells, the note, and the doubted cells once more by other ways."""
    parts = [f"# {table.title}: {table.place}", table.note, as_markdown(READER, reader_rows(findings))]
    doubted = [f for f in findings if f.verdict.kind is not Kind.AGREES or len(f.again) > 1]
    if doubted:
        parts += ["## By another way", as_markdown(DOUBTER, doubter_rows(doubted))]
    return "\n\n".join(part.strip() for part in parts) + "\n"


def latex_table(table: Table, findings: Sequence[Finding]) -> str:
    """A floating table for a document that uses booktabs, its model named once."""
    rows = reader_rows(findings)
    for row, before in reversed(list(zip(rows[1:], rows, strict=False))):
        row[0] = "" if row[0] == before[0] else row[0]
    head, body = as_latex(READER, rows).translate(TEX).split("\n", 1)
    caption = f"{table.title} ({table.place}): as printed, and recomputed with an error bound.".translate(LATEX | TEX)
    return (
        f"{head}\n\\begin{{table}}\n\\centering\\footnotesize\n\\caption{{{caption}}}\\label{{tab:{table.name}}}\n"
        f"{body}\\end{{table}}\n"
    )
