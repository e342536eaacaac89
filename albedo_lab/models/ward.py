"""Ward: a Gaussian of the half-vector's slopes over the geometric mean of both cosines; it diverges at grazing angles."""

from __future__ import annotations

from math import nan, pi, sqrt
from typing import NamedTuple

from albedo_lab.model import DivergesAtGrazing, EnergyConserving, Model, Parameter, Reciprocal
from albedo_lab.optics.coordinates import Axis, Coordinates
from albedo_lab.optics.frame import Direction, bisector, reflect
from albedo_lab.optics.maths import exp, log, sincos2pi
from albedo_lab.optics.profiles import GAUSS, normal_from_slopes
from albedo_lab.sources import losasso, neumann1999, schlick1993


class Ward(NamedTuple):
    m_x: float
    m_y: float


def gaussian(p: Ward, v: Direction) -> float:
    """exp(-tan^2 delta (cos^2 phi / m_x^2 + sin^2 phi / m_y^2)) / (4 pi m_x m_y), from the slopes v.x/v.z and v.y/v.z."""
    x, y = v.x / (p.m_x * v.z), v.y / (p.m_y * v.z)
    return exp(-x * x - y * y) / (4.0 * pi * p.m_x * p.m_y)


def evaluate(p: Ward, wi: Direction, wo: Direction) -> float:
    return gaussian(p, bisector(wi, wo)) / sqrt(wi.z * wo.z)  # eq. 34


def sample_normal(p: Ward, u1: float, u2: float) -> Direction:
    """A microfacet normal with Gaussian slopes."""
    radius, (sp, cp) = sqrt(-log(u1)), sincos2pi(u2)
    return normal_from_slopes(p.m_x * radius * cp, p.m_y * radius * sp)


def sample(p: Ward, wo: Direction, u1: float, u2: float) -> Direction:
    return reflect(wo, sample_normal(p, u1, u2))


def pdf(p: Ward, wi: Direction, wo: Direction) -> float:
    # normals: exp(..) / (pi m_x m_y cos^3), cos = v.z / |v|; reflection: 4 (wo.h) = 2 |v|
    v = bisector(wi, wo)
    vv = v.x * v.x + v.y * v.y + v.z * v.z
    return gaussian(p, v) * 2.0 * vv / (v.z * v.z * v.z)


def weight(p: Ward, wo: Direction, u1: float, u2: float) -> float:
    """f cos / pdf = (wo.h) cos^3 sqrt(wi.z / wo.z), the exponential and the widths cancelled."""
    h = sample_normal(p, u1, u2)
    d = h.x * wo.x + h.y * wo.y + h.z * wo.z
    z = 2.0 * d * h.z - wo.z
    return d * h.z * h.z * h.z * sqrt(z / wo.z) if z > 0.0 else 0.0


def widths(p: Ward) -> tuple[float, float]:
    return p.m_x, p.m_y


WIDTHS = (
    Parameter("m", "RMS slope, the same in x and y", default=0.1, low=1e-4, high=1.0, scale="log", sets=("m_x", "m_y")),
    Parameter("m_x", "RMS slope along x", default=0.1, low=1e-4, high=1.0, scale="log"),
    Parameter("m_y", "RMS slope along y", default=0.1, low=1e-4, high=1.0, scale="log"),
)

MODEL = Model(
    "ward",
    "C_max / (4 pi m^2) exp(-tan^2 delta / m^2) / sqrt(N.L N.V)",
    Ward,
    WIDTHS,
    evaluate,
    sample=sample,
    pdf=pdf,
    weight=weight,
    scale=lambda p: 1.0,
    scale_symbol="C_max",
    paper_constant=lambda p: 1.0 if max(p.m_x, p.m_y) < 0.2 else nan,
    smooth_in=Coordinates(Axis.HALF, GAUSS, ellipse=widths),
    isotropic=lambda p: p.m_x == p.m_y,
    source=neumann1999("eq. 34"),
    also=(schlick1993("eq. 8, specular part"), losasso("Ward's Anisotropic Lighting Model")),
    claims=(
        Reciprocal("schlick1993 section 4"),
        EnergyConserving("neumann1999 §6.2, citing Ward", where="m < 0.2"),
        DivergesAtGrazing("neumann1999 §6.2"),
    ),
)
