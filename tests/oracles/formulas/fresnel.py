"""Unpolarised Fresnel reflectance against the cosine of the angle of incidence."""

from __future__ import annotations

from typing import Any

import numpy as np

from tests.oracles.formulas.pair import Array


def exact(c: Array | float, eta: float, k: float = 0.0) -> Array:
    """Fresnel's equations for light from vacuum onto the complex index N = eta + i k (k = 0: a dielectric).

    r_s = (cos - w)/(cos + w), r_p = (N^2 cos - w)/(N^2 cos + w), w = N cos(theta_t) = sqrt(N^2 - sin^2).
    """
    c = np.asarray(c, dtype=float)
    n2 = complex(eta, k) ** 2
    if k == 0.0 and eta >= 1.0:
        n2 = eta**2
        w = np.sqrt(n2 - (1.0 - c * c))
    else:
        w = np.sqrt(n2 - (1.0 - c * c).astype(complex))
    r_s = (c - w) / (c + w)
    r_p = (n2 * c - w) / (n2 * c + w)
    return 0.5 * (np.abs(r_s) ** 2 + np.abs(r_p) ** 2)


def schlick(c: Array | float, f0: float) -> Array:
    """schlick1993 eq. 11, nuaj_models eq. 5."""
    return f0 + (1.0 - f0) * (1.0 - np.asarray(c, dtype=float)) ** 5


def reflectance(kind: str, c: Array | float, p: dict[str, Any]) -> Array:
    """The Fresnel factor named by a model's choice."""
    if kind == "one":
        return np.ones_like(np.asarray(c, dtype=float))
    if kind == "schlick":
        return schlick(c, p["F0"])
    if kind == "dielectric":
        return exact(c, p["eta"])
    if kind in ("exact", "conductor"):
        return exact(c, p["eta"], p.get("k", 0.0))
    raise ValueError(f"unknown Fresnel factor {kind!r}")


def losasso_exact(c: Array, n: float) -> Array:
    """losasso, Appendix A, as printed: the "- 1" of g stands outside the root."""
    g = np.sqrt(n * n + c * c) - 1.0
    return 0.5 * ((g - c) / (g + c)) ** 2 * (1.0 + ((c * (g + c) - 1.0) / (c * (g - c) + 1.0)) ** 2)


def losasso_cheap(n_dot_e: Array | float, n: float) -> Array:
    """losasso, Appendix A, as printed: N.E instead of L.H, and the two ends exchanged (1 at normal view, n at grazing)."""
    x = (1.0 - np.asarray(n_dot_e, dtype=float)) ** 5
    return (1.0 - x) + n * x
