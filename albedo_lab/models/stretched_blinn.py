"""Stretched Blinn: Blinn's cosine power over the larger cosine."""

from __future__ import annotations

from math import nan

from albedo_lab.model import MAXIMUM, EnergyConserving, Model, Reciprocal
from albedo_lab.models.blinn import EXPONENT, Blinn, exponent, pdf, sample
from albedo_lab.optics.coordinates import Axis, Coordinates, Kink
from albedo_lab.optics.frame import Direction, bisector, normal_power
from albedo_lab.optics.profiles import POWER
from albedo_lab.sources import neumann1999


def evaluate(p: Blinn, wi: Direction, wo: Direction) -> float:
    return normal_power(bisector(wi, wo), p.n) / max(wi.z, wo.z)  # eq. 32


TABLE_2 = {1: 0.293, 2: 0.368, 4: 0.449, 8: 0.592, 16: 0.895, 32: 1.52, 64: 2.79, 128: 5.34, 256: 10.4, 512: 20.6}

MODEL = Model(
    "stretched_blinn",
    "C_n (N.H)^n / max(N.L, N.V)",
    Blinn,
    (EXPONENT,),
    evaluate,
    sample=sample,
    pdf=pdf,
    scale=MAXIMUM,
    scale_symbol="C_n",
    paper_constant=lambda p: TABLE_2.get(p.n, nan),
    smooth_in=Coordinates(Axis.HALF, POWER, exponent, kink=Kink.EQUAL_COSINES),
    source=neumann1999("eq. 32; constants: table 2"),
    claims=(Reciprocal("neumann1999 §6.1"), EnergyConserving("neumann1999 table 2")),
)
