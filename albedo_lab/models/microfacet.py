"""The microfacet model: any of five distributions of normals, five geometric factors, four reflectances, and a diffuse part."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cache
from math import pi, sqrt
from typing import Any, NamedTuple

from albedo_lab.model import Choice, Claim, EnergyConserving, Model, Parameter, Reference
from albedo_lab.models.phong import EXPONENT
from albedo_lab.optics.coordinates import PLAIN, Axis, Coordinates, Kink
from albedo_lab.optics.frame import Direction, bisector, length
from albedo_lab.optics.fresnel import conductor, dielectric, schlick
from albedo_lab.optics.lobes import sample_cosine
from albedo_lab.optics.masking import (
    beckmann_lambda,
    blinn_phong_lambda,
    ggx_lambda,
    gtr_lambda,
    student_peak,
    trowbridge_reitz_lambda,
)
from albedo_lab.optics.microfacet import GEOMETRIES, Normals, Pdf, Sample, beckmann_visible, ggx_visible, reflection, sampling
from albedo_lab.optics.normals import (
    beckmann,
    beckmann_slope,
    blinn_phong,
    blinn_phong_slope,
    ggx,
    ggx_slope,
    gtr,
    gtr_median,
    gtr_slope,
    tails,
)
from albedo_lab.optics.profiles import GAUSS, POWER, TAIL, TANGENT, Profile
from albedo_lab.sources import nuaj_models, schlick1994, smith1967


class Microfacet(NamedTuple):
    """What a member does not use is 0."""

    n: float = 0.0
    m: float = 0.0
    alpha: float = 0.0
    gamma: float = 0.0
    F0: float = 0.0
    eta: float = 0.0
    k: float = 0.0
    a_d: float = 0.0
    peak: float = 0.0
    """blinn_phong: see masking.student_peak."""
    L: float = 0.0
    """trowbridge_reitz and gtr: this and what follows, see Tails."""
    g: float = 0.0
    E: float = 0.0
    norm: float = 0.0
    size: float = 1.0
    """D of the print over the normalised one."""
    refracted: float = 0.0
    """(n_i / n_t)^2."""


@dataclass(frozen=True)
class Distribution:
    """A distribution of normals, what it is called by, and the coordinates in which it is smooth."""

    normals: Normals
    formula: str
    parameters: tuple[Parameter, ...]
    profile: Profile
    width: Callable[[Microfacet], float]


ROUGHNESS = Parameter("alpha", "roughness", default=0.1, low=1e-4, high=1.0, scale="log")
TR = Normals(
    density=lambda p, v: gtr(p.alpha, 1.0, p.norm, v),
    slope=lambda p, u: gtr_slope(p.L, p.g, p.E, u),
    smith=lambda p, w: trowbridge_reitz_lambda(p.alpha, p.L, w),
    width=lambda p: p.alpha,
)
DISTRIBUTIONS = {
    "blinn_phong": Distribution(
        Normals(
            density=lambda p, v: blinn_phong(p.n, v),
            slope=lambda p, u: blinn_phong_slope(p.n, u),
            smith=lambda p, w: blinn_phong_lambda(p.n, p.peak, w),
            width=lambda p: sqrt(2.0 / (p.n + 2.0)),
        ),
        "(n+2) / (2 pi) cos^n delta",
        (EXPONENT,),
        POWER,
        lambda p: 1.0,
    ),
    "beckmann": Distribution(
        Normals(
            density=lambda p, v: beckmann(p.m, v),
            slope=lambda p, u: beckmann_slope(p.m, u),
            smith=lambda p, w: beckmann_lambda(p.m, w),
            width=lambda p: p.m,
            visible=lambda p, wo, u1, u2: beckmann_visible(p.m, wo, u1, u2),
        ),
        "exp(-tan^2 delta / m^2) / (pi m^2 cos^4 delta)",
        (Parameter("m", "RMS slope", default=0.1, low=1e-4, high=1.0, scale="log"),),
        GAUSS,
        lambda p: p.m,
    ),
    "trowbridge_reitz": Distribution(
        TR,
        "(1 - alpha^2) / (2 pi log(1/alpha)) / (alpha^2 cos^2 delta + sin^2 delta)",
        (ROUGHNESS,),
        TANGENT,
        lambda p: sqrt(p.alpha),
    ),
    "ggx": Distribution(
        Normals(
            density=lambda p, v: ggx(p.alpha, v),
            slope=lambda p, u: ggx_slope(p.alpha, u),
            smith=lambda p, w: ggx_lambda(p.alpha, w),
            width=lambda p: p.alpha,
            visible=lambda p, wo, u1, u2: ggx_visible(p.alpha, wo, u1, u2),
        ),
        "alpha^2 / (pi (alpha^2 cos^2 delta + sin^2 delta)^2)",
        (ROUGHNESS,),
        TAIL,
        lambda p: p.alpha,
    ),
    "gtr": Distribution(
        Normals(
            density=lambda p, v: gtr(p.alpha, p.gamma, p.norm, v),
            slope=lambda p, u: gtr_slope(p.L, p.g, p.E, u),
            smith=lambda p, w: gtr_lambda(p.alpha, p.L, p.g, p.E, w),
            width=lambda p: p.alpha,
        ),
        "(gamma-1) (1 - alpha^2) / (pi (alpha^(2 - 2 gamma) - 1)) / (alpha^2 cos^2 delta + sin^2 delta)^gamma",
        (ROUGHNESS, Parameter("gamma", "exponent of the tail: 1 trowbridge_reitz, 2 ggx", default=1.5, low=0.0, high=10.0)),
        TAIL,
        lambda p: gtr_median(p.L, p.g, p.E),
    ),
}
PRINTED = {
    "trowbridge_reitz": "alpha^2 / pi / (alpha^2 cos^2 delta + sin^2 delta)",
    "gtr": "alpha^2 / pi / (alpha^2 cos^2 delta + sin^2 delta)^gamma",
}

REAL = Parameter("eta", "refractive index n_t / n_i", default=1.5, low=1.0, high=10.0)
COMPLEX = (
    Parameter("eta", "real part of the refractive index", default=0.79, low=0.01, high=10.0, scale="log"),
    Parameter("k", "imaginary part of the refractive index", default=5.85, low=0.0, high=20.0),
)
FRESNEL: dict[str, tuple[Callable[..., float], tuple[Parameter, ...]]] = {
    "one": (lambda p, u: 1.0, ()),
    "schlick": (
        lambda p, u: schlick(p.F0, u),
        (Parameter("F0", "reflectance at normal incidence", default=0.04, low=0.0, high=1.0),),
    ),
    "dielectric": (lambda p, u: dielectric(p.eta, u), (REAL,)),
    "conductor": (lambda p, u: conductor(p.eta, p.k, u), COMPLEX),
}


def refracted(F: str, numbers: Mapping[str, float]) -> float:
    """(n_i / n_t)^2, for Schlick's F with the real index that has this F0; 0 for the perfect reflector."""
    if F == "schlick":
        root = sqrt(numbers["F0"])
        return ((1.0 - root) / (1.0 + root)) ** 2
    return 1.0 / numbers["eta"] ** 2 if F != "one" else 0.0


def lambert(F: Callable[..., float]) -> Callable[[Any, Direction, Direction], float]:
    return lambda p, wi, wo: p.a_d / pi


def one_minus_fresnel(F: Callable[..., float]) -> Callable[[Any, Direction, Direction], float]:
    return lambda p, wi, wo: p.a_d / pi * (1.0 - F(p, 0.5 * length(bisector(wi, wo))))


def refracted_diffuse(F: Callable[..., float]) -> Callable[[Any, Direction, Direction], float]:
    return lambda p, wi, wo: p.a_d / pi * p.refracted * (1.0 - F(p, 0.5 * length(bisector(wi, wo))))


DIFFUSE = {
    "lambert": (lambert, "a_d / pi", PLAIN),
    "one_minus_fresnel": (one_minus_fresnel, "a_d / pi (1 - F)", Coordinates(Axis.HALF, TANGENT)),
    "refracted": (refracted_diffuse, "a_d / pi (n_i / n_t)^2 (1 - F)", Coordinates(Axis.HALF, TANGENT)),
}
DIFFUSE_ALBEDO = Parameter("a_d", "albedo of the diffuse part", default=0.5, low=0.0, high=1.0)
CHOICES = (
    Choice("D", "distribution of the normals", tuple(DISTRIBUTIONS), "ggx"),
    Choice("G", "how facets hide each other", tuple(GEOMETRIES), "smith"),
    Choice("F", "reflectance of the facets", tuple(FRESNEL), "one"),
    Choice("diffuse", "diffuse part", ("none", *DIFFUSE), "none"),
    Choice(
        "as_printed",
        "with the constants of trowbridge_reitz and gtr that are printed, which do not normalise",
        ("no", "yes"),
        "no",
    ),
)
"""The geometric factors are those of any distribution; Smith's is the exact one of the distribution chosen."""


def mixture(specular: Sample, density: Pdf) -> tuple[Sample, Pdf]:
    """Half of the samples follow the facets, half the cosine."""

    def sample(p: Any, wo: Direction, u1: float, u2: float) -> Direction:
        return specular(p, wo, 2.0 * u1, u2) if u1 < 0.5 else sample_cosine(2.0 * u1 - 1.0, u2)

    def pdf(p: Any, wi: Direction, wo: Direction) -> float:
        return 0.5 * density(p, wi, wo) + 0.5 * wi.z / pi

    return sample, pdf


def exponent(p: Microfacet) -> float:
    return p.n


def completion(D: str, F: str, as_printed: str) -> Callable[[Mapping[str, float]], Microfacet]:
    """The parameters with the constants derived from them."""

    def complete(numbers: Mapping[str, float]) -> Microfacet:
        derived: dict[str, float] = {"refracted": refracted(F, numbers)}
        if D == "blinn_phong":
            derived["peak"] = student_peak(numbers["n"])
        if D in PRINTED:
            alpha = numbers["alpha"]
            derived.update(tails(alpha, numbers.get("gamma", 1.0))._asdict())
            derived["size"] = alpha * alpha / (pi * derived["norm"]) if as_printed == "yes" else 1.0
        return Microfacet(**numbers, **derived)

    return complete


MIRROR_LIMIT = {"beckmann": "m", "ggx": "alpha", "trowbridge_reitz": "alpha"}
"""What narrows a distribution to the normal of the surface: for gtr it depends on gamma, and blinn_phong narrows as n grows."""


def mirror_limit(D: str, G: str, F: str, diffuse: str, as_printed: str) -> tuple[str, Callable[[Any, float], float]] | None:
    """The width of D and the reflectance of the mirror, where the member tends to one at every angle."""
    misprinted = D in PRINTED and as_printed == "yes"
    if D not in MIRROR_LIMIT or G == "none" or diffuse != "none" or misprinted:
        return None
    return MIRROR_LIMIT[D], FRESNEL[F][0]


SCHLICK_FITS = "eq. 7 of schlick1993, at grazing angles 1 / sqrt(8) of Smith's masking of the facets that face the direction"


def references(D: str, G: str, F: str, diffuse: str, as_printed: str) -> tuple[Reference, ...]:
    """The page, and what it leaves out."""
    notes = []
    if D in PRINTED and as_printed == "no":
        notes.append(f"the constant of D normalises it; printed {PRINTED[D]}")
    if G != "none":
        notes.append("the page gives no formula for G")
    if diffuse == "refracted" and F == "schlick":
        notes.append("n_t / n_i from F0, as of a real index")
    also = {
        "smith": (smith1967("the shadowing function", "for the distribution chosen, and facets that face both directions"),),
        "smith_correlated": (
            smith1967("the shadowing function", "for the distribution chosen, both directions hidden by the same height"),
        ),
        "schlick": (
            schlick1994(
                "the geometrical attenuation",
                "for beckmann; else with m = alpha, or sqrt(2 / (n+2))",
                f"fitted to {SCHLICK_FITS}",
            ),
        ),
    }
    return nuaj_models("eq. 4", *notes), *also.get(G, ())


@cache
def make(*, D: str, G: str, F: str, diffuse: str, as_printed: str) -> Model:
    """One distribution, one geometric factor, one reflectance, one diffuse part."""
    distribution, (reflect, indices) = DISTRIBUTIONS[D], FRESNEL[F]
    facets = reflection(distribution.normals, GEOMETRIES[G](distribution.normals), reflect)
    sample, pdf = sampling(distribution.normals, G)
    width = distribution.width
    about_half = Coordinates(
        Axis.HALF,
        distribution.profile,
        exponent=exponent,
        ellipse=lambda p: (width(p), width(p)),
        kink=Kink.V_CAVITY if G == "v_cavity" else Kink.NONE,
    )

    def specular(p: Microfacet, wi: Direction, wo: Direction) -> float:
        return p.size * facets(p, wi, wo)

    printed = PRINTED.get(D, distribution.formula) if as_printed == "yes" else distribution.formula
    formula = f"{printed} F G / (4 N.L N.V)"
    evaluate: Callable[..., float] = specular
    parts: Callable[[Any], tuple[tuple[Model, Any], ...]] | None = None
    source, *also = references(D, G, F, diffuse, as_printed)
    if diffuse != "none":
        build, added, own = DIFFUSE[diffuse]
        base = build(reflect)
        formula = f"{added} + {formula}"
        sample, pdf = mixture(sample, pdf)
        terms = (
            Model("microfacet", added, Microfacet, (), base, source, smooth_in=own),
            Model("microfacet", "its facets", Microfacet, (), specular, source, smooth_in=about_half),
        )

        def evaluate(p: Microfacet, wi: Direction, wo: Direction) -> float:
            return base(p, wi, wo) + specular(p, wi, wo)

        def parts(p: Microfacet) -> tuple[tuple[Model, Any], ...]:
            return tuple((term, p) for term in terms)

    claims: tuple[Claim, ...] = ()
    if G != "none" and diffuse != "lambert":
        claims = (EnergyConserving("nuaj_models, Shadowing / Masking"),)
    return Model(
        "microfacet",
        formula,
        Microfacet,
        (*distribution.parameters, *indices, *((DIFFUSE_ALBEDO,) if diffuse != "none" else ())),
        evaluate,
        sample=sample,
        pdf=pdf,
        scale=lambda p: 1.0,
        complete=completion(D, F, as_printed),
        smooth_in=about_half,
        parts=parts,
        mirror_limit=mirror_limit(D, G, F, diffuse, as_printed),
        source=source,
        also=tuple(also),
        claims=claims,
        choices=CHOICES,
        make=make,
        chosen={"D": D, "G": G, "F": F, "diffuse": diffuse, "as_printed": as_printed},
    )


MODEL = make(D="ggx", G="smith", F="one", diffuse="none", as_printed="no")
