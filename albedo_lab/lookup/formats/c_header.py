"""C header: plain static arrays behind an include guard, for C99 and C++."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from albedo_lab.lookup.formats.arrays import decode
from albedo_lab.lookup.formats.code import described, extent, identifier, lines_of, literals
from albedo_lab.lookup.formats.stored import Encoded, Layout, in_unit
from albedo_lab.lookup.table import Table

__all__ = ["decode", "encode"]

TYPES = {"float32": ("float", "f"), "float64": ("double", ""), "uint16": ("unsigned short", "")}
"""By dtype: the name of the type, and the suffix of its literals."""


def encode(tables: Sequence[Table], layout: Layout, record: Mapping[str, Any]) -> Encoded:
    """One header with an array a table; several channels alternate.

    Raises BadInput for a value that is not finite, or for uint16 outside [0, 1].
    """
    guard = identifier(tables[0].name).upper() + "_H"
    kind, suffix = TYPES[layout.dtype]
    parts = [f"#ifndef {guard}\n#define {guard}\n"]
    for table in tables:
        channels = table.values.shape[-1]
        comment = "\n".join(f" * {line}" for line in described(table, layout, record, interleaved=True))
        size = extent(table) + (f" * {channels}" if channels > 1 else "")
        cells = in_unit(table, "c") if layout.dtype == "uint16" else literals(table, layout, "c")
        lines = lines_of([f"{cell}{suffix}" for cell in cells.ravel()])
        parts.append(
            "\n".join([f"/*\n{comment}\n */", f"static const {kind} {identifier(table.name)}[{size}] = {{", *lines, "};\n"])
        )
    parts.append(f"#endif /* {guard} */\n")
    return {"": "\n".join(parts).encode("ascii")}
