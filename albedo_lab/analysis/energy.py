"""Whether a model creates energy: is its albedo, from any direction of incidence, above 1?

An interval decides. Quadrature searches for the supremum, at first no more precisely than most models need, then as precisely
as f and the budget allow. A model is acquitted by the upper bound of its supremum, and convicted by one direction whose albedo,
integrated there, is above 1 for certain. Quadrature trusts what a model says of its own shape, and a sick one may be wrong about
that too; so nobody is convicted before a sampler has seen as much, and a sampler that sees more than quadrature overrules it.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import lru_cache
from typing import Any

import numpy as np

from albedo_lab.analysis.request import orders
from albedo_lab.analysis.rows import degrees_of
from albedo_lab.analysis.supremum import WALK, Supremum, supremum
from albedo_lab.analysis.trust import LEVELS, limited, reachable, trusted
from albedo_lab.analysis.verdict import Finding, Subject, Trial, Verdict
from albedo_lab.estimate.quadrature import quadrature
from albedo_lab.estimate.record import Estimate, Question, Tolerance
from albedo_lab.estimate.sampling import rqmc
from albedo_lab.model import Model
from albedo_lab.optics.coordinates import PLAIN

FIRST_LOOK = 1e-7
DIRECTIONS = (1.0, 0.5, 1e-2)
"""Cosines at which samples are asked where quadrature cannot be."""
CLEARLY = 1.05
"""A divergent albedo is shown where it is above 1 by so much, so that nobody has to count digits."""
SMALLEST_MU = 1e-20
MOST_SAMPLES = 1 << 22
FEW_SAMPLES = 1 << 17
SIGMAS = 4.0
"""Standard errors within which two methods agree."""


@dataclass(frozen=True, slots=True)
class Witness:
    """A direction of incidence, (mu, phi), and the albedo there, the constant in it."""

    mu: float
    phi: float
    albedo: Estimate

    def __str__(self) -> str:
        a = self.albedo
        turn = f", phi = {math.degrees(self.phi):.6g} deg" if self.phi else ""
        if not math.isfinite(a.value):
            return f"a = {a.value} at {_where(self.mu)}{turn}"
        return f"a = {a.value:.9g} +- {a.half_width:.1g} at {_where(self.mu)}{turn} by {a.method}"


def energy(subject: Subject, trial: Trial) -> list[Finding]:
    """Whether the supremum of the albedo, Dirac part and constant included, is at most 1 + excess: a finding per order.

    PASS when its upper bound is, FAIL with a witness when some direction's lower bound is not or when the albedo is NaN or
    infinite somewhere, INCONCLUSIVE where the budget decides neither.
    """
    with np.errstate(all="ignore"):
        return [_tried(subject, trial, order) for order in orders(subject.model)]


def _tried(subject: Subject, trial: Trial, order: str) -> Finding:
    """The finding for one order of integration."""
    if subject.scale.value == 0.0:
        return _finding(Verdict.PASS, 0.0, trial, order, "the constant is 0: nothing is reflected")
    subject = replace(subject, model=trusted(subject.model, subject.p))
    found = _by_quadrature(subject, trial, order)
    if found.verdict is Verdict.PASS and _seen_more(subject, trial, order):
        plain = replace(subject, model=_plain(subject.model))
        again = _by_quadrature(plain, trial, order)
        # once quadrature has missed something, plain coordinates may miss it as well: they can convict, but not acquit
        if again.verdict is not Verdict.PASS:
            return again
        told = f"samples see light that quadrature in the model's own coordinates misses; in plain ones {again.statement}"
        return replace(again, verdict=Verdict.INCONCLUSIVE, statement=told)
    return found


def _by_quadrature(subject: Subject, trial: Trial, order: str) -> Finding:
    """The finding that the model's own coordinates lead to."""
    most = 1.0 + trial.excess
    finest = reachable(subject.model, subject.p, order, trial.budget)
    if finest is None:
        return _by_chance(subject, trial, order)
    peak, high = None, math.inf
    for relative in dict.fromkeys((max(FIRST_LOOK, finest), finest)):
        peak = _search(limited(subject.model, relative), subject.p, order)
        if peak is None or not math.isfinite(peak.value.value):
            return _unbounded(subject, trial, order, peak, finest)
        scaled = peak.value.scaled(subject.scale)
        high = scaled.high
        where = Witness(peak.mu, peak.phi, scaled)
        if high < most:
            return _finding(Verdict.PASS, scaled.value, trial, order, f"the albedo is at most {scaled.value:.9g}", where)
        seen = _albedo(subject, order, peak.mu or 1e-12, peak.phi, finest)
        if seen.albedo.low > most:
            return _convicted(subject, trial, order, seen)
    # a peak whose place cannot be told, a jump, may still have an albedo above 1 beside it
    for t in WALK:
        seen = _albedo(subject, order, 1.0 / math.cosh(t), peak.phi if peak else 0.0, finest)
        if seen.albedo.low > most:
            return _convicted(subject, trial, order, seen)
    told = f"the albedo is at most {where.albedo.value:.9g} in [{where.albedo.low:.9g}, {high:.9g}], which decides nothing"
    return _finding(Verdict.INCONCLUSIVE, where.albedo.value, trial, order, told, where)


def _search(model: Model, p: Any, order: str) -> Supremum | None:
    """The supremum; None where infinite albedos leave nothing to interpolate."""
    try:
        return supremum(model, p, order)
    except (np.linalg.LinAlgError, ValueError, ArithmeticError):
        return None


def _unbounded(subject: Subject, trial: Trial, order: str, peak: Supremum | None, finest: float) -> Finding:
    """The finding of an albedo that is infinite or NaN somewhere, or grows without bound."""
    most = 1.0 + trial.excess
    worst: Witness | None = None
    for mu, phi in _directions(subject, peak.phi if peak else 0.0):
        seen = _albedo(subject, order, mu, phi, max(finest, 1e-8))
        if not math.isfinite(seen.albedo.value):
            told = f"the albedo is {seen.albedo.value}"
            return _finding(Verdict.FAIL, seen.albedo.value, trial, order, told, seen, convicts=True)
        if seen.albedo.low > most and (worst is None or worst.albedo.value < CLEARLY):
            worst = seen
    if peak is None or peak.behaviour != "diverges":
        if worst is not None:
            return _convicted(subject, trial, order, worst)
        return _finding(Verdict.INCONCLUSIVE, math.nan, trial, order, "the search met albedos that are not finite, and lost them")
    if worst is not None:
        return _convicted(subject, trial, order, worst, "the albedo grows without bound towards grazing incidence")
    told = "the albedo grows without bound towards grazing incidence, but exceeds 1 at no angle that is a number"
    return _finding(Verdict.FAIL, math.inf, trial, order, told, seen, convicts=True)


def _directions(subject: Subject, phi: float) -> Iterator[tuple[float, float]]:
    """Directions of incidence from the normal to the last that counts, at a few azimuths where these matter."""
    turns = [phi] if subject.model.isotropic(subject.p) else [phi, *(math.pi * turn for turn in (0.0, 0.25, 0.5, 1.0, 1.5))]
    for t in (*WALK, *np.arange(28.0, -math.log(0.5 * SMALLEST_MU))):
        for turn in turns:
            yield 1.0 / math.cosh(t), turn


def _convicted(subject: Subject, trial: Trial, order: str, seen: Witness, told: str = "") -> Finding:
    """FAIL, if a sampler at the witness' direction agrees; INCONCLUSIVE where it contradicts."""
    most = 1.0 + trial.excess
    told = told or f"the albedo reaches {seen.albedo.value:.9g}"
    heard: list[Witness] = []
    for other in _samplers(subject.model):
        width = max(0.5 * (seen.albedo.value - most), 1e-7)
        budget = min(trial.budget, MOST_SAMPLES)
        question = Question(other, subject.p, seen.mu, seen.phi, order)
        within = Tolerance(width / abs(subject.scale.value))
        heard.append(Witness(seen.mu, seen.phi, rqmc(question, within, trial.seed, trial.threads, budget).scaled(subject.scale)))
        low, high = _widened(heard[-1].albedo)
        if low > most or (low <= seen.albedo.high and high >= seen.albedo.low):
            break
    else:
        told = f"quadrature says that {told}, but samples do not: {'; '.join(map(str, heard))}"
        return _finding(Verdict.INCONCLUSIVE, seen.albedo.value, trial, order, told, seen)
    found = _finding(Verdict.FAIL, seen.albedo.value, trial, order, told, seen, convicts=True)
    second = heard[-1].albedo
    return replace(
        found,
        witness=f"{found.witness}; {second.value:.6g} +- {second.half_width:.2g} by samples",
        details=found.details | {"samples_low": second.low, "samples_high": second.high},
    )


def _by_chance(subject: Subject, trial: Trial, order: str) -> Finding:
    """The finding where quadrature is beyond the budget: samples may convict, but not acquit."""
    most = 1.0 + trial.excess
    budget = min(trial.budget, FEW_SAMPLES)
    for mu in DIRECTIONS:
        question = Question(_by_cosine(subject.model), subject.p, mu, 0.0, order)
        seen = Witness(mu, 0.0, rqmc(question, Tolerance(1e-4), trial.seed, trial.threads, budget).scaled(subject.scale))
        if _widened(seen.albedo)[0] > most:
            told = f"the albedo reaches {seen.albedo.value:.6g}; quadrature is beyond the budget"
            return _finding(Verdict.FAIL, seen.albedo.value, trial, order, told, seen, convicts=True)
    told = "quadrature does not settle within the budget, and samples cannot acquit"
    return _finding(Verdict.INCONCLUSIVE, math.nan, trial, order, told)


def _seen_more(subject: Subject, trial: Trial, order: str) -> bool:
    """Whether samples that know nothing of the model see more light than quadrature does, where it acquits."""
    for mu in (0.9, 0.3):
        question = Question(_by_cosine(subject.model), subject.p, mu, 0.4, order)
        sampled = rqmc(question, Tolerance(1e-3), trial.seed, trial.threads, min(trial.budget, FEW_SAMPLES))
        integral = quadrature(replace(question, model=subject.model), Tolerance(0.0, LEVELS[0]))
        if _widened(sampled)[0] > integral.high:
            return True
    return False


def _samplers(model: Model) -> Iterator[Model]:
    """The model's own sampler, and one that knows nothing of it."""
    if model.sample is not None and model.pdf is not None:
        yield model
    yield _by_cosine(model)


@lru_cache(maxsize=256)
def _by_cosine(model: Model) -> Model:
    """The model without a sampler of its own: samples then follow the cosine."""
    return replace(model, sample=None, pdf=None, weight=None)


@lru_cache(maxsize=256)
def _plain(model: Model) -> Model:
    """The model as one of which nothing is known."""
    return replace(model, smooth_in=PLAIN, parts=None, isotropic=lambda p: False)


def _albedo(subject: Subject, order: str, mu: float, phi: float, relative: float) -> Witness:
    """The albedo from one direction, the constant in it."""
    e = quadrature(Question(subject.model, subject.p, mu, phi, order), Tolerance(0.0, relative))
    return Witness(mu, phi, e.scaled(subject.scale))


def _widened(e: Estimate) -> tuple[float, float]:
    """The interval in which a sampled figure lies for all that matters: wider than 95 %."""
    return e.value - SIGMAS * e.standard_error - e.half_width, e.value + SIGMAS * e.standard_error + e.half_width


def _where(mu: float) -> str:
    """A direction of incidence by its angle; near grazing, where the angle has no digits left, by its cosine."""
    return f"theta = {degrees_of(mu):.6g} deg" if mu > 1e-3 else f"mu = {mu:.6g}"


def _finding(
    verdict: Verdict, figure: float, trial: Trial, order: str, told: str, where: Witness | None = None, convicts: bool = False
) -> Finding:
    """The finding of this check: its figure is the largest albedo found, held against 1 + excess."""
    details: dict[str, Any] = {"order": order}
    if where is not None:
        details |= {"mu": where.mu, "phi": where.phi, "ci95_low": where.albedo.low, "ci95_high": where.albedo.high}
        told += "" if convicts or "at " + _where(where.mu) in told else f", at {_where(where.mu)}"
    told += f" (integrated over {order})" if order == "wo" else ""
    witness = str(where) if convicts and where is not None else ""
    return Finding("energy", verdict, figure, 1.0 + trial.excess, told, witness=witness, details=details)
