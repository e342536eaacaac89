"""From an array to a verdict: what it holds, where it departs from what was said of it, and what is wrong with its cells."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import permutations

import numpy as np

from albedo_lab.analysis.rows import Progress
from albedo_lab.errors import BadInput
from albedo_lab.lookup.audit.defects import Defect, Rest, Trial, begun, cleared, remaining, rest, tried, unbiased
from albedo_lab.lookup.audit.expectation import Expectation
from albedo_lab.lookup.audit.hypotheses import (
    CLOSER,
    FINAL,
    PLAINLY,
    Fit,
    Hypothesis,
    Observed,
    Screened,
    better,
    fitted,
    picked,
    screened,
)
from albedo_lab.lookup.audit.layouts import Run, departures, in_words, plain, run_along, run_of
from albedo_lab.lookup.audit.storage import grain
from albedo_lab.lookup.audit.truth import Lab
from albedo_lab.lookup.audit.variants import Variant, directional, forms, siblings, unusual, usual
from albedo_lab.lookup.axes import Axis, Floats
from albedo_lab.lookup.source import F0, MU, QUANTITIES
from albedo_lab.model import Model

HALF_WAY = 0.5
"""A table is taken for a variant if it lies nearer to it than half the way to any other."""
SPREAD = 0.05
"""Where there is no other: what goes smoothly must be below this share of the table's own standard deviation."""
NEAR = 0.01
"""A mean deviation below this share of it leaves no room for the models that few people use: they are further apart."""
NOISIEST = 0.3
"""What is left, noise or not, must be below this share of it: nine tenths of the variance are explained, or nothing is."""
MOST = 12
"""Hypotheses that are computed in all cells, for evidence."""
TOLD = 0.25
"""Share of the cells that must be left to be judged after all defects, for a table to be what was said."""
LARGE = 8192
"""Values of a table of which fewer are computed, as of means, which cost more."""
SMALL_SQUARE = 8
"""Numbers without a shape may be a square of at least that side."""
LONGEST_LINE = 512
"""Nodes of a table of means without a shape: no longer one is known, and each node costs as much as a hundred albedos."""


@dataclass(frozen=True, eq=False)
class Judgement:
    """What was found of one array. `trial` is None where nothing at all could be held against it."""

    observed: Observed
    expected: Expectation
    trial: Trial | None
    fits: tuple[Fit, ...]
    rivals: tuple[Hypothesis, ...]
    """What explains the table as well as the first."""
    defects: tuple[Defect, ...]
    facts: tuple[Defect, ...]
    known: bool
    """Whether any hypothesis explains the table."""

    @property
    def verdict(self) -> str:
        """sound, defects, undecided or unknown."""
        if not self.known:
            return "unknown"
        if self.rivals:
            return "undecided"
        return "defects" if self.defects else "sound"

    @property
    def fit(self) -> Fit | None:
        """The best hypothesis."""
        return None if self.trial is None else self.trial.fit


def judged(
    values: Floats,
    rounding: float,
    kind: str,
    expected: Expectation,
    lab: Lab,
    tolerance: float,
    progress: Progress | None = None,
) -> Judgement:
    """The judgement of an array as a file holds it. Raises BadInput where its shape is not what was said."""
    judgements: list[Judgement] = []
    for shaped, facts in shapes(values, expected):
        found = _judged(Observed(shaped, rounding, tolerance), kind, expected, lab, progress)
        judgements.append(replace(found, facts=(*facts, *found.facts)))
        if found.known:
            break  # no other shape needs to be tried
    return min(judgements, key=lambda judgement: (not judgement.known, judgement.fits[0].score if judgement.fits else math.inf))


def shapes(values: Floats, expected: Expectation) -> Iterator[tuple[Floats, list[Defect]]]:
    """The array with an axis of channels, in every shape that it may have, the likeliest first; and what to tell of it.

    Raises BadInput.
    """
    said = None if expected.quantity is None else len(QUANTITIES[expected.quantity].channels)
    if expected.axes is not None:
        yield _of_forms(_as_said(values, expected.axes, said))
    elif values.ndim == 1:
        yield from _unrolled(values, said)
    elif values.shape[-1] == said if said else values.shape[-1] in (2, 3, 4):
        yield _of_forms(values)
    elif values.ndim > 3:
        raise BadInput("shape", list(values.shape), "must be of one to three axes, and of channels where there are several")
    else:
        yield values[..., None], []


def _unrolled(values: Floats, channels: int | None) -> Iterator[tuple[Floats, list[Defect]]]:
    """Numbers of which no shape is told: a square, of pixels where they are a few times a square; a line. Raises BadInput."""
    n = values.size
    found = False
    for count in (1, 2, 3) if channels is None else (channels,):
        side = math.isqrt(n // count)
        if side < SMALL_SQUARE or count * side * side != n:
            continue
        found = True
        ways = [("in turn", values.reshape(side, side, count))]
        ways += [("one after the other", np.moveaxis(values.reshape(count, side, side), 0, -1))] if count > 1 else []
        for way, shaped in ways:
            of = f" of {count} channels, {way}" if count > 1 else ""
            told = Defect("shape assumed", f"the file does not tell it; {side} x {side}{of} is what {n} numbers may be")
            kept, facts = _of_forms(shaped)
            yield kept, [told, *facts]
    if n <= LONGEST_LINE and channels in (None, 1):
        yield values[:, None], []
    elif not found:
        raise BadInput("shape", [n], "is one axis only, of too many nodes; say how many each axis has, as in --shape 32x32")


def _as_said(values: Floats, axes: Sequence[Axis], channels: int | None) -> Floats:
    """The array in the shape of the axes, in this order or another. Raises BadInput."""
    sizes = [axis.size for axis in axes]
    for count in (1, 2) if channels is None else (channels,):
        for order in permutations(sizes):
            if values.shape == order and count == 1:
                return values[..., None]
            if values.shape[:-1] == order and values.shape[-1] in (count, 3, 4):
                return values
    for count in (1, 2) if channels is None else (channels,):
        if values.ndim == 1 and values.size == math.prod(sizes) * count:
            return values.reshape(*sizes, count)
    raise BadInput("shape", list(values.shape), f"is not that of the axes, {' x '.join(map(str, sizes))}")


def _of_forms(values: Floats) -> tuple[Floats, list[Defect]]:
    """The first two channels of an image, for no quantity has more; and what the others are."""
    count = values.shape[-1]
    if count <= 2:
        return values, []
    more = values[..., 2:]
    what = "the same in all cells" if all(np.ptp(more[..., i]) == 0.0 for i in range(count - 2)) else "not judged"
    return values[..., :2], [Defect("more channels", f"of {count} channels the first two are judged; what follows is {what}")]


def _judged(observed: Observed, kind: str, expected: Expectation, lab: Lab, progress: Progress | None) -> Judgement:
    grains = _grains(observed, kind)
    if grains:
        observed = replace(observed, rounding=max(observed.rounding, grains[0][1]))
    coarse = [defect for defect, step in grains if step > observed.tolerance]
    told = [defect for defect, step in grains if step <= observed.tolerance]
    asserted = _asserted(observed, expected)
    if asserted is not None:
        fit = fitted(observed, lab, asserted)
        if fit is not None and np.any(fit.judged):
            trial = tried(observed, fit, lab, edges_count=expected.limits)
            if not np.any(trial.off) and np.count_nonzero(np.isfinite(trial.left)) >= TOLD * trial.left.size:
                defects = (*coarse, *trial.defects)  # they explain the table, as said, in every cell: no other needs to be tried
                return Judgement(observed, expected, trial, (fit,), (), defects, (*told, *trial.facts), known=True)
    fits = _fits(observed, expected, lab, asserted, progress)
    if not fits:
        return Judgement(observed, expected, None, (), (), (), (*coarse, *told), known=False)
    return _concluded(observed, expected, lab, fits, coarse, told)


def _grains(observed: Observed, kind: str) -> list[tuple[Defect, float]]:
    """How coarse the numbers are beyond the file's own storage, and the error that it makes."""
    found = grain(observed.values, observed.rounding)
    if found is None or found.name == kind:
        return []
    sentence = f"all values are those of {found.name} though the file holds {kind}: rounded by up to {found.rounding:.2g}"
    return [(Defect("8 bits" if found.name == "8 bits" else "coarse storage", sentence), found.rounding)]


def _asserted(observed: Observed, expected: Expectation) -> Hypothesis | None:
    """The one hypothesis that was said, where nothing is left open."""
    if expected.variant is None or expected.quantity is None or expected.axes is None:
        return None
    axes = tuple(map(plain, expected.axes))
    if tuple(axis.size for axis in axes) != observed.sizes:
        return None
    of = forms(observed.values.shape[-1], any(axis.name == MU for axis in axes), expected.quantity)
    return next((Hypothesis(expected.variant, f, axes) for f in of if f.quantity == expected.quantity and not f.swapped), None)


def _runs(observed: Observed, expected: Expectation) -> tuple[Run, ...]:
    """What may run along the axes."""
    if expected.axes is not None:
        return tuple(map(run_along, expected.axes))
    several = len(observed.sizes)
    alone = several == 1 and expected.quantity is not None and directional(expected.quantity)
    names = [MU] if alone else [_roughness(expected.variant), MU, F0][:several]
    return tuple(map(run_of, names))


def _roughness(variant: Variant | None) -> str:
    """The parameter that people tabulate a model over."""
    if variant is None:
        return "alpha"
    fixed = dict(variant.white)
    member = variant.model.member({name: value for name, value in fixed.items() if name != "scale"})[0]
    free = [parameter.name for parameter in member.parameters if parameter.name not in fixed and parameter.name != F0]
    return "alpha" if "alpha" in free or not free else free[0]


def _variants(expected: Expectation, runs: Sequence[Run]) -> Iterator[tuple[Variant, ...]]:
    """The variants to try, the likeliest first: what was said, what differs from it in a word, what is usual; then the rest."""
    said = expected.variant
    first, others = ([], []) if said is None else ([said], list(siblings(said)))
    names = {run.name for run in runs} - {MU}
    free = F0 in names

    def fit(several: Sequence[Variant]) -> list[Variant]:
        coloured = [replace(v, white=(*v.white, ("F", "schlick")), dark=None) if free else v for v in several]
        return [v for v in coloured if names <= _free(v)]

    if said is not None and said not in usual():
        yield tuple(dict.fromkeys([*first, *others]))  # what else it fixes, the usual ones do not have
        return
    yield tuple(dict.fromkeys([*first, *fit(usual()), *others]))
    yield tuple(dict.fromkeys(fit(unusual())))


def _free(variant: Variant) -> set[str]:
    """The parameters that a variant leaves open."""
    fixed = dict(variant.white)
    member: Model = variant.model.member({name: value for name, value in fixed.items() if name != "scale"})[0]
    return {parameter.name for parameter in member.parameters} - set(fixed)


def _fits(
    observed: Observed, expected: Expectation, lab: Lab, asserted: Hypothesis | None, progress: Progress | None
) -> list[Fit]:
    """The hypotheses that come near, computed in all cells, the best first."""
    runs = _runs(observed, expected)
    over_mu = any(run.name == MU for run in runs)
    of = forms(observed.values.shape[-1], over_mu, expected.quantity)
    closer: list[Fit] = []
    done = total = 0
    step = progress or (lambda done, total: None)
    for variants in _variants(expected, runs):
        total += len(variants)
        for variant in variants:
            step(done, total + FINAL)
            closer += _closer(observed, lab, screened(observed, lab, variant, of, runs, expected))
            done += 1
        if closer and min(fit.score for fit in closer) <= max(observed.tolerance, NEAR * _spread(observed)):
            break  # one of the usual models it is: what few people use need not be tried
    hypotheses = [] if asserted is None else [asserted]
    cheap = len(observed.sizes) == 2 and observed.values.size <= LARGE
    hypotheses += _finalists(closer, expected, cheap=cheap, hopeless=0.0 if cheap else NOISIEST * _spread(observed))
    fits = []
    for count, hypothesis in enumerate(several := list(dict.fromkeys(hypotheses))):
        step(done + count, done + len(several))
        fits.append(fitted(observed, lab, hypothesis, limits=False))
    step(done + len(fits), done + len(fits))
    return sorted((fit for fit in fits if fit is not None and np.any(fit.judged)), key=lambda fit: fit.score)


def _closer(observed: Observed, lab: Lab, found: Sequence[Screened]) -> list[Fit]:
    """Layouts computed exactly on a few lines of the table, with what a bias explains taken off."""
    picks = picked(observed.sizes, CLOSER[len(observed.sizes)], margin=1)
    few = replace(observed, values=observed.values[np.ix_(*picks)])
    fits = (fitted(observed, lab, each.hypothesis, picks) for each in found)
    return [unbiased(few, fit, lab) for fit in fits if fit is not None and np.any(fit.judged)]


def _finalists(closer: Sequence[Fit], expected: Expectation, cheap: bool, hopeless: float) -> list[Hypothesis]:
    """Those of the best score, the best of other variants, and the best of what was said; one if the best score is `hopeless`."""
    order = sorted(closer, key=lambda fit: (fit.score, fit.explained))
    if not order:
        return []
    most = MOST if cheap else 2 * FINAL + 1
    best = order[0].score
    if hopeless and best > hopeless:
        return [order[0].hypothesis]
    chosen = [fit.hypothesis for fit in order if fit.score <= PLAINLY * best][: most - FINAL - 1]
    usual = [fit.hypothesis for fit in order if not fit.hypothesis.oddity]
    said = [fit.hypothesis for fit in order if expected.allows(fit.hypothesis.variant, fit.hypothesis.form, fit.hypothesis.axes)]
    several = {fit.hypothesis.variant: fit.hypothesis for fit in reversed(order)}
    others = sorted(several.values(), key=lambda h: next(i for i, fit in enumerate(order) if fit.hypothesis == h))
    return [*chosen, *said[:1], *usual[:1], *others[:FINAL]]


def _concluded(
    observed: Observed, expected: Expectation, lab: Lab, fits: Sequence[Fit], coarse: list[Defect], told: list[Defect]
) -> Judgement:
    """The best of the fits, where it departs from what was said, and what is wrong with its cells."""
    clear = {fit.hypothesis: unbiased(observed, fit, lab) for fit in fits}
    nearest = min(each.score for each in clear.values())
    for fit in fits:
        if clear[fit.hypothesis].score <= PLAINLY * nearest:
            clear[fit.hypothesis] = cleared(observed, fit, lab)
    order = sorted(fits, key=lambda fit: (clear[fit.hypothesis].score, clear[fit.hypothesis].explained))
    first = clear[order[0].hypothesis]
    alike = [order[0], *(fit for fit in order[1:] if not better(first, clear[fit.hypothesis]))]
    best = min(alike, key=lambda fit: fit.hypothesis.oddity)
    said = [fit for fit in order if expected.allows(fit.hypothesis.variant, fit.hypothesis.form, fit.hypothesis.axes)]
    if said and not better(clear[best.hypothesis], clear[said[0].hypothesis]):
        best = said[0]
    own = clear[best.hypothesis]
    as_said = best in said
    if own.score <= NOISIEST * _spread(observed):  # or nothing explains the table, and limits are dear
        best = fitted(observed, lab, best.hypothesis) or best
    order = [best if fit.hypothesis == best.hypothesis else fit for fit in order]
    trial = tried(observed, best, lab, edges_count=expected.axes is not None and expected.limits)
    left = rest(trial)
    known = _explains(observed, best, left, order)
    if said and not known:
        nearest_said = fitted(observed, lab, said[0].hypothesis) or said[0]
        nowhere = f"it deviates from what was said by up to {nearest_said.largest:.3g}, and nothing that is known explains it"
        where = nearest_said.where(nearest_said.place)
        other = Defect("not as said", nowhere, f"RMS {nearest_said.rms:.3g}, the largest at {where}")
        trial = begun(observed, nearest_said, lab)
        return Judgement(observed, expected, trial, tuple(order), (), (*coarse, other), tuple(told), known=True)
    if not known and not said:
        plain_facts = [defect for defect in trial.defects if defect.name in ("not finite", "negative")]
        return Judgement(observed, expected, trial, tuple(order), (), (), (*coarse, *told, *plain_facts), known=False)
    rivals: tuple[Hypothesis, ...] = ()
    if not as_said:
        rivals = tuple(
            fit.hypothesis
            for fit in order
            if fit.hypothesis != best.hypothesis
            and clear[fit.hypothesis].explained <= own.explained
            and fit.hypothesis.oddity <= best.hypothesis.oddity
            and not better(own, clear[fit.hypothesis])
        )
    departs = list(structure(best.hypothesis, expected))
    native = [defect for defect in departs if defect.name == "texel shift" and (expected.texel or expected.axes is None)]
    defects = [*(defect for defect in departs if defect not in native), *coarse, *trial.defects, *remaining(trial, left)]
    facts = (*told, *native, *trial.facts)
    return Judgement(observed, expected, trial, tuple(order), rivals, tuple(defects), facts, known=True)


def _explains(observed: Observed, best: Fit, left: Rest, fits: Sequence[Fit]) -> bool:
    """Whether the best hypothesis is what the table holds: what deviates smoothly is less than half the way to another variant.

    A table of a model that is not among the hypotheses lies somewhere between them, and is nobody's.
    """
    if left.largest <= observed.tolerance:
        return True
    others = [fit for fit in fits if fit.hypothesis.variant != best.hypothesis.variant and fit.truth.shape == best.truth.shape]
    apart = [float(np.sqrt(np.nanmean(np.square(fit.truth - best.truth)))) for fit in others]
    spread = _spread(observed)
    if left.rms > NOISIEST * spread:
        return False
    return left.smooth <= min([SPREAD * spread, *(HALF_WAY * distance for distance in apart)])


def _spread(observed: Observed) -> float:
    """The standard deviation of all values."""
    return float(np.std(observed.values[np.isfinite(observed.values)]))


def structure(found: Hypothesis, expected: Expectation) -> Iterator[Defect]:
    """Where what was found departs from what was said; of what was not said, only shifts that no convention knows."""
    if expected.variant is not None and found.variant != expected.variant:
        yield Defect("other model", f"the table holds {found.variant.title}, not {expected.variant.title}")
    if expected.quantity is not None and found.form.quantity != expected.quantity:
        lost = {"energy-loss": "albedo", "mean-energy-loss": "mean-albedo"}
        name = "stored as 1 - E" if lost.get(found.form.quantity) == expected.quantity else "other quantity"
        name = "stored as E" if lost.get(expected.quantity) == found.form.quantity else name
        yield Defect(name, f"the table holds {found.form.title}, not {expected.quantity}")
    if expected.quantity is not None and found.form.swapped:
        yield Defect("channels swapped", f"the channels are {found.form.title}")
    if expected.axes is None:
        for axis in found.axes:
            if expected.sampling is not None and (axis.sampling != expected.sampling or axis.shift):
                said = replace(axis, sampling=expected.sampling, shift=0.0)
                yield from (Defect(name, sentence) for name, sentence in departures(axis, said))
            elif axis.shift:
                yield Defect(*next(departures(axis, replace(axis, shift=0.0))))
        return
    said_axes = {axis.name: plain(axis) for axis in expected.axes}
    order = tuple(axis.name for axis in expected.axes)
    if found.names != order:
        yield Defect("axes swapped", f"the axes are {', '.join(found.names)} instead of {', '.join(order)}, the last one fastest")
    for axis in found.axes:
        yield from (Defect(name, sentence) for name, sentence in departures(axis, said_axes[axis.name]))


def described(hypothesis: Hypothesis) -> str:
    """A hypothesis in one line."""
    axes = "; ".join(f"{in_words(axis)}" for axis in hypothesis.axes)
    return f"{hypothesis.form.title} of {hypothesis.variant.title} over {axes}"
