"""What is wrong with a table, once it is known what it should hold: each defect with a name, a sentence and its evidence.

The defects are taken off one after the other (a factor and an offset, clamps, a smallest value of an axis, single cells), so that
each is judged by what those before it leave. Storage rounding and the truth's own bound are always forgiven.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from albedo_lab.lookup.audit.hypotheses import PLAINLY, PLATEAU, Fit, Hypothesis, Observed, correlation, effective, picked
from albedo_lab.lookup.audit.layouts import nodes
from albedo_lab.lookup.audit.truth import Lab
from albedo_lab.lookup.axes import Floats

SURE = 4.0
"""Standard errors beyond which a factor or an offset is no accident (6e-5 of doubt for each)."""
LEAST = 0.05
"""Factors below are none: what falls where the truth rises is another quantity."""
EXPLAINED = 0.5
"""A factor and an offset must leave less than this share of the mean deviation."""
AROUND = 2
"""Neighbours to either side, along each axis, that tell how noisy a table is about a cell; twice as many in one dimension."""
OUTLYING = 8.0
"""Robust standard deviations of its neighbourhood, beyond which a cell is wrong. With 24 neighbours, whose upper quartile has an
error of a fifth, noise of a normal law gets there less than one time in 1e6."""
SINGLE = 0.02
"""Share of the cells up to which they are single ones."""
LINE = 0.2
"""Share of a line's cells that must be off for the line to be."""
TELLS = 5
"""Cells that are named one by one."""
MAD = 1.4826
"""Standard deviation of a normal law over its median absolute deviation."""
QUARTILE = 0.8694
"""The same over its upper quartile of sizes."""
SMALLEST = 1e-7
"""Where the search for the smallest value of an axis begins."""
ACROSS = 5
"""Nodes along each other axis on which it searches: all of a large table would cost more than everything else."""
REFINED = 7
"""Times that it narrows by a third: from a factor of two to four digits."""


@dataclass(frozen=True)
class Defect:
    """Something wrong: its name, what it is in a sentence, the figures that show it, and the cells where they are few."""

    name: str
    sentence: str
    evidence: str = ""
    cells: tuple[tuple[int, ...], ...] = ()


@dataclass(eq=False)
class Trial:
    """A table before its judge: what it deviates by from the best hypothesis, less what the defects found so far explain.

    `left` is NaN where a cell is not judged, or has been told of.
    """

    observed: Observed
    fit: Fit
    lab: Lab
    truth: Floats
    left: Floats
    defects: list[Defect] = field(default_factory=list)
    facts: list[Defect] = field(default_factory=list)

    @property
    def allowed(self) -> Floats:
        """What storage and the truth's bound are forgiven, cell by cell."""
        return self.observed.rounding + self.fit.bound

    def excess(self, left: Floats) -> Floats:
        """What a deviation leaves beyond that; NaN where it is NaN."""
        return np.maximum(np.abs(left) - self.allowed, 0.0)

    @property
    def off(self) -> NDArray[np.bool_]:
        """The cells beyond the tolerance."""
        return np.nan_to_num(self.excess(self.left)) > self.observed.tolerance


def tried(observed: Observed, fit: Fit, lab: Lab, edges_count: bool) -> Trial:
    """A table against a hypothesis, through every judge; `edges_count` says whether a displaced edge is a defect or a fact."""
    trial = begun(observed, fit, lab)
    not_finite(trial)
    explained(trial, edges_count)
    lines(trial)
    single_cells(trial)
    return trial


def begun(observed: Observed, fit: Fit, lab: Lab) -> Trial:
    """A table against a hypothesis before any judge."""
    return Trial(observed, fit, lab, fit.truth, np.where(np.isfinite(observed.values), observed.values, np.nan) - fit.truth)


def explained(trial: Trial, edges_count: bool) -> None:
    """What is wrong with the table as a whole."""
    biased(trial)
    for axis in range(len(trial.observed.sizes)):
        held(trial, axis, edges_count)  # before clamps: lines that are alike hold the same largest value
    clamped(trial)


def cleared(observed: Observed, fit: Fit, lab: Lab) -> Fit:
    """A fit less all that is wrong with the table as a whole, so that hypotheses are compared by what they leave unexplained."""
    if fit.within:
        return fit
    trial = begun(observed, fit, lab)
    explained(trial, edges_count=True)
    left = np.where(np.isfinite(fit.deviation) & ~np.isfinite(trial.left), 0.0, trial.left)
    return replace(fit, deviation=left, excess=np.nan_to_num(trial.excess(left)), explained=len(trial.defects))


def unbiased(observed: Observed, fit: Fit, lab: Lab) -> Fit:
    """A fit less the factor and the offset that its deviations show."""
    trial = begun(observed, fit, lab)
    biased(trial)
    if not trial.defects:
        return fit
    left = np.where(observed.beyond(trial.truth) & np.isfinite(trial.left), 0.0, trial.left)
    return replace(fit, deviation=left, excess=np.nan_to_num(trial.excess(left)), explained=1)


def not_finite(trial: Trial) -> None:
    """NaN and infinities, and negative values where there should be none."""
    values = trial.observed.values
    for name, cells in (
        ("not finite", ~np.isfinite(values)),
        ("negative", np.isfinite(values) & (values < -trial.allowed) & (trial.truth >= 0.0)),
    ):
        if np.any(cells):
            count = int(np.count_nonzero(cells))
            verb = "is" if count == 1 else "are"
            what = "NaN or infinite" if name == "not finite" else f"negative, the smallest {np.nanmin(values[cells]):.4g}"
            trial.defects.append(Defect(name, f"{_cells(count)} {verb} {what}", _listed(trial, cells), _places(cells)))
            if name == "negative":
                trial.left[cells] = np.nan


def biased(trial: Trial) -> None:
    """A factor, an offset, or both, with 95 % intervals."""
    told = np.isfinite(trial.left) & ~trial.observed.beyond(trial.truth)
    if np.count_nonzero(told) < 8:
        return
    y, t, allowed = trial.left[told], trial.truth[told], trial.allowed[told]
    before = _mean_excess(y, allowed, trial.fit.floor)
    columns = {"an offset": (np.ones_like(t),), "a factor": (t,), "a factor and an offset": (t, np.ones_like(t))}
    best: tuple[float, str, Floats, Floats] | None = None
    for name, parts in columns.items():
        basis = np.stack(parts, axis=-1)
        coefficients, errors, left = _robust(basis, y, allowed)
        smooth = np.full(trial.left.shape, np.nan)
        smooth[told] = left
        errors = errors * math.sqrt(y.size / max(effective(replace(trial.fit, deviation=smooth)), 2.0))
        after = _mean_excess(left, allowed, trial.fit.floor)
        sure = bool(np.all(np.abs(coefficients) > SURE * errors)) and ("factor" not in name or coefficients[0] > LEAST - 1.0)
        matters = float(np.max(np.abs(basis @ coefficients))) > trial.observed.tolerance
        if sure and matters and after <= EXPLAINED * (before if best is None or len(parts) == 1 else best[0]):
            best = min(
                (each for each in (best, (after, name, coefficients, errors)) if each is not None), key=lambda each: each[0]
            )
    if best is None:
        return
    _, name, coefficients, errors = best
    factor = coefficients[0] if "factor" in name else 0.0
    offset = coefficients[-1] if "offset" in name else 0.0
    words = []
    if "factor" in name:
        words.append(f"the truth times {1.0 + factor:.6g} +- {2.0 * errors[0]:.1g}")
    if "offset" in name:
        plus = "plus" if offset > 0.0 else "minus"
        words.append(f"{'' if words else 'the truth '}{plus} {abs(offset):.4g} +- {2.0 * errors[-1]:.1g}")
    evidence = f"mean deviation beyond storage {before:.2g}, without it {best[0]:.2g}"
    step = 2.0 * trial.observed.rounding
    if abs(float(np.mean(trial.left[told])) + 0.5 * step) < 0.1 * step and float(np.max(y)) < 0.1 * step:
        sentence = f"numbers were cut off instead of rounded: they are low by {-float(np.mean(y)):.3g} on average"
        trial.defects.append(Defect("biased", sentence, evidence))
        trial.left = np.where(trial.left < 0.0, np.minimum(trial.left + 0.5 * step, 0.0), trial.left)
        return
    trial.defects.append(Defect("biased", f"the values are {' '.join(words)}", evidence))
    trial.truth = trial.truth * (1.0 + factor) + offset
    trial.left = trial.left - (trial.fit.truth * factor + offset)


def _robust(basis: Floats, y: Floats, allowed: Floats) -> tuple[Floats, Floats, Floats]:
    """Coefficients with standard errors, and what they leave; cells that lie far off have no say."""
    weight = np.ones_like(y)
    left = y
    for _ in range(12):
        coefficients = np.linalg.lstsq(basis * weight[:, None], y * weight, rcond=None)[0]
        left = y - basis @ coefficients
        reach = 1.5 * MAD * float(np.median(np.abs(left))) + 1e-15
        weight = np.sqrt(np.minimum(1.0, reach / np.maximum(np.abs(left), reach)))
    use = np.abs(left) <= 4.0 * MAD * float(np.median(np.abs(left))) + allowed
    coefficients = np.linalg.lstsq(basis[use], y[use], rcond=None)[0]
    left = y - basis @ coefficients
    variance = float(np.mean(np.square(left[use])))
    errors = np.sqrt(variance * np.diag(np.linalg.pinv(basis[use].T @ basis[use])))
    return np.asarray(coefficients, dtype=np.float64), errors, np.asarray(left, dtype=np.float64)


def clamped(trial: Trial) -> None:
    """Cells that stand together at the largest or the smallest value, while the truth goes on."""
    beyond = trial.observed.beyond(trial.truth)
    for side, word, extreme in ((1, "exceeds", np.max), (0, "falls below", np.min)):
        for channel, end in enumerate(trial.observed.ends()[side]):
            cells = np.zeros_like(beyond)
            cells[..., channel] = beyond[..., channel] & (trial.observed.values[..., channel] == end) & trial.off[..., channel]
            count = int(np.count_nonzero(cells))
            if count < PLATEAU:
                continue
            furthest = float(extreme(trial.truth[cells]))
            sentence = f"{count} cells stand at {end:.6g}, where the truth {word} it, up to {furthest:.6g}"
            trial.defects.append(Defect("clamped", sentence, _listed(trial, cells), _places(cells)))
            trial.left[cells] = np.nan


def held(trial: Trial, axis: int, edges_count: bool) -> None:
    """Lines at the small end of an axis that hold the values of a larger one: the variable was held at or above it."""
    along = trial.fit.hypothesis.axes[axis]
    at = nodes(along)
    ascending = np.argsort(at, kind="stable")
    others = tuple(i for i in range(trial.left.ndim) if i != axis)
    many = np.count_nonzero(trial.off, axis=others)
    enough = np.maximum(PLATEAU, LINE * np.count_nonzero(np.isfinite(trial.left), axis=others))
    count = 0
    while count < len(at) and many[ascending[count]] >= enough[ascending[count]]:
        count += 1
    if not 0 < count <= len(at) // 2 or not at[ascending[count]] > 2.0 * SMALLEST:
        return
    lines_off = ascending[:count]
    value, explained = _value_of(trial, axis, lines_off, float(at[ascending[count]]))
    before = np.take(trial.excess(trial.left), lines_off, axis=axis)
    after = np.take(trial.excess(explained), lines_off, axis=axis)
    if not np.any(np.isfinite(after)) or not PLAINLY * max(float(np.nanmean(after)), trial.fit.floor) < float(np.nanmean(before)):
        return
    evidence = f"mean deviation of these cells {np.nanmean(before):.2g}, from the values at {value:.3g} {np.nanmean(after):.2g}"
    if count == 1:
        sentence = f"the line {along.name} = {at[lines_off[0]]:.4g} holds the values of {along.name} = {value:.3g}"
        (trial.defects if edges_count else trial.facts).append(Defect("edge displaced", sentence, evidence))
    else:
        sentence = f"the {count} lines with {along.name} below {value:.3g} hold the values there: it was not let below"
        trial.defects.append(Defect(f"{along.name} clamped", sentence, evidence))
    index = _at(trial.left.ndim, axis, lines_off)
    trial.left[index] = explained[index]


def _value_of(trial: Trial, axis: int, lines_off: NDArray[np.intp], high: float) -> tuple[float, Floats]:
    """Of which value of an axis' variable some lines are the truth, and all deviations with these lines from it."""
    every = [nodes(along) for along in trial.fit.hypothesis.axes]
    picks = [pick[at[pick] > 0.0] for pick, at in zip(picked(trial.observed.sizes, ACROSS), every, strict=True)]
    picks[axis] = lines_off  # the others without their limits, each of which costs as much as hundreds of cells
    few = trial.observed.values[np.ix_(*picks)]

    def miss(value: float) -> float:
        left = np.abs(few - _line(trial, axis, value, picks))
        known = np.isfinite(left)
        return float(np.mean(np.minimum(left[known], 1.0))) if np.any(known) else math.inf

    candidates = np.geomspace(SMALLEST, high, 22)
    spacing = candidates[1] / candidates[0]
    best = min(map(float, candidates), key=miss)
    for _ in range(REFINED):
        near = best * spacing ** (-2.0 / 3.0, -1.0 / 3.0, 0.0, 1.0 / 3.0, 2.0 / 3.0)
        best = min((float(v) for v in near if v <= high), key=miss)
        spacing **= 1.0 / 3.0
    left = trial.left.copy()
    index = _at(left.ndim, axis, lines_off)
    left[index] = trial.observed.values[index] - _line(trial, axis, best)
    return best, left


def _line(trial: Trial, axis: int, value: float, picks: Sequence[NDArray[np.intp]] | None = None) -> Floats:
    """The truth, biased as the table is, along a line of nodes of all other axes, or of those picked."""
    hypothesis: Hypothesis = trial.fit.hypothesis
    every = [nodes(along) for along in hypothesis.axes]
    chosen = every if picks is None else [at[pick] for at, pick in zip(every, picks, strict=True)]
    values = [np.array([value]) if i == axis else at for i, at in enumerate(chosen)]
    found = trial.lab.exact(hypothesis.variant, hypothesis.form, hypothesis.names, values)
    assert found is not None
    known = np.isfinite(trial.fit.truth)
    if np.array_equal(trial.truth[known], trial.fit.truth[known]):
        return found[0]
    factor, offset = np.polyfit(trial.fit.truth[known], trial.truth[known], 1)
    return np.asarray(found[0] * factor + offset)


def _at(dimensions: int, axis: int, lines_off: NDArray[np.intp]) -> tuple[slice | NDArray[np.intp], ...]:
    """The index of lines along an axis."""
    return tuple(lines_off if i == axis else slice(None) for i in range(dimensions))


def lines(trial: Trial) -> None:
    """Whole lines of cells that are off while their neighbours are not, as a border that was forgotten is."""
    for axis, along in enumerate(trial.fit.hypothesis.axes):
        others = tuple(i for i in range(trial.left.ndim) if i != axis)
        if not others or trial.left.size == trial.left.shape[axis]:
            continue
        judged = np.count_nonzero(np.isfinite(trial.left), axis=others)
        many = np.count_nonzero(trial.off, axis=others)
        for i in np.flatnonzero((many >= np.maximum(PLATEAU, 0.5 * judged)) & (judged > 0)):
            beside = [many[j] < LINE * max(judged[j], 1) for j in (i - 1, i + 1) if 0 <= j < len(many)]
            if not all(beside):
                continue
            cells = np.zeros_like(trial.off)
            index = _at(cells.ndim, axis, np.array([i]))
            cells[index] = trial.off[index]
            values = trial.observed.values[index]
            same = float(np.nanmax(values) - np.nanmin(values)) <= 2.0 * trial.observed.rounding
            holds = f"holds {float(values.ravel()[0]):.4g} throughout" if same else f"is off in {_cells(int(many[i]))}"
            sentence = (
                f"the line {along.name} = {nodes(along)[i]:.4g} {holds}, by up to {np.nanmax(np.abs(trial.left[cells])):.2g}"
            )
            trial.defects.append(Defect("line wrong", sentence, _listed(trial, cells), _places(cells)))
            trial.left[cells] = np.nan


def single_cells(trial: Trial) -> None:
    """Cells that lie far off among neighbours that do not."""
    spread = QUARTILE * _around(trial.left)
    known = np.abs(trial.left[np.isfinite(trial.left)])
    whole = MAD * float(np.median(known)) if known.size else 0.0  # what is less than the table's own noise is no outlier of it
    limit = trial.allowed + np.maximum(max(trial.observed.tolerance, whole), OUTLYING * spread)
    cells = np.nan_to_num(np.abs(trial.left)) > limit
    count = int(np.count_nonzero(cells))
    if not 0 < count <= max(TELLS, SINGLE * trial.left.size):
        return
    most = float(np.max(np.abs(trial.left[cells])))
    ratio = most / max(float(np.median(spread[cells])), 1e-300)
    noise = f", {ratio:.0f} times as much as about them" if ratio < 1e4 else ""
    sentence = f"{_cells(count)} {'is' if count == 1 else 'are'} wrong, by up to {most:.3g}{noise}"
    trial.defects.append(Defect("cells wrong", sentence, _listed(trial, cells), _places(cells)))
    trial.left[cells] = np.nan


def _around(left: Floats) -> Floats:
    """The upper quartile of the sizes of what is left about each cell, without itself.

    Not the median: where noise is cut off at 0 or at 1, half of the cells have none.
    """
    reach = AROUND * (2 if left.ndim == 2 else 1)
    width = [(reach, reach)] * (left.ndim - 1) + [(0, 0)]
    padded = np.pad(np.abs(left), width, constant_values=np.nan)
    windows = np.lib.stride_tricks.sliding_window_view(
        padded, [2 * reach + 1] * (left.ndim - 1), axis=tuple(range(left.ndim - 1))
    )
    flat = windows.reshape(*left.shape, -1).copy()
    flat[..., flat.shape[-1] // 2] = np.nan
    known = np.isfinite(flat)
    ordered = np.sort(np.where(known, flat, np.inf), axis=-1)
    count = np.count_nonzero(known, axis=-1)
    middle = np.take_along_axis(ordered, (3 * count // 4)[..., None], axis=-1)[..., 0]
    return np.where(np.isfinite(middle), middle, 0.0)


@dataclass(frozen=True)
class Rest:
    """What no defect explains: RMS and largest of it, and how much of the RMS is noise and how much goes smoothly."""

    rms: float
    largest: float
    noise: float
    smooth: float
    mean: float
    mean_error: float


def rest(trial: Trial) -> Rest:
    """The deviations that are left. Noise is told from what is smooth by second differences, which smooth things hardly have."""
    known = np.isfinite(trial.left)
    if not np.any(known):
        return Rest(0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
    left = trial.left[known]
    rms = math.sqrt(float(np.mean(np.square(left))))
    rough = []
    for axis in range(trial.left.ndim - 1):
        if trial.left.shape[axis] >= 4:
            second = np.diff(trial.left, n=2, axis=axis)
            second = second[np.isfinite(second)]
            rough += [math.sqrt(float(np.mean(np.square(second))) / 6.0)] if second.size else []
    noise = min([rms, *rough])
    smooth = math.sqrt(max(rms * rms - noise * noise, 0.0))
    count = max(effective(replace(trial.fit, deviation=trial.left)), 1.0)
    largest = float(np.max(trial.excess(trial.left)[known]))
    return Rest(rms, largest, noise, smooth, float(np.mean(left)), rms / math.sqrt(count))


def remaining(trial: Trial, left: Rest) -> Iterator[Defect]:
    """What is left beyond the tolerance, by whether it is noise."""
    if left.largest <= trial.observed.tolerance:
        return
    off = trial.off
    count = int(np.count_nonzero(off))
    worst = np.unravel_index(int(np.argmax(np.where(off, np.abs(trial.left), -1.0))), trial.left.shape)
    at = tuple(int(i) for i in worst)
    where = f"{_cells(count)} beyond the tolerance, the largest {trial.left[at]:+.3g} at {trial.fit.where(at)}"
    if left.noise >= left.smooth:
        sentence = f"noise as of Monte Carlo: RMS {left.rms:.2g}, mean {left.mean:+.1g} +- {2.0 * left.mean_error:.1g}"
        yield Defect("noise", sentence, where)
    else:
        alike = max(correlation(trial.left, axis) for axis in range(trial.left.ndim - 1))
        sentence = f"the values deviate smoothly: RMS {left.rms:.2g}, largest {left.largest:.2g} beyond storage"
        cause = "another formula, or few samples that are the same in all cells"
        yield Defect("deviates", sentence, f"{where}; neighbours agree to {100.0 * alike:.0f} %, as with {cause}")


def _mean_excess(left: Floats, allowed: Floats, floor: float) -> float:
    """The mean of what is left beyond what is forgiven."""
    return max(float(np.mean(np.maximum(np.abs(left) - allowed, 0.0))), floor)


def _cells(count: int) -> str:
    return "1 cell" if count == 1 else f"{count} cells"


def _places(cells: NDArray[np.bool_]) -> tuple[tuple[int, ...], ...]:
    return tuple(tuple(int(i) for i in place) for place in np.argwhere(cells))


def _listed(trial: Trial, cells: NDArray[np.bool_]) -> str:
    """The cells with their values and the truth, the worst first; not all where they are many."""
    places = sorted(_places(cells), key=lambda place: -abs(np.nan_to_num(trial.left[place], nan=np.inf)))
    told = [f"{trial.fit.where(at)} is {trial.observed.values[at]:.6g}, not {trial.truth[at]:.6g}" for at in places[:TELLS]]
    return "; ".join([*told, *([f"and {len(places) - TELLS} more"] if len(places) > TELLS else [])])
