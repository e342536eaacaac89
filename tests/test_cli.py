import io
import json
import math
import os
import pty
import subprocess
import sys
from importlib.resources import files
from types import SimpleNamespace
from xml.etree import ElementTree

import pandas as pd
import pytest
from click.testing import CliRunner
from jsonschema import Draft202012Validator

import albedo_lab
from albedo_lab import catalogue
from albedo_lab.cli import main
from albedo_lab.digits import justified
from albedo_lab.errors import BadInput, Inconclusive
from albedo_lab.report.formats import KINDS, format_rows

FIGURES = ["standard_error", "ci95_low", "ci95_high"]
EXPLAINED = ["samples", "method", "seed", "non_finite"]
QUICK = ["--tolerance", "1e-3"]


def run(*arguments):
    return CliRunner().invoke(main, [str(argument) for argument in arguments])


def shell(*arguments, **options):
    settings = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE} | options
    return subprocess.run([sys.executable, "-m", "albedo_lab", *arguments], check=False, timeout=100, **settings)


def assert_refused(result, status, *said):
    assert result.exit_code == status
    assert result.stdout == ""
    assert result.stderr.startswith("albedo-lab: ")
    assert result.stderr.count("\n") == 1
    assert result.stderr.endswith("\n")
    for part in said:
        assert part in result.stderr


@pytest.fixture
def folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        ([], ["Missing command"]),
        (["lst"], ["lst", "list"]),
        (["--fast"], ["--fast"]),
        (["show"], ["MODEL"]),
        (["show", "wart"], ["model = 'wart'", "ward"]),
        (["albedo", "phong", "mirror"], ["mirror"]),
        (["albedo", "phong\nphong"], [r"'phong\nphong'"]),
        (["mean-albedo", "phong", "--mu", "1"], ["--mu"]),
        (["normalise", "phong", "-p", "scale=2"], ["scale", "2.0"]),
        (["list", "--format", "xml"], ["--format", "xml", "csv"]),
        (["list", "-o", "."], ["output = '.'"]),
        (["check"], ["model", "--all"]),
        (["check", "phong", "--all"], ["model = 'phong'", "--all"]),
        (["check", "phong", "wart"], ["model = 'wart'", "ward"]),
        (["check", "phong", "ward", "-p", "n=3"], ["n = 3.0", "ward"]),
        (["check", "phong", "-p", "only=energy"], ["only = 'energy'", "it takes n, scale"]),
        (["check", "phong", "--only", "energie"], ["only = 'energie'", "finiteness"]),
        (["check", "phong", "--only", ""], ["only = ''"]),
        (["check", "phong", "--skip", "energy,,"], ["skip = ''"]),
        (["check", "phong", "--only", "energy", "--skip", "energy"], ["skip = 'energy'", "no check"]),
        (["check", "phong", "--alpha", "1"], ["alpha = 1.0"]),
        (["check", "phong", "--alpha", "low"], ["alpha = 'low'"]),
        (["check", "phong", "--budget", "0"], ["budget = 0"]),
        (["check", "phong", "--budget", "much"], ["budget = 'much'"]),
        (["check", "phong", "--excess", "-1"], ["excess = -1.0"]),
        (["check", "phong", "--excess", "nan"], ["excess = nan"]),
        (["check", "phong", "--seed", "-1"], ["seed = -1"]),
        (["check", "phong", "--threads", "0"], ["threads = 0"]),
        (["check", "merl"], ["file", "must be given"]),
        (["check", "phong", "--junit", "-"], ["junit = '-'", "standard output"]),
        (["check", "phong", "--junit", "missing/x.xml"], ["junit = 'missing/x.xml'", "No such file"]),
        (["check", "phong", "--junit", "x", "-o", "x"], ["junit", "another file"]),
        (["check", "phong", "-o", "."], ["output = '.'"]),
        (["grazing", "phong", "--phi-deg", "361"], ["phi_deg = 361.0", "turn"]),
        (["grazing", "phong", "-p", "q=1"], ["q = 1.0", "it takes n, scale"]),
    ],
)
def test_bad_usage(folder, arguments, said):
    assert_refused(run(*arguments), 2, *said)
    assert not any(folder.iterdir())


@pytest.mark.parametrize(
    ("options", "said"),
    [
        (["-p", "q=3"], ["q = 3.0", "it takes n, scale"]),
        (["-p", "mu=1"], ["mu = 1.0", "it takes n, scale"]),
        (["-p", "tolerance=1"], ["tolerance = 1.0", "it takes n, scale"]),
        (["-p", "n"], ["parameter = 'n'", "NAME=VALUE"]),
        (["-p", "=3"], ["parameter = '=3'", "NAME=VALUE"]),
        (["-p", "n="], ["n = ''", "[0, 1e+08]"]),
        (["-p", "n=1,,2"], ["n = ''", "[0, 1e+08]"]),
        (["-p", "n=1", "-p", "n=2"], ["n = '2'", "twice"]),
        (["-p", "n=-1"], ["n = -1.0", "[0, 1e+08]"]),
        (["-p", "n=1,1e9"], ["n = 1000000000.0", "[0, 1e+08]"]),
        (["-p", "n=" + "9" * 5000], ["n = inf", "[0, 1e+08]"]),
        (["-p", "n=nan"], ["n = nan", "[0, 1e+08]"]),
        (["-p", "n=-inf"], ["n = -inf", "[0, 1e+08]"]),
        (["-p", "n=many"], ["n = 'many'", "[0, 1e+08]"]),
        (["-p", "scale=nan"], ["scale = nan", "[0, "]),
        (["-p", "scale=-1"], ["scale = -1.0", "[0, "]),
        (["--theta-deg", "90"], ["theta_deg = 90.0", "[0, 90) degrees"]),
        (["--theta-deg", "0,-1"], ["theta_deg = -1.0", "[0, 90) degrees"]),
        (["--theta-deg", "nan"], ["theta_deg = nan", "[0, 90) degrees"]),
        (["--theta-deg", ""], ["theta_deg = ''", "[0, 90) degrees"]),
        (["--theta-deg", "0,steep"], ["theta_deg = 'steep'", "[0, 90) degrees"]),
        (["--mu", "0"], ["mu = 0.0", "[1e-20, 1]"]),
        (["--mu", "1.5"], ["mu = 1.5", "[1e-20, 1]"]),
        (["--mu", "1", "--theta-deg", "0"], ["mu", "theta_deg", "exactly one"]),
        (["--phi-deg", "inf"], ["phi_deg = inf", "turn"]),
        (["--tolerance", "0"], ["tolerance = 0.0", "above 0"]),
        (["--tolerance", "nan"], ["tolerance = nan", "above 0"]),
        (["--tolerance", "inf"], ["tolerance = inf", "above 0"]),
        (["--tolerance", "small"], ["tolerance = 'small'", "above 0"]),
        (["--seed", "-1"], ["seed = -1", "[0, 2^64)"]),
        (["--seed", "1" + "0" * 400], ["seed = 1000", "[0, 2^64)"]),
        (["--seed", "1.5"], ["seed = '1.5'", "[0, 2^64)"]),
        (["--threads", "0"], ["threads = 0", "[1, 1024]"]),
        (["--threads", "1e9"], ["threads = '1e9'", "[1, 1024]"]),
        (["--method", "guess"], ["--method", "guess", "quadrature"]),
        (["--format", "xml"], ["--format", "xml", "latex"]),
        (["-o", "/"], ["output = '/'"]),
        (["-o", ""], ["output = ''"]),
        (["-o", "new/"], ["output = 'new/'"]),
        (["-o", "/dev/null"], ["output = '/dev/null'"]),
        (["-o", "missing/albedo.csv"], ["output = 'missing/albedo.csv'", "No such file or directory"]),
        (["-o", "a" * 300], ["output = 'aaa", "too long"]),
    ],
)
def test_bad_options(folder, options, said):
    """A bad option is refused before anything is computed or written."""
    output = [] if "-o" in options else ["-o", "albedo.csv"]
    assert_refused(run("albedo", "phong", *options, *output), 2, *said)
    assert not any(folder.iterdir())


@pytest.mark.parametrize("command", ["albedo", "mean-albedo", "normalise"])
def test_unreachable_tolerance(folder, command):
    assert_refused(run(command, "phong", "--tolerance", "1e-300", "-o", "x.csv"), 3, "tolerance = 1e-300")
    assert not any(folder.iterdir())


@pytest.mark.parametrize(
    ("error", "status", "lines"),
    [
        (BadInput("n", 1, "must be\nanother"), 2, 1),
        (OSError(28, "No space left on device"), 2, 1),
        (Inconclusive("not\nreached"), 3, 1),
        (KeyboardInterrupt(), 130, 0),
    ],
)
def test_errors_while_computing(folder, monkeypatch, error, status, lines):
    def fails(*arguments, **options):
        raise error

    monkeypatch.setattr("albedo_lab.analysis.albedo.albedo", fails)
    result = run("albedo", "phong", "-o", "x.csv")
    assert (result.exit_code, result.stdout, len(result.stderr.split("\n")) - 1) == (status, "", max(lines, 1))
    assert len(result.stderr.strip().splitlines()) == lines
    assert not any(folder.iterdir())


@pytest.mark.parametrize(
    ("arguments", "columns"),
    [
        (
            ["albedo", "ward", "-p", "m_x=0.1,0.2", "--theta-deg", "0,89.999", "--phi-deg", "45"],
            [
                *["form", "as_printed", "m", "m_x", "m_y", "scale", "theta_deg", "phi_deg"],
                "albedo",
                *FIGURES,
                *EXPLAINED,
                "order",
            ],
        ),
        (
            ["albedo", "phong", "--mu", "0.5"],
            ["n", "scale", "theta_deg", "albedo", *FIGURES, *EXPLAINED, "order"],
        ),
        (
            ["albedo", "metal", "-p", "metal=gold", "-p", "wavelength=400,450", "--theta-deg", "0"],
            ["metal", "angle", "n", "wavelength", "scale", "theta_deg", "albedo", *FIGURES, *EXPLAINED, "order"],
        ),
        (["mean-albedo", "p_phong"], ["n", "p", "scale", "mean_albedo", *FIGURES, *EXPLAINED, "order"]),
        (
            ["normalise", "schlick_isotropic", "-p", "r=0.3"],
            ["r", "constant", *FIGURES, *EXPLAINED, "peak_theta_deg", "paper_constant", "behaviour", "order"],
        ),
    ],
)
def test_columns(arguments, columns):
    """The columns of the mission, in its order, in csv and json alike."""
    read = run(*arguments, *QUICK, "--format", "csv")
    assert read.stdout.splitlines()[0].split(",") == ["model", *columns]
    records = json.loads(run(*arguments, *QUICK, "--format", "json").stdout)
    assert all(list(record) == list(dict.fromkeys(["model", *columns])) for record in records)


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["albedo", "metal", "-p", "metal=tin"], ["metal = 'tin'", "gold, silver, copper, aluminium"]),
        (["albedo", "metal", "-p", "metal=gold", "-p", "wavelength=1000"], ["wavelength = 1000.0", "[380, 780]"]),
        (["albedo", "metal", "-p", "metal=gold", "-p", "eta=1"], ["eta = 1.0", "metal = gold", "wavelength"]),
        (["albedo", "phong_blend", "-p", "as_printed=maybe"], ["as_printed = 'maybe'", "no, yes"]),
        (["albedo", "phong_blend", "-p", "as_printed=1"], ["as_printed = 1.0", "no, yes"]),
        (["albedo", "lafortune", "-p", "lobes=0"], ["lobes = 0.0", "[1, 100]"]),
        (["albedo", "lafortune", "-p", "lobes=many"], ["lobes = 'many'", "[1, 100]"]),
        (["show", "lafortune", "-p", "n_2=3"], ["n_2 = 3.0", "lobes = 1"]),
        (["albedo", "merl"], ["file", "must be given"]),
        (["albedo", "missing.binary"], ["file = 'missing.binary'", "No such file"]),
        (["show", "short.binary"], ["file = 'short.binary'", "34992012"]),
        (["colour", "metal"], ["custom", "wavelength"]),
        (["colour", "metal", "-p", "metal=gold", "-p", "wavelength=500"], ["wavelength", "at least 2"]),
        (["tabulate", "phong"], ["-o"]),
        (["tabulate", "phong", "-o", "-"], ["output = '-'"]),
        (["tabulate", "ward", "-p", "m_x=0.3", "-o", "x.binary"], ["ward", "anisotropic"]),
        (["tabulate", "mirror", "-o", "x.binary"], ["mirror"]),
        (["tabulate", "phong", "-p", "n=1,2", "-o", "x.binary"], ["n", "three"]),
    ],
)
def test_bad_members(folder, arguments, said):
    """What families, measurements and colours refuse, before anything is written."""
    (folder / "short.binary").write_bytes(b"short")
    assert_refused(run(*arguments), 2, *said)
    assert [path.name for path in folder.iterdir()] == ["short.binary"]


def test_a_formula_and_its_table_go_through_the_same_door(folder):
    """Three exponents as red, green and blue of one file, whose channels are then three rows."""
    made = run("tabulate", "stretched_phong", "-p", "n=1,4,20", "-o", "x.binary")
    assert (made.exit_code, made.stderr) == (0, "")
    of_table, of_formula = (
        pd.read_csv(io.StringIO(run("albedo", *asked, "--theta-deg", "45", "--tolerance", "1e-4", "--format", "csv").stdout))
        for asked in (["x.binary"], ["stretched_phong", "-p", "n=1,4,20"])
    )
    assert of_table.channel.tolist() == ["red", "green", "blue"]
    assert of_table.albedo.tolist() == pytest.approx(of_formula.albedo.tolist(), rel=2e-3)  # what a cell of a degree blurs
    assert of_table.albedo.tolist() != pytest.approx(sorted(of_formula.albedo, reverse=True), rel=2e-3)


def test_colour():
    shown = run("colour", "metal", "-p", "metal=gold", "-p", "n=1e4", "--theta-deg", "0", "--method", "quadrature")
    assert "#ffdca5" in shown.stdout
    assert "standard_error" not in shown.stdout
    read = pd.read_csv(
        io.StringIO(run("colour", "metal", "-p", "metal=gold,silver", "--mu", "0.5", *QUICK, "--format", "csv").stdout)
    )
    assert read.metal.tolist() == ["gold", "silver"]
    assert (read.R > read.B).tolist() == [True, True]


def test_show_of_a_member():
    family, member = run("show", "metal").stdout, run("show", "metal", "-p", "metal=gold").stdout
    assert "custom, gold, silver, copper, aluminium, default custom" in family
    assert "eta" in family.partition("\nparameters")[2]
    assert "here gold" in member
    assert "in [380, 780] nm" in member


def test_csv_holds_every_bit():
    """What csv says reads back as the DataFrame of the Python call; a grid's first parameter varies slowest."""
    arguments = ["albedo", "p_phong", "-p", "n=3,1e3", "-p", "p=0,0.1", "--theta-deg", "0,89.9", *QUICK]
    read = pd.read_csv(io.StringIO(run(*arguments, "--format", "csv").stdout))
    frame = albedo_lab.albedo("p_phong", n=[3, 1e3], p=[0, 0.1], theta_deg=[0, 89.9], tolerance=1e-3)
    pd.testing.assert_frame_equal(read, frame, check_exact=True, check_dtype=False)
    cells = [(n, p, theta) for n in (3.0, 1e3) for p in (0.0, 0.1) for theta in (0.0, 89.9)]
    assert list(zip(read.n, read.p, read.theta_deg, strict=True)) == cells


def test_default_angles():
    assert run("albedo", "lambert", *QUICK, "--format", "csv").stdout.count("\n") == 9


def test_same_bytes(tmp_path):
    """One thread and a cold kernel cache, two threads and a warm one."""
    arguments = ["albedo", "stretched_phong", "--tolerance", "1e-6", "--theta-deg", "60", "--format", "csv"]
    environment = os.environ | {"ALBEDO_LAB_CACHE": str(tmp_path)}
    cold, warm = (shell(*arguments, "--threads", threads, env=environment) for threads in "12")
    assert (cold.returncode, cold.stderr) == (0, b"")
    assert cold.stdout == warm.stdout
    assert cold.stdout.count(b"\n") == 2


def test_status_of_the_process():
    refused = shell("albedo", "phong", "-p", "n=nan")
    assert (refused.returncode, refused.stdout, refused.stderr.count(b"\n")) == (2, b"", 1)


@pytest.mark.parametrize("arguments", [["--help"], ["--version"], ["list"], ["list", "--format", "json"], ["show", "ward"]])
def test_starts_light(arguments):
    """The list reads every model's file, of which some hold tables of numbers: numpy, but nothing heavier."""
    heavy = {"numba", "pandas", "scipy", "matplotlib"} | (set() if "list" in arguments else {"numpy"})
    code = (
        "import sys; from albedo_lab.cli import main\n"
        f"try: main({arguments})\n"
        f"finally: sys.stderr.write(' '.join({heavy} & set(sys.modules)))"
    )
    result = subprocess.run([sys.executable, "-c", code], capture_output=True, check=True, text=True)
    assert result.stdout
    assert result.stderr == ""


def test_version():
    assert run("--version").stdout == f"albedo-lab, version {albedo_lab.__version__}\n"


@pytest.mark.parametrize("kind", KINDS)
def test_list(kind):
    text = run("list", "--format", kind).stdout
    assert all(name.replace("_", r"\_" if kind == "latex" else "_") in text for name in catalogue.names())


@pytest.mark.parametrize("name", catalogue.names())
def test_show(name):
    model = catalogue.find(name)
    text = run("show", name).stdout
    shown = [model.formula, model.scale_symbol, model.source.title, model.source.equation]
    for parameter in model.parameters:
        shown += [parameter.name, parameter.domain, parameter.meaning]
    unwrapped = " ".join(text.split())
    for part in [name, *shown, *(claim.place for claim in model.claims)]:
        assert part in unwrapped
    assert max(map(len, text.splitlines()[2:])) <= 110


@pytest.mark.parametrize("kind", KINDS)
def test_output(folder, kind):
    """The file holds what standard output would, through a link as well, and nothing is left beside it."""
    (folder / "link").symlink_to("target")
    (folder / "target").write_text("old")
    written = run("list", "--format", kind, "-o", "link")
    assert (written.exit_code, written.output) == (0, "")
    assert (folder / "target").read_text() == run("list", "--format", kind, "-o", "-").stdout
    assert {path.name for path in folder.iterdir()} == {"link", "target"}


def test_progress_only_to_a_terminal():
    arguments = ["albedo", "lambert", "--theta-deg", "0,60", *QUICK, "--format", "csv"]
    quiet = shell(*arguments)
    terminal, other_end = pty.openpty()
    seen = shell(*arguments, stderr=other_end, env=os.environ | {"TERM": "xterm"})
    os.close(other_end)
    assert b"100%" in os.read(terminal, 65536)
    os.close(terminal)
    assert quiet.stderr == b""
    assert quiet.stdout == seen.stdout


def test_reader_gone():
    """A closed pipe is no failed check, and no traceback."""
    reader, writer = os.pipe()
    os.close(reader)
    result = shell("list", stdout=writer)
    os.close(writer)
    assert (result.returncode, result.stderr) == (141, b"")


@pytest.mark.skipif(not os.path.exists("/dev/full"), reason="needs a device that is full")
def test_no_space_left():
    with open("/dev/full", "wb") as full:
        result = shell("list", stdout=full)
    assert (result.returncode, result.stderr.count(b"\n")) == (2, 1)
    assert b"No space left" in result.stderr


@pytest.mark.parametrize(
    ("arguments", "asked"),
    [
        (["--threads", "3"], ("reports", (), 0, 3, None, False, 3)),
        (["neumann1999", "-o", "out", "--seed", "7", "--threads", "2"], ("out", ("neumann1999",), 7, 2, None, False, 2)),
        (["--timings", "--threads", "1"], ("reports", (), 0, 1, None, True, 1)),
    ],
)
def test_report(monkeypatch, arguments, asked):
    calls = []
    build = SimpleNamespace(write_reports=lambda folder, *others: calls.append((str(folder), *others)))
    monkeypatch.setitem(sys.modules, "albedo_lab.report.build", build)
    result = run("report", *arguments)
    assert (result.exit_code, result.output) == (0, "")
    assert calls == [asked]


NAMES = ["model", "n", "albedo", *FIGURES, "samples", "as_printed"]
ROWS = [
    ("a_b", 1.0, 0.95043123, 6e-6, 0.9504194, 0.9504431, 512, None),
    ("a_b", 100.5, math.inf, 0.0, math.inf, math.inf, 8, None),
    ("a_b", math.nan, 1.0, 0.0, 1.0, 1.0, 8, None),
]


@pytest.mark.parametrize(
    ("kind", "text"),
    [
        (
            "table",
            "model a_b\n\n"
            "    n      albedo     ± 95 %  samples\n"
            "  1      0.950431    1.2e-05      512\n"
            "100.5  inf         nan              8\n"
            "nan      1           0              8\n",
        ),
        (
            "csv",
            "model,n,albedo,standard_error,ci95_low,ci95_high,samples,as_printed\n"
            "a_b,1.0,0.95043123,6e-06,0.9504194,0.9504431,512,\n"
            "a_b,100.5,inf,0.0,inf,inf,8,\n"
            "a_b,nan,1.0,0.0,1.0,1.0,8,\n",
        ),
        (
            "json",
            '[\n{"model": "a_b", "n": 1.0, "albedo": 0.95043123, "standard_error": 6e-06, "ci95_low": 0.9504194, '
            '"ci95_high": 0.9504431, "samples": 512, "as_printed": null},\n'
            '{"model": "a_b", "n": 100.5, "albedo": "inf", "standard_error": 0.0, "ci95_low": "inf", '
            '"ci95_high": "inf", "samples": 8, "as_printed": null},\n'
            '{"model": "a_b", "n": null, "albedo": 1.0, "standard_error": 0.0, "ci95_low": 1.0, '
            '"ci95_high": 1.0, "samples": 8, "as_printed": null}\n]\n',
        ),
        (
            "md",
            "| model | n | albedo | ± 95 % | samples | as_printed |\n"
            "| --- | ---: | ---: | ---: | ---: | --- |\n"
            "| a_b | 1 | 0.950431 | 1.2e-05 | 512 |  |\n"
            "| a_b | 100.5 | inf | nan | 8 |  |\n"
            "| a_b | nan | 1 | 0 | 8 |  |\n",
        ),
        (
            "latex",
            "% \\usepackage{booktabs}\n"
            "\\begin{tabular}{lrrrrl}\n"
            "\\toprule\n"
            "model & n & albedo & $\\pm$ 95 \\% & samples & as\\_printed \\\\\n"
            "\\midrule\n"
            "a\\_b & $1$ & $0.950431$ & $1.2 \\times 10^{-5}$ & $512$ &  \\\\\n"
            "a\\_b & $100.5$ & $\\infty$ & nan & $8$ &  \\\\\n"
            "a\\_b & nan & $1$ & $0$ & $8$ &  \\\\\n"
            "\\bottomrule\n"
            "\\end{tabular}\n",
        ),
    ],
)
def test_formats(kind, text):
    assert format_rows(NAMES, ROWS, kind) == text


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("names", [NAMES, ["model", "n"]])
def test_formats_without_rows(names, kind):
    assert format_rows(names, [], kind).endswith("\n")


@pytest.mark.parametrize(
    ("interval", "shown"),
    [
        ((0.95043123, 0.95042, 0.95044), ("0.950431", "1.2e-05")),
        ((0.5, 0.375, 0.5625), ("0.50", "0.13")),
        ((20.611, 20.111, 21.111), ("20.61", "0.50")),
        ((500.0, 488.0, 512.0), ("500", "12")),
        ((81489238.5, 81488038.5, 81490438.5), ("81489238", "1.2e+03")),
        ((1.23456789e-7, 1.23455e-7, 1.23457e-7), ("1.234568e-07", "1.8e-12")),
        ((-3.5e20, -3.6e20, -3.4e20), ("-3.50e+20", "1.0e+19")),
        ((0.0, -1e-3, 1e-3), ("0.0000", "0.0010")),
        ((1e-200, 0.0, 2e-200), ("1.0e-200", "1.0e-200")),
        ((0.0, -1e-300, 1e-300), ("0.0000000000000000", "1.0e-300")),
        ((1.0, 1.0, 1.0), ("1", "0")),
        ((1.0, 0.0, math.inf), ("1", "inf")),
        ((math.nan, math.nan, math.nan), ("nan", "nan")),
    ],
)
def test_digits_that_the_error_justifies(interval, shown):
    assert justified(*interval) == shown


STUBS = ["finiteness", "positivity", "energy", "reciprocity", "grazing", "sampler", "claims", "quality"]


@pytest.fixture
def verdicts(monkeypatch):
    """Every check replaced by one that says what this dictionary holds for it, PASS by default."""
    from albedo_lab.analysis.check import CHECKS
    from albedo_lab.analysis.verdict import Finding, Verdict

    said = {}

    def stub(name):
        def found(subject, trial, before):
            kind = said.get(name, "PASS")
            if isinstance(kind, Exception):
                raise kind
            return [Finding(name, Verdict(kind), math.inf, 1.0, f"{name} <says>", "there" if kind == "FAIL" else "")]

        return found

    for name in STUBS:
        monkeypatch.setitem(CHECKS, name, stub(name))
    return said


@pytest.mark.parametrize(
    ("said", "status"),
    [
        ({}, 0),
        ({"sampler": "SKIPPED", "grazing": "REPORTED"}, 0),
        ({"energy": "FAIL"}, 1),
        ({"energy": "FAIL", "claims": "INCONCLUSIVE"}, 1),
        ({"claims": "INCONCLUSIVE"}, 3),
        ({"claims": Inconclusive("budget = 5: spent")}, 3),
        ({"claims": ZeroDivisionError("x")}, 3),
    ],
)
def test_status_of_a_check(folder, verdicts, said, status):
    """The result is told in full, whatever the status."""
    verdicts.update(said)
    result = run("check", "phong", "--junit", "x.xml", "-o", "x.txt")
    assert (result.exit_code, result.output) == (status, "")
    assert {path.name for path in folder.iterdir()} == {"x.xml", "x.txt"}
    text = (folder / "x.txt").read_text()
    assert text == run("check", "phong").stdout
    assert text.splitlines()[0].split() == ["model", "check", "verdict", "figure", "limit", "found"]
    assert len(text.splitlines()) == 1 + len(STUBS) + 2
    assert text.splitlines()[-1].split()[:2] == ["phong", {0: "PASS", 1: "FAIL", 3: "INCONCLUSIVE"}[status]]
    suites = ElementTree.parse(folder / "x.xml").getroot()
    assert [case.get("name") for case in suites.iter("testcase")] == STUBS
    assert int(suites.get("failures")) == sum(kind == "FAIL" for kind in said.values())


def test_json_of_a_check(verdicts):
    """The records of the Python call, with neither NaN nor infinity, of which JSON has none."""
    verdicts["energy"] = "FAIL"
    result = run("check", "phong", "lambert", "-p", "scale=1,2", "--json", "--skip", "quality")
    records = json.loads(result.stdout, parse_constant=pytest.fail)
    schema = json.loads((files("albedo_lab.report") / "check.schema.json").read_text(encoding="utf-8"))
    Draft202012Validator.check_schema(schema)
    Draft202012Validator(schema).validate(records)
    columns = ["model", "n", "albedo", *schema["items"]["required"][1:]]
    assert [list(record) for record in records] == [columns] * 28
    assert [record["check"] for record in records] == STUBS[:-1] * 4
    assert {record["figure"] for record in records} == {"inf"}
    frame = albedo_lab.check(["phong", "lambert"], skip=["quality"], scale=[1, 2])
    assert [record["verdict"] for record in records] == frame.verdict.tolist()
    assert list(frame.columns) == columns
    assert result.exit_code == 1


def test_the_whole_catalogue(verdicts):
    result = run("check", "--all", "--only", "energy", "-p", "scale=1")
    names = [name for name in catalogue.names() if name != "merl"]
    lines = [line.split() for line in result.stdout.splitlines()]
    assert [line[:3] for line in lines[1 : len(names) + 1]] == [[name, "scale=1", "energy"] for name in names]
    assert [line[:2] for line in lines[len(names) + 2 :]] == [[name, "PASS"] for name in names]


def test_the_help_names_every_check():
    from albedo_lab.analysis.check import CHECKS

    text = " ".join(run("check", "--help").stdout.split())
    assert ", ".join(CHECKS) in text


def test_nothing_is_written_when_the_run_breaks_off(folder, monkeypatch):
    def fails(*arguments, **options):
        raise KeyboardInterrupt

    monkeypatch.setattr("albedo_lab.analysis.check.run", fails)
    assert run("check", "phong", "--junit", "x.xml", "-o", "x.txt").exit_code == 130
    assert not any(folder.iterdir())


def test_colours_only_on_a_terminal():
    arguments = ["check", "lambert", "--only", "positivity"]
    plain = shell(*arguments)
    terminal, other_end = pty.openpty()
    environment = {name: value for name, value in os.environ.items() if name != "NO_COLOR"} | {"COLUMNS": "100"}
    seen = []
    for more in ({}, {"NO_COLOR": "1"}):
        assert shell(*arguments, stdout=other_end, env=environment | more).returncode == 0
        seen.append(os.read(terminal, 65536))
    os.close(other_end)
    os.close(terminal)
    assert b"\x1b[32mPASS" in seen[0]
    assert b"\x1b" not in seen[1] + plain.stdout
    assert max(map(len, seen[1].splitlines())) <= 100
    assert b" ".join(seen[1].split()) == b" ".join(plain.stdout.split())


def test_a_check_says_the_same_bytes():
    """Two processes, one and two threads."""
    arguments = ["check", "stretched_phong", "--only", "finiteness,sampler", "--budget", "1000000", "--json"]
    one, two = (shell(*arguments, "--threads", threads) for threads in "12")
    assert (one.returncode, one.stderr) == (0, b"")
    assert one.stdout == two.stdout


def test_status_of_the_process_of_a_check():
    """A sound and a sick model, nothing replaced."""
    sound, sick = (shell("check", "lambert", "-p", f"scale={scale}", "--only", "energy") for scale in ("1", "1.001"))
    assert (sound.returncode, sick.returncode) == (0, 1)
    assert b"witness: " in sick.stdout
    assert b"witness: " not in sound.stdout


def test_grazing():
    """neumann1999: the plain model is bounded, one divided by cos^2 diverges."""
    read = run("grazing", "product_phong", "-p", "n=1,20", "--format", "csv")
    frame = pd.read_csv(io.StringIO(read.stdout))
    assert list(frame.columns)[:6] == ["model", "n", "scale", "exponent", *FIGURES[:2]]
    assert frame.behaviour.tolist() == ["diverges"] * 2
    assert "bounded" in run("grazing", "stretched_phong").stdout
