"""Statements of sections 2.3 and 2.4: the p-model, the metallic properties and the ideal mirror."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from albedo_lab.optics.fresnel import conductor
from albedo_lab.optics.metals import PAPER_WAVELENGTHS, index
from albedo_lab.papers.neumann1999.equations import (
    Array,
    N,
    dot,
    fresnel,
    hemisphere,
    phong,
    stretched,
    stretched_by_products,
)
from albedo_lab.papers.neumann1999.statements.introduction import TABLE_1, peak
from albedo_lab.papers.neumann1999.statements.stretched import c_n, excess
from albedo_lab.papers.neumann1999.tried import (
    CODE,
    MANY,
    PRINTED,
    SAME,
    albedo,
    at_mirror,
    cosine,
    exchanged,
    in_section,
    sampled,
)
from albedo_lab.papers.recipes import Means
from albedo_lab.papers.record import Statement, Trial
from albedo_lab.papers.trials import CLOSED, Found, apart, checked, measured, trial, undecided
from albedo_lab.pictures.evaluation import in_plane


def ends_of_the_transition(means: Means) -> Found:
    """p = 0 is eq. 5, p = 1 is eq. 7."""
    L, V = hemisphere(means.seed, MANY), hemisphere(means.seed + 1, MANY)
    n = 20.0
    ends = max(apart(stretched(n, 0.0)(L, V), phong(n)(L, V)), apart(stretched(n, 1.0)(L, V), stretched_by_products(n)(L, V)))
    viewers = np.linspace(-80.0, 89.0, 500)
    pairs = ((0.0, "phong"), (1.0, "stretched_phong"))
    code = max(apart(in_section("p_phong", 50.0, viewers, n=n, p=p), in_section(model, 50.0, viewers, n=n)) for p, model in pairs)
    told = "largest relative difference {:.1g}"
    return Found(max(ends, code) < SAME, told.format(ends), PRINTED, f"{told.format(code)} ({CODE})")


def constant_of_the_p_model(means: Means) -> Found:
    """The maximum of c_n for any p, as far as the overshoot allows that the paper neglects."""
    over = {p: max(excess(p, (1.0, 2.0, 10.0, 100.0), means)) for p in (0.0, 0.25, 0.5, 0.75, 1.0)}
    ours = "largest albedo - 1 with c_n of ineq. 6: " + ", ".join(f"{max(x, 0.0):.1e} (p = {p:g})" for p, x in over.items())
    again = f"p = 0.9, n = 1: a(13°) = {sampled('p_phong', 13.0, means, n=1, p=0.9)} (rqmc)"
    return Found(max(over.values()) < 4e-4, ours, "search of normalise", again)


def ratio_of_figure_4(means: Means) -> Found:
    """Figure 4: the ratio of both BRDFs depends on the angles alone."""
    light, viewers = 40.0, np.array([0.0, 20.0, 39.0, 60.0, 85.0])
    code = in_section("p_phong", light, viewers, n=20, p=0.5) / in_section("phong", light, viewers, n=20)
    printed = np.cos(np.radians(np.minimum(light, viewers))) ** -0.5
    worst = apart(code, printed)
    return Found(
        worst < SAME,
        f"1/cos^p Θ_min within {worst:.1g}, p = 0.5",
        CODE,
        "the same factor of every n (closed form: eq. 12 over eq. 5)",
    )


def silver_is_white(means: Means) -> Found:
    """Silver's reflectance over the visible wavelengths and all angles."""
    c = np.cos(np.radians(np.arange(0.0, 90.0, 0.5)))
    indices = [index("silver", wavelength) for wavelength in PAPER_WAVELENGTHS]
    ours = min(conductor(eta, k, float(x)) for eta, k in indices for x in c)
    again = min(float(np.min(fresnel(complex(eta, k), c))) for eta, k in indices)
    return Found(
        ours > 0.95,
        f"F ≥ {ours:.4f} over 400 to 750 nm, every angle",
        "Fresnel, measured indices",
        f"{again:.4f} (complex amplitudes)",
    )


def stays_above_half(means: Means) -> Found:
    """The grazing albedo of the stretched model."""
    exponents = (1.0, 10.0, 150.0, 1e4)
    a = [albedo("stretched_phong", 90.0 - 1e-8, n=n) for n in exponents]
    expected = [(n + 2.0) / (2.0 * (n + 1.0)) for n in exponents]
    ours = ", ".join(f"{x:.5f}" for x in a) + " at n = 1, 10, 150, 1e4"
    return Found(min(a) >= 0.5, ours, "quadrature", "eq. 26: " + ", ".join(f"{x:.5f}" for x in expected))


def greatest(model: str) -> Trial:
    """Where the BRDF is largest and how large, over all viewers."""

    def find(means: Means) -> Found:
        n, worst, told = 20.0, 0.0, []
        V = np.concatenate([hemisphere(means.seed, MANY), in_plane(np.linspace(-89.9, 89.9, 3597))])
        f = {"phong": phong(n), "stretched_phong": stretched(n)}[model]
        for angle in (0.0, 40.0, 80.0, 89.0):
            L = np.broadcast_to(in_plane(np.array([-angle])), V.shape)
            value = at_mirror(model, angle, n=n) / cosine(angle)
            expected = c_n(n) * (1.0 / cosine(angle) if model == "stretched_phong" else 1.0)
            worst = max(worst, abs(value / expected - 1.0), c_n(n) * float(np.max(f(L, V))) / value - 1.0)
            told.append(f"{value:.4f} at {angle:g}°")
        again = f"no viewer of {MANY + 3597} sees more, and the value printed is met within {max(worst, 0.0):.1g} ({PRINTED})"
        return Found(worst < SAME, f"f at R: {', '.join(told)}, n = 20", CODE, again)

    return trial(find)


def irradiance(means: Means) -> Found:
    """A point source of intensity 4π W/sr at distance 1: E = I cos Θ / r²."""
    intensity, theta, patch = 4.0 * math.pi, 40.0, 1e-6
    E = intensity * cosine(theta) / 1.0**2
    # the same from the solid angle that a small patch fills, seen from the source
    source = np.array([math.sin(math.radians(theta)), 0.0, cosine(theta)])
    solid_angle = patch * float(dot(source, N)) / float(dot(source, source)) ** 1.5
    ours = f"{E:.4f} at 40°, 4π times cos Θ_L = {cosine(theta):.4f}"
    return Found(
        abs(E - cosine(theta)) < 1e-9,
        ours,
        "inverse square law",
        f"{intensity * solid_angle / patch:.4f} (solid angle of a patch)",
    )


def mirror_radiance(means: Means) -> Found:
    """Figure 7: radiance at the mirror direction, of both models."""
    ratio = {m: [at_mirror(m, a, n=100) / at_mirror(m, 0.0, n=100) for a in (40.0, 80.0)] for m in ("phong", "stretched_phong")}
    ours = "; ".join(f"{m} {r[0]:.4f}, {r[1]:.4f}" for m, r in ratio.items())
    condition = abs(ratio["phong"][1] - cosine(80.0)) < SAME and all(abs(r - 1.0) < SAME for r in ratio["stretched_phong"])
    again = f"cos Θ_L = {cosine(40.0):.4f}, {cosine(80.0):.4f}, and 1 ({CLOSED})"
    return Found(condition, f"radiance at R over that at 0°, light from 40°, 80°: {ours}", CODE, again)


def normalised_mirror(means: Means) -> Found:
    """f/c_n at the mirror direction."""
    values = [at_mirror("stretched_phong", angle, n=1e8) / c_n(1e8) for angle in (0.0, 40.0, 80.0)]
    ours = ", ".join(f"{v:.6f}" for v in values)
    beside = float(stretched(1e8)(in_plane(np.array([-40.0])), in_plane(np.array([40.2])))[0])
    return Found(
        max(abs(v - 1.0) for v in values) < 1e-6, f"f cos Θ_L / c_n at R: {ours}", CODE, f"0.2° beside R {beside:.1g} ({PRINTED})"
    )


def sees_itself(means: Means) -> Found:
    """Where the mirror of the limit sends light from 45 degrees."""
    L, retro, R = in_plane(np.array([-45.0])), in_plane(np.array([-45.0])), in_plane(np.array([45.0]))
    f = [float(in_section("stretched_phong", 45.0, angle, n=1e6)[0]) / c_n(1e6) for angle in (-45.0, 45.0)]
    printed = [float(stretched(1e6)(L, V)[0]) for V in (retro, R)]
    ours = f"f/c_n = {f[0]:g} at V = L, {f[1]:.4f} at V = R; n = 1e6, light from 45°"
    return Found(f[0] > f[1], ours, CODE, f"{printed[0]:g} and {printed[1]:.4f} ({PRINTED}); eq. 8 gives R ≠ L unless L = N")


def approximates_mirror(means: Means) -> Found:
    """How far the mean albedo is from 1."""
    short = [1.0 - 2.0 * float(np.trapezoid(*_mean_points(n))) for n in (1e4, 1e6, 1e8)]
    ours = ", ".join(f"{x:.1e}" for x in short)
    expected = [1.0 / math.sqrt(8.0 * n / math.pi) for n in (1e4, 1e6, 1e8)]
    again = ", ".join(f"{x:.1e}" for x in expected)
    condition = short[0] > short[1] > short[2] and short[2] < 2e-4
    return Found(
        condition, f"1 - mean albedo: {ours} at n = 1e4, 1e6, 1e8", "quadrature, trapezoids over angles", f"√(π/8n): {again}"
    )


def _mean_points(n: float) -> tuple[Array, Array]:
    """Integrand of eq. 33 and cosines, dense near grazing."""
    mu = np.concatenate([[0.0], np.geomspace(1e-6, 1.0, 400)])
    a = np.array([albedo("stretched_phong", math.degrees(math.acos(max(float(m), 1e-9))), n=n) for m in mu])
    return a * mu, mu


def no_off_specular_peak(means: Means) -> Found:
    """The stretched model's summit is the mirror direction."""
    at = peak("stretched_phong", n=100)
    return Found(
        abs(at - 75.0) < 0.02,
        f"summit at {at:.2f}° for light from 75°, n = 100",
        CODE,
        "cosⁿα/max falls on both sides of R (closed form)",
    )


def ratio_at_75(model: str, **parameters: Any) -> float:
    """The radiance at the summit over that at the mirror direction."""
    at = min(peak(model, **parameters), 89.9)
    f = in_section(model, 75.0, [at, 75.0], **parameters)
    return float(f[0] / f[1])


def peak_of_1_6(means: Means) -> Found:
    """Surfaces of He and Torrance whose off-specular peak is 1.6 times the mirror direction."""
    surfaces = [(s, t) for s in (0.2, 0.5) for t in (1.7, 3.0, 5.0)]
    ratios = {(s, t): ratio_at_75("he_torrance", **(TABLE_1["he_torrance"] | {"sigma0": s, "tau": t})) for s, t in surfaces}
    (s, t), top = max(ratios.items(), key=lambda item: item[1])
    again = f"figure 5's surface: {ratio_at_75('he_torrance', **TABLE_1['he_torrance']):.3f}; Cook-Torrance, m = 0.1: "
    again += f"{ratio_at_75('cook_torrance', m=0.1):.3f} ({CODE})"
    return Found(top >= 1.6, f"{top:.2f} times at σ₀ = {s:g}, τ = {t:g}, λ = 0.5, |F|² = 1", CODE, again)


def stronger_when_polished(means: Means) -> Found:
    """The off-specular peak against the roughness."""
    slopes = (0.01, 0.03, 0.1)
    ratios = [ratio_at_75("cook_torrance", m=m) for m in slopes]
    rough = [ratio_at_75("he_torrance", **(TABLE_1["he_torrance"] | {"sigma0": 0.5, "tau": t})) for t in (100.0, 30.0, 5.0)]
    ours = ", ".join(f"{r:.4f}" for r in ratios) + " at m = 0.01, 0.03, 0.1 (Cook-Torrance)"
    again = ", ".join(f"{r:.4f}" for r in rough) + f" at τ = 100, 30, 5, σ₀ = λ = 0.5 (He-Torrance, {CODE})"
    return Found(ratios[0] > ratios[-1] and rough[0] > rough[-1], f"summit over mirror direction at 75°: {ours}", CODE, again)


STATEMENTS = (
    Statement(
        "transition_ends",
        "§2.3, eq. 12",
        "The case of p = 0 represents the reciprocal Phong model, while the case of p = 1 means the new metallic model.",
        "Eq. 12 is eq. 5 and eq. 7 at its ends.",
        trial(ends_of_the_transition),
        ("p_phong",),
    ),
    Statement(
        "p_model_constant",
        "§2.3",
        "If n ≥ 1, then the maximum of the multiplicative factor c_n is as shown in equation 6 for any p ∈ [0, 1].",
        "With c_n of ineq. 6 the albedo is at most 1.0004 for p = 0, 0.25, 0.5, 0.75, 1 and n = 1, 2, 10, 100.",
        trial(constant_of_the_p_model),
        ("p_phong",),
    ),
    Statement(
        "p_model_reciprocal",
        "§2.3",
        "a continuous transition … between the reciprocal Phong model … and the new metallic model",
        "Every step of it is reciprocal: p = 0.5, n = 100.",
        checked("reciprocity", "PASS", "p_phong", again=exchanged(stretched(100.0, 0.5)), n=100, p=0.5),
        ("p_phong",),
    ),
    Statement(
        "figure_4_ratio",
        "§2.3, figure 4",
        "the ratio of the BRDFs of the p-model and the Phong model for different viewing angles Θ_V and … p",
        "It is 1/cos^p Θ_min.",
        trial(ratio_of_figure_4),
        ("p_phong", "phong"),
    ),
    Statement(
        "silver_is_white",
        "§2.4",
        "Supposing that the Fresnel term is 1 (for silver this is practically true)",
        "Silver's F is above 0.95 over 400 to 750 nm, at every angle.",
        trial(silver_is_white),
        ("metal",),
    ),
    Statement(
        "not_lower_than_half",
        "§2.4",
        "The stretched model converges to a value that is not lower than 0.5 for grazing angles.",
        "Its grazing albedo is at least 1/2 for every n.",
        trial(stays_above_half),
        ("stretched_phong",),
    ),
    Statement(
        "maximum_of_stretched",
        "§2.4",
        "The maximum of the stretched Phong BRDF is always at the mirror direction R and its value is c_n / cos Θ_L for any n",
        "Over all viewers; n = 20, light from 0°, 40°, 80°, 89°.",
        greatest("stretched_phong"),
        ("stretched_phong",),
    ),
    Statement(
        "maximum_of_phong",
        "§2.4",
        "the maximum of the Phong model is always c_n",
        "Over all viewers; n = 20, light from 0°, 40°, 80°, 89°.",
        greatest("phong"),
        ("phong",),
    ),
    Statement(
        "point_light",
        "§2.4",
        "a single point-like lightsource of intensity 4π at distance 1 in direction L. In this case the irradiance is cos Θ_L.",
        "I cos Θ_L / r² is cos Θ_L for I = 4π, r = 1.",
        measured(
            irradiance,
            "a power of 4π (an intensity of 1) has that irradiance, a radiant intensity of 4π has 4π times it; the paper does "
            "not say in which sense it takes the word",
        ),
    ),
    Statement(
        "figure_7",
        "§2.4, figure 7",
        "the ‘Phong-mirror’ gets darker for greater incident angles, but the stretched model eliminates this artifact",
        "Radiance at the mirror direction: as cos Θ_L for Phong, the same at all angles for stretched Phong.",
        trial(mirror_radiance),
        ("phong", "stretched_phong"),
    ),
    Statement(
        "normalised_brdf_of_mirror",
        "§2.4.1",
        "The new model gives back the normalized BRDF of the ideal mirror for n → ∞, which is 1/cos Θ_L.",
        "f/c_n at the mirror direction is 1/cos Θ_L, and 0 beside it.",
        trial(normalised_mirror),
        ("stretched_phong",),
    ),
    Statement(
        "mirror_sees_itself",
        "§2.4.1",
        "The output radiance is L^out(V) = L^in(L) if V = L and 0 otherwise.",
        "The limit n → ∞ sends light back to where it came from.",
        trial(sees_itself, "it sends it into the mirror direction: V = R is meant"),
        ("stretched_phong",),
    ),
    Statement(
        "approximates_the_mirror",
        "§2.4.1",
        "the new model can arbitrarily approximate the ideal mirror. Selecting n in an appropriate way (e.g. n = 10⁴ … 10⁸)",
        "1 less the mean albedo falls with n, below 2e-4 at n = 1e8.",
        trial(approximates_mirror),
        ("stretched_phong",),
    ),
    Statement(
        "no_off_specular_peak",
        "§2.4.2",
        "The new model does not provide off-specular peak",
        "The summit of the stretched Phong lobe is the mirror direction; light from 75°, n = 100.",
        trial(no_off_specular_peak),
        ("stretched_phong",),
    ),
    Statement(
        "peak_of_1_6",
        "§2.4.2",
        "at 75° incident angle the off-specular peak can be 1.6 times greater than the radiance at the mirror direction",
        "He-Torrance has surfaces with a ratio of 1.6 or more.",
        trial(peak_of_1_6),
        ("he_torrance",),
    ),
    Statement(
        "peak_of_polished_metals",
        "§2.4.2",
        "off-specular peak which can be quite significant for highly polished metals",
        "The smoothest surface of three has at least as strong a peak as the roughest: m = 0.01 to 0.1, τ = 100 to 5.",
        trial(
            stronger_when_polished,
            "as the surface gets smooth the summit moves into the mirror direction: it is rough surfaces that have it",
        ),
        ("cook_torrance", "he_torrance"),
    ),
    Statement(
        "peak_not_significant",
        "§2.4.2",
        "experience gained with other models show that this effect is not significant",
        "Whether a metal looks metallic without an off-specular peak.",
        undecided("an experience of the authors, and a matter of looking"),
        ("stretched_phong",),
    ),
)
