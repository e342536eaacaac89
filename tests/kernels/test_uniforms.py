"""Uniforms against independent implementations: SciPy's Sobol points, Philox in plain integers; and what scrambling must keep."""

from collections.abc import Callable

import numpy as np
import pytest
from numba import njit
from numpy.typing import NDArray
from scipy.special import ndtri
from scipy.stats import chi2, qmc

from albedo_lab.kernels import uniforms

DIMENSIONS = (uniforms.sobol0, uniforms.sobol1, uniforms.sobol2, uniforms.sobol3)
POINTS = 1 << 12


@njit
def _points(n, key0, key1, key2, key3):
    out = np.empty((n, 4))
    for i in range(n):
        base, j = np.uint32(i - i % 512), np.uint32(i % 512)
        out[i, 0] = uniforms.sobol0(np.uint32(i), key0)
        out[i, 1] = uniforms.sobol1(np.uint32(i), key1)
        out[i, 2] = uniforms.sobol2(base, j, key2)
        out[i, 3] = uniforms.sobol3(base, j, key3)
    return out


def scrambled(seed: int) -> NDArray[np.float64]:
    """The first points under the keys of a seed."""
    return _points(POINTS, *np.random.SeedSequence(seed).generate_state(4))


def test_generator_matrices_are_those_of_scipy() -> None:
    expected = qmc.Sobol(4, scramble=False, bits=32).random(64)
    for dimension, columns in ((2, uniforms._direction_numbers(2, 1, [1, 3])), (3, uniforms._direction_numbers(3, 1, [1, 3, 1]))):
        for i in range(64):
            gray, y = i ^ (i >> 1), 0
            for b in range(32):
                y ^= columns[b] if gray >> b & 1 else 0
            assert int(f"{y:032b}"[::-1], 2) / 2**32 == expected[i, dimension]


@pytest.mark.parametrize("pair", [(0, 1), (0, 2), (1, 2), (2, 3), (0, 3), (1, 3)])
def test_scrambled_points_are_as_even_as_sobol_points(pair: tuple[int, int]) -> None:
    """Each elementary interval of the unscrambled net of this pair holds as many points after the scramble."""
    raw = qmc.Sobol(4, scramble=False, bits=32).random(POINTS)[:, pair]
    points = scrambled(7)[:, pair]
    for k in range(13):
        cells = np.array([1 << k, POINTS >> k])
        before = np.unique(np.floor(raw * cells).astype(int), axis=0, return_counts=True)[1]
        after = np.unique(np.floor(points * cells).astype(int), axis=0, return_counts=True)[1]
        assert sorted(before) == sorted(after)


def test_scrambles_are_uniform_and_independent() -> None:
    """The first point of many scrambles, 4 coordinates: chi-square over 8^2 cells of every pair, Šidák over 6 at 1e-6."""
    first = np.array([_points(1, *np.random.SeedSequence(s).generate_state(4))[0] for s in range(6400)])
    threshold = chi2.isf(1.0 - (1.0 - 1e-6) ** (1 / 6), 63)
    for a in range(4):
        for b in range(a):
            counts = np.histogram2d(first[:, a], first[:, b], bins=8, range=[[0, 1], [0, 1]])[0]
            assert ((counts - 100.0) ** 2 / 100.0).sum() < threshold


def plain_philox(i: int, stream: int, key: int) -> tuple[int, int]:
    """Philox2x32-10 in Python's integers."""
    x0, x1 = i, stream
    for _ in range(10):
        product = x0 * 0xD256D193
        x0, x1 = (product >> 32) ^ key ^ x1, product & 0xFFFFFFFF
        key = (key + 0x9E3779B9) & 0xFFFFFFFF
    return x0, x1


@njit
def _philox(n, stream, key):
    out = np.empty((n, 2))
    for i in range(n):
        out[i, 0], out[i, 1] = uniforms.philox(np.uint32(i), stream, key)
    return out


def test_philox_is_philox() -> None:
    got = _philox(1000, np.uint32(77), np.uint32(0xDEADBEEF))
    expected = np.array([plain_philox(i, 77, 0xDEADBEEF) for i in range(1000)])
    np.testing.assert_array_equal(got, (expected + 0.5) / 2**32)
    # the known answer of Random123 for a counter and a key of zeros and of ones
    assert plain_philox(0, 0, 0) == (0xFF1DAE59, 0x6CD10DF2)
    assert plain_philox(0xFFFFFFFF, 0xFFFFFFFF, 0xFFFFFFFF) == (0x2C3F628B, 0xAB4FD7AD)


def test_uniforms_stay_inside() -> None:
    for index, inside in ((0, 0.5 / 2**32), (0xFFFFFFFF, 1 - 0.5 / 2**32)):
        assert uniforms.to_unit(np.uint32(index)) == inside
    points = scrambled(1)
    assert points.min() > 0.0
    assert points.max() < 1.0


@pytest.mark.parametrize("integrand", [lambda u: u.prod(axis=1) * 16.0, lambda u: np.cos(ndtri(u)).prod(axis=1) * np.exp(2.0)])
def test_scrambled_points_beat_random_ones(integrand: Callable[[NDArray[np.float64]], NDArray[np.float64]]) -> None:
    """The standard deviation over scrambles is at least five times below that of as many random points; the mean is right."""
    means = np.array([integrand(scrambled(s)).mean() for s in range(64)])
    spread = integrand(np.random.default_rng(0).random((1 << 14, 4))).std() / np.sqrt(POINTS)
    assert means.std() < spread / 5.0
    assert abs(means.mean() - 1.0) < 4.0 * means.std() / 8.0
