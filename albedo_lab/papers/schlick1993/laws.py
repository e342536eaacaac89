"""Statements of the abstract and of section 7: which formulation obeys which law, and what each does at grazing incidence."""

from __future__ import annotations

import ast
import inspect
from collections.abc import Callable
from fractions import Fraction
from math import cos, pi, radians
from typing import Any

from scipy.optimize import brentq

from albedo_lab.analysis.request import model_of
from albedo_lab.estimate.quadrature import quadrature
from albedo_lab.estimate.record import Question, Tolerance
from albedo_lab.optics.schlick1993 import mean_of_A
from albedo_lab.papers.recipes import Means, albedo_of
from albedo_lab.papers.record import GRAZING, Statement, Trial
from albedo_lab.papers.schlick1993 import formulas
from albedo_lab.papers.schlick1993.formulas import DIRECTIONAL, A, albedo, eq15, eq18, pairs, quarter_turn
from albedo_lab.papers.schlick1993.tried import EQUATIONS, over, row, spread
from albedo_lab.papers.trials import Found, behaves, checked, subject_of, trial

EVERY = "Every proposed formulation obeys to reciprocity and energy conservation laws"
NEARLY_0 = 1e-9
"""A cosine near enough to 0 for eq. 15 and 18."""
LAYERS: dict[str, dict[str, Any]] = {"single": {"r": 0.2}, "double": {"spectral": "fresnel"}}
NAMES = {"single": "SINGLE, eq. 10", "double": "DOUBLE, eq. 11"}


def grows(name: str) -> str:
    """Why eq. 12 or 17 creates energy."""
    return f"Eq. {name[2:]} has vv′ below the lobe and nothing above it: the albedo grows like 1/v towards grazing incidence."


BREAKS = {
    "eq12": grows("eq12"),
    "eq15": "At grazing incidence the lobe keeps its long tail and has 1/(4πr) before it: too much for a small r.",
    "eq17": grows("eq17"),
    "eq18": "At grazing incidence 1 - GG′ is 1: the diffuse term alone sends back all light, and the lobe is still there.",
}


def threshold(means: Means) -> Found:
    """The r below which the albedo of eq. 15 at grazing incidence exceeds 1; and the model on both sides of it."""
    r = brentq(lambda r: albedo(eq15(r), NEARLY_0).value - 1.0, 0.1, 0.3, xtol=1e-10)
    again = over((round(r - 0.001, 3), round(r + 0.001, 3)), lambda k: at_grazing(r=k, directional="eq15")(means))
    few = over((0.01, 0.05, 0.2), lambda k: albedo(eq15(k), NEARLY_0).value)
    ours = f"a(90°) = {row('r =', few, 5)}; 1 at r = {r:.6f}"
    return Found(few[0][1] <= 1.0, ours, "plain integration", f"{row('r =', again, 7)} (model at v = 1e-9)")


def at_grazing(**parameters: Any) -> Callable[[Means], float]:
    """The albedo of the model at the cosine NEARLY_0."""

    def found(means: Means) -> float:
        of = subject_of("schlick", **parameters)
        return quadrature(Question(of.model, of.p, NEARLY_0), Tolerance(0.0, 1e-9)).value * of.scale.value

    return found


def always_more(means: Means) -> Found:
    """Eq. 18 at grazing incidence: 1 more than eq. 15, for every r."""
    chosen = (0.01, 0.05, 0.2, 0.5, 1.0)
    ours = over(chosen, lambda r: albedo(eq18(r), NEARLY_0).value)
    again = over(chosen, lambda r: 1.0 + at_grazing(r=r, directional="eq15")(means))
    return Found(
        max(a for _, a in ours) <= 1.0,
        f"a(90°) = {row('r =', ours)}",
        "plain integration",
        f"1 + that of eq. 15 = {row('r =', again)} (model)",
    )


def brushed_eq15(means: Means) -> Found:
    """Eq. 15 with r = 0.2, p = 0.2 across the scratch: A as printed, and over its mean, which is what its condition asks."""
    ours = albedo(eq15(0.2, 0.2), NEARLY_0, 0.5 * pi).value
    corrected = ours / quarter_turn(lambda w: A(0.2, w))
    again = ours / mean_of_A(0.2)
    words = f"a(90°) = {ours:.6f} across the scratch as printed (r = p = 0.2); with A over its mean it would be {corrected:.6f}"
    return Found(ours <= 1.0, words, "plain integration", f"with A over its mean {again:.6f} (mean of A by agm)")


def inconsistent(means: Means) -> Found:
    """Albedos of all four formulations for a light that is far from grazing."""
    v = cos(radians(85.0))
    ours = [(int(name[2:]), albedo(f(0.05), v).value) for name, f in DIRECTIONAL.items()]
    again = [(int(name[2:]), albedo_of("schlick", 85.0, directional=name, r=0.05)(means).value) for name in DIRECTIONAL]
    return Found(
        max(a for _, a in ours) <= 1.0,
        f"a(85°) = {row('eq.', ours, 5)} (r = 0.05, C = 1)",
        "plain integration",
        f"{row('eq.', again, 5)} (model)",
    )


def facets_cover(means: Means) -> Found:
    """The area of all facets laid into the surface, which must be 1: the mean of A, as Z meets its own condition."""
    chosen = (1.0, 0.5, 0.2, 0.05)
    ours, again = over(chosen, lambda p: quarter_turn(lambda w: A(p, w))), over(chosen, mean_of_A)
    condition = all(abs(a - 1.0) < 1e-6 for _, a in ours)
    return Found(
        condition, f"facets cover {row('p =', ours, 4)} of the surface", "adaptive Gauss-Kronrod", f"{row('p =', again, 4)} (agm)"
    )


def continuum(means: Means) -> Found:
    """The four corners: Lambert at r = 1, p = 1 in some formulation, and a Dirac function of the azimuth as p falls."""
    lambert = {
        name: spread(f(1.0)(pairs(means.seed))) < 1.0 + 1e-9 and abs(albedo(f(1.0), 1.0).value - 1.0) < 1e-9
        for name, f in DIRECTIONAL.items()
    }
    mean = quarter_turn(lambda w: A(1e-4, w))
    diffuse = ", ".join(name[2:] for name, found in lambert.items() if found)
    ours = f"Lambert's 1/π at r = 1: eq. {diffuse} only; mean of A at p = 1e-4: {mean:.4f}"
    return Found(any(lambert.values()) and abs(mean - 1.0) < 1e-3, ours, EQUATIONS, f"{mean_of_A(1e-4):.4f} (agm)")


def few_parameters(means: Means) -> Found:
    """The numbers that both kinds of material take."""
    counts = []
    for layers in ("single", "double"):
        member, _ = model_of("schlick").member({"layers": layers})
        counts.append(len(member.parameters))
    return Found(
        counts == [3, 6], f"SINGLE {counts[0]}, DOUBLE {counts[1]}", "the model's record", "(C, r, p) and (C′, r′, p′) of §5.1"
    )


def arithmetic(means: Means) -> Found:
    """The operators and functions of eq. 11, 14 and 16 as they are written down here; and the same in fractions."""
    found = {}
    for name in ("S", "Z", "A", "G", "lobe", "seen", *DIRECTIONAL):
        tree = ast.parse(inspect.getsource(getattr(formulas, name)))
        found[name] = {n.func.attr for n in ast.walk(tree) if isinstance(n, ast.Call) and isinstance(n.func, ast.Attribute)}
    roots = {name for name, calls in found.items() if calls}
    half = Fraction(1, 2)
    rational: list[Any] = [f(Fraction(1, 5), half) for f in (formulas.S, formulas.Z, formulas.G)]  # type: ignore[arg-type]
    exact = all(isinstance(value, Fraction) for value in rational)
    condition = roots == {"A"} and found["A"] == {"sqrt"} and exact
    calls = f"{', '.join(sorted(found['A']))} in {', '.join(sorted(roots))}"
    ours = f"other functions than + - * /: {calls}; to have u from the directions takes a root, too"
    return Found(condition, ours, "syntax of the equations", f"S, Z, G of fractions are {', '.join(map(str, rational))}")


def by_formulation(law: str, make: Callable[[str, str], Trial], asks: str) -> tuple[Statement, ...]:
    """A statement for each of eq. 12, 15, 17 and 18 in one and in two layers."""
    return tuple(
        Statement(
            f"{law}_{name}_{layers}", f"§7; eq. 9, {name[2:]}, {NAMES[layers]}", EVERY, asks, make(name, layers), ("schlick",)
        )
        for layers in LAYERS
        for name in DIRECTIONAL
        if (law, name, layers) not in TRIED_ALONE
    )


TRIED_ALONE = {("reciprocity", "eq12", "single"), ("energy", "eq15", "single"), ("energy", "eq18", "single")}
"""By statements of their own."""


def reciprocal(name: str, layers: str) -> Trial:
    """The trial of reciprocity."""
    return checked("reciprocity", "PASS", "schlick", directional=name, layers=layers, **LAYERS[layers])


def conserving(name: str, layers: str) -> Trial:
    """The trial of energy balance."""
    return checked("energy", "PASS", "schlick", why=BREAKS[name], directional=name, layers=layers, **LAYERS[layers])


def grazing(name: str, place: str, printed: str, asks: str, tried: Trial, *models: str) -> Statement:
    """A row of the table of laws at grazing incidence."""
    return Statement(f"grazing_{name}", place, printed, asks, tried, models, GRAZING)


BOUNDED = "the albedo stays bounded as v → 0, as eq. 3 demands"
TABLE = (
    grazing(
        "eq4_printed",
        "eq. 4; §4",
        "they do not fulfill the normalization condition (Equation 3)",
        f"{BOUNDED}, though above 1 (as printed; d = 0.5, n = 100)",
        behaves("phong_blend", "bounded", as_printed="yes"),
        "phong_blend",
    ),
    grazing(
        "eq4",
        "eq. 4",
        "D (resp. S) ∈ [0,1] is the ratio of light reflected",
        f"{BOUNDED} (both terms normalised; d = 0.5, n = 100)",
        behaves("phong_blend", "bounded"),
        "phong_blend",
    ),
    grazing(
        "eq5_printed",
        "eq. 5 to 7",
        "G(v,v′) ∈ [0,1] is the geometrical attenuation coefficient",
        f"{BOUNDED} (eq. 7 as printed, m = 0.2, F = 1)",
        behaves("cook_torrance", "bounded", geometry="smith", as_printed="schlick1993", m=0.2),
        "cook_torrance",
    ),
    grazing(
        "eq5",
        "eq. 5 to 7",
        "by Equation 7 [SMIT67]",
        f"{BOUNDED} (Smith's masking of eq. 6, m = 0.2, F = 1)",
        behaves("cook_torrance", "bounded", geometry="smith", m=0.2),
        "cook_torrance",
    ),
    grazing(
        "eq8",
        "eq. 8; §4",
        "except the Helmholtz Reciprocity Rule (Equation 2) and the Energy Conservation Law (Equation 3)",
        f"{BOUNDED} (m = 0.2, n = 0.1)",
        behaves("ward", "bounded", why="√v below the lobe: the albedo grows like 1/√v.", m_x=0.2, m_y=0.1),
        "ward",
    ),
    *(
        grazing(
            f"{name}_{layers}",
            f"eq. 9, {name[2:]}, {NAMES[layers]}",
            EVERY,
            f"{BOUNDED} ({'r = 0.2, C = 1' if layers == 'single' else 'r = r′ = 0.1, C = 0.05, C′ = 1'})",
            behaves(
                "schlick",
                "bounded",
                why=grows(name) if name in ("eq12", "eq17") else "",
                directional=name,
                layers=layers,
                **LAYERS[layers],
            ),
            "schlick",
        )
        for layers in LAYERS
        for name in DIRECTIONAL
    ),
    grazing(
        "eq17_rough",
        "eq. 17",
        "This restriction can be removed by … a linear interpolation, according to the roughness factor",
        f"{BOUNDED} where nothing but Lambert's term is left (r = 1, C = 1), with the limit 1",
        behaves("schlick", "bounded", limit=1.0, directional="eq17", r=1.0),
        "schlick",
    ),
)

LAWS = (
    *by_formulation(
        "reciprocity", reciprocal, "f(V,V′) = f(V′,V) (SINGLE: r = 0.2, C = 1; DOUBLE: r = r′ = 0.1, C = 0.05, C′ = 1)"
    ),
    *by_formulation(
        "energy", conserving, "the albedo is nowhere above 1 (SINGLE: r = 0.2, C = 1; DOUBLE: r = r′ = 0.1, C = 0.05, C′ = 1)"
    ),
    Statement(
        "energy_eq15_single",
        "§7; eq. 9, 15",
        EVERY,
        "the albedo of eq. 15 at grazing incidence is at most 1 for every r (p = 1, C = 1)",
        trial(threshold, BREAKS["eq15"]),
        ("schlick",),
    ),
    Statement(
        "energy_eq15_brushed",
        "§7; eq. 9, 15",
        EVERY,
        "the albedo of eq. 15 at grazing incidence is at most 1 across the scratch, too, A as printed (r = p = 0.2, C = 1)",
        trial(brushed_eq15),
        ("schlick",),
    ),
    Statement(
        "energy_eq18_single",
        "§7; eq. 9, 18",
        EVERY,
        "the albedo of eq. 18 at grazing incidence is at most 1 (p = 1, C = 1, every r of figure 6)",
        trial(always_more, BREAKS["eq18"]),
        ("schlick",),
    ),
    Statement(
        "inconsistent_avoided",
        "§7",
        "and therefore physically inconsistent results are avoided",
        "no formulation sends back more than it receives at 85° (r = 0.05, C = 1)",
        trial(inconsistent, "All four do."),
        ("schlick",),
    ),
    Statement(
        "microfacet_theory",
        "abstract; §4",
        "it obeys to the main laws of physics (Energy conservation law, Helmholtz reciprocity rule, Microfacet theory, "
        "Fresnel equation)",
        "microfacet theory: the facets with density ZA/π, laid into the surface, cover it once, for every p",
        trial(facets_cover, "With A of eq. 14 they do for p = 1 only (see eq_14_A)."),
        ("schlick",),
    ),
    Statement(
        "continuum",
        "§7; §4",
        "A two dimensional continuum is insured both between perfect diffuse and perfect specular, and between perfect "
        "isotropy and perfect "
        "anisotropy",
        "some formulation is Lambert's at r = p = 1, and A becomes a Dirac function as p → 0",
        trial(continuum, "Eq. 17 has the first; A vanishes instead of becoming a Dirac function (see p_0_dirac)."),
        ("schlick",),
    ),
    Statement(
        "few_parameters",
        "§7; abstract",
        "Very few parameters are used to define a material",
        "SINGLE takes three numbers, DOUBLE six (a wavelength)",
        trial(few_parameters),
        ("schlick",),
    ),
    Statement(
        "arithmetic_only",
        "§7",
        "only basic arithmetic operators (+ - * /), except a square root for anisotropy",
        "eq. 10 to 18, of t, u, v, v′ and w, hold no other operation",
        trial(arithmetic),
        ("schlick",),
    ),
    *TABLE,
)
