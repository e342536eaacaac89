"""Phong, reciprocal: a cosine lobe about the mirror direction; as n grows it darkens towards grazing angles like the cosine."""

from __future__ import annotations

from math import pi
from typing import NamedTuple

from albedo_lab.model import EnergyConserving, Model, Parameter, Reciprocal
from albedo_lab.optics.coordinates import Axis, Coordinates, Kink
from albedo_lab.optics.frame import Direction, cosine_power, mirror_of
from albedo_lab.optics.lobes import lobe_pdf, sample_lobe
from albedo_lab.optics.profiles import POWER
from albedo_lab.sources import neumann1999


class Phong(NamedTuple):
    n: float


def evaluate(p: Phong, wi: Direction, wo: Direction) -> float:
    return cosine_power(mirror_of(wo), wi, p.n)  # eq. 5


def sample(p: Phong, wo: Direction, u1: float, u2: float) -> Direction:
    return sample_lobe(mirror_of(wo), p.n, u1, u2)  # eq. 20


def pdf(p: Phong, wi: Direction, wo: Direction) -> float:
    return lobe_pdf(mirror_of(wo), wi, p.n)  # eq. 19; what falls below the horizon is rejected


def largest_constant(p: Phong) -> float:
    """c_n of ineq. 6."""
    return (p.n + 2.0) / (2.0 * pi)


def exponent(p: Phong) -> float:
    return p.n


EXPONENT = Parameter("n", "exponent of the lobe", default=100.0, low=0.0, high=1e8, scale="log")
MIRROR_LOBE = Coordinates(Axis.MIRROR, POWER, exponent)
KINKED_MIRROR_LOBE = Coordinates(Axis.MIRROR, POWER, exponent, kink=Kink.EQUAL_COSINES)

MODEL = Model(
    "phong",
    "c_n [(R.V)^+]^n",
    Phong,
    (EXPONENT,),
    evaluate,
    sample=sample,
    pdf=pdf,
    scale=largest_constant,
    scale_symbol="c_n",
    paper_constant=largest_constant,
    smooth_in=MIRROR_LOBE,
    source=neumann1999("eq. 5, 6"),
    claims=(Reciprocal("neumann1999 §2.1"), EnergyConserving("neumann1999 ineq. 6")),
)
