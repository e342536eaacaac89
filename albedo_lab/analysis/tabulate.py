"""Any isotropic model as a MERL file, for programs that read measured surfaces and nothing else."""

from __future__ import annotations

import math
import os
from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from albedo_lab.analysis.constant import constant
from albedo_lab.analysis.request import grid, model_of, values_of
from albedo_lab.analysis.rows import Progress, parameter_columns, table, track
from albedo_lab.errors import BadInput
from albedo_lab.kernels.tabulation import tabulation_kernel
from albedo_lab.measured.cells import SHAPE, point_of
from albedo_lab.measured.merl_file import CHANNELS, FACTORS, MISSING, Floats, write
from albedo_lab.model import Model
from albedo_lab.tables import plain

MIRROR_COSINES = (1.0, 0.9, 0.7, 0.5, 0.3, 0.1, 0.01, 1e-3)
LARGEST = 1e300
"""Above this the factor of a channel could make a value infinite."""


def tabulate(
    model: Model | str, path: str | os.PathLike[str], /, *, progress: Progress | None = None, **parameters: object
) -> pd.DataFrame:
    """Writes a model in the binary format of the MERL database, whole or not at all.

    A cell holds scale * f at its centre, or where that lies below the horizon at a place of the cell above it; a cell that is
    nowhere above by more than a cosine of 1e-3 holds -1, before its factor.

    Parameters
    ----------
    model
        A Model, or a name of the catalogue.
    path
        The file to write; 35 MB.
    progress
        Called with the number of channels done and the number of all.
    parameters
        The model's choices, parameters and `scale`: one value, or three, for red, green and blue.

    Returns
    -------
    DataFrame
        One row per channel: model, parameters, scale, plane (its colour), cells, below_horizon (cells that hold -1), zero (cells
        that hold 0), smallest and largest value in 1/sr.

    Raises
    ------
    BadInput
        For a value outside its domain, and for what the format cannot hold: a model that is anisotropic, not reciprocal or partly
        a mirror, values that are negative or not finite.
    OSError
        When the file cannot be written.
    """
    model = model_of(model)
    asked = [next(grid(model, single)) for single in _by_plane(model, parameters)]
    evaluated: dict[Any, Plane] = {}
    stored = np.empty((len(CHANNELS), *SHAPE))
    rows = []
    for index, (member, p, given) in enumerate(track(asked, progress)):
        if asked[index] not in evaluated:
            evaluated[asked[index]] = _evaluated(member, p, given)
        plane = evaluated[asked[index]]
        stored[index] = np.where(plane.above, plane.cells / FACTORS[CHANNELS[index]], MISSING)
        values = plane.cells[plane.above]
        found = {
            "plane": CHANNELS[index],
            "cells": plane.above.size,
            "below_horizon": plane.above.size - values.size,
            "zero": int(np.count_nonzero(values == 0.0)),
            "smallest": float(np.min(values)),
            "largest": float(np.max(values)),
        }
        rows.append(({"model": member.name} | parameter_columns(member, p, "plane") | {"scale": plane.scale}, found))
    write(path, stored)
    return table(rows)


class Plane(NamedTuple):
    """scale * f in every cell, and whether the cell has a place above the horizon."""

    scale: float
    cells: Floats
    above: NDArray[np.bool_]


def _by_plane(model: Model, parameters: Mapping[str, object]) -> list[dict[str, object]]:
    """The values of each of the three planes; a swept choice that is not given spreads over them. Raises BadInput."""
    several = values_of(model, parameters)
    for name, values in several.items():
        if len(values) not in (1, len(CHANNELS)):
            raise BadInput(name, parameters.get(name), f"must be one value, or three, for {', '.join(CHANNELS)}")
    return [{name: values[i % len(values)] for name, values in several.items()} for i in range(len(CHANNELS))]


def _evaluated(model: Model, p: Any, given: float | None) -> Plane:
    """One plane. Raises BadInput for what has no place in a file."""
    if not model.isotropic(p):
        raise BadInput("model", model.title, "is anisotropic with these parameters; a MERL file holds isotropic surfaces only")
    if not model.reciprocal:
        raise BadInput("model", model.title, "is not reciprocal; a MERL file has one value for both orders of the directions")
    if any(model.mirror(p, mu) > 0.0 for mu in MIRROR_COSINES):
        raise BadInput("model", model.title, "has a mirror part, which is no function that a cell could hold a value of")
    scale = constant(model, p, given).value
    cells, above = np.empty(SHAPE), np.empty(SHAPE, np.bool_)
    tabulation_kernel(model)(tuple(map(plain, p)), cells, above)
    with np.errstate(over="ignore", invalid="ignore"):
        cells *= scale
    wrong = above & ~((cells >= 0.0) & (cells <= LARGEST))
    if np.any(wrong):
        i, j, k = (int(index) for index in np.argwhere(wrong)[0])
        where = ", ".join(f"{name} = {math.degrees(x):.4g}" for name, x in point_of(i, j, k)._asdict().items())
        what = f"is {cells[i, j, k]:g} 1/sr at {where} degrees"
        raise BadInput("model", model.title, f"{what}; a MERL file holds finite values that are not negative")
    return Plane(scale, cells, above)
