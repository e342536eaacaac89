"""The diffuse part, its weights and the bound of 0.44: what the page says of them, on trial."""

from __future__ import annotations

import math
from functools import cache
from typing import Any

import numpy as np

from albedo_lab.analysis.albedo import albedo
from albedo_lab.digits import with_error
from albedo_lab.estimate.record import Estimate, bounded, exact
from albedo_lab.optics.fresnel import dielectric
from albedo_lab.optics.metals import LONGEST, METALS, SHORTEST, index
from albedo_lab.papers.nuaj_models.formulas import DIAMOND, GLASS, WATER, Array, excess, fresnel, generalised, integral, white_sky
from albedo_lab.papers.nuaj_models.variables import paired
from albedo_lab.papers.recipes import Means, figure
from albedo_lab.papers.record import Evidence, Statement
from albedo_lab.papers.trials import number, ruled, subject_of, undecided
from albedo_lab.pictures.evaluation import in_plane, values

DIFFUSE = "Diffuse Part"
COSINES = (1.0, 0.5, 0.1, 1e-2, 1e-3, 1e-5)
WIDTHS = (0.1, 0.01, 0.001)
DRAWN = 1 << 18


def brightest(means: Means, method: str, **parameters: Any) -> Estimate:
    """The largest of the albedos at COSINES of eq. 4 with GGX, Smith's G, glass."""
    tolerance = 1e-7 if method == "quadrature" else 1e-3
    table = albedo(
        "microfacet",
        mu=COSINES,
        F="dielectric",
        tolerance=tolerance,
        method=method,
        seed=means.seed,
        threads=means.threads,
        **parameters,
    )
    return figure(table.nlargest(1, "albedo"), "albedo")


def diffuse_part(mu: float, weight: float) -> float:
    """The albedo of weight (1 - F(theta_d)) / pi, by points even over the projected hemisphere."""
    side = (np.arange(400) + 0.5) / 400
    z, phi = (x.ravel() for x in np.meshgrid(np.sqrt(side), math.pi * side))
    cosine = z * mu + np.sqrt(1.0 - z * z) * math.sqrt(1.0 - mu * mu) * np.cos(phi)
    return weight * float(np.mean(1.0 - fresnel(GLASS, np.sqrt(0.5 * (1.0 + cosine)))))


def _unweighted(means: Means) -> Evidence:
    facets = {alpha: brightest(means, "quadrature", alpha=alpha) for alpha in WIDTHS}
    sampled = brightest(means, "rqmc", alpha=WIDTHS[0])
    return ruled(
        min(e.value for e in facets.values()) > 1e-3,
        f"1 + {', '.join(with_error(e, 1e-4) for e in facets.values())} for α = {', '.join(map(str, WIDTHS))}: a white "
        "Lambertian part leaves no room for facets",
        "quadrature",
        f"facets alone, α = {WIDTHS[0]}: {with_error(sampled, 1e-3)} (rqmc)",
    )


def balance(diffuse: str, weight: float, why: str, means: Means) -> Evidence:
    """Whether a white diffuse part (a_d = 1) with that weight keeps the balance, facets and all."""
    found = {alpha: brightest(means, "quadrature", diffuse=diffuse, a_d=1.0, alpha=alpha) for alpha in WIDTHS}
    worst = max(found, key=lambda alpha: found[alpha].value)
    apart = {
        mu: diffuse_part(mu, weight)
        + float(albedo("microfacet", mu=mu, F="dielectric", alpha=worst, tolerance=1e-6, method="quadrature").albedo[0])
        for mu in COSINES
    }
    return ruled(
        max(e.high for e in found.values()) <= 1.0,
        f"largest albedo {', '.join(with_error(e, 1e-4) for e in found.values())} for α = {', '.join(map(str, WIDTHS))}",
        f"quadrature at cosines of {', '.join(f'{mu:g}' for mu in COSINES)}",
        f"facets and diffuse part one by one, α = {worst}: {max(apart.values()):.4f}",
        why,
    )


def _one_minus_fresnel(means: Means) -> Evidence:
    return balance(
        "one_minus_fresnel",
        1.0,
        "At grazing incidence the facets return up to all the light, while θd of the diffuse directions is 45° or so and 1 − "
        "F(θd) nearly 1. What enters is 1 − F of the light's own angle.",
        means,
    )


def _refracted(means: Means) -> Evidence:
    return balance(
        "refracted",
        1.0 / GLASS**2,
        "The smaller weight hides it on rough surfaces. On smooth ones the facets return nearly all the light at grazing "
        "incidence, and the diffuse part still adds its 1/n² (1 − F(θd)).",
        means,
    )


def _solid_angle(means: Means) -> Evidence:
    theta = np.linspace(0.01, 1.5, 300)
    step = 1e-5
    wrong, told = 0.0, []
    for n in (WATER, GLASS, DIAMOND):
        inside = np.arcsin(np.sin(theta) / n)
        turn = (np.arcsin(np.sin(theta + step) / n) - np.arcsin(np.sin(theta - step) / n)) / (2.0 * step)
        ratio = np.cos(inside) * np.sin(inside) * turn / (np.cos(theta) * np.sin(theta))
        wrong = max(wrong, float(np.max(np.abs(ratio * n * n - 1.0))))
        told.append(f"{float(ratio.mean()):.6f} ({1.0 / n**2:.6f})")
    whole = integral(lambda c: 2.0 * np.pi * c, math.sqrt(1.0 - 1.0 / GLASS**2), 1.0).value / math.pi
    return ruled(
        wrong < 1e-6,
        f"cos θt dωt / (cos θi dωi) (and 1/n²): {', '.join(told)} for water, glass, diamond",
        "Snell's law, differentiated numerically",
        f"the whole hemisphere is refracted into {whole:.6f} of one in glass (1/n² = {1.0 / GLASS**2:.6f}); it is the solid "
        "angle times its cosine that changes so",
    )


def _counterbalances(means: Means) -> Evidence:
    theta = np.linspace(0.01, 1.5, 300)
    step = 1e-5

    def projected(angle: Array) -> Array:
        return np.cos(angle) * np.sin(angle)

    def through(angle: Array) -> Array:
        return np.arcsin(GLASS * np.sin(np.arcsin(np.sin(angle) / GLASS)))

    turn = (through(theta + step) - through(theta - step)) / (2.0 * step)
    wrong = float(np.max(np.abs(projected(through(theta)) * turn / projected(theta) - 1.0)))
    products = [(1.0 / n) ** 2 * n**2 for n in (WATER, GLASS, DIAMOND)]
    return ruled(
        max(abs(product - 1.0) for product in products) < 1e-14,
        "(ni/nt)² (nt/ni)² = 1 for water, glass, diamond",
        "arithmetic",
        f"in and out of glass the solid angle times its cosine comes back, to {wrong:.1g}",
    )


def _critical_cone(means: Means) -> Evidence:
    wrong, told = 0.0, []
    for n in (WATER, GLASS, DIAMOND):
        low, high = 0.0, 0.5 * math.pi
        for _ in range(60):
            middle = 0.5 * (low + high)
            low, high = (middle, high) if dielectric(1.0 / n, math.cos(middle)) < 1.0 else (low, middle)
        wrong = max(wrong, abs(high - math.asin(1.0 / n)))
        told.append(f"{math.degrees(high):.4f}°")
    degrees = [math.degrees(math.asin(1.0 / n)) for n in (WATER, GLASS, DIAMOND)]
    return ruled(
        wrong < 1e-7,
        f"F of light from within reaches 1 at {', '.join(told)}: water, glass, diamond",
        "bisection on Fresnel's reflectance",
        f"asin(ni/nt) = {', '.join(f'{x:.4f}°' for x in degrees)}",
    )


@cache
def returning(n: float, seed: int) -> tuple[float, float]:
    """Of light from within, equally bright from everywhere: the share in the cone, and the share that gets out."""
    c = np.sqrt((np.arange(DRAWN) + np.random.default_rng(seed).random(DRAWN)) / DRAWN)
    outside = np.array([1.0 - dielectric(1.0 / n, x) for x in c.tolist()])
    return float(np.mean(c > math.sqrt(1.0 - 1.0 / n**2))), float(outside.mean())


def first_escape(n: float) -> Estimate:
    """What gets out at the first attempt: by reciprocity, 1/n^2 of what gets in of a white sky."""
    into = white_sky(n)
    return bounded((1.0 - into.value) / n**2, into.half_width / n**2, into.samples, into.method)


def _transmitted(means: Means) -> Evidence:
    cone, out = returning(WATER, means.seed)
    share = 1.0 / WATER**2
    return ruled(
        abs(bound_value(means).value - share) < 1e-3,
        f"in the cone: (ni/nt)² = {share:.4f}; out of it: 1 − (ni/nt)² = {1.0 - share:.4f}; let out by Fresnel "
        f"{with_error(first_escape(WATER), 1e-4)}",
        "closed form and quadrature, water",
        f"samples: {cone:.4f} in the cone, {out:.4f} let out",
        "What is transmitted lies within the cone, whose share of light that is equally bright everywhere is sin²θc = "
        "(ni/nt)². 1 − (ni/nt)² is the share that is reflected back inside.",
    )


def bound_value(means: Means) -> Estimate:
    """1 - (n_i / n_t)^2 of water."""
    return exact(1.0 - 1.0 / WATER**2)


def bound_sampled(means: Means) -> Estimate:
    """The share of samples that miss the cone."""
    cone, _ = returning(WATER, means.seed)
    return bounded(1.0 - cone, 2.0 / math.sqrt(DRAWN), DRAWN, "samples that miss the cone")


def _upper_bound(means: Means) -> Evidence:
    first, all_of_it = first_escape(WATER), 1.0 - white_sky(WATER).value
    _, out = returning(WATER, means.seed)
    # a medium that absorbs nothing sends back what is reflected inside, again and again
    inside, total = 1.0 - all_of_it, 0.0
    light = all_of_it
    for _ in range(200):
        total += light * out
        light *= 1.0 - out
    bound = bound_value(means).value
    return ruled(
        all_of_it <= bound,
        f"water that absorbs nothing returns {all_of_it:.4f} of a white sky from below its surface ({inside:.4f} from the "
        f"surface); {with_error(first, 1e-4)} of what comes up gets out at once",
        "quadrature of Fresnel's reflectance",
        f"200 attempts to get out, {out:.4f} at each by samples: {total:.4f}",
        f"More than {bound:.2f} gets out at the first attempt, and what does not is reflected, not lost: without absorption all "
        "that enters comes back.",
    )


def _exit_weight(means: Means) -> Evidence:
    inside = 1.0 - first_escape(GLASS).value
    undecidable = undecided("“(TODO)”: the page prints no formula.")(means)
    return Evidence(
        undecidable.verdict,
        f"of light from within, equally bright from everywhere, glass reflects {inside:.4f} back inside",
        "quadrature",
        f"samples: {1.0 - returning(GLASS, means.seed)[1]:.4f}",
        undecidable.why,
    )


def _grazing_band(means: Means) -> Evidence:
    theta_d = np.radians(np.linspace(0.0, 89.0, 90))
    wi, wo = paired(math.radians(89.0), theta_d, 0.5 * math.pi)
    steepest = np.degrees(np.arcsin(np.maximum(wi[:, 2], wo[:, 2]).max()))
    formula = np.degrees(np.arcsin(math.cos(math.radians(89.0)) * np.cos(theta_d)).max())
    top = paired(np.radians(np.linspace(0.0, 89.0, 90)), math.radians(89.0), 0.5 * math.pi)
    return ruled(
        bool(steepest <= 1.0 + 1e-9),
        f"at θh = 89° light and viewer are at most {steepest:.3f}° above the surface, whatever θd",
        "rotations",
        f"cos θi = cos θo = cos θh cos θd: {formula:.3f}°. The upper edge, θd = 89°, grazes as well "
        f"({np.degrees(np.arcsin(top[0][:, 2].max())):.3f}°)",
    )


def _retro_corner(means: Means) -> Evidence:
    wi, wo = paired(np.radians(np.array([80.0, 85.0, 89.0])), 0.0, 0.5 * math.pi)
    apart = float(np.max(np.abs(wi - wo)))
    heights = np.degrees(np.arcsin(wi[:, 2]))
    closed = [90.0 - 80.0, 90.0 - 85.0, 90.0 - 89.0]
    return ruled(
        apart < 1e-14,
        f"at θd = 0 light and viewer are the same direction, to {apart:.1g}, and {', '.join(f'{x:.0f}' for x in heights)}° "
        "above the surface at θh = 80, 85, 89°",
        "rotations",
        f"90° − θh: {', '.join(f'{x:.0f}' for x in closed)}°",
    )


def _retro_of_roughness(means: Means) -> Evidence:
    w, sigmas, widths = in_plane(np.array([0.0, 75.0])), (0.0, 0.1, 0.2, 0.3, 0.5), (0.2, 0.3, 0.5, 0.7, 1.0)
    facets = [values(subject_of("microfacet", alpha=alpha), w, w) for alpha in widths]
    lambertian = [values(subject_of("oren_nayar", form="full", sigma=sigma), w, w) for sigma in sigmas]
    surge = [float(f[1] / f[0]) for f in lambertian]
    second = [float(f[1] / f[0]) for f in facets]
    return ruled(
        surge == sorted(surge) and second == sorted(second),
        f"f(75°) / f(0) back to the light: {', '.join(f'{x:.3f}' for x in surge)} for Lambertian facets, σ = "
        f"{', '.join(map(str, sigmas))}",
        "Oren and Nayar's formula",
        f"{', '.join(f'{x:.2g}' for x in second)} for perfect ones of GGX, α = {', '.join(map(str, widths))}",
    )


def _facets_towards_the_light(means: Means) -> Evidence:
    widths, angle = (0.1, 0.2, 0.3, 0.5, 0.7), math.radians(60.0)

    def steeper(alpha: float) -> float:
        return integral(
            lambda t: 2.0 * math.pi * generalised(alpha, 2.0, t) * np.cos(t) * np.sin(t), angle, 0.5 * math.pi
        ).value / excess(alpha, 2.0)

    found = [steeper(alpha) for alpha in widths]
    slope = math.tan(angle)
    closed = [alpha**2 / (alpha**2 + slope**2) for alpha in widths]
    return ruled(
        found == sorted(found),
        f"facets steeper than 60°: {', '.join(f'{100 * x:.2g} %' for x in found)} for α = {', '.join(map(str, widths))}",
        "quadrature of GGX",
        f"α² / (α² + tan² 60°): {', '.join(f'{100 * x:.2g} %' for x in closed)}",
    )


def _metals_absorb(means: Means) -> Evidence:
    nm = np.arange(SHORTEST, LONGEST + 1.0, 5.0)
    k = {metal: min(index(metal, float(x))[1] for x in nm) for metal in METALS}
    left = {metal: math.exp(-4.0 * math.pi * least) for metal, least in k.items()}
    depth = {metal: max(float(x) / (4.0 * math.pi * index(metal, float(x))[1]) for x in nm) for metal in METALS}
    return ruled(
        max(left.values()) < 1e-6,
        "of what enters is left after one wavelength at most "
        + ", ".join(f"{value:.1e} {metal}" for metal, value in left.items()),
        "exp(−4π k), least k of the visible wavelengths",
        "light falls to 1/e within " + ", ".join(f"{value:.0f} nm {metal}" for metal, value in depth.items()),
    )


STATEMENTS = (
    Statement(
        "unweighted",
        DIFFUSE,
        "To enforce energy conservation, the diffuse part should also be multiplied by a factor",
        "Does a white Lambertian part without one exceed the balance, once facets are added? GGX, Smith, n = 1.5.",
        _unweighted,
        ("microfacet",),
    ),
    Statement(
        "one_minus_fresnel",
        DIFFUSE,
        "The simplest choice would be to use 1 − F(θd)",
        "Does a white diffuse part with that factor keep the balance? GGX, Smith, n = 1.5.",
        _one_minus_fresnel,
        ("microfacet",),
    ),
    Statement(
        "refracted",
        DIFFUSE,
        "Fdiffuse = (ni/nt)² (1 − F(θd))",
        "Does a white diffuse part with that factor keep the balance? GGX, Smith, n = 1.5.",
        _refracted,
        ("microfacet",),
    ),
    Statement(
        "solid_angle",
        DIFFUSE,
        "this factor as a change in the size of the solid angle due to penetration in the medium",
        "Is (ni/nt)² the ratio of the solid angles, each times its cosine, after and before refraction?",
        _solid_angle,
    ),
    Statement(
        "counterbalances",
        DIFFUSE,
        "when exiting the material is multiplied by (nt/ni)² so it counterbalances the factor on entry",
        "Is the product of both factors 1?",
        _counterbalances,
    ),
    Statement(
        "exit_weight",
        DIFFUSE,
        "it should be weighted by another kind of “Fresnel term” on the way out …: (TODO)",
        "Which term?",
        _exit_weight,
    ),
    Statement(
        "critical_cone",
        DIFFUSE,
        "only a limited cone of angle θc = sin⁻¹(ni/nt) will contain the rays that can come out of a diffuse medium",
        "Is F = 1 for every ray from within beyond θc, and less within?",
        _critical_cone,
    ),
    Statement(
        "transmitted",
        DIFFUSE,
        "By assuming an isotropic distribution of returning light, we can compute the percentage that will be transmitted …: 1 "
        "− (ni/nt)²",
        "Is the share within the cone 1 − (ni/nt)²? Water.",
        _transmitted,
    ),
    Statement(
        "bound_value",
        DIFFUSE,
        "for an air-water boundary, the maximum subsurface reflectance is approximately 0.44",
        "1 − (ni/nt)² with nt = 1.333",
        number("0.44", bound_value, bound_sampled),
    ),
    Statement(
        "upper_bound",
        DIFFUSE,
        "This sets an upper bound on the subsurface reflectance of 1 − (ni/nt)²",
        "Can no more than that come back from below the surface? Water, lit by a white sky.",
        _upper_bound,
    ),
    Statement(
        "uniform_area",
        DIFFUSE,
        "There is this vast, almost uniform, area of colored reflection",
        "How uniform is a measured slice?",
        undecided("The slice is a picture that is not in the text, and so are the measurements."),
        ("merl",),
    ),
    Statement(
        "grazing_band",
        DIFFUSE,
        "There is a thin vertical band on the right side that represents grazing-reflection",
        "Are light and viewer near the horizon wherever θh is near 90°, φd being 90°?",
        _grazing_band,
        ("merl",),
    ),
    Statement(
        "retro_corner",
        DIFFUSE,
        "At the bottom of this vertical band, when the view and light vectors are colinear, we find the grazing "
        "retro-reflection area",
        "Are light and viewer the same direction at θd = 0, and near the horizon there?",
        _retro_corner,
        ("merl",),
    ),
    Statement(
        "retro_of_roughness",
        DIFFUSE,
        "the surge in retro-reflection essentially comes from the roughness of the material",
        "Does f(75°) / f(0) back to the light grow with roughness, for Lambertian facets and for perfect ones?",
        _retro_of_roughness,
        ("oren_nayar", "microfacet"),
    ),
    Statement(
        "facets_towards_the_light",
        DIFFUSE,
        "If roughness is large … there is potentially a large amount of those micro-facets that will be able to reflect light "
        "in the direction it originally came from",
        "Does the share of facets that face a glancing light grow with α?",
        _facets_towards_the_light,
        ("microfacet",),
    ),
    Statement(
        "metals_absorb",
        DIFFUSE,
        "metals completely absorb photons if they are not reflected specularly",
        "Is less than a millionth left after one wavelength within gold, silver, copper, aluminium?",
        _metals_absorb,
        ("metal",),
    ),
    Statement(
        "metal_slices",
        DIFFUSE,
        "It can be clearly seen in the characteristic slices of several metals",
        "Have the slices of measured metals no diffuse part?",
        undecided("The slices are a picture that is not in the text, and so are the measurements."),
        ("merl",),
    ),
)
