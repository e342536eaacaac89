"""The coordinates in which a BRDF is smooth: which axis its lobe turns about, and how it falls off: all that quadrature needs."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from enum import IntEnum
from typing import Any

from albedo_lab.optics.frame import Direction, mirror_of
from albedo_lab.optics.profiles import TANGENT, Profile


class Axis(IntEnum):
    """What the polar angle is measured from."""

    NORMAL = 0
    MIRROR = 1
    RETRO = 2
    HALF = 3
    LOBE = 4


class Kink(IntEnum):
    """Where a BRDF has a kink, so that quadrature splits there."""

    NONE = 0
    EQUAL_COSINES = 1
    """Where both directions have the same cosine, as max() of them makes it."""
    V_CAVITY = 2
    """Where the V-cavity factor min(1, 2 (n.h)(n.wo)/(wo.h), 2 (n.h)(n.wi)/(wo.h)) turns over; about HALF only."""


def unit_ellipse(p: Any) -> tuple[float, float]:
    """Widths of an isotropic lobe whose profile already holds its width."""
    return 1.0, 1.0


def no_exponent(p: Any) -> float:
    """For profiles without an exponent."""
    return 0.0


def mirror_axis(p: Any, wo: Direction) -> Direction:
    """The mirror direction, for lobes that turn about another one only where a model says so."""
    return mirror_of(wo)


@dataclass(frozen=True)
class Coordinates:
    """Polar coordinates about `axis` with the radial variable of `profile`.

    `exponent(p)` feeds the profile; `ellipse(p)` holds the widths along x and y in slope space (microfacet normals only).
    `lobe(p, wo)` is the unit vector that Axis.LOBE stands for; it may point below the horizon, and the BRDF is 0 a quarter turn
    and more away from it. `pieces` is into how many panels a quarter turn of azimuth is cut before anything is known: more than
    one for a BRDF with so many kinks that two rules may agree by chance where neither is right; `finest` is the relative error
    below which such a one is not worth its price in a search.
    """

    axis: Axis
    profile: Profile
    exponent: Callable[[Any], float] = no_exponent
    ellipse: Callable[[Any], tuple[float, float]] = unit_ellipse
    kink: Kink = Kink.NONE
    lobe: Callable[[Any, Direction], Direction] = mirror_axis
    pieces: int = 1
    finest: float = 0.0


PLAIN = Coordinates(Axis.NORMAL, TANGENT, kink=Kink.EQUAL_COSINES)
"""Plain spherical angles, split at the other direction's: for a BRDF of which nothing is known."""
