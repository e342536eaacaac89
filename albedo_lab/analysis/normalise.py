"""The largest constant that a model may carry before it creates energy."""

from __future__ import annotations

import math
from dataclasses import replace

import pandas as pd

from albedo_lab.analysis.constant import largest_constant
from albedo_lab.analysis.request import Effort, effort, grid, model_of, orders
from albedo_lab.analysis.rows import Progress, conclude, degrees_of, figures, label, parameter_columns, table, track
from albedo_lab.analysis.supremum import GRAZING, Supremum, supremum
from albedo_lab.errors import BadInput
from albedo_lab.estimate.methods import estimate
from albedo_lab.estimate.record import Estimate, Question, Tolerance
from albedo_lab.model import Model


def normalise(
    model: Model | str,
    *,
    tolerance: float | None = None,
    method: str = "quadrature",
    seed: int = 0,
    threads: int | None = None,
    progress: Progress | None = None,
    **parameters: object,
) -> pd.DataFrame:
    """The maximum of `scale`: the reciprocal of the supremum of the albedo over all directions of incidence, mu -> 0 included.

    Options and errors are those of `albedo`. Quadrature finds the place of the supremum and bounds what the place's error can
    hide; the method asked for measures the albedo there; the interval holds both errors. The default is quadrature here: it has
    to search anyway, and a supremum wants a bound rather than a chance of 95 %.

    Returns
    -------
    DataFrame
        One row per cell: model, parameters, constant, standard_error, ci95_low, ci95_high, samples, method, seed, non_finite,
        peak_theta_deg (90 stands for the limit), paper_constant (NaN where the source prints none), behaviour ("bounded", or
        "diverges": the albedo is unbounded at grazing angles, and no constant but 0 keeps the energy balance; "undefined": it is
        NaN somewhere), order, and peak_phi_deg for anisotropic models.

    Examples
    --------
    >>> table = normalise("ward", m=0.1)
    >>> float(table.constant[0]), table.behaviour[0]
    (0.0, 'diverges')
    """
    model = model_of(model)
    want = effort(tolerance, method, seed, threads)
    if "scale" in parameters:
        raise BadInput("scale", parameters["scale"], "is what normalise finds; leave it out")
    cells = [(member, p, order) for member, p, _ in list(grid(model, parameters)) for order in orders(member)]
    anisotropic = any(not member.isotropic(p) for member, p, _ in cells)
    rows = []
    for member, p, order in track(cells, progress):
        peak = supremum(member, p, order)
        head = parameter_columns(member, p, "constant")
        found = conclude(_measured(member, p, order, peak, want), want.tolerance, label(member, head))
        where = {"peak_theta_deg": degrees_of(peak.mu), "paper_constant": member.paper_constant(p)}
        how = {"behaviour": peak.behaviour, "order": order} | ({"peak_phi_deg": math.degrees(peak.phi)} if anisotropic else {})
        rows.append(({"model": member.name} | head, figures("constant", found) | where | how))
    return table(rows)


def _measured(model: Model, p: object, order: str, peak: Supremum, want: Effort) -> Estimate:
    """The constant, from an estimate of the albedo at its peak by the method asked for."""
    first = largest_constant(peak.value)
    if peak.behaviour != "bounded" or want.method == "quadrature" or math.isinf(first.value):
        return first
    mu = peak.mu or GRAZING[-1]
    spare = peak.location_error if peak.mu else peak.value.half_width
    allowed = want.tolerance.at(first.value) / first.value**2
    question = Question(model, p, mu, peak.phi, order)
    within = Tolerance(max(0.99 * allowed - spare, 0.5 * allowed))
    at_peak = estimate(question, within, want.method, want.seed, want.threads)
    below = 0.0 if peak.mu else spare
    return largest_constant(replace(at_peak, low=at_peak.low - below, high=at_peak.high + spare))
