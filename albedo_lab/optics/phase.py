"""How a volume scatters: Henyey and Greenstein's phase function, and directions that follow it and stay above the surface."""

from __future__ import annotations

from math import pi, sqrt

from albedo_lab.optics.frame import Direction, about_axis
from albedo_lab.optics.maths import sincos2pi


def henyey_greenstein(g: float, chord: float) -> float:
    """(1 - g^2) / (1 + g^2 - 2 g cos)^(3/2), of mean 1 over the sphere; g is the mean of the cosine.

    `chord` is the squared distance of both unit vectors, 2 - 2 cos: a narrow lobe loses no digits.
    """
    spread = (1.0 - g) * (1.0 - g) + g * chord
    return (1.0 - g * g) / (spread * sqrt(spread))


def chord(a: Direction, b: Direction) -> float:
    """Squared distance of two unit vectors."""
    x, y, z = a.x - b.x, a.y - b.y, a.z - b.z
    return x * x + y * y + z * z


def sample_folded(axis: Direction, g: float, u1: float, u2: float) -> Direction:
    """A direction of Henyey and Greenstein's lobe about an axis above the surface, mirrored up if it lies below.

    Nothing is rejected; about an axis and about its image in the surface the samples are the same.
    """
    s = 2.0 * u1 - 1.0
    gg = g * g
    scale = 1.0 + g * s
    # the usual inverse, multiplied out so that nothing is divided by g
    c = (s * (1.0 + gg) + 0.5 * g * (s * s * (1.0 + gg) + 3.0 - gg)) / (scale * scale)
    w = about_axis(axis, sqrt(max((1.0 - c) * (1.0 + c), 0.0)), c, sincos2pi(u2))
    return Direction(w.x, w.y, abs(w.z))


def folded_pdf(axis: Direction, g: float, w: Direction) -> float:
    """Density of sample_folded."""
    below = Direction(w.x, w.y, -w.z)
    return (henyey_greenstein(g, chord(axis, w)) + henyey_greenstein(g, chord(axis, below))) / (4.0 * pi)
