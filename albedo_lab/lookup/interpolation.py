"""What a renderer reads between the nodes of a table, and how far that is from the truth.

Textures are read multilinearly in texture coordinates, and beyond the outermost nodes as at these, as GPUs do when they clamp to
the edge. The error of that is measured against the source itself: its RMS at points spread evenly over the texture, its largest
value by a search that begins at the worst of these and of others that crowd at the ends of the axes.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache
from itertools import product
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from albedo_lab.analysis.request import SCALE
from albedo_lab.analysis.rows import Progress, track
from albedo_lab.errors import BadInput, Inconclusive
from albedo_lab.estimate.record import Tolerance
from albedo_lab.lookup.axes import Axis, Floats
from albedo_lab.lookup.source import MU, QUANTITIES, Found, Source
from albedo_lab.lookup.table import Table
from albedo_lab.model import Maximum

FEWEST, MOST = 16, 1 << 20
FEWEST_EACH = 2
"""Places in each cell without which nobody knows how much the error scatters there."""
PLAIN_SHARE = 0.75
"""Of the places, what all cells may share alike; the rest goes where the error is."""
FINER = 0.25 ** np.arange(1, 5)
"""Where the outermost cells are cut once more."""
TINY = 1e-300
CLOSEST = 1e-12
"""How near to an end of an axis, in texture coordinates, the largest error is looked for."""
STARTS = 8
COARSE, FINE = 1.0 / 8.0, 1.0 / 32.0
"""Of a cell: the last steps of all climbs, and of the highest. Half a step beside the peak of a parabola over the cell 1.6 % and
0.1 % of the error are missed, and little of that once the vertex through the last places has been tried."""
SMALL_SHARE = 1e-3
"""Of the error that is measured: how wide the truth may be known there."""
FIRST_DECADES, GROWING = 1e-9, 1e-3
"""Where grazing begins for an albedo without a limit, and by how much it grows in the next three decades."""
LOOSER = (1.0, 1e2, 1e4)
"""Factors of the tolerance with which the truth is asked for, where it cannot be had as precisely as the table."""


@dataclass(frozen=True)
class Interpolation:
    """How far a table read between its nodes is from the truth; of several channels the worst counts.

    largest, largest_at
        The largest absolute error found, a lower limit as of every search, and the values of the axes' variables there. It is
        infinite, at mu = 0, where the albedo grows without bound towards grazing incidence and the nodes keep away from there.
    largest_bound
        How much the errors of the truth and of the cells around can add to it or take from it.
    rms, rms_error
        The root of the mean square over the texture, every place of which counts alike, and its standard error, to which is
        added what the bounds of the truth can make of it.
    points
        How many places were looked at, those of the search included.
    over
        From where to where each variable was tried. That is the whole axis, but for what no model has a value for: a range beyond
        a parameter's domain, or between 0, where it stands for a limit, and the domain.
    """

    largest: float
    largest_at: dict[str, float]
    largest_bound: float
    rms: float
    rms_error: float
    points: int
    over: dict[str, tuple[float, float]]


def interpolated(table: Table, points: Mapping[str, ArrayLike] | ArrayLike) -> Floats:
    """What a renderer reads from a table: multilinear in the texture coordinates of its axes' variables, clamped to the edge.

    Parameters
    ----------
    table
        One to three axes.
    points
        A value or an array of n values per variable, by their names; or an array of shape (n, axes).

    Returns
    -------
    array
        Shape (n, channels).

    Raises
    ------
    BadInput
        For variables other than those of the axes, and for values at which the mapping of an axis is not a number.
    """
    names = [axis.name for axis in table.axes]
    if isinstance(points, Mapping):
        if set(points) != set(names):
            raise BadInput("points", sorted(points), f"must be values of {', '.join(names)}")
        columns = np.broadcast_arrays(*(np.atleast_1d(np.asarray(points[name], np.float64)) for name in names))
        given = np.stack(columns, axis=-1)
    else:
        given = np.asarray(points, np.float64)
    if given.ndim != 2 or given.shape[1] != len(names):
        raise BadInput("points", f"shape {given.shape}", f"must have shape (n, {len(names)}), for {', '.join(names)}")
    with np.errstate(invalid="ignore", divide="ignore"):
        index = np.stack([axis.index(given[:, i]) for i, axis in enumerate(table.axes)], axis=-1)
    for i, axis in enumerate(table.axes):
        if np.any(np.isnan(index[:, i])):
            value = float(given[np.isnan(index[:, i]), i][0])
            raise BadInput(axis.name, value, f"must be a value at which {axis.label} is a number")
    read = np.zeros((len(index), table.values.shape[-1]))
    for nodes, weight in neighbours(table.axes, index):
        read += weight[:, None] * table.values[tuple(nodes.T)]
    return read


def neighbours(axes: Sequence[Axis], index: Floats) -> Iterator[tuple[NDArray[np.intp], Floats]]:
    """The nodes (n, axes) that a renderer reads for places among them, as `Axis.index` gives these, and their weights (n,)."""
    last = np.array([axis.size for axis in axes]) - 1
    index = np.clip(index, 0.0, last)
    before = np.minimum(np.floor(index), last - 1).astype(np.intp)
    share = index - before
    for corner in product((0, 1), repeat=len(last)):
        yield before + np.array(corner), np.prod(np.where(np.array(corner) == 1, share, 1.0 - share), axis=-1)


def interpolation_error(
    table: Table, points: int | None = None, seed: int = 0, progress: Progress | None = None
) -> Interpolation:
    """The largest and the RMS error of reading a table between its nodes.

    Parameters
    ----------
    table
        Its source is the truth; where that is a rounded table, what is measured includes the rounding.
    points
        The most places that the RMS is measured at, 16 at least: two or more at random in every cell, or in several joined where
        that many are not allowed. By default as many as a second leaves time for, see `default_points`. The search for the
        largest error comes on top, with about as many.
    seed
        The same seed gives the same bits.
    progress
        Called with the number of places done and that of all, but for the last steps of the search.

    Returns
    -------
    Interpolation

    Raises
    ------
    BadInput
        For a number of points that is too small or too large.
    Inconclusive
        Where the truth cannot be had.

    Notes
    -----
    An interpolant cannot follow what is discontinuous. GGX, and every model that becomes a mirror as its width goes to 0, has
    such a corner at alpha = 0, mu = 0: its albedo there depends on the ratio of the two. Near that corner the largest error does
    not shrink as the table grows; `largest_at` then lies in the outermost cell, and the RMS tells how much that matters.
    """
    if not (points is None or enough(points)):
        raise BadInput("points", points, f"must be an integer from {FEWEST} to {MOST}")
    count = default_points(table.source, len(table.axes)) if points is None else points
    search = _Search(table)
    rng = np.random.default_rng([seed, 6])
    pieces = Pieces.of(search, int(PLAIN_SHARE * count / FEWEST_EACH))
    found = search.look(np.concatenate([pieces.centres, search.suspects(), search.crowded(count // 8, rng)]), progress)
    squares = np.square([e.of_channels for e in found[: len(pieces.centres)]])
    places, each = pieces.sampled(np.max(squares, axis=1), count, rng)
    fresh = search.look(places, progress)
    first = np.concatenate([[0], np.cumsum(each)[:-1]])
    squares = np.square([e.of_channels for e in fresh])
    mean = np.add.reduceat(squares, first) / each[:, None]
    variance = np.add.reduceat(np.square(squares - np.repeat(mean, each, axis=0)), first) / ((each - 1) * each)[:, None]
    rms = np.sqrt(pieces.share @ mean)
    worst = int(np.argmax(rms))
    error = math.sqrt(float(np.square(pieces.share) @ variance[:, worst]))
    # the root of a mean square is off by no more than the root of the mean square of the bounds
    off = math.sqrt(float(pieces.share @ (np.add.reduceat(np.square([e.bound for e in fresh]), first) / each)))
    found += fresh
    largest = search.largest(found)
    return Interpolation(
        largest=largest.size,
        largest_at=largest.at,
        largest_bound=largest.bound + float(np.max(table.half_widths)),
        rms=float(rms[worst]),
        rms_error=(error / (2.0 * float(rms[worst])) if rms[worst] > 0.0 else 0.0) + off,
        points=search.asked,
        over=search.over,
    )


def enough(points: object) -> bool:
    """Whether the RMS can be measured at so many places."""
    return isinstance(points, int | np.integer) and not isinstance(points, bool) and bool(FEWEST <= points <= MOST)


def truth(source: Source, at: Mapping[str, float]) -> Found:
    """The source's figures at values of all variables, as precisely as they can be had. Raises Inconclusive and BadInput."""
    for asked in _loosened(source):
        try:
            return asked.at(at)
        except Inconclusive as unknown:
            last = unknown
    raise last


@lru_cache(maxsize=64)
def _loosened(source: Source) -> tuple[Source, ...]:
    """The source with its tolerance and with wider ones, relative too: what grows without bound has no absolute precision."""
    within = source.want.tolerance
    relative = max(within.relative, within.absolute)
    wants = [replace(source.want, tolerance=Tolerance(within.absolute * x, relative * x)) for x in LOOSER]
    return tuple(replace(source, want=want) for want in wants)


def default_points(source: Source, axes: int) -> int:
    """How many places the RMS of a source's table is measured at, unless one says: fewer where the truth takes long.

    An albedo takes 0.1 ms; a mean albedo and a maximum of the albedo, which a model's constant may be, fifty times that. The RMS
    is known to a few per cent then, and its standard error says to how many.
    """
    given = {name for name, _ in source.fixed}
    if not QUANTITIES[source.quantity].directional:
        return 24
    if isinstance(source.member.scale, Maximum) and SCALE.name not in given and axes > 1:
        return 256
    return (1 << 8, 1 << 10, 1 << 12)[axes - 1]


class Seen(NamedTuple):
    """The error at one place: its texture coordinates, the variables' values, the error of each channel, and how sure it is."""

    t: Floats
    at: dict[str, float]
    of_channels: Floats
    bound: float

    @property
    def size(self) -> float:
        """The worst channel's."""
        return float(np.max(self.of_channels))


@dataclass(frozen=True, eq=False)
class Pieces:
    """The texture cut into boxes, (n, axes) each of the lower and of the upper corners, in texture coordinates."""

    low: Floats
    high: Floats

    @classmethod
    def of(cls, search: _Search, most: int) -> Pieces:
        """The cells of a table, or so many of them joined that there are `most` boxes at most."""
        along = int(most ** (1.0 / len(search.low)) + 1e-9)
        edges = [_edges(axis, a, b, along) for axis, a, b in zip(search.table.axes, search.low, search.high, strict=True)]
        corners = [np.meshgrid(*side, indexing="ij") for side in ([e[:-1] for e in edges], [e[1:] for e in edges])]
        low, high = (np.stack(c, axis=-1).reshape(-1, len(edges)) for c in corners)
        return cls(low, high)

    @property
    def centres(self) -> Floats:
        """Shape (n, axes)."""
        return 0.5 * (self.low + self.high)

    @property
    def share(self) -> Floats:
        """Of the whole, shape (n,)."""
        volume: Floats = np.prod(self.high - self.low, axis=-1)
        share: Floats = volume / volume.sum()
        return share

    def sampled(self, squares: Floats, count: int, rng: np.random.Generator) -> tuple[Floats, NDArray[np.intp]]:
        """`count` places or fewer at random, box after box, and how many in each: more where `squares` say that the error is.

        In a cell the square of an error scatters about as much as it is: places allotted by size are allotted by spread, which
        makes the error of the mean smallest [Neyman 1934]. What allots them has no part in the mean, which is therefore unbiased.
        """
        weight = self.share * squares
        spare = count - FEWEST_EACH * len(weight)
        each = FEWEST_EACH + np.floor(spare * weight / max(float(weight.sum()), TINY)).astype(np.intp)
        low, high = (np.repeat(corner, each, axis=0) for corner in (self.low, self.high))
        return low + (high - low) * rng.random(low.shape), each


class _Search:
    """A table held against its source at places given in texture coordinates."""

    def __init__(self, table: Table) -> None:
        self.table = table
        self.domains = [_domain(table.source, axis) for axis in table.axes]
        spans = [_span(axis, domain) for axis, domain in zip(table.axes, self.domains, strict=True)]
        self.low, self.high = np.array(spans).T
        ends = self._values(np.stack([self.low, self.high]))
        self.over = {axis.name: (float(a), float(b)) for axis, a, b in zip(table.axes, *ends, strict=True)}
        # grazing incidence is a limit: a place close by stands for it
        grazing = np.array([axis.name == MU for axis in table.axes]) & (ends == 0.0)
        self.low += CLOSEST * grazing[0]
        self.high -= CLOSEST * grazing[1]
        self.cell = np.array([axis.coordinates[1] - axis.coordinates[0] for axis in table.axes])
        self.source = _rougher(table.source, SMALL_SHARE * _expected(table))
        self.asked = 0

    def _values(self, t: Floats) -> Floats:
        """The variables' values at texture coordinates (n, axes); rounding takes none out of its domain."""
        columns = [np.clip(axis.values(t[:, i]), *self.domains[i]) for i, axis in enumerate(self.table.axes)]
        return np.stack(columns, axis=-1)

    def look(self, t: Floats, progress: Progress | None = None) -> list[Seen]:
        """The errors at texture coordinates (n, axes)."""
        values = self._values(t)
        read = interpolated(self.table, values)
        names = [axis.name for axis in self.table.axes]
        seen = []
        for i in track(range(len(t)), progress):
            at = dict(zip(names, map(float, values[i]), strict=True))
            right = truth(self.source, at)
            seen.append(Seen(t[i], at, np.abs(read[i] - [e.value for e in right]), max(e.half_width for e in right)))
        self.asked += len(t)
        return seen

    def suspects(self) -> Floats:
        """Places halfway to both neighbours of the nodes where the second differences along an axis are the largest."""
        found = []
        for i, second in enumerate(_second_differences(self.table)):
            if second.size:
                *node, _ = np.unravel_index(int(np.argmax(np.abs(second))), second.shape)
                t = np.array([axis.coordinates[n] for axis, n in zip(self.table.axes, node, strict=True)])
                t[i] += self.cell[i]  # the first node has no second difference
                found += [t - 0.5 * self.cell * (np.arange(len(t)) == i), t + 0.5 * self.cell * (np.arange(len(t)) == i)]
        places: Floats = np.clip(np.array(found).reshape(-1, len(self.low)), self.low, self.high)
        return places

    def crowded(self, count: int, rng: np.random.Generator) -> Floats:
        """Places of which each coordinate stands anywhere, at an end of its axis, or at any scale of distance from one."""
        shape = (count, len(self.low))
        kind, end = rng.integers(3, size=shape), rng.integers(2, size=shape)
        distance = np.choose(kind, (rng.random(shape), CLOSEST ** rng.random(shape), np.zeros(shape)))
        span = self.high - self.low
        places: Floats = np.where(end == 1, self.high - span * distance, self.low + span * distance)
        return places

    def largest(self, seen: list[Seen]) -> Seen:
        """The largest error that a search finds from the worst of these places, one start a cell."""
        starts: dict[tuple[int, ...], Seen] = {}
        for one in sorted(seen, key=lambda s: -s.size):
            starts.setdefault(tuple(np.floor(one.t / self.cell).astype(int)), one)
        directional = QUANTITIES[self.table.source.quantity].directional
        climbed = [self._climbed(one, 1.0, COARSE) for one in list(starts.values())[: STARTS if directional else 1]]
        best = max(climbed, key=lambda s: s.size)
        if directional:
            best = self._climbed(best, 0.5 * COARSE, FINE)
        if self._unbounded(best):
            return best._replace(of_channels=np.array([math.inf]), at=best.at | {MU: 0.0})
        self.source = self.table.source
        return self.look(best.t[None])[0]

    def _climbed(self, best: Seen, step: float, last: float) -> Seen:
        """The best place found by steps of so many cells, and decades of the distance to an end, along each axis, halved."""
        while step >= last:
            tried = self.look(self._around(best.t, step))
            found = max(tried, key=lambda s: s.size)
            if found.size > best.size:
                best = found
            else:
                step *= 0.5
        vertex = np.array([_vertex(best, tried[2 * i], tried[2 * i + 1], i) for i in range(len(best.t))])
        return max(best, *self.look(np.clip(vertex, self.low, self.high)[None]), key=lambda s: s.size)

    def _around(self, t: Floats, step: float) -> Floats:
        """The places that a search tries next: on both sides along each axis, and in an outermost cell at other scales, too."""
        sides = [(i, x) for i in range(len(t)) for x in (t[i] - step * self.cell[i], t[i] + step * self.cell[i])]
        for i in range(len(t)):
            near, toward = (self.low[i], 1.0) if t[i] - self.low[i] <= self.high[i] - t[i] else (self.high[i], -1.0)
            distance = max(abs(t[i] - near), CLOSEST)
            if distance < self.cell[i]:
                sides += [(i, near + toward * distance * 10.0**power) for power in (step, -step)]
        moved = np.tile(t, (len(sides), 1))
        for place, (i, x) in zip(moved, sides, strict=True):
            place[i] = min(max(x, self.low[i]), self.high[i])
        return moved

    def _unbounded(self, best: Seen) -> bool:
        """Whether the largest error grows for ever towards grazing incidence: there is no limit, and no end of growing."""
        if best.at.get(MU, 1.0) > FIRST_DECADES:
            return False
        try:
            truth(self.table.source, best.at | {MU: 0.0})
        except BadInput:
            near, nearer = (max(abs(e.value) for e in truth(self.table.source, best.at | {MU: mu})) for mu in (1e-9, 1e-12))
            return nearer > (1.0 + GROWING) * near
        return False


def _expected(table: Table) -> float:
    """The RMS error that the second differences of the nodes foretell, at most: an eighth of them, along all axes."""
    return math.sqrt(math.fsum(float(np.mean(np.square(d / 8.0))) for d in _second_differences(table) if d.size))


def _second_differences(table: Table) -> list[Floats]:
    """Those of the nodes along each axis, two fewer than it has nodes."""
    return [np.diff(table.values, 2, axis=i) for i in range(len(table.axes))]


def _rougher(source: Source, tolerance: float) -> Source:
    """The source, to no more than that tolerance."""
    within = source.want.tolerance
    wider = Tolerance(max(within.absolute, tolerance), within.relative)
    return replace(source, want=replace(source.want, tolerance=wider))


def _vertex(middle: Seen, before: Seen, after: Seen, i: int) -> float:
    """Where along an axis the parabola through three errors peaks; the place in the middle where it has no peak."""
    x, left, right = (float(seen.t[i]) for seen in (middle, before, after))
    fall_left, fall_right = middle.size - before.size, middle.size - after.size
    curved = fall_left * (right - x) + fall_right * (x - left)
    if not (left < x < right and curved > 0.0):
        return x
    return x + 0.5 * (fall_left * (right - x) ** 2 - fall_right * (x - left) ** 2) / curved


def _domain(source: Source, axis: Axis) -> tuple[float, float]:
    """The values of an axis' variable at which its model has an albedo."""
    if axis.name == MU:
        return 0.0, 1.0
    found = next(parameter for parameter in (*source.member.parameters, SCALE) if parameter.name == axis.name)
    return found.low, found.high


def _span(axis: Axis, domain: tuple[float, float]) -> tuple[float, float]:
    """The texture coordinates between which an axis runs inside a domain."""
    inside = np.clip([axis.first, axis.last], *domain)
    low, high = sorted(float(t) for t in axis.texture(inside))
    return max(low, 0.0), min(high, 1.0)


def _edges(axis: Axis, low: float, high: float, most: int) -> Floats:
    """Where an axis is cut for sampling, into `most` pieces at most: at its nodes, and finer towards its ends.

    Between nodes the error is smooth; but what is discontinuous at an end, as GGX at alpha = 0, leaves most of it close to there.
    """
    nodes = axis.coordinates
    edges: Floats = np.concatenate([[low], nodes[(nodes > low) & (nodes < high)], [high]])
    kept = 0
    if most >= 4 * len(FINER):
        edges = np.unique([*edges, *(low + (edges[1] - low) * FINER), *(high - (high - edges[-2]) * FINER)])
        kept = len(FINER) + 1
    if len(edges) <= most + 1:
        return edges
    inner = np.round(np.linspace(kept, len(edges) - 1 - kept, most + 1 - 2 * kept)).astype(np.intp)
    return np.concatenate([edges[:kept], edges[inner], edges[len(edges) - kept :]])
