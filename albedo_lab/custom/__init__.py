"""Models of one's own: `path/to/file.py:name`, `package.module:name`, and what installed packages offer. Imports no numba.

`name` is a `Model`, or a plain function in one of two forms; evaluate alone is enough:

    def mine(wi, wo, alpha=0.3, n=20):      # what follows the directions are the parameters, each with a number as default
    def mine(p: P, wi, wo):                 # P is a NamedTuple class whose fields are the parameters, with defaults

Directions are unit vectors with fields x, y, z; z is the cosine with the normal. The value is f_r in 1/sr, without the cosine.
The code is run as Python and as machine code, so it holds numbers, tuples, `math` and `numpy` as numba knows them. A function
has no sampler and the constant 1; whoever has one writes a Model.
"""

from __future__ import annotations

from dataclasses import replace
from types import FunctionType
from typing import Any

from albedo_lab.custom.functions import function_model, own
from albedo_lab.custom.modules import Loaded, Source, load, source_of
from albedo_lab.custom.probe import try_out
from albedo_lab.errors import BadInput
from albedo_lab.model import Model

_made: dict[tuple[str, Source], tuple[Loaded, Model]] = {}


def is_own(spec: str) -> bool:
    """Whether that is the place of a model rather than a name."""
    return ":" in spec or spec.endswith(".py")


def model_at(spec: str, name: str | None = None) -> Model:
    """The model at `file.py:name` or `package.module:name`; the same object until one of its files changes.

    It is called `name`, by default as it was asked for. Raises BadInput, one line, for whatever is wrong with it.
    """
    called = name or spec
    source = source_of(spec)
    key = called, source
    known = _made.get(key)
    if known is not None and known[0].is_fresh():
        return known[1]
    loaded = load(source, called)
    model = _model(loaded.attribute(called), loaded, called)
    try_out(model, loaded, called)
    _made[key] = loaded, model
    return model


def _model(found: Any, loaded: Loaded, called: str) -> Model:
    if isinstance(found, Model):
        return replace(own(found, loaded), name=called)
    function = getattr(found, "py_func", found)  # of a function that numba has compiled already
    if not isinstance(function, FunctionType):
        kind = type(found).__name__
        raise BadInput("model", called, f"{loaded.place} is of type {kind}, neither a plain function nor an albedo_lab.Model")
    return function_model(function, loaded, called)
