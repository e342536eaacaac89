"""What stands at the door: whatever goes wrong leaves as one line on standard error and an exit status."""

from __future__ import annotations

import os
import signal
import sys
from typing import Any, NoReturn

import click

from albedo_lab.errors import BadInput, Inconclusive

INTERRUPTED = 128 + signal.SIGINT
TRACEBACK = "ALBEDO_LAB_TRACEBACK"
"""Of the environment: whether an error that nobody foresaw is shown with its traceback."""


class OneLine(click.Group):
    """Turns whatever goes wrong into one line on standard error and the exit status that stands for it."""

    def main(self, *args: Any, **kwargs: Any) -> NoReturn:
        """Runs the command line and exits: 0 done, 1 a check failed, 2 bad input, 3 inconclusive, 130 interrupted."""
        try:
            status = super().main(*args, **(kwargs | {"standalone_mode": False}))
        except click.ClickException as error:
            status = fail(2, error.format_message())
        except (BadInput, OSError) as error:
            status = fail(2, str(error))
        except Inconclusive as error:
            status = fail(3, str(error))
        except (click.Abort, KeyboardInterrupt):
            status = INTERRUPTED
        except Exception as error:  # of somebody's own model far from its defaults, or a defect of ours
            if os.environ.get(TRACEBACK):
                raise
            status = fail(2, f"{type(error).__name__}: {error} ({TRACEBACK}=1 shows where)")
        sys.exit(status or 0)


def fail(status: int, message: str) -> int:
    """Says in one line what is wrong; hands the status on."""
    click.echo(f"albedo-lab: {' '.join(message.split())}", err=True)
    return status
