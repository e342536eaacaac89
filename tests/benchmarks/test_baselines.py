"""The baselines ask the same question by the same estimator as albedo_lab: else comparing their speed says nothing."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache

import pytest

from tests.benchmarks import baseline_cpp, baseline_numpy, baseline_scipy
from tests.benchmarks.moments import Moments
from tests.benchmarks.subjects import MU, SUBJECTS, Subject
from tests.oracles.albedo import albedo

SAMPLES = 1 << 18
Estimator = Callable[..., Moments]

BASELINES: dict[str, Estimator] = {"numpy": baseline_numpy.estimate}
if baseline_cpp.compiler() is not None:
    BASELINES |= {
        f"cpp {'xoshiro' if fast else 'mt19937_64'}{' reduced' if reduced else ''}": (
            lambda *where, fast=fast, reduced=reduced: baseline_cpp.estimate(*where, baseline_cpp.PLAIN, fast, reduced)
        )
        for fast in (False, True)
        for reduced in (False, True)
    }

baseline = pytest.mark.parametrize("estimate", BASELINES.values(), ids=BASELINES.keys())
subject = pytest.mark.parametrize("subject", SUBJECTS, ids=str)


@cache
def oracle(subject: Subject) -> float:
    return albedo(subject.name, MU, effort=1, **{subject.parameter: subject.value})[0]


@cache
def ours(subject: Subject, generic: bool) -> Moments:
    return subject.sampler(SAMPLES, generic=generic)()


@baseline
@subject
def test_a_baseline_gives_the_oracles_albedo_within_its_standard_error(subject: Subject, estimate: Estimator) -> None:
    found = estimate(subject.name, subject.value, MU, SAMPLES, 7)
    assert abs(found.mean - oracle(subject)) < 4.0 * found.standard_error


@baseline
@subject
def test_a_baseline_has_the_variance_of_our_kernel(subject: Subject, estimate: Estimator) -> None:
    found = estimate(subject.name, subject.value, MU, SAMPLES, 8)
    assert found.deviation == pytest.approx(ours(subject, True).deviation, rel=0.02)


@baseline
@subject
def test_a_baseline_with_another_parameter_is_found_out(subject: Subject, estimate: Estimator) -> None:
    found = estimate(subject.name, 1.2 * subject.value, MU, SAMPLES, 9)
    assert abs(found.mean - oracle(subject)) > 6.0 * found.standard_error


@pytest.mark.parametrize("generic", [True, False], ids=["contract", "reduced"])
@subject
def test_our_kernel_gives_the_oracles_albedo_within_its_standard_error(subject: Subject, generic: bool) -> None:
    found = ours(subject, generic)
    assert abs(found.mean - oracle(subject)) < 4.0 * found.standard_error


@pytest.mark.parametrize("careful", [False, True], ids=["plain", "careful"])
@pytest.mark.parametrize("integrate", [baseline_scipy.by_dblquad, baseline_scipy.by_cubature])
@subject
def test_scipy_integrates_the_same_albedo(subject: Subject, integrate: Callable[..., float], careful: bool) -> None:
    found = integrate(subject.name, subject.value, MU, 1e-6, careful)
    assert found == pytest.approx(oracle(subject) * subject.scale, abs=1e-6)


@subject
def test_the_quadrature_that_errors_are_measured_against_is_right(subject: Subject) -> None:
    assert subject.albedo == pytest.approx(oracle(subject) * subject.scale, abs=1e-8)
