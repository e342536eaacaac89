"""Models side by side: what their cards know of them at the defaults, and their albedo again where all are equally wide."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from albedo_lab.analysis.albedo import shape_estimate
from albedo_lab.analysis.card import TOLERANCE, Facts
from albedo_lab.analysis.constant import constant
from albedo_lab.analysis.request import Effort, effort, orders
from albedo_lab.analysis.rows import Progress, track
from albedo_lab.analysis.spread import Comparable, comparable, median_angle
from albedo_lab.analysis.supremum import supremum
from albedo_lab.analysis.verdict import Subject
from albedo_lab.estimate.record import Estimate, Question
from albedo_lab.optics.coordinates import Axis


@dataclass(frozen=True, slots=True)
class Level:
    """The albedo for one order of integration: its supremum, the cosine at which it lies (0 is the limit), and its mean."""

    order: str
    largest: Estimate
    mu: float
    mean: Estimate


@dataclass(frozen=True)
class Standing:
    """A model in the league: its facts at the defaults, its median angle there in degrees, and itself as wide as the others.

    `wide` is None, and `levels` are empty, for a model that cannot be made so.
    """

    facts: Facts
    median: Estimate
    wide: Comparable | None = None
    levels: tuple[Level, ...] = ()

    @property
    def name(self) -> str:
        """The model's name in the catalogue."""
        return self.facts.name

    @property
    def axis(self) -> Axis:
        """What the model's lobe turns about, by the coordinates that it declares; of several parts the first that has a lobe."""
        model, p = self.facts.subject.model, self.facts.subject.p
        if model.sample is None and self.facts.mirror:
            return Axis.MIRROR
        several = [part for part, _ in model.parts(p)] if model.parts else [model]
        return next((part.smooth_in.axis for part in several if part.smooth_in.axis is not Axis.NORMAL), Axis.NORMAL)

    @property
    def defaults(self) -> tuple[Level, ...]:
        """What the facts say of the albedo, one for each order."""
        return tuple(Level(a.order, a.largest, a.mu, a.mean) for a in self.facts.albedos)


def standings(
    known: Sequence[Facts], *, seed: int = 0, threads: int | None = None, progress: Progress | None = None
) -> list[Standing]:
    """Where each model stands, in the order of the facts, which are those of the cards and are not computed again.

    Everything is by quadrature: the same bits whatever the threads. `progress` is called with the number of models done and of
    all.
    """
    want = effort(TOLERANCE, "quadrature", seed, threads)
    with np.errstate(all="ignore"):  # a sick model's infinities are findings
        return [_standing(facts, want) for facts in track(known, progress)]


def _standing(facts: Facts, want: Effort) -> Standing:
    """One model."""
    model = facts.subject.model
    median, wide = median_angle(model, facts.subject.p), comparable(model)
    if wide is None:
        return Standing(facts, median)
    there = Subject(model, wide.p, constant(model, wide.p, None))
    return Standing(facts, median, wide, tuple(_level(there, order, want) for order in orders(model)))


def _level(subject: Subject, order: str, want: Effort) -> Level:
    """The albedo in one order."""
    peak = supremum(subject.model, subject.p, order)
    mean = shape_estimate(Question(subject.model, subject.p, None, order=order), subject.scale, want)
    return Level(order, peak.value.scaled(subject.scale), peak.mu, mean.scaled(subject.scale))
