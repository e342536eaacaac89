"""CPU time of whole commands: the start without a question, and a warm `normalise`."""

from __future__ import annotations

import resource
import subprocess
import sys
from collections.abc import Sequence
from importlib.util import find_spec
from statistics import median

from albedo_lab.analysis.clock import interleave
from tests.benchmarks.tables import seconds, table

COMMANDS = {
    "--help": (("--help",), 0.25),
    "list": (("list",), 0.25),
    "normalise stretched_blinn -p n=64": (("normalise", "stretched_blinn", "-p", "n=64"), 2.0),
}
DOOR = "import sys; from albedo_lab.cli import main; sys.exit(main())"


def start_up(quick: bool) -> str:
    """CPU seconds, user and system, of a new process a command; each runs once before, so that kernels are on disk."""
    title = "## CPU time of commands, kernels from the disk cache\n\n"
    if find_spec("albedo_lab.cli") is None:
        return title + "There is no command line yet."
    for arguments, _ in COMMANDS.values():
        status = subprocess.run([sys.executable, "-c", DOOR, *arguments], capture_output=True, check=False).returncode
        if status:
            return title + f"`albedo-lab {' '.join(arguments)}` fails with status {status}."
    measures = {name: lambda a=arguments: cpu_seconds(a) for name, (arguments, _) in COMMANDS.items()}
    times = interleave(measures, 3 if quick else 7)
    rows = []
    for name, (_, most) in COMMANDS.items():
        took = median(times[name])
        rows.append([f"`albedo-lab {name}`", seconds(took), seconds(most), "holds" if took < most else "FAILS"])
    return title + table(["command", "CPU time", "required, under", "verdict"], rows)


def cpu_seconds(arguments: Sequence[str]) -> float:
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run([sys.executable, "-c", DOOR, *arguments], capture_output=True, check=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
