"""The command that judges: plausibility, check by check."""

from __future__ import annotations

import os
import shutil
import sys
from pathlib import Path
from typing import Any

import click

from albedo_lab.cli.options import PARAMETERS, SEED, THREADS, probability, real, report_file, whole, words, writable
from albedo_lab.cli.output import emit, progress_bar
from albedo_lab.errors import BadInput
from albedo_lab.files import write_whole
from albedo_lab.report.formats import format_table


@click.command()
@click.argument("models", nargs=-1, metavar="[MODEL]...")
@click.option("--all", "whole_catalogue", is_flag=True, help="Every model of the catalogue that needs no file.")
@PARAMETERS
@click.option(
    "--only",
    callback=words,
    metavar="A,B,..",
    help="Of finiteness, positivity, energy, reciprocity, grazing, sampler, claims, quality.",
)
@click.option("--skip", callback=words, metavar="A,B,..", help="Of the same.")
@click.option(
    "--alpha",
    "level",
    type=real,
    default=0.01,
    show_default=True,
    callback=probability,
    metavar="P",
    help="Probability that the run accuses a sound model.",
)
@click.option("--budget", type=whole, metavar="N", help="Evaluations that one check may cost. [default: 2^24]")
@click.option("--excess", type=real, default=1e-5, show_default=True, metavar="E", help="Forgiven above an albedo of 1.")
@SEED
@THREADS
@click.option("--json", "as_json", is_flag=True, help="A list of records instead of the table.")
@click.option("--junit", metavar="FILE", callback=report_file, help="JUnit XML as well, for a build server.")
@click.option("-o", "--output", metavar="FILE", callback=writable, help="Written whole, or not at all; - is standard output.")
def check(
    models: tuple[str, ...],
    whole_catalogue: bool,
    parameters: dict[str, list[Any]],
    as_json: bool,
    junit: Path | None,
    output: Path | None,
    **options: Any,
) -> int:
    """Plausibility. Energy, reciprocity, sampler and the rest, each with a verdict, and a witness where it convicts.

    Exit status: 0 plausible, 1 a check failed, 2 bad input, 3 inconclusive within the budget.
    """
    if bool(models) == whole_catalogue:
        raise BadInput("model", " ".join(models), "give the names of models, or --all")
    if junit is not None and junit == output:
        raise BadInput("junit", str(junit), "must be another file than the output")
    from albedo_lab.analysis.check import everyone, findings_table, run, short, status
    from albedo_lab.report.findings import findings_text
    from albedo_lab.report.junit import Case, junit_xml

    with progress_bar() as progress:
        told = run(models or everyone(), parameters, progress=progress, **options)
    cases = [Case(subject.model.name, short(subject, parameters), finding) for subject, finding in told]
    terminal = output is None and sys.stdout.isatty()
    if as_json:
        text = format_table(findings_table(told), "json")
    else:
        columns = shutil.get_terminal_size().columns if terminal else None
        text = findings_text(cases, terminal and not os.environ.get("NO_COLOR"), columns)
    if junit is not None:
        write_whole(junit, junit_xml(cases))
    emit(text, output)
    return status([finding for _, finding in told])
