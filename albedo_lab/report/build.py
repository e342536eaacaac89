"""Writes the audit of the documents: one page of HTML, a front page in Markdown, and files for every table and picture."""

from __future__ import annotations

import itertools
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from albedo_lab.analysis.card import Facts
from albedo_lab.analysis.request import effort
from albedo_lab.analysis.timing import Pace
from albedo_lab.analysis.verdict import Verdict
from albedo_lab.errors import BadInput
from albedo_lab.files import write_whole
from albedo_lab.papers import find_paper, paper_names
from albedo_lab.papers.cost_claims import CLAIMS
from albedo_lab.papers.record import Paper
from albedo_lab.papers.timing import TIMINGS
from albedo_lab.report.audit_tables import csv_table, latex_table, markdown_table
from albedo_lab.report.audited import Audited, audit, frames, steps
from albedo_lab.report.cards import (
    CHECKED,
    CLAIMED,
    FIGURES,
    PARAMETERS,
    SAMPLED,
    Card,
    card_files,
    cards,
    check_rows,
    claim_rows,
    figure_rows,
    parameter_rows,
    sampling_rows,
)
from albedo_lab.report.drawing import render
from albedo_lab.report.findings import WORDS
from albedo_lab.report.formats import as_csv, format_table
from albedo_lab.report.front import front_page
from albedo_lab.report.html.page import page
from albedo_lab.report.league import League, league, league_files, league_html
from albedo_lab.report.manifest import NAME as MANIFEST
from albedo_lab.report.manifest import left_over, manifest
from albedo_lab.report.statements import (
    csv_errata,
    csv_statements,
    latex_errata,
    latex_statements,
    longtable,
    markdown_errata,
    markdown_statements,
    markdown_topic,
    page_of,
    topics,
)
from albedo_lab.report.timings import FOLDER, paces_there, timings_are_there, write_timings
from albedo_lab.report.wards import Wards, wards, wards_files, wards_html
from albedo_lab.report.workers import Step, Task, worked

Files = dict[str, bytes]
Drawn = Mapping[str, Mapping[str, bytes]]

CARD_STEPS = 250
"""How much of the progress the model cards are: about as long as so many figures take."""
TIMING_STEPS = 40
CARD_TABLES: Mapping[str, tuple[str, Sequence[str], Callable[[Facts], Sequence[Sequence[str]]]]] = {
    "albedo": ("Albedo of every model at its default parameters.", ("figure", *FIGURES[1:]), figure_rows),
    "parameters": ("Parameters of every model.", PARAMETERS, parameter_rows),
    "checks": ("What the checks found of every model at its default parameters.", CHECKED, check_rows),
    "claims": ("What the authors of the models claim, and what was found.", CLAIMED, claim_rows),
    "sampling": ("How good every model's own sampler is.", SAMPLED, sampling_rows),
}
"""Tables of the model cards: their title, their columns, and their rows for one model."""
ALL_TABLES = r"""% Every table of the audit; pdflatex tables.tex, twice.
\documentclass[a4paper,10pt]{article}
\usepackage[landscape,margin=15mm]{geometry}
\usepackage{amsmath,amssymb,array,booktabs,longtable}
\sloppy
\begin{document}
"""


@dataclass(frozen=True)
class SideBySide:
    """What compares models: all of them, and one family."""

    ranked: League
    family: Wards


def write_reports(
    directory: Path,
    papers: Sequence[str] = (),
    seed: int = 0,
    threads: int | None = None,
    progress: Callable[[int, int], None] | None = None,
    timings: bool = False,
    processes: int = 1,
) -> None:
    """Recomputes the documents of those names, all of them by default, and writes their reports under `directory`.

    A run over all documents makes the model cards as well, measures the times where `timings` says so or none are there, and
    removes what an earlier run wrote and it does not. No file is written before everything is computed, the times first, as the
    league shows them; with the same times, the bytes are the same whatever the number of processes, which share the threads.
    Raises BadInput for an unknown name or a folder that cannot be made.
    """
    chosen = [find_paper(name) for name in dict.fromkeys(papers or paper_names())]
    try:
        directory.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise BadInput("output", str(directory), f"must be a folder that can be written ({error.strerror})") from None
    timing = not papers and (timings or not timings_are_there(directory))
    length = sum(steps(paper) + len(paper.figures) for paper in chosen) + CARD_STEPS * (not papers)
    count = itertools.count(1)

    def step() -> None:
        if progress is not None:
            progress(next(count), length + TIMING_STEPS * timing)

    audits, drawn, models, side_by_side = work_out(chosen, not papers, seed, threads, processes, step)
    if timing:
        write_timings(directory, in_steps(TIMING_STEPS, step))
    paces = paces_there(directory)
    files = {name: content for audited in audits for name, content in document_files(audited, drawn).items()}
    files |= {f"models/{name}": content for name, content in model_files(models).items()}
    if side_by_side:
        files |= encoded(league_files(side_by_side.ranked, paces) | wards_files(side_by_side.family))
    files |= common_files(audits, drawn, models, {} if papers else timing_pages(), seed, side_by_side, paces)
    files[MANIFEST] = manifest(files, seed).encode()
    for path in [] if papers else left_over(directory, files):
        path.unlink()
    for name, content in files.items():
        path = directory / name
        path.parent.mkdir(parents=True, exist_ok=True)
        write_whole(path, content)


def work_out(
    papers: Sequence[Paper], whole: bool, seed: int, threads: int | None, processes: int, step: Step
) -> tuple[list[Audited], dict[str, dict[str, bytes]], list[Card], SideBySide | None]:
    """The documents after their trials, all their pictures, for a whole run cards and comparisons; longest work first."""
    share = threads if processes == 1 else max(1, effort(None, "rqmc", seed, threads).threads // processes)
    tasks = [Task(carded, (seed, share))] if whole else []
    tasks += [Task(heard, (paper.name, seed, share)) for paper in sorted(papers, key=steps, reverse=True)]
    answers = worked(tasks, processes, step)
    models, side_by_side = answers.pop(0) if whole else ([], None)
    found = {audited.paper.name: (audited, pictures) for audited, pictures in answers}
    drawn = {name: picture for paper in papers for name, picture in found[paper.name][1].items()}
    return [found[paper.name][0] for paper in papers], drawn, models, side_by_side


def heard(name: str, seed: int, threads: int | None, step: Step) -> tuple[Audited, dict[str, dict[str, bytes]]]:
    """A document after its trial, and its pictures."""
    audited = audit(find_paper(name), seed, threads, step)
    return audited, draw(audited, step)


def carded(seed: int, threads: int | None, step: Step) -> tuple[list[Card], SideBySide | None]:
    """The model cards, in CARD_STEPS steps, and what compares models, where there are any."""
    made = cards(seed, threads, in_steps(CARD_STEPS, step))
    return made, SideBySide(league(made, seed, threads), wards(threads)) if made else None


def in_steps(size: int, step: Step) -> Callable[[int, int], None]:
    """What work is told its progress with that counts in units of its own: so many steps in all."""
    told = 0

    def tell(done: int, total: int) -> None:
        nonlocal told
        while told < size * done // total:
            told += 1
            step()

    return tell


def draw(audited: Audited, step: Step) -> dict[str, dict[str, bytes]]:
    """Every picture of a document as svg and png, by document and name ("neumann1999/figure_5")."""
    drawn = {}
    for figure, data in audited.figures():
        drawn[f"{audited.paper.name}/{figure.name}"] = render(figure.picture, data)
        step()
    return drawn


def document_files(audited: Audited, drawn: Drawn) -> Files:
    """Tables, statements and pictures of a document, each in its formats."""
    name = audited.paper.name
    files: dict[str, str | bytes] = {}
    for table, findings in audited.tables():
        base = f"{name}/{table.name}"
        files[f"{base}.md"] = markdown_table(table, findings)
        files[f"{base}.csv"] = csv_table(findings)
        files[f"{base}.tex"] = latex_table(f"{name}-{table.name}", table, findings)
    if audited.evidence:
        files[f"{name}/statements.md"] = markdown_statements(audited)
        files[f"{name}/statements.csv"] = csv_statements(audited)
        files[f"{name}/statements.tex"] = latex_statements(audited)
    for figure, data in audited.figures():
        base = f"{name}/{figure.name}"
        files |= {f"{base}.{kind}": content for kind, content in drawn[base].items()}
        files |= {f"{base}{'_' * bool(of)}{of}.csv": format_table(table, "csv") for of, table in frames(data).items()}
    return encoded(files)


def model_files(models: Sequence[Card]) -> Files:
    """The model cards, and each kind of their tables as one for all models."""
    files = {name: content for card in models for name, content in card_files(card).items()}
    for name, (title, head, rows_of) in CARD_TABLES.items() if models else ():
        rows = [
            [card.name, *(WORDS[cell] if isinstance(cell, Verdict) else cell for cell in row)]
            for card in models
            for row in rows_of(card.facts)
        ]
        widths = [3.2, *((24.0 - 3.2) / len(head) for _ in head)]
        files[f"{name}.csv"] = as_csv(("model", *head), rows)
        files[f"{name}.tex"] = longtable(title, f"models-{name}", ("model", *head), widths, rows)
    return encoded(files)


def timing_pages() -> dict[str, str]:
    """Which pages of measured times there are, by title."""
    pages = {f"{timing.title}, {timing.place}": f"{FOLDER}/{timing.name}.md" for timing in TIMINGS}
    return pages | {f"All {len(CLAIMS)} sentences about time or cost": f"{FOLDER}/claims.md"}


def common_files(
    audits: Sequence[Audited],
    drawn: Drawn,
    models: Sequence[Card],
    timed: Mapping[str, str],
    seed: int,
    side_by_side: SideBySide | None,
    paces: Mapping[str, Pace],
) -> Files:
    """The pages over all documents and models."""
    tables = [f"{a.paper.name}/{t.name}" for a in audits for t in a.paper.tables]
    long = [f"{a.paper.name}/statements" for a in audits if a.evidence]
    long += ["errata", *(f"models/{name}" for name in CARD_TABLES if models)]
    inputs = "".join(f"\\input{{{name}}}\n" for name in tables) + "".join(f"\\clearpage\\input{{{name}}}\n" for name in long)
    compared = league_html(side_by_side.ranked, paces) + wards_html(side_by_side.family) if side_by_side else None
    by_topic = {page_of(topic): markdown_topic(topic, audits) for topic in topics(audits)}
    return encoded(
        by_topic
        | {
            "index.html": page(audits, drawn, models, seed, timed, compared),
            "README.md": front_page(
                audits, {card.name: f"models/{card.name}.md" for card in models}, timed, compared is not None
            ),
            "errata.md": markdown_errata(audits),
            "errata.csv": csv_errata(audits),
            "errata.tex": latex_errata(audits),
            "tables.tex": f"{ALL_TABLES}{inputs}\\end{{document}}\n",
        }
    )


def encoded(files: Mapping[str, str | bytes]) -> Files:
    """Every file as it is written."""
    return {name: content.encode() if isinstance(content, str) else content for name, content in files.items()}
