"""The league at a glance: a row for every model, its largest and its mean albedo, at its defaults and as wide as the others."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import pandas as pd

from albedo_lab.analysis.league import Standing
from albedo_lab.analysis.verdict import Verdict
from albedo_lab.pictures.base import Data

COLUMNS = (
    "model",
    "axis",
    "order",
    "verdict",
    "largest",
    "mean",
    "behaviour",
    "exponent",
    "exponent_low",
    "exponent_high",
    "limit",
    "median_deg",
    "parameter",
    "value",
    "wide_largest",
    "wide_mean",
)


@dataclass(frozen=True, eq=False)
class League:
    """The models in the order of their rows, with the verdict on each by its name; all were compared at `angle_deg`."""

    standings: tuple[Standing, ...]
    verdicts: Mapping[str, Verdict]
    angle_deg: float

    def trace(self, threads: int | None = None) -> Data:
        """A row for each model and order of integration, under COLUMNS; empty where a model cannot be made as wide."""
        rows = []
        for standing in self.standings:
            wide = standing.wide
            for i, (albedo, level) in enumerate(zip(standing.facts.albedos, standing.defaults, strict=True)):
                law = albedo.grazing
                row: list[object] = [standing.name, standing.axis.name, level.order, str(self.verdicts[standing.name])]
                row += [level.largest.value, level.mean.value, law.behaviour]
                row += [law.exponent.value, law.exponent.low, law.exponent.high, law.limit, standing.median.value]
                row += [wide.parameter, wide.value] if wide else [None, None]
                row += [standing.levels[i].largest.value, standing.levels[i].mean.value] if wide else [None, None]
                rows.append(row)
        return {"": pd.DataFrame(rows, columns=list(COLUMNS))}
