"""OpenPBR, as Adobe implements it: what GGX loses, 1 - E, for its term of multiple scattering."""

from __future__ import annotations

from albedo_lab.lookup.formats import Layout
from albedo_lab.lookup.presets.preset import Preset

PRESETS = {
    "openpbr": Preset(
        name="ideal_metal_energy_complement",
        mean="ideal_metal_average_energy_complement",
        model="ggx",
        quantity="energy-loss",
        axes=("sqrt(alpha)=32", "mu=32"),
        sampling="endpoints",
        fixed=(("G", "smith"), ("F", "one")),
        format="u16",
        layout=Layout(),
        reader="openpbr-bsdf: value / 65535 at [31 sqrt(alpha)][31 mu]; its masking is Smith's of both directions by themselves",
        differences=(
            "its own table has E(mu = 1e-3) in the column mu = 0; this is the limit, which is below 1 for this masking",
            "OpenPBR itself prescribes no table",
        ),
    )
}
