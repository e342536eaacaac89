"""Lambert: the same radiance in every direction."""

from __future__ import annotations

from math import pi
from typing import NamedTuple

from albedo_lab.model import EnergyConserving, Model, Parameter, Reciprocal
from albedo_lab.optics.coordinates import PLAIN
from albedo_lab.optics.frame import Direction
from albedo_lab.optics.lobes import sample_cosine
from albedo_lab.sources import losasso, schlick1993


class Lambert(NamedTuple):
    albedo: float


def evaluate(p: Lambert, wi: Direction, wo: Direction) -> float:
    return p.albedo / pi


def sample(p: Lambert, wo: Direction, u1: float, u2: float) -> Direction:
    return sample_cosine(u1, u2)


def pdf(p: Lambert, wi: Direction, wo: Direction) -> float:
    return wi.z / pi


MODEL = Model(
    "lambert",
    "albedo / pi",
    Lambert,
    (Parameter("albedo", "share of the light that is reflected", default=1.0, low=0.0, high=1.0),),
    evaluate,
    sample=sample,
    pdf=pdf,
    scale=lambda p: 1.0,
    smooth_in=PLAIN,
    source=losasso("The Lambertian Lighting Models"),
    also=(schlick1993("section 3.1"),),
    claims=(Reciprocal("schlick1993 eq. 2"), EnergyConserving("schlick1993 eq. 3")),
)
