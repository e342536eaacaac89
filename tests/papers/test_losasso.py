"""The document losasso: its equations against the models, its statements and their verdicts, its errata."""

from __future__ import annotations

from collections import Counter
from functools import cache
from math import pi, radians

import mpmath
import numpy as np
import pytest

from albedo_lab.papers.losasso import PAPER, equations
from albedo_lab.papers.recipes import Means
from albedo_lab.papers.record import Cause, Evidence, Statement
from albedo_lab.papers.trials import subject_of
from albedo_lab.papers.verdict import Kind
from albedo_lab.pictures.evaluation import values

MEANS = Means(1e-8, "quadrature", 0, 1)
STATEMENTS = {statement.name: statement for statement in PAPER.statements}
SLOW = {"oren_nayar_energy", "ct_energy", "blinn_energy", "one_light_for_all_equations"}
"""Searches of a supremum; `make reports` holds them."""
TASTE = {name for name in STATEMENTS if name.endswith(("plastic", "metal", "appearance", "tweak", "vase", "velvet"))}


@cache
def heard(name: str) -> Evidence:
    return STATEMENTS[name].trial(MEANS)


@pytest.mark.parametrize(
    ("equation", "model", "irradiance", "parameters"),
    [
        (equations.lambert, "lambert", pi, {}),
        (equations.cook_torrance(0.3), "cook_torrance", 1.0, {"m": 0.3}),
        (equations.blinn(0.3), "blinn_trowbridge_reitz", 1.0, {"c": 0.3, "as_printed": "yes"}),
        (equations.oren_nayar(0.5), "oren_nayar", 1.0, {"sigma": 0.5}),
        (equations.minnaert(0.5), "minnaert", pi, {"k": 0.5, "as_printed": "yes"}),
        (equations.ward(0.2, 0.4), "ward", pi, {"m_x": 0.2, "m_y": 0.4, "form": "half_vector"}),
    ],
    ids=lambda value: value if isinstance(value, str) else "",
)
def test_equations_are_the_models(
    equation: equations.Equation, model: str, irradiance: float, parameters: dict[str, object]
) -> None:
    """Both parents of the figures of this document: formulas on arrays, and what the catalogue has."""
    L, E = equations.hemisphere(1, 2000), equations.hemisphere(2, 2000)
    f = values(subject_of(model, **parameters), L, E)
    np.testing.assert_allclose(equation(L, E), irradiance * f * L[:, 2], rtol=1e-9, atol=1e-250)


def test_phong_is_the_model_where_it_is_not_negative() -> None:
    L, E = equations.hemisphere(1, 2000), equations.hemisphere(2, 2000)
    ahead = equations.dot(E, equations.reflection_vector(L)) > 0.0
    f = values(subject_of("phong_original", n=20, scale=1.0), L, E) * L[:, 2]
    np.testing.assert_allclose(equations.phong(20)(L, E)[ahead], f[ahead], rtol=1e-9, atol=1e-250)
    assert np.all(f[~ahead] == 0.0)


def test_fresnel_as_corrected_and_as_printed() -> None:
    """Snell's law and both polarisations, in 30 digits."""
    with mpmath.workdps(30):
        inside = mpmath.asin(mpmath.sin(1) / mpmath.mpf("1.5"))
        s = (mpmath.sin(1 - inside) / mpmath.sin(1 + inside)) ** 2
        p = (mpmath.tan(1 - inside) / mpmath.tan(1 + inside)) ** 2
        expected = float((s + p) / 2)
    assert float(equations.fresnel(1.5, float(np.cos(1.0)))) == pytest.approx(expected, rel=1e-13)
    g = np.sqrt(1.5**2 + 1.0) - 1.0
    assert float(equations.fresnel(1.5, 1.0, printed=True)) == pytest.approx(((g - 1) / (g + 1)) ** 2, rel=1e-13)


def test_reflected_integrates() -> None:
    """Lambert's share is exactly 1 under an irradiance pi, from everywhere; Phong's at normal incidence 2 / (n + 2)."""
    assert equations.reflected(equations.lambert, radians(70.0), pi) == pytest.approx(1.0, rel=1e-9)
    assert equations.reflected(equations.phong(20), 0.0, pi) == pytest.approx(2.0 / 22.0, rel=1e-9)


def test_names_and_places() -> None:
    assert len(STATEMENTS) == len(PAPER.statements)
    assert [name for name, count in Counter(figure.name for figure in PAPER.figures).items() if count > 1] == []
    for statement in PAPER.statements:
        assert statement.name == statement.name.lower().replace(" ", "_")
        assert statement.place
        assert statement.printed
        assert statement.asks.endswith(".")


@pytest.mark.parametrize("statement", [s for s in PAPER.statements if s.name not in SLOW], ids=lambda s: s.name)
def test_every_statement_has_a_verdict_with_its_evidence(statement: Statement) -> None:
    evidence = heard(statement.name)
    if evidence.verdict.kind is Kind.UNDECIDED:
        assert evidence.why
        return
    assert evidence.ours
    assert evidence.method
    assert evidence.again
    assert bool(evidence.why) == (evidence.verdict.kind is Kind.REFUTED)
    assert "nan" not in evidence.ours + evidence.again


@pytest.mark.parametrize("name", [e.statement for e in PAPER.errata if e.statement not in SLOW])
def test_errata_are_refuted_statements(name: str) -> None:
    assert heard(name).verdict.kind is Kind.REFUTED


def test_every_refuted_statement_is_an_erratum_or_its_consequence() -> None:
    """The formula of an erratum may fail in more than one way; nothing else is refuted."""
    consequences = {
        "fresnel_no_boundary",
        "cheap_fresnel_increases",
        "cheap_fresnel_at_most_one",
    }
    errata = {erratum.statement for erratum in PAPER.errata}
    refuted = {name for name in STATEMENTS if name not in SLOW and heard(name).verdict.kind is Kind.REFUTED}
    assert refuted - errata == consequences


def test_what_the_document_does_not_claim_is_not_refuted() -> None:
    """The figures are told, and why they do not convict; a convention that the document leaves open is read in its favour."""
    for name in ("phong_equation_reciprocal", "phong_equation_grazing", "ward_grazing", "phong_equation_negative"):
        assert heard(name).verdict.kind is Kind.UNDECIDED
        assert heard(name).ours
    for name in ("ct_distribution", "blinn_same_form", "blinn_energy"):
        assert heard(name).verdict.kind is Kind.HOLDS


def test_taste_is_left_undecided() -> None:
    assert TASTE
    assert {heard(name).verdict.kind for name in TASTE} == {Kind.UNDECIDED}
    assert heard("appendix_b").verdict.kind is Kind.UNDECIDED


def test_figures_of_the_errata() -> None:
    """The numbers that the errata speak of."""
    assert "0.011968" in heard("fresnel_glass").ours
    assert "0.785398" in heard("ct_distribution").ours
    assert "0.141421" in heard("ward_standard_deviation").ours
    assert "0.50" in heard("minnaert_equation_lambert").ours


def test_causes_are_argued() -> None:
    for erratum in PAPER.errata:
        assert erratum.printed != erratum.correct
        assert erratum.how
        if erratum.cause is not Cause.FALSE:
            assert erratum.why_cause


def test_the_same_seed_gives_the_same_words() -> None:
    for name in ("ct_lambertian_facets", "minnaert_equation_reciprocal", "ward_standard_deviation"):
        assert STATEMENTS[name].trial(MEANS) == heard(name)
