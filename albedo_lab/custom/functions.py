"""A plain function as a model: its parameters read off its signature, the rest of the record found out or left plain."""

from __future__ import annotations

import dis
import inspect
import math
import types
import typing
from collections import namedtuple
from collections.abc import Callable
from dataclasses import dataclass, fields
from functools import lru_cache
from typing import Any

from albedo_lab.custom.modules import Loaded
from albedo_lab.custom.pairs import is_number, symmetric
from albedo_lab.errors import BadInput
from albedo_lab.model import Model, Parameter, Reference
from albedo_lab.optics.coordinates import PLAIN

FORMS = "it must be f(wi, wo), f(wi, wo, alpha=0.3, ...), or f(p: P, wi, wo) with a NamedTuple class P"
LARGEST = 1e300
OPTIONS = {"model", "scale", "mu", "theta", "theta_deg", "phi", "phi_deg", "tolerance", "method", "seed", "threads", "progress"}
COLUMNS = {"samples", "order", "non_finite", "standard_error", "ci95_low", "ci95_high"}
RESERVED = OPTIONS | COLUMNS | {"only", "skip", "level", "budget", "excess"}
"""What the analyses call their own options and columns."""
ARGUMENTS = {"evaluate": "p, wi, wo", "sample": "p, wo, u1, u2", "pdf": "p, wi, wo", "weight": "p, wo, u1, u2", "mirror": "p, mu"}


HOME = "albedo_lab"
"""Where functions say they come from once they are settled: a module that every process has."""


@dataclass(frozen=True, eq=False)
class OwnModel(Model):
    """A model whose summary is kept, because its functions do not tell their module."""

    about: str = ""

    @property
    def summary(self) -> str:
        """The first line of the module that was asked for."""
        return self.about


def function_model(function: Callable[..., Any], loaded: Loaded, called: str) -> Model:
    """The model whose f_r is that function: constant 1, no sampler, plain coordinates; isotropic where turning it tells no other.

    Raises BadInput for a signature of another form, and for parameters without a number as default.
    """
    signature = inspect.signature(function)
    given = list(signature.parameters.values())
    required = [parameter for parameter in given if parameter.default is parameter.empty]
    ordinary = all(parameter.kind is parameter.POSITIONAL_OR_KEYWORD for parameter in given)
    parameters_type: Any
    annotated = _fields(function, given[0].name) if len(required) == 3 == len(given) else None
    if ordinary and annotated is not None:
        parameters_type = annotated
        values = {name: annotated._field_defaults.get(name) for name in annotated._fields}
        body = "function(p, wi, wo)"
    elif ordinary and len(required) == 2:
        values = {parameter.name: parameter.default for parameter in given[2:]}
        parameters_type = _named_tuple(list(values))
        body = f"function({', '.join(['wi', 'wo', *(f'p.{name}' for name in values)])})"
    else:
        raise BadInput("model", called, f"{loaded.place} takes {signature}; {FORMS}")
    parameters = tuple(_parameter(name, value, loaded, called) for name, value in values.items())
    evaluate = _wrapped("evaluate", body, function, loaded, {})
    return OwnModel(
        called,
        f"{loaded.source.name}(wi, wo)",
        parameters_type,
        parameters,
        evaluate,
        source=Reference("the user", loaded.file, None, f"function {loaded.source.name}"),
        scale=one,
        isotropic=lru_cache(maxsize=4096)(lambda p: symmetric(evaluate, p)),
        smooth_in=PLAIN,
        about=_about(loaded),
    )


def own(model: Model, loaded: Loaded) -> Model:
    """The model by the name it is asked for, its functions, but albedo_lab's own, written as those of a function_model are."""
    record: dict[str, Any] = {field.name: getattr(model, field.name) for field in fields(model)}
    memo: dict[int, Any] = {}
    for name, arguments in ARGUMENTS.items():
        function = getattr(record[name], "py_func", record[name])
        if isinstance(function, types.FunctionType) and not function.__module__.startswith("albedo_lab."):
            record[name] = _wrapped(name, f"function({arguments})", function, loaded, memo)
    return OwnModel(**record, about=_about(loaded))


def _named_tuple(names: list[str]) -> Any:
    """A type with these fields; of whatever module the function is, equal ones share their compiled code."""
    maker: Any = namedtuple  # which wants to see the names
    return maker("Parameters", names, module="albedo_lab.custom", rename=True)  # what is no name of a field is refused later


def one(p: Any) -> float:
    """The constant of a function that is complete."""
    return 1.0


def _wrapped(name: str, body: str, function: Any, loaded: Loaded, memo: dict[int, Any]) -> Any:
    """The function as one of a Model's.

    Its text holds the digest of the user's files: compiled code is kept by what a function says and calls, which does not hold
    what it reads from another module as `module.name`.
    """
    namespace: dict[str, Any] = {"function": _settled(function, memo), "__name__": HOME}
    exec(f'def {name}({ARGUMENTS[name]}):\n    "{loaded.stamp}"\n    return {body}\n', namespace)
    return namespace[name]


def _settled(thing: Any, memo: dict[int, Any]) -> Any:
    """A function, and all that it calls, as if they were defined in albedo_lab; anything else as it is.

    Compiled code on disk names the modules that it was made from, and wants to import them when it is read. Those of a file are
    not to be had by name.
    """
    function = getattr(thing, "py_func", thing)
    if not isinstance(function, types.FunctionType) or function.__module__.startswith("albedo_lab."):
        return thing
    if id(function) not in memo:
        namespace = dict(function.__globals__)
        cells = tuple(types.CellType() for _ in function.__closure__ or ())
        settled = types.FunctionType(function.__code__, namespace, function.__name__, function.__defaults__, cells)
        settled.__module__ = HOME
        memo[id(function)] = settled
        for name in {i.argval for i in dis.get_instructions(function.__code__) if i.opname == "LOAD_GLOBAL"} & namespace.keys():
            namespace[name] = _settled(namespace[name], memo)
        for cell, held in zip(cells, function.__closure__ or (), strict=True):
            cell.cell_contents = _settled(held.cell_contents, memo)
    return memo[id(function)]


def _about(loaded: Loaded) -> str:
    """The first line of what a module says of itself."""
    return (loaded.module.__doc__ or "").strip().partition("\n")[0]


def _fields(function: Callable[..., Any], first: str) -> Any:
    """The NamedTuple class that the first argument is annotated with, None where there is none."""
    try:
        found = typing.get_type_hints(function).get(first)
    except Exception:  # an annotation may be any expression
        return None
    return found if isinstance(found, type) and issubclass(found, tuple) and hasattr(found, "_field_defaults") else None


def _parameter(name: str, default: Any, loaded: Loaded, called: str) -> Parameter:
    """A parameter that takes any number."""
    told = f"{name}={default!r} of {loaded.place}"
    if name in RESERVED or name.startswith("_"):
        raise BadInput("model", called, f"{told} needs another name: this one is not free")
    if not is_number(default) or not math.isfinite(default):
        raise BadInput("model", called, f"{told}: the default of a parameter must be a finite number")
    return Parameter(name, f"parameter of {loaded.source.name}", float(default), low=-LARGEST, high=LARGEST)
