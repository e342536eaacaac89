import json
import shutil
from types import SimpleNamespace

import numpy as np
import pandas as pd
import pytest
from click.testing import CliRunner

from albedo_lab.cli import main
from albedo_lab.lookup.audit import audit
from albedo_lab.lookup.export import export

AXES = ("roughness=8", "mu=7")


def run(*arguments):
    return CliRunner().invoke(main, [str(argument) for argument in arguments])


@pytest.fixture(scope="module")
def sound(tmp_path_factory):
    """A table of ggx and its record."""
    folder = tmp_path_factory.mktemp("sound")
    export("ggx", folder / "x.npy", axes=AXES, mean=False, points=0)
    return folder


@pytest.fixture
def folder(tmp_path, monkeypatch, sound):
    """A copy of it to play with, the working directory."""
    shutil.copytree(sound, tmp_path, dirs_exist_ok=True)
    monkeypatch.chdir(tmp_path)
    return tmp_path


def test_a_sound_table(folder):
    """The text is that of the Python call, on standard output or in a file; nothing else is written."""
    before = set(folder.iterdir())
    result = run("audit", "x.npy")
    assert (result.exit_code, result.stderr) == (0, "")
    assert result.stdout == audit("x.npy").text()
    assert "by the record beside x.npy" in result.stdout
    assert set(folder.iterdir()) == before
    assert run("audit", "x.npy", "-o", "x.txt").exit_code == 0
    assert (folder / "x.txt").read_text() == result.stdout


def test_a_table_with_a_wrong_cell(folder):
    """One cell off by 1e-3 is status 1, and is named; a tolerance above that forgives it."""
    values = np.load("x.npy")
    values[5, 3] -= 1e-3
    np.save("x.npy", values)
    result = run("audit", "x.npy", "--json")
    record = json.loads(result.stdout, parse_constant=pytest.fail)
    assert (result.exit_code, record["verdict"], result.stderr) == (1, "defects", "")
    assert [cell[:2] for defect in record["defects"] for cell in defect["cells"]] == [[5, 3]]
    assert run("audit", "x.npy", "--tolerance", "2e-3").exit_code == 0
    for plot in ("a.svg", "b.svg"):
        assert run("audit", "x.npy", "--tolerance", "2e-3", "--plot", plot, "-o", "x.txt").exit_code == 0
    assert (folder / "a.svg").read_bytes() == (folder / "b.svg").read_bytes()
    assert "deviation from albedo E of ggx" in (folder / "a.svg").read_text(encoding="utf-8")


def test_what_the_options_say(folder):
    """They go before the record: another variant, other axes, a shape of numbers that have none."""
    said = ["--model", "ggx", "--axis", AXES[0], "--axis", AXES[1], "--quantity", "albedo"]
    other = run("audit", "x.npy", *said, "-p", "G=smith")
    assert (other.exit_code, "other model" in other.stdout) == (1, True)
    (folder / "flat.txt").write_text("\n".join(map(repr, np.load("x.npy").ravel().tolist())))
    result = run("audit", "flat.txt", *said, "--shape", "8x7")
    assert (result.exit_code, result.stderr) == (0, "")
    assert "by the options" in result.stdout


def test_a_table_that_nobody_knows(monkeypatch):
    """The text is told, and the status is that of the audit; what makes it 3 is tested with the audit."""
    monkeypatch.setattr(
        "albedo_lab.lookup.audit.audit", lambda file, **options: SimpleNamespace(status=3, text=lambda: "unknown\n")
    )
    result = run("audit", "noise.npy")
    assert (result.exit_code, result.stdout, result.stderr) == (3, "unknown\n", "")


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        ([], ["FILE"]),
        (["missing.npy"], ["file = 'missing.npy'", "No such file"]),
        (["."], ["file"]),
        (["empty.npy"], ["empty"]),
        (["prose.md"], ["file = 'prose.md'", "no table of 8 or more numbers"]),
        (["long.txt"], ["shape = [600]", "--shape 32x32"]),
        (["x.npy", "--format", "exr"], ["x.npy"]),
        (["x.npy", "--format", "tiff"], ["--format", "tiff", "npz"]),
        (["x.npy", "--shape", "7x7"], ["shape = [7, 7]", "49"]),
        (["x.npy", "--shape", "8by7"], ["shape", "8by7"]),
        (["x.npy", "--shape", ""], ["shape"]),
        (["x.npy", "--array", "9"], ["array = '9'"]),
        (["x.npy", "--preset", "unreal"], ["--preset", "unreal", "cycles"]),
        (["x.npy", "--preset", "cycles"], ["shape = [8, 7", "32 x 32"]),
        (["x.npy", "--model", "wart"], ["model = 'wart'", "ward"]),
        (["x.npy", "--axis", "mu"], ["axis = 'mu'"]),
        (["x.npy", "--quantity", "albdo"], ["--quantity", "albdo"]),
        (["x.npy", "--sampling", "corners"], ["--sampling", "corners"]),
        (["x.npy", "--tolerance", "0"], ["tolerance = 0.0"]),
        (["x.npy", "--tolerance", "small"], ["tolerance = 'small'"]),
        (["x.npy", "--threads", "0"], ["threads = 0"]),
        (["x.npy", "-p", "G=smith"], ["G = 'smith'", "model"]),
        (["x.npy", "-p", "shape=3"], ["shape = 3.0", "option"]),
        (["x.npy", "--plot", "x.jpg"], ["plot", "x.jpg", ".svg, .png or .pdf"]),
        (["x.npy", "--plot", "missing/x.svg"], ["plot", "No such file"]),
        (["x.npy", "--plot", "a.svg", "-o", "a.svg"], ["plot", "a file of its own"]),
        (["x.npy", "-o", "x.npy"], ["output", "a file of its own"]),
        (["x.npy", "-o", "."], ["output = '.'"]),
    ],
)
def test_bad_usage_of_audit(folder, arguments, said):
    """One line, status 2; nothing is written, and least of all over the table."""
    (folder / "empty.npy").write_bytes(b"")
    (folder / "prose.md").write_text("As in `audit(mu = (0.1, 0.2))`, with `theta = {30, 60}`.\n")
    (folder / "long.txt").write_text("0.5\n" * 600)
    before = {path.name: path.read_bytes() for path in folder.iterdir()}
    result = run("audit", *arguments)
    assert (result.exit_code, result.stdout) == (2, "")
    assert result.stderr.startswith("albedo-lab: ")
    assert result.stderr.count("\n") == 1
    assert "Error:" not in result.stderr, "unforeseen"
    for part in said:
        assert part in result.stderr
    assert {path.name: path.read_bytes() for path in folder.iterdir()} == before


def test_compensate(tmp_path):
    """A white model with exact albedos is compensated exactly; the largest is that of all directions."""
    asked = [
        "compensate",
        "ggx",
        "--axis",
        "roughness=8",
        "--axis",
        "mu=8",
        "--at",
        "alpha=0.5",
        "--F0",
        "1",
        "--mu",
        "1,0.5,0.1",
    ]
    result = run(*asked, "--format", "csv", "-o", tmp_path / "every.csv")
    assert (result.exit_code, result.output) == (0, "")
    every = pd.read_csv(tmp_path / "every.csv")
    assert every.mu.tolist() == [1.0, 0.5, 0.1]
    assert every.alpha.tolist() == [0.5] * 3
    assert np.all(np.abs(every.residual_kulla_conty_exact) <= every.residual_bound)
    assert np.all(np.abs(every.residual_kulla_conty) < every.residual_none)
    assert np.all(every.asymmetry_kulla_conty == 0.0)
    assert np.all(every.asymmetry_turquin > 0.0)
    largest = json.loads(run(*asked, "--largest", "--format", "json").stdout)
    assert [row["residual_none"] for row in largest] == [every.residual_none.max()]
    assert largest[0]["residual_kulla_conty"] == every.residual_kulla_conty[every.residual_kulla_conty.abs().argmax()]


def test_a_preset_brings_its_variant():
    """OpenPBR's masking is the separable one, which no default is; what the user says goes first."""
    asked = ["--axis", "roughness=2", "--axis", "mu=2", "--at", "alpha=1", "--mu", "0.5", "--F0", "1", "--format", "json"]
    ways = (["--preset", "openpbr"], ["ggx", "-p", "G=smith"], ["ggx"], ["--preset", "openpbr", "-p", "G=smith_correlated"])
    of_preset, separable, default, correlated = (json.loads(run("compensate", *way, *asked).stdout)[0]["E"] for way in ways)
    assert of_preset == separable != default
    assert correlated == default


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        ([], ["model", "preset"]),
        (["--preset", "filament-dfg", "--axis", "mu=2", "--axis", "roughness=2"], ["quantity = 'split-sum'"]),
        (["ggx"], ["axis", "one to three"]),
        (["ggx", "-p", "F=schlick", "--axis", "mu=3"], ["F = 'schlick'"]),
        (["ggx", "--axis", "mu=3", "--mu", "0"], ["mu = 0.0"]),
        (["ggx", "--axis", "mu=3", "--mu", "low"], ["mu = 'low'"]),
        (["ggx", "--axis", "mu=3", "--F0", "2"], ["F0 = 2.0"]),
        (["ggx", "--axis", "mu=3", "--at", "n=3"], ["values"]),
        (["ggx", "--axis", "mu=3", "--at", "n"], ["'n'", "NAME=VALUE"]),
        (["ggx", "--axis", "mu=3", "--phi-deg", "left"], ["phi_deg = 'left'"]),
        (["phong_original", "--axis", "mu=3@0.1:1"], ["reciprocal"]),
    ],
)
def test_bad_usage_of_compensate(arguments, said):
    result = run("compensate", *arguments)
    assert (result.exit_code, result.stdout) == (2, "")
    assert result.stderr.count("\n") == 1
    assert "Error:" not in result.stderr, "unforeseen"
    for part in said:
        assert part in result.stderr
