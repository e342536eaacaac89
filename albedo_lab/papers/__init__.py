"""The documents on trial: what each prints, as data, and how every printed figure is recomputed and judged."""

from __future__ import annotations

from importlib import import_module
from pkgutil import iter_modules
from typing import TYPE_CHECKING

from albedo_lab.errors import BadInput

if TYPE_CHECKING:
    from albedo_lab.papers.record import Paper


def paper_names() -> list[str]:
    """The documents on trial: the packages of this room."""
    return sorted(module.name for module in iter_modules(__path__) if module.ispkg)


def find_paper(name: str) -> Paper:
    """The document of that name. Raises BadInput for an unknown one."""
    known = paper_names()
    if name not in known:
        raise BadInput("paper", name, f"must be one of {', '.join(known)}")
    found: Paper = import_module(f"{__name__}.{name}").PAPER
    return found
