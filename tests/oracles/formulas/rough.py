"""Rough surfaces: Oren-Nayar, Minnaert, Ward in the half-vector form of losasso, and He-Torrance-Sillion-Greenberg 1991."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from scipy.special import erfc, gammaln, lambertw

from tests.oracles.formulas.facets import tangent
from tests.oracles.formulas.fresnel import reflectance
from tests.oracles.formulas.pair import Array, Pair

PI = math.pi


def oren_nayar(pair: Pair, p: dict[str, Any]) -> Array:
    """Oren and Nayar 1994: the qualitative model (also losasso), and the full one with C1, C2, C3 and interreflection."""
    rho, s2 = p["rho"], p["sigma"] ** 2
    theta = [np.arctan2(np.sqrt((1.0 - c) * (1.0 + c)), c) for c in (pair.light, pair.view)]
    alpha, beta = np.maximum(*theta), np.minimum(*theta)
    cos_phi = pair.cos_phi
    if p["form"] == "qualitative":
        a = 1.0 - 0.5 * s2 / (s2 + 0.33)
        b = 0.45 * s2 / (s2 + 0.09)
        return rho / PI * (a + b * np.maximum(0.0, cos_phi) * np.sin(alpha) * np.tan(beta))
    c1 = 1.0 - 0.5 * s2 / (s2 + 0.33)
    c2 = 0.45 * s2 / (s2 + 0.09) * np.where(cos_phi >= 0.0, np.sin(alpha), np.sin(alpha) - (2.0 * beta / PI) ** 3)
    c3 = 0.125 * s2 / (s2 + 0.09) * (4.0 * alpha * beta / PI**2) ** 2
    direct = c1 + cos_phi * c2 * np.tan(beta) + (1.0 - np.abs(cos_phi)) * c3 * np.tan(0.5 * (alpha + beta))
    twice = 0.17 * s2 / (s2 + 0.13) * (1.0 - cos_phi * (2.0 * beta / PI) ** 2)
    return rho / PI * direct + rho**2 / PI * twice


def minnaert(pair: Pair, p: dict[str, Any]) -> Array:
    """losasso as printed, v'^k (1 - v)^{1-k}; otherwise Minnaert's reciprocal (v v')^{k-1}."""
    k = p["k"]
    if p["as_printed"] == "yes":
        short = 1.0 - pair.view if pair.one_minus_view is None else pair.one_minus_view
        return pair.light**k * short ** (1.0 - k) / PI
    return pair.light ** (k - 1.0) * pair.view ** (k - 1.0) / PI


def ward(pair: Pair, p: dict[str, Any]) -> Array:
    """losasso, Ward's anisotropic model in terms of H; as printed the pi of Ward 1992 is missing."""
    front = 1.0 / (4.0 * p["m_x"] * p["m_y"])
    if p["as_printed"] == "no":
        front /= PI
    exponent = -2.0 * ((pair.h_x / p["m_x"]) ** 2 + (pair.h_y / p["m_y"]) ** 2) / (1.0 + pair.t)
    return front / np.sqrt(pair.light * pair.view) * np.exp(exponent)


# He, Torrance, Sillion, Greenberg 1991


def he_cotangent(c: Array | float, p: dict[str, Any]) -> Array:
    """tau cot(theta)/(2 sigma0)."""
    with np.errstate(divide="ignore"):
        return np.minimum(p["tau"] / (2.0 * p["sigma0"] * tangent(c)), 1e3)


def he_shadowing(c: Array | float, p: dict[str, Any]) -> Array:
    """Smith: S = (1 - erfc(a)/2)/(Lambda + 1), Lambda = (exp(-a^2)/(sqrt(pi) a) - erfc(a))/2."""
    a = he_cotangent(c, p)
    lam = 0.5 * (np.exp(-a * a) / (math.sqrt(PI) * a) - erfc(a))
    return (1.0 - 0.5 * erfc(a)) / (lam + 1.0)


def he_sigma(light: Array | float, view: Array | float, p: dict[str, Any]) -> Array:
    """Effective roughness sigma = sigma0/sqrt(1 + (z0/sigma0)^2).

    sqrt(pi/2) z0 = sigma0/4 (K_i + K_r) exp(-z0^2/(2 sigma0^2)); with x = (z0/sigma0)^2 this is x e^x = (K_i + K_r)^2/(8 pi),
    whose solution is Lambert's W.
    """
    k = tangent(light) * erfc(he_cotangent(light, p)) + tangent(view) * erfc(he_cotangent(view, p))
    return p["sigma0"] / np.sqrt(1.0 + np.real(lambertw(k * k / (8.0 * PI))))


def he_g(light: Array | float, view: Array | float, p: dict[str, Any]) -> Array:
    """g = [2 pi sigma/lambda (cos_i + cos_r)]^2."""
    return (2.0 * PI * he_sigma(light, view, p) / p["wavelength"] * (light + view)) ** 2


def he_series_direct(g: Array, b: Array, terms: int) -> Array:
    """sum_{m=1}^{terms} g^m e^{-g}/(m! m) exp(-b/m), term by term."""
    total = np.zeros(np.broadcast_shapes(g.shape, b.shape))
    log_g = np.log(g)
    for m in range(1, terms + 1):
        total += np.exp(m * log_g - g - math.lgamma(m + 1.0) - math.log(m) - b / m)
    return total


def he_series(g: Array, b: Array) -> Array:
    """The same sum, converged.

    The summand is log-concave in m around its peak m0, of width w.  If w is small all integers in m0 -10 w .. m0 + 14 w are
    summed; if w is large, every h-th with h = w/3 or less, times h: by Poisson's summation formula that changes the sum of a
    bell of width w by exp(-2 pi^2 (w/h)^2), nothing.
    """
    shape = np.broadcast_shapes(g.shape, b.shape)
    g, b = np.broadcast_to(g, shape).ravel(), np.broadcast_to(b, shape).ravel()
    log_g = np.log(g)
    low, high = np.log(np.full_like(g, 1e-3)), np.log(g + np.sqrt(b) + b**0.5 * g + 100.0)
    for _ in range(50):  # d/dm log(term) = log g - log m - 1/(2m) - 1/m + b/m^2 = 0, by bisection in log m
        middle = 0.5 * (low + high)
        m = np.exp(middle)
        rising = log_g - middle - 1.5 / m + b / m**2 > 0.0
        low, high = np.where(rising, middle, low), np.where(rising, high, middle)
    m0 = np.exp(0.5 * (low + high))
    width = 1.0 / np.sqrt(1.0 / np.maximum(m0, 1.0) + 2.0 * b / np.maximum(m0, 1.0) ** 3)
    step = np.maximum(1.0, np.floor(width / 3.0))
    first = np.maximum(1.0, np.floor(m0 - 10.0 * width))
    # a log-concave bell: beyond m0 + 14 w + 30 the Poisson tail is below 1e-17 of the peak
    count = int(np.max(np.ceil((m0 + 14.0 * width + 30.0 - first) / step)))
    total = np.zeros_like(g)
    # steps above 1 must not cut the bell at m = 1: then the bell is far from 1 (w >= 6 means m0 >= 36)
    for j in range(count + 1):
        m = first + j * step
        total += np.exp(m * log_g - g - gammaln(m + 1.0) - np.log(m) - b / m)
    return (total * step).reshape(shape)


def he_directional_diffuse(pair: Pair, p: dict[str, Any]) -> Array:
    """f_dd = F/pi G S D/(cos_i cos_r).

    The geometrical factor is (v.v/v_z)^2 times [(s_r.k_i)^2 + (p_r.k_i)^2][(s_i.k_r)^2 + (p_i.k_r)^2]/|k_r x k_i|^4, and each
    bracket is |k_r x k_i|^2 (s_r, p_r span the plane across k_r), so that only (v.v/v_z)^2 = (4 u^2/(v + v'))^2 remains.
    """
    k = 2.0 * PI / p["wavelength"]
    v_z = pair.light + pair.view
    v_xy2 = (k * v_z) ** 2 * pair.tan2  # v is along h
    g = he_g(pair.light, pair.view, p)
    series = he_series(g, 0.25 * v_xy2 * p["tau"] ** 2)
    d = PI**2 * p["tau"] ** 2 / (4.0 * p["wavelength"] ** 2) * series
    geometrical = (4.0 * pair.u**2 / v_z) ** 2
    shadowing = he_shadowing(pair.light, p) * he_shadowing(pair.view, p)
    f = reflectance(p["fresnel"], pair.u, p)
    return f / PI * geometrical * shadowing * d / (pair.light * pair.view)


def he_mirror(mu: float, p: dict[str, Any]) -> float:
    """Reflectance of the Dirac part: F exp(-g) S, both angles equal."""
    c = np.array(mu)
    return float(reflectance(p["fresnel"], c, p) * np.exp(-he_g(c, c, p)) * he_shadowing(c, p) ** 2)
