"""Pairs of directions, crowded where reflectance models break: normal, grazing, mirror, retro, and on the axes of azimuth.

A direction is walked by the tangent of its polar angle, which tells normal and grazing ones apart at any scale, and by its
azimuth in quarter turns and a rest, so that a direction said to lie on an axis does so exactly.
"""

from __future__ import annotations

import itertools
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

STEEPEST = 1e12
"""Tangent of the polar angle of the most grazing direction: mu = 1e-12."""
CLOSEST = 1e-9
"""The smallest angle on purpose: to the normal, to an axis, between the two directions."""
LOBE_RADIUS = 1e-7
"""Smallest distance, in the projected hemisphere, from the mirror or retro direction at which sky pairs are spread evenly in
logarithm."""
EPS = float(np.finfo(np.float64).eps)
HALF_PI = 0.5 * np.pi


@dataclass(frozen=True, slots=True)
class Pairs:
    """Light and viewer, each (n, 3)."""

    wi: Array
    wo: Array

    def __len__(self) -> int:
        return len(self.wi)

    def swapped(self) -> Pairs:
        """Viewer and light."""
        return Pairs(self.wo, self.wi)

    def at(self, which: NDArray[np.int64]) -> Pairs:
        """Some of them."""
        return Pairs(self.wi[which], self.wo[which])


def joined(*several: Pairs) -> Pairs:
    """All of them."""
    return Pairs(np.concatenate([pairs.wi for pairs in several]), np.concatenate([pairs.wo for pairs in several]))


def vectors(tangent: Array, quarters: Array, rest: Array) -> Array:
    """Unit vectors (n, 3) from the tangent of the polar angle and the azimuth, in quarter turns plus a rest in radians."""
    z = 1.0 / np.sqrt(1.0 + tangent * tangent)
    s = tangent * z
    c, d = s * np.cos(rest), s * np.sin(rest)
    turn = quarters.astype(np.int64) % 4
    return np.stack([np.choose(turn, (c, -d, -c, d)), np.choose(turn, (d, c, -d, -c)), z], axis=1)


def corners() -> Pairs:
    """Every combination of special polar angles and azimuths: both directions exactly normal, mirrored, on the axes."""
    tangents = (0.0, 1e-9, 1e-4, 0.1, 1.0, 10.0, 1e4, 1e8, STEEPEST)
    axes = tuple(itertools.product((0.0, 1.0, 2.0, 3.0), (0.0, 0.5 * HALF_PI)))
    light = vectors(*(np.array(column) for column in zip(*((t, *axis) for t in tangents for axis in axes), strict=True)))
    first, second = np.divmod(np.arange(len(light) ** 2), len(light))
    return Pairs(light[first], light[second])


def scattered(count: int, rng: np.random.Generator) -> Pairs:
    """Polar angles over all scales, half of the pairs with nearly the same; half of the azimuths near an axis or each other's."""
    seen, turn, rest = _tangents(count, rng), *_azimuths(count, rng)
    alike = seen * np.exp(_offsets(count, rng))
    lit = np.where(rng.random(count) < 0.5, alike, _tangents(count, rng))
    between, more = _azimuths(count, rng)
    return Pairs(vectors(np.minimum(lit, STEEPEST), turn + between, rest + more), vectors(seen, turn, rest))


def sky(count: int, rng: np.random.Generator) -> tuple[Pairs, Array]:
    """Pairs under a white sky, and weights that make sums over them integrals of cos dwi cos dwo / pi^2.

    In the projected hemisphere, a disk, cos dw is area. The viewer is uniform there; the light is so in one part of three, in the
    others spread evenly over the logarithm of its distance from the mirror and from the retro direction, so that a narrow lobe
    about either is not missed; the weight is that of the mixture. Lights outside the disk weigh 0 and are left at the normal.
    """
    radius, angle = np.sqrt(rng.random(count)), 2.0 * np.pi * rng.random(count)
    out = np.stack([radius * np.cos(angle), radius * np.sin(angle)], axis=1)
    radius, angle, kind = rng.random(count), 2.0 * np.pi * rng.random(count), rng.integers(3, size=count)
    span = np.log(2.0 / LOBE_RADIUS)
    step = np.where(kind == 0, np.sqrt(radius), 2.0 * np.exp(-span * radius))
    centre = (kind == 1)[:, None] * -out + (kind == 2)[:, None] * out
    into = centre + np.stack([step * np.cos(angle), step * np.sin(angle)], axis=1)
    mixture = np.full(count, 1.0 / np.pi)
    for sign in (-1.0, 1.0):
        apart = np.hypot(*(into - sign * out).T)
        mixture += np.where(apart >= LOBE_RADIUS, 1.0 / (2.0 * np.pi * span * np.maximum(apart, LOBE_RADIUS) ** 2), 0.0)
    height = 1.0 - np.sum(into * into, axis=1)
    inside = height > 0.0
    weights = np.where(inside, 3.0 / (np.pi * mixture * count), 0.0)
    into = np.where(inside[:, None], into, 0.0)
    return Pairs(
        *(np.column_stack([xy, np.sqrt(np.maximum(1.0 - np.sum(xy * xy, axis=1), 1e-24))]) for xy in (into, out))
    ), weights


def shaken(pairs: Pairs, rng: np.random.Generator) -> Pairs:
    """The same pairs as rounding might have them: x and y by an ulp of the largest of all four, z by an ulp of itself.

    They are no longer unit vectors, for a dot product rounds too.
    """
    size = EPS * np.max(np.abs(np.concatenate([pairs.wi[:, :2], pairs.wo[:, :2]], axis=1)), axis=1)
    moved = []
    for w in (pairs.wi, pairs.wo):
        by = rng.uniform(-1.0, 1.0, w.shape)
        moved.append(w + by * np.column_stack([size, size, EPS * w[:, 2]]))
    return Pairs(*moved)


def around(pairs: Pairs, rng: np.random.Generator, closest: float = 1e-7, farthest: float = 1.0) -> Pairs:
    """One neighbour of every pair, at a distance of any scale from `closest` to `farthest`.

    For half of them the distance is relative to the tangent of the polar angle, so that grazing directions stay so.
    """
    scale = np.exp(rng.uniform(np.log(closest), np.log(farthest), len(pairs)))
    relative = rng.random(len(pairs)) < 0.5
    moved = []
    for w in (pairs.wi, pairs.wo):
        s = np.hypot(w[:, 0], w[:, 1])
        tangent = np.minimum(s / w[:, 2] * np.exp(scale * rng.standard_normal(len(w))), STEEPEST)
        turn = np.arctan2(w[:, 1], w[:, 0]) + scale * rng.standard_normal(len(w))
        beside = w + scale[:, None] * rng.standard_normal(w.shape)
        beside[:, 2] = np.maximum(np.abs(beside[:, 2]), 2.0 / STEEPEST)
        beside /= np.sqrt(np.sum(beside * beside, axis=1))[:, None]
        beside[:, 2] = np.maximum(beside[:, 2], 1.0 / STEEPEST)
        moved.append(np.where(relative[:, None], vectors(tangent, np.zeros(len(w)), turn), beside))
    return Pairs(*moved)


def _tangents(count: int, rng: np.random.Generator) -> Array:
    """A third with a uniform cosine, a third near grazing, a third near the normal, some exactly there."""
    kind, u = rng.integers(3, size=count), rng.random(count)
    mu = np.maximum(u, 1.0 / STEEPEST)
    tangent = np.choose(kind, (np.sqrt((1.0 - mu) * (1.0 + mu)) / mu, STEEPEST**u, CLOSEST**u))
    return np.where(rng.random(count) < 0.03, 0.0, tangent)


def _azimuths(count: int, rng: np.random.Generator) -> tuple[Array, Array]:
    """Half anywhere, half near an axis; of these some exactly there."""
    rest = np.where(rng.random(count) < 0.5, rng.uniform(-0.5 * HALF_PI, 0.5 * HALF_PI, count), _offsets(count, rng))
    return rng.integers(4, size=count).astype(np.float64), rest


def _offsets(count: int, rng: np.random.Generator) -> Array:
    """Of either sign and any scale from CLOSEST to 1; a fifth of them 0."""
    size = CLOSEST ** rng.random(count) * rng.choice(np.array([-1.0, 1.0]), size=count)
    return np.where(rng.random(count) < 0.2, 0.0, size)
