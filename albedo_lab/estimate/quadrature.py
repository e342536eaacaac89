"""Adaptive quadrature as an Estimate: deterministic, with a bound instead of a statistical interval."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from albedo_lab.estimate.record import Estimate, Question, Tolerance, bounded
from albedo_lab.kernels.quadrature import quadrature_kernel


def quadrature(question: Question, tolerance: Tolerance) -> Estimate:
    """The directional albedo of the shape, its bound within the tolerance where that can be reached.

    A model made of parts is integrated part by part, each in the coordinates in which it is smooth; a Dirac part is added.
    """
    model, p, mu = question.model, question.p, question.mu
    assert mu is not None
    parts = [(model, p)] if model.parts is None else model.parts(p)
    share = Tolerance(tolerance.absolute / max(len(parts), 1), tolerance.relative)
    found = [_integral(replace(question, model=part, p=values), bool(model.isotropic(p)), share) for part, values in parts]
    value = math.fsum(integral.value for integral in found) + model.mirror(p, mu)
    bound = math.fsum(integral.half_width for integral in found)
    return bounded(value, bound, sum(integral.samples for integral in found), "quadrature")


def _integral(question: Question, symmetric: bool, tolerance: Tolerance) -> Estimate:
    """One integral by one kernel."""
    answer = np.zeros(3)
    quadrature_kernel(question.model, question.order)(
        question.values, question.mu, question.phi, symmetric, tolerance.absolute, tolerance.relative, answer
    )
    return bounded(float(answer[0]), float(answer[1]), int(answer[2]), "quadrature")
