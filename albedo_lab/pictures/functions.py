"""Functions of one variable side by side: a distribution of normals, a Fresnel factor, and what they stand for."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from albedo_lab.errors import BadInput
from albedo_lab.pictures.base import Data


@dataclass(frozen=True)
class Function:
    """A function of an array of doubles. A `reference` is what others approximate: it is drawn dashed.

    Several references are the first's, the second's and so on of the other functions, and share their colours.
    """

    label: str
    f: Callable[[NDArray[np.float64]], NDArray[np.float64]]
    reference: bool = False


@dataclass(frozen=True)
class Functions:
    """Functions over x = (low, high), with labels of both axes, their units among them.

    `polar` takes x as an angle in radians from the vertical, and the value as radius; `log_radius` the radius as a logarithm. A
    picture that is `symmetric` shows -x as well. `y` is the window of the values, by itself as wide as they need.
    """

    functions: tuple[Function, ...]
    x: tuple[float, float]
    x_label: str
    y_label: str
    log_x: bool = False
    log_y: bool = False
    polar: bool = False
    log_radius: bool = False
    points: int = 401
    symmetric: bool = False
    y: tuple[float, float] | None = None

    def trace(self, threads: int | None = None) -> Data:
        """Columns function, x, value. Raises BadInput for an x without extent, or not above 0 where its logarithm counts."""
        low, high = self.x
        if not (np.isfinite(high) and low < high and (low > 0.0 or not self.log_x)):
            raise BadInput("x", self.x, "must be two numbers, the lower first, and above 0 on a logarithmic axis")
        x = np.geomspace(low, high, self.points) if self.log_x else np.linspace(low, high, self.points)
        tables = []
        for function in self.functions:
            value = np.broadcast_to(np.asarray(function.f(x), dtype=np.float64), x.shape)
            tables.append(pd.DataFrame({"function": function.label, "x": x, "value": value}))
        return {"": pd.concat(tables, ignore_index=True)}
