"""What facets without masking do not reflect: by scipy in polar angles of the facets, in closed form, and as the table has it."""

from __future__ import annotations

import math
from itertools import pairwise

import numpy as np
import pytest
from scipy.integrate import quad

from albedo_lab.optics.specular_loss import loss_at, losses, panels, specular_loss, tabulated


def by_facets(m: float, mu: float, power: int) -> float:
    """1 - the mean of 2 z'/(z' + mu) (1 - wo.h)^power over facets of polar slope q and azimuth b, plain vectors."""
    s = math.sqrt(1.0 - mu * mu)

    def along(b: float) -> float:
        c = math.cos(b)

        def f(q: float) -> float:
            t = 1.0 / math.sqrt(1.0 + q * q)
            d = t * (mu + s * q * c)
            z = 2.0 * d * t - mu
            weight = 2.0 * z / (z + mu) * (1.0 - d) ** power if z > 0.0 else 0.0
            return 2.0 * q * math.exp(-((q / m) ** 2)) / (m * m) * weight

        end = (s * c + math.hypot(s * c, mu)) / mu if c > 0.0 else mu / (math.hypot(s * c, mu) - s * c)
        points = sorted({min(x, end) for x in (mu, m, 3.0 * m)} | {min(end, 6.5 * m)})
        ends = [0.0, *(x for x in points if x <= 6.5 * m)]
        return sum(quad(f, low, high, epsabs=1e-13, epsrel=1e-12)[0] for low, high in pairwise(ends))

    bends = [0.0, 0.5 * math.pi - min(mu / m, 1.0), 0.5 * math.pi, math.pi]
    total = sum(quad(along, low, high, epsabs=1e-11)[0] for low, high in pairwise(bends))
    return 1.0 - total / math.pi


@pytest.mark.parametrize(("m", "mu"), [(1.0, 0.4), (0.2, 0.15), (0.05, 0.9), (0.3, 0.01)])
def test_against_plain_vectors(m: float, mu: float) -> None:
    white, dark = losses(m, np.array([mu]))
    assert abs(white[0] - by_facets(m, mu, 0)) < 1e-9
    assert abs(dark[0] - by_facets(m, mu, 5)) < 1e-9


@pytest.mark.parametrize("m", [1e-4, 0.01, 0.3, 1.0])
def test_normal_incidence(m: float) -> None:
    """m^2 (1 - exp(-1 / m^2)) for F = 1."""
    assert abs(losses(m, np.array([1.0]))[0][0] + m * m * math.expm1(-1.0 / (m * m))) < 1e-13


@pytest.mark.parametrize("m", [1e-4, 0.02, 0.4, 1.0])
def test_the_table(m: float) -> None:
    """Between its steps and at its ends it is the integral, within 1e-11; its mean that of the values."""
    ends = panels(m)
    rng = np.random.default_rng(5)
    for low, high in zip(ends[:-1:3], ends[1::3], strict=False):
        mu = np.minimum(m * np.exp(np.append(low + (high - low) * rng.random(4), high)), 1.0)
        for F0, expected in zip((1.0, 0.0), losses(m, mu), strict=True):
            known = specular_loss(m, F0)
            found = [loss_at(known.values, known.first, known.per, c) for c in mu.tolist()]
            assert np.max(np.abs(found - expected)) < 1e-11
    x, w = np.polynomial.legendre.leggauss(200)
    for F0, mean in ((1.0, tabulated(m).mean_white), (0.0, tabulated(m).mean_dark)):
        known = specular_loss(m, F0)
        # 2 ∫ mu loss dmu in v = log(mu), from where less than 1e-13 is left
        low = -math.log(3e6)
        v = 0.5 * low * (1.0 - x)
        total = sum(
            -0.5 * low * share * 2.0 * math.exp(2.0 * t) * loss_at(known.values, known.first, known.per, math.exp(t))
            for t, share in zip(v.tolist(), w.tolist(), strict=True)
        )
        assert math.isclose(total, mean, rel_tol=1e-7)


def test_below_the_table_it_stands_still() -> None:
    known = specular_loss(0.5, 1.0)
    ends = [loss_at(known.values, known.first, known.per, mu) for mu in (1e-15, 0.5e-12)]
    assert ends[0] == ends[1]
    assert 0.0 < ends[0] < 3e-11
