"""The p-model: from the reciprocal Phong (p = 0) to the stretched one (p = 1)."""

from __future__ import annotations

from typing import NamedTuple

from albedo_lab.model import EnergyConserving, Model, Parameter, Reciprocal
from albedo_lab.models.phong import EXPONENT, KINKED_MIRROR_LOBE, largest_constant, pdf, sample
from albedo_lab.optics.frame import Direction, cosine_power, mirror_of
from albedo_lab.optics.maths import pow
from albedo_lab.sources import neumann1999


class PPhong(NamedTuple):
    n: float
    p: float


def evaluate(p: PPhong, wi: Direction, wo: Direction) -> float:
    return cosine_power(mirror_of(wo), wi, p.n) / pow(max(wi.z, wo.z), p.p)  # eq. 12


MODEL = Model(
    "p_phong",
    "c_n [(R.V)^+]^n / max(N.L, N.V)^p",
    PPhong,
    (EXPONENT, Parameter("p", "how far the lobe is stretched", default=0.5, low=0.0, high=1.0)),
    evaluate,
    sample=sample,
    pdf=pdf,
    scale=largest_constant,
    scale_symbol="c_n",
    paper_constant=largest_constant,
    smooth_in=KINKED_MIRROR_LOBE,
    source=neumann1999("eq. 12"),
    claims=(Reciprocal("neumann1999 §2.3"), EnergyConserving("neumann1999 §2.3", where="n >= 1")),
)
