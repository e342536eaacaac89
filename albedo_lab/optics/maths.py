"""Elementary functions that models are written with.

In plain Python they behave as below. Compiled, each is replaced by the function of the same name in
`albedo_lab.kernels.vmath`, which runs in SIMD lanes; `math.exp` and its kin would stay scalar calls and cost 4 to 10 times more.
Both faces follow IEEE 754: no exception, but inf or NaN.
"""

from __future__ import annotations

import math
from math import inf, nan


def exp(x: float) -> float:
    """e to the x; inf where it overflows."""
    try:
        return math.exp(x)
    except OverflowError:
        return inf


def expm1(x: float) -> float:
    """e to the x, minus 1, without cancellation at small x."""
    try:
        return math.expm1(x)
    except OverflowError:
        return inf


def log(x: float) -> float:
    """Natural logarithm; -inf at 0, NaN below."""
    return math.log(x) if x > 0 else (-inf if x == 0 else nan)


def log1p(x: float) -> float:
    """Natural logarithm of 1 + x, without cancellation at small x; -inf at -1, NaN below."""
    return math.log1p(x) if x > -1 else (-inf if x == -1 else nan)


def pow(x: float, y: float) -> float:
    """x to the y for x >= 0; NaN for negative x, but 1 for any x to the 0, as in C."""
    if x < 0 and y != 0:
        return nan
    try:
        return math.pow(x, y)
    except OverflowError:
        return inf
    except ValueError:
        return inf if x == 0 and y < 0 else nan


def sincos2pi(u: float) -> tuple[float, float]:
    """Sine and cosine of 2 pi u."""
    if math.isinf(u):
        return nan, nan
    return math.sin(2 * math.pi * u), math.cos(2 * math.pi * u)
