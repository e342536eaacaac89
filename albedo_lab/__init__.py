"""albedo_lab: every reflectance model on trial, each figure with an honest error bar."""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

__version__ = "0.1.0"

if TYPE_CHECKING:
    from albedo_lab.analysis.albedo import albedo
    from albedo_lab.analysis.mean_albedo import mean_albedo
    from albedo_lab.analysis.normalise import normalise
    from albedo_lab.catalogue import find, names
    from albedo_lab.errors import BadInput, Inconclusive
    from albedo_lab.model import Model, Parameter, Reference

_HOME = {
    "albedo": "albedo_lab.analysis.albedo",
    "mean_albedo": "albedo_lab.analysis.mean_albedo",
    "normalise": "albedo_lab.analysis.normalise",
    "find": "albedo_lab.catalogue",
    "names": "albedo_lab.catalogue",
    "BadInput": "albedo_lab.errors",
    "Inconclusive": "albedo_lab.errors",
    "Model": "albedo_lab.model",
    "Parameter": "albedo_lab.model",
    "Reference": "albedo_lab.model",
}
__all__ = [
    "BadInput",
    "Inconclusive",
    "Model",
    "Parameter",
    "Reference",
    "albedo",
    "find",
    "mean_albedo",
    "names",
    "normalise",
]


def __getattr__(name: str) -> Any:
    """Imports a public name when it is first used, so that the command line starts without numba and pandas."""
    if name not in _HOME:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(_HOME[name]), name)
