"""Which table is asked for: a model with parameters and axes in words, or the layout of a renderer, as a source and its axes."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

import numpy as np

from albedo_lab.analysis.request import SCALE, effort, model_of
from albedo_lab.errors import BadInput
from albedo_lab.lookup.axes import Axis, parse_axes
from albedo_lab.lookup.presets import preset as preset_of
from albedo_lab.lookup.source import MU, QUANTITIES, Source
from albedo_lab.model import Model, Parameter

COSINE = Parameter(MU, "cosine of the angle of incidence", default=1.0, low=0.0, high=1.0)


def requested(
    model: Model | str | None,
    parameters: Mapping[str, object],
    axes: Sequence[str] = (),
    quantity: str | None = None,
    sampling: str | None = None,
    preset: str | None = None,
    *,
    tolerance: float = 1e-6,
    method: str = "quadrature",
    seed: int = 0,
    threads: int | None = None,
    order: str = "wi",
    phi_deg: float = 0.0,
) -> tuple[Source, tuple[Axis, ...]]:
    """What fills a table, and its axes, with what the preset or the defaults say where nothing else does.

    The options are those of `albedo_lab.lookup.export.export`; `parameters` are the model's choices, parameters and `scale`, one
    value each. Raises BadInput, but not for nodes at which there is no value: `refuse_nodes` does.
    """
    chosen = None if preset is None else preset_of(preset)
    if model is None:
        if chosen is None:
            raise BadInput("model", model, "must be given where no preset is")
        model = chosen.model
    model = model_of(model)
    fixed = dict(parameters)
    for name, value in parameters.items():
        if isinstance(value, Sequence | np.ndarray) and not isinstance(value, str):
            raise BadInput(name, value, "must be one value; what varies is an axis")
    if chosen is not None:
        # another model than the preset's takes those of its choices that it has, too
        own = {choice.name for choice in model.choices} if model.name != chosen.model else set(dict(chosen.fixed))
        fixed = {name: value for name, value in chosen.fixed if name in own} | fixed
        axes, quantity, sampling = axes or chosen.axes, quantity or chosen.quantity, sampling or chosen.sampling
    quantity = quantity or "albedo"
    if quantity not in QUANTITIES:
        raise BadInput("quantity", quantity, f"must be one of {', '.join(QUANTITIES)}")
    parsed = parse_axes((axes,) if isinstance(axes, str) else axes, sampling or "endpoints")
    want = effort(tolerance, method, seed, threads)
    if not isinstance(phi_deg, int | float) or not abs(phi_deg) <= 360.0:
        raise BadInput("phi_deg", phi_deg, "must be within one turn, [-360, 360] degrees")
    source = Source(model, quantity, want, tuple(fixed.items()), order, math.radians(phi_deg))
    source = source.checked(tuple(axis.name for axis in parsed))
    member = source.member
    member.bind({name: value for name, value in fixed.items() if name not in member.chosen and name != SCALE.name})
    if SCALE.name in fixed:
        SCALE.parse(fixed[SCALE.name])
    return source, parsed


def refuse_nodes(source: Source, axes: Sequence[Axis]) -> None:
    """Nothing, if every node of the axes lies where its variable may, or at a limit. Raises BadInput."""
    for axis in axes:
        refuse_values(source, axis.name, axis.nodes.tolist())


def refuse_values(source: Source, name: str, values: Sequence[object]) -> None:
    """Nothing, if a source has figures at these values of a variable. Raises BadInput."""
    member = source.member
    domain = next(parameter for parameter in (COSINE, *member.parameters, SCALE) if parameter.name == name)
    limit = member.mirror_limit is not None and name == member.mirror_limit[0]
    for x in values:
        if not (limit and isinstance(x, float) and x == 0.0):
            domain.parse(x)
