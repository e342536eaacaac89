"""Blender Cycles: the albedo of GGX over roughness and mu, as its precomputation writes it."""

from __future__ import annotations

from albedo_lab.lookup.formats import Layout
from albedo_lab.lookup.presets.preset import Preset

PRESETS = {
    "cycles": Preset(
        name="table_ggx_E",
        mean="table_ggx_Eavg",
        model="ggx",
        quantity="albedo",
        axes=("mu=32", "roughness=32"),
        sampling="endpoints",
        fixed=(("G", "smith_correlated"), ("F", "one")),
        format="c",
        layout=Layout(decimals=6),
        reader="Blender Cycles, shader.tables: data[32 y + x], x = 31 sqrt(alpha), y = 31 mu",
        differences=(
            "Cycles holds E(mu = 1e-4) in its row mu = 0; this is the limit, which is 1: 0.0196 more at roughness 1/31",
            "both hold a mirror at roughness 0",
        ),
    )
}
