"""Sick models whose f is wrong: energy, reciprocity, positivity, finiteness.

All but the sampling of what changes is left healthy; a `weight` reduced by hand is dropped where it would no longer belong to f.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from math import inf, nan, pi, sqrt
from typing import Any

import numpy as np

from albedo_lab.model import Reciprocal
from albedo_lab.models.cook_torrance import MODEL as COOK_TORRANCE
from albedo_lab.models.lambert import MODEL as LAMBERT
from albedo_lab.models.microfacet import MODEL as GGX
from albedo_lab.models.mirror import MODEL as MIRROR
from albedo_lab.models.phong import MODEL as PHONG
from albedo_lab.models.phong import evaluate as phong
from albedo_lab.models.phong import largest_constant
from albedo_lab.models.phong_blend import MODEL as PHONG_BLEND
from albedo_lab.models.phong_original import MODEL as PHONG_ORIGINAL
from albedo_lab.models.stretched_phong import MODEL as STRETCHED_PHONG
from albedo_lab.models.stretched_phong import evaluate as stretched_phong
from albedo_lab.optics.frame import Direction, bisector, cosine_power, dot, length, mirror_of
from albedo_lab.optics.masking import v_cavity_factor
from albedo_lab.optics.maths import exp
from albedo_lab.optics.normals import beckmann, ggx
from tests.controls.record import Sick

cook_torrance: Callable[..., float] = COOK_TORRANCE.evaluate
N20 = {"n": 20.0}


def scaled(p: Any) -> float:
    return 1.001


def scaled_lobe(p: Any) -> float:
    return 1.001 * largest_constant(p)


def anisotropic(p: Any) -> bool:
    return False


# Energy


def without_one_over_pi(p: Any, wi: Direction, wo: Direction) -> float:
    return float(p.albedo)


def over_smaller_cosine(p: Any, wi: Direction, wo: Direction) -> float:
    return cosine_power(mirror_of(wo), wi, p.n) / min(wi.z, wo.z)


def facets_without_masking(p: Any, wi: Direction, wo: Direction) -> float:
    return beckmann(p.m, bisector(wi, wo)) / (4.0 * wi.z * wo.z)


def cavities_by_larger_cosine(p: Any, wi: Direction, wo: Direction) -> float:
    v = bisector(wi, wo)
    return beckmann(p.m, v) * min(1.0, 4.0 * v.z * max(wi.z, wo.z) / dot(v, v)) / (4.0 * wi.z * wo.z)


def facets_without_pi(p: Any, wi: Direction, wo: Direction) -> float:
    return pi * cook_torrance(p, wi, wo)


def ggx_of_squared_width(p: Any, wi: Direction, wo: Direction) -> float:
    """The constant alpha for alpha^2 in D: not normalised."""
    v = bisector(wi, wo)
    return ggx(p.alpha, v) / float(p.alpha) * v_cavity_factor(v, wi, wo) / (4.0 * wi.z * wo.z)


def brighter_than_one(p: Any, wi: Direction, wo: Direction) -> float:
    x = 1.0 - 0.5 * length(bisector(wi, wo))
    return cook_torrance(p, wi, wo) * (1.2 - 0.2 * x * x * x * x * x)


def misprinted_fresnel(p: Any, wi: Direction, wo: Direction) -> float:
    """(1 - x) + n x with x = (1 - c)^5, for F0 + (1 - F0) x."""
    x = 1.0 - 0.5 * length(bisector(wi, wo))
    x = x * x * x * x * x
    return cook_torrance(p, wi, wo) * ((1.0 - x) + 1.5 * x)


def unshared(p: Any, wi: Direction, wo: Direction) -> float:
    return 0.5 / pi + largest_constant(p) * stretched_phong(p, wi, wo)


def one_over_cosine(p: Any, wi: Direction, wo: Direction) -> float:
    return (0.5 + 0.001 / wi.z + 0.001 / wo.z) / pi


def bright_band(p: Any, wi: Direction, wo: Direction) -> float:
    """Brighter about 60 degrees, within 1.3 degrees."""
    a, b = (wi.z - 0.5) / 0.02, (wo.z - 0.5) / 0.02
    return (0.9 + 0.2 * exp(-a * a) + 0.2 * exp(-b * b)) / pi


def bright_across(p: Any, wi: Direction, wo: Direction) -> float:
    """Albedo 0.8 in the plane y = 0, and up to 1.3 across it."""
    return (0.8 + 2.0 * wi.y * wi.y * wo.y * wo.y) / pi


def mirror_above_one(p: Any, mu: float) -> float:
    return 1.001 * float(p.F)


def mirror_at_grazing(p: Any, mu: float) -> float:
    x = 1.0 - mu
    return 0.5 + 0.5 * x * x * x * x * x


ENERGY = (
    Sick("lambert_no_pi", "1/pi missing", replace(LAMBERT, evaluate=without_one_over_pi), ("energy", "claims")),
    Sick("lambert_1001", "scaled by 1.001", replace(LAMBERT, scale=scaled), ("energy", "claims")),
    Sick("stretched_phong_1001", "scaled by 1.001", replace(STRETCHED_PHONG, scale=scaled_lobe), ("energy", "claims"), N20),
    Sick("cook_torrance_1001", "scaled by 1.001", replace(COOK_TORRANCE, scale=scaled), ("energy", "claims")),
    Sick("phong_blend_1001", "scaled by 1.001", replace(PHONG_BLEND, scale=scaled), ("energy",)),
    Sick(
        "stretched_phong_min",
        "min(N.L, N.V) for max",
        replace(STRETCHED_PHONG, evaluate=over_smaller_cosine, weight=None),
        ("energy", "claims"),
        N20,
    ),
    Sick("cook_torrance_no_G", "G forgotten", replace(COOK_TORRANCE, evaluate=facets_without_masking), ("energy",), {"m": 0.3}),
    Sick(
        "cook_torrance_max",
        "V-cavity by the larger cosine",
        replace(COOK_TORRANCE, evaluate=cavities_by_larger_cosine),
        ("energy",),
        {"m": 0.3},
    ),
    Sick("cook_torrance_no_pi", "1/pi of D missing", replace(COOK_TORRANCE, evaluate=facets_without_pi), ("energy",)),
    Sick("ggx_alpha_in_D", "alpha for alpha^2 in D", replace(GGX, evaluate=ggx_of_squared_width), ("energy",), {"alpha": 0.3}),
    Sick("fresnel_above_1", "F of 1.2 at normal incidence", replace(COOK_TORRANCE, evaluate=brighter_than_one), ("energy",)),
    Sick(
        "fresnel_misprint",
        "Schlick's F as (1-x) + n x, n = 1.5",
        replace(COOK_TORRANCE, evaluate=misprinted_fresnel),
        ("energy",),
        {"m": 0.05},
    ),
    Sick(
        "unshared",
        "diffuse 0.5 added to a full lobe",
        replace(STRETCHED_PHONG, evaluate=unshared, scale=lambda p: 1.0, weight=None),
        ("energy",),
        N20,
    ),
    Sick("one_over_mu", "0.001 (1/N.L + 1/N.V) added", replace(LAMBERT, evaluate=one_over_cosine), ("energy",)),
    Sick("bright_band", "albedo 1.1 within 1.3 degrees about 60", replace(LAMBERT, evaluate=bright_band), ("energy",)),
    Sick(
        "bright_across",
        "albedo 1.3 across the plane y = 0, declared isotropic",
        replace(LAMBERT, evaluate=bright_across),
        ("energy",),
    ),
    Sick("mirror_1001", "Dirac part scaled by 1.001", replace(MIRROR, mirror=mirror_above_one), ("energy",)),
    Sick(
        "mirror_on_lambert",
        "a mirror over a white diffuse body",
        replace(LAMBERT, mirror=mirror_at_grazing),
        ("energy", "claims"),
    ),
)


# Reciprocity


def over_own_cosine(p: Any, wi: Direction, wo: Direction) -> float:
    return cosine_power(mirror_of(wo), wi, p.n) / wo.z


def facets_over_square(p: Any, wi: Direction, wo: Direction) -> float:
    return cook_torrance(p, wi, wo) * wo.z / wi.z


def fresnel_of_viewer(p: Any, wi: Direction, wo: Direction) -> float:
    x = 1.0 - wo.z
    return cook_torrance(p, wi, wo) * (0.5 + 0.5 * x * x * x * x * x)


def one_sided(p: Any, wi: Direction, wo: Direction) -> float:
    return 1.0 / pi if wi.y > 0.0 else 0.5 / pi


def a_millionth_askew(p: Any, wi: Direction, wo: Direction) -> float:
    return (0.5 + 1e-6 * wi.z) / pi


def askew_at_grazing(p: Any, wi: Direction, wo: Direction) -> float:
    return 0.5 / pi if wi.z > 1e-6 else 0.4 / pi


def viewer_in_float32(p: Any, wi: Direction, wo: Direction) -> float:
    """The viewer read from single precision, the light from double."""
    w = Direction(float(np.float32(wo.x)), float(np.float32(wo.y)), float(np.float32(wo.z)))
    return cosine_power(mirror_of(w), wi, p.n)


def masked_once(p: Any, wi: Direction, wo: Direction) -> float:
    v = bisector(wi, wo)
    return beckmann(p.m, v) * min(1.0, 4.0 * v.z * wo.z / dot(v, v)) / (4.0 * wi.z * wo.z)


RECIPROCITY = (
    Sick(
        "stretched_phong_wo",
        "N.V for max(N.L, N.V)",
        replace(STRETCHED_PHONG, evaluate=over_own_cosine, weight=None),
        ("reciprocity", "claims"),
        N20,
    ),
    Sick(
        "phong_original_claims",
        "an irreciprocal model that claims to be reciprocal",
        replace(PHONG_ORIGINAL, reciprocal=True, claims=(Reciprocal("nowhere"),)),
        ("reciprocity", "claims"),
        N20,
    ),
    Sick("cook_torrance_square", "N.L^2 for N.L N.V", replace(COOK_TORRANCE, evaluate=facets_over_square), ("reciprocity",)),
    Sick("fresnel_of_N_V", "F of N.V for L.H", replace(COOK_TORRANCE, evaluate=fresnel_of_viewer), ("reciprocity",)),
    Sick("masked_once", "G of the viewer alone", replace(COOK_TORRANCE, evaluate=masked_once), ("reciprocity",), {"m": 0.3}),
    Sick(
        "one_sided",
        "half as bright for wi.y < 0, whatever wo",
        replace(LAMBERT, evaluate=one_sided, isotropic=anisotropic),
        ("reciprocity", "claims"),
    ),
    Sick("askew_1e-6", "f depends on N.L, by 2 millionths", replace(LAMBERT, evaluate=a_millionth_askew), ("reciprocity",)),
    Sick("askew_at_grazing", "darker where N.L < 1e-6", replace(LAMBERT, evaluate=askew_at_grazing), ("reciprocity",)),
    Sick("float32_viewer", "wo rounded to float32 in f", replace(PHONG, evaluate=viewer_in_float32), ("reciprocity",)),
)


# Positivity


def negative_lobe(p: Any, wi: Direction, wo: Direction) -> float:
    return 0.5 / pi - 0.5 * cosine_power(mirror_of(wo), wi, 50.0)


def negative_spike(p: Any, wi: Direction, wo: Direction) -> float:
    return 0.5 / pi - cosine_power(wo, wi, 1e6)


def negative_at_grazing(p: Any, wi: Direction, wo: Direction) -> float:
    return 0.5 / pi * (1.0 - 2e-9 / (1e-9 + wi.z * wo.z))


def below_zero_off_the_lobe(p: Any, wi: Direction, wo: Direction) -> float:
    return phong(p, wi, wo) - 1e-12


def negative_band(p: Any, wi: Direction, wo: Direction) -> float:
    """Where both directions are 45 degrees from the normal, within a fifth of a degree."""
    return 0.5 / pi if max(abs(wi.z - 0.707), abs(wo.z - 0.707)) > 0.0025 else -0.1


def negative_mirror(p: Any, mu: float) -> float:
    return mu - 0.1


POSITIVITY = (
    Sick("negative_lobe", "a lobe of exponent 50 taken away", replace(LAMBERT, evaluate=negative_lobe), ("positivity",)),
    Sick("negative_spike", "a retro lobe of exponent 1e6 taken away", replace(LAMBERT, evaluate=negative_spike), ("positivity",)),
    Sick("negative_at_grazing", "below 0 where N.L N.V < 1e-9", replace(LAMBERT, evaluate=negative_at_grazing), ("positivity",)),
    Sick("below_zero", "1e-12 taken away", replace(PHONG, evaluate=below_zero_off_the_lobe), ("positivity",), N20),
    Sick("negative_band", "below 0 at 45 degrees, within 0.2", replace(LAMBERT, evaluate=negative_band), ("positivity",)),
    Sick("negative_mirror", "Dirac part N.V - 0.1", replace(MIRROR, mirror=negative_mirror), ("positivity",)),
)


# Finiteness


def nan_at_grazing(p: Any, wi: Direction, wo: Direction) -> float:
    return 0.5 / pi if min(wi.z, wo.z) >= 1e-6 else nan


def nan_at_normal(p: Any, wi: Direction, wo: Direction) -> float:
    """The cosine of the azimuth is 0/0 at the normal."""
    si, so = sqrt(wi.x * wi.x + wi.y * wi.y), sqrt(wo.x * wo.x + wo.y * wo.y)
    cos_phi = (wi.x * wo.x + wi.y * wo.y) / (si * so)
    return (0.5 + 0.25 * cos_phi * si * so) / pi


def inf_at_mirror(p: Any, wi: Direction, wo: Direction) -> float:
    r = mirror_of(wo)
    x, y, z = wi.x - r.x, wi.y - r.y, wi.z - r.z
    distance = sqrt(x * x + y * y + z * z)
    return 0.1 / pi + 0.001 / distance if distance > 0.0 else inf


def nan_at_retro(p: Any, wi: Direction, wo: Direction) -> float:
    x, y, z = wi.x - wo.x, wi.y - wo.y, wi.z - wo.z
    d = x * x + y * y + z * z
    return (0.5 + 0.25 * x * x / d) / pi


def overflow_at_grazing(p: Any, wi: Direction, wo: Direction) -> float:
    return 0.5 / pi * exp(1e-17 / (wi.z * wo.z))


def nan_in_a_cone(p: Any, wi: Direction, wo: Direction) -> float:
    """A hole of half a degree in a table, off every axis."""
    return 0.5 / pi if dot(Direction(0.36, 0.48, 0.8), wi) < 0.99996 else nan


def nan_mirror(p: Any, mu: float) -> float:
    return 0.5 if mu > 1e-6 else nan


FINITENESS = (
    Sick("nan_at_grazing", "NaN where a cosine is below 1e-6", replace(LAMBERT, evaluate=nan_at_grazing), ("finiteness",)),
    Sick("nan_at_normal", "0/0 at normal incidence exactly", replace(LAMBERT, evaluate=nan_at_normal), ("finiteness",)),
    Sick("inf_at_mirror", "1/0 at the mirror direction exactly", replace(LAMBERT, evaluate=inf_at_mirror), ("finiteness",)),
    Sick("nan_at_retro", "0/0 where L = V exactly", replace(LAMBERT, evaluate=nan_at_retro), ("finiteness",)),
    Sick("overflow", "exp(1e-17 / (N.L N.V))", replace(LAMBERT, evaluate=overflow_at_grazing), ("finiteness",)),
    Sick("nan_in_a_cone", "NaN for wi in a cone of 0.5 degrees", replace(LAMBERT, evaluate=nan_in_a_cone), ("finiteness",)),
    Sick("nan_mirror", "Dirac part NaN where N.V < 1e-6", replace(MIRROR, mirror=nan_mirror), ("finiteness",)),
)

VALUES = (*ENERGY, *RECIPROCITY, *POSITIVITY, *FINITENESS)
