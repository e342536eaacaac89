"""What the authors say of their model, each claim found or refuted."""

from __future__ import annotations

import ast
import inspect
import itertools
import math
import operator
import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import replace
from typing import Any

from albedo_lab.analysis.constant import constant
from albedo_lab.analysis.energy import energy
from albedo_lab.analysis.grazing import law
from albedo_lab.analysis.pointwise import reciprocity
from albedo_lab.analysis.request import orders
from albedo_lab.analysis.verdict import Finding, Subject, Trial, Verdict
from albedo_lab.errors import BadInput
from albedo_lab.model import Claim, DivergesAtGrazing, EnergyConserving, GrazingAlbedo, Reciprocal

ROUNDING = 2.0**-50
COMPARISONS: Mapping[type[ast.cmpop], Callable[[Any, Any], bool]] = {
    ast.Lt: operator.lt,
    ast.LtE: operator.le,
    ast.Gt: operator.gt,
    ast.GtE: operator.ge,
    ast.Eq: operator.eq,
    ast.NotEq: operator.ne,
}
ARITHMETIC: Mapping[type[ast.operator], Callable[[float, float], float]] = {
    ast.Add: operator.add,
    ast.Sub: operator.sub,
    ast.Mult: operator.mul,
    ast.Div: operator.truediv,
}


def claims(subject: Subject, trial: Trial, findings: Sequence[Finding]) -> list[Finding]:
    """Every claim of the model's record, judged: PASS when it is found true, FAIL when it is refuted.

    A claim that is not about these parameters is SKIPPED; one that is left open, or is refuted where it may not be meant, is
    INCONCLUSIVE. What other checks have found is not searched for again.
    """
    return [_judged(claim, subject, trial, findings) for claim in subject.model.claims]


def _judged(claim: Claim, subject: Subject, trial: Trial, findings: Sequence[Finding]) -> Finding:
    """The finding about one claim."""
    words = f"{claim.place}: {f'where {claim.where}: ' if claim.where else ''}{inspect.getdoc(claim)}"
    meant = holds(claim.where, subject) if claim.where else True
    if meant is False:
        told = f"says nothing of these parameters, only where {claim.where}"
        return Finding("claims", Verdict.SKIPPED, math.nan, math.nan, told, claim=words)
    answer = _answer(claim, subject, trial, findings)
    if answer.verdict is Verdict.FAIL and meant is None:
        told = f"refuted, if these parameters are among those where {claim.where}, which could not be decided: {answer.statement}"
        return replace(answer, check="claims", verdict=Verdict.INCONCLUSIVE, statement=told, claim=words)
    said = {Verdict.PASS: "found", Verdict.FAIL: "refuted"}.get(answer.verdict, "left open")
    return replace(answer, check="claims", statement=f"{said}: {answer.statement}", claim=words, p_value=None)


def _answer(claim: Claim, subject: Subject, trial: Trial, findings: Sequence[Finding]) -> Finding:
    """What is found of that which a claim says."""
    if isinstance(claim, Reciprocal):
        known = [f for f in findings if f.check == "reciprocity"] or reciprocity(subject, trial)
        return _worst(known)
    by_default = _by_default(subject)
    if by_default is None:
        return _open("the default constant is unknown: the model reflects nothing")
    if isinstance(claim, EnergyConserving):
        same = by_default.scale == subject.scale
        return _worst([f for f in findings if f.check == "energy" and same] or energy(by_default, trial))
    if isinstance(claim, DivergesAtGrazing):
        return _diverges(by_default, trial)
    if isinstance(claim, GrazingAlbedo):
        return _tends(claim, by_default, trial)
    return _open("no check knows how to try this claim")


def _by_default(subject: Subject) -> Subject | None:
    """The subject with the constant that its source prescribes, which is what claims are about."""
    try:
        return replace(subject, scale=constant(subject.model, subject.p, None))
    except BadInput:
        return None


def _worst(findings: Sequence[Finding]) -> Finding:
    """The finding that decides: one that fails, else one that is open, else the first."""
    for verdict in (Verdict.FAIL, Verdict.INCONCLUSIVE, Verdict.OPEN, Verdict.SKIPPED):
        for finding in findings:
            if finding.verdict is verdict:
                return finding if verdict is Verdict.FAIL else replace(finding, verdict=Verdict.INCONCLUSIVE)
    return findings[0] if findings else _open("nothing was found")


def _diverges(subject: Subject, trial: Trial) -> Finding:
    """Whether the albedo grows without bound, integrated in some order."""
    for order in orders(subject.model):
        seen = law(subject, order, budget=trial.budget)
        if seen.behaviour == "diverges":
            return Finding("claims", Verdict.PASS, seen.exponent.value, 0.0, str(seen))
    verdict = Verdict.FAIL if seen.behaviour in ("bounded", "vanishes") else Verdict.INCONCLUSIVE
    return Finding("claims", verdict, seen.exponent.value, 0.0, str(seen), witness=str(seen) if verdict is Verdict.FAIL else "")


def _tends(claim: GrazingAlbedo, subject: Subject, trial: Trial) -> Finding:
    """Whether the albedo tends to the value that is claimed, in every order."""
    value = float(claim.value(subject.p))
    for order in orders(subject.model):
        seen = law(subject, order, budget=trial.budget)
        known = seen.behaviour in ("bounded", "vanishes", "diverges") or math.isfinite(seen.limit)
        if not known or math.isnan(value):
            return _open(str(seen))
        off = abs(seen.limit - value)
        allowed = seen.limit_error + ROUNDING * abs(value)
        if not off <= allowed:
            told = f"{seen}, where {value:.9g} is claimed"
            return Finding("claims", Verdict.FAIL, off, allowed, told, witness=told)
    return Finding("claims", Verdict.PASS, off, allowed, f"{seen}, and {value:.9g} is claimed")


def _open(told: str) -> Finding:
    """A finding that decides nothing."""
    return Finding("claims", Verdict.INCONCLUSIVE, math.nan, math.nan, told)


def holds(where: str, subject: Subject) -> bool | None:
    """Whether a subject is among those of a condition, such as "n >= 1" or "a_s + a_d <= 1"; None where it cannot be decided.

    A name stands for the parameter, or, as m does for m_x and m_y, for every one that begins so: it must hold for each of them.
    """
    try:
        tree = ast.parse(re.sub("(?<![<>!=])=(?!=)", "==", where), mode="eval")
        verdicts = [_truth(tree.body, values) for values in _readings(tree, subject)]
    except (SyntaxError, KeyError, ArithmeticError, TypeError, ValueError):
        return None
    return all(verdicts)


def _readings(tree: ast.AST, subject: Subject) -> Iterator[dict[str, Any]]:
    """Every assignment of values to the names of a condition."""
    known = {name: value for name, value in subject.p._asdict().items() if isinstance(value, int | float)}
    known |= dict(subject.model.chosen)
    names = sorted({node.id for node in ast.walk(tree) if isinstance(node, ast.Name)})
    several = [[known[name]] if name in known else [v for k, v in known.items() if k.startswith(f"{name}_")] for name in names]
    if not all(several):
        raise KeyError(f"no such parameter among {names}")
    for values in itertools.product(*several):
        yield dict(zip(names, values, strict=True))


def _truth(node: ast.AST, values: Mapping[str, Any]) -> bool:
    """Whether a comparison, or several joined by and, or, not, is true. Raises ValueError for anything else."""
    if isinstance(node, ast.BoolOp):
        told = [_truth(part, values) for part in node.values]
        return all(told) if isinstance(node.op, ast.And) else any(told)
    if isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.Not):
        return not _truth(node.operand, values)
    if not isinstance(node, ast.Compare) or not all(type(op) in COMPARISONS for op in node.ops):
        raise ValueError("not a comparison")
    terms = [_number(term, values) for term in (node.left, *node.comparators)]
    return all(COMPARISONS[type(op)](a, b) for op, (a, b) in zip(node.ops, itertools.pairwise(terms), strict=True))


def _number(node: ast.AST, values: Mapping[str, Any]) -> Any:
    """The value of a sum, a product, a name, a number or a word. Raises ValueError for anything else."""
    if isinstance(node, ast.Constant):
        return node.value
    if isinstance(node, ast.Name):
        return values[node.id]
    if isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.USub):
        return -_number(node.operand, values)
    if isinstance(node, ast.BinOp) and type(node.op) in ARITHMETIC:
        return ARITHMETIC[type(node.op)](_number(node.left, values), _number(node.right, values))
    raise ValueError("not arithmetic")
