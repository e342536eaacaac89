"""Charlie, the sheen of Estevez and Kulla 2017: f = D G / (4 v v')."""

from __future__ import annotations

from typing import Any

import numpy as np

from tests.oracles.formulas.pair import Array, Pair

FIT = {
    "a": (25.3245, 21.5473),
    "b": (3.32435, 3.82987),
    "c": (0.16801, 0.19823),
    "d": (-1.27393, -1.97760),
    "e": (-4.85967, -4.32054),
}
"""Table 1: for r = 0 and r = 1."""


def masking(cosine: Array | float, r: float) -> Array:
    """The logarithm of the fitted Lambda, point-symmetric about the cosine 1/2."""
    k = {name: rough + (smooth - rough) * (1.0 - r) ** 2 for name, (smooth, rough) in FIT.items()}

    def curve(x: Array) -> Array:
        return k["a"] / (1.0 + k["b"] * x ** k["c"]) + k["d"] * x + k["e"]

    c = np.asarray(cosine, dtype=float)
    lower = curve(np.minimum(c, 0.5))
    upper = 2.0 * curve(np.array(0.5)) - curve(np.clip(1.0 - c, 0.0, 0.5))
    return np.where(c < 0.5, lower, upper)


def charlie(pair: Pair, p: dict[str, Any]) -> Array:
    """D of eq. 2 with the visibility chosen."""
    r, light, view = p["r"], np.asarray(pair.light), np.asarray(pair.view)
    sine = np.sqrt(pair.tan2 / (1.0 + pair.tan2))
    d = (2.0 + 1.0 / r) * sine ** (1.0 / r) / (2.0 * np.pi)
    if p["visibility"] == "neubelt":
        return d / (4.0 * (light + view - light * view))
    power = 1.0 + 2.0 * (1.0 - light) ** 8 if p["visibility"] == "softened" else 1.0
    g = 1.0 / (1.0 + np.exp(masking(light, r)) ** power + np.exp(masking(view, r)))
    return d * g / (4.0 * light * view)
