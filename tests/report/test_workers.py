"""Work in several processes: answers in order, every step told, errors and interrupts end it all."""

import os
import pickle
import signal
import subprocess
import sys
import time
from dataclasses import replace

import pandas as pd
import pytest

from albedo_lab.analysis.request import grid
from albedo_lab.analysis.verdict import Subject
from albedo_lab.catalogue import find
from albedo_lab.errors import BadInput
from albedo_lab.estimate.record import exact
from albedo_lab.papers import find_paper
from albedo_lab.papers.record import Finding
from albedo_lab.papers.verdict import judge
from albedo_lab.report.audited import Audited
from albedo_lab.report.workers import Task, worked


def squared(x, step):
    for _ in range(x):
        step()
    return x * x, os.getpid()


def refused(x, step):
    raise BadInput("x", x, "must be something else")


def forever(step):
    print("at work", flush=True)
    time.sleep(600)


@pytest.mark.parametrize("processes", [1, 2])
def test_answers_come_in_order_and_every_step_is_told(processes):
    steps = []
    answers = worked([Task(squared, (x,)) for x in (5, 2, 7)], processes, lambda: steps.append(1))
    assert [answer for answer, _ in answers] == [25, 4, 49]
    assert len(steps) == 14
    here = {pid == os.getpid() for _, pid in answers}
    assert here == {processes == 1}


def test_an_error_is_raised_here_and_ends_the_rest():
    start = time.monotonic()
    with pytest.raises(BadInput, match="x = 3: must be something else"):
        worked([Task(forever, ()), Task(refused, (3,))], 2, lambda: None)
    assert time.monotonic() - start < 60.0


SCRIPT = """
import signal
from albedo_lab.report.workers import Task, worked
from tests.report.test_workers import forever
if __name__ == "__main__":
    signal.signal(signal.SIGINT, signal.default_int_handler)  # a shell's background jobs are born deaf to it
    print("begun", flush=True)
    worked([Task(forever, ()), Task(forever, ())], 2, lambda: None)
"""


def test_an_interrupt_ends_every_process(tmp_path):
    script = tmp_path / "script.py"
    script.write_text(SCRIPT)
    environment = os.environ | {"PYTHONPATH": os.getcwd()}
    running = subprocess.Popen(
        [sys.executable, str(script)],
        env=environment,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        start_new_session=True,
    )
    assert [running.stdout.readline() for _ in range(3)] == ["begun\n", "at work\n", "at work\n"]
    os.killpg(running.pid, signal.SIGINT)
    _, said = running.communicate(timeout=60)
    assert said.rstrip().endswith("KeyboardInterrupt")
    assert said.count("Traceback") == 1  # of this process alone
    with pytest.raises(ProcessLookupError):
        outlive(running.pid)


def outlive(group):
    """Raises ProcessLookupError once nobody of the group is left; Python's own resource tracker is the last to go."""
    for _ in range(100):
        os.killpg(group, 0)
        time.sleep(0.1)


def test_a_document_after_its_trial_is_pickled_by_its_name():
    paper = find_paper("neumann1999")
    e = exact(0.5)
    findings = {
        table.name: [Finding(cell, e, {"rqmc": e}, judge(cell.printed, e)) for cell in table.cells] for table in paper.tables
    }
    again = pickle.loads(pickle.dumps(Audited(paper, findings, {}, {"figure": {"": pd.DataFrame({"a": [1.0]})}})))
    assert again.paper is paper
    assert again.findings == findings
    assert again.data["figure"][""].equals(pd.DataFrame({"a": [1.0]}))


def test_a_model_is_pickled_by_its_name_if_the_catalogue_has_it():
    member, p, _ = next(grid(find("cook_torrance"), {"geometry": "smith"}))
    again = pickle.loads(pickle.dumps(Subject(member, p, exact(1.0))))
    assert again.model is member
    assert again.p == p
    with pytest.raises(TypeError, match="cannot be pickled"):
        pickle.dumps(replace(member, pdf=None))
