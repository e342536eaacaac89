"""Every sentence of the documents about time or cost, each with the measured ratio or the count that judges it."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from math import inf
from typing import Any

from albedo_lab.analysis.operations import COMPARE, FUNCTION, OPERATIONS, operations
from albedo_lab.analysis.timing import LIGHT, VIEWER
from albedo_lab.estimate.quadrature import quadrature
from albedo_lab.estimate.record import Question, Tolerance
from albedo_lab.models import cook_torrance
from albedo_lab.optics import fresnel, masking, normals, schlick1993
from albedo_lab.optics.frame import bisector
from albedo_lab.papers.timing import CONTENDERS, Costs
from albedo_lab.papers.verdict import Kind


@dataclass(frozen=True, slots=True)
class Judged:
    """A verdict with what was measured, and why where that does not say it."""

    kind: Kind
    ours: str
    why: str = ""


Trial = Callable[[Costs], Judged]


@dataclass(frozen=True)
class CostClaim:
    """A sentence about time or cost; `asks` is the proposition on trial, put as a ratio or as a count."""

    name: str
    document: str
    place: str
    printed: str
    asks: str
    trial: Trial


def dearer(*each: tuple[str, str], low: float = 1.0, high: float = inf, wavelengths: int = 1, why: str = "") -> Trial:
    """Whether, pair by pair, the first takes `low` to `high` times as long as the second; undecided within the rounds' spread."""

    def trial(costs: Costs) -> Judged:
        found = {pair: costs.ratio(*pair, wavelengths) for pair in each}
        words = "; ".join(f"{a} / {b} = {r.value:.3g} ({r.low:.3g} to {r.high:.3g})" for (a, b), r in found.items())
        if all(r.low >= low and r.high <= high for r in found.values()):
            return Judged(Kind.HOLDS, words)
        if any(r.high < low or r.low > high for r in found.values()):
            return Judged(Kind.REFUTED, words, why)
        return Judged(Kind.UNDECIDED, words, "the rounds differ by more than what decides")

    return trial


def count(counted: Counter[str]) -> str:
    """Operations in words: "5 add, 3 multiply"."""
    return ", ".join(f"{counted[kind]} {kind}" for kind in OPERATIONS if counted[kind]) or "none"


def counts(condition: Callable[[list[Counter[str]]], bool], formulas: Mapping[str, tuple[Any, ...]], why: str = "") -> Trial:
    """A proposition about the operations of formulas, each given with its arguments."""

    def trial(costs: Costs) -> Judged:
        found = {name: operations(*call) for name, call in formulas.items()}
        words = "; ".join(f"{name}: {count(counted)}" for name, counted in found.items())
        holds = condition(list(found.values()))
        return Judged(Kind.HOLDS if holds else Kind.REFUTED, words, "" if holds else why)

    return trial


def unknown(why: str) -> Trial:
    """A sentence that cannot be decided here."""
    return lambda costs: Judged(Kind.UNDECIDED, "—", why)


def unclaimed(tried: Trial, why: str) -> Trial:
    """What a trial measures, without its verdict: the sentence is not about what can be measured here, and `why` says how."""
    return lambda costs: replace(tried(costs), kind=Kind.UNDECIDED, why=why)


def work(counted: Counter[str]) -> int:
    """All operations together."""
    return sum(counted.values())


def much_less(found: list[Counter[str]]) -> bool:
    """The second needs at most half of the operations of the first, and no more functions."""
    first, second = found
    return 2 * work(second) <= work(first) and second[FUNCTION] <= first[FUNCTION]


def basic(found: list[Counter[str]]) -> bool:
    """Nothing but + - * /; roots and comparisons count as more."""
    return all(counted["root"] + counted[FUNCTION] + counted[COMPARE] == 0 for counted in found)


def all_at_once(costs: Costs) -> Judged:
    """How many evaluations an integral over all lights takes, by quadrature to 1 %."""
    member, p = CONTENDERS["facets_ggx"].member
    times = quadrature(Question(member, p, 0.5), Tolerance(0.0, 0.01)).samples
    ns = costs.nanoseconds("facets_ggx")
    words = f"one evaluation {ns:.3g} ns; one integral to 1 % {times} evaluations"
    return Judged(Kind.HOLDS if times >= LEAST else Kind.REFUTED, words)


def an_eye(costs: Costs) -> Judged:
    """The same model with and without an exponential."""
    r = costs.ratio("facets_beckmann", "facets_ggx")
    words = f"facets_beckmann / facets_ggx = {r.value:.3g} ({r.low:.3g} to {r.high:.3g})"
    return Judged(Kind.UNDECIDED, words, "“An eye” has no measure.")


V = bisector(LIGHT, VIEWER)
LEAST = 100
OPENGL = "It needs graphics hardware and a driver of its time; no such machine is at hand."
HE = ("he_torrance", "phong")


def counted(costs: Costs, simpler: str, complex_: str) -> Judged:
    """Whether one contender executes at least twice as many operations as another."""
    few, many = (costs.operations[name] for name in (simpler, complex_))
    holds = work(many) >= 2 * work(few)
    return Judged(Kind.HOLDS if holds else Kind.REFUTED, f"{simpler}: {count(few)}; {complex_}: {count(many)}")


def sampling(costs: Costs) -> Judged:
    """Operations of the three samplers, of models of the catalogue."""
    found = {}
    for name in ("stretched_phong", "blinn", "ward"):
        member, p = CONTENDERS[name].member
        assert member.sample is not None
        found[name] = operations(member.sample, p, VIEWER, 0.4, 0.3)
    words = "; ".join(f"{name}: {count(each)}" for name, each in found.items())
    new, *others = map(work, found.values())
    holds = all(new < other for other in others)
    why = "" if holds else "A lobe about the mirror direction needs a frame about it; the others mirror at a drawn half-vector."
    return Judged(Kind.HOLDS if holds else Kind.REFUTED, words, why)


def simple(costs: Costs) -> Judged:
    """The factors of schlick1993, as they are written for a half-vector that is not normalised."""
    plain = {
        "Z": operations(schlick1993.Z, 0.2, V),
        "G": operations(schlick1993.G, 0.2, 0.6),
        "eq. 11": operations(lambda c: (1.0 - c) * (1.0 - c) * (1.0 - c) * (1.0 - c) * (1.0 - c), 0.6),
    }
    A = operations(schlick1993.A, 0.5, V)
    words = "; ".join(f"{name}: {count(each)}" for name, each in (plain | {"A": A}).items())
    holds = basic(list(plain.values())) and A["root"] == 1 and A[FUNCTION] == 0
    return Judged(Kind.HOLDS if holds else Kind.REFUTED, words)


def once_or_eight(costs: Costs) -> Judged:
    """Cook-Torrance with a reflectance for each of eight wavelengths, against its single evaluation with one."""
    eight, one = costs.nanoseconds("cook_torrance", 8), costs.nanoseconds("cook_torrance_exact")
    holds = eight >= 1.5 * one
    return Judged(Kind.HOLDS if holds else Kind.REFUTED, f"{eight:.3g} ns for eight reflectances, {one:.3g} ns for one")


CLAIMS: tuple[CostClaim, ...] = (
    CostClaim(
        "physically_based_effort",
        "neumann1999",
        "§1",
        "even the calculation of BRDF values requires significant computational effort for these physically based models",
        "At 8 wavelengths Cook-Torrance and He-Torrance take at least twice as long as Phong.",
        dearer(("cook_torrance", "phong"), HE, low=2.0, wavelengths=8),
    ),
    CostClaim(
        "tabulated_metal",
        "neumann1999",
        "§5.1, after eq. 28",
        "This computational cost is lower than that of any previously known metallic models",
        "For one wavelength eq. 28 with its table takes less than Ward, and than Cook-Torrance and He-Torrance with F.",
        dearer(
            ("ward", "metal_tabulated"),
            ("cook_torrance_exact", "metal_tabulated"),
            ("he_torrance", "metal_tabulated"),
            why="Ward's exponential is cheaper here than the power of eq. 28, and it has no Fresnel factor to tabulate.",
        ),
    ),
    CostClaim(
        "plastic_effective",
        "neumann1999",
        "§5.2, after eq. 30",
        "this is a computationally effective model for many practical cases",
        "The plastic model takes less than Cook-Torrance.",
        dearer(("cook_torrance_exact", "plastic")),
    ),
    CostClaim(
        "blinn_constant",
        "neumann1999",
        "§6.1, after eq. 31",
        "The complexity of this calculation is O(n)",
        "The constant C_n for integer n needs a number of operations that grows like n.",
        unknown(
            "True of the sum in the cited paper, which the text does not print. The constant itself has a closed "
            "form of fixed cost."
        ),
    ),
    CostClaim(
        "ward_schlick_simpler",
        "neumann1999",
        "§6.2",
        "These models are simpler than other known metallic models",
        "Ward and Schlick's isotropic model take less than Cook-Torrance with its Fresnel term.",
        dearer(("cook_torrance_exact", "ward"), ("cook_torrance_exact", "schlick_isotropic")),
    ),
    CostClaim(
        "main_advantage",
        "neumann1999",
        "§8",
        "The main advantage of the new models over existing physically based metal models is the computational time",
        "At 8 wavelengths stretched Phong and stretched Blinn take less than Cook-Torrance and He-Torrance.",
        dearer(
            ("cook_torrance", "stretched_phong"),
            ("cook_torrance", "stretched_blinn"),
            ("he_torrance", "stretched_phong"),
            wavelengths=8,
        ),
    ),
    CostClaim(
        "eight_percent",
        "neumann1999",
        "§8",
        "it requires only 8 percent more computational time than the reciprocal Phong model",
        "At 8 wavelengths stretched Phong takes at most a quarter more than Phong.",
        dearer(("stretched_phong", "phong"), low=0.0, high=1.25, wavelengths=8),
    ),
    CostClaim(
        "sampling_simpler",
        "neumann1999",
        "§8",
        "Importance sampling of the new models is simpler than that of the original Blinn and Ward models",
        "Drawing one direction for stretched Phong executes fewer operations than for Blinn and for Ward.",
        sampling,
    ),
    CostClaim(
        "schlick_fast",
        "schlick1993",
        "abstract",
        "First, it is fast and simple",
        "The model with eq. 11 and 15 takes less than Cook-Torrance with the exact Fresnel term.",
        dearer(("cook_torrance_exact", "schlick_eq15")),
    ),
    CostClaim(
        "empirical_inexpensive",
        "schlick1993",
        "§1",
        "empirical models … which are computationally inexpensive …, or theoretical models … which are expensive",
        "Cook-Torrance and He-Torrance take longer than Phong and than Blinn.",
        dearer(
            ("cook_torrance_exact", "phong"),
            ("cook_torrance_exact", "blinn"),
            HE,
            why="A cosine power costs two functions and Beckmann's exponential one.",
        ),
    ),
    CostClaim(
        "he_more_complex",
        "schlick1993",
        "§3.1",
        "a more complete (and much more complex) formulation of the distribution function",
        "He-Torrance executes at least twice as many operations as Cook-Torrance.",
        lambda costs: counted(costs, "cook_torrance_exact", "he_torrance"),
    ),
    CostClaim(
        "poulin_reasonable",
        "schlick1993",
        "§3.2",
        "Poulin & Fournier have proposed a model with a more reasonable cost",
        "Poulin and Fournier's model takes less than Kajiya's and Cabral's.",
        unknown("The document prints none of the three, and the catalogue has none."),
    ),
    CostClaim(
        "theoretical_extremely_high",
        "schlick1993",
        "§4",
        "complete theoretical models … imply an extremely high computational cost",
        "He-Torrance takes at least ten times as long as Phong.",
        dearer(HE, low=10.0),
    ),
    CostClaim(
        "several_levels",
        "schlick1993",
        "§4, §5.2 and §7",
        "Several levels of physical accuracy and computational cost should be provided; more or less expensive",
        "The directional factors cost more in the order eq. 12, 15, 18.",
        dearer(("schlick_eq15", "schlick_eq12"), ("schlick_eq18", "schlick_eq15")),
    ),
    CostClaim(
        "fresnel_approximated",
        "schlick1993",
        "§5.3, eq. 11",
        "Rather than using the true formulation of the Fresnel factor, we propose Equation 11",
        "Eq. 11 executes at most half of the operations of the exact factor of a dielectric.",
        counts(much_less, {"exact": (fresnel.dielectric, 1.5, 0.6), "eq. 11": (fresnel.schlick, 0.04, 0.6)}),
    ),
    CostClaim(
        "smith_approximated",
        "schlick1993",
        "§5.4, eq. 16",
        "Rather than using the true formulation of the Smith factor, we propose Equation 16",
        "Eq. 16 executes at most half of the operations of Smith's factor, and no function.",
        counts(much_less, {"Smith": (masking.beckmann_lambda, 0.2, LIGHT), "eq. 16": (schlick1993.G, 0.2, 0.6)}),
    ),
    CostClaim(
        "very_simple_expressions",
        "schlick1993",
        "§7",
        "very simple expressions (only basic arithmetic operators (+ - */), except a square root for anisotropy)",
        "Z, G and eq. 11 execute + - * / alone; A a square root besides.",
        simple,
    ),
    CostClaim(
        "lambert_extremely_cheap",
        "losasso",
        "Introduction, and The Lambertian Lighting Models",
        "extremely cheap to compute; The cost of this equation is extremely small",
        "Lambert takes at most a fifth of any other model of the document.",
        dearer(
            *(
                (name, "lambert")
                for name in ("phong_original", "cook_torrance_losasso", "blinn_facets", "oren_nayar", "minnaert")
            ),
            ("ward_half_vector", "lambert"),
            low=5.0,
        ),
    ),
    CostClaim(
        "phong_per_pixel",
        "losasso",
        "The Phong Lighting Model",
        "The major drawback … is of course that a lot more computational power is used",
        "Evaluating at every pixel costs more than at every vertex.",
        unknown("By the number of pixels over that of vertices, which depends on the scene."),
    ),
    CostClaim(
        "one_fresnel_calculation",
        "losasso",
        "The Cook-Torrance Lighting Model, after its equation",
        "for computational simplicity, we will assume that it is wavelength independent (and hence only one "
        "calculation is needed)",
        "With eight reflectances the model takes at least half as long again as with one.",
        once_or_eight,
    ),
    CostClaim(
        "blinn_cheaper",
        "losasso",
        "The Blinn Lighting Model, first paragraph",
        "yields similar results, but is significantly cheaper to compute",
        "Cook-Torrance takes at least 1.2 times as long as Blinn, both without Fresnel's factor.",
        dearer(("cook_torrance", "blinn_facets"), low=1.2),
    ),
    CostClaim(
        "blinn_distribution_easier",
        "losasso",
        "The Blinn Lighting Model, after its equation",
        "The distribution function (D) is now significantly easier to compute",
        "It executes fewer operations than Beckmann's, and no function.",
        counts(
            lambda found: work(found[1]) < work(found[0]) and found[1][FUNCTION] == 0,
            {"Beckmann": (normals.beckmann, 0.2, V), "ellipsoids": (normals.ggx, 0.2, V)},
        ),
    ),
    CostClaim(
        "huge_cost",
        "losasso",
        "The Blinn Lighting Model, last paragraph",
        "without the huge cost of the Cook-Torrance or the Torrance-Sparrow models",
        "Cook-Torrance, Fresnel's factor included, takes at least twice as long as Blinn with the cheap one left out.",
        dearer(
            ("cook_torrance_losasso", "blinn_facets"),
            low=2.0,
            why="An exponential and a Fresnel factor are a small part of an evaluation today.",
        ),
    ),
    CostClaim(
        "oren_nayar_expensive",
        "losasso",
        "The Oren-Nayar Lighting Model",
        "It is however very computationally expensive; the pixel program may get prohibitively expensive",
        "The simplified model takes longer than Cook-Torrance.",
        unclaimed(
            dearer(("oren_nayar", "cook_torrance_losasso")),
            "Measured is the form without angles, on a processor. The sentence is about the printed form in a shader of its day.",
        ),
    ),
    CostClaim(
        "oren_nayar_cheaper_simplified",
        "losasso",
        "The Oren-Nayar Lighting Model, after its equation",
        "in an effort to make the model cheaper to calculate",
        "The full model takes at least twice as long as the simplified one.",
        dearer(("oren_nayar_full", "oren_nayar"), low=2.0),
    ),
    CostClaim(
        "oren_nayar_not_worth",
        "losasso",
        "The Oren-Nayar Lighting Model, last sentence",
        "the benefit … is probably not worth the increase computational requirements",
        "The increase over Lambert outweighs the benefit.",
        unknown("What a better picture is worth is for a beholder; the increase stands in the table of appendix B."),
    ),
    CostClaim(
        "oren_nayar_nv30",
        "losasso",
        "The Oren-Nayar Lighting Model",
        "hardware like nv30 can calculate the above equation in hardware, at the fragment shader level",
        "The equation fits into a fragment program of nv30.",
        unknown(OPENGL),
    ),
    CostClaim(
        "minnaert_not_very_high",
        "losasso",
        "The Minnaert Lighting Model",
        "The computational power required to implement Minnaert style lighting is not very high",
        "Minnaert takes less than Cook-Torrance with the exact Fresnel factor.",
        unclaimed(
            dearer(("cook_torrance_losasso", "minnaert")),
            "“Not very high” has no measure. On a processor its two powers cost more than Beckmann's exponential; the document "
            "would look them up in a texture.",
        ),
    ),
    CostClaim(
        "maps_very_cheap",
        "losasso",
        "Environment Mapping Based Lighting Models",
        "a very good looking, and very cheap way of lighting objects",
        "Fetching from a cube map takes less than evaluating a model.",
        unknown(OPENGL),
    ),
    CostClaim(
        "cheap_fresnel",
        "losasso",
        "appendix A, F",
        "can also be approximated by the following (much cheaper) equation",
        "It executes at most half of the operations of the exact equation.",
        counts(
            much_less,
            {"exact": (cook_torrance.misprinted_exact, 1.5, 0.6), "cheap": (cook_torrance.misprinted_schlick, 0.04, 0.6)},
        ),
    ),
    CostClaim(
        "cost_is_the_integral",
        "nuaj_models",
        "Speed",
        "The cost of a BRDF model is not evaluating the model itself … we really need to evaluate that model times "
        "and times again",
        "The integral of f cos over all lights, to 1 % and by a method that knows the lobe, costs at least 100 evaluations.",
        all_at_once,
    ),
    CostClaim(
        "exponentials_cheap",
        "nuaj_models",
        "Speed",
        "especially now that exponentials and tangents don't cost you an eye anymore",
        "An exponential is a small part of an evaluation: Beckmann's facets against those of ggx, which need none.",
        an_eye,
    ),
    CostClaim(
        "several_rays_expensive",
        "nuaj_models",
        "Speed",
        "So we would need to actually shoot several rays to account for complex materials? It seems expensive",
        "Several rays cost more than one.",
        unknown("A question, and one of the scene; the document names neither rays nor times."),
    ),
)
