"""What is common to the trials: a fair reading's verdict, and the words of a check on a page."""

from __future__ import annotations

import pytest

from albedo_lab.digits import typeset
from albedo_lab.papers.recipes import Means
from albedo_lab.papers.trials import Found, measured, trial, unclaimed, verdict_of
from albedo_lab.papers.verdict import Kind

MEANS = Means(1e-8, "quadrature", 0, 1)


@pytest.mark.parametrize("condition", [True, False])
def test_what_is_not_claimed_keeps_its_figures_and_gets_no_verdict(condition):
    tried = trial(lambda means: Found(condition, "0.5", "quadrature", "0.50"), "because")
    open_ = unclaimed(tried, "the text does not say so")(MEANS)
    assert open_.verdict.kind is Kind.UNDECIDED
    assert (open_.ours, open_.method, open_.again, open_.why) == ("0.5", "quadrature", "0.50", "the text does not say so")
    assert tried(MEANS).verdict.kind is (Kind.HOLDS if condition else Kind.REFUTED)
    assert measured(lambda means: Found(condition, "0.5", "quadrature", "0.50"), "the text does not say so")(MEANS) == open_


def test_words_of_a_check_are_typeset():
    assert typeset("a -> 1.04 +- 0.01 at theta = 80 deg, mu = 0.2") == "a → 1.04 ± 0.01 at θ = 80°, μ = 0.2"
    assert typeset("degrees of emulation") == "degrees of emulation"


def test_findings_come_in_words_for_a_page():
    found = verdict_of("reciprocity", "phong_original", n=20)
    assert "±" in found.statement
    assert "+-" not in found.statement + found.witness
