"""What must hold of every model, at the ends of its parameters and at grazing angles too; broken twins must fail."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from functools import cache
from itertools import product
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings, strategies

from albedo_lab import catalogue
from albedo_lab.estimate.methods import estimate
from albedo_lab.estimate.record import Estimate, Question, Tolerance, exact
from albedo_lab.estimate.sampling import rqmc
from albedo_lab.kernels.sampling import NON_FINITE, SMALLEST, SUM, sampling_kernel
from albedo_lab.model import Model
from albedo_lab.models.blinn import MODEL as BLINN
from albedo_lab.models.phong import MODEL as PHONG
from albedo_lab.models.phong_original import MODEL as PHONG_ORIGINAL
from albedo_lab.models.retro_phong import MODEL as RETRO_PHONG
from albedo_lab.models.retro_phong import sample as sample_retro
from albedo_lab.models.stretched_phong import MODEL as STRETCHED_PHONG
from albedo_lab.models.ward import MODEL as WARD
from albedo_lab.models.ward import Ward, gaussian
from albedo_lab.models.ward import sample as sample_ward
from albedo_lab.optics.coordinates import Axis
from albedo_lab.optics.frame import Direction, bisector, cosine_power, mirror_of
from tests.models import trial
from tests.models.crowd import unsound
from tests.models.trial import Cell, Member

NAMES = [name for name in catalogue.names() if name != "merl"]
"""A measurement needs its file: tests/models/test_merl.py."""
SAMPLED = [name for name in NAMES if catalogue.find(name).sample]
SEED = 1999
RAREST = SMALLEST
"""The smallest uniform that a kernel may hand to a sampler."""
MILLION = 1_000_000
FAST_MEMBERS = 1
"""Of a family; each is a kernel that takes seconds to compile, and the slow tests take all of them."""
QUICK = 1 << 20
AFFORDABLE_MEMBER = 1 << 24
AFFORDABLE = 1 << 28
"""Samples a cell may cost in the fast tests; what does not reach its tolerance with them must still be honest."""

FAMILIES = sorted({cell.name for cell in trial.reference() if cell.family})
every_model = pytest.mark.parametrize("name", NAMES)
every_sampler = pytest.mark.parametrize("name", SAMPLED)
quick = settings(max_examples=60, deadline=None, derandomize=True, database=None)


# Values


@every_model
def test_f_is_finite_and_not_negative(name: str) -> None:
    model = catalogue.find(name)

    @quick
    @given(trial.bindings(model), trial.pairs())
    def check(member: Member, pair: tuple[Direction, Direction]) -> None:
        f = member.model.evaluate(member.p, *pair)
        assert math.isfinite(f) or not member.model.positive
        assert f >= 0.0 or not member.model.positive
        if member.model.pdf is not None:
            density = member.model.pdf(member.p, *pair)
            assert math.isfinite(density)
            assert density >= 0.0

    check()


def assert_sound_sample(model: Model, p: Any, wo: Direction, u1: float, u2: float) -> None:
    wi = model.sample(p, wo, u1, u2)
    assert math.isclose(wi.x**2 + wi.y**2 + wi.z**2, 1.0, rel_tol=1e-12)
    if wi.z > 0.0:
        f, density = model.evaluate(p, wi, wo), model.pdf(p, wi, wo)
        assert density > 0.0
        assert 0.0 <= f * wi.z / density < math.inf or not model.positive


@every_sampler
def test_sampled_directions_are_unit_and_their_weights_finite(name: str) -> None:
    model = catalogue.find(name)
    uniforms = strategies.floats(RAREST, 1.0 - 2.0**-33)

    @quick
    @given(trial.bindings(model), trial.directions(), uniforms, uniforms)
    def check(member: Member, wo: Direction, u1: float, u2: float) -> None:
        assert_sound_sample(*member, wo, u1, u2)

    check()


@every_sampler
def test_the_rarest_samples_are_sound(name: str) -> None:
    firsts, seconds = (RAREST, 2.0**-33, 1.0 - 2.0**-33), (2.0**-33, 0.2, 0.5, 0.8, 1.0 - 2.0**-33)
    for member, mu, u1, u2 in product(trial.specimens(catalogue.find(name)), trial.GRAZING, firsts, seconds):
        assert_sound_sample(*member, trial.at(mu), u1, u2)


@every_model
def test_reciprocity_is_as_declared(name: str) -> None:
    specimens = trial.specimens(catalogue.find(name))
    for model in dict.fromkeys(model for model, _ in specimens):
        parameters = [p for member, p in specimens if member is model]
        if model.reciprocal:
            trial.assert_reciprocal(model, *parameters)
        else:
            with pytest.raises(AssertionError):
                trial.assert_reciprocal(model, *parameters)


@every_model
def test_turning_the_surface_changes_nothing_unless_the_model_is_anisotropic(name: str) -> None:
    for model, p in trial.specimens(catalogue.find(name)):
        f = [model.evaluate(p, trial.at(0.8, 0.3 + turn), trial.at(0.6, 2.5 + turn)) for turn in (0.0, 1.0)]
        assert math.isclose(*f, rel_tol=1e-6) == model.isotropic(p)


# Samplers


ONE_OF_EACH_SAMPLER = {(m.sample, m.pdf): m.name for m in map(catalogue.find, SAMPLED)}.values()
"""Models that share both functions share what these tests know of them."""
HISTOGRAMS = sum(len(trial.moderate(catalogue.find(name))) for name in ONE_OF_EACH_SAMPLER)
"""Chi-square tests that share one level of false alarms."""
one_of_each_sampler = pytest.mark.parametrize("name", ONE_OF_EACH_SAMPLER)


@pytest.mark.parametrize("name", [name for name in ONE_OF_EACH_SAMPLER if catalogue.find(name).smooth_in.axis != Axis.LOBE])
def test_density_integrates_to_one_less_the_rejected_share(name: str) -> None:
    """Not of lobes about axes of their own: their own tests know where these point."""
    for member, mu in product(trial.specimens(catalogue.find(name)), trial.GRAZING):
        trial.assert_normalised(*member, mu)


@one_of_each_sampler
def test_samples_follow_the_density(name: str) -> None:
    member, mu = trial.moderate(catalogue.find(name))[0]
    trial.assert_follows_density(*member, mu, HISTOGRAMS)


@pytest.mark.slow
@one_of_each_sampler
def test_samples_of_other_members_follow_the_density(name: str) -> None:
    for member, mu in trial.moderate(catalogue.find(name))[1:]:
        trial.assert_follows_density(*member, mu, HISTOGRAMS)


# Albedos against the stored oracle


def rqmc_answers(model: Model, cells: list[Cell]) -> list[tuple[Cell, Estimate]]:
    """Every cell with random numbers of its own: the misses of a table that shares them would not be independent."""
    return [(cell, rqmc(cell.question(model), trial.relative(1e-5), SEED + cell.index, 1, budget=QUICK)) for cell in cells]


@cache
def quick_answers(name: str) -> list[tuple[Cell, Estimate]]:
    return rqmc_answers(catalogue.find(name), trial.cells_of(name, FAST_MEMBERS))


@every_model
def test_rqmc_agrees_with_the_oracle(name: str) -> None:
    for cell, answer in quick_answers(name):
        assert answer.non_finite == 0
        trial.assert_no_gross_error(cell, answer)


ONE_OF_EACH_GEOMETRY = {(m.smooth_in.axis, m.smooth_in.profile): m.name for m in map(catalogue.find, NAMES)}.values()
"""A model for every axis and profile; the slow tests take the rest."""


@pytest.mark.parametrize("name", sorted(ONE_OF_EACH_GEOMETRY))
def test_quadrature_agrees_with_the_oracle(name: str) -> None:
    model, tolerance = catalogue.find(name), trial.relative(1e-5)
    for cell in trial.cells_of(name, 1):
        answer = estimate(cell.question(model), tolerance, "quadrature", SEED, 1)
        assert answer.reaches(tolerance)
        trial.assert_within_bound(cell, answer)


def test_rqmc_intervals_are_honest() -> None:
    trial.assert_intervals_are_honest([pair for name in NAMES for pair in quick_answers(name)])


@pytest.mark.slow
@pytest.mark.parametrize("name", [name for name in NAMES if catalogue.find(name).weight])
def test_the_compiled_weight_is_the_contract(name: str) -> None:
    """The hand-reduced kernel and the generic one, over the same points."""
    keys = tuple(np.uint32(key) for key in (1, 2, 3, 4))
    for (model, p), mu in product(trial.specimens(catalogue.find(name)), trial.GRAZING):
        moments = np.zeros((2, 4))
        for generic, row in zip((False, True), moments, strict=True):
            kernel = sampling_kernel(model, False, True, "wi", generic)
            kernel(0, 8, np.uint32(0), keys, Question(model, p, mu).values, trial.viewer(model, p, mu), row)
        reduced, generic = moments
        assert math.isclose(reduced[SUM], generic[SUM], rel_tol=1e-9)
        assert reduced[NON_FINITE] == generic[NON_FINITE] == 0


@pytest.mark.slow
@pytest.mark.parametrize("order", ["wi", "wo"])
def test_both_orders_of_integration(order: str) -> None:
    """The only model that tells them apart, in the order that the fast tests leave out as well."""
    for cell in trial.cells_of("phong_original"):
        if cell.order == order:
            answer = estimate(cell.question(PHONG_ORIGINAL), trial.relative(1e-8), "quadrature", SEED, 1)
            trial.assert_within_bound(cell, answer)


@pytest.mark.slow
@every_model
def test_a_million_pairs_of_directions(name: str) -> None:
    """Half of them near the normal, near grazing, mirrored or retro; split evenly among the specimens."""
    specimens = trial.specimens(catalogue.find(name))
    for model, p in specimens:
        non_finite, negative, bad_density = unsound(model, p, -(-MILLION // len(specimens)))
        assert non_finite == bad_density == 0
        assert negative == 0 or not model.positive


@pytest.mark.slow
def test_every_cell_of_the_plain_models_at_a_millionth() -> None:
    """Quadrature and rqmc agree with each other and with the oracle; what samples cannot reach says so by its interval."""
    plain = [cell for cell in trial.reference() if not cell.family]
    reached = agreeing(plain, trial.relative(1e-6), AFFORDABLE)
    assert reached >= 0.95 * len(plain)  # not Schlick's heavy tails at r <= 0.1, for one


@pytest.mark.slow
@pytest.mark.parametrize("name", FAMILIES)
def test_every_cell_of_the_families(name: str) -> None:
    """The same of every member, at the default tolerance."""
    cells = [cell for cell in trial.cells_of(name) if cell.family]
    reached = agreeing(cells, trial.relative(1e-5), AFFORDABLE_MEMBER)
    assert reached >= 0.85 * len(cells)  # not facets that nothing hides, nor Schlick's eq. 12 and 18 near grazing


def agreeing(cells: list[Cell], tolerance: Tolerance, budget: int) -> int:
    """How many cells rqmc brought within the tolerance; of all, quadrature's bound and the intervals must hold."""
    answers, reached = [], 0
    for cell in cells:
        question = cell.question(catalogue.find(cell.name))
        integral = estimate(question, tolerance, "quadrature", SEED, 1)
        assert integral.reaches(tolerance)
        trial.assert_within_bound(cell, integral)
        answer = rqmc(question, tolerance, SEED + cell.index, 1, budget=budget)
        reached += answer.reaches(tolerance)
        trial.assert_no_gross_error(cell, answer)
        assert abs(integral.value - answer.value) <= integral.half_width + trial.allowance(answer)
        answers.append((cell, answer))
    trial.assert_intervals_are_honest(answers)
    return reached


# Broken twins: each check must see the fault that it is there for


def test_a_model_against_itself_passes() -> None:
    """The control of the controls: the same calls on the sound models."""
    trial.assert_normalised(BLINN, BLINN.bind({"n": 20.0}), 0.5)
    trial.assert_follows_density(PHONG, PHONG.bind({"n": 20.0}), 0.2, HISTOGRAMS)


def blinn_pdf_without_jacobian(p: Any, wi: Direction, wo: Direction) -> float:
    v = bisector(wi, wo)
    return BLINN.pdf(p, wi, wo) * 2.0 * math.sqrt(v.x * v.x + v.y * v.y + v.z * v.z)


def ward_pdf_without_jacobian(p: Ward, wi: Direction, wo: Direction) -> float:
    v = bisector(wi, wo)
    return gaussian(p, v) * (v.x * v.x + v.y * v.y + v.z * v.z) ** 1.5 / (v.z * v.z * v.z)


@pytest.mark.parametrize(
    "twin",
    [replace(BLINN, pdf=blinn_pdf_without_jacobian), replace(WARD, pdf=ward_pdf_without_jacobian)],
    ids=["blinn", "ward"],
)
def test_a_density_without_the_jacobian_of_reflection_is_caught(twin: Model) -> None:
    (twin, p), mu = trial.moderate(twin)[-1]
    with pytest.raises(AssertionError):
        trial.assert_normalised(twin, p, mu)
    with pytest.raises(AssertionError):
        trial.assert_follows_density(twin, p, mu, HISTOGRAMS)


def pdf_one_percent_too_large(p: Any, wi: Direction, wo: Direction) -> float:
    return 1.01 * PHONG.pdf(p, wi, wo)


def ward_sample_half_a_turn(p: Ward, wo: Direction, u1: float, u2: float) -> Direction:
    return sample_ward(p, wo, u1, 0.5 * u2)


@pytest.mark.parametrize(
    "twin",
    [
        replace(PHONG, pdf=pdf_one_percent_too_large),
        replace(PHONG, sample=sample_retro),
        replace(WARD, sample=ward_sample_half_a_turn),
    ],
    ids=["1 % too large", "wrong axis", "half the azimuths"],
)
def test_samples_that_do_not_follow_their_density_are_caught(twin: Model) -> None:
    (twin, p), mu = trial.moderate(twin)[-1]
    with pytest.raises(AssertionError):
        trial.assert_follows_density(twin, p, mu, HISTOGRAMS)


def phong_one_percent_too_bright(p: Any, wi: Direction, wo: Direction) -> float:
    return 1.01 * cosine_power(mirror_of(wo), wi, p.n)


def tilted_cells(name: str) -> list[Cell]:
    return [cell for cell in trial.cells_of(name) if cell.order == "wi" and cell.mu < 1.0][:6]


def assert_seen_to_be_wrong(answers: list[tuple[Cell, Estimate]]) -> None:
    for cell, answer in answers:
        with pytest.raises(AssertionError):
            trial.assert_no_gross_error(cell, answer)
    with pytest.raises(AssertionError):
        trial.assert_intervals_are_honest(answers)


def test_an_albedo_one_percent_too_bright_is_caught() -> None:
    twin = replace(PHONG, evaluate=phong_one_percent_too_bright)
    assert_seen_to_be_wrong(rqmc_answers(twin, tilted_cells("phong")))


def test_light_and_viewer_swapped_is_caught() -> None:
    cells = tilted_cells("phong_original")
    swapped = rqmc_answers(PHONG_ORIGINAL, [cell._replace(order="wo") for cell in cells])
    assert_seen_to_be_wrong([(cell, answer) for cell, (_, answer) in zip(cells, swapped, strict=True)])


def test_a_bound_that_does_not_hold_is_caught() -> None:
    for cell in trial.cells_of("ward"):
        answer = estimate(cell.question(WARD), trial.relative(1e-5), "quadrature", SEED, 1)
        with pytest.raises(AssertionError):
            trial.assert_within_bound(cell, answer.scaled(exact(1.01)))


@pytest.mark.parametrize("factor", [0.5, 2.0])
def test_intervals_of_the_wrong_width_are_caught(factor: float) -> None:
    """Half as wide they would miss 33 times in 100, twice as wide once in 10000 (and 0 misses of 500 is too few)."""

    def resized(answer: Estimate) -> Estimate:
        width = factor * answer.half_width
        return replace(answer, low=answer.value - width, high=answer.value + width)

    answers = [(cell, resized(answer)) for name in NAMES for cell, answer in quick_answers(name)]
    with pytest.raises(AssertionError):
        trial.assert_intervals_are_honest(answers)


def with_half_the_azimuth(evaluate: Callable[..., float]) -> Callable[..., float]:
    def halved(p: Any, wi: Direction, wo: Direction) -> float:
        return evaluate(p, trial.at(wi.z, 0.5 * math.atan2(wi.y, wi.x)), wo)

    return halved


def test_a_formula_with_half_the_azimuth_is_caught() -> None:
    p = PHONG.bind({"n": 5.0})
    with pytest.raises(AssertionError):
        trial.assert_formula(
            replace(PHONG, evaluate=with_half_the_azimuth(PHONG.evaluate)),
            p,
            lambda light, viewer, turn: trial.mirror_cosine(light, viewer, turn) ** p.n,
        )


def test_a_lobe_about_the_wrong_axis_is_caught() -> None:
    """Its albedo is right, since mirror and retro lobes are images of each other; its formula is not."""
    p = STRETCHED_PHONG.bind({"n": 5.0})
    with pytest.raises(AssertionError):
        trial.assert_formula(
            replace(STRETCHED_PHONG, evaluate=RETRO_PHONG.evaluate),
            p,
            lambda light, viewer, turn: trial.mirror_cosine(light, viewer, turn) ** p.n / trial.larger_cosine(light, viewer),
        )
