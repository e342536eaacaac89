"""Schlick's isotropic model as neumann1999 gives it: a rational zenith factor and a rational shadowing factor."""

from __future__ import annotations

from math import nan, pi, sqrt
from typing import NamedTuple

from albedo_lab.model import MAXIMUM, EnergyConserving, Model, Parameter, Reciprocal
from albedo_lab.optics.coordinates import Axis, Coordinates
from albedo_lab.optics.frame import Direction, bisector, reflect
from albedo_lab.optics.maths import sincos2pi
from albedo_lab.optics.profiles import TANGENT, normal_from_slopes
from albedo_lab.optics.schlick1993 import Z
from albedo_lab.sources import neumann1999, schlick1993


class Schlick(NamedTuple):
    r: float


def evaluate(p: Schlick, wi: Direction, wo: Direction) -> float:
    shadowing = (p.r + (1.0 - p.r) * wi.z) * (p.r + (1.0 - p.r) * wo.z)
    return Z(p.r, bisector(wi, wo)) / (4.0 * pi * shadowing)  # eq. 36


def sample(p: Schlick, wo: Direction, u1: float, u2: float) -> Direction:
    # Z is normalised: the integral of 2 t Z dt over [0, 1] is 1, and its survival is r / (r + tan^2)
    slope, (sp, cp) = sqrt(p.r * (1.0 - u1) / u1), sincos2pi(u2)
    return reflect(wo, normal_from_slopes(slope * cp, slope * sp))


def pdf(p: Schlick, wi: Direction, wo: Direction) -> float:
    # normals: Z t / pi; reflection: 4 (wo.h) = 2 |v|, and t / |v| = v.z / |v|^2
    v = bisector(wi, wo)
    return Z(p.r, v) * v.z / (2.0 * pi * (v.x * v.x + v.y * v.y + v.z * v.z))


def widths(p: Schlick) -> tuple[float, float]:
    return sqrt(p.r), sqrt(p.r)


AFTER_EQUATION_36 = {0.5: 2.14, 0.1: 0.72, 0.01: 0.21, 0.001: 0.042}

MODEL = Model(
    "schlick_isotropic",
    "C_max / (4 pi) r / (1 - (1-r) (N.H)^2)^2 / ((r + (1-r) N.L) (r + (1-r) N.V))",
    Schlick,
    (Parameter("r", "roughness factor: 0 specular, 1 diffuse", default=0.1, low=1e-6, high=1.0, scale="log"),),
    evaluate,
    sample=sample,
    pdf=pdf,
    scale=MAXIMUM,
    scale_symbol="C_max",
    paper_constant=lambda p: AFTER_EQUATION_36.get(p.r, nan),
    smooth_in=Coordinates(Axis.HALF, TANGENT, ellipse=widths),
    source=neumann1999("eq. 36"),
    also=(schlick1993("eq. 14, 15, 16 with A = 1"),),
    claims=(Reciprocal("schlick1993 section 5.4"), EnergyConserving("neumann1999 after eq. 36")),
)
