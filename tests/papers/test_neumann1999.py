"""The paper's cells against the models' constants, closed forms that share no code with the engine, and the committed reports."""

import csv
import math
from pathlib import Path

import numpy as np
import pytest

from albedo_lab.models import blinn, modified_ward, schlick_isotropic, stretched_blinn
from albedo_lab.papers.examine import examine, hear
from albedo_lab.papers.neumann1999 import PAPER, equations
from albedo_lab.papers.neumann1999.statements import efficiency, grazing, materials
from albedo_lab.papers.neumann1999.statements.introduction import peak
from albedo_lab.papers.neumann1999.tables import equation_26
from albedo_lab.papers.neumann1999.tried import albedo, exchanged, identical
from albedo_lab.papers.recipes import Means
from albedo_lab.papers.verdict import Kind
from tests.oracles.mean import mean_closed_form, wallis

REPORTS = Path(__file__).parents[2] / "reports" / PAPER.name
TABLES = {table.name: table for table in PAPER.tables}
QUADRATURE = Means(1e-8, "quadrature")


STATEMENTS = {statement.name: statement for statement in PAPER.statements}
DOUBTED = (Kind.REFUTED, Kind.OFF)


def found(name):
    """The verdict's kind and our words."""
    ((_, evidence),) = hear([STATEMENTS[name]])
    return evidence.verdict.kind, evidence.ours


def cell(table, model, at=None, **parameters):
    return next(c for c in TABLES[table].cells if c.model == model and all(c.parameters[k] == v for k, v in parameters.items()))


@pytest.mark.parametrize(
    ("table", "model", "constants"),
    [
        ("table_2", "blinn", blinn.TABLE_2),
        ("table_2", "stretched_blinn", stretched_blinn.TABLE_2),
        ("table_4", "modified_ward", modified_ward.TABLE_4),
        ("after_equation_36", "schlick_isotropic", schlick_isotropic.AFTER_EQUATION_36),
    ],
)
def test_the_print_is_the_same_here_and_in_the_models(table, model, constants):
    printed = {next(iter(c.parameters.values())): float(c.printed.value) for c in TABLES[table].cells if c.model == model}
    assert printed == constants


def test_every_printed_cell_is_there():
    sizes = {name: len(table.cells) for name, table in TABLES.items()}
    assert (sizes["table_2"], sizes["table_3"], sizes["table_4"], sizes["after_equation_36"]) == (20, 44, 7, 4)


def c_n(n):
    return (n + 2) / (2 * math.pi)


@pytest.mark.parametrize("n", [1, 4, 128])
def test_mean_albedos_against_closed_forms(n):
    for model in ("phong", "stretched_phong"):
        ours = cell("table_3", model, n=n).recipe(QUADRATURE)
        assert ours.low <= c_n(n) * mean_closed_form(model, n=n) <= ours.high
    for model in ("blinn", "stretched_blinn"):
        constant = cell("table_2", model, n=n).recipe(QUADRATURE)
        ours = cell("table_3", model, n=n).recipe(QUADRATURE)
        expected = constant.value * mean_closed_form(model, n=n)
        assert abs(ours.value - expected) <= ours.half_width + constant.half_width


def test_the_infinity_row_is_the_limit_of_the_closed_forms():
    n = 1e8
    largest = (n + 1) / (8 * math.pi)  # the limit of C_n that the note derives
    scales = {"phong": c_n(n), "stretched_phong": c_n(n), "blinn": largest, "stretched_blinn": largest}
    for model, scale in scales.items():
        limit = cell("table_3", model, n=math.inf).recipe(QUADRATURE)
        assert scale * mean_closed_form(model, n=n) == pytest.approx(limit.value, abs=2e-4)
        assert limit.half_width == 0.0


@pytest.mark.parametrize("model", ["phong", "stretched_phong", "blinn", "stretched_blinn"])
def test_rows_approach_the_infinity_row(model):
    infinity = cell("table_3", model, n=math.inf)
    limit = infinity.recipe(QUADRATURE).value
    gaps = [abs(recipe(QUADRATURE).value - limit) for recipe in infinity.again.values()]
    assert gaps[2] < gaps[0] / 50
    assert gaps[2] < 1e-4


def test_albedos_at_90_degrees_against_closed_forms():
    n = 128
    expected = {
        "blinn": 8 * math.pi / ((n + 2) * (n + 4)),
        "stretched_blinn": 8 * wallis(n) / (n + 2),
    }
    for model, shape in expected.items():
        ours = cell("section_6_1_1", model).recipe(QUADRATURE)
        constant = cell("table_2", model, n=n).recipe(QUADRATURE).value
        assert ours.low <= constant * shape <= ours.high


@pytest.mark.parametrize("n", [1, 2, 10, 100])
def test_equation_26_is_the_limit(n):
    ours = cell("equation_26", "stretched_phong", n=n).recipe(QUADRATURE)
    assert ours.low <= equation_26(n) <= ours.high
    assert ours.half_width < 1e-5


def test_a_tie_and_a_misprint_get_their_verdicts():
    tie, misprint = examine([cell("table_3", "phong", n=4), cell("table_2", "stretched_blinn", n=2)])
    assert tie.verdict.kind is Kind.AGREES
    assert str(misprint.verdict) == "off by 4 units in the last digit"


def test_curves_end_where_equation_26_says():
    (figure,) = (f for f in PAPER.figures if f.name == "figure_3")
    data = figure.picture.trace(threads=1)[""]
    for label, limit in figure.picture.limits.items():
        last = data[data.curve == label].iloc[-1]
        assert last.albedo == pytest.approx(limit, abs=1e-5)


def test_names_are_unique_and_errata_point_to_them():
    assert len(STATEMENTS) == len(PAPER.statements) >= 158
    assert {erratum.statement for erratum in PAPER.errata} <= STATEMENTS.keys() | TABLES.keys()
    assert len({figure.name for figure in PAPER.figures}) == len(PAPER.figures)


CHEAP = (
    "grazing_cook_torrance",
    "energy_balance_contracts",
    "blinn_follows_the_cosine",
    "table_1_off_specular_ward",
    "symmetric_function",
    "mirror_sees_itself",
    "peak_of_polished_metals",
    "equation_14",
    "mirrored_light",
    "efficiency_grows",
    "worst_at_zero",
    "smaller_angle_elsewhere",
    "largest_difference",
    "table_4_caption",
    "schlick_more_than_incoming",
)


@pytest.mark.parametrize("name", CHEAP)
def test_errata_are_found_again(name):
    assert name in {erratum.statement for erratum in PAPER.errata}
    assert found(name)[0] in DOUBTED


@pytest.mark.parametrize("name", ["point_light", "brdf_symmetric_about_mirror", "colour_fades_steadily"])
def test_what_a_fair_reading_leaves_open_is_not_refuted(name):
    assert found(name)[0] is Kind.UNDECIDED


SOUND = (
    "equation_21_at_normal",
    "plastic_energy",
    "equation_4",
    "equation_9",
    "equation_10",
    "equation_11",
    "equation_13",
    "equation_19",
    "equation_20",
    "equation_22",
    "equation_23",
    "equation_24",
    "equation_25",
    "equation_31",
    "equation_34",
    "equation_36",
    "rms_of_slope",
    "better_than_phong",
    "maximum_of_stretched",
)


@pytest.mark.parametrize("name", SOUND)
def test_what_holds_is_found_to_hold(name):
    assert found(name)[0] is Kind.HOLDS


def test_the_same_seed_tells_the_same():
    names = ("better_than_phong", "equation_25", "equation_10")
    statements = [STATEMENTS[name] for name in names]
    first, again, other = (list(hear(statements, seed)) for seed in (0, 0, 1))
    assert first == again
    assert [e.verdict for _, e in first] == [e.verdict for _, e in other]
    assert first != other


@pytest.mark.parametrize("wrong", [lambda L, V: equations.phong(20.0)(L, V) * L[:, 2], equations.phong(19.0)])
def test_a_wrong_formula_is_refuted(wrong):
    right = equations.phong(20.0)
    assert identical(right, right, "phong", n=20)(QUADRATURE).verdict.kind is Kind.HOLDS
    assert identical(wrong, right, "phong", n=20)(QUADRATURE).verdict.kind is Kind.REFUTED
    assert identical(wrong, wrong, "phong", n=20)(QUADRATURE).verdict.kind is Kind.REFUTED


def test_exchanging_tells_a_formula_that_is_not_reciprocal():
    def apart(f):
        return float(exchanged(f)(QUADRATURE).split()[3])

    assert apart(equations.ward(0.3)) < 1e-12
    assert apart(lambda L, V: equations.phong(20.0)(L, V) / L[:, 2]) > 0.9


@pytest.mark.parametrize(
    ("model", "f"), [("stretched_phong", equations.stretched(5.0)), ("stretched_blinn", equations.stretched_blinn(5.0))]
)
def test_the_product_rule_is_an_albedo(model, f):
    for angle in (0.0, 50.0, 80.0):
        assert equations.reflected(f, angle) == pytest.approx(albedo(model, angle, n=5, scale=1.0), rel=1e-5)


def test_efficiencies_against_closed_forms():
    n = 10.0
    assert efficiency.efficiency(0.0, exponent=n) == pytest.approx((n + 1) * (n + 3) / (n + 2) ** 2, rel=1e-4)
    # a lobe about the horizon: half of the weights are 0, the others are equal, or go like the height of a Gaussian for Phong
    for grazing_n in (1e2, 1e4):
        assert efficiency.efficiency(90.0 - 1e-7, exponent=grazing_n) == pytest.approx(0.5, rel=2e-3)
        assert efficiency.efficiency(90.0 - 1e-7, model="phong", exponent=grazing_n) == pytest.approx(1 / math.pi, rel=2e-2)


def test_the_angle_of_the_half_vector():
    L = equations.hemisphere(3, 1000)
    assert np.allclose(materials.half_angle(L, L), 0.0, atol=1e-5)
    assert np.allclose(materials.half_angle(L, equations.mirrored(L)), np.degrees(np.arccos(L[:, 2])), atol=1e-5)


def test_summits_in_closed_form():
    assert peak("stretched_phong", n=100) == pytest.approx(75.0, abs=0.011)
    tangent, m = math.tan(math.radians(75.0)), 0.03
    assert peak("ward", m=m) - 75.0 == pytest.approx(math.degrees(m * m * tangent), rel=0.1)
    assert peak("cook_torrance", m=m) - 75.0 == pytest.approx(2.0 * math.degrees(m * m * tangent), rel=0.1)


def test_every_model_of_the_paper_has_a_grazing_law():
    treated = {model for statement in PAPER.statements for model in statement.models}
    have = {model for statement in grazing.STATEMENTS for model in statement.models}
    assert treated - have == {"lambert", "mirror", "schlick"}


def committed(name):
    with (REPORTS / f"{name}.csv").open(encoding="utf-8", newline="") as stream:
        return list(csv.DictReader(stream))


@pytest.mark.parametrize("name", TABLES)
def test_committed_reports_hold_what_is_computed_now(name):
    rows = committed(name)
    assert len(rows) == len(TABLES[name].cells)
    for row, c in list(zip(rows, TABLES[name].cells, strict=True))[::4]:
        now = c.recipe(Means(1e-6, "quadrature"))
        assert row["printed"] == c.printed.text
        assert now.value == pytest.approx(float(row["ours"]), abs=1e-6 + now.half_width)


@pytest.mark.parametrize("name", TABLES)
def test_committed_second_ways_confirm_the_first(name):
    for row in committed(name):
        if row["again_method"] == "rqmc":
            half_width = float(row["again_ci95_high"]) - float(row["again"])
            bound = float(row["ci95_high"]) - float(row["ours"])
            assert abs(float(row["again"]) - float(row["ours"])) <= 3 * half_width + bound


def test_what_the_front_page_says_was_refuted_is_what_was():
    refuted = {(name, row["model"]) for name in TABLES for row in committed(name) if row["verdict"] == str(Kind.REFUTED)}
    assert refuted == {("table_3", "phong"), ("table_3", "stretched_blinn"), ("after_equation_36", "schlick_isotropic")}
