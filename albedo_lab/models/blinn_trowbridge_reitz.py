"""Blinn's model with Trowbridge and Reitz's ellipsoids of revolution as facets, hidden in V-cavities."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from math import pi
from typing import NamedTuple

from albedo_lab.model import Choice, Model, Parameter
from albedo_lab.models.cook_torrance import F0, INDEX
from albedo_lab.optics.coordinates import Axis, Coordinates, Kink
from albedo_lab.optics.frame import Direction
from albedo_lab.optics.fresnel import conductor, schlick
from albedo_lab.optics.masking import ggx_lambda
from albedo_lab.optics.microfacet import Normals, reflection, sampling, v_cavity
from albedo_lab.optics.normals import ggx, ggx_slope
from albedo_lab.optics.profiles import TANGENT
from albedo_lab.sources import losasso


class Blinn(NamedTuple):
    c: float
    F0: float = 1.0
    eta: float = 1.0
    k: float = 0.0


# [c^2 / ((N.H)^2 (c^2 - 1) + 1)]^2 / (pi c^2), with (N.H)^2 (c^2 - 1) + 1 = c^2 cos^2 + sin^2: ggx of width c
NORMALS = Normals(
    density=lambda p, v: ggx(p.c, v),
    slope=lambda p, u: ggx_slope(p.c, u),
    smith=lambda p, w: ggx_lambda(p.c, w),
    width=lambda p: p.c,
)
FRESNEL: dict[str, Callable[..., float]] = {
    "one": lambda p, u: 1.0,
    "schlick": lambda p, u: schlick(p.F0, u),
    "exact": lambda p, u: conductor(p.eta, p.k, u),
}


def as_printed_D(p: Blinn, v: Direction) -> float:
    """4 pi c^2 times the normalised D, so that F D G / (4 v v') is F G / (v v') with the D of the print, 1 at its peak."""
    return 4.0 * pi * p.c * p.c * ggx(p.c, v)


CHOICES = (
    Choice("fresnel", "reflectance of the facets: 1, Schlick's approximation, or that of a complex index", tuple(FRESNEL), "one"),
    Choice("as_printed", "with the D of the print, which is 1 at its peak and not normalised", ("no", "yes"), "no"),
)
SHAPE = "[c^2 / ((N.H)^2 (c^2 - 1) + 1)]^2"
NOTES = (
    "f is the printed intensity over N.L, as for Cook-Torrance; attenuation with distance is left out",
    "F as it should be: the misprints of the appendix are members of cook_torrance",
)


def widths(p: Blinn) -> tuple[float, float]:
    return p.c, p.c


@cache
def make(*, fresnel: str, as_printed: str) -> Model:
    """One reflectance of the facets, with a normalised or the printed D."""
    printed = as_printed == "yes"
    sample, pdf = sampling(NORMALS, "v_cavity")
    evaluated = Normals(as_printed_D, NORMALS.slope, NORMALS.smith, NORMALS.width) if printed else NORMALS
    notes = NOTES if printed else ("D over 4 pi c^2, which normalises it", *NOTES)
    return Model(
        "blinn_trowbridge_reitz",
        f"{SHAPE} F G / (N.L N.V)" if printed else f"{SHAPE} / (pi c^2) F G / (4 N.L N.V)",
        Blinn,
        (
            Parameter("c", "eccentricity of the facets: 0 very shiny, 1 very dull", default=0.1, low=1e-3, high=1.0, scale="log"),
            *{"one": (), "schlick": (F0,), "exact": INDEX}[fresnel],
        ),
        reflection(evaluated, v_cavity(evaluated), FRESNEL[fresnel]),
        sample=sample,
        pdf=pdf,
        scale=lambda p: 1.0,
        scale_symbol="k_s",
        smooth_in=Coordinates(Axis.HALF, TANGENT, ellipse=widths, kink=Kink.V_CAVITY),
        source=losasso("The Blinn Lighting Model", *notes),
        choices=CHOICES,
        make=make,
        chosen={"fresnel": fresnel, "as_printed": as_printed},
    )


MODEL = make(fresnel="one", as_printed="no")
