"""How microfacets hide each other: Smith's masking of each distribution of normals, the V-cavity factor and Schlick's fit.

Smith's masking of normals that do not know their neighbours is G1 = 1 / (1 + Lambda). The facets that face wo have the projected
area (1 + Lambda) cos(theta_o), those that face away Lambda cos(theta_o), and the share G1 that is seen must cover cos(theta_o).
With t = cot(theta_o) and S the survival of the slope (see `normals`), an integration by parts leaves, for every isotropic D,

    Lambda = 1 / (pi t) * integral over w > 0 of S(sqrt(t^2 + w^2)) w^2 / (t^2 + w^2)

Closed forms: beckmann, with a = t/m, exp(-a^2) / (2 a sqrt(pi)) - erfc(a) / 2; ggx, (sqrt(1 + alpha^2 / t^2) - 1) / 2;
trowbridge_reitz, with A^2 = 1 + t^2 and B^2 = alpha^2 + t^2, (A - B - t log((t + A) / (t + B))) / (2 t log(1/alpha)).

Not closed: blinn_phong, whose slopes in the plane of incidence have Student's distribution with n+2 degrees of freedom, scaled,
so that an incomplete beta function is left; and gtr. Both are integrated here by a fixed Gauss-Legendre rule. The largest
relative error of 1 + Lambda, for cosines from 1e-12 to 1 and all parameters, measured against mpmath: 2e-13 for blinn_phong,
1e-12 for gtr (gamma = 10; 2e-14 up to gamma = 5), 4e-16 for the others (tests/optics/test_microfacet.py).
"""

from __future__ import annotations

from math import erfc, pi, sqrt

import numpy as np

from albedo_lab.optics.frame import Direction
from albedo_lab.optics.maths import exp, expm1, log1p

X, W = np.polynomial.legendre.leggauss(20)
STUDENT_NODES, STUDENT_WEIGHTS = 0.5 + 0.5 * X, 0.5 * W
STUDENT_END = 6.7
"""Beyond lies less than 1e-13: the share of slopes above t falls like exp(-y^2 (n+2) / (n+3))."""
X, W = np.polynomial.legendre.leggauss(32)
GTR_NODES, GTR_WEIGHTS = 0.5 + 0.5 * X, 0.5 * W


def cot(w: Direction) -> float:
    """The cotangent of the angle from the normal, finite."""
    return w.z / max(sqrt(w.x * w.x + w.y * w.y), 1e-100)


def stretched(alpha_x: float, alpha_y: float, w: Direction) -> Direction:
    """w as it is seen after a surface of widths alpha_x and alpha_y is stretched to width 1, not normalised (Heitz 2014).

    Slopes of facets divide by their widths, so Lambda of the surface at w is that of width 1 at the stretched direction.
    """
    return Direction(alpha_x * w.x, alpha_y * w.y, w.z)


def beckmann_lambda(m: float, w: Direction) -> float:
    """Smith 1967 with the slope's variance m^2 / 2 in every direction."""
    a = cot(w) / m
    return 0.5 * (exp(-a * a) / (a * sqrt(pi)) - erfc(a))


def ggx_lambda(alpha: float, w: Direction) -> float:
    """(sqrt(1 + alpha^2 tan^2) - 1) / 2, nothing cancelled."""
    a = alpha / cot(w)
    return 0.5 * a * a / (1.0 + sqrt(1.0 + a * a))


def trowbridge_reitz_lambda(alpha: float, L: float, w: Direction) -> float:
    """With d = (A - B) / (t + B): (1 - alpha^2) / L (B + t (1 - log1p(d) / d)) / (t (A + B) (t + B))."""
    t = cot(w)
    a, b = sqrt(1.0 + t * t), sqrt(alpha * alpha + t * t)
    d = max((1.0 - alpha) * (1.0 + alpha) / ((a + b) * (t + b)), 1e-300)
    return -expm1(-L) / L * (b + t * (1.0 - log1p(d) / d)) / (t * (a + b) * (t + b))


def student_peak(n: float) -> float:
    """The density of the slope 0 in the plane of incidence: (n+2) / (2 sqrt(pi)) Gamma((n+3)/2) / Gamma((n+4)/2)."""
    # 1 / R(x), R(x) = Gamma(x + 1/2) / Gamma(x) = R(x + 1) x / (x + 1/2), and Stirling's series where x is large
    x, ratio = 0.5 * (n + 3.0), 1.0
    while x < 100.0:
        ratio *= x / (x + 0.5)
        x += 1.0
    y = 1.0 / (8.0 * x)
    ratio *= sqrt(x) * (1.0 - y * (1.0 - y * (0.5 + y * (2.5 - y * (2.625 + y * 49.875)))))
    return (n + 2.0) / (2.0 * sqrt(pi) * ratio)


def blinn_phong_lambda(n: float, peak: float, w: Direction) -> float:
    """peak (1 + t^2)^(-(n+1)/2) / ((n+1) t), less the share of slopes above t; these have density peak (1 + s^2)^(-(n+3)/2)."""
    t = cot(w)
    log_a = 0.5 * log1p(t * t) if t < 1e100 else 300.0
    nu = n + 3.0
    end = min(sqrt(nu * log_a), STUDENT_END)
    # the share of slopes in [0, t], with (1 + s^2)^(-nu/2) = exp(-y^2)
    within = 0.0
    for i in range(STUDENT_NODES.size):
        y = end * STUDENT_NODES[i]
        c = 2.0 * y * y / nu
        within += STUDENT_WEIGHTS[i] * exp(c - y * y) * y / sqrt(expm1(c))
    within *= 2.0 * end * peak / nu
    return peak * exp(-(n + 1.0) * log_a) / ((n + 1.0) * t) - max(0.5 - within, 0.0)


def gtr_lambda(alpha: float, L: float, g: float, E: float, w: Direction) -> float:
    """ggx's, and the integral over the difference of both survivals.

    That difference has no pole at w = i t, S being 1 at the slope 0 in both; what singularities there are lie at w = i B and
    w = i A (A and B of the module's docstring). With w = B sinh(u) below sqrt(A B) and w = A / sinh(u) above, they lie a
    quarter turn off the axis of u, however small alpha is.
    """
    t = cot(w)
    tt, aa = t * t, alpha * alpha
    a, b = sqrt(1.0 + tt), sqrt(aa + tt)
    c = -expm1(-L)
    end = log1p(sqrt(a / b) + (sqrt(1.0 + a / b) - 1.0))  # asinh(sqrt(a / b))
    total = 0.0
    for i in range(GTR_NODES.size):
        e = expm1(end * GTR_NODES[i])
        s = 0.5 * (e + e / (1.0 + e))
        ds = sqrt(1.0 + s * s)
        near, far = b * s, a / s
        rr = near * near
        bb = tt + aa + rr
        low = (expm1(g * log1p(c / bb)) / E - aa / bb) * rr / (tt + rr) * b * ds
        rr = far * far
        bb = tt + aa + rr
        high = (expm1(g * log1p(c / bb)) / E - aa / bb) * rr / (tt + rr) * far * ds / s
        total += GTR_WEIGHTS[i] * (low + high)
    return ggx_lambda(alpha, w) + end * total / (pi * t)


def v_cavity_factor(v: Direction, wi: Direction, wo: Direction) -> float:
    """min(1, 2 t v/u, 2 t v'/u) (losasso, appendix A): of a groove whose two sides mirror each other, the share lit and seen."""
    return min(1.0, 4.0 * v.z * min(wi.z, wo.z) / (v.x * v.x + v.y * v.y + v.z * v.z))


def v_cavity_seen(v: Direction, wo: Direction) -> float:
    """min(1, 2 t v/u) / v: the share seen over the cosine, which is finite."""
    return min(1.0 / wo.z, 4.0 * v.z / (v.x * v.x + v.y * v.y + v.z * v.z))


def schlick_factor(k: float, w: Direction) -> float:
    """v / (v (1 - k) + k), with k = sqrt(2/pi) m for Smith's masking of Beckmann's normals (Schlick 1994)."""
    return w.z / (w.z * (1.0 - k) + k)
