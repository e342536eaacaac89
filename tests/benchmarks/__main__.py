"""`python -m tests.benchmarks`: how fast albedo_lab is, alone and against others, as Markdown."""

from __future__ import annotations

import argparse
import os
import platform
import sys
from importlib.metadata import version
from pathlib import Path

from albedo_lab.files import write_whole
from tests.benchmarks.accuracy import time_to_accuracy
from tests.benchmarks.startup import start_up
from tests.benchmarks.subjects import processors
from tests.benchmarks.throughput import against_others, catalogue


def main() -> int:
    parser = argparse.ArgumentParser(prog="python -m tests.benchmarks", description=__doc__)
    parser.add_argument("--quick", action="store_true", help="fewer rounds and samples: a look, not a measurement")
    parser.add_argument("-o", dest="output", type=Path, metavar="FILE", help="write to FILE as well")
    options = parser.parse_args()
    if options.output and (options.output.is_dir() or not os.access(options.output.absolute().parent, os.W_OK)):
        parser.error(f"-o: {options.output} cannot be written")
    parts = [heading()]
    print(parts[0])
    for part in (catalogue, against_others, time_to_accuracy, start_up):
        parts.append(part(options.quick))
        print(f"\n{parts[-1]}", flush=True)
    if options.output:
        write_whole(options.output, "\n\n".join(parts) + "\n")
    return 0


def heading() -> str:
    packages = ", ".join(f"{name} {version(name)}" for name in ("numba", "numpy", "scipy"))
    return (
        "# Benchmarks\n\n"
        f"Medians of interleaved runs; ratios are medians of the ratios within a round. {processor()}, "
        f"{processors()} of its processors; Python {platform.python_version()}, {packages}. "
        f"Load average at the start {os.getloadavg()[0]:.1f}: "
        "figures in wall time (all threads) mean something on an idle machine only; CPU times hardly mind."
    )


def processor() -> str:
    """The processor's name where the system tells it."""
    information = Path("/proc/cpuinfo")
    lines = information.read_text(encoding="utf-8").splitlines() if information.exists() else []
    named = [line.partition(":")[2].strip() for line in lines if line.startswith("model name")]
    return named[0] if named else platform.processor() or platform.machine()


if __name__ == "__main__":
    sys.exit(main())
