"""Commands that lay out for the eye: pictures of a model, and the audit of the papers."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import click

from albedo_lab.cli.options import MODEL, PARAMETERS, SEED, THREADS, bound, given, picture_file, reals, suffix, whole
from albedo_lab.cli.output import progress_bar
from albedo_lab.errors import BadInput
from albedo_lab.files import write_whole
from albedo_lab.model import Model

PICTURES = ("polar", "log-polar", "lobe", "albedo", "slice", "preview", "sampling")


@click.command()
@MODEL
@PARAMETERS
@click.option("--kind", type=click.Choice(PICTURES), default="polar", show_default=True)
@click.option("--theta-deg", type=reals, metavar="A,B,..", help="Where the light is, in degrees from the normal; for some kinds.")
@click.option("--quantity", type=click.Choice(["brdf", "radiance", "normalised"]), help="Of the polar kinds. [default: brdf]")
@click.option("--seed", type=whole, metavar="N", help="Of the kind sampling. [default: 0]")
@THREADS
@click.option("-o", "--output", required=True, metavar="FILE", callback=picture_file, help="Ends in .svg, .png or .pdf.")
def plot(
    model: Model,
    parameters: dict[str, list[Any]],
    kind: str,
    theta_deg: list[Any] | None,
    threads: int | None,
    output: Path,
    **options: Any,
) -> None:
    """A picture. Sections, lobes, albedo curves, slices, previews or samples, of all of a grid of parameters together."""
    from albedo_lab.analysis.request import effort
    from albedo_lab.pictures.kinds import asked
    from albedo_lab.report.drawing import render

    bound(model, parameters)
    options |= {"theta_deg": theta_deg and tuple(theta_deg)}
    chosen = given(options)
    effort(None, "rqmc", chosen.get("seed", 0), threads)  # refuses what is no seed and no number of threads
    picture = asked(kind, model, parameters, **chosen)
    form = suffix(output)
    write_whole(output, render(picture, picture.trace(threads), (form,))[form])


@click.command()
@click.argument("papers", nargs=-1, metavar="[PAPER]...")
@click.option("-o", "--output", type=click.Path(path_type=Path), default="reports", show_default=True, metavar="FOLDER")
@click.option("--timings", is_flag=True, help="Measure the times anew; without, those of the folder stay, if there are any.")
@SEED
@THREADS
def report(papers: tuple[str, ...], output: Path, timings: bool, seed: int, threads: int | None) -> None:
    """The audit of the papers. Recomputes what they print, in all of them by default, and judges each figure."""
    from albedo_lab.analysis.request import effort
    from albedo_lab.report.build import write_reports

    if timings and papers:
        raise BadInput("timings", " ".join(papers), "times are measured for all documents together: give none")
    processes = effort(None, "rqmc", seed, threads).threads
    with progress_bar() as progress:
        write_reports(output, papers, seed, threads, progress, timings, processes)
