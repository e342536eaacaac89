"""Statements of sections 1 to 3.1, up to eq. 4, and of the list of references: definitions, and the oldest models."""

from __future__ import annotations

import math
from math import pi

import numpy as np

from albedo_lab.estimate.quadrature import quadrature
from albedo_lab.estimate.record import Question, Tolerance
from albedo_lab.papers.recipes import Means, albedo_of
from albedo_lab.papers.record import Statement
from albedo_lab.papers.schlick1993.formulas import (
    A,
    Array,
    albedo,
    at,
    directions,
    eq15,
    halves,
)
from albedo_lab.papers.schlick1993.tried import EQUATIONS, MANY, row, told
from albedo_lab.papers.trials import CLOSED, Found, checked, subject_of, trial, undecided
from albedo_lab.pictures.evaluation import values


def white_furnace(means: Means) -> Found:
    """Lambert's 1/pi under a radiance of 1 from everywhere, by eq. 1."""
    ours = albedo(lambda c: np.full_like(c.t, 1.0 / pi), 0.5)
    again = albedo_of("lambert", 60.0)(means)
    return Found(abs(ours.value - 1.0) <= ours.half_width, f"L = {told(ours)}", ours.method, f"{told(again)} (model, quadrature)")


def both_orders(means: Means) -> Found:
    """The integral over V′ and the one over V, of a model that is symmetric and of one that is not."""
    told_of = {}
    for name, words in (("schlick", {"r": 0.2}), ("phong_original", {"n": 10.0})):
        of = subject_of(name, **words)
        a = [quadrature(Question(of.model, of.p, 0.5, 0.0, order), Tolerance(0.0, 1e-9)) for order in ("wi", "wo")]
        told_of[name] = [e.value * of.scale.value for e in a]
    (over, under), (first, second) = told_of["schlick"], told_of["phong_original"]
    plain = albedo(eq15(0.2), 0.5)
    ours = f"over V′ {over:.7f}, over V {under:.7f} (eq. 15); {first:.4f} and {second:.4f} (Phong's own, which eq. 2 excludes)"
    return Found(abs(over - under) < 1e-8, ours, "quadrature", f"{told(plain)} (eq. 15, {plain.method})")


def azimuth_against_the_normal(means: Means) -> Found:
    """The angle between H laid flat and N, for random pairs."""
    H = halves(directions(means.seed, MANY), directions(means.seed + 1, MANY))
    flat = H * [1.0, 1.0, 0.0]
    w = float(np.max(np.abs(flat @ [0.0, 0.0, 1.0])))
    along = float(np.ptp(flat[:, 0] / np.hypot(flat[:, 0], flat[:, 1])))
    again = f"A(0) = {float(A(0.2, np.zeros(1))[0]):.4f} = 1/√p for every H (p = 0.2): the same in all azimuths"
    return Found(w > 0.0, f"w = {w:g} for every H; against the scratch it spans {along:.4f}", EQUATIONS, again)


def same_from_both(means: Means) -> Found:
    """V.H against V′.H."""
    V, V_ = directions(means.seed, MANY), directions(means.seed + 1, MANY)
    H = halves(V, V_)
    apart = float(np.max(np.abs(np.sum((V - V_) * H, axis=-1))))
    turn = np.random.default_rng(means.seed).uniform(-pi, pi, MANY)
    c, c_ = at(0.3, 0.0, np.full(MANY, 0.6), turn), at(0.6, 0.0, np.full(MANY, 0.3), turn)
    again = f"cosines with V and V′ exchanged differ by {float(np.max(np.abs(c.u - c_.u))):.1g}"
    return Found(apart < 1e-14, f"V·H and V′·H differ by at most {apart:.1g}", "10 000 random pairs", again)


def turned(means: Means) -> Found:
    """Eq. 15 with the surface turned by a radian, isotropic and not."""
    turn = np.random.default_rng(means.seed).uniform(-pi, pi, MANY)
    spread = []
    for p in (1.0, 0.2):
        f, f_ = (eq15(0.2, p)(at(0.5, phi, np.full(MANY, 0.7), turn)) for phi in (0.3, 1.3))
        spread.append(float(np.max(np.abs(f / f_ - 1.0))))
    model = []
    for p in (1.0, 0.2):
        V, V_ = directions(means.seed, MANY), directions(means.seed + 1, MANY)
        c, s = math.cos(1.0), math.sin(1.0)
        R = np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])
        of = subject_of("schlick", r=0.2, p=p)
        model.append(float(np.max(np.abs(values(of, V, V_) / values(of, V @ R.T, V_ @ R.T) - 1.0))))
    ours = f"change by {spread[0]:.1g} (p = 1) and {spread[1]:.2f} (p = 0.2)"
    return Found(max(spread[0], model[0]) < 1e-9 < spread[1], ours, EQUATIONS, f"{model[0]:.1g} and {model[1]:.2f} (model)")


def equal_radiance(means: Means) -> Found:
    """Radiance of a constant BRDF towards many viewers, and power per solid angle."""
    V = directions(means.seed, MANY)
    f = values(subject_of("lambert"), np.broadcast_to(V[0], V.shape), V)
    spread = float(np.ptp(f) / f[0])
    again = f"π f is off 1 by {float(np.max(np.abs(f * pi - 1.0))):.1g}"
    return Found(spread == 0.0, f"radiance spreads by {spread:g}", "model, 10 000 viewers", again)


def only_t(means: Means) -> Found:
    """Pairs of directions mirrored at H's meridian and swung about H keep t: what f does."""
    rng = np.random.default_rng(means.seed)
    H, u, turn = directions(means.seed, 400), rng.uniform(0.75, 1.0, 400), rng.uniform(0.0, 2.0 * pi, (2, 400))
    across = np.cross(H, [1.0, 0.0, 0.0])
    across /= np.linalg.norm(across, axis=-1, keepdims=True)
    along = np.cross(across, H)

    def about(phi: Array) -> tuple[Array, Array]:
        side = np.sqrt(1.0 - u**2)[:, None] * (np.cos(phi)[:, None] * across + np.sin(phi)[:, None] * along)
        return u[:, None] * H + side, u[:, None] * H - side

    pairs = [about(phi) for phi in turn]
    up = np.min([w[:, 2] for pair in pairs for w in pair], axis=0) > 0.05
    spread = {}
    for name in ("blinn", "phong"):
        f, f_ = (values(subject_of(name, n=2.0, scale=1.0), a[up], b[up]) for a, b in pairs)
        spread[name] = float(np.max(np.abs(f - f_)))
    t, t_ = (halves(a[up], b[up])[:, 2] for a, b in pairs)
    again = f"t² itself differs by {float(np.max(np.abs(t**2 - t_**2))):.1g}"
    ours = f"pairs of the same t: Blinn's lobe differs by {spread['blinn']:.1g}, Phong's R·V by {spread['phong']:.2f}"
    return Found(spread["blinn"] < 1e-12, ours, f"models, n = 2, {int(up.sum())} pairs", again)


def diffuse_share(means: Means) -> Found:
    """The albedo of eq. 4 where all is diffuse and nothing absorbed."""
    ours = albedo_of("phong_blend", 30.0, as_printed="yes", d=1.0, D=1.0)(means)
    again = albedo(lambda c: np.ones_like(c.t), math.cos(math.radians(30.0)))
    return Found(abs(ours.value - 1.0) < 1e-6, f"a = {told(ours)}, π", "model, quadrature", f"{told(again)} ({again.method})")


def specular_share(means: Means) -> Found:
    """The albedo of t^n at normal incidence, 8 pi (2^(-n/2) + n) / ((n+2) (n+4))."""
    exponents = (1.0, 10.0, 100.0)
    ours = [(n, albedo_of("phong_blend", 0.0, as_printed="yes", d=0.0, S=1.0, n=n)(means).value) for n in exponents]
    again = [(n, 8.0 * pi * (2.0 ** (-0.5 * n) + n) / ((n + 2.0) * (n + 4.0))) for n in exponents]
    condition = all(abs(a - 1.0) < 1e-6 for _, a in ours)
    return Found(condition, f"a(0°) = {row('n =', ours)}", "model, quadrature", f"{row('n =', again)} ({CLOSED})")


CITED = "PHON75 BLIN77 COOK81 KAJI85 HE91 WARD92 BECK63 TORR67 SMIT67 CABR87 TAKA83 YOKO88 SHIR90 WYSZ67 PALI85 SCHL92"

LISTED = "BECK63 BLIN77 CABR87 COOK81 HE91 KAJI85 PALI85 PHON75 POUL90 SCHL92 SMIT67 TORR67 WARD92 WYSZ67 YOKO88"


def references(means: Means) -> Found:
    """The tags of the text against those of the list."""
    cited, listed = set(CITED.split()), set(LISTED.split())
    missing, idle = sorted(cited - listed), sorted(listed - cited)
    again = f"listed, not cited by its tag: {', '.join(idle)}"
    return Found(not missing, f"not in the list: {', '.join(missing)}", "tags of the text", again)


def kajiya(means: Means) -> Found:
    """The name of §3.2 against the list of references."""
    named, listed = "Kajiyama", "J.T.Kajiya"
    return Found(listed.endswith(named), f"{named}, KAJI85 is by {listed}", "list of references", f"“{named[-2:]}” too many")


DEFINITIONS = (
    Statement(
        "empirical_lack_validity",
        "§1; §4",
        "empirical models [PHON75] [BLIN77] … are lacking of physical validity … the reflected energy is sometimes greater "
        "than the "
        "incident one",
        "the model of eq. 4, as printed, with d = 0.5, D = S = 1, n = 100 creates energy",
        checked("energy", "FAIL", "phong_blend", as_printed="yes"),
        ("phong_blend",),
    ),
    Statement(
        "theoretical_needlessly_accurate",
        "§1",
        "theoretical models … usually unnecessarily accurate compared to the error generated by other stages of the rendering "
        "pipeline",
        "as printed",
        undecided("What is necessary depends on the picture and on who looks at it; the document gives no measure."),
        ("he_torrance",),
    ),
    Statement(
        "eq_1",
        "eq. 1",
        "L(P,V) = ∫ R(P,V,V′) L(P,-V′) (N·V′) dV′",
        "Lambert's R = 1/π under a radiance of 1 from every direction has a radiance of 1",
        trial(white_furnace),
        ("lambert",),
    ),
    Statement(
        "eq_2",
        "eq. 2",
        "due to the Helmholtz Reciprocity Rule, R is symmetric relative to V and V′",
        "as printed",
        undecided("A law of nature, which no computation of a model can try; which models obey it is tried one by one."),
    ),
    Statement(
        "eq_3",
        "eq. 3",
        "due to the Energy Conservation Law, R has to fulfill ∫ R (N·V′) dV′ ≤ 1",
        "where eq. 2 holds, the integral over V′ is the share of the light from V that is reflected",
        trial(both_orders),
        ("schlick", "phong_original"),
    ),
    Statement(
        "notation_u",
        "§2, notations",
        "β = ⟨V,H⟩, u = cos β",
        "V and V′ make the same angle with H, so that naming V alone does no harm",
        trial(same_from_both),
    ),
    Statement(
        "notation_w",
        "§2, notations",
        "φ = ⟨H̄,N⟩, w = cos φ",
        "the angle between N and H laid into the surface tells the azimuth of H",
        trial(azimuth_against_the_normal, "H laid into the surface is perpendicular to N: φ is always 90° and w always 0."),
        ("schlick",),
    ),
    Statement(
        "isotropic",
        "§3.1",
        "does not change while the surface is rotated around its normal vector at P (ie the BRDF does not depend on angle φ)",
        "eq. 15 turned about N: unchanged where w does not count (p = 1), changed where it does (p = 0.2)",
        trial(turned),
        ("schlick",),
    ),
    Statement(
        "lambertian",
        "§3.1",
        "lambertian surfaces … constant function (ie the light is equally reflected in every direction)",
        "a constant BRDF has the same radiance in every direction",
        trial(equal_radiance),
        ("lambert",),
    ),
    Statement(
        "eq_4_only_t",
        "§3.1, before eq. 4",
        "proposed by Phong [PHON75] and later slightly modified by Blinn [BLIN77]. In that model, the BRDF depends only on "
        "the cosine "
        "of angle α",
        "Blinn's lobe is a function of t alone (Phong's own, of the mirror direction, is not)",
        trial(only_t),
        ("blinn", "phong", "phong_blend"),
    ),
    Statement(
        "eq_4_diffuse",
        "eq. 4",
        "dD + sSt^n … D ∈ [0,1] is the ratio of light reflected by the diffuse reflector",
        "d = D = 1 reflects all light",
        trial(diffuse_share, "The constant term lacks 1/π, which eq. 5 and 8 have: it reflects π times the light."),
        ("phong_blend",),
    ),
    Statement(
        "eq_4_specular",
        "eq. 4",
        "S ∈ [0,1] is the ratio of light reflected by the specular reflector",
        "s = S = 1 reflects all light, at normal incidence",
        trial(specular_share, "Nothing normalises tⁿ: what it reflects falls like 8π/n."),
        ("phong_blend", "blinn"),
    ),
    Statement(
        "eq_4_brightness",
        "after eq. 4",
        "n ∈ [1,∞[ characterizes the brightness of the specular reflector",
        "as printed",
        undecided(
            "Which brightness is not said: with n the lobe narrows, its peak sS stays, and what it reflects falls like 8π/n "
            "(the statement before this)."
        ),
        ("phong_blend",),
    ),
    Statement(
        "first_theoretical_model",
        "§3.1, before eq. 5",
        "The first theoretical reflectance model has been introduced in the computer graphics field by Cook & Torrance [COOK81]",
        "as printed",
        undecided(
            "History: the document's own BLIN77 has Torrance and Sparrow's facets with F and G four years earlier; whether "
            "that is "
            "theoretical is a matter of words."
        ),
        ("cook_torrance", "blinn_trowbridge_reitz"),
    ),
    Statement(
        "kajiya",
        "§3.2",
        "presented by Kajiyama and Cabral et al.",
        "the name is that of the reference KAJI85",
        trial(kajiya, "The list of references has Kajiya."),
    ),
    Statement(
        "references",
        "References",
        "[TAKA83] … [SHIR90]",
        "every tag of the text has its entry in the list",
        trial(references, "Two tags lead nowhere; POUL90 is listed, and the text names its authors without the tag."),
    ),
)
