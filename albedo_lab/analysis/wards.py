"""Ward's model and its descendants: what becomes of their albedo at grazing angles, and where it passes 1."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

from scipy.optimize import brentq

from albedo_lab.analysis.albedo import shape_estimate
from albedo_lab.analysis.constant import constant
from albedo_lab.analysis.grazing import GrazingLaw, law
from albedo_lab.analysis.request import effort
from albedo_lab.analysis.rows import degrees_of
from albedo_lab.analysis.supremum import supremum
from albedo_lab.analysis.verdict import Subject
from albedo_lab.catalogue import find
from albedo_lab.estimate.record import Estimate, Question

FAMILY = ("ward", "modified_ward", "ward_duer", "ward_bounded")
"""In the order of their years, 1992, 1999, 2006, 2010."""
WIDTHS = (0.1, 0.3, 1.0)
LAST = 1e-9
"""The cosine down to which a passage through 1 is looked for."""
PLACE = 1e-6
"""Relative error of the cosine at which it lies."""


@dataclass(frozen=True)
class Member:
    """One of the family at a width m: its law at grazing angles, its largest albedo and the angle of that, and where it passes 1.

    `above` is the angle in degrees beyond which the albedo is above 1 up to the cosine 1e-9, NaN where it never is.
    """

    name: str
    m: float
    grazing: GrazingLaw
    largest: Estimate
    at: float
    above: float


def members() -> Iterator[Member]:
    """Every model of the family at every width."""
    for name in FAMILY:
        for m in WIDTHS:
            model = find(name)
            p = model.bind({"m": m})
            subject = Subject(model, p, constant(model, p, None))
            peak = supremum(model, p)
            largest = peak.value.scaled(subject.scale)
            yield Member(name, m, law(subject), largest, degrees_of(peak.mu), _passage(subject))


def _passage(subject: Subject) -> float:
    """The angle at which the albedo, below 1 for steep light, passes 1; NaN where it is not above 1 at the last cosine."""
    want = effort(1e-9, "quadrature", 0, 1)

    def excess(log_mu: float) -> float:
        question = Question(subject.model, subject.p, math.exp(log_mu))
        return shape_estimate(question, subject.scale, want).scaled(subject.scale).value - 1.0

    if excess(math.log(LAST)) <= PLACE:  # what only tends to 1 does not pass it
        return math.nan
    return degrees_of(math.exp(brentq(excess, math.log(LAST), 0.0, rtol=PLACE)))
