"""A formula written as a MERL file and read back is the same surface, but for what the cells' size costs."""

from __future__ import annotations

import math
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from albedo_lab.analysis.constant import constant
from albedo_lab.analysis.tabulate import tabulate
from albedo_lab.catalogue import find
from albedo_lab.errors import BadInput
from albedo_lab.estimate.methods import estimate
from albedo_lab.estimate.record import Question, Tolerance
from albedo_lab.measured.cells import point_of
from albedo_lab.measured.merl_file import CHANNELS, FACTORS, PLANE, read
from albedo_lab.measured.rusinkiewicz import light_and_viewer
from albedo_lab.model import Model
from albedo_lab.models.merl import make
from albedo_lab.optics.frame import Direction

FINE = Tolerance(1e-5, 1e-5)


@pytest.fixture
def path(tmp_path: Path) -> Iterator[Path]:
    """A file of 35 MB is not left for pytest to keep."""
    path = tmp_path / "made.binary"
    yield path
    path.unlink(missing_ok=True)


def albedo_of(path: Path, channel: str, mu: float, method: str = "quadrature", tolerance: Tolerance = FINE) -> float:
    model = make(file=str(path), channel=channel)
    found = estimate(Question(model, model.bind({}), mu), tolerance, method, 0, 1)
    assert found.reaches(Tolerance(2 * tolerance.absolute, 2 * tolerance.relative))
    return found.value


def test_lambert_in_three_colours(path: Path) -> None:
    """A constant comes back as it is up to the horizon: nothing of the cells below leaks in, whatever the angle."""
    rows = tabulate("lambert", path, albedo=[0.2, 0.5, 0.9])
    assert list(rows.plane) == ["red", "green", "blue"]
    assert list(rows.albedo) == [0.2, 0.5, 0.9]
    assert set(rows.cells) == {PLANE}
    assert rows.below_horizon[0] / PLANE == pytest.approx(0.2366, abs=1e-4)
    assert list(rows.smallest) == pytest.approx(list(rows.largest))
    for channel, expected in zip(CHANNELS, (0.2, 0.5, 0.9), strict=True):
        assert read(path).values(channel).max() == pytest.approx(expected / math.pi, rel=1e-15)
        for mu in (1.0, 0.5, 0.1, 1e-2):
            assert albedo_of(path, channel, mu) == pytest.approx(expected, abs=1e-5)
    assert albedo_of(path, "blue", 0.5, "rqmc", Tolerance(2e-4)) == pytest.approx(0.9, abs=5e-4)


@pytest.mark.parametrize(
    ("name", "parameters", "error"),
    [("stretched_phong", {"n": 20.0}, 2.5e-3), ("schlick_isotropic", {"r": 0.1}, 3e-3)],
)
def test_albedo_through_the_table(path: Path, name: str, parameters: dict[str, float], error: float) -> None:
    """The formula's own albedo, within what the interpolation was measured to cost from normal to 84 degrees."""
    rows = tabulate(name, path, **parameters)
    model = find(name)
    p = model.bind(parameters)
    scale = constant(model, p, None).value
    assert list(rows.scale) == [scale] * 3
    errors = []
    for mu in (1.0, 0.7, 0.3, 0.1):
        own = scale * estimate(Question(model, p, mu), FINE, "quadrature", 0, 1).value
        errors.append(albedo_of(path, "green", mu) / own - 1.0)
    assert max(map(abs, errors)) < error, errors


def test_both_methods_agree(path: Path) -> None:
    """Quadrature ring by ring, and samples of the fitted density."""
    tabulate("ward", path, m=0.2)
    for mu in (0.9, 0.2):
        by_samples = albedo_of(path, "red", mu, "rqmc", Tolerance(1e-4))
        assert albedo_of(path, "red", mu) == pytest.approx(by_samples, abs=2e-4)


def test_cells(path: Path) -> None:
    """Every cell holds f where the cell is evaluated, divided by its factor, or -1."""
    tabulate("schlick_isotropic", path, r=[0.1, 0.5, 1.0], scale=2.0)
    stored = read(path).stored
    model, below = find("schlick_isotropic"), 0
    rng = np.random.default_rng(8)
    for i, j, k in rng.integers((0, 0, 0), (90, 90, 180), (300, 3)).tolist():
        wi, wo = light_and_viewer(point_of(i, j, k), 1.0)
        for index, (channel, r) in enumerate(zip(CHANNELS, (0.1, 0.5, 1.0), strict=True)):
            expected = -1.0
            if min(wi.z, wo.z) >= 1e-3:
                expected = 2.0 * model.evaluate(model.bind({"r": r}), wi, wo) / FACTORS[channel]
            below += expected == -1.0
            assert stored[index, i, j, k] == pytest.approx(expected, rel=1e-11)
    assert below > 100


def test_a_measurement_again(path: Path, tmp_path: Path) -> None:
    """A table is read at its own centres: all cells that lie there come back, channel by channel."""
    tabulate("lambert", path, albedo=[0.2, 0.5, 0.9])
    again = tmp_path / "again.binary"
    tabulate("merl", again, file=str(path))
    assert np.allclose(read(again).stored, read(path).stored, rtol=1e-12)
    again.unlink()


REFUSED = [
    ("phong_original", {}, "model = 'phong_original': is not reciprocal"),
    ("ward", {"m_x": 0.1, "m_y": 0.2}, "model = 'ward.*anisotropic"),
    ("mirror", {}, "model = 'mirror.*mirror part"),
    ("lambert", {"albedo": [0.1, 0.2]}, "albedo = .*one value, or three, for red, green, blue"),
    ("lambert", {"albedo": 2.0}, "albedo = 2.0: must be a number"),
    ("lambert", {"colour": 2.0}, "colour = 2.0: lambert has no such parameter"),
    ("lambert", {"scale": 1e301}, "scale = "),
    ("merl", {}, "file = '': must be given"),
    ("nothing", {}, "model = 'nothing'"),
]


@pytest.mark.parametrize(("name", "parameters", "message"), REFUSED)
def test_what_has_no_place_in_a_file(tmp_path: Path, name: str, parameters: dict[str, object], message: str) -> None:
    with pytest.raises(BadInput, match=message) as caught:
        tabulate(name, tmp_path / "x.binary", **parameters)
    assert "\n" not in str(caught.value)
    assert list(tmp_path.iterdir()) == []


def signed(p: Any, wi: Direction, wo: Direction) -> float:
    return wi.z * wo.z - 0.5


def unbounded(p: Any, wi: Direction, wo: Direction) -> float:
    return 1.0 / (wi.z - wi.z)


@pytest.mark.parametrize(("f", "what"), [(signed, "is -0."), (unbounded, "is inf")])
def test_values_that_a_file_cannot_hold(tmp_path: Path, f: Any, what: str) -> None:
    lambert = find("lambert")
    model = Model("odd", "odd", lambert.parameters_type, lambert.parameters, f, source=lambert.source, scale=lambda p: 1.0)
    with pytest.raises(BadInput, match=f"model = 'odd': {what}.* 1/sr at theta_h = .*holds finite values"):
        tabulate(model, tmp_path / "x.binary")
    assert list(tmp_path.iterdir()) == []


def test_a_folder_that_is_not_there(tmp_path: Path) -> None:
    with pytest.raises(OSError, match="No such file"):
        tabulate("lambert", tmp_path / "missing" / "x.binary")


def test_progress(path: Path) -> None:
    told: list[tuple[int, int]] = []
    tabulate("lambert", path, progress=lambda done, total: told.append((done, total)))
    assert told == [(0, 3), (1, 3), (2, 3), (3, 3)]
