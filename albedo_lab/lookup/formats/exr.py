"""OpenEXR: float32, one image a table, its channels R, or R and G. Half floats are read too."""

from __future__ import annotations

import json
import tempfile
from collections.abc import Mapping, Sequence
from importlib import import_module
from pathlib import Path
from typing import Any

import numpy as np

from albedo_lab.errors import BadInput
from albedo_lab.lookup.formats.stored import (
    Array,
    Encoded,
    Layout,
    Stored,
    as_image,
    companions,
    from_image,
    name_in,
    of_numbers,
    parsed_record,
    typed,
)
from albedo_lab.lookup.table import Table

CHANNELS = "RGBA"
ATTRIBUTE = "albedo_lab"


def library() -> Any:
    """OpenEXR from PyPI. Raises BadInput where it is missing."""
    try:
        return import_module("OpenEXR")
    except ImportError:
        raise BadInput("format", "exr", "needs OpenEXR: pip install 'albedo-lab[exr]'") from None


def encode(tables: Sequence[Table], layout: Layout, record: Mapping[str, Any]) -> Encoded:
    """An image a table: the last axis runs along the width, slices of three axes lie below each other.

    Raises BadInput for a value too large for float32, and where the library is missing.
    """
    return {
        added: _image(as_image(typed(table, "float32", "exr")), told)
        for added, (table, told) in companions(tables, record).items()
    }


def _image(pixels: Array, record: Mapping[str, Any]) -> bytes:
    """The file, compressed without loss."""
    openexr = library()
    head = {"compression": openexr.ZIP_COMPRESSION, "type": openexr.scanlineimage, ATTRIBUTE: json.dumps(record)}
    channels = {CHANNELS[i]: np.ascontiguousarray(pixels[..., i]) for i in range(pixels.shape[2])}
    with tempfile.TemporaryDirectory() as folder:  # the library writes to files only
        path = Path(folder) / "table.exr"
        with openexr.File(head, channels) as file:
            file.write(str(path))
        return path.read_bytes()


def decode(data: bytes, where: str) -> list[Stored]:
    """The image of every part of the file. Raises BadInput."""
    openexr = library()
    found = []
    try:
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "table.exr"
            path.write_bytes(data)
            with openexr.File(str(path), separate_channels=True) as file:
                for part in file.parts:
                    record = parsed_record(part.header.get(ATTRIBUTE))
                    image = np.stack([np.array(part.channels[name].pixels) for name in _ordered(part.channels)], axis=-1)
                    found.append(of_numbers(part.header.get("name") or name_in(record, where), from_image(image, record), record))
    except (RuntimeError, ValueError, TypeError, MemoryError) as error:
        if isinstance(error, BadInput):
            raise
        raise BadInput("file", where, "is no OpenEXR file that can be read") from None
    return found


def _ordered(names: Mapping[str, Any]) -> list[str]:
    """The channels as people count them: red first, alpha last, others between by name."""
    return sorted(names, key=lambda name: (f"{CHANNELS[:3]}*A".find(name[-1]) if name[-1] in CHANNELS else 3, name))
