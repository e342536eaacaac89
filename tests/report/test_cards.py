"""Model cards: all that was found stands on them, in HTML that a page can hold and in Markdown that finds its pictures."""

import math
import re
from dataclasses import replace
from html.parser import HTMLParser

import pytest

from albedo_lab import BadInput, find
from albedo_lab.analysis.card import Facts
from albedo_lab.analysis.check import CHECKS
from albedo_lab.analysis.grazing import GrazingLaw
from albedo_lab.analysis.sampler import VIEWERS
from albedo_lab.analysis.verdict import Finding, Subject, Verdict
from albedo_lab.digits import with_error
from albedo_lab.estimate.record import bounded, exact
from albedo_lab.report import cards as module
from albedo_lab.report.build import model_files
from albedo_lab.report.cards import (
    JUDGED,
    PICTURES,
    Card,
    card_files,
    card_html,
    card_markdown,
    cards,
    figure,
    figure_rows,
    limit_words,
    number_rows,
    sampling_rows,
    told,
    verdict_words,
    worst,
)
from albedo_lab.report.html.page import page

NAMES = ["phong_original", "mirror", "microfacet"]
VOID = {"img", "br", "meta", "link", "use"}


class Page(HTMLParser):
    """What a fragment of HTML holds; raises where elements are not nested."""

    def __init__(self, text):
        super().__init__()
        self.open, self.headings, self.ids, self.references, self.text = [], [], [], [], []
        self.tables_outside, self.cells = 0, 0
        self.feed(text)
        assert self.open == []

    def handle_starttag(self, tag, attributes):
        named = dict(attributes)
        self.ids += [named["id"]] if "id" in named else []
        self.references += [value for key, value in attributes if key in ("href", "src", "xlink:href")]
        self.headings += [tag] if re.fullmatch(r"h\d", tag) else []
        self.tables_outside += tag == "table" and not any(classes == "scroll" for _, classes in self.open)
        self.cells += tag in ("td", "th")
        if tag not in VOID:
            self.open.append((tag, named.get("class")))

    def handle_startendtag(self, tag, attributes):
        self.handle_starttag(tag, attributes)
        if tag not in VOID:
            self.open.pop()

    def handle_endtag(self, tag):
        if tag not in VOID:
            assert self.open.pop()[0] == tag

    def handle_data(self, data):
        self.text.append(data)


def some_finding(verdict, statement="said", check="quality", **more):
    return Finding(check, verdict, 1.0, math.nan, statement, **more)


@pytest.fixture(scope="module")
def some():
    """Three cards, without the checks that take a million samples each: not reciprocal; a Dirac part; with choices."""
    with pytest.MonkeyPatch.context() as patch:
        for name in ("sampler", "quality"):
            patch.setitem(CHECKS, name, lambda *_, check=name: [some_finding(Verdict.SKIPPED, "left out", check)])
        return {card.name: card for card in cards(models=NAMES)}


@pytest.fixture(scope="module")
def whole():
    """A card with every check, and the steps that it took."""
    steps = []
    (card,) = cards(models=["lambert"], threads=2, progress=lambda done, total: steps.append((done, total)))
    return card, steps


def rows_of(markdown):
    """The rows of all tables of a page of Markdown, as cells."""
    lines = [line for line in markdown.splitlines() if line.startswith("|")]
    return [[cell.strip() for cell in re.split(r"(?<!\\)\|", line)[1:-1]] for line in lines]


@pytest.mark.parametrize("name", NAMES)
def test_html_that_a_page_can_hold(some, name):
    page = Page(card_html(some[name]))
    assert page.headings[0] == "h3"
    assert set(page.headings[1:]) == {"h4"}
    assert page.tables_outside == 0
    assert len(page.ids) == len(set(page.ids))
    assert all(target.startswith(("#", "data:image/png;base64,")) for target in page.references)
    icons = {f"icon-{mood}" for mood in ("good", "bad", "open")}  # the page's
    assert {target[1:] for target in page.references if target.startswith("#")} <= {*page.ids, *icons}


def test_ids_are_unique_among_cards(some):
    several = [Page(card_html(card)).ids for card in some.values()]
    assert len({name for ids in several for name in ids}) == sum(map(len, several)) > 0


@pytest.mark.parametrize("name", NAMES)
def test_all_that_is_known_stands_on_both(some, name):
    card = some[name]
    html, markdown = " ".join(Page(card_html(card)).text), card_markdown(card)
    model = card.facts.subject.model
    for text in (html, markdown):
        assert model.formula in text
        assert model.summary in text
        for thing in (*model.parameters, *model.choices):
            assert thing.meaning in text.replace(r"\|", "|")
            assert thing.domain in text
        for source in (model.source, *model.also):
            assert all(part in text for part in (source.title, source.equation, *source.deviations))
        for finding in card.facts.findings:
            if finding.check in JUDGED:
                assert finding.check in text
        assert verdict_words(card.facts) in text
        for row in figure_rows(card.facts):
            assert all(cell in text for cell in row)


def test_the_figures_are_those_of_the_facts(some):
    viewer, light = some["phong_original"].facts.albedos
    rows = {row[0]: row[1:] for row in figure_rows(some["phong_original"].facts)}
    assert rows["mean albedo, for a viewer"] == (with_error(viewer.mean, 1e-8), with_error(viewer.again[1], 1e-8))
    assert rows["largest albedo, for a viewer"][1] == with_error(viewer.again[0], 1e-8)
    assert rows["exponent from μ = 10⁻³ to 10⁻⁵, for a viewer"] == tuple(
        with_error(e, 1e-8) for e in (viewer.slope, viewer.again[2])
    )
    assert rows["largest albedo, for a light"][0] == "unbounded, towards grazing incidence"
    assert rows["largest albedo, for a viewer"][0].startswith("1.00990099 ± 0.00000001 at θ = ")
    assert rows["as μ → 0, for a light"][0].startswith("diverges, a ~ μ^s with s = -1.000000")
    assert light.last.value > 1e4
    assert figure_rows(some["mirror"].facts)[-1][1].startswith("1 at 5°, 1 at 45°, 1 at 80°")


def test_every_digit_for_machines(some):
    viewer, light = some["phong_original"].facts.albedos
    rows = {(row["order"], row["quantity"], row["method"]): row for row in number_rows(some["phong_original"].facts)}
    assert len(rows) == 2 * (5 + 4)
    assert rows["wi", "mean_albedo", "quadrature"]["value"] == viewer.mean.value
    assert rows["wi", "slope", "rqmc"]["ci95_high"] == viewer.again[2].high
    assert rows["wo", "largest_albedo", "quadrature"]["value"] == math.inf
    assert rows["wi", "limit", "quadrature"]["value"] == pytest.approx(51 / 101, rel=1e-8)
    assert rows["wo", "albedo_at_1e-06", "rqmc"]["value"] == light.last.value


def test_a_failure_shows_its_witness_and_is_blamed(some):
    phong = some["phong_original"]
    assert verdict_words(phong.facts).startswith("2 passed, 3 failed (energy, reciprocity), 2 skipped (sampler, quality)")
    rows = {row[0]: row for row in rows_of(card_markdown(phong))}
    assert rows["reciprocity"][1] == "failed"
    assert "Witness: wi at" in rows["reciprocity"][2]
    assert "evaluate" not in rows["reciprocity"][2]
    assert rows["positivity"][1] == "passed"
    assert 'class="badge bad"' in card_html(phong)
    assert 'class="badge bad"' not in card_html(some["mirror"])


@pytest.mark.parametrize("verdict", [verdict for verdict in Verdict if verdict is not Verdict.OPEN])
def test_however_a_check_ends_it_has_its_place(some, verdict):
    """Not only as a sound model ends it: a check that does not come to an end says why, and has no details."""
    card = some["mirror"]
    claim = some_finding(verdict, "no more time", "claims", claim="somebody: it is white.")
    found = tuple(some_finding(verdict, "no more time", check) for check in CHECKS if check != "claims")
    for findings in ((*found, claim), ()):
        ended = Card(replace(card.facts, findings=findings), card.pictures)
        markdown, html = card_markdown(ended), " ".join(Page(card_html(ended)).text)
        page(audits=[], drawn={}, cards=[ended], seed=0, timed={})
        model_files([ended])
        for text in (markdown, html):
            assert text.lower().count("no more time") == (len(JUDGED) + 2 if findings else 0)
        assert ("somebody: it is white." in markdown) is bool(findings)


def test_markdown_tables_are_tables_and_pictures_are_there(some):
    for card in some.values():
        files = card_files(card)
        page = files[f"{card.name}.md"]
        tables = [block for block in page.split("\n\n") if block.startswith("|")]
        assert len(tables) >= 3
        for table in tables:
            assert len({len(row) for row in rows_of(table)}) == 1
        pictures = re.findall(r"!\[.+\]\((.+)\)", page)
        assert len(pictures) == len(PICTURES)
        assert all(files[name].startswith(b"<?xml") and b"<svg" in files[name] for name in pictures)
        assert set(files) == {f"{card.name}.md", *(f"{card.name}_{n}.svg" for n in PICTURES)}


def test_a_card_with_every_check(whole):
    card, steps = whole
    assert [name for name, _, _ in module.check_rows(card.facts)] == list(JUDGED)
    assert len(sampling_rows(card.facts)) == len(VIEWERS)
    assert all(len(row) == len(module.SAMPLED) for row in sampling_rows(card.facts))
    total = len(CHECKS) + len(PICTURES)
    assert steps == [(done, total) for done in range(total + 1)]


def test_the_same_bytes_whatever_the_threads(monkeypatch):
    for name in CHECKS:
        monkeypatch.setitem(CHECKS, name, lambda *_, check=name: [some_finding(Verdict.PASS, check=check)])
    one, two = (card_files(cards(models=["phong"], threads=threads)[0]) for threads in (1, 2))
    assert one == two


def test_text_is_escaped(some):
    card = some["mirror"]
    sly = replace(card.facts.subject.model, formula="a < b & |c|", claims=())
    finding = Finding("positivity", Verdict.FAIL, 1.0, 0.0, "f < 0 | here", witness="<script>")
    known = replace(card.facts, subject=replace(card.facts.subject, model=sly), findings=(finding, *card.facts.of("quality")))
    html = card_html(Card(known, card.pictures))
    assert "a &lt; b &amp; |c|" in html
    assert "<script>" not in html
    assert r"f < 0 \| here. Witness: <script>" in card_markdown(Card(known, card.pictures))


def test_the_worst_verdict_decides():
    ranked = [Verdict.FAIL, Verdict.INCONCLUSIVE, Verdict.PASS, Verdict.SKIPPED, Verdict.REPORTED]
    for i, verdict in enumerate(ranked):
        assert worst([some_finding(other) for other in reversed(ranked[i:])]) is verdict


def test_of_several_tests_the_nearest_is_told():
    passed = [some_finding(Verdict.PASS, f"test {p}", p_value=p) for p in (0.5, 0.02, 0.9)]
    assert told(passed) == "3 tests; the nearest to failing, p = 0.02: test 0.02"
    failed = some_finding(Verdict.FAIL, "chi-square +- much", p_value=1e-9, witness="mu = 1")
    assert told([*passed, failed]) == "chi-square ± much. Witness: μ = 1"
    assert told([replace(failed, statement="at mu = 1")]) == "at μ = 1"  # a witness that says nothing new


def test_limits_in_words():
    law = GrazingLaw(bounded(-0.5, 1e-9, 0, "quadrature"), "diverges", math.inf, 0.0)
    assert limit_words(law) == "diverges, a ~ μ^s with s = -0.50000000 ± 0.00000001"
    slow = replace(law, behaviour="vanishes", exponent=bounded(-0.01, 0.1, 0, "quadrature"))
    assert limit_words(slow) == "vanishes slowly, a ~ μ^s with s between 0 and 0.09"
    assert limit_words(replace(slow, behaviour="diverges")) == "diverges slowly, a ~ μ^s with s between -0.11 and 0"
    assert limit_words(replace(law, behaviour="bounded", limit=0.25, limit_error=1e-4)) == "bounded, a → 0.2500 ± 0.0001"
    assert limit_words(replace(law, behaviour="undecided")) == "undecided"


def test_figures_that_are_none():
    assert figure(exact(math.inf)) == "∞"
    assert figure(exact(math.nan)) == "—"
    assert figure(bounded(math.nan, math.nan, 0, "quadrature")) == "—"
    assert figure(bounded(0.5, 1e-15, 0, "quadrature")) == "0.50000000 ± 0.00000001"


def test_an_unknown_model():
    with pytest.raises(BadInput, match="phonk"):
        cards(models=["phonk"])


def test_the_constant_and_what_the_source_prints():
    ward = find("ward")
    p = ward.bind({})
    rows = {row[0]: row for row in module.parameter_rows(Facts(Subject(ward, p, exact(ward.scale(p))), (), ()))}
    assert rows["scale"] == ("scale", "C_max: as the source has it; the source prints 1 as the largest", "at least 0", "1")
    assert rows["m"][1].endswith("; sets m_x and m_y")
