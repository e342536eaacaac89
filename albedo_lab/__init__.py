"""albedo_lab: every reflectance model on trial, each figure with an honest error bar."""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

__version__ = "0.1.0"

if TYPE_CHECKING:
    from albedo_lab.analysis.albedo import albedo
    from albedo_lab.analysis.check import check
    from albedo_lab.analysis.colour import colour
    from albedo_lab.analysis.grazing import grazing
    from albedo_lab.analysis.mean_albedo import mean_albedo
    from albedo_lab.analysis.normalise import normalise
    from albedo_lab.analysis.tabulate import tabulate
    from albedo_lab.catalogue import find, names
    from albedo_lab.errors import BadInput, Inconclusive
    from albedo_lab.lookup.audit import audit
    from albedo_lab.lookup.export import export
    from albedo_lab.model import Choice, Count, File, Model, Parameter, Reference

_HOME = {
    "albedo": "albedo_lab.analysis.albedo",
    "check": "albedo_lab.analysis.check",
    "colour": "albedo_lab.analysis.colour",
    "grazing": "albedo_lab.analysis.grazing",
    "mean_albedo": "albedo_lab.analysis.mean_albedo",
    "normalise": "albedo_lab.analysis.normalise",
    "tabulate": "albedo_lab.analysis.tabulate",
    "audit": "albedo_lab.lookup.audit",
    "export": "albedo_lab.lookup.export",
    "find": "albedo_lab.catalogue",
    "names": "albedo_lab.catalogue",
    "BadInput": "albedo_lab.errors",
    "Inconclusive": "albedo_lab.errors",
    "Choice": "albedo_lab.model",
    "Count": "albedo_lab.model",
    "File": "albedo_lab.model",
    "Model": "albedo_lab.model",
    "Parameter": "albedo_lab.model",
    "Reference": "albedo_lab.model",
}
__all__ = [
    "BadInput",
    "Choice",
    "Count",
    "File",
    "Inconclusive",
    "Model",
    "Parameter",
    "Reference",
    "albedo",
    "audit",
    "check",
    "colour",
    "export",
    "find",
    "grazing",
    "mean_albedo",
    "names",
    "normalise",
    "tabulate",
]


def __getattr__(name: str) -> Any:
    """Imports a public name when it is first used, so that the command line starts without numba and pandas."""
    if name not in _HOME:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(_HOME[name]), name)
