"""Comma-separated values: a row a cell; a column per axis, per channel, and for the half-width of each. Reads bare numbers."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from itertools import product
from pathlib import Path
from typing import Any

import numpy as np

from albedo_lab.errors import BadInput
from albedo_lab.lookup.formats.code import literals
from albedo_lab.lookup.formats.numerals import NUMERAL, understood
from albedo_lab.lookup.formats.stored import Encoded, Layout, Stored, companions
from albedo_lab.lookup.source import QUANTITIES
from albedo_lab.lookup.table import Table

HALF_WIDTH = "half_width"
CHANNELS = {channel for quantity in QUANTITIES.values() for channel in quantity.channels}
NUMBER = re.compile(NUMERAL)


def encode(tables: Sequence[Table], layout: Layout, record: Mapping[str, Any]) -> Encoded:
    """A file a table, the first axis varying slowest."""
    return {added: _rows(table, layout) for added, (table, _) in companions(tables, record).items()}


def _rows(table: Table, layout: Layout) -> bytes:
    channels = table.source.channels
    widths = [HALF_WIDTH] if len(channels) == 1 else [f"{HALF_WIDTH}_{channel}" for channel in channels]
    lines = [[*(axis.name for axis in table.axes), *channels, *widths]]
    cells = product(*(map(str, axis.nodes.tolist()) for axis in table.axes))
    texts = literals(table, layout, "csv", finite=False).reshape(-1, len(channels))
    for cell, values, width in zip(cells, texts, table.half_widths.reshape(-1, len(channels)).tolist(), strict=True):
        lines.append([*cell, *values, *map(str, width)])
    return "".join(",".join(line) + "\n" for line in lines).encode("ascii")


def decode(data: bytes, where: str) -> list[Stored]:
    """The table of such rows, whatever their order; or rows of numbers as they stand there.

    Columns that have no name of a channel are axes where all their combinations occur, once each; without such a name, the last
    column is the only channel. Raises BadInput.
    """
    lines = [
        line for line in data.decode("utf-8-sig", errors="replace").splitlines() if line.strip() and line.lstrip()[0] not in "#%"
    ]
    fields = [_fields(line) for line in lines]
    names = fields.pop(0) if fields and not any(NUMBER.fullmatch(text) for text in fields[0]) else []
    for row in fields:
        for text in row:
            if not NUMBER.fullmatch(text):
                raise BadInput("file", where, f"holds {text[:40]!r}, which is no number")
    if not fields:
        raise BadInput("file", where, "holds no numbers")
    name = Path(where).stem
    even = len({len(row) for row in fields}) == 1
    if even and names and len(names) == len(fields[0]):
        found = _gridded(name, names, fields)
        if found is not None:
            return [found]
    values, rounding, kind = understood([text for row in fields for text in row])
    shape = (len(fields), len(fields[0])) if even and len(fields) > 1 and len(fields[0]) > 1 else values.shape
    return [Stored(name, values.reshape(shape), rounding, kind)]


def _gridded(name: str, names: Sequence[str], rows: Sequence[Sequence[str]]) -> Stored | None:
    """The channels over the combinations of the axes; None where these are not all there, once each."""
    kept = [i for i, column in enumerate(names) if not column.startswith(HALF_WIDTH)]
    channels = [i for i in kept if names[i] in CHANNELS] or kept[-1:]
    places, sizes = [], []
    for i in kept:
        if i < channels[0]:
            nodes = list(dict.fromkeys(row[i] for row in rows))
            at = {text: k for k, text in enumerate(nodes)}
            places.append([at[row[i]] for row in rows])
            sizes.append(len(nodes))
    if not sizes or int(np.prod(sizes)) != len(rows) or len(set(zip(*places, strict=True))) != len(rows):
        return None
    numbers, rounding, kind = understood([row[i] for row in rows for i in channels])
    values = np.empty((*sizes, len(channels)))
    values[tuple(places)] = numbers.reshape(len(rows), len(channels))
    return Stored(name, values[..., 0] if len(channels) == 1 else values, rounding, kind)


def _fields(line: str) -> list[str]:
    """The fields of a line between semicolons, commas or blanks; a comma beside semicolons is a decimal one."""
    if ";" in line:
        fields = line.replace(",", ".").split(";")
    else:
        fields = line.split(",") if "," in line else line.split()
    while fields and not fields[-1].strip():
        fields.pop()
    return [field.strip().strip('"') for field in fields]
