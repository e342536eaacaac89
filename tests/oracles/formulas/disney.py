"""Disney's principled model of 2012, as its code of that year has it, with tints of 0 and the G of the notes."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from tests.oracles.formulas.pair import Array, Pair

PI = math.pi


def mix(a: Any, b: Any, t: Any) -> Any:
    """a for t = 0, b for t = 1."""
    return a * (1.0 - t) + b * t


def schlick_weight(c: Array | float) -> Array:
    """(1 - c)^5."""
    return np.clip(1.0 - np.asarray(c), 0.0, 1.0) ** 5


def smith(c: Array | float, alpha: float) -> Array:
    """G1 / (2 c)."""
    return 1.0 / (c + np.sqrt(alpha**2 + np.square(c) - (alpha * np.asarray(c)) ** 2))


def amount(p: dict[str, Any], name: str) -> float:
    """A parameter, as it stands when only one lobe is there."""
    alone = {"subsurface": {"subsurface": 1.0}, "metallic": {"metallic": 1.0}}.get(p["lobe"], {})
    return float(alone.get(name, p.get(name, 0.0)))


def base(pair: Pair, p: dict[str, Any]) -> Array:
    """Diffuse, subsurface and sheen."""
    f_l, f_v, u = schlick_weight(pair.light), schlick_weight(pair.view), pair.u
    rough, sub = amount(p, "roughness"), amount(p, "subsurface")
    f_d90, f_ss90 = 0.5 + 2.0 * u**2 * rough, u**2 * rough
    f_d = mix(1.0, f_d90, f_l) * mix(1.0, f_d90, f_v)
    f_ss = mix(1.0, f_ss90, f_l) * mix(1.0, f_ss90, f_v)
    ss = 1.25 * (f_ss * (1.0 / (np.asarray(pair.light) + pair.view) - 0.5) + 0.5)
    value = amount(p, "baseColor") / PI * mix(f_d, ss, sub) + amount(p, "sheen") * schlick_weight(u)
    return value * (1.0 - amount(p, "metallic"))


def alphas(p: dict[str, Any]) -> tuple[float, float]:
    """Widths of the highlight."""
    square, aspect = amount(p, "roughness") ** 2, math.sqrt(1.0 - 0.9 * amount(p, "anisotropic"))
    return max(0.001, square / aspect), max(0.001, square * aspect)


def specular(pair: Pair, p: dict[str, Any]) -> Array:
    """GTR2, anisotropic."""
    (a_x, a_y), a_g = alphas(p), (0.5 + amount(p, "roughness") / 2.0) ** 2
    x, y = pair.h_x / a_x, pair.h_y / a_y
    d = 1.0 / (PI * a_x * a_y * (x**2 + y**2 + pair.t**2) ** 2)
    f = mix(mix(0.08 * amount(p, "specular"), amount(p, "baseColor"), amount(p, "metallic")), 1.0, schlick_weight(pair.u))
    return d * f * smith(pair.light, a_g) * smith(pair.view, a_g)


def clearcoat(pair: Pair, p: dict[str, Any]) -> Array:
    """GTR1."""
    a = mix(0.1, 0.001, amount(p, "clearcoatGloss"))
    sine2 = pair.tan2 * pair.t**2
    d = (a**2 - 1.0) / (PI * math.log(a**2) * (sine2 + (a * pair.t) ** 2))
    f = mix(0.04, 1.0, schlick_weight(pair.u))
    return 0.25 * amount(p, "clearcoat") * d * f * smith(pair.light, 0.25) * smith(pair.view, 0.25)
