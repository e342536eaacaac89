"""From plain Python formulas to machine code, with a disk cache that hits in a new process and is never stale.

numba's own disk cache never hits for a jitted function that is passed as an argument, and does not see an edit in a callee
of another file. So a kernel is made thus: an entry function (a template) refers to a model's functions by placeholders; for one
model it is written out as a stub whose name carries a fingerprint of everything reachable from it (byte code, constants,
globals, vector maths, numba's version), and the model's functions are compiled as globals of that stub.

Every function is inlined, and not for speed alone: one that stays a call exists twice in the process that compiles it, optimised
by itself and within the kernel, and only the second copy goes to disk; a cold and a warm cache would differ in the last bits.
"""

from __future__ import annotations

import dis
import hashlib
import inspect
import linecache
import os
import sys
import textwrap
import types
from collections.abc import Callable, Iterator
from functools import lru_cache
from pathlib import Path
from typing import Any

import numba
from numba.core.dispatcher import Dispatcher
from numba.extending import intrinsic

from albedo_lab.files import write_whole
from albedo_lab.kernels import vmath
from albedo_lab.kernels.vmath import FLAGS, INLINE

CALLEE: dict[str, Any] = INLINE | {"no_cpython_wrapper": True, "no_cfunc_wrapper": True}
"""What is only called by compiled code needs no entry from Python; making one is a tenth of the compilation."""
ENTRY: dict[str, Any] = {"fastmath": FLAGS, "error_model": "numpy", "nogil": True}
INTRINSIC = type(intrinsic(lambda typingctx: None))
TWINS: dict[str, Dispatcher] = {}
"""Every compiled twin of this process by its fingerprint: a formula is compiled once for all kernels of its model."""


class Placeholder:
    """A global of a template that each model fills with a function of its own."""

    def __init__(self, name: str) -> None:
        self.name = name

    def __call__(self, *arguments: Any) -> Any:
        """Never called: specialise puts the model's function in its place."""
        raise TypeError(f"{self.name} is a placeholder; see specialise")


def specialise(template: Callable[..., Any], **bindings: Any) -> Callable[..., Any]:
    """The template compiled with its placeholders bound; from memory or disk when the same was made before."""
    fingerprint = _fingerprint(template, bindings)
    name = f"{template.__name__}_{fingerprint}"
    made = sys.modules.get(f"albedo_lab_kernel_{name}")
    if made is None:
        made = _load(template, name, bindings)
    return getattr(made, name)  # type: ignore[no-any-return]


def cache_directory() -> Path:
    """Where compiled kernels are kept: ALBEDO_LAB_CACHE, or albedo_lab in the user's cache folder."""
    explicit = os.environ.get("ALBEDO_LAB_CACHE")
    if explicit:
        return Path(explicit)
    return Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache") / "albedo_lab"


def _load(template: Callable[..., Any], name: str, bindings: dict[str, Any]) -> types.ModuleType:
    source = textwrap.dedent(inspect.getsource(template))
    source = source[source.index("def ") :].replace(f"def {template.__name__}(", f"def {name}(", 1)
    path, cached = _write_stub(f"kernel_{name}.py", source)
    module = types.ModuleType(f"albedo_lab_kernel_{name}")
    module.__file__ = str(path)
    module.__dict__.update(_bound_globals(template, bindings))
    linecache.checkcache(str(path))
    exec(compile(source, str(path), "exec"), module.__dict__)
    module.__dict__[name] = numba.njit(**ENTRY, cache=cached)(module.__dict__[name])
    sys.modules[module.__name__] = module
    return module


def _write_stub(filename: str, source: str) -> tuple[Path, bool]:
    """The stub's path, and whether it could be written, without which there is no disk cache."""
    path = cache_directory() / filename
    try:
        if not path.exists():
            path.parent.mkdir(parents=True, exist_ok=True)
            write_whole(path, source, modified=0.0)  # numba stamps its index with this time: equal stubs must look equal
        return path, os.access(path.parent, os.W_OK)
    except OSError:
        return path, False


def _bound_globals(function: Callable[..., Any], bindings: dict[str, Any]) -> dict[str, Any]:
    """The function's globals with every plain function replaced by its compiled twin, placeholders by what they stand for."""
    namespace = dict(function.__globals__)
    for name in _global_names(function.__code__):
        value = namespace.get(name)
        if isinstance(value, Placeholder):
            value = bindings[value.name]
        if isinstance(value, types.FunctionType):
            value = _twin(value, bindings)
        namespace[name] = value
    return {name: value for name, value in namespace.items() if value is not None and not name.startswith("__")}


def _twin(function: Any, bindings: dict[str, Any]) -> Any:
    """The compiled twin of a plain function; of an elementary one, its vector version."""
    if function.__module__ == "albedo_lab.optics.maths":
        return getattr(vmath, function.__name__)
    fingerprint = _fingerprint(function, bindings)
    if fingerprint not in TWINS:
        namespace = _bound_globals(function, bindings)
        held = (cell.cell_contents for cell in function.__closure__ or ())
        closure = tuple(types.CellType(_twin(v, bindings) if isinstance(v, types.FunctionType) else v) for v in held)
        twin = types.FunctionType(function.__code__, namespace, function.__name__, function.__defaults__, closure)
        twin.__module__ = function.__module__
        TWINS[fingerprint] = numba.njit(**CALLEE)(twin)
    return TWINS[fingerprint]


def _fingerprint(function: Callable[..., Any], bindings: dict[str, Any]) -> str:
    """Of everything that can change what the function computes."""
    digest = hashlib.sha256()
    digest.update(f"{numba.__version__} {sys.version_info[:3]} {sorted(FLAGS)}".encode())
    _feed(function, bindings, digest, set())
    return digest.hexdigest()[:20]


def _feed(thing: Any, bindings: dict[str, Any], digest: Any, seen: set[int]) -> None:
    """Everything that can change what a function computes, in a fixed order."""
    if isinstance(thing, Placeholder):
        thing = bindings[thing.name]
    if isinstance(thing, Dispatcher):
        options = dict(thing.targetoptions)
        flags = options.pop("fastmath", ())
        digest.update(repr((sorted(getattr(flags, "flags", flags) or ()), sorted(options.items()))).encode())
        thing = thing.py_func
    if isinstance(thing, INTRINSIC):
        thing = thing._defn
    if isinstance(thing, types.FunctionType):
        if id(thing) in seen:
            return
        seen.add(id(thing))
        if thing.__module__ == "albedo_lab.optics.maths":
            _feed(getattr(vmath, thing.__name__), bindings, digest, seen)
            return
        digest.update(thing.__name__.encode())
        _feed_code(thing.__code__, digest)
        _feed(thing.__defaults__, bindings, digest, seen)
        for cell in thing.__closure__ or ():
            _feed(cell.cell_contents, bindings, digest, seen)
        for name in sorted(set(_global_names(thing.__code__))):
            if name in thing.__globals__:
                digest.update(name.encode())
                _feed(thing.__globals__[name], bindings, digest, seen)
        for path in sorted(set(_attribute_paths(thing.__code__))):
            value = _in_module(thing.__globals__, path)
            if value is not None:
                digest.update(".".join(path).encode())
                _feed(value, bindings, digest, seen)
    elif isinstance(thing, types.ModuleType | type) or callable(thing):
        fields = getattr(thing, "_fields", "")
        digest.update(f"{getattr(thing, '__module__', '')}.{getattr(thing, '__qualname__', thing)}{fields}".encode())
    elif hasattr(thing, "tobytes"):
        digest.update(f"{thing.dtype}{thing.shape}".encode() + thing.tobytes())  # the repr of an array is cut short
    else:
        digest.update(_stable(thing).encode())


def _stable(constant: Any) -> str:
    """A repr that is the same in every process: sets come in no order."""
    return repr(sorted(map(repr, constant))) if isinstance(constant, set | frozenset) else repr(constant)


def _feed_code(code: types.CodeType, digest: Any) -> None:
    digest.update(code.co_code)
    digest.update(repr((code.co_names, code.co_varnames, code.co_argcount)).encode())
    for constant in code.co_consts:
        if isinstance(constant, types.CodeType):
            _feed_code(constant, digest)
        else:
            digest.update(_stable(constant).encode())


@lru_cache(maxsize=4096)
def _global_names(code: types.CodeType) -> tuple[str, ...]:
    """The globals that a function reads; `co_names` would add its attributes, which may bear the name of some other function."""
    own = (instruction.argval for instruction in dis.get_instructions(code) if instruction.opname == "LOAD_GLOBAL")
    inner = (name for constant in code.co_consts if isinstance(constant, types.CodeType) for name in _global_names(constant))
    return (*own, *inner)


@lru_cache(maxsize=4096)
def _attribute_paths(code: types.CodeType) -> tuple[tuple[str, ...], ...]:
    """Every chain of names that a function follows from a global: settings.SIZE is ("settings", "SIZE")."""
    return tuple(_followed(code))


def _followed(code: types.CodeType) -> Iterator[tuple[str, ...]]:
    path: tuple[str, ...] = ()
    for instruction in dis.get_instructions(code):
        if instruction.opname == "LOAD_GLOBAL":
            path = (instruction.argval,)
        elif path and instruction.opname in ("LOAD_ATTR", "LOAD_METHOD"):
            path = (*path, instruction.argval)
            yield path
        else:
            path = ()
    for constant in code.co_consts:
        if isinstance(constant, types.CodeType):
            yield from _attribute_paths(constant)


def _in_module(namespace: dict[str, Any], path: tuple[str, ...]) -> Any:
    """What a chain of names that begins with a module leads to, when no module lies at its end; compiled code holds it fixed."""
    value = namespace.get(path[0])
    for name in path[1:]:
        if not isinstance(value, types.ModuleType):
            return None
        value = getattr(value, name, None)
    return None if isinstance(value, types.ModuleType) else value
