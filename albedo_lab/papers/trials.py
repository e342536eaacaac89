"""How statements without a table are put on trial: each function makes a trial, which computes and says what it found.

A trial computes when it is held, never when it is made: importing a document costs nothing.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from functools import lru_cache
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from albedo_lab.analysis.check import run
from albedo_lab.analysis.constant import constant
from albedo_lab.analysis.grazing import GrazingLaw, law
from albedo_lab.analysis.request import grid, model_of
from albedo_lab.analysis.verdict import Finding, Subject
from albedo_lab.analysis.verdict import Verdict as Judged
from albedo_lab.digits import typeset, with_error
from albedo_lab.estimate.quadrature import quadrature
from albedo_lab.estimate.record import Question, Tolerance, bounded
from albedo_lab.estimate.sampling import rqmc
from albedo_lab.papers.examine import FINEST
from albedo_lab.papers.recipes import Means, Recipe
from albedo_lab.papers.record import Evidence, Trial
from albedo_lab.papers.verdict import Kind, Printed, Verdict, judge

CLOSED = "closed form"
NEAR, NEARER = 1e-3, 1e-5
"""Cosines between which samples measure an exponent again."""


class Found(NamedTuple):
    """Whether a proposition holds, our figure, how it was found, and what a second method finds."""

    condition: bool
    ours: str
    method: str
    again: str


def holds(condition: bool) -> Verdict:
    """The verdict on a statement without digits."""
    return Verdict(Kind.HOLDS if condition else Kind.REFUTED, None)


def ruled(condition: bool, ours: str, method: str, again: str, why: str = "") -> Evidence:
    """The evidence on a proposition; `why` is told where it is refuted."""
    return Evidence(holds(condition), ours, method, again, "" if condition else why)


def apart(a: NDArray[np.float64], b: NDArray[np.float64]) -> float:
    """The largest relative difference."""
    return float(np.max(np.abs(a - b) / np.maximum(np.maximum(np.abs(a), np.abs(b)), 1e-300)))


def trial(find: Callable[[Means], Found], why: str = "") -> Trial:
    """A proposition that `find` decides; `why` is told where it does not hold."""

    def held(means: Means) -> Evidence:
        found = find(means)
        return ruled(bool(found.condition), found.ours, found.method, found.again, why)

    return held


def unclaimed(tried: Trial, why: str) -> Trial:
    """What a trial finds, without its verdict: the text does not claim what was tried, or not so; `why` says what is open."""
    return lambda means: replace(tried(means), verdict=Verdict(Kind.UNDECIDED, None), why=why)


def measured(find: Callable[[Means], Found], why: str) -> Trial:
    """What can be measured, where the text says nothing that could be judged by it; `why` says what is missing."""
    return unclaimed(trial(find), why)


def undecided(why: str, tried: str = "—") -> Trial:
    """A statement that the text leaves open; `why` says what is missing, `tried` which readings were tried."""
    return lambda means: Evidence(Verdict(Kind.UNDECIDED, None), "—", tried, "—", why)


def number(printed: str, recipe: Recipe, again: Recipe | None = None, *, exact: bool = False, why: str = "") -> Trial:
    """A printed number against its recomputation by quadrature, and once more by `again`, or by the same recipe with rqmc."""

    def held(means: Means) -> Evidence:
        claim = Printed(printed, exact=exact)
        unit = float(claim.resolution)
        ours = recipe(Means(min(FINEST, unit / 1000.0), "quadrature", means.seed, means.threads))
        second = (again or recipe)(Means(unit / 100.0, "rqmc", means.seed, means.threads))
        verdict = judge(claim, ours)
        told = [with_error(e, unit / 1000.0) for e in (ours, second)]
        return Evidence(verdict, told[0], ours.method, f"{told[1]} ({second.method})", "" if verdict.kind is Kind.AGREES else why)

    return held


def behaves(
    model: str,
    *behaviours: str,
    order: str = "wi",
    exponent: float | None = None,
    limit: float | None = None,
    why: str = "",
    **parameters: Any,
) -> Trial:
    """Whether the albedo at grazing incidence is one of "bounded", "vanishes", "diverges"; with that exponent or limit, if given.

    The second method is the exponent between two cosines by samples. `why` is told where the statement is refuted.
    """

    def held(means: Means) -> Evidence:
        subject = subject_of(model, **parameters)
        seen = law(subject, order)
        condition = seen.behaviour in behaviours
        if exponent is not None:
            condition = condition and seen.exponent.low <= exponent <= seen.exponent.high
        if limit is not None:
            condition = condition and abs(seen.limit - limit) <= seen.limit_error + FINEST * abs(limit)
        return ruled(condition, grazing_words(seen), "quadrature", _sampled_exponent(subject, order, means), why)

    return held


def checked(
    check: str, expected: str, model: str, *, again: Callable[[Means], str] | None = None, why: str = "", **parameters: Any
) -> Trial:
    """Whether a check of `albedo-lab check` ends as a statement has it: "PASS" or "FAIL".

    `again` tells what a second method finds; by default it is the witness that the check names, or what it says.
    """

    def held(means: Means) -> Evidence:
        found = verdict_of(check, model, means.seed, **parameters)
        if found.verdict is Judged.INCONCLUSIVE:
            return Evidence(Verdict(Kind.UNDECIDED, None), found.statement, f"check: {check}", "—", "the check is inconclusive")
        second = again(means) if again is not None else found.witness or "no witness against it"
        return ruled(found.verdict.value == expected, found.statement, f"check: {check}", second, why)

    return held


def same(
    left: Callable[..., NDArray[np.float64]],
    right: Callable[..., NDArray[np.float64]],
    *ranges: tuple[float, float],
    again: Callable[[Means], str],
    within: float = 1e-12,
    why: str = "",
) -> Trial:
    """Whether two formulas are the same function: largest relative difference over 10 000 points of the box of `ranges`."""

    def held(means: Means) -> Evidence:
        points = np.random.default_rng(means.seed).random((10_000, len(ranges)))
        low, high = np.array(ranges).T
        columns = (low + (high - low) * points).T
        most = apart(left(*columns), right(*columns))
        ours = f"largest relative difference {most:.2g} over 10 000 points"
        return ruled(most <= within, ours, "evaluation in double precision", again(means), why)

    return held


def extremum(
    f: Callable[[NDArray[np.float64]], NDArray[np.float64]], low: float, high: float, points: int = 100_001
) -> tuple[float, float]:
    """Where a function of one variable is largest between low and high, and how large; searched on a grid and refined twice."""
    for _ in range(3):
        x = np.linspace(low, high, points)
        at = int(np.argmax(f(x)))
        low, high = float(x[max(at - 1, 0)]), float(x[min(at + 1, points - 1)])
    best = 0.5 * (low + high)
    return best, float(np.max(f(np.array([low, best, high]))))


@lru_cache(maxsize=256)
def _subject(model: str, parameters: tuple[tuple[str, Any], ...]) -> Subject:
    member, p, scale = next(grid(model_of(model), dict(parameters)))
    return Subject(member, p, constant(member, p, scale))


def subject_of(model: str, **parameters: Any) -> Subject:
    """A model of the catalogue at its parameters, with its constant."""
    return _subject(model, tuple(sorted(parameters.items())))


@lru_cache(maxsize=256)
def _verdict(check: str, model: str, seed: int, parameters: tuple[tuple[str, Any], ...]) -> Finding:
    found = [finding for _, finding in run(model, dict(parameters), only=[check], seed=seed)]
    order = (Judged.FAIL, Judged.INCONCLUSIVE, Judged.PASS, Judged.REPORTED, Judged.SKIPPED)
    decides = min(found, key=lambda finding: order.index(finding.verdict))
    return replace(decides, statement=typeset(decides.statement), witness=typeset(decides.witness))


def verdict_of(check: str, model: str, seed: int = 0, **parameters: Any) -> Finding:
    """The finding of a check that decides: one that fails, else one that is inconclusive, else the first; in words for a page."""
    return _verdict(check, model, seed, tuple(sorted(parameters.items())))


def grazing_words(seen: GrazingLaw) -> str:
    """A law for a cell of a table: "diverges, a ~ μ^s, s = -0.500000 ± 0.000001"."""
    power = f"a ~ μ^s, s = {with_error(seen.exponent, 1e-6)}" if math.isfinite(seen.exponent.value) else ""
    if seen.behaviour == "bounded":
        limit = with_error(bounded(seen.limit, max(seen.limit_error, 1e-9), 0, "quadrature"), 1e-6)
        return f"bounded, a → {limit}; {power}"
    return f"{seen.behaviour}, {power}" if power else seen.behaviour


def _sampled_exponent(subject: Subject, order: str, means: Means) -> str:
    """The exponent between two cosines by samples, with half of its 95 % interval, and by quadrature.

    It is that of the approach to the limit, not of the limit, which samples cannot reach.
    """
    questions = [Question(subject.model, subject.p, mu, 0.0, order) for mu in (NEAR, NEARER)]
    within = Tolerance(1e-300, 1e-4)
    near, nearer = (rqmc(question, within, means.seed, means.threads or 1, 1 << 20) for question in questions)
    if not (near.value > 0.0 and nearer.value > 0.0 and math.isfinite(near.value + nearer.value)):
        return f"a({NEARER:g}) = {nearer.value * subject.scale.value:.4g} by samples"
    decades = math.log(NEAR / NEARER)
    s = math.log(near.value / nearer.value) / decades
    error = math.hypot(near.half_width / near.value, nearer.half_width / nearer.value) / decades
    before, after = (quadrature(question, within).value for question in questions)
    there = round(math.log(before / after) / decades, 4) + 0.0 if before > 0.0 and after > 0.0 else math.nan
    told = with_error(bounded(s, max(error, 1e-9), 0, "rqmc"), 1e-4)
    return f"between μ = {NEAR:g} and {NEARER:g}: s = {told} (rqmc), {there:.4f} (quadrature)"
