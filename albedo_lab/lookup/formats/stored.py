"""What a file holds: arrays of numbers, each with the largest error that storing it can have made."""

from __future__ import annotations

import json
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from albedo_lab.errors import BadInput
from albedo_lab.lookup.axes import Floats
from albedo_lab.lookup.source import QUANTITIES
from albedo_lab.lookup.table import Table

MOST_DECIMALS = 30
LARGEST_U16 = 65535.0
ROUNDED = 1e-12
"""What a sum of doubles may be off by."""
MEAN = ".mean"
"""What the name of a file of means adds to that of the table which they are of."""
Encoded = dict[str, bytes]
"""The content of a file under "", and of those beside it under what their names add before the suffix."""
Array = NDArray[Any]


@dataclass(frozen=True)
class Layout:
    """How numbers are stored: of type `dtype` ("" for what the format does by itself), as text with so many `decimals`.

    `decimals` = None is the shortest text that reads back to the same number.
    """

    dtype: str = ""
    decimals: int | None = None

    def checked(self, kind: str, dtypes: Sequence[str], text: bool) -> Layout:
        """This layout, its dtype filled in, if the format `kind` has one of these `dtypes` and, for decimals, is text.

        Raises BadInput.
        """
        if self.dtype and self.dtype not in dtypes:
            raise BadInput("dtype", self.dtype, f"must be {' or '.join(dtypes)} in the format {kind}")
        if self.decimals is not None and (not text or self.dtype == "uint16"):
            raise BadInput("decimals", self.decimals, f"{self.dtype or 'numbers'} in the format {kind} have none; leave them out")
        if self.decimals is not None and not (type(self.decimals) is int and 1 <= self.decimals <= MOST_DECIMALS):
            raise BadInput("decimals", self.decimals, f"must be an integer in [1, {MOST_DECIMALS}]")
        return Layout(self.dtype or dtypes[0], self.decimals)


@dataclass(frozen=True, eq=False)
class Stored:
    """An array as a file holds it.

    values
        Doubles, in the shape that the file tells; its last axis is that of channels where the file says that there are several.
    rounding
        The largest absolute error that storing can have made.
    kind
        How the numbers stand there: "float32", "text of 6 decimals", "16 bits".
    record
        The sidecar's record, where the file carries it inside; empty in files of other programs.
    """

    name: str
    values: Floats
    rounding: float
    kind: str
    record: Mapping[str, Any] = field(default_factory=dict)


def of_numbers(name: str, array: Array, record: Mapping[str, Any] | None = None) -> Stored:
    """A binary array with its rounding; 8 and 16 bits without a sign are fractions of their largest value."""
    if array.dtype.kind != "f":
        bits = 8 * array.dtype.itemsize if array.dtype.kind == "u" and array.dtype.itemsize <= 2 else None
        return Stored(name, *of_integers(array.astype(np.float64), bits), record or {})
    values = array.astype(np.float64)
    kind = "half floats" if array.dtype.itemsize == 2 else f"float{8 * array.dtype.itemsize}"
    return Stored(name, values, half_spacing(values, array.dtype.type), kind, record or {})


def of_integers(values: Floats, bits: int | None = None) -> tuple[Floats, float, str]:
    """Integers with rounding and kind.

    Those of so many `bits`, or from 0 to 255 or 65535 with some above 1, are fractions of the largest there can be.
    """
    largest = float(np.max(values, initial=0.0))
    if bits is None and largest > 1.0 and float(np.min(values)) >= 0.0:
        bits = 8 if largest < 256.0 else 16
    return in_bits(values, bits) if bits is not None and largest < 2**bits else (values, 0.5, "integers")


def in_bits(values: Floats, bits: int) -> tuple[Floats, float, str]:
    """Integers without a sign as fractions of the largest of so many bits, with rounding and kind."""
    unit = 1.0 / (2**bits - 1)
    return values * unit, 0.5 * unit, f"{bits} bits"


def half_spacing(values: Floats, dtype: Any) -> float:
    """Half the distance of the floats of a type about the largest of the values: what rounding to them costs."""
    finite = np.abs(values[np.isfinite(values)])
    largest = min(float(np.max(finite, initial=0.0)), 0.5 * float(np.finfo(dtype).max))
    return 0.5 * float(np.spacing(dtype(largest)))


def typed(table: Table, dtype: str, kind: str, finite: bool = False) -> Array:
    """The values in that type, shape (*sizes, channels).

    Raises BadInput where a value is too large for it, or is not finite and the format `kind` has no way to write that.
    """
    with np.errstate(over="ignore"):
        values = table.values.astype(dtype)
    lost = ~np.isfinite(values) & (finite | np.isfinite(table.values))
    if np.any(lost):
        raise BadInput("values", float(table.values[lost][0]), f"{table.name}: must be finite in {dtype} to stand in {kind}")
    return values


def in_unit(table: Table, kind: str) -> NDArray[np.uint16]:
    """The values as 16 bits, each as the nearest there is.

    Raises BadInput for one outside [0, 1]: nothing is clamped. One that is outside by no more than its own error, as a limit of 1
    may be, is not, as long as the nearest number is one of 16 bits.
    """
    nearest = np.rint(table.values * LARGEST_U16)
    slack = table.half_widths + ROUNDED
    inside = (table.values >= -slack) & (table.values <= 1.0 + slack) & (nearest >= 0.0) & (nearest <= LARGEST_U16)
    if not np.all(inside):
        raise BadInput("values", float(table.values[~inside][0]), f"{table.name}: {kind} holds values in [0, 1] only")
    return nearest.astype("<u2")


def as_image(values: Array) -> Array:
    """Values of shape (*sizes, channels) as (height, width, channels): the last axis is the width, slices stand below another."""
    *sizes, channels = values.shape
    return values.reshape(math.prod(sizes[:-1]), sizes[-1], channels)


def from_image(image: Array, record: Mapping[str, Any]) -> Array:
    """What `as_image` made an image of, if it bears the record of one table.

    Of other images, an alpha that is 1 everywhere, grey written three times, and a blue that is 0 everywhere are left out.
    """
    tables = record.get("tables", ())
    if len(tables) == 1:
        sizes, channels = tables[0]["shape"], len(tables[0]["channels"])
        if math.prod(sizes) == math.prod(image.shape[:2]) and channels <= image.shape[2]:
            return without_one(image[..., :channels].reshape(*sizes, channels))
    if image.shape[2] in (2, 4) and np.all(image[..., -1] == (1.0 if image.dtype.kind == "f" else np.iinfo(image.dtype).max)):
        image = image[..., :-1]
    if np.all(image == image[..., :1]):
        image = image[..., :1]
    if image.shape[2] == 3 and not np.any(image[..., 2]):
        image = image[..., :2]
    return without_one(image[0] if image.shape[0] == 1 else image)


def without_one(values: Array) -> Array:
    """One channel is no axis."""
    return values[..., 0] if values.shape[-1] == 1 else values


def companions(tables: Sequence[Table], record: Mapping[str, Any]) -> dict[str, tuple[Table, Mapping[str, Any]]]:
    """Each table, and the record with nothing of the others, under what its file's name adds: for formats that hold one array."""
    quantity = QUANTITIES[tables[0].source.quantity]
    found: dict[str, tuple[Table, Mapping[str, Any]]] = {}
    for index, table in enumerate(tables):
        added = "" if index == 0 else MEAN if table.source.quantity == quantity.mean else f".{table.name}"
        found[added] = table, {**record, "tables": record["tables"][index : index + 1]} if record else {}
    return found


def parsed_record(text: str | bytes | None) -> dict[str, Any]:
    """A record from inside a file; empty where there is none that was ours."""
    try:
        record = json.loads(text or "{}")
        sound = all(isinstance(t, dict) and {"name", "shape", "channels"} <= set(t) for t in record.get("tables", ()))
    except (ValueError, AttributeError, TypeError):
        return {}
    return record if sound else {}


def name_in(record: Mapping[str, Any], where: str) -> str:
    """What the record calls its one table, or else the file's name."""
    tables = record.get("tables", ())
    return str(tables[0]["name"]) if len(tables) == 1 else Path(where).stem
