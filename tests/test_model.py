"""Families of models: choices, counts and files, members, and tables among the parameters."""

import math

import numpy as np
import pytest

from albedo_lab.catalogue import find
from albedo_lab.errors import BadInput
from albedo_lab.model import Choice, Count, File
from albedo_lab.tables import plain, table

WORD = Choice("G", "masking", ("none", "smith"), "smith")
PRINTED = Choice("as_printed", "the print", ("no", "yes"), "no")
LOBES = Count("lobes", "number of lobes", 1, 1, 4)
FILE = File("file", "a measurement")


def test_a_choice_takes_its_options_only() -> None:
    assert WORD.parse("none") == "none"
    assert PRINTED.parse(True) == "yes"
    assert PRINTED.parse(False) == "no"
    for value in ("Smith", "", None, 1.0, True):
        with pytest.raises(BadInput, match=r"G = .*must be one of none, smith"):
            WORD.parse(value)


def test_a_count_takes_integers_of_its_domain_only() -> None:
    assert LOBES.parse(4.0) == 4
    assert isinstance(LOBES.parse(2.0), int)
    for value in (0, 5, 1.5, math.nan, math.inf, "2", None, True):
        with pytest.raises(BadInput, match=r"lobes = .*integer in \[1, 4\]"):
            LOBES.parse(value)


def test_a_file_takes_a_path_only() -> None:
    assert FILE.parse("a.binary") == "a.binary"
    for value in ("", None, 3.0):
        with pytest.raises(BadInput, match=r"file = .*path"):
            FILE.parse(value)


def test_a_member_is_one_and_the_same_however_it_is_asked_for() -> None:
    """Kernels and suprema are kept by the model's identity."""
    family = find("phong_blend")
    printed, rest = family.member({"as_printed": True, "n": 3.0})
    assert rest == {"n": 3.0}
    assert printed is not family
    assert printed is family.member({"as_printed": "yes"})[0]
    assert printed.member({"as_printed": "no"})[0] is family
    assert family.member({"as_printed": "no"})[0] is family
    assert family.member({})[0] is family
    assert printed.member({"n": 3.0})[0] is printed


def test_a_value_outside_the_family_is_told_with_the_member_that_was_chosen() -> None:
    member, rest = find("phong_blend").member({"as_printed": "yes", "m": 1.0})
    with pytest.raises(BadInput, match=r"m = 1.0.*phong_blend \(as_printed = yes\).*as_printed, d, D, S, n, scale"):
        member.bind(rest)


def test_tables_are_equal_to_themselves_alone_and_cannot_be_written() -> None:
    first, second = table([1.0, 2.0]), table([1.0, 2.0])
    assert first == first
    assert first != second
    assert len({first, second, first}) == 2
    with pytest.raises(ValueError, match="read-only"):
        first[0] = 3.0
    assert type(plain(first)) is np.ndarray
    assert plain(np.float64(2.0)) == 2.0
