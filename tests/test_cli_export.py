import json
import subprocess
import sys

import numpy as np
import pytest
from click.testing import CliRunner

from albedo_lab.cli import main
from albedo_lab.cli.options import FORMATS, PRESETS, QUANTITIES
from albedo_lab.lookup.export import export
from albedo_lab.lookup.formats import read

SMALL = ["--axis", "roughness=3", "--axis", "mu=4"]
QUICK = ["--points", "16"]


def run(*arguments):
    return CliRunner().invoke(main, [str(argument) for argument in arguments])


def written(folder):
    return {path.name: path.read_bytes() for path in folder.iterdir()}


@pytest.fixture
def folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    return tmp_path


def assert_refused(result, status, *said):
    assert (result.exit_code, result.stdout) == (status, "")
    assert result.stderr.startswith("albedo-lab: ")
    assert result.stderr.count("\n") == 1
    for part in said:
        assert part in result.stderr


def test_the_command_line_knows_every_name():
    from albedo_lab.lookup import formats, presets, source

    assert tuple(source.QUANTITIES) == QUANTITIES
    assert tuple(formats.FORMATS) == FORMATS
    assert tuple(presets.PRESETS) == PRESETS


@pytest.mark.parametrize("command", ["export", "audit"])
def test_help_starts_light(command):
    heavy = {"numba", "pandas", "scipy", "matplotlib", "numpy"}
    code = (
        "import sys; from albedo_lab.cli import main\n"
        f"try: main(['{command}', '--help'])\n"
        f"finally: sys.stderr.write(' '.join({heavy} & set(sys.modules)))"
    )
    result = subprocess.run([sys.executable, "-c", code], capture_output=True, check=True, text=True)
    assert "--axis" in result.stdout
    assert result.stderr == ""


def test_the_same_files_as_from_python(folder):
    """Options reach the analysis under their own names: another variant, decimals, a name."""
    (folder / "a").mkdir()
    (folder / "b").mkdir()
    result = run("export", "ggx", "-p", "G=smith", *SMALL, *QUICK, "--decimals", "6", "--name", "E", "-o", "a/x.h")
    assert (result.exit_code, result.stderr) == (0, "")
    assert [line.split()[1] for line in result.stdout.splitlines()] == ["name", "E", "E_mean"]
    export("ggx", "b/x.h", G="smith", axes=["roughness=3", "mu=4"], points=16, decimals=6, name="E")
    assert written(folder / "a") == written(folder / "b")
    assert set(written(folder / "a")) == {"x.h", "x.h.meta.json"}
    values = {stored.name: stored.values for stored in read(folder / "a/x.h")}
    assert values["E"].shape == (3, 4)
    assert np.all(values["E"][0] == 1.0)


def test_options_that_change_the_table(folder):
    result = run("export", "lambert", "-p", "albedo=0.25", "--axis", "mu=2", *QUICK, "--quantity", "energy-loss", "-o", "x.npy")
    assert (result.exit_code, result.stderr) == (0, "")
    assert np.load("x.npy") == pytest.approx([0.75, 0.75], abs=1e-12)
    result = run("export", "ggx", *SMALL, *QUICK, "--no-mean", "--sampling", "centres", "--format", "json", "-o", "y.txt")
    assert (result.exit_code, len(result.stdout.splitlines())) == (0, 2)
    record = json.loads((folder / "y.txt.meta.json").read_text())
    assert [axis["sampling"] for axis in record["tables"][0]["axes"]] == ["centres", "centres"]


def test_a_preset_brings_its_model(folder):
    """The user's words go before the preset's."""
    result = run("export", "--preset", "cycles", "--axis", "mu=3", "--axis", "roughness=2", *QUICK, "-o", "x.h")
    assert (result.exit_code, result.stderr) == (0, "")
    assert {stored.name: stored.values.shape for stored in read("x.h")} == {"table_ggx_E": (3, 2), "table_ggx_Eavg": (2,)}


def test_nothing_is_overwritten_unless_forced(folder):
    arguments = ["export", "lambert", "--axis", "mu=2", *QUICK, "-o", "x.npy"]
    (folder / "x.npy").write_bytes(b"mine")
    assert_refused(run(*arguments), 2, "output", "x.npy", "--force")
    assert written(folder) == {"x.npy": b"mine"}
    assert run(*arguments, "--force").exit_code == 0
    assert np.load("x.npy").shape == (2,)


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        ([], ["output", "must be given"]),
        (["-o", "x.h"], ["model", "preset"]),
        (["ggx", "-o", "-"], ["output = '-'"]),
        (["ggx", *SMALL], ["output", "must be given"]),
        (["ggx", "-o", "x.h"], ["axis", "one to three"]),
        (["ggx", *SMALL, "-o", "missing/x.h"], ["output = 'missing/x.h'", "No such file"]),
        (["ggx", *SMALL, "-o", "x.abc"], ["format = '.abc'", "npz"]),
        (["ggx", *SMALL, "-o", "x.h", "--format", "tiff"], ["--format", "tiff", "exr"]),
        (["ggx", *SMALL, "-o", "x.h", "--preset", "unreal"], ["--preset", "unreal", "cycles"]),
        (["ggx", *SMALL, "-o", "x.h", "--quantity", "albdo"], ["--quantity", "albdo", "split-sum"]),
        (["ggx", *SMALL, "-o", "x.h", "--sampling", "corners"], ["--sampling", "corners", "centres"]),
        (["ggx", *SMALL, "-o", "x.h", "--decimals", "many"], ["decimals = 'many'"]),
        (["ggx", *SMALL, "-o", "x.h", "--decimals", "-1"], ["decimals = -1"]),
        (["ggx", *SMALL, "-o", "x.npy", "--decimals", "3"], ["decimals = 3"]),
        (["ggx", *SMALL, "-o", "x.h", "--name", "1 2"], ["name = '1 2'"]),
        (["ggx", *SMALL, "-o", "x.h", "--points", "few"], ["--points", "few"]),
        (["ggx", *SMALL, "-o", "x.h", "--tolerance", "0"], ["tolerance = 0.0"]),
        (["ggx", *SMALL, "-o", "x.h", "--seed", "-1"], ["seed = -1"]),
        (["ggx", *SMALL, "-o", "x.h", "--phi-deg", "left"], ["phi_deg = 'left'"]),
        (["ggx", *SMALL, "-o", "x.h", "--norm", "rms"], ["norm", "--advise"]),
        (["ggx", *SMALL, "-o", "x.h", "-p", "G=smith,none"], ["G", "one value"]),
        (["ggx", *SMALL, "-o", "x.h", "-p", "points=3"], ["points = 3.0", "option"]),
        (["ggx", *SMALL, "-o", "x.h", "-p", "alpha=0.3"], ["alpha = 0.3", "axis"]),
        (["ggx", *SMALL, "-o", "x.h", "-p", "q=0.3"], ["q = 0.3"]),
        (["ggx", *SMALL, "-o", "x.h", "-p", "G=smyth"], ["G = 'smyth'", "smith_correlated"]),
        (["ggx", "--axis", "roughness=32", "-o", "x.h"], ["axis", "mu"]),
        (["ggx", "--axis", "rough=32", "--axis", "mu=3", "-o", "x.h"], ["axis = 'rough'"]),
        (["ggx", "--axis", "mu", "-o", "x.h"], ["axis = 'mu'", "SIZE"]),
        (["ggx", "--axis", "mu=1", "-o", "x.h"], ["axis = 'mu=1'", "2 to"]),
        (["ggx", "--axis", "mu=many", "-o", "x.h"], ["axis = 'mu=many'"]),
        (["ggx", "--axis", "mu=3@0:2", "-o", "x.h"], ["mu = 2.0", "[0, 1]"]),
        (["ggx", "--axis", "mu=3@0", "-o", "x.h"], ["axis = 'mu=3@0'"]),
        (["ggx", "--axis", "mu=3@1:1", "-o", "x.h"], ["axis = 'mu=3@1:1'", "different"]),
        (["ggx", "--axis", "mu=3", "--axis", "sqrt(mu)=3", "-o", "x.h"], ["axis", "different variables"]),
        (["ggx", *SMALL, "--advise", "small"], ["advise = 'small'"]),
        (["ggx", *SMALL, "--advise", "1e-9"], ["bound = 1e-09", "tolerance"]),
        (["ggx", *SMALL, "--advise", "0.1", "--phi-deg", "left"], ["phi_deg = 'left'"]),
        (["ggx", *SMALL, "--advise", "0.1", "-o", "x.h"], ["output", "--advise"]),
        (["ggx", *SMALL, "--advise", "0.1", "--decimals", "6"], ["decimals = 6", "--advise"]),
        (["ggx", "--advise", "0.1"], ["axis", "one to three"]),
    ],
)
def test_bad_usage_of_export(folder, arguments, said):
    """One line, before anything is computed or written."""
    assert_refused(run("export", *arguments), 2, *said)
    assert not any(folder.iterdir())


def test_an_interrupted_export_leaves_nothing(folder, monkeypatch):
    def fails(*arguments, **options):
        raise KeyboardInterrupt

    monkeypatch.setattr("albedo_lab.lookup.export.interpolation_error", fails)
    assert run("export", "lambert", "--axis", "mu=2", "-o", "x.npy").exit_code == 130
    assert not any(folder.iterdir())


COMPENSATED = ["--mu", "0.5", "--F0", "1", "--at", "alpha=0.3", "--format", "csv"]


def test_compensation_from_a_file_and_from_a_model(folder):
    """Of doubles nothing is lost: the same answer. What the record says cannot be said again."""
    assert run("export", "ggx", *SMALL, "--points", "0", "-o", "E.npz").exit_code == 0
    by_file, by_model = run("compensate", "E.npz", *COMPENSATED), run("compensate", "ggx", *SMALL, *COMPENSATED)
    assert (by_file.exit_code, by_file.stderr) == (0, "")
    assert by_file.stdout == by_model.stdout
    assert len(by_file.stdout.splitlines()) == 2
    for options, said in (
        (["-p", "alpha=0.5"], "alpha"),
        (["--axis", "mu=3"], "axes"),
        (["--seed", "1"], "seed"),
        (["--threads", "1"], "threads"),
    ):
        assert_refused(run("compensate", "E.npz", *options), 2, f"{said} = ", "E.npz")
    (folder / "E.npz").write_bytes((folder / "E.npz").read_bytes()[:-1])
    assert run("compensate", "E.npz").exit_code == 2


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        ([], ["model", "preset"]),
        (["ggx"], ["axis", "one to three"]),
        (["missing.npz"], ["file = 'missing.npz'", "No such file"]),
        (["ggxx", *SMALL], ["model = 'ggxx'", "ggx"]),
        (["missing.py:f", *SMALL], ["model = 'missing.py:f'"]),
        (["ggx", *SMALL, "--mu", "0"], ["mu = 0.0"]),
        (["ggx", *SMALL, "--F0", "2"], ["F0 = 2.0"]),
        (["ggx", *SMALL, "--at", "alpha=nan"], ["alpha = nan"]),
        (["ggx", *SMALL, "--at", "n=1"], ["values = ['n']"]),
        (["ggx", *SMALL, "-p", "F=schlick", "-p", "F0=0.5"], ["F = 'schlick'"]),
        (["ggx", "--preset", "filament-dfg"], ["quantity = 'split-sum'"]),
        (["ggx", "--axis", "roughness=3", "--axis", "mu=3@0:2"], ["mu = 2.0"]),
    ],
)
def test_bad_usage_of_compensate(folder, monkeypatch, arguments, said):
    """One line, before anything is computed."""
    monkeypatch.setattr("albedo_lab.lookup.compensation.tabulated", lambda *_: pytest.fail("computed"))
    assert_refused(run("compensate", *arguments), 2, *said)


def test_advice(folder):
    """Equal albedos are read exactly from any table; nothing is written. A bound out of reach is status 3, the tables told."""
    asked = ["export", "phong", "--axis", "mu=8", "--points", "16", "--advise"]
    result = run(*asked, "0.1")
    assert (result.exit_code, result.stderr) == (0, "")
    head, first = (line.split() for line in result.stdout.splitlines()[:2])
    assert head[0] == "axes"
    assert first[-1] == "True"
    assert first[0].endswith("=8@0:1")
    hopeless = run(*asked, "3e-6")
    assert hopeless.exit_code == 3
    assert hopeless.stdout.startswith("axes")
    assert (hopeless.stderr.count("\n"), "advise = 3e-06" in hopeless.stderr) == (1, True)
    assert not any(folder.iterdir())
