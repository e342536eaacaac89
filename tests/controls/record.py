"""What a negative control is."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

from albedo_lab.model import Model


@dataclass(frozen=True)
class Sick:
    """A model made sick: what was injected, and the checks each of which must convict it at the default budget."""

    name: str
    injected: str
    model: Model
    convicted_by: tuple[str, ...]
    values: dict[str, Any] = field(default_factory=dict)
