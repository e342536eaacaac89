"""The run over all checks: what is asked, in which order, what becomes of errors, and one level for all tests of a run."""

import math
import warnings
from dataclasses import replace

import numpy as np
import pandas as pd
import pytest

import albedo_lab
from albedo_lab import BadInput, Inconclusive, find
from albedo_lab.analysis import check as module
from albedo_lab.analysis.check import CHECKS, everyone, run, selected, short, status
from albedo_lab.analysis.verdict import Finding, Verdict

NAMES = ["finiteness", "positivity", "energy", "reciprocity", "grazing", "sampler", "claims", "quality"]
COLUMNS = ["check", "verdict", "figure", "threshold", "p_value", "statement", "witness", "claim"]


def finding(check, verdict=Verdict.PASS, **more):
    return Finding(check, verdict, 0.5, 1.0, f"{check} says", **more)


@pytest.fixture
def stubs(monkeypatch):
    """Every check replaced by one that says nothing else than that it passed; each call is recorded."""
    calls = []

    def stub(name):
        def made(subject, trial, before):
            calls.append((name, subject, trial, list(before)))
            return [finding(name)]

        return made

    for name in NAMES:
        monkeypatch.setitem(CHECKS, name, stub(name))
    return calls


def test_the_order_and_what_each_check_is_told(stubs):
    table = albedo_lab.check("phong", n=[1, 20], budget=1000, excess=0, seed=3, threads=1)
    assert list(CHECKS) == NAMES
    assert table.check.tolist() == NAMES * 2
    assert list(table.columns) == ["model", "n", "scale", *COLUMNS]
    assert table.n.tolist() == [1.0] * 8 + [20.0] * 8
    assert table.scale[0] == pytest.approx(3 / (2 * math.pi))
    assert [len(before) for *_, before in stubs] == [*range(8), *range(8)]  # of the same subject only
    assert {(t.budget, t.excess, t.seed, t.threads) for _, _, t, _ in stubs} == {(1000, 0.0, 3, 1)}


def test_several_models_and_their_columns(stubs):
    table = albedo_lab.check(["phong", find("lambert")], only=["energy"], scale=[0.5, 1])
    assert list(table.columns) == ["model", "n", "albedo", "scale", *COLUMNS]
    assert table.model.tolist() == ["phong"] * 2 + ["lambert"] * 2
    assert table.scale.tolist() == [0.5, 1.0] * 2


@pytest.mark.parametrize(
    ("options", "left"),
    [
        ({}, NAMES),
        ({"only": ["claims", "energy"]}, ["energy", "claims"]),
        ({"skip": ["sampler", "quality"]}, [n for n in NAMES if n not in ("sampler", "quality")]),
        ({"only": ["energy", "sampler"], "skip": ["sampler"]}, ["energy"]),
    ],
)
def test_only_and_skip(stubs, options, left):
    assert albedo_lab.check("phong", **options).check.tolist() == left
    assert selected(options.get("only", ()), options.get("skip", ())) == left


@pytest.mark.parametrize(
    ("options", "said"),
    [
        ({"only": ["energie"]}, "only = 'energie': must be one of finiteness, positivity"),
        ({"only": "energy"}, "only = 'energy': must be a list"),
        ({"skip": [""]}, "skip = ''"),
        ({"skip": NAMES}, "leaves no check"),
        ({"only": ["energy"], "skip": ["energy"]}, "leaves no check"),
        ({"level": 0.0}, "level = 0.0"),
        ({"level": 1}, "level = 1"),
        ({"level": math.nan}, "level = nan"),
        ({"level": "small"}, "level = 'small'"),
        ({"budget": 0}, "budget = 0"),
        ({"budget": 1.5}, "budget = 1.5"),
        ({"budget": 1 << 60}, "budget = "),
        ({"budget": True}, "budget = True"),
        ({"excess": -1e-9}, "excess = -1e-09"),
        ({"excess": math.inf}, "excess = inf"),
        ({"seed": -1}, "seed = -1"),
        ({"threads": 0}, "threads = 0"),
        ({"n": -1}, "n = -1"),
        ({"q": 1}, "phong has no such parameter"),
    ],
)
def test_refused_before_anything_is_tried(stubs, options, said):
    with pytest.raises(BadInput) as refused:
        albedo_lab.check(["phong", "phong"], **options)
    assert said in str(refused.value)
    assert stubs == []


def test_a_later_model_is_refused_before_the_first_is_tried(stubs):
    for models in (["phong", "wart"], ["phong", "ward"], []):
        with pytest.raises(BadInput):
            albedo_lab.check(models, n=3)
    assert stubs == []


def test_alpha_is_the_roughness_and_not_the_level(stubs):
    table = albedo_lab.check("microfacet", only=["energy"], level=0.02, alpha=[0.2, 0.3])
    assert table.alpha.tolist() == [0.2, 0.3]


def test_what_goes_wrong_in_a_check_is_its_finding(stubs, monkeypatch):
    """Two checks break on their way; the others still speak, and the run says what happened."""

    def raises(error):
        def broken(*_):
            raise error

        return broken

    monkeypatch.setitem(CHECKS, "energy", raises(Inconclusive("budget\nspent")))
    monkeypatch.setitem(CHECKS, "sampler", raises(ZeroDivisionError("division by zero")))
    monkeypatch.setitem(CHECKS, "claims", raises(AssertionError()))
    told = [f for _, f in run("phong", {})]
    assert [f.verdict for f in told if f.check in ("energy", "sampler", "claims")] == [Verdict.INCONCLUSIVE] * 3
    assert {f.check: f.statement for f in told if f.verdict is Verdict.INCONCLUSIVE} == {
        "energy": "budget spent",
        "sampler": "ZeroDivisionError: division by zero",
        "claims": "AssertionError",
    }
    assert [f.details.get("error") for f in told if f.check in ("energy", "sampler")] == [None, "ZeroDivisionError"]
    assert status(told) == 3


def test_an_unknown_constant_leaves_every_check_undecided(stubs):
    """Nothing can be said of scale * f without its scale."""

    def broken(p):
        raise ZeroDivisionError("no constant")

    told = run(replace(find("lambert"), scale=broken), {})
    assert [f.check for _, f in told] == NAMES
    assert {f.verdict for _, f in told} == {Verdict.INCONCLUSIVE}
    assert all("ZeroDivisionError: no constant" in f.statement for _, f in told)
    assert math.isnan(told[0][0].scale.value)
    assert stubs == []


def test_a_check_that_is_interrupted_stops_the_run(stubs, monkeypatch):
    def interrupted(*_):
        raise KeyboardInterrupt

    monkeypatch.setitem(CHECKS, "energy", interrupted)
    with pytest.raises(KeyboardInterrupt):
        run("phong", {})


def test_infinities_in_a_check_are_no_warnings(stubs, monkeypatch):
    monkeypatch.setitem(CHECKS, "energy", lambda *_: [finding("energy", details={"x": np.float64(1.0) / np.float64(0.0)})])
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert run("phong", {}, only=["energy"])[0][1].verdict is Verdict.PASS


def test_one_level_for_all_tests_of_a_run(stubs, monkeypatch):
    """p = 0.004 convicts one model at 1 %; among three, Holm holds it against 0.01 / 3, and acquits."""
    chances = {"phong": 0.004, "lambert": 0.5, "blinn": 0.9}

    def fake(subject, trial, before):
        return [finding("sampler", Verdict.OPEN, p_value=chances[subject.model.name], witness="w")]

    monkeypatch.setitem(CHECKS, "sampler", fake)

    def verdicts(models, **options):
        return albedo_lab.check(models, only=["energy", "sampler"], **options).query("check == 'sampler'").verdict.tolist()

    assert verdicts("phong") == ["FAIL"]
    assert verdicts(list(chances)) == ["PASS"] * 3
    assert verdicts(list(chances), level=0.02) == ["FAIL", "PASS", "PASS"]
    assert verdicts("phong", n=[1, 2, 3]) == ["PASS"] * 3  # the cells of a grid are tests of the same run
    chances["lambert"] = 0.001
    assert verdicts(list(chances)) == ["FAIL", "FAIL", "PASS"]


def test_no_verdict_stays_open(stubs, monkeypatch):
    monkeypatch.setitem(CHECKS, "sampler", lambda *_: [finding("sampler", Verdict.OPEN, p_value=0.5)] * 3)
    assert Verdict.OPEN not in {f.verdict for _, f in run("phong", {})}


@pytest.mark.parametrize(
    ("verdicts", "expected"),
    [
        ([], 0),
        ([Verdict.PASS, Verdict.SKIPPED, Verdict.REPORTED], 0),
        ([Verdict.PASS, Verdict.INCONCLUSIVE], 3),
        ([Verdict.INCONCLUSIVE, Verdict.FAIL, Verdict.PASS], 1),
    ],
)
def test_status(verdicts, expected):
    assert status([finding("energy", verdict) for verdict in verdicts]) == expected


def test_progress_counts_every_check(stubs):
    seen = []
    run(["phong", "lambert"], {}, only=["energy", "claims"], progress=lambda *told: seen.append(told))
    assert seen == [(0, 4), (1, 4), (2, 4), (3, 4), (4, 4)]


def test_everyone_needs_no_file():
    assert "merl" not in everyone()
    assert set(everyone()) == set(albedo_lab.names()) - {"merl"}


@pytest.mark.parametrize(
    ("model", "given", "said"),
    [
        ("phong", {}, ""),
        ("phong", {"n": 1e4, "scale": 2}, "n=10000 scale=2"),
        ("ward", {"m": 0.1}, "m=0.1"),
        ("ward", {"m": 0.1, "m_x": 0.2}, "m_x=0.2 m_y=0.1"),
        ("metal", {"metal": "gold"}, "metal=gold"),
    ],
)
def test_the_parameters_in_short(stubs, model, given, said):
    ((subject, _),) = run(model, given, only=["energy"])
    assert short(subject, given) == said


@pytest.mark.parametrize("name", NAMES)
def test_every_check_speaks_of_itself(name):
    """The checks themselves, on the simplest model: each says at least one thing, under its own name."""
    told = [f for _, f in run("lambert", {}, only=[name])]
    assert {f.check for f in told} == {name}
    assert {f.verdict for f in told} <= {Verdict.PASS, Verdict.REPORTED, Verdict.SKIPPED}


def test_same_seed_same_bits():
    """Whatever the number of threads."""
    tables = [albedo_lab.check("stretched_phong", seed=5, threads=threads, budget=1 << 20) for threads in (1, 2, 2)]
    pd.testing.assert_frame_equal(tables[0], tables[1], check_exact=True)
    pd.testing.assert_frame_equal(tables[1], tables[2], check_exact=True)


def test_a_sick_model_is_convicted_and_a_sound_one_is_not():
    """Negative control of the whole chain: 0.1 % more light than energy balance allows."""
    assert status([f for _, f in run("lambert", {"scale": 1})]) == 0
    told = [f for _, f in run("lambert", {"scale": 1.001})]
    convicted = [f for f in told if f.verdict is Verdict.FAIL]
    assert status(told) == 1
    assert "energy" in {f.check for f in convicted}
    assert all(f.witness for f in convicted if f.check == "energy")
    assert module.LEVEL == 0.01
