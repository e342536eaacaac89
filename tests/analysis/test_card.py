"""What is gathered of a model: against closed forms, against a second method, and judged together."""

import math
from dataclasses import replace

import pytest

from albedo_lab import BadInput, find
from albedo_lab.analysis import card, check
from albedo_lab.analysis.card import LAST, facts
from albedo_lab.analysis.check import CHECKS
from albedo_lab.analysis.sampler import VIEWERS
from albedo_lab.analysis.verdict import Finding, Verdict
from albedo_lab.estimate.quadrature import quadrature
from albedo_lab.estimate.record import Question, Tolerance, bounded


@pytest.fixture
def cheap(monkeypatch):
    """Without the checks that draw half a million samples."""
    monkeypatch.setattr(check, "CHECKS", {name: each for name, each in CHECKS.items() if name not in ("sampler", "quality")})


def agree(a, b):
    """Whether two intervals meet, with room for the one interval in twenty that misses."""
    return abs(a.value - b.value) <= a.half_width + 2.0 * b.half_width


@pytest.mark.usefixtures("cheap")
def test_phong_as_first_published_in_closed_form():
    (known,) = facts(["phong_original"])
    assert known.name == "phong_original"
    viewer, light = known.albedos
    assert (viewer.order, light.order) == ("wi", "wo")
    whole = 102 / 101  # (n + 2) / (n + 1): nothing of the lobe is lost where the horizon is far
    assert viewer.largest.value == pytest.approx(whole, rel=1e-12)
    assert viewer.grazing.limit == pytest.approx(whole / 2, abs=1e-8)  # half of the lobe
    assert math.isinf(light.largest.value)
    assert light.mu == 0.0
    assert light.grazing.exponent.value == pytest.approx(-1.0, abs=1e-6)
    for albedo in known.albedos:
        assert albedo.mean.low <= (1 + whole) / 2 <= albedo.mean.high  # both orders integrate the same over all pairs
    assert known.mirror == ()


@pytest.mark.usefixtures("cheap")
@pytest.mark.parametrize("name", ["ward", "plastic", "schlick", "minnaert"])
def test_both_methods_agree(name):
    (known,) = facts([name])
    (albedo,) = known.albedos
    largest, mean, slope = albedo.again
    subject = known.subject
    last = quadrature(Question(subject.model, subject.p, LAST), Tolerance(0.0, 1e-8)).scaled(subject.scale)
    assert agree(last, albedo.last)
    assert agree(albedo.mean, mean)
    assert agree(albedo.slope, slope)
    assert {e.method for e in (albedo.last, *albedo.again)} == {"rqmc"}
    assert {e.method for e in (albedo.largest, albedo.mean, albedo.slope)} == {"quadrature"}
    if albedo.mu > 0.0:
        assert agree(albedo.largest, largest)
    else:
        assert largest == albedo.last


@pytest.mark.usefixtures("cheap")
def test_the_slope_is_that_of_the_albedo():
    (known,) = facts(["minnaert"])  # k = 0.5: a(mu) = mu^(k - 1) 2 / (k + 1)
    (albedo,) = known.albedos
    assert albedo.slope.low <= -0.5 <= albedo.slope.high
    assert albedo.slope.half_width < 1e-7
    assert albedo.mean.low <= 16 / 9 <= albedo.mean.high  # 4 / (k + 1)^2


@pytest.mark.usefixtures("cheap")
def test_the_dirac_part_is_told_with_the_constant_in_it():
    mirror, lambert = facts([replace(find("mirror"), scale=lambda p: 0.5), "lambert"])
    assert [theta for theta, _ in mirror.mirror] == pytest.approx([math.degrees(math.acos(mu)) for mu in VIEWERS])
    assert {share for _, share in mirror.mirror} == {0.5}
    assert mirror.albedos[0].largest.value == pytest.approx(0.5)
    assert mirror.albedos[0].last.value == mirror.albedos[0].again[0].value == pytest.approx(0.5)
    assert lambert.mirror == ()


@pytest.mark.usefixtures("cheap")
def test_a_model_that_reflects_nothing_has_no_slope():
    (known,) = facts([replace(find("lambert"), evaluate=nothing)])
    (albedo,) = known.albedos
    assert math.isnan(albedo.slope.value)
    assert math.isnan(albedo.again[2].value)
    assert albedo.mean.value == 0.0


def nothing(p, wi, wo):
    return 0.0


def test_all_findings_of_a_model_and_no_others():
    (known,) = facts(["lambert"])
    assert list(dict.fromkeys(finding.check for finding in known.findings)) == list(CHECKS)
    assert len(known.of("quality")) == len(VIEWERS)
    assert {finding.check for finding in known.of("sampler")} == {"sampler"}


def test_models_are_judged_together(monkeypatch):
    open_one = Finding("sampler", Verdict.OPEN, 1.0, math.nan, "a test", p_value=0.008)
    monkeypatch.setattr(check, "CHECKS", {"sampler": lambda subject, trial, before: [open_one]})
    (alone,) = facts(["lambert"])
    assert alone.findings[0].verdict is Verdict.FAIL
    assert [known.findings[0].verdict for known in facts(["lambert", "mirror"])] == [Verdict.PASS] * 2


@pytest.mark.usefixtures("cheap")
def test_the_same_bits_whatever_the_threads_and_others_from_another_seed():
    one, two, other = (facts(["phong"], seed=seed, threads=threads)[0] for seed, threads in ((3, 1), (3, 2), (4, 1)))
    assert repr(one.albedos) == repr(two.albedos)
    assert repr(one.findings) == repr(two.findings)
    assert one.albedos[0].again != other.albedos[0].again
    assert one.albedos[0].mean == other.albedos[0].mean  # quadrature has no seed


@pytest.mark.usefixtures("cheap")
def test_the_whole_catalogue_by_default_and_progress(monkeypatch):
    monkeypatch.setattr(card, "everyone", lambda: ["lambert", "mirror"])
    steps = []
    assert [known.name for known in facts(progress=lambda done, total: steps.append((done, total)))] == ["lambert", "mirror"]
    assert steps == [(done, 2 * len(check.CHECKS)) for done in range(2 * len(check.CHECKS) + 1)]


def test_bad_input():
    with pytest.raises(BadInput, match="phonk"):
        facts(["phonk"])
    with pytest.raises(BadInput, match="threads"):
        facts(["lambert"], threads=0)


def test_one_model_may_stand_alone(monkeypatch):
    monkeypatch.setattr(card, "_albedo", lambda subject, order, want: bounded(0.0, 0.0, 0, "none"))
    monkeypatch.setattr(check, "CHECKS", {"positivity": CHECKS["positivity"]})
    assert [known.name for known in facts("lambert")] == ["lambert"]
