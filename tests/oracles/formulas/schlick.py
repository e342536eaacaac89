"""The models of schlick1993: eq. 4 (`phong_blend`) and eq. 9-18 (`schlick`)."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from scipy.special import ellipkm1

from tests.oracles.formulas.fresnel import schlick as schlick_fresnel
from tests.oracles.formulas.pair import Array, Pair

PI = math.pi


def zenith(tan2: Array, r: float) -> Array:
    """Z(t) = r/(1 + r t^2 - t^2)^2, eq. 14; 1 - (1 - r) t^2 = (tan^2 + r)/(1 + tan^2)."""
    return r * ((1.0 + tan2) / (tan2 + r)) ** 2


def azimuthal(azimuth: Array, p: float, as_printed: str) -> Array:
    """A(w) of eq. 14, w = cos(azimuth of h).

    Its mean over all azimuths is (2/pi) sqrt(p) K(m), m = 1 - p^2, K the complete elliptic integral of the first kind;
    as_printed = no divides by it.
    """
    w2, s2 = np.cos(azimuth) ** 2, np.sin(azimuth) ** 2
    value = np.sqrt(p / (p * p * s2 + w2))
    if as_printed == "yes":
        return value
    return value / (2.0 / PI * math.sqrt(p) * float(ellipkm1(p * p)))


def directional(pair: Pair, kind: str, r: float, p: float, as_printed: str) -> Array:
    """D(t, v, v', w): eq. 12, 15, 17 or 18."""
    z = zenith(pair.tan2, r)
    a = azimuthal(pair.azimuth, p, as_printed)
    # G(v)/v = 1/(r - r v + v), eq. 16
    g_over_v = 1.0 / ((r - r * pair.light + pair.light) * (r - r * pair.view + pair.view))
    if kind == "eq12":
        return z * a / (4.0 * PI * pair.light * pair.view)
    if kind == "eq15":
        return g_over_v * z * a / (4.0 * PI)
    if kind == "eq17":
        return r / PI * a + (1.0 - r) / (4.0 * PI * pair.light * pair.view) * z * a
    if kind == "eq18":
        g = g_over_v * pair.light * pair.view
        return (1.0 - g) / PI * a + g_over_v * z * a / (4.0 * PI)
    raise ValueError(f"unknown directional factor {kind!r}")


def schlick(pair: Pair, p: dict[str, Any]) -> Array:
    """Eq. 9: SINGLE S D; DOUBLE S D + (1 - S) S' D', the second layer with its own C, r, p."""

    def spectral(c: float) -> Array | float:
        return c if p["spectral"] == "constant" else schlick_fresnel(pair.u, c)  # eq. 10, 11

    s = spectral(p["C"])
    value = s * directional(pair, p["directional"], p["r"], p["p"], p["as_printed"])
    if p["layers"] == "single":
        return value
    second = directional(pair, p["directional"], p["r_2"], p["p_2"], p["as_printed"])
    return value + (1.0 - s) * spectral(p["C_2"]) * second


def phong_blend(pair: Pair, p: dict[str, Any]) -> Array:
    """Eq. 4 (as_printed = yes: d D + s S t^n); no: d D/pi + s S t^n (n+2)(n+4)/(8 pi (2^{-n/2} + n))."""
    d, n = p["d"], p["n"]
    power = np.exp(-0.5 * n * np.log1p(pair.tan2))
    if p["as_printed"] == "yes":
        return d * p["D"] + (1.0 - d) * p["S"] * power
    constant = (n + 2.0) * (n + 4.0) / (8.0 * PI * (2.0 ** (-0.5 * n) + n))
    return d * p["D"] / PI + (1.0 - d) * p["S"] * constant * power
