"""The templates behind searches for what is wrong with a model: f at given pairs of directions, samples and their densities.

They fill arrays and judge nothing. No flag of the compiler lets it assume that a number is finite, so a NaN comes out as one.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from typing import Any

from albedo_lab.kernels.jit import Placeholder, specialise
from albedo_lab.model import Model
from albedo_lab.optics.frame import Direction
from albedo_lab.optics.lobes import sample_cosine

GIVEN = 0.0
"""In place of the first uniform: the pair is given, nothing is to be sampled."""

Parameters = Placeholder("Parameters")
evaluate = Placeholder("evaluate")
sample = Placeholder("sample")
pdf = Placeholder("pdf")


def fill_values(values, wi, wo, f):
    """f of every pair: wi and wo are (n, 3)."""
    p = Parameters(*values)
    for i in range(len(f)):
        f[i] = evaluate(p, Direction(wi[i, 0], wi[i, 1], wi[i, 2]), Direction(wo[i, 0], wo[i, 1], wo[i, 2]))


def fill_samples(values, uniforms, wi, wo, density):
    """Draws wi for the uniforms (n, 2) where the first is not GIVEN, and takes the density of every pair."""
    p = Parameters(*values)
    for i in range(len(density)):
        viewer = Direction(wo[i, 0], wo[i, 1], wo[i, 2])
        light = Direction(wi[i, 0], wi[i, 1], wi[i, 2])
        if uniforms[i, 0] != GIVEN:
            light = sample(p, viewer, uniforms[i, 0], uniforms[i, 1])
            wi[i, 0] = light.x
            wi[i, 1] = light.y
            wi[i, 2] = light.z
        density[i] = pdf(p, light, viewer)


def cosine_sample(p, wo, u1, u2):
    """Stands for the sampler of a model that has a density alone."""
    return sample_cosine(u1, u2)


def no_density(p, wi, wo):
    """Stands for the density of a model that has a sampler alone."""
    return 1.0


@cache
def value_kernel(model: Model) -> Callable[..., Any]:
    """fill_values for one model."""
    return specialise(fill_values, Parameters=model.parameters_type, evaluate=model.evaluate)


@cache
def sample_kernel(model: Model) -> Callable[..., Any]:
    """fill_samples for one model."""
    return specialise(
        fill_samples,
        Parameters=model.parameters_type,
        sample=model.sample or cosine_sample,
        pdf=model.pdf or no_density,
    )
