"""Ward: a Gaussian of the half-vector's slopes over the geometric mean of both cosines; it diverges at grazing angles."""

from __future__ import annotations

from functools import cache
from math import nan, pi, sqrt
from typing import NamedTuple

from albedo_lab.model import Choice, DivergesAtGrazing, EnergyConserving, Model, Parameter, Reciprocal
from albedo_lab.optics.coordinates import Axis, Coordinates
from albedo_lab.optics.frame import Direction, bisector, dot, length, reflect
from albedo_lab.optics.maths import exp, log, sincos2pi
from albedo_lab.optics.profiles import GAUSS, TANGENT, normal_from_slopes
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


# The half-vector form: a Gaussian of the chord 2 sin(delta/2), which is tan delta for a small angle and ends at sqrt(2)


def chord_gaussian(p: Ward, v: Direction) -> float:
    """exp(-2 ((H.X / m_x)^2 + (H.Y / m_y)^2) / (1 + H.N)) / (4 pi m_x m_y), H = v/|v|."""
    x, y, norm = v.x / p.m_x, v.y / p.m_y, length(v)
    return exp(-2.0 * (x * x + y * y) / (norm * (norm + v.z))) / (4.0 * pi * p.m_x * p.m_y)


def evaluate_by_chord(p: Ward, wi: Direction, wo: Direction) -> float:
    return chord_gaussian(p, bisector(wi, wo)) / sqrt(wi.z * wo.z)


def evaluate_by_chord_as_printed(p: Ward, wi: Direction, wo: Direction) -> float:
    return pi * evaluate_by_chord(p, wi, wo)


def sample_chord_normal(p: Ward, u1: float, u2: float) -> Direction:
    """A microfacet normal with density exp(..) / (pi m_x m_y) per solid angle; below the horizon from the chord sqrt(2) on.

    A chord and an azimuth map the sphere to a disk of equal areas, so the chord is Gaussian like the slopes above. What is drawn
    longer than a diameter points down, and is no normal any more.
    """
    radius, (sp, cp) = sqrt(-log(u1)), sincos2pi(u2)
    x, y = p.m_x * radius * cp, p.m_y * radius * sp
    half = 0.5 * (x * x + y * y)
    k = sqrt(max(1.0 - 0.5 * half, 0.0))
    return Direction(x * k, y * k, 1.0 - half)


def sample_by_chord(p: Ward, wo: Direction, u1: float, u2: float) -> Direction:
    h = sample_chord_normal(p, u1, u2)
    return reflect(wo, h) if h.z > 0.0 else Direction(0.0, 0.0, -1.0)


def pdf_by_chord(p: Ward, wi: Direction, wo: Direction) -> float:
    # normals: 4 times the Gaussian; reflection: 4 (wo.h) = 2 |v|
    v = bisector(wi, wo)
    return 2.0 * chord_gaussian(p, v) / length(v)


def weight_by_chord(p: Ward, wo: Direction, u1: float, u2: float) -> float:
    """f cos / pdf = (wo.h) sqrt(wi.z / wo.z)."""
    h = sample_chord_normal(p, u1, u2)
    d = dot(h, wo)
    z = 2.0 * d * h.z - wo.z
    return d * sqrt(z / wo.z) if z > 0.0 and h.z > 0.0 else 0.0


def weight_by_chord_as_printed(p: Ward, wo: Direction, u1: float, u2: float) -> float:
    return pi * weight_by_chord(p, wo, u1, u2)


# The family


def widths(p: Ward) -> tuple[float, float]:
    return p.m_x, p.m_y


WIDTHS = (
    Parameter("m", "RMS slope, the same in x and y", default=0.1, low=1e-4, high=1.0, scale="log", sets=("m_x", "m_y")),
    Parameter("m_x", "RMS slope along x", default=0.1, low=1e-4, high=1.0, scale="log"),
    Parameter("m_y", "RMS slope along y", default=0.1, low=1e-4, high=1.0, scale="log"),
)

CHOICES = (
    Choice(
        "form",
        "the Gaussian's variable: tan delta (neumann1999 eq. 34), or 2 sin(delta/2), from the half-vector alone (losasso)",
        ("tangent", "half_vector"),
        "tangent",
    ),
    Choice(
        "as_printed",
        "yes: without the pi that losasso's half-vector form lacks; the tangent form is printed right",
        ("no", "yes"),
        "no",
    ),
)

NO_PI = "the pi in 4 pi m_x m_y is missing in print"


@cache
def make(*, form: str, as_printed: str) -> Model:
    """The member of the family that the words select."""
    chosen = {"form": form, "as_printed": as_printed}
    if form == "tangent":
        return Model(
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
            also=(schlick1993("eq. 8, specular part"),),
            claims=(
                Reciprocal("schlick1993 section 4"),
                EnergyConserving("neumann1999 §6.2, citing Ward", where="m < 0.2"),
                DivergesAtGrazing("neumann1999 §6.2"),
            ),
            choices=CHOICES,
            make=make,
            chosen=chosen,
        )
    printed = as_printed == "yes"
    return Model(
        "ward",
        f"1 / (4 {'' if printed else 'pi '}m^2) exp(-(2 sin(delta/2) / m)^2) / sqrt(N.L N.V)",
        Ward,
        WIDTHS,
        evaluate_by_chord_as_printed if printed else evaluate_by_chord,
        sample=sample_by_chord,
        pdf=pdf_by_chord,
        weight=weight_by_chord_as_printed if printed else weight_by_chord,
        scale=lambda p: 1.0,
        smooth_in=Coordinates(Axis.HALF, TANGENT, ellipse=widths),  # not GAUSS: for m = 1, exp(-2) is left at the horizon
        isotropic=lambda p: p.m_x == p.m_y,
        source=losasso("Ward's Anisotropic Lighting Model", *(() if printed else (NO_PI,))),
        choices=CHOICES,
        make=make,
        chosen=chosen,
    )


MODEL = make(form="tangent", as_printed="no")
