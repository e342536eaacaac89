"""Which model, quantity and layout explain a table: all are tried on a surface, the best of them cell by cell.

A layout is scored by the mean of what its deviations leave beyond the storage rounding and the truth's own bound: unlike their
mean square, it does not let one wrong cell or one clamped corner decide. Of values that stand together at the largest or the
smallest of the table no more is asked than that the truth lies beyond: they may have been clamped.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import permutations

import numpy as np
from numpy.typing import NDArray

from albedo_lab.lookup.audit.expectation import Expectation
from albedo_lab.lookup.audit.layouts import Run, nodes, usual_shift
from albedo_lab.lookup.audit.truth import Lab, weights
from albedo_lab.lookup.audit.variants import Form, Variant
from albedo_lab.lookup.axes import Axis, Floats
from albedo_lab.lookup.source import MU

PLATEAU = 3
"""Cells of the same largest or smallest value: fewer may be a coincidence."""
INSIDE = 0.1
"""Share of the cells that must stand between the smallest and the largest value, or there is nothing to see between clamps."""
SUBGRID = {1: 64, 2: 8, 3: 5}
"""Nodes along each axis on which layouts are told apart, by the number of axes."""
KEPT = {1: 4, 2: 12, 3: 6}
"""Layouts of each variant that are looked at more closely, and as many of those whose values are biased."""
SMALL = 4
"""Nodes of an axis whose ends are not left out when a bias is looked for."""
CLOSER = {1: 5, 2: 6, 3: 4}
"""Nodes along each axis on which they are computed exactly, the ends left out, where limits have to be taken. Both are few in one
dimension, where a cell is a mean over all directions and costs as much as a hundred others."""
FINAL = 2
"""Variants whose best layouts are computed cell by cell, for evidence and for what separates the first from the next."""
CERTAIN = 20.0
"""Log of the likelihood ratio, for deviations of Laplace's law of unknown width, beyond which a layout is preferred: it leaves
2e-4 of doubt after a hundred thousand layouts have been tried (ln 1e5 = 11.5)."""
PLAINLY = 4.0
"""Ratio of the mean deviations beyond which no statistics are needed."""


@dataclass(frozen=True, eq=False)
class Observed:
    """A table as it was read: values of shape (*sizes, channels), and the rounding of its storage."""

    values: Floats
    rounding: float
    tolerance: float

    @property
    def sizes(self) -> tuple[int, ...]:
        """Nodes along each axis."""
        return self.values.shape[:-1]

    def ends(self) -> Floats:
        """For each channel the smallest and the largest value, where so many cells stand at it that it may be a clamp.

        Shape (2, channels), infinite where it is none.
        """
        found = np.full((2, self.values.shape[-1]), (-np.inf,), dtype=np.float64)
        found[1] = np.inf
        for channel in range(self.values.shape[-1]):
            known = self.values[..., channel][np.isfinite(self.values[..., channel])]
            if known.size == 0 or np.count_nonzero((known > known.min()) & (known < known.max())) < INSIDE * known.size:
                continue
            for side, end in enumerate((np.min, np.max)):
                if np.count_nonzero(known == end(known)) >= max(PLATEAU, 0.005 * known.size):
                    found[side, channel] = end(known)
        return found

    def beyond(self, truth: Floats) -> NDArray[np.bool_]:
        """The cells that stand at a plateau which the truth exceeds by more than is forgiven."""
        low, high = self.ends()
        slack = self.rounding + self.tolerance
        above, below = (self.values == high) & (truth > high + slack), (self.values == low) & (truth < low - slack)
        return np.asarray(above | below)


@dataclass(frozen=True)
class Hypothesis:
    """A form of a variant over axes, in the order in which the table has them."""

    variant: Variant
    form: Form
    axes: tuple[Axis, ...]

    @property
    def names(self) -> tuple[str, ...]:
        """What runs along the axes."""
        return tuple(axis.name for axis in self.axes)

    @property
    def oddity(self) -> int:
        """On how many axes the layout is one that nobody means: of two that explain a table alike, the usual one is taken."""
        return sum(not usual_shift(axis) for axis in self.axes)


@dataclass(frozen=True, eq=False)
class Fit:
    """A hypothesis with its truth in every cell that was looked at: shape (*sizes, channels).

    `deviation` is the table minus the truth, NaN where either is not known, 0 where the table may have been clamped.
    """

    hypothesis: Hypothesis
    truth: Floats
    bound: Floats
    deviation: Floats
    excess: Floats
    """What the deviation leaves beyond rounding and bound."""
    floor: float
    explained: int = 0
    """How many defects have been taken off."""

    @property
    def judged(self) -> NDArray[np.bool_]:
        """The cells with a deviation."""
        return np.isfinite(self.deviation)

    @property
    def score(self) -> float:
        """The mean excess, not below a hundredth of the tolerance: less than that is no difference."""
        return max(float(np.mean(self.excess[self.judged])), self.floor) if np.any(self.judged) else math.inf

    @property
    def rms(self) -> float:
        """Of the deviations."""
        return float(np.sqrt(np.mean(np.square(self.deviation[self.judged])))) if np.any(self.judged) else math.nan

    @property
    def largest(self) -> float:
        """Of the deviations, without its sign."""
        return float(np.max(np.abs(self.deviation[self.judged]), initial=0.0))

    @property
    def place(self) -> tuple[int, ...]:
        """The cell (and channel) of the largest deviation."""
        at = np.argmax(np.where(self.judged, np.abs(self.deviation), -1.0))
        return tuple(int(i) for i in np.unravel_index(at, self.deviation.shape))

    @property
    def within(self) -> bool:
        """Whether every cell is within the tolerance."""
        return bool(np.any(self.judged)) and float(np.max(self.excess[self.judged])) <= 100.0 * self.floor

    def where(self, place: Sequence[int]) -> str:
        """A cell in words: its indices, and the values of the variables."""
        *indices, channel = place
        values = (f"{axis.name} = {nodes(axis)[i]:.5g}" for axis, i in zip(self.hypothesis.axes, indices, strict=True))
        of = self.hypothesis.form.channels
        named = f", {of[channel][0]}" if len(of) > 1 else ""
        return f"[{']['.join(map(str, indices))}] ({', '.join(values)}{named})"


def better(one: Fit, other: Fit) -> bool:
    """Whether one explains the table so much more closely than the other that it is no accident.

    Either its mean excess is PLAINLY smaller; or the likelihood ratio of Laplace's law is CERTAIN over the number of cells that
    count: neighbours that deviate alike count as one.
    """
    if one.score * PLAINLY <= other.score:
        return True
    return effective(one) * math.log(other.score / one.score) > CERTAIN if one.score < other.score else False


def effective(fit: Fit) -> float:
    """How many independent deviations there are, from how alike neighbours are along each axis (an autoregression of order 1)."""
    count = float(np.count_nonzero(fit.judged))
    for axis in range(fit.deviation.ndim - 1):
        count *= (1.0 - (alike := max(correlation(fit.deviation, axis), 0.0))) / (1.0 + alike)
    return count


def correlation(deviation: Floats, axis: int) -> float:
    """How alike neighbours along an axis are: the correlation of their signs' sizes, ranks instead of values."""
    signs = np.sign(deviation) * np.sqrt(np.abs(deviation))
    a, b = (np.take(signs, range(*ends), axis=axis) for ends in ((0, signs.shape[axis] - 1), (1, signs.shape[axis])))
    known = np.isfinite(a) & np.isfinite(b)
    a, b = a[known], b[known]
    norm = math.sqrt(float(a @ a) * float(b @ b))
    return float(a @ b) / norm if norm > 0.0 else 0.0


def fitted(
    observed: Observed,
    lab: Lab,
    hypothesis: Hypothesis,
    picks: Sequence[NDArray[np.intp]] | None = None,
    limits: bool = True,
) -> Fit | None:
    """A hypothesis computed exactly, in all cells or in the grid of those picked; None where the variant has no such form.

    Without `limits` the cells at mu = 0 are left out: each costs as much as hundreds of others, and many tables have none there.
    """
    values = [nodes(axis) for axis in hypothesis.axes]
    if not limits:
        values = [
            np.where(v == 0.0, np.nan, v) if axis.name == MU else v for axis, v in zip(hypothesis.axes, values, strict=True)
        ]
    table = observed.values
    if picks is not None:
        values = [v[pick] for v, pick in zip(values, picks, strict=True)]
        table = table[np.ix_(*picks)]
    found = lab.exact(hypothesis.variant, hypothesis.form, hypothesis.names, values)
    if found is None:
        return None
    truth, bound = found
    low, high = observed.ends()
    deviation = np.where(np.isfinite(table), table, np.nan) - truth
    clamped = ((table == high) & (truth > high)) | ((table == low) & (truth < low))
    deviation = np.where(clamped & np.isfinite(deviation), 0.0, deviation)
    excess = np.maximum(np.abs(deviation) - observed.rounding - bound, 0.0)
    return Fit(hypothesis, truth, bound, deviation, excess, 0.01 * observed.tolerance)


def picked(sizes: Sequence[int], most: int, margin: int = 0) -> list[NDArray[np.intp]]:
    """Up to so many indices along each axis, `margin` away from both ends where there is room."""
    rims = [margin if n > 4 * margin else 0 for n in sizes]
    return [
        np.unique(np.rint(np.linspace(rim, n - 1 - rim, min(n, most))).astype(np.intp))
        for n, rim in zip(sizes, rims, strict=True)
    ]


@dataclass(frozen=True)
class Screened:
    """A layout with its score on the surface; `affine` is what a factor and an offset leave of it."""

    hypothesis: Hypothesis
    score: float
    affine: float


def screened(
    observed: Observed, lab: Lab, variant: Variant, forms: Sequence[Form], runs: tuple[Run, ...], expected: Expectation
) -> list[Screened]:
    """The best layouts of a variant: those of the lowest scores, plain and affine, and of the expected ones the best."""
    several = len(observed.sizes)
    picks = picked(observed.sizes, SUBGRID[several])
    table = observed.values[np.ix_(*picks)]
    low, high = observed.ends()
    fields = {name: lab.surface(variant, name, runs) for name in set().union(*(form.fields for form in forms))}
    found: list[tuple[Screened, bool]] = []
    for order in permutations(range(several)):
        own = [_tried(runs[v], size, several) for v, size in zip(order, observed.sizes, strict=True)]
        spread = {
            name: _spread(np.transpose(field, order), [runs[v] for v in order], own, picks)
            for name, field in fields.items()
            if field is not None
        }
        for form in forms:
            if not form.fields <= set(spread):
                continue
            scores, affine = _scores(form, spread, table, low, high)
            wanted = _wanted(expected, variant, form, own, scores)
            unshifted = np.all(np.meshgrid(*([usual_shift(axis) for axis in axes] for axes in own), indexing="ij"), axis=0)
            for at in dict.fromkeys(_best(scores, affine, wanted, unshifted, KEPT[several])):
                hypothesis = Hypothesis(variant, form, tuple(axes[i] for axes, i in zip(own, at, strict=True)))
                found.append((Screened(hypothesis, float(scores[at]), float(affine[at])), bool(wanted[at])))
    plain = sorted((each for each, _ in found), key=lambda each: each.score)[: KEPT[several]]
    affine_best = sorted((each for each, _ in found), key=lambda each: each.affine)[: KEPT[several]]
    said = sorted((each for each, as_said in found if as_said), key=lambda each: each.score)[:2]
    usual = [each for each, _ in found if not each.hypothesis.oddity]
    usual = sorted(usual, key=lambda each: each.score)[:2] + sorted(usual, key=lambda each: each.affine)[:2]
    return list({each.hypothesis: each for each in (*plain, *affine_best, *said, *usual)}.values())


def _wanted(
    expected: Expectation, variant: Variant, form: Form, own: Sequence[Sequence[Axis]], scores: Floats
) -> NDArray[np.bool_]:
    """The layouts that are as was said."""
    if not expected.allows_form(variant, form):
        return np.zeros(scores.shape, dtype=np.bool_)
    single = [np.array([expected.allows_axis(axis, place) for axis in axes]) for place, axes in enumerate(own)]
    return np.asarray(np.all(np.meshgrid(*single, indexing="ij"), axis=0))


def _tried(run: Run, size: int, several: int) -> tuple[Axis, ...]:
    """The layouts of one axis; fewer where there are three, of which all combinations would be too many."""
    return run.axes(size) if several < 3 else Run(run.name, run.low, run.high, run.mappings[:2]).axes(size, (0.0,))


def _spread(field: Floats, runs: Sequence[Run], tried: Sequence[Sequence[Axis]], picks: Sequence[NDArray[np.intp]]) -> Floats:
    """A field at the picked nodes of all layouts: shape (layouts of each axis, picked nodes of each axis)."""
    several = len(runs)
    for dimension, (run, axes, pick) in enumerate(zip(runs, tried, picks, strict=True)):
        matrix = weights(run, several, np.concatenate([nodes(axis)[pick] for axis in axes]))
        field = np.moveaxis(np.tensordot(matrix, field, axes=(1, dimension)), 0, dimension)
    shape = [n for axes, pick in zip(tried, picks, strict=True) for n in (len(axes), len(pick))]
    return np.transpose(field.reshape(shape), [*range(0, 2 * several, 2), *range(1, 2 * several, 2)])


def _scores(form: Form, spread: dict[str, Floats], table: Floats, low: Floats, high: Floats) -> tuple[Floats, Floats]:
    """The mean deviation of every layout, and the RMS of what a positive factor and an offset leave."""
    several = table.ndim - 1
    inner = tuple(range(-several, 0))
    known = np.isfinite(table)
    ends = [np.arange(n) % (n - 1) != 0 if n > SMALL else np.ones(n, dtype=np.bool_) for n in table.shape[:-1]]
    within = np.all(np.meshgrid(*ends, indexing="ij"), axis=0)  # at the limits the surface is too far off for mean squares
    total = affine = np.zeros(())
    for channel, (_, constant, factors) in enumerate(form.channels):
        use = known[..., channel]
        count = max(int(np.count_nonzero(use)), 1)
        values = np.where(use, table[..., channel], 0.0)
        truth = constant + sum(factor * spread[name] for name, factor in factors)
        held = np.clip(truth, low[channel], high[channel])
        total = total + np.sum(np.where(use, np.abs(values - held), 0.0), axis=inner) / count
        use = use & within
        count = max(int(np.count_nonzero(use)), 1)
        values = np.where(use, values, 0.0)
        centred = values - np.sum(values) / count
        others = np.where(use, truth - np.sum(np.where(use, truth, 0.0), axis=inner, keepdims=True) / count, 0.0)
        common = np.sum(others * centred, axis=inner)
        along = np.maximum(common, 0.0) ** 2 / np.maximum(np.sum(others * others, axis=inner), 1e-30)
        affine = affine + np.sqrt(np.maximum(np.sum(np.where(use, centred, 0.0) ** 2) - along, 0.0) / count)
    return total / len(form.channels), affine / len(form.channels)


def _best(
    scores: Floats, affine: Floats, wanted: NDArray[np.bool_], unshifted: NDArray[np.bool_], kept: int
) -> Iterator[tuple[int, ...]]:
    """Where the lowest scores are: overall, after a factor and an offset, among what was expected, and without shifts."""
    among = ((np.where(mask, values, np.inf), 2) for mask in (wanted, unshifted) for values in (scores, affine))
    for values, count in ((scores, kept), (affine, kept), *among):
        for flat in np.argsort(values, axis=None, kind="stable")[:count]:
            at = tuple(int(i) for i in np.unravel_index(flat, values.shape))
            if np.isfinite(values[at]):
                yield at
