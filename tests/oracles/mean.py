"""Mean albedo 2 * integral of a(mu) mu d mu: directly, and by an independent reduction to one integral or less.

Derivation of the reduction.  The mean albedo is (1/pi) times the double integral of f c_L c_V over both hemispheres.  f
depends on one relative angle and the two cosines, so N may be averaged over the sphere for a fixed pair of directions
(or a fixed half vector) instead of the pair over the hemispheres for a fixed N.

(R.V)^n models.  Mirroring L into R keeps its cosine.  For a pair (R, V) at the angle alpha,

    M = 2 * integral_0^{pi/2} cos^n(alpha) sin(alpha) W(alpha) d alpha,   W = integral over N of c_R c_V * correction,

N running over the lune c_R > 0, c_V > 0.  With N = (rho cos chi, rho sin chi, t), rho^2 = 1 - t^2, dN = d chi dt, the
bisector of R and V at chi = 0 and delta = alpha/2: c_R = rho cos(chi - delta), c_V = rho cos(chi + delta); the lune is
|chi| < pi/2 - delta.  Note c_R c_V = rho^2 (cos^2 chi - sin^2 delta).  The integrals over t and chi give

    phong          2/3 (sin alpha + (pi - alpha) cos alpha)
    stretched      pi (1 - sin(alpha/2))                                  (retro: the same, V.L in place of V.R)
    plus           pi (1 - sin^2(delta) artanh(cos delta)/cos delta)
    product        2 (pi - alpha)
    sqrt           pi (E(k) - sin^2(delta) K(k)), k = cos delta
    p_phong        B(1/2, 2 - p/2) * 2 * integral_0^{pi/2 - delta} cos(chi + delta) cos^{1-p}(chi - delta) d chi
    original       pi/2 (1 + cos alpha)                                   (both orders: it is one double integral)

and, with W_k = integral_0^{pi/2} cos^k = sqrt(pi)/2 Gamma((k+1)/2)/Gamma(k/2+1) (Wallis), B the beta function,

    phong          4/(3(n+2)) (pi + W_n/(n+2))         times (n+2)/(2 pi): 2/3 (1 + W_n/(pi (n+2))) -> 2/3
    stretched      2 pi (1/(n+1) - B(3/2, n+1)/sqrt 2) times (n+2)/(2 pi) -> 1
    product        4 (pi - W_{n+1})/(n+1)
    original       pi (1/(n+1) + 1/(n+2))

N.H models.  d omega_L = 4 (V.H) d omega_H.  With H at the angle delta from N and V = (rho cos chi, rho sin chi, t) in
the frame of H with N in the plane t = 0: V.H = rho cos chi, c_V = rho cos(chi - delta), c_L = rho cos(chi + delta), so

    M = (1/pi) * integral over H of (kernel of delta, phi_h) * G(delta)
    G = integral over V of 4 (V.H) c_L c_V * correction

    blinn          2 pi cos^3 delta                    M = 4 pi/(n+4)
    stretched      16/3 (pi/2 - delta) cos delta       M = 32/3 (pi/2 - W_{n+2})/(n+2)
    plus           8/3 (sin 2 delta + (pi - 2 delta) cos 2 delta)/cos delta
                   M = 16/3 (2 W_n/(n+2) + 2 (pi - 2 W_{n+2})/(n+2) - (pi - 2 W_n)/n)
    1/sqrt (ward)  8 pi/3 cos^2 delta                  isotropic: M = 2/(3 m^2) exp(1/m^2) E_{5/2}(1/m^2)

The mean albedo of Ward's model is finite although its directional albedo is not.
"""

from __future__ import annotations

import math
from collections.abc import Callable

import mpmath
import numpy as np
from scipy.special import ellipe, ellipkm1, ive

from tests.oracles.albedo import HALF_PI, PHONG_MODELS, ROUNDING, albedo_plain, check_parameters
from tests.oracles.quadrature import Array, chain, graded_rule


def wallis(k: float) -> float:
    """Integral of cos^k over [0, pi/2], which is B((k + 1)/2, 1/2)/2 (mpmath: no loss in the ratio of gammas)."""
    return float(mpmath.beta(0.5 * (k + 1.0), 0.5) / 2)


def mean_closed_form(model: str, **parameters: float) -> float | None:
    """Closed form of the mean albedo of the shape (module docstring), None where none is known to us."""
    par = check_parameters(model, parameters)
    n = par.get("n", 0.0)
    if model == "lambert":
        return par["albedo"]
    if model == "phong":
        return 4.0 / (3.0 * (n + 2.0)) * (math.pi + wallis(n) / (n + 2.0))
    if model in ("stretched_phong", "retro_phong"):
        beta = float(mpmath.beta(1.5, n + 1.0))
        return 2.0 * math.pi * (1.0 / (n + 1.0) - beta / math.sqrt(2.0))
    if model == "product_phong":
        return 4.0 * (math.pi - wallis(n + 1.0)) / (n + 1.0)
    if model == "phong_original":
        return math.pi * (1.0 / (n + 1.0) + 1.0 / (n + 2.0))
    if model == "blinn":
        return 4.0 * math.pi / (n + 4.0)
    if model == "stretched_blinn":
        return 32.0 / 3.0 * (HALF_PI - wallis(n + 2.0)) / (n + 2.0)
    if model == "plus_blinn" and n > 0.0:
        edge = 2.0 * wallis(n) / (n + 2.0) + 2.0 * (math.pi - 2.0 * wallis(n + 2.0)) / (n + 2.0)
        return 16.0 / 3.0 * (edge - (math.pi - 2.0 * wallis(n)) / n)
    if model == "ward" and par["m_x"] == par["m_y"]:
        x = 1.0 / mpmath.mpf(par["m_x"]) ** 2
        return float(2 * x / 3 * mpmath.exp(x) * mpmath.expint(mpmath.mpf(5) / 2, x))
    return None


def mean_reduced(model: str, **parameters: float) -> tuple[float, float]:
    """Mean albedo by the one-dimensional integral of the module docstring, Schlick excepted; (value, error)."""
    par = check_parameters(model, parameters)
    if model == "lambert":
        return par["albedo"], 0.0
    integrand: Callable[[Array, Array], Array]
    if model in PHONG_MODELS:
        n = par["n"]

        def integrand(alpha: Array, to_end: Array) -> Array:
            power = np.exp(n * np.log1p(-2.0 * np.sin(0.5 * np.minimum(alpha, 1.0)) ** 2))
            tail = np.sin(to_end) ** n
            return 2.0 * np.where(alpha < 1.0, power, tail) * np.sin(alpha) * _lune(model, alpha, par.get("p", 1.0))
    else:

        def integrand(delta: Array, to_end: Array) -> Array:
            kernel = _kernel_over_azimuth(model, delta, to_end, par)
            return kernel * np.sin(delta) * _pair(model, delta, to_end) / math.pi

    values = []
    for order in (24, 18):
        rule = graded_rule(order, 27)
        values.append(float(np.sum(rule.weight * integrand(HALF_PI * rule.left, HALF_PI * rule.right)) * HALF_PI))
    return values[0], abs(values[0] - values[1]) + ROUNDING * values[0]


def _lune(model: str, alpha: Array, p: float) -> Array:
    """W(alpha) of the (R.V)^n models."""
    delta = 0.5 * alpha
    if model == "phong":
        return 2.0 / 3.0 * (np.sin(alpha) + (math.pi - alpha) * np.cos(alpha))
    if model in ("stretched_phong", "retro_phong"):
        return math.pi * (1.0 - np.sin(delta))
    if model == "plus_phong":
        # artanh(cos d) = log((1 + cos d)/sin d)
        return math.pi * (1.0 - np.sin(delta) ** 2 * np.log((1.0 + np.cos(delta)) / np.sin(delta)) / np.cos(delta))
    if model == "product_phong":
        return 2.0 * (math.pi - alpha)
    if model == "sqrt_phong":
        square = np.sin(delta) ** 2
        return math.pi * (ellipe(1.0 - square) - square * ellipkm1(square))
    if model == "phong_original":
        return HALF_PI * (1.0 + np.cos(alpha))
    rule = graded_rule(24, 12)
    span = HALF_PI - delta[:, None]
    chi = rule.left[None, :] * span
    cosine_far = np.sin(rule.right[None, :] * span)  # cos(chi + delta), zero at chi = pi/2 - delta
    inner = np.sum(rule.weight * cosine_far * np.cos(chi - delta[:, None]) ** (1.0 - p), axis=1) * span[:, 0]
    beta = math.sqrt(math.pi) * math.gamma(2.0 - 0.5 * p) / math.gamma(2.5 - 0.5 * p)
    return beta * 2.0 * inner


def _pair(model: str, delta: Array, to_end: Array) -> Array:
    """G(delta) of the N.H models; to_end = pi/2 - delta."""
    cosine = np.sin(to_end)
    if model == "blinn":
        return 2.0 * math.pi * cosine**3
    if model in ("stretched_blinn", "modified_ward"):
        return 16.0 / 3.0 * to_end * cosine
    if model == "plus_blinn":
        return 8.0 / 3.0 * (np.sin(2.0 * delta) + 2.0 * to_end * np.cos(2.0 * delta)) / cosine
    if model == "ward":
        return 8.0 * math.pi / 3.0 * cosine**2
    raise ValueError(f"no reduction for {model}")


def _kernel_over_azimuth(model: str, delta: Array, to_end: Array, par: dict[str, float]) -> Array:
    """The factor of the shape that depends on the half vector, integrated over its azimuth."""
    if model in ("blinn", "stretched_blinn", "plus_blinn"):
        near = np.exp(par["n"] * np.log1p(-2.0 * np.sin(0.5 * np.minimum(delta, 1.0)) ** 2))
        return 2.0 * math.pi * np.where(delta < 1.0, near, np.sin(to_end) ** par["n"])
    # integral of exp(-t^2 (cos^2/m_x^2 + sin^2/m_y^2)) = 2 pi exp(-a t^2) I_0(b t^2), a, b = (1/m_x^2 +- 1/m_y^2)/2
    m_x, m_y = par["m_x"], par["m_y"]
    smallest = min(1.0 / m_x**2, 1.0 / m_y**2)  # a - |b|, the rest is in the scaled Bessel function
    slope2 = np.minimum(np.tan(delta) ** 2, 750.0 / smallest)  # beyond, the exponential is zero and ive gives nan
    bessel = ive(0, 0.5 * abs(1.0 / m_x**2 - 1.0 / m_y**2) * slope2)
    return np.exp(-smallest * slope2) * bessel / (2.0 * m_x * m_y)


def mean_albedo(model: str, order: str = "wi", **parameters: float) -> tuple[float, float]:
    """(mean albedo of the shape, error) by plain integration of the directional albedo, three nested quadratures.

    d mu mu = sin(e) cos(e) d e in the elevation e of the fixed direction.  The error compares two sets of orders.
    Anisotropic models go through `mean_reduced`.
    """
    par = check_parameters(model, parameters)
    if par.get("m_x") != par.get("m_y"):
        return mean_reduced(model, **par)
    results = []
    for outer_order, inner_order in ((12, 18), (10, 14)):
        outer = chain([0.0, HALF_PI], graded_rule(outer_order, 12))
        inner = graded_rule(inner_order, 14)
        mu, sine = np.sin(outer.value), np.sin(-outer.offset(HALF_PI))
        values = np.array([albedo_plain(model, float(c), 0.0, order, inner, par) for c in mu])
        results.append(2.0 * float(np.sum(outer.weight * mu * sine * values)))
    return results[0], abs(results[0] - results[1]) + ROUNDING * results[0]
