"""Statements of the sections on Lambert's, Oren and Nayar's and Minnaert's equations."""

from __future__ import annotations

from math import cos, pi, radians

import numpy as np

from albedo_lab.papers.losasso.equations import (
    Array,
    direction,
    hemisphere,
    lambert,
    minnaert,
    oren_nayar,
    reflected,
    rough_A,
    rough_B,
)
from albedo_lab.papers.losasso.tried import MANY, PRINTED, lit, share, swapped, told
from albedo_lab.papers.recipes import Means
from albedo_lab.papers.record import Statement
from albedo_lab.papers.trials import CLOSED, Found, checked, same, subject_of, trial, unclaimed, undecided
from albedo_lab.pictures.evaluation import values

LAMBERT = "The Lambertian Lighting Models"
OREN_NAYAR = "The Oren-Nayar Lighting Model"
MINNAERT = "The Minnaert Lighting Model"
ROUGH, MINNAERT_K = 0.5, 0.5
"""The sigma (radians) and the k that are tried where the document names none."""


def equal_in_all_directions(means: Means) -> Found:
    """Radiance of Lambert's law for one light and many viewers."""
    E = hemisphere(means.seed, MANY)
    L = np.broadcast_to(direction(0.7), E.shape)
    f = values(subject_of("lambert"), L, E)
    spread = float(np.ptp(f) / f[0])
    again = float(np.ptp(lambert(L, E)) / lambert(L, E)[0])
    return Found(spread == 0.0 == again, f"relative spread {spread:g} over {MANY} viewers", "the model", f"{again:g} (equation)")


def cosine_law(means: Means) -> Found:
    """A unit square's shadow across the beam: by its area, and by counting rays that meet it."""
    theta = radians(60.0)
    # across the beam: one axis along the tilted side, which is foreshortened, one along the other
    shadow = float(np.linalg.norm(np.cross(*np.eye(3)[:2])) * direction(theta) @ np.eye(3)[2])
    rays = np.random.default_rng(means.seed).uniform(-1.0, 1.0, (200_000, 2))
    hits = 4.0 * float(np.mean((np.abs(rays[:, 0] / cos(theta)) <= 0.5) & (np.abs(rays[:, 1]) <= 0.5)))
    condition = abs(shadow - cos(theta)) < 1e-12 and abs(hits - cos(theta)) < 0.02
    return Found(condition, f"share caught at 60°: {shadow:.6f}, cos θ = {cos(theta):.6f}", CLOSED, f"{hits:.2f} of random rays")


def less_at_an_angle(means: Means) -> Found:
    """Every viewer sees less of a light at 75 than of one at 15 degrees."""
    E = hemisphere(means.seed, MANY)
    ratio = np.empty((2, MANY))
    near, far = (np.broadcast_to(direction(radians(a)), E.shape) for a in (15.0, 75.0))
    ratio[0] = lambert(far, E) / lambert(near, E)
    model = subject_of("lambert")
    ratio[1] = values(model, far, E) * far[:, 2] / (values(model, near, E) * near[:, 2])
    ours, again = (f"{float(r.max()):.6f}" for r in ratio)
    return Found(float(ratio.max()) < 1.0, f"I(75°) / I(15°) = {ours} towards every viewer", "the equation", f"{again} (model)")


def years_of_lambert(means: Means) -> Found:
    """Photometria appeared in 1760, the hardware of the text, nv30, in 2003."""
    return Found(2003 - 1760 > 100, f"{2003 - 1760} years", "Photometria, 1760; nv30, 2003", "—")


def ad_hoc(means: Means) -> Found:
    """Lambert's law is older than computers."""
    return Found(
        1760 > 1945,
        "1760",
        "date of Lambert's Photometria",
        "the document itself: “Lambert created this model over a century ago”",
    )


def smooth_limit(means: Means) -> Found:
    """sigma = 0 leaves Lambert's law, whatever the directions; the factor 1/pi is tried by another statement."""
    L, E = hemisphere(means.seed, MANY), hemisphere(means.seed + 1, MANY)
    apart = float(np.max(np.abs(pi * oren_nayar(0.0)(L, E) / lambert(L, E) - 1.0)))
    f = values(subject_of("oren_nayar", sigma=0.0), L, E)
    again = float(np.max(np.abs(pi * f - 1.0)))
    ours = f"π I / (N·L) is 1 within {apart:.1g}"
    return Found(max(apart, again) < 1e-12, ours, "the equation, σ = 0", f"π f is 1 within {again:.1g} (model)")


def by_vectors(L: Array, E: Array, sigma: float | Array) -> Array:
    """The same equation without an angle: cos(dphi) sin(alpha) tan(beta) = (L_x E_x + L_y E_y) / max(L_z, E_z)."""
    along = np.maximum(0.0, L[..., 0] * E[..., 0] + L[..., 1] * E[..., 1]) / np.maximum(L[..., 2], E[..., 2])
    return np.asarray(L[..., 2] / pi * (rough_A(sigma) + rough_B(sigma) * along))


def without_angles(means: Means) -> Found:
    """Angles are needed where the same function cannot be had without them."""
    L, E = hemisphere(means.seed, MANY), hemisphere(means.seed + 1, MANY)
    angles = oren_nayar(ROUGH)(L, E)
    apart = float(np.max(np.abs(by_vectors(L, E, ROUGH) / angles - 1.0)))
    model = values(subject_of("oren_nayar", sigma=ROUGH), L, E) * L[:, 2]
    again = float(np.max(np.abs(model / angles - 1.0)))
    ours = f"dot products alone give the same I within {apart:.1g}, relatively"
    return Found(apart > 1e-9, ours, "vectors against angles, 10 000 pairs", f"{again:.1g} (model, which uses no angle)")


def interreflections(means: Means) -> Found:
    """What the full model reflects more at normal incidence, against its interreflection term integrated by hand."""
    rho, s = 1.0, ROUGH**2
    full = share("oren_nayar", 0.0, 1.0, form="full", sigma=ROUGH)
    simple = share("oren_nayar", 0.0, 1.0, sigma=ROUGH)
    term = 0.17 * rho * s / (s + 0.13)
    gain = full.value - simple.value
    condition = abs(gain - term) < 1e-6 and term > 0.0
    ours = f"left out at θ = 0, σ = 0.5: {gain:.6f} of the light"
    return Found(condition, ours, "quadrature, full less simplified model", f"0.17 σ² / (σ² + 0.13) = {term:.6f} (closed form)")


def alike_at_low_angles(means: Means) -> Found:
    """At normal incidence the intensity is A times Lambert's, for every viewer."""
    E = hemisphere(means.seed, MANY)
    L = np.broadcast_to(direction(0.0), E.shape)
    ratio = pi * oren_nayar(ROUGH)(L, E) / lambert(L, E)
    f = pi * values(subject_of("oren_nayar", sigma=ROUGH), L, E)
    condition = float(np.ptp(ratio)) < 1e-12 and float(np.ptp(f)) < 1e-12
    ours = f"I over Lambert's: {ratio[0]:.6f} = A towards every viewer (σ = 0.5)"
    return Found(condition, ours, "the equation, θ = 0", f"{f[0]:.6f} (model)")


def flatter_at_high_angles(means: Means) -> Found:
    """A ball lit from the eye: its radiance at 80 degrees over that in its middle."""
    w = direction(np.radians([0.0, 80.0]))
    rough, flat = oren_nayar(ROUGH)(w, w), lambert(w, w)
    f = values(subject_of("oren_nayar", sigma=ROUGH), w, w) * w[:, 2]
    ratios = [float(i[1] / i[0]) for i in (rough, flat, f)]
    ours = f"I(80°) / I(0°) = {ratios[0]:.4f}, Lambert's {ratios[1]:.4f}"
    return Found(ratios[0] > ratios[1], ours, "the equation, light at the eye, σ = 0.5", f"{ratios[2]:.4f} (model)")


def twice_an_albedo(means: Means) -> Found:
    """k_d = 1 and rho = 1: the share reflected at normal incidence."""
    ours = share("oren_nayar", 0.0, 1.0, sigma=ROUGH)
    again = reflected(oren_nayar(ROUGH), 0.0, 1.0)
    return Found(abs(ours.value - 1.0) < 1e-6, f"{told(ours)} for k_d = ρ = 1, σ = 0.5", "quadrature", f"{again:.6f} ({PRINTED})")


def combined_exponent(means: Means) -> Found:
    """(N.L) (N.L)^k = (N.L)^(k+1)."""
    L, E = hemisphere(means.seed, MANY), hemisphere(means.seed + 1, MANY)
    k = MINNAERT_K
    apart = float(np.max(np.abs(L[:, 2] ** (k + 1.0) * (1.0 - E[:, 2]) ** (1.0 - k) / minnaert(k)(L, E) - 1.0)))
    model = values(subject_of("minnaert", as_printed="yes", k=k), L, E) * L[:, 2] * pi
    again = float(np.max(np.abs(model / minnaert(k)(L, E) - 1.0)))
    return Found(apart < 1e-12, f"relative difference {apart:.1g}", "the equation, k = 0.5", f"{again:.1g} (model)")


def darkening(means: Means) -> Found:
    """The factor (N.L)^k (1 - N.E)^(1-k) over random directions and k in [0, 1]."""
    L, E = hemisphere(means.seed, MANY), hemisphere(means.seed + 1, MANY)
    largest = max(float(np.max(minnaert(k)(L, E) / lambert(L, E))) for k in np.linspace(0.0, 1.0, 11))
    f = max(float(np.max(values(subject_of("minnaert", as_printed="yes", k=k), L, E))) * pi for k in (0.0, 0.5, 1.0))
    return Found(largest <= 1.0, f"largest factor {largest:.4f} for 0 ≤ k ≤ 1", "the equation", f"{f:.4f} (model)")


def limb(means: Means) -> Found:
    """The print's darkening factor for the eye in the middle and at the limb, and Minnaert's own with k = 1.5."""
    E, L = direction(np.radians([10.0, 80.0])), direction(np.radians([45.0, 45.0]))
    printed = minnaert(MINNAERT_K)(L, E)
    model = values(subject_of("minnaert", as_printed="yes", k=MINNAERT_K), L, E)
    own = values(subject_of("minnaert", k=1.5), L, E)
    ratios = [float(i[1] / i[0]) for i in (printed, model, own)]
    ours = f"I(E at 80°) / I(E at 10°) = {ratios[0]:.3f} for k = 0.5"
    again = f"{ratios[1]:.3f} (model); Minnaert's law with k = 1.5 has {ratios[2]:.3f}"
    return Found(ratios[0] < 1.0, ours, "the equation, light at 45°", again)


def dark_from_above(means: Means) -> Found:
    """The eye at the normal."""
    L, E = direction(radians(45.0))[None, :], direction(np.array([1e-9]))
    printed = float(minnaert(MINNAERT_K)(L, direction(np.array([0.0])))[0])
    near = float(values(subject_of("minnaert", as_printed="yes", k=MINNAERT_K), L, E)[0])
    return Found(printed == 0.0, f"I = {printed:g} at N·E = 1", "the equation, k = 0.5", f"f = {near:.2g} at 1e-9 rad (model)")


def becomes_lamberts(means: Means) -> Found:
    """The least spread of I / (N.L) over the hemisphere that any k in [0, 1] leaves."""
    L, E = hemisphere(means.seed, MANY), hemisphere(means.seed + 1, MANY)

    def spread(factor: Array) -> float:
        return float(np.std(factor) / np.mean(factor))

    k = np.linspace(0.0, 1.0, 101)
    spreads = [spread(minnaert(float(each))(L, E) / lambert(L, E)) for each in k]
    best = int(np.argmin(spreads))
    own = spread(values(subject_of("minnaert", k=1.0), L, E))
    ours = f"I / (N·L) varies by {spreads[best]:.2f} of its mean at best, k = {k[best]:.2f}"
    return Found(spreads[best] < 1e-9, ours, "the equation, 101 values of k", f"Minnaert's own law with k = 1: {own:.1g} (model)")


def minnaert_share(means: Means) -> Found:
    """Of light from theta: 2 (N.L)^k ∫ (1 - z)^(1-k) z dz = 2 (N.L)^k / ((2-k) (3-k)), most at normal incidence."""
    largest = max(2.0 / ((2.0 - k) * (3.0 - k)) for k in np.linspace(0.0, 1.0, 101))
    k = MINNAERT_K
    ours = f"at most {largest:.6f} of the light, for k = 1; {2.0 / ((2.0 - k) * (3.0 - k)):.6f} for k = 0.5"
    again = f"{told(share('minnaert', 0.0, 1.0, as_printed='yes', k=k))} for k = 0.5 (quadrature); {lit(minnaert(k), pi)}"
    return Found(largest <= 1.0, ours, CLOSED, again)


def two_variables(means: Means) -> Found:
    """Azimuths turned at random change nothing."""
    rng = np.random.default_rng(means.seed)
    theta, turn = np.arccos(rng.uniform(0.02, 1.0, (2, MANY))), rng.uniform(0.0, 2.0 * pi, (4, MANY))
    first = minnaert(MINNAERT_K)(direction(theta[0], turn[0]), direction(theta[1], turn[1]))
    second = minnaert(MINNAERT_K)(direction(theta[0], turn[2]), direction(theta[1], turn[3]))
    f = subject_of("minnaert", as_printed="yes", k=MINNAERT_K)
    pair = [values(f, direction(theta[0], turn[i]), direction(theta[1], turn[i + 1])) for i in (0, 2)]
    apart, again = (float(np.max(np.abs(a / b - 1.0))) for a, b in ((first, second), (pair[0], pair[1])))
    ours = f"I depends on N·L and N·E alone: {apart:.1g} of change under turns"
    return Found(apart < 1e-9, ours, "the equation, random azimuths", f"{again:.1g} (model)")


STATEMENTS = (
    Statement(
        "lambert_equal_in_all_directions",
        LAMBERT,
        "the light is reflected equally in all directions",
        "The radiance that Lambert's law reflects is the same for every viewer.",
        trial(equal_in_all_directions),
        ("lambert",),
    ),
    Statement(
        "cosine_of_the_incident_angle",
        LAMBERT,
        "The light that strikes any given part of a surface is proportional to the cosine of the incident angle",
        "A unit square tilted by 60° catches cos 60° of a parallel beam.",
        trial(cosine_law),
    ),
    Statement(
        "lambert_over_a_century_ago",
        LAMBERT,
        "Lambert created this model over a century ago",
        "Photometria is more than a hundred years older than the hardware that the document speaks of.",
        trial(years_of_lambert),
        ("lambert",),
    ),
    Statement(
        "lambert_less_at_an_angle",
        f"{LAMBERT}, on its figure",
        "when the light is coming from an angle, the amount of light reflected in all directions is less",
        "For every viewer, I is less for a light at 75° than for one at 15°.",
        trial(less_at_an_angle),
        ("lambert",),
    ),
    Statement(
        "lambert_rough_plastic",
        LAMBERT,
        "it does give the appearance that the lit object is made of rough plastic",
        "A Lambertian object looks like rough plastic.",
        undecided("What a picture looks like is for a beholder; the document states no test."),
    ),
    Statement(
        "lambert_most_used",
        LAMBERT,
        "it is still the most used model (by a huge margin) in real time graphics today",
        "More real-time programs use Lambert's law than any other.",
        undecided("A count of programs of that time, of which the text says nothing."),
    ),
    Statement(
        "models_above_ad_hoc",
        "The Cook-Torrance Lighting Model",
        "the models above that are made entirely ad-hoc for computer graphics only",
        "The models above, Lambert's and Phong's, were made for computer graphics.",
        unclaimed(
            trial(ad_hoc),
            "True of Phong's model; Lambert's law is photometry of 1760. The sentence does not say whether it means both.",
        ),
        ("lambert",),
    ),
    Statement(
        "oren_nayar_generalizes_lambert",
        OREN_NAYAR,
        "a new BRDF in the hope to ‘generalize’ the Lambertian diffuse lighting model",
        "With σ = 0 the equation is Lambert's cosine for every pair of directions, up to a constant.",
        trial(smooth_limit),
        ("oren_nayar", "lambert"),
    ),
    Statement(
        "oren_nayar_equation",
        f"{OREN_NAYAR}, equation",
        "I = k_d f_att ρ/π E₀ cos(θ_i) (A + B max[0, cos(φ_r − φ_i)] sin(α) tan(β)); A = 1.0 − 0.5 σ²/(σ² + 0.33); B = "
        "0.45 σ²/(σ² + 0.09)",
        "The equation is the qualitative model of Oren and Nayar (1994), with α the larger and β the smaller of θ_i and θ_r.",
        same(
            lambda a, b, u, v, sigma: oren_nayar(sigma)(direction(a, u), direction(b, v)),
            lambda a, b, u, v, sigma: by_vectors(direction(a, u), direction(b, v), sigma),
            (0.0, 1.55),
            (0.0, 1.55),
            (0.0, 2.0 * pi),
            (0.0, 2.0 * pi),
            (0.0, 1.5),
            again=lambda means: (
                f"share reflected at 60°, σ = 0.5: {reflected(oren_nayar(0.5), radians(60.0), 1.0):.5f} ({PRINTED}), "
                f"{told(share('oren_nayar', 60.0, 1.0, sigma=0.5))} (quadrature of the model)"
            ),
            within=1e-9,
        ),
        ("oren_nayar",),
    ),
    Statement(
        "oren_nayar_needs_angles",
        OREN_NAYAR,
        "it requires the calculation of azimuth and zenith angles",
        "The simplified model cannot be evaluated from dot products alone.",
        trial(without_angles, "cos(φ_r − φ_i) sin α tan β = (L·E − (N·L)(N·E)) / max(N·L, N·E): no angle is needed."),
        ("oren_nayar",),
    ),
    Statement(
        "oren_nayar_ignores_interreflections",
        OREN_NAYAR,
        "It ignores terms like inter-reflections",
        "What the simplified model lacks at normal incidence is the interreflection term of the full one.",
        trial(interreflections),
        ("oren_nayar",),
    ),
    Statement(
        "oren_nayar_low_angles",
        f"{OREN_NAYAR}, on its figure",
        "At low angles of light incidence, the Oren-Nayar approximation is similar to the Lambertian model",
        "At normal incidence it is Lambert's law times a constant.",
        trial(alike_at_low_angles),
        ("oren_nayar", "lambert"),
    ),
    Statement(
        "oren_nayar_high_angles",
        f"{OREN_NAYAR}, on its figure",
        "at high angles of incidence, the result is flatter, making the edges brighter",
        "On a ball lit from the eye, the radiance at 80° over that in the middle is larger than Lambert's.",
        trial(flatter_at_high_angles),
        ("oren_nayar", "lambert"),
    ),
    Statement(
        "oren_nayar_k_d_and_rho",
        f"{OREN_NAYAR}, equation, and appendix A",
        "k_d: The fraction of light that is reflected through diffuse reflection",
        "With k_d = 1 (and ρ = 1) all of the light is reflected, for E₀ cos θ_i of irradiance and σ = 0.5.",
        unclaimed(
            trial(twice_an_albedo),
            "ρ is explained nowhere. If it is the albedo of the facets, as Oren and Nayar have it, k_d is a second one, and what "
            "is reflected is A k_d ρ at normal incidence; if k_d ρ is the albedo, nothing is wrong.",
        ),
        ("oren_nayar",),
    ),
    Statement(
        "oren_nayar_energy",
        f"{OREN_NAYAR}, equation",
        "I = k_d f_att ρ/π E₀ cos(θ_i) (A + B max[0, cos(φ_r − φ_i)] sin(α) tan(β))",
        "The simplified model creates no energy: σ = 0.5, ρ = 1.",
        checked("energy", "PASS", "oren_nayar", sigma=0.5, again=lambda means: lit(oren_nayar(0.5))),
        ("oren_nayar",),
    ),
    Statement(
        "oren_nayar_reciprocal",
        f"{OREN_NAYAR}, equation",
        "I = k_d f_att ρ/π E₀ cos(θ_i) (A + B max[0, cos(φ_r − φ_i)] sin(α) tan(β))",
        "I over cos(θ_i) is the same with light and eye exchanged.",
        checked("reciprocity", "PASS", "oren_nayar", sigma=0.5, again=lambda means: swapped(oren_nayar(0.5), means)),
        ("oren_nayar",),
    ),
    Statement(
        "oren_nayar_surfaces",
        OREN_NAYAR,
        "This BRDF can reproduce several rough surfaces very well, including wall plaster, sand, sand paper, clay",
        "The model fits measurements of these surfaces.",
        undecided("Neither the document nor a data set at hand holds measurements of them."),
        ("oren_nayar",),
    ),
    Statement(
        "oren_nayar_vase",
        OREN_NAYAR,
        "It is glaringly obvious from that demonstration that the Lambertian model was not suitable",
        "The photograph of Oren and Nayar's clay vase is nearer to their model than to Lambert's.",
        undecided("The photograph is not part of the document."),
        ("oren_nayar", "lambert"),
    ),
    Statement(
        "minnaert_equation_reciprocal",
        f"{MINNAERT}, equation",
        "I = k_d f_att (N·L) * (N·L)^k (1 − N·E)^(1−k)",
        "I over N·L is the same with light and eye exchanged, as Minnaert's principle demands; k = 0.5.",
        checked(
            "reciprocity",
            "PASS",
            "minnaert",
            as_printed="yes",
            k=MINNAERT_K,
            again=lambda means: swapped(minnaert(MINNAERT_K), means),
            why="Minnaert made his law from the principle of reciprocity: (N·L)^k (N·E)^(k−1). 1 − N·E stands where N·E must.",
        ),
        ("minnaert",),
    ),
    Statement(
        "minnaert_equation_lambert",
        f"{MINNAERT}, equation",
        "I = k_d f_att (N·L) * (N·L)^k (1 − N·E)^(1−k)",
        "Some k makes it Lambert's law, as k = 1 does with Minnaert's own.",
        trial(becomes_lamberts, "k = 1 gives (N·L)², k = 0 gives (N·L)(1 − N·E): the print has N·L once too often."),
        ("minnaert", "lambert"),
    ),
    Statement(
        "minnaert_energy",
        f"{MINNAERT}, equation",
        "I = k_d f_att (N·L) * (N·L)^k (1 − N·E)^(1−k)",
        "The print creates no energy under an irradiance π N·L, which makes k_d Lambert's share, for 0 ≤ k ≤ 1.",
        trial(minnaert_share),
        ("minnaert",),
    ),
    Statement(
        "minnaert_combined_exponent",
        f"{MINNAERT}, after its equation",
        "the first dot product can be combined with the second making the exponent k+1",
        "(N·L)^(k+1) (1 − N·E)^(1−k) is the same function.",
        trial(combined_exponent),
        ("minnaert",),
    ),
    Statement(
        "minnaert_darkening_factor",
        f"{MINNAERT}, after its equation",
        "The first part of the equation is simply Lambertian lighting, which is then modulated by the darkening factor",
        "What multiplies Lambert's N·L is at most 1 for 0 ≤ k ≤ 1.",
        trial(darkening),
        ("minnaert",),
    ),
    Statement(
        "minnaert_darkening_limbs",
        f"{MINNAERT}, first sentence",
        "Minnaert added darkening limbs to the lighting equations to make the surface seem darker",
        "Seen towards the limb (E at 80°) the surface is darker than in the middle (E at 10°), under the same light; k = 0.5.",
        trial(
            limb,
            "The print is darkest where the eye faces the surface and brightest at the limb: (1 − N·E)^(1−k) goes to 1 there.",
        ),
        ("minnaert",),
    ),
    Statement(
        "minnaert_dark_from_above",
        f"{MINNAERT}, on its figure",
        "the amount of light reflected towards zero when the viewer looks onto the surface at perpendicular angles",
        "The printed equation goes to 0 as N·E goes to 1, for k < 1.",
        trial(dark_from_above),
        ("minnaert",),
    ),
    Statement(
        "minnaert_texture",
        MINNAERT,
        "can easily be optimized through the use of a texture lookup",
        "For a given k, a table of two variables holds the equation.",
        trial(two_variables),
        ("minnaert",),
    ),
    Statement(
        "minnaert_velvet",
        MINNAERT,
        "This effect is seen in some types of clothing (such as velvet)",
        "Velvet reflects as the printed equation has it.",
        undecided(
            "The document holds no measurement of velvet. That velvet is brightest at its limb is the print's behaviour, "
            "not its words'."
        ),
        ("minnaert",),
    ),
)
