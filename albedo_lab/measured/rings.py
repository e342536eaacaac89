"""How much light each ring of half-vectors reflects: from a table of cells to a density that samples can be drawn from."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from albedo_lab.measured.cells import SHAPE
from albedo_lab.measured.merl_file import Floats, centres


class Rings(NamedTuple):
    """A density of half-vectors per solid angle, linear in height = 1 - cos(theta_h) between the borders of the cells.

    `heights`, `density` and `cumulative` (the share of half-vectors below that height) stand at the borders, first to last.
    """

    heights: Floats
    density: Floats
    cumulative: Floats


def rings(values: Floats) -> Rings:
    """The density proportional to the light that each ring of cells reflects, averaged over all directions of incidence.

    The mean albedo is the integral of f cos cos' over both directions, so of f cos cos' 4 cos(theta_d) over half-vectors and
    light; cos cos' = (cos theta_h cos theta_d)^2 - (sin theta_h sin theta_d cos phi_d)^2. Missing values count as 0.
    """
    theta_h, theta_d, phi_d = centres()
    cosines = (np.cos(theta_h) * np.cos(theta_d)) ** 2 - (np.sin(theta_h) * np.sin(theta_d) * np.cos(phi_d)) ** 2
    measure = 4.0 * np.cos(theta_d) * np.sin(theta_d) * np.maximum(cosines, 0.0)
    light = np.einsum("ijk,ijk->i", np.maximum(values, 0.0), measure)
    if not np.any(light > 0.0):
        light = np.ones(len(light))  # a black surface
    border = 0.5 * np.pi * (np.arange(SHAPE[0] + 1) / SHAPE[0]) ** 2
    heights = 2.0 * np.sin(0.5 * border) ** 2
    density = 0.5 * (np.append(light[:1], light) + np.append(light, light[-1:]))
    mass = np.pi * np.diff(heights) * (density[1:] + density[:-1])
    cumulative = np.append(0.0, np.cumsum(mass))
    return Rings(heights, density / cumulative[-1], cumulative / cumulative[-1])
