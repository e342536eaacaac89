"""The colour of a model whose formula depends on the wavelength: its albedo at several, through an eye's colour matching."""

from __future__ import annotations

import itertools
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import numpy as np
import pandas as pd

from albedo_lab.analysis.albedo import Angles, albedo
from albedo_lab.analysis.request import effort, model_of, sequence
from albedo_lab.analysis.rows import Progress
from albedo_lab.errors import BadInput
from albedo_lab.model import Model, Parameter
from albedo_lab.optics.colour import encode, hexadecimal, in_gamut, srgb_weights, xyz_weights
from albedo_lab.optics.metals import PAPER_WAVELENGTHS

COMPONENTS = ("X", "Y", "Z", "R", "G", "B")
ENCODED = ("encoded_r", "encoded_g", "encoded_b")


def colour(
    model: Model | str,
    *,
    mu: Angles = None,
    theta: Angles = None,
    theta_deg: Angles = None,
    phi: Angles = None,
    phi_deg: Angles = None,
    wavelength: Sequence[float] = PAPER_WAVELENGTHS,
    illuminant: str = "D65",
    tolerance: float | None = None,
    method: str = "rqmc",
    seed: int = 0,
    threads: int | None = None,
    progress: Progress | None = None,
    **parameters: object,
) -> pd.DataFrame:
    """The colour of all the light that comes back from one direction: the albedo's spectrum in CIE 1931 XYZ and in sRGB.

    For models with a parameter `wavelength` in nm, as a named metal has.

    Parameters
    ----------
    model
        A Model, or a name of the catalogue.
    mu, theta, theta_deg, phi, phi_deg
        The direction of incidence, as `albedo` takes it.
    wavelength
        At least two, in nm; eight by default, as in neumann1999 section 7. The spectrum is linear between them and
        constant beyond (`albedo_lab.optics.colour`).
    illuminant
        "D65" or "E"; the perfect reflector is white, (1, 1, 1), under either.
    tolerance
        Half-width of the 95 % interval that every component of X, Y, Z and linear R, G, B reaches; by default 1e-5.
    method, seed, threads, progress
        As of `albedo`.
    parameters
        The model's parameters, choices among them, and `scale`; several values of several parameters make a grid.

    Returns
    -------
    DataFrame
        One row per cell: model, parameters but the wavelength, scale, theta_deg (and phi_deg), X, Y, Z, linear R, G, B, nothing
        clamped; encoded_r, encoded_g, encoded_b (IEC 61966-2-1), hex (the nearest that a screen shows), in_gamut (R, G, B within
        [0, 1], give or take their intervals); X_standard_error to B_standard_error, half_width (of the widest of their 95 %
        intervals), samples, method, seed, non_finite, order. All wavelengths share their random numbers, so that their errors are
        not independent: they are added as if all went the worst way.

    Raises
    ------
    BadInput
        For a model without such a parameter, for fewer than two wavelengths, and as `albedo` does.
    Inconclusive
        When the tolerance is out of reach.

    Examples
    --------
    >>> gold = colour("metal", metal="gold", n=1e4, theta_deg=[0, 80], method="quadrature")
    >>> gold.hex.tolist(), gold.in_gamut.tolist()
    (['#ffdca5', '#fbe8cb'], [False, True])
    """
    model = model_of(model)
    wavelengths = sequence("wavelength", wavelength)
    for member in _members(model, parameters):
        wavelengths = list(map(_wavelength_of(member).parse, wavelengths))
    weights = np.hstack([xyz_weights(wavelengths, illuminant), srgb_weights(wavelengths, illuminant)])
    want = effort(tolerance, method, seed, threads)
    tables = [
        albedo(
            model,
            mu=mu,
            theta=theta,
            theta_deg=theta_deg,
            phi=phi,
            phi_deg=phi_deg,
            tolerance=want.tolerance.absolute / float(np.abs(weights).sum(axis=0).max()),
            method=method,
            seed=seed,
            threads=threads,
            progress=_share_of(progress, done, len(wavelengths)),
            **parameters,
            wavelength=value,
        )
        for done, value in enumerate(wavelengths)
    ]
    return _coloured(tables, weights)


def _members(model: Model, parameters: Mapping[str, object]) -> Iterator[Model]:
    """Every member of the family that the choices among the parameters select."""
    words = {choice.name: sequence(choice.name, parameters[choice.name]) for choice in model.choices if choice.name in parameters}
    for values in itertools.product(*words.values()):
        yield model.member(dict(zip(words, values, strict=True)))[0]


def _wavelength_of(member: Model) -> Parameter:
    """The parameter that colours need. Raises BadInput."""
    for parameter in member.parameters:
        if parameter.name == "wavelength" and parameter.unit == "nm":
            return parameter
    raise BadInput("model", member.title, "must be one with a parameter `wavelength` in nm, such as a named metal")


def _share_of(progress: Progress | None, done: int, parts: int) -> Progress | None:
    """Progress of one of several equal parts, told as progress of the whole."""
    if progress is None:
        return None
    return lambda cells, of: progress(done * of + cells, parts * of)


def _coloured(tables: Sequence[pd.DataFrame], weights: np.ndarray[Any, np.dtype[np.float64]]) -> pd.DataFrame:
    """One table from those of all wavelengths, which agree in all that was asked but the wavelength."""
    first = tables[0]
    asked = [name for name in first.columns[: first.columns.get_loc("albedo")] if name != "wavelength"]
    made = first[asked].rename(columns={name: f"{name}_parameter" for name in COMPONENTS})

    def combined(name: str, by: np.ndarray[Any, np.dtype[np.float64]]) -> np.ndarray[Any, np.dtype[np.float64]]:
        spectra: np.ndarray[Any, np.dtype[np.float64]] = np.stack([table[name] for table in tables], axis=-1) @ by
        return spectra

    components = combined("albedo", weights)
    errors = combined("standard_error", np.abs(weights))
    for table in tables:
        table["half_width"] = np.maximum(table.ci95_high - table.albedo, table.albedo - table.ci95_low)
    half_widths = combined("half_width", np.abs(weights))
    linear = components[:, 3:]
    made[list(COMPONENTS)] = components
    made[list(ENCODED)] = encode(linear)
    made["hex"] = [hexadecimal(row) for row in encode(linear)]
    made["in_gamut"] = in_gamut(linear, half_widths[:, 3:] + 1e-9)
    made[[f"{name}_standard_error" for name in COMPONENTS]] = errors
    made["half_width"] = half_widths.max(axis=1)
    for name in ("samples", "non_finite"):
        made[name] = np.sum([table[name] for table in tables], axis=0)
    for name in ("method", "seed", "order"):
        made[name] = first[name]
    return made
