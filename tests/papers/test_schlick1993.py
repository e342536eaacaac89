"""The document's statements, and the equations as they are written down for it, against the models and closed forms."""

from __future__ import annotations

import dataclasses
import math

import numpy as np
import pytest

from albedo_lab.papers.examine import examine, hear
from albedo_lab.papers.recipes import Means
from albedo_lab.papers.schlick1993 import PAPER, approximations, earlier, factors, formulas
from albedo_lab.papers.schlick1993.formulas import DIRECTIONAL, Cosines, albedo, at, directions, exact_fresnel, halves, pairs
from albedo_lab.papers.trials import subject_of
from albedo_lab.papers.verdict import Kind
from albedo_lab.pictures.evaluation import values

MEANS = Means(1e-8, "quadrature")
STATEMENTS = {statement.name: statement for statement in PAPER.statements}
REFUTED = {
    *("notation_w", "eq_4_diffuse", "eq_4_specular", "kajiya", "references"),
    *("eq_7_smith", "eq_7_slope", "eq_8_fraction", "eq_8_rms", "ward_energy"),
    *("r_rms_slope", "p_ratio", "r_1_diffuse_eq18", "p_0_dirac", "eq_9_energy"),
    *("eq_13_sufficient", "eq_13_root", "eq_14_A", "eq_17_interpolation", "eq_18_reemission"),
    *("energy_eq12_single", "energy_eq15_single", "energy_eq17_single", "energy_eq18_single"),
    *("energy_eq12_double", "energy_eq15_double", "energy_eq17_double", "energy_eq18_double"),
    *("inconsistent_avoided", "microfacet_theory", "continuum"),
    *("grazing_eq8", "grazing_eq12_single", "grazing_eq17_single", "grazing_eq12_double", "grazing_eq17_double"),
}
UNDECIDED = {
    *("theoretical_needlessly_accurate", "eq_2", "eq_4_brightness", "first_theoretical_model", "he_phenomena"),
    *("homogeneous_continuum", "theoretical_accurate", "intuitive", "measurable", "figure_8_r", "Z_beckmann", "A_ellipse"),
    *("C_reflectivity", "r_1_diffuse_eq12", "eq_11_dielectrics", "eq_11_aluminium", "eq_16_smith", "one_r_for_both"),
}


def verdict(name: str) -> Kind:
    return STATEMENTS[name].trial(MEANS).verdict.kind


@pytest.fixture(scope="module")
def heard():
    """All but those of two layers, whose kernels are another dozen, and of reciprocity, which the models' tests try as well."""
    some = [s for s in PAPER.statements if not s.name.endswith("_double") and not s.name.startswith("reciprocity")]
    return {statement.name: evidence for statement, evidence in hear(some)}


def test_every_verdict_is_the_one_that_was_argued(heard):
    kinds = {name: evidence.verdict.kind for name, evidence in heard.items()}
    assert {name for name, kind in kinds.items() if kind is Kind.REFUTED} == REFUTED & set(kinds)
    assert {name for name, kind in kinds.items() if kind is Kind.UNDECIDED} == UNDECIDED
    assert set(kinds.values()) == {Kind.HOLDS, Kind.REFUTED, Kind.UNDECIDED}


def test_evidence_says_what_was_found_and_why_it_refutes(heard):
    for name, evidence in heard.items():
        assert evidence.ours
        assert evidence.again
        assert bool(evidence.why) == (evidence.verdict.kind is not Kind.HOLDS), name


def test_two_layers_are_tried_like_one():
    assert verdict("reciprocity_eq18_double") is Kind.HOLDS
    assert verdict("energy_eq15_double") is Kind.REFUTED
    assert verdict("grazing_eq17_double") is Kind.REFUTED


def test_names_are_unique_and_every_erratum_rests_on_a_refuted_statement():
    assert len(STATEMENTS) == len(PAPER.statements)
    assert set(STATEMENTS) >= REFUTED | UNDECIDED
    assert {erratum.statement for erratum in PAPER.errata} <= REFUTED
    names = [
        item.name for item in (*PAPER.statements, *PAPER.tables, *PAPER.figures) if item.name not in ("figure_7", "figure_8")
    ]
    assert len(set(names)) == len(names)


def test_there_is_a_law_at_grazing_incidence_for_every_formulation():
    of = {f"grazing_eq{k}_{layers}" for k in (12, 15, 17, 18) for layers in ("single", "double")}
    assert of | {"grazing_eq4", "grazing_eq4_printed", "grazing_eq5", "grazing_eq5_printed", "grazing_eq8"} <= set(STATEMENTS)


def test_an_exponent_stands_beside_the_claim(heard):
    assert "s = -1.000000 ±" in heard["grazing_eq12_single"].ours
    assert "s = -0.500000 ±" in heard["grazing_eq8"].ours
    assert "a → 1.899553 ±" in heard["grazing_eq18_single"].ours


# the equations


def cosines(wi, wo):
    """From directions, without what `at` does about lost digits."""
    h = wi + wo
    norm = np.linalg.norm(h, axis=-1)
    w = h[:, 0] / np.hypot(h[:, 0], h[:, 1])
    return Cosines(h[:, 2] / norm, 0.5 * norm, wo[:, 2], wi[:, 2], w)


@pytest.mark.parametrize("name", DIRECTIONAL)
@pytest.mark.parametrize(("r", "p"), [(0.05, 1.0), (0.3, 0.2), (1.0, 0.5)])
def test_the_printed_equations_are_the_model_as_printed(name, r, p):
    wi, wo = directions(1, 500), directions(2, 500)
    model = values(subject_of("schlick", directional=name, r=r, p=p, as_printed="yes"), wi, wo)
    assert np.allclose(DIRECTIONAL[name](r, p)(cosines(wi, wo)), model, rtol=1e-9)


def test_cosines_at_a_turn_are_those_of_directions():
    v, phi, v_, turn = np.random.default_rng(3).random((4, 300))
    phi, turn = 2.0 * np.pi * phi, 2.0 * np.pi * turn - np.pi

    def direction(z, azimuth):
        s = np.sqrt(1.0 - z * z)
        return np.stack([s * np.cos(azimuth), s * np.sin(azimuth), z], axis=-1)

    expected = cosines(direction(v_, phi + np.pi + turn), direction(v, phi))
    for ours, other in zip(at(v, phi, v_, turn), expected, strict=True):
        assert np.allclose(ours, other, atol=1e-7)


def test_random_pairs_lie_above_the_surface():
    c = pairs(0, 1000)
    assert all(column.shape == (1000,) for column in c)
    assert np.allclose(c.t, (c.v + c.v_) / (2.0 * c.u))
    H = halves(directions(0, 9), directions(1, 9))
    assert np.allclose(np.linalg.norm(H, axis=-1), 1.0)


@pytest.mark.parametrize("r", [0.01, 0.2, 1.0])
def test_plain_integration_against_closed_forms(r):
    normal, grazing = albedo(DIRECTIONAL["eq12"](r), 1.0), albedo(DIRECTIONAL["eq12"](r), 1e-9)
    assert abs(normal.value - 1.0 / (1.0 + r)) <= normal.half_width + 1e-12
    assert grazing.value == pytest.approx(math.sqrt(r) / 2e-9, rel=1e-6)
    both = [albedo(DIRECTIONAL[name](r), 1e-9).value for name in ("eq15", "eq18")]
    assert both[1] - both[0] == pytest.approx(1.0, abs=1e-6)


def test_plain_integration_of_lambert_and_of_eq_15_with_r_1():
    assert albedo(lambda c: np.full_like(c.t, 1.0 / math.pi), 0.3).value == pytest.approx(1.0, abs=1e-10)
    assert albedo(DIRECTIONAL["eq15"](1.0), 0.01).value == pytest.approx(0.25, abs=1e-10)


def test_fresnel_at_its_ends_and_at_brewster():
    assert exact_fresnel(1.5, np.array([0.0, 1.0])) == pytest.approx([1.0, 0.04])
    brewster = np.array([math.cos(math.atan(1.5))])
    s = ((1.0 - 1.5**2) / (1.0 + 1.5**2)) ** 2
    assert exact_fresnel(1.5, brewster) == pytest.approx([0.5 * s])
    k = np.array([0.1, 0.7])
    assert exact_fresnel(0.5 + 3j, k) == pytest.approx(exact_fresnel(0.5 - 3j, k))


def test_best_parameters_are_better_than_their_neighbours():
    rho, error = approximations.best_rho()
    assert error < min(approximations.survival_error(rho * k) for k in (0.98, 1.02))
    r, error = approximations.best_r(0.3, remainder=False)
    v = approximations.COSINES
    exact = formulas.smith(0.3, v)
    assert error < min(approximations.largest_error(formulas.G(r * k, v), exact) for k in (0.98, 1.02))


# the table and the figures


def test_the_table_refutes_A_alone():
    found = list(examine(PAPER.tables[0].cells))
    agrees = {(f.cell.quantity, *f.cell.parameters.values()) for f in found if f.verdict.kind is Kind.AGREES}
    assert agrees == {("zenith condition", r) for r in factors.ROUGHNESSES} | {("azimuth condition", 1.0)}
    for finding in found:
        (again,) = finding.again.values()
        assert again.value == pytest.approx(finding.ours.value, abs=1e-8)


def test_figures_of_functions_are_traced_above_0():
    drawn = [figure for figure in PAPER.figures if type(figure.picture).__name__ == "Functions"]
    assert len(drawn) >= 8
    for figure in drawn:
        table = figure.picture.trace()[""]
        assert np.isfinite(table.value).all()
        assert table.value.min() >= 0.0


# negative controls: a formula that is right is not refuted, one that is wrong does not hold


def test_A_without_its_root_would_hold(monkeypatch):
    monkeypatch.setattr(factors, "A", lambda p, w: p / (p**2 - p**2 * w**2 + w**2))
    assert verdict("eq_14_A") is Kind.HOLDS


def test_smiths_own_factor_would_hold(monkeypatch):
    monkeypatch.setattr(earlier, "gap_of_smith", lambda x: 0.0 * x)
    assert verdict("eq_7_smith") is Kind.HOLDS


def test_a_Z_that_is_not_normalised_would_be_refuted(monkeypatch):
    monkeypatch.setattr(factors, "Z", lambda r, t: 1.01 * formulas.Z(r, t))
    assert verdict("eq_14_Z") is Kind.REFUTED


def test_ward_over_t_to_the_fourth_would_hold(monkeypatch):
    monkeypatch.setattr(earlier, "ward_slope", lambda m, n, t, w: formulas.ward_slope(m, n, t, w) / t**4)
    assert verdict("eq_8_fraction") is Kind.HOLDS


def test_statements_are_what_a_reader_needs():
    for statement in PAPER.statements:
        fields = dataclasses.asdict(dataclasses.replace(statement, trial=None))
        assert all(fields[name].strip() == fields[name] != "" for name in ("name", "place", "printed", "asks"))
        assert "\\" not in statement.printed + statement.asks
