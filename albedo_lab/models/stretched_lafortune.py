"""Stretched Lafortune: Lafortune's lobes over a power of the larger cosine, so that fewer of them make a metal."""

from __future__ import annotations

from functools import cache
from typing import Any, NamedTuple

from albedo_lab.model import MAXIMUM, Model, Parameter
from albedo_lab.models.lafortune import (
    FACTORS,
    LOBES,
    SHARE,
    Lobes,
    cosine_power,
    energy,
    exponent,
    itself,
    lobe_axis,
    mixture,
    sum_of_lobes,
    typical_cosine,
    upper_lobe,
)
from albedo_lab.optics.coordinates import Axis, Coordinates, Kink
from albedo_lab.optics.frame import Direction
from albedo_lab.optics.maths import pow
from albedo_lab.optics.profiles import POWER
from albedo_lab.sources import neumann1999


class StretchedLafortune(NamedTuple):
    C_x: float
    C_y: float
    C_z: float
    n: float
    C: float
    p: float


def evaluate(q: StretchedLafortune, wi: Direction, wo: Direction) -> float:
    return q.C * cosine_power(q, wi, wo) / pow(max(wi.z, wo.z), q.p)  # eq. 15


def stretched_energy(q: Any, wo: Direction) -> Any:
    """About the albedo of a lobe; only the choice among lobes depends on it."""
    return energy(q, wo) / pow(max(typical_cosine(upper_lobe(q, wo)[0], q.n), wo.z), q.p)


def row(p: Lobes, i: int) -> StretchedLafortune:
    """One lobe of several."""
    t = p.table
    return StretchedLafortune(t[i, 0], t[i, 1], t[i, 2], t[i, 3], t[i, 4], t[i, 5])


@cache
def make(*, lobes: int) -> Model:
    """The model with that many lobes."""
    return ONE_LOBE if lobes == 1 else sum_of_lobes(lobes, ONE_LOBE, row, stretched_energy)


STRETCH = Parameter("p", "how far the lobe is stretched", default=1.0, low=0.0, high=1.0)
SAMPLE, PDF = mixture(1, itself, stretched_energy)

ONE_LOBE = MODEL = Model(
    "stretched_lafortune",
    "C_max sum_i C_i [(R.V)_i^+]^n_i / max(N.L, N.V)^p_i, (R.V)_i = C_x,i R_x V_x + C_y,i R_y V_y + C_z,i R_z V_z",
    StretchedLafortune,
    (*FACTORS, STRETCH, SHARE),
    evaluate,
    sample=SAMPLE,
    pdf=PDF,
    scale=MAXIMUM,
    scale_symbol="C_max",
    smooth_in=Coordinates(Axis.LOBE, POWER, exponent, kink=Kink.EQUAL_COSINES, lobe=lobe_axis),
    isotropic=lambda q: q.C_x == q.C_y,
    source=neumann1999(
        "eq. 15; several lobes: eq. 16",
        "(R.V)_M is cut off at 0, as R.V is in eq. 5; eq. 15 and 16 do not print it",
        "C_max multiplies the whole sum; with scale = 1 the C_i stand alone, as in eq. 16",
    ),
    choices=(LOBES,),
    make=make,
    chosen={"lobes": 1},
)
