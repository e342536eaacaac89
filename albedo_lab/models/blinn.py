"""Blinn: a cosine power of the half-vector's angle; for large n it darkens towards grazing like the square of the cosine."""

from __future__ import annotations

from math import nan
from typing import NamedTuple

from albedo_lab.model import MAXIMUM, EnergyConserving, Model, Parameter, Reciprocal
from albedo_lab.optics.coordinates import Axis, Coordinates
from albedo_lab.optics.frame import Direction, bisector, normal_power, reflect
from albedo_lab.optics.lobes import power_normal_pdf, sample_power_normal
from albedo_lab.optics.profiles import POWER
from albedo_lab.sources import neumann1999


class Blinn(NamedTuple):
    n: float


def evaluate(p: Blinn, wi: Direction, wo: Direction) -> float:
    return normal_power(bisector(wi, wo), p.n)  # eq. 31


def sample(p: Blinn, wo: Direction, u1: float, u2: float) -> Direction:
    return reflect(wo, sample_power_normal(p.n, u1, u2))


def pdf(p: Blinn, wi: Direction, wo: Direction) -> float:
    return power_normal_pdf(bisector(wi, wo), p.n)


def exponent(p: Blinn) -> float:
    return p.n


EXPONENT = Parameter("n", "exponent of the lobe", default=100.0, low=0.0, high=1e8, scale="log")
TABLE_2 = {1: 0.350, 2: 0.382, 4: 0.449, 8: 0.592, 16: 0.895, 32: 1.52, 64: 2.79, 128: 5.34, 256: 10.4, 512: 20.6}

MODEL = Model(
    "blinn",
    "C_n (N.H)^n",
    Blinn,
    (EXPONENT,),
    evaluate,
    sample=sample,
    pdf=pdf,
    scale=MAXIMUM,
    scale_symbol="C_n",
    paper_constant=lambda p: TABLE_2.get(p.n, nan),
    smooth_in=Coordinates(Axis.HALF, POWER, exponent),
    source=neumann1999("eq. 31; constants: table 2"),
    claims=(Reciprocal("neumann1999 §2.1"), EnergyConserving("neumann1999 table 2")),
)
