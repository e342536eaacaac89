"""Model cards: for each model of the catalogue what it is, how it reflects, and what the checks find, as HTML and as Markdown.

Every figure on a card comes from `analysis.card`, every picture from `pictures`; here they are asked for and laid out.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from importlib.resources import files
from typing import Any

from jinja2 import DictLoader, Environment, StrictUndefined
from markupsafe import Markup

from albedo_lab.analysis.card import LAST, NEAR, NEARER, Albedo, Facts, facts
from albedo_lab.analysis.check import CHECKS, everyone
from albedo_lab.analysis.grazing import GrazingLaw
from albedo_lab.analysis.rows import Progress, degrees_of, figures
from albedo_lab.analysis.verdict import Finding, Verdict
from albedo_lab.digits import typeset, with_error
from albedo_lab.estimate.record import Estimate, bounded
from albedo_lab.model import Maximum, Reference
from albedo_lab.pictures.albedos import Albedos
from albedo_lab.pictures.base import Curve, Picture
from albedo_lab.pictures.lobes import Lobes
from albedo_lab.pictures.samples import ROUNDING
from albedo_lab.report.drawing import render
from albedo_lab.report.drawing.albedos import OVER
from albedo_lab.report.drawing.samples import rounded
from albedo_lab.report.drawing.style import written
from albedo_lab.report.findings import ORDER, WORDS
from albedo_lab.report.formats import as_markdown
from albedo_lab.report.html.svg import embedded

FINEST = 1e-8
"""No figure is shown finer."""
JUDGED = ("finiteness", "positivity", "energy", "reciprocity", "sampler")
"""The checks of the model itself; grazing and quality are told and not judged, claims are their authors'."""
LIGHTS = (15.0, 45.0, 75.0)
"""Degrees from the normal of the lights whose lobes are drawn."""
FIGURES = ("", "by quadrature", "by samples")
PARAMETERS = ("name", "meaning", "domain", "default")
CHECKED = ("check", "verdict", "found")
CLAIMED = ("claim", "verdict", "found")
SAMPLED = ("viewer", "variance of the weight", "largest weight", "rejected", "efficiency")
SAMPLING = (
    "Variance of a sample's weight in units of its squared mean, largest weight in units of the mean, share of samples below the "
    "horizon, and efficiency: how many samples drawn by the cosine are worth one."
)
MOODS = {Verdict.PASS: "good", Verdict.FAIL: "bad"}
"""Classes of the page; every other verdict leaves the question open."""
CLAIM_WORDS = {Verdict.PASS: "found", Verdict.FAIL: "refuted", Verdict.INCONCLUSIVE: "left open", Verdict.SKIPPED: "not meant"}


@dataclass(frozen=True)
class Card:
    """The facts of a model, and its pictures: files of the kind "svg" by the names of PICTURES."""

    facts: Facts
    pictures: dict[str, dict[str, bytes]]

    @property
    def name(self) -> str:
        """The model's name in the catalogue."""
        return self.facts.name


def lobes(known: Facts) -> Picture:
    """The light that the model sends to every viewer."""
    return Lobes((Curve(known.name, known.subject.model),), LIGHTS)


def albedos(known: Facts) -> Picture:
    """The model's albedo from normal to grazing incidence."""
    seen = known.albedos[0].grazing
    limits = {known.name: seen.limit} if len(known.albedos) == 1 and math.isfinite(seen.limit) else {}
    return Albedos((Curve(known.name, known.subject.model),), limits, to_grazing=True)


PICTURES: Mapping[str, tuple[str, Callable[[Facts], Picture]]] = {
    "lobe": (
        f"Where {{}} sends light from {', '.join(f'{theta:g}°' for theta in LIGHTS)}: the radiance towards every viewer",
        lobes,
    ),
    "albedo": (
        "The albedo of {}, the share of the light that it reflects, against the angle of incidence and its cosine",
        albedos,
    ),
}
"""What each picture shows, and what it is made of."""


def cards(seed: int = 0, threads: int | None = None, progress: Progress | None = None, models: Sequence[str] = ()) -> list[Card]:
    """The cards of those models, by default of the whole catalogue but what needs a file, in the order of the catalogue.

    Computes everything that stands on them; the same seed gives the same bytes. `progress` is called with the number of steps
    done and of all: every check and every picture is a step. Raises BadInput for an unknown model.
    """
    names = list(models) or everyone()
    checks, total = len(names) * len(CHECKS), len(names) * (len(CHECKS) + len(PICTURES))
    tell = progress or (lambda done, total: None)
    known = facts(names, seed=seed, threads=threads, progress=lambda done, _: tell(done, total))
    made = []
    for i, each in enumerate(known):
        drawn = {}
        for j, (name, (_, picture_of)) in enumerate(PICTURES.items(), start=1):
            picture = picture_of(each)
            drawn[name] = render(picture, picture.trace(threads), ("svg",))
            tell(checks + i * len(PICTURES) + j, total)
        made.append(Card(each, drawn))
    return made


def card_html(card: Card) -> str:
    """A card as the content of an element: headings from h3 on, classes as those of the page, pictures embedded."""
    known, model = card.facts, card.facts.subject.model
    content: str = _template().render(
        card=card,
        model=model,
        verdict=worst(known.findings),
        verdict_words=verdict_words(known),
        badge=badge,
        pictures={
            name: Markup(embedded(card.pictures[name], f"card-{card.name}-{name}", said.format(card.name)))
            for name, (said, _) in PICTURES.items()
        },
        captions={name: said.format(card.name) for name, (said, _) in PICTURES.items()},
        figures=figure_rows(known),
        parameters=parameter_rows(known),
        references=[(str(source), source.deviations) for source in (model.source, *model.also)],
        checks=check_rows(known),
        claims=claim_rows(known),
        claim_words=CLAIM_WORDS,
        sampled=sampling_rows(known),
        unsampled=unsampled(known),
        sampling=SAMPLING,
        heads={"figures": FIGURES, "parameters": PARAMETERS, "checks": CHECKED, "claims": CLAIMED, "sampled": SAMPLED},
    )
    return content


def card_markdown(card: Card) -> str:
    """A card as a page of Markdown; its pictures lie beside it as `card_files` names them."""
    known, model = card.facts, card.facts.subject.model
    parts = [
        f"# {card.name}",
        model.summary,
        f"**{verdict_words(known)}**",
        f"    f_r = {model.formula}",
        *(f"![{said.format(card.name)}]({card.name}_{name}.svg)" for name, (said, _) in PICTURES.items()),
        "## Albedo",
        as_markdown(FIGURES, figure_rows(known)),
        "## Parameters",
        as_markdown(PARAMETERS, parameter_rows(known)),
        "## Source",
        "\n".join(line for source in (model.source, *model.also) for line in _source_lines(source)),
        "## Checks",
        as_markdown(CHECKED, [(name, WORDS[verdict], found) for name, verdict, found in check_rows(known)]),
    ]
    if claim_rows(known):
        claims = [(claim, claim_word(verdict), found) for claim, verdict, found in claim_rows(known)]
        parts += ["## What its authors claim", as_markdown(CLAIMED, claims)]
    parts += ["## Sampling", unsampled(known) or f"{as_markdown(SAMPLED, sampling_rows(known))}\n{SAMPLING}"]
    return "\n\n".join(part.rstrip() for part in parts) + "\n"


def card_files(card: Card) -> dict[str, str | bytes]:
    """All files of a card by their names: the page of Markdown, and beside it the pictures."""
    pictures = {f"{card.name}_{name}.{kind}": content for name, kinds in card.pictures.items() for kind, content in kinds.items()}
    return {f"{card.name}.md": card_markdown(card), **pictures}


# What stands on a card, the same in HTML and in Markdown


def worst(findings: Iterable[Finding]) -> Verdict:
    """The verdict that decides: FAIL before INCONCLUSIVE before PASS; SKIPPED or REPORTED where nothing else is found."""
    severity = (Verdict.FAIL, Verdict.INCONCLUSIVE, Verdict.PASS, Verdict.SKIPPED, Verdict.REPORTED)
    return min((finding.verdict for finding in findings), key=severity.index, default=Verdict.SKIPPED)


def verdict_words(known: Facts) -> str:
    """The card's verdict in a line: how many findings are of which kind, and which checks are to blame for the bad ones."""
    parts = []
    for kind in ORDER:
        found = [finding for finding in known.findings if finding.verdict is kind]
        if found and kind is not Verdict.REPORTED:
            blamed = ", ".join(dict.fromkeys(finding.check for finding in found))
            parts.append(f"{len(found)} {WORDS[kind]}" + (f" ({blamed})" if kind is not Verdict.PASS else ""))
    return ", ".join(parts)


def figure_rows(known: Facts) -> list[tuple[str, str, str]]:
    """The albedo's figures under FIGURES, for each order of integration where there are two."""
    rows = [row for albedo in known.albedos for row in _albedo_rows(albedo, known)]
    if known.mirror:
        share = ", ".join(f"{value:.4g} at {theta:.4g}°" for theta, value in known.mirror)
        rows.append(("of this in the mirror direction alone", share, "closed form"))
    return rows


def _albedo_rows(albedo: Albedo, known: Facts) -> list[tuple[str, str, str]]:
    """The figures of one order."""
    over = f", {OVER[albedo.order]}" if len(known.albedos) > 1 else ""
    largest_again, mean_again, slope_again = map(figure, albedo.again)
    last = f"{figure(albedo.last)} at μ = {written(LAST)}"
    if math.isinf(albedo.largest.value):
        largest = "unbounded, towards grazing incidence", last
    elif albedo.mu == 0.0:
        largest = f"{figure(albedo.largest)}, the limit at grazing incidence", last
    else:
        turn = "" if known.subject.model.isotropic(known.subject.p) else f", φ = {math.degrees(albedo.phi):.4g}°"
        largest = f"{figure(albedo.largest)} at θ = {degrees_of(albedo.mu):.4g}°{turn}", largest_again
    return [
        (f"largest albedo{over}", *largest),
        (f"mean albedo{over}", figure(albedo.mean), mean_again),
        (f"exponent from μ = {written(NEAR)} to {written(NEARER)}{over}", figure(albedo.slope), slope_again),
        (f"as μ → 0{over}", limit_words(albedo.grazing), last),
    ]


def limit_words(seen: GrazingLaw) -> str:
    """How the albedo ends: its limit, or the power of its cosine that it follows, as far as that is known."""
    if seen.behaviour == "bounded":
        return f"bounded, a → {figure(bounded(seen.limit, seen.limit_error, 0, 'quadrature'))}"
    s = seen.exponent
    if seen.behaviour not in ("vanishes", "diverges") or not math.isfinite(s.value):
        return seen.behaviour
    if s.low <= 0.0 <= s.high:  # what vanishes has no exponent below 0, what diverges none above
        low, high = (0.0, s.high) if seen.behaviour == "vanishes" else (s.low, 0.0)
        return f"{seen.behaviour} slowly, a ~ μ^s with s between {low:.2g} and {high:.2g}"
    return f"{seen.behaviour}, a ~ μ^s with s = {figure(s)}"


def figure(e: Estimate) -> str:
    """A figure with its error; a dash for what is no number."""
    if math.isfinite(e.value) and math.isfinite(e.half_width):
        return with_error(e, FINEST)
    return "—" if math.isnan(e.value) else f"{e.value:.7g}".replace("inf", "∞")


def number_rows(known: Facts) -> list[dict[str, object]]:
    """The figures of figure_rows with every digit, for machines: a row a figure, first by quadrature, then by samples."""
    rows: list[dict[str, object]] = []
    for a in known.albedos:
        ours = {"largest_albedo": a.largest, "mean_albedo": a.mean, "slope": a.slope, "exponent": a.grazing.exponent}
        ours["limit"] = bounded(a.grazing.limit, a.grazing.limit_error, a.grazing.exponent.samples, "quadrature")
        again = dict(zip(ours, a.again, strict=False)) | {f"albedo_at_{LAST:g}": a.last}
        for quantity, e in (*ours.items(), *again.items()):
            rows.append({"order": a.order, "quantity": quantity} | figures("value", e))
    return rows


def parameter_rows(known: Facts) -> list[tuple[str, str, str, str]]:
    """Choices, parameters and the constant under PARAMETERS."""
    model = known.subject.model
    rows = [(choice.name, choice.meaning, choice.domain, str(choice.default)) for choice in model.choices]
    for parameter in model.parameters:
        unit = f" {parameter.unit}" if parameter.unit else ""
        sets = f"; sets {' and '.join(parameter.sets)}" if parameter.sets else ""
        rows.append((parameter.name, parameter.meaning + sets, parameter.domain + unit, f"{parameter.default:g}{unit}"))
    prescribed = (
        "the largest that energy balance allows, computed" if isinstance(model.scale, Maximum) else "as the source has it"
    )
    printed = model.paper_constant(known.subject.p)
    beside = "" if math.isnan(printed) else f"; the source prints {printed:.8g} as the largest"
    symbol = "" if model.scale_symbol == "scale" else f"{model.scale_symbol}: "
    rows.append(("scale", f"{symbol}{prescribed}{beside}", "at least 0", figure(known.subject.scale)))
    return rows


def check_rows(known: Facts) -> list[tuple[str, Verdict, str]]:
    """What every check of JUDGED found, under CHECKED."""
    found = [(name, known.of(name)) for name in JUDGED]
    return [(name, worst(findings), told(findings)) for name, findings in found if findings]


def claim_rows(known: Facts) -> list[tuple[str, Verdict, str]]:
    """What the authors claim, and what was found, under CLAIMED."""
    rows = []
    for finding in known.of("claims"):
        claim = typeset(finding.claim).replace("`value(p)`", "a value that follows from its parameters")
        rows.append((claim, finding.verdict, told([finding]).removeprefix(f"{claim_word(finding.verdict)}: ")))
    return rows


def claim_word(verdict: Verdict) -> str:
    """What a verdict means for a claim."""
    return CLAIM_WORDS.get(verdict, WORDS[verdict])


def told(findings: Sequence[Finding]) -> str:
    """What several findings of one check say: all that accuse or are open; of those that passed, the one nearest to failing."""
    verdict = worst(findings)
    deciding = [finding for finding in findings if finding.verdict is verdict]
    tests = [finding for finding in deciding if finding.p_value is not None]
    if verdict is Verdict.PASS and len(tests) > 1:
        nearest = min(tests, key=lambda finding: finding.p_value or 0.0)
        return f"{len(tests)} tests; the nearest to failing, p = {nearest.p_value:.2g}: {typeset(nearest.statement)}"
    return typeset("; ".join(map(_with_witness, deciding)))


def _with_witness(finding: Finding) -> str:
    """What a finding says, and its witness where that says more; without the call of Python that shows the same."""
    witness = finding.witness.partition("; m = ")[0]
    return finding.statement if witness in finding.statement else f"{finding.statement}. Witness: {witness}"


def sampling_rows(known: Facts) -> list[tuple[str, ...]]:
    """How good the model's own sampler is, for every viewer that it was tried for, under SAMPLED."""
    rows: list[tuple[str, ...]] = []
    for finding in known.of("quality"):
        if "mu" in (d := finding.details):
            share = f"{100.0 * d['rejected']:.3g} %"
            gain = "∞" if math.isinf(d["efficiency"]) else rounded(d["efficiency"])
            spread = f"{d['variance']:.3g}" if d["variance"] > ROUNDING**2 else "0"
            rows.append((f"{degrees_of(d['mu']):.4g}°", spread, f"{d['largest']:.3g}", share, gain))
    return rows


def unsampled(known: Facts) -> str:
    """Why there is nothing to say of a sampler; empty where there is."""
    if sampling_rows(known):
        return ""
    why = told(known.of("quality")) or "the sampler was not tried"
    return f"{why[:1].upper()}{why[1:]}."


def badge(verdict: Verdict, word: str = "") -> dict[str, str]:
    """Class and word of a verdict's badge."""
    return {"mood": MOODS.get(verdict, "open"), "word": word or WORDS[verdict]}


def _source_lines(source: Reference) -> list[str]:
    """A source as an item of a list, its deviations below."""
    return [f"- {source}", *(f"  - deviation: {deviation}" for deviation in source.deviations)]


@cache
def _template() -> Any:
    """The card's layout."""
    text = (files("albedo_lab.report") / "card.html.jinja").read_text(encoding="utf-8")
    environment = Environment(
        loader=DictLoader({"card": text}), autoescape=True, undefined=StrictUndefined, trim_blocks=True, lstrip_blocks=True
    )
    return environment.get_template("card")
