"""What every kind of picture has."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, Protocol

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from albedo_lab.model import Model

Data = dict[str, pd.DataFrame | NDArray[np.float64]]


@dataclass(frozen=True)
class Curve:
    """A model at its parameters (choices and `scale` among them), under the label that the legend shows."""

    label: str
    model: Model | str
    parameters: Mapping[str, Any] = field(default_factory=dict)


class Picture(Protocol):
    """Something to be drawn."""

    def trace(self, threads: int | None = None) -> Data:
        """Its data, by name."""
        ...
