"""The league: what stands in it is what the cards know, nothing is computed twice, and each model has its row and its dot."""

import csv
import io
import math
import re
from dataclasses import replace

import matplotlib as mpl
import pytest
from matplotlib.colors import to_hex

from albedo_lab.analysis import league as analysis
from albedo_lab.analysis.card import facts
from albedo_lab.analysis.check import CHECKS
from albedo_lab.analysis.league import standings
from albedo_lab.analysis.timing import Pace
from albedo_lab.analysis.verdict import Finding, Verdict
from albedo_lab.digits import with_error
from albedo_lab.estimate.record import exact
from albedo_lab.pictures.league import COLUMNS
from albedo_lab.pictures.league import League as Picture
from albedo_lab.report.cards import Card
from albedo_lab.report.drawing.league import MARKS, draw, ending
from albedo_lab.report.drawing.style import STYLE
from albedo_lab.report.html.page import page
from albedo_lab.report.league import (
    ANGLE,
    HEAD,
    League,
    exponent_cell,
    league,
    league_csv,
    league_files,
    league_html,
    league_markdown,
    limit_cell,
    lines,
    verdict_of,
)

NAMES = ["lambert", "mirror", "phong", "phong_original"]
PACES = {"phong": Pace(10.04, 9.0, 11.0, 20.06, 19.0, 21.0), "mirror": Pace(1.0, 1.0, 1.0, math.nan, math.nan, math.nan)}


@pytest.fixture(scope="module")
def known():
    """Facts without the checks that take a million samples each; of the sampler's quality something is made up."""
    details = [{"mu": mu, "variance": v, "efficiency": gain} for mu, v, gain in ((0.5, 1.0, 40.0), (0.25, 0.25, 3.0))]
    made_up = [Finding("quality", Verdict.REPORTED, 1.0, math.nan, "told", details=each) for each in details]
    with pytest.MonkeyPatch.context() as patch:
        patch.setitem(CHECKS, "sampler", lambda *_: [])
        patch.setitem(CHECKS, "quality", lambda *_: made_up)
        return facts(NAMES)


@pytest.fixture(scope="module")
def ranked(known):
    return league([Card(each, {}) for each in known])


@pytest.fixture(scope="module")
def rows(ranked):
    """The cells of people's table by the column and the row's name."""
    return {line.cells[0].words: dict(zip(HEAD._fields, line.cells, strict=True)) for line in lines(ranked.standings, PACES)}


def parsed(text):
    return list(csv.DictReader(io.StringIO(text)))


def test_the_figures_are_those_of_the_facts(known, rows):
    phong = known[2].albedos[0]
    row = rows["phong"]
    assert row["mean"].line == with_error(phong.mean, 1e-5)
    assert row["largest"].line == f"{with_error(phong.largest, 1e-5)} at 0°"
    assert row["limit"].line == "0.03979 ± 0.00001"
    assert row["exponent"].line == "0"
    assert row["share"].line == "50 % at 60°"
    assert row["efficiency"].line == "3 at 75.5°"
    assert (row["evaluation"].words, row["sample"].words) == ("10", "20.1")


def test_nothing_that_the_cards_know_is_computed_again(known, monkeypatch):
    """At the defaults no albedo is asked for: only the parameters that were moved are new."""
    asked = []
    truly = analysis.supremum
    monkeypatch.setattr(analysis, "supremum", lambda model, p, order: asked.append((model.name, p)) or truly(model, p, order))
    assert standings(known)[2].facts is known[2]
    assert [name for name, _ in asked] == ["phong", "phong_original", "phong_original"]
    assert all(p.n < 10.0 for _, p in asked)


def test_equally_wide(ranked, rows):
    """Values that tests/analysis/test_spread.py has in closed form, as they are shown."""
    assert rows["phong"]["parameter"].words == "n = 9.14341"
    assert rows["phong"]["wide_largest"].line == "1.00000 ± 0.00001 at 0°"
    assert rows["lambert"]["parameter"].words == "not compared"
    assert rows["lambert"]["median"].line == "45.00000 ± 0.00001°"
    assert rows["mirror"]["median"].line == "0°"
    assert rows["mirror"]["wide_mean"].words == rows["mirror"]["sample"].words == "—"
    level = ranked.standings[3].levels[0]  # at normal incidence (n + 2) times the integral of cos^n sin
    n = ranked.standings[3].wide.value
    assert level.largest.value == pytest.approx((n + 2.0) / (n + 1.0), abs=1e-6)


def test_both_orders_of_what_is_not_reciprocal(rows, ranked):
    viewer, light = rows["phong_original, for a viewer"], rows["phong_original, for a light"]
    assert viewer["limit"].line == "0.50495 ± 0.00001"
    assert (light["largest"].line, light["limit"].line, light["exponent"].line) == ("∞ at 90°", "∞", "-1.00000 ± 0.00001")
    assert light["verdict"].line == "failed (energy, reciprocity)"
    assert [row["order"] for row in parsed(league_csv(ranked, PACES))] == ["wi", "wi", "wi", "wi", "wo"]


def test_every_digit_for_machines(ranked, known):
    row = {row["model"]: row for row in parsed(league_csv(ranked, PACES))}
    assert float(row["phong"]["mean_albedo"]) == known[2].albedos[0].mean.value
    assert float(row["phong"]["wide_mean_albedo_high"]) == ranked.standings[2].levels[0].mean.high
    assert float(row["phong"]["ns_sample"]) == 20.06
    assert row["lambert"]["ns_evaluation"] == row["lambert"]["wide_value"] == row["mirror"]["ns_sample"] == ""
    assert abs(float(row["phong"]["wide_median_angle_deg"]) - ANGLE) < 1e-4


def test_markdown_is_one_table_and_its_files_are_there(ranked):
    files = league_files(ranked, PACES)
    assert set(files) == {"league.md", "league.csv", "league.svg", "league.png"}
    text = files["league.md"]
    table = [line for line in text.splitlines() if line.startswith("|")]
    assert len(table) == 2 + 5
    assert len({line.count("|") for line in table}) == 1
    targets = set(re.findall(r"\]\(([^)]+)\)", text))
    assert targets == {"league.csv", "league.svg", "league.png", "timings/README.md", *(f"models/{name}.md" for name in NAMES)}
    assert league_markdown(ranked, {}).count("| — | — |\n") == 5, "without times, dashes"


def test_the_page_has_a_sortable_table(ranked, known):
    html = str(league_html(ranked, PACES))
    assert html.count("<tr>") == 1 + 5
    assert 'data-sort="inf"' in html, "as the script reads infinity"
    assert "nan" not in re.findall(r'data-sort="([^"]*)"', html)
    whole = page([], {}, [], 0, {}, league_html(ranked, PACES))
    assert 'id="league"' in whole
    assert 'href="#league"' in whole
    assert "How the models are compared" not in page([], {}, [], 0, {})


def test_the_picture_has_a_row_for_each_and_marks_what_failed(ranked):
    found = ranked.standings
    picture = Picture(found, {standing.name: verdict_of(standing) for standing in found}, ANGLE)
    data = picture.trace()
    assert list(data[""].columns) == list(COLUMNS)
    with mpl.rc_context(STYLE):
        left, right = draw(picture, data).axes
    said = [text.get_text() for text in left.texts]
    assert [name for name in said if name in NAMES] == ["mirror", "phong", "lambert"]
    assert {"about the mirror direction", "about the normal", "phong_original, viewer", "light", "∞"} <= set(said)
    heights = {
        text.get_text(): text.get_position()[1] for text in left.texts if text.get_text() in ("phong_original, viewer", "lambert")
    }
    colours = {round(line.get_ydata()[0]): to_hex(line.get_color()) for line in left.get_lines() if len(line.get_xdata()) == 2}
    assert colours[round(heights["phong_original, viewer"])] == MARKS[Verdict.FAIL]["color"].lower()
    assert colours[round(heights["lambert"])] == MARKS[Verdict.PASS]["color"].lower()
    assert "n = 9.143" in [text.get_text() for text in right.texts]
    assert "median 45°" in [text.get_text() for text in right.texts]


def test_how_an_albedo_ends(ranked):
    table = Picture(ranked.standings, dict.fromkeys(NAMES, Verdict.PASS), ANGLE).trace()[""]
    assert [ending(row) for _, row in table.iterrows()][2:] == ["→ 0.0398", "→ 0.505", "↗ ∞  μ$^{−1}$"]
    slow = table.iloc[4].copy()
    slow["exponent_high"], slow["behaviour"] = 0.1, "vanishes"
    assert ending(slow) == "↘ 0, slowly"
    slow["behaviour"] = "undecided"
    assert ending(slow) == "undecided"


def test_what_is_unknown_has_its_place(ranked):
    """A model whose law is undecided, and whose checks came to no end."""
    phong = ranked.standings[2]
    law = replace(phong.facts.albedos[0].grazing, behaviour="undecided", exponent=exact(math.nan))
    assert (exponent_cell(law).line, limit_cell(law).line) == ("—", "undecided")
    lost = replace(phong.facts.albedos[0], grazing=law, mean=exact(math.nan))
    sick = replace(phong, facts=replace(phong.facts, albedos=(lost,), findings=()), median=exact(math.nan), wide=None, levels=())
    league_html(League((sick,), ranked.drawn), {})
    assert "undecided" in league_markdown(League((sick,), ranked.drawn), {})
    picture = Picture((sick,), {"phong": Verdict.SKIPPED}, ANGLE)
    with mpl.rc_context(STYLE):
        draw(picture, picture.trace())


def test_a_broken_twin_is_seen(known, rows):
    """With the mean of the other order or another digit the row is another: the comparison above can fail."""
    twin = replace(known[2], albedos=(replace(known[2].albedos[0], mean=exact(0.5)),))
    (line,) = lines(standings([twin]), PACES)
    assert line.cells[HEAD._fields.index("mean")] != rows["phong"]["mean"]
