"""Assertions and the pytest plugin: what they accept, what a failure tells, and what they cost who makes no use of them."""

import os
import re
import shlex
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner

import albedo_lab.testing
from albedo_lab import BadInput, find
from albedo_lab.analysis.check import CHECKS
from albedo_lab.analysis.verdict import Finding, Verdict
from albedo_lab.cli import main
from albedo_lab.testing import (
    assert_bounded_at_grazing,
    assert_energy_conserving,
    assert_finite,
    assert_positive,
    assert_reciprocal,
    assert_sampler,
)

ROOT = Path(__file__).parents[1]
ASSERTIONS = {
    assert_energy_conserving: "energy",
    assert_reciprocal: "reciprocity",
    assert_positive: "positivity",
    assert_finite: "finiteness",
    assert_sampler: "sampler",
    assert_bounded_at_grazing: "grazing",
}
HEAVY = {"numba", "numpy", "pandas", "scipy", "matplotlib"}


def says(monkeypatch, check, verdict, **more):
    trials = []

    def fake(subject, trial, before):
        trials.append(trial)
        return [Finding(check, verdict, 2.0, 1.0, "the statement", **more)]

    monkeypatch.setitem(CHECKS, check, fake)
    return trials


def message(assertion, *arguments, **options):
    with pytest.raises(AssertionError) as failed:
        assertion(*arguments, **options)
    return str(failed.value)


@pytest.mark.parametrize("assertion", ASSERTIONS, ids=ASSERTIONS.values())
def test_a_sound_model_passes(assertion):
    assertion("lambert", albedo=0.5)
    assertion(find("lambert"), albedo=[0.5, 1.0])


@pytest.mark.parametrize(
    ("assertion", "model", "parameters"),
    [
        (assert_energy_conserving, "lambert", {"scale": 1.001}),
        (assert_energy_conserving, "ward", {"m": 0.2}),
        (assert_reciprocal, "phong_original", {"n": 5}),
        (assert_bounded_at_grazing, "product_phong", {}),
        (assert_bounded_at_grazing, "ward", {"m": [0.1, 0.2]}),
    ],
)
def test_a_failure_can_be_seen_again(assertion, model, parameters):
    """Both lines of the message are run as they stand: the Python one fails alike, the other says the same."""
    said = message(assertion, model, seed=3, **parameters)
    assert model in said
    python, shell = said.splitlines()[-2:]
    with pytest.raises(AssertionError) as again:
        exec(python.strip(), {})
    assert str(again.value) == said
    result = CliRunner().invoke(main, shlex.split(shell)[1:])
    assert result.exit_code == (0 if assertion is assert_bounded_at_grazing else 1)  # grazing is told and not judged
    statement = said.splitlines()[0].partition(f"{ASSERTIONS[assertion]} ")[2].partition(": ")[2]
    assert statement in result.stdout


def test_a_negative_and_a_sick_model_are_convicted_with_a_witness():
    lambert = find("lambert")
    negative = replace(lambert, evaluate=lambda p, wi, wo: 0.3 - 0.35 * wi.x * wo.x)
    broken = replace(lambert, evaluate=lambda p, wi, wo: (wi.z - wo.z) / (wi.z - wo.z))
    for assertion, sick in ((assert_positive, negative), (assert_finite, broken)):
        said = message(assertion, sick)
        assert re.search(r"^  witness: .*w[io]", said, re.MULTILINE)
        assert "albedo-lab check" not in said  # which knows the sound one under that name
        assert "with the Model of the test" in said


@pytest.mark.parametrize("assertion", ASSERTIONS, ids=ASSERTIONS.values())
@pytest.mark.parametrize("verdict", [Verdict.FAIL, Verdict.INCONCLUSIVE])
def test_what_a_failure_tells(monkeypatch, assertion, verdict):
    check = ASSERTIONS[assertion]
    says(monkeypatch, check, verdict, witness="wi = ...", claim="its source")
    assert message(assertion, "phong", n=2).splitlines() == [
        f"phong n=2: {check} {verdict}: the statement",
        "  claimed: its source",
        "  witness: wi = ...",
        "to reproduce:",
        f"  from albedo_lab.testing import {assertion.__name__}; {assertion.__name__}('phong', n=2)",
        f"  albedo-lab check phong -p n=2 --only {check}",
    ]


def test_options_reach_the_check_and_the_line_that_reproduces(monkeypatch):
    trials = says(monkeypatch, "energy", Verdict.FAIL)
    said = message(assert_energy_conserving, find("phong"), seed=7, level=0.05, excess=0.1, budget=999, threads=1, n=[1, 2.5])
    assert {(t.seed, t.excess, t.budget, t.threads) for t in trials} == {(7, 0.1, 999, 1)}
    assert said.endswith("  albedo-lab check phong -p n=1,2.5 --only energy --seed 7 --alpha 0.05 --excess 0.1 --budget 999")


@pytest.mark.parametrize("values", [np.array([1.0, 2.5]), (1.0, np.float64(2.5)), iter([1.0, 2.5])])
def test_several_values_of_any_kind(monkeypatch, values):
    says(monkeypatch, "energy", Verdict.FAIL)
    said = message(assert_energy_conserving, "phong", n=values)
    assert "assert_energy_conserving('phong', n=[1.0, 2.5])" in said
    assert "check phong -p n=1.0,2.5 --only" in said
    assert "phong n=1: energy FAIL" in said
    assert "phong n=2.5: energy FAIL" in said


def test_the_level_reaches_the_judge(monkeypatch):
    says(monkeypatch, "sampler", Verdict.OPEN, p_value=0.02)
    assert_sampler("phong")
    message(assert_sampler, "phong", level=0.03)


def test_the_roughness_alpha_is_no_option(monkeypatch):
    says(monkeypatch, "energy", Verdict.FAIL)
    said = message(assert_energy_conserving, "microfacet", alpha=0.3)
    assert "assert_energy_conserving('microfacet', alpha=0.3)" in said
    assert "albedo-lab check microfacet -p alpha=0.3 --only energy" in said


def test_a_model_without_a_sampler_has_none_to_show(monkeypatch):
    says(monkeypatch, "sampler", Verdict.SKIPPED)
    assert "SKIPPED" in message(assert_sampler, "phong")


@pytest.mark.parametrize(
    ("behaviour", "bounded"),
    [("bounded", True), ("vanishes", True), ("diverges", False), ("undecided", False), ("undefined", False)],
)
def test_what_is_bounded_at_grazing(monkeypatch, behaviour, bounded):
    says(monkeypatch, "grazing", Verdict.REPORTED, details={"behaviour": behaviour})
    if bounded:
        assert_bounded_at_grazing("phong")
    else:
        message(assert_bounded_at_grazing, "phong")


@pytest.mark.parametrize(
    ("model", "parameters"), [("wart", {}), ("phong", {"n": -1}), ("phong", {"q": 1}), ("phong", {"seed": -1})]
)
def test_bad_input_is_no_failed_assertion(model, parameters):
    with pytest.raises(BadInput):
        assert_finite(model, **parameters)


@pytest.mark.parametrize("module", ["albedo_lab.testing", "albedo_lab.pytest_plugin"])
def test_importing_is_light(module):
    code = f"import sys, pytest; before = set(sys.modules); import {module}; print(*(set(sys.modules) - before))"
    loaded = subprocess.run([sys.executable, "-c", code], capture_output=True, check=True, text=True, cwd=ROOT).stdout.split()
    assert module in loaded
    assert not HEAVY & set(loaded)
    if module == "albedo_lab.pytest_plugin":
        assert {name.partition(".")[0] for name in loaded} == {"albedo_lab"}


def suite(folder, text, *options):
    """What pytest says of that file with the plugin loaded as the entry point loads it, warnings being errors."""
    (folder / "test_it.py").write_text(text)
    entry = re.search(r"\[project\.entry-points\.pytest11\]\nalbedo_lab = \"([\w.]+)\"", (ROOT / "pyproject.toml").read_text())
    arguments = ["-q", "-W", "error", "-p", entry[1], "--rootdir", str(folder), "-p", "no:cacheprovider", *options]
    command = [sys.executable, "-c", f"import sys; sys.path.insert(0, {str(ROOT)!r}); import pytest; sys.exit(pytest.main())"]
    alone = os.environ | {"PYTEST_DISABLE_PLUGIN_AUTOLOAD": "1"}  # installed, the package would load it a second time
    return subprocess.run(
        [*command, *arguments, "test_it.py"], capture_output=True, check=False, text=True, cwd=folder, env=alone
    )


def test_the_plugin_in_a_suite_that_makes_use_of_it(tmp_path):
    text = (
        "def test_sound(brdf_check):\n    brdf_check.assert_positive('lambert')\n"
        "def test_sick(brdf_check):\n    brdf_check.assert_energy_conserving('lambert', scale=1.5)\n"
    )
    result = suite(tmp_path, text)
    assert "1 failed, 1 passed" in result.stdout
    assert "albedo-lab check lambert -p scale=1.5 --only energy" in result.stdout
    assert "_demand" not in result.stdout  # the test's own line is shown, not ours


def test_the_plugin_in_a_suite_that_makes_no_use_of_it(tmp_path):
    text = (
        "import sys\ndef test_light():\n"
        f"    assert not {HEAVY} & set(sys.modules)\n    assert 'albedo_lab.testing' not in sys.modules\n"
    )
    result = suite(tmp_path, text)
    assert (result.returncode, "1 passed" in result.stdout) == (0, True), result.stdout + result.stderr


def test_every_assertion_is_documented():
    names = {name for name in vars(albedo_lab.testing) if name.startswith("assert_")}
    assert names == {assertion.__name__ for assertion in ASSERTIONS}
    assert all(vars(albedo_lab.testing)[name].__doc__ for name in names)
