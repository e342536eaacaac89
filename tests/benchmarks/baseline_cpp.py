"""The plain C++ loop of baseline.cpp, compiled on the spot with whatever compiler is found."""

from __future__ import annotations

import ctypes
import os
import shutil
import subprocess
import tempfile
from functools import cache
from pathlib import Path

import numpy as np

from tests.benchmarks.moments import Moments

PLAIN = ("-O3",)
NATIVE = ("-O3", "-march=native")
FAST = ("-Ofast", "-march=native")
"""Not the same arithmetic any more: it may reorder sums, drop NaN, and take log and cos from a vector library."""


def compiler() -> str | None:
    """The C++ compiler: $CXX, or the first of c++, g++, clang++ that is installed."""
    candidates = (os.environ.get("CXX", ""), "c++", "g++", "clang++")
    return next((found for name in candidates if name and (found := shutil.which(name))), None)


def compiler_version() -> str:
    """The first line of what the compiler says of itself, without where it lies."""
    found = compiler()
    if found is None:
        return "none"
    said = subprocess.run([found, "--version"], capture_output=True, text=True, check=True).stdout
    return said.partition("\n")[0]


@cache
def library(flags: tuple[str, ...]) -> ctypes.CDLL:
    """baseline.cpp as a shared library; it stays loaded when its file is gone."""
    found = compiler()
    if found is None:
        raise RuntimeError("no C++ compiler; ask compiler() first")
    source = Path(__file__).with_name("baseline.cpp")
    with tempfile.TemporaryDirectory() as folder:
        target = Path(folder) / "baseline.so"
        command = [found, "-std=c++17", *flags, "-shared", "-fPIC", str(source), "-o", str(target)]
        subprocess.run(command, check=True)
        loaded = ctypes.CDLL(str(target))
    for name in ("stretched_phong", "ward"):
        function = getattr(loaded, name)
        function.restype = None
        function.argtypes = [
            ctypes.c_double,
            ctypes.c_int,
            ctypes.c_int,
            ctypes.c_uint64,
            ctypes.c_int64,
            ctypes.c_double,
            np.ctypeslib.ndpointer(np.float64, shape=(2,), flags="C_CONTIGUOUS"),
        ]
    return loaded


def estimate(
    model: str,
    parameter: float,
    mu: float,
    samples: int,
    seed: int,
    flags: tuple[str, ...] = PLAIN,
    fast_random: bool = True,
    reduced: bool = False,
) -> Moments:
    """The albedo of the shape by `samples` samples: xoshiro256+ (fast_random) or std::mt19937_64."""
    out = np.zeros(2)
    getattr(library(flags), model)(parameter, reduced, fast_random, seed, samples, mu, out)
    return Moments(samples, out[0], out[1])
