"""JSON: the record, and of each table its axes' nodes, values and half-widths. Reads any lists of numbers."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

from albedo_lab.errors import BadInput
from albedo_lab.lookup.formats.code import literals
from albedo_lab.lookup.formats.numerals import understood
from albedo_lab.lookup.formats.stored import Array, Encoded, Layout, Stored, parsed_record
from albedo_lab.lookup.table import Table

WORDS = {"nan": "null", "inf": '"inf"', "-inf": '"-inf"'}
"""JSON has neither NaN nor infinity."""


class Literal(str):
    """A number as it is written."""

    __slots__ = ()


def encode(tables: Sequence[Table], layout: Layout, record: Mapping[str, Any]) -> Encoded:
    """One file with all tables; a row of the last axis is a line."""
    parts = [f'{{"record": {json.dumps(record, allow_nan=False)},\n"tables": [']
    for table in tables:
        axes = {axis.name: axis.nodes.tolist() for axis in table.axes}
        head = {"name": table.name, "channels": table.source.channels, "axes": axes}
        texts = [
            _nested(array, table.values.shape[-1])
            for array in (literals(table, layout, "json", finite=False), table.half_widths.astype(object))
        ]
        parts.append(f'{json.dumps(head)[:-1]},\n"values": {texts[0]},\n"half_widths": {texts[1]}}}')
        parts.append(",\n")
    parts[-1] = "]}\n"
    return {"": "".join(parts).encode("ascii")}


def _nested(cells: Array, channels: int) -> str:
    """Texts of shape (*sizes, channels) as nested lists; one channel is no list."""
    if cells.ndim == 1:
        words = [WORDS.get(str(cell), str(cell)) for cell in cells]
        return words[0] if channels == 1 else f"[{', '.join(words)}]"
    between = ", " if cells.ndim == 2 else ",\n"
    return f"[{between.join(_nested(cell, channels) for cell in cells)}]"


def decode(data: bytes, where: str) -> list[Stored]:
    """The tables of such a file; of another one every list of numbers, under its key. Raises BadInput."""
    try:
        text = data.decode("utf-8-sig")
        document = json.loads(text, parse_float=Literal, parse_int=Literal, parse_constant=Literal)
        named = list(_lists(document, Path(where).stem))
    except (ValueError, RecursionError) as error:
        raise BadInput("file", where, f"is no JSON that can be read ({' '.join(str(error).split())})") from None
    record = {}
    if isinstance(document, dict) and {"record", "tables"} <= set(document):
        record = parsed_record(json.dumps(json.loads(text)["record"]))
        named = [(str(t.get("name", "")), _numbers(t.get("values"))) for t in document["tables"] if isinstance(t, dict)]
    found = []
    for name, numbers in named:
        if numbers is not None:
            texts, shape = numbers
            values, rounding, kind = understood(texts)
            found.append(Stored(name, values.reshape(shape), rounding, kind, record))
    return found


def _lists(node: object, name: str) -> Iterator[tuple[str, tuple[list[str], tuple[int, ...]] | None]]:
    """The largest lists of nothing but numbers, under the names of their keys."""
    if isinstance(node, dict):
        for key, value in node.items():
            yield from _lists(value, str(key))
    elif isinstance(node, list):
        numbers = _numbers(node)
        if numbers is not None:
            yield name, numbers
        else:
            for value in node:
                yield from _lists(value, name)


def _numbers(node: object) -> tuple[list[str], tuple[int, ...]] | None:
    """The numbers of nested lists in order, and their shape; None for what is no regular array of numbers."""
    if isinstance(node, Literal):
        return [str(node)], ()
    if node is None or node in ("inf", "-inf"):
        return ["nan" if node is None else str(node)], ()
    if not isinstance(node, list) or not node:
        return None
    inner = [_numbers(value) for value in node]
    shapes = {None if found is None else found[1] for found in inner}
    if len(shapes) > 1 or None in shapes:
        return None
    texts = [text for found in inner if found is not None for text in found[0]]
    return texts, (len(node), *shapes.pop())  # type: ignore[misc]
