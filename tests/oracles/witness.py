"""A third, very slow opinion: the printed formulas, literally, in 50-digit arithmetic.

`albedo_plain` and `albedo_lobe` share the half-angle identities of `tests.oracles.albedo`.  This module does not: it
forms R.V = 2 (N.L)(N.V) - L.V, H = (L + V)/|L + V|, tan(delta) and so on from the unit vectors with mpmath, where
cancellation costs nothing, and integrates over elevation and azimuth of the moving light.  Gauss-Legendre, 16 nodes to
a panel: panels of 1.5 lobe widths out to 12 widths, geometric panels towards the horizon.  For narrow lobes
(n >= 1000, m <= 0.03) only.
"""

from __future__ import annotations

import itertools

import numpy as np
from mpmath import mp, mpf

from tests.oracles.albedo import PHONG_MODELS, check_parameters


def literal_shape(model: str, light: list[mpf], view: list[mpf], par: dict[str, float]) -> mpf:
    """The shape f(L, V) as printed in neumann1999 (isotropic Ward)."""
    c_l, c_v = light[2], view[2]
    l_dot_v = sum(a * b for a, b in zip(light, view, strict=True))
    if model in PHONG_MODELS:
        base = l_dot_v if model == "retro_phong" else 2 * c_l * c_v - l_dot_v
        if base <= 0:
            return mpf(0)
        power = base ** mpf(par["n"])
    else:
        total = [a + b for a, b in zip(light, view, strict=True)]
        n_dot_h = total[2] / mp.sqrt(sum(a * a for a in total))
        if model == "schlick_isotropic":
            r = mpf(par["r"])
            zonal = r / (1 - (1 - r) * n_dot_h**2) ** 2
            return zonal / (4 * mp.pi) / ((r + (1 - r) * c_l) * (r + (1 - r) * c_v))
        if model in ("ward", "modified_ward"):
            m = mpf(par["m_x"])
            power = mp.exp(-(1 / n_dot_h**2 - 1) / m**2) / (4 * mp.pi * m**2)
        else:
            power = n_dot_h ** mpf(par["n"])
    if model in ("phong", "blinn"):
        return power
    if model in ("stretched_phong", "retro_phong", "stretched_blinn", "modified_ward"):
        return power / max(c_l, c_v)
    if model in ("plus_phong", "plus_blinn"):
        return power * 2 / (c_l + c_v)
    if model == "product_phong":
        return power / (c_l * c_v)
    if model in ("sqrt_phong", "ward"):
        return power / mp.sqrt(c_l * c_v)
    if model == "p_phong":
        return power / max(c_l, c_v) ** mpf(par["p"])
    if model == "phong_original":
        return power / c_l
    raise ValueError(f"unknown model {model!r}")


def _nodes(cuts: list[mpf]) -> list[tuple[mpf, mpf]]:
    """16-point Gauss-Legendre nodes and weights on the consecutive intervals of `cuts`."""
    x, w = np.polynomial.legendre.leggauss(16)
    pairs = [(mpf(float(a)), mpf(float(b))) for a, b in zip(x, w, strict=True)]
    intervals = [(a, b) for a, b in itertools.pairwise(cuts) if b > a]
    return [(a + (b - a) * (1 + t) / 2, (b - a) * v / 2) for a, b in intervals for t, v in pairs]


def witness(model: str, mu: float, **parameters: float) -> float:
    """Albedo of a narrow-lobed isotropic shape, viewer fixed, in 50 digits (the quadrature is good to some 1e-14)."""
    par = check_parameters(model, parameters)
    with mp.workdps(50):
        c_v = mpf(mu)
        s_v = mp.sqrt(1 - c_v**2)
        e_v = mp.asin(c_v)
        half_vector = model not in PHONG_MODELS
        # widths: (R.V)^n ~ exp(-n alpha^2/2); N.H: delta ~ m or 1/sqrt(n), delta being half the difference in elevation
        delta_width = mpf(par["m_x"]) if "m_x" in par else 1 / mp.sqrt(mpf(par["n"]))
        width = 2 * delta_width if half_vector else delta_width
        cuts = [mpf(0), *(e_v / mpf(3) ** k for k in range(24, 0, -1)), e_v]
        reach = e_v
        while reach < mp.pi / 2 and reach < e_v + 12 * width:
            reach += min(mpf(3) / 2 * width, 2 * reach)
            cuts.append(min(reach, mp.pi / 2))
        cuts = [e for e in cuts if e >= e_v - 12 * width]
        cuts += [e_v - mpf(3) / 2 * k * width for k in range(1, 9)]
        cuts = sorted(e for e in cuts if e >= 0)
        total = mpf(0)
        for e, e_weight in _nodes(cuts):
            z, s_l = mp.sin(e), mp.cos(e)
            azimuth_width = delta_width * (z + c_v) / mp.sqrt(s_l * s_v) if half_vector else width / mp.sqrt(s_l * s_v)
            step = min(mpf(3) / 2 * azimuth_width, mp.pi / 8)
            inner = mpf(0)
            for t, t_weight in _nodes([step * k for k in range(9)]):
                sign = 1 if model == "retro_phong" else -1
                light = [sign * s_l * mp.cos(t), s_l * mp.sin(t), z]
                inner += t_weight * literal_shape(model, light, [s_v, mpf(0), c_v], par)
            total += e_weight * z * s_l * 2 * inner
        return float(total)
