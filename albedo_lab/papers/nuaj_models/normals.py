"""Eq. 4 and its distributions of normals: what the page says of both, on trial."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from functools import partial

import numpy as np

from albedo_lab.digits import with_error
from albedo_lab.estimate.record import Estimate, bounded
from albedo_lab.optics.frame import Direction
from albedo_lab.optics.masking import beckmann_lambda
from albedo_lab.optics.normals import beckmann_slope
from albedo_lab.papers.nuaj_models.formulas import Array, beckmann, excess, generalised, integral, phong, projected
from albedo_lab.papers.recipes import Means, albedo_of
from albedo_lab.papers.record import Evidence, Statement, Trial
from albedo_lab.papers.trials import checked, ruled, subject_of, undecided
from albedo_lab.pictures.evaluation import in_plane, values

ANALYTICAL, SPECULARITY = "Analytical models of BRDF", "Specularity"
EXPONENTS, WIDTHS, GAMMAS = (10.0, 100.0, 1000.0), (0.1, 0.3, 0.6), (0.5, 1.0, 1.5, 2.0, 3.0)
FINEST = 1e-9


def on_disc(D: Callable[[Array], Array]) -> float:
    """The area of all facets seen from above, by points even over the disc below them: cos^2 is even there."""
    theta = np.arccos(np.sqrt((np.arange(200_000) + 0.5) / 200_000))
    return math.pi * float(D(theta).mean())


def normalised(distributions: Mapping[str, Callable[[Array], Array]], why: str = "") -> Trial:
    """Whether the integral of D cos is 1 for each distribution, by the name of its parameter."""

    def trial(means: Means) -> Evidence:
        found = [projected(D) for D in distributions.values()]
        told = "; ".join(f"{with_error(e, 1e-6)} for {name}" for e, name in zip(found, distributions, strict=True))
        again = ", ".join(f"{on_disc(D):.5f}" for D in distributions.values())
        right = all(abs(e.value - 1.0) <= e.half_width + FINEST for e in found)
        return ruled(right, told, "quadrature over the angle", f"{again} by points of the disc", why)

    return trial


def white_furnace(m: float, mu: float) -> Estimate:
    """The integral of D G1 / (4 mu) over all directions wi, below the surface as well; 1 if the 4 is right.

    In spherical coordinates of wi about wo; h is then half as far from wo. Beckmann's facets steeper than a cosine of 0.02 are
    left out: there are none that a double could count.
    """
    s = math.sqrt(1.0 - mu * mu)
    G1 = 1.0 / (1.0 + beckmann_lambda(m, Direction(s, 0.0, mu)))
    psi = (np.arange(256) + 0.5) * (2.0 * math.pi / 256)

    def ring(beta: Array) -> Array:
        half = 0.5 * beta
        z = np.cos(half)[:, None] * mu - np.sin(half)[:, None] * s * np.cos(psi)
        D = np.where(z > 0.02, beckmann(m, np.arccos(np.clip(z, 0.02, 1.0))), 0.0)
        found: Array = np.sin(beta) * D.mean(axis=1) * 2.0 * math.pi
        return found

    e = integral(ring, 0.0, math.pi)
    return bounded(e.value * G1 / (4.0 * mu), (e.half_width * G1 / (4.0 * mu)) + 1e-12, e.samples * 256, "quadrature")


def _equation_4(means: Means) -> Evidence:
    found = [white_furnace(0.5, mu) for mu in (1.0, 0.5, 0.2)]
    smooth = albedo_of("microfacet", 30.0, alpha=1e-4)(Means(1e-5, "rqmc", means.seed, means.threads))
    right = all(abs(e.value - 1.0) < 1e-6 for e in found) and abs(smooth.value - 1.0) < 1e-3
    return ruled(
        right,
        f"∫ D G1 / (4 cos θo) dωi = {', '.join(with_error(e, 1e-6) for e in found)} at cos θo = 1, 0.5, 0.2 (Beckmann, m = 0.5)",
        "quadrature over all directions",
        f"perfect facets that are nearly flat (GGX, α = 1e-4) reflect {with_error(smooth, 1e-5)} of what comes from 30° (rqmc); "
        "with π for 4 that would be 1.27",
    )


def _phong_argument(means: Means) -> Evidence:
    n, turn = 100.0, np.radians(np.array([10.0]))
    as_printed, meant = float(phong(n, turn)[0]), float(phong(n, 0.5 * turn)[0])
    area = projected(partial(phong, n))
    return ruled(
        as_printed == meant,
        f"at normal incidence, n = 100, θr = 10°, θh = 5°: D is {as_printed:.4g} of θr and {meant:.4g} of θh",
        "evaluation in double precision",
        f"of θh it is a distribution of normals: ∫ D cos = {with_error(area, 1e-9)}",
        "The left side names θr, the angle from the mirror direction, the right side θh; the two are not the same function. "
        "Eq. 4 and all other distributions of the page are functions of θh.",
    )


def _rms_slope(means: Means) -> Evidence:
    u = (np.arange(200_000) + 0.5) / 200_000
    told, again, right = [], [], True
    for m in WIDTHS:

        def weight(theta: Array, m: float = m) -> Array:
            return 2.0 * math.pi * np.tan(theta) ** 2 * beckmann(m, theta) * np.cos(theta) * np.sin(theta)

        mean = integral(weight, 0.0, 0.5 * math.pi)
        root = bounded(math.sqrt(mean.value), mean.half_width / math.sqrt(mean.value) + 1e-12, mean.samples, "quadrature")
        drawn = math.sqrt(float(np.mean([beckmann_slope(m, x) ** 2 for x in u[::20]])))
        right = right and abs(root.value - m) <= root.half_width + FINEST and abs(drawn - m) < 1e-3 * m
        told.append(with_error(root, 1e-6))
        again.append(f"{drawn:.5f}")
    return ruled(
        right,
        f"root of the mean of tan²θh over the facets: {', '.join(told)} for m = 0.1, 0.3, 0.6 (in one direction it is m/√2)",
        "quadrature",
        f"from slopes drawn: {', '.join(again)}",
    )


def ellipsoid(alpha: float, u: Array) -> tuple[Array, Array]:
    """Angle and distribution of an oblate ellipsoid's normals, by its area: radius 1, height alpha, from above a disc of pi."""
    q = np.cos(u) ** 2 + alpha**2 * np.sin(u) ** 2
    theta = np.arctan(alpha * np.tan(u))
    return theta, np.sin(u) * np.sqrt(q) * q / (alpha * np.sin(theta)) / np.pi


def _trowbridge_reitz_exponent(means: Means) -> Evidence:
    alpha = 0.3
    theta, D = ellipsoid(alpha, np.linspace(0.05, 1.52, 400))
    q = alpha**2 * np.cos(theta) ** 2 + np.sin(theta) ** 2
    slope = -float(np.polyfit(np.log(q), np.log(D), 1)[0])
    apart = float(np.max(np.abs(D / generalised(alpha, 2.0, theta) - 1.0)))
    return ruled(
        abs(slope - 1.0) < 1e-6,
        f"normals of an ellipsoid of revolution go like q^−{slope:.6f}, q = α² cos² + sin²",
        "area of the ellipsoid per solid angle of its normals, fitted",
        f"they are GGX's, to {apart:.1g} of it",
        "Trowbridge and Reitz (1975) take facets for ellipsoids of revolution. Their distribution has the exponent 2 and is "
        "the one called GGX, as losasso's Blinn model prints it too; with the exponent 1 it is the one that Disney's notes "
        "call Berry's.",
    )


def _not_ggx(means: Means) -> Evidence:
    theta = np.radians(np.array([0.0, 30.0, 60.0]))
    ratio = generalised(0.1, 1.0, theta) / generalised(0.1, 2.0, theta)
    q = 0.01 * np.cos(theta) ** 2 + np.sin(theta) ** 2
    return ruled(
        bool(np.all(np.abs(ratio - 1.0) > 0.01)),
        f"D_TR of the page is {', '.join(f'{r:.3g}' for r in ratio)} times GGX at θh = 0, 30, 60° (α = 0.1)",
        "evaluation in double precision",
        f"α² cos² + sin² there: {', '.join(f'{x:.3g}' for x in q)}",
    )


def tails(means: Means) -> Evidence:
    """D at 30 degrees over D at 0, for a width of 0.1, or as many normals within the peak."""
    theta = np.radians(np.array([30.0, 0.0]))
    shapes: dict[str, Callable[[Array], Array]] = {
        "Beckmann": partial(beckmann, 0.1),
        "Blinn-Phong, n = 198": partial(phong, 198.0),
        "GGX": partial(generalised, 0.1, 2.0),
        "γ = 1.5": partial(generalised, 0.1, 1.5),
        "γ = 1": partial(generalised, 0.1, 1.0),
    }
    found = {name: float(D(theta)[0] / D(theta)[1]) for name, D in shapes.items()}
    steeper = []
    for gamma in (2.0, 1.5, 1.0):

        def weight(t: Array, gamma: float = gamma) -> Array:
            return 2.0 * math.pi * generalised(0.1, gamma, t) * np.cos(t) * np.sin(t)

        steeper.append(integral(weight, math.radians(30.0), 0.5 * math.pi).value / excess(0.1, gamma))
    order = list(found.values())
    return ruled(
        order == sorted(order) and steeper == sorted(steeper),
        "D(30°) / D(0): " + ", ".join(f"{value:.2g} {name}" for name, value in found.items()) + " (all other widths 0.1)",
        "evaluation in double precision",
        f"share of facets steeper than 30°: {', '.join(f'{100 * s:.2g} %' for s in steeper)} for γ = 2, 1.5, 1 (quadrature)",
    )


def _retro_reflection(means: Means) -> Evidence:
    degrees = np.array([0.0, 60.0, 85.0])
    w, widths = in_plane(degrees), (0.1, 0.2, 0.3, 0.5, 0.7)
    f = np.array([values(subject_of("microfacet", alpha=alpha, G="none"), w, w) for alpha in widths])
    formula = np.array([generalised(alpha, 2.0, np.radians(degrees)) / (4.0 * w[:, 2] ** 2) for alpha in widths])
    apart = float(np.max(np.abs(f / formula - 1.0)))
    masked = np.array([values(subject_of("microfacet", alpha=alpha), w, w) for alpha in widths])
    growth = masked[:, 2] / masked[:, 1]
    return ruled(
        apart < 1e-9 and bool(np.all(growth > 1.0)),
        f"f(85°) / f(60°) back to the light: {', '.join(f'{g:.3g}' for g in growth)} for GGX with α = "
        f"{', '.join(map(str, widths))}",
        "evaluation in double precision, with Smith's G",
        f"without G, f = D(θ) / (4 cos²θ), to {apart:.1g}: it is D at large angles that shows there",
    )


STATEMENTS = (
    Statement(
        "none_covers_all",
        ANALYTICAL,
        "none of them successfully covers all the parts of the BRDF correctly",
        "Is some measured slice matched by no model?",
        undecided("The models are those of a list that is not in the text, and so are the measurements."),
    ),
    Statement(
        "equation_4",
        "eq. 4",
        "fr = diffuse + F(θd) G(θi, θo) D(θh) / (4 cos θi cos θo)",
        "Is 4 the right constant: do perfect facets, hidden from the viewer alone, return all the light?",
        _equation_4,
        ("microfacet",),
    ),
    Statement(
        "equation_4_reciprocal",
        "eq. 4",
        "F(θd) G(θi, θo) D(θh) / (4 cos θi cos θo)",
        "Is it reciprocal? With GGX, Smith's G, exact F and a diffuse part of eq. 4 weighted by 1 − F(θd).",
        checked("reciprocity", "PASS", "microfacet", F="dielectric", diffuse="one_minus_fresnel"),
        ("microfacet",),
    ),
    Statement(
        "d_phong",
        SPECULARITY,
        "Dphong = (2+n)/(2π) cos(θh)^n",
        "Is it normalised, ∫ D cos dω = 1, for n = 10, 100, 1000?",
        normalised({f"n = {n:g}": partial(phong, n) for n in EXPONENTS}),
        ("microfacet",),
    ),
    Statement(
        "d_phong_argument",
        SPECULARITY,
        "Dphong(θr) = … cos(θh)^n",
        "Is that of θr the same as that of θh?",
        _phong_argument,
        ("microfacet",),
    ),
    Statement(
        "d_beckmann",
        SPECULARITY,
        "Dbeckmann(θh) = e^(−tan²θh/m²) / (π m² cos⁴θh)",
        "Is it normalised for m = 0.1, 0.3, 0.6?",
        normalised({f"m = {m:g}": partial(beckmann, m) for m in WIDTHS}),
        ("microfacet",),
    ),
    Statement(
        "rms_slope",
        SPECULARITY,
        "m is the Root Mean Square (rms) slope of the surface microfacets",
        "Is the root of the mean squared slope of the facets, by their area seen from above, m?",
        _rms_slope,
        ("microfacet",),
    ),
    Statement(
        "d_tr",
        SPECULARITY,
        "DTR(θh) = α² / (π(α² cos(θh)² + sin(θh)²))",
        "Is it normalised for α = 0.1, 0.3, 0.6?",
        normalised(
            {f"α = {alpha:g}": partial(generalised, alpha, 1.0) for alpha in WIDTHS},
            "The constant that normalises it is (1 − α²) / (2π ln(1/α)); α²/π is that of the exponent 2.",
        ),
        ("microfacet",),
    ),
    Statement(
        "tr_exponent",
        SPECULARITY,
        "the Trowbridge-Reitz distribution: … / (π(α² cos(θh)² + sin(θh)²))",
        "Do Trowbridge and Reitz's facets, ellipsoids of revolution, have normals that go like the power −1 of α² cos² + sin²?",
        _trowbridge_reitz_exponent,
        ("microfacet", "blinn_trowbridge_reitz"),
    ),
    Statement(
        "not_ggx",
        SPECULARITY,
        "This is NOT the expression for the GGX distribution that uses an exponent 2 for the denominator",
        "Is the printed formula another function than that with the exponent 2?",
        _not_ggx,
        ("microfacet",),
    ),
    Statement(
        "short_tails",
        SPECULARITY,
        "Most models fail to accurately represent specularity due to “short tails” as can be seen in the figure below",
        "Do measured lobes have longer tails than most models?",
        undecided("The figure and its measurements are not in the text."),
    ),
    Statement(
        "longer_tails",
        SPECULARITY,
        "Disney uses an interesting variation … that helps to compensate for the short tail problem",
        "Are the tails longer than Beckmann's and Blinn-Phong's, the longer the smaller γ?",
        tails,
        ("microfacet",),
    ),
    Statement(
        "d_gtr",
        SPECULARITY,
        "DgeneralizedTR(θh) = α² / (π(α² cos(θh)² + sin(θh)²)^γ)",
        "Is it normalised for γ = 0.5, 1, 1.5, 2, 3? α = 0.1.",
        normalised(
            {f"γ = {gamma:g}": partial(generalised, 0.1, gamma) for gamma in GAMMAS},
            "α²/π normalises γ = 2 alone; in general it takes (γ−1)(1 − α²) / (π(α^(2−2γ) − 1)).",
        ),
        ("microfacet",),
    ),
    Statement(
        "retro_reflection",
        SPECULARITY,
        "The NDF is here to represent the specularity of the BRDF but also the retro-reflection at glancing angles",
        "Is what eq. 4 sends back to the light D(θ) / (4 cos²θ), and does it surge towards glancing angles?",
        _retro_reflection,
        ("microfacet",),
    ),
)
