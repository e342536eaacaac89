"""Stretched Phong: the reciprocal Phong lobe over the larger cosine, so that a mirror stays bright at grazing angles."""

from __future__ import annotations

from math import pi, sqrt

from albedo_lab.model import EnergyConserving, GrazingAlbedo, Model, Reciprocal
from albedo_lab.models.phong import EXPONENT, KINKED_MIRROR_LOBE, Phong, largest_constant, pdf, sample
from albedo_lab.optics.frame import Direction, cosine_power, mirror_of
from albedo_lab.optics.maths import log, sincos2pi
from albedo_lab.optics.profiles import power_lobe
from albedo_lab.sources import neumann1999


def evaluate(p: Phong, wi: Direction, wo: Direction) -> float:
    return cosine_power(mirror_of(wo), wi, p.n) / max(wi.z, wo.z)  # eq. 10


def weight(p: Phong, wo: Direction, u1: float, u2: float) -> float:
    """f cos / pdf = 2 pi / (n+1) * wi.z / max(wi.z, wo.z): of the sample only its cosine is needed (eq. 25)."""
    s, c = power_lobe(log(u1), p.n)
    z = c * wo.z + s * sqrt(wo.x * wo.x + wo.y * wo.y) * sincos2pi(u2)[1]
    return 2.0 * pi / (p.n + 1.0) * z / max(z, wo.z) if z > 0.0 else 0.0


MODEL = Model(
    "stretched_phong",
    "c_n [(R.V)^+]^n / max(N.L, N.V)",
    Phong,
    (EXPONENT,),
    evaluate,
    sample=sample,
    pdf=pdf,
    weight=weight,
    scale=largest_constant,
    scale_symbol="c_n",
    paper_constant=largest_constant,
    smooth_in=KINKED_MIRROR_LOBE,
    source=neumann1999("eq. 7, 10"),
    claims=(
        Reciprocal("neumann1999 §2.2"),
        EnergyConserving("neumann1999 §2.2", where="n >= 1"),
        GrazingAlbedo("neumann1999 eq. 26", value=lambda p: (p.n + 2.0) / (2.0 * (p.n + 1.0))),
    ),
)
