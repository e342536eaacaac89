"""Statements of the section on Blinn's equation."""

from __future__ import annotations

from math import pi, sqrt

import numpy as np

from albedo_lab.papers.losasso.cook_torrance import M
from albedo_lab.papers.losasso.equations import beckmann, blinn, cavities, ellipsoids, half_vector, hemisphere, reflected
from albedo_lab.papers.losasso.tried import FRACTION, MANY, dated, fraction, lit, swapped
from albedo_lab.papers.recipes import Means
from albedo_lab.papers.record import Evidence, Statement
from albedo_lab.papers.trials import CLOSED, Found, checked, subject_of, trial, undecided
from albedo_lab.pictures.evaluation import values

BLINN = "The Blinn Lighting Model"
EQUATION = "I = k_s f_att D G F_λ(θ_i) / (E·N); D = (c² / ((N·H)² (c² − 1) + 1))²"
C = 0.3
"""The c that is tried where the document names none."""


def same_form(means: Means) -> Found:
    """With the D of the one in the other, both intensities should be in one proportion for every pair of directions."""
    L, E = hemisphere(means.seed, MANY), hemisphere(means.seed + 1, MANY)
    cook = ellipsoids(C, half_vector(L, E)[:, 2]) * cavities(L, E) / (pi * E[:, 2])
    ratios = blinn(C)(L, E) / cook
    ratio, apart = float(np.median(ratios)), float(np.ptp(ratios))
    f = values(subject_of("blinn_trowbridge_reitz", as_printed="yes", c=C), L, E) * L[:, 2]
    ours = f"Blinn's I over Cook-Torrance's with the same D: {ratio:.6f} for every pair, within {apart:.1g}"
    again = f"{float(np.median(f / cook)):.6f} (model)"
    return Found(apart < 1e-9, ours, "the equations, 10 000 pairs, c = 0.3", again)


def similar(means: Means) -> Evidence:
    """The share that both normalised distributions of facets have in common, for the c that is best for m = 0.3."""
    t = np.linspace(1e-4, 1.0, 20_001)
    weight = 2.0 * pi * t * (t[1] - t[0])
    normalised = 4.0 / pi * beckmann(M, t)

    def common(c: float) -> float:
        return float(np.sum(weight * np.minimum(normalised, ellipsoids(c, t) / (pi * c * c))))

    best = max((float(c) for c in np.linspace(0.1, 0.5, 81)), key=common)
    tried = f"{common(best):.3f} of the facets of m = 0.3 and of c = {best:.3f} are distributed alike at best"
    why = "“Similar” has no measure in the document. As printed, the brightness differs besides."
    return undecided(why, tried)(means)


def eccentricity(means: Means) -> Found:
    """Of a spheroid with half-axes 1, 1 and c: D goes like the inverse of its curvature, and its eccentricity is another."""
    c = 0.6
    t = np.linspace(0.05, 1.0, 200)
    # area per solid angle of its normals, a^4 b^2 / (a^2 sin^2 + b^2 cos^2)^2, over that at its pole
    inverse_curvature = (c * c / ((1.0 - t * t) + c * c * t * t)) ** 2
    apart = float(np.max(np.abs(ellipsoids(c, t) / inverse_curvature - 1.0)))
    e = sqrt(1.0 - c * c)
    # the distance of the foci, from which every point of the ellipse is as far as from the directrix, times e
    v = np.linspace(0.1, 1.4, 50)
    x, z = np.cos(v), c * np.sin(v)
    again = float(np.mean(np.hypot(x - e, z) / (1.0 / e - x)))
    ours = f"the spheroid of axis ratio c = {c:g}, which D describes within {apart:.1g}, has the eccentricity {e:.3f}"
    return Found(abs(c - e) < 1e-9, ours, "Gaussian curvature", f"{again:.3f} (focus and directrix)")


def shiny_to_dull(means: Means) -> Found:
    """The angle of the facets at which D is half of its peak, as c grows; at c = 1 it never is."""
    c = np.array([0.01, 0.1, 0.3, 0.5])
    half = np.degrees(np.arccos(np.sqrt((1.0 - sqrt(2.0) * c**2) / (1.0 - c**2))))
    D = [float(ellipsoids(float(k), float(np.cos(np.radians(a))))) for k, a in zip(c, half, strict=True)]
    flat = float(np.ptp(ellipsoids(1.0, np.linspace(0.0, 1.0, 101))))
    condition = bool(np.all(np.diff(half) > 0.0)) and bool(np.allclose(D, 0.5)) and flat == 0.0
    angles = ", ".join(f"{a:.2f}°" for a in half)
    ours = f"D is half at {angles} for c = 0.01, 0.1, 0.3, 0.5; it varies by {flat:g} for c = 1"
    return Found(condition, ours, CLOSED, f"D there {D[0]:.6f} (the equation)")


STATEMENTS = (
    Statement(
        "blinn_torrance_sparrow_1967",
        BLINN,
        "the work done in 1967 by Torrance and Sparrow",
        "Torrance and Sparrow published their theory in 1967.",
        trial(dated(1967, ("TORR67 of schlick1993", 1967), ("23 of neumann1999, an earlier paper", 1966))),
    ),
    Statement(
        "blinn_same_form",
        f"{BLINN}, after its equation",
        "The lighting equation has the same form as the Cook-Torrance lighting equation above",
        "With one D and one f_att in both, the specular terms are in one proportion for every pair of directions.",
        trial(same_form),
        ("blinn_trowbridge_reitz", "cook_torrance"),
    ),
    Statement(
        "blinn_similar",
        f"{BLINN}, first paragraph and on its figure",
        "yields similar results; clearly show that Blinn lighting is similar to Cook-Torrance Lighting",
        "The normalised lobes of both are similar.",
        similar,
        ("blinn_trowbridge_reitz", "cook_torrance"),
    ),
    Statement(
        "blinn_reciprocal",
        f"{BLINN}, equation",
        EQUATION,
        "I over N·L is the same with light and eye exchanged; c = 0.3, F = 1.",
        checked(
            "reciprocity",
            "PASS",
            "blinn_trowbridge_reitz",
            as_printed="yes",
            c=C,
            again=lambda means: swapped(blinn(C), means),
        ),
        ("blinn_trowbridge_reitz",),
    ),
    Statement(
        "blinn_energy",
        f"{BLINN}, equation",
        EQUATION,
        "With k_s = F = 1 and c = 0.5 the equation creates no energy under the irradiance π for which k_d is Lambert's.",
        checked(
            "energy",
            "PASS",
            "blinn_trowbridge_reitz",
            as_printed="yes",
            c=0.5,
            scale=1.0 / pi,
            again=lambda means: lit(blinn(0.5), pi),
        ),
        ("blinn_trowbridge_reitz",),
    ),
    Statement(
        "blinn_k_s",
        f"{BLINN}, equation, and appendix A, k_s",
        FRACTION,
        "With c = 0.1 and F = 1, k_s is the share that the term reflects, under the irradiance π for which k_d is Lambert's.",
        trial(
            fraction("blinn_trowbridge_reitz", lambda: reflected(blinn(0.1), 0.0, pi), as_printed="yes", c=0.1),
            "4c² of the light, less what the cavities hide, comes back: a shiny surface is nearly black. 1 / (4c²) is "
            "missing, or 1 / (4πc²) under unit irradiance.",
        ),
        ("blinn_trowbridge_reitz",),
    ),
    Statement(
        "blinn_eccentricity",
        "appendix A, c",
        "Ellipsoid Eccentricity: The eccentricity of the micro facets",
        "c is the eccentricity of the ellipsoid whose normals D counts.",
        trial(eccentricity, "c is the ratio of the axes; the eccentricity is √(1 − c²), 0 for the sphere, which is the dullest."),
        ("blinn_trowbridge_reitz",),
    ),
    Statement(
        "blinn_shiny_to_dull",
        "appendix A, c",
        "(0 for very shiny, 1 for very dull)",
        "D widens as c grows, and is constant at c = 1.",
        trial(shiny_to_dull),
        ("blinn_trowbridge_reitz",),
    ),
    Statement(
        "blinn_metal",
        BLINN,
        "it is now possible to make surfaces that look more like metal than plastic using this equation",
        "Such surfaces look like metal.",
        undecided("What a picture looks like is for a beholder; the document states no test."),
        ("blinn_trowbridge_reitz",),
    ),
)
