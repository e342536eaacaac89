"""Statements of the section on Phong's equation, and of what the document says of vertices and pixels."""

from __future__ import annotations

from math import cos, pi, radians

import numpy as np

from albedo_lab.papers.losasso.equations import (
    Array,
    Equation,
    blinn,
    cook_torrance,
    direction,
    dot,
    half_vector,
    hemisphere,
    lambert,
    minnaert,
    oren_nayar,
    phong,
    reflection_vector,
    turned,
)
from albedo_lab.papers.losasso.tried import MANY, swapped
from albedo_lab.papers.recipes import Means
from albedo_lab.papers.record import Statement
from albedo_lab.papers.trials import CLOSED, Found, behaves, checked, extremum, subject_of, trial, unclaimed, undecided
from albedo_lab.pictures.evaluation import values

PHONG = "The Phong Lighting Model"
N = 50
APART = radians(20.0)
"""How far the normals of neighbouring vertices differ, where interpolation is tried."""


def along_edge(count: int = 2001) -> tuple[Array, Array]:
    """Places on an edge whose ends' normals lie APART, and the tilt of the surface's true normal there, 0 in the middle."""
    t = np.linspace(0.0, 1.0, count)
    return t, (t - 0.5) * APART


def interpolated_tilt(t: Array) -> Array:
    """Tilt of the normalised sum (1-t) a + t b of both ends' normals."""
    h = 0.5 * APART
    return np.asarray(np.arctan2((2.0 * t - 1.0) * np.sin(h), np.cos(h)))


def highlight(tilt: Array) -> Array:
    """(E.R)^N where E and L coincide with the normal in the middle: R turns by twice the tilt."""
    return np.asarray(np.cos(2.0 * tilt) ** N)


def accurate_highlights(means: Means) -> Found:
    """Vectors interpolated reproduce the highlight between two vertices; colours do not."""
    t, tilt = along_edge()
    true, by_vectors = highlight(tilt), highlight(interpolated_tilt(t))
    error = float(np.max(np.abs(by_vectors - true)))
    lost = 1.0 - float(highlight(tilt)[0])
    condition = error < 0.01 < lost
    ours = f"largest error {error:.4f} of the peak by vectors, {lost:.4f} by colours"
    return Found(condition, ours, "n = 50, vertices 20° apart", f"1 − cos^50(20°) = {1.0 - cos(APART) ** N:.4f} ({CLOSED})")


def in_the_reflection_direction(means: Means) -> Found:
    """Where the specular term is largest, by a search in the plane of incidence and by many viewers out of it."""
    theta = radians(50.0)
    best, _ = extremum(
        lambda x: np.asarray(phong(N)(np.broadcast_to(direction(theta), (len(x), 3)), direction(x, pi))), 0.0, 1.55
    )
    E = hemisphere(means.seed, 200_000)
    f = values(subject_of("phong_original", n=N), np.broadcast_to(direction(theta), E.shape), E)
    off = float(np.degrees(np.arccos(E[int(np.argmax(f))] @ reflection_vector(direction(theta)))))
    ours = f"largest at {np.degrees(best):.4f}° for a light at 50°"
    return Found(
        abs(best - theta) < 1e-4 and off < 1.0, ours, "search in the equation", f"{off:.1f}° from R, of 200 000 viewers (model)"
    )


def diffuse_is_lamberts(means: Means) -> Found:
    """With k_s = 0 both equations are one; so are the terms in N.L of random pairs."""
    L, E = hemisphere(means.seed, MANY), hemisphere(means.seed + 1, MANY)
    with_specular = lambert(L, E) + phong(N)(L, E)
    apart = float(np.max(np.abs(with_specular - phong(N)(L, E) - dot(L, np.array([0.0, 0.0, 1.0])))))
    return Found(
        apart < 1e-12,
        f"the difference is {apart:.1g}",
        "the equations, k_d = k_s = 1",
        "k_d f_att (N·L) stands in both (the print)",
    )


def sharper(means: Means) -> Found:
    """Half of the peak lies at arccos(2^(-1/n))."""
    n = np.array([1, 5, 20, 100, 1000])
    half = np.degrees(np.arccos(0.5 ** (1.0 / n)))
    R = direction(np.radians(half), pi)
    L = np.broadcast_to(direction(0.0), R.shape)
    again = [float(phong(int(k))(L[i], R[i])) for i, k in enumerate(n)]
    ours = ", ".join(f"{h:.3g}°" for h in half)
    condition = bool(np.all(np.diff(half) < 0.0)) and bool(np.allclose(again, 0.5))
    return Found(
        condition, f"half width at n = 1, 5, 20, 100, 1000: {ours}", CLOSED, f"I there: {again[0]:.6f} of the peak (equation)"
    )


def never_negative(means: Means) -> Found:
    """Light and eye on one side, 80 degrees from the normal: E.R = cos 160 degrees."""
    w = direction(radians(80.0))[None, :]
    odd, even = (float(phong(n)(w, w)[0]) for n in (3, 2))
    model = float(values(subject_of("phong_original", n=3), w, w)[0])
    ours = f"(E·R)^3 = {odd:.4f}, (E·R)^2 = {even:.4f} towards the light at 80°"
    return Found(odd >= 0.0, ours, "the equation", f"cos 160° = {cos(radians(160.0)):.4f}; the model, clamped: {model:g}")


def through_the_normal_alone(means: Means) -> Found:
    """Light and eye turned about the normal together: nothing but N tells where the surface is."""
    rng = np.random.default_rng(means.seed)
    L, E = hemisphere(means.seed, MANY), hemisphere(means.seed + 1, MANY)
    turn = rng.uniform(0.0, 2.0 * pi, MANY)
    equations: dict[str, Equation] = {
        "Phong": phong(N),
        "Cook-Torrance": cook_torrance(0.3),
        "Blinn": blinn(0.3),
        "Oren-Nayar": oren_nayar(0.5),
        "Minnaert": minnaert(0.5),
    }
    apart = {
        name: np.abs(I(turned(L, turn), turned(E, turn)) - I(L, E)) / np.maximum(np.abs(I(L, E)), 1e-9)
        for name, I in equations.items()
    }
    worst = max(apart, key=lambda name: float(np.max(apart[name])))
    largest = float(np.max(apart[worst]))
    again = values(subject_of("oren_nayar", sigma=0.5), turned(L, turn), turned(E, turn)) / values(
        subject_of("oren_nayar", sigma=0.5), L, E
    )
    ours = f"I changes by {largest:.1g} at most ({worst}) when L and E turn about N"
    return Found(
        largest < 1e-9, ours, "the equations, 10 000 turns", f"{float(np.max(np.abs(again - 1.0))):.1g} (model of Oren-Nayar)"
    )


def tessellation(means: Means) -> Found:
    """Ward's lobe with alpha = 0.1, light and eye at the normal in the middle of an edge: at its ends N.H is cos 10 degrees."""
    h = 0.5 * APART
    at_vertex = float(np.exp(-2.0 * (np.sin(h) / 0.1) ** 2 / (1.0 + np.cos(h))))
    fine = float(np.exp(-2.0 * (np.sin(radians(0.5)) / 0.1) ** 2 / (1.0 + np.cos(radians(0.5)))))
    w = direction(np.array([0.0, h]))
    f = values(subject_of("ward", form="half_vector", m=0.1), w, w) * w[:, 2]
    ours = f"the highlight keeps {at_vertex:.3f} of its peak with vertices 20° apart, {fine:.3f} with 1°"
    return Found(at_vertex < 0.5 < fine, ours, "the equation, α = 0.1", f"{f[1] / f[0]:.3f} (model)")


def viewer_ignored(means: Means) -> Found:
    """How much Phong's term changes with the viewer; and that its peak does not change with the light."""
    L = direction(radians(40.0))
    E = direction(np.radians([40.0, 60.0]), pi)
    change = phong(N)(np.broadcast_to(L, E.shape), E)
    model = values(subject_of("phong_original", n=N), np.broadcast_to(L, E.shape), E)
    ours = f"20° beside R, Phong's term is {change[1] / change[0]:.4f} of that in R"
    return Found(abs(change[1] / change[0] - 1.0) < 1e-9, ours, "the equation, n = 50", f"{model[1] / model[0]:.4f} (model)")


def half_angles(means: Means) -> Found:
    """H makes the same angle with both, and lies in their plane."""
    L, E = hemisphere(means.seed, MANY), hemisphere(means.seed + 1, MANY)
    H = half_vector(L, E)
    apart = float(np.max(np.abs(dot(H, L) - dot(H, E))))
    out = float(np.max(np.abs(dot(H, np.cross(L, E)))))
    return Found(max(apart, out) < 1e-12, f"|L·H − E·H| ≤ {apart:.1g}", "10 000 pairs", f"H·(L × E) ≤ {out:.1g}")


def turned_about_the_normal(means: Means) -> Found:
    """R is L turned by 180 degrees about N, of unit length, and E.R = 2 (N.L)(N.E) - L.E."""
    L = hemisphere(means.seed, MANY)
    apart = float(np.max(np.abs(reflection_vector(L) - turned(L, np.full(MANY, pi)))))
    length = float(np.max(np.abs(dot(reflection_vector(L), reflection_vector(L)) - 1.0)))
    return Found(
        max(apart, length) < 1e-12,
        f"R is L turned by 180° within {apart:.1g}",
        "10 000 directions",
        f"|R|² is 1 within {length:.1g}",
    )


STATEMENTS = (
    Statement(
        "phong_diffuse",
        f"{PHONG}, and on its figure",
        "The diffuse component is the same as the Lambertian diffuse component",
        "Without the specular term Phong's equation is Lambert's.",
        trial(diffuse_is_lamberts),
        ("lambert",),
    ),
    Statement(
        "phong_highlight_direction",
        f"{PHONG}, on its figure",
        "the specular highlight is in the direction of the reflection vector",
        "The specular term is largest at E = R; n = 50, light at 50°.",
        trial(in_the_reflection_direction),
        ("phong_original",),
    ),
    Statement(
        "phong_accurate_highlights",
        PHONG,
        "The largest benefit of interpolating vectors across the polygon is that accurate specular highlights can be reproduced",
        "Between vertices whose normals are 20° apart, interpolated vectors keep a highlight of n = 50 within 1 % of its "
        "peak, and interpolated colours do not.",
        trial(accurate_highlights),
    ),
    Statement(
        "phong_appearance",
        PHONG,
        "the visual appearance of the surface is significantly better than per-vertex interpolated lighting",
        "Pictures by interpolated vectors look significantly better.",
        undecided("How good a picture looks is for a beholder; the error of a highlight is tried above."),
    ),
    Statement(
        "phong_plastic",
        PHONG,
        "Objects that are lit by Phong lighting tend to look like various types of plastic",
        "Objects so lit look like plastic.",
        undecided("What a picture looks like is for a beholder; the document states no test."),
        ("phong_original",),
    ),
    Statement(
        "phong_equation_reciprocal",
        f"{PHONG}, equation",
        "I = k_a + k_d f_att (N·L) + k_s f_att (E·R)^n",
        "The specular term over N·L, which is its BRDF, is the same with light and eye exchanged; n = 20.",
        unclaimed(
            checked("reciprocity", "PASS", "phong_original", n=20, again=lambda means: swapped(phong(20), means)),
            "It is not: cos^n / (N·L) has the light's cosine alone. But the equation is Phong's own, and the document does not "
            "call it reciprocal.",
        ),
        ("phong_original",),
    ),
    Statement(
        "phong_equation_grazing",
        f"{PHONG}, equation",
        "I = k_a + k_d f_att (N·L) + k_s f_att (E·R)^n",
        "The share of the light that the specular term sends back stays bounded towards grazing incidence; n = 20.",
        unclaimed(
            behaves("phong_original", "bounded", "vanishes", order="wo", n=20),
            "It does not: the light's irradiance goes to 0 like N·L and the highlight stays. But the equation is Phong's own, "
            "and the document claims no bound for it.",
        ),
        ("phong_original",),
    ),
    Statement(
        "phong_equation_negative",
        f"{PHONG}, equation",
        "k_s f_att (E·R)^n",
        "The specular term is nowhere negative, for light and eye above the horizon.",
        unclaimed(
            trial(never_negative),
            "By the letter an odd n gives negative light, an even one a second highlight towards the light. max(0, E·R) is "
            "left to the reader, as max(0, N·L) is in every equation.",
        ),
        ("phong_original",),
    ),
    Statement(
        "phong_exponent",
        "appendix A, n",
        "The specular exponent determines how ‘sharp’ the specular highlight is (higher is ‘sharper’)",
        "The angle from R at which (E·R)^n is half falls as n grows.",
        trial(sharper),
        ("phong_original",),
    ),
    Statement(
        "phong_reflection_vector",
        "appendix A, R",
        "the direction of the Light Vector, rotated around the Normal Vector 180 degrees … R = 2(L·N)N − L",
        "R is L turned by 180° about N, and a unit vector.",
        trial(turned_about_the_normal),
    ),
    Statement(
        "half_vector",
        "appendix A, H",
        "the average of the light and viewing vector (normalize (L+V))",
        "With V = E, H makes the same angle with both and lies in their plane.",
        trial(half_angles),
    ),
    Statement(
        "bump_mapping",
        "The Phong, Blinn, Oren-Nayar and Minnaert Lighting Models",
        "amenable to add-ons such as bump mapping; well suited for bump mapping",
        "These equations know the surface by its normal alone, so that another normal is all that a bump map must give.",
        trial(through_the_normal_alone),
        ("phong_original", "blinn_trowbridge_reitz", "oren_nayar", "minnaert"),
    ),
    Statement(
        "previous_models_ignored_the_viewer",
        "The Blinn Lighting Model",
        "whereas previous models had ignored the direction of the viewer",
        "Phong's specular term, which the document treats before, does not depend on the viewer.",
        unclaimed(
            trial(viewer_ignored),
            "Phong's does, and the document treats it before; but the sentence is about work of 1967, and does not name the "
            "models that were before it.",
        ),
        ("phong_original",),
    ),
    Statement(
        "ward_tessellation",
        "Ward's Anisotropic Lighting Model",
        "Proper tessellation is essential when per vertex calculations are used",
        "A highlight of α = 0.1 loses more than half of its peak between vertices whose normals are 20° apart, and less with 1°.",
        trial(tessellation),
        ("ward",),
    ),
)
