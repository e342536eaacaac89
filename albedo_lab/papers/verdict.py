"""Does a printed figure hold? One rule for every cell of every document."""

from __future__ import annotations

import math
from dataclasses import dataclass
from decimal import Decimal
from enum import StrEnum
from fractions import Fraction

from albedo_lab.errors import Inconclusive
from albedo_lab.estimate.record import Estimate

SLIP_UNITS = 9
SLIP_SHARE = Fraction(2, 100)
EXACT_RESOLUTION = Fraction(1, 10**4)

RULE = """\
A printed decimal stands for every number that rounds to it; ours stands for every number of its interval.

- **agrees to the printed digits**: some number is one of both.
- **off by k units in the last digit**: none is, until the printed figure is changed by k units of its last digit.
  Either k = 1, which is what cutting digits off instead of rounding them makes; or k is at most 9, so that only
  the last digit is wrong, and the two differ by at most 2 %.
- **refuted**: everything else.

A figure that claims to be exact (a fraction, a limit) has no last digit: our interval holds it, or it is refuted.
No verdict is given on an interval wider than one unit of the last digit (1e-4 for an exact figure)."""


@dataclass(frozen=True, slots=True)
class Printed:
    """A number as its document prints it: "0.350", "7.8e-3", "3/4". Fractions are exact, and what `exact` says."""

    text: str
    exact: bool = False

    @property
    def value(self) -> Fraction:
        """The number itself, without rounding."""
        return Fraction(self.text)

    @property
    def unit(self) -> Fraction:
        """One unit of the last printed digit; 0 for an exact figure."""
        if self.exact or "/" in self.text:
            return Fraction(0)
        exponent = Decimal(self.text).as_tuple().exponent
        assert isinstance(exponent, int)
        return Fraction(10) ** exponent

    @property
    def resolution(self) -> Fraction:
        """The widest interval that may judge it."""
        return self.unit or EXACT_RESOLUTION


class Kind(StrEnum):
    """The verdicts, as the summary counts them; HOLDS is for statements without digits."""

    AGREES = "agrees to the printed digits"
    HOLDS = "holds"
    OFF = "off in the last digit"
    REFUTED = "refuted"
    UNDECIDED = "cannot be decided from the text"


@dataclass(frozen=True, slots=True)
class Verdict:
    """`units` of the last digit by which the print must at least change to agree; None for a refuted exact figure."""

    kind: Kind
    units: int | None = 0

    def __str__(self) -> str:
        if self.kind is Kind.OFF:
            return f"off by {self.units} unit{'s' * (self.units != 1)} in the last digit"
        return str(self.kind)


def judge(printed: Printed, ours: Estimate) -> Verdict:
    """The verdict of `RULE`, in exact arithmetic.

    Raises Inconclusive where our figure is not a number, or too uncertain to judge anything.
    """
    if math.isnan(ours.value):
        raise Inconclusive(f"printed {printed.text}: our own figure is not a number")
    if math.isinf(ours.value):
        return Verdict(Kind.REFUTED, None)
    if not ours.high - ours.low <= printed.resolution:
        raise Inconclusive(f"printed {printed.text}: our interval [{ours.low:g}, {ours.high:g}] is too wide to judge it")
    gap = max(Fraction(ours.low) - printed.value, printed.value - Fraction(ours.high), Fraction(0))
    if not printed.unit:
        return Verdict(Kind.REFUTED, None) if gap else Verdict(Kind.AGREES)
    units = max(0, math.ceil(gap / printed.unit - Fraction(1, 2)))
    if units == 0:
        return Verdict(Kind.AGREES)
    slip = units == 1 or (units <= SLIP_UNITS and gap <= SLIP_SHARE * abs(printed.value))
    return Verdict(Kind.OFF if slip else Kind.REFUTED, units)
