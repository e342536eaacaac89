"""What export wrote is read back as tables, errors and all; what was changed since, or has no record, is refused."""

from __future__ import annotations

import json
from importlib.util import find_spec
from pathlib import Path

import numpy as np
import pytest

from albedo_lab.analysis.request import effort
from albedo_lab.catalogue import find
from albedo_lab.errors import BadInput
from albedo_lab.lookup.axes import parse_axes
from albedo_lab.lookup.export import export
from albedo_lab.lookup.formats import FORMATS
from albedo_lab.lookup.reading import read_tables
from albedo_lab.lookup.source import Source
from albedo_lab.lookup.table import mean_beside, tabulated

AXES = ("roughness=3", "mu=4")
OPENEXR = pytest.mark.skipif(find_spec("OpenEXR") is None, reason="no OpenEXR")


@pytest.mark.parametrize("kind", [pytest.param(kind, marks=OPENEXR) if kind == "exr" else kind for kind in FORMATS])
def test_tables_come_back(tmp_path: Path, kind: str) -> None:
    """Values within the rounding told, half-widths that hold them, and a source that gives the same figures again."""
    path = tmp_path / f"E{FORMATS[kind].suffixes[0]}"
    export("ggx", path, axes=AXES, name="E", points=0, G="smith", tolerance=1e-5)
    source = Source(find("ggx"), "albedo", effort(1e-5, "quadrature", 0, None), (("G", "smith"),))
    table = tabulated("E", source, parse_axes(AXES))
    means = mean_beside(table, "E_mean")
    assert means is not None
    found = read_tables(path)
    assert [t.name for t in found] == ["E", "E_mean"]
    for read, true in zip(found, (table, means), strict=True):
        assert read.axes == true.axes
        assert read.samples == true.samples
        assert read.values.shape == read.half_widths.shape == true.values.shape
        lost = np.max(np.abs(read.values - true.values))
        assert np.all(read.half_widths >= true.half_widths + lost - 1e-15)
        assert np.max(read.half_widths) <= np.max(true.half_widths) + 1e-4
        at = {axis.name: 0.6 for axis in true.axes}
        assert read.source.at(at) == true.source.at(at)


def test_channels_azimuth_and_order_come_back(tmp_path: Path) -> None:
    path = tmp_path / "S.npy"
    export("ggx", path, axes=("mu=3",), quantity="split-sum", F="schlick", alpha=0.5, phi_deg=30, points=0, tolerance=1e-3)
    (found,) = read_tables(path)
    assert found.values.shape == (3, 2)
    assert found.source.phi == pytest.approx(np.radians(30.0))
    assert dict(found.source.fixed)["alpha_x"] == dict(found.source.fixed)["alpha_y"] == 0.5


def test_what_is_not_what_was_written_is_refused(tmp_path: Path) -> None:
    """A changed file, one without a record or companion, and records of something else: one line each."""

    def refused(path: Path, *said: str) -> None:
        with pytest.raises(BadInput) as told:
            read_tables(path)
        assert "\n" not in str(told.value)
        assert all(part in str(told.value) for part in said)

    def fresh() -> Path:
        path = tmp_path / "E.npy"
        export("lambert", path, axes=("albedo=3", "mu=4"), points=0, force=True)
        return path

    path, record = fresh(), tmp_path / "E.npy.meta.json"
    np.save(path, np.load(path) + 1e-3)
    refused(path, "E.npy", "changed since")
    path = fresh()
    (tmp_path / "E.mean.npy").unlink()
    refused(path, "E.mean.npy", "No such file")
    path = fresh()
    known = json.loads(record.read_text())
    for change in (
        {"tables": []},
        {"tables": known["tables"][:1]},
        {"tolerance": 3},
        {"tables": 7},
        {"files": {}},
        {"files": []},
    ):
        record.write_text(json.dumps(known | change))
        refused(path, "E.npy")
    record.write_text(json.dumps({name: value for name, value in known.items() if name != "order"}))
    refused(path, "E.npy")
    record.write_text(json.dumps(known | {"model": "lambda"}))
    refused(path, "model = 'lambda'")
    record.unlink()
    refused(path, "has no record, E.npy.meta.json")
