import hashlib
import json
import re
from functools import cache
from urllib.parse import unquote

import pytest

from albedo_lab.errors import BadInput
from albedo_lab.report import build
from albedo_lab.report.audited import audit
from albedo_lab.report.league import League
from albedo_lab.report.timings import LEAGUE
from albedo_lab.report.wards import Wards
from tests.report.small import PAPER

LINK = re.compile(r'\]\(([^)#]+)\)|(?:href|src)="([^"#:]+)"')


@pytest.fixture(autouse=True)
def _small(monkeypatch):
    """The only document is a small one, and no model has a card."""
    monkeypatch.setattr(build, "paper_names", lambda: ["small"])
    monkeypatch.setattr(build, "find_paper", lambda name: PAPER)
    monkeypatch.setattr(build, "cards", lambda seed, threads, progress: [])
    monkeypatch.setattr(build, "write_timings", stand_in)
    monkeypatch.setattr(build, "draw", draw_once)


DRAW = build.draw


@cache
def drawn():
    return DRAW(audit(PAPER), lambda: None)


def draw_once(audited, step):
    """Draws every picture the first time only."""
    for _ in audited.figures():
        step()
    return drawn()


def stand_in(folder, progress):
    """Measures nothing, and writes pages of the right names."""
    (folder / "timings").mkdir(exist_ok=True)
    for page in ("timings/README.md", LEAGUE, *build.timing_pages().values()):
        (folder / page).write_text("1 ns", encoding="utf-8")
    progress(1, 1)


def contents(folder):
    return {str(path.relative_to(folder)): path.read_bytes() for path in folder.rglob("*") if path.is_file()}


def test_the_same_bytes_whatever_the_threads(tmp_path, monkeypatch):
    monkeypatch.setattr(build, "draw", DRAW)
    build.write_reports(tmp_path / "one", threads=1)
    build.write_reports(tmp_path / "two", threads=2)
    one = contents(tmp_path / "one")
    assert one == contents(tmp_path / "two")
    assert {"index.html", "README.md", "manifest.json", "tables.tex", "errata.csv", "small/statements.md"} <= set(one)
    assert {"small/figure_1.svg", "small/figure_1.png", "small/figure_1.csv", "small/table_1.tex"} <= set(one)


def test_every_link_leads_somewhere(tmp_path):
    build.write_reports(tmp_path)
    for page in ("README.md", "index.html"):
        text = (tmp_path / page).read_text(encoding="utf-8")
        targets = {unquote(markdown or html) for markdown, html in LINK.findall(text)}
        assert len(targets) > 5
        assert [target for target in targets if not (tmp_path / target).is_file()] == []


def test_the_front_page_counts_and_shows_what_does_not_hold(tmp_path):
    build.write_reports(tmp_path)
    text = (tmp_path / "README.md").read_text(encoding="utf-8")
    assert "| [small](#small) | 1 | 1 | 2 | 2 | 1 | 7 |" in text
    assert "| table 1 | phong | n = 2 | 0.368 | 0.363800 ± 0.000001 |" in text
    assert "| §3 | 0.3 | number |" in text
    assert "it looks good" not in text


def test_the_manifest_has_the_digest_of_every_other_file(tmp_path):
    build.write_reports(tmp_path, seed=7)
    record = json.loads((tmp_path / "manifest.json").read_text(encoding="utf-8"))
    digests = {
        name: hashlib.sha256(content).hexdigest()
        for name, content in contents(tmp_path).items()
        if not name.startswith("timings/")
    }
    assert record["sha256"] == {name: digest for name, digest in digests.items() if name != "manifest.json"}
    assert record["seed"] == 7
    assert {"albedo_lab", "python", "numpy", "numba", "scipy", "matplotlib", "pandas"} <= set(record["versions"])


def test_times_are_measured_where_none_are_there_or_when_asked(tmp_path, monkeypatch):
    told = []
    monkeypatch.setattr(build, "write_timings", lambda folder, progress: told.append(folder) or stand_in(folder, progress))
    build.write_reports(tmp_path, ["small"])
    assert len(told) == 0
    build.write_reports(tmp_path)
    assert len(told) == 1
    build.write_reports(tmp_path)
    assert len(told) == 1
    build.write_reports(tmp_path, timings=True)
    assert len(told) == 2


def test_what_an_earlier_run_left_goes_unless_it_was_changed(tmp_path, monkeypatch):
    build.write_reports(tmp_path)
    monkeypatch.setattr(build, "find_paper", lambda name: type(PAPER)("small", PAPER.citation, PAPER.note, PAPER.tables))
    (tmp_path / "small" / "statements.md").write_text("mine", encoding="utf-8")
    (tmp_path / "notes.txt").write_text("mine", encoding="utf-8")
    build.write_reports(tmp_path, ["small"])
    assert (tmp_path / "small" / "figure_1.svg").exists(), "a run over some documents leaves the others alone"
    build.write_reports(tmp_path / "again")
    monkeypatch.setattr(build, "find_paper", lambda name: PAPER)
    build.write_reports(tmp_path)
    monkeypatch.setattr(build, "find_paper", lambda name: type(PAPER)("small", PAPER.citation, PAPER.note, PAPER.tables))
    (tmp_path / "small" / "statements.md").write_text("mine", encoding="utf-8")
    build.write_reports(tmp_path)
    assert not (tmp_path / "small" / "figure_1.svg").exists()
    assert (tmp_path / "small" / "table_1.md").exists()
    assert (tmp_path / "small" / "statements.md").read_text(encoding="utf-8") == "mine"
    assert (tmp_path / "notes.txt").exists()


def test_the_league_is_written_with_the_times_that_are_there(tmp_path, monkeypatch):
    seen = []
    truly = build.league_files
    picture = drawn()["small/figure_1"]
    compared = build.SideBySide(League((), picture), Wards((), picture))
    monkeypatch.setattr(build, "carded", lambda seed, threads, step: ([], compared))
    monkeypatch.setattr(build, "league_files", lambda ranked, paces: seen.append(paces) or truly(ranked, paces))
    (tmp_path / "timings").mkdir()
    head = "model,evaluation,evaluation_low,evaluation_high,sample,sample_low,sample_high"
    (tmp_path / LEAGUE).write_text(f"{head}\nlambert,1,2,3,4,5,6\n", encoding="utf-8")
    (tmp_path / "timings" / "README.md").write_text("times", encoding="utf-8")
    build.write_reports(tmp_path)
    assert seen == [{"lambert": (1.0, 2.0, 3.0, 4.0, 5.0, 6.0)}]
    once = contents(tmp_path)
    assert {f"{name}.{kind}" for name in ("league", "wards") for kind in ("md", "csv", "svg", "png")} <= set(
        json.loads(once["manifest.json"])["sha256"]
    )
    assert b"(league.md)" in once["README.md"]
    assert b"(wards.md)" in once["README.md"]
    assert b'id="league"' in once["index.html"]
    build.write_reports(tmp_path)
    assert contents(tmp_path) == once
    build.write_reports(tmp_path / "some", ["small"])
    assert "league.md" not in contents(tmp_path / "some")


def test_progress_counts_to_the_end(tmp_path, monkeypatch):
    def two_thirds(seed, threads, progress):
        for done in (1, 2, 3):
            progress(done, 3)
        return []

    monkeypatch.setattr(build, "cards", two_thirds)
    seen = []
    build.write_reports(tmp_path, progress=lambda done, total: seen.append((done, total)))
    assert seen == [(done, seen[0][1]) for done in range(1, seen[0][1] + 1)]


def test_interrupted_it_writes_nothing(tmp_path):
    def stop(done, total):
        if done == len(PAPER.statements) + 3:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        build.write_reports(tmp_path, progress=stop)
    assert contents(tmp_path) == {}


def test_an_unknown_paper_is_bad_input(tmp_path, monkeypatch):
    monkeypatch.undo()
    with pytest.raises(BadInput, match="neumann1999"):
        build.write_reports(tmp_path / "reports", ["neuman1999"])
    assert not (tmp_path / "reports").exists()
