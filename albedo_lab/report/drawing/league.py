"""Draws the league: dots for mean and largest albedo in two panels, how each albedo ends, and the parameter that was moved."""

from __future__ import annotations

import math
from collections.abc import Container, Sequence
from typing import Any, cast

import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.layout_engine import PlaceHolderLayoutEngine
from matplotlib.lines import Line2D

from albedo_lab.analysis.verdict import Verdict
from albedo_lab.pictures.base import Data
from albedo_lab.pictures.league import League
from albedo_lab.report.drawing.albedos import OVER
from albedo_lab.report.drawing.style import GRID, INK, OKABE_ITO, REFERENCE, WIDTH

ROW = 0.29
"""Inches of a row."""
ABOVE = 1.75
"""Inches of the legend, the titles and the axis."""
MOST = 1.5
"""A larger albedo is an arrow at the edge, and its number."""
CLEAR = 0.1
"""An exponent whose interval is wider is not shown."""
SMALL = 12
KINDS = {
    "HALF": "about the half-vector",
    "MIRROR": "about the mirror direction",
    "LOBE": "about an axis of its own",
    "RETRO": "back to the light",
    "NORMAL": "about the normal",
}
"""What the lobes of a group turn about, in the order of the groups."""
MARKS: dict[str, dict[str, Any]] = {
    Verdict.PASS: {"marker": "o", "color": OKABE_ITO[0], "markersize": 8.5},
    Verdict.FAIL: {"marker": "X", "color": OKABE_ITO[1], "markersize": 10},
}
WORDS = {Verdict.PASS: "no check failed", Verdict.FAIL: "a check failed"}
OPEN: dict[str, Any] = {"marker": "s", "color": INK, "markerfacecolor": "none", "markersize": 8}
"""A mark for what is neither."""
MEAN: dict[str, Any] = {"marker": "|", "linestyle": "", "markersize": 13, "markeredgewidth": 2.4}


def draw(picture: League, data: Data) -> Figure:
    """A row a model, grouped by what its lobe turns about; names in alphabetical order within a group."""
    table = cast(pd.DataFrame, data[""])
    lines = rows(table)
    height = ROW * len(lines) + ABOVE
    figure = Figure(figsize=(WIDTH, height), layout=PlaceHolderLayoutEngine(True, True))
    low, high = 0.5 / height, 1.0 - (ABOVE - 0.5) / height
    left, right = (figure.add_axes((x, low, 0.245, high - low)) for x in (0.215, 0.61))
    for axes, (largest, mean), title in (
        (left, ("largest", "mean"), "at the defaults"),
        (right, ("wide_largest", "wide_mean"), f"half of the light within {picture.angle_deg:g}°"),
    ):
        panel(axes, [row is not None for _, row in lines], title)
        for y, (_, row) in enumerate(lines):
            if row is not None and not pd.isna(row[largest]):
                dots(axes, y, row[largest], row[mean], row["verdict"])
    for y, (words, row) in enumerate(lines):
        place: dict[str, Any] = {"transform": left.get_yaxis_transform(), "va": "center", "clip_on": False}
        if row is None:
            left.text(-0.86, y, words, weight="bold", **place)
            continue
        left.text(-0.04, y, words, ha="right", **place)
        left.text(1.05, y, ending(row), fontsize=SMALL, **place)
        right.text(1.05, y, moved(row), fontsize=SMALL, **(place | {"transform": right.get_yaxis_transform()}))
    for axes, said in ((left, "as μ → 0"), (right, "with")):
        axes.text(1.05, 1.0, said, transform=axes.transAxes, va="bottom", fontsize=SMALL)
    figure.legend(handles=key(set(table.verdict)), loc="upper center", ncols=5, handletextpad=0.4, columnspacing=1.4)
    return figure


def rows(table: pd.DataFrame) -> list[tuple[str, pd.Series | None]]:
    """The lines of the picture from the top: a group's name without a row, then its models, each with its row."""
    lines: list[tuple[str, pd.Series | None]] = []
    for axis, words in KINDS.items():
        group = table[table.axis == axis]
        lines += [(words, None)] if len(group) else []
        for _, own in group.groupby("model", sort=True):
            for i, (_, row) in enumerate(own.iterrows()):
                over = OVER[row["order"]].removeprefix("for a ") if len(own) > 1 else ""
                lines.append((", ".join(filter(None, [row["model"] if i == 0 else "", over])), row))
    return lines


def panel(axes: Axes, models: Sequence[bool], title: str) -> None:
    """Rows, empty and with a line where there is a model, over a scale of albedos, with one more where all light is reflected:
    beyond it energy is created.
    """
    axes.set(xlim=(0.0, MOST), ylim=(len(models) - 0.5, -0.5))
    axes.set_title(title, pad=24)
    axes.set_xticks([0.0, 0.5, 1.0, MOST])
    axes.set_xlabel("albedo")
    axes.set_yticks([y for y, there in enumerate(models) if there])
    axes.tick_params(axis="y", length=0, labelleft=False)
    axes.grid(axis="x", visible=False)
    axes.spines["left"].set_visible(False)
    axes.axvspan(1.0, MOST, color=GRID, alpha=0.35, linewidth=0, zorder=0)
    axes.axvline(1.0, **(REFERENCE | {"zorder": 1}))


def dots(axes: Axes, y: float, largest: float, mean: float, verdict: str) -> None:
    """Mean and largest albedo, joined; one beyond the scale is an arrow at its end, with its number."""
    mark = MARKS.get(verdict, OPEN)
    colour = mark["color"]
    beyond = not largest <= MOST
    axes.plot([min(mean, MOST), min(largest, MOST)], [y, y], color=colour, linewidth=1.6, zorder=2, solid_capstyle="butt")
    if mean <= MOST:
        axes.plot(mean, y, color=colour, zorder=3, clip_on=False, **MEAN)
    if beyond:
        axes.plot(MOST, y, zorder=4, clip_on=False, linestyle="", **(mark | {"marker": ">"}))
        number = "∞" if math.isinf(largest) else f"{largest:.3g}"
        number = f"{mean:.3g} to {number}" if mean > MOST else number
        axes.annotate(number, (MOST, y), (-9, 0), textcoords="offset points", ha="right", va="bottom", fontsize=SMALL - 1)
    else:
        axes.plot(largest, y, zorder=4, clip_on=False, linestyle="", **mark)


def ending(row: pd.Series) -> str:
    """How the albedo ends at grazing incidence, as a sign and a number."""
    s = row["exponent"]
    low, high = row["exponent_low"], row["exponent_high"]
    power = f"  μ$^{{{s:.2g}}}$".replace("-", "−") if high - low < CLEAR else ", slowly" if low <= 0.0 <= high else ""
    if row["behaviour"] == "bounded":
        return f"→ {row['limit']:.3g}"
    behaviour = str(row["behaviour"])
    return {"vanishes": f"↘ 0{power}", "diverges": f"↗ ∞{power}"}.get(behaviour, behaviour)


def moved(row: pd.Series) -> str:
    """The parameter's value, or the angle at which a model stands that cannot be as wide as the others."""
    if pd.isna(row["value"]):
        return "—" if pd.isna(row["median_deg"]) else f"median {row['median_deg']:.3g}°"
    return f"{row['parameter']} = {row['value']:.4g}"


def key(verdicts: Container[str]) -> list[Line2D]:
    """What the marks mean; only of verdicts that are there."""
    marks = [(words, MARKS[of]) for of, words in WORDS.items() if of in verdicts]
    marks += [("undecided", OPEN)] if any(str(of) in verdicts for of in Verdict if of not in MARKS) else []
    handles = [Line2D([], [], label="mean albedo", color=INK, **MEAN)]
    handles += [Line2D([], [], linestyle="", label=f"largest: {words}", **mark) for words, mark in marks]
    return [*handles, Line2D([], [], label="all light", **REFERENCE)]
