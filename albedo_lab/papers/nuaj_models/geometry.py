"""Shadowing and masking, and what the page asks of a BRDF for real-time graphics, on trial."""

from __future__ import annotations

import math

import numpy as np

from albedo_lab.digits import with_error
from albedo_lab.estimate.record import Estimate
from albedo_lab.optics.frame import Direction
from albedo_lab.optics.masking import beckmann_lambda
from albedo_lab.papers.nuaj_models.formulas import NODES, WEIGHTS, Array, beckmann, directions, integral
from albedo_lab.papers.nuaj_models.variables import paired
from albedo_lab.papers.recipes import Means, albedo_of, largest_constant_of
from albedo_lab.papers.record import Evidence, Statement
from albedo_lab.papers.trials import behaves, ruled, subject_of, unclaimed, undecided, verdict_of
from albedo_lab.pictures.evaluation import values

SHADOWING, ACCURACY, SPEED = "Shadowing / Masking", "Accuracy", "Speed"
MASKED = ("v_cavity", "smith", "smith_correlated", "schlick")
M, COSINES = 0.5, (0.5, 0.2, 0.05)
"""Beckmann's width and the viewer's cosines at which areas are added up."""


def facing(mu: float) -> float:
    """The area of the facets that face the viewer, seen from there, over that of the surface; quadrature over their normals."""
    theta = 0.25 * math.pi * (1.0 + NODES)
    s, along = math.sqrt(1.0 - mu * mu), np.cos(theta) * mu
    across = np.sin(theta) * s
    # the azimuths between which a facet faces the viewer, and the mean of its projection over them
    end = np.arccos(np.clip(-along / across, -1.0, 1.0))
    seen = 2.0 * (along * end + across * np.sin(end))
    return float(0.25 * math.pi * np.sum(WEIGHTS * beckmann(M, theta) * np.sin(theta) * seen)) / mu


def facing_drawn(mu: float, seed: int) -> float:
    """The same from slopes x drawn: over a unit of the surface, a facet's area towards the viewer is mu + x sin."""
    u = np.random.default_rng(seed).random((1 << 18, 2))
    along = M * np.sqrt(-np.log1p(-u[:, 0])) * np.cos(2.0 * math.pi * u[:, 1])
    return float(np.maximum(mu + along * math.sqrt(1.0 - mu * mu), 0.0).mean()) / mu


def masking(mu: float) -> float:
    """Smith's Lambda in closed form."""
    return beckmann_lambda(M, Direction(math.sqrt(1.0 - mu * mu), 0.0, mu))


def _without_shadowing(means: Means) -> Evidence:
    found = [facing(mu) for mu in COSINES]
    return ruled(
        min(found) > 1.0,
        f"area of the facets that face the viewer over that of the surface: {', '.join(f'{x:.6f}' for x in found)} at cosines "
        f"{', '.join(map(str, COSINES))} (Beckmann, m = {M})",
        "quadrature over normals",
        f"1 + Λ, Smith: {', '.join(f'{1.0 + masking(mu):.6f}' for mu in COSINES)}",
    )


def _with_shadowing(means: Means) -> Evidence:
    found = [facing(mu) / (1.0 + masking(mu)) for mu in COSINES]
    return ruled(
        max(found) <= 1.0 + 1e-6,
        f"with Smith's masking {', '.join(f'{x:.6f}' for x in found)} of it: the facets seen cover the surface exactly, no less",
        "quadrature over normals, Λ in closed form",
        f"{', '.join(f'{facing_drawn(mu, means.seed) / (1.0 + masking(mu)):.4f}' for mu in COSINES)} by slopes drawn; what the "
        "light does not reach is taken off that",
    )


def _hidden_facets(means: Means) -> Evidence:
    mu = 0.2
    rough = [1.0 / facing(x) for x in COSINES]
    flat = 1.0 / (1.0 + beckmann_lambda(0.01, Direction(math.sqrt(1.0 - mu * mu), 0.0, mu)))
    return ruled(
        max(rough) < 1.0 and flat > 1.0 - 1e-9,
        f"share of the facing area that is seen: {', '.join(f'{x:.4f}' for x in rough)} at cosines "
        f"{', '.join(map(str, COSINES))} (Beckmann, m = {M})",
        "quadrature over normals",
        f"nearly flat (m = 0.01), at a cosine of {mu}: {flat:.9f}, Smith",
    )


def _too_bright(means: Means) -> Evidence:
    steep = 85.0
    found = [albedo_of("microfacet", theta, G="none")(means) for theta in (0.0, steep)]
    sampled = albedo_of("microfacet", steep, G="none")(Means(1e-3, "rqmc", means.seed, means.threads))
    return ruled(
        found[1].low > 1.0,
        f"albedo {with_error(found[0], 1e-5)} at 0°, {with_error(found[1], 1e-5)} at {steep:g}° (GGX, α = 0.1, F = 1, G = 1)",
        "quadrature",
        f"{with_error(sampled, 1e-3)} at {steep:g}° (rqmc)",
    )


def _masked_energy(means: Means) -> Evidence:
    exactly = Means(1e-6, "quadrature", means.seed, means.threads)
    largest: dict[str, Estimate] = {G: largest_constant_of("microfacet", G=G)(exactly) for G in MASKED}
    roughly = Means(1e-3, "rqmc", means.seed, means.threads)
    sampled = {G: albedo_of("microfacet", 89.9, G=G)(roughly) for G in MASKED}
    return ruled(
        min(e.low for e in largest.values()) >= 1.0 - 1e-6,
        "largest albedo over all directions: "
        + ", ".join(f"{1.0 / e.value:.5f} {G}" for G, e in largest.items())
        + " (GGX, α = 0.1, F = 1)",
        "quadrature, search over the direction",
        f"at 89.9° {', '.join(with_error(e, 1e-3) for e in sampled.values())} (rqmc)",
    )


def _entire_range(means: Means) -> Evidence:
    theta = np.radians(np.linspace(2.0, 88.0, 44))
    pairs = paired(theta[:, None], theta[None, :], 0.5 * math.pi)
    ratio = values(subject_of("microfacet", alpha=0.5), *pairs) / values(subject_of("microfacet", alpha=0.5, G="none"), *pairs)
    z = pairs[0][:, 2]
    G1 = 2.0 / (1.0 + np.sqrt(1.0 + 0.25 * (1.0 / z**2 - 1.0)))
    apart = float(np.max(np.abs(ratio / G1**2 - 1.0)))
    return ruled(
        bool(ratio.max() < 1.0),
        f"G over the characteristic slice is {ratio.min():.2g} to {ratio.max():.5f} (GGX, α = 0.5, Smith): below 1 everywhere",
        "f with G over f without",
        f"closed form of Smith's G, to {apart:.1g}",
    )


def _without_cosine(means: Means) -> Evidence:
    plain = integral(lambda theta: 2.0 * np.sin(theta), 0.0, 0.5 * math.pi)
    weighted = integral(lambda theta: 2.0 * np.sin(theta) * np.cos(theta), 0.0, 0.5 * math.pi)
    z = np.sqrt((np.arange(1 << 18) + 0.5) / (1 << 18))  # even over the disc below
    engine = albedo_of("lambert", 30.0, albedo=1.0)(means)
    return ruled(
        plain.low <= 1.0,
        f"white Lambert, f = 1/π: ∫ f dω = {with_error(plain, 1e-9)}, ∫ f cos θ dω = {with_error(weighted, 1e-9)}",
        "quadrature",
        f"{float(np.mean(1.0 / z)):.3f} by points of the disc, {with_error(engine, 1e-9)} by the library's albedo",
        "What must not exceed 1 is the integral of f cos θ.",
    )


def _equation_2(means: Means) -> Evidence:
    grey = albedo_of("lambert", 30.0, albedo=0.5)(means)
    flat = albedo_of("microfacet", 30.0, alpha=1e-4)(Means(1e-5, "rqmc", means.seed, means.threads))
    return ruled(
        abs(grey.value - 0.5) < 1e-6 and abs(flat.value - 1.0) < 1e-3,
        f"under a sky of radiance 1 a grey surface (ρ = 0.5) shows {with_error(grey, 1e-9)}",
        "quadrature of eq. 2",
        f"and perfect, nearly flat facets show the sky's radiance: {with_error(flat, 1e-5)} (rqmc)",
    )


def mean_over_face(theta: float, radius: float = 0.05, side: int = 1000) -> float:
    """The mean of a face's texels over a light of so many radians, in units of its solid angle: a picture of it, averaged."""
    x = (np.arange(side) + 0.5) * (2.0 / side) - 1.0
    cosine = (x[:, None] * math.sin(theta) + math.cos(theta)) / np.sqrt(1.0 + x[:, None] ** 2 + x[None, :] ** 2)
    return float(np.mean(cosine > math.cos(radius))) / (2.0 * math.pi * (1.0 - math.cos(radius)))


def last_mip(means: Means) -> Evidence:
    """A small light of unit L dω at angles from the axis of a face of the cube, seen by a surface that faces along the axis."""
    degrees = np.array([0.0, 30.0, 60.0])
    c = np.cos(np.radians(degrees))
    irradiance = c / math.pi
    on_face = np.tan(np.radians(degrees)) <= 1.0  # in the direction of an edge's middle
    mean = np.where(on_face, 1.0 / (4.0 * c**3), 0.0)
    pictured = [mean_over_face(theta) for theta in np.radians(degrees)]
    return ruled(
        bool(np.all(np.abs(mean / irradiance - 1.0) < 0.01)),
        f"a small light at 0, 30, 60° gives a mean of {', '.join(f'{x:.3f}' for x in mean)} over the face, and E/π = "
        f"{', '.join(f'{x:.3f}' for x in irradiance)}",
        "closed forms",
        f"from a picture of the face: {', '.join(f'{x:.3f}' for x in pictured)}",
        "It weighs light by 1/cos³ instead of cos.",
    )


def environment(w: Array) -> Array:
    """A smooth sky, for want of a picture."""
    found: Array = 1.0 + 0.5 * w[..., 0] + 0.3 * w[..., 2] ** 2
    return found


def mirror_level(means: Means) -> Evidence:
    """The mean of the sky over lobes cos^n about a direction 45 degrees up."""
    axis = math.radians(45.0)
    u = np.random.default_rng(means.seed).random((20_000, 2))
    exactly = float(environment(np.array([math.sin(axis), 0.0, math.cos(axis)])))
    gaps, closed = [], []
    for n in (1e2, 1e4, 1e6):
        c = u[:, 0] ** (1.0 / (n + 1.0))
        s, turn = np.sqrt(1.0 - c * c), 2.0 * math.pi * u[:, 1]
        x = s * np.cos(turn) * math.cos(axis) + c * math.sin(axis)
        z = -s * np.cos(turn) * math.sin(axis) + c * math.cos(axis)
        gaps.append(abs(float(environment(np.stack([x, 0.0 * x, z], axis=-1)).mean()) - exactly))
        # E[c] = (n+1)/(n+2), E[c^2] = (n+1)/(n+3)
        square = 0.5 * (n + 1.0) / (n + 3.0) + 0.25 * (1.0 - (n + 1.0) / (n + 3.0))
        closed.append(abs(1.0 + 0.5 * math.sin(axis) * (n + 1.0) / (n + 2.0) + 0.3 * square - exactly))
    return ruled(
        closed == sorted(closed, reverse=True) and closed[-1] < 1e-5,
        f"the lobe's mean of a smooth sky is {', '.join(f'{x:.1g}' for x in closed)} off that in the mirror's direction, n = "
        "1e2, 1e4, 1e6",
        "closed form",
        f"samples: {', '.join(f'{x:.1g}' for x in gaps)}",
    )


def _interpolates(means: Means) -> Evidence:
    wi, wo = directions(2000, means.seed), directions(2001, means.seed)[1:]
    f = values(subject_of("blinn", n=0, scale=1.0), wi, wo)
    spread = float(f.max() / f.min() - 1.0)
    degree = math.cos(math.radians(1.0))
    within = [1.0 - degree ** (n + 1.0) for n in (1e2, 1e4, 1e6)]
    drawn = np.random.default_rng(means.seed).random(100_000)
    sampled = [float(np.mean(drawn ** (1.0 / (n + 1.0)) > degree)) for n in (1e2, 1e4, 1e6)]
    return ruled(
        spread < 1e-12 and within[-1] > 0.999,
        f"n = 0: f is the same at 2000 pairs, to {spread:.1g}; n = 1e2, 1e4, 1e6: {', '.join(f'{x:.4f}' for x in within)} of "
        "the lobe lies within 1°",
        "evaluation; closed form",
        f"samples: {', '.join(f'{x:.4f}' for x in sampled)}",
    )


def blur(n: float) -> Array:
    """By how much a cosine lobe dampens the first twenty zonal harmonics of a sky."""
    x, w = 0.5 * (NODES + 1.0), 0.5 * WEIGHTS
    weight = w * (n + 1.0) * x**n
    found: Array = np.array([float(np.sum(weight * np.polynomial.legendre.Legendre.basis(order)(x))) for order in range(1, 21)])
    return found


def closest_lobe(first: float, second: float) -> tuple[float, float]:
    """The exponent of the lobe that blurs most as the mean of two lobes does, and how far it is off in the worst harmonic."""
    both = 0.5 * (blur(first) + blur(second))
    tried = np.geomspace(1.0, 3000.0, 200)
    gaps = [float(np.max(np.abs(blur(float(n)) - both))) for n in tried]
    best = int(np.argmin(gaps))
    return float(tried[best]), gaps[best]


def _several_lobes(means: Means) -> Evidence:
    n, gap = closest_lobe(10.0, 1000.0)
    both = 0.5 * (blur(10.0) + blur(1000.0))
    # cos^n dampens the first harmonic to (n+1) / (n+2), the second to n / (n+3)
    asked = (2.0 * both[0] - 1.0) / (1.0 - both[0]), 3.0 * both[1] / (1.0 - both[1])
    return ruled(
        gap > 0.01,
        f"the best single lobe, n = {n:.0f}, is {gap:.2f} off in some of the first 20 harmonics of two lobes, n = 10 and 1000",
        "search over n",
        f"their first harmonic alone asks for n = {asked[0]:.2f}, their second for n = {asked[1]:.2f} (closed form)",
    )


def _importance(means: Means) -> Evidence:
    found = verdict_of("quality", "microfacet", means.seed)
    gain = float(found.details["efficiency"])
    w, theta = directions(1 << 16, means.seed), math.radians(30.0)
    viewer = np.broadcast_to(np.array([math.sin(theta), 0.0, math.cos(theta)]), w.shape)
    weight = 2.0 * math.pi * values(subject_of("microfacet"), w, np.ascontiguousarray(viewer)) * w[:, 2]
    return ruled(
        gain > 1.0,
        found.statement,
        "check: quality",
        f"rays sent everywhere, 30°: variance {float(weight.var() / weight.mean() ** 2):.0f} of the square mean",
    )


STATEMENTS = (
    Statement(
        "hidden_facets",
        SHADOWING,
        "because the landscape of microfacets is not perfectly flat, some of the micro facets will shadow or mask other facets",
        "Is less than the whole of the facing area seen, and nearly all of it on a flat surface?",
        _hidden_facets,
    ),
    Statement(
        "too_bright",
        SHADOWING,
        "otherwise, the micro-facets model can easily output more energy than came in",
        "Is there a direction from which eq. 4 without G reflects more than it gets?",
        _too_bright,
        ("microfacet",),
    ),
    Statement(
        "glancing",
        SHADOWING,
        "especially at glancing angles",
        "Does the albedo of eq. 4 without G grow without bound towards grazing incidence, like 1/μ? GGX, F = 1.",
        behaves("microfacet", "diverges", exponent=-1.0, G="none"),
        ("microfacet",),
    ),
    Statement(
        "without_shadowing",
        SHADOWING,
        "where shadowing is not accounted for, resulting in a total reflection surface larger than the projected surface",
        "Is the area of the facets that face the viewer, seen from there, larger than that of the surface?",
        _without_shadowing,
    ),
    Statement(
        "with_shadowing",
        SHADOWING,
        "takes shadowing into account, the resulting area is smaller than the projected surface area",
        "Is the area of the facets that are seen at most that of the surface?",
        _with_shadowing,
    ),
    Statement(
        "masked_energy",
        SHADOWING,
        "and cannot reflect more energy than put in",
        "Is the albedo of eq. 4 at most 1 with V-cavities, with Smith's G, both directions hidden apart or together, and with "
        "Schlick's? GGX.",
        _masked_energy,
        ("microfacet",),
    ),
    Statement(
        "entire_range",
        SHADOWING,
        "The geometry of the micro-facets landscape of a material influence the entire range of reflectance",
        "Is G below 1 in the whole characteristic slice?",
        _entire_range,
        ("microfacet",),
    ),
    Statement(
        "integral_of_brdf",
        SHADOWING,
        "as long as the integral of the BRDF for any possible view direction doesn't exceed 1",
        "Does a white Lambertian surface, which reflects what it gets, pass?",
        unclaimed(
            _without_cosine,
            "By the letter a surface that reflects exactly what it gets would be condemned. With the cosine, as the page's own "
            "eq. 2 weighs the BRDF and as it may be meant, the condition is right.",
        ),
        ("lambert",),
    ),
    Statement(
        "importance_sampling",
        "Importance Sampling",
        "send rays where they matter –toward the important parts of the BRDF– and avoid unimportant parts that would otherwise "
        "consume lots of resources",
        "Is the variance of samples of the facets seen less than that of samples by the cosine? GGX.",
        _importance,
        ("microfacet",),
    ),
    Statement(
        "factor_ten",
        ACCURACY,
        "as long as there are not factor 10 errors in the results, we usually accept an image as “photorealistic”",
        "Do viewers?",
        undecided("A matter of taste, and of an experiment with viewers that the page does not report."),
    ),
    Statement(
        "equation_2",
        "eq. 2",
        "Lr(x, ωo) = ∫ fr(x, ωo, ωi) Li(ωi) (n.ωi) dωi",
        "Does a Lambertian surface under a sky of radiance 1 show its albedo, and a perfect mirror the sky?",
        _equation_2,
        ("lambert", "microfacet"),
    ),
    Statement(
        "last_mip",
        SPEED,
        "a perfectly diffuse material that will sample the last 1x1 mip (actually returning the irradiance)",
        "Is the mean over a face of the cube the irradiance, over π, of a surface that faces it, to 1 %? For a small light.",
        unclaimed(
            last_mip,
            "A plain chain of mips ends in the mean over a face: it weighs light by 1/cos³ instead of cos, and light beyond the "
            "face not at all. The page has its levels filled by a “clever pre-filtering” and does not say by which: one that "
            "fills the last with the irradiance returns it.",
        ),
        ("lambert",),
    ),
    Statement(
        "mirror_level",
        SPEED,
        "a perfectly specular material that will sample a single direction from the most details mip (level 0)",
        "Does the mean of a sky over a cosine lobe tend to its value in the mirror's direction?",
        mirror_level,
    ),
    Statement(
        "glossy_level",
        SPEED,
        "works quite well for a perfectly glossy material that will sample the appropriate mip level depending on the solid "
        "angle",
        "How well?",
        undecided("No error is named that would be small enough, and no sky on which it is to be measured."),
    ),
    Statement(
        "interpolates",
        SPEED,
        "interpolate the glossiness (i.e. the specular power of the cosine lobe in the Blinn-Phong model) from perfectly "
        "diffuse to perfectly specular",
        "Is Blinn's lobe constant for n = 0, and does it contract to one direction as n → ∞?",
        _interpolates,
        ("blinn",),
    ),
    Statement(
        "several_lobes",
        SPEED,
        "But that breaks down rapidly if your BRDF consists of multiple lobes",
        "Is there no single lobe that blurs a sky as two lobes do, to 1 %?",
        _several_lobes,
    ),
)
