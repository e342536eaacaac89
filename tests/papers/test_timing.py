"""Costs: what is counted, how ratios are judged, and the pages. No test asserts a time."""

from __future__ import annotations

import itertools
import math
import sys
from collections import Counter
from pathlib import Path

import numpy as np
import pytest

from albedo_lab.analysis import timing
from albedo_lab.analysis.clock import interleave, ratio, timed
from albedo_lab.analysis.operations import operations
from albedo_lab.analysis.timing import LIGHT, VIEWER, Contender, Pace, evaluation, operations_of, paces, spectrum
from albedo_lab.papers.cost_claims import CLAIMS, Judged, basic, counts, dearer, much_less, unclaimed
from albedo_lab.papers.timing import CONTENDERS, TIMINGS, Costs
from albedo_lab.papers.verdict import Kind
from albedo_lab.report import timings

PACE = Pace(1.5, 1.0, 2.0, 3.5, 3.0, 4.0)


def fabricated(**nanoseconds: tuple[float, ...]) -> Costs:
    """Costs of so many nanoseconds a pair in each round, at one and at eight wavelengths alike."""
    times = {name: [ns * timing.PAIRS * 1e-9 for ns in each] for name, each in nanoseconds.items()}
    return Costs(times, times, {name: operations_of(CONTENDERS[name]) for name in nanoseconds if name in CONTENDERS})


@pytest.fixture(scope="module")
def costs() -> Costs:
    """Made-up times of every contender, the later the slower, with what the formulas really execute."""
    return fabricated(**{name: (1.0 + i, 1.1 + i, 1.2 + i) for i, name in enumerate(CONTENDERS)})


def test_a_sentence_about_another_machine_keeps_its_figures_and_gets_no_verdict() -> None:
    tried, made_up = dearer(("a", "b")), fabricated(a=(1.0, 1.0, 1.0), b=(2.0, 2.0, 2.0))
    assert tried(made_up).kind is Kind.REFUTED
    assert unclaimed(tried, "another machine")(made_up) == Judged(Kind.UNDECIDED, tried(made_up).ours, "another machine")


def test_operations_of_a_formula_that_is_counted_by_hand() -> None:
    def formula(x: float, y: float) -> float:
        return math.sqrt(x * x + y * y) / max(x, -y) - math.exp(x) if x < y else 0.0

    assert operations(formula, 1.0, 2.0) == Counter(multiply=2, add=3, root=1, divide=1, compare=2, function=1)
    assert operations(formula, 2.0, 1.0) == Counter(compare=1)


def test_a_loop_counts_every_turn() -> None:
    def series(n: int) -> float:
        total = 0.0
        for i in range(n):
            total += i * 2.0
        return total

    assert operations(series, 7) == Counter(add=7, multiply=7)


def test_callees_count_and_elementary_functions_count_as_one() -> None:
    """Phong: 3 differences, 3 products and 2 sums of the distance, half of it, a sign twice, a power made of two functions."""
    counted = operations_of(CONTENDERS["phong"])
    assert counted["function"] == 2
    assert counted["divide"] == 0
    assert operations_of(CONTENDERS["lambert"]) == Counter(divide=1)
    assert operations_of(CONTENDERS["stretched_phong"]) - counted == Counter(divide=1, compare=1)


def test_counting_leaves_no_trace() -> None:
    before = sys.gettrace(), sys.getprofile()
    with pytest.raises(ZeroDivisionError):
        operations(lambda x: 1.0 / x, 0.0)
    assert (sys.gettrace(), sys.getprofile()) == before


def test_timed_and_interleave_take_turns() -> None:
    """With a clock of our own: every reading is a tick later."""
    ticks = itertools.count()
    done: list[str] = []
    measures = {name: timed(lambda name=name: done.append(name), lambda: float(next(ticks))) for name in "ab"}  # type: ignore[misc]
    del done[:]
    times = interleave(measures, 3)
    assert done == list("abbaab")
    assert times == {"a": [1.0] * 3, "b": [1.0] * 3}


def test_ratio_is_the_median_of_the_ratios_within_rounds() -> None:
    found = ratio({"slow": [2.0, 30.0, 8.0], "fast": [1.0, 10.0, 2.0]}, "slow", "fast")
    assert (found.value, found.low, found.high) == (3.0, 2.5, 3.5)


@pytest.mark.parametrize(
    ("slow", "kind"),
    [((2.0, 2.0, 2.0), Kind.HOLDS), ((1.0, 1.0, 1.0), Kind.REFUTED), ((1.0, 2.0, 2.0), Kind.UNDECIDED)],
)
def test_a_ratio_decides_beyond_the_spread_of_the_rounds(slow: tuple[float, ...], kind: Kind) -> None:
    found = dearer(("blinn", "phong"), low=1.6, why="because")(fabricated(blinn=slow, phong=(1.0, 1.0, 1.0)))
    assert found.kind is kind
    assert found.why == {Kind.HOLDS: "", Kind.REFUTED: "because"}.get(kind, found.why)


def test_counts_judge() -> None:
    def many(x: float) -> float:
        return x * x * x * x + 1.0

    def few(x: float) -> float:
        return x * x

    assert counts(much_less, {"a": (many, 2.0), "b": (few, 2.0)})(fabricated()) == Judged(
        Kind.HOLDS, "a: 1 add, 3 multiply; b: 1 multiply"
    )
    assert counts(much_less, {"a": (few, 2.0), "b": (many, 2.0)}, "no")(fabricated()).kind is Kind.REFUTED
    assert basic([operations(few, 2.0)])
    assert not basic([operations(math.sqrt, 2.0)])


def test_eight_wavelengths_are_eight_values() -> None:
    """Both kinds that depend on the wavelength run, and fill arrays with finite numbers; what they hold is the models' affair."""
    for name in ("phong", "cook_torrance", "he_torrance"):
        work = spectrum(CONTENDERS[name])
        work()
        closure = [cell.cell_contents for cell in work.__closure__ or ()]
        arrays = [value for value in closure if isinstance(value, np.ndarray) and value.ndim == 2]
        assert all(np.all(np.isfinite(values)) and values.shape == (8, timing.PAIRS) for values in arrays)
    evaluation(CONTENDERS["phong"])()


def test_metals_reflectance_multiplies_the_shape() -> None:
    contender = Contender("cook_torrance", {"m": 0.2}, "fresnel")
    work = spectrum(contender)
    work()
    (values,) = [
        c.cell_contents for c in work.__closure__ or () if isinstance(c.cell_contents, np.ndarray) and c.cell_contents.ndim == 2
    ]
    L, E = timing.pairs()
    eta, k = timing.index(timing.METAL, timing.PAPER_WAVELENGTHS[-1])
    exact, p, _ = next(timing.grid(timing.model_of("cook_torrance"), {"m": 0.2, "fresnel": "exact", "eta": eta, "k": k}))
    f = np.empty(timing.PAIRS)
    timing.value_kernel(exact)(tuple(map(float, p)), L, E, f)
    np.testing.assert_allclose(values[-1], f, rtol=1e-12, atol=1e-300)


def test_every_claim_is_judged(costs: Costs) -> None:
    assert len({claim.name for claim in CLAIMS}) == len(CLAIMS)
    assert {claim.document for claim in CLAIMS} == {"neumann1999", "schlick1993", "losasso", "nuaj_models"}
    for claim in CLAIMS:
        found = claim.trial(costs)
        assert found.ours
        assert found.kind is not Kind.UNDECIDED or found.why, claim.name


def test_rows_name_contenders() -> None:
    for table in TIMINGS:
        names = [row.contender for row in table.rows]
        assert set(names) <= set(CONTENDERS)
        assert table.base in names
    assert LIGHT.z > 0.0
    assert VIEWER.z > 0.0


def test_pages(costs: Costs) -> None:
    files = timings.timing_files(costs, {"phong": PACE})
    assert {Path(name).parent.as_posix() for name in files} == {"timings"}
    table = files["timings/neumann1999_table_5.md"]
    assert "| He-Torrance | 1516 | 281 |" in table
    assert "| model | printed [min] | over Phong, printed |" in table
    assert "is cheaper than" in table
    appendix = files["timings/losasso_appendix_b.md"]
    assert "missing" in appendix
    assert "printed |" not in appendix
    assert timings.processor() in files["timings/README.md"]
    assert files["timings/claims.csv"].count("\n") == len(CLAIMS) + 1
    assert all(content.endswith("\n") for content in files.values())


def test_written_and_found_again(tmp_path: Path, costs: Costs, monkeypatch: pytest.MonkeyPatch) -> None:
    told: list[tuple[int, int]] = []
    monkeypatch.setattr(timings, "measure", lambda: costs)
    monkeypatch.setattr(timings, "paces", lambda names: {"phong": PACE})
    assert not timings.timings_are_there(tmp_path)
    timings.write_timings(tmp_path, lambda done, of: told.append((done, of)))
    assert timings.timings_are_there(tmp_path)
    assert told[0] == (0, 3)
    assert told[-1] == (3, 3)
    assert timings.paces_there(tmp_path) == {"phong": PACE}
    (tmp_path / timings.LEAGUE).unlink()
    assert not timings.timings_are_there(tmp_path)
    assert timings.paces_there(tmp_path) == {}


def test_what_models_of_the_catalogue_cost() -> None:
    found = paces(["mirror", "lambert", "phong"], 3)
    assert list(found) == ["mirror", "lambert", "phong"]
    for pace in (found["lambert"], found["phong"]):
        assert 0.0 < pace.evaluation_low <= pace.evaluation <= pace.evaluation_high
        assert 0.0 < pace.sample_low <= pace.sample <= pace.sample_high
    assert np.isnan(found["mirror"].sample)
