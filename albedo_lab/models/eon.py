"""EON: Fujii's Oren-Nayar, and the light that it loses scattered once more, so that a white surface loses none."""

from __future__ import annotations

from functools import cache
from math import atan2, pi, sqrt
from typing import NamedTuple

from albedo_lab.model import Choice, EnergyConserving, GrazingAlbedo, Model, Parameter
from albedo_lab.models.oren_nayar_fujii import GRAZING, level, shade
from albedo_lab.optics.coordinates import PLAIN
from albedo_lab.optics.frame import Direction
from albedo_lab.optics.lobes import at_height
from albedo_lab.optics.maths import pow, sincos2pi
from albedo_lab.sources import fujii2012, portsmouth2025


class Eon(NamedTuple):
    rho: float
    r: float


MEAN = 2.0 / 3.0 - 28.0 / (15.0 * pi)
"""The mean albedo of Fujii's white surface is A_F (1 + MEAN r)."""

# 1 - E_F over A_F r, E_F being the albedo of Fujii's white surface: all that E_F is needed for, and at r = 0 no 0 / 0


def missing(w: Direction) -> float:
    """The exact one, with both ends of theta and 1 - sin^3 rewritten: near grazing it is cos / pi, and loses no digits."""
    s = sqrt(w.x * w.x + w.y * w.y)
    z = w.z
    elevation = atan2(z, s)
    short = z * z / (1.0 + s)  # 1 - sin
    cubic = 2.0 / 3.0 * s * z * (1.0 + s + s * s) / (1.0 + s)  # 2/3 tan (1 - sin^3)
    return ((0.5 * pi - 2.0 / 3.0) * short + s * elevation + s * s * z - cubic) / pi


def missing_fitted(w: Direction) -> float:
    """By the polynomial of the listing, which exceeds 1 within 1.4e-3 of grazing and is guarded there, as printed."""
    x = 1.0 - w.z
    fitted = x * (0.0571085289 + x * (0.491881867 + x * (-0.332181442 + x * 0.0714429953)))
    return max(GRAZING - fitted, 0.0)


def exact(p: Eon, wi: Direction, wo: Direction) -> float:
    return single(p, wi, wo) + compensation(p) * missing(wi) * missing(wo)


def fitted(p: Eon, wi: Direction, wo: Direction) -> float:
    return single(p, wi, wo) + compensation(p) * missing_fitted(wi) * missing_fitted(wo)


def single(p: Eon, wi: Direction, wo: Direction) -> float:
    """f_ss."""
    return p.rho / pi * level(p.r) * shade(1.0, p.r, wi, wo)


def compensation(p: Eon) -> float:
    """f_ms less both `missing`: rho_ms / pi (1 - E_i)(1 - E_o) / (1 - <E>), with 1 - <E> = A_F r (GRAZING - MEAN)."""
    lost = level(p.r) * p.r
    mean = 1.0 - lost * (GRAZING - MEAN)
    rho_ms = p.rho * p.rho * mean / (1.0 - p.rho * (1.0 - mean))
    return rho_ms / pi * lost / (GRAZING - MEAN)


class Clipped(NamedTuple):
    """The linear map of a cosine lobe: rows (a, 0, b), (0, c, 0), (d, 0, 1), in the frame whose x is the viewer's side."""

    a: float
    b: float
    c: float
    d: float


def clipped(r: float, mu: float) -> Clipped:
    """The fit of the listing, with d at most 0.

    Printed, d rises above 0 for mu > 0.99991, to 0.0035 r: there the clipping would cut the wrong side off, and the density would
    not be that of the samples.
    """
    a = 1.0 + r * (0.303392 + (-0.518982 + 0.111709 * mu) * mu + (-0.276266 + 0.335918 * mu) * r)
    b = r * (-1.16407 + 1.15859 * mu + (0.150815 - 0.150105 * mu) * r) / (mu * mu * mu - 1.43545)
    c = 1.0 + r * (0.20013 + (-0.506373 + 0.261777 * mu) * mu)
    d = r * (0.540852 + (-1.01625 + 0.475392 * mu) * mu) / (-1.0743 + (0.0725628 + mu) * mu)
    return Clipped(a, b, c, min(d, 0.0))


def side(wo: Direction) -> tuple[float, float]:
    """Cosine and sine of the viewer's azimuth; any will do for one at the normal."""
    s = sqrt(wo.x * wo.x + wo.y * wo.y)
    return (wo.x / s, wo.y / s) if s > 0.0 else (1.0, 0.0)


def uniform_share(p: Eon, mu: float) -> float:
    """The share of the samples that are spread evenly: they reach where the clipped lobe does not."""
    return pow(p.r, 0.1) * (0.162925 + (-0.372058 + (0.538233 - 0.290822 * mu) * mu) * mu)


def clip(m: Clipped) -> float:
    """cos of the tilt of the plane that the map lays into the surface."""
    return 1.0 / sqrt(m.d * m.d + 1.0)


def sample(p: Eon, wo: Direction, u1: float, u2: float) -> Direction:
    share = uniform_share(p, wo.z)
    if u1 < share:
        return at_height(u1 / share, u2)
    m = clipped(p.r, wo.z)
    radius, (sp, cp) = sqrt((u1 - share) / (1.0 - share)), sincos2pi(u2)
    # the disc is squeezed along x onto that part of it which the map leaves above the surface
    y = radius * sp
    rim = sqrt((1.0 - y) * (1.0 + y))
    x = 0.5 * (1.0 + clip(m)) * (rim - radius * cp) - rim
    z = sqrt(max((rim - x) * (rim + x), 0.0))
    along, across, up = m.a * x + m.b * z, m.c * y, m.d * x + z
    k = 1.0 / sqrt(along * along + across * across + up * up)
    ca, sa = side(wo)
    return Direction(k * (ca * along - sa * across), k * (sa * along + ca * across), k * up)


def pdf(p: Eon, wi: Direction, wo: Direction) -> float:
    share = uniform_share(p, wo.z)
    m = clipped(p.r, wo.z)
    ca, sa = side(wo)
    along, across = ca * wi.x + sa * wi.y, ca * wi.y - sa * wi.x
    # the cofactors of the map applied to wi: the direction of the lobe that wi came from, times its stretch
    volume = m.c * (m.a - m.b * m.d)
    x, y, z = m.c * (along - m.b * wi.z), (m.a - m.b * m.d) * across, m.c * (m.a * wi.z - m.d * along)
    stretch = volume / (x * x + y * y + z * z)
    lobe = stretch * stretch * max(z, 0.0) / (0.5 * pi * (1.0 + clip(m)))
    return share / (2.0 * pi) + (1.0 - share) * lobe


NOTES = (
    "1 - E_F is reduced by hand, so that the guards max(1e-7, ..) are not needed",
    "the d of the sampler's fit is at most 0; printed, it is up to 0.0035 r for mu > 0.99991, and the wrong side is clipped",
)
FORMS = {
    "exact": (exact, portsmouth2025("f_EON, exact", *NOTES)),
    "fitted": (
        fitted,
        portsmouth2025("f_EON, approximate", "the guards are max(0, ..) of the reduced 1 - E_F, for max(1e-7, ..)", NOTES[1]),
    ),
}
CLAIMS = (
    EnergyConserving("portsmouth2025, abstract: energy preserving"),
    GrazingAlbedo("portsmouth2025, E_EON: E_F = 1 at grazing angles", value=lambda p: p.rho),
)
CHOICES = (Choice("albedo", "the albedo of Fujii's surface as derived, or the polynomial fitted to it", tuple(FORMS), "exact"),)


@cache
def make(*, albedo: str = "exact") -> Model:
    """EON with the exact albedo of Fujii's surface in it, or with the fitted one."""
    evaluate, source = FORMS[albedo]
    return Model(
        "eon",
        "rho / pi A_F (1 + r s / t) + rho_ms / pi (1 - E_i) (1 - E_o) / (1 - <E>)",
        Eon,
        (
            Parameter("rho", "single-scattering albedo", default=1.0, low=0.0, high=1.0),
            Parameter("r", "roughness", default=0.5, low=0.0, high=1.0),
        ),
        evaluate,
        sample=sample,
        pdf=pdf,
        scale=lambda p: 1.0,
        smooth_in=PLAIN,
        source=source,
        also=(fujii2012("the single scattering"),),
        claims=CLAIMS if albedo == "exact" else CLAIMS[1:],  # the fit is meant to be near
        choices=CHOICES,
        make=make,
        chosen={"albedo": albedo},
    )


MODEL = make(albedo="exact")
