"""Markdown tables and the way figures are written in them."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence


def table(head: Sequence[str], rows: Iterable[Sequence[str]], text_columns: int = 1) -> str:
    """A Markdown table whose first columns are text and whose others are figures, padded to be read as it is."""
    lines = [list(head), *map(list, rows)]
    widths = [max(len(line[i]) for line in lines) for i in range(len(head))]
    rule = ["-" * w if i < text_columns else "-" * (w - 1) + ":" for i, w in enumerate(widths)]
    padded = [
        [cell.ljust(w) if i < text_columns else cell.rjust(w) for i, (cell, w) in enumerate(zip(line, widths, strict=True))]
        for line in lines
    ]
    return "\n".join(f"| {' | '.join(line)} |" for line in [padded[0], rule, *padded[1:]])


def digits(value: float, count: int = 3) -> str:
    """So many significant digits without an exponent."""
    if not math.isfinite(value) or value == 0.0:
        return str(value)
    places = count - 1 - math.floor(math.log10(abs(value)))
    return f"{round(value, places):,.{max(places, 0)}f}"


def seconds(value: float) -> str:
    """A duration in the unit that suits it."""
    for unit, size in (("h", 3600.0), ("min", 60.0), ("s", 1.0), ("ms", 1e-3), ("µs", 1e-6)):
        if value >= size:
            return f"{digits(value / size)} {unit}"
    return f"{digits(value * 1e9)} ns"


def rate(samples: int, time: float) -> str:
    """Millions of samples a second."""
    return digits(samples / time / 1e6)


def verdict(value: float, wanted: float) -> str:
    """A ratio against what is required of it."""
    return f"{digits(value)}x (required {wanted:,.0f}x: {'holds' if value >= wanted else 'FAILS'})"
