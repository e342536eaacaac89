"""The angles of half-vector and difference, both ways, also where they are tiny and near the horizon."""

from __future__ import annotations

import math

import mpmath
import pytest
from hypothesis import given
from hypothesis import strategies as st

from albedo_lab.measured.rusinkiewicz import HalfDifference, half_difference, light_and_viewer, lower_cosine
from albedo_lab.optics.frame import Direction
from tests.models import trial

HALF_PI = math.pi / 2
EPSILON = 2.0**-52


def tiny_or_not(largest: float) -> st.SearchStrategy[float]:
    """Down to 1e-12 on a logarithmic scale, and up to the largest; both ends of what is no rounding noise often."""
    return st.sampled_from((1e-12, 1e-6, 0.9999 * largest)) | st.floats(-27.0, math.log(largest)).map(math.exp)


def by_rotations(wi: Direction, wo: Direction) -> tuple[float, float, float]:
    """The definition, to 60 digits: the light turned by -phi_h about the normal, then by -theta_h about the y axis."""
    with mpmath.workdps(60):
        a, b = [[mpmath.mpf(x) for x in w] for w in (wi, wo)]
        a, b = ([x / mpmath.sqrt(sum(y * y for y in w)) for x in w] for w in (a, b))
        h = [x + y for x, y in zip(a, b, strict=True)]
        theta_h, phi_h = mpmath.atan2(mpmath.hypot(h[0], h[1]), h[2]), mpmath.atan2(h[1], h[0])
        x = mpmath.cos(phi_h) * a[0] + mpmath.sin(phi_h) * a[1]
        y = mpmath.cos(phi_h) * a[1] - mpmath.sin(phi_h) * a[0]
        x, z = mpmath.cos(theta_h) * x - mpmath.sin(theta_h) * a[2], mpmath.sin(theta_h) * x + mpmath.cos(theta_h) * a[2]
        return float(theta_h), float(mpmath.atan2(mpmath.hypot(x, y), z)), float(mpmath.atan2(y, x) % mpmath.pi)


def turn_between(a: float, b: float) -> float:
    """The distance of two azimuths that count modulo pi."""
    return abs((a - b + HALF_PI) % math.pi - HALF_PI)


def assert_same_angles(found: HalfDifference, expected: tuple[float, float, float], error: float) -> None:
    """Absolute error `error` in all directions; phi_d is worth sin(theta_d), and theta_h gives it its zero."""
    theta_h, theta_d, phi_d = expected
    assert abs(found.theta_h - theta_h) <= error
    assert abs(found.theta_d - theta_d) <= error
    assert turn_between(found.phi_d, phi_d) <= error / math.sin(theta_d) + error / math.sin(theta_h)


@given(trial.pairs())
def test_definition(pair: tuple[Direction, Direction]) -> None:
    wi, wo = pair
    expected = by_rotations(wi, wo)
    if min(expected[0], expected[1]) > 1e-14 and math.hypot(*(a + b for a, b in zip(wi, wo, strict=True))) > 1e-6:
        assert_same_angles(half_difference(wi, wo), expected, 16 * EPSILON / math.cos(expected[1]))


@given(tiny_or_not(HALF_PI), tiny_or_not(HALF_PI), st.floats(0.0, math.pi), st.floats(-math.pi, math.pi))
def test_round_trip_from_angles(theta_h: float, theta_d: float, phi_d: float, phi_h: float) -> None:
    """Half-vectors are lost in proportion to how short wi + wo is."""
    wi, wo = light_and_viewer(HalfDifference(theta_h, theta_d, phi_d), phi_h)
    assert math.isclose(math.hypot(*wi), 1.0, rel_tol=1e-15)
    found = half_difference(wi, wo)
    assert_same_angles(found, (theta_h, theta_d, phi_d), 16 * EPSILON / math.cos(theta_d))
    assert abs(lower_cosine(found) - min(wi.z, wo.z)) <= 64 * EPSILON / math.cos(theta_d)


@given(trial.pairs())
def test_round_trip_from_directions(pair: tuple[Direction, Direction]) -> None:
    wi, wo = pair
    h = Direction(wi.x + wo.x, wi.y + wo.y, wi.z + wo.z)
    if math.hypot(*h) > 1e-3 and math.hypot(h.x, h.y) > 0.0:  # without phi_h nothing knows how the pair is turned
        back = light_and_viewer(half_difference(wi, wo), math.atan2(h.y, h.x))
        # phi_d does not tell the light from the viewer
        near = min(math.dist(back[0], wi) + math.dist(back[1], wo), math.dist(back[0], wo) + math.dist(back[1], wi))
        assert near <= 64 * EPSILON / math.hypot(*h)


@given(trial.pairs(), st.floats(-math.pi, math.pi))
def test_exchange_and_turn_change_nothing(pair: tuple[Direction, Direction], turn: float) -> None:
    wi, wo = pair
    at = half_difference(wi, wo)
    swapped = half_difference(wo, wi)
    assert (swapped.theta_h, swapped.theta_d) == (at.theta_h, at.theta_d)
    assert turn_between(swapped.phi_d, at.phi_d) <= 4 * EPSILON
    assert 0.0 <= at.theta_h <= HALF_PI
    assert 0.0 <= at.theta_d <= HALF_PI
    assert 0.0 <= at.phi_d < math.pi
    c, s = math.cos(turn), math.sin(turn)
    turned = half_difference(*(Direction(c * w.x - s * w.y, s * w.x + c * w.y, w.z) for w in pair))
    assert abs(turned.theta_h - at.theta_h) < 1e-14 / math.cos(at.theta_d) if at.theta_d < 1.57 else True


@pytest.mark.parametrize("theta", [1e-9, 0.3, 1.5707])
def test_planes(theta: float) -> None:
    """Mirror directions have theta_h = 0, retro-reflection theta_d = 0, and in the plane of incidence phi_d = 0."""
    w = trial.direction(theta)
    assert half_difference(w, trial.direction(theta, math.pi)).theta_h < EPSILON / math.cos(theta)
    assert math.isclose(half_difference(w, trial.direction(theta, math.pi)).theta_d, theta, rel_tol=1e-14)
    assert half_difference(w, w)[:2] == (math.atan2(w.x, w.z), 0.0)
    in_plane = half_difference(w, trial.direction(0.5 * theta))
    assert math.isclose(in_plane.theta_h, 0.75 * theta, rel_tol=1e-14)
    assert math.isclose(in_plane.theta_d, 0.25 * theta, rel_tol=1e-14)
    assert in_plane.phi_d == 0.0


def test_handedness() -> None:
    """The light to the left of the half-vector, seen outward with the normal up: a quarter turn from the tangent to y."""
    h = trial.direction(0.5)
    wi, wo = light_and_viewer(HalfDifference(0.5, 0.2, HALF_PI), 0.0)
    assert wi.y > 0.0 > wo.y
    assert math.isclose(sum(a * b for a, b in zip(wi, h, strict=True)), math.cos(0.2), rel_tol=1e-15)
    assert math.isclose(wi.z, wo.z, rel_tol=1e-15)
