"""Tables as text: csv and json keep every digit, the others those that the error justifies. Computes nothing."""

from __future__ import annotations

import csv
import io
import json
import math
import re
from collections.abc import Callable, Iterable, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

from albedo_lab.digits import as_text, justified

if TYPE_CHECKING:
    import pandas as pd

Rows = Sequence[Sequence[object]]

ERROR = ("standard_error", "ci95_low", "ci95_high")
"""What follows a quantity. A person is shown half of the interval instead, beside the quantity."""
HALF_WIDTH = "± 95 %"
WIDEST = "half_width"
"""Where several quantities stand beside each other, as the components of a colour do, the half-width of the widest interval."""

MARKDOWN = str.maketrans({"|": r"\|"})
LATEX = str.maketrans(
    {character: f"\\{character}" for character in "&%$#_{}"}
    | {character: f"${character}$" for character in "<>|"}
    | {"\\": r"\textbackslash{}", "~": r"\textasciitilde{}", "^": r"\textasciicircum{}", "±": r"$\pm$"}
)


class Column(NamedTuple):
    """A column as a person reads it: numbers stand to the right, and the figure that was asked for is always shown."""

    name: str
    cells: list[str]
    numeric: bool
    figure: bool = False


def format_table(frame: pd.DataFrame, kind: str) -> str:
    """The DataFrame as text of one of KINDS, with a newline at its end."""
    return format_rows(list(frame.columns), frame.itertuples(index=False, name=None), kind)


def format_rows(names: Sequence[str], rows: Iterable[Sequence[object]], kind: str) -> str:
    """Rows under column names as text of one of KINDS: for those who must not wait for pandas."""
    return KINDS[kind](names, list(rows))


def as_csv(names: Sequence[str], rows: Rows) -> str:
    """Comma-separated values; floats as their shortest text that reads back to the same bits."""
    text = io.StringIO()
    csv.writer(text, lineterminator="\n").writerows([names, *rows])
    return text.getvalue()


def as_json(names: Sequence[str], rows: Rows) -> str:
    """A list of records, one a line. JSON has neither NaN, which becomes null, nor infinity: "inf" or "-inf"."""
    records = [dict(zip(names, map(_json_value, row), strict=True)) for row in rows]
    lines = ",\n".join(json.dumps(record, allow_nan=False, ensure_ascii=False) for record in records)
    return f"[\n{lines}\n]\n" if records else "[]\n"


def as_table(names: Sequence[str], rows: Rows) -> str:
    """Aligned text. What is the same in every row of estimates is said once, above."""
    columns = readable(names, rows)
    asked = any(column.figure for column in columns)
    shown = [column for column in columns if column.figure or not asked or len(set(column.cells)) != 1]
    said = ", ".join(f"{column.name} {column.cells[0]}" for column in columns if column not in shown and column.cells[0])
    lines = ["  ".join(line).rstrip() for line in zip(*map(_padded, shown), strict=True)]
    return "\n".join([*([said, ""] if said else []), *lines, ""])


def as_markdown(names: Sequence[str], rows: Rows) -> str:
    """A table of GitHub's Markdown."""
    columns = readable(names, rows)
    rule = ["---:" if column.numeric else "---" for column in columns]
    lines = [[column.name for column in columns], rule, *zip(*(column.cells for column in columns), strict=True)]
    return "".join(f"| {' | '.join(text.translate(MARKDOWN) for text in line)} |\n" for line in lines)


def as_latex(names: Sequence[str], rows: Rows) -> str:
    """A tabular of the package booktabs."""
    columns = readable(names, rows)
    head = [column.name.translate(LATEX) for column in columns]
    cells = [[_latex_number(c) if column.numeric else c.translate(LATEX) for c in column.cells] for column in columns]
    lines = [
        "% \\usepackage{booktabs}",
        f"\\begin{{tabular}}{{{''.join('r' if column.numeric else 'l' for column in columns)}}}",
        "\\toprule",
        " & ".join(head) + r" \\",
        "\\midrule",
        *(" & ".join(line) + r" \\" for line in zip(*cells, strict=True)),
        "\\bottomrule",
        "\\end{tabular}",
    ]
    return "\n".join(lines) + "\n"


KINDS: dict[str, Callable[[Sequence[str], Rows], str]] = {
    "table": as_table,
    "csv": as_csv,
    "json": as_json,
    "md": as_markdown,
    "latex": as_latex,
}


def readable(names: Sequence[str], rows: Rows) -> list[Column]:
    """The columns for a person: a quantity with the digits that its interval justifies, and half of that interval."""
    values: dict[str, list[Any]] = {name: [row[i] for row in rows] for i, name in enumerate(names)}
    quantity = names[names.index(ERROR[0]) - 1] if ERROR[0] in names else None
    several = [name for name in names if f"{name}_{ERROR[0]}" in names]
    columns = []
    for name, column in values.items():
        if name in several:
            widths = values[WIDEST]
            cells = [justified(value, value - width, value + width)[0] for value, width in zip(column, widths, strict=True)]
            columns.append(Column(name, cells, numeric=True, figure=True))
        elif several and name == WIDEST:
            columns.append(Column(HALF_WIDTH, [f"{width:.2g}" for width in column], numeric=True, figure=True))
        elif several and (name.endswith(ERROR[0]) or name.startswith("encoded_")):
            continue  # the interval, and the hexadecimal colour, tell a person enough
        elif name == quantity:
            pairs = [justified(*figure) for figure in zip(column, values[ERROR[1]], values[ERROR[2]], strict=True)]
            columns.append(Column(name, [value for value, _ in pairs], numeric=True, figure=True))
            columns.append(Column(HALF_WIDTH, [half_width for _, half_width in pairs], numeric=True, figure=True))
        elif quantity is None or name not in ERROR:
            numeric = all(isinstance(value, int | float) for value in column)
            columns.append(Column(name, [as_text(value) for value in column], numeric))
    return columns


def _padded(column: Column) -> list[str]:
    """The column with its head, every cell as wide as the widest, and decimal points under each other."""
    if not column.numeric:
        width = max(map(len, [column.name, *column.cells]))
        return [text.ljust(width) for text in [column.name, *column.cells]]
    tails = [len(text) - len(text.partition(".")[0]) for text in column.cells]
    cells = [text + " " * (max(tails) - tail) for text, tail in zip(column.cells, tails, strict=True)]
    width = max(map(len, [column.name, *cells]))
    return [text.rjust(width) for text in [column.name, *cells]]


def _json_value(value: object) -> object:
    if isinstance(value, float) and not math.isfinite(value):
        return None if math.isnan(value) else f"{value}"
    return value


def _latex_number(text: str) -> str:
    if text == "nan":
        return text
    power = re.sub(r"e([+-]\d+)", lambda found: rf" \times 10^{{{int(found[1])}}}", text)
    return "$" + power.replace("inf", r"\infty") + "$"
