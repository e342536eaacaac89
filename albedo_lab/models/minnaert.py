"""Minnaert: a power of both cosines, made for the moon, whose limb is brighter or darker than Lambert's law has it."""

from __future__ import annotations

from functools import cache
from math import pi
from typing import NamedTuple

from albedo_lab.model import Choice, Model, Parameter, Reciprocal
from albedo_lab.optics.coordinates import Axis, Coordinates
from albedo_lab.optics.frame import Direction
from albedo_lab.optics.lobes import sample_cosine, sample_power_normal
from albedo_lab.optics.maths import pow
from albedo_lab.optics.profiles import TANGENT
from albedo_lab.sources import losasso, minnaert1941


class Minnaert(NamedTuple):
    k: float


# Minnaert: the radiance is (N.L)^k (N.V)^(k-1)


def evaluate(p: Minnaert, wi: Direction, wo: Direction) -> float:
    return pow(wi.z * wo.z, p.k - 1.0) / pi


def sample(p: Minnaert, wo: Direction, u1: float, u2: float) -> Direction:
    return sample_power_normal(p.k, u1, u2)  # as f cos: every sample weighs the same


def pdf(p: Minnaert, wi: Direction, wo: Direction) -> float:
    return (p.k + 1.0) / (2.0 * pi) * pow(wi.z, p.k)


# Losasso: Lambert's N.L times (N.L)^k (1 - N.E)^(1-k)


def evaluate_printed(p: Minnaert, wi: Direction, wo: Direction) -> float:
    below = (wo.x * wo.x + wo.y * wo.y) / (1.0 + wo.z)  # 1 - N.E
    return pow(wi.z, p.k) * pow(below, 1.0 - p.k) / pi


def sample_printed(p: Minnaert, wo: Direction, u1: float, u2: float) -> Direction:
    return sample_cosine(u1, u2)  # of the light or of the viewer: weights are bounded for either


def pdf_printed(p: Minnaert, wi: Direction, wo: Direction) -> float:
    return wi.z / pi


K = "exponent of the law: 1 is Lambert's, the limb brightens below and darkens above"
K_PRINTED = "exponent of N.L; that of 1 - N.V is 1 - k"
MINNAERT = minnaert1941("the law itself", "1 / pi, so that k = 1 is the white Lambertian surface")
LOSASSO = losasso(
    "The Minnaert Lighting Equation", "f_att and Lambert's N.L belong to the light; 1 / pi, as for his Lambertian term"
)
PRINTED = losasso(
    "The Minnaert Lighting Equation",
    "printed with (1 - N.E)^(1-k) for (N.E)^(k-1), and with N.L once more: N.L (N.L)^k for (N.L)^k",
    "the print is not reciprocal, and no k makes it Lambert's law",
)
CHOICES = (Choice("as_printed", "Losasso's law as he prints it, instead of Minnaert's own", options=("no", "yes"), default="no"),)


@cache
def make(*, as_printed: str = "no") -> Model:
    """Minnaert's law, or what Losasso prints under this name."""
    printed = as_printed == "yes"
    return Model(
        "minnaert",
        "k_d / pi (N.L)^k (1 - N.V)^(1-k)" if printed else "k_d / pi (N.L N.V)^(k-1)",
        Minnaert,
        (Parameter("k", K_PRINTED if printed else K, default=0.5, low=0.0, high=1.0 if printed else 10.0),),
        evaluate_printed if printed else evaluate,
        sample=sample_printed if printed else sample,
        pdf=pdf_printed if printed else pdf,
        scale=lambda p: 1.0,
        scale_symbol="k_d",
        smooth_in=Coordinates(Axis.NORMAL, TANGENT),
        reciprocal=not printed,
        source=LOSASSO if printed else MINNAERT,
        also=() if printed else (PRINTED,),
        claims=() if printed else (Reciprocal("minnaert1941, title"),),
        choices=CHOICES,
        make=make,
        chosen={"as_printed": as_printed},
    )


MODEL = make(as_printed="no")
