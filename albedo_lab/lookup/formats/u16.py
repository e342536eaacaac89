"""Raw unsigned 16-bit numbers, little-endian, rows first, channels alternating: 65535 stands for 1."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from albedo_lab.errors import BadInput
from albedo_lab.lookup.formats.stored import Encoded, Layout, Stored, companions, in_unit, of_numbers
from albedo_lab.lookup.table import Table


def encode(tables: Sequence[Table], layout: Layout, record: Mapping[str, Any]) -> Encoded:
    """A file a table. Raises BadInput for a value outside [0, 1]."""
    return {added: in_unit(table, "u16").tobytes() for added, (table, _) in companions(tables, record).items()}


def decode(data: bytes, where: str) -> list[Stored]:
    """The numbers one after the other: the file tells no shape. Raises BadInput."""
    if len(data) % 2:
        raise BadInput("file", where, "has an odd number of bytes; numbers of 16 bits have two each")
    return [of_numbers(Path(where).stem, np.frombuffer(data, "<u2"))]
