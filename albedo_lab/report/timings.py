"""The pages of measured times and costs: the only files of the reports that are not the same again, and that name a machine."""

from __future__ import annotations

import csv
import io
import os
import platform
from collections import Counter
from collections.abc import Callable, Mapping
from importlib.metadata import version
from pathlib import Path

from albedo_lab.analysis.check import everyone
from albedo_lab.analysis.clock import Ratio
from albedo_lab.analysis.operations import OPERATIONS
from albedo_lab.analysis.timing import Pace, paces
from albedo_lab.files import write_whole
from albedo_lab.papers.cost_claims import CLAIMS, CostClaim, Judged
from albedo_lab.papers.timing import CONTENDERS, TIMINGS, Costs, Row, Timing, measure
from albedo_lab.papers.verdict import Kind
from albedo_lab.report.formats import as_csv, as_markdown

FOLDER = "timings"
FRONT = f"{FOLDER}/README.md"
LEAGUE = f"{FOLDER}/league.csv"
MEASURED = ("model", "printed", "over the first, printed", "ns a pair", "over the first, measured", "ratio of both", *OPERATIONS)
CLAIMED = ("document", "place", "printed", "asks", "measured", "verdict", "why")
HEAD = """\
# Times and costs, measured

Times belong to a machine, those of the documents to machines that are gone: what can be held against the print are ratios, and
the verdicts below are about this machine:

"""
HOW = """
Nanoseconds are CPU time of one evaluation of f for a pair of directions in compiled code, one thread, over 4096 pairs; contenders
take turns, and a figure is the median over the rounds, in brackets the middle half of them. Operations are counted while the
formula runs in Python, at one pair of directions, constants such as 4π as they are written; a function is exp, log, pow, erfc
or an arctangent, a comparison also min, max and the absolute value. A sample of the league is a weighted one: its uniforms, a
direction for a viewer at 45°, f cos over its density.
`albedo-lab report --timings` measures anew."""


def timings_are_there(directory: Path) -> bool:
    """Whether the pages were written before."""
    return (directory / FRONT).is_file() and (directory / LEAGUE).is_file()


def paces_there(directory: Path) -> dict[str, Pace]:
    """The times of the league as they were written there, by model; empty where none were."""
    try:
        text = (directory / LEAGUE).read_text(encoding="utf-8")
    except FileNotFoundError:
        return {}
    rows = csv.DictReader(io.StringIO(text))
    return {row["model"]: Pace(*(float(row[name]) for name in Pace._fields)) for row in rows}


def write_timings(directory: Path, progress: Callable[[int, int], None] | None = None) -> None:
    """Measures everything and writes the pages under `directory`/timings; it takes about 30 seconds.

    `directory` must exist and be writable. `progress` is told the number of steps done, and of all.
    """
    steps = 3
    if progress is not None:
        progress(0, steps)
    costs = measure()
    if progress is not None:
        progress(1, steps)
    league = paces(everyone())
    if progress is not None:
        progress(2, steps)
    for name, content in timing_files(costs, league).items():
        path = directory / name
        path.parent.mkdir(parents=True, exist_ok=True)
        write_whole(path, content)
    if progress is not None:
        progress(steps, steps)


def timing_files(costs: Costs, league: Mapping[str, Pace]) -> dict[str, str]:
    """Every page by its path: Markdown and CSV of each table and of the sentences, and a front page that names the machine."""
    judged = [(claim, claim.trial(costs)) for claim in CLAIMS]
    files = {}
    for timing in TIMINGS:
        files[f"{FOLDER}/{timing.name}.md"] = timing_page(timing, costs)
        files[f"{FOLDER}/{timing.name}.csv"] = timing_csv(timing, costs)
    files[f"{FOLDER}/claims.md"] = claims_page(judged)
    files[f"{FOLDER}/claims.csv"] = as_csv(("name", *CLAIMED), [[claim.name, *claim_row(claim, j)] for claim, j in judged])
    files[f"{FOLDER}/contenders.csv"] = contenders_csv(costs)
    files[LEAGUE] = as_csv(("model", *Pace._fields), [[name, *pace] for name, pace in league.items()])
    tally = Counter(j.kind for _, j in judged)
    links = [f"- [{timing.title}: {timing.place}]({timing.name}.md) ([csv]({timing.name}.csv))" for timing in TIMINGS]
    told = ", ".join(f"{tally[kind]} {kind}" for kind in Kind if tally[kind])
    links.append(f"- [Every sentence about time or cost](claims.md) ([csv](claims.csv)): {told}")
    links.append("- [Everything that was measured](contenders.csv)")
    links.append("- [An evaluation and a sample of every model of the catalogue](league.csv), for [the league](../league.md)")
    files[FRONT] = HEAD + machine() + HOW + "\n\n" + "\n".join(links) + "\n"
    return files


def machine() -> str:
    """What the times were measured on, in Markdown."""
    packages = ", ".join(f"{name} {version(name)}" for name in ("numba", "llvmlite", "numpy"))
    lines = (processor(), f"{platform.system()}, {platform.machine()}", f"Python {platform.python_version()}, {packages}")
    return "".join(f"- {line}\n" for line in lines)


def processor() -> str:
    """The processor's name, as Linux tells it, else as Python does; and how many there are."""
    name = platform.processor()
    try:
        lines = Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines()
        name = next(line.partition(":")[2].strip() for line in lines if line.startswith("model name"))
    except (OSError, StopIteration):
        pass
    return f"{name or 'unknown processor'}, {os.cpu_count()} logical processors"


def timing_page(timing: Timing, costs: Costs) -> str:
    """A table of costs in Markdown, printed and measured side by side."""
    base = next(row for row in timing.rows if row.contender == timing.base)
    names = [name.replace("over the first", f"over {base.label}") for name in MEASURED]
    names[1] += f" [{timing.unit}]" * bool(timing.unit)
    rows = [timing_row(row, base, timing, costs) for row in timing.rows]
    if not base.printed:  # nothing printed to compare with
        kept = [i for i in range(len(names)) if i not in (1, 2, 5)]
        names, rows = [names[i] for i in kept], [[row[i] for i in kept] for row in rows]
    parts = [f"# {timing.title}: {timing.place}", timing.note, as_markdown(names, rows), order(timing, costs)]
    return "\n\n".join(part.strip() for part in parts if part) + "\n"


def timing_row(row: Row, base: Row, timing: Timing, costs: Costs) -> list[str]:
    """One line of it, under MEASURED."""
    measured = costs.ratio(row.contender, base.contender, timing.wavelengths)
    counted = [str(costs.operations[row.contender][kind] or "") for kind in OPERATIONS]
    ns = f"{costs.nanoseconds(row.contender, timing.wavelengths):.3g}"
    if not row.printed or not base.printed:
        return [row.label, "", "", ns, told(measured), "", *counted]
    printed = float(row.printed) / float(base.printed)
    return [row.label, row.printed, f"{printed:.3g}", ns, told(measured), f"{measured.value / printed:.2g}", *counted]


def order(timing: Timing, costs: Costs) -> str:
    """Which models the print has in another order of cost than the measurement, where the rounds leave no doubt."""
    printed = [row for row in timing.rows if row.printed]
    if not printed:
        return ""
    swapped = []
    for i, a in enumerate(printed):
        for b in printed[i + 1 :]:
            dear, cheap = (a, b) if float(a.printed) > float(b.printed) else (b, a)
            if costs.ratio(dear.contender, cheap.contender, timing.wavelengths).high < 1.0:
                swapped.append(f"{dear.label} is cheaper than {cheap.label}")
    pairs = len(printed) * (len(printed) - 1) // 2
    if not swapped:
        return f"The print's order of cost is measured again in all {pairs} pairs of models."
    return f"In {len(swapped)} of {pairs} pairs of models the order of cost is not that of the print: {'; '.join(swapped)}."


def timing_csv(timing: Timing, costs: Costs) -> str:
    """The same with every digit."""
    names = ("label", "contender", "printed", "wavelengths", "nanoseconds", "relative", "low", "high", *OPERATIONS)
    rows = []
    for row in timing.rows:
        r = costs.ratio(row.contender, timing.base, timing.wavelengths)
        counted = [costs.operations[row.contender][kind] for kind in OPERATIONS]
        ns = costs.nanoseconds(row.contender, timing.wavelengths)
        rows.append([row.label, row.contender, row.printed, timing.wavelengths, ns, r.value, r.low, r.high, *counted])
    return as_csv(names, rows)


def contenders_csv(costs: Costs) -> str:
    """Who was measured, and what was found of each."""
    names = ("contender", "model", "parameters", "ns_one_wavelength", "ns_eight_wavelengths", *OPERATIONS)
    rows = []
    for name, contender in CONTENDERS.items():
        if name in costs.operations:
            parameters = " ".join(f"{key}={value}" for key, value in contender.parameters.items())
            counted = [costs.operations[name][kind] for kind in OPERATIONS]
            rows.append([name, contender.model, parameters, costs.nanoseconds(name), costs.nanoseconds(name, 8), *counted])
    return as_csv(names, rows)


def claims_page(judged: list[tuple[CostClaim, Judged]]) -> str:
    """Every sentence with its verdict, in Markdown."""
    rows = [claim_row(claim, j) for claim, j in judged]
    how = (
        "Names such as `cook_torrance_exact` are those of [contenders.csv](contenders.csv); a ratio is of times, in brackets the "
    )
    how += "middle half of the rounds. These verdicts hold on the machine that [the front page](README.md) names."
    return f"# Every sentence about time or cost\n\n{how}\n\n{as_markdown(CLAIMED, rows)}"


def claim_row(claim: CostClaim, j: Judged) -> list[str]:
    """A sentence under CLAIMED."""
    return [claim.document, claim.place, claim.printed, claim.asks, j.ours, str(j.kind), j.why]


def told(r: Ratio) -> str:
    """A ratio with the middle half of the rounds."""
    return f"{r.value:.3g} ({r.low:.3g} to {r.high:.3g})"
