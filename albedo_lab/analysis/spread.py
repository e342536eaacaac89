"""How wide a model spreads the light that falls along the normal, and the parameter at which models are equally wide.

Of light at normal incidence the mirror direction is the normal, so half of what is reflected lies within some angle of it: the
median angle. It needs nothing of a model but f, and means the same for a lobe about any axis and for a diffuse surface (45
degrees for Lambert's). The integral over the cone is of its own: f cos sin by Gauss-Kronrod panels that are halved towards the
normal, the values from the kernel that the pointwise checks use; no coordinates that a model declares are in it.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import brentq

from albedo_lab.estimate.record import Estimate, Question, bounded, exact
from albedo_lab.kernels.kronrod import GAUSS, KRONROD, LANES, NODES
from albedo_lab.kernels.search import value_kernel
from albedo_lab.model import Model, Parameter

COMPARED = math.radians(20.0)
"""The median angle at which models are compared: clearly glossy, and within the reach of every lobe of the catalogue."""
RIGHT = math.pi / 2
HALVINGS = 30
"""The innermost panel begins 1e-9 of a right angle from the normal: ten times nearer than the sharpest lobe is wide."""
AZIMUTHS = 64
"""Of a model that is not isotropic: their mean converges geometrically, and half of them tell its error."""
ROUNDS = 12
"""How often panels may be halved further."""
TOLERANCE = 1e-11
"""Of the integral, relative; a panel whose error is larger than its share is halved."""
ROUNDING = 1e-14
STEPS = 33
"""Values of a parameter, over its domain, between which a crossing is looked for."""
SMALLEST = 1e-3
"""Of the default: where the walk over a domain that begins at 0 begins after it."""
DIGITS = 6
"""Significant digits of the parameter that is found: with these very digits the models are compared."""

Floats = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class Comparable:
    """A model made as wide as the others: which parameter was moved, to which value, the parameters then, the median angle."""

    parameter: str
    value: float
    p: Any
    angle: Estimate


def share_within(model: Model, p: Any, angle: float) -> Estimate:
    """Which share of the light reflected at normal incidence leaves within `angle` (radians) of the mirror direction.

    The light is fixed, the viewer moves; a Dirac part is at angle 0. The error is a bound. NaN where nothing is reflected, or the
    values of f are no numbers.
    """
    at_zero = float(model.mirror(p, 1.0))
    near, near_error, count = _cone(model, p, 0.0, angle)
    far, far_error, more = _cone(model, p, angle, RIGHT)
    total = at_zero + near + far
    if not (math.isfinite(total) and total > 0.0):
        return bounded(math.nan, math.nan, count + more, "quadrature")
    share = (at_zero + near) / total
    bound = ((1.0 - share) * near_error + share * far_error) / total + ROUNDING
    return bounded(share, bound, count + more, "quadrature")


def median_angle(model: Model, p: Any) -> Estimate:
    """The angle from the mirror direction within which half of the light reflected at normal incidence leaves, in degrees.

    0 where a Dirac part has half of it. The bound is the width of the bracket found by shares that are surely too small and too
    large. NaN where the share is.
    """
    whole = share_within(model, p, RIGHT)
    if not math.isfinite(whole.value):
        return whole
    if _over_half(model, p, 0.0):
        return exact(0.0)
    samples = 0

    def excess(log_angle: float) -> float:
        nonlocal samples
        share = share_within(model, p, math.exp(log_angle))
        samples += share.samples
        return share.value - 0.5

    low, high = math.log(RIGHT) - HALVINGS * math.log(2.0), math.log(RIGHT)
    found = math.exp(float(brentq(excess, low, high, xtol=1e-13, rtol=1e-13)))
    step = 1e-9 * found
    while step < found and not (_surely(model, p, found - step, -1.0) and _surely(model, p, found + step, 1.0)):
        step *= 4.0
    return bounded(math.degrees(found), math.degrees(step), samples, "quadrature")


def comparable(model: Model, angle: float = COMPARED) -> Comparable | None:
    """The model with the median angle `angle` (radians), all other parameters at their defaults; None where there is none such.

    Moved is the parameter that the record calls its `width`; where it names none, the first logarithmic one (no other sets it)
    that has exactly one value with that median angle in its domain. A width acts by its factor and is logarithmic; shares,
    reflectances and factors of lobes are not.
    """
    for parameter in _candidates(model):
        value = _solved(model, parameter, angle)
        if value is not None:
            p = model.bind({parameter.name: value})
            return Comparable(parameter.name, value, p, median_angle(model, p))
    return None


def _candidates(model: Model) -> Sequence[Parameter]:
    """The parameters that may be the width."""
    if model.width:
        return [parameter for parameter in model.parameters if parameter.name == model.width]
    passive = {name for parameter in model.parameters for name in parameter.sets}
    return [parameter for parameter in model.parameters if parameter.scale == "log" and parameter.name not in passive]


def _solved(model: Model, parameter: Parameter, angle: float) -> float | None:
    """The one value of the parameter with that median angle, to DIGITS digits; None where there are none or several."""

    def excess(value: float) -> float:
        return share_within(model, model.bind({parameter.name: value}), angle).value - 0.5

    walk = _walk(parameter)
    seen = [excess(value) for value in walk]
    signs = zip(pairwise(walk), pairwise(seen), strict=True)
    brackets = [between for between, (a, b) in signs if a < 0.0 <= b or b < 0.0 <= a]
    if len(brackets) != 1:
        return None
    low, high = brackets[0]
    return float(f"{brentq(excess, low, high, xtol=1e-12 * high, rtol=1e-12):.{DIGITS}g}")


def _walk(parameter: Parameter) -> list[float]:
    """Values over the domain, ends included, equal steps of its scale."""
    if parameter.scale != "log":
        return [float(value) for value in np.linspace(parameter.low, parameter.high, STEPS)]
    first = parameter.low or SMALLEST * parameter.default
    steps = np.geomspace(first, parameter.high, STEPS)
    steps[0], steps[-1] = first, parameter.high  # not a rounding beyond
    return [*([0.0] if parameter.low == 0.0 else []), *map(float, steps)]


def _over_half(model: Model, p: Any, angle: float) -> bool:
    return share_within(model, p, angle).value >= 0.5


def _surely(model: Model, p: Any, angle: float, side: float) -> bool:
    """Whether the share within the angle is off one half, to that side, by more than its error."""
    share = share_within(model, p, angle)
    return side * (share.value - 0.5) > share.half_width


def _cone(model: Model, p: Any, low: float, high: float) -> tuple[float, float, int]:
    """The integral of f cos over angles from the normal between low and high, its bound, and the number of evaluations."""
    inside = high * 0.5 ** np.arange(HALVINGS, -1, -1.0)
    edges = np.concatenate([[low], inside[inside > low]])
    left, right = edges[:-1], edges[1:]
    value, bound, count = 0.0, 0.0, 0
    if not low < high:
        return value, bound, count
    f_cos = _rings(model, p)
    for turn in range(ROUNDS):
        middle, half = 0.5 * (left + right), 0.5 * (right - left)
        y, error = f_cos(middle[:, None] + half[:, None] * NODES[: LANES - 1])
        count += y.size
        fine, coarse = half * (y @ KRONROD[: LANES - 1]), half * (y @ GAUSS[: LANES - 1])
        off = np.abs(fine - coarse) + half * (error @ KRONROD[: LANES - 1])
        allowed = TOLERANCE * (abs(value) + abs(float(fine.sum()))) / len(off)
        again = (off > allowed) & (turn + 1 < ROUNDS)
        value += float(fine[~again].sum())
        bound += float(off[~again].sum())
        if not again.any():
            break
        left, right = np.concatenate([left[again], middle[again]]), np.concatenate([middle[again], right[again]])
    return value, bound, count


def _rings(model: Model, p: Any) -> Callable[[Floats], tuple[Floats, Floats]]:
    """f cos sin, integrated over the azimuth, for an array of angles from the normal; and the error of that."""
    turns = np.zeros(1) if model.isotropic(p) else 2.0 * math.pi * (np.arange(AZIMUTHS) + 0.5) / AZIMUTHS
    kernel, values = value_kernel(model), Question(model, p, None).values

    def integrated(theta: Floats) -> tuple[Floats, Floats]:
        z, s = np.cos(theta), np.sin(theta)
        wo = np.stack([np.multiply.outer(s, np.cos(turns)), np.multiply.outer(s, np.sin(turns))], axis=-1)
        wo = np.concatenate([wo, np.broadcast_to(z[..., None, None], (*wo.shape[:-1], 1))], axis=-1).reshape(-1, 3)
        f = np.empty(len(wo))
        with np.errstate(all="ignore"):
            kernel(values, np.tile([0.0, 0.0, 1.0], (len(wo), 1)), wo, f)
        rings = f.reshape(*theta.shape, len(turns))
        mean = rings.mean(axis=-1)
        error = np.abs(mean - rings[..., ::2].mean(axis=-1)) if len(turns) > 1 else np.zeros_like(mean)
        measure = 2.0 * math.pi * z * s
        return mean * measure, error * measure

    return integrated
