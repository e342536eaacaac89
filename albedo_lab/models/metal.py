"""Metal: the stretched Phong lobe coloured by the Fresnel reflectance of a metal, whose refractive index is complex."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import cache, lru_cache
from math import sqrt
from typing import Any, NamedTuple

from albedo_lab.model import Choice, Model, Parameter, Reciprocal
from albedo_lab.models.phong import EXPONENT, KINKED_MIRROR_LOBE, largest_constant, pdf, sample
from albedo_lab.optics.frame import Direction, bisector, cosine_power, length, mirror_of
from albedo_lab.optics.fresnel import conductor
from albedo_lab.optics.metals import LONGEST, METALS, SHORTEST, index
from albedo_lab.sources import johnson1972, mcpeak2015, neumann1999
from albedo_lab.tables import Table, table


class Custom(NamedTuple):
    n: float
    eta: float
    k: float


class Named(NamedTuple):
    n: float
    wavelength: float
    eta: float
    k: float


class CustomTable(NamedTuple):
    n: float
    eta: float
    k: float
    inverse: Table


class NamedTable(NamedTuple):
    n: float
    wavelength: float
    eta: float
    k: float
    inverse: Table


def half_vector(p: Custom, wi: Direction, wo: Direction) -> float:
    larger, of_half_vector = max(wi.z, wo.z), 0.5 * length(bisector(wi, wo))
    return cosine_power(mirror_of(wo), wi, p.n) / larger * conductor(p.eta, p.k, of_half_vector)  # eq. 27


def theta_min(p: Custom, wi: Direction, wo: Direction) -> float:
    larger = max(wi.z, wo.z)
    return cosine_power(mirror_of(wo), wi, p.n) / larger * conductor(p.eta, p.k, larger)  # eq. 28


def tabulated(p: CustomTable, wi: Direction, wo: Direction) -> float:
    return cosine_power(mirror_of(wo), wi, p.n) / g(p, max(wi.z, wo.z))  # eq. 28


CELLS = 1024


def g(p: CustomTable, c: float) -> float:
    """Eq. 28's denominator times c_n, cos(Theta) / F, from a table of 1 / F at even steps of sqrt(cos(Theta)).

    The denominator itself is 0 at grazing angles: in linear pieces from there, as many over the cosine, the highlight would be
    wrong by up to 0.5 %. 1 / F goes to 1, and the root spreads out how steeply it leaves it. So the highlight is right to 2e-6
    for the named metals at all their wavelengths, and to 1e-3 for any index of the domain.
    """
    x = sqrt(c) * CELLS
    i = min(int(x), CELLS - 1)
    inverse: float = p.inverse[i] + (x - i) * (p.inverse[i + 1] - p.inverse[i])
    return c * inverse


@lru_cache(1024)
def reciprocal_reflectance(eta: float, k: float) -> Table:
    """The table that `g` reads."""
    return table([1.0, *(1.0 / conductor(eta, k, (i / CELLS) ** 2) for i in range(1, CELLS + 1))])


DEVIATIONS = {
    "half_vector": ("the angle of the half-vector is the one between it and either direction",),
    "theta_min": (),
    "tabulated": (f"of g the factor 1 / F is tabulated, in {CELLS} linear pieces over sqrt(cos(Theta_min))",),
}
NAMED = ("the indices that the paper takes from Glassner 1995 and does not print are replaced by measured ones",)
ANGLES: dict[str, tuple[Callable[..., float], str, str]] = {
    "half_vector": (half_vector, "eq. 27", "c_n cos^n alpha / max(N.L, N.V) F(eta + i k, L.H)"),
    "theta_min": (theta_min, "eq. 28", "c_n cos^n alpha / max(N.L, N.V) F(eta + i k, max(N.L, N.V))"),
    "tabulated": (tabulated, "eq. 28", "cos^n alpha / g(Theta_min)"),
}
CHOICES = (
    Choice("metal", "one whose index was measured, or any index", ("custom", *METALS), "custom"),
    Choice(
        "angle",
        "Theta of F: of the half-vector, or the smaller of both angles, exactly or by a table",
        tuple(ANGLES),
        "half_vector",
    ),
)
WAVELENGTH = Parameter("wavelength", "wavelength of the light", default=550.0, low=SHORTEST, high=LONGEST, unit="nm")
PLACE = "n and k, as refractiveindex.info tabulates them"
MEASURED = {metal: johnson1972(PLACE) for metal in METALS} | {"aluminium": mcpeak2015(PLACE)}


def refraction(angle: str) -> tuple[Parameter, ...]:
    """Any index; about that of aluminium at 550 nm by default. A table needs an F that is nowhere 0, so some absorption."""
    return (
        Parameter("eta", "real part of the refractive index", default=0.79, low=0.01, high=10.0, scale="log"),
        Parameter(
            "k", "imaginary part of the refractive index", default=5.85, low=0.1 if angle == "tabulated" else 0.0, high=20.0
        ),
    )


@cache
def make(*, metal: str, angle: str) -> Model:
    """One metal, with one choice of the angle."""
    evaluate, equation, formula = ANGLES[angle]
    named, tables = metal != "custom", angle == "tabulated"
    parameters_type: Any = (NamedTable if tables else Named) if named else (CustomTable if tables else Custom)

    def complete(numbers: Mapping[str, float]) -> Any:
        eta, k = index(metal, numbers["wavelength"]) if named else (numbers["eta"], numbers["k"])
        held = {**numbers, "eta": eta, "k": k}
        return parameters_type(**held, inverse=reciprocal_reflectance(eta, k)) if tables else parameters_type(**held)

    return Model(
        "metal",
        formula,
        parameters_type,
        (EXPONENT, WAVELENGTH) if named else (EXPONENT, *refraction(angle)),
        evaluate,
        sample=sample,
        pdf=pdf,
        scale=largest_constant,
        scale_symbol="c_n",
        complete=complete,
        smooth_in=KINKED_MIRROR_LOBE,
        source=neumann1999(equation, *DEVIATIONS[angle], *(NAMED if named else ())),
        also=(MEASURED[metal],) if named else (),
        claims=(Reciprocal("neumann1999 §5.1"),),
        choices=CHOICES,
        make=make,
        chosen={"metal": metal, "angle": angle},
    )


MODEL = make(metal="custom", angle="half_vector")
