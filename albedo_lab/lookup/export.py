"""A table as files that a renderer reads, each cell proven to a tolerance, with the record of how far it can be trusted."""

from __future__ import annotations

import math
import os
import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd

from albedo_lab.analysis.rows import Progress, table
from albedo_lab.errors import BadInput
from albedo_lab.files import try_out, write_all
from albedo_lab.lookup import sidecar
from albedo_lab.lookup.axes import Axis
from albedo_lab.lookup.formats import FORMATS, MEAN, Layout, decoded, encode, format_of, prepared
from albedo_lab.lookup.interpolation import FEWEST, MOST, enough, interpolation_error
from albedo_lab.lookup.presets import Preset
from albedo_lab.lookup.presets import preset as preset_of
from albedo_lab.lookup.request import refuse_nodes, requested
from albedo_lab.lookup.source import MU, QUANTITIES, Source
from albedo_lab.lookup.table import Table, mean_beside, tabulated
from albedo_lab.model import Model

STEPS = 1000
"""Of progress, for each of the things that are computed."""


def export(
    model: Model | str | None,
    path: str | os.PathLike[str],
    *,
    axes: Sequence[str] = (),
    quantity: str | None = None,
    sampling: str | None = None,
    preset: str | None = None,
    format: str | None = None,
    dtype: str = "",
    decimals: int | None = None,
    name: str | None = None,
    mean: bool = True,
    force: bool = False,
    tolerance: float = 1e-6,
    method: str = "quadrature",
    seed: int = 0,
    threads: int | None = None,
    order: str = "wi",
    phi_deg: float = 0.0,
    points: int | None = None,
    progress: Progress | None = None,
    **parameters: object,
) -> pd.DataFrame:
    """Writes a quantity of a model over one to three axes as a table, and a record beside it: all files whole, or none.

    Everything that can be refused is refused before anything is computed. The record, `<path>.meta.json`, is that of
    `albedo_lab.lookup.sidecar`.

    Parameters
    ----------
    model
        A Model, or a name of the catalogue; None is that of the preset.
    path
        The file to write. A format that holds one array only has the means in a second one, `<stem>.mean<suffix>`.
    axes
        MAPPING=SIZE or MAPPING=SIZE@FIRST:LAST each, as `Axis.parse` takes them, the first varying slowest: ("roughness=32",
        "mu=32").
    quantity
        One of `albedo_lab.lookup.source.QUANTITIES`; "albedo" by default.
    sampling
        "endpoints" (by default) or "centres" of texels.
    preset
        The layout of a renderer, one of `albedo_lab.lookup.presets.PRESETS`: what else is given goes before it.
    format, dtype, decimals
        How numbers are stored: a name of `albedo_lab.lookup.formats.FORMATS`, by default that of the path's suffix; their type,
        by default the format's; and decimals of text, by default as many as read back to the same number.
    name
        Of the array; of the model and the quantity by default.
    mean
        Whether the mean over all directions is written too, where the quantity has one and an axis is a parameter.
    force
        Whether files that exist are written over.
    tolerance, method, seed, threads
        As of `albedo`, for every cell.
    order, phi_deg
        The direction that the integral runs over, and the azimuth of incidence in degrees, of anisotropic models.
    points
        The most places at which the RMS error of interpolation is measured; 0 leaves it out. By default what a second allows.
    progress
        Called with the number of steps done and the number of all.
    parameters
        The model's choices, parameters and `scale`, one value each.

    Returns
    -------
    DataFrame
        One row per array: file, name, quantity, cells, half_width (the largest, before rounding) and half_width_at, rounding (the
        largest difference between a figure and what is stored of it), interpolation_error (the largest), interpolation_at and
        interpolation_rms.

    Raises
    ------
    BadInput
        For a name, a value or an option outside its domain, values that the format cannot hold, and files that exist or cannot be
        written.
    Inconclusive
        When the tolerance is out of reach.
    """
    source, parsed = requested(
        model,
        parameters,
        axes,
        quantity,
        sampling,
        preset,
        tolerance=tolerance,
        method=method,
        seed=seed,
        threads=threads,
        order=order,
        phi_deg=phi_deg,
    )
    refuse_nodes(source, parsed)
    if not (points is None or points == 0 or enough(points)):
        raise BadInput("points", points, f"must be an integer from {FEWEST} to {MOST}, or 0")
    chosen = None if preset is None else preset_of(preset)
    output = _output(Path(path), source, parsed, chosen, format, Layout(dtype, decimals), name, mean)
    output.refuse_existing(force)
    stages = _Stages(progress, (1 + (output.mean is not None)) * (1 if points == 0 else 2))
    tables = [tabulated(output.name, source, parsed, stages.next())]
    if output.mean is not None:
        beside = mean_beside(tables[0], output.mean, stages.next())
        tables += [beside] if beside is not None else []
    errors = {t.name: interpolation_error(t, points, seed, stages.next()) for t in tables if points != 0}
    known = sidecar.record(tables, output.kind, output.layout, errors, chosen)
    contents = {output.beside(added): data for added, data in encode(output.kind, tables, output.layout, known).items()}
    rows, rounding = [], dict.fromkeys((at.name for at in contents), 0.0)
    for t, entry, (at, lost) in zip(tables, known["tables"], _roundings(output.kind, contents, tables), strict=True):
        rounding[at.name] = max(rounding[at.name], lost)
        rows.append(({"file": str(at), "name": t.name, "quantity": t.source.quantity}, _figures(entry, lost)))
    record = sidecar.with_files(known, {at.name: data for at, data in contents.items()}, rounding)
    write_all(contents | {sidecar.path_of(output.path): sidecar.as_text(record).encode("utf-8")})
    return table(rows)


@dataclass(frozen=True)
class _Output:
    """What is to be written where, and how; `mean` is the name of the means, None where there are to be none."""

    path: Path
    kind: str
    layout: Layout
    name: str
    mean: str | None

    def beside(self, added: str) -> Path:
        """The file whose name adds that to the output's."""
        return self.path.with_name(self.path.stem + added + self.path.suffix)

    def refuse_existing(self, force: bool) -> None:
        """Raises BadInput where a file exists and may not be written over, or cannot be written."""
        for path in (
            self.path,
            *([self.beside(MEAN)] if self.mean and not FORMATS[self.kind].several else []),
            sidecar.path_of(self.path),
        ):
            try:
                try_out(path)
            except (OSError, ValueError) as error:
                reason = error.strerror if isinstance(error, OSError) else error
                raise BadInput("output", str(path), f"must be a file that can be written ({reason})") from None
            if path.exists() and not force:
                raise BadInput("output", str(path), "exists; --force writes over it")


def _output(
    path: Path,
    source: Source,
    axes: Sequence[Axis],
    preset: Preset | None,
    format: str | None,
    layout: Layout,
    name: str | None,
    mean: bool,
) -> _Output:
    """The files that were asked for, with what the preset or the defaults say where nothing was. Raises BadInput."""
    kind = _kind(path, format, preset)
    if preset is not None and kind == preset.format:
        layout = Layout(
            layout.dtype or preset.layout.dtype, preset.layout.decimals if layout.decimals is None else layout.decimals
        )
    own = name or (preset.name if preset else re.sub(r"\W+", "_", f"{source.model.name}_{source.quantity}"))
    has_mean = mean and QUANTITIES[source.quantity].mean is not None and any(axis.name != MU for axis in axes)
    means = preset.mean if preset is not None and name is None else f"{own}_mean"
    if not has_mean or (preset is not None and preset.mean is None):
        means = None
    named = [own] if means is None else [own, means]
    for one in named:
        if not one.isidentifier():
            raise BadInput("name", one, "must be letters, digits and underscores, no digit first")
    return _Output(path, kind, prepared(kind, layout, named), own, means)


def _kind(path: Path, format: str | None, preset: Preset | None) -> str:
    """The format: the one given, that of the suffix, or the preset's. Raises BadInput."""
    try:
        return format_of(path, format)
    except BadInput:
        if format is None and preset is not None:
            return preset.format
        raise


class _Stages:
    """Progress of several things, one after the other, as that of one."""

    def __init__(self, progress: Progress | None, count: int) -> None:
        self.progress, self.count, self.begun, self.done = progress, count, -1, -1

    def next(self) -> Progress | None:
        """What the next of them tells its progress."""
        self.begun += 1
        return None if self.progress is None else self._tell

    def _tell(self, done: int, total: int) -> None:
        """Never backwards: the search for the largest error begins anew again and again."""
        reached = STEPS * self.begun + STEPS * done // max(total, 1)
        if self.progress is not None and reached > self.done:
            self.done = reached
            self.progress(self.done, STEPS * self.count)


def _roundings(kind: str, contents: Mapping[Path, bytes], tables: Sequence[Table]) -> Iterator[tuple[Path, float]]:
    """The file of every table, and how much storing changed its figures: read back from the bytes that are to be written."""
    if FORMATS[kind].several:
        ((at, data),) = contents.items()
        found = [(at, stored) for stored in decoded(kind, data, str(at))]
    else:
        found = [(at, decoded(kind, data, str(at))[0]) for at, data in contents.items()]
    for t, (at, stored) in zip(tables, found, strict=True):
        lost = np.abs(stored.values.ravel() - t.values.ravel())
        yield at, float(np.max(lost[np.isfinite(t.values.ravel())], initial=0.0))


def _figures(entry: Mapping[str, Any], lost: float) -> dict[str, object]:
    """The figures of a row, from the record of its table."""
    widest, between = entry["largest_half_width"], entry["interpolation"] or {}
    return {
        "cells": math.prod(entry["shape"]),
        "half_width": widest["value"],
        "half_width_at": _place(widest["at"]),
        "rounding": lost,
        "interpolation_error": float(between.get("largest", math.nan)),
        "interpolation_at": _place(between.get("largest_at", {})),
        "interpolation_rms": float(between.get("rms", math.nan)),
    }


def _place(at: Mapping[str, float]) -> str:
    """Values of variables in words."""
    return ", ".join(f"{name} = {value:.6g}" for name, value in at.items())
