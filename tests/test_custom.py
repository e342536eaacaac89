"""Models of one's own: what is accepted, that nothing of it is stale, and that whatever is wrong with it is told in one line."""

import math
import os
import re
import subprocess
import sys
from importlib.metadata import EntryPoint, EntryPoints

import numpy as np
import pytest
from click.testing import CliRunner

from albedo_lab import catalogue
from albedo_lab.analysis.albedo import albedo
from albedo_lab.analysis.mean_albedo import mean_albedo
from albedo_lab.catalogue import find
from albedo_lab.cli import main
from albedo_lab.custom.pairs import pairs, symmetric, tolerant
from albedo_lab.errors import BadInput
from albedo_lab.optics.frame import dot

GREY = '''"""A grey of my own."""
from math import pi
import math
from typing import NamedTuple

from albedo_lab.optics.frame import Direction


def grey(wi, wo, alpha=0.3):
    return alpha / pi


class P(NamedTuple):
    alpha: float = 0.25


def named(p: P, wi, wo):
    return p.alpha / pi


def steep(wi, wo, strength=1, n=20):
    """A number that Python refuses and compiled code does not: 1 / 0 at the normal."""
    return strength * math.sqrt(abs(wi.x * wo.x)) / wi.x if wi.x < 0 else math.sqrt(wi.x - 0.1)
'''
SAMPLED = '''"""A model with a sampler."""
from math import pi, sqrt
from typing import NamedTuple

from albedo_lab import Model, Parameter, Reference
from albedo_lab.optics.frame import Direction
from albedo_lab.optics.maths import sincos2pi

class P(NamedTuple):
    rho: float

def evaluate(p, wi, wo):
    return p.rho / pi

def sample(p, wo, u1, u2):
    s, c = sincos2pi(u2)
    r = sqrt(u1)
    return Direction(r * c, r * s, sqrt(1.0 - u1))

def pdf(p, wi, wo):
    return wi.z / pi

MINE = Model("grey", "rho / pi", P, (Parameter("rho", "reflectance", 0.5, 0.0, 1.0),), evaluate,
             Reference("me", "notes", 2024, "eq. 1"), sample=sample, pdf=pdf, scale=lambda p: 1.0)
'''


def run(*arguments):
    return CliRunner().invoke(main, [str(argument) for argument in arguments])


def shell(*arguments):
    path = os.pathsep.join([os.path.dirname(os.path.dirname(catalogue.__file__)), os.environ.get("PYTHONPATH", "")])
    done = subprocess.run(
        [sys.executable, "-m", "albedo_lab", *arguments],
        check=False,
        timeout=100,
        capture_output=True,
        text=True,
        env=os.environ | {"PYTHONPATH": path},
    )
    assert done.returncode == 0, done.stderr
    return done.stdout


def csv_value(text, column):
    head, row = (line.split(",") for line in text.split())
    return float(row[head.index(column)])


@pytest.fixture
def folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    before = set(sys.modules)
    yield tmp_path
    for name in set(sys.modules) - before:
        if str(getattr(sys.modules[name], "__file__", "")).startswith(str(tmp_path)):
            del sys.modules[name]


@pytest.fixture
def grey(folder):
    (folder / "brdf.py").write_text(GREY)
    return folder


ASKED = [
    ("brdf.py:grey", 0.3, "rqmc"),
    ("brdf.py:grey", 0.3, "mc"),
    ("brdf:grey", 0.3, "quadrature"),
    ("./brdf.py:named", 0.25, "rqmc"),
]


@pytest.mark.parametrize(("spec", "share", "method"), ASKED)
def test_a_grey_reflects_its_share(grey, spec, share, method):
    """The cosine cancels against cosine sampling: every weight is alpha."""
    found = albedo(spec, mu=0.5, method=method, tolerance=1e-4)
    assert found.albedo[0] == pytest.approx(share, abs=1e-4)
    assert found.model[0] == spec
    assert found.alpha[0] == share


def test_the_command_line_asks_every_question(grey):
    for command in (["albedo", "--theta-deg", "60"], ["mean-albedo"]):
        for method in ("rqmc", "quadrature"):
            if command == ["mean-albedo"] and method == "quadrature":
                continue
            result = run(
                *command, "brdf.py:grey", "-p", "alpha=0.2", "--tolerance", "1e-4", "--method", method, "--format", "csv"
            )
            assert result.exit_code == 0, result.output
            quantity = command[0].replace("-", "_")
            assert csv_value(result.stdout, quantity) == pytest.approx(0.2, abs=1e-4)
    result = run("normalise", "brdf.py:grey", "-p", "alpha=0.2", "--format", "csv")
    assert csv_value(result.stdout, "constant") == pytest.approx(5.0, rel=1e-6)
    several = run("albedo", "brdf.py:grey", "-p", "alpha=0.1,0.2", "--theta-deg", "0", "--tolerance", "1e-3", "--format", "csv")
    assert len(several.stdout.splitlines()) == 3


def test_show_tells_file_function_and_parameters(grey):
    result = run("show", "brdf.py:grey")
    assert result.exit_code == 0
    for part in ("brdf.py:grey", "A grey of my own.", "grey(wi, wo)", "function grey", "alpha", "default 0.3"):
        assert part in result.stdout


def test_a_parameter_outside_its_domain_is_refused_as_any(grey):
    for assignment, said in (("alpha=nan", "alpha = nan"), ("beta=1", "it takes alpha, scale"), ("alpha=inf", "alpha = inf")):
        result = run("albedo", "brdf.py:grey", "-p", assignment)
        assert (result.exit_code, result.stderr.count("\n")) == (2, 1)
        assert said in result.stderr


def test_a_model_with_a_sampler(folder):
    (folder / "own.py").write_text(SAMPLED)
    model = find("own.py:MINE")
    assert model.name == "own.py:MINE"
    assert model.summary == "A model with a sampler."
    assert model.sample is not None
    assert mean_albedo("own.py:MINE", rho=0.7, tolerance=1e-4).mean_albedo[0] == pytest.approx(0.7, abs=1e-4)


def test_the_same_file_gives_the_same_object(grey):
    """Kernels and suprema are kept by the model's identity."""
    assert find("brdf.py:grey") is find("brdf.py:grey")
    assert find("brdf:grey") is find("brdf:grey")


def test_two_files_with_one_function_name(folder):
    for name, share in (("a", 0.1), ("b", 0.9)):
        (folder / name).mkdir()
        (folder / name / "brdf.py").write_text("import part\ndef f(wi, wo):\n    return part.SHARE * 0.3183098861837907\n")
        (folder / name / "part.py").write_text(f"SHARE = {share}\n")
    first, second = find("a/brdf.py:f"), find("b/brdf.py:f")
    assert "part" not in sys.modules
    for model, share in ((first, 0.1), (second, 0.9)):
        assert albedo(model, mu=1.0, tolerance=1e-3).albedo[0] == pytest.approx(share, abs=1e-3)


def test_sibling_files_can_be_imported_and_nothing_is_left_behind(folder):
    (folder / "away").mkdir()
    (folder / "away" / "brdf.py").write_text("from part import half\ndef f(wi, wo):\n    return half() / 3.141592653589793\n")
    (folder / "away" / "part.py").write_text("def half():\n    return 0.5\n")
    path, modules = list(sys.path), set(sys.modules)
    assert albedo("away/brdf.py:f", mu=1.0, tolerance=1e-3).albedo[0] == pytest.approx(0.5, abs=1e-3)
    assert sys.path == path
    assert "part" not in set(sys.modules) - modules
    assert not list(folder.rglob("__pycache__"))


@pytest.mark.parametrize("spec", ["brdf.py:f", "brdf:f"])
@pytest.mark.parametrize("edited", ["brdf.py", "part.py"])
def test_an_edited_file_is_loaded_anew(folder, spec, edited):
    """Edits of the same length, within the same second: neither byte code nor a compiled kernel may be that of before."""
    texts = {
        "brdf.py": "import part\nONE = 1.0\ndef f(wi, wo):\n    return ONE * part.SHARE * 0.3183098861837907\n",
        "part.py": "SHARE = 1.0\n",
    }
    for name, text in texts.items():
        (folder / name).write_text(text)
    before = find(spec)
    assert albedo(spec, mu=1.0, tolerance=1e-3).albedo[0] == pytest.approx(1.0, abs=1e-3)
    (folder / edited).write_text(texts[edited].replace("1.0", "0.5"))
    assert find(spec) is not before
    assert albedo(spec, mu=1.0, tolerance=1e-3).albedo[0] == pytest.approx(0.5, abs=1e-3)


@pytest.mark.parametrize("spec", ["brdf.py:f", "brdf:f"])
def test_an_edited_file_is_compiled_anew_in_another_process(folder, spec):
    ask = ("albedo", spec, "--theta-deg", "0", "--tolerance", "1e-3", "--format", "csv")
    for share in (0.25, 0.75):
        (folder / "brdf.py").write_text("import part\ndef f(wi, wo):\n    return part.SHARE * 0.3183098861837907\n")
        (folder / "part.py").write_text(f"SHARE = {share}\n")
        assert csv_value(shell(*ask), "albedo") == pytest.approx(share, abs=1e-3)


def test_compiled_code_is_found_again_wherever_the_file_is(folder):
    """Compiled code on disk names the modules that it was made from, which another process may not have."""
    (folder / "away").mkdir()
    for place in (folder, folder / "away"):
        (place / "brdf.py").write_text("from part import half\ndef f(wi, wo):\n    return half() * 0.3183098861837907\n")
        (place / "part.py").write_text("def half():\n    return 0.5\n")
    for spec in ("brdf.py:f", "away/brdf.py:f", "brdf:f"):
        told = shell("albedo", spec, "--theta-deg", "0", "--tolerance", "1e-3", "--format", "csv")
        assert csv_value(told, "albedo") == pytest.approx(0.5, abs=1e-3)


def test_a_file_beside_is_meant_before_one_of_the_same_name_elsewhere(folder):
    (folder / "away").mkdir()
    for place, share in ((folder, 0.2), (folder / "away", 0.8)):
        (place / "brdf.py").write_text("import part\ndef f(wi, wo):\n    return part.SHARE\n")
        (place / "part.py").write_text(f"SHARE = {share}\n")
    assert find("brdf:f").evaluate((), None, None) == 0.2
    imported = sys.modules["part"]
    assert find("away/brdf.py:f").evaluate((), None, None) == 0.8
    assert sys.modules["part"] is imported
    os.chdir("away")
    assert find("brdf:f").evaluate((), None, None) == 0.8


def test_what_the_file_prints_is_no_part_of_the_answer(folder):
    (folder / "loud.py").write_text("print('hello')\ndef f(wi, wo):\n    return 0.1\n")
    assert "hello" not in shell("albedo", "loud.py:f", "--theta-deg", "0", "--tolerance", "1e-2", "--format", "csv")


class TestOffered:
    """Entry points of other packages."""

    @pytest.fixture
    def package(self, grey, monkeypatch):
        entries = [EntryPoint("their_grey", "brdf:grey", catalogue.GROUP), EntryPoint("ward", "nowhere:f", catalogue.GROUP)]
        entries.append(EntryPoint("broken", "nowhere:f", catalogue.GROUP))
        monkeypatch.setattr(catalogue, "entry_points", lambda group: EntryPoints(entries).select(group=group))
        return grey

    def test_a_name_is_found(self, package):
        assert albedo("their_grey", mu=1.0, tolerance=1e-3).albedo[0] == pytest.approx(0.3, abs=1e-3)
        assert find("their_grey").name == "their_grey"

    def test_the_catalogue_comes_first(self, package):
        assert find("ward").evaluate.__module__ == "albedo_lab.models.ward"
        assert list(catalogue.offered()) == ["broken", "their_grey"]

    def test_one_that_cannot_be_loaded_is_told(self, package):
        result = run("show", "broken")
        assert (result.exit_code, result.stderr.count("\n")) == (2, 1)
        assert "no module 'nowhere'" in result.stderr

    def test_the_list_shows_them(self, package):
        assert "offered by brdf:grey" in run("list").stdout

    def test_its_name_is_proposed(self, package):
        with pytest.raises(BadInput, match="did you mean their_grey"):
            find("their_gray")


BROKEN = {
    "exc": ("def exc(wi, wo):\n    return wi.foo", ["AttributeError", "(line 2)"]),
    "own": ("def own(wi, wo):\n    raise ValueError('two\\nlines')", ["ValueError: two lines", "(line 2)"]),
    "none": ("def none(wi, wo):\n    pass", ["returns None"]),
    "tup": ("def tup(wi, wo):\n    return 1.0, 2.0", ["type tuple"]),
    "cpx": ("def cpx(wi, wo):\n    return 1j", ["type complex"]),
    "txt": ("def txt(wi, wo):\n    return 'x'", ["type str"]),
    "arr": ("def arr(wi, wo):\n    return np.array([wi.x])", ["type ndarray"]),
    "boo": ("def boo(wi, wo):\n    return wi.z > 0", ["type bool"]),
    "nan": ("def nan(wi, wo):\n    return math.nan", ["NaN for every one of the 54 pairs"]),
    "domain": ("def domain(wi, wo):\n    return math.sqrt(-wi.z)", ["NaN for every one"]),
    "few": ("def few(wi):\n    return 1.0", ["takes (wi)", "f(wi, wo)"]),
    "bare": ("def bare(p, wi, wo):\n    return 1.0", ["takes (p, wi, wo)", "NamedTuple"]),
    "star": ("def star(*wi):\n    return 1.0", ["takes (*wi)"]),
    "key": ("def key(wi, wo, *, a=1.0):\n    return a", ["takes (wi, wo, *, a=1.0)"]),
    "word": ("def word(wi, wo, a='x'):\n    return 1.0", ["a='x'", "finite number"]),
    "endless": ("def endless(wi, wo, a=math.inf):\n    return 1.0", ["a=inf", "finite number"]),
    "taken": ("def taken(wi, wo, mu=1.0):\n    return mu", ["mu=1.0", "another name"]),
    "hidden": ("def hidden(wi, wo, _a=1.0):\n    return _a", ["_a=1.0", "another name"]),
    "late": ("def late(wi, wo):\n    assert wi.z < 2\n    return 1.0", ["must not raise or assert (line 2)"]),
    "inner": ("def g():\n    raise KeyError\ndef inner(wi, wo):\n    return g() if wi.z > 2 else 1.0", ["(line 2)", "math.nan"]),
    "glob": ("D = {'a': 1.0}\ndef glob(wi, wo):\n    return D['a']", ["cannot be compiled", "'D'", "(line 3)"]),
    "sometimes": ("def sometimes(wi, wo):\n    return 1.0 if wi.z < 2 else None", ["cannot be compiled", "another thing"]),
    "itself": ("def itself(wi, wo):\n    return itself(wi, wo) if wi.z > 2 else 1.0", ["calls itself"]),
    "text": ("text = 'x'", ["type str, neither"]),
    "cls": ("class cls:\n    pass", ["type type, neither"]),
    "method": ("class K:\n    def f(self, wi, wo):\n        return 1.0\nmethod = K().f", ["type method, neither"]),
    "absent": ("def absence(wi, wo):\n    return 1.0", ["no 'absent'", "did you mean absence?"]),
    "syntax": ("def syntax(:\n    pass", ["SyntaxError", "line 1"]),
    "nul": ("\0", ["bad.py"]),
    "imports": ("import nowhere_at_all", ["ModuleNotFoundError", "nowhere_at_all"]),
    "zero": ("x = 1\n1 / 0", ["ZeroDivisionError", "(line 2)"]),
    "leaves": ("raise SystemExit(3)", ["SystemExit: 3"]),
}


@pytest.mark.parametrize("name", BROKEN)
def test_what_is_wrong_is_told_in_one_line(folder, name):
    text, said = BROKEN[name]
    preamble = "" if name in ("syntax", "nul") else "import math; import numpy as np; "
    # on the line of the first statement, so that the lines are those above; a compound statement wants a line of its own
    separator = "\n" if text.startswith(("def", "class")) and preamble else ""
    (folder / "bad.py").write_text(f"{preamble}{separator}{text}\n")
    shift = 1 if separator else 0
    path, modules = list(sys.path), {other for other in sys.modules if not other.startswith("albedo_lab")}
    result = run("albedo", f"bad.py:{name}", "--theta-deg", "0")
    assert result.exit_code == 2, result.output
    assert result.stdout == ""
    assert result.stderr.count("\n") == 1
    assert result.stderr.startswith(f"albedo-lab: model = 'bad.py:{name}': ")
    for part in ("bad.py", *said):
        assert re.sub(r"(?<=\(line )\d+", lambda line: str(int(line[0]) + shift), part) in result.stderr
    assert sys.path == path
    assert "bad" not in set(sys.modules) - modules


@pytest.mark.parametrize(
    ("spec", "said"),
    [
        ("missing.py:f", "cannot read missing.py (No such file or directory)"),
        ("./:f", "Is a directory"),
        ("missing.module:f", "no module 'missing'"),
        ("brdf.missing:f", "no module 'brdf.missing'"),
        ("math:sin", "math is not a module that is written in Python"),
        ("brdf.py", "must be file.py:NAME"),
        ("brdf.py:", "must be file.py:NAME"),
        (":f", "must be file.py:NAME"),
        ("brdf.py:1+1", "must be file.py:NAME"),
        ("a b:f", "neither a file .py nor the name of a module"),
        ("brdf.py:math.pi", "of type float"),
    ],
)
def test_a_place_where_nothing_is(grey, spec, said):
    result = run("show", spec)
    assert (result.exit_code, result.stdout, result.stderr.count("\n")) == (2, "", 1)
    assert said in result.stderr


MODELS = {
    "sample": ("return (0.0, 0.0, 1.0)", "    s, c = sincos2pi(u2)", "returns tuple"),
    "pdf": ("return wi.q", "    return wi.z / pi", "AttributeError"),
    "evaluate": ("return None", "    return p.rho / pi", "returns None"),
}


@pytest.mark.parametrize("part", MODELS)
def test_the_function_of_a_model_that_is_wrong_is_named(folder, part):
    new, old, said = MODELS[part]
    (folder / "own.py").write_text(SAMPLED.replace(old, f"    {new}"))
    with pytest.raises(BadInput, match=rf"{part} of MINE in own.py .*{said}"):
        find("own.py:MINE")


def test_a_model_with_only_half_a_sampler_is_refused(folder):
    (folder / "own.py").write_text(SAMPLED.replace("pdf=pdf, ", ""))
    with pytest.raises(BadInput, match="only one of sample and pdf"):
        find("own.py:MINE")


def test_numbers_that_python_refuses_are_those_of_compiled_code(grey):
    """1 / 0 and sqrt(-1) are no exceptions of the user's."""
    assert find("brdf.py:steep").isotropic(find("brdf.py:steep").bind({})) is False
    assert math.isnan(tolerant(lambda: 1.0 / 0.0))
    assert math.isnan(tolerant(lambda: math.sqrt(-1.0)))
    with np.errstate(all="raise"):
        assert math.isinf(tolerant(lambda: np.float64(1.0) / np.float64(0.0)))
    with pytest.raises(ValueError, match="mine"):
        tolerant(raising)


def raising():
    raise ValueError("mine")


@pytest.mark.parametrize(
    ("evaluate", "expected"),
    [
        (lambda p, wi, wo: 1.0, True),
        (lambda p, wi, wo: wi.z * dot(wi, wo), True),
        (lambda p, wi, wo: math.exp(-1e6 * ((wi.x + wo.x) ** 2 + (wi.y + wo.y) ** 2)), True),
        (lambda p, wi, wo: math.exp(-1e5 * ((wi.x + wo.x) ** 2 + 2.0 * (wi.y + wo.y) ** 2)), False),
        (lambda p, wi, wo: 1.0 + 1e-4 * wi.x, False),
        (lambda p, wi, wo: float(wi.x * wo.y > wi.y * wo.x), False),
        (lambda p, wi, wo: math.nan if wi.x > 0 else 1.0, False),
    ],
)
def test_turning_and_reflecting_tell_an_anisotropic_function(evaluate, expected):
    """One that tells left from right counts among them: quadrature takes half of the azimuths of a symmetric one."""
    assert symmetric(evaluate, None) is expected


def test_an_anisotropic_function_is_integrated_over_every_azimuth(folder):
    """1/pi where the light is to the left of the viewer, 0 to the right: half of it comes back, and neither twice nor nothing."""
    (folder / "half.py").write_text(
        "from math import pi\ndef f(wi, wo):\n    return 1 / pi if wi.x * wo.y > wi.y * wo.x else 0.0\n"
    )
    found = albedo("half.py:f", mu=0.5, phi_deg=[0, 77], method="rqmc", tolerance=1e-3)
    assert found.albedo.to_numpy() == pytest.approx([0.5, 0.5], abs=1e-3)
    assert list(found.phi_deg) == [0.0, 77.0]


def test_the_pairs_are_unit_vectors_above_the_horizon():
    for w in (w for pair in pairs() for w in pair):
        assert dot(w, w) == pytest.approx(1.0, abs=1e-15)
        assert w.z > 0.0
