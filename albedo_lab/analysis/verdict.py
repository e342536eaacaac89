"""What a check says of a model: a figure, what it was held against, and a witness where it convicts.

A check that samples states the probability that a sound model looks as bad by chance. Such findings are judged together, by
Holm's rule, so that a whole run accuses a sound model with no more than the probability asked for, however many tests it makes.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from enum import StrEnum
from typing import Any

from albedo_lab.estimate.record import Estimate
from albedo_lab.model import Model


class Verdict(StrEnum):
    """How a check ends."""

    PASS = "PASS"
    FAIL = "FAIL"
    INCONCLUSIVE = "INCONCLUSIVE"
    SKIPPED = "SKIPPED"
    REPORTED = "REPORTED"
    """A figure that is told and not judged."""
    OPEN = "OPEN"
    """To be judged by its probability, with all others of the run."""


@dataclass(frozen=True, slots=True)
class Subject:
    """The model on trial, with its parameters and the constant that it carries."""

    model: Model
    p: Any
    scale: Estimate


@dataclass(frozen=True, slots=True)
class Trial:
    """By which means a subject is tried.

    `excess` of the albedo above 1 is forgiven; `budget` is the number of evaluations that one check may cost.
    """

    seed: int = 0
    threads: int = 1
    excess: float = 1e-5
    budget: int = 1 << 24


@dataclass(frozen=True, slots=True)
class Finding:
    """One check's answer: `figure` is its statistic, `threshold` what it must not exceed, both NaN where they do not apply.

    `claim` is what the source says, where it says anything; `witness` are the directions and values that convict.
    """

    check: str
    verdict: Verdict
    figure: float
    threshold: float
    statement: str
    witness: str = ""
    claim: str = ""
    p_value: float | None = None
    details: dict[str, Any] = field(default_factory=dict)


def judged(findings: Sequence[Finding], alpha: float) -> list[Finding]:
    """The findings with every open one judged by Holm's rule at the level alpha over all of them.

    The smallest of n probabilities is held against alpha / n, the next against alpha / (n - 1), and so on up to the first that is
    large enough: that one and all after it pass.
    """
    order = sorted((i for i, f in enumerate(findings) if f.verdict is Verdict.OPEN), key=lambda i: findings[i].p_value or 0.0)
    told = list(findings)
    convicting = True
    for rank, i in enumerate(order):
        level = alpha / (len(order) - rank)
        convicting = convicting and not (findings[i].p_value or 0.0) > level
        told[i] = replace(findings[i], verdict=Verdict.FAIL if convicting else Verdict.PASS)
        if not convicting:
            told[i] = replace(told[i], witness="")
    return told
