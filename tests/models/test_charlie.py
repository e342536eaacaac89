"""Charlie: the formula in angles, the albedo in closed form, and how good the fit of Smith's masking is."""

from __future__ import annotations

import math
from itertools import pairwise

import pytest
from scipy.integrate import quad
from scipy.special import gammaln

from albedo_lab.analysis.grazing import law
from albedo_lab.analysis.verdict import Subject
from albedo_lab.estimate.methods import estimate
from albedo_lab.estimate.record import Question, exact
from albedo_lab.models.charlie import MODEL, Charlie, log_lambda
from albedo_lab.optics.coordinates import Axis
from tests.models import trial
from tests.models.trial import PI, member

ROUGHNESSES = (0.05, 0.3, 1.0)


def fitted(theta: float, r: float) -> float:
    """Lambda as printed: exp of a fit below the cosine 1/2, mirrored in that point above; at the normal 1 - cos is rounded."""
    t = (1 - r) ** 2
    smooth, rough = (25.3245, 3.32435, 0.16801, -1.27393, -4.85967), (21.5473, 3.82987, 0.19823, -1.97760, -4.32054)
    a, b, c, d, e = (t * x + (1 - t) * y for x, y in zip(smooth, rough, strict=True))

    def L(x: float) -> float:
        return a / (1 + b * x**c) + d * x + e

    x = math.cos(theta)
    return math.exp(L(x) if x < 0.5 else 2 * L(0.5) - L(1 - x))


@pytest.mark.parametrize("r", ROUGHNESSES)
@pytest.mark.parametrize("visibility", ["softened", "smith", "neubelt"])
def test_formula(visibility: str, r: float) -> None:
    model, p = member(MODEL, {"visibility": visibility, "r": r})

    def printed(light: float, viewer: float, turn: float) -> float:
        v_l, v_v = math.cos(light), math.cos(viewer)
        sine = math.sqrt(max(1 - trial.half_cosine(light, viewer, turn) ** 2, 0.0))
        D = (2 + 1 / r) * (sine if sine > 1e-7 else 0.0) ** (1 / r) / (2 * PI)
        if visibility == "neubelt":
            return D / (4 * (v_l + v_v - v_l * v_v))
        power = 1 + 2 * (1 - v_l) ** 8 if visibility == "softened" else 1
        return D / ((1 + fitted(light, r) ** power + fitted(viewer, r)) * 4 * v_l * v_v)

    trial.assert_formula(model, p, printed)


@pytest.mark.parametrize("r", [1e-3, 0.1, 0.5, 1.0])
def test_albedo_with_the_visibility_of_neubelt(r: float) -> None:
    """At normal incidence, n = 1/r, 2^(-n/2) / (n+4); at grazing (n+2)/pi int sin^(n+2), which exceeds 1 from r = 0.21 down."""
    model, p = member(MODEL, {"visibility": "neubelt", "r": r})
    n = 1 / r
    grazing = (n + 2) / (2 * math.sqrt(PI)) * math.exp(gammaln((n + 3) / 2) - gammaln((n + 4) / 2))
    for mu, expected, off in ((1.0, 2 ** (-n / 2) / (n + 4), 0.0), (1e-12, grazing, 1e-9)):
        answer = estimate(Question(model, p, mu), trial.relative(1e-9), "quadrature", 0, 1)
        assert abs(answer.value - expected) <= answer.half_width + off * expected
    assert (grazing > 1) == (r < 0.21)


def smith(r: float, mu: float) -> float:
    """1 + Lambda of these normals: the share of slopes above x is 1 - sin^(n+2); see optics.masking."""
    t = mu / math.sqrt((1 - mu) * (1 + mu))

    def f(w: float) -> float:
        xx = t * t + w * w
        return -math.expm1(-(1 / r + 2) / 2 * math.log1p(1 / xx)) * w * w / xx

    ends = [0.0, t, 1.0, 10 / math.sqrt(r), 1e4 / math.sqrt(r)]
    pieces = [quad(f, a, b, epsabs=1e-10, limit=200)[0] for a, b in pairwise(ends)]
    return 1 + (sum(pieces) + (1 / r + 2) / 2 / ends[-1]) / (PI * t)


def test_the_fit_of_the_masking() -> None:
    """Of G1, off by less than 0.05 for r >= 0.1; by 0.5 for r = 1e-3, and without end towards grazing, where it is bounded."""

    def off(r: float, mu: float) -> float:
        return 1 / (1 + math.exp(log_lambda(Charlie(r), trial.at(mu)))) - 1 / smith(r, mu)

    mus = (0.99, 0.9, 0.7, 0.5, 0.3, 0.1, 1e-2, 1e-3)
    assert max(abs(off(r, mu)) for r in (0.1, 0.2, 0.3, 0.5, 0.7, 1.0) for mu in mus) < 0.05
    assert max(off(1e-3, mu) for mu in mus) > 0.5
    for r in ROUGHNESSES:
        assert off(r, 1e-9) * smith(r, 1e-9) > 25


@pytest.mark.parametrize("visibility", ["softened", pytest.param("smith", marks=pytest.mark.slow)])
def test_the_albedo_diverges(visibility: str) -> None:
    """1 / (N.V) is left of a Lambda that stays below exp(21)."""
    model, p = member(MODEL, {"visibility": visibility, "r": 0.3})
    assert law(Subject(model, p, exact(1.0))).behaviour == "diverges"


def test_the_density_is_normalised() -> None:
    """No sample is rejected."""
    assert MODEL.pdf is not None
    for r in (1e-3, 0.3):
        assert math.isclose(trial.accepted_by_density(MODEL.pdf, Axis.NORMAL, Charlie(r), 0.5), 1.0, rel_tol=1e-5)
