"""The cells of a MERL table: 90 of theta_h, closer together towards 0, 90 of theta_d and 180 of phi_d, a degree each.

A cell holds all directions from its lower border to its upper one, as the lookup published with the data has it, which
rounds down. Its value is taken to stand at its centre, (i + 1/2, j + 1/2, k + 1/2): no other place favours no neighbour.
"""

from __future__ import annotations

from math import pi, sqrt
from typing import NamedTuple

from albedo_lab.measured.rusinkiewicz import HalfDifference, lower_cosine

SHAPE = (90, 90, 180)
"""Cells of theta_h, theta_d and phi_d; phi_d varies fastest."""
LOWEST = 1e-3
"""Cosine of the lowest direction at which a cell is evaluated: the 17th part of a cell above the horizon."""
NEAREST = 2.0**-10
"""Of the way from a cell's highest corner to its centre; nearer than that it makes no difference to the cosine."""


class Place(NamedTuple):
    """Where a pair of directions lies in the table: its cell is (int(i), int(j), int(k))."""

    i: float
    j: float
    k: float


def place_of(at: HalfDifference) -> Place:
    """The place in the table."""
    return Place(90.0 * sqrt(at.theta_h / (0.5 * pi)), at.theta_d * (180.0 / pi), at.phi_d * (180.0 / pi))


def angles_at(place: Place) -> HalfDifference:
    """Inverse of place_of."""
    root = place.i / 90.0
    return HalfDifference(0.5 * pi * root * root, place.j * (pi / 180.0), place.k * (pi / 180.0))


def highest_corner(i: int, j: int, k: int) -> Place:
    """The corner of a cell at which the lower of both directions is farthest above the horizon."""
    return Place(1.0 * i, 1.0 * j, 1.0 * (k if k >= 90 else k + 1))


def point_of(i: int, j: int, k: int) -> HalfDifference:
    """Where a formula is evaluated for a cell: its centre.

    Where that lies below the horizon, half the way to the cell's highest corner, or half of what is left, and so on; of a cell
    that is nowhere LOWEST above the horizon, a point that is not either.
    """
    top = highest_corner(i, j, k)
    away = 1.0
    at = angles_at(Place(i + 0.5, j + 0.5, k + 0.5))
    while lower_cosine(at) < LOWEST and away > NEAREST:
        away *= 0.5
        di, dj, dk = i + 0.5 - top.i, j + 0.5 - top.j, k + 0.5 - top.k
        at = angles_at(Place(top.i + away * di, top.j + away * dj, top.k + away * dk))
    return at
