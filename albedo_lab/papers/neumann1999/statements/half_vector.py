"""Statements of section 6.1: the Blinn models and mean albedos."""

from __future__ import annotations

import math

import numpy as np

from albedo_lab.analysis.mean_albedo import mean_albedo
from albedo_lab.analysis.normalise import normalise
from albedo_lab.papers.neumann1999.equations import (
    blinn,
    stretched_blinn,
)
from albedo_lab.papers.neumann1999.statements.introduction import scaled
from albedo_lab.papers.neumann1999.tables import TABLE_3
from albedo_lab.papers.neumann1999.tried import albedo, at_mirror, exchanged, identical, sampled
from albedo_lab.papers.recipes import Means, mean_albedo_of
from albedo_lab.papers.record import Statement, Trial
from albedo_lab.papers.trials import CLOSED, Found, checked, number, trial, undecided

EXPONENTS = tuple(float(line.split()[0]) for line in TABLE_3.strip().split("\n")[1:])


def vanishes_with_n(model: str) -> Trial:
    """The grazing albedo against n."""

    def find(means: Means) -> Found:
        exponents = (1e2, 1e4, 1e6)
        a = [albedo(model, 90.0 - 1e-7, n=n, **scaled(model, n)) for n in exponents]
        out = [at_mirror(model, 89.9, n=n, scale=1.0) for n in exponents]
        closed = [8.0 * math.pi * scaled(model, n)["scale"] / ((n + 2.0) * (n + 4.0)) for n in exponents]
        ours = ", ".join(f"{x:.2e}" for x in a) + f" at n = 1e2, 1e4, 1e6; f cos Θ_L / C_n at R, 89.9°: {out[-1]:.2e}"
        return Found(a[-1] < 1e-5 < a[0], ours, "quadrature", "8πC_n/((n+2)(n+4)): " + ", ".join(f"{x:.2e}" for x in closed))

    return trial(find)


def practically_the_same(means: Means) -> Found:
    """Constants of both Blinn models from n = 4 on."""
    exponents = [n for n in EXPONENTS if n >= 4.0]
    a, b = (normalise(m, n=exponents, method="quadrature", tolerance=1e-7, seed=means.seed) for m in ("blinn", "stretched_blinn"))
    worst = float(np.max(np.abs(a.constant / b.constant - 1.0)))
    peaks = max(a.peak_theta_deg.max(), b.peak_theta_deg.max())
    ours = f"largest relative difference {worst:.1g}, n = 4 to 512; both albedos are largest at {peaks:g}°"
    closed = [scaled("blinn", n)["scale"] / c - 1.0 for n, c in zip(exponents, a.constant, strict=True)]
    again = (
        f"there max(cos Θ_L, cos Θ_V) = 1; 1/a(0°) = (n+2)(n+4)/(8π(n + 2^(-n/2))) within {max(map(abs, closed)):.1g} ({CLOSED})"
    )
    return Found(worst < 1e-6, ours, "search of normalise", again)


def constant_in_closed_form(means: Means) -> Found:
    """How the closed form of Blinn's constant compares with table 2's computation."""
    exponents = [4.0, 64.0, 512.0]
    table = normalise("blinn", n=exponents, method="quadrature", tolerance=1e-7, seed=means.seed)
    pairs = [(float(c), scaled("blinn", n)["scale"]) for n, c in zip(exponents, table.constant, strict=True)]
    ours = "; ".join(f"{a:.6f}" for a, _ in pairs) + " for n = 4, 64, 512"
    again = "; ".join(f"{b:.6f}" for _, b in pairs) + " by (n+2)(n+4)/(8π(n + 2^(-n/2))), two powers whatever n (closed form)"
    return Found(all(abs(a / b - 1.0) < 1e-6 for a, b in pairs), ours, "search of normalise", again)


def white_and_mirror(means: Means) -> Found:
    """Mean albedo of the white diffuse surface and of the mirror."""
    a = float(mean_albedo("lambert", albedo=1.0, method="quadrature", tolerance=1e-8).mean_albedo[0])
    b = float(mean_albedo("mirror", F=1.0, tolerance=1e-6, seed=means.seed).mean_albedo[0])
    z = (np.arange(100_000) + 0.5) / 1e5
    ours = f"{a:.9f} (diffuse), {b:.9f} (mirror)"
    return Found(
        abs(a - 1.0) < 1e-6 and abs(b - 1.0) < 1e-6,
        ours,
        "quadrature, rqmc",
        f"(1/π) ∫ cos Θ dω = {2.0 * np.mean(z):.9f} (midpoint rule)",
    )


def ratio_of_power(means: Means) -> Found:
    """Eq. 33 by its integral and by the mean over all directions at once."""
    z, weights = np.polynomial.legendre.leggauss(48)
    z, weights = 0.5 * (z + 1.0), 0.5 * weights
    angles = np.degrees(np.arccos(z))
    by_hand = 2.0 * float(np.sum(weights * z * [albedo("stretched_phong", float(a), n=8) for a in angles]))
    other = float(mean_albedo("stretched_phong", n=8, tolerance=1e-5, seed=means.seed).mean_albedo[0])
    return Found(
        abs(by_hand - other) < 1e-3,
        f"(1/π) ∫ a cos Θ dω = {by_hand:.5f}, stretched Phong, n = 8",
        "Gauss-Legendre",
        f"{other:.5f} (rqmc over both directions)",
    )


def means_of(n: float, means: Means) -> dict[str, float]:
    """Mean albedos of the four models of table 3."""
    models = ("phong", "stretched_phong", "blinn", "stretched_blinn")
    return {m: mean_albedo_of(m, n=n)(Means(1e-5, "quadrature", means.seed, means.threads)).value for m in models}


def pumped_up(means: Means) -> Found:
    """Whether the correction raises every mean albedo, Phong's most."""
    rows = {n: means_of(n, means) for n in EXPONENTS[::3]}
    gains = {n: (r["stretched_phong"] / r["phong"], r["stretched_blinn"] / r["blinn"]) for n, r in rows.items()}
    ours = "; ".join(f"n = {n:g}: {a:.3f}, {b:.3f}" for n, (a, b) in gains.items()) + " times (Phong, Blinn)"
    again = "3/2 and 4/3 as n → ∞: 1 over 2/3, 2/3 over 1/2 (closed form, note of table 3)"
    return Found(all(a > b > 1.0 for a, b in gains.values()), ours, "quadrature", again)


def darker_than_phong_type(means: Means) -> Found:
    """Whether those of (N.H) type are darker than those of Phong type, stretched, for each n of table 3."""
    rows = {n: means_of(n, means) for n in (1.0, 2.0, 4.0, 32.0, 512.0)}
    ours = "; ".join(f"n = {n:g}: {r['stretched_blinn']:.3f} against {r['stretched_phong']:.3f}" for n, r in rows.items())
    first, second = (sampled(model, 45.0, means, n=1) for model in ("stretched_blinn", "stretched_phong"))
    again = f"n = 1, a(45°): {first} against {second} (rqmc)"
    return Found(
        all(r["stretched_blinn"] < r["stretched_phong"] for r in rows.values()), f"mean albedos, {ours}", "quadrature", again
    )


def half_vector_to_mirror(means: Means) -> Found:
    """Whether the models of (N.H) type converge to the ideal mirror, if slower."""
    a = albedo("stretched_blinn", 60.0, n=1e8, **scaled("blinn", 1e8)), albedo("modified_ward", 60.0, m=1e-4, scale=1.0)
    b = albedo("stretched_phong", 60.0, n=1e8)
    ours = f"a(60°): stretched Blinn {a[0]:.4f} (n = 1e8), modified Ward {a[1]:.4f} (m = 1e-4), stretched Phong {b:.4f} (n = 1e8)"
    return Found(min(a) > 0.99, ours, "quadrature", f"cos 60° = 0.5, 0.5 and 1 in the limit ({CLOSED}, note of table 3)")


STATEMENTS = (
    Statement(
        "equation_31",
        "eq. 31",
        "f_r = C_n · (N·H)ⁿ",
        "It is what the catalogue's Blinn model computes, n = 20.",
        identical(
            blinn(20.0), lambda L, V: np.asarray(((L + V)[:, 2] ** 2 / np.sum((L + V) ** 2, axis=1)) ** 10.0), "blinn", n=20
        ),
        ("blinn",),
    ),
    Statement(
        "original_blinn",
        "§6.1, eq. 31",
        "the specular part of the original Blinn model is C_n · (N·H)ⁿ",
        "Whether Blinn's 1977 model is meant, which is Torrance and Sparrow's with other distributions.",
        undecided("the paper does not say whether it means his model or the highlight that is named after him"),
        ("blinn",),
    ),
    Statement(
        "blinn_complexity",
        "§6.1",
        "The analytical calculation of the C_n constant for integer n … The complexity of this calculation is O(n).",
        "No more is needed than O(n): a closed form gives table 2's constants from n = 4 on.",
        trial(constant_in_closed_form),
        ("blinn",),
    ),
    Statement(
        "blinn_vanishes",
        "§6.1",
        "The reflected radiance and the albedo converges to zero at grazing angles if n goes to infinity.",
        "Blinn's grazing albedo goes to 0 with n.",
        vanishes_with_n("blinn"),
        ("blinn",),
    ),
    Statement(
        "equation_32",
        "eq. 32",
        "f_r = C_n · (N·H)ⁿ / max((N·L), (N·V))",
        "It is eq. 31 times the factor of eq. 4, n = 20.",
        identical(
            stretched_blinn(20.0),
            lambda L, V: np.asarray(blinn(20.0)(L, V) / np.maximum(L[:, 2], V[:, 2])),
            "stretched_blinn",
            n=20,
        ),
        ("stretched_blinn",),
    ),
    Statement(
        "stretched_blinn_reciprocal",
        "§6.1, eq. 32",
        "this model can also be corrected resulting in a stretched Blinn model",
        "Eq. 32 is reciprocal, n = 100.",
        checked("reciprocity", "PASS", "stretched_blinn", again=exchanged(stretched_blinn(100.0)), n=100),
        ("stretched_blinn",),
    ),
    Statement(
        "practically_same_constant",
        "table 2, caption",
        "for n ≥ 4 the original and the stretched Blinn models have practically the same constant",
        "They agree to 1e-6 for n = 4 to 512.",
        trial(practically_the_same),
        ("blinn", "stretched_blinn"),
    ),
    Statement(
        "equation_33",
        "eq. 33",
        "a_mean = (1/π) · ∫ a(L) · cos Θ_L dω_L",
        "It is the share of the power of a uniform sky that is reflected.",
        trial(ratio_of_power),
        ("stretched_phong",),
    ),
    Statement(
        "white_and_mirror",
        "§6.1.1",
        "For diffuse white materials and for the ideal mirror the mean albedo is 1.",
        "Lambert with albedo 1, and the mirror with F = 1.",
        trial(white_and_mirror),
        ("lambert", "mirror"),
    ),
    Statement(
        "pumped_up",
        "§6.1.1",
        "The proposed correction by 1/cos Θ_min has “pumped-up” the mean albedo, especially for the Phong-type model.",
        "Every mean albedo grows, Phong's by the larger factor; n = 1, 8, 64, 512.",
        trial(pumped_up),
        ("phong", "stretched_phong", "blinn", "stretched_blinn"),
    ),
    Statement(
        "significantly_darker",
        "§6.1.1",
        "The models of (N·H) type … are significantly “darker” even after the pumping-up than the Phong-type models",
        "Stretched Blinn has the smaller mean albedo for every n of table 3.",
        trial(
            darker_than_phong_type,
            "for n = 1 and 2 it is the brighter one, in the paper's own table 3, too; from n = 4 on the sentence holds",
        ),
        ("stretched_phong", "stretched_blinn"),
    ),
    Statement(
        "converge_faster",
        "§6.1.1",
        "the Phong-type models that converge to the ideal mirror faster by increasing n",
        "Those of (N·H) type converge to it as well, if slower.",
        trial(half_vector_to_mirror, "they do not converge to it at all: stretched Blinn and modified Ward tend to the cosine"),
        ("stretched_blinn", "modified_ward", "stretched_phong"),
    ),
    Statement(
        "blinn_mean_128",
        "§6.1.1",
        "if n = 128, then the mean albedo of the Blinn model has been increased from 0.508",
        "Mean albedo of eq. 31 with the largest C_n.",
        number("0.508", mean_albedo_of("blinn", n=128)),
        ("blinn",),
    ),
    Statement(
        "stretched_blinn_mean_128",
        "§6.1.1",
        "to 0.640 due to the correction",
        "Mean albedo of eq. 32 with the largest C_n.",
        number("0.640", mean_albedo_of("stretched_blinn", n=128)),
        ("stretched_blinn",),
    ),
)
