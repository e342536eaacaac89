"""The kinds of picture by the names that the command line has for them, for any model and grid of parameters."""

from __future__ import annotations

import itertools
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import fields
from typing import Any

from albedo_lab.analysis.request import model_of, values_of
from albedo_lab.errors import BadInput
from albedo_lab.model import Model
from albedo_lab.pictures.albedos import Albedos
from albedo_lab.pictures.base import Curve, Picture
from albedo_lab.pictures.evaluation import refuse_below_horizon
from albedo_lab.pictures.lobes import Lobes
from albedo_lab.pictures.polar import Polar
from albedo_lab.pictures.previews import Previews
from albedo_lab.pictures.samples import Samples
from albedo_lab.pictures.slices import Slices

KINDS: dict[str, tuple[type[Any], Mapping[str, object]]] = {
    "polar": (Polar, {}),
    "log-polar": (Polar, {"log": True}),
    "lobe": (Lobes, {}),
    "albedo": (Albedos, {"to_grazing": True}),
    "slice": (Slices, {}),
    "preview": (Previews, {}),
    "sampling": (Samples, {}),
}
"""Each with the options that make it what its name says."""
MOST = 24
"""Curves or lights that one picture can tell apart."""


def asked(kind: str, model: Model | str, parameters: Mapping[str, object], **options: Any) -> Picture:
    """A picture of every model of a grid of parameters; options are the picture's own. Raises BadInput for another."""
    made, own = KINDS[kind]
    for name, value in options.items():
        if name not in {field.name for field in fields(made)}:
            raise BadInput(name, value, f"is nothing that a picture of the kind {kind} knows")
    refuse_below_horizon(options.get("theta_deg", ()))
    picture: Picture = made(curves(model, parameters), **own, **options)
    return picture


def curves(model: Model | str, parameters: Mapping[str, object]) -> tuple[Curve, ...]:
    """A curve for every combination of the parameters' values, labelled by those that differ. Raises BadInput for too many."""
    model = model_of(model)
    several = values_of(model, parameters)
    cells = [dict(zip(several, values, strict=True)) for values in itertools.product(*several.values())]
    made = tuple(Curve(", ".join([model.name, *_differing(cell, several)]), model, cell) for cell in cells)
    if len(made) > MOST:
        raise BadInput("parameter", f"{len(made)} combinations", f"must be at most {MOST}, or no picture tells them apart")
    if len({curve.label for curve in made}) < len(made):
        raise BadInput("parameter", made[0].label, "must not have the same value twice")
    return made


def _differing(cell: Mapping[str, object], several: Mapping[str, Sequence[object]]) -> Iterator[str]:
    """The values of a cell that others have not."""
    for name, value in cell.items():
        if len(several[name]) > 1:
            yield f"{name} = {value:.12g}" if isinstance(value, float) else f"{name} = {value}"
