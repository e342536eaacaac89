"""How the statements of this document are tried: propositions, and what the engine says of a model."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np

from albedo_lab.digits import with_error
from albedo_lab.estimate.quadrature import quadrature
from albedo_lab.estimate.record import Estimate, Question, Tolerance
from albedo_lab.estimate.sampling import monte_carlo, rqmc
from albedo_lab.papers.neumann1999.equations import Array, Brdf, hemisphere
from albedo_lab.papers.recipes import Means
from albedo_lab.papers.record import Trial
from albedo_lab.papers.trials import Found, apart, subject_of, trial
from albedo_lab.pictures.evaluation import in_plane, values

PRINTED = "the printed equation"
CODE = "the model's compiled code"
MANY = 10_000
"""Pairs of directions."""
SAME = 1e-9
"""Relative difference that rounding explains: a power multiplies what its base lost by its exponent."""
ANGLES = (5.0, 45.0, 80.0)
"""Viewers for whom samplers are tried, in degrees."""


def cosine(theta_deg: float) -> float:
    """The cosine of an angle in degrees, 0 at 90."""
    return math.sin(math.radians(90.0 - theta_deg))


def question(model: str, theta_deg: float, order: str = "wi", **parameters: Any) -> tuple[Question, Estimate]:
    """The question for the albedo of a model's shape at an angle, and its constant."""
    subject = subject_of(model, **parameters)
    return Question(subject.model, subject.p, cosine(theta_deg), 0.0, order), subject.scale


def albedo(model: str, theta_deg: float, **parameters: Any) -> float:
    """The albedo at an angle by quadrature, to nine digits, with the constant that the source prescribes."""
    asked, scale = question(model, theta_deg, **parameters)
    return quadrature(asked, Tolerance(0.0, 1e-9)).value * scale.value


def sampled(model: str, theta_deg: float, means: Means, **parameters: Any) -> str:
    """The same by samples, with half of its 95 % interval."""
    asked, scale = question(model, theta_deg, **parameters)
    return with_error(rqmc(asked, Tolerance(0.0, 1e-4), means.seed, means.threads or 1, 1 << 20).scaled(scale), 1e-6)


def variance(model: str, theta_deg: float, means: Means, by_cosine: bool = False, **parameters: Any) -> float:
    """Variance of the weight f cos / pdf of a sample over its square mean, rejected samples included.

    By the model's own sampler, or by the cosine.
    """
    asked, _ = question(model, theta_deg, **parameters)
    if by_cosine:
        asked = replace(asked, model=replace(asked.model, sample=None, pdf=None, weight=None))
    e = monte_carlo(asked, Tolerance(0.0, 1.0), means.seed, means.threads or 1)
    return (e.standard_error / e.value) ** 2 * e.samples


def in_section(model: str, light_deg: float, viewer_deg: Any, **parameters: Any) -> Array:
    """f towards viewers in the plane of incidence, positive angles on the mirror's side."""
    viewers = np.atleast_1d(np.asarray(viewer_deg, dtype=float))
    light = in_plane(np.full(len(viewers), -light_deg))
    return values(subject_of(model, **parameters), light, in_plane(viewers))


def at_mirror(model: str, light_deg: float, **parameters: Any) -> float:
    """Radiance towards the mirror direction under a point light, of irradiance cos Theta_L: f cos Theta_L."""
    return float(in_section(model, light_deg, light_deg, **parameters)[0]) * cosine(light_deg)


def exchanged(f: Brdf) -> Callable[[Means], str]:
    """The second method of checks of reciprocity: by how much a printed shape changes when light and viewer change places."""

    def told(means: Means) -> str:
        L, V = hemisphere(means.seed, MANY), hemisphere(means.seed + 1, MANY)
        return f"largest relative difference {apart(f(L, V), f(V, L)):.1g} over {MANY} pairs ({PRINTED})"

    return told


def identical(printed: Brdf, derived: Brdf, model: str, why: str = "", **parameters: Any) -> Trial:
    """Whether a printed shape is the same function as what it is derived from, and as a model's code without its constant."""

    def find(means: Means) -> Found:
        L, V = hemisphere(means.seed, MANY), hemisphere(means.seed + 1, MANY)
        subject = subject_of(model, **parameters)
        f = printed(L, V)
        first, second = apart(f, derived(L, V)), apart(f, values(subject, L, V) / subject.scale.value)
        told = f"largest relative difference {{:.1g}} over {MANY} pairs of directions"
        return Found(first <= SAME and second <= SAME, told.format(first), PRINTED, f"{told.format(second)} ({CODE})")

    return trial(find, why)
