"""Statements of section 5: metals, plastics and ceramics."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from albedo_lab.optics.fresnel import conductor
from albedo_lab.optics.metals import METALS, PAPER_WAVELENGTHS, index
from albedo_lab.papers.neumann1999.equations import (
    Array,
    Brdf,
    dot,
    fresnel,
    halfway,
    hemisphere,
    larger,
    mirrored,
    reflected,
    stretched,
)
from albedo_lab.papers.neumann1999.statements.introduction import towards_grazing
from albedo_lab.papers.neumann1999.statements.stretched import c_n
from albedo_lab.papers.neumann1999.tried import CODE, MANY, PRINTED, SAME, albedo, cosine, exchanged, in_section, sampled
from albedo_lab.papers.recipes import Means
from albedo_lab.papers.record import Statement
from albedo_lab.papers.trials import CLOSED, Found, apart, checked, trial, undecided
from albedo_lab.pictures.evaluation import in_plane

ALUMINIUM: dict[str, Any] = {"metal": "aluminium", "wavelength": 550.0}


METAL = complex(0.96, 6.69)
"""About the index of aluminium at 550 nm; reciprocity does not depend on it."""


def coloured(kappa: complex, half: bool = False) -> Brdf:
    """Eq. 28 without its constant, or eq. 27 with the angle of the halfway vector."""
    return lambda L, V: np.asarray(
        stretched(20.0)(L, V) * fresnel(complex(kappa), dot(halfway(L, V), V) if half else np.maximum(L[:, 2], V[:, 2]))
    )


def pairs(means: Means) -> tuple[Array, Array]:
    """Lights and viewers anywhere above the surface."""
    return hemisphere(means.seed, MANY), hemisphere(means.seed + 1, MANY)


def half_angle(L: Array, V: Array) -> Array:
    """The angle between the half-vector and either direction, in degrees."""
    return np.asarray(np.degrees(np.arccos(np.clip(dot(halfway(L, V), V), -1.0, 1.0))))


def smaller_angle(L: Array, V: Array) -> Array:
    """Theta_min in degrees."""
    return np.asarray(np.degrees(np.arccos(larger(L, V))))


def at_the_mirror(means: Means) -> Found:
    """Theta_min is the half-vector's angle in the mirror direction."""
    L = hemisphere(means.seed, MANY)
    worst = float(np.max(np.abs(half_angle(L, mirrored(L)) - smaller_angle(L, mirrored(L)))))
    f = [float(in_section("metal", 60.0, 60.0, n=20, angle=a, **ALUMINIUM)[0]) for a in ("half_vector", "theta_min")]
    return Found(
        worst < 1e-5,
        f"the angles differ by at most {worst:.1g}°",
        PRINTED,
        f"f at R: {f[0]:.9g} (eq. 27), {f[1]:.9g} (eq. 28; {CODE})",
    )


def smaller_elsewhere(means: Means) -> Found:
    """Whether Theta_min is the smaller one everywhere else."""
    L, V = pairs(means)
    larger_share = float(np.mean(smaller_angle(L, V) > half_angle(L, V)))
    L60 = in_plane(np.array([-60.0]))
    ours = f"Θ_min is larger at {larger_share:.3f} of all pairs"
    own, halfway_angle = smaller_angle(L60, L60)[0], half_angle(L60, L60)[0]
    again = f"V = L at 60°: Θ_min = {own:.1f}°, angle of the halfway vector {halfway_angle:.1f}° ({CLOSED}: 60° and 0°)"
    return Found(larger_share == 0.0, ours, f"{MANY} pairs", again)


def forty_five(means: Means) -> Found:
    """Perpendicular light, viewer at the horizon."""
    L, V = np.array([[0.0, 0.0, 1.0]]), np.array([[1.0, 0.0, 0.0]])
    a, b = float(smaller_angle(L, V)[0]), float(half_angle(L, V)[0])
    return Found(
        abs(a) < 1e-9 and abs(b - 45.0) < 1e-9, f"Θ_min = {a:g}°, halfway vector {b:.9g}°", PRINTED, f"half of 90° ({CLOSED})"
    )


def largest_difference(means: Means) -> Found:
    """Where both angles differ most."""
    L, V = pairs(means)
    difference = half_angle(L, V) - smaller_angle(L, V)
    grazing = in_plane(np.array([-89.99]))
    most = float(half_angle(grazing, grazing)[0] - smaller_angle(grazing, grazing)[0])
    ours = (
        f"{most:.2f}° for V = L at 89.99°; {difference.max():.1f}° and {difference.min():.1f}° are the extremes of {MANY} pairs"
    )
    again = f"(Θ_L + Θ_V)/2 - Θ_min ≤ 45°, but 0 - Θ_min → -90° for V = L ({CLOSED})"
    return Found(abs(most) <= 45.0, ours, PRINTED, again)


def variation_near_grazing(means: Means) -> Found:
    """Where Fresnel's reflectance of the metals is steepest."""
    angles = np.arange(0.0, 90.0, 0.1)
    steepest, later = [], []
    for metal in METALS:
        for wavelength in PAPER_WAVELENGTHS:
            eta, k = index(metal, wavelength)
            F = np.array([conductor(eta, k, cosine(float(a))) for a in angles])
            G = fresnel(complex(eta, k), np.cos(np.radians(angles)))
            steepest.append(float(angles[np.argmax(np.abs(np.diff(F)))]))
            later.append(float(np.sum(np.abs(np.diff(G[450:]))) / np.sum(np.abs(np.diff(G)))))
    ours = f"steepest at {min(steepest):.1f}° or beyond, four metals at eight wavelengths"
    return Found(
        min(steepest) > 45.0,
        ours,
        "Fresnel, steps of 0.1°",
        f"{min(later):.3f} or more of F's variation is beyond 45° (complex amplitudes)",
    )


def metal_by_table(means: Means) -> Found:
    """cosⁿα / g with g tabulated against eq. 28."""
    viewers = np.linspace(-80.0, 89.9, 500)
    worst = 0.0
    for metal in METALS:
        f, g = (
            in_section("metal", 60.0, viewers, n=20, metal=metal, wavelength=550.0, angle=a) for a in ("theta_min", "tabulated")
        )
        worst = max(worst, apart(f, g))
    eta, k = index("aluminium", 550.0)
    L, V = in_plane(np.full(500, -60.0)), in_plane(viewers)
    h = c_n(20.0) * stretched(20.0)(L, V) * fresnel(complex(eta, k), larger(L, V))
    code = in_section("metal", 60.0, viewers, n=20, angle="theta_min", **ALUMINIUM)
    ours = f"largest relative difference {worst:.1g}, 1024 linear pieces of 1/F, four metals at 550 nm"
    return Found(worst < 1e-5 and apart(h, code) < SAME, ours, CODE, f"eq. 28 against its code: {apart(h, code):.1g} ({PRINTED})")


def plastic_balance(means: Means) -> Found:
    """a_s + a_d = 1 with F = 1."""
    worst = {
        n: max(albedo("plastic", a, fresnel="one", a_d=0.0, a_s=1.0, n=n) for a in (0.0, 7.0, 13.0, 20.0))
        for n in (1.0, 2.0, 100.0)
    }
    ours = ", ".join(f"{x - 1.0:+.1e} (n = {n:g})" for n, x in worst.items())
    hand = c_n(1.0) * reflected(stretched(1.0), 13.0)
    return Found(
        max(worst.values()) <= 1.0004,
        f"largest albedo less 1, a_s = 1: {ours}",
        "quadrature",
        f"n = 1: a(13°) = {hand:.6f} (product rule)",
    )


def balance_needed(means: Means) -> Found:
    """Whether the condition of eq. 30 can be exceeded."""
    shares = [(0.5, 0.52), (0.9, 0.12)]
    a = [albedo("plastic", 0.0, fresnel="one", a_d=a_d, a_s=a_s, n=100) for a_d, a_s in shares]
    exact = [albedo("plastic", 0.0, fresnel="exact", a_d=a_d, a_s=a_s, n=100, eta=1.5) for a_d, a_s in shares]
    ours = ", ".join(f"{x:.4f}" for x in a) + " at 0° for (a_d, a_s) = (0.5, 0.52), (0.9, 0.12), n = 100"
    again = f"a_d + a_s at normal incidence ({CLOSED}); with eq. 29's F, η = 1.5, only {exact[0]:.4f}, {exact[1]:.4f}"
    return Found(min(a) > 1.0, ours, "quadrature", again)


def specular_is_smaller(means: Means) -> Found:
    """Shares of both parts of a plastic."""
    specular = [albedo("plastic", angle, a_d=0.0, a_s=1.0, n=100, eta=1.5) for angle in (0.0, 45.0, 60.0)]
    z = (np.arange(20_000) + 0.5) / 20_000
    mean = 2.0 * float(np.mean(z * fresnel(1.5 + 0j, z)))
    ours = ", ".join(f"{a:.4f}" for a in specular) + " at 0°, 45°, 60° from the specular part with a_s = 1, η = 1.5, n = 100"
    return Found(max(specular) < 0.25, ours, "quadrature", f"mean of F over a white sky {mean:.4f} (complex amplitudes, k = 0)")


def components(means: Means) -> Found:
    """Eq. 29 and 30 are sums of a Lambert and a stretched Phong part."""
    viewers = np.linspace(-80.0, 89.0, 300)
    a_d, a_s, n, eta = 0.4, 0.5, 20.0, 1.5
    L, V = in_plane(np.full(300, -50.0)), in_plane(viewers)
    lobe = a_s * c_n(n) * stretched(n)(L, V)
    first = apart(
        in_section("plastic", 50.0, viewers, a_d=a_d, a_s=a_s, n=n, eta=eta),
        a_d / math.pi + lobe * fresnel(complex(eta), larger(L, V)),
    )
    second = apart(in_section("plastic", 50.0, viewers, a_d=a_d, a_s=a_s, n=n, fresnel="one"), a_d / math.pi + lobe)
    again = f"a_d of it comes back by the first part alone: {sampled('plastic', 60.0, means, a_d=a_d, a_s=0.0, n=n)} (rqmc)"
    return Found(max(first, second) < SAME, f"eq. 29: {first:.1g}, eq. 30: {second:.1g} from the models' code", PRINTED, again)


STATEMENTS = (
    Statement(
        "equation_27_reciprocal",
        "§5.1, eq. 27",
        "an appropriate incident angle, which should be a symmetric function of L and V to make the model reciprocal",
        "With the angle of the halfway vector eq. 27 is reciprocal (aluminium at 550 nm, n = 20).",
        checked(
            "reciprocity", "PASS", "metal", again=exchanged(coloured(METAL, half=True)), n=20, angle="half_vector", **ALUMINIUM
        ),
        ("metal",),
    ),
    Statement(
        "equation_28_reciprocal",
        "§5.1, eq. 28",
        "Another alternative is letting Θ = Θ_min.",
        "With Θ_min eq. 28 is reciprocal (aluminium at 550 nm, n = 20).",
        checked("reciprocity", "PASS", "metal", again=exchanged(coloured(METAL)), n=20, angle="theta_min", **ALUMINIUM),
        ("metal",),
    ),
    Statement(
        "metal_energy",
        "§5.1, eq. 27",
        "For a single wavelength λ, the new BRDF for metals is",
        "With c_n = (n+2)/2π it keeps energy balance: silver at 550 nm, n = 20.",
        checked(
            "energy",
            "PASS",
            "metal",
            again=towards_grazing("metal", n=20, metal="silver", wavelength=550.0),
            n=20,
            metal="silver",
            wavelength=550.0,
        ),
        ("metal",),
    ),
    Statement(
        "same_angle_at_mirror",
        "§5.1",
        "This alternative gives back the angle of the halfway vector for the mirror direction",
        "For V = R both angles are the same.",
        trial(at_the_mirror),
        ("metal",),
    ),
    Statement(
        "smaller_angle_elsewhere",
        "§5.1",
        "but for other directions it generates a smaller angle",
        "Θ_min is nowhere larger than the angle between the halfway vector and either direction.",
        trial(smaller_elsewhere, "towards the light the halfway vector's angle goes to 0, Θ_min does not"),
        ("metal",),
    ),
    Statement(
        "forty_five_degrees",
        "§5.1",
        "Here Θ_min = 0 while the angle of the halfway vector is 45°.",
        "Perpendicular light and a viewer at the horizon.",
        trial(forty_five),
        ("metal",),
    ),
    Statement(
        "largest_difference",
        "§5.1",
        "The largest difference between the angle of the halfway vector and Θ_min occurs when the lighting is "
        "perpendicular to the surface and the viewing direction is parallel to it.",
        "No pair of directions has angles that differ by more than the 45° of that pair.",
        trial(
            largest_difference, "it is the largest of one sign; towards a grazing light they differ by up to 90° the other way"
        ),
        ("metal",),
    ),
    Statement(
        "variation_near_grazing",
        "§5.1",
        "the larger variation of Fresnel function is usually closer to 90° than to 0",
        "F of gold, silver, copper, aluminium at eight wavelengths is steepest beyond 45°.",
        trial(variation_near_grazing),
        ("metal",),
    ),
    Statement(
        "equation_28",
        "eq. 28",
        "= cosⁿ α / g(Θ_min), where g(Θ_min) can be tabulated for the considered wavelengths",
        "A table of g gives eq. 28 to 1e-5.",
        trial(metal_by_table),
        ("metal",),
    ),
    Statement(
        "cheaper_than_any",
        "§5.1",
        "This computational cost is lower than that of any previously known metallic models.",
        "Whether a table of g is the cheapest metallic model of 1999.",
        undecided("a survey of all models, and a machine to measure them on, would be needed; see the timings"),
        ("metal",),
    ),
    Statement(
        "plastic_components",
        "eq. 29 and 30",
        "the BRDF has two components",
        "A Lambert and a stretched Phong part, η = 1.5, n = 20.",
        trial(components),
        ("plastic",),
    ),
    Statement(
        "specular_is_smaller",
        "§5.2",
        "their diffuse component is relevant and the specular part is responsible for the smaller part of the reflected power",
        "Below 60° the specular part of eq. 29 with η = 1.5 reflects less than a quarter.",
        trial(specular_is_smaller),
        ("plastic",),
    ),
    Statement(
        "highlights_are_white",
        "§5.2",
        "The highlights can be assumed to be white everywhere not only for greater incident angles.",
        "A real index varies little enough with the wavelength.",
        undecided("the paper gives no index of a plastic, nor what still counts as white"),
        ("plastic",),
    ),
    Statement(
        "plastic_energy",
        "§5.2, eq. 29",
        "In order to make the model conserve energy, a_s + a_d should not exceed 1.",
        "a_s + a_d ≤ 1 keeps the albedo at most 1.0004, as §2.2 neglects an overshoot: F = 1, a_s = 1, n = 1, 2, 100.",
        trial(plastic_balance),
        ("plastic",),
    ),
    Statement(
        "plastic_needs_it",
        "§5.2, eq. 30",
        "a_s ≤ 1 - max(r, g, b) should hold",
        "Beyond it energy is created.",
        trial(balance_needed),
        ("plastic",),
    ),
    Statement(
        "plastic_reciprocal",
        "§5.2, eq. 29",
        "Thus the BRDF has two components",
        "Eq. 29 is reciprocal; η = 1.5, n = 20.",
        checked("reciprocity", "PASS", "plastic", again=exchanged(coloured(1.5)), n=20),
        ("plastic",),
    ),
)
