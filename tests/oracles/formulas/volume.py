"""What a volume scatters back: Lommel-Seeliger, Hapke, Hanrahan-Krueger; in phase angles, not in vectors."""

from __future__ import annotations

from typing import Any

import numpy as np

from tests.oracles.formulas.fresnel import exact
from tests.oracles.formulas.pair import Array, Pair

PI = np.pi


def henyey_greenstein(cosine: Array, g: float) -> Array:
    """Of mean 1."""
    return (1.0 - g * g) / (1.0 + g * g - 2.0 * g * cosine) ** 1.5


def lommel_seeliger(pair: Pair, p: dict[str, Any]) -> Array:
    """w/(4 pi)/(mu0 + mu)."""
    return p["w"] / (4.0 * PI) / (np.asarray(pair.light) + pair.view)


def chandrasekhar(x: Array | float, w: float, kind: str) -> Array:
    """Hapke's approximations of H."""
    x = np.asarray(x, dtype=float)
    gamma = np.sqrt(1.0 - w)
    if kind == "hapke1981":
        return (1.0 + 2.0 * x) / (1.0 + 2.0 * gamma * x)
    r0 = (1.0 - gamma) / (1.0 + gamma)
    return 1.0 / (1.0 - w * x * (r0 + (1.0 - 2.0 * r0 * x) / 2.0 * np.log((1.0 + x) / x)))


def hapke(pair: Pair, p: dict[str, Any]) -> Array:
    """cos(g) = 2 u^2 - 1 and tan(g/2) = sqrt(1 - u^2)/u, g the phase angle: 0 at opposition."""
    b, c = p["b"], p["c"]
    u = np.minimum(pair.u, 1.0)
    cos_g = 2.0 * u * u - 1.0
    phase = 0.5 * (1.0 + c) * henyey_greenstein(cos_g, b) + 0.5 * (1.0 - c) * henyey_greenstein(cos_g, -b)
    surge = p["B0"] / (1.0 + np.sqrt((1.0 - u) * (1.0 + u)) / u / p["h"])
    h = chandrasekhar(pair.light, p["w"], p["H"]) * chandrasekhar(pair.view, p["w"], p["H"])
    return lommel_seeliger(pair, p) * ((1.0 + surge) * phase + h - 1.0)


def hanrahan_krueger(pair: Pair, p: dict[str, Any]) -> Array:
    """Angles inside by Snell's law: the sine shrinks by eta, the azimuth stays; the medium scatters by pi - (their angle)."""
    eta, outside = p["eta"], [np.asarray(c) for c in (pair.light, pair.view)]
    sines = [np.sqrt((1.0 - c) * (1.0 + c)) / eta for c in outside]
    inside = [np.sqrt((1.0 - s) * (1.0 + s)) for s in sines]
    if eta == 1.0:
        inside = outside
    cosine = -(inside[0] * inside[1] + sines[0] * sines[1] * pair.cos_phi)
    through = (1.0 - exact(outside[0], eta)) * (1.0 - exact(outside[1], eta)) / eta**2
    depth = 1.0 - np.exp(-p["tau"] * (1.0 / inside[0] + 1.0 / inside[1]))
    return p["w"] * through * henyey_greenstein(cosine, p["g"]) / (4.0 * PI) / (inside[0] + inside[1]) * depth
