"""Plus-Blinn: Blinn's cosine power over the mean of both cosines."""

from __future__ import annotations

from albedo_lab.model import MAXIMUM, Model, Reciprocal
from albedo_lab.models.blinn import EXPONENT, Blinn, exponent, pdf, sample
from albedo_lab.optics.coordinates import Axis, Coordinates
from albedo_lab.optics.frame import Direction, bisector, normal_power
from albedo_lab.optics.profiles import POWER
from albedo_lab.sources import neumann1999


def evaluate(p: Blinn, wi: Direction, wo: Direction) -> float:
    return normal_power(bisector(wi, wo), p.n) * 2.0 / (wi.z + wo.z)


MODEL = Model(
    "plus_blinn",
    "C_n (N.H)^n 2 / (N.L + N.V)",
    Blinn,
    (EXPONENT,),
    evaluate,
    sample=sample,
    pdf=pdf,
    scale=MAXIMUM,
    scale_symbol="C_n",
    smooth_in=Coordinates(Axis.HALF, POWER, exponent),
    source=neumann1999("section 2.2, figures 1 and 2", "the paper prints no constant; the largest is taken, as for Blinn"),
    claims=(Reciprocal("neumann1999 §2.2"),),
)
