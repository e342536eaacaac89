"""Writes the audit of the documents: a front page, and for each document its tables and figures."""

from __future__ import annotations

import itertools
from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from importlib import import_module
from pathlib import Path
from pkgutil import iter_modules

import pandas as pd

from albedo_lab import papers as room
from albedo_lab.errors import BadInput
from albedo_lab.files import write_whole
from albedo_lab.papers.audit import Finding, Paper, Plot, Spectra, Table, examine, printed_points, trace, trace_spectra
from albedo_lab.papers.verdict import RULE, Kind
from albedo_lab.report.audit_tables import DOUBTER, csv_table, doubter_rows, latex_table, markdown_table
from albedo_lab.report.formats import as_markdown, format_table
from albedo_lab.report.plots import picture, spectra_picture

HEAD = """\
# The documents on trial

Every printed figure below was recomputed, and each of ours carries its error. `make reports` writes these pages
again, the same byte for byte.

## How a figure is judged

Ours comes from adaptive quadrature; the number after ± bounds its error, and is shown no finer than a thousandth of
the last printed unit. Every figure is computed again by another way that shares no integration with the first,
randomised quasi-Monte Carlo (rqmc, ± half of its 95 % interval); limits are argued, and approached by quadrature.
The csv files hold both, with every digit.
"""


def write_reports(
    directory: Path,
    papers: Sequence[str] = (),
    seed: int = 0,
    threads: int | None = None,
    progress: Callable[[int, int], None] | None = None,
) -> None:
    """Recomputes the documents of those names, all of them by default, and writes their reports under `directory`.

    No file is written before everything is computed. Raises BadInput for an unknown name or a folder that cannot be made.
    """
    audited = [find_paper(name) for name in dict.fromkeys(papers or paper_names())]
    try:
        directory.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise BadInput("output", str(directory), f"must be a folder that can be written ({error.strerror})") from None
    step = stepper(sum(len(table.cells) for paper in audited for table in paper.tables), progress)
    files: dict[str, str | bytes] = {}
    sections = []
    for paper in audited:
        findings = {table.name: [step(f) for f in examine(table.cells, seed, threads)] for table in paper.tables}
        for table in paper.tables:
            files |= table_files(f"{paper.name}/{table.name}", table, findings[table.name])
        for plot in paper.plots:
            files |= plot_files(f"{paper.name}/{plot.name}", plot, trace(plot, threads))
        for spectra in paper.spectra:
            files |= spectra_files(f"{paper.name}/{spectra.name}", spectra, *trace_spectra(spectra, threads))
        sections.append(paper_section(paper, findings))
    files["README.md"] = "\n".join([HEAD, RULE, "", *sections])
    for name, content in files.items():
        path = directory / name
        path.parent.mkdir(parents=True, exist_ok=True)
        write_whole(path, content)


def stepper(total: int, progress: Callable[[int, int], None] | None) -> Callable[[Finding], Finding]:
    """Passes findings on and tells progress."""
    count = itertools.count(1)

    def step(finding: Finding) -> Finding:
        if progress is not None:
            progress(next(count), total)
        return finding

    return step


def paper_names() -> list[str]:
    """The documents on trial: the modules of the room that hold one."""
    names = (module.name for module in iter_modules(room.__path__))
    return sorted(name for name in names if hasattr(import_module(f"{room.__name__}.{name}"), "PAPER"))


def find_paper(name: str) -> Paper:
    """The document of that name. Raises BadInput for an unknown one."""
    known = paper_names()
    if name not in known:
        raise BadInput("paper", name, f"must be one of {', '.join(known)}")
    found: Paper = import_module(f"{room.__name__}.{name}").PAPER
    return found


def table_files(base: str, table: Table, findings: Sequence[Finding]) -> dict[str, str | bytes]:
    """A table in its three formats."""
    return {
        f"{base}.md": markdown_table(table, findings),
        f"{base}.csv": csv_table(findings),
        f"{base}.tex": latex_table(table, findings),
    }


def plot_files(base: str, plot: Plot, data: pd.DataFrame) -> dict[str, str | bytes]:
    """A plot in its two formats, and its data."""
    pictures = {f"{base}.{kind}": content for kind, content in picture(plot, data, printed_points(plot)).items()}
    return pictures | {f"{base}.csv": format_table(data, "csv")}


def spectra_files(base: str, spectra: Spectra, albedos: pd.DataFrame, colours: pd.DataFrame) -> dict[str, str | bytes]:
    """Spectra in two formats, and their data."""
    pictures = {f"{base}.{kind}": content for kind, content in spectra_picture(spectra, albedos, colours).items()}
    return pictures | {f"{base}.csv": format_table(albedos, "csv"), f"{base}_colours.csv": format_table(colours, "csv")}


def paper_section(paper: Paper, findings: Mapping[str, Sequence[Finding]]) -> str:
    """What the front page says of a document: counts, every figure that does not hold, pictures."""
    counts, failures = [], []
    for table in paper.tables:
        link = f"[{table.title}]({paper.name}/{table.name}.md)"
        counts.append([table.place, link, *tally(findings[table.name]), links(paper, table.name, "csv", "tex")])
        doubted = [f for f in findings[table.name] if f.verdict.kind is not Kind.AGREES]
        failures += [[table.place, *row] for row in doubter_rows(doubted)]
    everything = [f for table in paper.tables for f in findings[table.name]]
    counts.append(["", "**all**", *(f"**{number}**" for number in tally(everything)), ""])
    pictures = [shown(paper, plot, links(paper, plot.name, "svg", "png", "csv")) for plot in paper.plots]
    for spectra in paper.spectra:
        files = f"{links(paper, spectra.name, 'svg', 'png', 'csv')}; colours: {links(paper, f'{spectra.name}_colours', 'csv')}"
        pictures.append(shown(paper, spectra, files))
    return "\n".join(
        [
            f"## {paper.name}\n\n{paper.citation}.\n\n{paper.note}\n",
            as_markdown(("place", "what", *Kind, "files"), counts),
            "### What does not hold\n",
            as_markdown(("place", *DOUBTER), failures),
            *pictures,
        ]
    )


def shown(paper: Paper, plot: Plot | Spectra, files: str) -> str:
    """A picture with its caption and its files."""
    picture_of = f"![{plot.title}]({paper.name}/{plot.name}.svg)"
    return f"### {plot.place.capitalize()}\n\n{picture_of}\n\n{plot.caption} Files: {files}.\n"


def tally(findings: Sequence[Finding]) -> list[str]:
    """How many verdicts there are of each kind."""
    number = Counter(f.verdict.kind for f in findings)
    return [str(number[kind]) for kind in Kind]


def links(paper: Paper, name: str, *kinds: str) -> str:
    """Markdown links to the files of a table or a plot."""
    return ", ".join(f"[{kind}]({paper.name}/{name}.{kind})" for kind in kinds)
