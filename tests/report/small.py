"""A document that nobody wrote, with every kind of verdict, and text that every format must escape."""

from albedo_lab.estimate.record import bounded
from albedo_lab.papers.record import Cause, Cell, Erratum, Evidence, Figure, Paper, Statement, Table
from albedo_lab.papers.trials import holds, undecided
from albedo_lab.papers.verdict import Kind, Printed, Verdict
from albedo_lab.pictures.functions import Function, Functions

NASTY = '[a_b] <script>alert("1")</script> | 5 % & x^2·10⁻³ ≥ α {}~\\ *c* `d`'


def recipe(value, bound=1e-9):
    """Finds always the same."""
    return lambda means: bounded(value, bound, 10, means.method)


def found(verdict, ours="0.5 ± 0.1", again="0.50 ± 0.02 (rqmc)", why=""):
    """Hears always the same."""
    return lambda means: Evidence(verdict, ours, "quadrature", again, why)


CELLS = (
    Cell("albedo", "phong", {"n": 1.0}, Printed("0.350"), recipe(0.3501)),
    Cell("albedo", "phong", {"n": 2.0}, Printed("0.368"), recipe(0.3638)),
    Cell("overshoot", "ward", {"m": 0.1, "theta_deg": 89.5}, Printed("7.8e-3"), recipe(0.5)),
)
STATEMENTS = (
    Statement("nasty", "§1, eq. 2", NASTY, "Is it *so*, with `n` < 2?", found(holds(False), why="because α < β"), ("phong",)),
    Statement("sound", "§2", "a → 1", "limit", found(holds(True)), ("phong", "ward")),
    Statement("slip", "§3", "0.3", "number", found(Verdict(Kind.OFF, 2))),
    Statement("open", "§4", "it looks good", "taste", undecided("A matter of taste.")),
)
ERRATA = (
    Erratum("nasty", "eq. 2", NASTY, "x ≤ 2", "By `albedo-lab check`.", Cause.MISPRINT, "Its dimension is wrong."),
    Erratum("table_1", "table 1", "0.368", "0.364", "Recomputed.", Cause.UNKNOWN),
)
FIGURE = Figure(
    "figure_1",
    "A parabola & its <axis>",
    "figure 1",
    "What *rises*.",
    Functions((Function("x²", lambda x: x * x),), (0.0, 1.0), "x", "y", points=11),
)
PAPER = Paper(
    "small",
    "A. Nobody: Nothing & more, 1999",
    "It has **four** verdicts.",
    (Table("table_1", "Constants & co, 100 %: C_n", "table 1", CELLS, "See `table 1`."),),
    STATEMENTS,
    ERRATA,
    (FIGURE,),
)
