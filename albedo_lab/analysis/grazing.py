"""How the albedo ends at grazing incidence: a ~ K mu^s as mu -> 0, with an interval on s, and the limit where there is one.

Quadrature gives a(mu) once a decade, to ten digits where the model allows it. The exponents between successive decades are a
sequence of their own, and it is extrapolated twice: as one that settles geometrically, which powers of mu make of it, and as
one that settles like 1 / log mu, which logarithms do. The interval spans the last exponent and both extrapolations, and as much
again.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import lru_cache
from itertools import pairwise
from typing import Any

import pandas as pd

from albedo_lab.analysis.constant import constant
from albedo_lab.analysis.request import effort, grid, model_of, orders, sequence
from albedo_lab.analysis.rows import Progress, conclude, figures, label, parameter_columns, table, track
from albedo_lab.analysis.trust import LEVELS, trusted
from albedo_lab.analysis.verdict import Finding, Subject, Trial, Verdict
from albedo_lab.errors import BadInput
from albedo_lab.estimate.quadrature import quadrature
from albedo_lab.estimate.record import Estimate, Question, Tolerance, bounded
from albedo_lab.model import Model

DECADES = tuple(range(2, 13))
"""mu = 10^-2 to 10^-12."""
BUDGET = 1 << 24
FEWEST = 4
"""Decades without which no extrapolation is tried."""
GEOMETRIC = 0.7
"""Ratio of successive steps up to which a sequence is taken to settle like a power of mu (mu^0.16 and higher)."""
LN10 = math.log(10.0)


@dataclass(frozen=True, slots=True)
class GrazingLaw:
    """a ~ K mu^s: `exponent` is s with its interval, `limit` that of the albedo, with the constant `scale` in it.

    `behaviour` is "bounded" (with a limit that is not 0), "vanishes", "diverges"; "undefined" where the albedo is not finite, and
    "undecided" where no more can be said. A limit known to be 0 or infinite has no error.
    """

    exponent: Estimate
    behaviour: str
    limit: float
    limit_error: float

    def __str__(self) -> str:
        s = self.exponent
        power = f"a ~ mu^s with s = {s.value:.6g} +- {s.half_width:.1g}"
        if self.behaviour == "bounded":
            return f"bounded: a -> {self.limit:.9g} +- {self.limit_error:.2g} as mu -> 0; {power}"
        return f"{self.behaviour} as mu -> 0; {power}" if math.isfinite(s.value) else f"{self.behaviour} as mu -> 0"


def law(subject: Subject, order: str = "wi", phi: float = 0.0, budget: int = BUDGET) -> GrazingLaw:
    """The law of a subject's albedo at grazing incidence from the azimuth phi (radians)."""
    model, scale = trusted(subject.model, subject.p), subject.scale
    shape = _shape_law(model, subject.p, order, phi, budget)
    if not math.isfinite(shape.limit):
        return replace(shape, limit=shape.limit * math.copysign(1.0, scale.value) if scale.value else math.nan)
    error = shape.limit_error * abs(scale.value) + (abs(shape.limit) + shape.limit_error) * scale.half_width
    return replace(shape, limit=shape.limit * scale.value, limit_error=error)


def grazing_check(subject: Subject, trial: Trial) -> list[Finding]:
    """What the albedo does at grazing incidence, in every order that counts: told, not judged."""
    found = []
    for order in orders(subject.model):
        seen = law(subject, order, budget=trial.budget)
        told = str(seen) if subject.model.reciprocal else f"{seen}, integrated over {order}"
        details = {"order": order, "behaviour": seen.behaviour, "limit": seen.limit, "limit_error": seen.limit_error}
        details |= {"ci95_low": seen.exponent.low, "ci95_high": seen.exponent.high}
        found.append(Finding("grazing", Verdict.REPORTED, seen.exponent.value, math.nan, told, details=details))
    return found


def grazing(
    model: Model | str,
    *,
    phi_deg: float | Sequence[float] = 0.0,
    tolerance: float | None = None,
    method: str = "quadrature",
    seed: int = 0,
    threads: int | None = None,
    progress: Progress | None = None,
    **parameters: object,
) -> pd.DataFrame:
    """The behaviour of the albedo at grazing incidence, a ~ K mu^s as mu -> 0, for a grid of parameters.

    Parameters
    ----------
    model
        A Model, or a name of the catalogue.
    phi_deg
        Azimuth of incidence in degrees, one or several; reported where the model is anisotropic.
    tolerance
        Half-width of the interval on s that every cell must reach; by default it is as wide as it comes out.
    method
        "quadrature": no other reaches mu = 1e-12 with the digits that an exponent needs.
    seed, threads, progress
        As in `albedo`; quadrature needs neither of the first two.
    parameters
        The model's parameters and `scale`; several values of several parameters make a grid, the first varying slowest.

    Returns
    -------
    DataFrame
        One row per cell: model, parameters, scale (and phi_deg), exponent, standard_error, ci95_low, ci95_high, samples, method,
        seed, behaviour ("bounded", "vanishes", "diverges"; "undefined" where the albedo is not finite, "undecided" where no more
        can be said), limit, limit_error, order.

    Raises
    ------
    BadInput
        For a name, a value or an option outside its domain.
    Inconclusive
        When a tolerance is given and out of reach.

    Examples
    --------
    >>> table = grazing("ward", m=0.1)
    >>> float(round(table.exponent[0], 6)), table.behaviour[0]
    (-0.5, 'diverges')
    """
    model = model_of(model)
    want = effort(tolerance, method, seed, threads)
    if method != "quadrature":
        raise BadInput("method", method, "must be quadrature: no other reaches grazing incidence with enough digits")
    azimuths = [_azimuth(value) for value in sequence("phi_deg", phi_deg)]
    cells = [
        (member, p, scale, azimuth, order)
        for member, p, scale in list(grid(model, parameters))
        for azimuth in (azimuths if not member.isotropic(p) else azimuths[:1])
        for order in orders(member)
    ]
    anisotropic = any(not member.isotropic(p) for member, p, *_ in cells)
    rows = []
    for member, p, given, azimuth, order in track(cells, progress):
        subject = Subject(member, p, constant(member, p, given))
        head = parameter_columns(member, p, "exponent") | {"scale": subject.scale.value}
        head |= {"phi_deg": azimuth} if anisotropic else {}
        seen = law(subject, order, math.radians(azimuth))
        if tolerance is not None:
            conclude(seen.exponent, want.tolerance, label(member, head))
        figure = figures("exponent", seen.exponent)
        del figure["non_finite"]
        how = {"behaviour": seen.behaviour, "limit": seen.limit, "limit_error": seen.limit_error, "order": order}
        rows.append(({"model": member.name} | head, figure | how))
    return table(rows)


def _azimuth(value: object) -> float:
    """An azimuth in degrees. Raises BadInput."""
    try:
        number = float(value)  # type: ignore[arg-type]
    except (TypeError, ValueError):
        number = math.nan
    if not abs(number) <= 360.0:
        raise BadInput("phi_deg", value, "must be within one turn, [-360, 360] degrees")
    return number


@lru_cache(maxsize=4096)
def _shape_law(model: Model, p: Any, order: str, phi: float, budget: int) -> GrazingLaw:
    """The law of the shape (scale = 1)."""
    a, samples = _by_decades(model, p, order, phi, budget)
    unknown = bounded(math.nan, math.nan, samples, "quadrature")
    if not all(math.isfinite(e.value) and math.isfinite(e.half_width) for e in a):
        return GrazingLaw(unknown, "undefined", math.nan, math.nan)
    if all(e.value == 0.0 == e.half_width for e in a):
        return GrazingLaw(unknown, "vanishes", 0.0, 0.0)
    s, noise = _local_exponents(a)
    if len(s) < FEWEST:
        gone = len(a) == len(DECADES) and a[-1].value == 0.0 == a[-1].half_width
        return GrazingLaw(unknown, "vanishes" if gone else "undecided", 0.0 if gone else math.nan, 0.0 if gone else math.nan)
    places = [k + 0.5 for k in DECADES[: len(a)]][-len(s) :]
    exponent = replace(_settled(s, noise, places), samples=samples)
    if exponent.high < 0.0:
        return GrazingLaw(exponent, "diverges", math.copysign(math.inf, a[-1].value), 0.0)
    if exponent.low > 0.0:
        return GrazingLaw(exponent, "vanishes", 0.0, 0.0)
    return GrazingLaw(exponent, *_level(a, s, places))


def _by_decades(model: Model, p: Any, order: str, phi: float, budget: int) -> tuple[list[Estimate], int]:
    """The albedo at every decade, as precisely as can be had, and the evaluations that it took."""
    best: list[Estimate] = []
    samples = 0
    for relative in LEVELS:
        found: list[Estimate] = []
        within = Tolerance(0.0, max(relative, model.smooth_in.finest))
        for k in DECADES:
            e = quadrature(Question(model, p, 10.0**-k, phi, order), within)
            found.append(e)
            samples += e.samples
            if e.samples * len(DECADES) > budget:
                break
        # a level that is given up is still worth having if it is the first
        if len(found) < len(DECADES):
            return best or found, samples
        best = found
        if relative < within.relative or not all(e.reaches(within) for e in found):
            break
    return best, samples


def _local_exponents(a: Sequence[Estimate]) -> tuple[list[float], list[float]]:
    """Exponents between successive decades and the bounds of their noise: as many of the last ones as have a sign."""
    s: list[float] = []
    noise: list[float] = []
    for before, after in pairwise(a):
        if not before.value * after.value > 0.0 or before.low * before.high <= 0.0 or after.low * after.high <= 0.0:
            s, noise = [], []
            continue
        s.append(math.log(before.value / after.value) / LN10)
        noise.append((before.half_width / abs(before.value) + after.half_width / abs(after.value)) / LN10)
    return s, noise


def _settled(s: Sequence[float], noise: Sequence[float], places: Sequence[float]) -> Estimate:
    """Where a sequence of local exponents settles."""
    last, step = s[-1], s[-1] - s[-2]
    harmonic = last + places[-2] * step
    geometric = _geometric(s)
    quiet = abs(step) <= noise[-1] + noise[-2]
    value = last if quiet else harmonic if geometric is None else geometric
    spread = max(abs(last - value), abs(harmonic - value), abs((last if geometric is None else geometric) - value))
    # extrapolation in 1 / log mu multiplies what noise there is by the number of decades
    return bounded(value, 2.0 * spread + (1.0 + places[-1]) * (noise[-1] + noise[-2]), 0, "quadrature")


def _geometric(x: Sequence[float]) -> float | None:
    """Aitken's limit of a sequence whose steps shrink geometrically; None where they do not."""
    before, after = x[-2] - x[-3], x[-1] - x[-2]
    if not abs(after) <= GEOMETRIC * abs(before) or before == 0.0:
        return None
    ratio = after / before
    return x[-1] + after * ratio / (1.0 - ratio)


def _level(a: Sequence[Estimate], s: Sequence[float], places: Sequence[float]) -> tuple[str, float, float]:
    """Behaviour, limit and its error of an albedo whose exponent may be 0."""
    values = [e.value for e in a]
    last, step = values[-1], values[-1] - values[-2]
    noise = 2.0 * max(e.half_width for e in a[-3:])
    limit = _geometric(values)
    if abs(step) <= noise:
        return _unless_zero(last, 2.0 * abs(step) + noise)
    if limit is not None:
        ratio = step / (values[-2] - values[-3])
        return _unless_zero(limit, 2.0 * abs(limit - last) + noise / (1.0 - abs(ratio)))
    # a power of the logarithm, a ~ (log 1/mu)^-d: d is settled like 1 / log mu
    d = [x * k * LN10 for x, k in zip(s, places, strict=True)]
    power = d[-1] + places[-2] * (d[-1] - d[-2])
    if abs(power) > 2.0 * abs(power - d[-1]):
        return ("vanishes", 0.0, 0.0) if power > 0.0 else ("diverges", math.copysign(math.inf, last), 0.0)
    limit = last + places[-2] * step
    return _unless_zero(limit, 2.0 * abs(limit - last) + 2.0 * places[-1] * noise)


def _unless_zero(limit: float, error: float) -> tuple[str, float, float]:
    """A limit is one that is not 0, by its error."""
    return ("bounded" if abs(limit) > error else "undecided"), limit, error
