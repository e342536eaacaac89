"""The estimator in NumPy as a user writes it: arrays of a million samples, `sample`, `evaluate`, `pdf`, one `where`.

Directions are arrays of shape (3, samples), the fixed one of shape (3, 1). Nothing here may share code with albedo_lab.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from tests.benchmarks.moments import Moments

Array = NDArray[np.float64]
ARRAY = 1_000_000


class Brdf(Protocol):
    def sample(self, wo: Array, u1: Array, u2: Array) -> Array: ...
    def evaluate(self, wi: Array, wo: Array) -> Array: ...
    def pdf(self, wi: Array, wo: Array) -> Array: ...


def dot(a: Array, b: Array) -> Array:
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def normalize(a: Array) -> Array:
    return a / np.sqrt(dot(a, a))


class StretchedPhong:
    def __init__(self, n: float) -> None:
        self.n = n

    def sample(self, wo: Array, u1: Array, u2: Array) -> Array:
        cos = u1 ** (1 / (self.n + 1))
        sin = np.sqrt(1 - cos**2)
        phi = 2 * np.pi * u2
        r = mirror(wo)
        t = normalize(np.cross(r, [[0.0], [1.0], [0.0]], axis=0))
        b = np.cross(r, t, axis=0)
        return sin * np.cos(phi) * t + sin * np.sin(phi) * b + cos * r

    def evaluate(self, wi: Array, wo: Array) -> Array:
        return np.maximum(dot(mirror(wo), wi), 0) ** self.n / np.maximum(wi[2], wo[2])

    def pdf(self, wi: Array, wo: Array) -> Array:
        return (self.n + 1) / (2 * np.pi) * np.maximum(dot(mirror(wo), wi), 0) ** self.n


def mirror(w: Array) -> Array:
    return w * np.array([[-1.0], [-1.0], [1.0]])


class Ward:
    def __init__(self, m: float) -> None:
        self.m = m

    def sample(self, wo: Array, u1: Array, u2: Array) -> Array:
        slope = self.m * np.sqrt(-np.log(1 - u1))
        phi = 2 * np.pi * u2
        cos = 1 / np.sqrt(1 + slope**2)
        h = np.stack([slope * cos * np.cos(phi), slope * cos * np.sin(phi), cos])
        return 2 * dot(wo, h) * h - wo

    def gaussian(self, h: Array) -> Array:
        return np.exp(-(1 - h[2] ** 2) / (h[2] ** 2 * self.m**2))

    def evaluate(self, wi: Array, wo: Array) -> Array:
        return self.gaussian(normalize(wi + wo)) / (4 * np.pi * self.m**2 * np.sqrt(wi[2] * wo[2]))

    def pdf(self, wi: Array, wo: Array) -> Array:
        h = normalize(wi + wo)
        return self.gaussian(h) / (np.pi * self.m**2 * h[2] ** 3) / (4 * dot(wo, h))


BRDFS: dict[str, Callable[[float], Brdf]] = {"stretched_phong": StretchedPhong, "ward": Ward}


def weights(brdf: Brdf, mu: float, samples: int, random: np.random.Generator) -> Array:
    """f cos / pdf of so many samples; 0 for those below the horizon."""
    wo = np.array([[np.sqrt(1 - mu**2)], [0.0], [mu]])
    wi = brdf.sample(wo, random.random(samples), random.random(samples))
    with np.errstate(invalid="ignore", divide="ignore"):
        weight = brdf.evaluate(wi, wo) * wi[2] / brdf.pdf(wi, wo)
    return np.where(wi[2] > 0, weight, 0.0)


def estimate(model: str, parameter: float, mu: float, samples: int, seed: int, array: int = ARRAY) -> Moments:
    """The albedo of the shape by `samples` samples, a multiple of `array` or fewer than it."""
    random = np.random.default_rng(seed)
    brdf = BRDFS[model](parameter)
    total = squares = 0.0
    for size in [min(array, samples)] * max(1, samples // array):
        w = weights(brdf, mu, size, random)
        total += float(np.sum(w))
        squares += float(np.sum(w * w))
    return Moments(min(array, samples) * max(1, samples // array), total, squares)
