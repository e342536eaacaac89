"""Lafortune: cosine lobes about the scaled components of the mirror direction: off-specular, retro-reflective, anisotropic."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace
from functools import cache, lru_cache
from math import pi, sqrt
from typing import Any, NamedTuple

from albedo_lab.model import MAXIMUM, Count, Model, Parameter
from albedo_lab.optics.coordinates import Axis, Coordinates
from albedo_lab.optics.frame import Direction, mirror_of
from albedo_lab.optics.lobes import lobe_pdf, sample_cosine, sample_lobe
from albedo_lab.optics.maths import pow
from albedo_lab.optics.profiles import POWER
from albedo_lab.sources import neumann1999
from albedo_lab.tables import table


class Lafortune(NamedTuple):
    C_x: float
    C_y: float
    C_z: float
    n: float
    C: float


def cosine_power(q: Any, wi: Direction, wo: Direction) -> float:
    """[(R.V)_M^+]^n with R = (-L_x, -L_y, L_z). For n = 0 the limit n -> 0+: 1 where (R.V)_M > 0, else 0.

    Rounding costs n roundings of the power: 1000 at the most, unlike in Phong's lobe.
    """
    r_v = q.C_z * (wi.z * wo.z) - q.C_x * (wi.x * wo.x) - q.C_y * (wi.y * wo.y)
    return pow(r_v, q.n) if r_v > 0.0 else 0.0


def evaluate(q: Lafortune, wi: Direction, wo: Direction) -> float:
    return q.C * cosine_power(q, wi, wo)  # eq. 14


# (R.V)_M = |M R| cos(angle from M R): anisotropic or not, every lobe is a Phong lobe about an axis of its own


def lobe_axis(q: Any, wo: Direction) -> Direction:
    """M R, unit; below the horizon where C_z < 0. Where it vanishes the lobe does too, and any axis will do."""
    x, y, z = -q.C_x * wo.x, -q.C_y * wo.y, q.C_z * wo.z
    r = sqrt(x * x + y * y + z * z)
    return Direction(x / r, y / r, z / r) if r > TINY else mirror_of(wo)


def upper_lobe(q: Any, wo: Direction) -> tuple[Direction, float]:
    """An axis to sample about, unit and above the horizon, and a bound on (R.V)_M / cos(angle from it).

    An axis below the horizon is raised to it, which for directions above can only add to (R.V)_M.
    """
    x, y, z = -q.C_x * wo.x, -q.C_y * wo.y, max(q.C_z * wo.z, 0.0)
    r = sqrt(x * x + y * y + z * z)
    k = 1.0 / r if r > TINY else 0.0
    return Direction(x * k, y * k, z * k if r > TINY else 1.0), r


def typical_cosine(axis: Direction, n: float) -> float:
    """About the mean cosine of the directions of a lobe, be it one that grazes the horizon."""
    return max(axis.z, 0.4 / sqrt(n + 1.0))


def energy(q: Any, wo: Direction) -> Any:
    """About the albedo of a lobe; only the choice among lobes depends on it."""
    axis, length = upper_lobe(q, wo)
    return q.C * pow(length, q.n) / (q.n + 1.0) * typical_cosine(axis, q.n)


def mixture(count: int, lobe: Callable[..., Any], energy: Callable[..., float]) -> tuple[Callable[..., Any], Callable[..., Any]]:
    """Sampler and density: a lobe chosen by its energy, and the cosine where none has any; `lobe(p, i)` is one of them."""

    def share(q: Any, wo: Direction) -> Any:
        light = energy(q, wo)
        return light if light > TINY else 0.0  # no quotient of two of them overflows

    def sample(p: Any, wo: Direction, u1: float, u2: float) -> Direction:
        total = 0.0
        for i in range(count):
            total += share(lobe(p, i), wo)
        rest = u1 * total
        chosen, u, below = lobe(p, 0), u1, 0.0
        for i in range(count):  # the last lobe that begins below `rest`; no break, so that samples fill SIMD lanes
            q = lobe(p, i)
            part = share(q, wo)
            if part > 0.0 and rest >= below:
                chosen, u = q, (rest - below) / part
            below += part
        axis, _ = upper_lobe(chosen, wo)
        by_lobe = sample_lobe(axis, chosen.n, min(max(u, SMALLEST), 1.0), u2)
        by_cosine = sample_cosine(u1, u2)
        return by_lobe if total > 0.0 else by_cosine

    def pdf(p: Any, wi: Direction, wo: Direction) -> float:
        total, density = 0.0, 0.0
        for i in range(count):
            q = lobe(p, i)
            part, (axis, _) = share(q, wo), upper_lobe(q, wo)
            total += part
            density += part * lobe_pdf(axis, wi, q.n)
        return density / total if total > 0.0 else max(wi.z, 0.0) / pi

    return sample, pdf


class Lobes(NamedTuple):
    """Several lobes: a table with a row for each and the columns FIELDS; every parameter is an attribute as well."""

    table: Any

    def __getattr__(self, name: str) -> float:
        field, _, number = (name, "", "1") if name in FIELDS else name.rpartition("_")
        i = int(number) - 1 if number.isdigit() else -1
        if field not in FIELDS[: self.table.shape[1]] or not 0 <= i < len(self.table):
            raise AttributeError(name)
        return float(self.table[i, FIELDS.index(field)])


@lru_cache(maxsize=4096)
def lobes_of(rows: tuple[tuple[float, ...], ...]) -> Lobes:
    """The same table for the same numbers, so that answers about it are found again."""
    return Lobes(table(rows))


def sum_of_lobes(count: int, one: Model, lobe: Callable[..., Any], energy: Callable[..., float]) -> Model:
    """The model of several lobes from that of one; `lobe(p, i)` is row i of the table (eq. 16)."""
    term, fields = one.evaluate, one.parameters_type._fields
    suffixes = ["", *(f"_{i}" for i in range(2, count + 1))]

    def evaluate(p: Any, wi: Direction, wo: Direction) -> float:
        f = 0.0
        for i in range(count):
            f += term(lobe(p, i), wi, wo)
        return f

    def complete(numbers: Mapping[str, float]) -> Lobes:
        return lobes_of(tuple(tuple(numbers[field + suffix] for field in fields) for suffix in suffixes))

    def parts(p: Any) -> tuple[tuple[Model, Any], ...]:
        return tuple((one, one.parameters_type(*row)) for row in p.table.tolist())

    sample, pdf = mixture(count, lobe, energy)
    evaluate.__module__ = term.__module__  # the summary stands there
    return replace(
        one,
        parameters_type=Lobes,
        parameters=tuple(
            replace(q, name=q.name + suffix, meaning=q.meaning.replace("the lobe", f"lobe {i + 1}"))
            for i, suffix in enumerate(suffixes)
            for q in one.parameters
        ),
        complete=complete,
        evaluate=evaluate,
        sample=sample,
        pdf=pdf,
        parts=parts,
        isotropic=lambda p: all(one.isotropic(q) for _, q in parts(p)),
        chosen={"lobes": count},
    )


def itself(p: Any, i: int) -> Any:
    """The only lobe."""
    return p


def row(p: Lobes, i: int) -> Lafortune:
    """One lobe of several."""
    t = p.table
    return Lafortune(t[i, 0], t[i, 1], t[i, 2], t[i, 3], t[i, 4])


def exponent(q: Any) -> Any:
    return q.n


@cache
def make(*, lobes: int) -> Model:
    """The model with that many lobes."""
    return ONE_LOBE if lobes == 1 else sum_of_lobes(lobes, ONE_LOBE, row, energy)


TINY = 1e-150
SMALLEST = 2.0**-50
"""Farther out a wide lobe's samples could not be told from the plane a quarter turn from its axis, where its density is 0."""
FIELDS = ("C_x", "C_y", "C_z", "n", "C", "p")
LOBES = Count("lobes", "number of lobes", default=1, low=1, high=100)
# 1.4^1000 is as large as f may become if the squares that a standard deviation sums are to stay finite
FACTORS = (
    Parameter("C_x", "factor of R_x V_x in the lobe", default=1.0, low=-1.4, high=1.4),
    Parameter("C_y", "factor of R_y V_y in the lobe", default=1.0, low=-1.4, high=1.4),
    Parameter("C_z", "factor of R_z V_z in the lobe", default=1.0, low=-1.4, high=1.4),
    Parameter("n", "exponent of the lobe", default=20.0, low=0.0, high=1000.0, scale="log"),
)
SHARE = Parameter("C", "factor of the lobe", default=1.0, low=0.0, high=1e3)
SAMPLE, PDF = mixture(1, itself, energy)

ONE_LOBE = MODEL = Model(
    "lafortune",
    "C_max sum_i C_i [(R.V)_i^+]^n_i, (R.V)_i = C_x,i R_x V_x + C_y,i R_y V_y + C_z,i R_z V_z",
    Lafortune,
    (*FACTORS, SHARE),
    evaluate,
    sample=SAMPLE,
    pdf=PDF,
    scale=MAXIMUM,
    scale_symbol="C_max",
    smooth_in=Coordinates(Axis.LOBE, POWER, exponent, lobe=lobe_axis),
    isotropic=lambda q: q.C_x == q.C_y,
    source=neumann1999(
        "eq. 14; several lobes: eq. 16 with p_i = 0",
        "(R.V)_M is cut off at 0, as R.V is in eq. 5; eq. 14 does not print it",
        "C_max multiplies the whole sum; with scale = 1 the C_i stand alone, as in eq. 16",
    ),
    choices=(LOBES,),
    make=make,
    chosen={"lobes": 1},
)
