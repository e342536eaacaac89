"""MERL: a measured isotropic surface, a table over half-vector and difference angles read from a file of the MERL database."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from functools import cache, lru_cache
from math import atan, pi, sqrt, tan
from typing import TYPE_CHECKING, Any, NamedTuple

from albedo_lab.errors import BadInput
from albedo_lab.measured.cells import SHAPE, place_of
from albedo_lab.measured.rusinkiewicz import HalfDifference, half_difference
from albedo_lab.model import Choice, File, Model
from albedo_lab.optics.coordinates import Axis, Coordinates
from albedo_lab.optics.frame import Direction, bisector, length, reflect
from albedo_lab.optics.lobes import sample_cosine
from albedo_lab.optics.maths import sincos2pi
from albedo_lab.optics.profiles import Profile
from albedo_lab.sources import matusik2003, nuaj_models, rusinkiewicz1998

if TYPE_CHECKING:
    from albedo_lab.tables import Table

THETA_H, THETA_D, PHI_D = SHAPE
WIDE = 0.25
"""The share of samples drawn by the cosine, so that no weight exceeds pi f / WIDE."""


class Merl(NamedTuple):
    """The cells in 1/sr, negative where nothing was measured; and the density of half-vectors, see albedo_lab.measured.rings."""

    values: Table
    heights: Table
    density: Table
    cumulative: Table


def between(place: float, count: int) -> tuple[int, float]:
    """The lower of the two cells between whose centres a place lies, and how far it is on its way to the upper one.

    Before the first centre and behind the last one the place counts as that centre.
    """
    x = place - 0.5
    cell = int(x) if 0.0 <= x < count - 1.0 else (count - 2 if x >= count - 1.0 else 0)
    return cell, min(max(x - cell, 0.0), 1.0)


def interpolated(p: Merl | Ring, at: HalfDifference) -> float:
    """Linear between the centres of the eight cells around, in the table's own spacing; phi_d goes round.

    Cells without a value are left out, and the weights of the others made to sum to 1. Where all eight are, the nearest
    one's negative value stands as it is stored.
    """
    place = place_of(at)
    i, x = between(place.i, THETA_H)
    j, y = between(place.j, THETA_D)
    k0, z = between(place.k + 1.0, PHI_D + 2)  # one cell further on, so that those of the seam have neighbours
    k0 = (k0 + PHI_D - 1) % PHI_D
    k1 = (k0 + 1) % PHI_D
    total = 0.0
    weight = 0.0
    for a in range(2):
        for b in range(2):
            w = (x if a else 1.0 - x) * (y if b else 1.0 - y)
            f0, f1 = p.values[i + a, j + b, k0], p.values[i + a, j + b, k1]
            w0, w1 = w * (1.0 - z) if f0 >= 0.0 else 0.0, w * z if f1 >= 0.0 else 0.0
            total += w0 * f0 + w1 * f1
            weight += w0 + w1
    if weight == 0.0:
        nearest: float = p.values[i + (x >= 0.5), j + (y >= 0.5), k1 if z >= 0.5 else k0]
        return nearest
    return total / weight


def evaluate(p: Merl, wi: Direction, wo: Direction) -> float:
    return interpolated(p, half_difference(wi, wo))


def evaluate_both_sides(p: Ring, wi: Direction, wo: Direction) -> float:
    """The mean of f on both sides of the plane of incidence. Its albedo is that of f, and it is the same on both sides."""
    at = half_difference(wi, wo)
    other = HalfDifference(at.theta_h, at.theta_d, pi - at.phi_d)
    return 0.5 * (interpolated(p, at) + interpolated(p, other))


def ring_below(borders: Table, value: float) -> int:
    """The ring between whose borders a value lies: halving the distance 7 times, for 90 rings."""
    ring = 0
    step = 64
    while step > 0:
        if ring + step < THETA_H and borders[ring + step] <= value:
            ring += step
        step //= 2
    return ring


def sample(p: Merl, wo: Direction, u1: float, u2: float) -> Direction:
    """By the cosine, or reflected at a half-vector of the table's rings."""
    if u1 < WIDE:
        return sample_cosine(u1 / WIDE, u2)
    u = (u1 - WIDE) / (1.0 - WIDE)
    i = ring_below(p.cumulative, u)
    low, rise = p.density[i], p.density[i + 1] - p.density[i]
    step = p.heights[i + 1] - p.heights[i]
    # within a ring the share grows as 2 pi step (low t + rise t^2 / 2)
    share = (u - p.cumulative[i]) / (2.0 * pi * step)
    root = sqrt(max(low * low + 2.0 * rise * share, 0.0))
    t = min(2.0 * share / (low + root), 1.0) if low + root > 0.0 else 0.0
    height = p.heights[i] + t * step
    sine, (sp, cp) = sqrt(height * (2.0 - height)), sincos2pi(u2)
    return reflect(wo, Direction(sine * cp, sine * sp, 1.0 - height))


def pdf(p: Merl, wi: Direction, wo: Direction) -> float:
    v = bisector(wi, wo)
    whole = length(v)
    height = (v.x * v.x + v.y * v.y) / (whole * (whole + v.z))  # 1 - cos(theta_h)
    i = ring_below(p.heights, height)
    t = (height - p.heights[i]) / (p.heights[i + 1] - p.heights[i])
    half_vectors: float = (1.0 - t) * p.density[i] + t * p.density[i + 1]
    return WIDE * wi.z / pi + (1.0 - WIDE) * half_vectors / (2.0 * whole)  # reflection: 4 (wo.h) = 2 |v|


class Ring(NamedTuple):
    """What quadrature needs: the cells, and the place in theta_h at which a ring of half-vectors begins that is one cell wide."""

    values: Table
    begin: float


def ring_slope(y: float, begin: float) -> tuple[float, float]:
    """The table's own spacing: theta_h = pi/2 (i/90)^2 with i = begin + y."""
    root = max(begin + y, 0.0) / THETA_H
    rho = tan(0.5 * pi * root * root)
    return rho, rho * (1.0 + rho * rho) * pi * root / THETA_H


def ring_coordinate(rho: float, begin: float) -> float:
    """Inverse of ring_slope; 0 below the ring."""
    return max(THETA_H * sqrt(atan(rho) / (0.5 * pi)) - begin, 0.0)


def begin(p: Ring) -> float:
    return p.begin


RING = Coordinates(Axis.HALF, Profile(ring_slope, ring_coordinate, 1.0), exponent=begin, pieces=12, finest=1e-3)
CHOICES = (
    File("file", "binary file of the MERL database"),
    Choice("channel", "which plane of the file", options=("red", "green", "blue"), default="red", swept=True),
)


def without_file(numbers: Mapping[str, float]) -> Any:
    raise BadInput("file", "", "must be given: the path of a binary file of the MERL database")


UNREAD = Model(
    "merl",
    "table over theta_h, theta_d, phi_d",
    Merl,
    (),
    evaluate,
    sample=sample,
    pdf=pdf,
    scale=lambda p: 1.0,
    complete=without_file,
    smooth_in=RING,
    positive=False,
    choices=CHOICES,
    source=nuaj_models(
        'the "MERL 100"',
        "the published lookup takes the nearest cell below; here the table is linear between the cells' centres",
        "cells without a measurement (negative) take no part in that; where there is nothing else the nearest stands as stored",
    ),
    also=(matusik2003("the database"), rusinkiewicz1998("the coordinates")),
)
ONE_RING = replace(UNREAD, parameters_type=Ring, evaluate=evaluate_both_sides)


@lru_cache(maxsize=16)
def member(file: str, state: tuple[int, ...], channel: str) -> Model:
    """The model of one channel of a file in that state; every one holds 12 MB."""
    from albedo_lab.measured.merl_file import read
    from albedo_lab.measured.rings import rings
    from albedo_lab.tables import table

    found = read(file)
    values, census = found.values(channel), found.census(channel)
    measured = Merl(table(values), *map(table, rings(values)))
    # the centres of cells bound the rings in which a table is smooth, as far as theta_h is concerned
    every_ring = tuple((ONE_RING, Ring(measured.values, i - 0.5)) for i in range(THETA_H + 1))
    return replace(
        UNREAD,
        formula=f"{UNREAD.formula}; of {census.cells} cells {census.negative} are without a value, {census.holes} of these above "
        f"the horizon, and {census.zero} are 0",
        complete=lambda numbers: measured,
        parts=lambda p: every_ring,
        make=make,
        chosen={"file": file, "channel": channel},
    )


@cache
def unread(channel: str) -> Model:
    """The record without a file, for those who only look at it."""
    return replace(UNREAD, make=make, chosen={"file": "", "channel": channel})


def make(*, file: str, channel: str) -> Model:
    """The model of one channel of a file. Raises BadInput for a file that is not sound."""
    if not file:
        return unread(channel)
    from albedo_lab.measured.merl_file import identity

    return member(file, identity(file), channel)


MODEL = make(file="", channel="red")
