"""GGX with the light of several reflections given back, in the forms of Kulla and Conty 2017 and of Turquin 2019.

Both need E, the albedo of the facets for F = 1: here a polynomial over the fourth root of the cosine, through albedos that the
oracle of `ggx` integrates at Chebyshev's nodes. Degree 44 leaves less than 1e-10 for alpha >= 0.1, at random cosines.
"""

from __future__ import annotations

import math
from functools import cache
from typing import Any

import numpy as np

from tests.oracles.formulas import microfacet
from tests.oracles.formulas.pair import Array, Pair

DEGREE = 44
ERROR = 1e-8
"""Of an albedo, for alpha >= 0.1, through the polynomial, and through the table that the model has instead."""
X, W = np.polynomial.legendre.leggauss(26)


@cache
def polynomial(alpha: float, g: str) -> np.polynomial.Chebyshev:
    """E over the fourth root of the cosine."""
    from tests.oracles.catalogue_albedo import albedo

    p = {"alpha_x": alpha, "alpha_y": alpha, "G": g, "F": "one"}

    def values(x: Array) -> list[float]:
        return [albedo("ggx", p, float(y) ** 4, effort=1)[0] for y in x]

    return np.polynomial.Chebyshev.interpolate(values, DEGREE, domain=[0.0, 1.0])


def reflected(p: dict[str, Any], cosine: Array | float) -> Array:
    """E."""
    found: Array = polynomial(p["alpha"], p["G"])(np.asarray(cosine) ** 0.25)
    return found


@cache
def mean(alpha: float, g: str) -> float:
    """2 int E mu dmu = 8 int E x^7 dx, of a polynomial of degree 51."""
    x = 0.5 + 0.5 * X
    return float(np.sum(4.0 * W * polynomial(alpha, g)(x) * x**7))


def facets(pair: Pair, p: dict[str, Any]) -> Array:
    """What is reflected once."""
    return microfacet.microfacet(pair, {**p, "D": "ggx", "diffuse": "none", "as_printed": "no"})


def turquin(pair: Pair, p: dict[str, Any]) -> Array:
    """That times 1 + F0 (1 - E) / E."""
    e = reflected(p, pair.view)
    return facets(pair, p) * (1.0 + p.get("F0", 1.0) * (1.0 - e) / e)


def lobe(pair: Pair, p: dict[str, Any]) -> Array:
    """The lobe of Kulla and Conty, F = F0 + (1 - F0) / 21 on the average."""
    e = mean(p["alpha"], p["G"])
    f = 1.0 if p["F"] == "one" else p["F0"] + (1.0 - p["F0"]) / 21.0
    share = f * f * e / (1.0 - f * (1.0 - e))
    return share * (1.0 - reflected(p, pair.light)) * (1.0 - reflected(p, pair.view)) / (math.pi * (1.0 - e)) + 0.0 * pair.t
