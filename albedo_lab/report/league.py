"""The league: every model of the catalogue side by side, as one table for the page, for Markdown and for machines.

Computes nothing: the facts are those of the model cards, the rest is from `analysis.league`, the times from the folder of times.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from importlib.resources import files
from typing import Any, NamedTuple

from jinja2 import DictLoader, Environment, StrictUndefined
from markupsafe import Markup

from albedo_lab.analysis.card import Albedo
from albedo_lab.analysis.grazing import GrazingLaw
from albedo_lab.analysis.league import Level, Standing, standings
from albedo_lab.analysis.rows import degrees_of
from albedo_lab.analysis.sampler import VIEWERS
from albedo_lab.analysis.spread import COMPARED
from albedo_lab.analysis.timing import Pace
from albedo_lab.analysis.verdict import Verdict
from albedo_lab.digits import with_error
from albedo_lab.estimate.record import Estimate, bounded
from albedo_lab.pictures.league import League as Picture
from albedo_lab.report.cards import Card, badge, worst
from albedo_lab.report.drawing import render
from albedo_lab.report.drawing.albedos import OVER
from albedo_lab.report.drawing.league import KINDS
from albedo_lab.report.drawing.samples import rounded
from albedo_lab.report.findings import WORDS
from albedo_lab.report.formats import as_csv, as_markdown
from albedo_lab.report.html.svg import embedded

NAME = "league"
TITLE = "The league of models"
FINEST = 1e-5
"""No figure of the table is shown finer; league.csv has every digit."""
ANGLE = math.degrees(COMPARED)
LEAD = "Every model of the catalogue that needs no file, side by side."
HOW = f"""\
**At the defaults** stand the figures of the model cards: the verdict over all checks, with those that failed; the largest
albedo and the angle of incidence at which it lies (90° is the limit); the mean albedo; how the albedo ends at grazing
incidence, a ~ μ^s, and its limit; and how good the model's own sampler is, for the least lucky of the viewers that the check
`quality` tries: which share of its samples counts, 1 / (1 + v) with v the relative variance of their weights, and how many
samples drawn by the cosine one is worth.

**Equally wide.** Parameters of different models mean different things, so models are compared where they do the same to a
beam: of the light that falls along the normal, half of what is reflected leaves within {ANGLE:g}° of the mirror direction.
The angle within which half of it leaves is the *median angle*; it needs nothing but f, counts diffuse parts and Dirac parts
with the rest, and is 45° for Lambert's surface. For each model one parameter is moved, all others stay at their defaults:
the one that its record names as its width, else the first logarithmic one for which there is exactly one such value. It is
found to six digits, and the figures are those at these very digits. A model that has no such parameter (a diffuse one, or
one whose diffuse part holds more than half of the light) is not compared: its own median angle stands there. A width at
normal incidence says nothing of that at other angles. Models whose source prescribes the largest constant that energy
balance allows have a largest albedo of 1 by that constant: of those compare the mean.

**Times** are nanoseconds of one evaluation of f and of one weighted sample for a viewer at 45°, at the defaults, measured
once on [the machine that the pages of times name](timings/README.md); a dash where none were. All other figures carry a
bound of their error."""
PICTURE = (
    f"Mean and largest albedo of each model, at its defaults and where half of the light stays within {ANGLE:g}° of the mirror "
    "direction, grouped by what its lobe turns about"
)


class Head(NamedTuple):
    """The columns for people."""

    model: str = "model"
    verdict: str = "verdict"
    largest: str = "largest albedo"
    mean: str = "mean albedo"
    exponent: str = "grazing s"
    limit: str = "grazing limit"
    median: str = "median angle"
    share: str = "samples that count"
    efficiency: str = "against cosine"
    parameter: str = f"at {ANGLE:g}° with"
    wide_largest: str = f"largest at {ANGLE:g}°"
    wide_mean: str = f"mean at {ANGLE:g}°"
    evaluation: str = "ns per evaluation"
    sample: str = "ns per sample"


HEAD = Head()


class Cell(NamedTuple):
    """What stands in a cell: its words, a line below them, and what a table is sorted by."""

    words: str
    below: str = ""
    key: float | str = ""

    @property
    def line(self) -> str:
        """Both lines in one."""
        return f"{self.words} {self.below}".rstrip()


@dataclass(frozen=True)
class Line:
    """A row for people: the verdict, and the other cells in the order of HEAD."""

    standing: Standing
    verdict: Verdict
    cells: tuple[Cell, ...]


@dataclass(frozen=True)
class League:
    """Where the models stand, and the picture as a file of every kind."""

    standings: tuple[Standing, ...]
    drawn: dict[str, bytes]


def league(cards: Sequence[Card], seed: int = 0, threads: int | None = None) -> League:
    """The league of those cards; it takes their facts as they are."""
    found = tuple(standings([card.facts for card in cards], seed=seed, threads=threads))
    picture = Picture(found, {standing.name: verdict_of(standing) for standing in found}, ANGLE)
    return League(found, render(picture, picture.trace(threads)))


def league_files(ranked: League, paces: Mapping[str, Pace]) -> dict[str, str | bytes]:
    """Every file of the league by its name: the page of Markdown, the table for machines, the picture."""
    pictures: dict[str, str | bytes] = {f"{NAME}.{kind}": content for kind, content in ranked.drawn.items()}
    return {f"{NAME}.md": league_markdown(ranked, paces), f"{NAME}.csv": league_csv(ranked, paces), **pictures}


def league_markdown(ranked: League, paces: Mapping[str, Pace]) -> str:
    """The league as a page of Markdown."""
    rows = []
    for line in lines(ranked.standings, paces):
        cells = [cell.line for cell in line.cells]
        rows.append([f"[{cells[0]}](models/{line.standing.name}.md)", *cells[1:]])
    parts = [
        f"# {TITLE}",
        f"{LEAD} Files: [csv](league.csv), [svg](league.svg).",
        f"![{PICTURE}](league.png)",
        as_markdown(HEAD, rows),
        HOW,
    ]
    return "\n\n".join(part.strip() for part in parts) + "\n"


def league_html(ranked: League, paces: Mapping[str, Pace]) -> Markup:
    """The league as the content of a section of the page, which has its heading and its prose."""
    picture = embedded(ranked.drawn, NAME, PICTURE)
    rows = [(line, badge(line.verdict)) for line in lines(ranked.standings, paces)]
    return Markup(_template().render(head=HEAD, rows=rows, picture=Markup(picture), caption=PICTURE))


def league_csv(ranked: League, paces: Mapping[str, Pace]) -> str:
    """Every digit: a row for each model and order of integration."""
    rows = [record for standing in ranked.standings for record in records(standing, paces.get(standing.name))]
    return as_csv(list(rows[0]), [list(row.values()) for row in rows]) if rows else ""


def lines(found: Sequence[Standing], paces: Mapping[str, Pace]) -> list[Line]:
    """The rows for people, one for each order of integration, in the order of the standings."""
    told = []
    for standing in found:
        for i, albedo in enumerate(standing.facts.albedos):
            over = f", {OVER[albedo.order]}" if len(standing.facts.albedos) > 1 else ""
            wide = standing.levels[i] if standing.wide else None
            cells = (
                Cell(f"{standing.name}{over}"),
                verdict_cell(standing),
                largest_cell(standing.defaults[i]),
                estimate_cell(albedo.mean),
                exponent_cell(albedo.grazing),
                limit_cell(albedo.grazing),
                estimate_cell(standing.median, "°"),
                share_cell(standing),
                efficiency_cell(standing),
                parameter_cell(standing),
                largest_cell(wide) if wide else Cell("—"),
                estimate_cell(wide.mean) if wide else Cell("—"),
                *pace_cells(paces.get(standing.name)),
            )
            told.append(Line(standing, verdict_of(standing), cells))
    return told


def verdict_of(standing: Standing) -> Verdict:
    """What all checks together say."""
    return worst(standing.facts.findings)


def verdict_cell(standing: Standing) -> Cell:
    """The verdict, and the checks that are to blame for it."""
    verdict = verdict_of(standing)
    return Cell(WORDS[verdict], "" if verdict is Verdict.PASS else f"({blamed(standing)})", WORDS[verdict])


def blamed(standing: Standing) -> str:
    """The checks that ended as the whole trial did."""
    verdict = verdict_of(standing)
    return ", ".join(dict.fromkeys(finding.check for finding in standing.facts.findings if finding.verdict is verdict))


def largest_cell(level: Level) -> Cell:
    """The supremum, and where."""
    where = "at 90°" if level.mu == 0.0 else f"at {degrees_of(level.mu):.4g}°"
    found = estimate_cell(level.largest)
    return found._replace(below=f"{found.below} {where}".lstrip())


def estimate_cell(e: Estimate, unit: str = "") -> Cell:
    """A figure, its error below it."""
    words, sign, error = words_of(e).partition(" ± ")
    unit = unit * math.isfinite(e.value)
    key = "" if math.isnan(e.value) else e.value
    return Cell(words, f"± {error}{unit}", key) if sign else Cell(f"{words}{unit}", key=key)


def words_of(e: Estimate) -> str:
    """A figure with its error, not finer than FINEST; a dash for what is no number."""
    if not math.isfinite(e.value):
        return "—" if math.isnan(e.value) else f"{e.value:g}".replace("inf", "∞").replace("-", "−")
    return with_error(e, FINEST) if math.isfinite(e.half_width) else f"{e.value:.5g} ± ∞"


def exponent_cell(law: GrazingLaw) -> Cell:
    """The power of the cosine that the albedo follows; none where it has a limit, or none was found."""
    if law.behaviour == "bounded":
        return Cell("0", key=0.0)
    return estimate_cell(law.exponent)


def limit_cell(law: GrazingLaw) -> Cell:
    """Where the albedo ends."""
    if law.behaviour == "bounded":
        return estimate_cell(bounded(law.limit, law.limit_error, 0, "quadrature"))
    return {"vanishes": Cell("0", key=0.0), "diverges": Cell("∞", key=math.inf)}.get(law.behaviour, Cell(law.behaviour))


def efficiency_cell(standing: Standing) -> Cell:
    """The smallest efficiency over the viewers that the check tries, and which."""
    known = {mu: seen["efficiency"] for mu, seen in qualities(standing).items()}
    if not known:
        return Cell("—")
    mu = min(known, key=lambda cosine: known[cosine])
    gain = known[mu]
    return Cell("∞", key=gain) if math.isinf(gain) else Cell(rounded(gain), f"at {degrees_of(mu):.3g}°", gain)


def share_cell(standing: Standing) -> Cell:
    """Which share of the samples counts, 1 / (1 + relative variance of the weight), at the least; and for which viewer."""
    known = {mu: 1.0 / (1.0 + seen["variance"]) for mu, seen in qualities(standing).items()}
    if not known:
        return Cell("—")
    mu = min(known, key=lambda cosine: known[cosine])
    return Cell(f"{100.0 * known[mu]:.3g} %", "" if known[mu] > 0.9995 else f"at {degrees_of(mu):.3g}°", known[mu])


def qualities(standing: Standing) -> dict[float, dict[str, float]]:
    """What the check `quality` measured, by the cosine of the viewer."""
    told = [finding.details for finding in standing.facts.of("quality")]
    return {details["mu"]: details for details in told if "mu" in details}


def parameter_cell(standing: Standing) -> Cell:
    """The parameter that was moved, and its value."""
    wide = standing.wide
    return Cell(f"{wide.parameter} = {wide.value:g}") if wide else Cell("not compared")


def pace_cells(pace: Pace | None) -> tuple[Cell, Cell]:
    """Nanoseconds of an evaluation and of a sample, to three digits."""
    if pace is None:
        return nanoseconds(math.nan), nanoseconds(math.nan)
    return nanoseconds(pace.evaluation), nanoseconds(pace.sample)


def nanoseconds(ns: float) -> Cell:
    """A time; a dash for what has none."""
    return Cell("—") if math.isnan(ns) else Cell(f"{ns:.3g}", key=ns)


def records(standing: Standing, pace: Pace | None) -> list[dict[str, Any]]:
    """The rows of the csv for one model; what there is not is empty."""
    found = []
    for i, (albedo, level) in enumerate(zip(standing.facts.albedos, standing.defaults, strict=True)):
        wide = standing.wide
        row: dict[str, Any] = {"model": standing.name, "kind": KINDS[standing.axis.name], "order": level.order}
        row |= {
            "verdict": str(verdict_of(standing)),
            "checks": blamed(standing) if verdict_of(standing) is not Verdict.PASS else "",
        }
        row |= level_record("", level) | grazing_record(albedo)
        row |= figures("median_angle_deg", standing.median)
        for mu in VIEWERS:
            seen = qualities(standing).get(mu, {})
            where = f"at_{degrees_of(mu):.3g}_deg"
            row |= {f"variance_{where}": seen.get("variance"), f"efficiency_{where}": seen.get("efficiency")}
        row |= {"wide_parameter": wide.parameter if wide else None, "wide_value": wide.value if wide else None}
        row |= figures("wide_median_angle_deg", wide.angle if wide else None)
        row |= level_record("wide_", standing.levels[i] if wide else None)
        row |= {f"ns_{name}": getattr(pace, name, None) for name in Pace._fields}
        found.append({name: "" if value is None or value != value else value for name, value in row.items()})
    return found


def level_record(prefix: str, level: Level | None) -> dict[str, Any]:
    """The columns of largest and mean albedo."""
    where = None if level is None else degrees_of(level.mu)
    columns = figures(f"{prefix}largest_albedo", level.largest if level else None) | {f"{prefix}largest_theta_deg": where}
    return columns | figures(f"{prefix}mean_albedo", level.mean if level else None)


def grazing_record(albedo: Albedo) -> dict[str, Any]:
    """The columns of how the albedo ends."""
    law = albedo.grazing
    return {"behaviour": law.behaviour} | figures("exponent", law.exponent) | {"limit": law.limit, "limit_error": law.limit_error}


def figures(name: str, e: Estimate | None) -> dict[str, Any]:
    """A figure and its bounds."""
    values = (None, None, None) if e is None else (e.value, e.low, e.high)
    return dict(zip((name, f"{name}_low", f"{name}_high"), values, strict=True))


@cache
def _template() -> Any:
    """The layout of the section."""
    text = (files("albedo_lab.report") / "league.html.jinja").read_text(encoding="utf-8")
    environment = Environment(
        loader=DictLoader({"league": text}), autoescape=True, undefined=StrictUndefined, trim_blocks=True, lstrip_blocks=True
    )
    return environment.get_template("league")
