"""MaterialX: the directional albedo of GGX for Schlick's reflectance, over mu and alpha itself."""

from __future__ import annotations

from albedo_lab.lookup.formats import Layout
from albedo_lab.lookup.presets.preset import Preset

PRESETS = {
    "materialx": Preset(
        name="albedo_table",
        mean=None,
        model="ggx",
        quantity="split-sum",
        axes=("alpha=64", "mu=64"),
        sampling="centres",
        fixed=(("G", "smith_correlated"), ("F", "schlick")),
        format="exr",
        layout=Layout(),
        reader="MaterialX, mx_ggx_dir_albedo_table_lookup: texture at (mu, alpha); E = F0 R + F90 G",
        differences=("MaterialX's own has 64 samples a cell, which leave noise of about 1e-2, and the albedo of a sheen in B",),
    )
}
