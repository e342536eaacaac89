"""Statements of sections 5.3 and 5.4: the spectral factor, and the directional factors of eq. 12 to 18."""

from __future__ import annotations

import math
from math import pi

import numpy as np
from scipy.integrate import quad

from albedo_lab.estimate.quadrature import quadrature
from albedo_lab.estimate.record import Question, Tolerance
from albedo_lab.optics import schlick1993
from albedo_lab.optics.schlick1993 import mean_of_A
from albedo_lab.papers.recipes import Means
from albedo_lab.papers.record import Statement
from albedo_lab.papers.schlick1993.formulas import (
    A,
    Array,
    G,
    S,
    Z,
    albedo,
    at,
    beckmann,
    eq12,
    eq17,
    eq18,
    pairs,
    quarter_turn,
    ward_slope,
)
from albedo_lab.papers.schlick1993.tried import EQUATIONS, MANY, over, row, spread, told
from albedo_lab.papers.trials import Found, checked, same, subject_of, trial

ROUGHNESSES = (0.01, 0.05, 0.2, 0.5, 1.0)
ISOTROPIES = (0.01, 0.05, 0.2, 0.5, 1.0)
"""Of figure 6."""


def ends_of_S(means: Means) -> Found:
    """Eq. 11 at both ends."""
    few = (0.02, 0.5, 0.95)
    normal, grazing = over(few, lambda C: float(S(C, np.ones(1))[0])), over(few, lambda C: float(S(C, np.zeros(1))[0]))
    condition = all(s == C for C, s in normal) and all(s == 1.0 for _, s in grazing)
    return Found(condition, f"S(1) = {row('C =', normal)}", EQUATIONS, f"S(0) = {row('C =', grazing)}")


def of_eq_5(m: Array, v: Array, v_: Array, turn: Array) -> Array:
    """The specular part of eq. 5, s = F = G = 1."""
    c = at(v, np.zeros_like(v), v_, turn)
    return 1.0 / (4.0 * pi * c.v * c.v_) * (np.exp((c.t**2 - 1.0) / (m**2 * c.t**2)) / (m**2 * c.t**4))


def of_eq_12(m: Array, v: Array, v_: Array, turn: Array) -> Array:
    """Eq. 12 with the D of eq. 6 for Z A."""
    c = at(v, np.zeros_like(v), v_, turn)
    return beckmann(m, c.t) / (4.0 * pi * c.v * c.v_)


def at_normal_incidence(means: Means) -> str:
    """The albedo of eq. 12 with the D of eq. 6, which is the share of facets less steep than 1."""
    m = 0.5
    a = albedo(lambda c: beckmann(m, c.t) / (4.0 * pi * c.v * c.v_), 1.0)
    return f"a(0°) = {told(a)}, 1 - exp(-1/m²) = {1.0 - math.exp(-(m**-2)):.6f} (m = 0.5)"


def sufficient(means: Means) -> Found:
    """Z and A = 1 meet both conditions, rightly read; what eq. 12 then reflects."""
    r = 0.2
    cosines = (1.0, 0.5, 0.1, 0.01)
    ours = over(cosines, lambda v: albedo(eq12(r), v).value)
    of = subject_of("schlick", directional="eq12", r=r)
    again = over(cosines, lambda v: quadrature(Question(of.model, of.p, v), Tolerance(0.0, 1e-9)).value)
    condition = max(a for _, a in ours) <= 1.0
    return Found(condition, f"a = {row('v =', ours)} (r = 0.2, p = 1)", "plain integration", f"{row('v =', again)} (model)")


def root_as_factor(means: Means) -> Found:
    """The second condition of eq. 13 for A = 1, the root as a factor and below."""
    factor = quad(lambda w: math.sqrt(1.0 - w * w), 0.0, 1.0)[0]
    below = quad(lambda w: 1.0 / math.sqrt((1.0 - w) * (1.0 + w)), 0.0, 1.0)[0]
    ours = f"{factor:.6f} = π/4 for A = 1; {below:.6f} = π/2 with the root in the denominator"
    return Found(abs(factor - 0.5 * pi) < 1e-6, ours, "adaptive Gauss-Kronrod", "quarter of a disc; dφ = dw/√(1-w²)")


def Z_meets(means: Means) -> Found:
    """2 t Z, for the r of figure 6."""
    ours = over(ROUGHNESSES, lambda r: quad(lambda t: 2.0 * t * float(Z(r, np.array(t))), 0.0, 1.0, epsrel=1e-11, limit=200)[0])
    again = over(ROUGHNESSES, lambda r: quad(lambda x: r / (r + x) ** 2, 0.0, math.inf)[0])
    condition = all(abs(z - 1.0) < 1e-8 for _, z in ours + again)
    return Found(condition, f"∫2tZ dt = {row('r =', ours)}", "adaptive Gauss-Kronrod", f"{row('r =', again)} (in the slopes)")


def A_meets(means: Means) -> Found:
    """The mean of A over the azimuth, for the p of figure 6; and of A^2, which is eq. 14 without its root."""
    ours = over(ISOTROPIES, lambda p: quarter_turn(lambda w: A(p, w)))
    again = over(ISOTROPIES, mean_of_A)
    squared = max(abs(a - 1.0) for _, a in over(ISOTROPIES, lambda p: quarter_turn(lambda w: A(p, w) ** 2)))
    condition = all(abs(a - 1.0) < 1e-6 for _, a in ours)
    words = f"(2/π)∫A/√(1-w²) dw = {row('p =', ours, 4)}; without A's root 1 within {squared:.1g}"
    return Found(condition, words, "adaptive Gauss-Kronrod", f"{row('p =', again, 4)} (√p / agm(1, p))")


def elliptical(means: Means) -> Found:
    """Eq. 8's Gaussian over t^4, over all normals: in slopes, by Gauss-Hermite it is 1; here over t and the azimuth."""
    m, n = 0.4, 0.1
    turn = np.linspace(0.0, 2.0 * pi, 400, endpoint=False)

    def over_azimuth(t: float) -> float:
        return float(np.mean(ward_slope(m, n, np.full_like(turn, t), np.cos(turn)) * 2.0 / t**3))

    whole = quad(over_azimuth, 0.02, 1.0, epsrel=1e-10, limit=400)[0]
    printed = quad(lambda t: over_azimuth(t) * t**4, 0.02, 1.0, epsrel=1e-10, limit=400)[0]
    ours = f"∫ = {whole:.7f} with 1/t⁴, {printed:.4f} without (m = 0.4, n = 0.1)"
    return Found(abs(whole - 1.0) < 1e-6, ours, "Gauss-Kronrod and the trapezoidal rule", "Gaussian of slopes: 1 (closed form)")


def constant_Z(means: Means) -> Found:
    """Z for r = 1."""
    t = np.linspace(0.0, 1.0, MANY)
    apart = float(np.max(np.abs(Z(1.0, t) - 1.0)))
    return Found(apart < 1e-12, f"Z is off 1 by {apart:.1g}", EQUATIONS, "1/(1 + t² - t²)² = 1")


def dirac_Z(means: Means) -> Found:
    """Z beside t = 1 vanishes with r, and its integral stays."""
    few = (1e-2, 1e-4, 1e-6)
    beside = over(few, lambda r: float(Z(r, np.array(0.9))))

    def whole(r: float) -> float:
        # with 1 - t^2 = exp(y)
        return float(quad(lambda y: r * math.exp(y) / (r + (1.0 - r) * math.exp(y)) ** 2, -60.0, 0.0, epsrel=1e-10, limit=400)[0])

    integrals = over(few, whole)
    condition = beside[-1][1] < 1e-4 and abs(integrals[-1][1] - 1.0) < 1e-6
    return Found(condition, f"Z(0.9) = {row('r =', beside, 3)}", EQUATIONS, f"∫2tZ dt = {row('r =', integrals, 7)}")


def no_transition(means: Means) -> Found:
    """Eq. 12 for r = 1 is 1/(4 pi v v')."""
    c = pairs(means.seed)
    f = eq12(1.0)(c)
    apart = float(np.max(np.abs(f * 4.0 * pi * c.v * c.v_ - 1.0)))
    words = f"largest over smallest D = {spread(f):.4g} at r = 1"
    return Found(spread(f) > 1.0 + 1e-6, words, EQUATIONS, f"4πvv′D = 1 within {apart:.1g}")


def interpolated(means: Means) -> Found:
    """The other end of eq. 17's interpolation: is r A / pi Lambert's? Over the azimuth, for p = 0.2."""
    ours = spread(A(0.2, np.linspace(0.0, 1.0, MANY)))
    again = spread(eq17(1.0, 0.2)(pairs(means.seed)))
    words = f"rA/π varies by a factor {ours:.4g} with the azimuth (p = 0.2)"
    return Found(ours < 1.0 + 1e-9, words, EQUATIONS, f"{again:.4g} over {MANY} pairs of eq. 17")


def weights_18(means: Means) -> Found:
    """Both weights of eq. 18 lie in [0, 1] and make 1."""
    v = np.linspace(0.0, 1.0, 301)
    GG = G(0.2, v)[:, None] * G(0.2, v)[None, :]
    condition = bool(GG.min() >= 0.0 and GG.max() <= 1.0)
    return Found(condition, f"GG′ from {GG.min():g} to {GG.max():g}", "301² cosines, r = 0.2", "(1 - GG′) + GG′ = 1")


def ratio(means: Means) -> Found:
    """G of eq. 16 at both ends, and that it grows, for the r of figure 6."""
    v = np.linspace(0.0, 1.0, MANY)
    shares = np.stack([G(r, v) for r in ROUGHNESSES])
    condition = bool(
        np.all(np.diff(shares) > 0.0) and np.all(shares[:, 0] == 0.0) and np.all(np.abs(shares[:, -1] - 1.0) < 1e-12)
    )
    again = over(ROUGHNESSES, lambda r: schlick1993.G(r, 0.5))
    ours = f"G(0.5) = {row('r =', over(ROUGHNESSES, lambda r: float(G(r, np.array(0.5)))))}; from 0 to 1"
    return Found(condition, ours, EQUATIONS, f"{row('r =', again)} (module schlick1993)")


def reemitted(means: Means) -> Found:
    """Eq. 18 with C = 1: facets that absorb nothing should send back everything."""
    cosines = (1.0, 0.5, 0.1, 1e-9)
    ours = over(cosines, lambda v: albedo(eq18(0.2), v).value)
    of = subject_of("schlick", directional="eq18", r=0.2)
    again = over(cosines, lambda v: quadrature(Question(of.model, of.p, v), Tolerance(0.0, 1e-9)).value)
    condition = all(abs(a - 1.0) < 1e-3 for _, a in ours)
    return Found(condition, f"a = {row('v =', ours)} (r = 0.2)", "plain integration", f"{row('v =', again)} (model)")


FACTORS = (
    Statement(
        "eq_11_ends",
        "§5.3",
        "S is function of the incident angle and should obey to Fresnel law",
        "eq. 11 is C at normal and 1 at grazing incidence",
        trial(ends_of_S),
        ("schlick",),
    ),
    Statement(
        "eq_12_extension",
        "§5.4, before eq. 12",
        "a straightforward extension of [BECK63]",
        "eq. 12 with D of eq. 6 for ZA is the specular part of eq. 5 with F = G = 1",
        same(of_eq_5, of_eq_12, (0.05, 0.5), (0.05, 1.0), (0.05, 1.0), (-3.0, 3.0), again=at_normal_incidence),
        ("schlick",),
    ),
    Statement(
        "eq_12_reciprocity",
        "§5.4",
        "Obviously, D fulfills the reciprocity condition",
        "eq. 12 is symmetric in V and V′ (r = 0.2, p = 0.2)",
        checked("reciprocity", "PASS", "schlick", directional="eq12", r=0.2, p=0.2),
        ("schlick",),
    ),
    Statement(
        "eq_13_sufficient",
        "§5.4, before eq. 13",
        "one can show [SCHL92] that D fulfills the normalization condition when",
        "Z and A that meet both conditions, rightly read (Z of eq. 14, A = 1), make eq. 12 reflect at most what it receives",
        trial(
            sufficient,
            "What the conditions normalise are the facets. Over vv′ the albedo is 1/(1+r) at normal incidence and grows like "
            "√r/(2v) towards grazing.",
        ),
        ("schlick",),
    ),
    Statement(
        "eq_13_root",
        "eq. 13",
        "∫ √(1-w²) A(w) dw = π/2",
        "A = 1, perfect isotropy, meets it",
        trial(root_as_factor, "dφ = dw/√(1-w²): the root belongs in the denominator. As a factor it gives π/4."),
        ("schlick",),
    ),
    Statement(
        "eq_14_Z",
        "eq. 13, 14",
        "also satisfies Equation 13: Z(t) = r/(1 + rt² - t²)²",
        "∫2tZ dt = 1 for the r of figure 6",
        trial(Z_meets),
        ("schlick",),
    ),
    Statement(
        "eq_14_A",
        "eq. 13, 14",
        "also satisfies Equation 13: A(w) = √(p/(p² - p²w² + w²))",
        "∫A/√(1-w²) dw = π/2 for the p of figure 6",
        trial(A_meets, "Its mean is (2/π)√p K(1-p²), 1 for p = 1 only; without the root it is 1 for every p."),
        ("schlick",),
    ),
    Statement(
        "gaussian_mix",
        "§5.4, before eq. 14",
        "Z and A can be mixed in a gaussian elliptical function as in [WARD92]",
        "the Gaussian of eq. 8, over t⁴ as in eq. 6, meets both conditions at once",
        trial(elliptical),
        ("ward",),
    ),
    Statement(
        "Z_constant",
        "§5.4, after eq. 14",
        "when r = 1, Z(t) is a constant function (perfect diffuse)",
        "Z = 1 for r = 1",
        trial(constant_Z),
        ("schlick",),
    ),
    Statement(
        "Z_dirac",
        "§5.4, after eq. 14",
        "when r = 0, Z(t) becomes a Dirac function (perfect specular)",
        "as r falls, Z vanishes beside t = 1 and keeps its integral",
        trial(dirac_Z),
        ("schlick",),
    ),
    Statement(
        "eq_16_ratio",
        "eq. 15, 16",
        "G(v) (resp G(v′)) expresses the ratio of reflected (resp incident) non obstructed light",
        "eq. 16 grows from 0 at grazing to 1 at normal incidence, for the r of figure 6",
        trial(ratio),
        ("schlick",),
    ),
    Statement(
        "eq_12_no_transition",
        "§5.4, before eq. 17",
        "Due to the presence of v and v′ on the denominator, Equation 12 does not provide complete transition from perfect "
        "specular to perfect diffuse",
        "eq. 12 is not constant for r = 1",
        trial(no_transition),
        ("schlick",),
    ),
    Statement(
        "eq_17_interpolation",
        "§5.4, before eq. 17",
        "a linear interpolation … between the BRDF of Equation 12 and a lambertian BRDF",
        "the other end, rA/π, is Lambert's for p < 1, too (p = 0.2)",
        trial(interpolated, "A stays in the diffuse term; only for p = 1 is it Lambert's."),
        ("schlick",),
    ),
    Statement(
        "eq_18_weights",
        "eq. 18; §7",
        "expressing the weights of single vs multiple reflection",
        "GG′ and 1 - GG′ lie in [0, 1] and make 1",
        trial(weights_18),
        ("schlick",),
    ),
    Statement(
        "eq_18_reemission",
        "§5.4, before eq. 18; §4",
        "self-shadowing with reemission … the remainder of the light (ie 1-G) is reflected in other directions and not simply "
        "blocked",
        "eq. 18 with C = 1 sends back all light",
        trial(
            reemitted,
            "1 - GG′ is not what the lobe lacks: too little comes back at normal incidence, nearly twice the light at grazing.",
        ),
        ("schlick",),
    ),
)
