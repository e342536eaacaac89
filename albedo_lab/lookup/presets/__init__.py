"""The layouts that renderers read: one file each."""

from __future__ import annotations

from albedo_lab.errors import BadInput
from albedo_lab.lookup.presets import cycles, filament, kulla_conty, materialx, openpbr
from albedo_lab.lookup.presets.preset import Preset

__all__ = ["PRESETS", "Preset", "preset"]

PRESETS = cycles.PRESETS | kulla_conty.PRESETS | filament.PRESETS | materialx.PRESETS | openpbr.PRESETS


def preset(name: str) -> Preset:
    """The preset of that name. Raises BadInput."""
    if name not in PRESETS:
        raise BadInput("preset", name, f"must be one of {', '.join(PRESETS)}")
    return PRESETS[name]
