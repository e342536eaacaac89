"""The diffuse part of Disney's principled model: Lambert, darker or brighter towards grazing angles as roughness has it."""

from __future__ import annotations

from functools import cache
from math import pi
from typing import NamedTuple

from albedo_lab.model import Choice, EnergyConserving, Model, Parameter
from albedo_lab.models.lambert import pdf, sample
from albedo_lab.optics.coordinates import Axis, Coordinates
from albedo_lab.optics.frame import Direction, dot
from albedo_lab.optics.profiles import TANGENT
from albedo_lab.sources import burley2012, lagarde2014


class DisneyDiffuse(NamedTuple):
    rho: float
    roughness: float


def shadow(z: float) -> float:
    """(1 - cos)^5."""
    x = 1.0 - z
    xx = x * x
    return xx * xx * x


def burley(p: DisneyDiffuse, wi: Direction, wo: Direction) -> float:
    rise = p.roughness * (1.0 + dot(wi, wo)) - 0.5  # F_D90 - 1, 2 cos^2(theta_d) = 1 + L.V
    return p.rho / pi * (1.0 + rise * shadow(wi.z)) * (1.0 + rise * shadow(wo.z))


def frostbite(p: DisneyDiffuse, wi: Direction, wo: Direction) -> float:
    rise = p.roughness * (1.5 + dot(wi, wo)) - 1.0
    energy = 1.0 - p.roughness * (0.51 / 1.51)
    return p.rho / pi * energy * (1.0 + rise * shadow(wi.z)) * (1.0 + rise * shadow(wo.z))


FORMS = {
    "burley": (
        burley,
        "rho / pi (1 + (F_D90 - 1) (1 - N.L)^5) (1 + (F_D90 - 1) (1 - N.V)^5), F_D90 = 0.5 + 2 roughness cos^2 theta_d",
        burley2012("section 5.3"),
        (),
    ),
    "frostbite": (
        frostbite,
        "rho / pi (1 - roughness + roughness / 1.51) (1 + (F_D90 - 1) (1 - N.L)^5) (1 + (F_D90 - 1) (1 - N.V)^5),"
        " F_D90 = roughness / 2 + 2 roughness cos^2 theta_d",
        lagarde2014("section 3.1.3, Disney's diffuse term renormalised", "roughness is their linearRoughness"),
        (EnergyConserving("lagarde2014 section 3.1.3"),),
    ),
}
CHOICES = (Choice("form", "as Burley published it, or renormalised as in Frostbite", tuple(FORMS), "burley"),)


@cache
def make(*, form: str = "burley") -> Model:
    """Burley's term, or its descendant."""
    evaluate, formula, source, claims = FORMS[form]
    return Model(
        "disney_diffuse",
        formula,
        DisneyDiffuse,
        (
            Parameter("rho", "base colour", default=1.0, low=0.0, high=1.0),
            Parameter("roughness", "artist's roughness", default=0.5, low=0.0, high=1.0),
        ),
        evaluate,
        sample=sample,  # weights are at most 6.25 rho
        pdf=pdf,
        scale=lambda p: 1.0,
        smooth_in=Coordinates(Axis.NORMAL, TANGENT),
        source=source,
        also=() if form == "burley" else (burley2012("section 5.3"),),
        claims=claims,
        choices=CHOICES,
        make=make,
        chosen={"form": form},
    )


MODEL = make(form="burley")
