"""Kelemen: facets that do not hide each other, and a matte part made of what they do not reflect, both ways."""

from __future__ import annotations

from collections.abc import Mapping
from math import log1p, pi, sqrt
from typing import Any, NamedTuple

from albedo_lab.model import EnergyConserving, Model, Parameter, Reciprocal
from albedo_lab.models.ward import Ward
from albedo_lab.models.ward import pdf as facets_pdf
from albedo_lab.models.ward import sample as sample_facets
from albedo_lab.models.ward_bounded import evaluate as facets
from albedo_lab.optics.coordinates import Axis, Coordinates
from albedo_lab.optics.frame import Direction, bisector, length
from albedo_lab.optics.fresnel import schlick
from albedo_lab.optics.lobes import sample_cosine
from albedo_lab.optics.maths import expm1, sincos2pi
from albedo_lab.optics.profiles import GAUSS, TANGENT
from albedo_lab.optics.specular_loss import loss_at, specular_loss
from albedo_lab.sources import geisler2010, kelemen2001
from albedo_lab.tables import Table


class Kelemen(NamedTuple):
    m: float
    F0: float
    r_m: float
    mean: float
    """Mean over cosines of 1 - a, a the specular albedo."""
    grazing: float
    """The share of this that F = 1 has, weighted with F0; and the constant of sample_grazing."""
    span: float
    first: float
    """The table of 1 - a, see optics.specular_loss."""
    per: float
    lost: Table


def specular(p: Kelemen, wi: Direction, wo: Direction) -> float:
    # P_H F / (4 (L.H)^2), which stands for Cook and Torrance's P_H F G / (4 N.L N.V)
    return facets(Ward(p.m, p.m), wi, wo) * schlick(p.F0, 0.5 * length(bisector(wi, wo)))


def missing(p: Kelemen, mu: float) -> float:
    """1 - a(mu)."""
    return loss_at(p.lost, p.first, p.per, mu)


def matte(p: Kelemen, wi: Direction, wo: Direction) -> float:
    return p.r_m * missing(p, wi.z) * missing(p, wo.z) / (pi * p.mean)


def evaluate(p: Kelemen, wi: Direction, wo: Direction) -> float:
    return specular(p, wi, wo) + matte(p, wi, wo)


def to_matte(p: Kelemen, mu: float) -> float:
    """The share of samples that follow the matte part: its albedo, of that and the specular one."""
    lost = missing(p, mu)
    of_matte = p.r_m * lost
    return of_matte / (of_matte + max(1.0 - lost, 1e-300))


def sample_grazing(p: Kelemen, u1: float, u2: float) -> Direction:
    """A direction with density cos / (pi (cos^2 + m^2) span): what white facets lose goes like this where cos >> m."""
    zz = p.m * p.m * expm1(u1 * p.span)
    s, (sp, cp) = sqrt(max(1.0 - zz, 0.0)), sincos2pi(u2)
    return Direction(s * cp, s * sp, sqrt(zz))


def sample(p: Kelemen, wo: Direction, u1: float, u2: float) -> Direction:
    share = to_matte(p, wo.z)
    if u1 >= share:
        return sample_facets(Ward(p.m, p.m), wo, (1.0 - u1) / (1.0 - share), u2)
    u = u1 / share
    if u <= p.grazing:
        return sample_grazing(p, u / p.grazing, u2)
    return sample_cosine((u - p.grazing) / (1.0 - p.grazing), u2)


def pdf(p: Kelemen, wi: Direction, wo: Direction) -> float:
    share = to_matte(p, wo.z)
    of_matte = (1.0 - p.grazing + p.grazing / ((wi.z * wi.z + p.m * p.m) * p.span)) * wi.z / pi
    return share * of_matte + (1.0 - share) * facets_pdf(Ward(p.m, p.m), wi, wo)


def complete(numbers: Mapping[str, float]) -> Kelemen:
    """With the table of the specular albedo."""
    loss = specular_loss(numbers["m"], numbers["F0"])
    return Kelemen(
        **numbers,
        mean=loss.mean,
        grazing=loss.white,
        span=log1p(1.0 / numbers["m"] ** 2),
        first=loss.first,
        per=loss.per,
        lost=loss.values,
    )


def widths(p: Kelemen) -> tuple[float, float]:
    return p.m, p.m


SOURCE = kelemen2001(
    "the specular part with Ward's P_H and Schlick's F, and the matte part",
    "the specular albedo is computed to 1e-10 and read from 4096 steps of log(N.L), not from a coarse table",
)
ABOUT_HALF = Coordinates(Axis.HALF, GAUSS, ellipse=widths)
ABOUT_NORMAL = Coordinates(Axis.NORMAL, TANGENT)
TERMS = (
    Model("kelemen", "specular part", Kelemen, (), specular, SOURCE, smooth_in=ABOUT_HALF),
    Model("kelemen", "matte part", Kelemen, (), matte, SOURCE, smooth_in=ABOUT_NORMAL),
)


def parts(p: Kelemen) -> tuple[tuple[Model, Any], ...]:
    return tuple((term, p) for term in TERMS)


MODEL = Model(
    "kelemen",
    "exp(-tan^2 delta / m^2) / (pi m^2 cos^4 delta) F(F0, L.H) / (4 (L.H)^2)"
    " + r_m (1 - a(N.L)) (1 - a(N.V)) / (pi (1 - a_mean)), a the albedo of the first term",
    Kelemen,
    (
        Parameter("m", "RMS slope", default=0.2, low=1e-4, high=1.0, scale="log"),
        Parameter("F0", "reflectance of the facets at normal incidence", default=0.04, low=0.0, high=1.0),
        Parameter("r_m", "reflectance of the matte part: the share of the light left to it that comes back", 0.5, 0.0, 1.0),
    ),
    evaluate,
    sample=sample,
    pdf=pdf,
    scale=lambda p: 1.0,
    complete=complete,
    smooth_in=ABOUT_HALF,
    parts=parts,
    source=SOURCE,
    also=(geisler2010("the same specular part, for F = 1"),),
    claims=(Reciprocal("Kelemen and Szirmay-Kalos 2001, abstract"), EnergyConserving("Kelemen and Szirmay-Kalos 2001, abstract")),
)
