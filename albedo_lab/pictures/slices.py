"""Characteristic slices, as measured surfaces are looked at: f over theta_h and theta_d at one phi_d (nuaj_models)."""

from __future__ import annotations

import itertools
import math
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from albedo_lab.errors import BadInput
from albedo_lab.measured.cells import SHAPE, Place, angles_at
from albedo_lab.measured.rusinkiewicz import HalfDifference, light_and_viewer, lower_cosine
from albedo_lab.pictures.base import Curve, Data
from albedo_lab.pictures.evaluation import subject, values


@dataclass(frozen=True)
class Slices:
    """Curves by their labels, each with one slice for every phi_d in degrees, 0 <= phi_d_deg < 180; several make the stack.

    theta_h and theta_d go through the cells of a MERL table, at their centres; the half-vector lies at azimuth 0.
    """

    curves: tuple[Curve, ...]
    phi_d_deg: tuple[float, ...] = (90.0,)

    def trace(self, threads: int | None = None) -> Data:
        """Columns curve, phi_d_deg, theta_h_deg, theta_d_deg, above (the horizon), value: f in 1/sr, NaN where not above.

        theta_d varies fastest, then theta_h; there are 90 of each. Raises BadInput for a phi_d outside its domain.
        """
        places = {phi_d_deg: cells(phi_d_deg) for phi_d_deg in self.phi_d_deg}
        tables = []
        for curve in self.curves:
            of = subject(curve)
            for phi_d_deg, (at, above) in places.items():
                pairs = np.array([light_and_viewer(HalfDifference(*angles), 0.0) for angles in at[above].tolist()])
                value = np.full(len(at), np.nan)
                value[above] = values(of, pairs[:, 0], pairs[:, 1])
                theta_h_deg, theta_d_deg, _ = np.degrees(at).T
                tables.append(
                    pd.DataFrame(
                        {
                            "curve": curve.label,
                            "phi_d_deg": phi_d_deg,
                            "theta_h_deg": theta_h_deg,
                            "theta_d_deg": theta_d_deg,
                            "above": above,
                            "value": value,
                        }
                    )
                )
        return {"": pd.concat(tables, ignore_index=True)}


@lru_cache(maxsize=32)
def cells(phi_d_deg: float) -> tuple[NDArray[np.float64], NDArray[np.bool_]]:
    """The half-difference angles (n, 3) of the centres of all cells of a slice, and which of them lie above the horizon."""
    if not 0.0 <= phi_d_deg < 180.0:
        raise BadInput("phi_d_deg", phi_d_deg, "must be in [0, 180) degrees")
    centres = [
        angles_at(Place(i + 0.5, j + 0.5, 0.0))._replace(phi_d=math.radians(phi_d_deg))
        for i, j in itertools.product(range(SHAPE[0]), range(SHAPE[1]))
    ]
    return np.array(centres), np.array([lower_cosine(at) > 0.0 for at in centres])
