"""Kulla and Conty 2017: the albedo of GGX and its mean, from which their term of multiple scattering is made."""

from __future__ import annotations

from albedo_lab.lookup.formats import Layout
from albedo_lab.lookup.presets.preset import Preset

PRESETS = {
    "kulla-conty": Preset(
        name="E",
        mean="E_avg",
        model="ggx",
        quantity="albedo",
        axes=("roughness=32", "mu=32"),
        sampling="endpoints",
        fixed=(("G", "smith_correlated"), ("F", "one")),
        format="c",
        layout=Layout(),
        reader="the term of Kulla and Conty (2017): E[31 sqrt(alpha)][31 mu], E_avg[31 sqrt(alpha)]",
        differences=("the authors prescribe no layout; this is that of OSPRay and appleseed, the transpose of that of Cycles",),
    )
}
