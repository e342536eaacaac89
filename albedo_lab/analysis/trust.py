"""How far quadrature can be trusted with a model that may be sick: are its parts its own, and which digits can be had?"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from functools import lru_cache
from typing import Any

import numpy as np

from albedo_lab.estimate.quadrature import quadrature
from albedo_lab.estimate.record import Question, Tolerance
from albedo_lab.estimate.sampling import incident
from albedo_lab.model import Model
from albedo_lab.optics.frame import Direction

LEVELS = (1e-4, 1e-6, 1e-8, 1e-10)
"""Relative tolerances of quadrature, from one that tells little to the last that is worth its price."""
PROBES = (1.0, 0.5, 1e-2, 1e-6)
SEARCH = 300
AZIMUTH_SEARCH = 700
"""Integrals that a search costs, about, and coarse ones to be added where azimuths count, too."""
CHEAPER = 8
"""Evaluations of quadrature, without random numbers and several at once, that cost as much as one sample."""
PAIRS = 64
TURN = 1.0
"""An angle by which no crystal of finite order repeats, in radians."""


@lru_cache(maxsize=256)
def limited(model: Model, relative: float) -> Model:
    """The model with no search finer than a relative tolerance."""
    if model.smooth_in.finest >= relative:
        return model
    return replace(model, smooth_in=replace(model.smooth_in, finest=relative))


@lru_cache(maxsize=256)
def trusted(model: Model, p: Any) -> Model:
    """The model, without what it says of itself and what its f belies: parts that do not sum to f, and being isotropic.

    A copy of a model with another f still has its parts, and may still say that azimuths do not matter.
    """
    divided = model.smooth_in.finest > 0.0  # the parts of a table divide its domain, not f
    if model.parts is not None and not divided and _belied(model, p, _is_not_the_sum):
        model = replace(model, parts=None)
    if model.isotropic(p) and _belied(model, p, _turns):
        model = replace(model, isotropic=lambda p: False)
    return model


def _belied(model: Model, p: Any, fault: Callable[[Model, Any, Direction, Direction], bool]) -> bool:
    """Whether some pair of directions shows the fault; half of them near the mirror direction, where narrow lobes are."""
    rng = np.random.default_rng(0)
    for a, b, turn, phi in rng.random((PAIRS, 4)).tolist():
        wi = Direction(*incident(max(a * a, 1e-6), 2.0 * math.pi * phi))
        wo = Direction(*incident(max(b, 1e-6), 2.0 * math.pi * (phi + turn)))
        wi = wi if turn < 0.5 else Direction(*incident(max(b * (1.0 - 1e-3 * a), 1e-6), 2.0 * math.pi * (phi + turn) + math.pi))
        try:
            if fault(model, p, wi, wo):
                return True
        except (ArithmeticError, ValueError):
            continue
    return False


def _is_not_the_sum(model: Model, p: Any, wi: Direction, wo: Direction) -> bool:
    """Whether the parts sum to something else than f."""
    assert model.parts is not None
    parts = math.fsum(part.evaluate(values, wi, wo) for part, values in model.parts(p))
    return not math.isclose(model.evaluate(p, wi, wo), parts, rel_tol=1e-9, abs_tol=1e-12)


def _turns(model: Model, p: Any, wi: Direction, wo: Direction) -> bool:
    """Whether f changes when the surface is turned: by more than a narrow lobe's share of the rounding of directions."""
    s, c = math.sin(TURN), math.cos(TURN)
    turned = (Direction(c * w.x - s * w.y, s * w.x + c * w.y, w.z) for w in (wi, wo))
    return not math.isclose(model.evaluate(p, wi, wo), model.evaluate(p, *turned), rel_tol=1e-4, abs_tol=1e-12)


def reachable(model: Model, p: Any, order: str, budget: int) -> float | None:
    """The finest relative tolerance that a search within the budget can ask of quadrature; None where there is none."""
    azimuths = 0 if model.isotropic(p) else AZIMUTH_SEARCH
    reached, first = None, 0.0
    for relative in LEVELS:
        within = Tolerance(0.0, max(relative, model.smooth_in.finest))
        cost = 0.0
        for mu in PROBES:
            e = quadrature(Question(model, p, mu, 0.3, order), within)
            cost += e.samples / len(PROBES)
            if math.isfinite(e.value) and (not e.reaches(within) or cost * SEARCH + first * azimuths > CHEAPER * budget):
                return reached
        reached, first = within.relative, first or cost
        if reached > relative:
            break
    return reached
