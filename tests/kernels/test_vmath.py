"""The vector maths against mpmath, in units of the last place (ulp) of the exact result, and at the borders."""

from __future__ import annotations

import math
import platform
import re
from collections.abc import Callable
from functools import cache
from pathlib import Path
from types import ModuleType
from typing import Any, NamedTuple

import llvmlite.binding
import mpmath
import numpy as np
import pytest
from mpmath import mpf
from numba import njit
from numpy.typing import NDArray

from albedo_lab.kernels import vmath
from tests.kernels import vmath_coefficients

Array = NDArray[np.float64]
Exact = Callable[..., mpf]

DIGITS = 40
COUNT = 1000
NAN, INF = math.nan, math.inf
LARGEST, SMALLEST_NORMAL, SMALLEST = 1.7976931348623157e308, 2.2250738585072014e-308, 5e-324
SOURCE = Path(vmath.__file__).read_text()


class Claim(NamedTuple):
    """One row of the module's table: the largest error measured, which may not be exceeded, and the error wanted."""

    exact: Exact
    arguments: dict[str, tuple[Array, ...]]
    measured: float
    bound: float


def sine(u: mpf) -> mpf:
    """sin(2πu), exactly 0 where it is."""
    return mpmath.sinpi(2 * u)


def cosine(u: mpf) -> mpf:
    """cos(2πu), exactly 0 where it is."""
    return mpmath.cospi(2 * u)


def power(x: mpf, y: mpf) -> mpf:
    """x^y, with digits to spare: the logarithm of 1 + 1e-16 loses 16 of them."""
    with mpmath.workdps(2 * DIGITS):
        return mpmath.exp(y * mpmath.log(x))


def claims() -> dict[str, Claim]:
    """Every function with points from all over its range, dense where it is delicate."""
    rng = np.random.default_rng(20)

    def uniform(low: float, high: float) -> Array:
        return rng.uniform(low, high, COUNT)

    def decades(low: float, high: float) -> Array:
        return 10.0 ** uniform(low, high)

    def signed(x: Array) -> Array:
        return x * rng.choice([-1.0, 1.0], COUNT)

    def powers(x: Array, low: float, high: float) -> tuple[Array, Array]:
        x = x[x != 1.0]
        return x, rng.uniform(low, high, x.size) / np.log(x)

    around_one = 1.0 + signed(decades(-15.5, -1))
    turns = {
        "a turn": (uniform(-1, 1),),
        "2^20 turns": (uniform(-(2.0**20), 2.0**20),),
        "2^48 turns": (uniform(-(2.0**48), 2.0**48),),
        "close to the zeros": (np.rint(uniform(-4000, 4000)) / 4 + signed(decades(-19, -1)),),
        "small": (signed(decades(-300, -1)),),
        "eighths": (np.arange(-64.0, 65.0) / 8,),
    }
    return {
        "exp": Claim(
            mpmath.exp,
            {
                "all": (uniform(-708, 709.78),),
                "around 0": (signed(decades(-20, 0)),),
                "between integers n": (np.log(2.0) * (np.arange(-1020, 1023) + 0.5),),
                "subnormal results": (uniform(-745.13, -708),),
                "largest results": (uniform(709, 709.782712893384),),
            },
            measured=1.01,
            bound=2.0,
        ),
        "expm1": Claim(
            mpmath.expm1,
            {
                "all": (uniform(-45, 709.78),),
                "around 0": (signed(decades(-307, 0)),),
                "worst": (uniform(0.34, 0.45),),
                "around -1": (uniform(-1.5, 0),),
                "largest results": (uniform(709, 709.782712893384),),
                "subnormal": (signed(decades(-323, -308)),),
            },
            measured=1.80,
            bound=2.0,
        ),
        "log": Claim(
            mpmath.log,
            {
                "all": (decades(-307, 308),),
                "around 1": (around_one,),
                "where n changes": (np.concatenate([uniform(0.70, 0.72), uniform(1.40, 1.43)]),),
                "subnormal": (decades(-323, -308),),
                "ends": (np.array([SMALLEST, 2 * SMALLEST, SMALLEST_NORMAL, LARGEST, 1.0]),),
            },
            measured=0.85,
            bound=2.0,
        ),
        "log1p": Claim(
            mpmath.log1p,
            {
                "all": (decades(-307, 308),),
                "negative": (-decades(-307, 0),),
                "close to -1": (-1.0 + decades(-15.9, -1),),
                "around 0": (uniform(-0.5, 1.5),),
                "worst": (uniform(0.41, 0.48),),
                "where it becomes log": (decades(14, 17),),
                "subnormal": (signed(decades(-323, -308)),),
                "ends": (np.array([LARGEST, np.nextafter(-1.0, 0.0)]),),
            },
            measured=1.40,
            bound=2.0,
        ),
        "pow": Claim(
            power,
            {
                "all": powers(decades(-307, 308), -708, 709.7),
                "around 1": powers(around_one, -708, 709.7),
                "hardest, below": powers(uniform(0.70711, 0.71), 500, 709.7),
                "hardest, above": powers(uniform(1.41, 1.43), -708, -500),
                "lobes": (uniform(0, 1), decades(-3, 2.5)),
                "subnormal bases": powers(decades(-323, -308), -708, 709.7),
                "subnormal results": powers(decades(-300, 300), -745, -708),
            },
            measured=1.46,
            bound=2.0,
        ),
        "sine": Claim(sine, turns, measured=1.47, bound=2.0),
        "cosine": Claim(cosine, turns, measured=1.47, bound=2.0),
    }


CLAIMS = claims()
CASES = [pytest.param(name, where, id=f"{name}, {where}") for name, claim in CLAIMS.items() for where in claim.arguments]


def scalar(module: ModuleType, name: str) -> Callable[..., float]:
    """The function of that name with one result; sine and cosine are the halves of sincos2pi."""
    if name not in ("sine", "cosine"):
        return getattr(module, name)  # type: ignore[no-any-return]
    pair, index = module.sincos2pi, ("sine", "cosine").index(name)

    @njit(**vmath.INLINE)
    def half(u):
        return pair(u)[index]

    return half


@cache
def loop(module: ModuleType, name: str) -> Callable[..., None]:
    """A compiled loop that fills its last argument with the function of the others."""
    function = scalar(module, name)
    if name == "pow":

        @njit(error_model="numpy")
        def fill(x, y, out):
            for i in range(out.size):
                out[i] = function(x[i], y[i])
    else:

        @njit(error_model="numpy")
        def fill(x, out):
            for i in range(out.size):
                out[i] = function(x[i])

    return fill


def values(name: str, *arguments: Any, module: ModuleType = vmath) -> Array:
    """The function at every one of its arguments."""
    columns = [np.ascontiguousarray(a, dtype=np.float64) for a in arguments]
    out = np.empty_like(columns[0])
    loop(module, name)(*columns, out)
    return out


def ulps(got: float, exact: mpf) -> float:
    """The error of `got` in units of the last place of the exact value."""
    if not math.isfinite(got):
        return INF
    if exact == 0:
        return 0.0 if got == 0 else INF
    unit = max(mpmath.frexp(exact)[1] - 53, -1074)
    return float(mpmath.ldexp(abs(mpf(got) - exact), -unit))


def worst(name: str, *arguments: Array, module: ModuleType = vmath) -> float:
    """The largest error of a function at its arguments, in ulp."""
    exact = CLAIMS[name].exact
    with mpmath.workdps(DIGITS):
        points = zip(values(name, *arguments, module=module), *arguments, strict=True)
        return max(ulps(float(got), exact(*(mpf(float(a)) for a in x))) for got, *x in points)


def changed(old: str, new: str) -> ModuleType:
    """The module with one piece of its text replaced."""
    assert SOURCE.count(old) == 1
    module = ModuleType("vmath_changed")
    exec(compile(SOURCE.replace(old, new), module.__name__, "exec"), module.__dict__)
    return module


@pytest.mark.parametrize(("name", "where"), CASES)
def test_error_is_within_its_bound(name, where):
    claim = CLAIMS[name]
    assert worst(name, *claim.arguments[where]) <= claim.measured <= claim.bound


@pytest.mark.parametrize("name", ["sine", "cosine"])
def test_absolute_error_of_sine_and_cosine(name):
    u = CLAIMS[name].arguments["2^20 turns"][0]
    with mpmath.workdps(DIGITS):
        error = max(abs(mpf(float(v)) - CLAIMS[name].exact(mpf(float(x)))) for v, x in zip(values(name, u), u, strict=True))
    assert error <= 1.7e-16


@pytest.mark.parametrize(
    ("name", "where", "coefficient"),
    [
        ("exp", "all", "0.1666666666666667"),
        ("expm1", "worst", "0.1666666666666667"),
        ("pow", "hardest, below", "0.28571428571429364"),
        ("sine", "a turn", "-41.341702240399755"),
        ("cosine", "a turn", "64.93939402266824"),
    ],
)
def test_control_a_coefficient_wrong_by_1e_12_is_noticed(name, where, coefficient):
    module = changed(coefficient, f"({coefficient} * (1 + 1e-12))")
    assert worst(name, *CLAIMS[name].arguments[where], module=module) > CLAIMS[name].bound


def test_control_low_parts_are_needed():
    module = changed("LN2_LOW = 1.9082149292705877e-10", "LN2_LOW = 1.908214e-10")
    assert worst("pow", *CLAIMS["pow"].arguments["all"], module=module) > CLAIMS["pow"].bound


@pytest.mark.parametrize(
    ("name", "x", "expected"),
    [
        ("exp", [-INF, -1e300, -746.0, -745.13, 0.0, LARGEST, 709.7827128933841, 1000.0, INF], None),
        ("expm1", [-INF, -1e300, -40.0, 0.0, 709.7827128933841, LARGEST, INF], None),
        ("log", [-INF, -1.0, -SMALLEST, 0.0, -0.0, 1.0, INF], [NAN, NAN, NAN, -INF, -INF, 0.0, INF]),
        ("log1p", [-INF, -2.0, -1.0000000000000002, -1.0, 0.0, INF], [NAN, NAN, NAN, -INF, 0.0, INF]),
        ("sine", [-INF, INF], [NAN, NAN]),
        ("cosine", [-INF, INF], [NAN, NAN]),
    ],
)
def test_borders(name, x, expected):
    if expected is None:
        with np.errstate(all="ignore"):
            expected = getattr(np, name)(x)
    np.testing.assert_array_equal(values(name, x), expected)


@pytest.mark.parametrize("name", ["exp", "expm1", "log", "log1p", "sine", "cosine"])
def test_nan_goes_through_with_any_payload(name):
    nans = np.array([0x7FF8000000000000, 0x7FF8000000000FFF, 0xFFFFFFFFFFFFFFFF, 0x7FFDEADBEEFCAFE1], dtype=np.uint64)
    assert np.isnan(values(name, nans.view(np.float64))).all()
    assert np.isnan(values("pow", nans.view(np.float64), np.full(4, 0.5))).all()
    assert np.isnan(values("pow", np.full(4, 0.5), nans.view(np.float64))).all()


def test_pow_at_the_borders_is_that_of_c():
    bases = [
        0.0,
        -0.0,
        SMALLEST,
        SMALLEST_NORMAL,
        0.5,
        np.nextafter(1, 0),
        1.0,
        np.nextafter(1, 2),
        2.0,
        LARGEST,
        INF,
        NAN,
    ]
    exponents = [NAN, *(s * y for s in (1.0, -1.0) for y in (0.0, SMALLEST, 1e-300, 0.5, 2.0, 1e20, LARGEST, INF))]
    x, y = (grid.ravel() for grid in np.meshgrid(bases, exponents))
    with np.errstate(all="ignore"):
        expected = np.power(np.abs(x), y)  # the sign of a zero is not kept: no (-0)^-1 = -inf
    np.testing.assert_allclose(values("pow", x, y), expected, rtol=1e-15, atol=0)


def test_pow_of_a_negative_base():
    x = np.array([-1.0, -0.5, -SMALLEST, -LARGEST, -INF])
    for y in (-2.0, -0.5, 0.5, 3.0, INF):
        assert np.isnan(values("pow", x, np.full(x.size, y))).all()
    np.testing.assert_array_equal(values("pow", x, np.zeros(x.size)), 1.0)


def test_exact_cases():
    eighths = np.arange(-1000, 1000) / 4
    np.testing.assert_array_equal(values("sine", eighths), np.tile([0.0, 1.0, 0.0, -1.0], 500))
    np.testing.assert_array_equal(values("cosine", eighths), np.tile([1.0, 0.0, -1.0, 0.0], 500))
    assert vmath.exp(0) == vmath.pow(7, 0) == vmath.pow(1, 7) == 1
    assert vmath.log(1) == vmath.log1p(0) == vmath.expm1(0) == 0
    assert vmath.sincos2pi(1) == (0, 1)


def test_fma_rounds_once():
    x = 1.0 + 2.0**-30
    assert vmath_fma(x, x, -1.0 - 2.0**-29) == 2.0**-60


@njit
def vmath_fma(x, y, z):
    return vmath.fma(x, y, z)


@pytest.mark.parametrize("name", CLAIMS)
def test_a_value_does_not_depend_on_its_place_in_the_loop(name):
    arguments = [a[:101] for a in next(iter(CLAIMS[name].arguments.values()))]
    together = values(name, *arguments)
    alone = [values(name, *(a[i : i + 1] for a in arguments))[0] for i in range(101)]
    np.testing.assert_array_equal(together, alone)


@pytest.mark.skipif(
    platform.machine() not in ("x86_64", "AMD64") or not llvmlite.binding.get_host_cpu_features().get("avx2"),
    reason="looks for AVX2 or AVX-512 instructions",
)
@pytest.mark.parametrize("name", CLAIMS)
def test_loops_are_vectorised(name):
    values(name, *next(iter(CLAIMS[name].arguments.values())))
    (assembly,) = loop(vmath, name).inspect_asm().values()  # type: ignore[attr-defined]
    packed = re.findall(r"\bvf\w+pd\b.*%[yz]mm", assembly)
    assert len(packed) >= 8
    assert not re.findall(r"\$(exp|log|pow|sin|cos|fma)\b", assembly)


def test_coefficients_are_those_that_the_script_derives():
    in_source = {float(number) for number in re.findall(r"-?\d+\.\d+(?:e-\d+)?", SOURCE)}
    with mpmath.workdps(vmath_coefficients.DIGITS):
        for name, value in vmath_coefficients.constants().items():
            assert getattr(vmath, name) == value
        for fit in vmath_coefficients.fits().values():
            derived, error = vmath_coefficients.coefficients(fit)
            assert in_source.issuperset(derived)
            assert error < 2e-17
