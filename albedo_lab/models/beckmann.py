"""Beckmann: facets with Gaussian slopes, Smith's masking, and samples of the facets that the viewer sees, their density exact."""

from __future__ import annotations

from functools import cache
from typing import NamedTuple

from albedo_lab.model import EnergyConserving, Model, Reciprocal
from albedo_lab.models.ggx import DEVIATIONS, MASKING, REFLECTANCE, roughness, widths
from albedo_lab.models.microfacet import FRESNEL
from albedo_lab.optics.coordinates import Axis, Coordinates
from albedo_lab.optics.frame import Direction
from albedo_lab.optics.masking import beckmann_lambda, stretched
from albedo_lab.optics.microfacet import (
    GEOMETRIES,
    Normals,
    beckmann_visible,
    elliptic_visible,
    reflection,
    smith_sampling,
    smith_weight,
)
from albedo_lab.optics.normals import beckmann_elliptic, beckmann_slope
from albedo_lab.optics.profiles import GAUSS
from albedo_lab.sources import heitz2014, walter2007


class Beckmann(NamedTuple):
    """What the reflectance chosen does not use is 0."""

    alpha_x: float
    alpha_y: float
    F0: float = 0.0
    eta: float = 0.0
    k: float = 0.0


def D(p: Beckmann, v: Direction) -> float:
    return beckmann_elliptic(p.alpha_x, p.alpha_y, v)  # Walter et al. eq. 25, stretched


def Lambda(p: Beckmann, w: Direction) -> float:
    return beckmann_lambda(1.0, stretched(p.alpha_x, p.alpha_y, w))  # Walter et al. eq. 26, stretched: Heitz eq. 80


def visible(p: Beckmann, wo: Direction, u1: float, u2: float) -> Direction:
    return elliptic_visible(beckmann_visible, p.alpha_x, p.alpha_y, wo, u1, u2)


NORMALS = Normals(D, slope=lambda p, u: beckmann_slope(1.0, u), smith=Lambda, width=lambda p: 1.0)
"""Slope and width are those of the surface stretched to width 1."""
WIDTHS = roughness(1e-5, "RMS slope")
CHOICES = (MASKING, REFLECTANCE)


@cache
def make(*, G: str, F: str) -> Model:
    """One masking, one reflectance."""
    masking, (reflectance, indices) = GEOMETRIES[G](NORMALS), FRESNEL[F]
    sample, pdf = smith_sampling(NORMALS, visible)
    return Model(
        "beckmann",
        "exp(-tan^2 delta (cos^2 phi / alpha_x^2 + sin^2 phi / alpha_y^2)) / (pi alpha_x alpha_y cos^4 delta) F G / (4 N.L N.V)",
        Beckmann,
        (*WIDTHS, *indices),
        reflection(NORMALS, masking, reflectance),
        sample=sample,
        pdf=pdf,
        weight=smith_weight(NORMALS, masking, reflectance, sample),
        scale=lambda p: 1.0,
        smooth_in=Coordinates(Axis.HALF, GAUSS, ellipse=widths),
        isotropic=lambda p: p.alpha_x == p.alpha_y,
        mirror_limit=("alpha", reflectance),
        source=walter2007("eq. 20, 25, 26", *DEVIATIONS[G]),
        also=(heitz2014("eq. 80" if G == "smith" else "eq. 80, 99"),),
        claims=(Reciprocal("Walter et al. 2007"), EnergyConserving("Heitz 2014")),
        choices=CHOICES,
        make=make,
        chosen={"G": G, "F": F},
    )


MODEL = make(G="smith_correlated", F="one")
