"""Where a sampler's samples fall, over the light that they are to find, and how much better they find it than cosine sampling."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import cache

import numpy as np
import pandas as pd

from albedo_lab.analysis.verdict import Subject
from albedo_lab.errors import BadInput
from albedo_lab.estimate.record import Question
from albedo_lab.kernels.search import sample_kernel
from albedo_lab.model import Model
from albedo_lab.pictures.base import Curve, Data
from albedo_lab.pictures.evaluation import Array, subject, values
from albedo_lab.pictures.lobes import direction

DRAWN = 1 << 15
"""Samples that efficiency and rejection are measured with; those of the picture are the first of them."""
GRID = 181
"""Points across the disc at which f cos is taken."""
RAREST = 2.0**-50
ROUNDING = 1e-7
"""A relative standard deviation of the weights below this is rounding."""


@dataclass(frozen=True)
class Samples:
    """Curves by their labels, each with `count` samples for viewers at every polar angle of `theta_deg` and the azimuth 0.

    Directions lie in a disc on which equal areas are equal solid angles: at the radius sqrt(1 - cos theta), the viewer towards
    +x. A model without a sampler, or without its density, is sampled by the cosine.
    """

    curves: tuple[Curve, ...]
    theta_deg: tuple[float, ...] = (0.0, 60.0, 85.0)
    count: int = 4000
    seed: int = 0

    def trace(self, threads: int | None = None) -> Data:
        """Columns curve, viewer_deg, x, y (the place in the disc), weight (f cos / pdf); rejected samples are left out.

        "quality" has the columns curve, viewer_deg, own (whether the sampler is the model's own), rejected (share), albedo (mean
        weight), efficiency: the variance of cosine sampling over the sampler's own, infinite where the latter has none. "f cos"
        (curves, angles, GRID, GRID) holds f cos(theta) in 1/sr at even steps of y and x from -1 to 1, NaN beyond the disc.
        Raises BadInput for an angle or a count outside its domain.
        """
        if not 1 <= self.count <= DRAWN:
            raise BadInput("count", self.count, f"must be in [1, {DRAWN}]")
        across = np.linspace(-1.0, 1.0, GRID)
        y, x = (part.ravel() for part in np.meshgrid(across, across, indexing="ij"))
        inside = x * x + y * y < 1.0
        towards = from_disc(x[inside], y[inside])
        f_cos = np.full((len(self.curves), len(self.theta_deg), GRID * GRID), np.nan)
        tables, quality = [], []
        for i, curve in enumerate(self.curves):
            of = subject(curve)
            for j, theta_deg in enumerate(self.theta_deg):
                wo = direction(np.array([theta_deg]), np.zeros(1))
                f_cos[i, j, inside] = values(of, towards, np.broadcast_to(wo, towards.shape)) * towards[:, 2]
                uniforms = np.random.default_rng([self.seed, i, j]).random((DRAWN, 2))
                viewers = np.broadcast_to(wo, (DRAWN, 3))
                wi, density = drawn(of, viewers, uniforms)
                above = np.flatnonzero(wi[:, 2] > 0.0)
                wi, density, viewers = wi[above], density[above], viewers[above]
                weight = weights(of, wi, viewers, density)
                head = {"curve": curve.label, "viewer_deg": theta_deg}
                quality.append({**head, **_quality(of, values(of, wi, viewers), weight)})
                shown = int(np.count_nonzero(above < self.count))
                x_shown, y_shown = to_disc(wi[:shown])
                tables.append(pd.DataFrame({**head, "x": x_shown, "y": y_shown, "weight": weight[:shown]}))
        return {
            "": pd.concat(tables, ignore_index=True),
            "quality": pd.DataFrame(quality),
            "f cos": f_cos.reshape(*f_cos.shape[:2], GRID, GRID),
        }


def has_sampler(of: Subject) -> bool:
    """Whether the model can be sampled by itself: with a density."""
    return of.model.sample is not None and of.model.pdf is not None


@cache
def by_cosine(model: Model) -> Model:
    """The model without sampler and density, which `sample_kernel` samples by the cosine."""
    return replace(model, sample=None, pdf=None)


def drawn(of: Subject, wo: Array, uniforms: Array) -> tuple[Array, Array]:
    """Samples wi (n, 3) for viewers wo (n, 3) and uniforms (n, 2), and their densities; those below the horizon are rejected."""
    model = of.model if has_sampler(of) else by_cosine(of.model)
    wo = np.ascontiguousarray(wo)
    wi, density = np.empty_like(wo), np.empty(len(wo))
    sample_kernel(model)(Question(model, of.p, None).values, np.maximum(uniforms, RAREST), wi, wo, density)
    return wi, density if has_sampler(of) else wi[:, 2] / math.pi


def weights(of: Subject, wi: Array, wo: Array, density: Array) -> Array:
    """f cos / pdf of samples above the horizon. Nothing is clamped: a weight that is not finite stays so."""
    with np.errstate(all="ignore"):
        weight: Array = values(of, wi, wo) * wi[:, 2] / density
    return weight


def _quality(of: Subject, f: Array, weight: Array) -> dict[str, object]:
    """How good the samples of one viewer are, from f and the weight of those that were not rejected.

    Cosine sampling's weight is pi f, so its mean square is the mean of pi f f cos / pdf over these very samples: a narrow lobe,
    which cosine sampling hardly ever hits, needs no samples of its own.
    """
    with np.errstate(all="ignore"):
        albedo = float(np.sum(weight)) / DRAWN
        variance = float(np.sum(weight * weight)) / DRAWN - albedo**2
        of_cosine = float(np.sum(math.pi * f * weight)) / DRAWN - albedo**2
        exact = variance <= (ROUNDING * albedo) ** 2
        efficiency = 1.0 if not has_sampler(of) else math.inf if exact else of_cosine / variance
    return {
        "own": has_sampler(of),
        "rejected": 1.0 - len(f) / DRAWN,
        "albedo": albedo,
        "efficiency": efficiency if albedo != 0.0 else math.nan,
    }


def to_disc(w: Array) -> tuple[Array, Array]:
    """x and y of directions (n, 3) in the disc of equal solid angles; sqrt(1 - z) without taking a number near 1 from 1."""
    outward = 1.0 / np.sqrt(1.0 + w[:, 2])
    return w[:, 0] * outward, w[:, 1] * outward


def from_disc(x: Array, y: Array) -> Array:
    """Inverse of to_disc: unit vectors (n, 3)."""
    square = x * x + y * y
    stretch = np.sqrt(2.0 - square)
    return np.stack([x * stretch, y * stretch, 1.0 - square], axis=-1)
