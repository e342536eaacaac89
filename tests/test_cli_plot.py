import pytest
from click.testing import CliRunner

from albedo_lab.catalogue import find
from albedo_lab.cli import PICTURES, main
from albedo_lab.errors import BadInput
from albedo_lab.pictures.base import Curve
from albedo_lab.pictures.kinds import KINDS, MOST, asked, curves


def run(*arguments):
    return CliRunner().invoke(main, ["plot", *map(str, arguments)])


@pytest.fixture
def folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    return tmp_path


def test_the_command_line_knows_every_kind():
    assert tuple(KINDS) == PICTURES


@pytest.mark.parametrize(("suffix", "start"), [("svg", b"<?xml"), ("png", b"\x89PNG"), ("PDF", b"%PDF")])
def test_the_suffix_says_the_format(folder, suffix, start):
    result = run("phong", "-p", "n=10,100", "-o", f"x.{suffix}")
    assert (result.exit_code, result.stdout, result.stderr) == (0, "", "")
    assert (folder / f"x.{suffix}").read_bytes().startswith(start)


@pytest.mark.parametrize(
    "options", [("--kind", "log-polar", "--theta-deg", "20,70"), ("--kind", "polar", "--quantity", "radiance")]
)
def test_the_same_bytes_again(folder, options):
    for name in ("a.svg", "b.svg"):
        assert run("stretched_phong", "-p", "n=10,100", *options, "-o", name).exit_code == 0
    assert (folder / "a.svg").read_bytes() == (folder / "b.svg").read_bytes()


def test_every_value_has_a_curve_with_its_name(folder):
    assert run("ward", "-p", "m=0.1,0.2", "--theta-deg", "20,70", "-o", "x.svg").exit_code == 0
    written = (folder / "x.svg").read_text(encoding="utf-8")  # matplotlib leaves every text in a comment
    for text in ("ward, m = 0.1", "ward, m = 0.2", "light at 20°", "light at 70°"):
        assert f"<!-- {text} -->" in written


def test_an_albedo_curve_and_its_way_to_grazing(folder):
    assert run("lambert", "-p", "albedo=0.5", "--kind", "albedo", "-o", "x.svg").exit_code == 0
    assert "cosine of the incident angle" in (folder / "x.svg").read_text(encoding="utf-8")


@pytest.mark.parametrize("kind", ["lobe", "slice", "preview", "sampling"])
def test_the_other_kinds(folder, kind):
    result = run("lambert", "--kind", kind, "-o", "x.png")
    assert (result.exit_code, result.stderr) == (0, "")
    assert (folder / "x.png").stat().st_size > 10_000


def test_labels_are_what_differs():
    model = find("microfacet")
    made = curves(model, {"D": ["ggx", "beckmann"], "alpha": [0.1, 0.25], "G": ["smith"]})
    assert [curve.label for curve in made] == [
        "microfacet, D = ggx, alpha = 0.1",
        "microfacet, D = ggx, alpha = 0.25",
        "microfacet, D = beckmann, alpha = 0.1",
        "microfacet, D = beckmann, alpha = 0.25",
    ]
    assert made[3].parameters == {"D": "beckmann", "alpha": 0.25, "G": "smith"}
    assert curves(model, {}) == (Curve("microfacet", model, {}),)


@pytest.mark.parametrize(
    ("options", "said"),
    [
        (["-o", "x.jpg"], ["output", "x.jpg", ".svg, .png or .pdf"]),
        (["-o", "-"], ["output = '-'"]),
        (["-o", "missing/x.svg"], ["output", "No such file"]),
        ([], ["--output"]),
        (["--kind", "pie", "-o", "x.svg"], ["--kind", "pie", "log-polar"]),
        (["--theta-deg", "90", "-o", "x.svg"], ["theta_deg = 90.0", "[0, 90) degrees"]),
        (["--kind", "lobe", "--theta-deg", "steep", "-o", "x.svg"], ["theta_deg = 'steep'", "[0, 90) degrees"]),
        (["--kind", "albedo", "--theta-deg", "3", "-o", "x.svg"], ["theta_deg", "kind albedo"]),
        (["--kind", "lobe", "--quantity", "radiance", "-o", "x.svg"], ["quantity", "kind lobe"]),
        (["--seed", "1", "-o", "x.svg"], ["seed = 1", "kind polar"]),
        (["--kind", "sampling", "--seed", "x", "-o", "x.svg"], ["seed = 'x'", "[0, 2^64)"]),
        (["--threads", "0", "-o", "x.svg"], ["threads = 0", "[1, 1024]"]),
        (["-p", "q=1", "-o", "x.svg"], ["q = 1.0", "it takes n, scale"]),
        (["-p", "n=1,-1", "-o", "x.svg"], ["n = -1.0", "[0, 1e+08]"]),
        (["-p", "n=1,1", "-o", "x.svg"], ["parameter", "twice"]),
        (["-p", "n=" + ",".join(map(str, range(MOST + 1))), "-o", "x.svg"], ["parameter", "25", "at most 24"]),
    ],
)
def test_bad_usage(folder, options, said):
    result = run("phong", *options)
    assert result.exit_code == 2
    assert result.stdout == ""
    assert result.stderr.startswith("albedo-lab: ")
    assert result.stderr.count("\n") == 1
    assert all(part in result.stderr for part in said), result.stderr
    assert not any(folder.iterdir())


def test_no_option_goes_unheard():
    with pytest.raises(BadInput, match="colour = 'red': is nothing that a picture of the kind slice knows"):
        asked("slice", "lambert", {}, colour="red")
