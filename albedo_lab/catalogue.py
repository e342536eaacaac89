"""Finds a model by its name. Importing or listing it imports no numba."""

from __future__ import annotations

import difflib
from importlib import import_module
from importlib.metadata import EntryPoint, entry_points
from pkgutil import iter_modules

from albedo_lab import models
from albedo_lab.errors import BadInput
from albedo_lab.model import Model

GROUP = "albedo_lab.models"


def names() -> list[str]:
    """Every name of the catalogue, in alphabetical order."""
    return sorted(module.name for module in iter_modules(models.__path__))


def offered() -> dict[str, EntryPoint]:
    """What installed packages offer in the entry-point group `albedo_lab.models`, by name; none of it is imported."""
    found = sorted(entry_points(group=GROUP), key=lambda entry: entry.name)
    return {entry.name: entry for entry in found if entry.name not in names()}


def find(name: str) -> Model:
    """The model of that name; for the path of a `.binary` file, the measurement in it.

    Models of one's own are `file.py:name` or `package.module:name`, or bear a name that an installed package gives them (see
    `albedo_lab.custom`). Raises BadInput for an unknown name, with the nearest known ones, and for a file that cannot be read.
    """
    if name.endswith(".binary"):
        return find("merl").member({"file": name})[0]
    if name in names():
        found: Model = import_module(f"{models.__name__}.{name}").MODEL
        return found
    from albedo_lab import custom

    if custom.is_own(name):
        return custom.model_at(name)
    elsewhere = offered()
    if name in elsewhere:
        return custom.model_at(elsewhere[name].value, name)
    nearest = difflib.get_close_matches(name, [*names(), *elsewhere], n=3, cutoff=0.5)
    hint = f"did you mean {' or '.join(nearest)}?" if nearest else "see albedo-lab list"
    raise BadInput("model", name, f"not in the catalogue; {hint}")
