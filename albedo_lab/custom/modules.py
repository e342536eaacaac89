"""Python modules of somebody else's: where they are, loaded without a trace, and whether their files have changed since."""

from __future__ import annotations

import difflib
import hashlib
import importlib
import os
import sys
import types
from collections.abc import Iterable, Iterator
from contextlib import contextmanager, redirect_stdout
from dataclasses import dataclass
from operator import attrgetter
from pathlib import Path
from typing import Any

from albedo_lab.errors import BadInput
from albedo_lab.model import Model

State = tuple[tuple[str, int, int], ...]
OURS = "albedo_lab_own_"
"""How the names of modules begin that were loaded by their paths."""


@dataclass(frozen=True, slots=True)
class Source:
    """The module, by its path or by its name and the folder where that is looked for, and the name in it."""

    path: str
    module: str
    folder: str
    name: str


@dataclass(frozen=True, slots=True)
class Loaded:
    """A module that was loaded for a name in it, with all files of its own that it took."""

    source: Source
    module: types.ModuleType
    files: tuple[str, ...]
    state: State

    @property
    def file(self) -> str:
        """Its file, as people write it."""
        return shown(self.files[0])

    @property
    def place(self) -> str:
        """The file and the name."""
        return f"{self.source.name} in {self.file}"

    @property
    def stamp(self) -> str:
        """A digest of everything in its files."""
        digest = hashlib.sha256()
        for file in self.files:
            digest.update(Path(file).read_bytes())
        return digest.hexdigest()[:20]

    def is_fresh(self) -> bool:
        """Whether no file has changed since."""
        return _state(self.files) == self.state

    def attribute(self, called: str) -> Any:
        """What the name stands for. Raises BadInput."""
        try:
            return attrgetter(self.source.name)(self.module)
        except AttributeError:
            functions = [name for name, thing in vars(self.module).items() if isinstance(thing, types.FunctionType | Model)]
            nearest = difflib.get_close_matches(self.source.name, functions, n=3)
            hint = (
                f"; did you mean {' or '.join(nearest)}?" if nearest else f"; it has {', '.join(functions[:5]) or 'no function'}"
            )
            raise BadInput("model", called, f"no {self.source.name!r} in {self.file}{hint}") from None


_imported: dict[str, Loaded] = {}
"""What was imported by name, to know when it is out of date."""


def source_of(spec: str) -> Source:
    """The parts of `file.py:name` or `package.module:name`. Raises BadInput where one is missing."""
    place, _, name = spec.rpartition(":") if ":" in spec else (spec, "", "")
    if not place or not all(part.isidentifier() for part in name.split(".")):
        raise BadInput("model", spec, "must be file.py:NAME or package.module:NAME, with the name of a function or a Model in it")
    if place.endswith(".py") or os.sep in place:
        return Source(os.path.realpath(place), "", "", name)
    if not all(part.isidentifier() for part in place.split(".")):
        raise BadInput("model", spec, f"{place!r} is neither a file .py nor the name of a module")
    return Source("", place, os.getcwd(), name)


def load(source: Source, called: str) -> Loaded:
    """The module, executed anew. Raises BadInput, one line, for whatever it raises itself."""
    folder = os.path.dirname(source.path) or source.folder
    hidden = _beside(folder) if source.path else _outdated(source)
    _forget(hidden)
    before = set(sys.modules)
    try:
        with _at(folder):
            module = _executed(source.path) if source.path else importlib.import_module(source.module)
        files = _files(module, set(sys.modules) - before, source)
    except (Exception, SystemExit) as error:
        _forget(set(sys.modules) - before)
        raise BadInput("model", called, _complaint(source, error)) from None
    finally:
        if source.path:  # names of files beside it stand for whatever they stood for
            _forget({name for name in set(sys.modules) - before if not name.startswith(OURS)} & set(_beside(folder)))
            sys.modules.update(hidden)
    loaded = Loaded(source, module, files, _state(files))
    if source.module:
        _imported[source.module] = loaded
    return loaded


def shown(file: str) -> str:
    """A path as people write it: from the current folder where it is inside."""
    inside = os.path.relpath(file)
    return file if inside.startswith(os.pardir) else inside


def told(error: BaseException) -> str:
    """An exception as one line."""
    return " ".join(f"{type(error).__name__}: {error}".split())


def line_of(error: BaseException, files: tuple[str, ...]) -> str:
    """` (line N)`, the deepest line in those files that the exception went through; empty where it went through none."""
    line, trace = "", error.__traceback__
    while trace is not None:
        if trace.tb_frame.f_code.co_filename in files:
            line = f" (line {trace.tb_lineno})"
        trace = trace.tb_next
    return line


@contextmanager
def quiet() -> Iterator[None]:
    """What somebody else's code prints is no part of our answer: it goes to standard error."""
    with redirect_stdout(sys.stderr):
        yield


@contextmanager
def _at(folder: str) -> Iterator[None]:
    """The folder first in sys.path, as for `python -m`, and no byte code written: it would be stale within the same second."""
    path, writes = list(sys.path), sys.dont_write_bytecode
    sys.path.insert(0, folder)
    sys.dont_write_bytecode = True
    importlib.invalidate_caches()
    try:
        with quiet():
            yield
    finally:
        sys.path[:] = path
        sys.dont_write_bytecode = writes


def _executed(path: str) -> types.ModuleType:
    """The file as a module whose name no other has, and which is the same in every process."""
    name = f"{OURS}{Path(path).stem}_{hashlib.sha256(path.encode()).hexdigest()[:12]}"
    module = types.ModuleType(name)
    module.__file__ = path
    code = compile(Path(path).read_bytes(), path, "exec", dont_inherit=True)
    before = sys.modules.get(name)
    sys.modules[name] = module
    try:
        exec(code, module.__dict__)
    except BaseException:
        sys.modules.pop(name, None)
        if before is not None:
            sys.modules[name] = before
        raise
    return module


def _beside(folder: str) -> dict[str, Any]:
    """The modules that bear the names of files and packages in the folder, wherever they come from."""
    names = {entry.removesuffix(".py") for entry in os.listdir(folder)} if os.path.isdir(folder) else set()
    names -= sys.stdlib_module_names | {"albedo_lab", "__main__"}
    return {name: module for name, module in list(sys.modules.items()) if name.partition(".")[0] in names}


def _outdated(source: Source) -> dict[str, Any]:
    """What was imported for us under that name, where it was from another folder or a file has changed since."""
    known = _imported.get(source.module)
    if known is None or (known.source.folder == source.folder and known.is_fresh()):
        return {}
    del _imported[source.module]
    return {name: module for name, module in list(sys.modules.items()) if _file(module) in known.files}


def _files(module: types.ModuleType, new: set[str], source: Source) -> tuple[str, ...]:
    """The module's file, then those that lie beside it or below of the new modules, and of what its globals come from."""
    first = _file(module)
    if not first:
        raise BadInput("model", module.__name__, f"{module.__name__} is not a module that is written in Python")
    root = os.path.dirname(first)
    for _ in range(module.__name__.count(".")):
        root = os.path.dirname(root)
    known = _imported.get(source.module)
    found = {_file(sys.modules[name]) for name in new} | set(known.files if known else ())
    for thing in vars(module).values():
        home = thing if isinstance(thing, types.ModuleType) else sys.modules.get(str(getattr(thing, "__module__", "")))
        found.add(_file(home))
    ours = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
    beside = {file for file in found if file.startswith(root + os.sep) and not file.startswith(ours + os.sep)}
    return first, *sorted(file for file in beside - {first} if "site-packages" not in file[len(root) :])


def _file(module: Any) -> str:
    """The Python file of a module; empty for others."""
    file = getattr(module, "__file__", None)
    return file if isinstance(file, str) and file.endswith(".py") else ""


def _forget(names: Iterable[str]) -> None:
    for name in list(names):
        sys.modules.pop(name, None)


def _state(files: tuple[str, ...]) -> State:
    """What tells whether files are as they were."""
    found = []
    for file in files:
        try:
            status = os.stat(file)
            found.append((file, status.st_mtime_ns, status.st_size))
        except OSError:
            found.append((file, 0, -1))
    return tuple(found)


def _complaint(source: Source, error: BaseException) -> str:
    """Why a module could not be loaded."""
    where = shown(source.path) if source.path else source.module
    if isinstance(error, BadInput):
        return error.domain
    if isinstance(error, OSError) and error.filename == source.path:
        return f"cannot read {where} ({error.strerror})"
    if isinstance(error, ModuleNotFoundError) and error.name and f"{source.module}.".startswith(f"{error.name}."):
        return f"no module {error.name!r}, neither in the current folder nor installed"
    if isinstance(error, SyntaxError):
        file = shown(error.filename) if error.filename else where
        return f"{file}, line {error.lineno}: {' '.join(f'{type(error).__name__}: {error.msg}'.split())}"
    return f"importing {where} raises {told(error)}{line_of(error, (source.path,))}"
