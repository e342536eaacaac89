"""Does a sampler draw what its density says, and do its weights average to the albedo? And how good a sampler is it?

Samples are counted in cells of elevation and azimuth that a pilot sample lays out, so that cells are as narrow as the lobe. What
each cell should hold is the integral of the density over it, whose error counts as noise in the statistic.
"""

from __future__ import annotations

import math
import zlib
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from functools import lru_cache
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.special import bdtr, bdtrc, chdtrc

from albedo_lab.analysis.rows import degrees_of
from albedo_lab.analysis.verdict import Finding, Subject, Trial, Verdict
from albedo_lab.estimate.record import Question
from albedo_lab.estimate.sampling import incident
from albedo_lab.kernels import histogram

CHECK = "sampler"
QUALITY = "quality"
VIEWERS = tuple(math.cos(math.radians(theta)) for theta in (5.0, 45.0, 80.0, 88.5))
"""Cosines: near the normal, in between, and two near grazing, where half of a lobe is lost and densities go wrong unseen."""
AZIMUTH = 0.4
"""Off every axis: an azimuth counted from the wrong one shows."""
SAMPLES = 1 << 19
EVALUATIONS_PER_SAMPLE = 8
"""The draws, pilots and integrals of all viewers cost less than that."""
PILOTS = 8
LEAST_PILOT = 1 << 16
OTHERS = 4
"""The pilot is an eighth of the samples, if that is not too few, each of the other estimators a quarter."""
CHUNK = 1 << 16
CELL_CHUNK = 96
ROWS = 24
LEAST_EXPECTED = 5.0
PRECISION = 0.01
"""Error of a panel's integral in standard deviations of the count in it."""
SAFETY = 3.0
"""The errors of cells are as good as standard errors; a sum of them that is used as a bound takes so many."""
UNSEEN = 16.0
"""Of the pilot's points: what lobes between all nodes may have held, some crowds of histogram.CROWD."""
ROUNDING = 1e-7
"""Relative error that a narrow lobe leaves in a weight."""
HEAVY = 0.03
"""Of an estimator's standard error: what a single sample may contribute, so that the central limit theorem holds as far out as
probabilities of 1e-7 need; the skewness of the mean is smaller than that."""
HIDDEN = 0.3
"""Of an estimator's standard error: the part of the albedo that it may owe to weights too rare to have been drawn."""
FAULTS = {
    histogram.CROOKED: "directions that are not of unit length",
    histogram.BAD_DENSITY: "directions whose density is negative, not finite, or 0 where a sample fell",
    histogram.BAD_WEIGHT: "weights that are not finite",
}


class Cells(NamedTuple):
    """The cells that a pilot lays out: see histogram.draw and histogram.integrate."""

    rows: NDArray[np.float64]
    starts: NDArray[np.float64]
    edges: NDArray[np.float64]
    boxes: NDArray[np.float64]
    places: NDArray[np.int64]
    """Row and column of every box."""
    points: NDArray[np.float64]


@dataclass(frozen=True)
class Draws:
    """The directions of one kind: their weights, and what was told of them."""

    weights: NDArray[np.float64]
    counts: NDArray[np.int64]
    told: NDArray[np.float64]
    witness: NDArray[np.float64]
    record: NDArray[np.float64]

    @property
    def mean(self) -> float:
        """Average weight."""
        return float(np.mean(self.weights))

    @property
    def variance(self) -> float:
        """Variance of a weight."""
        return float(np.var(self.weights, ddof=1))


@dataclass(frozen=True)
class Measurement:
    """Everything drawn and integrated for one viewer direction."""

    mu: float
    draws: dict[int, Draws]
    observed: NDArray[np.float64]
    expected: NDArray[np.float64]
    errors: NDArray[np.float64]
    flux: float
    flux_error: float
    unseen: float
    """Share of the whole that the integrals may lack."""

    @property
    def samples(self) -> int:
        """Directions that were counted."""
        return len(self.draws[histogram.OWN].weights)

    @property
    def rejected(self) -> int:
        """Samples below the horizon."""
        return int(self.draws[histogram.OWN].told[histogram.REJECTED])

    @property
    def where(self) -> str:
        """The viewer direction in words."""
        return f"viewer at {degrees_of(self.mu):.3g} degrees"


def sampler(subject: Subject, trial: Trial) -> list[Finding]:
    """Samples against density, density against 1, and the estimators of the albedo against each other, viewer by viewer."""
    missing = _missing(subject, CHECK)
    if missing:
        return missing
    findings: list[Finding] = []
    with np.errstate(all="ignore"):
        for mu in VIEWERS:
            m = measure(subject, trial, mu)
            faults = _faults(m)
            findings += faults or [_chi_square(m), _normalisation(m)]
            findings.append(_agreement(subject, m))
    return findings


def quality(subject: Subject, trial: Trial) -> list[Finding]:
    """How good a sampler it is, viewer by viewer: reported, not judged."""
    missing = _missing(subject, QUALITY)
    if missing:
        return missing
    with np.errstate(all="ignore"):
        return [_quality(measure(subject, trial, mu)) for mu in VIEWERS]


def _missing(subject: Subject, check: str) -> list[Finding]:
    """The one finding about a model that cannot be sampled."""
    model = subject.model
    if model.sample is not None and model.pdf is not None:
        return []
    what = "no sampler of its own" if model.sample is None else "a sampler without a density to hold it against"
    return [Finding(check, Verdict.SKIPPED, math.nan, math.nan, f"the model has {what}")]


# Measurement


@lru_cache(maxsize=2 * len(VIEWERS))
def measure(subject: Subject, trial: Trial, mu: float) -> Measurement:
    """Draws the pilot, lays out the cells, counts and integrates."""
    samples = min(SAMPLES, max(trial.budget // EVALUATIONS_PER_SAMPLE // CHUNK, 1) * CHUNK)
    nowhere = Cells(
        np.array([0.0, 1.0]), np.zeros(1), np.array([[0.0, 1.0]]), np.empty((0, 7)), np.empty((0, 2), np.int64), np.empty((2, 0))
    )
    pilot = _draw(subject, trial, mu, histogram.PILOT, max(samples // PILOTS, LEAST_PILOT), nowhere)
    cells = lay_out(pilot.record[~np.isnan(pilot.record[:, 1])])
    kinds = [histogram.COSINE, histogram.UNIFORM, *([histogram.REDUCED] if subject.model.weight is not None else [])]
    draws = {histogram.OWN: _draw(subject, trial, mu, histogram.OWN, samples, cells)}
    draws |= {kind: _draw(subject, trial, mu, kind, samples // OTHERS, nowhere) for kind in kinds}
    integrals = _integrate(subject, trial, mu, cells, samples, draws[histogram.OWN].mean)
    row, column = cells.places.T
    expected = samples * integrals[:, histogram.MASS]
    observed = draws[histogram.OWN].counts[row, column].astype(np.float64)
    return Measurement(
        mu,
        draws,
        observed,
        expected,
        samples * integrals[:, histogram.MASS_ERROR],
        float(integrals[:, histogram.FLUX].sum()),
        SAFETY * math.hypot(*integrals[:, histogram.FLUX_ERROR]),
        UNSEEN / len(pilot.weights),
    )


def _draw(subject: Subject, trial: Trial, mu: float, kind: int, count: int, cells: Cells) -> Draws:
    """So many directions of one kind; the same whatever the number of threads."""
    kernel = histogram.drawing_kernel(subject.model)
    # every model has random numbers of its own: an unlucky seed is unlucky for one, not for all
    name = zlib.crc32(subject.model.title.encode())
    key = np.random.SeedSequence([trial.seed, name, VIEWERS.index(mu), kind]).generate_state(1)[0]
    values, direction = Question(subject.model, subject.p, mu).values, incident(mu, AZIMUTH)
    weights = np.empty(count)
    record = np.full((count if kind in (histogram.PILOT, histogram.UNIFORM) else 0, 2), np.nan)

    def work(first: int) -> tuple[NDArray[np.int64], NDArray[np.float64], NDArray[np.float64]]:
        counts = np.zeros((len(cells.rows) - 1, cells.edges.shape[1]), dtype=np.int64)
        told, witness = np.zeros(histogram.TOLD), np.zeros((len(FAULTS), 5))
        part = slice(first, first + CHUNK)
        kernel(
            kind,
            first,
            key,
            values,
            direction,
            cells.rows,
            cells.starts,
            cells.edges,
            counts,
            weights[part],
            told,
            witness,
            record[part],
        )
        return counts, told, witness

    parts = _each(work, range(0, count, CHUNK), trial.threads)
    told = np.array([told for _, told, _ in parts])
    total = told.sum(axis=0)
    largest = slice(histogram.LARGEST_F, None)
    total[largest] = told[:, largest].max(axis=0)
    witness = np.zeros((len(FAULTS), 5))
    for i, fault in enumerate(FAULTS):
        witness[i] = parts[int(np.argmax(told[:, fault] > 0.0))][2][i]
    return Draws(weights, sum((counts for counts, _, _ in parts), np.zeros_like(parts[0][0])), total, witness, record)


def _integrate(subject: Subject, trial: Trial, mu: float, cells: Cells, samples: int, flux: float) -> NDArray[np.float64]:
    """The integrals over every cell."""
    kernel = histogram.cell_kernel(subject.model)
    values, direction = Question(subject.model, subject.p, mu).values, incident(mu, AZIMUTH)
    integrals = np.zeros((len(cells.boxes), 4))

    def work(first: int) -> None:
        part = slice(first, first + CELL_CHUNK)
        kernel(values, direction, cells.boxes[part], cells.points, samples, PRECISION, abs(flux), integrals[part])

    _each(work, range(0, len(cells.boxes), CELL_CHUNK), trial.threads)
    return integrals


def _each(work: Any, jobs: Sequence[int], threads: int) -> list[Any]:
    """The answers to all jobs, in order."""
    if threads == 1 or len(jobs) == 1:
        return list(map(work, jobs))
    with ThreadPoolExecutor(threads) as pool:
        return list(pool.map(work, jobs))


def lay_out(points: NDArray[np.float64]) -> Cells:
    """Rows of equal share in elevation, each cut into cells of equal share in azimuth from the middle of its largest gap.

    points: (n, 2), e and azimuth in turns. Together the cells cover the hemisphere.
    """
    points = points[np.argsort(points[:, 0], kind="stable")]
    rows = _edges(points[:, 0], 0.0, 1.0)
    ends = np.searchsorted(points[:, 0], rows[1:-1])
    parts = np.split(points, ends)
    starts = np.array([_largest_gap(part[:, 1]) for part in parts])
    edges = np.full((len(parts), ROWS + 1), np.inf)
    boxes, places = [], []
    ordered = np.empty((2, len(points)))
    first = 0
    for row, (part, start) in enumerate(zip(parts, starts, strict=True)):
        turn = part[:, 1] - start
        turn -= np.floor(turn)
        order = np.argsort(turn, kind="stable")
        turn = turn[order]
        own = _edges(turn, 0.0, 1.0)
        edges[row, : len(own)] = own
        ordered[0, first : first + len(part)], ordered[1, first : first + len(part)] = part[order, 0], turn
        at = first + np.searchsorted(turn, own)
        at[-1] = first + len(part)
        for column in range(len(own) - 1):
            boxes.append((rows[row], rows[row + 1], own[column], own[column + 1], start, at[column], at[column + 1]))
            places.append((row, column))
        first += len(part)
    return Cells(rows, starts, edges, np.array(boxes, dtype=np.float64), np.array(places, dtype=np.int64), ordered)


def _edges(sorted_values: NDArray[np.float64], low: float, high: float) -> NDArray[np.float64]:
    """Edges between which the values fall in equal shares, midway between two of them; fewer where many are equal."""
    at = np.arange(1, ROWS) * len(sorted_values) // ROWS
    at = at[at > 0]
    inner = np.unique(0.5 * (sorted_values[at - 1] + sorted_values[at]))
    return np.array([low, *inner[(inner > low) & (inner < high)], high])


def _largest_gap(turns: NDArray[np.float64]) -> float:
    """The middle of the largest gap between azimuths, in turns."""
    if len(turns) == 0:
        return 0.0
    around = np.sort(turns)
    gaps = np.diff(around, append=around[0] + 1.0)
    widest = int(np.argmax(gaps))
    return float((around[widest] + 0.5 * gaps[widest]) % 1.0)


# Judgement


def _faults(m: Measurement) -> list[Finding]:
    """What no sound sampler does even once."""
    found = []
    for i, (fault, words) in enumerate(FAULTS.items()):
        kind = next((kind for kind, draws in m.draws.items() if draws.told[fault] > 0.0), None)
        if kind is None:
            continue
        count = sum(int(draws.told[fault]) for draws in m.draws.values())
        x, y, z, f, density = m.draws[kind].witness[i]
        witness = f"wi = ({x:.9g}, {y:.9g}, {z:.9g}), {m.where}, azimuth {AZIMUTH:g} rad: f = {f:.6g}, density = {density:.6g}"
        found.append(Finding(CHECK, Verdict.FAIL, float(count), 0.0, f"{words}: {count}, {m.where}", witness))
    return found


def _chi_square(m: Measurement) -> Finding:
    """Samples by cell against the integrated density, the rejected ones as one more cell."""
    observed = np.append(m.observed, m.rejected)
    expected = np.append(m.expected, m.samples - m.expected.sum())
    errors = np.append(m.errors, math.hypot(*m.errors))
    empty = (m.expected + m.errors <= 1e-9) & (m.observed > 0.0)
    if np.any(empty):
        hits = int(m.observed[empty].sum())
        statement = f"{hits} samples fell where the density is 0, {m.where}"
        return Finding(CHECK, Verdict.FAIL, float(hits), 0.0, statement, f"{int(empty.sum())} cells of no expectation were hit")
    observed, expected, errors = _pooled(observed, expected, errors)
    freedom = len(expected) - 1
    terms = (observed - expected) ** 2 / (np.abs(expected) + errors**2)
    statistic = float(terms.sum())
    if not math.isfinite(statistic):
        return Finding(CHECK, Verdict.FAIL, statistic, math.nan, f"the density has no integral, {m.where}")
    p_value = float(chdtrc(freedom, statistic)) if freedom > 0 else 1.0
    worst = int(np.argmax(terms))
    statement = f"samples against the density, {m.where}: chi-square {statistic:.1f} of {freedom} degrees of freedom"
    witness = f"{observed[worst]:.0f} samples in a cell of {expected[worst]:.1f}, {m.where}"
    blurred = float((errors**2 / np.abs(expected)).sum()) > 0.1 * max(freedom, 1)
    details = {"degrees_of_freedom": freedom, "samples": m.samples, "mu": m.mu}
    if blurred and p_value > 1e-3:
        statement += "; the density could not be integrated well enough to tell"
        return Finding(CHECK, Verdict.INCONCLUSIVE, statistic, math.nan, statement, details=details)
    return Finding(CHECK, Verdict.OPEN, statistic, math.nan, statement, witness, p_value=p_value, details=details)


def _pooled(observed: Any, expected: Any, errors: Any) -> tuple[Any, Any, Any]:
    """Cells of the smallest expectation put together until they expect enough."""
    order = np.argsort(expected, kind="stable")
    observed, expected, errors = observed[order], expected[order], errors[order]
    if expected[0] >= LEAST_EXPECTED:
        return observed, expected, errors
    enough = np.cumsum(expected) >= LEAST_EXPECTED
    last = int(np.argmax(enough)) + 1 if np.any(enough) else len(expected)
    while last < len(expected) and expected[last] < LEAST_EXPECTED:
        last += 1

    def pool(x: Any) -> Any:
        return np.append(x[:last].sum(), x[last:])

    return pool(observed), pool(expected), np.append(math.hypot(*errors[:last]), errors[last:])


def _normalisation(m: Measurement) -> Finding:
    """The integral of the density against the share of samples that were not rejected."""
    integral = float(m.expected.sum()) / m.samples
    share = m.rejected / m.samples
    error = SAFETY * math.hypot(*m.errors) / m.samples + m.unseen
    # the probability of rejection, as near to the share seen as the integral's error allows
    q = min(max(share, 1.0 - integral - error), 1.0 - integral + error)
    statistic = integral + share - 1.0
    if not math.isfinite(q):
        return Finding(CHECK, Verdict.FAIL, statistic, math.nan, f"the density has no integral, {m.where}")
    p_value = 0.0
    if 0.0 <= q <= 1.0:
        below, above = float(bdtr(m.rejected, m.samples, q)), float(bdtrc(m.rejected - 1, m.samples, q)) if m.rejected else 1.0
        p_value = min(1.0, 2.0 * min(below, above))
    told = f"density {integral:.6f} (+- {error:.1g}) and rejection {share:.6f}"
    statement = f"density and rejection against 1, {m.where}: {told}"
    details = {"integral": integral, "integral_error": error, "rejected": share, "mu": m.mu}
    return Finding(CHECK, Verdict.OPEN, statistic, math.nan, statement, f"{told}, {m.where}", p_value=p_value, details=details)


NAMES = {
    histogram.OWN: "own sampler",
    histogram.REDUCED: "reduced weight",
    histogram.COSINE: "cosine sampling",
    histogram.UNIFORM: "uniform sampling",
}


def _agreement(subject: Subject, m: Measurement) -> Finding:
    """All estimators of the albedo that have a normal error, held against their common mean."""
    largest_f = max(draws.told[histogram.LARGEST_F] for draws in m.draws.values())
    largest_f_cos = max(draws.told[histogram.LARGEST_F_COS] for draws in m.draws.values())
    known = {histogram.COSINE: math.pi * largest_f, histogram.UNIFORM: 2.0 * math.pi * largest_f_cos}
    estimates: dict[str, tuple[float, float]] = {}
    left_out = []
    for kind, draws in m.draws.items():
        mean, variance, count = draws.mean, draws.variance, len(draws.weights)
        largest = max(known.get(kind, 0.0), float(np.abs(draws.weights).max()))
        error = math.sqrt(variance / count) if math.isfinite(variance) else math.nan
        most = HEAVY * error * count + ROUNDING * abs(mean) * count
        hidden = _hidden(m, mean, most) if kind in (histogram.OWN, histogram.REDUCED) else 0.0
        if not math.isfinite(mean) or not largest - mean <= most or hidden > HIDDEN * error:
            left_out.append(NAMES[kind])
        else:
            estimates[NAMES[kind]] = mean, math.hypot(error, ROUNDING * mean)
    if math.isfinite(m.flux) and m.flux_error <= 0.01 * abs(m.flux):
        estimates["quadrature over the cells"] = m.flux, math.hypot(m.flux_error, m.unseen * m.flux)
    else:
        left_out.append("quadrature over the cells")
    told = ", ".join(f"{name} {scaled(value, subject)} +- {scaled(error, subject)}" for name, (value, error) in estimates.items())
    skipped = f"; too heavy a tail for a test: {', '.join(left_out)}" if left_out else ""
    details = {"estimates": estimates, "left_out": left_out, "mu": m.mu}
    if len(estimates) < 2:
        statement = f"no two estimators of the albedo can be compared, {m.where}{skipped}"
        return Finding(CHECK, Verdict.SKIPPED, math.nan, math.nan, statement, details=details)
    values, errors = np.array(list(estimates.values())).T
    precision = 1.0 / np.maximum(errors, 1e-150) ** 2
    common = float((values * precision).sum() / precision.sum())
    statistic = float(((values - common) ** 2 * precision).sum())
    p_value = float(chdtrc(len(values) - 1, statistic))
    statement = f"estimators of the albedo, {m.where}: {told}{skipped}"
    return Finding(CHECK, Verdict.OPEN, statistic, math.nan, statement, f"{told}, {m.where}", p_value=p_value, details=details)


def _hidden(m: Measurement, mean: float, most: float) -> float:
    """The albedo that the model's own sampler would bring by weights further than that from the mean: as uniform samples see it.

    Where its density is 0 it brings nothing at all; that is no heavy tail but a fault, and shows as a lack.
    """
    uniform = m.draws[histogram.UNIFORM]
    own = uniform.record[:, 0]
    return float(np.abs(uniform.weights[np.isfinite(own) & (np.abs(own - mean) > most)]).sum()) / len(own)


def scaled(value: float, subject: Subject) -> str:
    """A figure of the shape, times the model's constant where that is finite, to six digits."""
    scale = subject.scale.value
    return f"{value * scale if math.isfinite(scale) else value:.6g}"


def _quality(m: Measurement) -> Finding:
    """Relative variance, largest weight, rejection, and efficiency against cosine sampling (section 4 of neumann1999)."""
    own, cosine = m.draws[histogram.OWN], m.draws[histogram.COSINE]
    mean, variance = own.mean, own.variance
    relative = variance / mean**2 if mean else math.nan
    largest = float(np.abs(own.weights).max()) / abs(mean) if mean else math.nan
    rejected = m.rejected / m.samples
    gain = cosine.variance / variance if variance > (ROUNDING * mean) ** 2 else math.inf
    statement = (
        f"{m.where}: variance of the weight {relative:.3g} of its square mean, largest weight {largest:.3g} means, "
        f"{100.0 * rejected:.3g} % rejected, {gain:.3g} times as efficient as cosine sampling"
    )
    details = {"variance": relative, "largest": largest, "rejected": rejected, "efficiency": gain, "mu": m.mu}
    return Finding(QUALITY, Verdict.REPORTED, relative, math.nan, statement, details=details)
