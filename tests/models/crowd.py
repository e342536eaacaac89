"""A crowd of direction pairs, compiled: half of the directions near the normal or grazing, a third mirrored or retro."""

from __future__ import annotations

from math import sqrt
from typing import Any

import numpy as np
from numpy.typing import NDArray

from albedo_lab.estimate.record import Question
from albedo_lab.kernels.jit import Placeholder, specialise
from albedo_lab.kernels.uniforms import philox
from albedo_lab.model import Model
from albedo_lab.optics.frame import Direction
from albedo_lab.optics.maths import exp, sincos2pi

GRAZING, NORMAL = 27.0, 20.0
"""Logarithms of the smallest cosine (2e-12) and of the smallest sine (2e-9)."""
LARGEST = 1.7976931348623157e308
NON_FINITE, NEGATIVE, BAD_DENSITY = range(3)

Parameters = Placeholder("Parameters")
evaluate = Placeholder("evaluate")
pdf = Placeholder("pdf")


def crowded(u: float, v: float, turn: float) -> Direction:
    """A direction whose polar angle is spread over all scales."""
    c = exp(-GRAZING * v) if u < 0.25 else v
    s = exp(-NORMAL * v) if 0.25 <= u < 0.5 else sqrt((1.0 - c) * (1.0 + c))
    c = sqrt((1.0 - s) * (1.0 + s)) if 0.25 <= u < 0.5 else c
    sp, cp = sincos2pi(turn)
    return Direction(s * cp, s * sp, c)


def judge(count: int, key: Any, values: Any, tally: Any) -> None:
    """Adds to the tally what is wrong with f and the density at so many pairs."""
    p = Parameters(*values)
    for i in range(count):
        u1, u2 = philox(np.uint32(i), np.uint32(0), key)
        u3, u4 = philox(np.uint32(i), np.uint32(1), key)
        u5, u6 = philox(np.uint32(i), np.uint32(2), key)
        kind, _ = philox(np.uint32(i), np.uint32(3), key)
        wo = crowded(u1, u2, u3)
        near = wo if kind < 1.0 / 6.0 else Direction(-wo.x, -wo.y, wo.z)
        wi = near if kind < 1.0 / 3.0 else crowded(u4, u5, u6)
        f = evaluate(p, wi, wo)
        density = pdf(p, wi, wo)
        tally[NON_FINITE] += not abs(f) <= LARGEST
        tally[NEGATIVE] += f < 0.0
        tally[BAD_DENSITY] += not 0.0 <= density <= LARGEST


def cosine(p: Any, wi: Direction, wo: Direction) -> float:
    """The density of a model without a sampler."""
    return wi.z


def unsound(model: Model, p: Any, count: int) -> NDArray[np.float64]:
    """How many of so many pairs give an f that is not finite, a negative f, a density that is neither finite nor positive."""
    tally = np.zeros(3)
    kernel = specialise(judge, Parameters=model.parameters_type, evaluate=model.evaluate, pdf=model.pdf or cosine)
    kernel(count, np.uint32(7), Question(model, p, None).values, tally)
    return tally
