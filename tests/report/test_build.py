from dataclasses import replace

import pytest

from albedo_lab.errors import BadInput
from albedo_lab.papers.neumann1999 import PAPER
from albedo_lab.report import build


@pytest.fixture
def small(monkeypatch):
    """The paper with two cheap tables and one plot of few curves."""
    tables = tuple(t for t in PAPER.tables if t.name in ("section_6_2", "equation_26"))
    plots = tuple(replace(p, curves=p.curves[1:]) for p in PAPER.plots if p.name == "figure_5")
    paper = replace(PAPER, tables=tables, plots=plots)
    monkeypatch.setattr(build, "find_paper", lambda name: paper)


def contents(folder):
    return {path.relative_to(folder): path.read_bytes() for path in folder.rglob("*") if path.is_file()}


def test_the_same_bytes_whatever_the_threads(small, tmp_path):
    build.write_reports(tmp_path / "one", threads=1)
    build.write_reports(tmp_path / "two", threads=2)
    one = contents(tmp_path / "one")
    assert one == contents(tmp_path / "two")
    assert {path.suffix for path in one} == {".md", ".csv", ".tex", ".svg", ".png"}


def test_every_link_of_the_front_page_leads_somewhere(small, tmp_path):
    build.write_reports(tmp_path)
    text = (tmp_path / "README.md").read_text(encoding="utf-8")
    targets = [part.split(")")[0] for part in text.split("](")[1:]]
    assert len(targets) > 5
    assert all((tmp_path / target).is_file() for target in targets)
    assert "| §6.2 | ward | m = 0.1, θ = 89.9995° | 3.8 | 3.7098 ± 0.0001 |" in text


def test_progress_counts_to_the_end(small, tmp_path):
    seen = []
    build.write_reports(tmp_path, progress=lambda done, total: seen.append((done, total)))
    assert [done for done, _ in seen] == list(range(1, len(seen) + 1))
    assert seen[-1][0] == seen[-1][1]


def test_interrupted_it_writes_nothing(small, tmp_path):
    def stop(done, total):
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        build.write_reports(tmp_path, progress=stop)
    assert contents(tmp_path) == {}


def test_an_unknown_paper_is_bad_input(tmp_path):
    with pytest.raises(BadInput, match="neumann1999"):
        build.write_reports(tmp_path / "reports", ["neuman1999"])
    assert not (tmp_path / "reports").exists()
