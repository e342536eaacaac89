"""PNG of 16 bits: grey, or red and green for two channels; 65535 stands for 1. Reads PNG of 8 and 16 bits."""

from __future__ import annotations

import json
import struct
import zlib
from collections.abc import Iterator, Mapping, Sequence
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
    in_unit,
    name_in,
    of_numbers,
    parsed_record,
)
from albedo_lab.lookup.table import Table

SIGNATURE = b"\x89PNG\r\n\x1a\n"
GREY, COLOUR = 0, 2
SAMPLES = {GREY: 1, COLOUR: 3, 4: 2, 6: 4}
"""Channels by colour type; palettes are no tables."""
KEYWORD = b"albedo_lab"
LARGEST = 1 << 24
"""Pixels: more than any table has."""
PAETH = 4
"""The last kind of filter."""


def encode(tables: Sequence[Table], layout: Layout, record: Mapping[str, Any]) -> Encoded:
    """An image a table: the last axis runs along the width, slices of three axes lie below each other.

    Raises BadInput for a value outside [0, 1].
    """
    return {added: _image(as_image(in_unit(table, "png")), told) for added, (table, told) in companions(tables, record).items()}


def _image(pixels: Array, record: Mapping[str, Any]) -> bytes:
    """The file; the second of two channels is green, and blue is 0."""
    height, width, channels = pixels.shape
    colour = GREY if channels == 1 else COLOUR
    rows = np.zeros((height, width, SAMPLES[colour]), ">u2")
    rows[..., :channels] = pixels
    lines = b"".join(b"\0" + row.tobytes() for row in rows)
    chunks = (
        (b"IHDR", struct.pack(">IIBBBBB", width, height, 16, colour, 0, 0, 0)),
        (b"gAMA", struct.pack(">I", 100000)),  # numbers, not shades: no viewer shall bend them
        (b"tEXt", KEYWORD + b"\0" + json.dumps(record).encode("ascii")),
        (b"IDAT", zlib.compress(lines, 9)),
        (b"IEND", b""),
    )
    packed = (struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body)) for kind, body in chunks)
    return SIGNATURE + b"".join(packed)


def decode(data: bytes, where: str) -> list[Stored]:
    """The image's numbers as they stand there, whatever gamma it claims. Raises BadInput."""
    try:
        chunks = list(_chunks(data))
        width, height, bits, colour, _, _, interlaced = struct.unpack(">IIBBBBB", chunks[0][1])
        if bits not in (8, 16) or colour not in SAMPLES or interlaced or not 0 < width * height <= LARGEST:
            raise BadInput("file", where, "must be a PNG of 8 or 16 bits without palette and interlace, of a table's size")
        texts = [body for kind, body in chunks if kind == b"tEXt" and body.startswith(KEYWORD + b"\0")]
        record = parsed_record(texts[0][len(KEYWORD) + 1 :]) if texts else {}
        stride = SAMPLES[colour] * bits // 8
        size = height * (1 + width * stride)
        lines = zlib.decompressobj().decompress(b"".join(body for kind, body in chunks if kind == b"IDAT"), size)
        pixels = np.frombuffer(_unfiltered(lines, height, width * stride, stride), f">u{bits // 8}")
    except (ValueError, IndexError, struct.error, zlib.error) as error:
        if isinstance(error, BadInput):
            raise
        raise BadInput("file", where, f"is no PNG that can be read ({error})") from None
    image = pixels.reshape(height, width, -1)
    return [of_numbers(name_in(record, where), from_image(image, record), record)]


def _chunks(data: bytes) -> Iterator[tuple[bytes, bytes]]:
    """The parts of the file. Raises ValueError for one that is cut off or was changed."""
    if not data.startswith(SIGNATURE):
        raise ValueError("it begins otherwise")
    at = len(SIGNATURE)
    while at < len(data):
        (length,) = struct.unpack_from(">I", data, at)
        kind, body = data[at + 4 : at + 8], data[at + 8 : at + 8 + length]
        (checksum,) = struct.unpack_from(">I", data, at + 8 + length)
        if zlib.crc32(kind + body) != checksum:
            raise ValueError("its checksum is another")
        yield kind, body
        at += 12 + length


def _unfiltered(lines: bytes, height: int, width: int, stride: int) -> bytes:
    """Rows of `width` bytes whose differences, row by row of one of five kinds, are added up. Raises ValueError."""
    if len(lines) != height * (1 + width):
        raise ValueError("it ends too early")
    above = bytearray(width)
    found = bytearray()
    for start in range(0, len(lines), 1 + width):
        kind, row = lines[start], bytearray(lines[start + 1 : start + 1 + width])
        if kind > PAETH:
            raise ValueError(f"filter {kind}")
        for i in range(width if kind else 0):
            left, corner = (row[i - stride], above[i - stride]) if i >= stride else (0, 0)
            guess = (left, above[i], (left + above[i]) // 2, _paeth(left, above[i], corner))[kind - 1]
            row[i] = (row[i] + guess) & 255
        found += row
        above = row
    return bytes(found)


def _paeth(left: int, above: int, corner: int) -> int:
    """The neighbour that is nearest to left + above - corner."""
    guess = left + above - corner
    return min((left, above, corner), key=lambda value: abs(value - guess))
