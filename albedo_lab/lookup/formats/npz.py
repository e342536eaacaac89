"""NumPy's .npz: every table with its half-widths and the nodes of its axes, and the record as JSON."""

from __future__ import annotations

import io
import json
import zipfile
import zlib
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from albedo_lab.errors import BadInput
from albedo_lab.lookup.formats.npy import as_npy, from_npy
from albedo_lab.lookup.formats.stored import Array, Encoded, Layout, Stored, of_numbers, parsed_record, typed, without_one
from albedo_lab.lookup.table import Table

RECORD = "record"
EPOCH = (1980, 1, 1, 0, 0, 0)
"""The time that every member bears: the same table, the same bytes."""
LARGEST = 1 << 28


def encode(tables: Sequence[Table], layout: Layout, record: Mapping[str, Any]) -> Encoded:
    """One file: NAME, NAME_half_width and NAME_AXIS (the values of an axis' variable) of each table, and `record`.

    Raises BadInput where two of them would have one name.
    """
    arrays: dict[str, Array] = {}
    for table in tables:
        named = {
            table.name: without_one(typed(table, layout.dtype, "npz")),
            f"{table.name}_half_width": without_one(table.half_widths),
            **{f"{table.name}_{axis.name}": axis.nodes for axis in table.axes},
        }
        for name, array in named.items():
            if name in {*arrays, RECORD}:
                raise BadInput("name", name, "is that of two arrays of the .npz file")
            arrays[name] = array
    arrays[RECORD] = np.array(json.dumps(record, allow_nan=False))
    stream = io.BytesIO()
    with zipfile.ZipFile(stream, "w") as archive:
        for name, array in arrays.items():
            member = zipfile.ZipInfo(f"{name}.npy", EPOCH)
            member.create_system, member.external_attr = 3, 0o644 << 16
            archive.writestr(member, as_npy(array))
    return {"": stream.getvalue()}


def decode(data: bytes, where: str) -> list[Stored]:
    """The tables, if the file has our record; all its arrays of numbers otherwise. Raises BadInput."""
    try:
        with zipfile.ZipFile(io.BytesIO(data)) as archive:
            members = archive.infolist()
            if sum(member.file_size for member in members) > LARGEST:
                raise BadInput("file", where, "unpacks to more than any table has")
            content = {m.filename.removesuffix(".npy"): archive.read(m) for m in members if m.filename.endswith(".npy")}
    except BadInput:
        raise
    except (zipfile.BadZipFile, zlib.error, EOFError, OSError, ValueError, NotImplementedError, RuntimeError) as error:
        raise BadInput("file", where, f"is no .npz file that can be read ({error})") from None
    arrays = {name: from_npy(member, where) for name, member in content.items()}
    record = parsed_record(str(arrays[RECORD])) if RECORD in arrays and arrays[RECORD].dtype.kind == "U" else {}
    ours = [str(table["name"]) for table in record.get("tables", ())]
    names = [name for name, array in arrays.items() if array.dtype.kind in "fiu" and (not ours or name in ours)]
    return [of_numbers(name, arrays[name], record) for name in names]
