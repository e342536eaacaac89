"""Statements of the section on Cook and Torrance's equation."""

from __future__ import annotations

from collections.abc import Callable
from math import pi, radians, sqrt

import numpy as np
from scipy.integrate import quad

from albedo_lab.optics.fresnel import conductor
from albedo_lab.optics.metals import index
from albedo_lab.papers.losasso.equations import (
    Array,
    beckmann,
    blinn,
    cavities,
    cook_torrance,
    direction,
    dot,
    fresnel,
    half_vector,
    hemisphere,
    lambert,
    reflected,
)
from albedo_lab.papers.losasso.tried import MANY, PRINTED, lit, share, swapped, told
from albedo_lab.papers.recipes import Means
from albedo_lab.papers.record import Statement
from albedo_lab.papers.trials import CLOSED, Found, checked, extremum, subject_of, trial, unclaimed, undecided
from albedo_lab.pictures.evaluation import values

COOK_TORRANCE = "The Cook-Torrance Lighting Model"
M, GLASS = 0.3, 1.5
"""The m and the index of refraction that are tried where the document names none."""
CAP = radians(10.0)


def over_normals(g: Callable[[float], float]) -> float:
    """The integral over the hemisphere of D of the print times a function of the normal's cosine t."""
    return float(2.0 * pi * quad(lambda t: float(beckmann(M, t)) * g(t), 1e-9, 1.0, epsabs=1e-13, epsrel=1e-12, limit=200)[0])


def specular_term(means: Means) -> Found:
    """The print against Torrance and Sparrow's D G / (4 N.L N.E) with Beckmann's distribution normalised."""
    L, E = hemisphere(means.seed, MANY), hemisphere(means.seed + 1, MANY)
    t = half_vector(L, E)[:, 2]
    normalised = np.exp(-(1.0 - t * t) / (M * t) ** 2) / (pi * M**2 * t**4)
    right = normalised * cavities(L, E) / (4.0 * L[:, 2] * E[:, 2])
    printed = cook_torrance(M)(L, E) / L[:, 2]
    apart = float(np.max(np.abs(printed - right) / np.maximum(right, 1e-290)))
    one = 4.0 / pi * over_normals(lambda t: t)
    ours = f"I / (N·L) is D G / (4 (N·L)(N·E)) within {apart:.1g}, ∫ D cos = {one:.9f}"
    model, grid = share("cook_torrance", 30.0, 1.0, m=M), reflected(cook_torrance(M), radians(30.0), 1.0)
    again = f"share reflected at 30°: {told(model)} (model, quadrature), {grid:.6f} ({PRINTED})"
    condition = apart < 1e-11 and abs(one - 1.0) < 1e-9 and abs(model.value - grid) < 1e-5
    return Found(condition, ours, "the equation, 10 000 pairs, m = 0.3", again)


def distribution_alone(means: Means) -> Found:
    """The integral of the printed D cos over the hemisphere, times 4/π: the equation has 1/π for Torrance and Sparrow's 1/4."""
    ours = over_normals(lambda t: t)
    words = f"∫ D cos(β) dω = {ours:.9f} for m = 0.3; times the equation's 4/π, {4.0 / pi * ours:.9f}"
    return Found(abs(4.0 / pi * ours - 1.0) < 1e-9, words, "scipy.integrate.quad", f"π/4 = {pi / 4.0:.9f} ({CLOSED})")


def rms_slope(means: Means) -> Found:
    """The mean of tan^2(beta) over the facets, weighed by the area that they cover."""
    ours = sqrt(over_normals(lambda t: (1.0 - t * t) / t) / over_normals(lambda t: t))
    u = np.random.default_rng(means.seed).random(1_000_000)
    again = sqrt(float(np.mean(-(M**2) * np.log1p(-u))))
    words = f"RMS slope {ours:.9f} for m = 0.3"
    return Found(abs(ours - M) < 1e-9, words, "scipy.integrate.quad", f"{again:.4f} of a million facets drawn")


def spreads(means: Means) -> Found:
    """The angle within which half of the facets' area lies, m sqrt(log 2) in slope, and the share that is within it."""
    m = np.array([0.05, 0.1, 0.2, 0.4, 0.8])
    half = np.degrees(np.arctan(m * sqrt(np.log(2.0))))
    within = [over_cap(float(each), radians(float(a))) for each, a in zip(m, half, strict=True)]
    ours = ", ".join(f"{a:.1f}°" for a in half)
    condition = bool(np.all(np.diff(half) > 0.0)) and bool(np.allclose(within, 0.5, atol=1e-6))
    words = f"half of the facets within {ours} for m = 0.05, 0.1, 0.2, 0.4, 0.8"
    return Found(condition, words, CLOSED, f"share there {within[0]:.6f} (quadrature)")


def over_cap(m: float, angle: float) -> float:
    """The share of facets within an angle of the normal, by integrating the printed D."""
    inside = quad(lambda t: float(beckmann(m, t)) * t, np.cos(angle), 1.0, epsabs=1e-13, epsrel=1e-12)[0]
    return float(2.0 * pi * inside / (pi / 4.0))


def near_the_mirror(intensity: Array, E: Array, R: Array) -> float:
    """The share of what is seen, over the hemisphere, within 10 degrees of R; E is uniform."""
    flux = intensity * E[:, 2]
    return float(np.sum(flux[dot(E, R) > np.cos(CAP)]) / np.sum(flux))


def lambertian_facets(means: Means) -> Found:
    """Nearly flat facets: Lambertian ones would send 3 % into the cone of 10 degrees about R, mirrors send nearly all."""
    theta, m = radians(30.0), 0.05
    R = direction(theta, pi)
    E = hemisphere(means.seed, 300_000)
    L = np.broadcast_to(direction(theta), E.shape)
    ours = near_the_mirror(cook_torrance(m)(L, E), E, R)
    model = near_the_mirror(values(subject_of("cook_torrance", m=m), L, E), E, R)
    flat = near_the_mirror(lambert(L, E), E, R)
    words = f"{ours:.3f} of the light within 10° of R; Lambertian facets would send {flat:.3f} there"
    return Found(abs(ours - flat) < 0.01, words, "the equation, m = 0.05, light at 30°", f"{model:.3f} (model)")


def diffuse_term(means: Means) -> Found:
    """k_d rho (L.N) over k_s D G F / (pi E.N) with the printed rho: another function of L and E, if it is diffuse."""
    L, E = hemisphere(means.seed, MANY), hemisphere(means.seed + 1, MANY)
    third = cook_torrance(M)(L, E)
    rho = beckmann(M, half_vector(L, E)[:, 2]) * cavities(L, E) / (pi * L[:, 2] * E[:, 2])
    bright = third > 1e-200
    ratio = rho[bright] * L[bright, 2] / third[bright]
    model = values(subject_of("cook_torrance", m=M), L, E)[bright] * L[bright, 2] / third[bright]
    ours = f"ρ (L·N) is the specular term times {float(np.median(ratio)):.6f}, everywhere"
    again = f"the specular term is the model's within {float(np.max(np.abs(model - 1.0))):.1g}"
    return Found(float(np.ptp(ratio)) > 1e-9, ours, "the equation, 10 000 pairs, k_d = k_s = f_att = 1", again)


def attenuated(means: Means) -> Found:
    """A light at a distance of 10 with c_3 = 1, against one at 1: the term as printed, which holds no distance."""
    f_att = min(1.0 / 10.0**2, 1.0)
    L, E = direction(radians(30.0))[None, :], direction(np.array([radians(30.0)]), pi)
    near = float(cook_torrance(M)(L, E)[0])
    far = near  # d is nowhere in it
    other = float(blinn(0.3)(L, E)[0])
    ours = f"specular term at d = 10 over that at d = 1: {far / near:.4f} as printed"
    again = f"Blinn's, printed with f_att: {f_att * other / other:.4f}"
    return Found(abs(far / near - f_att) < 1e-9, ours, "the equation, c₃ = 1", again)


def nothing_absorbed(means: Means) -> Found:
    """Reflectance plus transmittance of a boundary, the latter from the amplitudes that go through it."""
    c = np.linspace(0.01, 1.0, 100)
    g = np.sqrt(GLASS**2 + c**2 - 1.0)  # n times the cosine inside
    s, p = 2.0 * c / (c + g), 2.0 * GLASS * c / (GLASS**2 * c + g)
    through = 0.5 * g / c * (s**2 + p**2)
    lost = float(np.max(np.abs(1.0 - fresnel(GLASS, c) - through)))
    ours = f"absorbed at the boundary: at most {lost:.1g}; at θ = 0, {float(through[-1]):.4f} goes through (n = 1.5)"
    again = f"1 − F(0) = {1.0 - conductor(GLASS, 0.0, 1.0):.4f} (optics.fresnel)"
    return Found(lost > 1e-9, ours, "Fresnel's amplitudes of what is transmitted", again)


def mirror_like(means: Means) -> Found:
    """F of water's n towards grazing angles."""
    c = np.cos(np.radians([0.0, 80.0, 89.0]))
    F = fresnel(1.33, c)
    again = conductor(1.33, 0.0, float(c[2]))
    ours = f"F = {', '.join(f'{v:.3f}' for v in F)} at 0°, 80°, 89° (n = 1.33)"
    return Found(bool(F[2] > 0.8 > 0.1 > F[0]), ours, "the corrected equation", f"{again:.3f} at 89° (optics.fresnel)")


def wavelength_dependent(means: Means) -> Found:
    """Gold's reflectance in the blue and in the red."""
    indices = [index("gold", nm) for nm in (450.0, 650.0)]
    F = [conductor(n, k, 1.0) for n, k in indices]
    again = [((n - 1.0) ** 2 + k**2) / ((n + 1.0) ** 2 + k**2) for n, k in indices]
    ours = f"gold: F = {F[0]:.3f} at 450 nm, {F[1]:.3f} at 650 nm"
    return Found(F[1] - F[0] > 0.1, ours, "measured indices, exact F", f"{again[0]:.3f}, {again[1]:.3f} ({CLOSED}, θ = 0)")


def off_specular(means: Means) -> Found:
    """How far beyond R the lobe is brightest, for a light at 15 and at 75 degrees."""
    m = 0.15

    def beyond(theta_deg: float) -> float:
        L = direction(radians(theta_deg))
        I = cook_torrance(m)
        best, _ = extremum(lambda x: I(np.broadcast_to(L, (len(x), 3)), direction(x, pi)), 0.0, radians(89.9), 20_001)
        return float(np.degrees(best)) - theta_deg

    near, far = beyond(15.0), beyond(75.0)
    viewer_deg = np.linspace(70.0, 89.9, 20_000)
    E = direction(np.radians(viewer_deg), pi)
    f = values(subject_of("cook_torrance", m=m), np.broadcast_to(direction(radians(75.0)), E.shape), E)
    again = float(viewer_deg[int(np.argmax(f))]) - 75.0
    ours = f"peak {near:+.2f}° from R at 15°, {far:+.2f}° at 75°"
    condition = far > 5.0 > 2.0 > abs(near)
    return Found(condition, ours, "search in the equation, m = 0.15, F = 1", f"{again:+.2f}° at 75° (model)")


def masking(means: Means) -> Found:
    """G lies in [0, 1], is symmetric, and 0 where the eye grazes."""
    L, E = hemisphere(means.seed, MANY), hemisphere(means.seed + 1, MANY)
    G = cavities(L, E)
    uneven = float(np.max(np.abs(G - cavities(E, L))))
    grazing = float(cavities(direction(radians(30.0)), direction(radians(89.9999), pi)))
    whole = values(subject_of("cook_torrance", m=M, geometry="none"), L, E)
    bright = whole > 1e-200
    again = float(np.max(np.abs(values(subject_of("cook_torrance", m=M), L, E)[bright] / whole[bright] - G[bright])))
    condition = float(G.min()) >= 0.0 and float(G.max()) <= 1.0 and grazing < 1e-4 and uneven < 1e-10
    ours = f"G in [{G.min():.4f}, {G.max():.4f}], symmetric within {uneven:.1g}, {grazing:.1g} for E at 89.9999°"
    return Found(condition, ours, "the equation with V = E, 10 000 pairs", f"model with over without it: within {again:.1g}")


EQUATION = "I = k_a + k_d ρ (L·N) + k_s D G F_λ(θ_i) / (π (E·N)); ρ = k_s f_att D G F_λ(θ_i) / (π (L·N)(E·N))"
NICE = "has all the nice properties one would expect a BRDF to have (such as energy conservation, …"
AFTER = f"{COOK_TORRANCE}, after its equation"

STATEMENTS = (
    Statement(
        "ct_energy",
        COOK_TORRANCE,
        NICE,
        "The specular term creates no energy under unit irradiance; m = 0.3, F = 1.",
        checked("energy", "PASS", "cook_torrance", m=M, again=lambda means: lit(cook_torrance(M))),
        ("cook_torrance",),
    ),
    Statement(
        "ct_reciprocal",
        COOK_TORRANCE,
        NICE,
        "The specular term over N·L is the same with light and eye exchanged; m = 0.3, F = 1.",
        checked("reciprocity", "PASS", "cook_torrance", m=M, again=lambda means: swapped(cook_torrance(M), means)),
        ("cook_torrance",),
    ),
    Statement(
        "ct_predictive",
        COOK_TORRANCE,
        "… complex substructures, and a predictive result)",
        "The model predicts what real surfaces reflect.",
        undecided("No surface and no measurement is named."),
        ("cook_torrance",),
    ),
    Statement(
        "ct_lambertian_facets",
        COOK_TORRANCE,
        "the surface is made up of microscopic perfect Lambertian reflectors called microfacets",
        "Nearly flat, the surface reflects as Lambertian facets would.",
        trial(
            lambertian_facets,
            "The facets are mirrors: only those whose normal is H send light from L to E. Lambertian facets are Oren and "
            "Nayar's.",
        ),
        ("cook_torrance", "lambert"),
    ),
    Statement(
        "ct_specular_term",
        f"{COOK_TORRANCE}, equation",
        "k_s D G F_λ(θ_i) / (π (E·N)); D = e^(−(tan(β)/m)²) / (4 m² cos⁴(β))",
        "As a whole the term is N·L D G F / (4 (N·L)(N·E)) with Beckmann's distribution normalised; m = 0.3.",
        trial(specular_term),
        ("cook_torrance",),
    ),
    Statement(
        "ct_distribution",
        AFTER,
        "The D term in the equation is the distribution function of the microfacets",
        "The printed D is Beckmann's distribution up to a constant, which the equation makes good by 1/π in place of 1/4: "
        "4/π ∫ D cos(β) dω = 1 over the hemisphere.",
        trial(distribution_alone),
        ("cook_torrance",),
    ),
    Statement(
        "ct_diffuse_term",
        f"{COOK_TORRANCE}, equation",
        EQUATION,
        "The term with k_d is a diffuse one: it depends on the directions in another way than the specular term.",
        trial(
            diffuse_term,
            "ρ is the specular reflectance, so that k_d ρ (L·N) is the specular term once more, times k_d: no part is diffuse.",
        ),
        ("cook_torrance",),
    ),
    Statement(
        "ct_attenuation",
        f"{COOK_TORRANCE}, equation",
        "k_s D G F_λ(θ_i) / (π (E·N))",
        "The specular term is attenuated with the light's distance.",
        trial(attenuated, "f_att stands in ρ and is missing here; Blinn's equation “of the same form” has it."),
        ("cook_torrance",),
    ),
    Statement(
        "ct_rms_slope",
        AFTER,
        "The m parameter is the root-mean-square (RMS) of the slope of the microfacets",
        "The mean square of tan β over the facets is m²; m = 0.3.",
        trial(rms_slope),
        ("cook_torrance",),
    ),
    Statement(
        "ct_large_m_spreads",
        AFTER,
        "a large m makes the reflections spread out",
        "The cone about the normal that holds half of the facets widens with m.",
        trial(spreads),
        ("cook_torrance",),
    ),
    Statement(
        "ct_masking",
        f"{COOK_TORRANCE}, and appendix A, G",
        "how the individual microfacets shadow and mask each other; G = min{1, 2(N·H)(N·E)/(E·H), 2(N·H)(N·L)/(V·H)}",
        "With V = E, G lies between 0 and 1, is symmetric, and goes to 0 where the eye grazes.",
        trial(masking),
        ("cook_torrance",),
    ),
    Statement(
        "ct_wavelength",
        AFTER,
        "the Fresnel Conductance term that is wavelength dependent (notice the λ)",
        "Gold's reflectance at normal incidence differs between 450 and 650 nm.",
        trial(wavelength_dependent),
    ),
    Statement(
        "ct_reflected_versus_absorbed",
        AFTER,
        "the amount of light that is reflected versus absorbed as the incident angle changes",
        "With the real n of the appendix, 1 − F is absorbed.",
        unclaimed(
            trial(nothing_absorbed),
            "At a boundary of a real index nothing is absorbed: what is not reflected goes through. In a metal it is absorbed "
            "soon, and the sentence does not say of which it speaks.",
        ),
    ),
    Statement(
        "ct_grazing_mirror",
        AFTER,
        "the road appearing mirror-like when viewed from grazing angles",
        "F of n = 1.33 exceeds 0.8 at 89° and is below 0.1 at 0°.",
        trial(mirror_like),
    ),
    Statement(
        "ct_change_of_behaviour",
        f"{COOK_TORRANCE}, on its figure",
        "Notice the complete change in behavior when the incident angle is large",
        "The lobe's peak lies within 2° of R for a light at 15°, and more than 5° beyond it at 75°; m = 0.15, F = 1.",
        trial(off_specular),
        ("cook_torrance",),
    ),
    Statement(
        "ct_tweak",
        COOK_TORRANCE,
        "artists can tweak the properties of the surface easily to create realistic looking objects",
        "Artists find such parameters easy.",
        undecided("Nobody was asked; the document names no test."),
    ),
)
