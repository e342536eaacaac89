"""The disk cache of kernels hits in a new process and is never stale."""

import os
import subprocess
import sys
from pathlib import Path
from typing import NamedTuple

import pytest

from albedo_lab.kernels.jit import Placeholder, specialise

MODEL = """
from typing import NamedTuple
from callee import shape
from albedo_lab.model import Model, Parameter, Reference

class P(NamedTuple):
    k: float

def evaluate(p, wi, wo):
    return p.k * shape(wi)

MODEL = Model("mine", "k", P, (Parameter("k", "k", 1.0, 0.0, 1.0),), evaluate,
              Reference("me", "mine", 2026, "1"), scale=lambda p: 1.0)
"""
ASK = """
import sys
from mine import MODEL
from albedo_lab import albedo
from albedo_lab.kernels.quadrature import quadrature_kernel
print(albedo(MODEL, mu=0.5, method="quadrature").albedo[0])
print(sum(quadrature_kernel(MODEL).stats.cache_hits.values()))
"""


def ask(folder: Path) -> tuple[float, int]:
    """The albedo of the user's model and the number of cache hits, from a fresh process."""
    done = subprocess.run(
        [sys.executable, "-B", "-c", ASK],
        cwd=folder,
        env=os.environ | {"ALBEDO_LAB_CACHE": str(folder / "cache"), "PYTHONPATH": f"{folder}{os.pathsep}{Path.cwd()}"},
        capture_output=True,
        text=True,
        check=True,
    )
    value, hits = done.stdout.split()
    return float(value), int(hits)


def test_an_edit_in_a_callee_of_another_file_is_seen_and_an_unchanged_model_comes_from_disk(tmp_path: Path) -> None:
    (tmp_path / "mine.py").write_text(MODEL)
    callee = tmp_path / "callee.py"
    callee.write_text("def shape(w):\n    return 0.25\n")
    assert ask(tmp_path) == (pytest.approx(0.25 * 3.141592653589793), 0)
    assert ask(tmp_path) == (pytest.approx(0.25 * 3.141592653589793), 1)
    stamp = callee.stat()
    callee.write_text("def shape(w):\n    return 0.75\n")
    os.utime(callee, (stamp.st_atime, stamp.st_mtime))  # not even the time of the file tells
    assert ask(tmp_path) == (pytest.approx(0.75 * 3.141592653589793), 0)


def test_an_edit_of_a_constant_that_is_read_through_its_module_is_seen(tmp_path: Path) -> None:
    through = MODEL.replace("from callee import shape", "import callee").replace("shape(wi)", "callee.SHARE")
    (tmp_path / "mine.py").write_text(through)
    for share in (0.25, 0.75):
        (tmp_path / "callee.py").write_text(f"SHARE = {share}\n")
        assert ask(tmp_path) == (pytest.approx(share * 3.141592653589793), 0)
    assert ask(tmp_path) == (pytest.approx(0.75 * 3.141592653589793), 1)


DIGITS = """
from albedo_lab import albedo, mean_albedo
for options in ({"method": "quadrature", "tolerance": 1e-8}, {"tolerance": 1e-4}):
    table = albedo("ward", m=0.1, theta_deg=[0, 60, 89.995, 89.999], **options)
    print([x.hex() for name in ("albedo", "standard_error", "ci95_low") for x in table[name]])
print(mean_albedo("ward", m=0.1, tolerance=1e-4).mean_albedo[0].hex())
"""


def test_a_cold_and_a_warm_cache_give_the_same_bits(tmp_path: Path) -> None:
    """The process that compiles a kernel and the one that loads it must run the same code."""

    def digits() -> str:
        environment = os.environ | {"ALBEDO_LAB_CACHE": str(tmp_path)}
        return subprocess.run([sys.executable, "-c", DIGITS], env=environment, capture_output=True, text=True, check=True).stdout

    cold = digits()
    assert len(list(tmp_path.glob("kernel_*.py"))) == 3
    assert digits() == cold


number = Placeholder("number")


def twice(x):
    return 2.0 * number(x)


def one(x):
    return 1.0 + x


def two(x):
    return 2.0 + x


def test_the_same_template_serves_several_models_in_one_process() -> None:
    assert specialise(twice, number=one)(0.5) == 3.0
    assert specialise(twice, number=two)(0.5) == 5.0
    assert specialise(twice, number=one) is specialise(twice, number=one)


def test_an_unwritable_cache_costs_time_only(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    blocked = tmp_path / "file"
    blocked.write_text("no folder")
    monkeypatch.setenv("ALBEDO_LAB_CACHE", str(blocked))
    assert specialise(twice, number=lambda x: x - 1.0)(0.5) == -1.0


class Named(NamedTuple):
    """A field that bears the name of the function that reads it."""

    doubled: float


def doubled(p: Named) -> float:
    return 2.0 * p.doubled


answer = Placeholder("answer")


def ask_once(x: float) -> float:
    return answer(Named(x))  # type: ignore[no-any-return]


def test_a_field_that_bears_the_name_of_a_function_is_no_call() -> None:
    assert specialise(ask_once, answer=doubled)(3.0) == 6.0
