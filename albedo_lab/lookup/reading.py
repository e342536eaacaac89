"""Tables out of the files that `export` wrote: as stored, with the errors that their record tells."""

from __future__ import annotations

import hashlib
import math
from collections.abc import Iterator, Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from albedo_lab.analysis.request import effort
from albedo_lab.catalogue import find
from albedo_lab.errors import BadInput
from albedo_lab.estimate.record import Tolerance
from albedo_lab.lookup import sidecar
from albedo_lab.lookup.formats import Stored, read
from albedo_lab.lookup.source import Source
from albedo_lab.lookup.table import Table


def read_tables(path: str | Path) -> list[Table]:
    """The tables of a file, and of those that were written with it, from their content and from their record.

    Values are those stored. Half-widths are the same in all cells: the largest of the record, plus what storing cost.

    Raises
    ------
    BadInput
        For files that cannot be read, have no record or another one, and for a model that the catalogue does not have.
    """
    path = Path(path)
    arrays = read(path)
    known = sidecar.beside(path) or dict(arrays[0].record)
    if not known:
        raise BadInput("file", str(path), f"has no record, {sidecar.path_of(path).name}, to say what is in it")
    try:
        return [_table(known, *pair) for pair in zip(known["tables"], _stored(path, arrays, known), strict=True)]
    except (AttributeError, KeyError, TypeError, ValueError) as error:
        if isinstance(error, BadInput):
            raise
        raise BadInput("file", str(path), "does not fit its record: is not what `export` wrote, or was changed since") from None


def _stored(path: Path, arrays: list[Stored], known: Mapping[str, Any]) -> Iterator[Stored]:
    """The array of every table of a record, in its order: all in one file, or one in each. Raises BadInput."""
    files = known.get("files") or {path.name: {}}
    for name, entry in files.items():
        at = path.with_name(name)
        found = arrays if name == path.name else read(at)
        if "sha256" in entry and hashlib.sha256(at.read_bytes()).hexdigest() != entry["sha256"]:
            raise BadInput("file", str(at), "is not the one that its record describes: it was changed since")
        for stored in found:
            yield replace(stored, rounding=float(entry.get("rounding", stored.rounding)))


def _table(known: Mapping[str, Any], entry: Mapping[str, Any], stored: Stored) -> Table:
    """The table of that entry of a record."""
    said = sidecar.declared(known, entry["name"])
    within = known["tolerance"]
    want = replace(
        effort(float(within["absolute"]), known["method"], known["seed"], None),
        tolerance=Tolerance(float(within["absolute"]), float(within["relative"])),
    )
    source = Source(find(said.model), said.quantity, want, said.fixed, known["order"], math.radians(known["phi_deg"]))
    source = source.checked(tuple(axis.name for axis in said.axes))
    values = stored.values.reshape(*(axis.size for axis in said.axes), len(source.channels))
    width, error = (float(entry[f"largest_{what}"]["value"]) for what in ("half_width", "standard_error"))
    widths, errors = (np.full(values.shape, x) for x in (width + stored.rounding, error))
    return Table(said.name, source, said.axes, values, widths, errors, int(entry["evaluations"]))
