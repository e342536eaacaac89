"""The question of an audit: which array of which file, and what it is said to be."""

from __future__ import annotations

import hashlib
import math
import os
from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

from albedo_lab.analysis.request import Effort, effort, model_of
from albedo_lab.analysis.rows import Progress
from albedo_lab.errors import BadInput
from albedo_lab.lookup import sidecar
from albedo_lab.lookup.audit.defects import Defect
from albedo_lab.lookup.audit.expectation import Expectation
from albedo_lab.lookup.audit.judge import judged
from albedo_lab.lookup.audit.record import Audit
from albedo_lab.lookup.audit.truth import Lab
from albedo_lab.lookup.audit.variants import SPLIT, variant_of
from albedo_lab.lookup.axes import SAMPLINGS, Axis, parse_axes
from albedo_lab.lookup.formats import Stored, read
from albedo_lab.lookup.presets import preset as preset_of
from albedo_lab.lookup.source import F0, MU, QUANTITIES, Source
from albedo_lab.model import Model

CMGEN = ("filament-dfg", "filament-dfg-multiscatter")
"""Presets whose renderer's own tool writes the rows of the next roughness."""
FEWEST = 8
"""Numbers of an array that nobody has named."""
FINEST = 1e-5
"""Truth is computed to a tenth of the tolerance, or to this if that is coarser."""


def audit(
    path: str | os.PathLike[str],
    *,
    format: str | None = None,
    shape: Sequence[int] | None = None,
    array: str | int | None = None,
    preset: str | None = None,
    model: Model | str | None = None,
    axes: Sequence[str] = (),
    quantity: str | None = None,
    sampling: str | None = None,
    tolerance: float = 1e-4,
    threads: int | None = None,
    progress: Progress | None = None,
    **parameters: object,
) -> Audit:
    """Which model and variant a table holds, in which layout, and what is wrong with it.

    What the table should be is what the options say; without any, the record beside the file; without one, nothing: then the
    layout that is found is a fact, and only what no convention has is a defect.

    Parameters
    ----------
    path, format, shape
        The file, its format where its suffix does not tell, and its array's shape where the file does not.
    array
        Name or number of the array. By default all that the preset or the record names; without either, the first.
    preset, model, axes, quantity, sampling
        What the table is said to be, as `export` takes them; each may be left open.
    tolerance
        By how much a cell may be off beyond what its storage and the truth's own bound account for.
    threads
        For the truth.
    progress
        Called with the number of models tried and of all.
    parameters
        The model's choices and parameters that do not run along an axis.

    Raises
    ------
    BadInput
        For a file that cannot be read, and for an option outside its domain.
    """
    want = effort(tolerance, "quadrature", 0, threads)
    path = Path(path)
    found = read(path, format, shape)
    known = _record(path, found) if all(each is None for each in (preset, model, quantity, sampling)) and not axes else None
    chosen = [_chosen(found, array)] if array is not None else _declared(found, preset, known) or [_first(path, found)]
    others = tuple(each.name for each in found if each not in chosen)
    facts = _changed(path) if known else ()
    audits = []
    for stored in chosen:
        said, lab = _expectation(path, stored, known, preset, model, axes, quantity, sampling, parameters, want)
        judgement = judged(stored.values, stored.rounding, stored.kind, said, lab, tolerance, progress)
        judgement = replace(judgement, facts=(*facts, *judgement.facts))
        audits.append(Audit(str(path), stored.name, stored.kind, stored.rounding, others, judgement))
    return replace(audits[0], more=tuple(audits[1:]))


def _record(path: Path, found: Sequence[Stored]) -> Mapping[str, Any] | None:
    """The record inside the file or beside it. Raises BadInput for one that cannot be read."""
    return next((stored.record for stored in found if stored.record), None) or sidecar.beside(path)


def _first(path: Path, found: Sequence[Stored]) -> Stored:
    """The first array that is more than a few numbers in prose or in a program. Raises BadInput."""
    for stored in found:
        if stored.values.size >= FEWEST:
            return stored
    sizes = ", ".join(f"{stored.name or 'one'} of {stored.values.size}" for stored in found)
    raise BadInput("file", str(path), f"holds no table of {FEWEST} or more numbers ({sizes}); name what is one with --array")


def _declared(found: Sequence[Stored], preset: str | None, known: Mapping[str, Any] | None) -> list[Stored]:
    """The arrays that a preset or a record names."""
    names: set[str | None] = set()
    if preset is not None:
        names = {preset_of(preset).name, preset_of(preset).mean}
    elif known is not None:
        names = {entry.get("name") for entry in _entries(known)}
    return [stored for stored in found if stored.name in names]


def _entries(known: Mapping[str, Any]) -> list[Mapping[str, Any]]:
    """The tables of a record."""
    tables = known.get("tables", [])
    return [entry for entry in tables if isinstance(entry, dict)] if isinstance(tables, list) else []


def _changed(path: Path) -> tuple[Defect, ...]:
    """A fact, where the file is no longer what the record beside it was written for."""
    files = (sidecar.beside(path) or {}).get("files", {})
    entry = files.get(path.name) if isinstance(files, dict) else None
    written = entry.get("sha256") if isinstance(entry, dict) else None
    if written is None or hashlib.sha256(path.read_bytes()).hexdigest() == written:
        return ()
    return (Defect("changed", "the file has changed since its record was written: its SHA-256 is another"),)


def _chosen(found: Sequence[Stored], array: str | int | None) -> Stored:
    """The array of that name or number. Raises BadInput."""
    if array is None:
        return found[0]
    for i, stored in enumerate(found):
        if stored.name == array or str(i) == str(array):
            return stored
    raise BadInput("array", array, f"must be one of {', '.join(stored.name for stored in found)}, or a number from 0")


def _expectation(
    path: Path,
    stored: Stored,
    known: Mapping[str, Any] | None,
    preset: str | None,
    model: Model | str | None,
    axes: Sequence[str],
    quantity: str | None,
    sampling: str | None,
    parameters: Mapping[str, object],
    want: Effort,
) -> tuple[Expectation, Lab]:
    """What is said of the table, and how its truth is computed. Raises BadInput."""
    fine = effort(max(min(FINEST, 0.1 * want.tolerance.absolute), 1e-12), "quadrature", 0, want.threads)
    lab = Lab(fine)
    if quantity is not None and quantity not in QUANTITIES:
        raise BadInput("quantity", quantity, f"must be one of {', '.join(QUANTITIES)}")
    if sampling is not None and sampling not in SAMPLINGS:
        raise BadInput("sampling", sampling, f"must be one of {', '.join(SAMPLINGS)}")
    if preset is None and model is None and not axes and quantity is None and sampling is None:
        if parameters:
            name, value = next(iter(parameters.items()))
            raise BadInput(name, value, "is a parameter of a model; name the model as well")
        return _recorded(known, stored, path, lab) if known else (Expectation(), lab)
    chosen = None if preset is None else preset_of(preset)
    fixed = dict(parameters) if chosen is None else {**dict(chosen.fixed), **parameters}
    if chosen is not None:
        model = chosen.model if model is None else model
        quantity = chosen.quantity if quantity is None else quantity
    asked = axes or (chosen.axes if chosen else ())
    parsed = parse_axes(asked, sampling or (chosen.sampling if chosen else "endpoints")) if asked else None
    if chosen is not None and parsed is not None and _is_mean(stored, chosen.mean, parsed):
        quantity, parsed = QUANTITIES[chosen.quantity].mean, tuple(axis for axis in parsed if axis.name != MU)
    by = "by the options" if chosen is None else f"by the preset {preset}"
    said = _said(model, fixed, quantity, parsed, sampling, by, lab)
    return replace(said, limits=chosen is None or bool(axes), texel=preset in CMGEN and not axes), lab


def _is_mean(stored: Stored, name: str | None, axes: Sequence[Axis]) -> bool:
    """Whether the array is the one of mean albedos beside a preset's table."""
    sizes = [axis.size for axis in axes if axis.name != MU]
    fits = stored.values.size == math.prod(sizes) != math.prod(axis.size for axis in axes)
    return name is not None and len(sizes) > 0 and (stored.name == name or fits)


def _recorded(known: Mapping[str, Any], stored: Stored, path: Path, lab: Lab) -> tuple[Expectation, Lab]:
    """What a record says of the array: of that name, or of that shape. Raises BadInput."""
    entries = _entries(known)
    named = [entry for entry in entries if entry.get("name") == stored.name]
    sized = [entry for entry in entries if math.prod(entry.get("shape", [0])) == stored.values[..., 0].size]
    whole = [entry for entry in entries if math.prod(entry.get("shape", [0])) == stored.values.size]
    name = next((str(entry.get("name")) for entry in (*named, *whole, *sized)), None)
    said = sidecar.declared(known, name)
    lab = replace(lab, order=str(known.get("order", "wi")), phi=math.radians(float(known.get("phi_deg", 0.0))))
    return _said(said.model, dict(said.fixed), said.quantity, said.axes, None, f"by the record beside {path.name}", lab), lab


def _said(
    model: Model | str | None,
    fixed: Mapping[str, object],
    quantity: str | None,
    axes: tuple[Axis, ...] | None,
    sampling: str | None,
    by: str,
    lab: Lab,
) -> Expectation:
    """An expectation whose parts agree with each other. Raises BadInput."""
    if model is None:
        if fixed:
            name, value = next(iter(fixed.items()))
            raise BadInput(name, value, "is a parameter of a model; name the model as well")
        return Expectation(None, quantity, axes, sampling, by)
    found = model_of(model)
    member, numbers = found.member({name: value for name, value in fixed.items() if name != "scale"})
    member.bind(numbers)
    variables = () if axes is None else tuple(axis.name for axis in axes)
    if axes is not None:
        assumed = quantity or ("albedo" if MU in variables else "mean-albedo")
        split = quantity is None and _is_split(member, fixed, variables)
        Source(found, "split-sum" if split else assumed, lab.want, tuple(fixed.items())).checked(variables)
    open_split = quantity is None and _is_split(member, fixed, variables)
    variant = variant_of(found, fixed, SPLIT[0] if open_split else quantity or "albedo")
    return Expectation(variant, quantity, axes, sampling, by)


def _is_split(member: Model, fixed: Mapping[str, object], variables: Sequence[str]) -> bool:
    """Whether a model leaves F0 open, as the split sum does."""
    return F0 in {parameter.name for parameter in member.parameters} and F0 not in fixed and F0 not in variables
