"""Oren-Nayar as Fujii improved it: one formula for all azimuths, without the dark rings of the qualitative form."""

from __future__ import annotations

from functools import cache
from math import pi
from typing import NamedTuple

from albedo_lab.model import Choice, EnergyConserving, GrazingAlbedo, Model, Parameter
from albedo_lab.models.oren_nayar import rise, steady
from albedo_lab.optics.coordinates import PLAIN
from albedo_lab.optics.frame import Direction
from albedo_lab.optics.lobes import raised_cosine_pdf, sample_raised_cosine
from albedo_lab.sources import fujii2012, oren_nayar1994, portsmouth2025


class OrenNayarFujii(NamedTuple):
    rho: float
    sigma: float


GRAZING = 0.5 - 2.0 / (3.0 * pi)
"""What s / t adds to the albedo of light that grazes: the factor that keeps it at rho."""


def level(sigma: float) -> float:
    """A of the mixing form times pi, which EON calls A_F; B is sigma times as much."""
    return 1.0 / (1.0 + GRAZING * sigma)


def shade(A: float, B: float, wi: Direction, wo: Direction) -> float:
    """A + B s / t: s = L.V - (N.L)(N.V), t = max(N.L, N.V) where s > 0, else 1."""
    s = wi.x * wo.x + wi.y * wo.y
    x, y = wi.x + wo.x, wi.y + wo.y
    # 1 + s as a sum of squares: where A = B, what is left of both at opposite azimuths must not round to less than nothing
    rest = 0.5 * (x * x + y * y + wi.z * wi.z + wo.z * wo.z)
    return A + B * s / max(wi.z, wo.z) if s > 0.0 else (A - B) + B * rest


def mixing(p: OrenNayarFujii, wi: Direction, wo: Direction) -> float:
    return p.rho / pi * level(p.sigma) * shade(1.0, p.sigma, wi, wo)


def sample_mixing(p: OrenNayarFujii, wo: Direction, u1: float, u2: float) -> Direction:
    return sample_raised_cosine(1.0, p.sigma / pi, u1, u2)  # as f cos, averaged over the azimuth, at grazing incidence


def pdf_mixing(p: OrenNayarFujii, wi: Direction, wo: Direction) -> float:
    return raised_cosine_pdf(1.0, p.sigma / pi, wi)


def matched(p: OrenNayarFujii, wi: Direction, wo: Direction) -> float:
    ss = p.sigma * p.sigma
    A = steady(p.sigma) + 0.17 * p.rho * ss / (ss + 0.13)
    return p.rho / pi * shade(A, rise(p.sigma), wi, wo)


def sample_matched(p: OrenNayarFujii, wo: Direction, u1: float, u2: float) -> Direction:
    return sample_raised_cosine(steady(p.sigma), rise(p.sigma) / pi, u1, u2)


def pdf_matched(p: OrenNayarFujii, wi: Direction, wo: Direction) -> float:
    return raised_cosine_pdf(steady(p.sigma), rise(p.sigma) / pi, wi)


RHO = Parameter("rho", "albedo of the facets", default=1.0, low=0.0, high=1.0)
FORMS = {
    "mixing": (
        (mixing, sample_mixing, pdf_mixing),
        "rho / pi (1 + sigma s / t) / (1 + (1/2 - 2 / (3 pi)) sigma)",
        Parameter("sigma", "share of the term that is not diffuse, Fujii's sigma'", default=0.5, low=0.0, high=1.0),
        fujii2012("A and B of the parameter sigma'"),
        (portsmouth2025("FON"),),
        (
            EnergyConserving("fujii2012, of the parameter sigma': never violates energy conservation"),
            GrazingAlbedo("fujii2012: the intensity at V.N = 0 is kept", value=lambda p: p.rho),
        ),
    ),
    "matched": (
        (matched, sample_matched, pdf_matched),
        "rho / pi (A + B s / t), A = 1 - sigma^2 / (2 sigma^2 + 0.66) + 0.17 rho sigma^2 / (sigma^2 + 0.13),"
        " B = 0.45 sigma^2 / (sigma^2 + 0.09)",
        Parameter("sigma", "standard deviation of the facets' angle", default=0.5, low=0.0, high=0.5 * pi, unit="rad"),
        fujii2012("A and B that match the full model of Oren and Nayar"),
        (oren_nayar1994("the full model that it matches"),),
        (EnergyConserving("fujii2012: violated when rho > 0.97", where="rho <= 0.97"),),
    ),
}
CHOICES = (
    Choice("form", "sigma as a share that keeps the energy, or as an angle that matches the full model", tuple(FORMS), "mixing"),
)


@cache
def make(*, form: str = "mixing") -> Model:
    """One of Fujii's two pairs of constants."""
    (evaluate, sample, pdf), formula, sigma, source, also, claims = FORMS[form]
    return Model(
        "oren_nayar_fujii",
        formula,
        OrenNayarFujii,
        (RHO, sigma),
        evaluate,
        sample=sample,
        pdf=pdf,
        scale=lambda p: 1.0,
        smooth_in=PLAIN,
        source=source,
        also=also,
        claims=claims,
        choices=CHOICES,
        make=make,
        chosen={"form": form},
    )


MODEL = make(form="mixing")
