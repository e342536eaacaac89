"""Numbers written as text, and what can be told of their precision from how they are written."""

from __future__ import annotations

import math
import re
from collections.abc import Sequence

import numpy as np

from albedo_lab.lookup.axes import Floats
from albedo_lab.lookup.formats.stored import half_spacing, of_integers

NUMERAL = r"[-+]?(?:0[xX][0-9a-fA-F]+|(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?|(?i:nan|inf(?:inity)?))"
"""A number of C, of JSON or of a spreadsheet, without suffix, or what stands for none."""
INTEGER = re.compile(r"\+?\d+|0[xX][0-9a-fA-F]+")
HALF_OF_ONE = 0x3C00
"""The bits of 1 as a half float."""
SINGLE_DIGITS, DOUBLE_DIGITS = 8, 16
"""Texts of floats that read back to the same bits have at least so many digits, some among many."""


def understood(texts: Sequence[str], single: bool = False, bits: int | None = None) -> tuple[Floats, float, str]:
    """Numbers, the largest error that writing them so can have made, and the way in words.

    Integers up to 255 or 65535, some above 1, or of so many `bits`, are fractions of the largest; 16 bits in hexadecimal, none
    above those of 1, are half floats. `single` says that a program reads the numbers into float32.
    """
    if all(INTEGER.fullmatch(text) for text in texts):
        return _of_integers(texts, bits)
    texts = [str(int(text, 16)) if "x" in text.lower() else text for text in texts]
    values = np.array([float(text) for text in texts])
    kind, rounding = _precision(texts, values)
    if kind == "float32":
        values = values.astype(np.float32).astype(np.float64)
    elif single:
        rounding += half_spacing(values, np.float32)
    return values, rounding, kind


def _of_integers(texts: Sequence[str], bits: int | None) -> tuple[Floats, float, str]:
    hexadecimal = all(text[:2].lower() == "0x" for text in texts)
    integers = [int(text, 16 if text[:2].lower() == "0x" else 10) for text in texts]
    largest = max(integers)
    if hexadecimal and bits != 8 and 255 < largest <= HALF_OF_ONE:
        values = np.array(integers, np.uint16).view(np.float16).astype(np.float64)
        return values, half_spacing(values, np.float16), "half floats, their bits in hexadecimal"
    return of_integers(np.array(integers, np.float64), bits)


def _precision(texts: Sequence[str], values: Floats) -> tuple[str, float]:
    """How the numbers are written, and the largest error of that."""
    written = [_digits(text) for text, value in zip(texts, values, strict=True) if math.isfinite(value)]
    if not written:
        return "no finite numbers", 0.0
    decimals, digits = ([pair[i] for pair in written] for i in (0, 1))
    most = max(digits)
    if len(set(decimals)) > 1:
        if most >= DOUBLE_DIGITS:
            return "float64", half_spacing(values, np.float64)
        if most >= SINGLE_DIGITS and _are_singles(values):
            return "float32", half_spacing(values, np.float32)
        if max(decimals) > most:  # more places than digits: the small numbers keep their digits, as with %g
            largest = float(np.max(np.abs(values[np.isfinite(values)])))
            return f"text of {most} digits", 0.5 * 10.0 ** (math.floor(math.log10(largest)) + 1 - most) if largest else 0.0
    places = max(decimals)
    return f"text of {places} decimal{'s' * (places != 1)}", 0.5 * 10.0**-places


def _digits(text: str) -> tuple[int, int]:
    """How many decimals and how many digits a number is written with.

    >>> _digits("-0.0120e-1")
    (5, 3)
    """
    mantissa, _, exponent = text.lower().lstrip("+-").partition("e")
    whole, _, part = mantissa.partition(".")
    return len(part) - int(exponent or 0), len((whole + part).lstrip("0"))


def _are_singles(values: Floats) -> bool:
    """Whether every number is the shortest text of a float32."""
    with np.errstate(over="ignore"):
        shortest = values.astype(np.float32).astype(str).astype(np.float64)
    return bool(np.array_equal(shortest, values, equal_nan=True))
