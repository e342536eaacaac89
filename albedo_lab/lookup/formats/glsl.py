"""GLSL: constant arrays of float, or of vectors where a table has several channels."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from albedo_lab.lookup.formats.arrays import decode
from albedo_lab.lookup.formats.code import PER_LINE, described, extent, identifier, lines_of, literals
from albedo_lab.lookup.formats.stored import Encoded, Layout
from albedo_lab.lookup.table import Table

__all__ = ["decode", "encode"]


def encode(tables: Sequence[Table], layout: Layout, record: Mapping[str, Any]) -> Encoded:
    """One text with an array a table. Raises BadInput for a value that is not finite."""
    parts = []
    for table in tables:
        comment = "\n".join(f"// {line}" for line in described(table, layout, record))
        texts = literals(table, layout, "glsl")
        channels = texts.shape[-1]
        kind = "float" if channels == 1 else f"vec{channels}"
        elements = [cell[0] if channels == 1 else f"{kind}({', '.join(cell)})" for cell in texts.reshape(-1, channels)]
        head = f"const {kind} {identifier(table.name)}[{extent(table)}] = {kind}[{extent(table)}]("
        parts.append("\n".join([comment, head, *lines_of(elements, PER_LINE // channels), ");\n"]))
    return {"": "\n".join(parts).encode("ascii")}
