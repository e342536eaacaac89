"""What a rough surface without masking does not reflect: 1 minus the albedo of F D / (4 (L.H)^2), D Beckmann's of one width m.

Half-vectors drawn with density D cos weigh 2 z' / (z' + z), z and z' the cosines of both directions. Let x be a facet's slope in
the plane of incidence and y the one across, r = tan(theta), a = 1 / (r + sqrt(1 + r^2)) and S^2 = (x + a) (1/a - x). Then

    weight = (S^2 - y^2) / (1 + r x)   where y^2 < S^2, else 0;      L.H = z (1 + r x) / sqrt(1 + x^2 + y^2);
    albedo = 2 / (pi m^2) * integral over x in (-a, 1/a), y in (0, S) of exp(-(x^2 + y^2) / m^2) weight F(L.H).

Schlick's F = F0 + (1 - F0) (1 - L.H)^5 leaves two integrals, F = 1 and F = (1 - L.H)^5, which depend on m and z only. For small
z the facets change their part over slopes from a / m to 1, in units of m, and near -a also where S is of the order of m: Gauss's
rule is used on panels that grow fourfold from the smaller scale. The albedo is then a function of log(z / m), with most of its
features near z = m: it is found at Gauss's points of panels there, and brought to equal steps for a table that kernels can read.
"""

from __future__ import annotations

from functools import lru_cache
from itertools import pairwise
from math import ceil, log
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from albedo_lab.optics.maths import log as log_in_lanes
from albedo_lab.tables import Table, table

Floats = NDArray[np.float64]

SMALLEST = 1e-12
"""Below this cosine, in units of m, the table stands still: what is lost is of the order z/m log(m/z), 3e-11 there."""
CELLS = 4096
CUT = 6.5
"""Beyond so many m lies 1e-18 of the slopes."""


def rule(count: int) -> tuple[Floats, Floats]:
    """Gauss's nodes and weights over [0, 1]."""
    x, w = np.polynomial.legendre.leggauss(count)
    return 0.5 + 0.5 * x, 0.5 * w


ALONG, ACROSS, COSINES = rule(12), rule(24), rule(16)
STEEP, FAINT, MIDDLE = 4.0, 3e-5, 5
"""Growth of panels; the share of the first scale below which a feature is too faint to matter; panels over what is left."""


def losses(m: float, mu: Floats) -> tuple[Floats, Floats]:
    """1 minus the albedo for F = 1 and for F = (1 - L.H)^5 at cosines of one order of magnitude, to 1e-13."""
    z = mu[:, None]
    root = 1.0 / z
    r = np.sqrt((1.0 - z) * (1.0 + z)) * root
    a = 1.0 / (r + root)
    # in units of m, from the left end: where the integral begins and ends, and the scales in between
    left, right = np.minimum(a / m, CUT), np.minimum(1.0 / (a * m), CUT)
    wide = np.minimum(left, 1.0)
    first = np.clip(4.0 * m * a, FAINT * wide, wide)
    growing = max(ceil(log(1.0 / float(first.min())) / log(STEEP)), 0)
    ends = [np.zeros_like(first), *(first ** (1.0 - i / growing) for i in range(growing)), np.ones_like(first)]
    ends += [ends[-1] + (left + right - ends[-1]) * i / MIDDLE for i in range(1, MIDDLE + 1)]
    low, size = np.stack(ends[:-1], 1), np.diff(np.stack(ends, 1), axis=1)
    # S is a root at both ends: the first and the last panel run in the root of the distance
    t, w = ALONG
    from_left, weight = low + size * t, size * w
    from_left[:, 0], weight[:, 0] = size[:, 0] * t * t, size[:, 0] * 2.0 * t * w
    from_right = (left + right)[:, :, None] - from_left
    from_right[:, -1], weight[:, -1] = size[:, -1] * (1.0 - t) ** 2, size[:, -1] * 2.0 * (1.0 - t) * w
    from_left[:, -1] = left + right - from_right[:, -1]
    d, e, weight = (part.reshape(len(mu), -1, 1) for part in (from_left, from_right, weight))
    z, root, r, a, left, right = (part[:, :, None] for part in (z, root, r, a, left, right))
    x = d - left
    s = np.sqrt((d + (a / m - left)) * (e + (1.0 / (a * m) - right)))
    facing = np.where(left < CUT, root / (r + root) + r * m * d, 1.0 + r * m * x)  # 1 + r x
    t, w = ACROSS
    high = np.minimum(s, CUT)
    y = high * t
    slopes = x * x + y * y
    value = np.exp(-slopes) * (s * s - y * y) / facing * weight * high * w * (2.0 * m * m / np.pi)
    dark = 1.0 - z * facing / np.sqrt(1.0 + m * m * slopes)
    return 1.0 - np.sum(value, axis=(1, 2)), 1.0 - np.sum(value * dark**5, axis=(1, 2))


class Losses(NamedTuple):
    """For F = 1 and F = (1 - L.H)^5, at CELLS + 1 equal steps of log(mu) from SMALLEST m to 1; and their means over cosines."""

    white: Floats
    dark: Floats
    mean_white: float
    mean_dark: float


def panels(m: float) -> Floats:
    """Where panels of log(mu / m) end: wide below, narrow about mu = m."""
    low, high = log(SMALLEST), -log(m)
    bend, relax = -3.0, min(2.3, high)
    pieces = [(low, bend, 2.1), (bend, relax, 0.7), (relax, high, 1.0)]
    starts = [np.linspace(a, b, ceil((b - a) / step), endpoint=False) for a, b, step in pieces if b > a]
    return np.concatenate([*starts, [high]])


@lru_cache(64)
def tabulated(m: float) -> Losses:
    """The table of one width, in 0.1 s."""
    ends, (t, w) = panels(m), COSINES
    barycentric = 1.0 / np.prod(t[:, None] - t + np.eye(t.size), axis=1)
    grid = np.linspace(log(SMALLEST), -log(m), CELLS + 1)
    filled, means = np.empty((2, grid.size)), [0.0, 0.0]
    for low, high in pairwise(ends.tolist()):
        mu = np.minimum(m * np.exp(low + (high - low) * t), 1.0)
        inside = (grid >= low) & (grid <= high)
        gap = (grid[inside, None] - low) / (high - low) - t
        share = barycentric / np.where(gap == 0.0, 1e-300, gap)
        share /= np.sum(share, axis=1, keepdims=True)
        for i, values in enumerate(losses(m, mu)):
            filled[i, inside] = share @ values
            means[i] += 2.0 * (high - low) * float(np.sum(w * mu * mu * values))
    return Losses(filled[0], filled[1], means[0], means[1])


class Loss(NamedTuple):
    """The loss for one F0, its mean over cosines, the share of it that F = 1 has; the table's first logarithm, steps per unit."""

    values: Table
    mean: float
    white: float
    first: float
    per: float


@lru_cache(256)
def specular_loss(m: float, F0: float) -> Loss:
    """The loss with Schlick's F, which is linear in F0."""
    known, first = tabulated(m), log(SMALLEST * m)
    mean = F0 * known.mean_white + (1.0 - F0) * known.mean_dark
    return Loss(table(F0 * known.white + (1.0 - F0) * known.dark), mean, F0 * known.mean_white / mean, first, CELLS / -first)


def loss_at(values: Table, first: float, per: float, mu: float) -> float:
    """The loss at a cosine, by the polynomial of degree 5 through the six nearest values: within 1e-11 of the integral."""
    x = max((log_in_lanes(mu) - first) * per, 0.0)
    i = min(max(int(x), 2), CELLS - 3)
    c = x - i
    a, b, d, e, f = c + 2.0, c + 1.0, c - 1.0, c - 2.0, c - 3.0
    far: float = b * c * d * e * (a * values[i + 3] - f * values[i - 2]) / 120.0
    near: float = a * c * d * f * (e * values[i - 1] - b * values[i + 2]) / 24.0
    nearest: float = a * b * e * f * (c * values[i + 1] - d * values[i]) / 12.0
    return far + near + nearest
