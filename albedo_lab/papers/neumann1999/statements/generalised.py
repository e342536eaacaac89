"""Statements of section 3: retro-reflective and anisotropic materials."""

from __future__ import annotations

import math

import numpy as np

from albedo_lab.analysis.normalise import normalise
from albedo_lab.papers.neumann1999.equations import (
    Array,
    dot,
    hemisphere,
    lafortune,
    mirrored,
    phong,
    retro,
    stretched,
)
from albedo_lab.papers.neumann1999.statements.materials import pairs
from albedo_lab.papers.neumann1999.statements.stretched import c_n
from albedo_lab.papers.neumann1999.tried import CODE, MANY, PRINTED, SAME, cosine, exchanged, identical, in_section
from albedo_lab.papers.recipes import Means
from albedo_lab.papers.record import Statement, Trial
from albedo_lab.papers.trials import Found, apart, checked, trial, undecided
from albedo_lab.pictures.evaluation import in_plane


def anisotropic(L: Array, V: Array) -> Array:
    """Eq. 15 with an even exponent, for which the missing cut changes no symmetry."""
    return np.asarray(lafortune((0.7, -0.9, 1.1), 20.0)(L, V) / np.maximum(L[:, 2], V[:, 2]))


def maximum_at_light(means: Means) -> Found:
    """Eq. 13 is largest towards the light."""
    V = np.concatenate([hemisphere(means.seed, MANY), in_plane(np.linspace(-89.9, 89.9, 3597))])
    told, worst = [], 0.0
    for angle in (0.0, 40.0, 80.0):
        own = float(in_section("retro_phong", angle, -angle, n=20)[0])
        L = np.broadcast_to(in_plane(np.array([-angle])), V.shape)
        worst = max(worst, c_n(20.0) * float(np.max(retro(20.0)(L, V))) / own - 1.0, abs(own * cosine(angle) / c_n(20.0) - 1.0))
        told.append(f"{own:.4f} at {angle:g}°")
    again = f"no viewer of {MANY + 3597} sees more; c_n / cos Θ_L within {max(worst, 0.0):.1g} ({PRINTED})"
    return Found(worst < SAME, f"f(L, L) = {', '.join(told)}, n = 20", CODE, again)


def retro_constant(means: Means) -> Found:
    """The largest constant of eq. 13: turned by half a turn it is eq. 7."""
    exponents = [1.0, 2.0, 20.0]
    found = {
        m: normalise(m, n=exponents, method="quadrature", tolerance=1e-8, seed=means.seed).constant
        for m in ("retro_phong", "stretched_phong")
    }
    over = [c_n(n) / c - 1.0 for n, c in zip(exponents, found["retro_phong"], strict=True)]
    same = float(np.max(np.abs(found["retro_phong"] / found["stretched_phong"] - 1.0)))
    ours = ", ".join(f"{max(x, 0.0):.1e}" for x in over) + " above 1 with c_n of ineq. 6, n = 1, 2, 20"
    L, V = pairs(means)
    turned = apart(retro(20.0)(L, V), stretched(20.0)(mirrored(L), V))
    again = f"f(L, V) is eq. 7's f(R, V) within {turned:.1g} ({PRINTED}): the constants agree within {same:.1g}"
    return Found(max(over) < 4e-4 and turned < SAME, ours, "search of normalise", again)


def becomes_negative(power: float, terms: int = 1) -> Trial:
    """Whether eq. 14 to 16 as printed are BRDFs: nowhere negative, and real."""

    def find(means: Means) -> Found:
        L, V = pairs(means)
        with np.errstate(invalid="ignore"):
            # several terms: two axes of different lengths
            f = sum(
                lafortune((1.0, 1.0, 1.0 / (1.0 + k)), 1.0)(L, V) / np.maximum(L[:, 2], V[:, 2]) ** power for k in range(terms)
            )
            roots = lafortune((1.0, 1.0, 1.0), 2.5)(L, V)
        low, share = float(np.min(f)), float(np.mean(f < 0.0))
        retro_pair = in_plane(np.array([-80.0]))
        single = float(lafortune((1.0, 1.0, 1.0), 1.0)(retro_pair, retro_pair)[0])
        ours = f"n = 1, C = (1, 1, 1): f is negative at {share:.2f} of all pairs, {low:.3g} at the lowest"
        expected, imaginary = math.cos(math.radians(160.0)), float(np.mean(np.isnan(roots)))
        again = (
            f"V = L at 80°: (R·V) = {single:.4f}, cos 160° = {expected:.4f}; n = 2.5: no number at {imaginary:.2f} of all pairs"
        )
        return Found(low >= 0.0, ours, f"{PRINTED}, {MANY} pairs", again)

    return trial(
        find, "the cut ( )⁺ of eq. 5 is missing: an odd n makes it negative behind the lobe, a fraction makes it no number"
    )


def matrix_product(means: Means) -> Found:
    """The special dot product, and its symmetry."""
    L, V = pairs(means)
    C = np.array([0.7, -0.9, 1.1])
    by_matrix = np.einsum("ki,ij,kj->k", mirrored(L), np.diag(C), V)
    by_terms = dot(mirrored(L) * C, V)
    swapped = np.einsum("ki,ij,kj->k", mirrored(V), np.diag(C), L)
    a, b = float(np.max(np.abs(by_matrix - by_terms))), float(np.max(np.abs(by_matrix - swapped)))
    return Found(
        max(a, b) < 1e-14, f"RᵀMV against its three terms: {a:.1g}", PRINTED, f"L and V exchanged: {b:.1g}, so f is reciprocal"
    )


def generalises_phong(means: Means) -> Found:
    """With C = 1 eq. 14 is eq. 5."""
    viewers = np.linspace(-80.0, 89.0, 300)
    f = in_section("lafortune", 50.0, viewers, n=20, scale=1.0)
    g = in_section("phong", 50.0, viewers, n=20, scale=1.0)
    L, V = pairs(means)
    lobes = phong(20.0)(L, V)
    even = apart(np.where(lobes > 0.0, lafortune((1.0, 1.0, 1.0), 20.0)(L, V), 0.0), lobes)
    return Found(
        max(apart(f, g), even) < SAME,
        f"largest relative difference {apart(f, g):.1g}",
        CODE,
        f"{even:.1g} where (R·V) > 0 ({PRINTED})",
    )


def contains_the_p_model(means: Means) -> Found:
    """With C = 1 eq. 15 is eq. 12."""
    viewers = np.linspace(-80.0, 89.0, 300)
    f = in_section("stretched_lafortune", 50.0, viewers, n=20, p=0.5, scale=1.0)
    g = in_section("p_phong", 50.0, viewers, n=20, p=0.5, scale=1.0)
    h = stretched(20.0, 0.5)(in_plane(np.full(300, -50.0)), in_plane(viewers))
    return Found(
        max(apart(f, g), apart(g, h)) < SAME,
        f"largest relative difference {apart(f, g):.1g}",
        CODE,
        f"{apart(g, h):.1g} ({PRINTED}, eq. 12)",
    )


STATEMENTS = (
    Statement(
        "retro_maximum",
        "§3.1",
        "a retro-reflective BRDF which has the maximum at the direction of the incident illumination",
        "Eq. 13 is largest for V = L; n = 20.",
        trial(maximum_at_light),
        ("retro_phong",),
    ),
    Statement(
        "retro_constant",
        "§3.1, after eq. 13",
        "The maximum value of c_n is as defined in equation 6.",
        "With it the albedo is at most 1.0004, n = 1, 2, 20.",
        trial(retro_constant),
        ("retro_phong",),
    ),
    Statement(
        "equation_13",
        "eq. 13",
        "c_n [(L·V)⁺]ⁿ / max((N·L), (N·V))",
        "It is eq. 7 with L in place of R; n = 20.",
        identical(retro(20.0), lambda L, V: stretched(20.0)(mirrored(L), V), "retro_phong", n=20),
        ("retro_phong",),
    ),
    Statement(
        "retro_reciprocal",
        "§3.1, eq. 13",
        "The proposed model can easily be generalized to provide a retro-reflective BRDF",
        "Eq. 13 is reciprocal; n = 100.",
        checked("reciprocity", "PASS", "retro_phong", again=exchanged(retro(100.0)), n=100),
        ("retro_phong",),
    ),
    Statement(
        "equation_14",
        "eq. 14",
        "C_max · (C_x(R_x V_x) + C_y(R_y V_y) + C_z(R_z V_z))ⁿ",
        "As printed it is a BRDF: real and nowhere negative, whatever n > 0.",
        becomes_negative(0.0),
        ("lafortune",),
    ),
    Statement(
        "equation_15",
        "eq. 15",
        "C_max · [(R·V)_M]ⁿ / max((N·L), (N·V))^p",
        "As printed it is a BRDF: real and nowhere negative, whatever n > 0.",
        becomes_negative(1.0),
        ("stretched_lafortune",),
    ),
    Statement(
        "equation_16",
        "eq. 16",
        "Σ C_i · [(R·V)_Mi]^ni / max((N·L), (N·V))^pi",
        "As printed it is a BRDF: real and nowhere negative, whatever the n_i > 0; two terms.",
        becomes_negative(1.0, terms=2),
        ("stretched_lafortune",),
    ),
    Statement(
        "special_dot_product",
        "§3.2, after eq. 14",
        "(R·V)_M = RᵀMV is a special dot product containing also a multiplication with diagonal matrix M",
        "It has the three terms of eq. 14, and does not change when L and V are exchanged.",
        trial(matrix_product),
        ("lafortune",),
    ),
    Statement(
        "anisotropic_phong",
        "§3.2",
        "the anisotropic generalization of the Phong model",
        "With C_x = C_y = C_z = 1 and the cut ( )⁺ eq. 14 is eq. 5.",
        trial(generalises_phong),
        ("lafortune", "phong"),
    ),
    Statement(
        "normalised_lafortune",
        "§3.2, eq. 15",
        "the anisotropic generalization can also be normalized with p-th power of the maximum of the dot products",
        "With C_x = C_y = C_z = 1 eq. 15 is eq. 12.",
        trial(contains_the_p_model),
        ("stretched_lafortune", "p_phong"),
    ),
    Statement(
        "lafortune_reciprocal",
        "§3.2, eq. 15",
        "For the original Phong model, … thus we can obtain",
        "Eq. 15 is reciprocal: C = (0.7, -0.9, 1.1), n = 20, p = 1.",
        checked("reciprocity", "PASS", "stretched_lafortune", again=exchanged(anisotropic), C_x=0.7, C_y=-0.9, C_z=1.1, n=20),
        ("stretched_lafortune",),
    ),
    Statement(
        "fewer_terms",
        "§3.2",
        "This model is able to approximate metals even with a single term, or by fewer terms than required by "
        "Lafortune’s approximation.",
        "How many terms of eq. 15 and of eq. 14 a metal takes.",
        undecided("neither the metal nor the error to be reached is given"),
        ("stretched_lafortune", "lafortune"),
    ),
    Statement(
        "hundred_terms",
        "§3.2",
        "if the RMS slope is less than 0.02, the number of terms may exceed a hundred",
        "How many lobes of eq. 14 a surface of slope 0.02 takes.",
        undecided("the error to be reached is not given, nor which BRDF of that slope is meant"),
        ("lafortune",),
    ),
)
