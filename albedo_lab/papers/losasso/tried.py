"""How the statements of this document are tried: a proposition with the figures that decide it."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

from albedo_lab.digits import with_error
from albedo_lab.estimate.quadrature import quadrature
from albedo_lab.estimate.record import Estimate, Question, Tolerance, exact
from albedo_lab.papers.losasso.equations import Equation, hemisphere, reflected
from albedo_lab.papers.recipes import Means
from albedo_lab.papers.trials import Found, apart, subject_of

PRINTED = "the printed equation on a grid"
MANY = 10_000
"""Pairs of directions."""
FRACTION = "The fraction of light that is reflected through specular reflection"


def share(model: str, theta_deg: float, irradiance: float, order: str = "wo", **parameters: Any) -> Estimate:
    """The share of the light from an angle that a model sends back, as `reflected` of the equations has it, by quadrature."""
    subject = subject_of(model, **parameters)
    mu = math.sin(math.radians(90.0 - theta_deg))
    found = quadrature(Question(subject.model, subject.p, mu, 0.0, order), Tolerance(0.0, 1e-9))
    return found.scaled(exact(subject.scale.value / irradiance))


def told(e: Estimate) -> str:
    """An estimate for a cell, to six digits at most."""
    return with_error(e, 1e-6 * max(abs(e.value), 1e-6))


def lit(equation: Equation, irradiance: float = 1.0) -> str:
    """What a printed equation sends back from three angles, for the second method of checks of energy."""
    shares = ", ".join(f"{reflected(equation, math.radians(a), irradiance):.4f} at {a}°" for a in (0, 60, 85))
    return f"share reflected: {shares} ({PRINTED})"


def swapped(equation: Equation, means: Means) -> str:
    """By how much I / (N.L) of a printed equation changes when light and eye change places."""
    L, E = hemisphere(means.seed, MANY), hemisphere(means.seed + 1, MANY)
    most = apart(equation(L, E) / L[:, 2], equation(E, L) / E[:, 2])
    return f"largest relative difference {most:.2g} over {MANY} pairs (the printed equation)"


def dated(printed: int, *references: tuple[str, int]) -> Callable[[Means], Found]:
    """A year against the bibliographies of the other documents; the first reference is the one that must have it."""

    def find(means: Means) -> Found:
        (name, year), *others = references
        again = "; ".join(f"{year}: reference {name}" for name, year in others)
        return Found(year == printed, f"{year}", f"reference {name}", again)

    return find


def fraction(model: str, equation: Callable[[], float], **parameters: Any) -> Callable[[Means], Found]:
    """Whether k_s is the share that a specular term reflects at normal incidence, under the irradiance π that suits k_d."""

    def find(means: Means) -> Found:
        ours = share(model, 0.0, math.pi, **parameters)
        words = f"{told(ours)} of the light at θ = 0, for k_s = 1 and an irradiance π"
        return Found(abs(ours.value - 1.0) < 0.01, words, "quadrature", f"{equation():.5f} ({PRINTED})")

    return find
