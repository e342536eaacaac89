"""Long work in several processes: matplotlib and most of the audit hold Python's lock, so that threads would not help."""

from __future__ import annotations

import multiprocessing
import pickle
import signal
import threading
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from multiprocessing.sharedctypes import Synchronized
from typing import Any, NamedTuple

POLL = 0.1
"""Seconds between two looks at how far the work is."""
Step = Callable[[], None]


class Task(NamedTuple):
    """work(*arguments, step), which calls `step` once for each of its steps. All of it, and the answer, must be picklable."""

    work: Callable[..., Any]
    arguments: tuple[Any, ...]


def worked(tasks: Sequence[Task], processes: int, step: Step) -> list[Any]:
    """The answers to all tasks, in order; the first is begun first. `step` is called in this process, as the steps are made.

    With one process, or one task, everything is done in this one. Whatever a task raises is raised here; when this process is
    interrupted, the others end with it.
    """
    if processes == 1 or len(tasks) == 1:
        return [task.work(*task.arguments, step) for task in tasks]
    context = multiprocessing.get_context("spawn")
    made = context.Value("l", 0)
    told = 0
    with _deaf():
        pool = context.Pool(min(processes, len(tasks)), _begin, (made,))
    with pool:
        answers = [pool.apply_async(_done, (task,)) for task in tasks]
        while waiting := [answer for answer in answers if not answer.ready()]:
            waiting[0].wait(POLL)
            for answer in answers:
                if answer.ready() and not answer.successful():
                    answer.get()  # raises: nobody waits for the rest
            for _ in range(made.value - told):
                step()
                told += 1
        for _ in range(made.value - told):
            step()
        return [answer.get() for answer in answers]


_made: Synchronized[int]


def _begin(made: Synchronized[int]) -> None:
    """In a new process: where steps are counted."""
    global _made
    _made = made


@contextmanager
def _deaf() -> Iterator[None]:
    """Processes that are started here never hear of an interrupt, which is for the one that waits for them.

    A signal that is ignored stays so in a new process, from its first instruction on. Only the main thread can ignore one.
    """
    if threading.current_thread() is not threading.main_thread():
        yield
        return
    before = signal.signal(signal.SIGINT, signal.SIG_IGN)
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, before)


def _done(task: Task) -> Any:
    try:
        return task.work(*task.arguments, _counted)
    except Exception as error:
        try:
            pickle.loads(pickle.dumps(error))
        except Exception:  # the pool would wait for it for ever
            raise RuntimeError(f"{type(error).__name__}: {error}") from None
        raise


def _counted() -> None:
    with _made.get_lock():
        _made.value += 1
