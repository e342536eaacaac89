"""Mean albedo: which share of uniform light from the whole hemisphere comes back."""

from __future__ import annotations

import pandas as pd

from albedo_lab.analysis.albedo import shape_estimate
from albedo_lab.analysis.constant import constant
from albedo_lab.analysis.request import effort, grid, model_of, orders
from albedo_lab.analysis.rows import Progress, conclude, figures, label, parameter_columns, table, track
from albedo_lab.estimate.record import Question
from albedo_lab.model import Model


def mean_albedo(
    model: Model | str,
    *,
    tolerance: float | None = None,
    method: str = "rqmc",
    seed: int = 0,
    threads: int | None = None,
    progress: Progress | None = None,
    **parameters: object,
) -> pd.DataFrame:
    """Mean albedo 2 ∫ a(mu) mu dmu, averaged over the azimuth (neumann1999 eq. 33), for a grid of parameters.

    Options and errors are those of `albedo`. The direction of incidence is one more dimension of the integral,
    not a sum over a grid of angles, and its error is in the interval.

    Returns
    -------
    DataFrame
        One row per cell: model, parameters, scale, mean_albedo, standard_error, ci95_low, ci95_high, samples, method, seed,
        non_finite, order.

    Examples
    --------
    >>> float(round(mean_albedo("phong", n=1, method="quadrature").mean_albedo[0], 3))
    0.737
    """
    model = model_of(model)
    want = effort(tolerance, method, seed, threads)
    cells = [(member, p, scale, order) for member, p, scale in list(grid(model, parameters)) for order in orders(member)]
    rows = []
    for member, p, given, order in track(cells, progress):
        scale = constant(member, p, given)
        head = parameter_columns(member, p, "mean_albedo") | {"scale": scale.value}
        shape = shape_estimate(Question(member, p, None, order=order), scale, want)
        found = conclude(shape.scaled(scale), want.tolerance, label(member, head))
        rows.append(({"model": member.name} | head, figures("mean_albedo", found) | {"order": order}))
    return table(rows)
