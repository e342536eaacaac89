"""What is advised is the smallest table tried that keeps its bound: closed forms of the error say which that is."""

from __future__ import annotations

import math

import numpy as np
import pytest

from albedo_lab.analysis.request import effort
from albedo_lab.catalogue import find
from albedo_lab.errors import BadInput
from albedo_lab.lookup.advice import SIZES, advise
from albedo_lab.lookup.axes import parse_axes
from albedo_lab.lookup.interpolation import interpolation_error
from albedo_lab.lookup.source import Source
from albedo_lab.lookup.table import tabulated
from tests.lookup.test_interpolation import corner, formula

PLAIN = {"mu": ["x"], "albedo": ["x"]}


@pytest.mark.parametrize("bound", [1e-2, 1e-3, 2e-4])
def test_the_size_that_a_parabola_needs(bound: float) -> None:
    """A parabola errs by h^2/4: the first size listed with h <= 2 sqrt(bound)."""
    needed = next(size for size in SIZES if 1.0 / (size - 1) <= 2.0 * math.sqrt(bound))
    found = advise(formula(lambda mu: mu * mu), parse_axes(["mu=2"]), bound, mappings=PLAIN)
    assert (found["mu_nodes"][0], found["advised"][0], found["within"][0]) == (needed, True, True)
    assert found["advised"].sum() == 1
    assert found["cells"][0] == min(found["cells"][found["within"]])
    assert all(found["largest"][~found["within"]] > bound - 1e-8)


def test_axes_are_told_in_the_shortest_text() -> None:
    found = advise(formula(lambda mu: mu), parse_axes(["mu=2@0.1:0.7"]), 1e-3, mappings=PLAIN)
    assert found["axes"][0] == "mu=8@0.1:0.7"


def test_the_rms_of_a_parabola() -> None:
    """h^2/sqrt(30) <= 1e-3: h <= 0.074, 15 nodes and more."""
    found = advise(formula(lambda mu: mu * mu), parse_axes(["mu=2"]), 1e-3, norm="rms", mappings=PLAIN)
    assert found["mu_nodes"][0] == 16


def test_the_mapping_that_makes_a_line_wins() -> None:
    ways = {"mu": ["x", "x^2", "acos(x)"]}
    found = advise(formula(lambda mu: mu * mu), parse_axes(["mu=2"]), 1e-5, mappings=ways)
    assert (found["mu_mapping"][0], found["mu_nodes"][0]) == ("mu^2", 8)
    assert found["axes"][0] == "mu^2=8@0:1"
    assert parse_axes([found["axes"][0]])[0].size == 8


def test_an_axis_that_needs_less_is_shrunk() -> None:
    """Of the bound 1e-3, 0.01 rho^2 takes 5e-5 with 8 nodes, which leaves mu^2 no more than h = 0.0616: 18 nodes, so 24."""
    found = advise(formula(lambda rho, mu: mu * mu + 0.01 * rho * rho), parse_axes(["albedo=2", "mu=2"]), 1e-3, mappings=PLAIN)
    assert (found["albedo_nodes"][0], found["mu_nodes"][0]) == (8, 24)
    assert {"alpha", "mu_of_largest", "albedo_of_largest"} & set(found.columns) == {"mu_of_largest", "albedo_of_largest"}


def test_where_no_size_helps_it_says_so() -> None:
    sizes = (4, 8, 16)
    found = advise(formula(corner), parse_axes(["albedo=2", "mu=2"]), 0.1, sizes=sizes, mappings=PLAIN)
    assert not found["within"].any()
    assert not found["advised"].any()
    assert set(found["cells"]) <= {size * size for size in sizes}
    assert max(found["cells"]) == 256
    assert min(found["largest"]) > 0.5


def test_what_is_advised_is_measured_like_any_table() -> None:
    """A table of a real model; the claim is checked by another seed of the same measurement, at four times the points."""
    source = Source(find("ggx"), "albedo", effort(1e-5, "quadrature", 0, None), (("alpha", 0.5),))
    told: list[tuple[int, int]] = []
    found = advise(source, parse_axes(["mu=2"]), 1e-3, progress=lambda done, of: told.append((done, of)))
    best = found["axes"][0]
    assert found["advised"][0]
    again = interpolation_error(tabulated("E", source, parse_axes([best])), 2048, seed=3)
    assert again.largest <= 1e-3
    assert told[-1][0] == told[-1][1]
    smaller = [i for i in range(1, len(found)) if found["within"][i]]
    assert all(found["cells"][i] >= found["cells"][0] for i in smaller)


def test_a_node_where_there_is_no_value_rules_its_table_out() -> None:
    """GGX's alpha is 0 or at least 1e-5: the second of 24 nodes of the fourth root is at (1/23)^4 = 3.6e-6."""
    source = Source(find("ggx"), "mean-albedo", effort(1e-4, "quadrature", 0, None))
    asked = {"norm": "largest", "sizes": (24,), "mappings": {"alpha": ["sqrt(sqrt(x))"]}}
    with pytest.raises(BadInput, match=r"alpha = 3\.57"):
        advise(source, parse_axes(["alpha=2"]), 1e-2, **asked)  # type: ignore[arg-type]


def test_the_same_seed_gives_the_same_answer() -> None:
    asked = (formula(lambda mu: mu**3), parse_axes(["mu=2"]), 2e-3)
    assert advise(*asked).equals(advise(*asked))


@pytest.mark.parametrize(
    ("options", "named"),
    [
        ({"bound": 0.0}, "bound"),
        ({"bound": 1e-9}, "bound"),
        ({"bound": math.nan}, "bound"),
        ({"norm": "median"}, "norm"),
        ({"points": 3}, "points"),
        ({"points": "few"}, "points"),
        ({"sizes": ()}, "sizes"),
        ({"sizes": (1, 8)}, "sizes"),
        ({"sizes": (8.5,)}, "sizes"),
        ({"sizes": (1 << 16,)}, "sizes"),
        ({"mappings": {"mu": ["tan(x)"]}}, "mapping"),
        ({"mappings": {"mu": ["log(x)"]}}, "axis"),
    ],
)
def test_bad_options_are_refused(options: dict[str, object], named: str) -> None:
    given = {"bound": 1e-3} | options
    with pytest.raises(BadInput) as wrong:
        advise(formula(lambda mu: mu), parse_axes(["mu=2"]), **given)  # type: ignore[arg-type]
    assert wrong.value.parameter == named


def test_integers_of_numpy_are_sizes() -> None:
    found = advise(formula(lambda mu: mu), parse_axes(["mu=2"]), 1e-3, sizes=list(np.array([4, 8])), mappings=PLAIN)
    assert found["mu_nodes"][0] == 4
