"""Figures with as many digits as their error leaves."""

from __future__ import annotations

import math
import re
from decimal import ROUND_UP, Decimal
from fractions import Fraction
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from albedo_lab.estimate.record import Estimate

TYPESET = {
    re.compile(pattern): sign
    for pattern, sign in {
        r"\+-": "±",
        r"->": "→",
        r" deg(rees)?\b(?! of freedom)": "°",
        r"\btheta\b": "θ",
        r"\bphi\b": "φ",
        r"\bmu\b": "μ",
    }.items()
}


def typeset(words: str) -> str:
    """The plain words of a check, which any terminal can show, with the signs of a page.

    >>> typeset("a = 1.04 +- 0.01 at theta = 80 deg")
    'a = 1.04 ± 0.01 at θ = 80°'
    """
    for pattern, sign in TYPESET.items():
        words = pattern.sub(sign, words)
    return words


def justified(value: float, low: float, high: float) -> tuple[str, str]:
    """The value to the second digit of its interval's half-width, and that half-width rounded up to two digits.

    >>> justified(0.9504312345, 0.9504194, 0.9504431)
    ('0.950431', '1.2e-05')
    >>> justified(0.5, 0.5, 0.5)
    ('0.5', '0')
    """
    half_width = max(high - value, value - low)
    if not (math.isfinite(value) and 0.0 < half_width < math.inf):
        return as_text(value), as_text(half_width)
    exact = Decimal(repr(half_width))
    last = exact.adjusted() - 1
    rounded_up = float(exact.quantize(Decimal(1).scaleb(last), ROUND_UP))
    if value == 0.0 or 1e-4 <= abs(value) < 1e12:
        text = f"{value:.{min(max(-last, 0), 16)}f}"
    else:
        text = f"{value:.{min(max(Decimal(repr(value)).adjusted() - last, 0), 16)}e}"
    return text, f"{rounded_up:#.2g}".rstrip(".")


def with_error(e: Estimate, finest: float = 0.0) -> str:
    """The figure ± half of its interval, to one digit, rounded up, and not finer than `finest`; a limit as a fraction.

    >>> from albedo_lab.estimate.record import Estimate
    >>> with_error(Estimate(5.33417739, 3e-13, 5.334177389, 5.334177391, 99, "quadrature"), finest=1e-5)
    '5.33418 ± 0.00001'
    """
    if e.half_width == 0.0:
        fraction = Fraction(e.value).limit_denominator(100)
        return str(fraction) if float(fraction) == e.value else f"{e.value:.7g}"
    if not math.isfinite(e.value + e.half_width):
        return f"{e.value:g} ± {e.half_width:g}"
    last = Decimal(1).scaleb(Decimal(max(e.half_width, finest) * (1.0 + 1e-9)).adjusted())
    value = Decimal(e.value).quantize(last) + 0  # no negative zero
    half_width = max(Decimal(e.high) - value, value - Decimal(e.low)).quantize(last, ROUND_UP)
    return f"{value:f} ± {half_width:f}"


def as_text(value: object) -> str:
    """A value for a person: numbers to twelve digits, nothing for None."""
    if isinstance(value, float):
        return f"{value:.12g}"
    return "" if value is None else str(value)
