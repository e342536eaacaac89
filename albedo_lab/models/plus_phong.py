"""Plus-Phong: the lobe over the mean of both cosines; at grazing angles it reflects twice the radiance of normal incidence."""

from __future__ import annotations

from albedo_lab.model import Model, Reciprocal
from albedo_lab.models.phong import EXPONENT, MIRROR_LOBE, Phong, largest_constant, pdf, sample
from albedo_lab.optics.frame import Direction, cosine_power, mirror_of
from albedo_lab.sources import neumann1999


def evaluate(p: Phong, wi: Direction, wo: Direction) -> float:
    return cosine_power(mirror_of(wo), wi, p.n) * 2.0 / (wi.z + wo.z)


MODEL = Model(
    "plus_phong",
    "c_n [(R.V)^+]^n 2 / (N.L + N.V)",
    Phong,
    (EXPONENT,),
    evaluate,
    sample=sample,
    pdf=pdf,
    scale=largest_constant,
    scale_symbol="c_n",
    smooth_in=MIRROR_LOBE,
    source=neumann1999("section 2.2, figures 1 and 2"),
    claims=(Reciprocal("neumann1999 §2.2"),),
)
