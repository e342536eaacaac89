"""Pairs of directions at which somebody else's function is tried out, in plain Python."""

from __future__ import annotations

import dis
import math
from collections.abc import Callable, Iterator
from functools import cache
from numbers import Real
from typing import Any

import numpy as np

from albedo_lab.optics.frame import Direction

COSINES = (1.0, 0.97, 0.8, 0.55, 0.3, 0.05)
OFFSETS = ((0.0, 0.0), (1e-3, 2e-3), (0.03, -0.02), (-0.2, 0.3))
TURNS = (0.7, 2.1, 4.0)
NOISE = 1e-6
"""Relative; a lobe of n = 1e8 loses so many digits when a direction is turned."""
NOTHING = 1e-30


@cache
def pairs() -> tuple[tuple[Direction, Direction], ...]:
    """54 pairs (wi, wo), from normal to grazing: at and near the mirror direction and wo itself, and elsewhere."""
    found = []
    for i, mu in enumerate(COSINES):
        wo = direction(mu, 0.4 + i)
        crowd = [(sign * wo.x + dx, sign * wo.y + dy, mu) for sign in (-1.0, 1.0) for dx, dy in OFFSETS]
        found += [(_unit(*place), wo) for place in crowd] + [(direction(0.6, 2.0 + 0.7 * i), wo)]
    return tuple(found)


def direction(mu: float, phi: float) -> Direction:
    """The unit vector of cosine mu and azimuth phi."""
    s = math.sqrt((1.0 - mu) * (1.0 + mu))
    return Direction(s * math.cos(phi), s * math.sin(phi), mu)


def tolerant(function: Callable[..., Any], *arguments: Any) -> Any:
    """What a function returns; NaN where Python's arithmetic raises and that of compiled code, IEEE 754, does not."""
    try:
        with np.errstate(all="ignore"):
            return function(*arguments)
    except ArithmeticError:
        return math.nan
    except ValueError as error:
        trace = error.__traceback__
        while trace is not None and trace.tb_next is not None:
            trace = trace.tb_next
        assert trace is not None
        if trace.tb_frame.f_code.co_code[trace.tb_lasti] == dis.opmap["RAISE_VARARGS"]:
            raise
        return math.nan  # by a function of the library: "math domain error"


def is_number(value: object) -> bool:
    """Whether that is a real number; a truth value is none."""
    return not isinstance(value, bool) and isinstance(value, Real)


def symmetric(evaluate: Callable[..., Any], p: Any) -> bool:
    """Whether f is the same for pairs that are turned about the normal, and for their reflection in a plane through it."""
    for wi, wo in pairs():
        f = tolerant(evaluate, p, wi, wo)
        for moved in _moves(wi, wo):
            other = tolerant(evaluate, p, *moved)
            if math.isfinite(f) != math.isfinite(other) or abs(f - other) > NOISE * max(abs(f), abs(other)) + NOTHING:
                return False
    return True


def _moves(wi: Direction, wo: Direction) -> Iterator[tuple[Direction, Direction]]:
    yield wi._replace(y=-wi.y), wo._replace(y=-wo.y)
    for angle in TURNS:
        yield _turned(wi, angle), _turned(wo, angle)


def _turned(w: Direction, angle: float) -> Direction:
    s, c = math.sin(angle), math.cos(angle)
    return Direction(c * w.x - s * w.y, s * w.x + c * w.y, w.z)


def _unit(x: float, y: float, z: float) -> Direction:
    length = math.sqrt(x * x + y * y + z * z)
    return Direction(x / length, y / length, z / length)
