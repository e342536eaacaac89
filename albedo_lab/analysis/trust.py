"""How far quadrature can be trusted with a model that may be sick: are its parts its own, and which digits can be had?"""

from __future__ import annotations

import math
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


@lru_cache(maxsize=256)
def limited(model: Model, relative: float) -> Model:
    """The model with no search finer than a relative tolerance."""
    if model.smooth_in.finest >= relative:
        return model
    return replace(model, smooth_in=replace(model.smooth_in, finest=relative))


@lru_cache(maxsize=256)
def trusted(model: Model, p: Any) -> Model:
    """The model, without its parts where these do not sum to its f: a copy of a model with another f has them still."""
    if model.parts is None:
        return model
    rng = np.random.default_rng(0)
    for a, b, turn, phi in rng.random((PAIRS, 4)).tolist():
        wi = Direction(*incident(max(a * a, 1e-6), 2.0 * math.pi * phi))
        wo = Direction(*incident(max(b, 1e-6), 2.0 * math.pi * (phi + turn)))
        # half of the pairs near the mirror direction, where narrow lobes are
        wi = wi if turn < 0.5 else Direction(*incident(max(b * (1.0 - 1e-3 * a), 1e-6), 2.0 * math.pi * (phi + turn) + math.pi))
        try:
            whole = model.evaluate(p, wi, wo)
            parts = math.fsum(part.evaluate(values, wi, wo) for part, values in model.parts(p))
        except (ArithmeticError, ValueError):
            continue
        if not math.isclose(whole, parts, rel_tol=1e-9, abs_tol=1e-12):
            return replace(model, parts=None)
    return model


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
