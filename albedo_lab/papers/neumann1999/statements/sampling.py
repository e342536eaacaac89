"""Statements of section 4: its equations 17 to 25 as printed."""

from __future__ import annotations

import math
from fractions import Fraction

import numpy as np

from albedo_lab.papers.neumann1999.equations import (
    Array,
    N,
    cos_alpha,
    dot,
    hemisphere,
    lobe,
    mirrored,
    phong,
    reflected,
    stretched,
)
from albedo_lab.papers.neumann1999.statements.stretched import c_n
from albedo_lab.papers.neumann1999.tried import CODE, MANY, PRINTED, SAME, albedo, cosine, in_section
from albedo_lab.papers.recipes import Means
from albedo_lab.papers.record import Statement
from albedo_lab.papers.trials import Found, apart, trial
from albedo_lab.pictures.evaluation import in_plane

n = 100.0
"""The exponent that figures 6 and 7 use."""


def drawn(V: Array, seed: int, count: int, exponent: float = n) -> tuple[Array, Array, Array]:
    """Reflection directions about V by eq. 20 to 22, with cos alpha and the light that the text after eq. 22 prints."""
    u, v = np.random.default_rng(seed).random((2, count))
    alpha, phi = np.arccos(u ** (1.0 / (exponent + 1.0))), 2.0 * math.pi * v
    i = np.cross(V, N)
    i = i / np.linalg.norm(i)
    j = np.cross(i, V)
    R = (np.sin(alpha) * np.cos(phi))[:, None] * i + (np.sin(alpha) * np.sin(phi))[:, None] * j + np.cos(alpha)[:, None] * V
    return R, np.cos(alpha), R[:, 2:] * N - R


def viewer(theta_deg: float) -> Array:
    """A viewer in the plane of incidence."""
    return np.asarray(in_plane(np.array([theta_deg]))[0])


def by_samples(exponent: float, theta_deg: float, seed: int, count: int = 200_000) -> tuple[float, float]:
    """Eq. 25 for L^in = 1, with its standard error."""
    R, *_ = drawn(viewer(theta_deg), seed, count, exponent)
    z, mu = mirrored(R)[:, 2], cosine(theta_deg)
    w = (exponent + 2.0) / (exponent + 1.0) * np.where(z < 0.0, 0.0, np.where(z >= mu, 1.0, z / mu))
    return float(np.mean(w)), float(np.std(w)) / math.sqrt(count)


def estimator_of_radiance(means: Means) -> Found:
    """Eq. 18 with eq. 19: the mean of f cos / p is the albedo."""
    R, c, _ = drawn(viewer(60.0), means.seed, 200_000)
    L = mirrored(R)
    z = np.maximum(L[:, 2], 0.0)
    w = c_n(n) * c**n * z / ((n + 1.0) / (2.0 * math.pi) * c**n)
    error = float(np.std(w)) / math.sqrt(len(w))
    exact = albedo("phong", 60.0, n=n)
    ours = f"{np.mean(w):.5f} ± {1.96 * error:.5f} for L^in = 1, 60°, n = 100"
    return Found(
        abs(float(np.mean(w)) - exact) < 4.0 * error,
        ours,
        "200000 samples of eq. 18 to 22",
        f"{exact:.5f} (quadrature of eq. 17)",
    )


def density_integrates(means: Means) -> Found:
    """Eq. 19 over the hemisphere about V."""
    c, weights = np.polynomial.legendre.leggauss(200)
    c, weights = 0.5 * (c + 1.0), 0.5 * weights
    total = float((n + 1.0) * (weights @ c**n))
    rejected = 1.0 - total * float(np.mean(lobe(n, 80.0)[0] >= 0.0))
    ours = f"∫ p dω = {total:.12f} over the hemisphere about V"
    again = f"of eq. 20's samples for a viewer at 80°, {rejected:.4f} point into the object and are rejected (midpoints)"
    return Found(abs(total - 1.0) < 1e-12, ours, "Gauss-Legendre", again)


def inversion(means: Means) -> Found:
    """Eq. 20 inverts the distribution of eq. 19."""
    u = np.linspace(0.001, 0.999, 999)
    alpha = np.arccos(u ** (1.0 / (n + 1.0)))
    # P(angle > alpha) by eq. 19 is cos^(n+1) alpha, which eq. 20 sets to u
    worst = float(np.max(np.abs(np.cos(alpha) ** (n + 1.0) - u)))
    c = np.random.default_rng(means.seed).random(200_000) ** (1.0 / (n + 1.0))
    ours = f"cos^(n+1) α_m = u_m within {worst:.1g}"
    again = f"mean cos α_m of 200000 samples {np.mean(c):.6f}, of eq. 19 (n+1)/(n+2) = {(n + 1) / (n + 2):.6f}"
    return Found(worst < 1e-9, ours, PRINTED, again)


def frame(means: Means) -> Found:
    """Eq. 21 is an orthonormal frame."""
    V = hemisphere(means.seed, 1000)
    i = np.cross(V, N)
    i /= np.linalg.norm(i, axis=1, keepdims=True)
    j = np.cross(i, V)
    products = [dot(i, i) - 1.0, dot(j, j) - 1.0, dot(i, j), dot(i, V), dot(j, V)]
    worst = max(float(np.max(np.abs(p))) for p in products)
    hand = float(np.median(dot(np.cross(i, j), V)))
    again = f"i × j = {hand:+.0f} k: the frame is left-handed, which a uniform azimuth does not feel"
    return Found(
        worst < 1e-10,
        f"products of i, j, k differ from those of a frame by at most {worst:.1g}",
        f"{PRINTED}, 1000 viewers",
        again,
    )


def frame_at_normal(means: Means) -> Found:
    """Eq. 21 for viewers ever nearer to N, and for V = N itself."""
    angles = (1.0, 1e-3, 1e-6)
    lengths = [float(np.linalg.norm(np.cross(viewer(angle), N))) for angle in angles]
    at_normal = float(np.linalg.norm(np.cross(N, N)))
    ours = f"|V × N| = {', '.join(f'{x:.2g}' for x in lengths)} at 1°, 1e-3°, 1e-6°; {at_normal:g} at V = N itself"
    again = f"sin Θ_V = {', '.join(f'{math.sin(math.radians(a)):.2g}' for a in angles)}; at V = N any i across it will do"
    return Found(min(lengths) > 0.0, ours, PRINTED, again)


def on_the_lobe(means: Means) -> Found:
    """Eq. 22: unit vectors at the angle alpha from V."""
    V = viewer(60.0)
    R, c, _ = drawn(V, means.seed, MANY)
    length = float(np.max(np.abs(np.linalg.norm(R, axis=1) - 1.0)))
    angle = float(np.max(np.abs(R @ V - c)))
    kept = R[:, 2] > 0.0
    phong_angle = float(np.max(np.abs(cos_alpha(mirrored(R), np.broadcast_to(V, R.shape))[kept] - c[kept])))
    ours = f"| |R_m| - 1 | ≤ {length:.1g}, |R_m·V - cos α_m| ≤ {angle:.1g}"
    return Found(
        max(length, angle) < 1e-12,
        ours,
        f"{PRINTED}, {MANY} samples",
        f"cos α of eq. 5 for the mirrored light within {phong_angle:.1g}",
    )


def mirrored_light(means: Means) -> Found:
    """L_m as printed after eq. 22."""
    R, _, L = drawn(viewer(60.0), means.seed, MANY)
    lengths = np.linalg.norm(L, axis=1)
    height = float(np.max(np.abs(L[:, 2])))
    right = mirrored(R)
    ours = (
        f"|L_m| between {lengths.min():.3f} and {lengths.max():.3f}, N·L_m at most {height:.1g}: all in the plane of the surface"
    )
    again = f"with 2(N·R_m)N - R_m: |L_m| = 1 within {float(np.max(np.abs(np.linalg.norm(right, axis=1) - 1.0))):.1g}, as eq. 8"
    return Found(float(np.max(np.abs(lengths - 1.0))) < 1e-9, ours, f"{PRINTED}, viewer at 60°", again)


def weights_of_23(means: Means) -> Found:
    """f cos / p is 2 pi c_n / (n+1) cos Theta_L."""
    L, V = hemisphere(means.seed, MANY), hemisphere(means.seed + 1, MANY)
    f, z = phong(n)(L, V), L[:, 2]
    seen = f > 0.0
    left = c_n(n) * (f * z)[seen] / ((n + 1.0) / (2.0 * math.pi) * f[seen])
    worst = apart(left, 2.0 * math.pi * c_n(n) / (n + 1.0) * z[seen])
    quarter = (
        float(in_section("phong", 40.0, 45.0, n=n)[0])
        * cosine(40.0)
        / ((n + 1.0) / (2.0 * math.pi) * math.cos(math.radians(5.0)) ** n)
    )
    again = f"{quarter:.6f} and {2.0 * math.pi * c_n(n) / (n + 1.0) * cosine(40.0):.6f} for light at 40°, viewer at 45° ({CODE})"
    return Found(worst < SAME, f"largest relative difference {worst:.1g}", PRINTED, again)


def factor_of_24(means: Means) -> Found:
    """2 pi c_n / (n+1) for the largest c_n."""
    exact = [Fraction(k + 2, 2) * 2 / (k + 1) for k in (1, 10, 100)]
    printed = [Fraction(k + 2, k + 1) for k in (1, 10, 100)]
    ours = ", ".join(str(x) for x in exact) + " for n = 1, 10, 100"
    again = ", ".join(f"{2.0 * math.pi * c_n(k) / (k + 1.0):.6f}" for k in (1.0, 10.0, 100.0))
    return Found(exact == printed, ours, "fractions", f"{again} in floating point")


def estimator_of_25(means: Means) -> Found:
    """Eq. 25 against quadrature."""
    angles = (0.01, 45.0, 85.0, 89.9)
    found = [by_samples(n, angle, means.seed) for angle in angles]
    exact = [albedo("stretched_phong", angle, n=n) for angle in angles]
    condition = all(abs(e - x) <= 4.0 * s + 1e-9 for (e, s), x in zip(found, exact, strict=True))
    ours = ", ".join(f"{e:.4f} ± {1.96 * s:.4f}" for e, s in found) + " at 0.01°, 45°, 85°, 89.9°"
    return Found(condition, ours, "200000 samples of eq. 20 to 25", ", ".join(f"{x:.4f}" for x in exact) + " (quadrature)")


def radiance_is_albedo(means: Means) -> Found:
    """Eq. 17 under a white sky is the albedo of eq. 2 with L and V exchanged, for a reciprocal model."""
    theta = 60.0
    f = stretched(20.0)
    over_lights = c_n(20.0) * reflected(lambda V, L: f(L, V), theta)
    over_viewers = albedo("stretched_phong", theta, n=20, order="wo")
    ours = f"eq. 17: {over_lights:.7f} with L^in = 1, Θ_V = 60°, n = 20"
    other = albedo("phong_original", theta, n=20), albedo("phong_original", theta, n=20, order="wo")
    again = f"eq. 2: {over_viewers:.7f} (quadrature); Phong's original, not reciprocal: {other[0]:.4f} and {other[1]:.4f}"
    return Found(abs(over_lights - over_viewers) < 1e-5, ours, "product rule", again)


STATEMENTS = (
    Statement(
        "equation_17_is_albedo",
        "§4.3, eq. 17",
        "for L^in = 1 equation 17 gives the albedo function at illumination direction V",
        "Eq. 17 with L^in = 1 is eq. 2 with the light in V, for a reciprocal model.",
        trial(radiance_is_albedo),
        ("stretched_phong",),
    ),
    Statement(
        "equation_18",
        "eq. 18",
        "the Monte-Carlo estimate of this integral",
        "The mean of f_r cos Θ_L / p over samples of eq. 19 is the integral of eq. 17.",
        trial(estimator_of_radiance),
        ("phong",),
    ),
    Statement(
        "equation_19",
        "eq. 19",
        "p(L) = (n+1)/2π · [(V·R)⁺]ⁿ",
        "It is a density: its integral is 1.",
        trial(density_integrates),
        ("phong",),
    ),
    Statement(
        "equation_20",
        "eq. 20",
        "(α_m, ϕ_m) = (arccos u_m^(1/(n+1)), 2πv_m)",
        "Its samples have the density of eq. 19.",
        trial(inversion),
        ("phong",),
    ),
    Statement(
        "equation_21",
        "eq. 21",
        "i = V × N / |V × N|, j = i × k",
        "With k = V they are a Cartesian frame, for V ≠ N.",
        trial(frame),
    ),
    Statement(
        "equation_21_at_normal",
        "eq. 21",
        "Let us establish a Cartesian coordinate system i, j, k where k = V",
        "The frame exists for every viewer but V = N itself, where i is 0/0 and free to choose.",
        trial(frame_at_normal),
    ),
    Statement(
        "equation_22",
        "eq. 22",
        "R_m = sin α_m cos ϕ_m i + sin α_m sin ϕ_m j + cos α_m k",
        "R_m is a unit vector at the angle α_m from V.",
        trial(on_the_lobe),
        ("phong",),
    ),
    Statement(
        "mirrored_light",
        "after eq. 22",
        "L_m = ((N·R_m) N - R_m)",
        "L_m is a unit vector, the mirror image of R_m.",
        trial(mirrored_light, "a factor 2 is missing: as printed L_m lies in the plane of the surface and is shorter than 1"),
        ("phong", "stretched_phong"),
    ),
    Statement(
        "equation_23",
        "eq. 23",
        "(1/M) · 2πc_n/(n+1) · Σ L^in(L_m) cos Θ_Lm",
        "The weight f_r cos Θ_L / p is 2πc_n/(n+1) cos Θ_L.",
        trial(weights_of_23),
        ("phong",),
    ),
    Statement(
        "equation_24",
        "eq. 24",
        "(1/M) · (n+2)/(n+1) · Σ L^in(L_m) cos Θ_Lm",
        "2πc_n/(n+1) with the largest c_n is (n+2)/(n+1).",
        trial(factor_of_24),
        ("phong",),
    ),
    Statement(
        "equation_25",
        "eq. 25",
        "(1/M) · (n+2)/(n+1) (Σ L^in(L_m) + Σ L^in(L_m) · cos Θ_Lm / cos Θ_V)",
        "For L^in = 1 its mean is the albedo; n = 100.",
        trial(estimator_of_25),
        ("stretched_phong",),
    ),
)
