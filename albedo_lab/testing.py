"""Assertions for the tests of a renderer: a model is plausible, or the test says where it is not, and how to see it again.

Importing this module imports neither numba nor pandas; the first assertion does.
"""

from __future__ import annotations

import shlex
from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from albedo_lab.analysis.verdict import Finding
    from albedo_lab.model import Model

OPTIONS: dict[str, Any] = {"seed": 0, "level": 0.01, "excess": 1e-5, "budget": None, "threads": None}
"""The keywords that every assertion takes beside the model's parameters, with their defaults."""
FLAGS = {"level": "alpha"}
"""What the command line calls an option by another name: there `-p` tells the level from the roughness alpha."""

# `__tracebackhide__` makes pytest show the line of the test, not of these functions.


def assert_energy_conserving(model: Model | str, **parameters: object) -> None:
    """Asserts that the albedo is nowhere above 1.

    This and every other assertion take a Model, the name or the place of one, its parameters and `scale`, several values of
    which make a grid; `seed`, `level`, `excess`, `budget` and `threads` as `albedo_lab.check` does. They raise AssertionError
    with the finding, its witness and a line that reproduces it, also where the check stays inconclusive, and BadInput for a
    value outside its domain.
    """
    __tracebackhide__ = True
    _demand("assert_energy_conserving", "energy", model, parameters)


def assert_reciprocal(model: Model | str, **parameters: object) -> None:
    """Asserts that f(wi, wo) = f(wo, wi). Options and errors are those of `assert_energy_conserving`."""
    __tracebackhide__ = True
    _demand("assert_reciprocal", "reciprocity", model, parameters)


def assert_positive(model: Model | str, **parameters: object) -> None:
    """Asserts that f is nowhere negative. Options and errors are those of `assert_energy_conserving`."""
    __tracebackhide__ = True
    _demand("assert_positive", "positivity", model, parameters)


def assert_finite(model: Model | str, **parameters: object) -> None:
    """Asserts that f is nowhere NaN or infinite. Options and errors are those of `assert_energy_conserving`."""
    __tracebackhide__ = True
    _demand("assert_finite", "finiteness", model, parameters)


def assert_sampler(model: Model | str, **parameters: object) -> None:
    """Asserts that the sampler samples what its density says. Options and errors are those of `assert_energy_conserving`.

    A model without a sampler has nothing to show: the assertion fails.
    """
    __tracebackhide__ = True
    _demand("assert_sampler", "sampler", model, parameters, unless_tried="there is no sampler to be tried")


def assert_bounded_at_grazing(model: Model | str, **parameters: object) -> None:
    """Asserts that the albedo stays bounded as mu -> 0. Options and errors are those of `assert_energy_conserving`."""
    __tracebackhide__ = True
    _demand("assert_bounded_at_grazing", "grazing", model, parameters, convicts=_unbounded)


def _fails(finding: Finding) -> bool:
    return finding.verdict in ("FAIL", "INCONCLUSIVE")


def _unbounded(finding: Finding) -> bool:
    """The grazing check tells what it finds and judges nothing; what it cannot decide is not shown to be bounded."""
    return finding.details.get("behaviour") not in ("bounded", "vanishes")


def _demand(
    assertion: str,
    check: str,
    model: Model | str,
    given: Mapping[str, Any],
    convicts: Callable[[Finding], bool] = _fails,
    unless_tried: str = "",
) -> None:
    """Makes one check of a model, and raises AssertionError for what it finds against it."""
    __tracebackhide__ = True
    from albedo_lab.analysis.check import run, short

    options = {name: given.get(name, default) for name, default in OPTIONS.items()}
    parameters = {name: _plain(value) for name, value in given.items() if name not in OPTIONS}
    told = run(model, parameters, only=[check], **options)
    bad = [
        (subject, finding) for subject, finding in told if convicts(finding) or (unless_tried and finding.verdict == "SKIPPED")
    ]
    if not bad:
        return
    lines = []
    for subject, finding in bad:
        where = f"{subject.model.name} {short(subject, parameters)}".strip()
        lines.append(f"{where}: {finding.check} {finding.verdict}: {finding.statement}")
        lines += [f"  {name}: {text}" for name, text in (("claimed", finding.claim), ("witness", finding.witness)) if text]
    raise AssertionError("\n".join([*lines, "to reproduce:", *_reproducing(assertion, check, model, parameters, options)]))


def _reproducing(
    assertion: str, check: str, model: Model | str, parameters: Mapping[str, Any], options: Mapping[str, Any]
) -> list[str]:
    """The same as a line of Python and, for a model that has a name, as a line for the shell."""
    chosen = {name: value for name, value in options.items() if value != OPTIONS[name] and name != "threads"}
    name = repr(model) if isinstance(model, str) else "model"
    arguments = ", ".join([name, *(f"{key}={value!r}" for key, value in (dict(parameters) | chosen).items())])
    lines = [f"  from albedo_lab.testing import {assertion}; {assertion}({arguments})"]
    spec = model if isinstance(model, str) else _known_as(model)
    if spec is None:
        return [f"{lines[0]}  # with the Model of the test"]
    words = ["albedo-lab", "check", spec]
    for key, value in parameters.items():
        words += ["-p", f"{key}={_listed(value)}"]
    words += ["--only", check]
    for key, value in chosen.items():
        words += [f"--{FLAGS.get(key, key)}", str(value)]
    return [*lines, f"  {shlex.join(words)}"]


def _known_as(model: Model) -> str | None:
    """The name under which the catalogue holds that very model."""
    from albedo_lab import catalogue

    return model.name if model.name in catalogue.names() and catalogue.find(model.name) is model else None


def _plain(value: Any) -> Any:
    """A value, or a list of values, that is written as it reads: numpy's scalars and arrays are not."""
    if hasattr(value, "tolist"):
        return value.tolist()
    return value if isinstance(value, str) or not hasattr(value, "__iter__") else list(map(_plain, value))


def _listed(value: Any) -> str:
    """A parameter's value or values as the command line reads them."""
    return ",".join(map(str, value)) if isinstance(value, list) else str(value)
