"""What must hold at every pair of directions: f is finite, not negative, and the same both ways.

A crowd of pairs is evaluated, the worst of them are searched for worse neighbours, and the worst of all is the witness. What is
judged is the shape, `evaluate`: a constant changes none of the three, and one of 0 would hide them.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from albedo_lab import catalogue
from albedo_lab.analysis import crowd
from albedo_lab.analysis.crowd import Array, Pairs
from albedo_lab.analysis.verdict import Finding, Subject, Trial, Verdict
from albedo_lab.errors import BadInput
from albedo_lab.estimate.record import Question
from albedo_lab.kernels.search import GIVEN, sample_kernel, value_kernel
from albedo_lab.model import Model, Reciprocal
from albedo_lab.optics.frame import Direction

MOST_PAIRS = 1 << 17
ASYMMETRY = 1e-10
"""Relative difference of f(a, b) and f(b, a) that is forgiven. No model of the catalogue that is reciprocal exceeds 1e-15,
n = 1e8 and m = 1e-4 included; a formula that adds up in another order may lose a few digits more."""
SHAKES, MORE_SHAKES = 2, 16
"""How often the directions are shaken by an ulp: at every pair that differs, and at those that may convict."""
PER_ULP = 64.0
"""An asymmetry is forgiven that is so many times what an ulp's change of the directions makes of f."""
UNDERFLOW = 1e-290
"""Numbers below have lost digits, or are about to."""
NEGATIVE = 1e-12
"""Depth below 0 that is rounding, relative to the largest |f| close by or to the mean, whichever is larger."""
UNIT = 1e-6
"""How far the square of a sampled direction's length may be from 1."""
RAREST, LAST = 2.0**-50, 1.0 - 2.0**-33
"""The smallest and the largest uniform that a sampler is ever given."""
COSINES = np.concatenate([[1.0], np.linspace(0.95, 0.05, 19), np.geomspace(1e-2, 1e-12, 21)])
STARTS, NEIGHBOURS, ROUNDS = 16, 128, 6
LOOK_AROUND, CLOSE = 16, 1e-3
MOST_LOOKED_AT = 1 << 12
DEARER = 1 << 4
"""A crowd's pair costs fewer evaluations than that, with the search for worse ones."""
NEARLY = 0.9
"""A witness shows at least that share of the largest asymmetry, or of the most negative f."""


def finiteness(subject: Subject, trial: Trial) -> list[Finding]:
    """Whether f is finite everywhere, and density, samples and their weights where there is a sampler.

    One finding; its figure is the share of values that are not finite, or no directions or densities at all.
    """
    seen = _seen(subject.model, subject.p, *_crowd_of(trial))
    faults = [_non_finite(subject, seen), _bad_mirror(subject, "not finite", lambda r: not math.isfinite(r))]
    if subject.model.sample is not None or subject.model.pdf is not None:
        faults += _sampling_faults(subject, seen, trial)
    counts = {fault.what: fault.count for fault in faults}
    tried = sum(fault.tried for fault in faults)
    found = [fault for fault in faults if fault.count]
    share = sum(fault.count for fault in found) / tried
    told = "; ".join(f"{fault.count} of {fault.tried}: {fault.what}" for fault in found) or f"all of {tried} values are finite"
    unsampled = "" if subject.model.sample is not None else "; it has no sampler to try"
    verdict = Verdict.FAIL if found else Verdict.PASS
    witness = found[0].witness if found else ""
    return [Finding("finiteness", verdict, share, 0.0, told + unsampled, witness, details=counts)]


def positivity(subject: Subject, trial: Trial) -> list[Finding]:
    """Whether f is nowhere negative.

    One finding; its figure is the depth of the most negative f beyond what rounding of the directions explains, relative to the
    largest |f| close by or to the mean of |f| under a white sky, whichever is larger.
    """
    seen = _seen(subject.model, subject.p, *_crowd_of(trial))
    claim = "" if subject.model.positive else "not promised"
    mirror = _bad_mirror(subject, "negative", lambda r: r < 0.0)
    if mirror.count:
        return [Finding("positivity", Verdict.FAIL, 1.0, NEGATIVE, f"the Dirac part is {mirror.what}", mirror.witness, claim)]
    known = np.isfinite(seen.f)
    if not np.any(known):
        return [Finding("positivity", Verdict.INCONCLUSIVE, math.nan, NEGATIVE, "f is finite nowhere", claim=claim)]
    below = np.flatnonzero(known & (seen.f < 0.0))
    details = {"pairs": len(seen.f), "negative": len(below)}
    if not len(below):
        told = f"f is not negative at any of {len(seen.f)} pairs"
        return [Finding("positivity", Verdict.PASS, 0.0, NEGATIVE, told, claim=claim, details=details)]
    pairs, depth = _deepest(subject, seen, below, np.random.default_rng([trial.seed, 2]))
    f = _values(subject, pairs)
    deep = depth > NEGATIVE
    worst = int(np.argmin(np.where(deep, f, np.inf)) if np.any(deep) else np.argmax(depth))
    told = f"f is negative at {len(below)} of {len(seen.f)} pairs, {f[worst]:.3g} at the lowest"
    if not np.any(deep):
        told += ", by rounding"
        return [Finding("positivity", Verdict.PASS, float(depth[worst]), NEGATIVE, told, claim=claim, details=details)]
    plainest = _plainest(pairs, np.where(deep & (f <= NEARLY * f[worst]), -f, 0.0))
    witness = _witness_at(subject, pairs, plainest, {"f(wi, wo)": float(f[plainest])})
    return [Finding("positivity", Verdict.FAIL, float(depth[worst]), NEGATIVE, told, witness, claim, details=details)]


def reciprocity(subject: Subject, trial: Trial) -> list[Finding]:
    """Whether f(wi, wo) = f(wo, wi).

    One finding; its figure is the largest relative difference beyond what rounding of the directions explains. The white-sky norm
    (the integral of |f(a, b) - f(b, a)| cos cos over that of f cos cos) is told with it. A model that is declared
    not to be reciprocal is convicted all the same.
    """
    seen = _seen(subject.model, subject.p, *_crowd_of(trial))
    claim = _reciprocity_claim(subject.model)
    if not np.any(np.isfinite(seen.f) & np.isfinite(seen.g)):
        return [Finding("reciprocity", Verdict.INCONCLUSIVE, math.nan, ASYMMETRY, "f is finite nowhere", claim=claim)]
    rng = np.random.default_rng([trial.seed, 3])

    first = _asymmetry(subject, seen.pairs, seen.f, seen.g, rng, SHAKES)
    unequal = int(np.count_nonzero(first > ASYMMETRY))
    doubtful = np.argsort(-first, kind="stable")[: min(unequal, MOST_LOOKED_AT)]
    pairs = seen.pairs.at(doubtful)
    scores = _difference(subject, pairs, rng, MORE_SHAKES)
    if not np.any(scores > ASYMMETRY):
        first[doubtful], unequal = scores, 0
    norm, error = _white_sky(seen)
    details = {"pairs": len(first), "unequal": unequal, "white_sky_norm": norm, "white_sky_norm_error": error}
    if not unequal:
        told = f"f(wi, wo) and f(wo, wi) agree at all of {len(first)} pairs; white-sky norm of their difference {norm:.2g}"
        return [Finding("reciprocity", Verdict.PASS, float(np.max(first)), ASYMMETRY, told, claim=claim, details=details)]
    climbed = _climbed(pairs, scores, lambda moved: _difference(subject, moved, rng, SHAKES), rng)[0]
    pairs, scores = crowd.joined(pairs, climbed), np.concatenate([scores, _difference(subject, climbed, rng, MORE_SHAKES)])
    largest = float(np.max(scores))
    f, g = _values(subject, pairs), _values(subject, pairs.swapped())
    plainest = _plainest(pairs, np.where(scores >= NEARLY * largest, np.abs(f) + np.abs(g), 0.0))
    values = {"f(wi, wo)": float(f[plainest]), "f(wo, wi)": float(g[plainest])}
    witness = _witness_at(subject, pairs, plainest, values)
    told = (
        f"f(wi, wo) and f(wo, wi) differ by up to {largest:.3g} of the larger, at {unequal} of {len(first)} pairs; "
        f"white-sky norm of their difference {norm:.3g} +- {error:.1g}"
    )
    return [Finding("reciprocity", Verdict.FAIL, largest, ASYMMETRY, told, witness, claim, details=details)]


def witness_text(subject: Subject, wi: Direction, wo: Direction, values: Mapping[str, float]) -> str:
    """Where it is seen, the values that are seen there (of the shape), and a line of Python that shows the first of them."""
    told = ", ".join(f"{name} = {value:.9g}" for name, value in values.items())
    return f"wi at {_place(wi)}, wo at {_place(wo)}: {told}; {reproduction(subject)}{_plain(wi)}, {_plain(wo)})"


def reproduction(subject: Subject) -> str:
    """Python up to the first direction of a call of `evaluate`."""
    model = subject.model
    given = {
        name: value
        for name, value in model.columns(subject.p).items()
        if name not in model.chosen and not any(q.sets for q in model.parameters if q.name == name)
    }
    return f"m = {_origin(model)}; m.evaluate(m.bind({given!r}), "


def _origin(model: Model) -> str:
    """How to come by the model: by the catalogue, unless it is somebody's own."""
    try:
        if catalogue.find(model.name).member(model.chosen)[0] is model:
            return f"find({model.name!r})" + (f".member({dict(model.chosen)!r})[0]" if model.chosen else "")
    except (BadInput, ModuleNotFoundError):
        pass
    return "model"


def _place(w: Direction) -> str:
    """In degrees; near grazing by the cosine."""
    theta = math.degrees(math.atan2(math.hypot(w.x, w.y), w.z))
    phi = math.degrees(math.atan2(w.y, w.x)) % 360.0
    height = f"mu {w.z:.6g}" if theta > 89.9 else f"theta {theta:.6g} deg"
    return f"{height}, phi {phi:.6g} deg"


def _plain(w: Direction) -> str:
    return f"Direction({float(w.x)!r}, {float(w.y)!r}, {float(w.z)!r})"


def _witness_at(subject: Subject, pairs: Pairs, which: int, values: Mapping[str, float]) -> str:
    return witness_text(subject, Direction(*pairs.wi[which]), Direction(*pairs.wo[which]), values)


# The crowd


@dataclass(frozen=True, slots=True)
class _Seen:
    """A crowd of pairs with f at them and at the swapped ones; `weights` belong to the last of them, those under a white sky."""

    pairs: Pairs
    f: Array
    g: Array
    weights: Array


def _crowd_of(trial: Trial) -> tuple[int, int]:
    """The seed, and the number of pairs that the budget affords."""
    return trial.seed, min(MOST_PAIRS, max(trial.budget // DEARER, DEARER))


@lru_cache(maxsize=1)
def _pairs(seed: int, count: int) -> tuple[Pairs, Array]:
    rng = np.random.default_rng([seed, 1])
    under_sky, weights = crowd.sky(count // 2, rng)
    return crowd.joined(crowd.corners(), crowd.scattered(count // 2, rng), under_sky), weights


@lru_cache(maxsize=2)
def _seen(model: Model, p: Any, seed: int, count: int) -> _Seen:
    """The three checks share it."""
    pairs, weights = _pairs(seed, count)
    return _Seen(pairs, _values_of(model, p, pairs), _values_of(model, p, pairs.swapped()), weights)


def _values(subject: Subject, pairs: Pairs) -> Array:
    return _values_of(subject.model, subject.p, pairs)


def _values_of(model: Model, p: Any, pairs: Pairs) -> Array:
    """f at every pair."""
    f = np.empty(len(pairs))
    value_kernel(model)(Question(model, p, None).values, pairs.wi, pairs.wo, f)
    return f


def _climbed(pairs: Pairs, scores: Array, score: Callable[[Pairs], Array], rng: np.random.Generator) -> tuple[Pairs, Array]:
    """The pairs of highest score, each moved to the best of its neighbours, several times; their scores with them."""
    best = np.argsort(-scores, kind="stable")[:STARTS]
    pairs, scores = pairs.at(best), scores[best]
    row = np.arange(len(best))
    for _ in range(ROUNDS):
        neighbours = crowd.around(pairs.at(np.repeat(row, NEIGHBOURS)), rng)
        found = score(neighbours).reshape(len(row), NEIGHBOURS)
        winner = np.argmax(found, axis=1)
        moved = neighbours.at(row * NEIGHBOURS + winner)
        better = found[row, winner] > scores
        pairs = Pairs(*(np.where(better[:, None], a, b) for a, b in zip((moved.wi, moved.wo), (pairs.wi, pairs.wo), strict=True)))
        scores = np.where(better, found[row, winner], scores)
    return pairs, scores


# Reciprocity


def _difference(subject: Subject, pairs: Pairs, rng: np.random.Generator, shakes: int) -> Array:
    """The asymmetry of pairs whose f is not known yet."""
    return _asymmetry(subject, pairs, _values(subject, pairs), _values(subject, pairs.swapped()), rng, shakes)


def _asymmetry(subject: Subject, pairs: Pairs, f: Array, g: Array, rng: np.random.Generator, shakes: int) -> Array:
    """|f - g| over the larger, less what rounding of the directions explains; 0 where either is not finite or both underflow.

    Rounding is looked at only where the difference is not forgiven anyhow.
    """
    with np.errstate(invalid="ignore", over="ignore"):
        size = np.maximum(np.abs(f), np.abs(g))
        known = np.isfinite(f) & np.isfinite(g) & (size > UNDERFLOW)
        relative = np.where(known, np.abs(f - g), 0.0) / np.where(known, size, 1.0)
    doubtful = np.flatnonzero(relative > ASYMMETRY)
    if not len(doubtful):
        return relative
    some, noise = pairs.at(doubtful), np.zeros(len(doubtful))
    with np.errstate(invalid="ignore", over="ignore"):
        for _ in range(shakes):
            moved = crowd.shaken(some, rng)
            for new, old in ((moved, f), (moved.swapped(), g)):
                change = np.abs(_values(subject, new) - old[doubtful])
                noise = np.maximum(noise, np.where(np.isfinite(change), change, np.inf))
        explained = PER_ULP * noise / size[doubtful]
    relative[doubtful] = np.maximum(relative[doubtful] - explained, 0.0)
    return relative


def _plainest(pairs: Pairs, brightness: Array) -> int:
    """Of several witnesses the one that carries most light under a white sky: neither grazing nor where f has vanished."""
    return int(np.argmax(np.where(np.isfinite(brightness), brightness, 0.0) * _light(pairs)))


def _light(pairs: Pairs) -> Array:
    """Product of the cosines."""
    product: Array = pairs.wi[:, 2] * pairs.wo[:, 2]
    return product


def _white_sky(seen: _Seen) -> tuple[float, float]:
    """The integral of |f - g| over that of the mean of both, and its standard error; pairs without a finite f are left out."""
    f, g = seen.f[-len(seen.weights) :], seen.g[-len(seen.weights) :]
    known = np.isfinite(f) & np.isfinite(g)
    with np.errstate(over="ignore", invalid="ignore"):
        apart = np.where(known, seen.weights * np.abs(f - g), 0.0)
        both = np.where(known, seen.weights * 0.5 * (f + g), 0.0)
        whole = float(np.sum(both))
        if not 0.0 < whole < math.inf:
            return (0.0, 0.0) if not np.any(apart) else (math.nan, math.nan)
        norm = float(np.sum(apart)) / whole
        return norm, float(np.sqrt(np.sum((apart - norm * both) ** 2))) / whole


def _reciprocity_claim(model: Model) -> str:
    """What the source, or else the model's record, says."""
    places = [claim.place for claim in model.claims if isinstance(claim, Reciprocal)]
    if places:
        return f"reciprocal ({places[0]})"
    return "" if model.reciprocal else "not reciprocal"


# Positivity


def _deepest(subject: Subject, seen: _Seen, below: NDArray[np.int64], rng: np.random.Generator) -> tuple[Pairs, Array]:
    """Pairs of negative f, refined, and how deep each is.

    Starts are both the lowest values and the relatively deepest ones, so that rounding next to a bright lobe hides nothing.
    """
    mean = _mean_size(seen)
    looked_at = below[:: -(-len(below) // MOST_LOOKED_AT)]
    lowest = below[np.argsort(seen.f[below], kind="stable")[:STARTS]]
    depth = _depth(subject, seen.pairs.at(looked_at), mean, SHAKES, rng)
    deepest = looked_at[np.argsort(-depth, kind="stable")[:STARTS]]

    def score(pairs: Pairs) -> Array:
        f = _values(subject, pairs)
        return np.where(np.isfinite(f), -f, -np.inf)

    climbed = [_climbed(seen.pairs.at(starts), -seen.f[starts], score, rng)[0] for starts in (lowest, deepest)]
    plainest = looked_at[np.argsort(seen.f[looked_at] * _light(seen.pairs.at(looked_at)), kind="stable")[:STARTS]]
    pairs = crowd.joined(*climbed, seen.pairs.at(deepest), seen.pairs.at(plainest))
    return pairs, _depth(subject, pairs, mean, MORE_SHAKES, rng)


def _mean_size(seen: _Seen) -> float:
    """The mean of |f| under a white sky, of what is finite."""
    size = np.abs(seen.f[-len(seen.weights) :])
    return float(np.sum(np.where(np.isfinite(size), size, 0.0) * seen.weights))


def _depth(subject: Subject, pairs: Pairs, mean: float, shakes: int, rng: np.random.Generator) -> Array:
    """How far f is below 0, less what rounding explains, relative to what `positivity` says."""
    f = _values(subject, pairs)
    near = crowd.around(pairs.at(np.repeat(np.arange(len(pairs)), LOOK_AROUND)), rng, farthest=CLOSE)
    around = np.abs(_values(subject, near)).reshape(len(pairs), LOOK_AROUND)
    size = np.maximum(np.max(np.where(np.isfinite(around), around, 0.0), axis=1), np.maximum(-f, mean))
    noise = np.zeros(len(pairs))
    with np.errstate(over="ignore", invalid="ignore"):
        for _ in range(shakes):
            change = np.abs(_values(subject, crowd.shaken(pairs, rng)) - f)
            noise = np.maximum(noise, np.where(np.isfinite(change), change, np.inf))
        depth: Array = np.maximum(-f - PER_ULP * noise, 0.0) / np.maximum(size, UNDERFLOW)
        return depth


# Finiteness


@dataclass(frozen=True, slots=True)
class _Fault:
    """Something wrong: how often it was seen, in how many tries, and the first example."""

    what: str
    count: int
    tried: int
    witness: str


def _non_finite(subject: Subject, seen: _Seen) -> _Fault:
    """f itself, both ways."""
    both = crowd.joined(seen.pairs, seen.pairs.swapped())
    f = np.concatenate([seen.f, seen.g])
    return _first(subject, "f is not finite", ~np.isfinite(f), both, "f(wi, wo)", f)


def _first(subject: Subject, what: str, wrong: NDArray[np.bool_], pairs: Pairs, name: str, values: Array) -> _Fault:
    where = np.flatnonzero(wrong)
    witness = _witness_at(subject, pairs, int(where[0]), {name: float(values[where[0]])}) if len(where) else ""
    return _Fault(what, len(where), len(wrong), witness)


def _bad_mirror(subject: Subject, what: str, is_bad: Callable[[float], bool]) -> _Fault:
    """The reflectance of the Dirac part."""
    bad = [(float(mu), r) for mu in COSINES if is_bad(r := _reflectance(subject, float(mu)))]
    witness = f"mirror(p, {bad[0][0]!r}) = {bad[0][1]:.9g}" if bad else ""
    return _Fault(f"reflectance of the Dirac part is {what}", len(bad), len(COSINES), witness)


def _reflectance(subject: Subject, mu: float) -> float:
    """NaN where plain Python divides by 0 or leaves its domain, which compiled code does not mind."""
    try:
        return float(subject.model.mirror(subject.p, mu))
    except (ArithmeticError, ValueError):
        return math.nan


def _sampling_faults(subject: Subject, seen: _Seen, trial: Trial) -> list[_Fault]:
    """Density at pairs of the crowd; samples for their viewers, the rarest uniforms among them; the samples' weights."""
    model, rng = subject.model, np.random.default_rng([trial.seed, 4])
    given = seen.pairs.at(np.arange(0, len(seen.f), 4))
    uniforms = np.concatenate([np.full((len(given), 2), GIVEN), _uniforms(len(given), rng)])
    pairs = Pairs(np.concatenate([given.wi, given.wi]), np.concatenate([given.wo, given.wo]))
    density = np.empty(len(pairs))
    sample_kernel(model)(Question(model, subject.p, None).values, uniforms, pairs.wi, pairs.wo, density)
    faults = []
    if model.pdf is not None:
        bad = ~((density[: len(given)] >= 0.0) & (density[: len(given)] < np.inf))
        faults.append(_first(subject, "density is negative or not finite", bad, given, "pdf(wi, wo)", density[: len(given)]))
    if model.sample is None:
        return faults
    drawn, density = pairs.at(np.arange(len(given), len(pairs))), density[len(given) :]
    with np.errstate(all="ignore"):
        square = np.sum(drawn.wi * drawn.wi, axis=1)
        no_direction = ~(np.abs(square - 1.0) < UNIT)
        faults.append(_first(subject, "sample is no unit vector", no_direction, drawn, "its square", square))
        accepted = np.flatnonzero(~no_direction & (drawn.wi[:, 2] > 0.0))
        if model.pdf is not None and len(accepted):
            weighed, density = drawn.at(accepted), density[accepted]
            weight = _values(subject, weighed) * weighed.wi[:, 2] / density
            faults.append(
                _first(subject, "density of a sample is not positive", ~(density > 0.0), weighed, "pdf(wi, wo)", density)
            )
            faults.append(_first(subject, "weight of a sample is not finite", ~np.isfinite(weight), weighed, "weight", weight))
    return faults


def _uniforms(count: int, rng: np.random.Generator) -> Array:
    """Two each; an eighth of the first near 0 on a logarithmic scale, a few of either at the ends."""
    u = np.clip(rng.random((count, 2)), 2.0**-33, LAST)
    u[0::8, 0] = RAREST ** rng.random(len(u[0::8]))
    u[0::64, 0], u[1::64, 0], u[2::64, 1], u[3::64, 1] = RAREST, LAST, 2.0**-33, LAST
    return np.minimum(u, LAST)
