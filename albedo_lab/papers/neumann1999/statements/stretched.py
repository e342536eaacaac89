"""Statements of section 2.2: the stretched Phong model and its rejected rivals."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from albedo_lab.analysis.normalise import normalise
from albedo_lab.papers.neumann1999.equations import (
    Array,
    cos_alpha,
    dot,
    hemisphere,
    larger,
    mirrored,
    reflected,
    stretched,
    stretched_by_products,
)
from albedo_lab.papers.neumann1999.tried import (
    CODE,
    MANY,
    PRINTED,
    SAME,
    albedo,
    at_mirror,
    cosine,
    exchanged,
    identical,
    in_section,
    sampled,
)
from albedo_lab.papers.recipes import Means
from albedo_lab.papers.record import Statement, Trial
from albedo_lab.papers.trials import CLOSED, Found, apart, behaves, checked, trial, undecided


def c_n(n: float) -> float:
    """The right side of ineq. 6."""
    return (n + 2.0) / (2.0 * math.pi)


def symmetric_factor(means: Means) -> Found:
    """The factor 1/max is 1/cos Θ_L for every viewer that is farther from the normal than the light."""
    L, V = hemisphere(means.seed, MANY), hemisphere(means.seed + 1, MANY)
    share = float(np.mean(np.abs(L[:, 2] / larger(L, V) - 1.0) < SAME))
    off = float(in_section("stretched_phong", 45.0, -45.0, n=100)[0]), float(in_section("stretched_phong", 45.0, 45.0, n=100)[0])
    ours = f"the chosen factor is 1/cos Θ_L at {share:.2f} of all pairs, and at L = V and V = R alike"
    again = f"half of them, Θ_V ≥ Θ_L ({CLOSED}); f is {off[0]:g} at V = L and {off[1]:.4g} at V = R, 45° ({CODE})"
    return Found(share < 0.01, ours, f"{PRINTED} at {MANY} pairs", again)


def brightest(model: str, light_deg: float, n: float) -> float:
    """The largest radiance between the mirror direction and the horizon, over that at normal incidence."""
    viewers = 90.0 - np.degrees(np.arcsin(cosine(light_deg) * np.geomspace(1e-4, 1.0, 201)))
    return float(np.max(in_section(model, light_deg, viewers, n=n))) * cosine(light_deg) / at_mirror(model, 0.0, n=n)


def too_bright(model: str, exponent: float) -> Trial:
    """Radiance beside the reflection direction, as large as one likes for viewers near the horizon."""

    def find(means: Means) -> Found:
        angles = (89.0, 89.9, 89.99)
        seen = [brightest(model, angle, 20.0) for angle in angles]
        at = at_mirror(model, 89.9, n=20.0) / at_mirror(model, 0.0, n=20.0)
        ours = "light from 89°, 89.9°, 89.99°: " + ", ".join(f"{x:.3g}" for x in seen) + " times that of normal incidence"
        again = f"in R itself {at:.4g} times at 89.9°; cos^{exponent:g} Θ_L = {cosine(89.9) ** exponent:.4g} ({CLOSED})"
        return Found(min(seen) > 10.0, ours, f"{CODE}, n = 20", again)

    return trial(find)


def twice_the_radiance(model: str) -> Trial:
    """The largest radiance under grazing light over that at normal incidence."""

    def find(means: Means) -> Found:
        viewers = 90.0 - np.geomspace(1e-9, 89.0, 20001)
        top = float(np.max(in_section(model, 89.999, viewers, n=20))) * cosine(89.999)
        normal = float(np.max(in_section(model, 0.0, viewers, n=20)))
        mirror = at_mirror(model, 89.999, n=20) / at_mirror(model, 0.0, n=20)
        first = f"largest radiance at 89.999° over that at 0°: {top / normal:.3f}, for viewers still nearer to the horizon"
        again = f"2 cos Θ_L/(cos Θ_L + cos Θ_V) → 2 where cos Θ_V ≪ cos Θ_L, 1 in the mirror direction ({CLOSED}; {mirror:.4f})"
        return Found(1.95 < top / normal < 2.05, first, f"{CODE}, n = 20", again)

    return trial(find)


def kinked(means: Means) -> Found:
    """The factor's derivative jumps where both angles are equal."""
    step, c = 1e-6, cosine(45.0)
    left, right = ((1.0 / max(c, c + s * step) - 1.0 / c) / (s * step) for s in (-1.0, 1.0))
    f = [float(in_section("stretched_phong", 45.0, 45.0 + d, n=100)[0]) for d in (-1e-4, 0.0, 1e-4)]
    jump = ((f[2] - f[1]) - (f[1] - f[0])) / 1e-4
    ours = f"slopes on both sides of equal cosines at 45°: {left:.4f} and {right:.4f}"
    return Found(abs(left - right) > 1.0, ours, PRINTED, f"f's slope at R jumps by {jump:.4g} per degree ({CODE}, n = 100)")


def largest_phong_constant(means: Means) -> Found:
    """The maximum of c_n against ineq. 6."""
    exponents = [0.1, 1.0, 2.0, 20.0, 1000.0]
    table = normalise("phong", n=exponents, method="quadrature", tolerance=1e-7, seed=means.seed)
    worst = max(abs(c / c_n(n) - 1.0) for c, n in zip(table.constant, exponents, strict=True))
    z = (np.arange(100_000) + 0.5) / 1e5
    by_hand = 1.0 / (2.0 * math.pi * float(np.mean(z**21)))
    ours = f"largest constant = (n+2)/2π within {worst:.1g} for n = 0.1, 1, 2, 20, 1000"
    return Found(
        worst < 1e-7, ours, "quadrature", f"1/∫cosⁿ⁺¹Θ dω = {by_hand:.6f} for n = 20, ineq. 6 {c_n(20.0):.6f} (midpoint rule)"
    )


def reflection_vector(means: Means) -> Found:
    """Eq. 8 is a mirror image, and eq. 9 its product with V."""
    L, V = hemisphere(means.seed, MANY), hemisphere(means.seed + 1, MANY)
    R = mirrored(L)
    length = float(np.max(np.abs(np.linalg.norm(R, axis=1) - 1.0)))
    product = float(np.max(np.abs(dot(R, V) - (2.0 * L[:, 2] * V[:, 2] - dot(L, V)))))
    turned = float(np.max(np.abs(R - L * np.array([-1.0, -1.0, 1.0]))))
    ours = f"| |R| - 1 | ≤ {length:.1g}, both sides of eq. 9 differ by at most {product:.1g}"
    return Found(max(length, product, turned) < 1e-14, ours, PRINTED, f"R = (-L_x, -L_y, L_z) within {turned:.1g}")


def two_integrals(means: Means) -> Found:
    """Eq. 11: the albedo as a sum over both halves."""
    n, theta = 20.0, 60.0

    def halves(L: Array, V: Array) -> Array:
        # both integrands are without the cosine, which `reflected` multiplies
        return np.asarray(cos_alpha(L, V) ** n * np.where(L[:, 2] < V[:, 2], 1.0, V[:, 2] / L[:, 2]) / V[:, 2])

    ours, code = c_n(n) * reflected(halves, theta), albedo("stretched_phong", theta, n=n)
    return Found(
        abs(ours - code) < 1e-5, f"eq. 11 gives a(60°) = {ours:.7f}, n = 20", "product rule", f"{code:.7f} by eq. 2 (quadrature)"
    )


def excess(p: float, exponents: tuple[float, ...], means: Means, model: str = "p_phong") -> list[float]:
    """How far the largest albedo exceeds 1 with c_n of ineq. 6."""
    chosen: dict[str, Any] = {"p": p} if model == "p_phong" else {}
    table = normalise(model, n=list(exponents), method="quadrature", tolerance=1e-8, seed=means.seed, **chosen)
    return [c_n(n) / constant - 1.0 for n, constant in zip(exponents, table.constant, strict=True)]


def negligible_overshoot(means: Means) -> Found:
    """The overshoot of the stretched model against n."""
    over = excess(1.0, (1.0, 1.2, 1.5, 2.0, 8.0, 100.0), means)
    ours = ", ".join(f"{max(x, 0.0):.1e}" for x in over)
    a = [albedo("stretched_phong", angle, n=1) - 1.0 for angle in (0.0, 13.0, 26.0)]
    again = "n = 1: a - 1 = " + ", ".join(f"{x:+.1e}" for x in a) + " at 0°, 13°, 26° (quadrature)"
    return Found(
        0.0 < max(over) < 4e-4 and max(over[3:]) < 1e-7, f"n = 1, 1.2, 1.5, 2, 8, 100: {ours}", "search of normalise", again
    )


def overshoot_below_one(means: Means) -> Found:
    """For n < 1 the constant must be smaller, and the maximum is away from the normal."""
    table = normalise("stretched_phong", n=[0.25, 0.5, 0.75], method="quadrature", tolerance=1e-8, seed=means.seed)
    shares = [c / c_n(n) for c, n in zip(table.constant, table.n, strict=True)]
    ours = "; ".join(
        f"n = {n:g}: {s:.4f} of (n+2)/2π, at {t:.1f}°" for n, s, t in zip(table.n, shares, table.peak_theta_deg, strict=True)
    )
    again = f"n = 0.5: a(30°) = {sampled('stretched_phong', 30.0, means, n=0.5)} (rqmc), a(0°) = 1"
    return Found(max(shares) < 1.0 and min(table.peak_theta_deg) > 5.0, ours, "search of normalise", again)


def becomes_a_mirror(means: Means) -> Found:
    """Figure 3: in the limit the albedo is 1 below 90 degrees."""
    a = [albedo("stretched_phong", angle, n=1e8) for angle in (0.0, 45.0, 80.0, 89.0)]
    ours = ", ".join(f"{x:.5f}" for x in a) + " at 0°, 45°, 80°, 89°, n = 1e8"
    again = f"{sampled('stretched_phong', 80.0, means, n=1e8)} at 80° (rqmc); at 90° itself 1/2, eq. 26"
    return Found(min(a) > 0.995, ours, "quadrature", again)


def minimum(means: Means) -> Found:
    """Eq. 4: 1/cos of the smaller angle."""
    L, V = hemisphere(means.seed, MANY), hemisphere(means.seed + 1, MANY)
    worst = apart(1.0 / larger(L, V), 1.0 / np.maximum(L[:, 2], V[:, 2]))
    angles = np.linspace(0.0, 89.9, 1000)
    falls = bool(np.all(np.diff(np.cos(np.radians(angles))) < 0.0))
    return Found(
        worst < SAME and falls, f"largest relative difference {worst:.1g}", PRINTED, "the cosine falls on [0°, 90°] (1000 angles)"
    )


def reflected_radiance(means: Means) -> Found:
    """f cos Θ_L of Phong's model."""
    viewers = np.linspace(-60.0, 89.0, 300)
    light = 50.0
    code = in_section("phong", light, viewers, n=20) * cosine(light) / c_n(20.0)
    alpha = np.radians(np.abs(viewers - light))
    printed = np.where(alpha < math.pi / 2.0, np.cos(alpha), 0.0) ** 20 * cosine(light)
    worst = float(np.max(np.abs(code - printed)))
    return Found(
        worst < 1e-12, f"c_n cosⁿα cos Θ_L within {worst:.1g} c_n", CODE, "α measured as a difference of angles (closed form)"
    )


STATEMENTS = (
    Statement(
        "radiance_of_phong",
        "§2.2",
        "The reflected radiance of the physically plausible Phong model follows the cosⁿ α · cos Θ_L function",
        "f_r cos Θ_L = c_n cosⁿα cos Θ_L in the plane of incidence, n = 20.",
        trial(reflected_radiance),
        ("phong",),
    ),
    Statement(
        "back_to_the_original",
        "§2.2",
        "if we multiplied the specular part of the reciprocal Phong model by 1/cos Θ_L, then we would get back the "
        "original, non-reciprocal Phong expression",
        "cosⁿα / cos Θ_L is Phong's original as the catalogue has it, and it is not reciprocal.",
        checked("reciprocity", "FAIL", "phong_original", n=100),
        ("phong_original", "phong"),
    ),
    Statement(
        "symmetric_function",
        "§2.2",
        "a symmetric function of L and V, which gives 1/cos Θ_L value only in the L = V case",
        "1/max(cos Θ_L, cos Θ_V) is 1/cos Θ_L for V = L only.",
        trial(symmetric_factor, "the mirror direction V = R is meant, and even so not only there: Θ_V ≥ Θ_L suffices"),
        ("stretched_phong",),
    ),
    Statement(
        "product_radiance",
        "§2.2",
        "If we multiplied the Phong BRDF with 1/(cos Θ_L · cos Θ_V), then the radiance would be unacceptably high "
        "around the reflection direction at grazing angles",
        "Between R and the horizon, less than 1° apart, it is more than 10 times that of normal incidence; n = 20.",
        too_bright("product_phong", -1.0),
        ("product_phong",),
    ),
    Statement(
        "product_energy",
        "§2.2",
        "and the energy balance could not be preserved",
        "The albedo diverges, so that no constant can keep the balance.",
        behaves("product_phong", "diverges", exponent=-1.0, n=20),
        ("product_phong",),
    ),
    Statement(
        "sqrt_radiance",
        "§2.2",
        "We can come to the same conclusion with 1/√(cos Θ_L · cos Θ_V)",
        "Between R and the horizon, less than 1° apart, the radiance is more than 10 times that of normal incidence; n = 20.",
        too_bright("sqrt_phong", 0.0),
        ("sqrt_phong",),
    ),
    Statement(
        "sqrt_energy",
        "§2.2",
        "We can come to the same conclusion with 1/√(cos Θ_L · cos Θ_V)",
        "The albedo diverges, so that no constant can keep the balance.",
        behaves("sqrt_phong", "diverges", exponent=-0.5, n=20),
        ("sqrt_phong",),
    ),
    Statement(
        "plus_phong_twice",
        "§2.2",
        "it reflects two times greater radiance at grazing angles than at orthogonal illumination (figures 1 and 2)",
        "Plus-Phong: the largest radiance over all viewers, light at grazing over light at the normal; n = 20.",
        twice_the_radiance("plus_phong"),
        ("plus_phong",),
    ),
    Statement(
        "plus_blinn_twice",
        "§2.2",
        "it reflects two times greater radiance at grazing angles than at orthogonal illumination (figures 1 and 2)",
        "Plus-Blinn: the largest radiance over all viewers, light at grazing over light at the normal; n = 20.",
        twice_the_radiance("plus_blinn"),
        ("plus_blinn",),
    ),
    Statement(
        "only_appropriate_function",
        "§2.2",
        "only the 1/max(cos Θ_L, cos Θ_V) function has been found appropriate from the set of simple L, V symmetric functions",
        "No other simple symmetric function would do.",
        undecided("the set is not given, nor what makes a function simple"),
        ("stretched_phong",),
    ),
    Statement(
        "derivative_not_continuous",
        "§2.2",
        "its derivative is not continuous",
        "The derivative of 1/max(cos Θ_L, cos Θ_V) jumps at equal angles.",
        trial(kinked),
        ("stretched_phong",),
    ),
    Statement(
        "no_visible_artifacts",
        "§2.2",
        "has no visible artifacts, similarly to the Cook-Torrance model",
        "Whether the kink can be seen.",
        undecided("depends on the picture and on who looks"),
        ("stretched_phong", "cook_torrance"),
    ),
    Statement(
        "equation_4", "eq. 3 and 4", "1/cos Θ_min = 1/max(cos Θ_L, cos Θ_V)", "Both sides are the same function.", trial(minimum)
    ),
    Statement(
        "inequality_6",
        "ineq. 6",
        "c_n ≤ (n+2)/2π must hold in order for the model to preserve energy balance",
        "It is the largest constant of the reciprocal Phong model, for n = 0.1 to 1000.",
        trial(largest_phong_constant),
        ("phong",),
    ),
    Statement(
        "equation_9",
        "eq. 8 and 9",
        "R = 2(N·L)N - L; (R·V) = 2(N·L)(N·V) - (L·V)",
        "R is the mirror image of L, and both sides of eq. 9 agree.",
        trial(reflection_vector),
    ),
    Statement(
        "equation_10",
        "eq. 10",
        "f_r = c_n [(2(N·L)(N·V) - (L·V))⁺]ⁿ / max((N·L), (N·V))",
        "It is eq. 7; n = 20.",
        identical(stretched_by_products(20.0), stretched(20.0), "stretched_phong", n=20),
        ("stretched_phong",),
    ),
    Statement(
        "equation_7_reciprocal",
        "§2.2, before eq. 7",
        "The new reciprocal BRDF of the stretched Phong model",
        "f_r(L, V) = f_r(V, L), n = 100.",
        checked("reciprocity", "PASS", "stretched_phong", again=exchanged(stretched(100.0)), n=100),
        ("stretched_phong",),
    ),
    Statement(
        "equation_11",
        "eq. 11",
        "The albedo function … as the sum of the following two integrals",
        "The sum is the albedo of eq. 2; n = 20, 60°.",
        trial(two_integrals),
        ("stretched_phong",),
    ),
    Statement(
        "overshoot_negligible",
        "§2.2, after eq. 11",
        "the albedo … has only a negligible overshooting where it exceeds value 1 if n ≥ 1. … For higher n values, the "
        "overshooting is negligible.",
        "With c_n of ineq. 6 the albedo is at most 1.0004 for n ≥ 1, and at most 1 from n = 2 on.",
        trial(negligible_overshoot),
        ("stretched_phong",),
    ),
    Statement(
        "overshoot_below_one",
        "§2.2, after eq. 11",
        "Below the arbitrarily selected n = 1 minimum, the c_n value should be decreased … which would shift the "
        "maximum … from the perpendicular incident direction",
        "For n = 0.25, 0.5, 0.75 the largest constant is below (n+2)/2π, and the maximum is away from the normal.",
        trial(overshoot_below_one),
        ("stretched_phong",),
    ),
    Statement(
        "figure_3_limit",
        "§2.2, figure 3",
        "in the limit case the albedo converges to constant 1, which is the albedo of the ideal mirror",
        "At every angle below 90° the albedo tends to 1.",
        trial(becomes_a_mirror),
        ("stretched_phong",),
    ),
)
