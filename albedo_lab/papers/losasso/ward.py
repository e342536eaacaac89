"""Statements of the section on Ward's equation."""

from __future__ import annotations

from math import pi, radians, sqrt

import numpy as np
from scipy.integrate import quad

from albedo_lab.papers.losasso.equations import Array, direction, half_vector, hemisphere, reflected, turned, ward
from albedo_lab.papers.losasso.tried import FRACTION, MANY, dated, fraction, swapped
from albedo_lab.papers.recipes import Means
from albedo_lab.papers.record import Statement
from albedo_lab.papers.trials import CLOSED, Found, behaves, checked, subject_of, trial, unclaimed
from albedo_lab.pictures.evaluation import values

WARD = "Ward's Anisotropic Lighting Model"
EQUATION = "k_s f_att 1/√((N·L)(N·E)) (N·L)/(4 α_x α_y) e^(−2 ((H·X/α_x)² + (H·Y/α_y)²)/(1 + H·N))"
ALPHA = 0.2
"""The alpha that is tried where the document names none."""


def isotropy(means: Means) -> Found:
    """Turning the surface is turning light and eye together: with equal and with unequal alphas."""
    L, E = hemisphere(means.seed, MANY), hemisphere(means.seed + 1, MANY)
    quarter = np.full(MANY, 0.5 * pi)

    def change(I: Array, J: Array) -> float:
        bright = np.maximum(I, J) > 1e-9
        return float(np.max(np.abs(np.log(np.maximum(I, 1e-300) / np.maximum(J, 1e-300)))[bright]))

    same, other = (
        change(ward(x, y)(turned(L, quarter), turned(E, quarter)), ward(x, y)(L, E)) for x, y in ((ALPHA, ALPHA), (ALPHA, 0.5))
    )
    f = subject_of("ward", form="half_vector", m=ALPHA)
    again = change(values(f, turned(L, quarter), turned(E, quarter)), values(f, L, E))
    ours = f"a quarter turn changes log I by {same:.1g} at most with equal α, by up to {other:.2g} with α = 0.2 and 0.5"
    return Found(same < 1e-9 < other, ours, "the equation, 10 000 pairs", f"{again:.1g} (model, equal α)")


def texture_axes(means: Means) -> Found:
    """N.L and N.H while the surface turns about its normal."""
    L, E = hemisphere(means.seed, MANY), hemisphere(means.seed + 1, MANY)
    turn = np.random.default_rng(means.seed).uniform(0.0, 2.0 * pi, MANY)
    light, H = turned(L, turn), half_vector(turned(L, turn), turned(E, turn))
    change = max(float(np.max(np.abs(a[:, 2] - b[:, 2]))) for a, b in ((light, L), (H, half_vector(L, E))))
    tangent = float(np.max(np.abs(light[:, 0] - L[:, 0])))
    ours = f"N·L and N·H change by {change:.1g} when the surface turns: no table of both is anisotropic"
    return Found(change > 1e-9, ours, "10 000 turns", f"the cosine with a tangent, X·L, changes by up to {tangent:.2f}")


def deviation_of_slope(means: Means) -> Found:
    """Of the slope along X, for facets whose density per slope is exp(-(x/a)^2 - (y/a)^2) / (pi a^2)."""
    ours = sqrt(quad(lambda x: x * x * np.exp(-((x / ALPHA) ** 2)), -np.inf, np.inf)[0] / (ALPHA * sqrt(pi)))
    u = np.random.default_rng(means.seed).random((2, 1_000_000))
    slopes = ALPHA * np.sqrt(-np.log1p(-u[0])) * np.cos(2.0 * pi * u[1])
    words = f"standard deviation along X: {ours:.6f} for α_x = 0.2"
    again = f"{float(np.std(slopes)):.4f} of a million slopes drawn"
    return Found(abs(ours / ALPHA - 1.0) < 1e-6, words, "scipy.integrate.quad", again)


def near_the_normal(means: Means) -> Found:
    """The exponent over that of Ward's Gaussian of slopes, tan^2(delta) / alpha^2, for half-vectors near the normal and not."""
    delta = np.radians([1.0, 10.0, 45.0])
    ratio = 2.0 * np.sin(delta) ** 2 / (1.0 + np.cos(delta)) / np.tan(delta) ** 2
    w = direction(delta)
    m = 0.5
    chord, slope = (
        np.log(values(subject_of("ward", form=form, m=m), w, w) * np.cos(delta) * 4.0 * pi * m * m)
        for form in ("half_vector", "tangent")
    )
    ours = f"exponent over the Gaussian's: {ratio[0]:.6f} at 1°, {ratio[1]:.4f} at 10°, {ratio[2]:.3f} at 45°"
    again = f"{chord[1] / slope[1]:.4f} at 10°, {chord[2] / slope[2]:.3f} at 45° (both models)"
    return Found(abs(float(ratio[0]) - 1.0) < 1e-3, ours, CLOSED, again)


def across_the_groove(means: Means) -> Found:
    """The lobe's width along X and Y, for grooves along X: slopes across them are steeper."""
    x, y = 0.1, 0.4
    angle = np.linspace(0.0, radians(80.0), 80_001)
    L = np.broadcast_to(direction(0.0), (len(angle), 3))
    half = []
    for phi in (0.0, 0.5 * pi):
        I = ward(x, y)(L, direction(angle, phi))
        half.append(float(np.degrees(angle[int(np.argmax(0.5 * I[0] > I))])))
    E = np.stack([direction(radians(30.0)), direction(radians(30.0), 0.5 * pi)])
    f = values(subject_of("ward", form="half_vector", m_x=x, m_y=y), L[:2], E)
    ours = f"half width {half[0]:.1f}° along the groove, {half[1]:.1f}° across it (α = 0.1, 0.4)"
    again = f"f across over f along at 30°: {f[1] / f[0]:.3g} (model)"
    return Found(half[1] > half[0], ours, "the equation, light at the normal", again)


STATEMENTS = (
    Statement(
        "ward_isotropic",
        WARD,
        "the light reflected does not change when the surface is rotated about the normal",
        "The equation is isotropic by this definition where α_x = α_y, and not otherwise.",
        trial(isotropy),
        ("ward",),
    ),
    Statement(
        "ward_texture_axes",
        WARD,
        "a texture lookup based on the cosine of the angle between the surface normal and the light vector on one axis, "
        "and the cosine of the angle between the surface normal and the half angle vector on the other axis",
        "A table of these two cosines can be anisotropic.",
        trial(
            texture_axes,
            "Neither cosine changes when the surface turns about its normal, which by the document's own definition is "
            "isotropy. The tangent is meant in place of the normal.",
        ),
    ),
    Statement(
        "ward_1992",
        WARD,
        "the BRDF introduced by Greg Ward Larson in 1992",
        "Ward published the model in 1992.",
        trial(dated(1992, ("WARD92 of schlick1993", 1992), ("24 of neumann1999", 1992))),
        ("ward",),
    ),
    Statement(
        "ward_reciprocal",
        f"{WARD}, equation",
        EQUATION,
        "The specular term over N·L is the same with light and eye exchanged; α = 0.2.",
        checked(
            "reciprocity",
            "PASS",
            "ward",
            form="half_vector",
            as_printed="yes",
            m=ALPHA,
            again=lambda means: swapped(ward(ALPHA, ALPHA), means),
        ),
        ("ward",),
    ),
    Statement(
        "ward_k_s",
        f"{WARD}, equation, and appendix A, k_s",
        FRACTION,
        "With α = 0.05, k_s is the share that the term reflects at normal incidence, within 1 %, under the irradiance π for "
        "which k_d is Lambert's.",
        trial(fraction("ward", lambda: reflected(ward(0.05, 0.05), 0.0, pi), form="half_vector", as_printed="yes", m=0.05)),
        ("ward",),
    ),
    Statement(
        "ward_grazing",
        f"{WARD}, equation",
        EQUATION,
        "The share of the light that the specular term sends back stays bounded towards grazing incidence; α = 0.2.",
        unclaimed(
            behaves("ward", "bounded", "vanishes", form="half_vector", as_printed="yes", m=ALPHA),
            "It does not: the light's cosine under the root outweighs the half of the lobe that falls below the horizon. But "
            "the model is Ward's own, and the document claims no bound for it.",
        ),
        ("ward",),
    ),
    Statement(
        "ward_exponent",
        f"{WARD}, equation",
        "e^(−2 ((H·X/α_x)² + (H·Y/α_y)²)/(1 + H·N))",
        "Near H = N the exponent is that of a Gaussian of slopes, −tan²δ / α².",
        trial(near_the_normal),
        ("ward",),
    ),
    Statement(
        "ward_standard_deviation",
        f"{WARD}, after its equation",
        "The α terms are the standard deviations of the slope in the X and Y direction",
        "The slope along X of facets with this Gaussian has the standard deviation α_x.",
        trial(
            deviation_of_slope,
            "e^(−(x/α)²) has the standard deviation α/√2 along each axis; α is the RMS of the slope in all directions together.",
        ),
        ("ward",),
    ),
    Statement(
        "ward_across_the_groove",
        f"{WARD}, on its figure",
        "the lobe of reflected light is oriented perpendicularly to the groove in the surface",
        "With grooves along X (α_x = 0.1, α_y = 0.4) the lobe of a light at the normal is wider along Y.",
        trial(across_the_groove),
        ("ward",),
    ),
)
