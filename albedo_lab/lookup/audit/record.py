"""What an audit says: the evidence, the defects, and the verdict."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
import pandas as pd

from albedo_lab.lookup.audit.defects import Defect
from albedo_lab.lookup.audit.hypotheses import Fit, Hypothesis
from albedo_lab.lookup.audit.judge import Judgement, described
from albedo_lab.lookup.audit.layouts import in_words
from albedo_lab.lookup.axes import Floats

STATUS = {"sound": 0, "defects": 1, "undecided": 3, "unknown": 3}
WORST = (1, 3, 0)
COLUMNS = ("model", "variant", "quantity", "layout", "largest", "rms", "where")
SENTENCES = {
    "sound": "sound: every cell{but} is within {tolerance:g} of the truth, beyond the rounding of its storage",
    "defects": "not sound",
    "undecided": "undecided: these hypotheses explain the table as well as the first:{rivals}",
    "unknown": "unknown: nothing that was tried explains the table; the nearest candidates are no finding",
}


@dataclass(frozen=True, eq=False)
class Audit:
    """The audit of one array.

    file, array
        Where it stands, and its name there.
    kind, rounding
        How its numbers are stored, and the largest error that this can have made.
    others
        The names of the arrays of the file that were not audited.
    more
        The audits of the other arrays that are declared.
    """

    file: str
    array: str
    kind: str
    rounding: float
    others: tuple[str, ...]
    judgement: Judgement
    more: tuple[Audit, ...] = ()

    @property
    def verdict(self) -> str:
        """sound, defects, undecided or unknown."""
        return self.judgement.verdict

    @property
    def status(self) -> int:
        """The exit status, the worst of all arrays: 1 defects, 3 undecided or unknown, 0 sound."""
        found = {STATUS[each.verdict] for each in (self, *self.more)}
        return next(status for status in WORST if status in found)

    @property
    def found(self) -> Hypothesis | None:
        """What the table holds; None where that is unknown."""
        fit = self.judgement.fit
        return fit.hypothesis if fit is not None and self.judgement.known else None

    @property
    def defects(self) -> tuple[Defect, ...]:
        """What is wrong with the table."""
        return self.judgement.defects

    @property
    def facts(self) -> tuple[Defect, ...]:
        """What is worth to know and not wrong."""
        return self.judgement.facts

    @property
    def values(self) -> Floats:
        """The table, shape (*sizes, channels)."""
        return self.judgement.observed.values

    @property
    def truth(self) -> Floats:
        """What the best hypothesis says it should hold, NaN where it says nothing; the same shape."""
        fit = self.judgement.fit
        return np.full_like(self.values, np.nan) if fit is None else fit.truth

    @property
    def deviations(self) -> Floats:
        """The table minus the truth."""
        return np.where(np.isfinite(self.values), self.values, np.nan) - self.truth

    @property
    def candidates(self) -> pd.DataFrame:
        """The nearest hypotheses, the best first: model, variant, quantity, layout, largest and RMS deviation, where."""
        return pd.DataFrame([_row(fit) for fit in self.judgement.fits], columns=list(COLUMNS))

    def text(self) -> str:
        """The evidence, the defects and the verdict, for a person."""
        judged = self.judgement
        sizes = " x ".join(map(str, judged.observed.sizes))
        several = f", {self.values.shape[-1]} channels" if self.values.shape[-1] > 1 else ""
        lines = [f"{self.file}: {self.array}, {sizes}{several}, stored as {self.kind} (rounded by up to {self.rounding:.2g})"]
        lines += [f"also in the file, and audited if asked for (--array NAME): {', '.join(self.others)}"] if self.others else []
        lines += [f"expected: {_said(judged)}", "", "candidates, and how far the table is off:"]
        for fit in judged.fits:
            lines.append(f"  largest {fit.largest:<8.3g} RMS {fit.rms:<8.3g} {described(fit.hypothesis)}")
            lines.append(f"{'':<10}largest at {fit.where(fit.place)}")
        lines += ["  none"] if not judged.fits else []
        for title, several_found in (("defects", judged.defects), ("told", judged.facts)):
            if several_found:
                lines += ["", f"{title}:"]
            for defect in several_found:
                lines.append(f"  {defect.name}: {defect.sentence}")
                lines += [f"    {defect.evidence}"] if defect.evidence else []
        rivals = "".join(f"\n  {described(rival)}" for rival in judged.rivals)
        but = ", but for the edges that are told of," if any(fact.name == "edge displaced" for fact in judged.facts) else ""
        verdict = SENTENCES[self.verdict].format(tolerance=judged.observed.tolerance, rivals=rivals, but=but)
        return "\n\n".join(["\n".join([*lines, "", verdict, ""]), *(each.text() for each in self.more)])

    def as_dict(self) -> dict[str, Any]:
        """The same as a record that JSON can hold; NaN is null."""
        judged = self.judgement
        return {
            "file": self.file,
            "array": self.array,
            "shape": list(judged.observed.sizes),
            "channels": self.values.shape[-1],
            "storage": self.kind,
            "rounding": self.rounding,
            "tolerance": judged.observed.tolerance,
            "expected": _said(judged),
            "verdict": self.verdict,
            "found": None if self.found is None else described(self.found),
            "undecided": [described(rival) for rival in judged.rivals],
            "candidates": [
                {name: None if isinstance(value, float) and math.isnan(value) else value for name, value in _row(fit).items()}
                for fit in judged.fits
            ],
            "defects": [_told(defect) for defect in judged.defects],
            "facts": [_told(defect) for defect in judged.facts],
            **({"more": [each.as_dict() for each in self.more]} if self.more else {}),
        }


def _told(defect: Defect) -> dict[str, Any]:
    return {
        "name": defect.name,
        "sentence": defect.sentence,
        "evidence": defect.evidence,
        "cells": [list(c) for c in defect.cells],
    }


def _row(fit: Fit) -> dict[str, Any]:
    """A candidate's columns."""
    of = fit.hypothesis
    return {
        "model": of.variant.model.name,
        "variant": of.variant.title.partition(", ")[2],
        "quantity": of.form.title,
        "layout": "; ".join(map(in_words, of.axes)),
        "largest": fit.largest,
        "rms": fit.rms,
        "where": fit.where(fit.place),
    }


def _said(judged: Judgement) -> str:
    """What was expected, in words."""
    said = judged.expected
    if said.nothing:
        return "nothing is said of the table"
    words = [
        *([said.quantity] if said.quantity else []),
        *([said.variant.title] if said.variant else []),
        *(["; ".join(map(in_words, said.axes))] if said.axes else []),
        *([said.sampling] if said.sampling and not said.axes else []),
    ]
    return f"{', '.join(words)} ({said.source})"
