"""Statements of sections 5.1, 5.2 and 6: what C, r and p are, the two layers of eq. 9, and the two figures of pictures."""

from __future__ import annotations

import math
from collections.abc import Callable
from itertools import pairwise
from math import pi

import numpy as np
from scipy.integrate import quad
from scipy.special import ellipk

from albedo_lab.optics.schlick1993 import mean_of_A
from albedo_lab.papers.recipes import Means, albedo_of
from albedo_lab.papers.record import Statement
from albedo_lab.papers.schlick1993.formulas import (
    DIRECTIONAL,
    A,
    Array,
    Cosines,
    S,
    Z,
    albedo,
    eq15,
    eq17,
    pairs,
    quarter_turn,
)
from albedo_lab.papers.schlick1993.tried import EQUATIONS, MANY, over, row, spread, told
from albedo_lab.papers.trials import CLOSED, Found, measured, trial, undecided

FIGURE_7 = (1.0, 0.5, 0.2, 0.05)
"""The r of its four pictures."""
FIGURE_8 = (1.0, 0.5, 0.2, 0.05)
"""The p of its four pictures."""


def normal_reflectance(means: Means) -> Found:
    """a(0) of the four formulations, C = 1, r = 0.2; eq. 12 in closed form: 1/(1+r)."""
    ours = [(int(name[2:]), albedo_of("schlick", 0.0, directional=name, r=0.2)(means).value) for name in DIRECTIONAL]
    again = [(int(name[2:]), albedo(f(0.2), 1.0).value) for name, f in DIRECTIONAL.items()]
    condition = all(abs(a - 1.0) < 1e-6 for _, a in ours)
    told_again = f"{row('eq.', again)} (plain integration; eq. 12: 1/(1+r))"
    return Found(condition, f"a(0°)/C = {row('eq.', ours)}", "model, quadrature", told_again)


def rms_of_Z(means: Means) -> Found:
    """The mean of x = tan^2 over normals of Z with x up to a cut that grows: 2 t Z dt = r / (r + x)^2 dx."""
    r, cuts = 0.2, (1e2, 1e4, 1e6)

    def mean(cut: float) -> float:
        return float(quad(lambda y: r * math.exp(2.0 * y) / (r + math.exp(y)) ** 2, -40.0, math.log(cut), limit=200)[0])

    ours = over(cuts, mean)
    again = over(cuts, lambda cut: r * (math.log1p(cut / r) - cut / (r + cut)))
    words = f"mean tan² = {row('tan² up to', ours, 4)}: r ln 100 more each time, no end (r = 0.2)"
    condition = ours[2][1] - ours[1][1] < 1e-3
    return Found(condition, words, "adaptive Gauss-Kronrod", f"{row('tan² up to', again, 4)} ({CLOSED})")


def ratio_of_slopes(means: Means) -> Found:
    """The RMS of H's slope along the scratch over that across, slopes of one size; and A itself, along over across."""

    def ratio(p: float) -> float:
        along, across = quarter_turn(lambda w: A(p, w) * w**2), quarter_turn(lambda w: A(p, w) * (1.0 - w**2))
        return math.sqrt(along / across)

    chosen = (0.05, 0.2, 0.5)
    ours = over(chosen, ratio)
    again = over(chosen, lambda p: float(A(p, np.array(1.0)) / A(p, np.array(0.0))))
    condition = all(abs(x - p) < 1e-6 for p, x in ours)
    words = f"ratio of RMS slopes {row('p =', ours, 4)}"
    return Found(condition, words, "adaptive Gauss-Kronrod", f"A along over A across {row('p =', again, 4)}")


def mirror_at_last(means: Means) -> Found:
    """The share of the light of eq. 12 whose H is within a degree of N, at 60 degrees, as r falls; and the albedo."""

    def share(r: float) -> float:
        # normals: survival r / (r + tan^2)
        x = math.tan(math.radians(1.0)) ** 2
        return x / (r + x)

    few = (1e-2, 1e-4, 1e-6)
    ours = over(few, share)
    again = over(few, lambda r: albedo_of("schlick", 60.0, directional="eq12", r=r)(means).value)
    return Found(
        ours[-1][1] > 0.99, f"normals within 1°: {row('r =', ours, 4)}", CLOSED, f"a(60°) = {row('r =', again, 6)} (eq. 12)"
    )


def diffuse_at_last(name: str) -> Callable[[Means], Found]:
    """A finder: whether D of that equation is constant for r = 1, and what it reflects."""

    def find(means: Means) -> Found:
        f = DIRECTIONAL[name](1.0)
        ours, a = spread(f(pairs(means.seed))), albedo(f, 1.0)
        engine = albedo_of("schlick", 0.0, directional=name, r=1.0)(means)
        words = f"largest over smallest D = {ours:.4g} over {MANY} pairs; a(0°) = {told(a)}"
        return Found(ours < 1.0 + 1e-9, words, EQUATIONS, f"a(0°) = {told(engine)} (model)")

    return find


def isotropic_at_last(means: Means) -> Found:
    """A for p = 1."""
    w = np.linspace(0.0, 1.0, MANY)
    apart = float(np.max(np.abs(A(1.0, w) - 1.0)))
    return Found(
        apart < 1e-12, f"A is off 1 by {apart:.1g}", EQUATIONS, f"its mean {mean_of_A(1.0):g} (arithmetic-geometric mean)"
    )


def dirac_A(means: Means) -> Found:
    """The mean of A over the azimuth as p falls: a Dirac function would keep it."""
    few = (1e-1, 1e-3, 1e-5)
    ours = over(few, lambda p: quarter_turn(lambda w: A(p, w)))
    again = over(few, lambda p: 2.0 / pi * math.sqrt(p) * float(ellipk(1.0 - p * p)))
    condition = abs(ours[-1][1] - 1.0) < 1e-3
    return Found(
        condition, f"mean of A = {row('p =', ours, 4)}", "adaptive Gauss-Kronrod", f"{row('p =', again, 4)} ((2/π)√p K(1-p²))"
    )


def weights(means: Means) -> Found:
    """S and 1 - S of eq. 9 over all cosines."""
    u = np.linspace(0.0, 1.0, MANY)
    F = S(0.05, u)
    apart = float(np.max(np.abs(F + (1.0 - F) - 1.0)))
    condition = apart < 1e-12 and F.min() >= 0.0 and F.max() <= 1.0
    return Found(condition, f"sum 1 within {apart:.1g}, S from {F.min():.2f} to {F.max():.2f}", EQUATIONS, "S + (1 - S) = 1")


def varnish(means: Means) -> Found:
    """Eq. 9 with the layers of eq. 15, r = 0.2, and Lambert (eq. 17, r = 1): each conserves, what of both?"""
    C, upper, lower = 0.04, eq15(0.2), eq17(1.0)

    def both(c: Cosines) -> Array:
        return S(C, c.u) * upper(c) + (1.0 - S(C, c.u)) * lower(c)

    cosines = (1.0, 0.5, 0.1, 1e-9)
    ours = over(cosines, lambda v: albedo(both, v).value)
    smooth = over(cosines, lambda v: varnished(C, v))
    condition = max(a for _, a in ours) <= 1.0
    again = f"{row('v =', smooth, 5)} under a smooth varnish (mirror + Lambert)"
    return Found(condition, f"a = {row('v =', ours, 5)}; C = 0.04, r = 0.2 over r′ = 1", "plain integration", again)


def varnished(C: float, v: float) -> float:
    """The limit r = 0 of the upper layer: S(v) of the mirror, and Lambert's lower layer under 1 - S(u)."""
    return float(S(C, np.array(v))) + albedo(lambda c: (1.0 - S(C, c.u)) / pi, v).value


def single_in_double(means: Means) -> Found:
    """Eq. 9 where the upper layer reflects all (C = 1): the lower one does not count."""
    c = pairs(means.seed)
    F = S(1.0, c.u)
    apart = float(np.max(np.abs(F * eq15(0.2)(c) + (1.0 - F) * eq17(1.0)(c) - eq15(0.2)(c))))
    a = albedo_of("schlick", 60.0, directional="eq15", layers="double", spectral="fresnel", C=1.0, r=0.2)(means)
    b = albedo_of("schlick", 60.0, directional="eq15", r=0.2)(means)
    words = f"DOUBLE with C = 1 is SINGLE within {apart:.1g}"
    return Found(apart < 1e-12, words, EQUATIONS, f"a(60°) = {told(a)} and {told(b)} (models)")


def narrower(means: Means) -> Found:
    """The angle at which Z falls to half its height, 90 degrees where it does not: off a grid, and closed."""
    alpha = np.linspace(0.0, 0.5 * pi, 90_001)

    def seen(r: float) -> float:
        below = Z(r, np.cos(alpha)) < 0.5 / r
        return float(np.degrees(alpha[np.argmax(below)])) if below.any() else 90.0

    def angle(r: float) -> float:
        # there 1 - (1-r) t^2 = sqrt(2) r
        tt = (1.0 - math.sqrt(2.0) * r) / (1.0 - r) if r < math.sqrt(0.5) else 0.0
        return math.degrees(math.acos(math.sqrt(tt)))

    ours, again = over(FIGURE_7, seen), over(FIGURE_7, angle)
    condition = all(before > after for (_, before), (_, after) in pairwise(ours))
    return Found(
        condition, f"α at half of Z's height = {row('r =', ours, 4)}, in degrees", "grid", f"{row('r =', again, 4)} ({CLOSED})"
    )


def brushed(means: Means) -> Found:
    """How much A varies over the azimuth for the p of figure 8, from sqrt(p) along the scratch to 1/sqrt(p) across."""
    w = np.linspace(0.0, 1.0, MANY)
    ours = over(FIGURE_8, lambda p: spread(A(p, w)))
    again = over(FIGURE_8, lambda p: 1.0 / p)
    condition = all(before < after for (_, before), (_, after) in pairwise(ours))
    return Found(condition, f"A's largest over smallest = {row('p =', ours, 4)}", EQUATIONS, f"1/p = {row('p =', again, 4)}")


PARAMETERS = (
    Statement(
        "C_reflectivity",
        "§5.1",
        "C can be viewed as the reflectivity at normal incidence",
        "the albedo at normal incidence is C (C = 1, r = 0.2, each of eq. 12, 15, 17, 18)",
        measured(
            normal_reflectance,
            "“Can be viewed” leaves open of what: C is the reflectance of each facet; of the surface, part of the lobe falls "
            "below the horizon and G takes more: eq. 12 gives C/(1+r), C only for r = 0.",
        ),
        ("schlick",),
    ),
    Statement(
        "r_rms_slope",
        "§5.1",
        "r is related to the RMS slope of the surface",
        "the normals of Z have a finite RMS slope",
        trial(
            rms_of_Z, "Z falls so slowly that the mean of tan² is infinite for every r; half of the normals are steeper than √r."
        ),
        ("schlick",),
    ),
    Statement(
        "p_ratio",
        "§5.1",
        "p is the ratio of the RMS slopes between the scratch (φ = 0) and the ortho-scratch (φ = π/2) direction",
        "the RMS of tan α cos φ over that of tan α sin φ is p, with A of eq. 14 for the azimuth",
        trial(ratio_of_slopes, "p is the ratio of A along and across the scratch, not that of the slopes."),
        ("schlick",),
    ),
    Statement(
        "intuitive",
        "§5.1",
        "they can be understood intuitively and therefore easily defined by a non-physician user",
        "as printed",
        undecided("A matter of who uses it."),
        ("schlick",),
    ),
    Statement(
        "measurable",
        "§5.1",
        "they can also be assigned by experimental measurements [WYSZ67] [PALI85]",
        "as printed",
        undecided("No procedure is given; that C, r and p are not the quantities named is found by the statements on each."),
        ("schlick",),
    ),
    Statement(
        "r_0_specular",
        "§5.1; §5.4",
        "r = 0: perfect specular",
        "as r falls to 1e-6 all but 1 % of the normals of Z come within 1° of N",
        trial(mirror_at_last),
        ("schlick",),
    ),
    Statement(
        "r_1_diffuse_eq12",
        "§5.1, eq. 12",
        "r = 1: perfect diffuse",
        "D of eq. 12 is constant for r = 1, p = 1",
        measured(
            diffuse_at_last("eq12"),
            "At r = 1 it is 1/(4πvv′), not constant; the document says so itself before eq. 17, and does not say of which "
            "formulation §5.1 speaks.",
        ),
        ("schlick",),
    ),
    Statement(
        "r_1_diffuse_eq15",
        "§5.1, eq. 15",
        "r = 1: perfect diffuse",
        "D of eq. 15 is constant for r = 1, p = 1, although it sends back a quarter of the light only",
        trial(diffuse_at_last("eq15")),
        ("schlick",),
    ),
    Statement(
        "r_1_diffuse_eq17",
        "§5.1, eq. 17",
        "r = 1: perfect diffuse",
        "D of eq. 17 is constant for r = 1, p = 1",
        trial(diffuse_at_last("eq17")),
        ("schlick",),
    ),
    Statement(
        "r_1_diffuse_eq18",
        "§5.1, eq. 18",
        "r = 1: perfect diffuse",
        "D of eq. 18 is constant for r = 1, p = 1",
        trial(
            diffuse_at_last("eq18"),
            "Its diffuse part is (1 - vv′)/π at r = 1, on top of 1/(4π): brighter away from the normal, and above 1 at "
            "grazing incidence.",
        ),
        ("schlick",),
    ),
    Statement(
        "p_1_isotropic",
        "§5.1; §5.4",
        "constant function when p = 1 (perfect isotropy)",
        "A = 1 for p = 1",
        trial(isotropic_at_last),
        ("schlick",),
    ),
    Statement(
        "p_0_dirac",
        "§5.4, after eq. 14",
        "A(w) … a Dirac function when p = 0 (perfect anisotropy)",
        "as p falls, the mean of A over the azimuth tends to 1 while A narrows",
        trial(
            dirac_A, "A vanishes altogether: its mean falls like √p ln(4/p). Without the root it would become a Dirac function."
        ),
        ("schlick",),
    ),
    Statement(
        "eq_9_weights",
        "eq. 9; §7",
        "The Fresnel factor is introduced in a new way, expressing the weights of surface vs subsurface reflection",
        "both weights, S and 1 - S, lie in [0, 1] and make 1",
        trial(weights),
        ("schlick",),
    ),
    Statement(
        "eq_9_energy",
        "eq. 9; §7",
        "S(u) D + [1 - S(u)] S′(u) D′",
        "two layers that each conserve energy conserve it together: eq. 15 with r = 0.2 and eq. 11 with C = 0.04 over Lambert "
        "(eq. 17, r′ = 1), C′ = 1",
        trial(
            varnish,
            "Near grazing incidence the lobe sends back what S(u) near u = 0 gives it, and 1 - S(u) of other u goes to the "
            "layer below besides.",
        ),
        ("schlick",),
    ),
    Statement(
        "eq_9_single",
        "eq. 9; §7",
        "A distinction is made between materials with homogeneous properties and materials with heterogeneous properties",
        "DOUBLE holds SINGLE: for C = 1 the lower layer does not count",
        trial(single_in_double),
        ("schlick",),
    ),
    Statement(
        "figure_7_continuum",
        "§6, figure 7",
        "illustrates the continuum that is achieved between diffuse and specular reflection",
        "the zenith factor narrows from each r of figure 7 to the next",
        trial(narrower),
        ("schlick",),
    ),
    Statement(
        "figure_8_continuum",
        "§6, figure 8",
        "shows the continuum that is provided between isotropy and anisotropy",
        "the azimuth factor varies more from each p of figure 8 to the next",
        trial(brushed),
        ("schlick",),
    ),
    Statement(
        "figure_8_r",
        "figure 8",
        "r = 1.0 … the cylinder has been made of brushed metal",
        "the four pictures of brushed metal were made with r = 1.0",
        undecided(
            "r = 1 is “perfect diffuse” by §5.1, which no brushed metal is; yet the factor A alone makes a surface look brushed "
            "(our figures with r = 1 and r = 0.2 both do), so that it may be meant. The pictures are not in the text."
        ),
        ("schlick",),
    ),
)
