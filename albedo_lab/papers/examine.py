"""Puts a document's figures and statements on trial, one after the other."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from albedo_lab.papers.recipes import Means
from albedo_lab.papers.record import Cell, Evidence, Finding, Statement
from albedo_lab.papers.verdict import judge

FINEST = 1e-8


def examine(cells: Sequence[Cell], seed: int = 0, threads: int | None = None) -> Iterator[Finding]:
    """Recomputes cell after cell and judges it.

    The judge is quadrature, whose interval is a bound: of some eighty 95 % intervals four miss their value.
    """
    for cell in cells:
        unit = float(cell.printed.resolution)
        judged = Means(min(FINEST, unit / 1000.0), "quadrature", seed, threads)
        doubted = Means(unit / 100.0, "rqmc", seed, threads)
        ours = cell.recipe(judged)
        again = {way: recipe(judged) for way, recipe in cell.again.items()} or {"rqmc": cell.recipe(doubted)}
        yield Finding(cell, ours, again, judge(cell.printed, ours))


def hear(statements: Sequence[Statement], seed: int = 0, threads: int | None = None) -> Iterator[tuple[Statement, Evidence]]:
    """Every statement with the evidence of its trial."""
    for statement in statements:
        yield statement, statement.trial(Means(FINEST, "quadrature", seed, threads))
