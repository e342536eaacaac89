"""The command that judges a table of anybody's: what it holds, and what is wrong with it."""

from __future__ import annotations

import json
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from albedo_lab.cli.options import (
    FILE_FORMAT,
    QUANTITY,
    TABLE,
    THREADS,
    given,
    model_named,
    picture_file,
    real,
    sizes,
    suffix,
    unmistaken,
    writable,
)
from albedo_lab.cli.output import emit, progress_bar
from albedo_lab.errors import BadInput, Inconclusive
from albedo_lab.files import write_whole

if TYPE_CHECKING:
    from albedo_lab.lookup.audit import Audit


@click.command()
@click.argument("file", type=click.Path(path_type=Path))
@FILE_FORMAT
@click.option("--shape", type=sizes, metavar="N[xN]...", help="Of an array whose file does not tell it, the slowest axis first.")
@click.option(
    "--array",
    metavar="NAME",
    help="Which array of the file, or its number from 0. [default: all that the preset or the record names, else the first]",
)
@click.option("--model", callback=model_named, metavar="MODEL", help="Said to be in the table; as is what follows.")
@TABLE
@QUANTITY
@click.option("--tolerance", type=real, metavar="T", help="What a cell may be off, beyond its rounding. [default: 1e-4]")
@THREADS
@click.option(
    "--plot",
    callback=picture_file,
    metavar="FILE",
    help="A map of the deviations, of the first array; ends in .svg, .png or .pdf.",
)
@click.option("--json", "as_json", is_flag=True, help="A record instead of the text.")
@click.option("-o", "--output", metavar="FILE", callback=writable, help="Written whole, or not at all; - is standard output.")
def audit(file: Path, parameters: dict[str, Any], plot: Path | None, as_json: bool, output: Path | None, **options: Any) -> int:
    """The audit of a table. Which model and variant FILE holds, in which layout, how far it is off, and its defects.

    What it is said to hold are the options, else the record beside it, FILE.meta.json. Where nothing is said, a layout is a fact,
    and only what no convention has is a defect.

    Exit status: 0 sound, 1 defects, 2 bad input, 3 undecided or unknown.
    """
    for name, path in (("output", output), ("plot", plot)):
        if path is not None and path in (file.resolve(), output if name == "plot" else None):
            raise BadInput(name, str(path), "must be a file of its own")
    from albedo_lab.lookup.audit import audit as question

    with progress_bar() as progress:
        found = question(file, progress=progress, **given(options), **unmistaken(question, parameters))
    text = json.dumps(found.as_dict(), indent=2, ensure_ascii=False, allow_nan=False) + "\n" if as_json else found.text()
    if plot is not None:
        draw(found, plot)
    emit(text, output)
    return int(found.status)


def draw(found: Audit, plot: Path) -> None:
    """Writes a map of how far the table is from the hypothesis that comes nearest."""
    from albedo_lab.lookup.audit.judge import described
    from albedo_lab.pictures.deviations import Deviations
    from albedo_lab.report.drawing import render

    fit = found.judgement.fit
    if fit is None:
        raise Inconclusive(f"plot = {plot.name}: nothing explains {found.array}, so there is nothing to compare it with")
    title = f"{Path(found.file).name}, {found.array}: deviation from {described(fit.hypothesis)}"
    channels = tuple(name for name, _, _ in fit.hypothesis.form.channels)
    forgiven = found.rounding + found.judgement.observed.tolerance
    picture = Deviations(title, fit.hypothesis.axes, channels, found.values, found.truth, forgiven)
    form = suffix(plot)
    write_whole(plot, render(picture, picture.trace(), (form,))[form])
