"""Directional albedo against the incident angle, and towards grazing incidence against its cosine."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np
import pandas as pd

from albedo_lab.analysis.albedo import shape_estimate
from albedo_lab.analysis.request import effort, orders
from albedo_lab.analysis.rows import degrees_of
from albedo_lab.estimate.record import Question, Tolerance
from albedo_lab.pictures.base import Curve, Data
from albedo_lab.pictures.evaluation import subject

TOLERANCE = Tolerance(1e-6, 1e-6)
COSINES = np.concatenate([np.cos(np.radians(np.arange(0.0, 89.0, 0.5))), np.geomspace(math.cos(math.radians(89.0)), 1e-7, 121)])


@dataclass(frozen=True)
class Albedos:
    """Curves by their labels; `limits` are their values at 90 degrees (dots), `constants` horizontal lines by label.

    `points` are printed figures to be marked, (cosine, albedo); `to_grazing` adds a panel against the cosine, in logarithms.
    """

    curves: tuple[Curve, ...]
    limits: Mapping[str, float] = field(default_factory=dict)
    constants: Mapping[str, float] = field(default_factory=dict)
    points: tuple[tuple[float, float], ...] = ()
    to_grazing: bool = False

    def trace(self, threads: int | None = None) -> Data:
        """Columns curve, theta_deg, mu, albedo, ci95_low, ci95_high, order ("wo" for a fixed light, "wi" for a fixed viewer).

        A model that is not reciprocal has both orders. An interval wider than asked is kept as it is: it is drawn.
        """
        columns = ["curve", "theta_deg", "mu", "albedo", "ci95_low", "ci95_high", "order"]
        return {"": pd.DataFrame([row for curve in self.curves for row in _rows(curve, threads)], columns=columns)}


def _rows(curve: Curve, threads: int | None) -> Iterator[tuple[Any, ...]]:
    """The albedo at every cosine, in every order that counts."""
    want = replace(effort(None, "quadrature", 0, threads), tolerance=TOLERANCE)
    model, p, scale = (of := subject(curve)).model, of.p, of.scale
    for order in orders(model):
        for mu in COSINES.tolist():
            found = shape_estimate(Question(model, p, mu, order=order), scale, want).scaled(scale)
            yield curve.label, degrees_of(mu), mu, found.value, found.low, found.high, order
