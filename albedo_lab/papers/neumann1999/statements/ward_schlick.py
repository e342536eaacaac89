"""Statements of section 6.2: the Ward and Schlick models and the modified Ward model."""

from __future__ import annotations

import math
from itertools import pairwise

import numpy as np

from albedo_lab.analysis.normalise import normalise
from albedo_lab.papers.neumann1999.equations import (
    gaussian,
    hemisphere,
    modified_ward,
    reflected,
    schlick,
    ward,
)
from albedo_lab.papers.neumann1999.statements.introduction import towards_grazing
from albedo_lab.papers.neumann1999.tried import (
    CODE,
    MANY,
    PRINTED,
    SAME,
    albedo,
    cosine,
    exchanged,
    identical,
    in_section,
    sampled,
)
from albedo_lab.papers.recipes import Means
from albedo_lab.papers.record import Statement
from albedo_lab.papers.trials import Found, apart, behaves, checked, subject_of, trial, undecided
from albedo_lab.pictures.evaluation import in_plane, values


def rms_slope(means: Means) -> Found:
    """The second moment of the slopes in eq. 34."""
    m = 0.3
    s = (np.arange(200_000) + 0.5) / 200_000 * 12.0 * m
    weight = np.exp(-((s / m) ** 2)) * s
    rms = math.sqrt(float(np.sum(s * s * weight) / np.sum(weight)))
    drawn = m * np.sqrt(-np.log(1.0 - np.random.default_rng(means.seed).random(200_000)))
    one_axis = math.sqrt(float(np.mean(drawn**2)) / 2.0)
    again = f"{math.sqrt(float(np.mean(drawn**2))):.4f} (200000 samples); along one axis {one_axis:.4f} = m/√2"
    return Found(abs(rms / m - 1.0) < 1e-4, f"RMS of tan δ = {rms:.6f} for m = {m:g}", "midpoint rule", again)


def normalised_gaussian(means: Means) -> Found:
    """Eq. 34's front factor makes a narrow lobe's albedo 1."""
    a = [albedo("ward", 0.0, m=m) for m in (0.1, 0.01, 1e-3)]
    n = 801
    x = np.linspace(-0.05, 0.05, n)
    z = 1.0 - 0.5 * (x[:, None] ** 2 + x[None, :] ** 2)
    V = np.stack(np.broadcast_arrays(x[:, None], x[None, :], z), axis=-1).reshape(-1, 3)
    total = float(np.sum(gaussian(0.005, np.broadcast_to([0.0, 0.0, 1.0], V.shape), V))) * (x[1] - x[0]) ** 2
    ours = ", ".join(f"{v:.6f}" for v in a) + " at 0°, m = 0.1, 0.01, 0.001, C_max = 1"
    return Found(
        abs(a[-1] - 1.0) < 1e-4,
        ours,
        "quadrature",
        f"∫ of the Gaussian over V about N: {total:.4f} for m = 0.005 (sum on a grid)",
    )


def unbounded_radiance(means: Means) -> Found:
    """f and f cos Theta_L of Ward's model for viewers at the horizon."""
    viewers = 90.0 - np.degrees(np.array([1e-2, 1e-4, 1e-6, 1e-8]))
    f = in_section("ward", 85.0, viewers, m=0.1)
    out = f * cosine(85.0)
    printed = ward(0.1)(in_plane(np.full(4, -85.0)), in_plane(viewers))
    ours = (
        "f cos Θ_L = "
        + ", ".join(f"{x:.3g}" for x in out)
        + " for viewers at cos Θ_V = 1e-2, 1e-4, 1e-6, 1e-8; light from 85°, m = 0.1"
    )
    return Found(out[-1] > 1e2 * out[0], ours, CODE, "f = " + ", ".join(f"{x:.3g}" for x in printed) + f" ({PRINTED})")


def ward_below_89(means: Means) -> Found:
    """Ward's albedo with C_max = 1 over 0 to 89 degrees."""
    angles = np.arange(0.0, 89.01, 1.0)
    largest = {m: max(albedo("ward", float(a), m=m) for a in angles) for m in (0.19, 0.1, 0.05, 0.01)}
    ours = ", ".join(f"{x:.4f} (m = {m:g})" for m, x in largest.items())
    again = f"m = 0.19: a(0°) = {sampled('ward', 0.0, means, m=0.19)}, a(89°) = {sampled('ward', 89.0, means, m=0.19)} (rqmc)"
    return Found(max(largest.values()) <= 1.0, f"largest albedo: {ours}", "quadrature, steps of 1°", again)


def ward_above_085(means: Means) -> Found:
    """The same maximum against 0.85, and its limit."""
    ms = (0.2, 0.15, 0.1, 0.05, 0.02, 0.01)
    largest = [max(albedo("ward", float(a), m=m) for a in np.arange(0.0, 89.01, 1.0)) for m in ms]
    ours = ", ".join(f"{x:.4f}" for x in largest) + " at m = 0.2, 0.15, 0.1, 0.05, 0.02, 0.01"
    hand = reflected(ward(0.2), 0.0)
    rising = all(b > a for a, b in pairwise(largest))
    return Found(
        min(largest) > 0.85 and rising and 1.0 - largest[-1] < 1e-3,
        ours,
        "quadrature, steps of 1°",
        f"m = 0.2: {hand:.6f} at 0° (product rule)",
    )


def ward_brdf_diverges(means: Means) -> Found:
    """The BRDF itself at the mirror direction, towards grazing angles."""
    angles = 90.0 - np.degrees(np.array([1e-2, 1e-4, 1e-6]))
    f = [float(in_section("ward", float(a), float(a), m=0.1)[0]) for a in angles]
    closed = [1.0 / (4.0 * math.pi * 0.01) / c for c in (1e-2, 1e-4, 1e-6)]
    ours = ", ".join(f"{x:.4g}" for x in f) + " at R for cos Θ = 1e-2, 1e-4, 1e-6, m = 0.1"
    return Found(f[-1] > 1e3 * f[0], ours, CODE, "1/(4πm² cos Θ): " + ", ".join(f"{x:.4g}" for x in closed))


def anisotropic_too(means: Means) -> Found:
    """The modification of the anisotropic model is bounded at every azimuth."""
    p = {"m_x": 0.1, "m_y": 0.4}
    subject = subject_of("modified_ward", **p)
    L, V = hemisphere(means.seed, MANY), hemisphere(means.seed + 1, MANY)
    L[:, 2], V[:, 2] = np.maximum(L[:, 2], 1e-12), np.maximum(V[:, 2], 1e-12)
    f = values(subject, L, V)
    most = float(np.max(f * np.maximum(L[:, 2], V[:, 2]))) * 4.0 * math.pi * 0.04 / subject.scale.value
    a = [albedo("modified_ward", angle, **p) for angle in (0.0, 60.0, 89.0, 89.999)]
    ours = ", ".join(f"{x:.4f}" for x in a) + " at 0°, 60°, 89°, 89.999°; m_x = 0.1, m_y = 0.4"
    return Found(
        max(a) <= 1.0 + 1e-6 and most <= 1.0 + 1e-9,
        ours,
        "quadrature",
        f"f max(cos Θ_L, cos Θ_V) 4πm_x m_y / C_max ≤ {most:.6f} at {MANY} pairs",
    )


def one_suffices(means: Means) -> Found:
    """C_max of the modified Ward model for small m."""
    ms = [0.05, 0.02, 0.01]
    table = normalise("modified_ward", m=ms, method="quadrature", tolerance=1e-8, seed=means.seed)
    ours = ", ".join(f"{c:.5f}" for c in table.constant) + " for m = 0.05, 0.02, 0.01"
    expected = ", ".join(f"{1.0 + 4.0 * m * m:.5f}" for m in ms)
    return Found(
        all(0.0 <= c - 1.0 < 0.0105 for c in table.constant), ours, "search of normalise", f"1 + 4m² to first order: {expected}"
    )


def not_a_plain_number(means: Means) -> Found:
    """The caption's n < 0.05, read as the exponent of a Blinn lobe of the same width."""
    table = normalise("blinn", n=[0.01, 0.04], method="quadrature", tolerance=1e-7, seed=means.seed)
    subject = subject_of("modified_ward", m=0.04)
    names = tuple(p.name for p in subject.model.parameters)
    ours = f"the model has the parameters {', '.join(names)}; of m = 0.04 the constant is {subject.scale.value:.4f}"
    again = f"a Blinn lobe with n = 0.04 has C_n = {table.constant[1]:.4f}, not 1"
    return Found("n" in names, ours, "the model's record", again)


def darkens_with_r(means: Means) -> Found:
    """Albedo of Schlick's model at usual directions with its largest constant."""
    rs = (0.5, 0.1, 0.01, 0.001)
    a = [[albedo("schlick_isotropic", angle, r=r) for angle in (0.0, 60.0)] for r in rs]
    ours = "; ".join(f"{x:.3f}, {y:.3f} (r = {r:g})" for r, (x, y) in zip(rs, a, strict=True))
    again = f"r = 0.01: {sampled('schlick_isotropic', 0.0, means, r=0.01)} at 0° (rqmc)"
    return Found(
        all(x > y for (x, _), (y, _) in pairwise(a)) and a[-1][0] < 0.1,
        f"a(0°), a(60°): {ours}",
        "quadrature",
        again,
    )


def constant_decreases(means: Means) -> Found:
    """C_max against r."""
    rs = [1.0, 0.5, 0.2, 0.1, 0.03, 0.01, 0.003, 0.001]
    table = normalise("schlick_isotropic", r=rs, method="quadrature", tolerance=1e-7, seed=means.seed)
    limits = [1.0 / albedo("schlick_isotropic", 90.0 - 1e-9, r=r, scale=1.0) for r in (0.5, 0.001)]
    ours = ", ".join(f"{c:.3f}" for c in table.constant) + " for r = 1, 0.5, 0.2, 0.1, 0.03, 0.01, 0.003, 0.001"
    again = f"1/a(90°): {limits[0]:.4f} for r = 0.5, {limits[1]:.5f} for r = 0.001 (quadrature)"
    return Found(bool(np.all(np.diff(table.constant) < 0.0)), ours, "search of normalise", again)


def more_than_incoming(means: Means) -> Found:
    """The largest radiance that the plausible model sends out under a sky of radiance 1 at most."""
    rs = (0.5, 0.01, 0.001)
    best = [max(albedo("schlick_isotropic", a, r=r) for a in (0.0, 45.0, 80.0, 89.0, 89.999)) for r in rs]
    plain = [albedo("schlick_isotropic", 89.999, r=r, scale=1.0) for r in rs]
    ours = ", ".join(f"{x:.4f}" for x in best) + " times the sky's radiance at most, r = 0.5, 0.01, 0.001, C_max the largest"
    again = (
        f"eq. 17 with a ≤ 1; only with C_max = 1 it is {plain[1]:.1f} and {plain[2]:.1f} times for r = 0.01, 0.001 (quadrature)"
    )
    return Found(max(best) > 1.0 + 1e-6, ours, "quadrature", again)


def schlick_form(means: Means) -> Found:
    """Eq. 36 against Schlick's own model, with A = 1 and his factor of eq. 15."""
    L, V = hemisphere(means.seed, MANY), hemisphere(means.seed + 1, MANY)
    own = values(subject_of("schlick", r=0.2, p=1.0, directional="eq12"), L, V)
    code = values(subject_of("schlick_isotropic", r=0.2, scale=1.0), L, V)
    shadowing = (L[:, 2] / (0.2 + 0.8 * L[:, 2])) * (V[:, 2] / (0.2 + 0.8 * V[:, 2]))
    f = schlick(0.2)(L, V)
    first, second = apart(f, own * shadowing), apart(f, code)
    return Found(
        max(first, second) < SAME,
        f"Schlick's eq. 12 times G(L) G(V): {first:.1g}",
        PRINTED,
        f"the catalogue's model: {second:.1g} ({CODE})",
    )


STATEMENTS = (
    Statement(
        "equation_34",
        "eq. 34",
        "C_max/4πm² · exp(-tan²δ/m²) / √((N·L)(N·V))",
        "It is what the catalogue's Ward model computes, m = 0.3.",
        identical(
            ward(0.3),
            lambda L, V: np.asarray(
                modified_ward(0.3)(L, V) * np.sqrt(np.maximum(L[:, 2], V[:, 2]) / np.minimum(L[:, 2], V[:, 2]))
            ),
            "ward",
            m=0.3,
        ),
        ("ward",),
    ),
    Statement(
        "ward_normalisation",
        "eq. 34",
        "C_max / 4πm²",
        "With C_max = 1 the albedo at normal incidence tends to 1 as m → 0.",
        trial(normalised_gaussian),
        ("ward",),
    ),
    Statement(
        "rms_of_slope",
        "§6.2, after eq. 34",
        "m is the standard deviation (RMS) of the surface slope",
        "The RMS of tan δ under a density like exp(-tan²δ/m²) of the slopes is m.",
        trial(rms_slope),
        ("ward",),
    ),
    Statement(
        "ward_unbounded",
        "§6.2",
        "Not only the BRDF but also the reflected radiance are unbounded for the Ward model",
        "f cos Θ_L grows without bound towards the horizon.",
        trial(unbounded_radiance),
        ("ward",),
    ),
    Statement(
        "ward_below_89",
        "§6.2",
        "selecting C_max = 1 the model meets energy balance if m < 0.2. Examining the albedo function in the range of "
        "0..89°, this is true quite accurately.",
        "The albedo is at most 1 at 0° to 89°; m = 0.19, 0.1, 0.05, 0.01.",
        trial(ward_below_89),
        ("ward",),
    ),
    Statement(
        "ward_above_085",
        "§6.2",
        "Here the maximum of the albedo is greater than 0.85, and it converges to 1 if m is decreased.",
        "Largest albedo at 0° to 89°, m = 0.2 to 0.01.",
        trial(ward_above_085),
        ("ward",),
    ),
    Statement(
        "ward_violates_balance",
        "§6.2",
        "at grazing angles the albedo significantly violates energy balance",
        "Eq. 34 with C_max = 1, m = 0.05.",
        checked("energy", "FAIL", "ward", again=towards_grazing("ward", m=0.05), m=0.05),
        ("ward",),
    ),
    Statement(
        "ward_brdf_diverges",
        "§6.2",
        "the BRDF diverges to infinity at grazing angles",
        "f at the mirror direction grows without bound.",
        trial(ward_brdf_diverges),
        ("ward",),
    ),
    Statement(
        "shown_analytically",
        "§6.2",
        "In the next section, it will be shown analytically that the BRDF diverges",
        "Whether the paper shows it.",
        undecided("section 7 shows rendered images and no proof; section 2.4 refers to a technical report for one"),
        ("ward",),
    ),
    Statement(
        "modified_ward_bounded",
        "§6.2, eq. 35",
        "which leads to a new BRDF model",
        "Its albedo is bounded at grazing angles, m = 0.2.",
        behaves("modified_ward", "bounded", "vanishes", m=0.2),
        ("modified_ward",),
    ),
    Statement(
        "modified_ward_reciprocal",
        "§6.2, eq. 35",
        "The previously applied modification … leads to a new BRDF model",
        "Eq. 35 is reciprocal, m = 0.1.",
        checked("reciprocity", "PASS", "modified_ward", again=exchanged(modified_ward(0.1)), m=0.1),
        ("modified_ward",),
    ),
    Statement(
        "equation_35",
        "eq. 35",
        "C_max/4πm² · exp(-tan²δ/m²) / max((N·L), (N·V))",
        "It is what the catalogue's modified Ward model computes, m = 0.3.",
        identical(
            modified_ward(0.3),
            lambda L, V: np.asarray(ward(0.3)(L, V) * np.sqrt(np.minimum(L[:, 2], V[:, 2]) / np.maximum(L[:, 2], V[:, 2]))),
            "modified_ward",
            m=0.3,
        ),
        ("modified_ward",),
    ),
    Statement(
        "anisotropic_ward",
        "§6.2, after eq. 35",
        "A similar method can be applied to the anisotropic Ward model as well.",
        "Bounded, and in energy balance, for m_x = 0.1, m_y = 0.4.",
        trial(anisotropic_too),
        ("modified_ward",),
    ),
    Statement(
        "table_4_caption",
        "table 4, caption",
        "for n < 0.05 the C_max can be supposed to be 1",
        "The modified Ward model has a parameter n.",
        trial(not_a_plain_number, "it has no n; m is meant, as in the table's own head"),
        ("modified_ward",),
    ),
    Statement(
        "one_for_small_m",
        "table 4, caption",
        "the C_max can be supposed to be 1",
        "With m for n: C_max is within 0.0105 of 1 for m ≤ 0.05.",
        trial(one_suffices),
        ("modified_ward",),
    ),
    Statement(
        "equation_36",
        "eq. 36",
        "The Schlick model, on the other hand, has the following form describing the isotropic case",
        "It is Schlick's Z and A = 1 with the G(L) G(V)/(4π (N·L)(N·V)) that his eq. 15 begins with; r = 0.2.",
        trial(schlick_form),
        ("schlick_isotropic", "schlick"),
    ),
    Statement(
        "schlick_plausible",
        "§6.2, after eq. 36",
        "This model can be made physically plausible by the appropriate selection of C_max.",
        "With the computed C_max it keeps energy balance, r = 0.1.",
        checked("energy", "PASS", "schlick_isotropic", again=towards_grazing("schlick_isotropic", r=0.1), r=0.1),
        ("schlick_isotropic",),
    ),
    Statement(
        "schlick_reciprocal",
        "§6.2, eq. 36",
        "This model can be made physically plausible",
        "Eq. 36 is reciprocal, r = 0.1.",
        checked("reciprocity", "PASS", "schlick_isotropic", again=exchanged(schlick(0.1)), r=0.1),
        ("schlick_isotropic",),
    ),
    Statement(
        "schlick_constant_decreases",
        "§6.2, after eq. 36",
        "the required C_max factor decreases as r decreases",
        "C_max grows with r from 0.001 to 1.",
        trial(constant_decreases),
        ("schlick_isotropic",),
    ),
    Statement(
        "schlick_dark",
        "§6.2, after eq. 36",
        "Thus this model becomes “dark” for usual viewing directions if r is small.",
        "With the largest C_max the albedo at 0° falls with r, below 0.1 at r = 0.001.",
        trial(darkens_with_r),
        ("schlick_isotropic",),
    ),
    Statement(
        "schlick_more_than_incoming",
        "§6.2, after eq. 36",
        "in mirroring direction the reflected radiance can be unacceptably greater than the incoming radiance",
        "With the largest C_max a viewer can see more than the largest incoming radiance.",
        trial(
            more_than_incoming,
            "what is plausible and reciprocal cannot: by eq. 17 it is at most the albedo times the largest incoming radiance",
        ),
        ("schlick_isotropic",),
    ),
)
