"""Adaptive quadrature as an Estimate: deterministic, with a bound instead of a statistical interval."""

from __future__ import annotations

import numpy as np

from albedo_lab.estimate.record import Estimate, Question, Tolerance, bounded
from albedo_lab.kernels.quadrature import quadrature_kernel


def quadrature(question: Question, tolerance: Tolerance) -> Estimate:
    """The directional albedo of the shape, its bound within the tolerance where that can be reached."""
    model, p = question.model, question.p
    answer = np.zeros(3)
    values = tuple(map(float, p))
    quadrature_kernel(model, question.order)(
        values, question.mu, question.phi, bool(model.isotropic(p)), tolerance.absolute, tolerance.relative, answer
    )
    return bounded(float(answer[0]), float(answer[1]), int(answer[2]), "quadrature")
