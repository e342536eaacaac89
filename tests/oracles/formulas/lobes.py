"""Cosine lobes of neumann1999: powers of a (generalised) mirror cosine over a power of the larger cosine."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from tests.oracles.formulas.fresnel import exact
from tests.oracles.formulas.pair import Array, Pair

PI = math.pi


def lobe_parameters(p: dict[str, Any], stretched: bool) -> list[tuple[tuple[float, float, float], float, float, float]]:
    """((C_x, C_y, C_z), n, C, p) of every lobe; the second and later ones carry the suffix _2, _3, ..."""
    lobes = []
    for i in range(int(p["lobes"])):
        suffix = "" if i == 0 else f"_{i + 1}"
        matrix = (p[f"C_x{suffix}"], p[f"C_y{suffix}"], p[f"C_z{suffix}"])
        lobes.append((matrix, p[f"n{suffix}"], p[f"C{suffix}"], p[f"p{suffix}"] if stretched else 0.0))
    return lobes


def lafortune(wi: Array, wo: Array, p: dict[str, Any], stretched: bool) -> Array:
    """neumann1999 eq. 14-16, literally, from vectors: R = (-L_x, -L_y, L_z)."""
    value = np.zeros(np.broadcast_shapes(wi.shape, wo.shape)[:-1])
    for (c_x, c_y, c_z), n, c, power in lobe_parameters(p, stretched):
        dot = -c_x * wi[..., 0] * wo[..., 0] - c_y * wi[..., 1] * wo[..., 1] + c_z * wi[..., 2] * wo[..., 2]
        lobe = np.where(dot > 0.0, np.maximum(dot, 0.0) ** n, 0.0)
        value += c * lobe / np.maximum(wi[..., 2], wo[..., 2]) ** power
    return value


def metal_factor(pair: Pair, p: dict[str, Any]) -> Array:
    """What multiplies cos^n(alpha) in eq. 27 (half vector) and 28 (theta_min), without the constant (n + 2)/2 pi."""
    larger = np.maximum(pair.light, pair.view)
    angle = pair.u if p["angle"] == "half_vector" else larger
    return exact(angle, p["eta"], p["k"]) / larger


def plastic_factor(pair: Pair, p: dict[str, Any]) -> Array:
    """What multiplies cos^n(alpha) in eq. 29 (exact) and 30 (one)."""
    larger = np.maximum(pair.light, pair.view)
    fresnel = exact(larger, p["eta"]) if p["fresnel"] == "exact" else 1.0
    return p["a_s"] * (p["n"] + 2.0) / (2.0 * PI) * fresnel / larger
