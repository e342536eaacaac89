"""Every format reads back what it wrote, to the precision that it stores; and what others wrote."""

from __future__ import annotations

import json
import math
import shutil
import struct
import subprocess
import zipfile
import zlib
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image

from albedo_lab.analysis.request import effort
from albedo_lab.catalogue import find
from albedo_lab.errors import BadInput
from albedo_lab.lookup.axes import parse_axes
from albedo_lab.lookup.formats import FORMATS, Layout, Stored, encode, format_of, read
from albedo_lab.lookup.formats.arrays import decode
from albedo_lab.lookup.formats.numerals import understood
from albedo_lab.lookup.source import QUANTITIES, Source
from albedo_lab.lookup.table import Table

AXES = (("mu=7",), ("roughness=5", "mu=4"), ("eta=3@1.2:2", "roughness=2", "mu=5"))
PLAIN = Layout()
HALF_ULP = {"float32": 2.0**-25, "float64": 2.0**-54}
"""Of the largest number below 1."""
SHAPELESS = {"u16"}
NAMELESS = {"npy", "csv", "u16"}
"""Formats that hold numbers only."""


def made(axes: Sequence[str] = AXES[1], quantity: str = "albedo", name: str = "E", values: Any = None, seed: int = 6) -> Table:
    """A table of values in (0, 1) that no model has."""
    parsed = parse_axes(axes, "centres" if quantity == "split-sum" else "endpoints")
    fixed = (("F", {"split-sum": "schlick"}.get(quantity, "dielectric" if len(axes) > 2 else "one")),)
    source = Source(find("ggx"), quantity, effort(1e-6, "quadrature", 0, 1), fixed)
    shape = (*(axis.size for axis in parsed), len(QUANTITIES[quantity].channels))
    rng = np.random.default_rng(seed)
    drawn = rng.random(shape) if values is None else np.broadcast_to(np.asarray(values, np.float64), shape).copy()
    return Table(name, source, parsed, drawn, 1e-9 * rng.random(shape), 5e-10 * rng.random(shape), 1234)


def record_of(*tables: Table) -> dict[str, Any]:
    """As much of a record as readers look at."""
    entries = [{"name": t.name, "shape": list(t.sizes), "channels": list(t.source.channels)} for t in tables]
    return {"model": "ggx", "tables": entries}


def written(folder: Path, kind: str, tables: Sequence[Table], layout: Layout = PLAIN, told: bool = True) -> Path:
    """The main file of tables; those beside it stand there too."""
    for added, data in encode(kind, tables, layout, record_of(*tables) if told else {}).items():
        (folder / f"table{added}{FORMATS[kind].suffixes[0]}").write_bytes(data)
    return folder / f"table{FORMATS[kind].suffixes[0]}"


def expected(table: Table, dtype: str) -> Any:
    """What a file of that type holds, computed without the writers."""
    if dtype == "uint16":
        return np.floor(table.stored * 65535.0 + 0.5) / 65535.0
    return table.stored.astype(dtype).astype(np.float64)


@pytest.mark.parametrize("axes", AXES)
@pytest.mark.parametrize("quantity", ["albedo", "split-sum"])
@pytest.mark.parametrize(("kind", "dtype"), [(kind, dtype) for kind, what in FORMATS.items() for dtype in what.dtypes])
def test_round_trip(tmp_path: Path, kind: str, dtype: str, quantity: str, axes: tuple[str, ...]) -> None:
    """Bit by bit what the type holds of the values, in the table's shape, with the error that this has made and no larger one."""
    if quantity == "split-sum" and len(axes) > 2:
        axes = ("alpha_x=3@0.1:1", "alpha_y=2@0.1:1", "mu=5")
    table = made(axes, quantity)
    layout = Layout("" if dtype == FORMATS[kind].dtypes[0] else dtype)
    (stored,) = read(written(tmp_path, kind, [table], layout), shape=table.stored.shape if kind in SHAPELESS else None)
    assert stored.name == ("table" if kind in NAMELESS else "E")
    assert stored.values.dtype == np.float64
    assert stored.values.shape == table.stored.shape
    lost = np.max(np.abs(stored.values - table.stored))
    if dtype == "uint16":
        assert np.allclose(stored.values, expected(table, dtype), rtol=0.0, atol=1e-16)
        assert stored.rounding == pytest.approx(0.5 / 65535.0)
        assert stored.kind == "16 bits"
    else:
        assert np.array_equal(stored.values, expected(table, dtype))
        assert stored.rounding == HALF_ULP[dtype]
        assert stored.kind == dtype
    assert lost <= stored.rounding


@pytest.mark.parametrize("decimals", [3, 6, 12])
@pytest.mark.parametrize("kind", ["csv", "json", "c", "glsl"])
def test_decimals(tmp_path: Path, kind: str, decimals: int) -> None:
    """Text of fixed decimals tells its own precision; what a program makes of it as float32 comes on top."""
    table = made()
    (stored,) = read(written(tmp_path, kind, [table], Layout(decimals=decimals)))
    lost = np.max(np.abs(stored.values - table.stored))
    assert stored.kind == f"text of {decimals} decimals"
    assert np.array_equal(stored.values, [[float(f"{x:.{decimals}f}") for x in row] for row in table.stored])
    single = 2.0**-25 if kind in ("c", "glsl") else 0.0
    assert stored.rounding == pytest.approx(0.5 * 10.0**-decimals + single, rel=1e-12)
    assert 0.8 * 0.5 * 10.0**-decimals < lost <= stored.rounding


@pytest.mark.parametrize("kind", FORMATS)
def test_the_means_beside(tmp_path: Path, kind: str) -> None:
    """In the same file where that holds several arrays, in one beside it otherwise."""
    table, mean = made(), made(("roughness=5",), "mean-albedo", "E_avg")
    path = written(tmp_path, kind, [table, mean])
    beside = path.with_name(f"table.mean{path.suffix}")
    assert beside.exists() != FORMATS[kind].several
    found = [*read(path), *(read(beside) if beside.exists() else [])]
    assert [stored.values.size for stored in found] == [20, 5]
    for stored, wanted in zip(found, (table, mean), strict=True):
        assert np.allclose(stored.values.ravel(), wanted.stored.ravel(), rtol=0.0, atol=stored.rounding)


@pytest.mark.parametrize("kind", ["npz", "json", "exr", "png"])
def test_the_record_inside(tmp_path: Path, kind: str) -> None:
    table = made()
    (stored,) = read(written(tmp_path, kind, [table]))
    assert stored.record == record_of(table)


@pytest.mark.parametrize("kind", FORMATS)
def test_the_same_bytes(kind: str) -> None:
    once, again = (encode(kind, [made(), made(("roughness=5",), "mean-albedo", "E_avg")], Layout(), {}) for _ in range(2))
    assert once == again
    assert once != encode(kind, [made(seed=7)], Layout(), {})


def test_npz(tmp_path: Path) -> None:
    """NumPy reads everything by its name; no date of writing tells one file from another."""
    table = made()
    path = written(tmp_path, "npz", [table])
    with np.load(path) as archive:
        assert set(archive) == {"E", "E_half_width", "E_alpha", "E_mu", "record"}
        assert np.array_equal(archive["E"], table.stored)
        assert np.array_equal(archive["E_half_width"], table.half_widths[..., 0])
        assert np.array_equal(archive["E_alpha"], table.axes[0].nodes)
        assert json.loads(str(archive["record"])) == record_of(table)
    with zipfile.ZipFile(path) as archive:
        assert {member.date_time for member in archive.infolist()} == {(1980, 1, 1, 0, 0, 0)}
    (bare,) = (stored for stored in read(written(tmp_path, "npz", [table], told=False)) if stored.name == "E_mu")
    assert list(bare.values) == list(table.axes[1].nodes)
    with pytest.raises(BadInput, match="name = 'E_mu': is that of two arrays"):
        encode("npz", [table, made(name="E_mu")], Layout(), {})


def test_npy_is_rows_first(tmp_path: Path) -> None:
    """The bytes behind the header are what a program reads that knows nothing of NumPy."""
    table = made()
    assert (
        written(tmp_path, "npy", [table])
        .read_bytes()
        .endswith(b"".join(struct.pack("<d", x) for row in table.stored for x in row))
    )


def test_csv(tmp_path: Path) -> None:
    """A column per axis, channel and half-width; the order of the rows does not matter to the reader."""
    table = made(AXES[1], "split-sum")
    path = written(tmp_path, "csv", [table])
    head, *rows = path.read_text().splitlines()
    assert head == "alpha,mu,scale,bias,half_width_scale,half_width_bias"
    first = [float(text) for text in rows[0].split(",")]
    assert first == [table.axes[0].nodes[0], table.axes[1].nodes[0], *table.values[0, 0], *table.half_widths[0, 0]]
    path.write_text("\n".join([head, *reversed(rows)]))
    (stored,) = read(path)
    assert np.array_equal(stored.values, table.values[::-1, ::-1])


def test_json(tmp_path: Path) -> None:
    table = made()
    told = json.loads(written(tmp_path, "json", [table]).read_text())
    assert told["record"] == record_of(table)
    (entry,) = told["tables"]
    assert entry["values"] == table.stored.tolist()
    assert entry["half_widths"] == table.half_widths[..., 0].tolist()
    assert entry["axes"] == {axis.name: axis.nodes.tolist() for axis in table.axes}


PROGRAM = """#include <stdio.h>
#include <string.h>
#include "table.h"
int main(void) {
    size_t i;
    unsigned long long bits;
    for (i = 0; i < sizeof NAME / sizeof NAME[0]; ++i) {
        bits = 0;
        memcpy(&bits, &NAME[i], sizeof NAME[0]);
        printf("%llx\\n", bits);
    }
    return sizeof E_avg / sizeof E_avg[0] == 5 ? 0 : 1;
}
"""


@pytest.mark.skipif(shutil.which("cc") is None, reason="no C compiler")
@pytest.mark.parametrize(
    ("quantity", "layout"), [("albedo", Layout()), ("split-sum", Layout("float64")), ("albedo", Layout("uint16"))]
)
def test_c_header(tmp_path: Path, quantity: str, layout: Layout) -> None:
    """C99 and C++ compile it without a warning, and a program finds the bits that were to be written, little-endian or not."""
    table = made(AXES[1], quantity, values=None)
    table.values[0, 0] = 0.0, *table.values[0, 0, 1:]
    table.values[1, 0, 0] = 1.0
    table.values[2, 0, 0] = 1e-7 if layout.dtype == "uint16" else 1e-30
    written(tmp_path, "c", [table, made(("roughness=5",), "mean-albedo", "E_avg")], layout)
    (tmp_path / "main.c").write_text(PROGRAM.replace("NAME", "E"))
    strict = ["-Wall", "-Wextra", "-Werror", "-pedantic", "-Wconversion", "-I", str(tmp_path)]
    subprocess.run(["cc", "-std=c99", *strict, str(tmp_path / "main.c"), "-o", str(tmp_path / "main")], check=True)
    ran = subprocess.run([str(tmp_path / "main")], check=True, capture_output=True, text=True)
    kind = {"": "float32"}.get(layout.dtype, layout.dtype)
    numbers = np.rint(table.values * 65535).astype("<u2") if kind == "uint16" else table.values.astype(kind)
    bits = numbers.ravel().view({2: "u2", 4: "u4", 8: "u8"}[numbers.itemsize])
    assert [int(line, 16) for line in ran.stdout.split()] == bits.tolist()
    if shutil.which("c++") is not None:
        subprocess.run(["c++", "-std=c++11", *strict, "-fsyntax-only", "-x", "c++", str(tmp_path / "main.c")], check=True)


def test_what_a_header_says(tmp_path: Path) -> None:
    """The index, where on which axis, and the error; nothing that could end the comment."""
    table = made(AXES[1], "split-sum")
    hostile = Table("E", table.source, table.axes, table.values, table.half_widths, table.standard_errors, 1)
    object.__setattr__(
        hostile, "source", Source(table.source.model, "split-sum", table.source.want, (("F", "schlick"), ("k", "*/ é /*\n\\")))
    )
    text = written(tmp_path, "c", [hostile]).read_bytes().decode("ascii")
    assert "E[(i * 4 + j) * 2 + c]: E = scale F0 + bias" in text
    assert "i = 5 * sqrt(alpha) - 0.5: sqrt(alpha), 5 nodes from alpha = 0 to 1, at the centres of texels." in text
    assert "j = 4 * mu - 0.5" in text
    assert text.count("/*") == text.count("*/") == 2
    (said,) = (float(line.split("at most ")[1][:-1]) for line in text.splitlines() if "95 %" in line)
    assert np.max(table.half_widths) <= said <= 1.1 * np.max(table.half_widths)


def test_glsl(tmp_path: Path) -> None:
    """Constructors with as many components as they say; no suffix and no comma that GLSL would refuse."""
    text = written(tmp_path, "glsl", [made(AXES[1], "split-sum"), made(name="B")]).read_text()
    assert "const vec2 E[5 * 4] = vec2[5 * 4](\n    vec2(0." in text
    assert "const float B[5 * 4] = float[5 * 4](\n" in text
    code = "".join(line for line in text.splitlines() if not line.startswith("//"))
    assert code.count("vec2(") == 20
    assert not any(wrong in code.replace(" ", "") for wrong in (",)", "f,", "f)", "{"))


def test_exr_by_its_own_library(tmp_path: Path) -> None:
    openexr = pytest.importorskip("OpenEXR")
    three = made(("eta=3@1.2:2", "roughness=2", "mu=5"))
    with openexr.File(str(written(tmp_path, "exr", [three])), separate_channels=True) as file:
        assert set(file.channels()) == {"R"}
        pixels = file.channels()["R"].pixels
        assert pixels.dtype == np.float32
        assert np.array_equal(pixels, three.stored.astype(np.float32).reshape(6, 5))
        assert json.loads(file.header()["albedo_lab"]) == record_of(three)
    pair = made(AXES[1], "split-sum")
    with openexr.File(str(written(tmp_path, "exr", [pair])), separate_channels=True) as file:
        for index, channel in enumerate("RG"):
            assert np.array_equal(file.channels()[channel].pixels, pair.values[..., index].astype(np.float32))
    half = tmp_path / "half.exr"
    grey = np.random.default_rng(1).random((3, 4)).astype(np.float16)
    with openexr.File(
        {"compression": openexr.ZIP_COMPRESSION, "type": openexr.scanlineimage}, dict.fromkeys("RGB", grey)
    ) as file:
        file.write(str(half))
    (stored,) = read(half)
    assert np.array_equal(stored.values, grey.astype(np.float64))
    assert (stored.kind, stored.rounding) == ("half floats", 2.0**-12)


def test_exr_without_its_library(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(__import__("sys").modules, "OpenEXR", None)
    with pytest.raises(BadInput, match=r"format = 'exr': needs OpenEXR: pip install 'albedo-lab\[exr\]'"):
        encode("exr", [made()], Layout(), {})


def test_png_by_another_library(tmp_path: Path) -> None:
    """Pillow reads our 16 bits; we read its filtered rows of 8 bits, grey and coloured, with alpha or without."""
    table = made()
    with Image.open(written(tmp_path, "png", [table])) as image:
        assert np.array_equal(np.asarray(image), np.rint(table.stored * 65535))
    y, x = np.mgrid[0:40, 0:50]
    channels = [x * 5, y * 6, (x + y) % 256, 255 - x]
    for mode, count in (("L", 1), ("LA", 2), ("RGB", 3), ("RGBA", 4)):
        pixels = np.stack(channels[:count], axis=-1).astype(np.uint8)
        Image.fromarray(pixels[..., 0] if count == 1 else pixels, mode=None).save(tmp_path / "theirs.png")
        with Image.open(tmp_path / "theirs.png") as image:
            assert image.mode == mode
        (stored,) = read(tmp_path / "theirs.png")
        assert np.allclose(stored.values.reshape(pixels.shape) * 255.0, pixels, rtol=0.0, atol=1e-12)
        assert (stored.kind, stored.rounding) == ("8 bits", 0.5 / 255)
    # what every image library adds to a table of one or two channels
    plain = np.stack([channels[0], channels[1], 0 * x, 0 * x + 255], axis=-1).astype(np.uint8)
    Image.fromarray(plain).save(tmp_path / "pair.png")
    assert read(tmp_path / "pair.png")[0].values.shape == (40, 50, 2)


DECLARED = [
    ("const float a[4] = float[4](0.1, 0.2, 0.3, 1.0);", "a", [0.1, 0.2, 0.3, 1.0]),
    ("const float a[] = float[](0.1, 0.2);", "a", [0.1, 0.2]),
    ("const float[2] t = {-0.25, 5e-1};", "t", [-0.25, 0.5]),
    ("const vec2 T[2] = vec2[2](vec2(0.1, 0.2), vec2(.3, 4.));", "T", [[0.1, 0.2], [0.3, 4.0]]),
    ("static const float2 T[2] = { float2(0.1,0.2), {0.2,0.3} };", "T", [[0.1, 0.2], [0.2, 0.3]]),
    ("static std::array<float, 4> foo = {{ 0.1f, 0.2f, 0.3f, 0.4f }};", "foo", [0.1, 0.2, 0.3, 0.4]),
    ("std::array<std::array<float, 2>, 2> foo{{ {{0.1f,0.2f}}, {{0.3f,0.4f}} }};", "foo", [[0.1, 0.2], [0.3, 0.4]]),
    ("#define N 2\nconst float a[N * N] = {1,2,3,4.5};", "a", [[1.0, 2.0], [3.0, 4.5]]),
    ("const int N = 2; const float a[N][2] = {1,2,3,4.5};", "a", [[1.0, 2.0], [3.0, 4.5]]),
    ("/* = {1.5, 2.5} */ float b[2][3] = {{1.5,2,3}, // {9}\n{3,4,5},};", "b", [[1.5, 2.0, 3.0], [3.0, 4.0, 5.0]]),
    ("float E[][2] = {{1.0,2},{3,4},{5,6}};", "E", [[1.0, 2.0], [3.0, 4.0], [5.0, 6.0]]),
    ("float f(float x) { float y = (x + 2.0) * 3.0; return y; } const float t[2] = {0.25, 0.5};", "t", [0.25, 0.5]),
    ("namespace lut { constexpr double t[3]{0.1, 0.2, 0.3}; }", "t", [0.1, 0.2, 0.3]),
    ("const t = new Float32Array([0.1, 0.2, 0.3]);", "t", [0.1, 0.2, 0.3]),
    ("E = np.array([[0.1, 0.2], [0.3, 0.4]])", "E", [[0.1, 0.2], [0.3, 0.4]]),
    ("const float a[3] = {NAN, INFINITY, -0.5F};", "a", [math.nan, math.inf, -0.5]),
    ("0.1f, 0.2f,\n0.33f,", "", [0.1, 0.2, 0.33]),
    ("{0.1f, 0.2f, 0.33f}", "", [0.1, 0.2, 0.33]),
    ("static const unsigned short u[3] = {0, 13107, 65535u};", "u", [0.0, 0.2, 1.0]),
    ("const uint8_t u[3] = {0, 1, 0};", "u", [0.0, 1 / 255, 0.0]),
    ("const uint16_t h[2] = {0x3c00, 0x3800};", "h", [1.0, 0.5]),
]


@pytest.mark.parametrize(("text", "name", "values"), DECLARED)
def test_arrays_of_others(text: str, name: str, values: list[Any]) -> None:
    (stored,) = decode(text.encode(), "theirs.h")
    assert stored.name == name
    assert stored.values.shape == np.shape(values)
    assert np.allclose(stored.values, values, rtol=1e-15, atol=0.0, equal_nan=True)


def test_several_arrays_of_others(tmp_path: Path) -> None:
    """Each by its name; a shape goes to those that have as many numbers."""
    path = tmp_path / "theirs.h"
    path.write_text("float a[4] = {.1, .2, .3, .4};\nint n = 3;\nfloat b[2] = {.5, .6}; float c[4] = {1., 2., 3., 4.};")
    assert [stored.name for stored in read(path)] == ["a", "b", "c"]
    assert [(stored.name, stored.values.tolist()) for stored in read(path, shape=(2, 2))] == [
        ("a", [[0.1, 0.2], [0.3, 0.4]]),
        ("c", [[1.0, 2.0], [3.0, 4.0]]),
    ]
    with pytest.raises(BadInput, match=r"shape = \[3, 3\]: is that of 9 numbers; .* holds a of 4, b of 2, c of 4"):
        read(path, shape=(3, 3))
    with pytest.raises(BadInput, match=r"shape = .*whole numbers above 0"):
        read(path, shape=(0, 4))


LISTS = [
    ("x.txt", "0.1 0.2\n0.3 0.4\n", [[0.1, 0.2], [0.3, 0.4]]),
    ("x.dat", "# of old\n0.1\n0.2\n", [0.1, 0.2]),
    ("x.csv", "0,5;0,25\n1;0\n", [[0.5, 0.25], [1.0, 0.0]]),
    ("x.csv", "alpha,mu,E\n0.1,0,0.5\n0.2,0,0.6\n0.1,1,0.7\n0.2,1,0.8\n", [[0.5, 0.7], [0.6, 0.8]]),
    ("x.csv", "a,b\n0.5,0.25\n0.5,0.125\n", [[0.5, 0.25], [0.5, 0.125]]),
    ("x.json", "[[0.1, 0.2], [0.3, null]]", [[0.1, 0.2], [0.3, math.nan]]),
    ("x.json", '{"lut": {"E": [0.1, "inf"]}, "size": [32]}', [0.1, math.inf]),
    ("x.unknown", "[0, 51, 255]", [0.0, 0.2, 1.0]),
    ("x.unknown", "float E[2] = {0.5, 0.25};", [0.5, 0.25]),
    ("x.unknown", "0.5 0.25", [0.5, 0.25]),
]


@pytest.mark.parametrize(("name", "text", "values"), LISTS)
def test_lists_of_others(tmp_path: Path, name: str, text: str, values: list[Any]) -> None:
    (tmp_path / name).write_text(text)
    (stored,) = read(tmp_path / name)
    assert stored.values.shape == np.shape(values)
    assert np.allclose(stored.values, values, rtol=1e-15, atol=0.0, equal_nan=True)


@pytest.mark.parametrize(
    ("array", "kind", "rounding"),
    [
        (np.array([0.25, 0.75], np.float16), "half floats", 2.0**-12),
        (np.array([0, 255], np.uint8), "8 bits", 0.5 / 255),
        (np.array([0, 200], np.int64), "8 bits", 0.5 / 255),
        (np.array([-1, 200], np.int64), "integers", 0.5),
        (np.array([0.25, 0.75], ">f4"), "float32", 2.0**-25),
        (np.array([0.25, np.inf, np.nan]), "float64", 2.0**-55),
    ],
)
def test_arrays_of_numpy(tmp_path: Path, array: Any, kind: str, rounding: float) -> None:
    for suffix in (".npy", ".npz"):
        path = tmp_path / f"x{suffix}"
        np.save(path, array) if suffix == ".npy" else np.savez_compressed(path, E=array, words=np.array(["a"]))
        (stored,) = read(path)
        assert (stored.kind, stored.rounding) == (kind, rounding)


NUMBERS = [
    (["0.500000", "1.000000", "0.123456"], "text of 6 decimals", 5e-7),
    (["0.5", "1.0", "0.1235"], "text of 4 decimals", 5e-5),
    (["0.5", "12.25", "0.123456"], "text of 6 decimals", 5e-7),
    (["0.00012346", "0.98765"], "text of 5 digits", 5e-6),
    (["0.98040503", "0.5", "1e-10"], "float32", 2.0**-25),
    (["0.980405031", "0.5"], "text of 9 decimals", 5e-10),
    (["0.9804050326347351", "0.5"], "float64", 2.0**-54),
    (["1.0", "0.0"], "text of 1 decimal", 0.05),
    (["nan", "nan"], "no finite numbers", 0.0),
]


@pytest.mark.parametrize(("texts", "kind", "rounding"), NUMBERS)
def test_precision_of_text(texts: list[str], kind: str, rounding: float) -> None:
    values, found, how = understood(texts)
    assert how == kind
    assert found == pytest.approx(rounding, rel=1e-9)
    assert np.allclose(values, [float(text) for text in texts], rtol=1e-7, equal_nan=True)


@pytest.mark.parametrize("kind", ["npz", "npy", "csv", "json", "exr"])
def test_what_is_not_finite_is_kept(tmp_path: Path, kind: str) -> None:
    values = np.random.default_rng(3).random((5, 4, 1))
    values[0, :3, 0] = math.nan, math.inf, -math.inf
    table = made(values=values)
    (stored,) = read(written(tmp_path, kind, [table]))
    assert np.array_equal(np.isnan(stored.values), np.isnan(table.stored))
    assert np.array_equal(np.isinf(stored.values), np.isinf(table.stored))


UNWRITABLE = [
    ("c", math.nan, Layout(), "values = nan: E: must be finite in float32 to stand in c"),
    ("glsl", math.inf, Layout(decimals=3), "values = inf: E: must be finite"),
    ("c", 1e39, Layout(), r"values = 1e\+39: E: must be finite in float32"),
    ("npy", 1e39, Layout("float32"), r"values = 1e\+39: E: must be finite in float32 to stand in npy"),
    ("exr", 1e39, Layout(), r"values = 1e\+39"),
    ("u16", 1.000001, Layout(), r"values = 1.000001: E: u16 holds values in \[0, 1\] only"),
    ("png", -2e-9, Layout(), r"values = -2e-09: E: png holds values in \[0, 1\] only"),
    ("c", math.nan, Layout("uint16"), r"values = nan: E: c holds values in \[0, 1\] only"),
    ("u16", 0.5, Layout("float32"), "dtype = 'float32': must be uint16 in the format u16"),
    ("glsl", 0.5, Layout("float64"), "dtype = 'float64': must be float32"),
    ("csv", 0.5, Layout("float16"), "dtype = 'float16': must be float64 or float32"),
    ("npz", 0.5, Layout(decimals=6), "decimals = 6: .*npz have none"),
    ("c", 0.5, Layout("uint16", 6), "decimals = 6: uint16 in the format c have none"),
    ("c", 0.5, Layout(decimals=0), r"decimals = 0: must be an integer in \[1, 30\]"),
]


@pytest.mark.parametrize(("kind", "value", "layout", "message"), UNWRITABLE)
def test_what_no_file_can_hold(kind: str, value: float, layout: Layout, message: str) -> None:
    with pytest.raises(BadInput, match=message):
        encode(kind, [made(values=value)], layout, {})


def test_what_is_outside_by_its_error_only(tmp_path: Path) -> None:
    """A limit of 1 that came out as 1 + 1e-10, known to 1e-9, is 1; one known to 1e-3 must still be the nearest of 16 bits."""
    table = made(values=1.0 + 1e-10)
    table.half_widths[:] = 1e-9
    assert set(read(written(tmp_path, "u16", [table]))[0].values) == {1.0}
    wide = made(values=1.0 + 1e-4)
    wide.half_widths[:] = 1e-3
    with pytest.raises(BadInput, match=r"values = 1.0001: E: u16 holds"):
        encode("u16", [wide], Layout(), {})


@pytest.mark.parametrize("name", ["float", "2x", "a-b", "a__b", "gl_E", "vec2", "é", ""])
def test_names_that_programs_refuse(name: str) -> None:
    for kind in ("c", "glsl"):
        with pytest.raises(BadInput, match=r"name = .*that C and GLSL take"):
            encode(kind, [made(name=name)], Layout(), {})


UNREADABLE: list[tuple[str, bytes, str]] = [
    ("x.npz", b"PK\x03\x04 and so on", "is no .npz file"),
    ("x.npy", b"\x93NUMPY\x01\x00", "is no .npy file"),
    (
        "x.npy",
        b"\x93NUMPY\x01\x00\x76\x00{'descr': '<f8', 'fortran_order': False, 'shape': (9, 9999999999999)}",
        "is no .npy file",
    ),
    ("x.csv", b"alpha,mu\n0.1,word\n", "holds 'word', which is no number"),
    ("x.csv", b"a,b\n", "holds no numbers"),
    ("x.json", b"[0.1, 0.2", "is no JSON"),
    ("x.json", b"[" * 99999, "is no JSON"),
    ("x.json", b'{"a": "b"}', "holds no array of numbers"),
    ("x.h", b"int main(void) { return 0; }", "holds no array of numbers"),
    ("x.h", b"static const float t[2][2] = {0.25, 0.5, 0.75};", "t is declared to have 2 x 2 numbers and has 3"),
    ("x.exr", b"\x76\x2f\x31\x01garbage", "is no OpenEXR file"),
    ("x.u16", b"abc", "odd number of bytes"),
    ("x.png", b"\x89PNG\r\n\x1a\nxx", "is no PNG"),
    ("x.h", b"", "is empty"),
    ("x.bin", b"\x00\x01\x02", "name one of npz, npy"),
]


@pytest.mark.parametrize(("name", "content", "message"), UNREADABLE)
def test_what_is_no_table(tmp_path: Path, name: str, content: bytes, message: str) -> None:
    if name.endswith(".exr"):
        pytest.importorskip("OpenEXR")
    (tmp_path / name).write_bytes(content)
    with pytest.raises(BadInput, match=message) as caught:
        read(tmp_path / name)
    assert "\n" not in str(caught.value)


def test_what_is_no_file(tmp_path: Path) -> None:
    for path, message in (
        (tmp_path, "must be a file"),
        (tmp_path / "missing.h", "No such file"),
        (tmp_path / "a\0b.h", "cannot be read"),
    ):
        with pytest.raises(BadInput, match=message):
            read(path)
    np.save(tmp_path / "words.npy", np.array(["a", "b"]))
    np.save(tmp_path / "pickled.npy", np.array([0.5, None]), allow_pickle=True)
    for name, message in (("words.npy", "no real numbers"), ("pickled.npy", "is no .npy file")):
        with pytest.raises(BadInput, match=message):
            read(tmp_path / name)


def test_formats_by_name_and_suffix() -> None:
    assert [format_of(Path(f"x{what.suffixes[0].upper()}")) for what in FORMATS.values()] == list(FORMATS)
    assert format_of(Path("x.json"), "glsl") == "glsl"
    with pytest.raises(BadInput, match=r"format = '\.jpg': no format has this suffix"):
        format_of(Path("x.jpg"))
    with pytest.raises(BadInput, match="format = 'jpg': must be one of npz"):
        format_of(Path("x.json"), "jpg")


@pytest.mark.parametrize("kind", [kind for kind in FORMATS if kind != "exr"])
def test_damage_is_told_or_read(tmp_path: Path, kind: str) -> None:
    """A file cut short or with bytes changed is refused in one line, or read as what it then is: never a traceback."""
    (data,) = encode(kind, [made()], Layout(), record_of(made())).values()
    rng = np.random.default_rng(9)
    path = tmp_path / "damaged"
    refused = []
    for _ in range(60):
        broken = bytearray(data[: rng.integers(1, len(data))] if rng.random() < 0.5 else data)
        for place in rng.integers(0, len(broken), rng.integers(0, 4)):
            broken[place] = rng.integers(256)
        path.write_bytes(broken)
        try:
            assert all(isinstance(stored, Stored) for stored in read(path, kind))
        except BadInput as error:
            refused.append(str(error))
    assert refused
    assert not any("\n" in line for line in refused)


def test_a_png_that_was_changed(tmp_path: Path) -> None:
    """Its checksums tell, though it could still be unpacked."""
    path = written(tmp_path, "png", [made()])
    data = path.read_bytes()
    path.write_bytes(data.replace(b'"name": "E"', b'"name": "F"'))
    with pytest.raises(BadInput, match="its checksum is another"):
        read(path)


def test_a_png_too_large_to_be_one(tmp_path: Path) -> None:
    """What claims to be huge is refused before anything is unpacked."""
    head = struct.pack(">IIBBBBB", 1 << 20, 1 << 20, 16, 0, 0, 0, 0)
    chunk = struct.pack(">I", len(head)) + b"IHDR" + head + struct.pack(">I", zlib.crc32(b"IHDR" + head))
    (tmp_path / "x.png").write_bytes(b"\x89PNG\r\n\x1a\n" + chunk)
    with pytest.raises(BadInput, match="of a table's size"):
        read(tmp_path / "x.png")
