"""The record of a table, beside it or inside: what it is, how it was made, and how far it can be trusted."""

from __future__ import annotations

import hashlib
import json
import math
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from albedo_lab import __version__
from albedo_lab.errors import BadInput
from albedo_lab.lookup.axes import MAPPINGS, SAMPLINGS, Axis, Floats
from albedo_lab.lookup.formats import Layout
from albedo_lab.lookup.source import F0, MU, QUANTITIES, Source
from albedo_lab.lookup.table import Table
from albedo_lab.model import Maximum

if TYPE_CHECKING:
    from albedo_lab.lookup.interpolation import Interpolation
    from albedo_lab.lookup.presets import Preset

SUFFIX = ".meta.json"
SCHEMA = "table.schema.json"
MASKINGS = {
    "smith": "separable Smith masking and shadowing",
    "smith_correlated": "height-correlated Smith masking and shadowing",
    "v_cavity": "masking and shadowing of V-shaped grooves",
    "none": "no masking and shadowing",
}
"""What people call the options of G."""
ROWS = re.compile(r"\[\n\s*([-+.\deE]+(?:,\s+[-+.\deE]+)*)\s*\]")


@dataclass(frozen=True)
class Declared:
    """What a record says that a table is.

    `fixed` are the choices, the parameters that are no axes, and the scale where it was given.
    """

    name: str
    model: str
    fixed: tuple[tuple[str, object], ...]
    quantity: str
    axes: tuple[Axis, ...]


def record(
    tables: Sequence[Table], kind: str, layout: Layout, interpolation: Mapping[str, Interpolation], preset: Preset | None = None
) -> dict[str, Any]:
    """All that is known of tables of one model, as JSON has it, but for their files, which `with_files` adds.

    `kind` and `layout` say how they are stored, `interpolation` holds the errors between the nodes by the tables' names, where
    these were measured. Infinity is "inf", as JSON has none.
    """
    source = tables[0].source
    member = source.member
    return {
        "albedo_lab": __version__,
        "model": member.name,
        "choices": dict(member.chosen),
        "parameters": _parameters(source, {axis.name for table in tables for axis in table.axes}),
        "scale": _scale(source),
        "equation": member.formula,
        "source": str(member.source),
        "deviations": list(member.source.deviations),
        "see_also": [str(reference) for reference in member.also],
        "variant": _variant(source),
        "order": source.order,
        "phi_deg": math.degrees(source.phi),
        "method": source.want.method,
        "seed": source.want.seed,
        "tolerance": {"absolute": source.want.tolerance.absolute, "relative": source.want.tolerance.relative},
        "storage": {"format": kind, "dtype": layout.dtype, "decimals": layout.decimals},
        "preset": None if preset is None else _preset(preset),
        "tables": [_entry(table, interpolation.get(table.name)) for table in tables],
    }


def with_files(known: Mapping[str, Any], files: Mapping[str, bytes], rounding: Mapping[str, float]) -> dict[str, Any]:
    """The record with the SHA-256 of every file's content, and how much storing changed its figures, by the files' names."""
    entries = {
        name: {"sha256": hashlib.sha256(content).hexdigest(), "rounding": rounding[name]} for name, content in files.items()
    }
    return {**known, "files": entries}


def as_text(known: Mapping[str, Any]) -> str:
    """The record as JSON that people read: lists of numbers on one line."""
    text = json.dumps(known, indent=2, ensure_ascii=False, allow_nan=False)
    return ROWS.sub(lambda found: f"[{' '.join(found[1].split())}]", text) + "\n"


def path_of(output: Path) -> Path:
    """Where the record of an output stands."""
    return output.with_name(output.name + SUFFIX)


def beside(path: Path) -> dict[str, Any] | None:
    """The record of a file: the one beside it, or beside the file that it came with ("x.mean.npy" with "x.npy"); None without.

    Raises BadInput for one that cannot be read.
    """
    main = path.with_name(path.stem.rpartition(".")[0] + path.suffix)
    for of in (path, main):
        at = path_of(of)
        if at.is_file():
            try:
                known = json.loads(at.read_text(encoding="utf-8"))
            except (OSError, ValueError) as error:
                raise BadInput("sidecar", str(at), f"cannot be read ({' '.join(str(error).split())})") from None
            if not isinstance(known, dict):
                raise BadInput("sidecar", str(at), "is no record of a table")
            if of is path or path.name in known.get("files", {}):
                return known
    return None


def declared(known: Mapping[str, Any], name: str | None = None) -> Declared:
    """What a record says of the table of that name, or of the first. Raises BadInput where there is no such."""
    try:
        entry = next(t for t in known["tables"] if name is None or t["name"] == name)
        fixed = {**known["choices"], **known["parameters"]}
        if isinstance(known["scale"], int | float):
            fixed["scale"] = float(known["scale"])
        axes = tuple(
            Axis(a["name"], a["mapping"], a["size"], float(a["first"]), float(a["last"]), a["sampling"]) for a in entry["axes"]
        )
        if not axes or any(axis.mapping not in MAPPINGS or axis.sampling not in SAMPLINGS or axis.size < 2 for axis in axes):
            raise ValueError
        if entry["quantity"] not in QUANTITIES:
            raise ValueError
        return Declared(str(entry["name"]), str(known["model"]), tuple(fixed.items()), entry["quantity"], axes)
    except StopIteration:
        raise BadInput("sidecar", name, "has no table of that name") from None
    except (KeyError, TypeError, ValueError):
        raise BadInput("sidecar", str(known.get("model", "")), "is no record of a table") from None


def _parameters(source: Source, variables: set[str]) -> dict[str, float]:
    """The parameters that are no axes, defaults filled in."""
    member = source.member
    moved = {name for p in member.parameters if p.name in variables for name in p.sets}
    if source.quantity.startswith("split-sum"):
        moved.add(F0)
    given = {name: value for name, value in source.fixed if name not in member.chosen and name != "scale"}
    columns = member.columns(member.bind(given))
    kept = [p.name for p in member.parameters if p.name not in variables | moved]
    return {name: float(columns[name]) for name in kept if not math.isnan(columns[name])}


def _scale(source: Source) -> float | str:
    """The constant of the equation: the one given, or where it comes from."""
    given = dict(source.fixed).get("scale")
    if given is not None:
        return float(given)  # type: ignore[arg-type]
    if source.quantity == "constant":
        return "what the table holds"
    return "computed maximum" if isinstance(source.member.scale, Maximum) else "as its source prescribes"


def _variant(source: Source) -> str:
    """The model's choices in words."""
    chosen = source.member.chosen
    words = [MASKINGS.get(word, f"G = {word}") if name == "G" else f"{name} = {word}" for name, word in chosen.items()]
    return ", ".join(words) or "the only one"


def _preset(preset: Preset) -> dict[str, Any]:
    """Which renderer's layout it is."""
    return {"reader": preset.reader, "differences": list(preset.differences)}


def _entry(table: Table, found: Interpolation | None) -> dict[str, Any]:
    """One table: its axes and its errors."""
    quantity = table.source.quantity
    return {
        "name": table.name,
        "quantity": quantity,
        "meaning": QUANTITIES[quantity].meaning,
        "channels": list(table.source.channels),
        "shape": list(table.sizes),
        "axes": [_axis(axis) for axis in table.axes],
        "fastest_axis": table.axes[-1].name,
        "limits": _limits(table),
        "largest_half_width": _largest(table, table.half_widths),
        "largest_standard_error": _largest(table, table.standard_errors),
        "evaluations": table.samples,
        "interpolation": None if found is None else _interpolation(found),
    }


def _axis(axis: Axis) -> dict[str, Any]:
    """An axis as `Axis` has it, in words, and its nodes."""
    return {
        "name": axis.name,
        "mapping": axis.mapping,
        "label": axis.label,
        "size": axis.size,
        "first": axis.first,
        "last": axis.last,
        "sampling": axis.sampling,
        "meaning": axis.title,
        "nodes": axis.nodes.tolist(),
    }


def _limits(table: Table) -> list[str]:
    """Which nodes are limits of the model, not values of it."""
    found = []
    at_zero = {axis.name for axis in table.axes if np.any(axis.nodes == 0.0)}
    member = table.source.member
    if MU in at_zero:
        found.append("mu = 0: the limit at grazing incidence")
    if member.mirror_limit is not None and member.mirror_limit[0] in at_zero:
        corner = "; where both are limits, this one goes first" if MU in at_zero else ""
        found.append(f"{member.mirror_limit[0]} = 0: an ideal mirror, the limit of the lobe{corner}")
    return found


def _largest(table: Table, errors: Floats) -> dict[str, Any]:
    """The largest of the cells' errors, and at which node."""
    *place, channel = np.unravel_index(int(np.argmax(errors)), errors.shape)
    at = {axis.name: float(axis.nodes[i]) for axis, i in zip(table.axes, place, strict=True)}
    return {"value": _number(float(np.max(errors))), "at": at, "channel": table.source.channels[int(channel)]}


def _interpolation(found: Interpolation) -> dict[str, Any]:
    """The errors between the nodes."""
    return {
        "largest": _number(found.largest),
        "largest_at": dict(found.largest_at),
        "largest_bound": _number(found.largest_bound),
        "rms": _number(found.rms),
        "rms_error": _number(found.rms_error),
        "points": found.points,
        "over": {name: list(ends) for name, ends in found.over.items()},
    }


def _number(x: float) -> float | str | None:
    """JSON has neither NaN, which becomes null, nor infinity."""
    return x if math.isfinite(x) else None if math.isnan(x) else f"{x}"
