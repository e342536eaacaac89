"""The plain faces of the elementary functions agree with the vector ones, at the borders too."""

import math

import pytest
from numba import njit

from albedo_lab.kernels import vmath
from albedo_lab.optics import maths

BORDERS = [0.0, 1.0, -1.0, 0.5, -0.5, 3.0, 1e-300, 5e-324, 1e300, 800.0, -800.0, math.inf, -math.inf, math.nan]


def compiled(name: str):  # type: ignore[no-untyped-def]
    """A vector function as one that Python can call: forceinline alone leaves no symbol to call."""
    function = getattr(vmath, name)

    @njit
    def call(*arguments):  # type: ignore[no-untyped-def]
        return function(*arguments)

    return call


@pytest.mark.parametrize("name", ["exp", "expm1", "log", "log1p"])
def test_functions_of_one_argument(name: str) -> None:
    vector, plain = compiled(name), getattr(maths, name)
    for x in BORDERS:
        assert vector(x) == pytest.approx(plain(x), rel=1e-15, abs=5e-324, nan_ok=True), x


def test_pow() -> None:
    vector = compiled("pow")
    for x in BORDERS:
        for y in BORDERS:
            if not (math.isnan(x) or math.isnan(y)):
                assert vector(x, y) == pytest.approx(maths.pow(x, y), rel=1e-15, abs=5e-324, nan_ok=True), (x, y)


def test_sincos2pi() -> None:
    vector = compiled("sincos2pi")
    for u in (0.0, 0.1, 0.25, 0.5, 0.999, -0.3, 17.125):
        assert vector(u) == pytest.approx(maths.sincos2pi(u), abs=1e-14)
    assert all(math.isnan(x) for x in maths.sincos2pi(math.inf))
