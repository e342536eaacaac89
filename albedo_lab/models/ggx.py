"""GGX: Trowbridge and Reitz's facets under their usual name, Smith's masking, and samples of the facets that the viewer sees."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from typing import Any, NamedTuple

from albedo_lab.model import Choice, EnergyConserving, Model, Parameter, Reciprocal
from albedo_lab.models.microfacet import FRESNEL
from albedo_lab.optics.coordinates import Axis, Coordinates
from albedo_lab.optics.frame import Direction
from albedo_lab.optics.masking import ggx_lambda, stretched
from albedo_lab.optics.microfacet import (
    GEOMETRIES,
    Normals,
    elliptic_visible,
    ggx_visible,
    ggx_visible_by_disk,
    reflection,
    smith_sampling,
    smith_weight,
)
from albedo_lab.optics.normals import ggx_elliptic, ggx_slope
from albedo_lab.optics.profiles import TAIL
from albedo_lab.sources import dupuy2023, heitz2014, heitz2018, walter2007


class GGX(NamedTuple):
    """What the reflectance chosen does not use is 0."""

    alpha_x: float
    alpha_y: float
    F0: float = 0.0
    eta: float = 0.0
    k: float = 0.0


def D(p: GGX, v: Direction) -> float:
    return ggx_elliptic(p.alpha_x, p.alpha_y, v)  # Walter et al. eq. 33, stretched


def Lambda(p: GGX, w: Direction) -> float:
    return ggx_lambda(1.0, stretched(p.alpha_x, p.alpha_y, w))  # Heitz eq. 86


def by_caps(p: GGX, wo: Direction, u1: float, u2: float) -> Direction:
    return elliptic_visible(ggx_visible, p.alpha_x, p.alpha_y, wo, u1, u2)


def by_disk(p: GGX, wo: Direction, u1: float, u2: float) -> Direction:
    return elliptic_visible(ggx_visible_by_disk, p.alpha_x, p.alpha_y, wo, u1, u2)


NORMALS = Normals(D, slope=lambda p, u: ggx_slope(1.0, u), smith=Lambda, width=lambda p: 1.0)
"""Slope and width are those of the surface stretched to width 1."""
VISIBLE: dict[str, Callable[..., Direction]] = {"caps": by_caps, "heitz2018": by_disk}


def widths(p: Any) -> tuple[float, float]:
    return p.alpha_x, p.alpha_y


def roughness(low: float, meaning: str) -> tuple[Parameter, ...]:
    """alpha, and alpha_x and alpha_y where they differ."""
    return (
        Parameter("alpha", f"{meaning}, the same in x and y", 0.1, low, 1.0, scale="log", sets=("alpha_x", "alpha_y")),
        Parameter("alpha_x", f"{meaning} along x", 0.1, low, 1.0, scale="log"),
        Parameter("alpha_y", f"{meaning} along y", 0.1, low, 1.0, scale="log"),
    )


WIDTHS = roughness(1e-5, "roughness")
MASKING = Choice(
    "G",
    "how Smith's masking hides facets from both directions: independently, or by the same height of the facet",
    ("smith", "smith_correlated"),
    "smith_correlated",
)
DEVIATIONS = {"smith": (), "smith_correlated": ("both directions are hidden by the same height of the facet (Heitz eq. 99)",)}
REFLECTANCE = Choice("F", "reflectance of the facets", tuple(FRESNEL), "one")
CHOICES = (
    MASKING,
    REFLECTANCE,
    Choice(
        "sampling",
        "how visible normals are drawn, with the same density: by spherical caps, or by the projected half sphere",
        tuple(VISIBLE),
        "caps",
    ),
)


@cache
def make(*, G: str, F: str, sampling: str) -> Model:
    """One masking, one reflectance, one way to draw the same samples."""
    masking, (reflectance, indices) = GEOMETRIES[G](NORMALS), FRESNEL[F]
    sample, pdf = smith_sampling(NORMALS, VISIBLE[sampling])
    return Model(
        "ggx",
        "F G / (4 N.L N.V) / (pi alpha_x alpha_y ((H.X / alpha_x)^2 + (H.Y / alpha_y)^2 + (H.N)^2)^2)",
        GGX,
        (*WIDTHS, *indices),
        reflection(NORMALS, masking, reflectance),
        sample=sample,
        pdf=pdf,
        weight=smith_weight(NORMALS, masking, reflectance, sample),
        scale=lambda p: 1.0,
        smooth_in=Coordinates(Axis.HALF, TAIL, ellipse=widths),
        isotropic=lambda p: p.alpha_x == p.alpha_y,
        mirror_limit=("alpha", reflectance),
        source=walter2007("eq. 20, 33, 34", *DEVIATIONS[G]),
        also=(
            heitz2014("eq. 80, 86" if G == "smith" else "eq. 80, 86, 99"),
            dupuy2023("visible normals") if sampling == "caps" else heitz2018("visible normals"),
        ),
        claims=(Reciprocal("Walter et al. 2007"), EnergyConserving("Heitz 2014")),
        choices=CHOICES,
        make=make,
        chosen={"G": G, "F": F, "sampling": sampling},
    )


MODEL = make(G="smith_correlated", F="one", sampling="caps")
