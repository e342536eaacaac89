"""From a reflectance spectrum to a colour: CIE 1931 XYZ, linear sRGB and encoded sRGB (IEC 61966-2-1:1999).

Nothing is clamped: a colour outside the gamut keeps its negative or too large components, and `in_gamut` tells.

Between its samples a spectrum is taken as linear, beyond the outermost as constant; XYZ is the sum over 380 to 780 nm in steps of
5 nm, divided so that the perfect reflector has Y = 1. Its X and Z are those of the illuminant. Linear sRGB is for an eye adapted
to the illuminant: Bradford's transform takes its white to the white of sRGB, so the perfect reflector is (1, 1, 1) under any
illuminant. For D65 that undoes no more than rounding: its tabulated white is 2e-4 off the one that the four digits of the
standard's matrix imply.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from albedo_lab.errors import BadInput
from albedo_lab.optics.data import columns

Array = NDArray[np.float64]

ILLUMINANTS = ("D65", "E")
"""Daylight, and the same power at every wavelength."""

XYZ_OF_SRGB = np.array([[0.4124, 0.3576, 0.1805], [0.2126, 0.7152, 0.0722], [0.0193, 0.1192, 0.9505]])
"""Linear sRGB to XYZ (IEC 61966-2-1:1999); the way back is its inverse, not the printed one, which is rounded once more."""

BRADFORD = np.array([[0.8951, 0.2664, -0.1614], [-0.7502, 1.7135, 0.0367], [0.0389, -0.0685, 1.0296]])
"""XYZ to the cone responses in which whites are exchanged (Lam 1985; ICC.1:2022, annex E)."""

LINEAR_BELOW = 0.0031308


def xyz_weights(wavelengths: ArrayLike, illuminant: str = "D65") -> Array:
    """What each sample of a spectrum contributes to X, Y and Z; shape (samples, 3).

    `wavelengths` in nm, in any order. XYZ is linear in the samples, so errors of the samples propagate through these weights.
    Raises BadInput for fewer than 2 wavelengths, for equal or non-positive ones, and for an unknown illuminant.
    """
    given = np.asarray(wavelengths, dtype=np.float64)
    if given.ndim != 1 or len(given) < 2 or len(np.unique(given)) < len(given) or not np.all((given > 0.0) & (given < np.inf)):
        raise BadInput("wavelength", wavelengths, "must be at least 2 different wavelengths in nm")
    grid, *_ = columns("cie1931")
    order = np.argsort(given)
    share = np.empty((len(grid), len(given)))
    for sample, place in enumerate(order):
        share[:, place] = np.interp(grid, given[order], np.arange(len(given)) == sample)
    return share.T @ _observed(illuminant)


def srgb_weights(wavelengths: ArrayLike, illuminant: str = "D65") -> Array:
    """What each sample of a spectrum contributes to linear R, G and B; shape (samples, 3)."""
    return xyz_weights(wavelengths, illuminant) @ _srgb_of_xyz(illuminant).T


def xyz(wavelengths: ArrayLike, reflectance: ArrayLike, illuminant: str = "D65") -> Array:
    """CIE 1931 XYZ of reflectance spectra of shape (..., samples); shape (..., 3), Y = 1 for the perfect reflector."""
    return np.asarray(reflectance, dtype=np.float64) @ xyz_weights(wavelengths, illuminant)


def white(illuminant: str = "D65") -> Array:
    """XYZ of the perfect reflector under an illuminant; shape (3,)."""
    total: Array = _observed(illuminant).sum(axis=0)
    return total


def linear_srgb(xyz: ArrayLike, illuminant: str = "D65") -> Array:
    """Linear sRGB of colours (..., 3) given in XYZ, for an eye that is adapted to the illuminant."""
    return np.asarray(xyz, dtype=np.float64) @ _srgb_of_xyz(illuminant).T


def xyz_of_srgb(linear: ArrayLike, illuminant: str = "D65") -> Array:
    """Inverse of linear_srgb."""
    return np.asarray(linear, dtype=np.float64) @ np.linalg.inv(_srgb_of_xyz(illuminant)).T


def encode(linear: ArrayLike) -> Array:
    """The transfer function of IEC 61966-2-1, component by component; below 0 its linear piece goes on.

    Examples
    --------
    >>> encode([0.0, 0.001, 1.0]).round(6).tolist()
    [0.0, 0.01292, 1.0]
    """
    v = np.asarray(linear, dtype=np.float64)
    encoded: Array = np.where(v <= LINEAR_BELOW, 12.92 * v, 1.055 * np.maximum(v, LINEAR_BELOW) ** (1.0 / 2.4) - 0.055)
    return encoded


def decode(encoded: ArrayLike) -> Array:
    """Inverse of encode."""
    v = np.asarray(encoded, dtype=np.float64)
    linear: Array = np.where(v <= 0.04045, v / 12.92, ((np.maximum(v, 0.04045) + 0.055) / 1.055) ** 2.4)
    return linear


def in_gamut(linear: ArrayLike, allowance: ArrayLike = 1e-9) -> NDArray[np.bool_]:
    """Whether colours (..., 3) in linear sRGB can be shown: all components within [0, 1], give or take the allowance."""
    v = np.asarray(linear, dtype=np.float64)
    inside: NDArray[np.bool_] = np.all((v >= -np.asarray(allowance)) & (v <= 1.0 + np.asarray(allowance)), axis=-1)
    return inside


def hexadecimal(encoded: ArrayLike) -> str:
    """One colour (3,) in encoded sRGB as a screen is told it: #rrggbb, the nearest of 256 steps, ends included; empty for NaN.

    Examples
    --------
    >>> hexadecimal([1.0, 0.5, 0.0])
    '#ff8000'
    """
    v = np.asarray(encoded, dtype=np.float64)
    steps = np.rint(255.0 * np.clip(v, 0.0, 1.0))
    return "" if np.isnan(v).any() else "#" + "".join(f"{int(step):02x}" for step in steps)


def _observed(illuminant: str) -> Array:
    """What each wavelength of the grid contributes to X, Y and Z under an illuminant; the middle column sums to 1."""
    if illuminant not in ILLUMINANTS:
        raise BadInput("illuminant", illuminant, f"must be one of {', '.join(ILLUMINANTS)}")
    _, *matching = columns("cie1931")
    power = columns("d65")[1] if illuminant == "D65" else np.ones(len(matching[0]))
    weighted = np.stack(matching, axis=1) * power[:, None]
    observed: Array = weighted / weighted[:, 1].sum()
    return observed


def _srgb_of_xyz(illuminant: str) -> Array:
    """XYZ under an illuminant to linear sRGB."""
    seen, shown = BRADFORD @ white(illuminant), BRADFORD @ XYZ_OF_SRGB.sum(axis=1)
    adapted = np.linalg.inv(BRADFORD) @ np.diag(shown / seen) @ BRADFORD
    found: Array = np.linalg.inv(XYZ_OF_SRGB) @ adapted
    return found
