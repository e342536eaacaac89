"""Statements of the abstract, of the introduction and of section 2.1."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from albedo_lab.optics.fresnel import conductor
from albedo_lab.optics.metals import METALS, PAPER_WAVELENGTHS, index
from albedo_lab.papers.neumann1999.equations import Array, Brdf, blinn, cook_torrance, fresnel, phong, ward
from albedo_lab.papers.neumann1999.tried import ANGLES, CODE, albedo, at_mirror, cosine, in_section, sampled, variance
from albedo_lab.papers.recipes import Means
from albedo_lab.papers.record import Statement, Trial
from albedo_lab.papers.trials import CLOSED, Found, checked, measured, trial, undecided
from albedo_lab.pictures.evaluation import in_plane

HE_TORRANCE: dict[str, Any] = {"fresnel": "one", "sigma0": 0.1, "tau": 1.7, "wavelength": 0.5}


ROUGH_HE_TORRANCE = HE_TORRANCE | {"sigma0": 0.5, "tau": 3.0}


TABLE_1: dict[str, dict[str, Any]] = {
    "phong": {"n": 100},
    "blinn": {"n": 100},
    "cook_torrance": {"m": 0.1},
    "ward": {"m": 0.1},
    "he_torrance": HE_TORRANCE,
}


NAMES = {
    "phong": "recip. Phong",
    "blinn": "recip. Blinn",
    "cook_torrance": "Cook-Torrance",
    "ward": "Ward",
    "he_torrance": "He-Torrance",
}


SHARP = 1e8
"""An exponent that stands for n → ∞."""


GRAZING = (89.0, 89.9, 89.99)


def towards_grazing(model: str, **parameters: Any) -> Any:
    """The second method of checks of energy: albedos by samples, ever nearer to grazing."""

    def told(means: Means) -> str:
        return ", ".join(f"a({angle:g}°) = {sampled(model, angle, means, **parameters)}" for angle in GRAZING) + " (rqmc)"

    return told


def darker_than_a_mirror(means: Means) -> Found:
    """However sharp, Phong's and Blinn's lobes reflect less than a mirror."""
    a = {model: albedo(model, 60.0, n=1e6, **scaled(model, 1e6)) for model in ("phong", "blinn")}
    ours = f"a(60°) = {a['phong']:.5f} (Phong), {a['blinn']:.5f} (Blinn) at n = 1e6; a mirror has 1"
    return Found(max(a.values()) < 0.51, ours, "quadrature", f"cos 60° = 0.5 and cos² 60° = 0.25 as n → ∞ ({CLOSED})")


def scaled(model: str, n: float) -> dict[str, float]:
    """The constant of Blinn's model in closed form: its albedo is largest at normal incidence from n = 4 on."""
    return {"scale": (n + 2.0) * (n + 4.0) / (8.0 * math.pi * (n + 2.0 ** (-0.5 * n)))} if "blinn" in model else {}


def not_a_contraction(means: Means) -> Found:
    """The operator's norm is the largest albedo; at 1 the series of reflections grows without end."""
    a = albedo("lambert", 45.0, albedo=1.0)
    bounces, factor, series = 10_000, albedo("stretched_phong", 0.0, n=100), 0.0
    for _ in range(bounces):
        series = 1.0 + a * series
    ours = f"factor {a:g} for a white diffuse surface, {factor:.6f} for the stretched Phong model with the largest c_n"
    again = f"in a closed white furnace that emits 1, {bounces} reflections add up to {series:g} (the iteration itself)"
    return Found(max(a, factor) < 1.0 - 1e-9, ours, "quadrature", again)


def fraction_of_power(means: Means) -> Found:
    """Eq. 2 gives the albedo of a diffuse surface."""
    a = [albedo("lambert", angle, albedo=0.8) for angle in (0.0, 45.0, 89.0)]
    z = (np.arange(1_000_000) + 0.5) / 1e6
    return Found(
        max(abs(x - 0.8) for x in a) < 1e-9,
        f"{a[0]:.9f}, {a[1]:.9f}, {a[2]:.9f} at 0°, 45°, 89°, for f_r = 0.8/π",
        "quadrature",
        f"{2.0 * np.pi * np.mean(0.8 / np.pi * z):.9f} (midpoint rule)",
    )


def mirror_albedo(means: Means) -> Found:
    """An ideal mirror with F = 1 reflects everything at every angle."""
    a = [albedo("mirror", angle, F=1.0) for angle in (0.0, 45.0, 89.99)]
    again = ", ".join(sampled("mirror", angle, means, F=1.0) for angle in (0.0, 45.0, 89.99))
    return Found(a == [1.0, 1.0, 1.0], f"albedo {a[0]:g}, {a[1]:g}, {a[2]:g} at 0°, 45°, 89.99°", "Dirac part", f"{again} (rqmc)")


def spread_of_colours(metal: str, theta_deg: float) -> tuple[float, float]:
    """Largest less smallest reflectance over the wavelengths, by the model's code and by complex amplitudes."""
    indices = [index(metal, wavelength) for wavelength in PAPER_WAVELENGTHS]
    ours = [conductor(eta, k, cosine(theta_deg)) for eta, k in indices]
    again = [float(fresnel(complex(eta, k), np.array(cosine(theta_deg)))) for eta, k in indices]
    return max(ours) - min(ours), max(again) - min(again)


def colour_fades(means: Means) -> Found:
    """At grazing angles less is left of what tells the wavelengths apart."""
    at = {metal: (spread_of_colours(metal, 0.0), spread_of_colours(metal, 89.9)) for metal in METALS}
    ours = "; ".join(f"{metal} {near[0]:.3f} → {far[0]:.4f}" for metal, (near, far) in at.items())
    again = "; ".join(f"{metal} {near[1]:.3f} → {far[1]:.4f}" for metal, (near, far) in at.items())
    condition = all(far[0] < 0.3 * near[0] for near, far in at.values())
    return Found(
        condition, f"spread of F over 400 to 750 nm, 0° → 89.9°: {ours}", "Fresnel, real parts", f"{again} (complex amplitudes)"
    )


def aluminium_on_the_way(means: Means) -> Found:
    """Of aluminium the colour grows before it fades."""
    angles = np.arange(0.0, 90.0, 0.25)
    ours, again = np.array([spread_of_colours("aluminium", float(angle)) for angle in angles]).T
    top, other = int(np.argmax(ours)), int(np.argmax(again))
    return Found(
        bool(np.all(np.diff(ours) <= 0.0)),
        f"aluminium's spread of F is {ours[0]:.3f} at 0° and {ours[top]:.3f} at {angles[top]:g}°",
        "Fresnel, real parts",
        f"{again[0]:.3f} and {again[other]:.3f} at {angles[other]:g}° (complex amplitudes)",
    )


def exponent_at_mirror(model: str, **parameters: Any) -> float:
    """s in f ~ cos^s Theta_L at the mirror direction, between 60 and 80 degrees."""
    near, far = (at_mirror(model, angle, **parameters) / cosine(angle) for angle in (60.0, 80.0))
    return math.log(far / near) / math.log(cosine(80.0) / cosine(60.0))


def compensating(means: Means) -> Found:
    """How the BRDFs that table 1 calls metallic go with the angle, at the mirror direction."""
    s = {model: exponent_at_mirror(model, **TABLE_1[model]) for model in ("ward", "cook_torrance", "he_torrance")}
    ours = ", ".join(f"{NAMES[model]} {value:.2f}" for model, value in s.items())
    again = "Ward -1, Cook-Torrance -2 as G = 1 at the mirror direction (closed form)"
    return Found(False, f"f ~ cos^s Θ_L at the mirror direction, 60° to 80°, s: {ours} (its lobe alone)", CODE, again)


def uphill(f: Array, angles: Array, start_deg: float) -> float:
    """The viewer's angle at the summit that is reached uphill from an angle, 90 where it is at the horizon."""
    at = int(np.argmin(np.abs(angles - start_deg)))
    # flat to rounding counts as the summit itself
    step = 1 if f[at + 1] > f[at] * (1.0 + 1e-9) else -1 if f[at - 1] > f[at] * (1.0 + 1e-9) else 0
    while step and 0 < at < len(angles) - 1 and f[at + step] > f[at]:
        at += step
    return 90.0 if at == len(angles) - 1 else float(angles[at])


LIGHT = 75.0


VIEWERS = np.arange(1.0, 89.995, 0.01)


PRINTED_SHAPES = {"phong": phong(100), "blinn": blinn(100), "cook_torrance": cook_torrance(0.1), "ward": ward(0.1)}


def peak(model: str, **parameters: Any) -> float:
    """Where the lobe of a model is highest beside the mirror direction."""
    return uphill(in_section(model, LIGHT, VIEWERS, **parameters), VIEWERS, LIGHT)


def printed_peak(f: Brdf) -> float:
    """The same of a formula."""
    return uphill(f(in_plane(np.full(len(VIEWERS), -LIGHT)), in_plane(VIEWERS)), VIEWERS, LIGHT)


def off_specular(model: str, expected: bool) -> Trial:
    """Whether the lobe's summit is beyond the mirror direction for light from 75 degrees."""
    parameters = ROUGH_HE_TORRANCE if model == "he_torrance" else TABLE_1[model]

    def find(means: Means) -> Found:
        at = peak(model, **parameters)
        if model == "he_torrance":
            other = peak(model, **HE_TORRANCE)
            again = f"{other:.2f}°, nearer to the normal, for the smoother surface of figure 5 ({CODE})"
        else:
            again = f"{printed_peak(PRINTED_SHAPES[model]):.2f}° (the formula alone)"
        return Found((at > 75.1) is expected, f"summit at {at:.2f}° for light from 75°", CODE, again)

    return trial(find, "1 / √(cos Θ_L cos Θ_V) grows towards the horizon and moves the summit beyond the mirror direction")


def all_but_the_last(means: Means) -> Found:
    """Of the new models only the stretched Phong converges to the mirror."""
    new = {"stretched_phong": {"n": SHARP}, "stretched_blinn": {"n": SHARP}, "modified_ward": {"m": 1e-4}}
    a = {model: albedo(model, 60.0, **p, **scaled(model, SHARP)) for model, p in new.items()}
    ours = ", ".join(f"{model} {value:.4f}" for model, value in a.items())
    again = f"1, cos 60° = 0.5 and cos 60° = 0.5 as the lobe contracts ({CLOSED}: note of table 3)"
    return Found(min(a.values()) > 0.99, f"a(60°) of the sharpest lobes: {ours}; a mirror has 1", "quadrature", again)


def darkens(means: Means) -> Found:
    """Albedo and radiance decrease with the angle."""
    angles = np.arange(0.0, 90.0, 3.0)
    rises = []
    for model in ("phong", "blinn"):
        for n in (1, 10, 100):
            a = np.array([albedo(model, float(angle), n=n) for angle in angles])
            out = np.array([at_mirror(model, float(angle), n=n) for angle in angles])
            rises += [float(np.max(np.diff(a))), float(np.max(np.diff(out)))]
    again = ", ".join(sampled("phong", angle, means, n=10) for angle in (0.0, 45.0, 80.0))
    ours = f"steps of 3°: none of albedo or radiance at the mirror direction is up (largest {max(rises):.1e})"
    return Found(max(rises) <= 1e-9, ours, "quadrature", f"Phong, n = 10: {again} at 0°, 45°, 80° (rqmc)")


def follows(model: str, power: int) -> Trial:
    """Whether the albedo tends to the cosine as n grows."""

    def find(means: Means) -> Found:
        angles = (30.0, 60.0, 80.0)
        n = 1e6
        a = [albedo(model, angle, n=n, **scaled(model, n)) for angle in angles]
        worst = max(abs(x - cosine(angle)) for x, angle in zip(a, angles, strict=True))
        limit = max(abs(x - cosine(angle) ** power) for x, angle in zip(a, angles, strict=True))
        ours = f"a = {a[0]:.4f}, {a[1]:.4f}, {a[2]:.4f} at 30°, 60°, 80°, n = 1e6; largest distance from cos Θ {worst:.1g}"
        again = f"cos^{power} Θ as the lobe contracts ({CLOSED}); largest distance from it {limit:.1g}"
        return Found(worst < 1e-3, ours, "quadrature", again)

    return trial(find, "Blinn's albedo tends to the square of the cosine: the Jacobian 4 (L·H) of the half-vector adds a factor")


def dark_at_ninety(means: Means) -> Found:
    """The albedo at grazing incidence goes to 0 with n."""
    exponents = (1e2, 1e4, 1e6)
    a = [albedo("phong", 90.0 - 1e-7, n=n) for n in exponents]
    expected = [(n + 2.0) / (n + 1.0) / math.sqrt(2.0 * math.pi * n) for n in exponents]
    ours = ", ".join(f"{x:.2e}" for x in a)
    again = ", ".join(f"{x:.2e}" for x in expected)
    return Found(
        a[-1] < 1e-3 and a[0] > 10.0 * a[-1], f"a(90°) = {ours} at n = 1e2, 1e4, 1e6", "quadrature", f"1/√(2πn): {again}"
    )


def efficient(models: dict[str, dict[str, Any]], expected: bool, least: float, why: str = "") -> Trial:
    """Whether a sampler with its density is known: right, and so many times as efficient as the cosine at every one of ANGLES."""

    def find(means: Means) -> Found:
        gains, estimates = [], []
        for model, p in models.items():
            own = [variance(model, angle, means, **p) for angle in ANGLES]
            cosines = [variance(model, angle, means, by_cosine=True, **p) for angle in ANGLES]
            gain = [by / max(mine, 1e-9) for by, mine in zip(cosines, own, strict=True)]
            gains.append(min(gain))
            estimates.append(f"{albedo(model, 45.0, **p):.5f} and {sampled(model, 45.0, means, **p)}")
        shown = ", ".join(f"{gain:.0f}" if gain >= 10.0 else f"{gain:.1f}" for gain in gains)
        ours = f"at least {shown} times less variance than by the cosine, at 5°, 45°, 80°"
        again = f"a(45°) by quadrature and by these samples: {'; '.join(estimates)}"
        return Found(bool(min(gains) >= least) is expected, ours, "Monte Carlo, 65536 samples", again)

    return trial(find, why)


SAMPLED_NOW = (
    "a sampler only has to be about proportional, as §4 itself says: normals of the microfacets can be drawn in closed "
    "form and the "
    "light reflected about them"
)


COOK_TORRANCE_BOUNDED = (
    "with V-cavities, as Cook and Torrance have them, G takes the growth away: the albedo tends to 1, never above"
)

STATEMENTS = (
    Statement(
        "phong_and_blinn_not_metallic",
        "abstract",
        "The Phong and the Blinn models are known not to have metallic characteristics.",
        "As n → ∞ they do not become mirrors: the albedo at 60° stays below 0.51.",
        trial(darker_than_a_mirror),
        ("phong", "blinn"),
    ),
    Statement(
        "cook_torrance_not_plausible",
        "abstract",
        "the Cook-Torrance … models are not physically plausible, because of their behavior at grazing angles",
        "The model of figure 5 (m = 0.1, Fresnel term 1, V-cavities) breaks energy balance.",
        checked(
            "energy", "FAIL", "cook_torrance", again=towards_grazing("cook_torrance", m=0.1), why=COOK_TORRANCE_BOUNDED, m=0.1
        ),
        ("cook_torrance",),
    ),
    Statement(
        "ward_not_plausible",
        "abstract",
        "the … Ward models are not physically plausible, because of their behavior at grazing angles",
        "Eq. 34 with C_max = 1 and m = 0.1 breaks energy balance.",
        checked("energy", "FAIL", "ward", m=0.1),
        ("ward",),
    ),
    Statement(
        "no_compact_model_so_far",
        "abstract",
        "So far there has been no metallic BRDF model that is easy to compute, suitable for fast importance sampling "
        "and is physically "
        "plausible.",
        "Whether none of the models known in 1999 has all three properties.",
        undecided("how easy is easy, and how metallic, the paper does not say; which models it searched, neither"),
    ),
    Statement(
        "original_phong_violates_physics",
        "§1",
        "Since the original form violates physics",
        "Phong's original formula as a BRDF, cosⁿα / cos Θ_L, is not reciprocal.",
        checked("reciprocity", "FAIL", "phong_original", n=20),
        ("phong_original",),
    ),
    Statement(
        "physical_models_not_sampled",
        "§1",
        "These models are not suitable for importance sampling",
        "No sampler of Cook-Torrance (m = 0.1) or He-Torrance (σ₀ = 0.1, τ = 1.7, λ = 0.5) is ten times as efficient "
        "as the cosine.",
        efficient({m: TABLE_1[m] for m in ("cook_torrance", "he_torrance")}, False, 10.0, SAMPLED_NOW),
        ("cook_torrance", "he_torrance"),
    ),
    Statement(
        "integration_and_inversion_impossible",
        "§1",
        "Not only is it impossible to compute the required integral and inversion analytically",
        "No closed form exists for the integral and inverse of f_r cos of Cook-Torrance and He-Torrance.",
        undecided("an exact density's closed form cannot be excluded by trying; the paper gives no proof"),
        ("cook_torrance", "he_torrance"),
    ),
    Statement(
        "ward_and_schlick_are_sampled",
        "§1",
        "Ward and Schlick presented simplified versions of the Cook-Torrance model that are suitable for importance sampling.",
        "Both (m = 0.1, r = 0.1) have a sampler at least twice as efficient as the cosine.",
        efficient({"ward": {"m": 0.1}, "schlick_isotropic": {"r": 0.1}}, True, 2.0),
        ("ward", "schlick_isotropic"),
    ),
    Statement(
        "lafortune_needs_many_terms",
        "§1",
        "this approach requires a great number of elementary terms to sufficiently represent highly specular materials",
        "How many lobes of eq. 14 represent a given metal.",
        undecided("no error is named that would be sufficient"),
        ("lafortune",),
    ),
    Statement(
        "equation_2",
        "eq. 2",
        "the albedo, that is the fraction of the total reflected power",
        "∫ f_r cos Θ_V dω_V of a diffuse surface with f_r = ρ/π is ρ, at every angle.",
        trial(fraction_of_power),
        ("lambert",),
    ),
    Statement(
        "energy_balance_contracts",
        "§1, after eq. 2",
        "Energy balance makes the linear operator of the rendering equation a contraction",
        "a ≤ 1 (ineq. 2, equality allowed) makes the operator's norm less than 1.",
        trial(not_a_contraction, "the norm is 1 where a = 1, which ineq. 2 allows; where a < 1 throughout, the sentence holds"),
        ("lambert", "stretched_phong"),
    ),
    Statement(
        "ideal_mirror",
        "§2.1",
        "an ideal mirror would reflect all energy independently of the illumination, that is the albedo is 1",
        "δ F / cos Θ_L with F = 1 has albedo 1 at every angle.",
        trial(mirror_albedo),
        ("mirror",),
    ),
    Statement(
        "colour_fades",
        "§2.1",
        "Due to the angle dependence of the Fresnel function, this color fades at grazing angles.",
        "Gold, silver, copper, aluminium: F varies over 400 to 750 nm by less than a third at 89.9° of what it does at 0°.",
        trial(colour_fades),
        ("metal",),
    ),
    Statement(
        "colour_fades_steadily",
        "§2.1",
        "this color fades at grazing angles",
        "The spread of aluminium's F over 400 to 750 nm does nowhere grow with the angle.",
        measured(
            aluminium_on_the_way,
            "in the limit the colour goes (see colour_fades), but aluminium's is strongest at about 84°, near its "
            "pseudo-Brewster angles; the paper does not say where grazing begins",
        ),
        ("metal",),
    ),
    Statement(
        "metals_compensate",
        "§2.1",
        "The BRDF function of metals has 1/cos Θ_L characteristics that can compensate for the cos Θ_L factor of the irradiance",
        "How f_r at the mirror direction goes with cos Θ_L, for the models that table 1 calls metallic.",
        measured(compensating, "the models differ among themselves, and the paper gives no measurement of a metal"),
        ("ward", "cook_torrance", "he_torrance"),
    ),
    Statement(
        "off_specular_at_great_angles",
        "§2.1",
        "For great incident angles, the peak of the reflection lobe … occurs at an angle greater than the angle of incidence.",
        "Cook-Torrance, m = 0.1, light from 75°: the summit is beyond 75°.",
        off_specular("cook_torrance", True),
        ("cook_torrance",),
    ),
    Statement(
        "all_but_the_last",
        "§2.1",
        "We shall conclude that the new models meet all but the last requirements.",
        "All three (stretched Phong, stretched Blinn, modified Ward) converge to the ideal mirror: their albedo at 60° "
        "tends to 1.",
        trial(
            all_but_the_last, "those of (N·H) type tend to the cosine, not to 1; only the stretched Phong model becomes a mirror"
        ),
        ("stretched_phong", "stretched_blinn", "modified_ward"),
    ),
    Statement(
        "phong_type_darkens",
        "§2.1",
        "as the incident angle grows towards the grazing angle, the ratio of the total reflected and incident powers "
        "as well as the "
        "output radiance decrease",
        "Albedo, and radiance at the mirror direction, of Phong and Blinn fall with the angle; n = 1, 10, 100.",
        trial(darkens),
        ("phong", "blinn"),
    ),
    Statement(
        "phong_follows_the_cosine",
        "§2.1",
        "in this limit case the albedo follows the cosine function",
        "Phong's albedo tends to cos Θ as n → ∞.",
        follows("phong", 1),
        ("phong",),
    ),
    Statement(
        "blinn_follows_the_cosine",
        "§2.1",
        "these models … the albedo follows the cosine function",
        "Blinn's albedo tends to cos Θ as n → ∞.",
        follows("blinn", 2),
        ("blinn",),
    ),
    Statement(
        "phong_vanishes_at_ninety",
        "§2.1",
        "If n goes to infinity, then the reflected radiance and the albedo converges to zero for 90 degree incident angle",
        "Phong's albedo at grazing incidence goes to 0 with growing n.",
        trial(dark_at_ninety),
        ("phong",),
    ),
)
