"""The template that evaluates a model at every cell of a MERL table."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from typing import Any

from albedo_lab.kernels.jit import Placeholder, specialise
from albedo_lab.measured.cells import LOWEST, SHAPE, point_of
from albedo_lab.measured.rusinkiewicz import light_and_viewer, lower_cosine
from albedo_lab.model import Model

THETA_H, THETA_D, PHI_D = SHAPE

Parameters = Placeholder("Parameters")
evaluate = Placeholder("evaluate")


def fill_cells(values, cells, above):
    """f into `cells`, and into `above` whether the cell has a place above the horizon; where not, its f is 0."""
    p = Parameters(*values)
    for i in range(THETA_H):
        for j in range(THETA_D):
            for k in range(PHI_D):
                at = point_of(i, j, k)
                above[i, j, k] = lower_cosine(at) >= LOWEST
                cells[i, j, k] = 0.0
                if above[i, j, k]:
                    wi, wo = light_and_viewer(at, 0.0)
                    cells[i, j, k] = evaluate(p, wi, wo)


@cache
def tabulation_kernel(model: Model) -> Callable[..., Any]:
    """The kernel for one model."""
    return specialise(fill_cells, Parameters=model.parameters_type, evaluate=model.evaluate)
