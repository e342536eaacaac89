"""Statements about the models of eq. 5 to 8, and of section 4 on what is unsatisfactory about them."""

from __future__ import annotations

import math
from collections.abc import Callable
from math import pi

import numpy as np
from scipy.integrate import quad
from scipy.special import erfc, exp1

from albedo_lab.optics import fresnel
from albedo_lab.papers.recipes import Means, albedo_of
from albedo_lab.papers.record import Statement
from albedo_lab.papers.schlick1993.formulas import (
    Array,
    albedo,
    at,
    beckmann,
    directions,
    exact_fresnel,
    halves,
    smith,
    ward_slope,
)
from albedo_lab.papers.schlick1993.tried import EQUATIONS, MANY, over, row
from albedo_lab.papers.trials import CLOSED, Found, checked, extremum, subject_of, trial, undecided

SLOPES = (0.1, 0.3, 0.5)
"""The m that are tried: eq. 8 has m in [0, 0.5]."""

VARNISH = 1.5


def reflected_about_H(means: Means) -> Found:
    """V mirrored at the facet whose normal is H, and at facets beside it."""
    V, V_ = directions(means.seed, MANY), directions(means.seed + 1, MANY)
    H = halves(V, V_)
    miss = float(np.max(np.linalg.norm(2.0 * np.sum(V * H, axis=-1, keepdims=True) * H - V - V_, axis=-1)))
    beside = H + 1e-3 * directions(means.seed + 2, MANY)
    beside /= np.linalg.norm(beside, axis=-1, keepdims=True)
    away = float(np.min(np.linalg.norm(2.0 * np.sum(V * beside, axis=-1, keepdims=True) * beside - V - V_, axis=-1)))
    again = f"at other facets by {away:.1g} or more"
    return Found(miss < 1e-12 < away, f"V mirrored at H misses V′ by {miss:.1g}", "10 000 pairs", again)


def four_cosines(means: Means) -> Found:
    """t from the other three."""
    V, V_ = directions(means.seed, MANY), directions(means.seed + 1, MANY)
    H = halves(V, V_)
    t, u = H[:, 2], np.sum(V * H, axis=-1)
    apart = float(np.max(np.abs(t - (V[:, 2] + V_[:, 2]) / (2.0 * u))))
    c = at(0.3, 0.0, np.linspace(0.01, 1.0, MANY), np.linspace(0.0, pi, MANY))
    again = float(np.max(np.abs(c.t - (c.v + c.v_) / (2.0 * c.u))))
    ours = f"four, three of them free: t = (v + v′)/(2u) within {apart:.1g}"
    return Found(apart < 1e-12, ours, "10 000 pairs", f"within {again:.1g} on a grid")


def integrated(f: Callable[[Array], Array]) -> float:
    """Over t in [0, 1]; a Gaussian of the slope leaves nothing below 1e-3."""
    return float(quad(lambda t: float(f(np.array(t))), 1e-3, 1.0, epsrel=1e-10, limit=200)[0])


def beckmann_normalised(means: Means) -> Found:
    """2 t D over [0, 1], and in the slope's square x: exp(-x/m^2) / m^2."""
    ours = over(SLOPES, lambda m: integrated(lambda t: 2.0 * t * beckmann(m, t)))
    again = over(SLOPES, lambda m: quad(lambda x: math.exp(-x / m**2) / m**2, 0.0, 60.0 * m**2)[0])
    condition = all(abs(a - 1.0) < 1e-8 for _, a in ours + again)
    return Found(condition, f"∫2tD dt = {row('m =', ours)}", "adaptive Gauss-Kronrod", f"{row('m =', again)} (in the slopes)")


def beckmann_rms(means: Means) -> Found:
    """The root of the mean squared slope of eq. 6, over m; and the same of normals that are drawn."""
    ours = over(SLOPES, lambda m: math.sqrt(integrated(lambda t: 2.0 * (1.0 - t * t) / t * beckmann(m, t))) / m)
    drawn = np.random.default_rng(means.seed).exponential(1.0, 1_000_000)
    condition = all(abs(a - 1.0) < 1e-8 for _, a in ours)
    again = f"{math.sqrt(drawn.mean()):.3f} (10⁶ slopes)"
    return Found(condition, f"RMS slope / m = {row('m =', ours)}", "adaptive Gauss-Kronrod", again)


def smith_in_range(means: Means) -> Found:
    """Eq. 7 over all cosines: between 0 and 1, and growing."""
    v = np.linspace(1e-6, 1.0, 100_001)
    g = np.stack([smith(m, v) for m in SLOPES])
    condition = bool(g.min() >= 0.0 and g.max() <= 1.0 and np.diff(g).min() > -1e-12)
    right = np.stack([smith(m, v, remainder=True) for m in SLOPES])
    ours = f"from {g.min():.1g} to {g.max():.6f}"
    again = f"{right.min():.1g} to {right.max():.6f} with Smith's own"
    return Found(condition, ours, "100 001 cosines, m = 0.1, 0.3, 0.5", again)


def gap_of_smith(x: Array) -> Array:
    """g/(g + exp(-h)) - g/(g + 1), of the root of h."""
    g = math.sqrt(pi) * x * (2.0 - erfc(x))
    return np.asarray(g / (g + np.exp(-(x**2))) - g / (g + 1.0))


def smith_as_printed(means: Means) -> Found:
    """The largest difference; Smith's own from the definition of his factor, by integrating the slopes in the plane."""
    x, gap = extremum(gap_of_smith, 1e-3, 6.0)
    # Smith 1967: the share of slopes below cot, over 1 + Lambda, Lambda = mean of (slope - cot)^+ / cot; sigma = 1
    cot = x * math.sqrt(2.0)

    def density(q: float) -> float:
        return math.exp(-0.5 * q * q) / math.sqrt(2.0 * pi)

    Lambda = quad(lambda q: (q - cot) / cot * density(q), cot, cot + 12.0, epsabs=1e-14)[0]
    below = quad(density, -12.0, cot, epsabs=1e-14)[0]
    g = math.sqrt(pi) * x * (2.0 - float(erfc(x)))
    printed = g / (g + 1.0)
    ours = f"{printed:.6f} for Smith's {printed + gap:.6f} at h = {x * x:.4f}: {gap:.6f} less"
    return Found(gap < 1e-6, ours, "both equations", f"{below / (1.0 + Lambda):.6f} (his integrals over slopes)")


def facing(m: float, v: float) -> float:
    """The area, seen from the cosine v, of those facets of eq. 6 that face the viewer, per unit of the surface.

    That is D (V.H)^+ / pi over all normals; over their azimuth in closed form, with V.H = a + b cos.
    """
    s = math.sqrt(1.0 - v * v)

    def over_azimuth(x: float) -> float:
        t = 1.0 / math.hypot(1.0, x)
        a, b = v * t, s * t * x
        half = math.acos(max(-a / b, -1.0)) if b > 0.0 else pi
        return float(beckmann(m, np.array(t))) / pi * 2.0 * (a * half + b * math.sin(half)) * t**3 * x

    return float(quad(over_azimuth, 0.0, 8.0 * m, points=[v / s], epsrel=1e-10, limit=200)[0])


def smith_of_the_same_m(means: Means) -> Found:
    """The share seen, v over the projected area of the facets that face the viewer, against eq. 7 corrected but for its m."""
    m, v = 0.3, 0.2
    s = math.sqrt(1.0 - v * v)
    seen = v / facing(m, v)
    roots = (v / s / m, v / s / m / math.sqrt(2.0))
    shares = [1.0 / (1.0 + 0.5 * (math.exp(-x * x) / (x * math.sqrt(pi)) - math.erfc(x))) for x in roots]
    drawn = np.random.default_rng(means.seed).normal(0.0, m / math.sqrt(2.0), 1_000_000)
    again = f"{v / np.maximum(v + s * drawn, 0.0).mean():.3f} (10⁶ slopes)"
    ours = f"seen {seen:.6f}; h with m² gives {shares[0]:.6f}, with the printed 2m² {shares[1]:.6f} (m = 0.3, v = 0.2)"
    return Found(abs(seen - shares[1]) < 1e-6, ours, "projected area of the facets", again)


def coherent_term(means: Means) -> Found:
    """The reflectance of the Dirac part at normal incidence of a surface that is nearly smooth."""
    mirror = {}
    for name, words in (("he_torrance", {"sigma0": 0.1, "tau": 1.7, "wavelength": 0.5}), ("cook_torrance", {})):
        of = subject_of(name, **words)
        mirror[name] = of.model.mirror(of.p, 1.0) * of.scale.value
    again = math.exp(-((4.0 * pi * 0.1 / 0.5) ** 2))
    ours = f"share of the mirror term: He {mirror['he_torrance']:.4g}, Cook-Torrance {mirror['cook_torrance']:g}"
    told_again = f"exp(-(4πσ/λ)²) = {again:.3g}, before F and shadows"
    return Found(mirror["he_torrance"] > 0.0 == mirror["cook_torrance"], ours, "models at 0°", told_again)


def ellipses(means: Means) -> Found:
    """D of eq. 8 along an ellipse of slopes, and its axes."""
    m, n = 0.4, 0.1
    turn = np.linspace(0.0, 2.0 * pi, MANY)
    x, y = m * np.cos(turn), n * np.sin(turn)
    t, w = 1.0 / np.sqrt(1.0 + x * x + y * y), x / np.hypot(x, y)
    D = ward_slope(m, n, t, w)
    apart = float(np.ptp(D) / D[0])
    again = f"= exp(-1)/(mn) within {abs(float(D[0]) * m * n * math.e - 1.0):.1g}"
    return Found(apart < 1e-9, f"D on the ellipse of slopes with axes m, n varies by {apart:.1g}", EQUATIONS, again)


def ward_fraction(means: Means) -> Found:
    """2 t D of eq. 8 with m = n; in closed form b (1 - b exp(b) E1(b)) with b = 1/m^2."""
    ours = over(SLOPES, lambda m: integrated(lambda t: 2.0 * t * ward_slope(m, m, t, 0.0 * t)))
    again = [(m, (1.0 - math.exp(m**-2) * float(exp1(m**-2)) / m**2) / m**2) for m in SLOPES]
    condition = all(abs(a - 1.0) < 1e-6 for _, a in ours)
    return Found(condition, f"∫2tD dt = {row('m =', ours)}", "adaptive Gauss-Kronrod", f"{row('m =', again)} ({CLOSED})")


def ward_rms(means: Means) -> Found:
    """The RMS of the slope along x, over m, of the Gaussian; and with the weight t^4 that eq. 8 leaves to the facets' area."""
    m, n = 0.5, 0.25
    x, weight = np.polynomial.hermite.hermgauss(60)
    w = weight[:, None] * weight[None, :]
    slope, t4 = (m * x[:, None]) ** 2, (1.0 + (m * x[:, None]) ** 2 + (n * x[None, :]) ** 2) ** -2
    gauss = math.sqrt(float((w * slope).sum() / w.sum())) / m
    facets = math.sqrt(float((w * t4 * slope).sum() / (w * t4).sum())) / m
    drawn = np.random.default_rng(means.seed).normal(0.0, math.sqrt(0.5), 1_000_000)
    ours = f"RMS slope along x / m = {gauss:.6f}; {facets:.4f} with D as printed (m = 0.5, n = 0.25)"
    return Found(abs(gauss - 1.0) < 1e-6, ours, "Gauss-Hermite", f"{math.sqrt(float(np.mean(drawn**2))):.3f} (10⁶ slopes)")


def specular_share_changes(means: Means) -> Found:
    """What a varnish reflects at several angles."""
    angles = (0.0, 60.0, 80.0, 89.0)
    ours = [(a, float(exact_fresnel(VARNISH, np.cos(np.radians([a])))[0])) for a in angles]
    again = [(a, fresnel.dielectric(VARNISH, math.cos(math.radians(a)))) for a in angles]
    condition = ours[-1][1] > 2.0 * ours[0][1]
    shares = f"share reflected by the varnish {row('θ =', ours, 4)}°"
    return Found(condition, shares, "Fresnel, n = 1.5", f"{row('θ =', again, 4)}°")


def varnished_floor(means: Means) -> Found:
    """Where a varnish begins to reflect more than half, and what it lets in at normal incidence."""
    angle = np.linspace(0.0, 89.99, 900_000)
    F = exact_fresnel(VARNISH, np.cos(np.radians(angle)))
    half = float(angle[np.argmax(F > 0.5)])
    below, above = (fresnel.dielectric(VARNISH, math.cos(math.radians(half + d))) for d in (-0.001, 0.001))
    ours = f"more than half beyond {half:.3f}°; at 0° {1.0 - float(F[0]):.2%} penetrate (n = 1.5)"
    return Found(F[-1] > 0.5 > F[0], ours, "Fresnel on a grid", f"{below:.5f} and {above:.5f} beside it (module fresnel)")


def lost_by_G(means: Means) -> Found:
    """What Cook and Torrance's model of facets that absorb nothing sends back of light at 60 degrees."""
    shares = [(m, albedo_of("cook_torrance", 60.0, geometry="smith", m=m)(means).value) for m in SLOPES]

    def rough(m: float) -> float:
        def G(v: Array) -> Array:
            x = v / np.sqrt(np.maximum((1.0 - v) * (1.0 + v), 1e-300)) / m
            return np.asarray(1.0 / (1.0 + 0.5 * (np.exp(-x * x) / np.maximum(x * math.sqrt(pi), 1e-300) - erfc(x))))

        return albedo(lambda c: beckmann(m, c.t) * G(c.v) * G(c.v_) / (4.0 * pi * c.v * c.v_), 0.5).value

    again = [(m, rough(m)) for m in SLOPES]
    ours = f"a(60°) = {row('m =', shares, 5)} although F = 1"
    return Found(shares[-1][1] < 0.95, ours, "model, quadrature", f"{row('m =', again, 5)} (plain integration)")


def precision(means: Means) -> Found:
    """Errors of 5, 15 and 0.1 % together: independent, and all at their worst."""
    squared = math.hypot(5.0, 15.0, 0.1) - math.hypot(5.0, 15.0)
    worst = 0.1 / 20.0
    ours = f"0.1 % raises √(5² + 15²) = {math.hypot(5.0, 15.0):.4f} % by {squared:.1g} %"
    return Found(squared < 0.01, ours, "errors in quadrature", f"by {worst:.1%} of the sum, were they all at their worst")


EARLIER = (
    Statement(
        "eq_5_facets",
        "§3.1, before eq. 5",
        "Only microfacets whose normal vector is in the direction H … contribute to the reflection between V and V′",
        "V mirrored at a facet is V′ where the facet's normal is H, and nowhere else",
        trial(reflected_about_H),
    ),
    Statement(
        "eq_5_four_cosines",
        "§3.1, before eq. 5",
        "it depends here on the cosine of four different angles",
        "t, u, v, v′ are four cosines; three of them give the fourth",
        trial(four_cosines),
    ),
    Statement(
        "eq_6_normalised",
        "eq. 5, 6",
        "D(t) … defines the fraction of the facets that are oriented in the direction H",
        "D t / π is a density of normals: ∫2tD dt = 1, as eq. 5 with its 1/(4πvv′) needs",
        trial(beckmann_normalised),
        ("cook_torrance",),
    ),
    Statement(
        "eq_6_rms",
        "after eq. 6",
        "m is the RMS slope of the microfacets",
        "the mean of tan²α over the facets of eq. 6 is m²",
        trial(beckmann_rms),
        ("cook_torrance",),
    ),
    Statement(
        "eq_7_range",
        "after eq. 5",
        "G(v,v′) ∈ [0,1]",
        "eq. 7 lies in [0, 1] and grows with v",
        trial(smith_in_range),
        ("cook_torrance",),
    ),
    Statement(
        "eq_7_smith",
        "eq. 7",
        "G(v) = g/(g+1) … by Equation 7 [SMIT67]",
        "eq. 7 is Smith's shadowing function of a Gaussian surface",
        trial(smith_as_printed, "Smith's is g/(g + exp(-h)); as printed up to 0.14 of the light is lost besides."),
        ("cook_torrance",),
    ),
    Statement(
        "eq_7_slope",
        "eq. 7",
        "h = v²/(2m²(1-v²)) … where m is the RMS slope of the microfacets",
        "the m of eq. 6 and that of eq. 7 are the same: h hides as many facets as D of eq. 6 needs",
        trial(
            smith_of_the_same_m,
            "Eq. 7 counts slopes in the plane of incidence, whose RMS is m/√2 for the m of eq. 6; with that, h = v²/(m²(1-v²)).",
        ),
        ("cook_torrance",),
    ),
    Statement(
        "he_coherent",
        "§3.1, last paragraph",
        "The model has quite a similar expression as the Cook-Torrance model; the main differences are the addition of a "
        "coherent "
        "reflection term …",
        "He's model has a mirror term, Cook and Torrance's has none",
        trial(coherent_term),
        ("he_torrance", "cook_torrance"),
    ),
    Statement(
        "he_phenomena",
        "§3.1, last paragraph",
        "accounts for even more physical phenomena (polarization, diffraction, interference)",
        "as printed",
        undecided("He's equations are not in the document; polarisation enters them only for polarised light."),
        ("he_torrance",),
    ),
    Statement(
        "ward_ellipse",
        "§3.2, before eq. 8",
        "express the degree of anisotropy by an ellipsis of varying excentricity",
        "D of eq. 8 is constant on ellipses of slopes with axes as m to n",
        trial(ellipses),
        ("ward",),
    ),
    Statement(
        "eq_8_fraction",
        "eq. 8",
        "D(t,w) ∈ [0,∞[ has the same meaning as in Equation 5",
        "D of eq. 8 with m = n meets ∫2tD dt = 1, as that of eq. 6 does",
        trial(
            ward_fraction,
            "The 1/t⁴ of eq. 6 is missing: 30 % of the facets are lost at m = 0.5.",
        ),
        ("ward",),
    ),
    Statement(
        "eq_8_rms",
        "after eq. 8",
        "m (resp. n) is the RMS slope of the surface in the x (resp. y) direction",
        "the RMS of the slope along x is m",
        trial(ward_rms, "exp(-x²/m²) has the variance m²/2: the RMS slope along x is m/√2."),
        ("ward",),
    ),
    Statement(
        "constant_weights",
        "§4",
        "such a linear combination with constant weights is incorrect because proportions … are … function of the incident angle",
        "the share that a varnish (n = 1.5) reflects changes with the angle, by more than a factor of 2",
        trial(specular_share_changes),
        ("plastic",),
    ),
    Statement(
        "varnished_floor",
        "§4",
        "for large incident angles most light is reflected specularly by the varnish, whereas for small incident angles, most "
        "light "
        "penetrates the varnish",
        "there is an angle beyond which more than half is reflected, and at normal incidence less than half is (n = 1.5)",
        trial(varnished_floor),
        ("plastic",),
    ),
    Statement(
        "homogeneous_continuum",
        "§4",
        "For such materials (metals, for instance) there rather exists a kind of continuum between perfect diffuse and "
        "perfect specular "
        "behaviours",
        "as printed",
        undecided("A statement about real surfaces: it takes measurements of metals of many roughnesses."),
    ),
    Statement(
        "no_reemission",
        "§4, figure 5",
        "the remainder of the light (ie 1-G) is reflected in other directions and not simply blocked. Currently, none of the "
        "existing "
        "reflectance models does correctly account for that",
        "Cook and Torrance's model (Smith's G, F = 1) loses light: less than 95 % come back at m = 0.5, 60°",
        trial(lost_by_G),
        ("cook_torrance",),
    ),
    Statement(
        "theoretical_accurate",
        "§4",
        "complete theoretical models [KAJI85] [HE91] are physically accurate",
        "as printed",
        undecided("It takes measured surfaces to compare with, which the document does not give."),
        ("he_torrance",),
    ),
    Statement(
        "precision",
        "§4",
        "there is no need to compute BDRFs at a precision of 0.1%, if global illumination is only done at 5% and spectral "
        "sampling at 15%",
        "an error of 0.1 % beside independent ones of 5 % and 15 % adds less than 0.01 %",
        trial(precision),
    ),
    Statement(
        "ward_reciprocity",
        "§4",
        "[Ward's model] not searching for theoretical justification — except the Helmholtz Reciprocity Rule (Equation 2) …",
        "eq. 8 is symmetric (m = 0.2, n = 0.1)",
        checked("reciprocity", "PASS", "ward", m_x=0.2, m_y=0.1),
        ("ward",),
    ),
    Statement(
        "ward_energy",
        "§4",
        "… and the Energy Conservation Law (Equation 3)",
        "eq. 8 keeps its albedo at or below 1 (m = 0.2, n = 0.1, d = 0, s = 1)",
        checked("energy", "PASS", "ward", why="The albedo of eq. 8 grows like 1/√v towards grazing incidence.", m_x=0.2, m_y=0.1),
        ("ward",),
    ),
)
