"""Disney's principled model of 2012: diffuse or subsurface body, sheen, an anisotropic highlight and a clearcoat, all added up.

Colours are one channel: baseColor is its value in linear light, and what tints by hue is left out. Energy is not balanced by
design: neither the highlight nor the clearcoat takes light from what lies below.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace
from functools import cache
from math import pi, sqrt
from typing import NamedTuple

from albedo_lab.model import Choice, Model, Parameter
from albedo_lab.optics.coordinates import Axis, Coordinates
from albedo_lab.optics.frame import Direction, bisector, length
from albedo_lab.optics.fresnel import schlick
from albedo_lab.optics.masking import ggx_lambda, stretched
from albedo_lab.optics.maths import sincos2pi
from albedo_lab.optics.microfacet import Normals, Pdf, Sample, elliptic_visible, ggx_visible, plain_sampling, smith_sampling
from albedo_lab.optics.normals import ggx_elliptic, gtr, gtr_slope, tails
from albedo_lab.optics.profiles import TAIL, TANGENT
from albedo_lab.sources import burley2012


class Disney(NamedTuple):
    """What the lobe chosen has no use for stands as in NEUTRAL; what follows clearcoatGloss is derived."""

    baseColor: float  # noqa: N815, the name that everybody knows
    metallic: float
    subsurface: float
    specular: float
    roughness: float
    anisotropic: float
    sheen: float
    clearcoat: float
    clearcoatGloss: float  # noqa: N815
    alpha_x: float
    alpha_y: float
    alpha_g: float
    """Of G: rougher than the highlight, so that smooth surfaces do not flare at grazing angles."""
    F0: float
    alpha_c: float
    """Of the clearcoat; what follows: see optics.normals.Tails."""
    L: float
    g: float
    E: float
    norm: float


def fifth(c: float) -> float:
    """(1 - c)^5."""
    return schlick(0.0, c)


def faded(edge: float, wi: Direction, wo: Direction) -> float:
    """From 1 where a direction is the normal to `edge` where it grazes, one factor for each."""
    return (1.0 + (edge - 1.0) * fifth(wi.z)) * (1.0 + (edge - 1.0) * fifth(wo.z))


def diffuse(p: Disney, wi: Direction, wo: Direction, u: float) -> float:
    return faded(0.5 + 2.0 * u * u * p.roughness, wi, wo)  # section 5.3, F_D90


def subsurface(p: Disney, wi: Direction, wo: Direction, u: float) -> float:
    """Hanrahan and Krueger's, approximated for a medium that scatters in all directions alike."""
    return 1.25 * (faded(u * u * p.roughness, wi, wo) * (1.0 / (wi.z + wo.z) - 0.5) + 0.5)


def body(p: Disney, wi: Direction, wo: Direction) -> float:
    """Diffuse light, or light from below the surface, and sheen; a metal has none of these."""
    u = 0.5 * length(bisector(wi, wo))
    mixed = (1.0 - p.subsurface) * diffuse(p, wi, wo, u) + p.subsurface * subsurface(p, wi, wo, u)
    return (1.0 - p.metallic) * (p.baseColor / pi * mixed + p.sheen * fifth(u))


def G(alpha: float, w: Direction) -> float:
    """Smith's masking of GGX over twice the cosine."""
    return 1.0 / (w.z + sqrt(alpha * alpha + (1.0 - alpha * alpha) * w.z * w.z))


def highlight(p: Disney, wi: Direction, wo: Direction) -> float:
    """GTR with gamma = 2, of two widths."""
    v = bisector(wi, wo)
    return schlick(p.F0, 0.5 * length(v)) * G(p.alpha_g, wi) * G(p.alpha_g, wo) * ggx_elliptic(p.alpha_x, p.alpha_y, v)


COAT_F0, COAT_G, COAT_SHARE = 0.04, 0.25, 0.25
"""Of the clearcoat: a refractive index of 1.5, the width of its G, and how much of it there is at most."""


def coat(p: Disney, wi: Direction, wo: Direction) -> float:
    """GTR with gamma = 1."""
    v = bisector(wi, wo)
    reflected = schlick(COAT_F0, 0.5 * length(v)) * gtr(p.alpha_c, 1.0, p.norm, v)
    return COAT_SHARE * p.clearcoat * reflected * G(COAT_G, wi) * G(COAT_G, wo)


# Samples: by the cosine and a little more for the body, visible normals for the highlight, any normal for the clearcoat

MORE = 0.1
"""Light from below the surface goes like 1 / (N.L + N.V): no weight exceeds that over cosine + MORE."""


def sample_body(p: Disney, wo: Direction, u1: float, u2: float) -> Direction:
    # the root of z^2 + 2 MORE z = (1 + 2 MORE) u1
    share = (1.0 + 2.0 * MORE) * u1
    z = share / (MORE + sqrt(MORE * MORE + share))
    s, (sp, cp) = sqrt(max((1.0 - z) * (1.0 + z), 0.0)), sincos2pi(u2)
    return Direction(s * cp, s * sp, z)


def body_pdf(p: Disney, wi: Direction, wo: Direction) -> float:
    return (MORE + wi.z) / (pi * (1.0 + 2.0 * MORE))


def visible(p: Disney, wo: Direction, u1: float, u2: float) -> Direction:
    return elliptic_visible(ggx_visible, p.alpha_x, p.alpha_y, wo, u1, u2)


FACETS = Normals(
    density=lambda p, v: ggx_elliptic(p.alpha_x, p.alpha_y, v),
    slope=lambda p, u: 0.0,
    smith=lambda p, w: ggx_lambda(1.0, stretched(p.alpha_x, p.alpha_y, w)),
    width=lambda p: 1.0,
)
COAT = Normals(
    density=lambda p, v: gtr(p.alpha_c, 1.0, p.norm, v),
    slope=lambda p, u: gtr_slope(p.L, p.g, p.E, u),
    smith=lambda p, w: 0.0,
    width=lambda p: p.alpha_c,
)
sample_highlight, highlight_pdf = smith_sampling(FACETS, visible)
sample_coat, coat_pdf = plain_sampling(COAT)


def shares(p: Disney, wo: Direction) -> tuple[float, float]:
    """Of the samples of all lobes together, those of the body and those of the highlight: about as their albedos are."""
    below = (1.0 - p.metallic) * (p.baseColor + p.sheen)
    above = 0.05 + schlick(p.F0, wo.z)
    on_top = COAT_SHARE * p.clearcoat * (0.1 + schlick(COAT_F0, wo.z))
    total = below + above + on_top
    return below / total, above / total


def sample_all(p: Disney, wo: Direction, u1: float, u2: float) -> Direction:
    below, above = shares(p, wo)
    if u1 < below:
        return sample_body(p, wo, u1 / below, u2)
    u = u1 - below
    if u < above:
        return sample_highlight(p, wo, u / above, u2)
    return sample_coat(p, wo, (u - above) / (1.0 - below - above), u2)


def pdf_all(p: Disney, wi: Direction, wo: Direction) -> float:
    below, above = shares(p, wo)
    on_top = max(1.0 - below - above, 0.0)
    return below * body_pdf(p, wi, wo) + above * highlight_pdf(p, wi, wo) + on_top * coat_pdf(p, wi, wo)


# The family


def widths(p: Disney) -> tuple[float, float]:
    return p.alpha_x, p.alpha_y


def coat_widths(p: Disney) -> tuple[float, float]:
    return sqrt(p.alpha_c), sqrt(p.alpha_c)


ABOUT_BODY = Coordinates(Axis.HALF, TANGENT)
ABOUT_HIGHLIGHT = Coordinates(Axis.HALF, TAIL, ellipse=widths)
ABOUT_COAT = Coordinates(Axis.HALF, TANGENT, ellipse=coat_widths)
Term = tuple[Callable[..., float], Coordinates, Sample, Pdf]
BODY: Term = (body, ABOUT_BODY, sample_body, body_pdf)
HIGHLIGHT: Term = (highlight, ABOUT_HIGHLIGHT, sample_highlight, highlight_pdf)
CLEARCOAT: Term = (coat, ABOUT_COAT, sample_coat, coat_pdf)


def together(p: Disney, wi: Direction, wo: Direction) -> float:
    return body(p, wi, wo) + highlight(p, wi, wo) + coat(p, wi, wo)


EVERYTHING: Term = (together, ABOUT_HIGHLIGHT, sample_all, pdf_all)


PARAMETERS = {
    name: Parameter(name, meaning, default, 0.0, 1.0)
    for name, meaning, default in (
        ("baseColor", "colour of the surface, one channel in linear light", 0.5),
        ("metallic", "from dielectric to metal", 0.0),
        ("subsurface", "from the diffuse shape to that of light from below the surface", 0.0),
        ("specular", "reflectance of a dielectric at normal incidence, in units of 0.08", 0.5),
        ("roughness", "of the body and of the highlight", 0.5),
        ("anisotropic", "how much wider the highlight is along x than along y", 0.0),
        ("sheen", "brightness of the sheen", 0.0),
        ("clearcoat", "strength of the clearcoat", 0.0),
        ("clearcoatGloss", "from satin to gloss", 1.0),
    )
}
NEUTRAL = dict.fromkeys(PARAMETERS, 0.0)
LOBES: dict[str, tuple[Term, str, tuple[str, ...], dict[str, float]]] = {
    "all": (
        EVERYTHING,
        "(1 - metallic) (baseColor / pi (diffuse or subsurface) + sheen) + F G D / (4 N.L N.V) + clearcoat",
        tuple(PARAMETERS),
        {},
    ),
    "diffuse": (BODY, "baseColor / pi F_d(N.L) F_d(N.V)", ("baseColor", "roughness"), {}),
    "subsurface": (
        BODY,
        "1.25 baseColor / pi (F_ss(N.L) F_ss(N.V) (1 / (N.L + N.V) - 1/2) + 1/2)",
        ("baseColor", "roughness"),
        {"subsurface": 1.0},
    ),
    "sheen": (BODY, "sheen (1 - L.H)^5", ("sheen",), {}),
    "specular": (HIGHLIGHT, "F G D / (4 N.L N.V), F0 = 0.08 specular", ("specular", "roughness", "anisotropic"), {}),
    "metallic": (HIGHLIGHT, "F G D / (4 N.L N.V), F0 = baseColor", ("baseColor", "roughness", "anisotropic"), {"metallic": 1.0}),
    "clearcoat": (CLEARCOAT, "clearcoat / 4 F G D / (4 N.L N.V)", ("clearcoat", "clearcoatGloss"), {}),
}
"""Of all lobes, and of each alone: the term, its formula, the parameters that it has, and what makes the others vanish."""
CHOICES = (Choice("lobe", "all of them together, or one alone", tuple(LOBES), "all"),)
NARROWEST = 1e-3
SOURCE = burley2012("section 5", "G of 2012, with the remapped roughness", "specularTint and sheenTint are 0")


def completion(fixed: Mapping[str, float]) -> Callable[[Mapping[str, float]], Disney]:
    """The parameters with the constants derived from them."""

    def complete(numbers: Mapping[str, float]) -> Disney:
        n = {**NEUTRAL, **fixed, **numbers}
        r, aspect = n["roughness"], sqrt(1.0 - 0.9 * n["anisotropic"])
        alpha_c = 0.1 + (0.001 - 0.1) * n["clearcoatGloss"]
        return Disney(
            **n,
            alpha_x=max(NARROWEST, r * r / aspect),
            alpha_y=max(NARROWEST, r * r * aspect),
            alpha_g=(0.5 + 0.5 * r) ** 2,
            F0=n["metallic"] * n["baseColor"] + (1.0 - n["metallic"]) * 0.08 * n["specular"],
            alpha_c=alpha_c,
            **tails(alpha_c, 1.0)._asdict(),
        )

    return complete


def own_of(lobe: str, name: str) -> Parameter:
    """A parameter; that which says how much there is of a lobe is 1 where this lobe is alone."""
    parameter = PARAMETERS[name]
    return replace(parameter, default=1.0) if name == lobe and parameter.default == 0.0 else parameter


@cache
def make(*, lobe: str) -> Model:
    """All lobes, each integrated where it is smooth, or one."""
    (evaluate, about, sample, pdf), formula, names, fixed = LOBES[lobe]
    terms = tuple(
        Model("disney", "one of its lobes", Disney, (), f, SOURCE, smooth_in=where)
        for f, where, *_ in (BODY, HIGHLIGHT, CLEARCOAT)
    )
    return Model(
        "disney",
        formula,
        Disney,
        tuple(own_of(lobe, name) for name in names),
        evaluate,
        sample=sample,
        pdf=pdf,
        scale=lambda p: 1.0,
        complete=completion(fixed),
        smooth_in=about,
        width="roughness",
        parts=(lambda p: tuple((term, p) for term in terms)) if lobe == "all" else None,
        isotropic=lambda p: p.alpha_x == p.alpha_y,
        source=SOURCE,
        choices=CHOICES,
        make=make,
        chosen={"lobe": lobe},
    )


MODEL = make(lobe="all")
