"""Models of the form F G D / (4 v v'), and the printed variants of losasso and schlick1993."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from scipy.special import erfc

from tests.oracles.formulas import facets
from tests.oracles.formulas.fresnel import losasso_cheap, losasso_exact, reflectance
from tests.oracles.formulas.pair import Array, Pair

PI = math.pi


def microfacet(pair: Pair, p: dict[str, Any]) -> Array:
    """nuaj_models eq. 4, with its diffuse part."""
    f = reflectance(p["F"], pair.u, p)
    d = facets.distribution(p["D"], p, pair.t, pair.tan2, p["as_printed"])
    g = facets.geometry(p["G"], p["D"], p, pair)
    value = f * g * d / (4.0 * pair.light * pair.view)
    if p["diffuse"] == "none":
        return value
    weight = np.ones_like(f) if p["diffuse"] == "lambert" else 1.0 - f
    if p["diffuse"] == "refracted":
        if p["F"] == "schlick":
            root = math.sqrt(p["F0"])
            eta = (1.0 + root) / (1.0 - root)
        else:
            eta = p.get("eta", 1.0)  # F = one: the weight 1 - F is 0 anyway
        weight = weight / eta**2
    return value + p["a_d"] / PI * weight


def elliptic(d_kind: str, pair: Pair, p: dict[str, Any]) -> Array:
    """`ggx` and `beckmann`: F D G2 / (4 v v') with a width of its own along x and y, D and Lambda as in Heitz 2014.

    D = P22(slopes) / t^4 with the slopes over their widths; Lambda is the isotropic one of the width that the direction meets.
    """
    a_x, a_y = p["alpha_x"], p["alpha_y"]
    squared = pair.tan2 * ((np.cos(pair.azimuth) / a_x) ** 2 + (np.sin(pair.azimuth) / a_y) ** 2)
    p22 = np.exp(-squared) if d_kind == "beckmann" else (1.0 + squared) ** -2
    d = p22 / (PI * a_x * a_y) * (1.0 + pair.tan2) ** 2
    hidden = []
    for c, (x, y) in zip((pair.light, pair.view), pair.horizontal(), strict=True):
        slope = np.hypot(a_x * x, a_y * y) / c  # alpha_o tan(theta)
        if d_kind == "ggx":
            hidden.append(0.5 * slope**2 / (np.sqrt(1.0 + slope**2) + 1.0))
        else:
            a = 1.0 / np.maximum(slope, 1e-3)
            hidden.append(np.where(slope > 1e-3, 0.5 * (np.exp(-a * a) / (a * math.sqrt(PI)) - erfc(a)), 0.0))
    light, view = hidden
    g = 1.0 / ((1.0 + light) * (1.0 + view)) if p["G"] == "smith" else 1.0 / (1.0 + light + view)
    return reflectance(p["F"], pair.u, p) * d * g / (4.0 * pair.light * pair.view)


def ggx(pair: Pair, p: dict[str, Any]) -> Array:
    """Walter et al. 2007, Heitz 2014."""
    return elliptic("ggx", pair, p)


def beckmann(pair: Pair, p: dict[str, Any]) -> Array:
    """The same with Beckmann's D."""
    return elliptic("beckmann", pair, p)


def cook_torrance(pair: Pair, p: dict[str, Any]) -> Array:
    """Beckmann D; as_printed: no, losasso (rho with its 4 in D and its Fresnel), schlick1993 (eq. 5-7, d = 0, s = 1)."""
    m = p["m"]
    gauss = np.exp(-pair.tan2 / m**2)
    if p["as_printed"] == "losasso":
        d = gauss / (4.0 * m * m * pair.t**4)
        if p["fresnel"] == "exact":
            f = losasso_exact(pair.u, p["eta"])
        elif p["fresnel"] == "schlick":
            f = losasso_cheap(pair.view, p["F0"])
        else:
            f = 1.0
        return d * facets.geometry(p["geometry"], "beckmann", p, pair) * f / (PI * pair.light * pair.view)
    f = reflectance(p["fresnel"], pair.u, p)
    if p["as_printed"] == "schlick1993":
        d = gauss / (m * m * pair.t**4)
        if p["geometry"] == "smith":
            g = schlick_smith(pair.light, m) * schlick_smith(pair.view, m)
        else:
            g = facets.geometry(p["geometry"], "beckmann", p, pair)
        return d * f * g / (4.0 * PI * pair.light * pair.view)
    d = gauss / (PI * m * m * pair.t**4)
    return d * f * facets.geometry(p["geometry"], "beckmann", p, pair) / (4.0 * pair.light * pair.view)


def schlick_smith(v: Array | float, m: float) -> Array:
    """schlick1993 eq. 7 as printed: g = sqrt(h pi)(2 - erfc sqrt(h)), h = v^2/(2 m^2 (1 - v^2)), G = g/(g + 1).

    Written g/(g + 1) = 1/(1 + 1/g), so that v = 1 (h infinite) gives 1.
    """
    inverse_root_h = math.sqrt(2.0) * m * facets.tangent(v)
    with np.errstate(divide="ignore"):
        root_h = 1.0 / inverse_root_h
    return 1.0 / (1.0 + inverse_root_h / (math.sqrt(PI) * (2.0 - erfc(root_h))))


def blinn_trowbridge_reitz(pair: Pair, p: dict[str, Any]) -> Array:
    """losasso, "The Blinn Lighting Model"; as_printed = yes lacks the 1/(4 pi c^2)."""
    c2 = p["c"] ** 2
    d = (c2 * (1.0 + pair.tan2) / (c2 + pair.tan2)) ** 2  # t^2 (c^2 - 1) + 1 = t^2 (c^2 + tan^2)
    f = reflectance(p["fresnel"], pair.u, p)
    value = d * facets.v_cavity(pair) * f / (pair.light * pair.view)
    return value if p["as_printed"] == "yes" else value / (4.0 * PI * c2)
