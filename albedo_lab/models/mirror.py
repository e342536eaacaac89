"""Ideal mirror: all it reflects leaves in the mirror direction; the limit of the stretched Phong model for n -> infinity."""

from __future__ import annotations

from typing import NamedTuple

from albedo_lab.model import EnergyConserving, GrazingAlbedo, Model, Parameter
from albedo_lab.optics.frame import Direction
from albedo_lab.sources import neumann1999


class Mirror(NamedTuple):
    F: float


def evaluate(p: Mirror, wi: Direction, wo: Direction) -> float:
    return 0.0  # delta F / cos(theta) is no function: `mirror` is its albedo


def mirror(p: Mirror, mu: float) -> float:
    return p.F  # section 2.1


MODEL = Model(
    "mirror",
    "delta F / N.L",
    Mirror,
    (Parameter("F", "reflectance, the same at every angle", default=1.0, low=0.0, high=1.0),),
    evaluate,
    mirror=mirror,
    scale=lambda p: 1.0,
    source=neumann1999("§2.1, §2.4.1", "F does not depend on the angle"),
    claims=(EnergyConserving("neumann1999 §2.1"), GrazingAlbedo("neumann1999 §2.1", value=lambda p: p.F)),
)
