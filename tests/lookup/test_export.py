"""Tables are exported whole or not at all, proven cell by cell, the same bytes each time; what cannot be is refused first."""

from __future__ import annotations

import json
import math
import os
from importlib.resources import files
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from jsonschema import Draft202012Validator
from scipy.integrate import quad

from albedo_lab import files as writing
from albedo_lab.errors import BadInput, Inconclusive
from albedo_lab.files import write_all, write_whole
from albedo_lab.lookup import export as exporting
from albedo_lab.lookup.export import export
from albedo_lab.lookup.formats import FORMATS, read
from albedo_lab.lookup.presets import PRESETS

AXES = ("roughness=3", "mu=4")
OPENEXR = pytest.mark.skipif(__import__("importlib.util").util.find_spec("OpenEXR") is None, reason="no OpenEXR")


def oracle(alpha: float) -> float:
    """The albedo of GGX at normal incidence, in plain polar coordinates: Smith's G2 is G1 of the light there, F = 1."""

    def integrand(theta: float) -> float:
        c = math.cos(0.5 * theta)
        D = alpha**2 / (math.pi * (c**2 * (alpha**2 - 1.0) + 1.0) ** 2)
        G = 2.0 / (1.0 + math.sqrt(1.0 + (alpha * math.tan(theta)) ** 2))
        return D * G / 4.0 * 2.0 * math.pi * math.sin(theta)

    return quad(integrand, 0.0, 0.5 * math.pi, epsabs=1e-12, epsrel=1e-12)[0]


@pytest.mark.parametrize("kind", [pytest.param(kind, marks=OPENEXR) if kind == "exr" else kind for kind in FORMATS])
def test_every_format(tmp_path: Path, kind: str) -> None:
    """What is read back is the model's albedo; the row and the sidecar tell what storing cost."""
    suffix = FORMATS[kind].suffixes[0]
    path = tmp_path / f"E{suffix}"
    rows = export("ggx", path, axes=AXES, name="E", points=0)
    means = path if FORMATS[kind].several else tmp_path / f"E.mean{suffix}"
    sidecar = tmp_path / f"E{suffix}.meta.json"
    assert set(tmp_path.iterdir()) == {path, means, sidecar}
    assert list(rows.file) == [str(path), str(means)]
    assert list(rows.name) == ["E", "E_mean"]
    assert list(rows.cells) == [12, 3]
    assert all(rows.half_width <= 1e-6)
    stored = read(path)[0]
    values = stored.values.reshape(3, 4)
    assert values[:, 3] == pytest.approx([1.0, oracle(0.25), oracle(1.0)], abs=1e-6 + stored.rounding)
    assert values[:, 0] == pytest.approx(1.0, abs=1e-6 + stored.rounding)  # both limits
    known = json.loads(sidecar.read_text(encoding="utf-8"))
    Draft202012Validator(json.loads((files("albedo_lab.lookup") / "table.schema.json").read_text())).validate(known)
    assert set(known["files"]) == {path.name, means.name}
    assert known["storage"]["format"] == kind
    assert max(rows.rounding) == max(entry["rounding"] for entry in known["files"].values()) <= stored.rounding * (1 + 1e-9)
    assert (max(rows.rounding) == 0.0) == ("float64" in FORMATS[kind].dtypes[:1])


def test_the_same_bytes(tmp_path: Path) -> None:
    """However often it is made, and with however many threads."""
    contents = []
    for folder, threads in (("a", 1), ("b", 2)):
        (tmp_path / folder).mkdir()
        export(
            "ggx",
            tmp_path / folder / "E.npz",
            axes=["mu=2@0.5:1", "alpha=2@0.4:0.5"],
            points=0,
            threads=threads,
            method="rqmc",
            tolerance=1e-3,
        )
        contents.append({path.name: path.read_bytes() for path in (tmp_path / folder).iterdir()})
    assert contents[0] == contents[1]


def test_interpolation(tmp_path: Path) -> None:
    """Its errors stand in the rows, in the sidecar and in the header's comment."""
    told: list[tuple[int, int]] = []
    rows = export(
        "ggx", tmp_path / "E.h", axes=("roughness=2", "mu=2"), points=16, progress=lambda done, total: told.append((done, total))
    )
    table, _ = json.loads((tmp_path / "E.h.meta.json").read_text())["tables"]
    assert rows.interpolation_error[0] == table["interpolation"]["largest"] > rows.interpolation_rms[0] > 0.0
    assert "Error of linear interpolation between the nodes: largest found 0." in (tmp_path / "E.h").read_text()
    assert told == sorted(set(told))
    assert told[0] == (0, 4000)
    assert told[-1] == (4000, 4000)


@pytest.mark.parametrize("name", PRESETS)
def test_presets(tmp_path: Path, name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """Each at a smaller size, in its own format where the suffix names none, under its own names."""
    if PRESETS[name].format == "exr":
        pytest.importorskip("OpenEXR")
    axes = tuple(f"{axis.partition('=')[0]}=3" for axis in PRESETS[name].axes)
    rows = export(None, tmp_path / "table", preset=name, axes=axes, points=0)
    known = json.loads((tmp_path / "table.meta.json").read_text())
    assert rows.name[0] == known["tables"][0]["name"] == PRESETS[name].name
    assert (len(rows) == 2) == (PRESETS[name].mean is not None)
    assert known["storage"]["format"] == PRESETS[name].format
    assert known["storage"]["decimals"] == PRESETS[name].layout.decimals
    assert known["preset"]["reader"] == PRESETS[name].reader
    assert {key: known["choices"][key] for key, _ in PRESETS[name].fixed} == dict(PRESETS[name].fixed)


def test_what_goes_before_a_preset(tmp_path: Path) -> None:
    """Format, name, axes, sampling and parameters that are given; its decimals are of its own format."""
    rows = export(
        "ggx", tmp_path / "x.json", preset="cycles", axes=["mu=2", "alpha=3"], sampling="centres", name="T", points=0, G="smith"
    )
    assert list(rows.name) == ["T", "T_mean"]
    known = json.loads((tmp_path / "x.json.meta.json").read_text())
    assert known["choices"]["G"] == "smith"
    assert known["storage"] == {"format": "json", "dtype": "float64", "decimals": None}
    assert {axis["sampling"] for axis in known["tables"][0]["axes"]} == {"centres"}
    rows = export("ggx", tmp_path / "x.h", preset="cycles", axes=["mu=2", "alpha=3"], mean=False, decimals=4, points=0)
    assert list(rows.name) == ["table_ggx_E"]
    assert read(tmp_path / "x.h")[0].kind == "text of 4 decimals"


def test_other_quantities(tmp_path: Path) -> None:
    """Split sum, loss, constant; and a model with no roughness."""
    pair = export("ggx", tmp_path / "a.npy", axes=["mu=2", "alpha=2@0.5:1"], quantity="split-sum", points=0, F="schlick")
    assert len(pair) == 1
    whole = read(tmp_path / "a.npy")[0].values.sum(axis=-1)
    export("ggx", tmp_path / "b.npy", axes=["mu=2", "alpha=2@0.5:1"], quantity="energy-loss", points=0)
    assert np.allclose(1.0 - read(tmp_path / "b.npy")[0].values, whole, rtol=0.0, atol=4e-6)
    export("stretched_phong", tmp_path / "c.csv", axes=["n=2@1:10"], quantity="constant", points=0, tolerance=1e-4)
    assert read(tmp_path / "c.csv")[0].values[0] == pytest.approx(3 / (2 * math.pi), rel=1e-3)
    lambert = export("lambert", tmp_path / "d.json", axes=["theta=3"], albedo=0.25, points=0)
    assert len(lambert) == 1
    assert read(tmp_path / "d.json")[0].values == pytest.approx([0.25] * 3)


REFUSED: list[tuple[dict[str, Any], str]] = [
    ({"axes": ()}, "axis = .*one to three axes"),
    ({"axes": ["mu"]}, "axis = 'mu': must be MAPPING=SIZE"),
    ({"axes": ["mu=1"]}, "axis = 'mu=1': must have 2 to"),
    ({"axes": ["mu=4", "mu=4"]}, "axis = .*different variables"),
    ({"axes": ["mu=4", "n=4@1:2"]}, "axis = 'n': albedo of ggx"),
    ({"axes": ["mu=4@0:2"]}, "mu = 1.3333333333333333: must be a number in"),
    ({"axes": ["mu=4", "alpha=4@0:3"]}, "alpha = 2.0: must be a number in"),
    ({"axes": ["mu=4", "alpha=4@0:1e-5"]}, "alpha = 3.3.*e-06: must be a number in"),
    ({"quantity": "weight"}, "quantity = 'weight': must be one of albedo"),
    ({"quantity": "split-sum"}, "quantity = 'split-sum': needs a model whose F0"),
    ({"sampling": "corners"}, "sampling = 'corners': must be one of"),
    ({"preset": "doom"}, "preset = 'doom': must be one of cycles"),
    ({"format": "doc"}, "format = 'doc': must be one of npz"),
    ({"dtype": "float16"}, "dtype = 'float16': must be float64 or float32"),
    ({"decimals": 6}, "decimals = 6: "),
    ({"name": "two words"}, "name = 'two words': must be letters"),
    ({"format": "c", "name": "float"}, "name = 'float': .*C and GLSL"),
    ({"tolerance": 0.0}, "tolerance = 0.0: must be a finite number above 0"),
    ({"method": "guess"}, "method = 'guess': must be one of"),
    ({"points": 3}, "points = 3: must be an integer from 16 to 1048576, or 0"),
    ({"points": 0.5}, "points = 0.5: must be"),
    ({"points": "few"}, "points = 'few': must be"),
    ({"phi_deg": 400.0}, "phi_deg = 400.0: must be within one turn"),
    ({"order": "wx"}, "order = 'wx': must be wi or wo"),
    ({"alpha_x": [0.1, 0.2]}, "alpha_x = .*one value; what varies is an axis"),
    ({"alpha_x": 3.0}, "alpha_x = 3.0: must be a number in"),
    ({"colour": 3.0}, "colour = 3.0: .*no such parameter"),
    ({"G": "round"}, "G = 'round': must be one of"),
    ({"scale": -1.0}, "scale = -1.0: must be a number in"),
    ({"alpha": 0.5}, "alpha = 0.5: is an axis of the table"),
]


@pytest.mark.parametrize(("options", "message"), REFUSED)
def test_refused_before_anything_is_computed(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, options: dict[str, Any], message: str
) -> None:
    """One line that names it; nothing written, nothing computed."""
    monkeypatch.setattr(exporting, "tabulated", lambda *_: pytest.fail("computed"))
    with pytest.raises(BadInput, match=message) as caught:
        export("ggx", tmp_path / "E.npz", **({"axes": AXES} | options))
    assert "\n" not in str(caught.value)
    assert list(tmp_path.iterdir()) == []


def test_outputs_that_cannot_be(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Before anything is computed as well."""
    monkeypatch.setattr(exporting, "tabulated", lambda *_: pytest.fail("computed"))
    (tmp_path / "folder.npy").mkdir()
    for output, message in (
        (tmp_path / "E.xyz", r"format = '\.xyz'"),
        (tmp_path / "missing" / "E.npy", "output = .*No such file"),
        (tmp_path / "folder.npy", "output = .*a folder or a device"),
        (tmp_path / "a\0b.npy", "output = .*must be a file that can be written"),
    ):
        with pytest.raises(BadInput, match=message):
            export("ggx", output, axes=AXES)
    with pytest.raises(BadInput, match="model = None: must be given where no preset is"):
        export(None, tmp_path / "E.npy", axes=AXES)
    for name in ("E.npy", "E.mean.npy", "E.npy.meta.json"):
        (tmp_path / name).write_text("old")
        with pytest.raises(BadInput, match=f"output = .*{name}': exists; --force writes over it"):
            export("ggx", tmp_path / "E.npy", axes=AXES)
        assert (tmp_path / name).read_text() == "old"
        (tmp_path / name).unlink()


def test_force(tmp_path: Path) -> None:
    (tmp_path / "E.npy").write_text("old")
    export("ggx", tmp_path / "E.npy", axes=AXES, points=0, force=True)
    assert read(tmp_path / "E.npy")[0].values.shape == (3, 4)
    assert {path.name for path in tmp_path.iterdir()} == {"E.npy", "E.mean.npy", "E.npy.meta.json"}


def test_what_a_format_cannot_hold(tmp_path: Path) -> None:
    """An albedo above 1 is no fraction of 65535: nothing is clamped, and nothing written."""
    with pytest.raises(BadInput, match=r"values = 2.0\d*: .*u16 holds values in \[0, 1\] only"):
        export("lambert", tmp_path / "E.u16", axes=["mu=3"], albedo=1.0, scale=2.0, points=0)
    with pytest.raises(BadInput, match=r"mu = 0.0: the albedo of ward .*diverges"):
        export("ward", tmp_path / "E.npy", axes=["mu=3"], m=0.2, scale=1.0, points=0)
    with pytest.raises(Inconclusive, match="tolerance = 1e-15"):
        export("ggx", tmp_path / "E.npy", axes=["mu=3"], alpha=0.3, tolerance=1e-15, points=0)
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("moment", range(5))
def test_interrupted_while_computing(tmp_path: Path, moment: int) -> None:
    """In the table, in its means, in the search for the error: no file is left."""

    def progress(done: int, total: int) -> None:
        if done >= min(moment * 1000, 3500):
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        export("ggx", tmp_path / "E.npy", axes=AXES, points=16, progress=progress)
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("function", ["open", "replace", "link"])
@pytest.mark.parametrize("call", range(4))
def test_interrupted_while_writing(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, function: str, call: int) -> None:
    """Before or after any step of any file: all of the new ones or none, and the old as they were."""
    contents = {tmp_path / name: name.encode() for name in ("a", "b", "c")}
    for after in (False, True):
        for path in tmp_path.iterdir():
            path.unlink()
        (tmp_path / "a").write_bytes(b"old a")
        (tmp_path / "c").write_bytes(b"old c")
        count = 0
        true = getattr(os, function)

        def interrupted(*args: Any, true: Any = true, after: bool = after, **kwargs: Any) -> Any:
            nonlocal count
            count += 1
            if count == call + 1 and not after:
                raise KeyboardInterrupt
            result = true(*args, **kwargs)
            if count == call + 1:
                raise KeyboardInterrupt
            return result

        with monkeypatch.context() as patch:
            patch.setattr(writing.os, function, interrupted)
            try:
                write_all(contents)
                stopped = False
            except KeyboardInterrupt:
                stopped = True
        assert stopped == (count > call)
        left = {path.name: path.read_bytes() for path in tmp_path.iterdir()}
        complete = {"a": b"a", "b": b"b", "c": b"c"}
        assert (
            left == complete
            if not stopped or (function == "replace" and call == 2 and after)
            else left == {"a": b"old a", "c": b"old c"}
        )


def test_a_disk_that_is_full(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """No file of an export remains when the last of them cannot be written."""
    stage, count = writing._stage, 0

    def full(temporary: Path, data: bytes, modified: float | None) -> None:
        nonlocal count
        count += bool(data)
        stage(temporary, data, modified)
        if count == 3:
            raise OSError(28, "No space left on device")

    monkeypatch.setattr(writing, "_stage", full)
    with pytest.raises(OSError, match="No space left"):
        export("ggx", tmp_path / "E.npy", axes=AXES, points=0)
    assert list(tmp_path.iterdir()) == []


def test_files_without_links(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Where the file system has none, what was there is copied before it is replaced, and comes back too."""
    contents = {tmp_path / "a": b"new a", tmp_path / "b" / "missing": b""}
    (tmp_path / "a").write_bytes(b"old a")
    monkeypatch.setattr(writing.os, "link", lambda *_: (_ for _ in ()).throw(OSError(1, "no links")))
    with pytest.raises(FileNotFoundError):
        write_all(contents)
    (tmp_path / "b").mkdir()
    replace = os.replace

    def once(source: Path, target: Path) -> None:
        if target.name == "missing":
            raise OSError(5, "broken")
        replace(source, target)

    monkeypatch.setattr(writing.os, "replace", once)
    with pytest.raises(OSError, match="broken"):
        write_all(contents)
    assert (tmp_path / "a").read_bytes() == b"old a"
    assert list((tmp_path / "b").iterdir()) == []
    monkeypatch.setattr(writing.os, "replace", replace)
    write_all(contents)
    assert (tmp_path / "a").read_bytes() == b"new a"
    assert {path.name for path in tmp_path.iterdir()} == {"a", "b"}


def test_permissions_and_times(tmp_path: Path) -> None:
    """What the user's mask leaves, and the time that is asked for."""
    mask = os.umask(0o027)
    try:
        write_whole(tmp_path / "a", "é", modified=12.0)
    finally:
        os.umask(mask)
    assert (tmp_path / "a").read_bytes() == "é".encode()
    assert (tmp_path / "a").stat().st_mode & 0o777 == 0o640
    assert (tmp_path / "a").stat().st_mtime == 12.0
