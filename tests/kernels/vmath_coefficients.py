"""Derives the polynomial coefficients of `albedo_lab.kernels.vmath` with mpmath and prints them with their errors.

    python tests/kernels/vmath_coefficients.py

A polynomial stands for the tail of a function: what is left when the leading terms, which the kernel adds in a better
way, are taken off. It is the tail's Chebyshev interpolant with its coefficients rounded to double; the error is that of
the rounded polynomial, relative to the function it is a part of.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

from mpmath import cos, exp, linspace, log, lu_solve, matrix, mp, mpf, nstr, pi, sin, sqrt

DIGITS = 50
NEAR_ZERO = mpf(10) ** -14  # closer than this a tail divides zero by zero, and its Taylor series is used


class Fit(NamedTuple):
    """A tail on [low, high], the terms of its polynomial, and what makes an error of the tail one of the function."""

    tail: Callable[[mpf], mpf]
    low: mpf
    high: mpf
    terms: int
    weight: Callable[[mpf], mpf]


def exp_tail(r: mpf) -> mpf:
    """exp(r) = 1 + r + r² tail(r)."""
    return (exp(r) - 1 - r) / r**2 if abs(r) > NEAR_ZERO else mpf(1) / 2 + r / 6


def log_tail(z: mpf) -> mpf:
    """log((1+s)/(1-s)) = 2s + 2/3 s³ + s⁵ tail(s²)."""
    s = sqrt(z)
    return (log((1 + s) / (1 - s)) - 2 * s - 2 * s**3 / 3) / s**5 if z > NEAR_ZERO else mpf(2) / 5 + 2 * z / 7


def sin_tail(z: mpf) -> mpf:
    """sin(2πr) = r (2π + r² tail(r²))."""
    r, tau = sqrt(z), 2 * pi
    return (sin(tau * r) / r - tau) / z if z > NEAR_ZERO else -(tau**3) / 6 + z * tau**5 / 120


def cos_tail(z: mpf) -> mpf:
    """cos(2πr) = 1 + r² tail(r²)."""
    tau = 2 * pi
    return (cos(tau * sqrt(z)) - 1) / z if z > NEAR_ZERO else -(tau**2) / 2 + z * tau**4 / 24


def fits() -> dict[str, Fit]:
    """The polynomials of vmath by name."""
    widest_s = (sqrt(mpf(2)) - 1) / (sqrt(mpf(2)) + 1)
    widest_r = mpf(1) / 8
    return {
        "exp": Fit(exp_tail, -log(2) / 2, log(2) / 2, 11, lambda r: r**2),
        "log": Fit(log_tail, mpf(0), widest_s**2, 8, lambda z: z**2 / 2),
        "sin": Fit(sin_tail, mpf(0), widest_r**2, 6, lambda z: z / (2 * pi)),
        "cos": Fit(cos_tail, mpf(0), widest_r**2, 7, lambda z: z),
    }


def coefficients(fit: Fit) -> tuple[list[float], float]:
    """Coefficients from the constant upward, rounded to double, and the largest error they leave."""
    middle, half = (fit.high + fit.low) / 2, (fit.high - fit.low) / 2
    nodes = [middle + half * cos(pi * (2 * k + 1) / (2 * fit.terms)) for k in range(fit.terms)]
    solution = lu_solve(matrix([[x**k for k in range(fit.terms)] for x in nodes]), matrix([fit.tail(x) for x in nodes]))
    rounded = [float(c) for c in solution]
    points = linspace(fit.low, fit.high, 1001)
    error = max(abs(sum(c * x**k for k, c in enumerate(rounded)) - fit.tail(x)) * fit.weight(x) for x in points)
    return rounded, float(error)


def constants() -> dict[str, float]:
    """The constants of vmath that are a sum of two doubles."""
    ln2_high = mpf(int(log(2) * 2**32)) / 2**32  # 32 bits: exact times any |n| < 2^21
    two_pi, two_thirds = float(2 * pi), 2.0 / 3.0
    return {
        "LN2_HIGH": float(ln2_high),
        "LN2_LOW": float(log(2) - ln2_high),
        "TWO_PI_HIGH": two_pi,
        "TWO_PI_LOW": float(2 * pi - mpf(two_pi)),
        "TWO_THIRDS_HIGH": two_thirds,
        "TWO_THIRDS_LOW": float(mpf(2) / 3 - mpf(two_thirds)),
    }


def main() -> None:
    """Print everything."""
    with mp.workdps(DIGITS):
        for name, value in constants().items():
            print(f"{name} = {value!r}")
        for name, fit in fits().items():
            values, error = coefficients(fit)
            print(f"\n{name} on [{nstr(fit.low, 6)}, {nstr(fit.high, 6)}], error {error:.1e}")
            print("\n".join(f"    {c!r}" for c in values))


if __name__ == "__main__":
    main()
