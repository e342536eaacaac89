"""The command line: a thin door that parses, asks an analysis and prints.

Analyses are imported inside the commands: --help and list must not wait for numpy, numba and pandas.
"""

from __future__ import annotations

import click

from albedo_lab import __version__
from albedo_lab.cli.auditing import audit
from albedo_lab.cli.checking import check
from albedo_lab.cli.door import OneLine
from albedo_lab.cli.figures import albedo, colour, grazing, mean_albedo, normalise
from albedo_lab.cli.listing import list_models, show
from albedo_lab.cli.showing import PICTURES, plot, report
from albedo_lab.cli.tables import compensate, export, tabulate

__all__ = ["PICTURES", "main"]


@click.group(cls=OneLine, no_args_is_help=False, context_settings={"help_option_names": ["-h", "--help"]})
@click.version_option(__version__, prog_name="albedo-lab")
def main() -> None:
    """Puts reflectance models (BRDFs) on trial, each figure with an honest error bar.

    Exit status: 0 done, 1 a check failed, 2 bad input, 3 inconclusive within the budget.
    """


_FIGURES = (albedo, mean_albedo, normalise, colour, grazing)
_TABLES = (tabulate, export, audit, compensate)
for _command in (list_models, show, *_FIGURES, check, *_TABLES, plot, report):
    main.add_command(_command)
