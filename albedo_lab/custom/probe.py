"""Somebody else's functions tried out before they are used: whatever is wrong with them becomes one line that names them."""

from __future__ import annotations

import dis
import math
import os
import re
import types
import warnings
from collections.abc import Callable, Iterator
from functools import partial
from typing import Any

from albedo_lab.custom.modules import Loaded, line_of, quiet, told
from albedo_lab.custom.pairs import is_number, pairs, tolerant
from albedo_lab.errors import BadInput
from albedo_lab.model import Maximum, Model
from albedo_lab.optics.frame import Direction

NOISE_OF_NUMBA = re.compile(
    r"^(Failed in |During: |File |There (is|are) |- |<|def |\^|~|Enable|[Tt]his error |For more|$)|^[*\d]"
)


def try_out(model: Model, loaded: Loaded, called: str) -> None:
    """Calls every function of the model in plain Python and compiled, with the default parameters.

    Raises BadInput where one raises, returns something else than a number, does not compile, or is NaN wherever it was asked.
    """
    complain = Complaint(loaded, called)
    try:
        with quiet():
            p = model.bind({})
    except BadInput:
        return  # a model without defaults, as a measurement without its file, says so when it is used
    except Exception as error:
        raise complain(f"raises {told(error)}{line_of(error, loaded.files)} for its default parameters") from None
    with quiet():
        _call_everything(model, p, complain)
        _refuse_exceptions(model, complain)
        values = _compiled(model, p, complain)
        _called(lambda: model.isotropic(p), "", "isotropic", complain)
    if all(math.isnan(value) for value in values):
        raise complain(f"returns NaN for every one of the {len(values)} pairs of directions tried")


class Complaint:
    """Makes the one line, which names the function and the file."""

    def __init__(self, loaded: Loaded, called: str) -> None:
        self.loaded, self.called = loaded, called

    def __call__(self, what: str, part: str = "") -> BadInput:
        """The error; `part` is the function of a Model that is meant."""
        return BadInput("model", self.called, f"{part and part + ' of '}{self.loaded.place} {what}")


def _call_everything(model: Model, p: Any, complain: Complaint) -> None:
    """One call of each function, and of evaluate one for every pair, in plain Python."""
    part = "" if model.sample is None and not model.choices else "evaluate"
    for wi, wo in pairs():
        _number(partial(model.evaluate, p, wi, wo), f"for wi = {_plain(wi)}, wo = {_plain(wo)}", part, complain)
    wi, wo = pairs()[-1]
    if (model.sample is None) != (model.pdf is None):
        raise complain("has only one of sample and pdf")
    if model.sample is not None and model.pdf is not None:
        sampled = _called(lambda: model.sample(p, wo, 0.4, 0.7), "", "sample", complain)  # type: ignore[misc]
        if not isinstance(sampled, Direction):
            raise complain(f"returns {type(sampled).__name__}, not an albedo_lab.optics.frame.Direction", "sample")
        _number(lambda: model.pdf(p, wi, wo), "", "pdf", complain)  # type: ignore[misc]
    if model.weight is not None:
        _number(lambda: model.weight(p, wo, 0.4, 0.7), "", "weight", complain)  # type: ignore[misc]
    _number(lambda: model.mirror(p, 0.5), "", "mirror", complain)
    if not isinstance(model.scale, Maximum):
        _number(lambda: model.scale(p), "", "scale", complain)  # type: ignore[operator]


def _called(call: Callable[[], Any], where: str, part: str, complain: Complaint) -> Any:
    try:
        return tolerant(call)
    except Exception as error:
        raise complain(f"raises {told(error)}{line_of(error, complain.loaded.files)} {where}".rstrip(), part) from None


def _number(call: Callable[[], Any], where: str, part: str, complain: Complaint) -> None:
    found = _called(call, where, part, complain)
    if not is_number(found):
        kind = "None" if found is None else f"a value of type {type(found).__name__}"
        raise complain(f"returns {kind}, not a number {where}".rstrip(), part)


def _refuse_exceptions(model: Model, complain: Complaint) -> None:
    """Compiled code would raise somewhere in the middle of an estimate, where nobody can say for which directions."""
    for part in (model.evaluate, model.sample, model.pdf, model.weight, model.mirror):
        for function in _reached(part, set()):
            for instruction in dis.get_instructions(function.__code__):
                if instruction.opname == "RAISE_VARARGS":
                    line = function.__code__.co_firstlineno if instruction.positions is None else instruction.positions.lineno
                    raise complain(f"must not raise or assert (line {line}): compiled code cannot; return math.nan instead")


def _reached(thing: Any, seen: set[int]) -> Iterator[types.FunctionType]:
    """The function and those that it may call, without albedo_lab's."""
    thing = getattr(thing, "py_func", thing)
    if not isinstance(thing, types.FunctionType) or id(thing) in seen or thing.__module__.startswith("albedo_lab."):
        return
    seen.add(id(thing))
    yield thing
    cells = [cell.cell_contents for cell in thing.__closure__ or ()]
    names = [i.argval for i in dis.get_instructions(thing.__code__) if i.opname == "LOAD_GLOBAL"]
    for other in [*cells, *(thing.__globals__.get(name) for name in names)]:
        yield from _reached(other, seen)


def _compiled(model: Model, p: Any, complain: Complaint) -> list[float]:
    """f of every pair, by compiled code."""
    from albedo_lab.kernels.probing import probed
    from albedo_lab.tables import plain

    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            return probed(model, tuple(map(plain, p)), pairs())
    except RecursionError:
        raise complain("calls itself, which cannot be compiled") from None
    except Exception as error:
        raise complain(f"cannot be compiled: {_gist(str(error), complain.loaded.files)}") from None


def _gist(text: str, files: tuple[str, ...]) -> str:
    """The one sentence of a message of numba that says what is wrong, and the line of the user's that it is about."""
    text = re.sub(r"\x1b\[[0-9;]*m", "", text)
    said = [line.strip() for line in text.splitlines() if not NOISE_OF_NUMBA.match(line.strip())]
    names = {os.path.basename(file) for file in files}
    lines = [line for file, line in re.findall(r'File "([^"]*)", line (\d+)', text) if os.path.basename(file) in names]
    where = f" (line {lines[0]})" if lines else ""
    return f"{said[0] if said else 'numba does not say why'}{where}"


def _plain(w: Direction) -> str:
    return f"({w.x:g}, {w.y:g}, {w.z:g})"
