"""Sound samplers are acquitted, sick ones convicted, and the cells cover the hemisphere."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from albedo_lab import catalogue
from albedo_lab.analysis import sampler as page
from albedo_lab.analysis.sampler import VIEWERS, lay_out, measure, quality, sampler
from albedo_lab.analysis.verdict import Finding, Subject, Trial, Verdict, judged
from albedo_lab.estimate.record import exact
from albedo_lab.kernels.histogram import BAD_DENSITY, END, FIRST, HIGH_E, HIGH_TURN, LOW_E, LOW_TURN
from albedo_lab.model import Model
from albedo_lab.models.blinn import MODEL as BLINN
from albedo_lab.models.blinn import pdf as blinn_pdf
from albedo_lab.models.lambert import MODEL as LAMBERT
from albedo_lab.models.lambert import pdf as lambert_pdf
from albedo_lab.models.phong import MODEL as PHONG
from albedo_lab.models.phong import evaluate as phong
from albedo_lab.models.phong import pdf as phong_pdf
from albedo_lab.models.phong import sample as sample_phong
from albedo_lab.models.retro_phong import MODEL as RETRO_PHONG
from albedo_lab.models.ward import MODEL as WARD
from albedo_lab.models.ward import pdf as ward_pdf
from albedo_lab.models.ward import sample as sample_ward
from albedo_lab.optics.frame import Direction, bisector, length, mirror_of
from albedo_lab.optics.lobes import lobe_pdf, power_normal_pdf
from tests.models import trial

ALPHA = 1e-4
"""How often a sound package may fail a judgement here; fixed seeds make it once or never."""
SEEDS = 5
QUICK = Trial(budget=1 << 20)


def subject(model: Model, values: dict[str, Any]) -> Subject:
    chosen, p = trial.member(model, values)
    return Subject(chosen, p, exact(1.0))


def verdicts(model: Model, values: dict[str, Any], how: Trial = QUICK) -> set[Verdict]:
    return {finding.verdict for finding in judged(sampler(subject(model, values), how), ALPHA)}


# Sound samplers


SOUND: list[tuple[str, dict[str, Any]]] = [
    ("lambert", {}),
    ("phong", {"n": 0.0}),
    ("phong", {"n": 1e8}),
    ("ward", {"m_x": 0.1, "m_y": 0.4}),
    ("plastic", {"n": 1e8}),
]


@pytest.mark.parametrize(("name", "values"), SOUND)
def test_sound_samplers_are_acquitted(name: str, values: dict[str, Any]) -> None:
    found = verdicts(catalogue.find(name), values)
    assert Verdict.PASS in found
    assert found <= {Verdict.PASS, Verdict.SKIPPED}


@pytest.mark.slow
@pytest.mark.parametrize("name", [name for name in trial.SPECIMENS if catalogue.find(name).sample])
def test_no_sound_sampler_is_accused(name: str) -> None:
    """Every specimen, at the full number of samples, judged together over several seeds."""
    findings: list[Finding] = []
    for seed in range(SEEDS):
        for model, p in trial.specimens(catalogue.find(name)):
            findings += sampler(Subject(model, p, exact(1.0)), Trial(seed=seed))
    told = judged(findings, ALPHA)
    assert {finding.verdict for finding in told} <= {Verdict.PASS, Verdict.SKIPPED, Verdict.INCONCLUSIVE}
    assert sum(finding.verdict is Verdict.INCONCLUSIVE for finding in told) < 0.05 * len(told)


@pytest.mark.slow
@pytest.mark.parametrize(("name", "values"), [("phong", {"n": 20.0}), ("ward", {"m": 1e-3}), ("blinn", {"n": 1.0})])
def test_probabilities_are_those_of_chance(name: str, values: dict[str, Any]) -> None:
    """Over seeds, by Kolmogorov's distance, 1.95 / sqrt(n) at one in a thousand: those of chi-square are uniform.

    Of the estimators they are no smaller than that, which is what the level promises; larger they may be, since the bound of the
    quadrature over the cells counts as if it were noise.
    """
    findings = [f for seed in range(20) for f in sampler(subject(catalogue.find(name), values), Trial(seed=seed, budget=1 << 22))]
    for what in ("samples against", "estimators of"):
        p = np.sort([f.p_value for f in findings if f.p_value is not None and f.statement.startswith(what)])
        assert len(p) >= 40
        ranks = np.arange(len(p)) / len(p)
        assert np.max(ranks + 1.0 / len(p) - p) < 1.95 / math.sqrt(len(p))
        assert what == "estimators of" or np.max(p - ranks) < 1.95 / math.sqrt(len(p))


# Sick ones, made of sound ones


def no_jacobian(p: Any, wi: Direction, wo: Direction) -> float:
    return blinn_pdf(p, wi, wo) * 2.0 * length(bisector(wi, wo))


def too_large(p: Any, wi: Direction, wo: Direction) -> float:
    return 1.01 * phong_pdf(p, wi, wo)


def next_exponent(p: Any, wi: Direction, wo: Direction) -> float:
    return power_normal_pdf(bisector(wi, wo), p.n + 1.0)


def squared_exponent(p: Any, wi: Direction, wo: Direction) -> float:
    return lobe_pdf(mirror_of(wo), wi, p.n * p.n)


def swapped(p: Any, wi: Direction, wo: Direction) -> float:
    return lambert_pdf(p, wo, wi)


def half_the_azimuths(p: Any, wo: Direction, u1: float, u2: float) -> Direction:
    return sample_ward(p, wo, u1, 0.5 * u2)


def density_of_half(p: Any, wi: Direction, wo: Direction) -> float:
    return 2.0 * ward_pdf(p, wi, wo) if bisector(wi, wo).y > 0.0 else 0.0


def azimuth_halved(p: Any, wo: Direction, u1: float, u2: float) -> Direction:
    w = sample_phong(p, wo, u1, u2)
    s, phi = math.sqrt(w.x * w.x + w.y * w.y), 0.5 * math.atan2(w.y, w.x)
    return Direction(s * math.cos(phi), s * math.sin(phi), w.z)


def weight_without_density(p: Any, wo: Direction, u1: float, u2: float) -> float:
    wi = sample_phong(p, wo, u1, u2)
    return phong(p, wi, wo) * wi.z if wi.z > 0.0 else 0.0


def negative(p: Any, wi: Direction, wo: Direction) -> float:
    return phong_pdf(p, wi, wo) - 1e-3


def too_long(p: Any, wo: Direction, u1: float, u2: float) -> Direction:
    w = sample_phong(p, wo, u1, u2)
    return Direction(1.01 * w.x, w.y, w.z)


def nowhere(p: Any, wi: Direction, wo: Direction) -> float:
    return math.nan


def one_direction(p: Any, wo: Direction, u1: float, u2: float) -> Direction:
    return Direction(0.0, 0.6, 0.8)


def never(p: Any, wo: Direction, u1: float, u2: float) -> Direction:
    return Direction(0.0, 0.0, -1.0)


SICK: dict[str, tuple[Model, dict[str, Any]]] = {
    "no Jacobian of reflection": (replace(BLINN, pdf=no_jacobian), {"n": 20.0}),
    "density 1 % too large": (replace(PHONG, pdf=too_large), {"n": 20.0}),
    "density 1 % too large, narrow": (replace(PHONG, pdf=too_large), {"n": 1e8}),
    "n + 1 in the density": (replace(BLINN, pdf=next_exponent), {"n": 20.0}),
    "n squared in the density": (replace(PHONG, pdf=squared_exponent), {"n": 5.0}),
    "wi and wo swapped in the density": (replace(LAMBERT, pdf=swapped), {}),
    "sampler of the wrong lobe": (replace(PHONG, sample=RETRO_PHONG.sample), {"n": 20.0}),
    "sampler of the wrong lobe, narrow": (replace(PHONG, sample=RETRO_PHONG.sample), {"n": 1e6}),
    "half the azimuths": (replace(WARD, sample=half_the_azimuths), {"m": 0.3}),
    "half the azimuths, narrow": (replace(WARD, sample=half_the_azimuths), {"m": 1e-3}),
    "half the azimuths, and the density says so": (
        replace(WARD, sample=half_the_azimuths, pdf=density_of_half, weight=None),
        {"m": 0.3},
    ),
    "azimuth halved": (replace(PHONG, sample=azimuth_halved), {"n": 20.0}),
    "1 / density missing in the weight": (replace(PHONG, weight=weight_without_density), {"n": 20.0}),
    "negative density": (replace(PHONG, pdf=negative), {"n": 20.0}),
    "directions too long": (replace(PHONG, sample=too_long), {"n": 20.0}),
    "density nowhere defined": (replace(PHONG, pdf=nowhere), {"n": 20.0}),
    "f nowhere defined": (replace(PHONG, evaluate=nowhere), {"n": 20.0}),
    "always the same direction": (replace(PHONG, sample=one_direction), {"n": 20.0}),
    "always rejected": (replace(PHONG, sample=never), {"n": 20.0}),
}


@pytest.mark.parametrize("fault", SICK)
def test_sick_samplers_are_convicted(fault: str) -> None:
    assert Verdict.FAIL in verdicts(*SICK[fault])


def test_who_convicts() -> None:
    """A weight without its density is told by the estimators alone, a density too large by its integral, at every viewer."""
    told = judged(sampler(subject(*SICK["1 / density missing in the weight"]), QUICK), ALPHA)
    assert [f.statement[:10] for f in told if f.verdict is Verdict.FAIL] == len(VIEWERS) * ["estimators"]
    told = judged(sampler(subject(*SICK["density 1 % too large"]), QUICK), ALPHA)
    assert sum(f.statement.startswith("density and") and f.verdict is Verdict.FAIL for f in told) == len(VIEWERS)


def test_a_fault_has_a_witness() -> None:
    found = [f for f in sampler(subject(*SICK["negative density"]), QUICK) if f.verdict is Verdict.FAIL]
    assert len(found) == len(VIEWERS)
    assert page.FAULTS[BAD_DENSITY] in found[0].statement
    assert "density = -" in found[0].witness


# What there is to check


@pytest.mark.parametrize(
    ("model", "reason"), [(replace(PHONG, sample=None, pdf=None), "no sampler"), (replace(PHONG, pdf=None), "without a density")]
)
def test_a_model_that_cannot_be_sampled_says_so(model: Model, reason: str) -> None:
    for check in (sampler, quality):
        (finding,) = check(subject(model, {}), QUICK)
        assert finding.verdict is Verdict.SKIPPED
        assert reason in finding.statement


def test_the_same_bits_whatever_the_threads() -> None:
    one, two = (sampler(subject(PHONG, {"n": 20.0}), replace(QUICK, threads=threads)) for threads in (1, 2))
    assert one == two
    assert one != sampler(subject(PHONG, {"n": 20.0}), replace(QUICK, seed=1))


# Cells and their integrals


@pytest.mark.parametrize("width", [1.0, 1e-6, 0.0])
def test_cells_cover_the_hemisphere_and_hold_their_points(width: float) -> None:
    rng = np.random.default_rng(1)
    points = np.clip(0.5 + width * (rng.random((5000, 2)) - 0.5), 0.0, 1.0 - 1e-16)
    cells = lay_out(points)
    area = (cells.boxes[:, HIGH_E] - cells.boxes[:, LOW_E]) * (cells.boxes[:, HIGH_TURN] - cells.boxes[:, LOW_TURN])
    assert math.isclose(area.sum(), 1.0, rel_tol=1e-12)
    assert (cells.boxes[:, END] - cells.boxes[:, FIRST]).sum() == len(points)
    for low_e, high_e, low, high, _, first, end in cells.boxes:
        e, turn = cells.points[:, int(first) : int(end)]
        assert np.all((e >= low_e) & (e <= high_e) & (turn >= low) & (turn <= high))
    if width:
        shares = cells.boxes[:, END] - cells.boxes[:, FIRST]
        assert shares.max() <= 2.0 * len(points) / len(shares)


@pytest.mark.parametrize("no_points", [np.empty((0, 2)), np.array([[0.5, 0.1]])])
def test_a_pilot_of_nothing_makes_cells_all_the_same(no_points: Any) -> None:
    boxes = lay_out(no_points).boxes
    assert math.isclose(((boxes[:, 1] - boxes[:, 0]) * (boxes[:, 3] - boxes[:, 2])).sum(), 1.0)


@pytest.mark.parametrize(("name", "values"), [("phong", {"n": 20.0}), ("ward", {"m": 1e-3}), ("blinn", {"n": 0.0})])
def test_the_density_integrates_to_what_an_independent_rule_gives(name: str, values: dict[str, Any]) -> None:
    """The plain integral about the lobe's own axis, good to 1e-3 or better, shares nothing with the cells."""
    who = subject(catalogue.find(name), values)
    assert who.model.pdf is not None
    for mu in VIEWERS:
        m = measure(who, QUICK, mu)
        integral = m.expected.sum() / m.samples
        assert abs(integral - trial.accepted_by_density(who.model.pdf, who.model.smooth_in.axis, who.p, mu)) < 1e-3


def test_small_cells_are_pooled_by_expectation() -> None:
    expected = np.array([1.0, 100.0, -0.5, 2.0, 3.0, 7.0])
    observed, pooled, errors = page._pooled(np.array([0.0, 90.0, 0.0, 9.0, 1.0, 8.0]), expected, np.full(6, 0.1))
    assert pooled.tolist() == [5.5, 7.0, 100.0]
    assert observed.tolist() == [10.0, 8.0, 90.0]
    assert np.allclose(errors, [0.2, 0.1, 0.1])


# Quality


def test_quality_of_known_samplers() -> None:
    """Lambert's own sampler is cosine sampling, without variance; of Phong's lobe at 80 degrees a part lies below the horizon."""
    for finding in quality(subject(LAMBERT, {}), QUICK):
        assert finding.verdict is Verdict.REPORTED
        assert finding.figure < 1e-20
        assert finding.details["rejected"] == 0.0
        assert math.isclose(finding.details["largest"], 1.0)
    who = subject(PHONG, {"n": 20.0})
    for finding, mu in zip(quality(who, QUICK), VIEWERS, strict=True):
        share = max(1.0 - trial.accepted_by_density(phong_pdf, who.model.smooth_in.axis, who.p, mu), 0.0)
        assert abs(finding.details["rejected"] - share) < 2e-3 + 5.0 * math.sqrt(abs(share) / (QUICK.budget / 8))
        assert finding.details["efficiency"] > 1.0
