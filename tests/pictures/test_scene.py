import math

import numpy as np
import pytest

from albedo_lab.pictures.scene import CYLINDER, EDGE, LAMP, SPHERE, TOUCH, VIEWER, ZENITH, cylinder, pixels, seen, sphere

SIZE = 48


def points(shape):
    at, _ = pixels(SIZE)
    x, y = at[..., 0], at[..., 1]
    normal, position, hit = shape(x, y)
    return normal[hit], position[hit], np.stack([x, y], axis=-1)[hit]


def outside(position):
    """How far points are from a cylinder that is smaller by the radius of its edges: a solid of revolution about ZENITH."""
    radius, half = CYLINDER
    up = position @ np.array(ZENITH)
    across = np.sqrt(np.sum((position - up[:, None] * np.array(ZENITH)) ** 2, axis=1))
    return np.hypot(np.maximum(across - (radius - EDGE), 0.0), np.maximum(np.abs(up) - (half - EDGE), 0.0))


@pytest.mark.parametrize("shape", [sphere, cylinder])
def test_every_point_is_seen_where_it_is_and_faces_the_viewer(shape):
    normal, position, at = points(shape)
    np.testing.assert_allclose(position[:, :2], at, atol=1e-12)
    np.testing.assert_allclose(np.sum(normal * normal, axis=1), 1.0, rtol=1e-12)
    assert np.all(normal[:, 2] > 0.0)
    assert np.all(position[:, 2] > -1.0)


def test_the_points_of_a_sphere():
    normal, position, _ = points(sphere)
    np.testing.assert_allclose(np.sum(position * position, axis=1), SPHERE**2, rtol=1e-12)
    np.testing.assert_allclose(normal, position / SPHERE, rtol=1e-12)


def test_the_points_of_a_cylinder_are_as_far_from_the_inner_one_as_its_edges_are_round():
    normal, position, _ = points(cylinder)
    np.testing.assert_allclose(outside(position), EDGE, atol=TOUCH)
    step = 1e-5
    slope = np.stack([outside(position + step * e) - outside(position - step * e) for e in np.eye(3)], axis=1) / (2.0 * step)
    off = np.abs(slope - normal).max(axis=1)
    assert np.quantile(off, 0.99) < 1e-4  # but for points where a flat part meets an edge
    for axis in (0.0, 1.0):  # face and top are there
        assert np.any(np.abs(normal @ np.array(ZENITH) - axis) < 1e-12)


def test_coverage_is_the_area():
    assert seen("sphere", SIZE, "length").coverage.mean() == pytest.approx(math.pi * SPHERE**2 / 4.0, rel=5e-3)
    tall = seen("cylinder", 96, "around").coverage
    np.testing.assert_allclose(tall, tall[:, ::-1], atol=1e-12)
    assert tall.max() == 1.0
    rows = np.flatnonzero(tall.any(axis=1))
    assert 0 < rows[0] < rows[-1] < 95


@pytest.mark.parametrize("shape", ["sphere", "cylinder"])
def test_frames(shape):
    for scratches in ("length", "around"):
        view = seen(shape, SIZE, scratches)
        assert len(view.frames) == np.count_nonzero(view.coverage)
        np.testing.assert_allclose(
            view.frames @ view.frames.transpose(0, 2, 1), np.broadcast_to(np.eye(3), view.frames.shape), atol=1e-12
        )
        np.testing.assert_allclose(np.linalg.det(view.frames), 1.0, rtol=1e-12)
        np.testing.assert_allclose(view.local(VIEWER)[:, 2], view.frames[:, 2, 2], rtol=1e-12)
        level = view.frames[:, 0 if scratches == "around" else 1] @ np.array(ZENITH)
        np.testing.assert_allclose(level, 0.0, atol=1e-12)  # circles about the axis are level; across the length, too


def test_directions():
    for w in (VIEWER, ZENITH, LAMP):
        assert sum(c * c for c in w) == pytest.approx(1.0, abs=1e-12)
    assert LAMP.x < 0.0 < LAMP.y
