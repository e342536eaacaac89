"""Retro-reflective stretched Phong: the lobe points back at the light."""

from __future__ import annotations

from albedo_lab.model import EnergyConserving, Model, Reciprocal
from albedo_lab.models.phong import EXPONENT, Phong, exponent, largest_constant
from albedo_lab.optics.coordinates import Axis, Coordinates, Kink
from albedo_lab.optics.frame import Direction, cosine_power
from albedo_lab.optics.lobes import lobe_pdf, sample_lobe
from albedo_lab.optics.profiles import POWER
from albedo_lab.sources import neumann1999


def evaluate(p: Phong, wi: Direction, wo: Direction) -> float:
    return cosine_power(wo, wi, p.n) / max(wi.z, wo.z)  # eq. 13


def sample(p: Phong, wo: Direction, u1: float, u2: float) -> Direction:
    return sample_lobe(wo, p.n, u1, u2)


def pdf(p: Phong, wi: Direction, wo: Direction) -> float:
    return lobe_pdf(wo, wi, p.n)


MODEL = Model(
    "retro_phong",
    "c_n [(L.V)^+]^n / max(N.L, N.V)",
    Phong,
    (EXPONENT,),
    evaluate,
    sample=sample,
    pdf=pdf,
    scale=largest_constant,
    scale_symbol="c_n",
    paper_constant=largest_constant,
    smooth_in=Coordinates(Axis.RETRO, POWER, exponent, kink=Kink.EQUAL_COSINES),
    source=neumann1999("eq. 13"),
    claims=(Reciprocal("neumann1999 §3.1"), EnergyConserving("neumann1999 §3.1", where="n >= 1")),
)
