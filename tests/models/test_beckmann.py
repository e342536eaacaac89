"""Beckmann: the formula in angles, an exact density, the mirror that it tends to, its oracle, its domain."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

import pytest
from scipy.special import erfc

from albedo_lab.models.beckmann import MODEL, Beckmann
from albedo_lab.optics.frame import Direction, reflect
from albedo_lab.optics.masking import cot
from albedo_lab.optics.maths import log
from albedo_lab.optics.microfacet import elliptic_visible, normal_about, visible_gaussian
from tests.models import trial
from tests.models.test_ggx import (
    CASES_AT_A_HUNDRED_MILLION,
    ELLIPTIC,
    LONGEST,
    SMALLEST,
    assert_acquitted_at_a_hundred_million,
    assert_agrees_with_microfacet,
    assert_bounds_hold,
    assert_density_is_the_jacobian,
    assert_is,
    assert_oracle_is_sound,
    assert_tends_to_a_mirror,
    assert_weight_is_masking_of_the_light,
)
from tests.models.trial import PI


def test_formula() -> None:
    assert_is(MODEL, lambda x: math.exp(-x * x) / PI, lambda a: math.exp(-a * a) / (2 * a * math.sqrt(PI)) - 0.5 * float(erfc(a)))


def test_round_it_is_microfacets_beckmann() -> None:
    assert_agrees_with_microfacet(MODEL, "beckmann", "m")


def test_the_axes_are_x_and_y() -> None:
    """alpha_x spreads the normals along x."""
    p = MODEL.bind({"alpha_x": 0.4, "alpha_y": 0.1})
    along, across = (MODEL.evaluate(p, trial.at(0.9, phi), trial.at(1.0)) for phi in (0.0, 0.5 * PI))
    assert along > 10 * across


def test_bounds_hold_over_the_domain() -> None:
    assert_bounds_hold(MODEL, [(SMALLEST, 1e-5), (SMALLEST, 0.1), ({"alpha": 1.0}, 0.5), (LONGEST, 0.3), (ELLIPTIC, 1e-6)])


def test_the_oracle() -> None:
    assert_oracle_is_sound("beckmann", {"alpha_x": 0.3, "alpha_y": 0.5})


def test_density_is_exact() -> None:
    assert_density_is_the_jacobian(MODEL)


def test_weight() -> None:
    assert_weight_is_masking_of_the_light(MODEL)


def test_tends_to_a_mirror() -> None:
    """E x = sqrt(pi) / 2 alpha; steeper than mu/4 are exp(-(mu / 4 alpha)^2), nothing, and Lambda of half that height as well."""
    assert_tends_to_a_mirror(MODEL, 1e-5, 0.5 * math.sqrt(PI) * 1e-5, lambda alpha, mu: 1e-12)


def winitzki(u: float) -> float:
    """The Gaussian slope of survival u by an inverse of erf that is good to 2e-3, as renderers have shipped."""
    x = 1.0 - 2.0 * u
    log_ = log(4.0 * u * (1.0 - u))
    h = 2.0 / (0.147 * PI) + 0.5 * log_
    root = math.sqrt(max(math.sqrt(h * h - log_ / 0.147) - h, 0.0))
    return root if x > 0.0 else -root


def roughly_visible(m: float, wo: Direction, u1: float, u2: float) -> Direction:
    return normal_about(wo, m * visible_gaussian(min(cot(wo) / m, 1e30), u1), m * winitzki(u2))


def sample_roughly(p: Beckmann, wo: Direction, u1: float, u2: float) -> Direction:
    return reflect(wo, elliptic_visible(roughly_visible, p.alpha_x, p.alpha_y, wo, u1, u2))


ROUGHLY = replace(MODEL, sample=sample_roughly, choices=(), make=None)


def test_a_rough_inverse_of_erf_is_caught() -> None:
    """Which chi-square over 576 cells misses even at 1e8 samples (p = 0.0035 and above)."""
    with pytest.raises(AssertionError):
        assert_density_is_the_jacobian(ROUGHLY)


@pytest.mark.slow
@pytest.mark.parametrize(("values", "mu"), CASES_AT_A_HUNDRED_MILLION)
def test_samples_follow_the_density_at_a_hundred_million(
    monkeypatch: pytest.MonkeyPatch, values: dict[str, Any], mu: float
) -> None:
    assert_acquitted_at_a_hundred_million(monkeypatch, MODEL, values, mu)
