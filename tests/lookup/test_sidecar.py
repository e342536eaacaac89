"""The record of a table keeps to its schema, tells where the errors are largest, and is enough to make the table again."""

from __future__ import annotations

import copy
import hashlib
import json
import math
from importlib.resources import files
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from jsonschema import Draft202012Validator, ValidationError

from albedo_lab.analysis.request import effort
from albedo_lab.catalogue import find
from albedo_lab.errors import BadInput
from albedo_lab.lookup.axes import MAPPINGS, parse_axes
from albedo_lab.lookup.formats import FORMATS, Layout
from albedo_lab.lookup.interpolation import Interpolation
from albedo_lab.lookup.presets import preset
from albedo_lab.lookup.sidecar import as_text, beside, declared, path_of, record, with_files
from albedo_lab.lookup.source import Source
from albedo_lab.lookup.table import Table, mean_beside, tabulated

WANT = effort(1e-6, "quadrature", 3, 1)
LAYOUT = Layout("float32", 6)
FOUND = Interpolation(math.inf, {"alpha": 0.25, "mu": 0.0}, 1e-7, 2e-3, 1e-5, 99, {"alpha": (1e-5, 1.0), "mu": (0.0, 1.0)})


@pytest.fixture(scope="module")
def tables() -> list[Table]:
    """A table and its means."""
    source = Source(find("ggx"), "albedo", WANT, (("G", "smith"),), phi=0.5)
    table = tabulated("E", source, parse_axes(["roughness=3", "sqrt(1-mu)=4@1:0"]))
    mean = mean_beside(table, "E_avg")
    assert mean is not None
    return [table, mean]


@pytest.fixture(scope="module")
def known(tables: list[Table]) -> dict[str, Any]:
    return with_files(record(tables, "c", LAYOUT, {"E": FOUND}, preset("cycles")), {"E.h": b"content"}, {"E.h": 5e-7})


@pytest.fixture(scope="module")
def schema() -> Any:
    schema = json.loads((files("albedo_lab.lookup") / "table.schema.json").read_text(encoding="utf-8"))
    Draft202012Validator.check_schema(schema)
    return schema


def test_the_schema(known: dict[str, Any], schema: Any) -> None:
    Draft202012Validator(schema).validate(known)
    assert schema["properties"]["storage"]["properties"]["format"]["enum"] == list(FORMATS)
    assert schema["$defs"]["axis"]["properties"]["mapping"]["enum"] == list(MAPPINGS)


def test_the_schema_refuses(known: dict[str, Any], schema: Any) -> None:
    """Whatever is missing at any level, and what is not said there."""
    paths = [
        (),
        ("storage",),
        ("tolerance",),
        ("tables", 0),
        ("tables", 0, "axes", 1),
        ("tables", 0, "interpolation"),
        ("files", "E.h"),
    ]
    for path in paths:
        for change in [*_at(known, path), "unknown"]:
            broken = copy.deepcopy(known)
            part = _at(broken, path)
            if change == "unknown":
                part[change] = 1
            else:
                del part[change]
            with pytest.raises(ValidationError):
                Draft202012Validator(schema).validate(broken)


def _at(node: Any, path: tuple[Any, ...]) -> Any:
    for key in path:
        node = node[key]
    return node


def test_what_it_says(known: dict[str, Any], tables: list[Table]) -> None:
    """Model, variant, axes, limits, where the errors are largest, how they were made, and the digest."""
    assert known["model"] == "ggx"
    assert known["variant"].startswith("separable Smith masking")
    assert known["choices"]["G"] == "smith"
    assert known["parameters"] == {}
    assert (known["method"], known["seed"], known["tolerance"]["absolute"]) == ("quadrature", 3, 1e-6)
    assert known["phi_deg"] == pytest.approx(math.degrees(0.5))
    assert known["files"]["E.h"]["sha256"] == hashlib.sha256(b"content").hexdigest()
    table, mean = known["tables"]
    assert (table["shape"], table["fastest_axis"], table["channels"]) == ([3, 4], "mu", ["albedo"])
    assert [axis["label"] for axis in table["axes"]] == ["sqrt(alpha)", "sqrt(1-mu)"]
    assert table["axes"][1]["nodes"] == pytest.approx([1.0, 8 / 9, 5 / 9, 0.0])
    assert [limit.partition(":")[0] for limit in table["limits"]] == ["mu = 0", "alpha = 0"]
    assert [limit.partition(":")[0] for limit in mean["limits"]] == ["alpha = 0"]
    assert table["interpolation"]["largest"] == "inf"
    assert mean["interpolation"] is None
    i, j, _ = np.unravel_index(np.argmax(tables[0].half_widths), tables[0].half_widths.shape)
    widest = table["largest_half_width"]
    assert widest["value"] == tables[0].half_widths.max() > 0.0
    assert list(widest["at"].values()) == [tables[0].axes[0].nodes[i], tables[0].axes[1].nodes[j]]


def test_as_text(known: dict[str, Any]) -> None:
    text = as_text(known)
    assert json.loads(text) == known
    assert '"shape": [3, 4]' in text
    assert "NaN" not in text
    assert "Infinity" not in text


def test_made_again_from_its_record(known: dict[str, Any], tables: list[Table]) -> None:
    """What is declared makes the same table bit by bit, read from text."""
    told = json.loads(as_text(known))
    for table in tables:
        what = declared(told, table.name)
        assert what.axes == table.axes
        source = Source(find(what.model), what.quantity, WANT, what.fixed, phi=0.5)
        assert np.array_equal(tabulated("again", source, what.axes).values, table.values)
    assert declared(told).name == "E"


@pytest.mark.parametrize(
    ("name", "quantity", "fixed", "axes", "parameters", "scale"),
    [
        (
            "ggx",
            "split-sum",
            (("F", "schlick"), ("alpha", 0.5)),
            ["mu=2@0.5:1"],
            {"alpha": 0.5, "alpha_x": 0.5, "alpha_y": 0.5},
            "as its",
        ),
        ("ggx", "albedo", (("F", "dielectric"),), ["alpha_x=2@0.5:1", "mu=2@0.5:1"], {"alpha_y": 0.1, "eta": 1.5}, "as its"),
        ("lambert", "albedo", (("albedo", 0.3), ("scale", 2.0)), ["mu=2"], {"albedo": 0.3}, 2.0),
        ("stretched_phong", "constant", (), ["log(n)=2@1:10"], {}, "what the table holds"),
        ("blinn", "albedo", (), ["n=2@1:10", "mu=2@0.5:1"], {}, "computed maximum"),
    ],
)
def test_parameters_and_scale(
    name: str, quantity: str, fixed: Any, axes: list[str], parameters: dict[str, float], scale: Any
) -> None:
    """Those that are neither axes nor set by one, nor what the channels are for; and where the constant comes from."""
    source = Source(find(name), quantity, WANT, fixed)
    told = record([tabulated("T", source, parse_axes(axes))], "npy", LAYOUT, {})
    shown = {key: value for key, value in told["parameters"].items() if not (key == "alpha" and "alpha" not in parameters)}
    assert shown == parameters
    assert told["scale"] == scale or str(told["scale"]).startswith(str(scale))
    assert dict(declared(told).fixed).get("scale") == (2.0 if scale == 2.0 else None)


def test_beside_its_file(tmp_path: Path, known: dict[str, Any]) -> None:
    """Found for the file, and for the means that came with it; for no other."""
    output = tmp_path / "E.npy"
    told = {**known, "files": {"E.npy": {}, "E.mean.npy": {}}}
    assert beside(output) is None
    path_of(output).write_text(as_text(told))
    assert beside(output) == beside(tmp_path / "E.mean.npy") == told
    assert beside(tmp_path / "E.other.npy") is None
    assert beside(tmp_path / "F.npy") is None
    for content in ("[1]", "{", ""):
        path_of(output).write_text(content)
        with pytest.raises(BadInput, match=r"sidecar = .*(cannot be read|is no record)"):
            beside(output)


def test_what_is_no_record(known: dict[str, Any]) -> None:
    with pytest.raises(BadInput, match="sidecar = 'B': has no table of that name"):
        declared(known, "B")
    for path, value in (
        (("tables",), None),
        (("tables", 0, "axes", 0, "mapping"), "cube"),
        (("tables", 0, "axes", 0, "sampling"), "somewhere"),
        (("tables", 0, "axes", 0, "size"), 1),
        (("tables", 0, "axes", 0, "first"), "a"),
        (("tables", 0, "axes"), {}),
        (("tables", 0, "quantity"), "weight"),
        (("choices",), []),
    ):
        broken = copy.deepcopy(known)
        _at(broken, path[:-1])[path[-1]] = value
        with pytest.raises(BadInput, match=r"sidecar = .*is no record of a table"):
            declared(broken)
