import itertools
import re
from html.parser import HTMLParser
from importlib.resources import files

import pytest

from albedo_lab.papers.verdict import Kind, Verdict
from albedo_lab.report.audited import audit
from albedo_lab.report.drawing import render
from albedo_lab.report.drawing.style import GRID, INK
from albedo_lab.report.html import page as pages
from albedo_lab.report.html import svg
from albedo_lab.report.html.prose import prose, words
from tests.report.small import FIGURE, NASTY, PAPER

VOID = {"meta", "link", "input", "img", "br"}


class Reader(HTMLParser):
    """What a browser would make of the page: elements, text without scripts, and whether every element is closed."""

    def __init__(self, text):
        super().__init__()
        self.elements, self.open, self.text = [], [], []
        self.feed(text)
        self.close()

    def handle_starttag(self, tag, attributes):
        self.elements.append((tag, dict(attributes)))
        if tag not in VOID:
            self.open.append(tag)

    def handle_startendtag(self, tag, attributes):
        self.elements.append((tag, dict(attributes)))

    def handle_endtag(self, tag):
        assert self.open.pop() == tag

    def handle_data(self, data):
        if not {"script", "style"} & set(self.open):
            self.text.append(data)

    def all(self, attribute):
        return [attributes[attribute] for _, attributes in self.elements if attribute in attributes]


@pytest.fixture(scope="module")
def drawn():
    return render(FIGURE.picture, FIGURE.picture.trace())


@pytest.fixture(scope="module")
def text(drawn):
    return pages.page([audit(PAPER)], {"small/figure_1": drawn}, [], 3, {"Table 1": "timings/table_1.md"})


@pytest.fixture(scope="module")
def read(text):
    return Reader(text)


def test_every_element_is_closed_and_every_name_is_used_once(read):
    assert read.open == []
    names = read.all("id")
    assert len(names) == len(set(names))


def test_every_link_within_the_page_leads_somewhere(read):
    targets = [href[1:] for href in read.all("href") if href.startswith("#")]
    targets += [name for attribute in ("aria-labelledby", "data-filters") for name in read.all(attribute)]
    assert set(targets) <= set(read.all("id"))
    assert "small-statement-nasty" in targets
    assert "small-table-table_1" in targets


def test_it_needs_no_other_file_and_no_network(text, read):
    assert not re.search(r"""(?:src|href|url|import|fetch)\s*[=("']+\s*(?:https?:)?//""", text)
    assert [source for source in read.all("src") if not source.startswith("data:")] == []
    assert [attributes for tag, attributes in read.elements if tag == "link" and not attributes["href"].startswith("data:")] == []


def test_what_documents_say_is_text_and_never_markup(text, read):
    assert "<script>alert" not in text
    assert re.sub(r"\^|(?<=\[a)_", "", NASTY) in "".join(read.text), "but for the signs of raised and lowered letters"
    assert sum(tag == "script" for tag, _ in read.elements) == 1


def test_headings_come_in_order(read):
    levels = [int(tag[1]) for tag, _ in read.elements if re.fullmatch("h[1-6]", tag)]
    assert levels[0] == 1
    assert levels.count(1) == 1
    assert all(below <= above + 1 for above, below in itertools.pairwise(levels))


def test_every_verdict_has_a_sign_and_a_word_beside_its_colour(text):
    badges = re.findall(r'<span class="badge (\w+)" title="[^"]+"><svg[^>]*><use href="#icon-(\w+)"/></svg>([^<]+)</span>', text)
    assert len(badges) == text.count('class="badge')
    assert all(mood == icon for mood, icon, _ in badges)
    assert {word for *_, word in badges} >= {"agrees", "holds", "refuted", "undecided", "off by 2 units", "off by 4 units"}


def test_every_statement_is_there_with_its_verdict(text):
    for statement in PAPER.statements:
        row = text[text.index(f'id="small-statement-{statement.name}"') :]
        assert 'class="badge' in row[: row.index("</tr>")]


def test_the_counts_add_up(read):
    said = "".join(read.text)
    assert "3 printed figures and 4 statements of 1 document on" in " ".join(said.split())
    rows = re.sub(r"\s+", " ", said)
    assert "seed 3" in rows


def test_a_model_leads_to_the_statements_about_it_by_document_and_place():
    cited = pages.citations("ward", [audit(PAPER)])
    assert cited == {"small": {"§2": ['<a href="#small-statement-sound">holds</a>']}}
    assert pages.citations("lambert", [audit(PAPER)]) == {}


def test_letters_below_a_bracket_are_lowered_and_names_are_not():
    assert str(words("(R·V)_M of plus_phong, k_d")) == "(R·V)<sub>M</sub> of plus_phong, k<sub>d</sub>"


def test_verdicts_sort_from_the_best_on():
    ranks = [
        pages.rank(verdict)
        for verdict in (
            Verdict(Kind.HOLDS, None),
            Verdict(Kind.OFF, 1),
            Verdict(Kind.OFF, 4),
            Verdict(Kind.REFUTED, 0),
            Verdict(Kind.UNDECIDED, None),
        )
    ]
    assert ranks == sorted(ranks)
    assert len(set(ranks)) == len(ranks)


def test_inline_pictures_take_the_theme_and_leak_nothing(drawn):
    text = svg.embedded(drawn, "p", "what <it> shows")
    assert INK not in text
    assert GRID not in text
    assert "var(--ink)" in text
    assert "<style" not in text
    assert "<metadata" not in text
    assert 'aria-label="what &lt;it&gt; shows"' in text
    assert all(name.startswith("p-") for name in Reader(text).all("id"))
    assert not re.search(r' d="[^"]*\.\d{3}', text)


def test_a_picture_too_heavy_to_be_drawn_inline_is_an_image(drawn, monkeypatch):
    monkeypatch.setattr(svg, "HEAVIEST", 0.01)
    text = svg.embedded(drawn, "p", "shows")
    assert '<img src="data:image/png;base64,' in text
    assert "<svg" not in text


@pytest.mark.parametrize(
    ("text", "html"),
    [
        ("a *b* **c** `d*e*`", "a <em>b</em> <strong>c</strong> <code>d*e*</code>"),
        ("2 * 3 * 4 < 5", "2 * 3 * 4 &lt; 5"),
        ("[x](y.md)", '<a href="y.md">x</a>'),
        ("f_r * g_r and a*b*c", "f<sub>r</sub> * g<sub>r</sub> and a*b*c"),
        (
            "plus_phong, `x^2`, x^-1.5, [z^+]^n, e^(-x^2) y",
            "plus_phong, <code>x^2</code>, x<sup>-1.5</sup>, [z<sup>+</sup>]<sup>n</sup>, e<sup>-x<sup>2</sup></sup> y",
        ),
        ("2^(1", "2^(1"),
    ],
)
def test_a_little_markdown(text, html):
    assert words(text) == html


def test_paragraphs_and_lists():
    assert prose("a\n\nb\n\n- c\n  d\n- e") == "<p>a</p>\n<p>b</p>\n<ul><li>c\n  d</li><li>e</li></ul>"


def contrast(one, two):
    """The ratio of WCAG 2.1."""

    def luminance(colour):
        channels = [int(colour[i : i + 2], 16) / 255.0 for i in (1, 3, 5)]
        linear = [c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4 for c in channels]
        return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]

    dark, light = sorted((luminance(one), luminance(two)))
    return (light + 0.05) / (dark + 0.05)


@pytest.mark.parametrize("theme", [0, 1], ids=["light", "dark"])
def test_text_is_readable_in_both_themes(theme):
    style = (files("albedo_lab.report.html") / "style.css").read_text(encoding="utf-8")
    tokens = {name: pair[theme] for name, *pair in re.findall(r"--(\S+): light-dark\((#\w{6}), (#\w{6})\)", style)}
    for ground in ("paper", "card"):
        for ink in ("ink", "soft", "accent"):
            assert contrast(tokens[ink], tokens[ground]) >= 4.5, (ink, ground)
    for mood in pages.MOODS:
        assert contrast(tokens[mood], tokens[f"{mood}-ground"]) >= 4.5, mood
        assert contrast(tokens[mood], tokens["paper"]) >= 4.5, mood
