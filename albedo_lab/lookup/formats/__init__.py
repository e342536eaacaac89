"""The formats of tables: one file each, which writes tables and reads what it or others wrote."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from importlib import import_module
from pathlib import Path
from types import ModuleType
from typing import Any

from albedo_lab.errors import BadInput
from albedo_lab.lookup.formats.code import identifier
from albedo_lab.lookup.formats.stored import MEAN, Encoded, Layout, Stored
from albedo_lab.lookup.table import Table

__all__ = ["FORMATS", "MEAN", "Encoded", "Format", "Layout", "Stored", "decoded", "encode", "format_of", "prepared", "read"]

LARGEST_FILE = 1 << 28
"""Bytes: more than any table has."""


@dataclass(frozen=True)
class Format:
    """A format: the module that writes and reads it, the suffixes that stand for it, the first bytes of its files.

    Its numbers have one of `dtypes`, the first by default, and stand there as text or not. A file holds one array, or `several`;
    those of programs have names that `languages` take.
    """

    module: str
    suffixes: tuple[str, ...]
    magic: bytes
    dtypes: tuple[str, ...]
    text: bool
    several: bool = False
    languages: bool = False

    def load(self) -> ModuleType:
        """The module, imported when it is first needed."""
        return import_module(f"albedo_lab.lookup.formats.{self.module}")


DOUBLES, SINGLES = ("float64", "float32"), ("float32", "float64")
FORMATS = {
    "npz": Format("npz", (".npz",), b"PK\x03\x04", DOUBLES, text=False, several=True),
    "npy": Format("npy", (".npy",), b"\x93NUMPY", DOUBLES, text=False),
    "csv": Format("csv", (".csv", ".tsv", ".txt", ".dat"), b"", DOUBLES, text=True),
    "json": Format("json", (".json",), b"", DOUBLES, text=True, several=True),
    "c": Format(
        "c_header",
        (".h", ".c", ".hpp", ".cpp", ".inl", ".inc", ".tables"),
        b"",
        (*SINGLES, "uint16"),
        text=True,
        several=True,
        languages=True,
    ),
    "glsl": Format(
        "glsl", (".glsl", ".frag", ".vert", ".comp", ".hlsl"), b"", ("float32",), text=True, several=True, languages=True
    ),
    "exr": Format("exr", (".exr",), b"\x76\x2f\x31\x01", ("float32",), text=False),
    "u16": Format("u16", (".u16",), b"", ("uint16",), text=False),
    "png": Format("png", (".png",), b"\x89PNG\r\n\x1a\n", ("uint16",), text=False),
}
"""By name. A file is written by the format of its suffix unless another one is named."""


def format_of(path: Path, name: str | None = None) -> str:
    """The name of the format: the one given, or that of the file's suffix. Raises BadInput."""
    if name is not None:
        if name not in FORMATS:
            raise BadInput("format", name, f"must be one of {', '.join(FORMATS)}")
        return name
    for known, what in FORMATS.items():
        if path.suffix.lower() in what.suffixes:
            return known
    raise BadInput("format", path.suffix, f"no format has this suffix; name one of {', '.join(FORMATS)}")


def prepared(kind: str, layout: Layout, names: Sequence[str]) -> Layout:
    """The layout with its defaults filled in, if the format can write arrays of these names so.

    Raises BadInput, also where a library is missing that the format needs.
    """
    what = FORMATS[kind]
    layout = layout.checked(kind, what.dtypes, what.text)
    if what.languages:
        for name in names:
            identifier(name)
    if kind == "exr":
        what.load().library()
    return layout


def encode(kind: str, tables: Sequence[Table], layout: Layout, record: Mapping[str, Any]) -> Encoded:
    """The tables, the first of which gives the file its name, as the bytes of files: the same tables, the same bytes.

    Under "" stands the file itself; a format that holds one array only has the others beside it, each under what the file's name
    adds before its suffix (".mean"). `record` is kept inside, where the format has a place for it. Raises BadInput for a layout
    or for values that the format does not have.
    """
    layout = prepared(kind, layout, [table.name for table in tables])
    encoded: Encoded = FORMATS[kind].load().encode(tables, layout, record)
    return encoded


def read(path: str | Path, kind: str | None = None, shape: Sequence[int] | None = None) -> list[Stored]:
    """Every array of numbers in a file, of ours or of another program.

    Parameters
    ----------
    path, kind
        The file and its format, which follows from the file's first bytes, its suffix, or the look of its text if not given.
    shape
        What to make of an array that has just so many numbers, where the file does not tell or tells otherwise.

    Raises
    ------
    BadInput
        For a file that cannot be read, is not of that format, holds no array of numbers, or none of that shape.
    """
    path = Path(path)
    if kind is not None:
        format_of(path, kind)
    data = _content(path)
    found = decoded(kind or _recognised(path, data), data, str(path))
    return found if shape is None else _reshaped(found, tuple(shape), path)


def decoded(kind: str, data: bytes, where: str) -> list[Stored]:
    """Every array of numbers in the bytes of a file, called `where` in messages. Raises BadInput."""
    found = [stored for stored in FORMATS[kind].load().decode(data, where) if stored.values.size > 1]
    if not found:
        raise BadInput("file", where, "holds no array of numbers")
    return found


def _content(path: Path) -> bytes:
    """The whole file. Raises BadInput."""
    try:
        if path.exists() and not path.is_file():
            raise BadInput("file", str(path), "must be a file")
        if path.stat().st_size > LARGEST_FILE:
            raise BadInput("file", str(path), f"is larger than {LARGEST_FILE >> 20} MiB, which no table is")
        data = path.read_bytes()
    except OSError as error:
        raise BadInput("file", str(path), f"cannot be read ({error.strerror})") from None
    except ValueError as error:  # a null character in its name
        raise BadInput("file", str(path), f"cannot be read ({error})") from None
    if not data:
        raise BadInput("file", str(path), "is empty")
    return data


def _recognised(path: Path, data: bytes) -> str:
    """The format of a file by its first bytes, its suffix, or what its text looks like. Raises BadInput."""
    for name, what in FORMATS.items():
        if what.magic and data.startswith(what.magic):
            return name
    for name, what in FORMATS.items():
        if path.suffix.lower() in what.suffixes:
            return name
    if b"\0" in data:
        raise BadInput("format", path.suffix, f"the content tells no format either; name one of {', '.join(FORMATS)}")
    if b"=" in data and any(bracket in data for bracket in b"{("):
        return "c"
    return "json" if data.lstrip()[:1] in (b"[", b"{") else "csv"


def _reshaped(found: Sequence[Stored], shape: tuple[int, ...], path: Path) -> list[Stored]:
    """The arrays that have as many numbers as the shape, in that shape. Raises BadInput where there is none."""
    if not shape or any(type(n) is not int or n < 1 for n in shape):
        raise BadInput("shape", list(shape), "must be whole numbers above 0")
    count = math.prod(shape)
    fitting = [replace(stored, values=stored.values.reshape(shape)) for stored in found if stored.values.size == count]
    if not fitting:
        sizes = ", ".join(f"{stored.name} of {stored.values.size}" for stored in found)
        raise BadInput("shape", list(shape), f"is that of {count} numbers; {path} holds {sizes}")
    return fitting
