"""Lommel-Seeliger: light that a dusty half-space scatters once, alike in all directions."""

from __future__ import annotations

from math import pi
from typing import NamedTuple

from albedo_lab.model import GrazingAlbedo, Model, Parameter
from albedo_lab.optics.coordinates import PLAIN
from albedo_lab.optics.frame import Direction
from albedo_lab.optics.lobes import limb_pdf, sample_limb
from albedo_lab.sources import fairbairn2005, lommel1889


class LommelSeeliger(NamedTuple):
    w: float


def evaluate(p: LommelSeeliger, wi: Direction, wo: Direction) -> float:
    return p.w / (4.0 * pi) / (wi.z + wo.z)


def sample(p: LommelSeeliger, wo: Direction, u1: float, u2: float) -> Direction:
    return sample_limb(wo.z, u1, u2)


def pdf(p: LommelSeeliger, wi: Direction, wo: Direction) -> float:
    return limb_pdf(wo.z, wi)


def weight(p: LommelSeeliger, wo: Direction, u1: float, u2: float) -> float:
    z = sample_limb(wo.z, u1, u2).z
    return 0.5 * p.w * (z + wo.z) / ((1.0 + wo.z) * (z + 2.0 * wo.z))


MODEL = Model(
    "lommel_seeliger",
    "w / (4 pi) / (N.L + N.V)",
    LommelSeeliger,
    (Parameter("w", "single-scattering albedo", default=1.0, low=0.0, high=1.0),),
    evaluate,
    sample=sample,
    pdf=pdf,
    weight=weight,
    scale=lambda p: 1.0,
    smooth_in=PLAIN,  # near grazing, 1 / (N.L + N.V) turns over where the cosines are equal
    source=lommel1889("the law that bears his name and Seeliger's", "as a BRDF: the radiance over that of the irradiance N.L"),
    also=(fairbairn2005("the law in today's notation"),),
    claims=(GrazingAlbedo("textbooks: the albedo is w / 2 (1 - mu log(1 + 1 / mu))", value=lambda p: 0.5 * p.w),),
)
