"""Oren-Nayar: V-cavities of Lambertian facets, which scatter back and stay bright towards grazing angles."""

from __future__ import annotations

from functools import cache
from math import atan2, pi, sqrt
from typing import NamedTuple

from albedo_lab.model import Choice, Model, Parameter
from albedo_lab.optics.coordinates import PLAIN
from albedo_lab.optics.frame import Direction
from albedo_lab.optics.lobes import raised_cosine_pdf, sample_raised_cosine
from albedo_lab.sources import losasso, neumann1999, oren_nayar1994


class OrenNayar(NamedTuple):
    rho: float
    sigma: float


def steady(sigma: float) -> float:
    """A of the qualitative form, C1 of the full one."""
    ss = sigma * sigma
    return 1.0 - 0.5 * ss / (ss + 0.33)


def rise(sigma: float) -> float:
    """B of the qualitative form, C2 / sin(alpha) of the full one."""
    ss = sigma * sigma
    return 0.45 * ss / (ss + 0.09)


def qualitative(p: OrenNayar, wi: Direction, wo: Direction) -> float:
    # both horizontal parts are sines long: cos(dphi) sin(alpha) tan(beta) = (x x' + y y') / cos(beta)
    along = wi.x * wo.x + wi.y * wo.y
    return p.rho / pi * (steady(p.sigma) + rise(p.sigma) * max(0.0, along) / max(wi.z, wo.z))


def full(p: OrenNayar, wi: Direction, wo: Direction) -> float:
    si, so = sqrt(wi.x * wi.x + wi.y * wi.y), sqrt(wo.x * wo.x + wo.y * wo.y)
    # the azimuth counts for nothing where either direction is the normal
    product = max(si * so, 1e-300)
    cos_phi = (wi.x * wo.x + wi.y * wo.y) / product
    sin_phi = (wi.x * wo.y - wi.y * wo.x) / product
    sin_alpha, cos_alpha = max(si, so), min(wi.z, wo.z)
    sin_beta, cos_beta = min(si, so), max(wi.z, wo.z)
    # elevations as shares of a right angle: 2 alpha / pi = 1 - a, 2 beta / pi = 1 - b
    a, b = atan2(cos_alpha, sin_alpha) * (2.0 / pi), atan2(cos_beta, sin_beta) * (2.0 / pi)
    facing = sin_alpha
    # 1 - (2 beta / pi)^3 less 1 - sin(alpha): where both directions graze, tan(beta) multiplies what is left
    opposing = b * (3.0 - b * (3.0 - b)) - cos_alpha * cos_alpha / (1.0 + sin_alpha)
    C1 = steady(p.sigma)
    C2 = rise(p.sigma) * (facing if cos_phi >= 0.0 else opposing)
    C3 = rise(p.sigma) * (0.125 / 0.45) * ((1.0 - a) * (1.0 - b)) ** 2
    tan_beta, tan_mean = sin_beta / cos_beta, (si + so) / (wi.z + wo.z)  # tan((alpha + beta) / 2)
    across = sin_phi * sin_phi / (1.0 + abs(cos_phi))  # 1 - |cos(dphi)|
    direct = C1 + cos_phi * C2 * tan_beta + across * C3 * tan_mean
    ss = p.sigma * p.sigma
    interreflected = 0.17 * p.rho * ss / (ss + 0.13) * (1.0 - cos_phi * (1.0 - b) * (1.0 - b))
    return p.rho / pi * (direct + interreflected)


def sample(p: OrenNayar, wo: Direction, u1: float, u2: float) -> Direction:
    # f cos goes like A z + (B / pi), at grazing incidence and averaged over the azimuth: by the cosine alone, few samples would
    # carry much where both directions graze
    return sample_raised_cosine(steady(p.sigma), rise(p.sigma) / pi, u1, u2)


def pdf(p: OrenNayar, wi: Direction, wo: Direction) -> float:
    return raised_cosine_pdf(steady(p.sigma), rise(p.sigma) / pi, wi)


LOSASSO = losasso(
    "The Oren-Nayar Lighting Equation",
    "f_att, E_0 and cos(theta_i) belong to the light; k_d, a second albedo beside rho, is left to the scale",
    "Oren and Nayar advise 0.57 in place of the 0.33 in A to make up for the missing interreflections; 0.33 is kept",
)
OREN_NAYAR = oren_nayar1994("direct illumination L1 and interreflections L2")
# The full form falls below 0 towards the mirror direction at grazing angles if the surface is rough and dark. It tends there to
# rho/pi (C1 - 6 B / pi + 0.34 rho sigma^2 / (sigma^2 + 0.13)): for small rho from sigma = 0.664 on, at pi/2 for rho < 0.837.
FORMS = {
    "qualitative": (qualitative, "rho / pi (A + B max(0, cos dphi) sin alpha tan beta)", LOSASSO, OREN_NAYAR),
    "full": (
        full,
        "rho / pi (C_1 + C_2 cos dphi tan beta + C_3 (1 - |cos dphi|) tan((alpha + beta) / 2)"
        " + 0.17 rho sigma^2 / (sigma^2 + 0.13) (1 - cos dphi (2 beta / pi)^2))",
        OREN_NAYAR,
        losasso("The Oren-Nayar Lighting Equation, without interreflections"),
    ),
}
CHOICES = (Choice("form", "the authors' qualitative simplification, or all their terms", tuple(FORMS), "qualitative"),)


@cache
def make(*, form: str = "qualitative") -> Model:
    """One form of the model."""
    evaluate, formula, source, other = FORMS[form]
    return Model(
        "oren_nayar",
        formula,
        OrenNayar,
        (
            Parameter("rho", "albedo of the facets", default=1.0, low=0.0, high=1.0),
            Parameter("sigma", "standard deviation of the facets' angle", default=0.5, low=0.0, high=0.5 * pi, unit="rad"),
        ),
        evaluate,
        sample=sample,
        pdf=pdf,
        scale=lambda p: 1.0,
        smooth_in=PLAIN,
        positive=form == "qualitative",  # full: see FORMS
        source=source,
        also=(other, neumann1999("table 5")),
        choices=CHOICES,
        make=make,
        chosen={"form": form},
    )


MODEL = make(form="qualitative")
