"""Lays the audit out as one page of HTML."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from html import escape
from importlib.resources import files

from jinja2 import DictLoader, Environment, StrictUndefined
from markupsafe import Markup

from albedo_lab import __version__
from albedo_lab.papers.verdict import RULE, Kind, Verdict
from albedo_lab.report.audit_tables import again, as_printed, ours, place
from albedo_lab.report.audited import Audited, tally
from albedo_lab.report.cards import Card, badge, card_html, verdict_words, worst
from albedo_lab.report.front import HOW, STATED, TITLE, figure_files
from albedo_lab.report.html.prose import formula, prose, words
from albedo_lab.report.html.svg import embedded
from albedo_lab.report.league import HOW as LEAGUE_HOW
from albedo_lab.report.league import LEAD
from albedo_lab.report.league import TITLE as LEAGUE_TITLE
from albedo_lab.report.statements import corrected

MOODS = {
    "good": (Kind.AGREES, Kind.HOLDS),
    "slip": (Kind.OFF,),
    "bad": (Kind.REFUTED,),
    "open": (Kind.UNDECIDED,),
}
"""Verdicts that share a colour and a sign, from the best on."""
MOOD_WORDS = {"good": "agree or hold", "slip": "off in the last digit", "bad": "refuted", "open": "undecided"}
BRIEF = {Kind.AGREES: "agrees", Kind.HOLDS: "holds", Kind.REFUTED: "refuted", Kind.UNDECIDED: "undecided"}


def page(
    audits: Sequence[Audited],
    drawn: Mapping[str, Mapping[str, bytes]],
    cards: Sequence[Card],
    seed: int,
    timed: Mapping[str, str],
    league: Markup | None = None,
) -> str:
    """The whole report as HTML that needs no other file and no network.

    `drawn` are the pictures by document and name ("neumann1999/figure_5"), each of the kinds svg and png; `timed` the
    pages of measured times by title, which are linked and not shown, as they are not the same from run to run; `league` is
    the content of its section.
    """
    home = files(__package__)
    environment = Environment(
        loader=DictLoader({"page": (home / "page.html.jinja").read_text(encoding="utf-8")}),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
        keep_trailing_newline=True,
    )
    carded = {card.name for card in cards}
    titles = {f"{a.paper.name}/{figure.name}": f"{figure.place}: {figure.title}" for a in audits for figure in a.paper.figures}
    return environment.get_template("page").render(
        title=TITLE,
        version=__version__,
        seed=seed,
        how=HOW,
        stated=STATED,
        rule=RULE,
        style=Markup((home / "style.css").read_text(encoding="utf-8")),
        script=Markup((home / "script.js").read_text(encoding="utf-8")),
        audits=audits,
        total=sum((audited.tally() for audited in audits), Counter()),
        cells=sum(len(found) for audited in audits for found in audited.findings.values()),
        heard_all=sum(len(audited.evidence) for audited in audits),
        errata=[erratum for audited in audits for erratum in audited.paper.errata],
        drawn={name: Markup(embedded(drawn[name], name.replace("/", "-"), title)) for name, title in titles.items()},
        cards={card.name: Markup(card_html(card)) for card in cards},
        outcomes={card.name: (badge(worst(card.facts.findings)), verdict_words(card.facts)) for card in cards},
        cited={card.name: citations(card.name, audits) for card in cards},
        timed=timed,
        league=league,
        league_words={"title": LEAGUE_TITLE, "lead": LEAD, "how": LEAGUE_HOW},
        moods=MOODS,
        mood_words=MOOD_WORDS,
        mood=mood,
        number=number,
        brief=brief,
        rank=rank,
        tally=tally,
        corrected=lambda audited: [(erratum, found) for _, erratum, found in corrected([audited])],
        anchor=anchor,
        model_link=lambda model: link(f"#model-{model}", model) if model in carded else Markup("<code>{}</code>").format(model),
        prose=prose,
        formula=formula,
        words=words,
        place=place,
        as_printed=as_printed,
        ours=ours,
        again=again,
        figure_files=figure_files,
    )


def mood(kind: Kind) -> str:
    """The class of a verdict."""
    return next(name for name, kinds in MOODS.items() if kind in kinds)


def number(count: Counter[Kind], kinds: Iterable[Kind]) -> int:
    """How many verdicts are of these kinds."""
    return sum(count[kind] for kind in kinds)


def brief(verdict: Verdict) -> str:
    """A verdict as its badge says it."""
    return BRIEF.get(verdict.kind) or f"off by {verdict.units} unit{'s' * (verdict.units != 1)}"


def rank(verdict: Verdict) -> float:
    """Where a verdict stands when a table is sorted by it: the best first, and the smaller slips before the larger."""
    return list(MOODS).index(mood(verdict.kind)) + min(verdict.units or 0, 99) / 100.0


def anchor(audited: Audited, name: str) -> str:
    """Where on the page the evidence of that statement or table stands."""
    return f"{audited.paper.name}-{'statement' if name in audited.evidence else 'table'}-{name}"


def citations(model: str, audits: Sequence[Audited]) -> dict[str, dict[str, list[Markup]]]:
    """Links to the statements that are about a model, which say their verdicts, by document and place."""
    found: dict[str, dict[str, list[Markup]]] = {}
    for audited in audits:
        for statement, evidence in audited.statements():
            if model in statement.models:
                places = found.setdefault(audited.paper.name, {})
                places.setdefault(statement.place, []).append(
                    link(f"#{anchor(audited, statement.name)}", brief(evidence.verdict))
                )
    return found


def link(target: str, said: str) -> Markup:
    """A link within the page."""
    return Markup(f'<a href="{escape(target)}">{escape(said)}</a>')
