"""The three methods by name."""

from __future__ import annotations

from albedo_lab.estimate.mean import mean_by_quadrature
from albedo_lab.estimate.quadrature import quadrature
from albedo_lab.estimate.record import Estimate, Question, Tolerance
from albedo_lab.estimate.sampling import monte_carlo, rqmc

METHODS = ("rqmc", "mc", "quadrature")


def estimate(question: Question, tolerance: Tolerance, method: str, seed: int, threads: int) -> Estimate:
    """The answer to a question about a model's shape, its half-width under the tolerance where the budget allows."""
    if method == "quadrature":
        return quadrature(question, tolerance) if question.mu is not None else mean_by_quadrature(question, tolerance)
    sampler = rqmc if method == "rqmc" else monte_carlo
    return sampler(question, tolerance, seed, threads)
