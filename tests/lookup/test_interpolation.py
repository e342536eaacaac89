"""What is read between nodes, against SciPy; how far it is off, against closed forms, and against brute force."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
import pytest
from scipy.interpolate import RegularGridInterpolator

from albedo_lab.analysis.request import effort
from albedo_lab.catalogue import find
from albedo_lab.errors import BadInput
from albedo_lab.estimate.quadrature import quadrature
from albedo_lab.estimate.record import Question, Tolerance, bounded, exact
from albedo_lab.lookup.axes import Axis, Floats, parse_axes
from albedo_lab.lookup.interpolation import interpolated, interpolation_error
from albedo_lab.lookup.source import Found, Source
from albedo_lab.lookup.table import Table, tabulated

WANT = effort(1e-9, "quadrature", 0, None)


@dataclass(frozen=True)
class Formula(Source):
    """A source that is a formula of mu, and of Lambert's albedo rho in [0, 1], which stands for any parameter."""

    f: Callable[..., float | tuple[float, ...]] = lambda mu: mu

    @property
    def channels(self) -> tuple[str, ...]:
        found = self.f(**dict.fromkeys(self.f.__code__.co_varnames[: self.f.__code__.co_argcount], 0.5))
        return ("one", "two") if isinstance(found, tuple) else ("one",)

    def checked(self, variables: tuple[str, ...]) -> Source:
        return self

    def at(self, point: Mapping[str, float]) -> Found:
        found = self.f(**{{"albedo": "rho"}.get(name, name): value for name, value in point.items()})
        return tuple(exact(x) for x in (found if isinstance(found, tuple) else (found,)))


def formula(f: Callable[..., float | tuple[float, ...]]) -> Formula:
    return Formula(find("lambert"), "albedo", WANT, f=f)


def made(f: Callable[..., float | tuple[float, ...]], *axes: str, sampling: str = "endpoints") -> Table:
    return tabulated("t", formula(f), parse_axes(axes, sampling))


def by_scipy(table: Table, points: Floats) -> Floats:
    """Multilinear in texture coordinates with SciPy, clamped to the outermost nodes by hand."""
    grid = [axis.coordinates for axis in table.axes]
    t = np.stack([np.clip(a.texture(points[:, i]), grid[i][0], grid[i][-1]) for i, a in enumerate(table.axes)], axis=-1)
    found: Floats = RegularGridInterpolator(grid, table.values)(t)
    return found


@pytest.mark.parametrize("sampling", ["endpoints", "centres"])
@pytest.mark.parametrize("axes", [["mu=5"], ["sqrt(alpha)=7", "acos(mu)=4"], ["alpha=3@1:0.1", "sqrt(1-mu)=5", "x^2=4"]])
def test_reading_is_multilinear_in_texture_coordinates(axes: Sequence[str], sampling: str) -> None:
    rng = np.random.default_rng(1)
    of = [Axis.parse(text.replace("x^2", "F0^2"), sampling) for text in axes]
    shape = (*(axis.size for axis in of), 2)
    table = Table("t", formula(lambda mu: mu), tuple(of), rng.random(shape), np.zeros(shape), np.zeros(shape), 0)
    points = np.stack([axis.values(rng.random(500)) for axis in of], axis=-1)
    points[:20] = np.stack([axis.values(np.full(20, 1.0)) for axis in of], axis=-1)
    points[20:40] = np.stack([axis.values(np.full(20, 0.0)) for axis in of], axis=-1)
    read = interpolated(table, points)
    assert read.shape == (500, 2)
    assert np.max(np.abs(read - by_scipy(table, points))) < 1e-14
    named = {axis.name: points[:, i] for i, axis in enumerate(of)}
    assert np.array_equal(interpolated(table, named), read)


def test_nodes_are_read_as_they_stand_and_the_edge_beyond() -> None:
    table = made(lambda mu: mu * mu, "mu=8@0.25:0.75", sampling="centres")
    assert np.array_equal(interpolated(table, {"mu": table.axes[0].nodes}), table.values)
    ends = interpolated(table, {"mu": [0.0, 0.26, 0.74, 1.0]})[:, 0]
    assert ends.tolist() == [*[table.values[0, 0]] * 2, *[table.values[-1, 0]] * 2]


NO_POINTS: list[object] = [
    {"mu": 0.5},
    {"mu": 0.5, "beta": 0.1},
    [[0.1, 0.2, 0.3]],
    [0.1, 0.2],
    {"mu": 1.5, "albedo": 0.1},
    [[math.nan, 0.5]],
]


@pytest.mark.parametrize("points", NO_POINTS)
def test_points_that_are_none_are_refused(points: object) -> None:
    table = made(lambda rho, mu: rho * mu, "albedo=3", "sqrt(1-mu)=3")
    with pytest.raises(BadInput):
        interpolated(table, points)  # type: ignore[arg-type]


# Between nodes h apart, the parabola x^2 lies h^2 t (1 - t) below its chord: h^2/4 at most, h^2/sqrt(30) in the mean square.


def test_the_error_of_a_parabola() -> None:
    found = interpolation_error(made(lambda mu: mu * mu, "mu=9"))
    h = 1.0 / 8.0
    assert h * h / 4.0 * (1.0 - 1e-4) <= found.largest <= h * h / 4.0 + found.largest_bound + 1e-15
    assert abs((found.largest_at["mu"] / h) % 1.0 - 0.5) < 0.01
    assert abs(found.rms - h * h / math.sqrt(30.0)) < 4.0 * found.rms_error < 0.1 * found.rms
    assert found.over == {"mu": (0.0, 1.0)}


def test_the_error_of_two_parabolas_that_add_up() -> None:
    """The mean square of t (1 - t) + s (1 - s) is 2/30 + 2/36."""
    found = interpolation_error(made(lambda rho, mu: rho * rho + mu * mu, "albedo=9", "mu=9"))
    h = 1.0 / 8.0
    assert found.largest == pytest.approx(h * h / 2.0, rel=1e-3)
    assert abs(found.rms - h * h * math.sqrt(2 / 30 + 2 / 36)) < 4.0 * found.rms_error < 0.1 * found.rms


def test_where_two_parabolas_oppose_each_other_the_worst_place_is_on_an_edge() -> None:
    found = interpolation_error(made(lambda rho, mu: rho * rho - mu * mu, "albedo=9", "mu=9"))
    assert found.largest == pytest.approx(1.0 / 64.0 / 4.0, rel=1e-3)


def test_clamped_rims_of_centres_count() -> None:
    """x with centres: the outermost half texels are flat, 1/(2n) off at the ends; elsewhere a line is exact."""
    n = 8
    found = interpolation_error(made(lambda mu: mu, f"mu={n}", sampling="centres"))
    assert found.largest == pytest.approx(0.5 / n, rel=1e-9)
    assert min(found.largest_at["mu"], 1.0 - found.largest_at["mu"]) < 1e-9
    true = math.sqrt(2.0 * (0.5 / n) ** 3 / 3.0)
    assert abs(found.rms - true) < 4.0 * found.rms_error < 0.3 * true


def test_the_worse_channel_counts() -> None:
    found = interpolation_error(made(lambda mu: (mu, 2.0 * mu * mu), "mu=5"))
    assert found.largest == pytest.approx(2.0 / 64.0, rel=1e-3)
    assert found.rms == pytest.approx(2.0 / 16.0 / math.sqrt(30.0), rel=0.05)


def test_a_mapping_in_which_the_function_is_a_line_leaves_no_error() -> None:
    found = interpolation_error(made(lambda mu: mu**0.5, "sqrt(mu)=4"))
    assert found.largest < 1e-15
    assert found.rms < 1e-15


def corner(rho: float, mu: float) -> float:
    """Depends on the ratio alone at the corner, as the albedo of GGX does at alpha = 0, mu = 0: no limit there."""
    return rho * rho / (rho * rho + mu * mu) if rho > 0.0 else 0.0


@pytest.mark.parametrize("size", [8, 64])
def test_the_largest_error_at_a_discontinuous_corner_does_not_shrink(size: int) -> None:
    """At rho -> 0 with mu -> 0 much faster, the truth is 1 and the node at the corner 0."""
    found = interpolation_error(made(corner, f"albedo={size}", f"mu={size}"))
    assert 0.99 < found.largest <= 1.0
    assert found.largest_at["albedo"] < 1e-2 / size
    assert found.rms < 0.6 / size


def test_an_albedo_without_bound_has_an_error_without_bound() -> None:
    def divergent(mu: float) -> float:
        if mu == 0.0:
            raise BadInput("mu", mu, "has no limit")
        return mu**-0.25

    found = interpolation_error(made(divergent, "mu=16", sampling="centres"))
    assert (found.largest, found.largest_at) == (math.inf, {"mu": 0.0})

    def jumping(mu: float) -> float:
        if mu == 0.0:
            raise BadInput("mu", mu, "has no limit")
        return 1.0 if mu < 1e-3 else 0.0

    assert interpolation_error(made(jumping, "mu=16", sampling="centres")).largest == 1.0


def test_the_standard_error_of_the_rms_is_honest() -> None:
    """Over 40 seeds the mean square of (rms - truth) / error has an expectation near 1 and a standard deviation of 0.2 to 0.3."""
    table = made(lambda mu: mu**6, "mu=6")
    points = (np.arange(40_000)[:, None] + 0.5) / 40_000
    right = math.sqrt(float(np.mean(np.square(by_scipy(table, points)[:, 0] - points[:, 0] ** 6))))
    seen = [interpolation_error(table, 64, seed) for seed in range(40)]
    z = np.array([(e.rms - right) / e.rms_error for e in seen])
    assert 0.4 < float(np.mean(z * z)) < 2.0
    assert abs(float(np.mean(z))) < 0.6


def test_the_same_seed_gives_the_same_bits_and_progress_is_told() -> None:
    table = made(corner, "albedo=8", "mu=8")
    told: list[tuple[int, int]] = []
    first = interpolation_error(table, 64, 5, lambda done, of: told.append((done, of)))
    assert first == interpolation_error(table, 64, 5)
    assert first.rms != interpolation_error(table, 64, 6).rms
    assert told
    assert all(0 <= done <= of for done, of in told)


@pytest.mark.parametrize("points", [4, -1, 1 << 40, 20.0, "few", True])
def test_numbers_of_points_that_are_none_are_refused(points: object) -> None:
    with pytest.raises(BadInput, match=f"points = {points!r}: must be an integer from 16 to 1048576"):
        interpolation_error(made(lambda mu: mu, "mu=4"), points)  # type: ignore[arg-type]


@dataclass(frozen=True)
class Rough(Formula):
    """A parabola that is as wrong as its tolerance allows."""

    def at(self, point: Mapping[str, float]) -> Found:
        width = self.want.tolerance.absolute
        return (bounded(point["mu"] ** 2 + 0.9 * width, width, 1, "quadrature"),)


def test_the_truth_is_asked_for_no_more_precisely_than_the_error_needs_and_that_is_carried() -> None:
    """Nodes to 1e-9, between them a thousandth of the error foretold, h^2/4: it is in rms_error; the largest is had to 1e-9."""
    table = tabulated("t", Rough(find("lambert"), "albedo", WANT), parse_axes(["mu=9"]))
    found = interpolation_error(table)
    h = 1.0 / 8.0
    exact_one = interpolation_error(made(lambda mu: mu * mu, "mu=9"))
    assert found.rms_error - exact_one.rms_error == pytest.approx(1e-3 * h * h / 4.0, rel=0.05)
    assert 1e-6 < exact_one.rms - found.rms < 1e-3 * h * h / 4.0
    assert found.largest_bound == pytest.approx(2e-9, rel=1e-3)
    assert found.largest == pytest.approx(h * h / 4.0, rel=1e-6)


def peak_of_a_cube(nodes: int) -> float:
    """How far x^3 lies below its chord over the last cell, where 3 x^2 is the slope of the chord."""
    a = 1.0 - 1.0 / (nodes - 1)
    slope = 1.0 + a + a * a
    x = math.sqrt(slope / 3.0)
    return 1.0 - slope * (1.0 - x) - x**3


def test_the_vertex_of_a_smooth_peak_is_found() -> None:
    """Beside the middle of its cell, more closely than the last step, a 32nd of a cell, comes."""
    found = interpolation_error(made(lambda mu: mu**3, "mu=4"))
    assert found.largest == pytest.approx(peak_of_a_cube(4), rel=1e-6)


def test_what_takes_long_is_asked_seldom_and_the_worst_cell_is_found_yet() -> None:
    """A mean albedo takes fifty times as long as an albedo. The errors of neighbouring cells are nearly the same."""
    for f in (lambda rho: rho**3, lambda rho: math.cos(4.0 * rho), lambda rho: math.sin(3.0 * rho)):
        source = Formula(find("lambert"), "mean-albedo", WANT, f=f)
        table = tabulated("t", source, parse_axes(["albedo=32"]))
        found = interpolation_error(table)
        places = (np.arange(31_000)[:, None] + 0.5) / 31_000
        right = np.max(np.abs(by_scipy(table, places)[:, 0] - [f(x) for x in places[:, 0].tolist()]))
        assert found.points < 70
        assert found.largest == pytest.approx(right, rel=1e-5)


def test_what_no_model_has_a_value_for_is_left_out_and_said() -> None:
    """GGX's alpha is 0 or at least 1e-5: between, there is nothing to hold a table against."""
    source = Source(find("ggx"), "albedo", effort(1e-5, "quadrature", 0, None))
    found = interpolation_error(tabulated("E", source, parse_axes(["sqrt(alpha)=4", "mu=4"])), 16)
    assert found.over == {"alpha": (1e-5, 1.0), "mu": (0.0, 1.0)}
    assert found.largest_at["alpha"] >= 1e-5


def brute(table: Table, count: int, **words: str) -> tuple[Floats, Floats]:
    """Errors at random places of the texture, all but alpha < 1e-5: SciPy's interpolation, quadrature for itself."""
    t = np.random.default_rng(8).random((count, 2))
    points = np.stack([axis.values(t[:, i]) for i, axis in enumerate(table.axes)], axis=-1)
    points = points[points[:, 0] >= 1e-5]
    member, _ = find("ggx").member(words)
    asked = [Question(member, member.bind({"alpha": float(alpha)}), float(mu)) for alpha, mu in points]
    truth = [quadrature(question, Tolerance(1e-6)).value for question in asked]
    return np.abs(by_scipy(table, points)[:, 0] - truth), points


def agrees(table: Table, count: int, **words: str) -> None:
    errors, _ = brute(table, count, **words)
    found = interpolation_error(table)
    assert found.largest + found.largest_bound >= float(errors.max())
    squares = np.square(errors)
    rms = math.sqrt(float(squares.mean()))
    error = float(squares.std()) / math.sqrt(len(squares)) / (2.0 * rms)
    assert abs(found.rms - rms) < 4.0 * math.hypot(error, found.rms_error)
    assert found.rms_error < 0.1 * found.rms


def test_ggx_agrees_with_brute_force() -> None:
    source = Source(find("ggx"), "albedo", effort(1e-6, "quadrature", 0, None), (("G", "smith"),))
    agrees(tabulated("E", source, parse_axes(["sqrt(alpha)=12@0.01:1", "mu=12"], "centres")), 3000, G="smith")


@pytest.mark.slow
@pytest.mark.parametrize("sampling", ["endpoints", "centres"])
@pytest.mark.parametrize("G", ["smith", "smith_correlated"])
def test_ggx_agrees_with_brute_force_at_1e5_points(G: str, sampling: str) -> None:
    source = Source(find("ggx"), "albedo", effort(1e-6, "quadrature", 0, None), (("G", G),))
    agrees(tabulated("E", source, parse_axes(["sqrt(alpha)=32", "mu=32"], sampling)), 100_000, G=G)


def test_the_corner_of_ggx_has_the_error_of_its_limit_whatever_the_size() -> None:
    """At alpha -> 0 with mu = s alpha the albedo tends to a function e(s), and the nodes say 1: the error is 1 - min e(s)."""
    member, _ = find("ggx").member({})
    p = member.bind({"alpha": 1e-3})
    along = [quadrature(Question(member, p, 1e-3 * s), Tolerance(1e-7)).value for s in np.linspace(0.9, 1.3, 81)]
    source = Source(find("ggx"), "albedo", effort(1e-6, "quadrature", 0, None))
    for size in (4, 16):
        found = interpolation_error(tabulated("E", source, parse_axes([f"alpha={size}", f"mu={size}"])), 256)
        # alpha = 1e-3 is not 0 yet: e(s) is approached like alpha
        assert abs(found.largest - (1.0 - min(along))) < 2e-3
