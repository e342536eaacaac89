"""The printed tables and figures of Neumann, Neumann and Szirmay-Kalos (1999), cell by cell, each with its recomputation."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace
from fractions import Fraction
from math import inf, pi

import numpy as np

from albedo_lab.analysis.albedo import albedo
from albedo_lab.analysis.normalise import normalise
from albedo_lab.estimate.record import NORMAL_975, Estimate, exact
from albedo_lab.papers.recipes import Means, Recipe, albedo_of, grazing_albedo_of, largest_constant_of, limit, mean_albedo_of
from albedo_lab.papers.record import Cell, Table
from albedo_lab.papers.verdict import Printed

TABLE_2 = """
n    blinn  stretched_blinn
1    0.350  0.293
2    0.382  0.368
4    0.449  0.449
8    0.592  0.592
16   0.895  0.895
32   1.52   1.52
64   2.79   2.79
128  5.34   5.34
256  10.4   10.4
512  20.6   20.6
"""

TABLE_3 = """
n    phong  stretched_phong  blinn  stretched_blinn
1    0.737  0.934            0.879  0.941
2    0.708  0.902            0.800  0.952
4    0.688  0.887            0.706  0.863
8    0.676  0.888            0.620  0.748
16   0.670  0.901            0.562  0.679
32   0.668  0.919            0.531  0.648
64   0.667  0.937            0.516  0.639
128  0.667  0.953            0.508  0.640
256  0.667  0.966            0.504  0.644
512  0.667  0.975            0.502  0.649
"""

TABLE_3_INFINITY = {
    "phong": ("0.5", Fraction(2, 3)),
    "stretched_phong": ("1", Fraction(1)),
    "blinn": ("0.5", Fraction(1, 2)),
    "stretched_blinn": ("1", Fraction(2, 3)),
}
"""As printed, and our limit."""

TABLE_4 = """
m      modified_ward
0.4    1.63
0.2    1.16
0.1    1.04
0.05   1.011
0.02   1.005
0.01   1.002
0.005  1.002
"""

AFTER_EQUATION_36 = """
r      schlick_isotropic
0.5    2.14
0.1    0.72
0.01   0.21
0.001  0.042
"""

WARD_AT_GRAZING = {89.995: "1.2", 89.999: "2.6", 89.9995: "3.8"}

TOWARDS_INFINITY = {"n = 1e4": 1e4, "n = 1e6": 1e6, "n = 1e8": 1e8}


def cells(block: str, quantity: str, recipe: Callable[..., Recipe]) -> Iterator[Cell]:
    """The cells of a printed table, model by model: a parameter in the first column, then a model in each."""
    (parameter, *models), *rows = (line.split() for line in block.split("\n") if line)
    for column, model in enumerate(models, start=1):
        for row in rows:
            at = {parameter: float(row[0])}
            yield Cell(quantity, model, at, Printed(row[column]), recipe(model, **at))


def table_3_cells() -> tuple[Cell, ...]:
    """Model by model, the last row a limit, with the rows that approach it."""
    found = list(cells(TABLE_3, "mean_albedo", mean_albedo_of))
    for model, (text, value) in TABLE_3_INFINITY.items():
        approach = {name: mean_albedo_of(model, n=n) for name, n in TOWARDS_INFINITY.items()}
        found.append(Cell("mean_albedo", model, {"n": inf}, Printed(text, exact=True), limit(value), approach))
    return tuple(sorted(found, key=lambda cell: list(TABLE_3_INFINITY).index(cell.model)))


def overshoot(means: Means) -> Estimate:
    """How far the largest albedo of the stretched Phong model exceeds 1 with c_n of ineq. 6, for n = 1."""
    largest = largest_constant_of("stretched_phong", n=1)(means)
    c_n = 3.0 / (2.0 * pi)
    return replace(
        largest,
        value=c_n / largest.value - 1.0,
        standard_error=c_n * largest.standard_error / largest.value**2,
        low=c_n / largest.high - 1.0,
        high=c_n / largest.low - 1.0,
    )


def overshoot_angle(means: Means) -> Estimate:
    """Where that is: every angle of a walk at which the albedo may be the largest within its bound, and a step more."""
    low, high = 0.0, 89.0
    for step in (1.0, 0.01):
        walk = np.arange(low, high + step / 2.0, step)
        table = albedo("stretched_phong", n=1, theta_deg=walk.tolist(), tolerance=1e-9, method="quadrature")
        largest = walk[table.ci95_high >= table.ci95_low.max()]
        low, high = float(largest[0]) - step, float(largest[-1]) + step
    best, half = 0.5 * (low + high), 0.5 * (high - low)
    return Estimate(best, half / NORMAL_975, low, high, int(table.samples.sum()), "quadrature")


def normalise_angle(means: Means) -> Estimate:
    """The same from the search of `normalise`, which gives no interval of the angle."""
    return exact(float(normalise("stretched_phong", n=1, **means.options).peak_theta_deg[0]), "normalise")


def equation_26(n: int) -> Fraction:
    """The grazing albedo of the stretched Phong model, as printed."""
    return Fraction(n + 2, 2 * (n + 1))


def equation_26_cells() -> Iterator[Cell]:
    """Its printed values, two more of its formula, and both limits of the text that follows."""
    for n, text in {1: "3/4", 2: "2/3", 10: str(equation_26(10)), 100: str(equation_26(100))}.items():
        yield Cell("grazing_albedo", "stretched_phong", {"n": n}, Printed(text), grazing_albedo_of("stretched_phong", n=n))
    few = {"n = 1e2": 1e2, "n = 1e3": 1e3, "n = 1e4": 1e4}
    approach = {name: grazing_albedo_of("stretched_phong", n=n) for name, n in few.items()}
    yield Cell("grazing_albedo", "stretched_phong", {"n": inf}, Printed("1/2"), limit(Fraction(1, 2)), approach)
    approach = {name: albedo_of("stretched_phong", 89.0, n=n) for name, n in TOWARDS_INFINITY.items()}
    below = {"n": inf, "theta_deg": 89.0}
    yield Cell("albedo", "stretched_phong", below, Printed("1", exact=True), limit(Fraction(1)), approach)


def grazing_cell(model: str, n: int, text: str) -> Cell:
    """An albedo printed for 90 degrees."""
    return Cell("grazing_albedo", model, {"n": n}, Printed(text), grazing_albedo_of(model, n=n))


WARD_CELLS = tuple(
    Cell("albedo", "ward", {"m": 0.1, "theta_deg": angle}, Printed(text), albedo_of("ward", angle, m=0.1))
    for angle, text in WARD_AT_GRAZING.items()
)

OVERSHOOT_CELLS = (
    Cell("overshoot", "stretched_phong", {"n": 1}, Printed("0.0003"), overshoot),
    Cell(
        "overshoot_angle_deg",
        "stretched_phong",
        {"n": 1},
        Printed("13"),
        overshoot_angle,
        {"search of normalise": normalise_angle},
    ),
)

NOTE_TABLE_2 = """\
The constant Cₙ of eq. 31 and 32 under which the largest albedo over all incident directions is 1.
`albedo-lab normalise blinn -p n=1,2,4,8,16,32,64,128,256,512` gives the same. The printed 0.368 of the stretched
model with n = 2 contradicts the paper's own table 3: there its mean albedo would be 0.963, and the printed 0.952 needs
our 0.3638."""

NOTE_TABLE_3 = """\
Mean albedo 2 ∫ a(μ) μ dμ (eq. 33). Phong and stretched Phong carry cₙ = (n+2)/(2π) of ineq. 6, the Blinn models the
computed maximum of table 2. The mean of the Phong model with n = 4 is 11/16 = 0.6875 exactly: it rounds to the
print.

**The infinity row.**

Each albedo is an expectation over the model's own lobe, and as n → ∞ that lobe contracts to one direction. Let μ be
the cosine of the incident direction and z that of the random reflected one, z⁺ = max(z, 0).

*Phong.* The density (n+1)/(2π) cosⁿα about the mirror direction integrates to 1, so with cₙ = (n+2)/(2π) the albedo
is aₙ(μ) = (n+2)/(n+1) · E[z⁺]. The lobe contracts: z → μ in probability. As z⁺ ≤ 1, dominated convergence gives
aₙ(μ) → **μ**, and as aₙ ≤ 2, once more under the mean, 2 ∫ aₙ μ dμ → 2 ∫ μ² dμ = **2/3**. The paper prints 0.5; its
own rows settle at 0.667.

*Stretched Phong.* aₙ(μ) = (n+2)/(n+1) · E[z⁺ / max(z, μ)]. The fraction is at most 1, and continuous and equal to 1
at z = μ for every μ > 0: aₙ(μ) → **1**, mean → 2 ∫ μ dμ = **1**.

*Blinn.* Draw the half-vector h with density (n+1)/(2π) cosⁿδ about the normal N. Reflecting the incident direction
o about it has the Jacobian dω = 4 (o·h) dω_h, so aₙ(μ) = Cₙ · 2π/(n+1) · E[4 (o·h)⁺ z⁺]. As h → N, both o·h and z
tend to μ; the function under E is Lipschitz in h with a constant that does not depend on o, hence E → 4 μ²
uniformly in μ, and its supremum over μ tends to 4. The largest constant is therefore Cₙ ~ (n+1)/(8π), and aₙ(μ) →
**μ²**, mean → 2 ∫ μ³ dμ = **1/2**.

*Stretched Blinn.* aₙ(μ) = Cₙ · 2π/(n+1) · E[4 (o·h)⁺ z⁺ / max(z, μ)]. The fraction is at most 1 and tends to 1 for
μ > 0, so E → 4 μ and E ≤ 4; at normal incidence E → 4, so its supremum tends to 4 and again Cₙ ~ (n+1)/(8π). Then
aₙ(μ) → **μ**, bounded, and the mean → 2 ∫ μ² dμ = **2/3**. The paper prints 1; its own rows have risen to 0.649
only, and ours to 0.66661 at n = 1e8."""

NOTE_TABLE_4 = """\
C_max of eq. 35. The caption's "for n < 0.05" must read m < 0.05: the model has no n. A printed constant above ours
lets the albedo exceed 1 in the same ratio."""

NOTE_SECTION_2_2 = """\
Largest albedo minus 1 for n = 1 with cₙ = (n+2)/(2π), and the incident angle at which it occurs. The interval of
the angle holds every angle at which the albedo, within its bound, may be the largest."""

NOTE_EQUATION_26 = """\
ã(90°) = (n+2) / (2(n+1)). The paper prints n = 1, 2 and ∞; the rows n = 10 and 100 are its formula. Ours is the
limit μ → 0: the albedo at μ = 1e-9, its interval widened by the distance from the albedo at μ = 1e-6.

The formula is right: aₙ(μ) = (n+2)/(n+1) · E[z⁺ / max(z, μ)] and, as μ → 0, the fraction tends to 1 above the
horizon, where half of a lobe lies whose axis is the horizon. As n → ∞ *after* μ → 0 it gives 1/2. For a fixed angle
below 90°, n → ∞ gives 1 (see the infinity row of table 3). Both statements of the paper hold; the order of the
limits matters."""

NOTE_SECTION_6_1_1 = """\
The limit μ → 0 for n = 128 with the computed maximum Cₙ. In closed form 8π Cₙ / ((n+2)(n+4)) and 8 Cₙ Wₙ / (n+2),
with Wallis' integral Wₙ of cosⁿ over [0, π/2]."""

TABLES = (
    Table(
        "table_2",
        "Maximum constants of the Blinn models",
        "table 2",
        tuple(cells(TABLE_2, "constant", largest_constant_of)),
        NOTE_TABLE_2,
    ),
    Table(
        "table_3",
        "Mean albedo of the Phong and Blinn models",
        "table 3",
        table_3_cells(),
        NOTE_TABLE_3,
    ),
    Table(
        "table_4",
        "Maximum constants of the modified Ward model",
        "table 4",
        tuple(cells(TABLE_4, "constant", largest_constant_of)),
        NOTE_TABLE_4,
    ),
    Table(
        "after_equation_36",
        "Maximum constants of Schlick's isotropic model",
        "text after eq. 36",
        tuple(cells(AFTER_EQUATION_36, "constant", largest_constant_of)),
        "The albedo of this model is largest in the limit of grazing incidence.",
    ),
    Table(
        "section_6_2",
        "Albedo of Ward's model near grazing",
        "§6.2",
        WARD_CELLS,
        "Eq. 34 with C_max = 1 and m = 0.1. The albedo diverges as θ → 90°.",
    ),
    Table("section_2_2", "Overshoot of the stretched Phong model", "§2.2", OVERSHOOT_CELLS, NOTE_SECTION_2_2),
    Table(
        "equation_26",
        "Grazing albedo of the stretched Phong model",
        "eq. 26",
        tuple(equation_26_cells()),
        NOTE_EQUATION_26,
    ),
    Table(
        "section_6_1_1",
        "Albedo of the Blinn models at 90 degrees",
        "§6.1.1",
        (grazing_cell("blinn", 128, "7.8e-3"), grazing_cell("stretched_blinn", 128, "3.7e-2")),
        NOTE_SECTION_6_1_1,
    ),
)
