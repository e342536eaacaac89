"""What comes out: the result on standard output or in a file, progress on a terminal."""

from __future__ import annotations

import os
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

import click

from albedo_lab.files import write_whole

UNREAD = 128 + 13
"""The status of a program whose reader went away (SIGPIPE): nothing failed, but not all was said."""


def emit(text: str, output: Path | None) -> None:
    """The result, in UTF-8 whatever the terminal, to the file or to standard output."""
    if output is not None:
        write_whole(output, text)
        return
    try:
        click.echo(text.encode(), nl=False)
    except OSError as error:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())  # or the rest of the buffer fails again at exit
        if isinstance(error, BrokenPipeError):
            sys.exit(UNREAD)
        raise


@contextmanager
def progress_bar() -> Iterator[Callable[[int, int], None] | None]:
    """A bar on standard error; None where that is no terminal."""
    if not sys.stderr.isatty():
        yield None
        return
    with click.progressbar(length=1, file=sys.stderr) as bar:

        def advance(done: int, total: int) -> None:
            bar.length = total
            bar.update(done - bar.pos)

        yield advance
