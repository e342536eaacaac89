"""NumPy's .npy: one array, nothing else."""

from __future__ import annotations

import io
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from albedo_lab.errors import BadInput
from albedo_lab.lookup.formats.stored import Array, Encoded, Layout, Stored, companions, of_numbers, typed, without_one
from albedo_lab.lookup.table import Table


def encode(tables: Sequence[Table], layout: Layout, record: Mapping[str, Any]) -> Encoded:
    """A file a table."""
    return {
        added: as_npy(without_one(typed(table, layout.dtype, "npy"))) for added, (table, _) in companions(tables, record).items()
    }


def decode(data: bytes, where: str) -> list[Stored]:
    """The array, if it is one of numbers. Raises BadInput."""
    array = from_npy(data, where)
    if array.dtype.kind not in "fiu":
        raise BadInput("file", where, f"holds {array.dtype}, no real numbers")
    return [of_numbers(Path(where).stem, array)]


def as_npy(array: Array) -> bytes:
    """The bytes of a .npy file, little-endian, rows first."""
    stream = io.BytesIO()
    np.lib.format.write_array(
        stream, np.array(array, array.dtype.newbyteorder("<"), order="C"), version=(1, 0), allow_pickle=False
    )
    return stream.getvalue()


def from_npy(data: bytes, where: str) -> Array:
    """The array of a .npy file. Raises BadInput."""
    try:
        return np.lib.format.read_array(io.BytesIO(data), allow_pickle=False)
    except Exception as error:  # a damaged header is read as Python, and raises whatever the tokenizer does
        raise BadInput("file", where, f"is no .npy file that can be read ({' '.join(str(error).split())})") from None
