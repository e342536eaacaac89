"""The trial of models: every check on every member of a grid, and one verdict over all that was found."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import replace
from typing import Any, TypeVar

import numpy as np
import pandas as pd

from albedo_lab import catalogue
from albedo_lab.analysis.claims import claims
from albedo_lab.analysis.constant import constant
from albedo_lab.analysis.energy import energy
from albedo_lab.analysis.grazing import grazing_check
from albedo_lab.analysis.pointwise import finiteness, positivity, reciprocity
from albedo_lab.analysis.request import effort, grid, model_of
from albedo_lab.analysis.rows import Progress, parameter_columns, table, track
from albedo_lab.analysis.sampler import quality, sampler
from albedo_lab.analysis.verdict import Finding, Subject, Trial, Verdict, judged
from albedo_lab.errors import BadInput, Inconclusive
from albedo_lab.estimate.record import exact
from albedo_lab.model import Choice, File, Model

LEVEL = 0.01
T = TypeVar("T")
LARGEST_BUDGET = 1 << 48
Models = Model | str | Sequence[Model | str]
Told = list[tuple[Subject, Finding]]
Check = Callable[[Subject, Trial, Sequence[Finding]], list[Finding]]
CHECKS: dict[str, Check] = {
    "finiteness": lambda subject, trial, _: finiteness(subject, trial),
    "positivity": lambda subject, trial, _: positivity(subject, trial),
    "energy": lambda subject, trial, _: energy(subject, trial),
    "reciprocity": lambda subject, trial, _: reciprocity(subject, trial),
    "grazing": lambda subject, trial, _: grazing_check(subject, trial),
    "sampler": lambda subject, trial, _: sampler(subject, trial),
    "claims": claims,
    "quality": lambda subject, trial, _: quality(subject, trial),
}
"""In the order in which they are made; each is told what those before it found of the same subject."""


def check(
    model: Models,
    *,
    only: Sequence[str] = (),
    skip: Sequence[str] = (),
    level: float = LEVEL,
    budget: int | None = None,
    excess: float = 1e-5,
    seed: int = 0,
    threads: int | None = None,
    progress: Progress | None = None,
    **parameters: object,
) -> pd.DataFrame:
    """Whether a model is plausible: energy balance, reciprocity, positivity, its sampler, and what its source claims of it.

    Parameters
    ----------
    model
        A Model, a name of the catalogue, or several of either.
    only, skip
        Names of checks, of CHECKS; all of them by default.
    level
        The probability with which the whole run may accuse a sound model by chance (Holm's rule); `--alpha` on the command line.
    budget
        How many evaluations one check may cost; 2^24 by default.
    excess
        How far above 1 an albedo is forgiven.
    seed, threads
        The same seed gives the same bits, whatever the number of threads.
    progress
        Called with the number of checks done and the number of all, while they are made.
    parameters
        The model's parameters and `scale`; several values of several parameters make a grid, the first varying slowest.

    Returns
    -------
    DataFrame
        One row per finding: model, parameters, scale, check, verdict, figure, threshold, p_value, statement, witness, claim.

    Raises
    ------
    BadInput
        For a name, a value or an option outside its domain.

    Examples
    --------
    >>> check("lambert", only=["positivity"]).verdict.unique().tolist()
    ['PASS']
    """
    told = run(
        model,
        parameters,
        only=only,
        skip=skip,
        level=level,
        budget=budget,
        excess=excess,
        seed=seed,
        threads=threads,
        progress=progress,
    )
    return findings_table(told)


def run(
    model: Models,
    parameters: Mapping[str, object],
    *,
    only: Sequence[str] = (),
    skip: Sequence[str] = (),
    level: float = LEVEL,
    budget: int | None = None,
    excess: float = 1e-5,
    seed: int = 0,
    threads: int | None = None,
    progress: Progress | None = None,
) -> Told:
    """Every finding with its subject, as `check` tells them in its table. Raises BadInput."""
    names = selected(only, skip)
    number("level", level, 0.0, 1.0, "must be a probability above 0 and below 1")
    trial = _trial(budget, excess, seed, threads)
    cells = [cell for each in several(model) for cell in grid(model_of(each), parameters)]
    steps = track(range(len(cells) * len(names)), progress)
    told = [(subject, finding) for cell in cells for subject, finding in _tried(*cell, names, trial, steps)]
    next(steps, None)
    verdicts = judged([finding for _, finding in told], level)
    return [(subject, finding) for (subject, _), finding in zip(told, verdicts, strict=True)]


def findings_table(told: Told) -> pd.DataFrame:
    """What was found, a row per finding."""
    return table([(_head(subject), _body(finding)) for subject, finding in told])


def status(findings: Sequence[Finding]) -> int:
    """The exit status of a run: 1 where a check failed, else 3 where one is inconclusive, else 0."""
    verdicts = {finding.verdict for finding in findings}
    return 1 if Verdict.FAIL in verdicts else 3 if Verdict.INCONCLUSIVE in verdicts else 0


def everyone() -> list[str]:
    """The names of the catalogue, but for those models that are nothing without a file."""
    return [name for name in catalogue.names() if not any(isinstance(c, File) for c in catalogue.find(name).choices)]


def several(model: Models) -> list[Model | str]:
    """One model or several, as a list. Raises BadInput for none at all."""
    models = [model] if isinstance(model, Model | str) else list(model)
    if not models:
        raise BadInput("model", models, "must be at least one")
    return models


def selected(only: Sequence[str], skip: Sequence[str]) -> list[str]:
    """The names of the checks to make, in their order. Raises BadInput."""
    for option, names in (("only", only), ("skip", skip)):
        if isinstance(names, str):
            raise BadInput(option, names, "must be a list of names")
        for name in names:
            if name not in CHECKS:
                raise BadInput(option, name, f"must be one of {', '.join(CHECKS)}")
    left = [name for name in CHECKS if (not only or name in only) and name not in skip]
    if not left:
        raise BadInput("skip", ", ".join(skip), "leaves no check to be made")
    return left


def number(name: str, value: object, low: float, high: float, domain: str) -> float:
    """The value, when it is a number strictly between low and high. Raises BadInput."""
    if isinstance(value, bool) or not isinstance(value, int | float | np.number) or not low < value < high:
        raise BadInput(name, value, domain)
    return float(value)


def short(subject: Subject, given: Mapping[str, object]) -> str:
    """The subject's parameters in a few words: those that were given, and the choices that are swept."""
    model, columns = subject.model, subject.model.columns(subject.p)
    shown = set(given) | {choice.name for choice in model.choices if isinstance(choice, Choice) and choice.swept}
    shown |= {name for parameter in model.parameters if parameter.name in given for name in _expanded(parameter, columns)}
    columns["scale"] = subject.scale.value
    words = {name: value for name, value in columns.items() if name in shown and value == value}  # a shorthand may be NaN
    return " ".join(f"{name}={value:g}" if isinstance(value, float) else f"{name}={value}" for name, value in words.items())


def _expanded(parameter: Any, columns: Mapping[str, Any]) -> Sequence[str]:
    return parameter.sets if columns[parameter.name] != columns[parameter.name] else ()


def _trial(budget: int | None, excess: float, seed: int, threads: int | None) -> Trial:
    means = effort(None, "quadrature", seed, threads)
    evaluations = number(
        "budget",
        Trial().budget if budget is None else budget,
        0.0,
        LARGEST_BUDGET + 1,
        f"must be an integer in [1, {LARGEST_BUDGET}]",
    )
    if evaluations != int(evaluations):
        raise BadInput("budget", budget, f"must be an integer in [1, {LARGEST_BUDGET}]")
    forgiven = 0.0 if excess == 0 else number("excess", excess, 0.0, math.inf, "must be a finite number of at least 0")
    return Trial(means.seed, means.threads, forgiven, int(evaluations))


def _tried(member: Model, p: Any, given: float | None, names: Sequence[str], trial: Trial, steps: Iterator[int]) -> Told:
    """The findings of one subject; what is open in them is yet to be judged. Takes a step before every check."""
    found: list[Finding] = []
    subject, obstacle = _subject(member, p, given)
    for name in names:
        next(steps)
        found += [replace(obstacle, check=name)] if obstacle else _found(name, subject, trial, found)
    return [(subject, finding) for finding in found]


def _subject(member: Model, p: Any, given: float | None) -> tuple[Subject, Finding | None]:
    """The subject with its constant; where that cannot be found, also what every check then says."""
    try:
        return Subject(member, p, _quietly(lambda: constant(member, p, given))), None
    except BadInput:
        raise
    except Exception as error:
        unknown = Subject(member, p, exact(math.nan, "none"))
        return unknown, _undecided("", f"the constant of the model is unknown: {_told_by(error)}", error)


def _found(name: str, subject: Subject, trial: Trial, before: Sequence[Finding]) -> list[Finding]:
    """What a check says. Whatever goes wrong in it is its own finding: one sick model must not end a run over many."""
    try:
        return _quietly(lambda: CHECKS[name](subject, trial, before))
    except Exception as error:
        return [_undecided(name, _told_by(error), error)]


def _quietly(work: Callable[[], T]) -> T:
    """The work's result; a sick model's infinities are findings, not warnings."""
    with np.errstate(all="ignore"):
        return work()


def _undecided(name: str, statement: str, error: Exception) -> Finding:
    details = {} if isinstance(error, Inconclusive) else {"error": type(error).__name__}
    return Finding(name, Verdict.INCONCLUSIVE, math.nan, math.nan, statement, details=details)


def _told_by(error: Exception) -> str:
    """One line of what went wrong; an error that nobody foresaw says its kind."""
    text = " ".join(str(error).split())
    return text if isinstance(error, Inconclusive | BadInput) else f"{type(error).__name__}: {text}".removesuffix(": ")


def _head(subject: Subject) -> dict[str, Any]:
    columns = parameter_columns(subject.model, subject.p, "check")
    return {"model": subject.model.name} | columns | {"scale": subject.scale.value}


def _body(finding: Finding) -> dict[str, Any]:
    return {
        "check": finding.check,
        "verdict": finding.verdict.value,
        "figure": finding.figure,
        "threshold": finding.threshold,
        "p_value": math.nan if finding.p_value is None else finding.p_value,
        "statement": finding.statement,
        "witness": finding.witness,
        "claim": finding.claim,
    }
