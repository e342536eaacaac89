"""Fresnel's reflectance and Schlick's form of it: what the page says of both, on trial."""

from __future__ import annotations

import math

import numpy as np

from albedo_lab.analysis.grazing import law
from albedo_lab.digits import with_error
from albedo_lab.optics.colour import srgb_weights
from albedo_lab.optics.fresnel import conductor, dielectric, normal_reflectance
from albedo_lab.optics.fresnel import schlick as schlick_of_library
from albedo_lab.optics.metals import LONGEST, METALS, SHORTEST, index
from albedo_lab.papers.nuaj_models.formulas import DIAMOND, GLASS, WATER, Array, directions, fresnel, polarised, schlick
from albedo_lab.papers.nuaj_models.variables import PAIRS, angles_of
from albedo_lab.papers.recipes import Means, albedo_of
from albedo_lab.papers.record import Evidence, Statement
from albedo_lab.papers.trials import extremum, grazing_words, ruled, subject_of, unclaimed, undecided
from albedo_lab.papers.verdict import Kind, Verdict
from albedo_lab.pictures.evaluation import values

FRESNEL = "Fresnel"
YELLOW = 550.0
COLOURS = np.arange(SHORTEST, LONGEST + 1.0, 5.0)
"""In nm."""


def media() -> dict[str, complex]:
    """Refractive indices: three dielectrics, and the four metals of the library at 550 nm."""
    return {"water": WATER, "glass": GLASS, "diamond": DIAMOND} | {metal: complex(*index(metal, YELLOW)) for metal in METALS}


def by_library(n: complex, c: Array) -> Array:
    """The library's reflectance, in real numbers only."""
    return np.array([conductor(n.real, n.imag, float(x)) if n.imag else dielectric(n.real, float(x)) for x in c])


def normal_spectrum(metal: str) -> Array:
    """The reflectance at normal incidence at COLOURS."""
    return np.array([normal_reflectance(*index(metal, float(nm))) for nm in COLOURS])


def _rest_enters(means: Means) -> Evidence:
    c = np.linspace(0.01, 1.0, 200)
    lost = 0.0
    for n in (WATER, GLASS, DIAMOND):
        inside = np.sqrt(n * n - 1.0 + c * c)
        across, along = 2.0 * c / (c + inside), 2.0 * n * c / (n * n * c + inside)
        entering = inside / c * 0.5 * (across**2 + along**2)
        lost = max(lost, float(np.max(np.abs(fresnel(n, c) + entering - 1.0))))
    glass = float(fresnel(GLASS, np.array([0.5]))[0])
    return ruled(
        lost < 1e-12,
        f"reflected and refracted light add up to 1, to {lost:.1g}, for water, glass, diamond at 200 angles",
        "Fresnel's amplitudes of the refracted light",
        f"reflected by glass at 60°: {glass:.6f}, by the library {dielectric(GLASS, 0.5):.6f}",
    )


def _depends_on_theta_d(means: Means) -> Evidence:
    wi, wo = directions(PAIRS, means.seed), directions(PAIRS + 1, means.seed)[1:]
    theta_h, theta_d, _ = angles_of(wi, wo).T
    ratio = values(subject_of("microfacet", F="dielectric"), wi, wo) / values(subject_of("microfacet"), wi, wo)
    of_d, of_h = (float(np.max(np.abs(ratio / fresnel(GLASS, np.cos(t)) - 1.0))) for t in (theta_d, theta_h))
    h = wi + wo
    offset = np.arccos(np.clip(np.sum(h * wi, axis=1) / np.linalg.norm(h, axis=1), -1.0, 1.0))
    apart = float(np.max(np.abs(offset - theta_d)))
    return ruled(
        apart < 1e-7 and of_d < 1e-6 < of_h,
        f"the light is θd from the facet's normal h, to {apart:.1g} rad",
        f"scalar products of {PAIRS} pairs",
        f"eq. 4 with F over eq. 4 without is F(θd), to {of_d:.1g}; F(θh) is up to {of_h:.2g} of it off",
    )


def _flat(means: Means) -> Evidence:
    c = np.cos(np.radians(np.linspace(0.0, 60.0, 601)))
    change = {name: float(np.max(np.abs(fresnel(n, c) - fresnel(n, np.ones(1))))) for name, n in media().items()}
    ends = {name: float(by_library(n, np.array([0.5]))[0]) for name, n in media().items()}
    return ruled(
        max(change.values()) < 0.1,
        "largest change of F from 0 to 60°: " + ", ".join(f"{value:.2g} {name}" for name, value in change.items()),
        "evaluation with complex indices",
        "F(60°) by the library: "
        + ", ".join(f"{value:.3f}" for value in ends.values())
        + ". Against itself glass more than doubles",
    )


def _total(means: Means) -> Evidence:
    c = np.array([1e-3, 1e-6, 1e-9])
    left = {name: 1.0 - fresnel(n, c) for name, n in media().items()}
    slopes = {name: float(math.log10(x[1] / x[2]) / 3.0) for name, x in left.items()}
    library = max(float(1.0 - by_library(n, c[2:])[0]) for n in media().values())
    return ruled(
        all(x[2] < 1e-6 for x in left.values()),
        f"1 − F at cos θ = 1e-3, 1e-6, 1e-9 is at most {', '.join(f'{max(x[i] for x in left.values()):.1e}' for i in range(3))}",
        "evaluation with complex indices",
        f"1 − F goes like cos^s, s = {min(slopes.values()):.3f} to {max(slopes.values()):.3f}; by the library at most "
        f"{library:.1e} at 1e-9",
    )


def _colour_in_unit_range(means: Means) -> Evidence:
    fine = {metal: normal_spectrum(metal) @ srgb_weights(COLOURS) for metal in METALS}
    eight = np.linspace(400.0, 750.0, 8)
    coarse = {
        metal: np.array([normal_reflectance(*index(metal, float(nm))) for nm in eight]) @ srgb_weights(eight) for metal in METALS
    }
    wrong = [metal for metal, rgb in fine.items() if not 0.0 <= rgb.min() <= rgb.max() <= 1.0]
    return ruled(
        not wrong,
        "F0 in linear sRGB: " + "; ".join(f"{metal} {', '.join(f'{x:.3f}' for x in rgb)}" for metal, rgb in fine.items()),
        f"spectra at {len(COLOURS)} wavelengths, daylight (D65)",
        "from eight wavelengths: " + "; ".join(f"{metal} {', '.join(f'{x:.2f}' for x in rgb)}" for metal, rgb in coarse.items()),
        f"{' and '.join(wrong)}: too saturated for sRGB.",
    )


def _metals_coloured(means: Means) -> Evidence:
    spread = {metal: float(np.ptp(normal_spectrum(metal))) for metal in METALS}
    told = ", ".join(f"{value:.2f} {metal}" for metal, value in spread.items())
    return Evidence(
        Verdict(Kind.UNDECIDED, None),
        f"range of F0 over {SHORTEST:g} to {LONGEST:g} nm: {told}",
        "measured indices",
        "—",
        "How often is “usually”? Gold and copper are coloured, silver and aluminium nearly grey. No dispersion of a dielectric "
        "is printed, and brass has none here.",
    )


def _smooth_below_half(means: Means) -> Evidence:
    F0 = {metal: normal_reflectance(*index(metal, YELLOW)) for metal in METALS}
    complex_way = {metal: float(fresnel(complex(*index(metal, YELLOW)), np.ones(1))[0]) for metal in METALS}
    half = math.sqrt(0.5)
    needed = (1.0 + half) / (1.0 - half)
    return ruled(
        max(F0.values()) < 0.5,
        "F0 at 550 nm: " + ", ".join(f"{value:.3f} {metal}" for metal, value in F0.items()),
        "measured indices",
        f"by complex amplitudes {', '.join(f'{x:.3f}' for x in complex_way.values())}; a dielectric needs an index above "
        f"{needed:.3f} for F0 > 0.5",
        "F0 is a property of the index, not of roughness. The page counts metals among its smooth materials and fabrics among "
        "its rough ones: of polished metals all four have F0 > 0.5, and no fabric has an index of 5.8.",
    )


def _complex_for_polarity(means: Means) -> Evidence:
    c = np.cos(np.radians(np.linspace(0.0, 89.0, 90)))
    s, p = polarised(GLASS, c)
    imaginary = float(np.max(np.abs(np.sqrt(GLASS**2 - 1.0 + c * c + 0j).imag)))
    apart = float(np.max(np.abs(0.5 * (s + p) - by_library(GLASS, c))))
    polarity = float(np.max(np.abs(s - p)))
    return ruled(
        imaginary > 0.0,
        f"glass: both polarisations differ by up to {polarity:.3f}, and every quantity is real",
        "Fresnel's amplitudes",
        f"the library's real formula agrees to {apart:.1g}",
        "Complex numbers account for absorption (the k of a metal's index). Both polarisations come out of real formulas "
        "wherever k = 0.",
    )


def _schlick_ends(means: Means) -> Evidence:
    ends, stray, told = 0.0, 0.0, []
    c = np.linspace(0.0, 1.0, 100_001)
    for name, n in media().items():
        exact = fresnel(n, c)
        F0 = float(exact[-1])
        error = schlick(F0, c) - exact
        ends = max(ends, abs(float(error[0])), abs(float(error[-1])))
        where, largest = extremum(lambda x, n=n, F0=F0: np.abs(schlick(F0, x) - fresnel(n, x)), 0.0, 1.0, 10_001)  # type: ignore[misc]
        stray = max(stray, largest)
        told.append(f"{largest:.3f} {name} ({math.degrees(math.acos(where)):.0f}°)")
    apart = max(abs(schlick_of_library(0.04, float(x)) - float(schlick(0.04, np.array([x]))[0])) for x in c[::10_000])
    return ruled(
        ends < 1e-12,
        f"exact at 0 and 90°, to {ends:.1g}; in between at most {', '.join(told)} off",
        "search over the angle",
        f"the library's eq. 5 is the same to {apart:.1g}",
    )


def _increases(means: Means) -> Evidence:
    c = np.cos(np.radians(np.linspace(0.0, 90.0, 9001)))
    dips = {}
    for name, n in media().items():
        F = fresnel(n, c)
        dips[name] = (float(F[0] - F.min()), float(np.degrees(np.arccos(c[int(np.argmin(F))]))))
    falling = {name: dip for name, dip in dips.items() if dip[0] > 1e-9}
    edge = 2.0 + math.sqrt(3.0)
    around = [float(np.min(fresnel(n, c)) - fresnel(n, np.ones(1))[0]) for n in (edge - 0.05, edge + 0.05)]
    eq5 = bool(np.all(np.diff(schlick(0.04, c)) >= 0.0))
    rises = min(float(fresnel(n, np.cos(np.radians([89.0])))[0] - fresnel(n, np.ones(1))[0]) for n in media().values())
    return ruled(
        rises > 0.0,
        f"F(89°) − F0 is at least {rises:.3f}; on the way F falls below F0 by "
        + ", ".join(f"{depth:.3f} at {where:.0f}° {name}" for name, (depth, where) in falling.items()),
        "evaluation with complex indices",
        f"of real indices those above 2 + √3 dip: lowest F − F0 is {around[0]:.1g} at n = {edge - 0.05:.2f}, {around[1]:.1g} at "
        f"{edge + 0.05:.2f}; eq. 5 {'never falls' if eq5 else 'falls'}",
        "Light in the plane of incidence is reflected least near the Brewster angle; where the index is large the mean of both "
        "polarisations falls with it.",
    )


def _smooth_at_grazing(means: Means) -> Evidence:
    found = {F0: 1.0 - float(schlick(F0, np.array([1e-9]))[0]) for F0 in (0.02, 0.04, 0.5, 0.9)}
    exact = max(1.0 - float(fresnel(n, np.array([1e-9]))[0]) for n in media().values())
    return ruled(
        max(found.values()) < 1e-6,
        f"1 − F at cos θd = 1e-9 is at most {max(found.values()):.1g} by eq. 5, F0 = 0.02 to 0.9",
        "evaluation in double precision",
        f"and at most {exact:.1g} by Fresnel's formulas for water to aluminium",
    )


def _rough_at_grazing(means: Means) -> Evidence:
    seen = [law(subject_of("microfacet", F="dielectric", alpha=alpha), "wi") for alpha in (0.1, 0.3, 0.6)]
    sampled = albedo_of("microfacet", 89.99, F="dielectric", alpha=0.3)(Means(1e-4, "rqmc", means.seed, means.threads))
    return ruled(
        all(x.behaviour == "bounded" and x.limit + x.limit_error < 1.0 for x in seen),
        "; ".join(grazing_words(x).split(";")[0] for x in seen) + " for α = 0.1, 0.3, 0.6 (GGX, Smith, n = 1.5)",
        "quadrature",
        f"α = 0.3 at 89.99°: {with_error(sampled, 1e-4)} (rqmc)",
    )


STATEMENTS = (
    Statement(
        "rest_enters",
        FRESNEL,
        "the rest of the incoming light entering the surface",
        "Does what is reflected and what is refracted add up to 1?",
        _rest_enters,
    ),
    Statement(
        "theta_d",
        FRESNEL,
        "F(θd) depends on θd and not θh …: the view/light direction is offset from the facet's direction. This offset is … θd",
        "Is θd the angle between the light and the facet's normal, and is F in eq. 4 a function of it?",
        _depends_on_theta_d,
        ("microfacet",),
    ),
    Statement(
        "flat_to_60",
        FRESNEL,
        "The Fresnel reflectance curves don't change much over most of the range, say from 0° … to ~60°",
        "Does F change by less than a tenth of its scale, 0 to 1? Water, glass, diamond, gold, silver, copper, aluminium.",
        _flat,
    ),
    Statement(
        "total_at_90",
        FRESNEL,
        "then the reflectance jumps to 1 (i.e. total reflection) at 90°",
        "Is the limit of F 1, for the same seven materials?",
        _total,
    ),
    Statement(
        "f0_colour",
        FRESNEL,
        "it can be represented by a RGB color in [0,1]",
        "Is F0 of gold, silver, copper and aluminium within [0, 1] in sRGB?",
        unclaimed(
            _colour_in_unit_range,
            "F0 is in [0, 1] at every wavelength, and as a colour of three of the four metals. Gold is too saturated for sRGB; a "
            "wider space holds it, and the page names none.",
        ),
        ("metal",),
    ),
    Statement(
        "metals_coloured",
        FRESNEL,
        "Metals usually have a colored specular reflection while dielectric materials … have a uniform specular",
        "How much does F0 change over the visible wavelengths?",
        _metals_coloured,
        ("metal",),
    ),
    Statement(
        "smooth_below_half",
        FRESNEL,
        "smooth materials generally have a Fresnel reflectance F0 < 0.5 while rough materials have a F0 > 0.5",
        "Have smooth metals F0 < 0.5?",
        _smooth_below_half,
        ("metal",),
    ),
    Statement(
        "complex_for_polarity",
        FRESNEL,
        "The expressions … deal with complex numbers to account for light polarity",
        "Do both polarisations of light at a dielectric need complex numbers?",
        _complex_for_polarity,
    ),
    Statement(
        "equation_5",
        "eq. 5",
        "F(θd) = F0 + (1 − F0)(1 − cos θd)^5",
        "Is it exact at both ends, and how far is it from Fresnel's reflectance in between?",
        _schlick_ends,
        ("microfacet",),
    ),
    Statement(
        "increases",
        "after eq. 5",
        "The Fresnel reflection represents the increase in specular reflection as the light and view vectors move apart",
        "Is F far from normal incidence, at 89°, larger than F0? For the same seven materials.",
        _increases,
        ("metal",),
    ),
    Statement(
        "smooth_at_grazing",
        "after eq. 5",
        "predicts that all smooth surfaces will approach 100% specular reflection at grazing incidence",
        "Is the limit of eq. 5 1 for every F0?",
        _smooth_at_grazing,
    ),
    Statement(
        "rough_at_grazing",
        "after eq. 5",
        "This is purely theoretical though, because in reality many materials are not perfectly smooth",
        "Does the albedo of a rough dielectric stay below 1 at grazing incidence, by eq. 4?",
        _rough_at_grazing,
        ("microfacet",),
    ),
    Statement(
        "measured_at_grazing",
        "after eq. 5",
        "… don't reflect light exactly as predicted by the Fresnel function, as we can see in the figure below",
        "Do the 100 materials of the database reflect otherwise than by Fresnel's formula at grazing incidence?",
        undecided("The figure and the measurements are not in the text."),
        ("merl",),
    ),
)
