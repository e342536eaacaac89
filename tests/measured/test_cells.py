"""Which cell of a table a pair of directions falls into, and where in it a formula is evaluated."""

from __future__ import annotations

import math

import numpy as np
import pytest
from numpy.typing import NDArray

from albedo_lab.measured.cells import LOWEST, SHAPE, Place, angles_at, highest_corner, place_of, point_of
from albedo_lab.measured.merl_file import centre_cosines, centres, share_below
from albedo_lab.measured.rusinkiewicz import HalfDifference, half_difference, lower_cosine
from tests.models import trial


def published_index(theta_h: float, theta_d: float, phi_d: float) -> int:
    """What is known of the lookup that came with the data: root spacing of theta_h, all rounded down, phi_d fastest."""
    in_degrees = theta_h / (math.pi / 2) * 90
    row = min(max(int(math.sqrt(in_degrees * 90)), 0), 89)
    column = min(max(int(theta_d / (math.pi / 2) * 90), 0), 89)
    half_turn = phi_d + math.pi if phi_d < 0 else phi_d
    depth = min(max(int(half_turn / math.pi * 360 / 2), 0), 179)
    return depth + 180 * (column + 90 * row)


def test_the_published_lookup_finds_the_same_cell() -> None:
    """All but those within rounding of a border."""
    count = 0
    for wi, wo in trial.random_pairs(2000):
        at = half_difference(wi, wo)
        place = place_of(at)
        if all(abs(x - round(x)) > 1e-9 for x in place):
            cell = [min(int(x), n - 1) for x, n in zip(place, SHAPE, strict=True)]
            assert np.ravel_multi_index(cell, SHAPE) == published_index(*at)
            count += 1
    assert count > 1990


@pytest.mark.parametrize("place", [Place(0.5, 0.5, 0.5), Place(1e-6, 45.0, 90.0), Place(89.5, 89.5, 179.5)])
def test_places_and_angles(place: Place) -> None:
    assert place_of(angles_at(place)) == pytest.approx(place, rel=1e-14)


def test_a_degree_is_a_cell() -> None:
    at = HalfDifference(math.radians(90.0 / 8100.0), math.radians(1.0), math.radians(1.0))
    assert place_of(at) == pytest.approx((1.0, 1.0, 1.0), rel=1e-14)


def test_a_formula_is_evaluated_inside_the_cell_and_above_the_horizon() -> None:
    """At the centre where that is above; and a cell is given up only if its highest corner is no higher."""
    rng = np.random.default_rng(3)
    moved, given_up = 0, 0
    for i, j, k in rng.integers((0, 0, 0), SHAPE, (20_000, 3)).tolist():
        at = point_of(i, j, k)
        offset = np.subtract(place_of(at), (i, j, k))
        assert np.all(offset >= -1e-11)
        assert np.all(offset <= 1.0 + 1e-11)
        if centre_cosines()[i, j, k] >= LOWEST:
            assert np.allclose(offset, 0.5, atol=1e-11)
        elif lower_cosine(at) >= LOWEST:
            moved += 1
        else:
            assert lower_cosine(angles_at(highest_corner(i, j, k))) < 1.1 * LOWEST
            given_up += 1
    assert moved > 100
    assert given_up > 4000


def test_highest_corner() -> None:
    """No other corner of a cell is higher."""
    rng = np.random.default_rng(4)
    for i, j, k in rng.integers((0, 0, 0), SHAPE, (500, 3)).tolist():
        corners = [Place(i + a, j + b, k + c) for a in (0, 1) for b in (0, 1) for c in (0, 1)]
        highest = max(lower_cosine(angles_at(corner)) for corner in corners)
        assert lower_cosine(angles_at(highest_corner(i, j, k))) == pytest.approx(highest, abs=1e-15)


def test_centres() -> None:
    theta_h, theta_d, phi_d = (a.ravel() for a in centres())
    at = angles_at(Place(30.5, 20.5, 100.5))
    assert (theta_h[30], theta_d[20], phi_d[100]) == pytest.approx(at, rel=1e-14)
    assert centre_cosines()[30, 20, 100] == pytest.approx(lower_cosine(at), rel=1e-12)


def test_a_quarter_of_all_cells_is_below_the_horizon() -> None:
    """Not 40 %, as nuaj_models has it: that is the share of the angles themselves, which theta_h's spacing does not keep.

    The horizon is tan(theta_h) tan(theta_d) |cos(phi_d)| = 1. A plain integral of that over both, to the resolution of its grid.
    """
    middle = (np.arange(500) + 0.5) / 500
    coarse = (np.arange(150) + 0.5) / 150
    cosine = np.abs(np.cos(np.pi * middle))[:, None]
    tan_d = np.tan(0.5 * np.pi * middle)

    def below(theta_h: NDArray[np.float64]) -> float:
        return float(np.mean([np.mean(np.tan(t) * tan_d * cosine > 1.0) for t in theta_h]))

    assert share_below() == pytest.approx(below(0.5 * np.pi * coarse**2), abs=2e-3)
    assert share_below() == pytest.approx(0.248, abs=1e-3)
    assert below(0.5 * np.pi * coarse) == pytest.approx(0.383, abs=2e-3)
