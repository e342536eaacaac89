"""Diffuse surfaces of today: Fujii's Oren-Nayar, EON, Disney's diffuse term and Frostbite's."""

from __future__ import annotations

from typing import Any

import numpy as np

from tests.oracles.formulas.pair import Array, Pair

PI = np.pi


def sines(pair: Pair) -> tuple[Array, Array]:
    """Of light and viewer."""
    return tuple(np.sqrt((1.0 - np.asarray(c)) * (1.0 + np.asarray(c))) for c in (pair.light, pair.view))  # type: ignore[return-value]


def non_diffuse(pair: Pair) -> Array:
    """s / t in angles: sin sin cos(dphi), over the larger cosine for azimuths below 90 degrees."""
    light, view = sines(pair)
    s = light * view * pair.cos_phi
    return np.where(s > 0.0, s / np.maximum(pair.light, pair.view), s)


def fujii(pair: Pair, p: dict[str, Any]) -> Array:
    """mixing: A = 1/(pi + (pi/2 - 2/3) sigma), B = sigma A; matched: his A and B of the full Oren-Nayar."""
    sigma = p["sigma"]
    if p["form"] == "mixing":
        a = 1.0 / (PI + (PI / 2.0 - 2.0 / 3.0) * sigma)
        b = sigma * a
    else:
        s2 = sigma**2
        a = (1.0 - 0.5 * s2 / (s2 + 0.33) + 0.17 * p["rho"] * s2 / (s2 + 0.13)) / PI
        b = 0.45 * s2 / (s2 + 0.09) / PI
    return p["rho"] * (a + b * non_diffuse(pair))


def fujii_albedo(c: Array | float, sigma: float, exact: bool) -> Array:
    """E_F of the white surface, with G = sin (theta - sin cos) + 2/3 (tan (1 - sin^3) - sin), or the fit of the listing."""
    c = np.asarray(c, dtype=float)
    a = 1.0 / (1.0 + (0.5 - 2.0 / (3.0 * PI)) * sigma)
    if not exact:
        x = 1.0 - c
        return a * (1.0 + sigma * np.polyval([0.0714429953, -0.332181442, 0.491881867, 0.0571085289, 0.0], x))
    s = np.sqrt((1.0 - c) * (1.0 + c))
    one_minus_cube = c * c * (1.0 + s * (1.0 + s)) / (1.0 + s)  # 1 - sin = cos^2 / (1 + sin)
    g = s * (np.arccos(c) - s * c) + 2.0 / 3.0 * (s / c * one_minus_cube - s)
    return a * (1.0 + sigma * g / PI)


def eon(pair: Pair, p: dict[str, Any]) -> Array:
    """f_ss + rho_ms/pi (1 - E_i)(1 - E_o)/(1 - <E>), literally."""
    rho, r, exact = p["rho"], p["r"], p["albedo"] == "exact"
    once = fujii(pair, {"form": "mixing", "rho": rho, "sigma": r})
    if r == 0.0:
        return once
    mean = (1.0 + (2.0 / 3.0 - 28.0 / (15.0 * PI)) * r) / (1.0 + (0.5 - 2.0 / (3.0 * PI)) * r)
    lost = [np.maximum(1.0 - fujii_albedo(c, r, exact), 0.0) for c in (pair.light, pair.view)]
    rho_ms = rho**2 * mean / (1.0 - rho * (1.0 - mean))
    return once + rho_ms / PI * lost[0] * lost[1] / (1.0 - mean)


def disney(pair: Pair, p: dict[str, Any]) -> Array:
    """cos(theta_d) = u."""
    k = p["roughness"]
    f90 = 2.0 * k * pair.u**2 + (0.5 if p["form"] == "burley" else 0.5 * k)
    energy = 1.0 if p["form"] == "burley" else (1.0 - k) + k / 1.51
    factors = [1.0 + (f90 - 1.0) * (1.0 - np.asarray(c)) ** 5 for c in (pair.light, pair.view)]
    return p["rho"] / PI * energy * factors[0] * factors[1]
