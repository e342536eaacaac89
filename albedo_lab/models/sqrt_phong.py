"""Phong over the geometric mean of both cosines: a correction that its paper rejects, since it breaks the energy balance."""

from __future__ import annotations

from math import sqrt

from albedo_lab.model import DivergesAtGrazing, Model, Reciprocal
from albedo_lab.models.phong import EXPONENT, MIRROR_LOBE, Phong, largest_constant, pdf, sample
from albedo_lab.optics.frame import Direction, cosine_power, mirror_of
from albedo_lab.sources import neumann1999


def evaluate(p: Phong, wi: Direction, wo: Direction) -> float:
    return cosine_power(mirror_of(wo), wi, p.n) / sqrt(wi.z * wo.z)


MODEL = Model(
    "sqrt_phong",
    "c_n [(R.V)^+]^n / sqrt(N.L N.V)",
    Phong,
    (EXPONENT,),
    evaluate,
    sample=sample,
    pdf=pdf,
    scale=largest_constant,
    scale_symbol="c_n",
    paper_constant=lambda p: 0.0,
    smooth_in=MIRROR_LOBE,
    source=neumann1999("section 2.2"),
    claims=(Reciprocal("neumann1999 §2.2"), DivergesAtGrazing("neumann1999 §2.2")),
)
