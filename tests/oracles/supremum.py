"""Supremum of the directional albedo of an isotropic shape over mu in (0, 1]; its inverse is the maximum constant."""

from __future__ import annotations

import math

import numpy as np
from scipy.optimize import minimize_scalar

from tests.oracles.albedo import HALF_PI, albedo, albedo_plain, check_parameters, unbounded_at_grazing
from tests.oracles.quadrature import graded_rule


def supremum(model: str, order: str = "wi", **parameters: float) -> tuple[float, float, float]:
    """(supremum, error, angle of the peak in radians); (inf, 0, pi/2) where the albedo is unbounded at grazing angles.

    A scan of about a hundred angles, geometrically dense towards both ends, which are included (grazing as a limit);
    then golden-section refinement around the best one; then the reference albedo at the peak.  A maximum missed by the
    position error h costs a''h^2/2, some 1e-13, because the peak is flat; the error adds what the refinement could not
    decide.
    """
    par = check_parameters(model, parameters)
    if unbounded_at_grazing(model, order):
        return math.inf, 0.0, HALF_PI
    rule = graded_rule(18, 14)

    def height(theta: float) -> float:
        mu = math.sin(HALF_PI - theta) if theta > 0.25 * math.pi else math.cos(theta)
        return albedo_plain(model, min(max(mu, 0.0), 1.0), 0.0, order, rule, par)

    def final(theta: float) -> tuple[float, float]:
        mu = 0.0 if theta == HALF_PI else math.cos(theta)
        return albedo(model, mu, 0.0, order, **par)

    middle = np.linspace(0.0, HALF_PI, 49)[1:-1]
    ends = middle[0] * 0.5 ** np.arange(1.0, 24.0)
    grid = [0.0, *ends[::-1], *middle, *(HALF_PI - ends), HALF_PI]
    heights = [height(theta) for theta in grid]
    best = int(np.argmax(heights))
    value, error, theta = max((*final(end), end) for end in (0.0, HALF_PI))
    if 0 < best < len(grid) - 1:
        found = minimize_scalar(
            lambda angle: -height(angle),
            bounds=(grid[best - 1], grid[best + 1]),
            method="bounded",
            options={"xatol": 1e-8},
        )
        peak = float(found.x)
        inner, inner_error = final(peak)
        inner_error += abs(height(peak) - max(height(peak - 1e-6), height(peak + 1e-6)))
        if inner - inner_error > value + error:  # an end wins a tie
            value, error, theta = inner, inner_error, peak
    return value, error, theta
