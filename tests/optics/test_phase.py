"""Henyey and Greenstein's phase function and the directions that follow it, folded at the surface."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.integrate import quad

from albedo_lab.optics.frame import dot
from albedo_lab.optics.phase import folded_pdf, henyey_greenstein, sample_folded
from tests.models import trial


@pytest.mark.parametrize("g", [-0.95, -0.3, 0.0, 0.6, 0.95])
def test_moments(g: float) -> None:
    """Mean 1 over the sphere, mean cosine g."""
    for power, expected in ((0, 1.0), (1, g)):
        mean = quad(lambda c, k=power: 0.5 * c**k * henyey_greenstein(g, 2 - 2 * c), -1, 1, epsabs=1e-11, limit=200)[0]
        assert mean == pytest.approx(expected, abs=1e-9)


@pytest.mark.parametrize("g", [0.0, 1e-9, 0.5, 0.95])
def test_cosines_are_the_inverse_of_their_distribution(g: float) -> None:
    """About the normal nothing but the lower half is folded; u is the share of smaller cosines."""
    for u in (1e-6, 0.3, 0.7, 1 - 1e-6):
        z = sample_folded(trial.at(1.0), g, u, 0.2).z
        below = [0.5 * quad(lambda c: henyey_greenstein(g, 2 - 2 * c), -1, s * z, epsabs=1e-12)[0] for s in (-1, 1)]
        assert min(abs(share - u) for share in below) < 1e-8


@pytest.mark.parametrize("axis", [trial.at(0.9), trial.at(0.05, 2.0)])
def test_density_is_whole_and_samples_are_about_the_axis(axis: trial.Direction) -> None:
    g, rng = 0.6, np.random.default_rng(4)
    z, w = np.polynomial.legendre.leggauss(40)
    total = sum(
        0.5 * dz * math.pi / 40 * folded_pdf(axis, g, trial.at(0.5 + 0.5 * x, math.pi / 40 * k))
        for x, dz in zip(z, w, strict=True)
        for k in range(80)
    )
    assert total == pytest.approx(1.0, rel=1e-6)
    samples = [sample_folded(axis, g, u1, u2) for u1, u2 in rng.random((4000, 2)).tolist()]
    assert all(s.z >= 0.0 for s in samples)
    assert np.mean([dot(s, axis) for s in samples]) > 0.6
