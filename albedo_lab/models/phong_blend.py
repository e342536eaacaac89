"""Phong blend: Schlick's reading of Phong and Blinn, a constant and a cosine power of the half-vector's angle in fixed shares."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from functools import cache
from math import exp2, pi
from typing import NamedTuple

from albedo_lab.model import Choice, Model, Parameter
from albedo_lab.models.blinn import MODEL as BLINN
from albedo_lab.models.lambert import MODEL as LAMBERT
from albedo_lab.optics.frame import Direction, bisector, normal_power, reflect
from albedo_lab.optics.lobes import power_normal_pdf, sample_cosine, sample_power_normal
from albedo_lab.sources import neumann1999, schlick1993


class PhongBlend(NamedTuple):
    d: float
    D: float
    S: float
    n: float
    diffuse: float
    """The constant term."""
    specular: float
    """What multiplies the cosine power."""
    branch: float
    """The share of samples that go by the cosine power: that of its term in the albedo at normal incidence."""


def diffuse(p: PhongBlend, wi: Direction, wo: Direction) -> float:
    return p.diffuse


def specular(p: PhongBlend, wi: Direction, wo: Direction) -> float:
    return p.specular * normal_power(bisector(wi, wo), p.n)


def evaluate(p: PhongBlend, wi: Direction, wo: Direction) -> float:
    return diffuse(p, wi, wo) + specular(p, wi, wo)  # eq. 4


def sample(p: PhongBlend, wo: Direction, u1: float, u2: float) -> Direction:
    if u1 < p.branch:
        return reflect(wo, sample_power_normal(p.n, u1 / p.branch, u2))
    return sample_cosine((u1 - p.branch) / (1.0 - p.branch), u2)


def pdf(p: PhongBlend, wi: Direction, wo: Direction) -> float:
    return p.branch * power_normal_pdf(bisector(wi, wo), p.n) + (1.0 - p.branch) * wi.z / pi


def largest_constant(n: float) -> float:
    """(n+2) (n+4) / (8 pi (2^(-n/2) + n)): with it the albedo of (N.H)^n is 1 at normal incidence, its largest for n >= 1."""
    return (n + 2.0) * (n + 4.0) / (8.0 * pi * (exp2(-0.5 * n) + n))


def from_albedos(white: float, mirror: float, d: float, D: float, S: float, n: float) -> PhongBlend:
    """The terms d D and (1-d) S times the constants given; `branch` from the albedos that they then have."""
    constant, lobe = d * D * white, (1.0 - d) * S * mirror
    matt, shiny = pi * constant, lobe / largest_constant(n)
    return PhongBlend(d, D, S, n, constant, lobe, shiny / (matt + shiny) if shiny > 0.0 else 0.0)


def complete(numbers: Mapping[str, float]) -> PhongBlend:
    return from_albedos(1.0 / pi, largest_constant(numbers["n"]), **numbers)


def complete_printed(numbers: Mapping[str, float]) -> PhongBlend:
    return from_albedos(1.0, 1.0, **numbers)


DIFFUSE = replace(LAMBERT, parameters_type=PhongBlend, evaluate=diffuse)
SPECULAR = replace(BLINN, parameters_type=PhongBlend, evaluate=specular)


def parts(p: PhongBlend) -> tuple[tuple[Model, PhongBlend], ...]:
    return (DIFFUSE, p), (SPECULAR, p)


PARAMETERS = (
    Parameter("d", "share of the surface that reflects diffusely; the rest is specular", default=0.5, low=0.0, high=1.0),
    Parameter("D", "share of the light that the diffuse reflector reflects", default=1.0, low=0.0, high=1.0),
    Parameter("S", "share of the light that the specular reflector reflects", default=1.0, low=0.0, high=1.0),
    Parameter("n", "exponent of the lobe", default=100.0, low=1.0, high=1e8, scale="log"),
)
DEVIATIONS = (
    "D / pi for the printed D, which is the share of light reflected only with 1/pi, as in eq. 5 and 8",
    "(N.H)^n carries the constant that makes it reflect the share S at normal incidence",
)
CHOICES = (Choice("as_printed", "both terms without the constants that normalise them", options=("no", "yes"), default="no"),)


@cache
def make(*, as_printed: str = "no") -> Model:
    """The model as Schlick defines its parameters, or as he prints it."""
    printed = as_printed == "yes"
    return Model(
        "phong_blend",
        "d D + (1-d) S (N.H)^n" if printed else "d D / pi + (1-d) S (n+2) (n+4) / (8 pi (2^(-n/2) + n)) (N.H)^n",
        PhongBlend,
        PARAMETERS,
        evaluate,
        sample=sample,
        pdf=pdf,
        scale=lambda p: 1.0,
        complete=complete_printed if printed else complete,
        smooth_in=SPECULAR.smooth_in,
        parts=parts,
        source=schlick1993("eq. 4", *(() if printed else DEVIATIONS)),
        also=() if printed else (neumann1999("eq. 31; table 2 holds the constant of (N.H)^n"),),
        choices=CHOICES,
        make=make,
        chosen={"as_printed": as_printed},
    )


MODEL = make(as_printed="no")
