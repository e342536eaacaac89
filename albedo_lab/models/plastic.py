"""Plastic: a diffuse body under a stretched Phong lobe, whose light is white because the refractive index is real."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from math import pi
from typing import Any, NamedTuple

from albedo_lab.model import Choice, EnergyConserving, Model, Parameter, Reciprocal
from albedo_lab.models import lambert
from albedo_lab.models.phong import EXPONENT, KINKED_MIRROR_LOBE
from albedo_lab.optics.frame import Direction, cosine_power, mirror_of
from albedo_lab.optics.fresnel import dielectric
from albedo_lab.optics.lobes import lobe_pdf, sample_cosine, sample_lobe
from albedo_lab.sources import neumann1999


class Plain(NamedTuple):
    a_d: float
    a_s: float
    n: float


class Refracting(NamedTuple):
    a_d: float
    a_s: float
    n: float
    eta: float


def one(p: Plain, c: float) -> float:
    return 1.0  # eq. 30


def exact(p: Refracting, c: float) -> float:
    return dielectric(p.eta, c)  # eq. 29


FRESNEL: dict[str, tuple[Callable[[Any, float], float], Any, str, str]] = {
    "exact": (exact, Refracting, "eq. 29", " F(eta, max(N.L, N.V))"),
    "one": (one, Plain, "eq. 30", ""),
}
CHOICES = (Choice("fresnel", "reflectance of the surface: that of its refractive index, or 1", tuple(FRESNEL), "exact"),)
SHARES = (
    Parameter("a_d", "albedo of the diffuse part", default=0.5, low=0.0, high=1.0),
    Parameter("a_s", "size of the specular part", default=0.5, low=0.0, high=1.0),
    EXPONENT,
)
INDEX = (Parameter("eta", "refractive index", default=1.5, low=1.0, high=10.0),)


@cache
def make(*, fresnel: str) -> Model:
    """The model with one reflectance of the surface."""
    F, parameters_type, equation, factor = FRESNEL[fresnel]

    def specular(p: Plain, wi: Direction, wo: Direction) -> float:
        larger = max(wi.z, wo.z)
        return p.a_s * (p.n + 2.0) / (2.0 * pi) * cosine_power(mirror_of(wo), wi, p.n) / larger * F(p, larger)

    def evaluate(p: Plain, wi: Direction, wo: Direction) -> float:
        return p.a_d / pi + specular(p, wi, wo)

    def to_lobe(p: Plain, mu: float) -> float:
        """The share of samples that follow the lobe: its albedo towards the mirror, of that and the diffuse one."""
        a_s = p.a_s * F(p, mu)
        return a_s / max(p.a_d + a_s, 1e-300)

    def sample(p: Plain, wo: Direction, u1: float, u2: float) -> Direction:
        share = to_lobe(p, wo.z)
        if u1 < share:
            return sample_lobe(mirror_of(wo), p.n, u1 / share, u2)
        return sample_cosine((1.0 - u1) / (1.0 - share), u2)

    def pdf(p: Plain, wi: Direction, wo: Direction) -> float:
        share = to_lobe(p, wo.z)
        return share * lobe_pdf(mirror_of(wo), wi, p.n) + (1.0 - share) * wi.z / pi

    lobe = Model("plastic", "the lobe", parameters_type, (), specular, neumann1999(equation), smooth_in=KINKED_MIRROR_LOBE)

    def parts(p: Plain) -> tuple[tuple[Model, Any], ...]:
        return (lambert.MODEL, lambert.Lambert(p.a_d)), (lobe, p)

    return Model(
        "plastic",
        f"a_d / pi + a_s (n+2) / (2 pi) cos^n alpha / max(N.L, N.V){factor}",
        parameters_type,
        SHARES + (INDEX if fresnel == "exact" else ()),
        evaluate,
        sample=sample,
        pdf=pdf,
        scale=lambda p: 1.0,
        smooth_in=KINKED_MIRROR_LOBE,
        parts=parts,
        source=neumann1999(equation),
        claims=(
            Reciprocal("neumann1999 §2"),
            EnergyConserving("neumann1999 §5.2", where="a_s + a_d <= 1"),
        ),
        choices=CHOICES,
        make=make,
        chosen={"fresnel": fresnel},
    )


MODEL = make(fresnel="exact")
