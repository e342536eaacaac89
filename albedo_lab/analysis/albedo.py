"""Directional albedo: which share of the light from one direction comes back."""

from __future__ import annotations

import math
from collections.abc import Sequence

import pandas as pd

from albedo_lab.analysis.constant import constant
from albedo_lab.analysis.request import Effort, effort, grid, model_of, orders, sequence
from albedo_lab.analysis.rows import Progress, conclude, degrees_of, figures, label, parameter_columns, table, track
from albedo_lab.errors import BadInput
from albedo_lab.estimate.methods import estimate
from albedo_lab.estimate.record import Estimate, Question, exact
from albedo_lab.model import Model

Angles = float | Sequence[float] | None
SMALLEST_MU = 1e-20
"""Far below the last angle that is a double (2e-16), far above where squares and quotients leave the range of doubles."""


def albedo(
    model: Model | str,
    *,
    mu: Angles = None,
    theta: Angles = None,
    theta_deg: Angles = None,
    phi: Angles = None,
    phi_deg: Angles = None,
    tolerance: float | None = None,
    method: str = "rqmc",
    seed: int = 0,
    threads: int | None = None,
    progress: Progress | None = None,
    **parameters: object,
) -> pd.DataFrame:
    """Directional albedo a(theta, phi): f_r cos integrated over the hemisphere (neumann1999 eq. 2), for a grid of parameters.

    Parameters
    ----------
    model
        A Model, or a name of the catalogue.
    mu, theta, theta_deg
        The direction of incidence, by exactly one of its cosine in [1e-20, 1], its angle from the normal in radians in
        [0, pi/2), or in degrees in [0, 90); one value or several. Near grazing only mu keeps its digits.
    phi, phi_deg
        Its azimuth in radians or degrees, 0 by default; one value or several. Reported where the model is anisotropic.
    tolerance
        Half-width of the 95 % interval that every cell reaches; by default 1e-5, relative for figures above 1.
    method
        "rqmc", "mc" or "quadrature".
    seed, threads
        The same seed gives the same bits, whatever the number of threads.
    progress
        Called with the number of cells done and the number of all, while they are worked on.
    parameters
        The model's parameters and `scale`; several values of several parameters make a grid, the first varying slowest.

    Returns
    -------
    DataFrame
        One row per cell: model, parameters, scale, theta_deg (and phi_deg), albedo, standard_error, ci95_low, ci95_high, samples,
        method, seed, non_finite, order. A model that is not reciprocal has a row for each order of integration.

    Raises
    ------
    BadInput
        For a name, a value or an option outside its domain.
    Inconclusive
        When the tolerance is out of reach.

    Examples
    --------
    >>> float(round(albedo("lambert", theta_deg=60, albedo=0.5).albedo[0], 6))
    0.5
    """
    model = model_of(model)
    want = effort(tolerance, method, seed, threads)
    elevations = _elevations(mu, theta, theta_deg)
    azimuths = _azimuths(phi, phi_deg)
    cells = [
        (member, p, scale, elevation, azimuth, order)
        for member, p, scale in list(grid(model, parameters))
        for elevation in elevations
        for azimuth in (azimuths if not member.isotropic(p) else azimuths[:1])
        for order in orders(member)
    ]
    anisotropic = any(not member.isotropic(p) for member, p, *_ in cells)
    rows = []
    for member, p, given, (cosine, degrees), (angle, angle_deg), order in track(cells, progress):
        scale = constant(member, p, given)
        where = {"scale": scale.value, "theta_deg": degrees} | ({"phi_deg": angle_deg} if anisotropic else {})
        head = parameter_columns(member, p, "albedo") | where
        question = Question(member, p, cosine, angle, order)
        shape = shape_estimate(question, scale, want)
        found = conclude(shape.scaled(scale), want.tolerance, label(member, head))
        rows.append(({"model": member.name} | head, figures("albedo", found) | {"order": order}))
    return table(rows)


def shape_estimate(question: Question, scale: Estimate, want: Effort) -> Estimate:
    """The shape's albedo, so precisely that the scaled one reaches the tolerance whatever the scale's own error leaves of it."""
    if scale.value == 0.0:
        return exact(0.0, want.method)
    lost = 2.0 * scale.half_width / scale.value / want.tolerance.absolute
    share = 1.0 - min(0.5, lost)
    return estimate(question, want.tolerance.over(scale.value / share), want.method, want.seed, want.threads)


def _elevations(mu: Angles, theta: Angles, theta_deg: Angles) -> list[tuple[float, float]]:
    """Every direction of incidence as its cosine and its angle in degrees."""
    given = {name: value for name, value in (("mu", mu), ("theta", theta), ("theta_deg", theta_deg)) if value is not None}
    if len(given) != 1:
        raise BadInput("theta", None if not given else list(given), "give exactly one of mu, theta and theta_deg")
    ((name, values),) = given.items()
    found = []
    for value in sequence(name, values):
        number = _number(value)
        inside, domain = {
            "mu": (SMALLEST_MU <= number <= 1.0, f"must be in [{SMALLEST_MU:g}, 1]"),
            "theta": (0.0 <= number < math.pi / 2, "must be in [0, pi/2) radians"),
            "theta_deg": (0.0 <= number < 90.0, "must be in [0, 90) degrees"),
        }[name]
        if not inside:
            raise BadInput(name, value, domain)
        if name == "mu":
            found.append((number, degrees_of(number)))
        elif name == "theta":
            found.append((math.cos(number), math.degrees(number)))
        else:
            found.append((math.sin(math.radians(90.0 - number)), number))
    return found


def _azimuths(phi: Angles, phi_deg: Angles) -> list[tuple[float, float]]:
    """Every azimuth in radians and degrees."""
    if phi is not None and phi_deg is not None:
        raise BadInput("phi", phi, "give only one of phi and phi_deg")
    name, values = ("phi", phi) if phi is not None else ("phi_deg", 0.0 if phi_deg is None else phi_deg)
    found = []
    for value in sequence(name, values):
        number = _number(value)
        pair = (number, math.degrees(number)) if name == "phi" else (math.radians(number), number)
        if not abs(pair[1]) <= 360.0:
            raise BadInput(name, value, "must be within one turn, [-2 pi, 2 pi] radians or [-360, 360] degrees")
        found.append(pair)
    return found


def _number(value: object) -> float:
    """The value as a float; NaN, which is in no domain, when it is none."""
    try:
        return float(value)  # type: ignore[arg-type]
    except (TypeError, ValueError):
        return math.nan
