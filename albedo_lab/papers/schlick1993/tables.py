"""The conditions of eq. 13 as printed numbers: what Z and A of eq. 14 give for the parameters of figure 6."""

from __future__ import annotations

import math
from collections.abc import Callable
from math import pi

import numpy as np
from scipy.integrate import quad

from albedo_lab.estimate.record import Estimate, bounded, exact
from albedo_lab.optics.schlick1993 import mean_of_A
from albedo_lab.papers.record import Cell, Table
from albedo_lab.papers.schlick1993.factors import ISOTROPIES, ROUGHNESSES
from albedo_lab.papers.schlick1993.formulas import A, Z, quarter_turn
from albedo_lab.papers.verdict import Printed


def zenith(r: float) -> Estimate:
    """The integral of 2 t Z over [0, 1]."""
    value, error = quad(lambda t: 2.0 * t * float(Z(r, np.array(t))), 0.0, 1.0, epsrel=1e-11, limit=200)
    return bounded(value, error, 0, "Gauss-Kronrod")


def zenith_in_slopes(r: float) -> Estimate:
    """The same in x = tan^2: r / (r + x)^2."""
    value, error = quad(lambda x: r / (r + x) ** 2, 0.0, math.inf)
    return bounded(value, error, 0, "Gauss-Kronrod")


def azimuth(p: float) -> Estimate:
    """The integral of A(w) / sqrt(1 - w^2) over [0, 1], over pi/2."""
    return bounded(quarter_turn(lambda w: A(p, w)), 1e-9, 0, "Gauss-Kronrod")


def azimuth_as_printed(p: float) -> Estimate:
    """The integral of sqrt(1 - w^2) A(w), over pi/2, with w = cos: that of sin^2 A over the azimuth."""
    return bounded(quarter_turn(lambda w: (1.0 - w**2) * A(p, w)), 1e-9, 0, "Gauss-Kronrod")


def azimuth_in_cosines(p: float) -> Estimate:
    """The same in w, as it is printed."""
    value, error = quad(lambda w: math.sqrt(1.0 - w * w) * float(A(p, np.array(w))), 0.0, 1.0, points=[p], limit=200)
    return bounded(value / (0.5 * pi), error, 0, "Gauss-Kronrod")


def cell(
    quantity: str, name: str, value: float, ours: Callable[[float], Estimate], way: str, again: Callable[[float], Estimate]
) -> Cell:
    """A condition at one value of its parameter; each is divided by what it must be, so that all are printed as 1."""
    one = Printed("1", exact=True)
    return Cell(quantity, "schlick", {name: value}, one, lambda means: ours(value), {way: lambda means: again(value)})


TABLES = (
    Table(
        "equation_13",
        "The conditions that Z and A are said to meet",
        "eq. 13, 14",
        (
            *(cell("zenith condition", "r", r, zenith, "in the slopes", zenith_in_slopes) for r in ROUGHNESSES),
            *(cell("azimuth condition", "p", p, azimuth, "√p / agm(1, p)", lambda p: exact(mean_of_A(p))) for p in ISOTROPIES),
            *(cell("azimuth condition as printed", "p", p, azimuth_as_printed, "in w", azimuth_in_cosines) for p in ISOTROPIES),
        ),
        """\
Each condition over what it is to be: ∫ 2tZ dt over 1; ∫ A/√(1-w²) dw over π/2, which is the mean of A over the azimuth, as dφ =
dw/√(1-w²); and ∫ √(1-w²) A dw over π/2, which is how eq. 13 has it. The document prints neither r nor p here; these are those of
figure 6. In x = tan²α, 2tZ dt = r/(r+x)² dx, whose integral is 1 for every r. The mean of A is (2/π) √p K(1-p²), 1 for p = 1
only; that of A² = p/(p² - p²w² + w²), eq. 14 without its root, is 1 for every p.""",
    ),
)
