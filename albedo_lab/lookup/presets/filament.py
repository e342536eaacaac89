"""Filament: the split sum of image-based lighting, for single and for multiple scattering."""

from __future__ import annotations

from dataclasses import replace

from albedo_lab.lookup.formats import Layout
from albedo_lab.lookup.presets.preset import Preset

SINGLE = Preset(
    name="dfg",
    mean=None,
    model="ggx",
    quantity="split-sum",
    axes=("roughness=128", "mu=128"),
    sampling="centres",
    fixed=(("G", "smith_correlated"), ("F", "schlick")),
    format="exr",
    layout=Layout(),
    reader="Filament, light_indirect: texture at (mu, perceptual roughness), row 0 the smoothest; E = F0 R + G",
    differences=(
        "cmgen's own rows are those of the next roughness, (i + 1.5) / 128, the last of 1; these stand where the shader looks",
        "cmgen draws 1024 normals a cell, which leaves noise of about 1e-3",
    ),
)
PRESETS = {
    "filament-dfg": SINGLE,
    "filament-dfg-multiscatter": replace(
        SINGLE,
        quantity="split-sum-total",
        reader="Filament, light_indirect: texture at (mu, perceptual roughness), row 0 the smoothest; E = mix(R, G, F0)",
    ),
}
