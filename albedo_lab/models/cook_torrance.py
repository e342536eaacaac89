"""Cook-Torrance: Beckmann's normals, Fresnel reflection and V-cavities or Smith's masking, over both cosines."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from math import erfc, pi, sqrt
from typing import NamedTuple

from albedo_lab.model import Choice, Claim, DivergesAtGrazing, EnergyConserving, Model, Parameter
from albedo_lab.optics.coordinates import Axis, Coordinates, Kink
from albedo_lab.optics.frame import Direction, bisector
from albedo_lab.optics.fresnel import conductor, schlick
from albedo_lab.optics.masking import beckmann_lambda, cot
from albedo_lab.optics.microfacet import GEOMETRIES, Normals, beckmann_visible, reflection, sampling
from albedo_lab.optics.normals import beckmann, beckmann_slope
from albedo_lab.optics.profiles import GAUSS
from albedo_lab.sources import losasso, neumann1999, schlick1993, smith1967


class CookTorrance(NamedTuple):
    m: float
    F0: float = 1.0
    eta: float = 1.0
    k: float = 0.0


NORMALS = Normals(
    density=lambda p, v: beckmann(p.m, v),
    slope=lambda p, u: beckmann_slope(p.m, u),
    smith=lambda p, w: beckmann_lambda(p.m, w),
    width=lambda p: p.m,
    visible=lambda p, wo, u1, u2: beckmann_visible(p.m, wo, u1, u2),
)
FRESNEL: dict[str, Callable[..., float]] = {
    "one": lambda p, u: 1.0,
    "schlick": lambda p, u: schlick(p.F0, u),
    "exact": lambda p, u: conductor(p.eta, p.k, u),
}


def misprinted_exact(n: float, c: float) -> float:
    """losasso, appendix A, with g = sqrt(n^2 + c^2) - 1; the root should hold the 1."""
    g = sqrt(n * n + c * c) - 1.0
    s = (g - c) / (g + c)
    e = (c * (g + c) - 1.0) / (c * (g - c) + 1.0)
    return 0.5 * s * s * (1.0 + e * e)


def misprinted_schlick(n: float, c: float) -> float:
    """losasso, appendix A: (1 - x) + n x with x = (1 - c)^5; n belongs to the other term."""
    x = (1.0 - c) * (1.0 - c)
    x *= x * (1.0 - c)
    return (1.0 - x) + n * x


def misprinted_smith(m: float, w: Direction) -> float:
    """schlick1993 eq. 7: g / (g + 1) with g = sqrt(h pi) (2 - erfc sqrt(h)), h = v^2 / (2 m^2 (1 - v^2)).

    Smith's 1967 is g / (g + exp(-h)), with m the RMS slope along one direction; the m of eq. 6 is sqrt(2) times that.
    """
    root = cot(w) / (m * sqrt(2.0))
    g = sqrt(pi) * root * (2.0 - erfc(root))
    return g / (g + 1.0)


def losasso_exact(geometry: str) -> Callable[..., float]:
    """F of the misprinted root."""
    return reflection(NORMALS, GEOMETRIES[geometry](NORMALS), lambda p, u: misprinted_exact(p.eta, u))


def losasso_schlick(geometry: str) -> Callable[..., float]:
    """F of N.E, where L.H is meant: not reciprocal."""
    D, G = NORMALS.density, GEOMETRIES[geometry](NORMALS)

    def evaluate(p: CookTorrance, wi: Direction, wo: Direction) -> float:
        v = bisector(wi, wo)
        return misprinted_schlick(p.F0, wo.z) * D(p, v) * G(p, v, wi, wo) / (4.0 * wi.z * wo.z)

    return evaluate


def printed_smith(p: CookTorrance, v: Direction, wi: Direction, wo: Direction) -> float:
    return misprinted_smith(p.m, wi) * misprinted_smith(p.m, wo)


CHOICES = (
    Choice(
        "geometry",
        "how facets hide each other: V-cavities, Smith's masking, or not at all",
        ("v_cavity", "smith", "none"),
        "v_cavity",
    ),
    Choice("fresnel", "reflectance of the facets: 1, Schlick's approximation, or that of a complex index", tuple(FRESNEL), "one"),
    Choice(
        "as_printed",
        "with the misprints of a source: of losasso those of F, of schlick1993 that of Smith's G; nothing else is printed wrong",
        ("no", "losasso", "schlick1993"),
        "no",
    ),
)
SLOPE = Parameter("m", "RMS slope", default=0.1, low=1e-4, high=1.0, scale="log")
F0 = Parameter("F0", "reflectance at normal incidence", default=0.9, low=0.0, high=1.0)
INDEX = (
    Parameter("eta", "real part of the refractive index", default=0.79, low=0.01, high=10.0, scale="log"),
    Parameter("k", "imaginary part of the refractive index", default=5.85, low=0.0, high=20.0),
)
MISPRINTED_INDEX = (
    Parameter("eta", "refractive index", default=1.5, low=1.0, high=10.0),
    Parameter("k", "ignored: the printed formula is for a real index", default=0.0, low=0.0, high=20.0),
)
OF_FRESNEL = {
    "one": (),
    "schlick": (
        "F is F0 + (1 - F0) (1 - L.H)^5; printed (1 - x) + n x with x = (1 - N.E)^5, the factors swapped and N.E for L.H",
    ),
    "exact": ("g^2 of F is n^2 - 1 + c^2, for a complex index; printed g = sqrt(n^2 + c^2) - 1",),
}
OF_SMITH = (
    "G(v) is 1 / (1 + Lambda) = 2 sqrt(h pi) / (g + exp(-h)); printed g / (g + 1), where Smith's 1967 has g / (g + exp(-h)), "
    "which counts as hidden the facets that face away",
    "h is v^2 / (m^2 (1 - v^2)) with the m of eq. 6; printed with 2 m^2, m then being the RMS slope along one direction",
    "d = 0, s = 1: the specular part",
)
WHITE_PAPER = "The Cook-Torrance Lighting Model"


def gauss(geometry: str) -> Coordinates:
    """Half-vectors with Gaussian slopes."""
    return Coordinates(Axis.HALF, GAUSS, ellipse=widths, kink=Kink.V_CAVITY if geometry == "v_cavity" else Kink.NONE)


def widths(p: CookTorrance) -> tuple[float, float]:
    return p.m, p.m


@cache
def make(*, geometry: str, fresnel: str, as_printed: str) -> Model:
    """One geometry and one reflectance of the facets, correct or as a source prints it."""
    swapped = (as_printed, fresnel) == ("losasso", "schlick")
    misprinted = (as_printed, fresnel) == ("losasso", "exact")
    G = printed_smith if (as_printed, geometry) == ("schlick1993", "smith") else GEOMETRIES[geometry](NORMALS)
    if swapped:
        evaluate = losasso_schlick(geometry)
    else:
        evaluate = losasso_exact(geometry) if misprinted else reflection(NORMALS, G, FRESNEL[fresnel])
    sample, pdf = sampling(NORMALS, geometry)

    if geometry == "smith":
        source = schlick1993("eq. 5 to 7", *(OF_SMITH if as_printed == "no" else OF_SMITH[2:]))
    else:
        source = losasso(WHITE_PAPER, *(OF_FRESNEL[fresnel] if as_printed == "no" else ()))
    claims: tuple[Claim, ...] = ()
    if geometry == "v_cavity":
        claims += (EnergyConserving(f"losasso, {WHITE_PAPER}"),)
    if fresnel == "one" and as_printed == "no":
        claims += (DivergesAtGrazing("neumann1999 §2.4, figure 5"),)
    return Model(
        "cook_torrance",
        "exp(-tan^2 delta / m^2) / (pi m^2 cos^4 delta) F G / (4 N.L N.V)",
        CookTorrance,
        (SLOPE, *{"one": (), "schlick": (F0,), "exact": MISPRINTED_INDEX if misprinted else INDEX}[fresnel]),
        evaluate,
        sample=sample,
        pdf=pdf,
        scale=lambda p: 1.0,
        scale_symbol="k_s" if geometry != "smith" else "s",
        smooth_in=gauss(geometry),
        reciprocal=not swapped,
        source=source,
        also=(
            neumann1999("figure 5"),
            *((smith1967("the shadowing function"),) if geometry == "smith" else (schlick1993("eq. 5, 6"),)),
        ),
        claims=claims,
        choices=CHOICES,
        make=make,
        chosen={"geometry": geometry, "fresnel": fresnel, "as_printed": as_printed},
    )


MODEL = make(geometry="v_cavity", fresnel="one", as_printed="no")
