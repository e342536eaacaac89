"""Commands that write tables: for a renderer, with what they are worth, and for whatever reads measured surfaces."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from albedo_lab.cli.options import (
    CELLS,
    FILE_FORMAT,
    LAYOUT,
    MODEL,
    PARAMETERS,
    QUANTITY,
    TABLE,
    assigned,
    bound,
    given,
    model_named,
    real,
    reals,
    report_file,
    table_or_model,
    unmistaken,
    whole,
    writable,
)
from albedo_lab.cli.output import emit, progress_bar
from albedo_lab.errors import BadInput, Inconclusive
from albedo_lab.model import Model
from albedo_lab.report.formats import format_table

if TYPE_CHECKING:
    import pandas as pd


@click.command()
@click.argument("model", required=False, callback=model_named)
@TABLE
@QUANTITY
@FILE_FORMAT
@click.option("--dtype", type=click.Choice(["float32", "float64"]), help="[default: that of the format]")
@click.option("--decimals", type=whole, metavar="N", help="Of numbers in text. [default: all that tell a number from the next]")
@click.option("--name", metavar="NAME", help="Of the array. [default: of the model and the quantity]")
@click.option("--no-mean", "mean", flag_value=False, default=None, help="Without the mean albedos beside the directional ones.")
@CELLS
@click.option("--order", type=click.Choice(["wi", "wo"]), help="Of integration, where the model is not reciprocal. [default: wi]")
@click.option("--points", type=click.IntRange(0), metavar="N", help="To try interpolation at. [default: what a second allows]")
@click.option("--advise", "most", type=real, metavar="BOUND", help="Write nothing; find the smallest table that errs no more.")
@click.option("--norm", type=click.Choice(["largest", "rms"]), help="The error that --advise bounds. [default: largest]")
@click.option("--force", is_flag=True, default=None, help="Write over files that exist.")
@click.option("-o", "--output", metavar="FILE", callback=report_file, help="Written whole, or not at all; its record beside it.")
def export(model: Model | None, parameters: dict[str, Any], most: Any, output: Path | None, **options: Any) -> None:
    """A table for a renderer. One to three axes, every cell with a proven error, and a record that says what it is.

    The record, FILE.meta.json, also holds what reading between the nodes adds to the error. A preset has its own MODEL.
    """
    options = given(options)
    if most is not None:
        if output is not None:
            raise BadInput("output", str(output), "is not written: --advise only tries tables")
        advice(model, parameters, most, options)
        return
    if output is None:
        raise BadInput("output", None, "must be given: the file to write")
    if "norm" in options:
        raise BadInput("norm", options["norm"], "belongs to --advise")
    from albedo_lab.lookup.export import export as write_table

    with progress_bar() as progress:
        frame = write_table(model, output, progress=progress, **options, **unmistaken(write_table, parameters))
    emit(format_table(three_digits(frame), "table"), None)


def advice(model: Model | None, parameters: dict[str, Any], most: Any, options: dict[str, Any]) -> None:
    """Prints the tables that were tried, the one advised first. Raises Inconclusive where none keeps within the error."""
    for name in options.keys() & {"dtype", "decimals", "format", "name", "mean", "force"}:
        raise BadInput(name, options[name], "is of no use to --advise, which writes nothing")
    if not isinstance(most, float):
        raise BadInput("advise", most, "must be a number")
    from albedo_lab.lookup.advice import advise
    from albedo_lab.lookup.request import requested

    own = {name: options.pop(name) for name in ("norm", "points") if name in options}
    source, axes = requested(model, parameters, **options)
    with progress_bar() as progress:
        frame = advise(source, axes, most, seed=source.want.seed, progress=progress, **own)
    told = frame.drop(columns=frame.filter(regex="_mapping$|_nodes$"))  # the first column says the same
    emit(format_table(three_digits(told), "table"), None)
    if not frame.advised.any():
        raise Inconclusive(f"advise = {most:g}: none of the tables tried errs so little; the first comes nearest")


@click.command()
@click.argument("table", metavar="[MODEL|FILE]", required=False, callback=table_or_model)
@TABLE
@CELLS
@click.option("--mu", type=reals, metavar="A,B,..", help="Cosines of the viewer. [default: 15 from 1 to 0.001]")
@click.option("--F0", "F0", type=reals, metavar="A,B,..", help="Reflectances at normal incidence; 1 is white. [default: 1,0.5]")
@click.option(
    "--at",
    "values",
    multiple=True,
    callback=assigned,
    metavar="NAME=VALUE[,VALUE...]",
    help="Of a parameter along an axis. [default: sixteen, most of them between nodes]",
)
@click.option("--largest", is_flag=True, help="Of all directions only the residual farthest from 0.")
@LAYOUT
def compensate(
    table: Path | Model | None,
    parameters: dict[str, Any],
    kind: str,
    output: Path | None,
    largest: bool,
    mu: list[Any] | None,
    F0: list[Any] | None,
    values: dict[str, list[Any]],
    **options: Any,
) -> None:
    """Energy compensation from a table. What Kulla and Conty's term and Turquin's leave of 1, and how far they are reciprocal.

    The table is that in FILE, with its record beside it, or the one of MODEL that `export` would write. It is read as a renderer
    reads it; beside that stands what exact albedos give.
    """
    from albedo_lab.lookup.compensation import compensation, compensation_of, largest_residuals
    from albedo_lab.lookup.reading import read_tables
    from albedo_lab.lookup.request import refuse_nodes, requested

    options, points = given(options), given({"mu": mu, "F0": F0}) | {"values": values}
    with progress_bar() as progress:
        if isinstance(table, Path):
            for name, value in {**parameters, **options}.items():
                if value != () and (name, value) != ("seed", 0):
                    raise BadInput(name, value, f"cannot be given: the record of {table.name} says it")
            frame = compensation(*read_tables(table)[:2], progress=progress, **points)
        else:
            source, axes = requested(table, parameters, **options)
            refuse_nodes(source, axes)
            frame = compensation_of(source, axes, progress=progress, **points)
    frame = largest_residuals(frame) if largest else frame
    emit(format_table(frame if kind in ("csv", "json") else three_digits(frame), kind), output)


def three_digits(frame: pd.DataFrame) -> pd.DataFrame:
    """The table for a person: of an error, and of where it is, nobody needs more."""
    return frame.map(lambda value: float(f"{value:.3g}") if isinstance(value, float) else value)


@click.command()
@MODEL
@PARAMETERS
@click.option(
    "-o", "--output", required=True, metavar="FILE", callback=writable, help="A .binary file; written whole or not at all."
)
def tabulate(model: Model, parameters: dict[str, list[Any]], output: Path | None) -> None:
    """A model as a table. Writes a file of the MERL format, for whatever reads measured surfaces.

    Three values of one parameter stand for red, green and blue.
    """
    from albedo_lab.analysis.tabulate import tabulate as write_table

    if output is None:
        raise BadInput("output", "-", "must be a file: a table is 35 MB of binary numbers")
    bound(model, parameters)
    with progress_bar() as progress:
        frame = write_table(model, output, progress=progress, **parameters)
    emit(format_table(frame, "table"), None)
