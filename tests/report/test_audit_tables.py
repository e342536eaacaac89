import csv
import io
import math

import pytest

from albedo_lab.digits import with_error
from albedo_lab.estimate.record import bounded, exact
from albedo_lab.papers.neumann1999 import PAPER
from albedo_lab.papers.record import Cell, Finding, Table
from albedo_lab.papers.verdict import Printed, judge
from albedo_lab.report.audit_tables import as_printed, csv_table, latex_table, markdown_table, place


def finding(text="0.350", value=0.3516, model="stretched_blinn", **parameters):
    c = Cell("constant", model, parameters or {"n": 1}, Printed(text), lambda means: ours)
    ours = bounded(value, 1e-9, 10, "quadrature")
    return Finding(c, ours, {"rqmc": bounded(value, 1e-5, 99, "rqmc")}, judge(c.printed, ours))


TABLE = Table("t", "Constants & co, 100 %: C_n", "§1, a_b", ())


@pytest.mark.parametrize(
    ("value", "bound", "finest", "text"),
    [
        (5.33417739, 1e-10, 1e-5, "5.33418 ± 0.00001"),
        (0.6481, 0.00035, 0.0, "0.6481 ± 0.0004"),
        (20.611186829, 1e-6, 1e-4, "20.6112 ± 0.0001"),
        (2 / 3, 0.0, 0.0, "2/3"),
        (1.0, 0.0, 0.0, "1"),
        (12.905764396873401, 0.0, 0.0, "12.90576"),
    ],
)
def test_figures_show_the_digits_that_their_error_leaves(value, bound, finest, text):
    assert with_error(bounded(value, bound, 1, "test") if bound else exact(value), finest) == text


def test_what_is_shown_holds_the_whole_interval():
    for i in range(200):
        e = bounded(math.sin(i) + 2.0, 10.0 ** -(i % 9) * (0.05 + (i % 7) / 7), 1, "test")
        value, half_width = map(float, with_error(e).split(" ± "))
        assert value - half_width <= e.low + 1e-15
        assert value + half_width >= e.high - 1e-15


def test_places_read_like_the_paper():
    assert place(finding(n=math.inf).cell) == "n → ∞"
    assert place(finding(m=0.1, theta_deg=89.9995).cell) == "m = 0.1, θ = 89.9995°"
    assert as_printed("7.8e-3") == "7.8·10⁻³"


def test_csv_keeps_every_digit_and_the_second_way():
    (row,) = csv.DictReader(io.StringIO(csv_table([finding(value=0.3516000000000001)])))
    assert row["ours"] == "0.3516000000000001"
    assert (row["printed"], row["verdict"]) == ("0.350", "off by 2 units in the last digit")
    assert (row["again_method"], row["units_off"]) == ("rqmc", "2")


def test_markdown_shows_doubted_cells_once_more():
    assert "By another way" in markdown_table(TABLE, [finding()])
    assert "By another way" not in markdown_table(TABLE, [finding(value=0.35)])


def test_latex_is_escaped_and_ascii():
    text = latex_table("t", TABLE, [finding(m=0.1, theta_deg=89.0), finding("7.8e-3", 0.0078, n=math.inf)])
    assert text.isascii()
    assert r"stretched\_blinn" in text
    assert r"\caption{Constants \& co, 100 \%: C\_n (\S1, a\_b)" in text
    assert r"n $\to$ $\infty$" in text
    for command in (r"\toprule", r"\midrule", r"\bottomrule", r"\end{tabular}", r"\end{table}"):
        assert text.count(command) == 1


def test_latex_of_every_table_is_ascii():
    for table in PAPER.tables:
        ours = bounded(1.0, 1e-9, 1, "quadrature")
        found = [Finding(c, ours, {"rqmc": ours}, judge(Printed("1.0"), ours)) for c in table.cells]
        assert latex_table(table.name, table, found).isascii()
