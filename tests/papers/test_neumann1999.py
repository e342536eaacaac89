"""The paper's cells against the models' constants, closed forms that share no code with the engine, and the committed reports."""

import csv
import math
from pathlib import Path

import pytest

from albedo_lab.models import blinn, modified_ward, schlick_isotropic, stretched_blinn
from albedo_lab.papers.audit import Means, examine, trace
from albedo_lab.papers.neumann1999 import PAPER, equation_26
from albedo_lab.papers.verdict import Kind
from tests.oracles.mean import mean_closed_form, wallis

REPORTS = Path(__file__).parents[2] / "reports" / PAPER.name
TABLES = {table.name: table for table in PAPER.tables}
QUADRATURE = Means(1e-8, "quadrature")


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
    (plot,) = (p for p in PAPER.plots if p.name == "figure_3")
    data = trace(plot, threads=1)
    for curve in plot.curves:
        last = data[data.curve == curve.label].iloc[-1]
        assert last.albedo == pytest.approx(curve.limit, abs=1e-5)


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
