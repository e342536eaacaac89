"""Charlie: sheen of cloth, from microfacets whose normals are the likelier the flatter they lie.

Smith's Lambda of these normals grows like 1 / cos towards grazing; the authors' fit ends at exp(17) to exp(21), and so the albedo
goes like 1 / cos there, above 1 from cosines of about 1e-6 down. The fit is that of G1 within 0.05 for r from 0.1 to 1, and too
bright for less: by 0.63 for r = 0.001 (tests/models/test_charlie.py).
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from math import pi
from typing import NamedTuple

from albedo_lab.model import Choice, Claim, Model, Parameter, Reciprocal, Reference
from albedo_lab.optics.coordinates import Axis, Coordinates
from albedo_lab.optics.frame import Direction, bisector
from albedo_lab.optics.maths import exp, expm1, log1p, pow, sincos2pi
from albedo_lab.optics.profiles import TANGENT
from albedo_lab.sources import estevez2017, neubelt2013


class Charlie(NamedTuple):
    r: float


def D(p: Charlie, v: Direction) -> float:
    """(2 + 1/r) sin^(1/r) / (2 pi): it integrates to 1 over the projected hemisphere, and is 0 for the normal of the surface."""
    cot2 = v.z * v.z / max(v.x * v.x + v.y * v.y, 1e-300)
    return (2.0 + 1.0 / p.r) / (2.0 * pi) * exp(-0.5 / p.r * log1p(cot2))  # eq. 2


SMOOTHEST = (25.3245, 3.32435, 0.16801, -1.27393, -4.85967)
ROUGHEST = (21.5473, 3.82987, 0.19823, -1.97760, -4.32054)
"""a to e of the fit below for r = 0 and for r = 1 (table 1)."""


def L(p: Charlie, x: float) -> float:
    """a / (1 + b x^c) + d x + e, the coefficients weighted by (1 - r)^2 and what is left."""
    w = (1.0 - p.r) * (1.0 - p.r)
    a, b, c, d, e = SMOOTHEST
    a1, b1, c1, d1, e1 = ROUGHEST
    a, b, c = w * a + (1.0 - w) * a1, w * b + (1.0 - w) * b1, w * c + (1.0 - w) * c1
    d, e = w * d + (1.0 - w) * d1, w * e + (1.0 - w) * e1
    return a / (1.0 + b * pow(x, c)) + d * x + e  # eq. 3


def log_lambda(p: Charlie, w: Direction) -> float:
    """The logarithm of Lambda as it is fitted: over the cosine from 0 to 1/2, and from there on its image in that point."""
    return L(p, w.z) if w.z < 0.5 else 2.0 * L(p, 0.5) - L(p, max(1.0 - w.z, 0.0))


def softened(p: Charlie, wi: Direction, wo: Direction) -> float:
    """Smith's masking, Lambda of the light to the power 1 + 2 (1 - cos)^8."""
    grazing = (1.0 - wi.z) * (1.0 - wi.z)
    grazing *= grazing
    light = exp(log_lambda(p, wi) * (1.0 + 2.0 * grazing * grazing))  # eq. 4
    return 1.0 / ((1.0 + light + exp(log_lambda(p, wo))) * 4.0 * wi.z * wo.z)


def smith(p: Charlie, wi: Direction, wo: Direction) -> float:
    return 1.0 / ((1.0 + exp(log_lambda(p, wi)) + exp(log_lambda(p, wo))) * 4.0 * wi.z * wo.z)


def neubelt(p: Charlie, wi: Direction, wo: Direction) -> float:
    return 1.0 / (4.0 * (wi.z + wo.z - wi.z * wo.z))


# Flat-lying normals come from light that grazes: for most viewers from cosines of the order of sqrt(r)


def knee(p: Charlie) -> float:
    return pow(p.r, 0.5)


def sample(p: Charlie, wo: Direction, u1: float, u2: float) -> Direction:
    """A cosine z with density 1 / (z + knee), normalised, at any azimuth."""
    k = knee(p)
    z = k * expm1(u1 * log1p(1.0 / k))
    s, (sp, cp) = pow(max((1.0 - z) * (1.0 + z), 0.0), 0.5), sincos2pi(u2)
    return Direction(s * cp, s * sp, z)


def pdf(p: Charlie, wi: Direction, wo: Direction) -> float:
    k = knee(p)
    return 1.0 / (2.0 * pi * (wi.z + k) * log1p(1.0 / k))


ESTEVEZ = estevez2017("eq. 1 to 4, table 1")
VISIBILITIES: dict[str, tuple[Callable[..., float], str, Reference, tuple[Reference, ...], tuple[Claim, ...]]] = {
    "softened": (softened, "1 / (1 + Lambda'(N.L) + Lambda(N.V)) / (4 N.L N.V)", ESTEVEZ, (), ()),
    "smith": (
        smith,
        "1 / (1 + Lambda(N.L) + Lambda(N.V)) / (4 N.L N.V)",
        estevez2017("eq. 1 to 3, table 1", "without the softening of eq. 4, as glTF's KHR_materials_sheen has it"),
        (),
        (Reciprocal("Estevez and Kulla 2017 section 1: the usual microfacet equation"),),
    ),
    "neubelt": (
        neubelt,
        "1 / (4 (N.L + N.V - N.L N.V))",
        estevez2017("eq. 2", "its masking replaced by another, as Filament and glTF's viewer do"),
        (neubelt2013("cloth"),),
        (),
    ),
}
CHOICES = (
    Choice(
        "visibility",
        "G / (4 N.L N.V): the authors' fit, softened towards the terminator or not, or the one of Neubelt and Pettineo",
        tuple(VISIBILITIES),
        "softened",
    ),
)


@cache
def make(*, visibility: str) -> Model:
    """The sheen with one visibility."""
    V, formula, source, also, claims = VISIBILITIES[visibility]

    def evaluate(p: Charlie, wi: Direction, wo: Direction) -> float:
        return D(p, bisector(wi, wo)) * V(p, wi, wo)  # eq. 1, F = 1

    return Model(
        "charlie",
        f"(2 + 1/r) sin^(1/r) delta / (2 pi) {formula}",
        Charlie,
        (Parameter("r", "roughness: how far the normals rise", default=0.3, low=1e-3, high=1.0, scale="log"),),
        evaluate,
        sample=sample,
        pdf=pdf,
        scale=lambda p: 1.0,
        smooth_in=Coordinates(Axis.HALF, TANGENT),
        reciprocal=visibility != "softened",
        source=source,
        also=also,
        claims=claims,
        choices=CHOICES,
        make=make,
        chosen={"visibility": visibility},
    )


MODEL = make(visibility="softened")
