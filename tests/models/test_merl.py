"""A measured surface: the table between its cells, where cells are missing, the sampler made from it, and its file."""

from __future__ import annotations

import math
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from albedo_lab.errors import BadInput
from albedo_lab.measured.cells import SHAPE, Place, angles_at
from albedo_lab.measured.merl_file import FACTORS, centre_cosines, centres, write
from albedo_lab.measured.rings import rings
from albedo_lab.measured.rusinkiewicz import HalfDifference, half_difference, light_and_viewer
from albedo_lab.model import Model
from albedo_lab.models.merl import MODEL, Merl, evaluate, make, pdf, ring_coordinate, ring_slope, sample
from albedo_lab.optics.coordinates import Axis
from albedo_lab.tables import table
from tests.models import trial

Floats = NDArray[np.float64]


def surface(values: Floats) -> Merl:
    return Merl(table(values), *map(table, rings(values)))


def formula(theta_h: Any, theta_d: Any, phi_d: Any) -> Any:
    """A glossy surface with a base, higher at grazing angles and different on both sides of the plane of incidence."""
    return 0.1 + np.exp(-((theta_h / 0.2) ** 2)) * (1.0 + theta_d**2) + 0.03 * np.sin(theta_d) * np.sin(2.0 * phi_d)


GLOSSY = surface(np.where(centre_cosines() > 0.0, formula(*centres()), -1.0))
WHITE = surface(np.full(SHAPE, 1.0 / math.pi))
NARROW = surface(np.where(centre_cosines() > 0.0, np.exp(-((centres()[0] / 0.02) ** 2)) + 0.0 * centre_cosines(), -1.0))
IN_RUN_OF_PLACES = surface(np.fromfunction(lambda i, j, k: 2.0 * i + 3.0 * j + np.abs(k - 90.0) + 1.0, SHAPE))
every_surface = pytest.mark.parametrize("p", [GLOSSY, WHITE, NARROW], ids=["glossy", "white", "narrow"])


def at_place(p: Merl, i: float, j: float, k: float) -> float:
    return evaluate(p, *light_and_viewer(angles_at(Place(i, j, k)), 0.7))


# Between the cells


def test_at_its_centre_a_cell_has_its_value() -> None:
    rng = np.random.default_rng(6)
    for i, j, k in rng.integers((1, 1, 0), SHAPE, (500, 3)).tolist():
        if centre_cosines()[i, j, k] > 0.0:
            assert at_place(GLOSSY, i + 0.5, j + 0.5, k + 0.5) == pytest.approx(GLOSSY.values[i, j, k], rel=1e-9)


def test_linear_between_the_centres() -> None:
    """What is linear in i, j and k comes back as it is, at places above the horizon."""
    for i, j, k in ((1.0, 2.0, 3.0), (20.3, 40.9, 60.2), (44.7, 30.1, 120.0), (5.5, 70.25, 91.1)):
        expected = 2.0 * (i - 0.5) + 3.0 * (j - 0.5) + abs(k - 0.5 - 90.0) + 1.0
        assert at_place(IN_RUN_OF_PLACES, i, j, k) == pytest.approx(expected, rel=1e-9)


def test_before_the_first_centre_the_table_is_level() -> None:
    assert at_place(IN_RUN_OF_PLACES, 0.1, 20.5, 60.5) == pytest.approx(at_place(IN_RUN_OF_PLACES, 0.3, 20.5, 60.5), rel=1e-9)
    assert at_place(IN_RUN_OF_PLACES, 20.5, 0.1, 60.5) == pytest.approx(at_place(IN_RUN_OF_PLACES, 20.5, 0.4, 60.5), rel=1e-9)
    behind = (at_place(IN_RUN_OF_PLACES, 1.5, j, 90.5) for j in (89.5, 89.9))
    assert next(behind) == pytest.approx(next(behind), rel=1e-9)


def test_the_seam() -> None:
    """phi_d = 0 lies half-way between the last and the first cell."""
    first, last = IN_RUN_OF_PLACES.values[10, 20, 0], IN_RUN_OF_PLACES.values[10, 20, 179]
    assert first != last
    assert at_place(IN_RUN_OF_PLACES, 10.5, 20.5, 1e-9) == pytest.approx(0.5 * (first + last), rel=1e-8)
    assert at_place(IN_RUN_OF_PLACES, 10.5, 20.5, 180.0 - 1e-9) == pytest.approx(0.5 * (first + last), rel=1e-8)
    assert at_place(IN_RUN_OF_PLACES, 10.5, 20.5, 0.25) == pytest.approx(0.75 * first + 0.25 * last, rel=1e-8)


def test_error_of_the_table() -> None:
    """A quarter of h^2 f'' / 2 in each of three directions: for this surface, 3 / 0.2^2 (2 theta_h-cells)^2 / 8 at most."""
    worst = 0.0
    for wi, wo in trial.random_pairs(1000):
        at = half_difference(wi, wo)
        if min(wi.z, wo.z) > 0.05:
            worst = max(worst, abs(evaluate(GLOSSY, wi, wo) - formula(*at)))
    assert worst < 2e-3
    assert worst > 1e-5


def test_missing_cells_take_no_part() -> None:
    values = np.ones(SHAPE)
    values[10, 20, 30] = -7.0
    values[:, 60:, :] = -7.0
    p = surface(values)
    assert at_place(p, 10.5, 20.5, 31.0) == 1.0
    assert at_place(p, 10.9, 20.9, 30.9) == pytest.approx(1.0, rel=1e-15)
    assert at_place(p, 10.5, 60.3, 90.5) == 1.0
    assert at_place(p, 10.5, 61.5, 90.5) == -7.0  # nothing else is there: shown as it is stored


def test_a_zero_is_a_value() -> None:
    values = np.ones(SHAPE)
    values[10, 20, 30] = 0.0
    assert at_place(surface(values), 11.0, 20.5, 30.5) == pytest.approx(0.5, rel=1e-9)


def test_nothing_of_the_other_side_of_the_horizon() -> None:
    """The marks of cells below the horizon do not leak above it."""
    p = surface(np.where(centre_cosines() > 0.0, 1.0, -1e6))
    values = [evaluate(p, wi, wo) for wi, wo in trial.random_pairs(3000) if min(wi.z, wo.z) > 1e-2]
    assert len(values) > 2000
    assert values == pytest.approx([1.0] * len(values), rel=1e-12)


def test_directions_that_are_none() -> None:
    """No index leaves the table, whatever comes in; NaN comes out as NaN."""
    down = trial.direction(2.0, 1.0)
    opposite = trial.Direction(-down.x, -down.y, -down.z)
    for wi in (down, opposite, trial.Direction(0.0, 0.0, -1.0), trial.Direction(0.0, 0.0, 0.0)):
        evaluate(GLOSSY, wi, opposite)
    assert math.isnan(evaluate(GLOSSY, trial.Direction(math.nan, 0.0, 1.0), opposite))


@every_surface
def test_reciprocal(p: Merl) -> None:
    trial.assert_reciprocal(MODEL, p)


# The sampler


@every_surface
def test_density_of_the_rings(p: Merl) -> None:
    """A density: piecewise linear in 1 - cos, its integral is the cumulative share."""
    mass = 2.0 * math.pi * np.diff(p.heights) * 0.5 * (p.density[1:] + p.density[:-1])
    assert float(p.cumulative[-1]) == 1.0
    assert np.allclose(np.diff(p.cumulative), mass, atol=1e-15)
    assert np.all(p.density >= 0.0)
    assert np.allclose(p.heights, 1.0 - np.cos(np.pi / 2 * (np.arange(91) / 90) ** 2), atol=1e-15)


def test_rings_follow_the_light() -> None:
    """All mass of a narrow lobe lies within a few of its widths; a black surface still has a density."""
    few_widths = np.searchsorted(NARROW.heights, 1.0 - math.cos(0.06))
    assert NARROW.cumulative[few_widths] > 0.999
    assert np.allclose(surface(np.zeros(SHAPE)).density, 1.0 / (2.0 * math.pi), rtol=1e-12)


@every_surface
@pytest.mark.parametrize("mu", [0.9, 0.3])
def test_normalised(p: Merl, mu: float) -> None:
    trial.assert_normalised(MODEL, p, mu)


@pytest.mark.parametrize(("p", "mu"), [(GLOSSY, 0.8), (GLOSSY, 0.2), (WHITE, 0.5)])
def test_samples_follow_the_density(p: Merl, mu: float) -> None:
    trial.assert_follows_density(MODEL, p, mu, tests=3)


@every_surface
def test_weights_are_bounded(p: Merl) -> None:
    """By pi f / (share of the cosine), and at the ends of the uniforms, too."""
    rng = np.random.default_rng(7)
    ends = [(a, b) for a in (2.0**-53, 0.25, 1.0 - 2.0**-53) for b in (2.0**-53, 0.5, 1.0 - 2.0**-53)]
    for mu in (1.0, 0.5, 1e-3, 1e-12):
        wo = trial.at(mu, 0.3)
        for u1, u2 in [*ends, *rng.random((200, 2)).tolist()]:
            wi = sample(p, wo, u1, u2)
            assert math.isclose(math.hypot(*wi), 1.0, rel_tol=1e-12)
            f = evaluate(p, wi, wo)
            if wi.z > 0.0 and f >= 0.0:
                assert 0.0 <= f * wi.z / pdf(p, wi, wo) <= math.pi * f / 0.25 * (1 + 1e-12)


# The rings that quadrature integrates one by one


def test_rings_of_quadrature_are_a_cell_wide() -> None:
    for begin in (-0.5, 0.5, 30.5, 88.5):
        for y in (0.6, 1.0):
            rho, measure = ring_slope(y, begin)
            assert math.atan(rho) == pytest.approx(0.5 * math.pi * ((begin + y) / 90) ** 2, rel=1e-14)
            assert ring_coordinate(rho, begin) == pytest.approx(y, rel=1e-11)
            step = 1e-6
            rise = (ring_slope(y + step, begin)[0] - ring_slope(y - step, begin)[0]) / (2 * step)
            assert measure == pytest.approx(rho * rise, rel=1e-6)
        assert ring_coordinate(0.0, begin) == (0.5 if begin < 0.0 else 0.0)


def plain_albedo(p: Merl, f: Any, mu: float, steps: int = 160) -> float:
    """A midpoint sum over wi, uniform in cos^2 and azimuth."""
    wo, total = trial.at(mu), 0.0
    for a in range(steps):
        for b in range(2 * steps):
            wi = trial.at(math.sqrt((a + 0.5) / steps), math.pi * (b + 0.5) / steps)
            total += f(p, wi, wo)
    return math.pi * total / (2 * steps * steps)


# The file


@pytest.fixture(scope="module")
def path(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Path]:
    path = tmp_path_factory.mktemp("merl") / "glossy.binary"
    plane = np.asarray(GLOSSY.values)
    write(
        path,
        np.stack(
            [
                np.where(plane >= 0.0, plane * shade / factor, -1.0)
                for shade, factor in zip((1, 2, 3), FACTORS.values(), strict=True)
            ]
        ),
    )
    yield path
    path.unlink()


def test_channels(path: Path) -> None:
    """All three of a file by name, each with its own factor; the same file gives the same model."""
    for shade, channel in zip((1, 2, 3), FACTORS, strict=True):
        member, rest = MODEL.member({"file": str(path), "channel": channel})
        assert not rest
        assert member.chosen == {"file": str(path), "channel": channel}
        assert member is make(file=str(path), channel=channel)
        p = member.bind({})
        assert p is member.bind({})
        assert hash(p) == hash(member.bind({}))
        for wi, wo in trial.random_pairs(20):
            f = GLOSSY_AT(wi, wo)
            assert member.evaluate(p, wi, wo) == pytest.approx(shade * f, rel=1e-12) or f < 0.0


def GLOSSY_AT(wi: Any, wo: Any) -> float:
    return evaluate(GLOSSY, wi, wo)


def test_parts_cover_the_table_once(path: Path) -> None:
    """91 rings end to end, and each with the same cells; f on both sides of the plane of incidence is averaged."""
    member = make(file=str(path), channel="red")
    p = member.bind({})
    assert member.parts is not None
    parts = member.parts(p)
    assert [q.begin for _, q in parts] == [i - 0.5 for i in range(91)]
    assert {part.smooth_in.axis for part, _ in parts} == {Axis.HALF}
    one, q = parts[0]
    uneven = 0
    for wi, wo in trial.random_pairs(50):
        mirrored = half_difference(wi, wo)
        mirrored = HalfDifference(mirrored.theta_h, mirrored.theta_d, math.pi - mirrored.phi_d)
        other = evaluate(p, *light_and_viewer(mirrored, 0.0))
        assert one.evaluate(q, wi, wo) == pytest.approx(0.5 * (evaluate(p, wi, wo) + other), rel=1e-6, abs=1e-9)
        uneven += abs(other - evaluate(p, wi, wo)) > 1e-3
    assert uneven > 10
    both = plain_albedo(q, one.evaluate, 0.6)
    assert both == pytest.approx(plain_albedo(p, evaluate, 0.6), rel=1e-9)


def test_without_a_file() -> None:
    """The record can be looked at, but nothing be computed."""
    assert isinstance(MODEL, Model)
    assert MODEL.summary.startswith("MERL")
    assert MODEL is make(file="", channel="red")
    green, _ = MODEL.member({"channel": "green"})
    assert green.chosen == {"file": "", "channel": "green"}
    with pytest.raises(BadInput, match="file = '': must be given"):
        green.bind({})
    with pytest.raises(BadInput, match="channel = 'grey'"):
        MODEL.member({"channel": "grey"})
    with pytest.raises(BadInput, match="cannot be read"):
        MODEL.member({"file": "/nowhere/x.binary"})
