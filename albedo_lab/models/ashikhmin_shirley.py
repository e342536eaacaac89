"""Ashikhmin-Shirley: half-vectors of two exponents over the larger cosine, above a diffuse part that leaves them their light.

The diffuse albedo is R_d (1 - R_s) (1 - (1 - wo.z / 2)^5) exactly: 2 times the integral of mu (1 - (1 - mu/2)^5) is 23/28.
A half-vector makes wo.h >= wo.z / 2 with both directions, since (wo.h)^2 >= (1 - sin theta_o) / 2, and a specular sample weighs
F wi.z / max(wi.z, wo.z). So the specular albedo is at most R_s + (1 - R_s) (1 - wo.z / 2)^5, and the sum at most 1.
"""

from __future__ import annotations

from math import pi, sqrt
from typing import Any, NamedTuple

from albedo_lab.model import EnergyConserving, Model, Parameter, Reciprocal
from albedo_lab.optics.coordinates import Axis, Coordinates, Kink
from albedo_lab.optics.frame import Direction, bisector, length, reflect
from albedo_lab.optics.fresnel import schlick
from albedo_lab.optics.lobes import sample_cosine
from albedo_lab.optics.maths import exp, log, log1p, sincos2pi
from albedo_lab.optics.profiles import POWER, TANGENT, power_lobe
from albedo_lab.sources import ashikhmin2000


class AshikhminShirley(NamedTuple):
    n_u: float
    n_v: float
    R_s: float
    R_d: float


def lobe(p: AshikhminShirley, v: Direction) -> float:
    """sqrt((n_u+1) (n_v+1)) / (2 pi) (N.H)^((n_u (H.U)^2 + n_v (H.V)^2) / (1 - (N.H)^2)): the density of half-vectors."""
    x, y = v.x / v.z, v.y / v.z
    xx, yy = x * x, y * y
    slope = max(xx + yy, 1e-300)
    power = exp(-0.5 * (p.n_u * xx + p.n_v * yy) * (log1p(slope) / slope))
    return sqrt((p.n_u + 1.0) * (p.n_v + 1.0)) / (2.0 * pi) * power


def specular(p: AshikhminShirley, wi: Direction, wo: Direction) -> float:
    v = bisector(wi, wo)
    u = 0.5 * length(v)
    return lobe(p, v) / (4.0 * u * max(wi.z, wo.z)) * schlick(p.R_s, u)


def lit(c: float) -> float:
    """1 - (1 - c/2)^5, nothing cancelled."""
    x = 0.5 * c
    return x * (5.0 - x * (10.0 - x * (10.0 - x * (5.0 - x))))


def diffuse(p: AshikhminShirley, wi: Direction, wo: Direction) -> float:
    return 28.0 * p.R_d / (23.0 * pi) * (1.0 - p.R_s) * lit(wi.z) * lit(wo.z)


def evaluate(p: AshikhminShirley, wi: Direction, wo: Direction) -> float:
    return specular(p, wi, wo) + diffuse(p, wi, wo)


def to_lobe(p: AshikhminShirley, mu: float) -> float:
    """The share of samples that follow the lobe: its reflectance as a mirror, of that and the diffuse albedo."""
    of_lobe = schlick(p.R_s, mu)
    return of_lobe / max(of_lobe + p.R_d * (1.0 - p.R_s) * lit(mu), 1e-300)


def sample_half_vector(p: AshikhminShirley, u1: float, u2: float) -> Direction:
    """The azimuth's tangent is sqrt((n_u+1) / (n_v+1)) tan(2 pi u2); along it, u1 is the cosine's power."""
    s, c = sincos2pi(u2)
    y, x = s * sqrt(p.n_u + 1.0), c * sqrt(p.n_v + 1.0)
    unit = 1.0 / sqrt(x * x + y * y)
    x, y = x * unit, y * unit
    sine, cosine = power_lobe(log(u1), p.n_u * x * x + p.n_v * y * y)
    return Direction(sine * x, sine * y, cosine)


def sample(p: AshikhminShirley, wo: Direction, u1: float, u2: float) -> Direction:
    share = to_lobe(p, wo.z)
    if u1 < share:
        return reflect(wo, sample_half_vector(p, u1 / share, u2))
    return sample_cosine((1.0 - u1) / (1.0 - share), u2)


def pdf(p: AshikhminShirley, wi: Direction, wo: Direction) -> float:
    share, v = to_lobe(p, wo.z), bisector(wi, wo)
    return share * lobe(p, v) / (2.0 * length(v)) + (1.0 - share) * wi.z / pi


def smaller(p: AshikhminShirley) -> float:
    """The exponent of the wide axis, along which the coordinates turn about the lobe; the other one is an ellipse's."""
    return min(p.n_u, p.n_v)


def widths(p: AshikhminShirley) -> tuple[float, float]:
    wide = smaller(p) + 1.0
    return sqrt(wide / (p.n_u + 1.0)), sqrt(wide / (p.n_v + 1.0))


SOURCE = ashikhmin2000("the specular part, the diffuse part and their sampling")
ABOUT_HALF = Coordinates(Axis.HALF, POWER, exponent=smaller, ellipse=widths, kink=Kink.EQUAL_COSINES)
ABOUT_NORMAL = Coordinates(Axis.NORMAL, TANGENT)
TERMS = (
    Model("ashikhmin_shirley", "specular part", AshikhminShirley, (), specular, SOURCE, smooth_in=ABOUT_HALF),
    Model("ashikhmin_shirley", "diffuse part", AshikhminShirley, (), diffuse, SOURCE, smooth_in=ABOUT_NORMAL),
)


def parts(p: AshikhminShirley) -> tuple[tuple[Model, Any], ...]:
    return tuple((term, p) for term in TERMS)


MODEL = Model(
    "ashikhmin_shirley",
    "sqrt((n_u+1) (n_v+1)) / (8 pi) (N.H)^((n_u (H.U)^2 + n_v (H.V)^2) / (1 - (N.H)^2)) F(R_s, L.H) / (L.H max(N.L, N.V))"
    " + 28 R_d / (23 pi) (1 - R_s) (1 - (1 - N.L/2)^5) (1 - (1 - N.V/2)^5)",
    AshikhminShirley,
    (
        Parameter("n", "exponent, the same in x and y", default=100.0, low=0.0, high=1e8, scale="log", sets=("n_u", "n_v")),
        Parameter("n_u", "exponent along x", default=100.0, low=0.0, high=1e8, scale="log"),
        Parameter("n_v", "exponent along y", default=100.0, low=0.0, high=1e8, scale="log"),
        Parameter("R_s", "specular reflectance at normal incidence", default=0.05, low=0.0, high=1.0),
        Parameter("R_d", "reflectance of what lies below", default=0.5, low=0.0, high=1.0),
    ),
    evaluate,
    sample=sample,
    pdf=pdf,
    scale=lambda p: 1.0,
    smooth_in=ABOUT_HALF,
    parts=parts,
    isotropic=lambda p: p.n_u == p.n_v,
    source=SOURCE,
    claims=(Reciprocal("Ashikhmin and Shirley 2000, abstract"), EnergyConserving("Ashikhmin and Shirley 2000, abstract")),
)
