"""Phong as first published, as a BRDF: the lobe over the cosine of the light alone, and therefore not reciprocal."""

from __future__ import annotations

from albedo_lab.model import Model
from albedo_lab.models.phong import EXPONENT, MIRROR_LOBE, Phong, largest_constant, pdf, sample
from albedo_lab.optics.frame import Direction, cosine_power, mirror_of
from albedo_lab.sources import neumann1999


def evaluate(p: Phong, wi: Direction, wo: Direction) -> float:
    return cosine_power(mirror_of(wo), wi, p.n) / wi.z


MODEL = Model(
    "phong_original",
    "c_n [(R.V)^+]^n / (N.L)",
    Phong,
    (EXPONENT,),
    evaluate,
    sample=sample,
    pdf=pdf,
    scale=largest_constant,
    scale_symbol="c_n",
    smooth_in=MIRROR_LOBE,
    reciprocal=False,
    source=neumann1999(
        "section 2.2",
        "the constant is that of ineq. 6: the paper gets this formula as the reciprocal Phong times 1/cos(theta_L)",
    ),
    claims=(),
)
