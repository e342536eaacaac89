"""Microfacet distributions D(t) and geometrical factors G.

D is normalised by integral of D(t) t d omega = 1 over the hemisphere of facet normals.  Smith masking is the exact one of
that D: G1(v) = v / P(v), P(v) = integral of (wo.m)^+ D(m) d omega_m, the projected area of the visible facets.
"""

from __future__ import annotations

import math
from functools import cache
from typing import Any

import numpy as np
from scipy.special import erfc

from tests.oracles.formulas.pair import Array, Pair
from tests.oracles.quadrature import chain, graded_rule

PI = math.pi


def distribution(kind: str, p: dict[str, Any], t: Array, tan2: Array, as_printed: str = "no") -> Array:
    """D(t); as_printed = yes takes the constant alpha^2/pi of nuaj_models for trowbridge_reitz and gtr."""
    if kind == "blinn_phong":
        n = p["n"]
        return (n + 2.0) / (2.0 * PI) * np.exp(-0.5 * n * np.log1p(tan2))  # t^n, t^-2 = 1 + tan^2
    if kind == "beckmann":
        m2 = p["m"] ** 2
        return np.exp(-tan2 / m2) / (PI * m2) * (1.0 + tan2) ** 2
    alpha2 = p["alpha"] ** 2
    # alpha^2 t^2 + 1 - t^2 = t^2 (alpha^2 + tan^2)
    base = t * t * (alpha2 + tan2)
    gamma = {"trowbridge_reitz": 1.0, "ggx": 2.0}.get(kind) or p["gamma"]
    if kind == "ggx" or as_printed == "yes":
        return alpha2 / PI * base**-gamma
    return gtr_constant(alpha2, gamma) * base**-gamma


def gtr_constant(alpha2: float, gamma: float) -> float:
    """1 / (integral of t (alpha^2 t^2 + 1 - t^2)^-gamma d omega) = 1 / (pi int_0^1 (1 - (1 - alpha^2) x)^-gamma dx)."""
    if alpha2 == 1.0:
        return 1.0 / PI
    if gamma == 1.0:
        return (1.0 - alpha2) / (-PI * math.log(alpha2))
    return (gamma - 1.0) * (1.0 - alpha2) / (PI * math.expm1((1.0 - gamma) * math.log(alpha2)))


def v_cavity(pair: Pair) -> Array:
    """min(1, 2 t v/u, 2 t v'/u)."""
    return np.minimum(1.0, 2.0 * pair.t * np.minimum(pair.light, pair.view) / pair.u)


def tangent(c: Array | float) -> Array:
    """tan(theta) from cos(theta)."""
    c = np.asarray(c, dtype=float)
    return np.sqrt((1.0 - c) * (1.0 + c)) / c


def lambda_beckmann(c: Array | float, m: float) -> Array:
    """exp(-a^2)/(2 a sqrt(pi)) - erfc(a)/2, a = cot(theta)/m."""
    with np.errstate(divide="ignore"):
        a = np.minimum(1.0 / (m * tangent(c)), 1e3)
    return np.exp(-a * a) / (2.0 * a * math.sqrt(PI)) - 0.5 * erfc(a)


def lambda_ggx(c: Array | float, alpha: float) -> Array:
    """(sqrt(1 + alpha^2 tan^2) - 1)/2."""
    return 0.5 * (np.sqrt(1.0 + (alpha * tangent(c)) ** 2) - 1.0)


def projected_area(kind: str, c: float, **p: float) -> float:
    """P(v) by its definition; the azimuth integral of (v cos d + s sin d cos b)^+ done by hand.

    With x = v cos d, y = s sin d: 2 pi x if x >= y, else 2 (x b0 + sqrt(y^2 - x^2)), b0 = arccos(-x/y).
    """
    s = math.sqrt((1.0 - c) * (1.0 + c))
    limit = math.atan2(c, s)  # tan d = v/s, where part of the ring begins to face away
    breaks = [0.0, limit, 0.5 * PI]
    if kind != "blinn_phong":
        breaks.append(math.atan(p.get("m", p.get("alpha", 1.0))))
    nodes = chain(breaks, graded_rule(20, 20))
    d, cos_d = nodes.value, np.sin(-nodes.offset(0.5 * PI))
    sin_d = np.sin(d)
    x, y = c * cos_d, s * sin_d
    inside = d < limit
    ratio = np.where(inside, 1.0, x / np.where(y > 0.0, y, 1.0))
    partial = 2.0 * (x * np.arccos(-np.minimum(ratio, 1.0)) + np.sqrt(np.maximum((y - x) * (y + x), 0.0)))
    ring = np.where(inside, 2.0 * PI * x, partial)
    with np.errstate(over="ignore"):
        density = distribution(kind, p, cos_d, (sin_d / cos_d) ** 2)
    return float(np.sum(nodes.weight * np.where(density > 0.0, density, 0.0) * sin_d * ring))


PANELS, DEGREE, RATIO = 24, 19, 0.25


@cache
def _area_table(kind: str, items: tuple[tuple[str, float], ...]) -> Array:
    """Chebyshev coefficients of P against the elevation, on panels graded to both ends of [0, pi/2]."""
    p = dict(items)
    x = np.polynomial.chebyshev.chebpts1(DEGREE + 1)
    rows = []
    for side in (0, 1):
        for k in range(PANELS):
            low, high = _panel(k)
            distance = low + (high - low) * 0.5 * (1.0 + x)
            cosine = np.sin(distance) if side == 0 else np.cos(distance)
            values = np.array([projected_area(kind, float(c), **p) for c in cosine])
            rows.append(np.polynomial.chebyshev.chebfit(x, values, DEGREE))
    return np.array(rows)


def _panel(k: int) -> tuple[float, float]:
    """Panel k of [0, pi/4]: [q^(k+1), q^k] pi/4, the last one reaching 0."""
    high = 0.25 * PI * RATIO**k
    return (0.0 if k == PANELS - 1 else high * RATIO), high


def interpolated_area(kind: str, c: Array | float, p: dict[str, float]) -> Array:
    """P at many cosines, from the table (tested against `projected_area`)."""
    c = np.asarray(c, dtype=float)
    table = _area_table(kind, tuple(sorted(p.items())))
    elevation = np.arctan2(c, np.sqrt((1.0 - c) * (1.0 + c)))
    upper = elevation > 0.25 * PI
    distance = np.where(upper, 0.5 * PI - elevation, elevation)
    with np.errstate(divide="ignore"):
        k = np.floor(np.log(distance / (0.25 * PI)) / math.log(RATIO))
    k = np.clip(k, 0, PANELS - 1).astype(int)
    ends = np.array([_panel(i) for i in range(PANELS)])
    x = np.clip(2.0 * (distance - ends[k, 0]) / (ends[k, 1] - ends[k, 0]) - 1.0, -1.0, 1.0)
    row = k + PANELS * upper
    b1, b2 = np.zeros_like(x), np.zeros_like(x)
    for j in range(DEGREE, 0, -1):  # Clenshaw
        b1, b2 = table[row, j] + 2.0 * x * b1 - b2, b1
    return table[row, 0] + x * b1 - b2


def smith_lambda(kind: str, p: dict[str, Any], c: Array | float) -> Array:
    """Lambda = 1/G1 - 1 of the distribution."""
    if kind == "beckmann":
        return lambda_beckmann(c, p["m"])
    if kind == "ggx":
        return lambda_ggx(c, p["alpha"])
    numbers = {key: p[key] for key in ("n", "alpha", "gamma") if key in p}
    return np.maximum(interpolated_area(kind, c, numbers) / c - 1.0, 0.0)


def width_of(kind: str, p: dict[str, Any]) -> float:
    """The slope width that Schlick's approximation of Smith takes: m, alpha, or sqrt(2/(n + 2))."""
    if kind == "beckmann":
        return p["m"]
    if kind == "blinn_phong":
        return math.sqrt(2.0 / (p["n"] + 2.0))
    return p["alpha"]


def geometry(kind: str, d_kind: str, p: dict[str, Any], pair: Pair) -> Array | float:
    """G."""
    if kind == "none":
        return 1.0
    if kind == "v_cavity":
        return v_cavity(pair)
    if kind == "smith":
        return 1.0 / ((1.0 + smith_lambda(d_kind, p, pair.light)) * (1.0 + smith_lambda(d_kind, p, pair.view)))
    if kind == "smith_correlated":
        return 1.0 / (1.0 + smith_lambda(d_kind, p, pair.light) + smith_lambda(d_kind, p, pair.view))
    if kind == "schlick":
        kk = math.sqrt(2.0 / PI) * width_of(d_kind, p)
        g = [c / (c * (1.0 - kk) + kk) for c in (pair.light, pair.view)]
        return g[0] * g[1]
    raise ValueError(f"unknown geometrical factor {kind!r}")
