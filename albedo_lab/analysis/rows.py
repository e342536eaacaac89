"""Rows of a table: what stands in them, in which order, and when a figure is good enough to stand there."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any

import pandas as pd

from albedo_lab.errors import Inconclusive
from albedo_lab.estimate.record import Estimate, Tolerance
from albedo_lab.model import Model

Progress = Callable[[int, int], None]
LAST_ASKED = ("scale", "theta_deg", "phi_deg")
"""What follows the parameters in every table."""


def table(rows: Sequence[tuple[Mapping[str, Any], Mapping[str, Any]]]) -> pd.DataFrame:
    """Rows, each told as what was asked and what was found, as a DataFrame.

    Members of one family may differ in their parameters: a column that a row lacks is empty there, and stands beside the other
    things asked.
    """
    asked = dict.fromkeys(name for head, _ in rows for name in head)
    found = dict.fromkeys(name for _, body in rows for name in body)
    last = [name for name in LAST_ASKED if name in asked]
    order = [*(name for name in asked if name not in last), *last, *found]
    return pd.DataFrame([{**head, **body} for head, body in rows], columns=order)


def parameter_columns(model: Model, p: Any, quantity: str) -> dict[str, Any]:
    """A column per parameter; one that bears the quantity's name, as Lambert's albedo does, is called `<name>_parameter`."""
    return {f"{name}_parameter" if name == quantity else name: value for name, value in model.columns(p).items()}


def figures(quantity: str, e: Estimate) -> dict[str, Any]:
    """The columns of a quantity, in the order that every table has."""
    return {
        quantity: e.value,
        "standard_error": e.standard_error,
        "ci95_low": e.low,
        "ci95_high": e.high,
        "samples": e.samples,
        "method": e.method,
        "seed": e.seed,
        "non_finite": e.non_finite,
    }


def degrees_of(mu: float) -> float:
    """The angle of a cosine, in degrees, without the digits that arccos would lose near the normal."""
    return math.degrees(math.atan2(math.sqrt((1.0 - mu) * (1.0 + mu)), mu))


def conclude(e: Estimate, tolerance: Tolerance, cell: str) -> Estimate:
    """The estimate, when it is as narrow as asked; one that holds non-finite weights is a finding and passes as well.

    Raises Inconclusive.
    """
    if e.reaches(tolerance) or e.non_finite or not math.isfinite(e.value):
        return e
    raise Inconclusive(
        f"tolerance = {tolerance.at(e.value):g}: not reached within the budget at {cell}: "
        f"half-width {e.half_width:.2g} about {e.value:.6g} after {e.samples} evaluations"
    )


def label(model: Model, row: Mapping[str, Any]) -> str:
    """A cell in words, for a message."""
    words = (f"{name} = {value:g}" if isinstance(value, int | float) else f"{name} = {value}" for name, value in row.items())
    return ", ".join([model.name, *words])


def track(cells: Sequence[Any], progress: Progress | None) -> Iterator[Any]:
    """The cells one by one, with progress told."""
    for done, cell in enumerate(cells):
        if progress is not None:
            progress(done, len(cells))
        yield cell
    if progress is not None:
        progress(len(cells), len(cells))
