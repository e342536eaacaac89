"""The coordinates in which a BRDF is smooth: which axis its lobe turns about, and how it falls off: all that quadrature needs."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from enum import IntEnum
from typing import Any

from albedo_lab.optics.profiles import TANGENT, Profile


class Axis(IntEnum):
    """What the polar angle is measured from."""

    NORMAL = 0
    MIRROR = 1
    RETRO = 2
    HALF = 3


def unit_ellipse(p: Any) -> tuple[float, float]:
    """Widths of an isotropic lobe whose profile already holds its width."""
    return 1.0, 1.0


def no_exponent(p: Any) -> float:
    """For profiles without an exponent."""
    return 0.0


@dataclass(frozen=True)
class Coordinates:
    """Polar coordinates about `axis` with the radial variable of `profile`.

    `exponent(p)` feeds the profile; `ellipse(p)` holds the widths along x and y in slope space (microfacet normals only).
    `kink`: the BRDF has a kink where both cosines are equal, as max() makes it; quadrature then splits there.
    """

    axis: Axis
    profile: Profile
    exponent: Callable[[Any], float] = no_exponent
    ellipse: Callable[[Any], tuple[float, float]] = unit_ellipse
    kink: bool = False


PLAIN = Coordinates(Axis.NORMAL, TANGENT, kink=True)
"""Plain spherical angles, split at the other direction's: for a BRDF of which nothing is known."""
