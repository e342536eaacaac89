import math
from fractions import Fraction

import pytest

from albedo_lab.errors import Inconclusive
from albedo_lab.estimate.record import Estimate, bounded
from albedo_lab.papers.verdict import Kind, Printed, judge


def verdict(text: str, value: float, bound: float = 0.0, exact: bool = False) -> str:
    return str(judge(Printed(text, exact), bounded(value, bound, 1, "test")))


AGREES, REFUTED = "agrees to the printed digits", "refuted"


def off(k: int) -> str:
    return f"off by {k} unit{'s' if k > 1 else ''} in the last digit"


@pytest.mark.parametrize(
    ("text", "value", "unit"),
    [
        ("0.350", Fraction(35, 100), Fraction(1, 1000)),
        ("10.4", Fraction(104, 10), Fraction(1, 10)),
        ("13", Fraction(13), Fraction(1)),
        ("7.8e-3", Fraction(78, 10000), Fraction(1, 10000)),
        ("3/4", Fraction(3, 4), Fraction(0)),
    ],
)
def test_a_printed_number_knows_its_digits(text, value, unit):
    assert (Printed(text).value, Printed(text).unit) == (value, unit)


def test_an_exact_number_has_no_last_digit():
    assert Printed("0.5", exact=True).unit == 0


@pytest.mark.parametrize(
    ("text", "value", "bound", "expected"),
    [
        ("0.350", 0.3496, 0.0, AGREES),
        ("0.350", 0.3495 + 1e-12, 0.0, AGREES),
        ("0.350", 0.3495 - 1e-12, 0.0, off(1)),
        ("0.350", 0.3495 - 1e-12, 1e-11, AGREES),  # straddles the rounding boundary: consistent with the print
        ("0.688", 0.6875, 0.0, AGREES),  # a tie may be rounded either way
        ("0.687", 0.6875, 0.0, AGREES),
        ("0.350", 0.3516, 0.0, off(2)),
        ("0.368", 0.36378, 0.0, off(4)),
        ("0.0003", 0.0004, 0.0, off(1)),  # one unit never refutes, however large a share it is
        ("0.0003", 0.0005, 0.0, REFUTED),  # two units of one digit do
        ("1.002", 1.0114, 0.0, off(9)),
        ("1.002", 1.0116, 0.0, REFUTED),  # ten units: not the last digit alone
        ("0.042", 0.0642, 0.0, REFUTED),
        ("2.6", 3.1, 0.0, REFUTED),
        ("-0.5", -0.52, 0.0, AGREES),
    ],
)
def test_the_rule(text, value, bound, expected):
    assert verdict(text, value, bound) == expected


def test_the_whole_interval_counts_not_its_centre():
    # printed + 1.5 units is the border between one and two units
    assert verdict("0.350", 0.3516, 0.00005) == off(2)
    assert verdict("0.350", 0.3516, 0.00015) == off(1)


def test_exact_figures_are_held_or_refuted():
    assert verdict("2/3", 0.6666667, 1e-6) == AGREES
    assert verdict("2/3", 0.66667, 1e-6) == REFUTED
    assert verdict("1", 2 / 3, exact=True) == REFUTED  # although 2/3 rounds to the printed "1"
    assert verdict("1", 1.0, exact=True) == AGREES


def test_units_are_told_of_refuted_decimals_only():
    assert judge(Printed("0.042"), bounded(0.0641554, 1e-8, 1, "test")).units == 22
    assert judge(Printed("1", exact=True), bounded(2 / 3, 0.0, 1, "test")).units is None


def test_an_unbounded_figure_refutes_and_nothing_is_judged_on_nothing():
    assert judge(Printed("1.2"), bounded(math.inf, 0.0, 1, "test")).kind is Kind.REFUTED
    with pytest.raises(Inconclusive):
        verdict("1.2", math.nan)
    with pytest.raises(Inconclusive):
        verdict("0.350", 0.35, 0.001)
    with pytest.raises(Inconclusive):
        judge(Printed("0.350"), Estimate(0.35, 1.0, -math.inf, math.inf, 1, "test"))


def test_negative_control_a_changed_digit_is_noticed():
    for text in ("0.737", "20.6", "1.011", "3.7e-2"):
        printed = Printed(text)
        ours = bounded(float(printed.value), float(printed.unit) / 1000, 1, "test")
        wrong = Printed(f"{float(printed.value + 3 * printed.unit):.{max(0, -round(math.log10(printed.unit)))}f}")
        assert judge(printed, ours).kind is Kind.AGREES
        assert judge(wrong, ours).kind is not Kind.AGREES
