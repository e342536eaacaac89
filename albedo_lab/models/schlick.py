"""Schlick's customizable model: one or two layers of rational factors, from mirror to diffuse, isotropic or brushed."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import cache
from math import pi
from typing import Any, NamedTuple

from albedo_lab.model import Choice, EnergyConserving, Model, Parameter, Reciprocal
from albedo_lab.optics import fresnel
from albedo_lab.optics.coordinates import Axis, Coordinates
from albedo_lab.optics.frame import Direction, bisector, length, reflect
from albedo_lab.optics.profiles import TANGENT
from albedo_lab.optics.schlick1993 import (
    A,
    G,
    Z,
    azimuth_density,
    mean_of_A,
    normal_of_slope,
    obstructed,
    slope_of_hemisphere,
    slope_of_lobe,
)
from albedo_lab.sources import schlick1993


class Single(NamedTuple):
    C: float
    r: float
    p: float
    a: float
    """What A is multiplied by: 1 as printed, else one over its mean."""


class Double(NamedTuple):
    C: float
    r: float
    p: float
    a: float
    C_2: float
    r_2: float
    p_2: float
    a_2: float


def itself(p: Single) -> Single:
    return p


def upper(p: Double) -> Single:
    return Single(p.C, p.r, p.p, p.a)


def lower(p: Double) -> Single:
    return Single(p.C_2, p.r_2, p.p_2, p.a_2)


# The spectral factor S(u)


def constant(C: float, u: float) -> float:
    return C  # eq. 10


SPECTRAL = {"constant": constant, "fresnel": fresnel.schlick}  # eq. 10, 11


# The directional factor D: its weights of the lobe Z A / (4 pi v v') and of the diffuse term A / pi


def one(r: float, v: float, v_: float) -> float:
    return 1.0


def none(r: float, v: float, v_: float) -> float:
    return 0.0


def smooth(r: float, v: float, v_: float) -> float:
    return 1.0 - r


def rough(r: float, v: float, v_: float) -> float:
    return r


def unobstructed(r: float, v: float, v_: float) -> float:
    return G(r, v) * G(r, v_)


DIRECTIONAL = {
    "eq12": (one, none),
    "eq15": (unobstructed, none),
    "eq17": (smooth, rough),
    "eq18": (unobstructed, obstructed),
}


# The share of the samples that follow the lobe, where v is the cosine of the direction that does not move. The diffuse term of
# eq. 17 needs no others: r A / pi is at most 8 times their density, since Z is nowhere below r


def all_to_lobe(r: float, v: float) -> float:
    return 1.0


def unobstructed_to_lobe(r: float, v: float) -> float:
    # the others, r / (r - r v + v), are few only where the diffuse term of eq. 18 is small
    return (1.0 - r) * G(r, v)


TO_LOBE = {"eq12": all_to_lobe, "eq15": all_to_lobe, "eq17": all_to_lobe, "eq18": unobstructed_to_lobe}


# Coordinates: in azimuth both terms have the ellipse that A is sampled by


def lobe_widths(p: Single) -> tuple[float, float]:
    s, k = p.r**0.5, p.p**0.25
    return s * k, s / k


def diffuse_widths(p: Single) -> tuple[float, float]:
    k = p.p**0.25
    return k, 1.0 / k


# The family


def layer(suffix: str, of: str, C: float) -> tuple[Parameter, ...]:
    """The parameters of section 5.1."""
    return (
        Parameter(f"C{suffix}", f"reflection factor{of}: reflectance at normal incidence", default=C, low=0.0, high=1.0),
        Parameter(f"r{suffix}", f"roughness factor{of}: 0 specular, 1 diffuse", default=0.1, low=1e-6, high=1.0, scale="log"),
        Parameter(
            f"p{suffix}", f"isotropy factor{of}: 0 brushed along x, 1 isotropic", default=1.0, low=1e-3, high=1.0, scale="log"
        ),
    )


PARAMETERS = {
    "single": layer("", "", C=1.0),
    "double": (*layer("", " of the upper layer", C=0.05), *layer("_2", " of the lower layer", C=1.0)),
}

CHOICES = (
    Choice("layers", "SINGLE: S D, or DOUBLE: S D + (1 - S) S' D', of eq. 9", ("single", "double"), "single"),
    Choice("spectral", "S(u): C (eq. 10), or C + (1 - C) (1 - u)^5 (eq. 11)", tuple(SPECTRAL), "constant"),
    Choice(
        "directional",
        "D: lobe alone (eq12), obstructed (eq15); with a diffuse term weighted by r (eq17), by the obstruction (eq18)",
        tuple(DIRECTIONAL),
        "eq15",
    ),
    Choice("as_printed", "A: yes, as eq. 14 prints it; no, over its mean, as energy balance asks", ("no", "yes"), "no"),
)

LAYERS = {"single": "S {}", "double": "S {0} + (1-S) S' {0}'"}
FORMULA = {
    "eq12": "Z A / (4 pi v v')",
    "eq15": "G G' Z A / (4 pi v v')",
    "eq17": "(r/pi + (1-r) Z / (4 pi v v')) A",
    "eq18": "((1 - G G')/pi + G G' Z / (4 pi v v')) A",
}

DEVIATIONS = (
    "A is divided by its mean over the azimuth, (2/pi) sqrt(p) K(1-p^2): as printed it meets the condition (13) for p = 1 only",
    "that condition is taken with sqrt(1-w^2) in the denominator: as a factor, as printed, A = 1 does not meet it either",
)

Evaluate = Callable[[Any, Direction, Direction], float]


@cache
def make(*, layers: str, spectral: str, directional: str, as_printed: str) -> Model:
    """The member of the family that the words select."""
    S = SPECTRAL[spectral]
    lobe_weight, diffuse_weight = DIRECTIONAL[directional]
    to_lobe = TO_LOBE[directional]
    parameters_type = Single if layers == "single" else Double
    formula = LAYERS[layers].format("D") + ", D = " + FORMULA[directional]
    equations = (
        "9",
        "10" if spectral == "constant" else "11",
        "14",
        directional[2:],
        *(("16",) if lobe_weight is unobstructed else ()),
    )
    source = schlick1993("eq. " + ", ".join(equations), *(DEVIATIONS if as_printed == "no" else ()))

    def u(wi: Direction, wo: Direction) -> float:
        return 0.5 * length(bisector(wi, wo))

    def lobe(p: Single, wi: Direction, wo: Direction) -> float:
        h = bisector(wi, wo)
        return lobe_weight(p.r, wo.z, wi.z) / (4.0 * pi * wo.z * wi.z) * Z(p.r, h) * p.a * A(p.p, h)

    def diffuse(p: Single, wi: Direction, wo: Direction) -> float:
        return diffuse_weight(p.r, wo.z, wi.z) / pi * p.a * A(p.p, bisector(wi, wo))

    def D(p: Single, wi: Direction, wo: Direction) -> float:
        return lobe(p, wi, wo) + diffuse(p, wi, wo)

    def S_single(p: Single, u: float) -> float:
        return S(p.C, u)

    def S_upper(p: Double, u: float) -> float:
        return S(p.C, u)

    def S_lower(p: Double, u: float) -> float:
        return (1.0 - S(p.C, u)) * S(p.C_2, u)

    def evaluate_single(p: Single, wi: Direction, wo: Direction) -> float:
        return S_single(p, u(wi, wo)) * D(p, wi, wo)  # eq. 9

    def evaluate_double(p: Double, wi: Direction, wo: Direction) -> float:
        return S_upper(p, u(wi, wo)) * D(upper(p), wi, wo) + S_lower(p, u(wi, wo)) * D(lower(p), wi, wo)  # eq. 9

    def sample_single(p: Single, wo: Direction, u1: float, u2: float) -> Direction:
        # normals for the diffuse term, too, since A makes it follow them: evenly spread ones. It is u2 that chooses: u1 tells how
        # far out a sample lies, and estimators rely on its order
        share = to_lobe(p.r, wo.z)
        slope = slope_of_lobe(p.r, u1) if u2 < share else slope_of_hemisphere(u1)
        return reflect(wo, normal_of_slope(slope, p.p, u2 / share if u2 < share else (u2 - share) / (1.0 - share)))

    def pdf_single(p: Single, wi: Direction, wo: Direction) -> float:
        # normals: 2 Z t of the lobe and 1 of the others, times the density of the azimuth; reflection: 4 u = 2 |h|
        h, share = bisector(wi, wo), to_lobe(p.r, wo.z)
        norm = length(h)
        return (share * 2.0 * Z(p.r, h) * h.z / norm + (1.0 - share)) * azimuth_density(p.p, h) / (2.0 * norm)

    def sample_double(p: Double, wo: Direction, u1: float, u2: float) -> Direction:
        over, under = upper(p), lower(p)
        return sample_single(over, wo, u1, 2.0 * u2) if u2 < 0.5 else sample_single(under, wo, u1, 2.0 * u2 - 1.0)

    def pdf_double(p: Double, wi: Direction, wo: Direction) -> float:
        return 0.5 * (pdf_single(upper(p), wi, wo) + pdf_single(lower(p), wi, wo))

    def complete(numbers: Mapping[str, float]) -> Any:
        norms = {f"a{name[1:]}": 1.0 / mean_of_A(value) for name, value in numbers.items() if name[0] == "p"}
        return parameters_type(**numbers, **(norms if as_printed == "no" else dict.fromkeys(norms, 1.0)))

    def term(S_layer: Callable[..., float], of: Callable[..., Single], shape: Evaluate, widths: Callable[..., Any]) -> Model:
        """One term of D of one layer, for quadrature."""

        def evaluate(p: Any, wi: Direction, wo: Direction) -> float:
            return S_layer(p, u(wi, wo)) * shape(of(p), wi, wo)

        def ellipse(p: Any) -> tuple[float, float]:
            w: tuple[float, float] = widths(of(p))
            return w

        return Model(
            "schlick", formula, parameters_type, (), evaluate, source, smooth_in=Coordinates(Axis.HALF, TANGENT, ellipse=ellipse)
        )

    layer_factors = ((S_single, itself),) if layers == "single" else ((S_upper, upper), (S_lower, lower))
    shapes = ((lobe, lobe_widths),) if diffuse_weight is none else ((lobe, lobe_widths), (diffuse, diffuse_widths))
    terms = tuple(term(S_layer, of, shape, widths) for S_layer, of in layer_factors for shape, widths in shapes)

    return Model(
        "schlick",
        formula,
        parameters_type,
        PARAMETERS[layers],
        evaluate_single if layers == "single" else evaluate_double,
        source,
        sample=sample_single if layers == "single" else sample_double,
        pdf=pdf_single if layers == "single" else pdf_double,
        scale=lambda p: 1.0,
        complete=complete,
        smooth_in=terms[0].smooth_in,
        parts=(lambda p: tuple((each, p) for each in terms)) if len(terms) > 1 else None,
        isotropic=lambda p: all(value == 1.0 for name, value in zip(p._fields, p, strict=True) if name[0] == "p"),
        claims=(Reciprocal("schlick1993 section 7"), EnergyConserving("schlick1993 section 7")),
        choices=CHOICES,
        make=make,
        chosen={"layers": layers, "spectral": spectral, "directional": directional, "as_printed": as_printed},
    )


MODEL = make(layers="single", spectral="constant", directional="eq15", as_printed="no")
