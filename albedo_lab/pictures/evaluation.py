"""What pictures ask of a curve: its model at its parameters, and f at many pairs of directions."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np
from numpy.typing import NDArray

from albedo_lab.analysis.constant import constant
from albedo_lab.analysis.request import grid, model_of
from albedo_lab.analysis.verdict import Subject
from albedo_lab.errors import BadInput
from albedo_lab.estimate.record import Question
from albedo_lab.kernels.search import value_kernel
from albedo_lab.pictures.base import Curve

Array = NDArray[np.float64]


def subject(curve: Curve) -> Subject:
    """The member of the family, its parameters and its constant. Raises BadInput, also for several values of a parameter."""
    cells = list(grid(model_of(curve.model), curve.parameters))
    if len(cells) != 1:
        raise BadInput("curve", curve.label, f"must be one model at one set of parameters, and is {len(cells)}")
    ((member, p, given),) = cells
    return Subject(member, p, constant(member, p, given))


def values(of: Subject, wi: Array, wo: Array) -> Array:
    """f_r in 1/sr, the constant in it, towards the lights wi from the viewers wo: (n, 3) each, unit vectors with z > 0."""
    f = np.empty(len(wi))
    value_kernel(of.model)(Question(of.model, of.p, None).values, np.ascontiguousarray(wi), np.ascontiguousarray(wo), f)
    with np.errstate(over="ignore", invalid="ignore"):
        return f * of.scale.value


def refuse_below_horizon(theta_deg: Iterable[float]) -> None:
    """Raises BadInput for an angle from the normal that is none, or not in [0, 90) degrees."""
    for theta in theta_deg:
        if not (isinstance(theta, int | float) and 0.0 <= theta < 90.0):
            raise BadInput("theta_deg", theta, "must be in [0, 90) degrees")


def in_plane(angle_deg: Array) -> Array:
    """Unit vectors (n, 3) in the plane y = 0, at angles from the normal towards +x in degrees in (-90, 90)."""
    angle = np.radians(angle_deg)
    return np.stack([np.sin(angle), np.zeros_like(angle), np.sin(np.radians(90.0 - np.abs(angle_deg)))], axis=-1)
