"""Statements of appendices A and B, of the section on environment maps, and of the document as a whole."""

from __future__ import annotations

from math import pi, radians, sqrt

import numpy as np

from albedo_lab.optics.fresnel import conductor, dielectric, schlick
from albedo_lab.papers.losasso.cook_torrance import GLASS, M
from albedo_lab.papers.losasso.equations import (
    cheap_fresnel,
    cook_torrance,
    direction,
    dot,
    fresnel,
    half_vector,
    hemisphere,
    lambert,
    oren_nayar,
    phong,
    reflected,
    reflection_vector,
    ward,
)
from albedo_lab.papers.losasso.tried import MANY, PRINTED, share
from albedo_lab.papers.recipes import Means
from albedo_lab.papers.record import Statement
from albedo_lab.papers.trials import CLOSED, Found, checked, subject_of, trial, unclaimed, undecided
from albedo_lab.pictures.evaluation import values

APPENDIX_A = "appendix A"
MAPS = "Environment Mapping Based Lighting Models"
NORMAL_F = ((GLASS - 1.0) / (GLASS + 1.0)) ** 2

USED = {
    "Lambert": "I k_a k_d f_att N L",
    "Phong": "I k_a k_d k_s f_att N L E R n",
    "Cook-Torrance": "I k_a k_d k_s ρ L N E D G F λ θ_i f_att β m",
    "Blinn": "I k_s f_att D G F λ θ_i E N H c",
    "Oren-Nayar": "I k_d f_att ρ E₀ θ_i A B φ_r φ_i α β σ",
    "Minnaert": "I k_d f_att N L E k",
    "Ward": "I k_d k_s f_att N L E α_x α_y H X Y",
    "H": "L V",
    "G": "N H E L V",
    "F": "g c n θ_i L H N E",
    "f_att": "c₁ c₂ c₃ d",
}
"""The symbols of each printed equation."""
EXPLAINED = "I k_d k_s N L E H R n c c₁ c₂ c₃ d G F f_att"
"""The first column of appendix A."""
MEANINGS = {
    "n": ("specular exponent (table; Phong)", "index of refraction (exact F)", "factor at grazing angles (cheap F)"),
    "c": ("eccentricity (table; Blinn)", "cos(θ_i) (F)"),
    "θ_i": ("between L and H (F)", "between L and N (Oren-Nayar)"),
    "β": ("between N and H (Cook-Torrance)", "the smaller of θ_i and θ_r (Oren-Nayar)"),
}


def one_light(means: Means) -> Found:
    """White surfaces: what is reflected of a light that brings E_0 = 1 to a surface facing it, by equation."""
    cook = share("cook_torrance", 0.0, 1.0, m=0.05)
    shares = {
        "Lambert": reflected(lambert, 0.0, 1.0),
        "Ward": pi * share("ward", 0.0, 1.0, form="half_vector", m=0.05).value,
        "Cook-Torrance": cook.value,
        "Oren-Nayar, σ = 0": share("oren_nayar", 0.0, 1.0, sigma=0.0).value,
    }
    again = [reflected(I, 0.0, 1.0) for I in (lambert, ward(0.05, 0.05), cook_torrance(0.05), oren_nayar(0.0))]
    ours = ", ".join(f"{name} {value:.4f}" for name, value in shares.items())
    condition = max(shares.values()) / min(shares.values()) < 1.01
    words = ", ".join(f"{value:.4f}" for value in again)
    return Found(condition, ours, "quadrature, k = F = ρ = E₀ = 1, m = α = 0.05, θ = 0", f"{words} ({PRINTED})")


def symbols(means: Means) -> Found:
    """Symbols of the equations that the table does not explain."""
    used = list(dict.fromkeys(symbol for text in USED.values() for symbol in text.split()))
    missing = [symbol for symbol in used if symbol not in EXPLAINED.split()]
    unused = [symbol for symbol in EXPLAINED.split() if symbol not in used]
    ours = f"{len(missing)} of {len(used)} symbols are not in it: {', '.join(missing)}"
    return Found(not missing, ours, "every equation's symbols against the table's", f"{len(unused)} in it are in no equation")


def one_meaning(means: Means) -> Found:
    """Symbols with several meanings; for theta_i, the two angles at random pairs."""
    L, E = hemisphere(means.seed, MANY), hemisphere(means.seed + 1, MANY)
    apart = np.degrees(np.abs(np.arccos(dot(L, half_vector(L, E))) - np.arccos(L[:, 2])))
    several = [f"{symbol} ({len(meanings)})" for symbol, meanings in MEANINGS.items() if len(meanings) > 1]
    ours = f"several meanings: {', '.join(several)}"
    return Found(
        not several,
        ours,
        "the equations' use of each",
        f"the two θ_i differ by up to {float(apart.max()):.0f}° over 10 000 pairs",
    )


def sums_to_one(means: Means) -> Found:
    """k_d = k_s = 1/2 in Phong's equation: what comes back of a light at 89.9 degrees."""
    theta = 89.9
    ours = share("phong_original", theta, pi, n=20, scale=1.0)
    both = 0.5 + 0.5 * ours.value
    again = 0.5 * reflected(lambert, radians(theta), pi) + 0.5 * reflected(phong(20), radians(theta), pi)
    words = f"{both:.4f} of a light at 89.9° comes back, Phong with k_d = k_s = 1/2 and n = 20"
    return Found(both <= 1.0, words, "quadrature, irradiance π", f"{again:.4f} ({PRINTED}, E·R < 0 not clamped)")


def no_boundary(means: Means) -> Found:
    """n = 1 is no boundary, and reflects nothing."""
    printed = float(fresnel(1.0, 1.0, printed=True))
    right = float(fresnel(1.0, 1.0))
    ours = f"F(0°) = {printed:.6f} for n = 1 as printed"
    again = f"{right:g} with g = √(n² + c² − 1); {dielectric(1.0000001, 1.0):.1g} (optics.fresnel)"
    return Found(abs(printed) < 1e-9, ours, "the printed equation", again)


def glass(means: Means) -> Found:
    """Glass of n = 1.5 at normal incidence."""
    printed = float(fresnel(GLASS, 1.0, printed=True))
    right = float(fresnel(GLASS, 1.0))
    ours = f"F(0°) = {printed:.6f} for n = 1.5 as printed"
    again = f"((n − 1)/(n + 1))² = {NORMAL_F:.6f}; {right:.6f} with g = √(n² + c² − 1)"
    return Found(abs(printed - NORMAL_F) < 1e-6, ours, "the printed equation", again)


def rising(means: Means) -> Found:
    """The corrected F of glass over the angle; and where a larger index breaks the rule."""
    c = np.cos(np.radians(np.linspace(0.0, 89.9, 9000)))
    steps = np.diff(fresnel(GLASS, c))
    exact = np.array([conductor(GLASS, 0.0, float(x)) for x in c[::10]])
    # the first that falls: for n > 2 + sqrt(3) both polarisations together fall before they rise
    falling = next(n for n in np.arange(3.5, 4.0, 0.001) if np.any(np.diff(fresnel(float(n), c)) < -1e-12))
    ours = f"F rises from {fresnel(GLASS, c[0]):.4f} at 0° to {fresnel(GLASS, c[-1]):.4f} at 89.9° (n = 1.5)"
    again = f"least step {float(np.diff(exact).min()):.1g} (optics.fresnel); from n = {falling:.2f} on (2 + √3) it falls first"
    return Found(bool(steps.min() > -1e-12), ours, "the corrected equation, 9000 angles", again)


def approximated(means: Means) -> Found:
    """The cheap equation against the exact one, for glass, with n the index as in the line before, or F at normal incidence."""
    c = np.cos(np.radians(np.linspace(0.0, 89.0, 900)))
    exact = fresnel(GLASS, c)
    off = {n: float(np.max(np.abs(cheap_fresnel(n, c) - exact))) for n in (GLASS, NORMAL_F)}
    right = max(abs(schlick(NORMAL_F, float(x)) - float(fresnel(GLASS, x))) for x in c)
    ours = f"off by up to {off[GLASS]:.3f} with n = 1.5, by {off[NORMAL_F]:.3f} with n = F(0°) = 0.04"
    again = f"F₀ + (1 − F₀)(1 − c)^5 is off by {right:.3f} at most"
    return Found(min(off.values()) < 0.1, ours, "both printed equations, c = N·E = L·H", again)


def at_most_one(means: Means) -> Found:
    """The cheap equation for an index above 1."""
    c = np.linspace(0.0, 1.0, 1001)
    largest = float(cheap_fresnel(GLASS, c).max())
    subject = subject_of("cook_torrance", fresnel="schlick", as_printed="losasso", F0=1.0, m=M)
    one = subject_of("cook_torrance", m=M)
    w = direction(np.radians([60.0]))
    ratio = float(values(subject, w, w)[0] / values(one, w, w)[0])
    ours = f"F = {largest:.4f} at grazing angles for n = 1.5; F(0°) = {float(cheap_fresnel(GLASS, 1.0)):g}"
    return Found(largest <= 1.0, ours, "the printed equation", f"{ratio:g} for n = 1, at 60° (model)")


def cheap_rises(means: Means) -> Found:
    """The cheap equation with n the reflectance at normal incidence, the only n that keeps it at most 1."""
    c = np.cos(np.radians([0.0, 80.0, 89.9]))
    F = cheap_fresnel(NORMAL_F, c)
    subject = subject_of("cook_torrance", fresnel="schlick", as_printed="losasso", F0=NORMAL_F, m=M)
    w = direction(np.radians([0.0, 80.0]))
    f = values(subject, w, w) / values(subject_of("cook_torrance", m=M), w, w)
    ours = ", ".join(f"{v:.3f}" for v in F)
    return Found(
        bool(F[-1] > F[0]),
        f"F = {ours} at 0°, 80°, 89.9° for n = 0.04",
        "the printed equation",
        f"{f[0]:.3f}, {f[1]:.3f} at 0°, 80° (model)",
    )


def swapped_cheap(means: Means) -> str:
    """F of N.E with light and eye exchanged."""
    low, high = (float(cheap_fresnel(NORMAL_F, float(cosine))) for cosine in np.cos(np.radians([20.0, 70.0])))
    return f"F(N·E) = {low:.4f} for E at 20°, {high:.4f} for E at 70° (the printed equation)"


def inverse_square(means: Means) -> Found:
    """The light of a point through a window of fixed size, counted, against 1 / d^2."""
    rng = np.random.default_rng(means.seed)
    w = rng.standard_normal((400_000, 3))
    w = w[w[:, 2] > 0.0]
    x, y = np.abs(w[:, 0] / w[:, 2]), np.abs(w[:, 1] / w[:, 2])
    hits = [float(np.mean((x <= 0.1 / d) & (y <= 0.1 / d))) for d in (1.0, 2.0)]
    solid = [4.0 * np.arctan(0.01 / (d * sqrt(d * d + 0.02))) for d in (1.0, 2.0)]
    ours = f"twice as far, {solid[1] / solid[0]:.4f} of the light passes a window of 0.2 × 0.2"
    return Found(abs(solid[1] / solid[0] - 0.25) < 0.01, ours, "solid angles", f"{hits[1] / hits[0]:.2f} of random rays")


def attenuation(means: Means) -> Found:
    """min(1 / (c_1 + c_2 d + c_3 d^2), 1) over random coefficients and distances."""
    c1, c2, c3, d = np.random.default_rng(means.seed).exponential(1.0, (4, 100_000))
    f = np.minimum(1.0 / (c1 + c2 * d + c3 * d * d), 1.0)
    unclamped = float(np.max(1.0 / (c1 + c2 * d + c3 * d * d)))
    ours = f"f_att in [{f.min():.2g}, {f.max():g}]"
    return Found(
        bool(f.max() <= 1.0 and f.min() >= 0.0),
        ours,
        "100 000 coefficients and distances",
        f"up to {unclamped:.3g} without the min",
    )


def one_map(means: Means) -> Found:
    """Two normals for which one light and two eyes have the same R, and what each equation says of both."""
    # the map is fetched by R, the eye mirrored about the normal; the light is fixed in the world
    light = direction(radians(10.0))
    R = direction(radians(40.0), pi)
    found: dict[str, list[float]] = {"Phong": [], "Cook-Torrance": []}
    model = []
    for tilt in (0.0, 25.0):
        normal = direction(radians(tilt), pi)

        def local(w: np.ndarray, normal: np.ndarray = normal) -> np.ndarray:
            """w in the frame of that normal, whose y axis stays."""
            y = np.array([0.0, 1.0, 0.0])
            return np.array([w @ np.cross(y, normal), w @ y, w @ normal])

        eye = 2.0 * (normal @ R) * normal - R
        L, E = local(light)[None, :], local(eye)[None, :]
        found["Phong"].append(float(reflection_vector(E)[0] @ L[0]) ** 20)
        found["Cook-Torrance"].append(float(cook_torrance(M)(L, E)[0]))
        model.append(float(values(subject_of("cook_torrance", m=M), L, E)[0] * L[0, 2]))
    ratios = {name: a / b for name, (a, b) in found.items()}
    ours = ", ".join(f"{name} {ratio:.4f}" for name, ratio in ratios.items())
    condition = all(abs(ratio - 1.0) < 1e-9 for ratio in ratios.values())
    return Found(
        condition,
        f"I of one normal over that of another, same R: {ours}",
        "the equations",
        f"Cook-Torrance {model[0] / model[1]:.4f} (model)",
    )


def moved_from_the_centre(means: Means) -> Found:
    """A light at a distance D seen from s beside the map's centre: its direction turns by atan(s / D)."""
    near, far = (float(np.cos(np.arctan(s)) ** 100) for s in (0.2, 0.01))
    eye = direction(np.arctan(np.array([0.2, 0.01])))
    again = phong(100)(np.broadcast_to(direction(0.0), eye.shape), eye)
    ours = f"a highlight of n = 100 keeps {near:.3f} of its peak at s = D/5, {far:.3f} at s = D/100"
    return Found(near < 0.5 < far, ours, CLOSED, f"{again[0]:.3f}, {again[1]:.3f} (the equation)")


STATEMENTS = (
    Statement(
        "one_light_for_all_equations",
        "all equations, and appendix A, k_d and k_s",
        "The fraction of light that is reflected",
        "One light makes k_d, k_s (and ρ) such fractions in all equations: white surfaces reflect the same of it at normal "
        "incidence.",
        trial(
            one_light,
            "Lambert's and Ward's terms (and Phong's) want a light of irradiance π, Cook and Torrance's and Oren and "
            "Nayar's one of "
            "irradiance 1: they have a 1/π that the others have not. Rendered beside each other they differ by π in brightness.",
        ),
        ("lambert", "ward", "cook_torrance", "oren_nayar"),
    ),
    Statement(
        "appendix_a_complete",
        f"{APPENDIX_A}, first sentence",
        "The following table gives each symbol used in this paper and an explanation",
        "Every symbol of the equations stands in the table.",
        trial(
            symbols,
            "The ambient k_a, Minnaert's k, m, σ, D, ρ and the angles among others are nowhere explained; V stands for E.",
        ),
    ),
    Statement(
        "appendix_a_one_meaning",
        f"{APPENDIX_A}, first sentence",
        "gives each symbol used in this paper and an explanation",
        "The explanation fits wherever the symbol is used.",
        trial(
            one_meaning,
            "The n of F is an index of refraction and its c a cosine; the table knows a specular exponent and an eccentricity. "
            "θ_i is measured from H in F, from N elsewhere.",
        ),
    ),
    Statement(
        "k_d_and_k_s_add_up",
        f"{APPENDIX_A}, k_s",
        "note that the diffuse and specular coefficients should add up to one",
        "Phong's equation with k_d + k_s = 1 creates no energy; light at 89.9°, n = 20.",
        unclaimed(
            trial(sums_to_one),
            "The note does not say what for. For energy balance they may add up to 1 at most; with Phong's equation that is not "
            "enough, with Lambert's, Ward's and others it is away from grazing incidence.",
        ),
        ("phong_original", "lambert"),
    ),
    Statement(
        "fresnel_no_boundary",
        f"{APPENDIX_A}, F",
        "g = √(n² + c²) − 1",
        "A boundary of n = 1, which is none, reflects nothing.",
        trial(no_boundary, "The 1 belongs under the root: g = √(n² + c² − 1)."),
        ("cook_torrance",),
    ),
    Statement(
        "fresnel_glass",
        f"{APPENDIX_A}, F",
        "F = ½ (g−c)²/(g+c)² [1 + (c(g+c)−1)²/(c(g−c)+1)²]; g = √(n² + c²) − 1",
        "Glass of n = 1.5 reflects ((n − 1)/(n + 1))² = 4 % at normal incidence.",
        trial(glass, "The 1 belongs under the root: with g = √(n² + c² − 1) the equation is Fresnel's."),
        ("cook_torrance",),
    ),
    Statement(
        "fresnel_increases",
        f"{APPENDIX_A}, F",
        "Fresnel determines the amount of reflection of the surface (increases as the zenith angle becomes larger)",
        "For glass (n = 1.5) the corrected F rises over all angles.",
        trial(rising),
    ),
    Statement(
        "cheap_fresnel_approximates",
        f"{APPENDIX_A}, F",
        "the Fresnel conductance term can also be approximated by … F = (1 − (1 − (N·E))^5) + n (1 − (N·E))^5",
        "For glass it is within 0.1 of the exact F, with n its index or its reflectance at normal incidence.",
        trial(
            approximated,
            "Schlick's approximation is F₀ (1 − x) + x, x = (1 − c)^5: the factor stands at the other term.",
        ),
        ("cook_torrance",),
    ),
    Statement(
        "cheap_fresnel_increases",
        f"{APPENDIX_A}, F",
        "F = (1 − (1 − (N·E))^5) + n (1 − (N·E))^5",
        "It increases as the zenith angle becomes larger, with n = F(0°) = 0.04.",
        trial(
            cheap_rises,
            "It falls from 1 to n: what is meant to be n at normal incidence and 1 at grazing is the other way round.",
        ),
        ("cook_torrance",),
    ),
    Statement(
        "cheap_fresnel_at_most_one",
        f"{APPENDIX_A}, F",
        "F = (1 − (1 − (N·E))^5) + n (1 − (N·E))^5",
        "It is at most 1 with n the index of the line before, 1.5.",
        trial(at_most_one, "It goes to n at grazing angles: with an index, more comes back than arrives."),
        ("cook_torrance",),
    ),
    Statement(
        "cheap_fresnel_reciprocal",
        f"{APPENDIX_A}, F",
        "F = (1 − (1 − (N·E))^5) + n (1 − (N·E))^5",
        "With it the Cook-Torrance model is the same with light and eye exchanged; n = F₀ = 0.04, m = 0.3.",
        checked(
            "reciprocity",
            "PASS",
            "cook_torrance",
            fresnel="schlick",
            as_printed="losasso",
            F0=0.04,
            m=M,
            again=swapped_cheap,
            why="N·E stands where c = L·H must, as the exact equation before has it.",
        ),
        ("cook_torrance",),
    ),
    Statement(
        "attenuation_is_a_fraction",
        f"{APPENDIX_A}, f_att",
        "The fraction of light that reaches the surface … f_att = min(1/(c₁ + c₂ d + c₃ d²), 1)",
        "f_att lies between 0 and 1 for coefficients and distances that are not negative.",
        trial(attenuation),
    ),
    Statement(
        "inverse_square",
        f"{APPENDIX_A}, f_att",
        "in real life, light is attenuated with the square of the distance",
        "Twice as far from a point, a quarter of its light passes a window.",
        trial(inverse_square),
    ),
    Statement(
        "one_map_holds_any_model",
        MAPS,
        "incredibly complex and expensive lighting solutions can be computed, and then cheaply applied to an object",
        "A cube map fetched by one direction (R, the eye mirrored about N) holds the specular terms of the document for "
        "static lights.",
        unclaimed(
            trial(one_map),
            "A cube map has one direction and a BRDF two: it holds what depends on N alone (Lambert) or on R alone (Phong's "
            "lobe). The document says how complex the lighting may be, not of which model.",
        ),
        ("phong_original", "cook_torrance"),
    ),
    Statement(
        "map_useless_elsewhere",
        MAPS,
        "If the surface being lit is not at the location where the point P was, then the cube map may be useless",
        "A fifth of the light's distance beside P a highlight of n = 100 has lost more than half of its peak.",
        trial(moved_from_the_centre),
        ("phong_original",),
    ),
    Statement(
        "appendix_b",
        "appendix B",
        "The following table shows the relative costs of the different lighting models",
        "The table's costs.",
        undecided(
            "The table is missing from the text beyond this caption. The costs are measured anew in the pages of the timings."
        ),
        ("lambert", "phong_original", "cook_torrance", "blinn_trowbridge_reitz", "oren_nayar", "minnaert", "ward"),
    ),
)
