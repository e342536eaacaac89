"""What a document prints, where, and how each statement is put on trial: the vocabulary of this room."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from enum import StrEnum

from albedo_lab.estimate.record import Estimate
from albedo_lab.papers.recipes import Means, Recipe
from albedo_lab.papers.verdict import Printed, Verdict
from albedo_lab.pictures import Picture


@dataclass(frozen=True)
class Cell:
    """A printed figure: its quantity, its model and at which parameters (an angle among them); and how to recompute it.

    `again` recomputes it in other ways, for the reader who doubts the first; by default the same recipe by rqmc.
    """

    quantity: str
    model: str
    parameters: Mapping[str, float]
    printed: Printed
    recipe: Recipe
    again: Mapping[str, Recipe] = field(default_factory=dict)


@dataclass(frozen=True)
class Table:
    """Cells that stand together. `note` is Markdown: what a reader must know beyond the cells."""

    name: str
    title: str
    place: str
    cells: tuple[Cell, ...]
    note: str = ""


@dataclass(frozen=True, slots=True)
class Evidence:
    """What a trial found.

    ours
        Our value with its error, in words short enough for a cell of a table: "s = -0.5000000 ± 0.0000001".
    method
        By which that was found.
    again
        What a second method, which shares as little as can be with the first, finds; and which method that is.
    why
        In one or two sentences: what refutes a statement, or why it cannot be decided. Empty where the figures speak.
    """

    verdict: Verdict
    ours: str
    method: str
    again: str
    why: str = ""


Trial = Callable[[Means], Evidence]


@dataclass(frozen=True)
class Statement:
    """A sentence, formula or table entry that can be put on trial.

    name
        Unique in its document, lower case with underscores: the anchor of links to it.
    place
        "§2.2, after eq. 6".
    printed
        What the document says, in its own words or symbols (Unicode, no LaTeX); the OCR's damage left as it is where it matters.
    asks
        The proposition on trial, as precisely as it can be put; which parameters are tried, where the document names none.
    models
        Names of the catalogue that it is about.
    topic
        What several documents speak of, and what has a page of its own therefore, over all documents; empty for most.
    """

    name: str
    place: str
    printed: str
    asks: str
    trial: Trial
    models: tuple[str, ...] = ()
    topic: str = ""


GRAZING = "grazing laws"


class Cause(StrEnum):
    """Where an error comes from, as far as it can be told."""

    MISPRINT = "misprint"
    FALSE = "false statement"
    ROUNDING = "rounding"
    OCR = "damage by OCR"
    UNKNOWN = "misprint or damage by OCR, undecided"


@dataclass(frozen=True)
class Erratum:
    """An error of the document; `statement` is the name of the statement, or of the table, whose evidence gives the numbers.

    `why_cause` says how misprint and damage by OCR were told apart (a dimension, a limit, a later equation with the right form).
    """

    statement: str
    place: str
    printed: str
    correct: str
    how: str
    cause: Cause
    why_cause: str = ""


@dataclass(frozen=True)
class Figure:
    """A picture for a figure of the document; `caption` says what is the same and what is not."""

    name: str
    title: str
    place: str
    caption: str
    picture: Picture


@dataclass(frozen=True)
class Paper:
    """A document on trial. `note` is Markdown: what the trial found."""

    name: str
    citation: str
    note: str
    tables: tuple[Table, ...] = ()
    statements: tuple[Statement, ...] = ()
    errata: tuple[Erratum, ...] = ()
    figures: tuple[Figure, ...] = ()


@dataclass(frozen=True)
class Finding:
    """A cell with our figure, the same figure by other ways, and the verdict."""

    cell: Cell
    ours: Estimate
    again: Mapping[str, Estimate]
    verdict: Verdict
