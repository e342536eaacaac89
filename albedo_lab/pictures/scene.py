"""What a preview looks at: a sphere and an upright cylinder, seen from afar and from above the horizon, and lights from afar.

Directions are those of the camera: x to the right, y up in the picture, z to the viewer. A picture spans -1 to 1 both ways.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import lru_cache
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from albedo_lab.optics.frame import Direction
from albedo_lab.pictures.evaluation import Array

ELEVATION = math.radians(20.0)
"""Of the viewer above the horizon, so that a cylinder shows its top."""
VIEWER = Direction(0.0, 0.0, 1.0)
ZENITH = Direction(0.0, math.cos(ELEVATION), math.sin(ELEVATION))
LAMP = Direction(-0.48, 0.64, 0.6)
"""The direction of the directional light: from the upper left, before the shape."""
SPHERE = 0.94
"""Radius."""
CYLINDER = (0.64, 0.76)
"""Radius and half its height."""
EDGE = 0.12
"""Radius of the cylinder's rounded edges: a narrow lobe that neither face nor top shows is seen there."""
STEPS, TOUCH = 24, 1e-3
"""How often the way to a rounded edge is shortened, and the distance that counts as there."""
WITHIN = 3
"""A pixel is covered by as many of its WITHIN^2 points as see the shape."""


class Seen(NamedTuple):
    """A shape in a square picture: which pixels show it, and the surface there, in frames of its own.

    `coverage` (size, size), from the top, is the share of a pixel that is covered; the arrays below have a row for each pixel
    with any, in reading order. A frame's x axis runs along the scratches, its z axis is the normal.
    """

    coverage: Array
    frames: Array
    """(n, 3, 3): the rows of a frame are its axes, so that frame @ w takes a direction into it."""

    def local(self, w: Direction) -> Array:
        """One direction of the camera in every frame, (n, 3)."""
        found: Array = self.frames @ np.array(w)
        return found


@lru_cache(maxsize=8)
def seen(shape: str, size: int, scratches: str) -> Seen:
    """A shape, "sphere" or "cylinder", in size x size pixels, scratched "around" its upright axis or along its "length".

    The part of a pixel that stands for it is the one nearest to its centre that sees the shape.
    """
    at, weight = pixels(size)
    normal, position, hit = SHAPES[shape](at[..., 0], at[..., 1])
    first = np.argmax(hit, axis=-1)[..., None]
    covered = hit.any(axis=-1)
    pick = np.take_along_axis
    n, p = (pick(vectors, first[..., None], axis=-2)[..., 0, :][covered] for vectors in (normal, position))
    around = np.cross(ZENITH, p)
    around /= np.maximum(np.sqrt(np.sum(around * around, axis=-1, keepdims=True)), 1e-300)
    along = around if scratches == "around" else np.cross(n, around)
    return Seen(hit @ weight, np.stack([along, np.cross(n, along), n], axis=1))


SCRATCHES = ("length", "around")


def pixels(size: int) -> tuple[Array, Array]:
    """The points within every pixel, (size, size, WITHIN^2, 2), from its centre outwards, and the weight of each."""
    offsets = (np.arange(WITHIN) + 0.5) / WITHIN - 0.5
    dy, dx = (part.ravel() for part in np.meshgrid(offsets, offsets, indexing="ij"))
    order = np.argsort(np.hypot(dx, dy), kind="stable")
    row, column = np.meshgrid(np.arange(size) + 0.5, np.arange(size) + 0.5, indexing="ij")
    x = 2.0 * (column[..., None] + dx[order]) / size - 1.0
    y = 1.0 - 2.0 * (row[..., None] + dy[order]) / size
    return np.stack([x, y], axis=-1), np.full(WITHIN * WITHIN, WITHIN**-2.0)


def sphere(x: Array, y: Array) -> tuple[Array, Array, NDArray[np.bool_]]:
    """Normals and positions (.., 3) where the points of the picture see the sphere, and whether they do."""
    square = SPHERE**2 - x * x - y * y
    position = np.stack([x, y, np.sqrt(np.maximum(square, 0.0))], axis=-1)
    return position / SPHERE, position, square > 0.0


def cylinder(x: Array, y: Array) -> tuple[Array, Array, NDArray[np.bool_]]:
    """As `sphere`: where the points see a sharp cylinder, and from there as far as its rounded edges are set back.

    Along the axis u, upwards, and across it w, towards the viewer, a point sees all with y = u cos e - w sin e.
    """
    radius, half = CYLINDER
    cos_e, sin_e = ZENITH.y, ZENITH.z
    depth = np.sqrt(np.maximum(radius**2 - x * x, 0.0))
    face_u = (y + depth * sin_e) / cos_e
    top_w = (half * cos_e - y) / sin_e
    on_top = x * x + top_w * top_w < radius**2
    hit = on_top | ((radius**2 > x * x) & (np.abs(face_u) <= half))
    x, u, w = x[hit], np.where(on_top, half, face_u)[hit], np.where(on_top, top_w, depth)[hit]
    for _ in range(STEPS):
        away, _ = rounded(x, u, w)
        u, w = u - away * sin_e, w - away * cos_e
    away, outward = rounded(x, u, w)
    axes = np.array([[1.0, 0.0, 0.0], ZENITH, [0.0, -sin_e, cos_e]])
    normal, position = np.zeros((2, *hit.shape, 3))
    normal[hit], position[hit] = np.stack(outward, axis=-1) @ axes, np.stack([x, u, w], axis=-1) @ axes
    hit[hit] = away < TOUCH
    return normal, position, hit & (normal[..., 2] > 0.0)


def rounded(x: Array, u: Array, w: Array) -> tuple[Array, tuple[Array, Array, Array]]:
    """The distance of points from the rounded cylinder, negative inside, and the normal of its surface next to them."""
    radius, half = CYLINDER
    axial = np.maximum(np.hypot(x, w), 1e-300)
    out, up = axial - (radius - EDGE), np.abs(u) - (half - EDGE)
    corner = np.hypot(np.maximum(out, 0.0), np.maximum(up, 0.0))
    distance = corner + np.minimum(np.maximum(out, up), 0.0) - EDGE
    at_edge, beside = (out > 0.0) & (up > 0.0), out > up
    outwards = np.where(at_edge, out / np.maximum(corner, 1e-300), beside)
    upwards = np.where(at_edge, up / np.maximum(corner, 1e-300), ~beside) * np.sign(u)
    return distance, (outwards * x / axial, upwards, outwards * w / axial)


SHAPES: dict[str, Callable[[Array, Array], tuple[Array, Array, NDArray[np.bool_]]]] = {"sphere": sphere, "cylinder": cylinder}
