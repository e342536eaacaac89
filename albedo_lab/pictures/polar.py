"""Section of a BRDF through the plane of incidence, for several lights."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, TypeAlias

import numpy as np
import pandas as pd

from albedo_lab.analysis.verdict import Subject
from albedo_lab.pictures.base import Curve, Data
from albedo_lab.pictures.evaluation import Array, in_plane, refuse_below_horizon, subject, values

Quantity: TypeAlias = Literal["brdf", "radiance", "normalised"]

FARTHEST = 89.99
"""Degrees of the outermost viewer: beyond it a BRDF that diverges at grazing angles has no picture."""
SPREAD = np.concatenate([np.linspace(-FARTHEST, FARTHEST, 361), np.linspace(-0.5, 0.5, 21)])
AROUND = np.geomspace(1e-3, 20.0, 40)
"""Distances in degrees from the mirror, the light and the normal at which a viewer looks whatever the lobe."""
ROUNDS, FINENESS = 8, 1e-3
"""How often an interval is halved, at most, while its chord misses the curve by that share of the whole picture."""

SHOOTING = 8.0
"""So many times larger than anywhere else is what lies near a viewer's horizon, where a BRDF diverges there."""
SEEN = 1.1
"""Beyond that share of the summit nothing is drawn."""


@dataclass(frozen=True)
class Polar:
    """Curves by their labels, under lights at `theta_deg` degrees from the normal, in [0, 90).

    `quantity` is "brdf" (f in 1/sr), "radiance" (f times the cosine of the light's angle: under a point light whose irradiance
    is 1 at normal incidence) or "normalised" (f over f where both light and viewer are in the normal). `log` draws the
    radius as a logarithm over so many `decades`. A panel for each light ("angle") or for each curve ("curve"),
    with one scale for all where they are to be compared and no curve would vanish, or each with its own where not `alike`.
    """

    curves: tuple[Curve, ...]
    theta_deg: tuple[float, ...] = (0.0, 40.0, 80.0)
    quantity: Quantity = "brdf"
    log: bool = False
    decades: float = 3.0
    panels: Literal["angle", "curve"] = "angle"
    alike: bool = True

    def trace(self, threads: int | None = None) -> Data:
        """Columns curve, light_deg, viewer_deg (from -90 to 90, positive on the mirror's side), value.

        "mirrors" holds what is not in these, the reflectances of Dirac parts: curve, light_deg, reflectance. Raises BadInput.
        """
        refuse_below_horizon(self.theta_deg)
        sections, mirrors = [], []
        for curve in self.curves:
            of = subject(curve)
            for theta in self.theta_deg:
                viewers, found = self._section(of, theta)
                section = {"curve": curve.label, "light_deg": theta, "viewer_deg": viewers, "value": found}
                sections.append(pd.DataFrame(section))
                reflectance = of.scale.value * of.model.mirror(of.p, float(in_plane(np.array([theta]))[0, 2]))
                if reflectance != 0.0:
                    mirrors.append((curve.label, theta, reflectance))
        return {
            "": pd.concat(sections, ignore_index=True),
            "mirrors": pd.DataFrame(mirrors, columns=["curve", "light_deg", "reflectance"]),
        }

    def _section(self, of: Subject, theta: float) -> tuple[Array, Array]:
        """Viewers and values, as many as the curve's bends need."""
        near = np.concatenate([centre + side * AROUND for centre in (-theta, 0.0, theta) for side in (-1.0, 1.0)])
        viewers = np.unique(np.concatenate([SPREAD, near[np.abs(near) < FARTHEST], [-theta, theta]]).round(9))
        viewers = viewers[np.abs(viewers) <= FARTHEST]
        found = self._values(of, theta, viewers)
        for _ in range(ROUNDS):
            between = 0.5 * (viewers[1:] + viewers[:-1])
            here = self._values(of, theta, between)
            top = summit(viewers, found, theta, self.log)
            ends = self._height(found, top)
            bent = np.abs(self._height(here, top) - 0.5 * (ends[1:] + ends[:-1])) > FINENESS
            if not np.any(bent):
                break
            order = np.argsort(np.concatenate([viewers, between[bent]]), kind="stable")
            viewers = np.concatenate([viewers, between[bent]])[order]
            found = np.concatenate([found, here[bent]])[order]
        return viewers, found

    def _values(self, of: Subject, theta: float, viewers: Array) -> Array:
        """The quantity towards every viewer."""
        light = in_plane(np.full(len(viewers), -theta))
        f = values(of, light, in_plane(viewers))
        if self.quantity == "radiance":
            return f * light[:, 2]
        if self.quantity == "normalised":
            normal = in_plane(np.zeros(1))
            with np.errstate(divide="ignore", invalid="ignore"):
                return f / values(of, normal, normal)
        return f

    def _height(self, value: Array, top: float) -> Array:
        """What is seen of a value: its radius in the picture."""
        share = np.clip(value / top, 0.0, SEEN) if top > 0.0 else np.zeros_like(value)
        return 1.0 + np.log10(np.maximum(share, 10.0**-self.decades)) / self.decades if self.log else share


def summit(viewer_deg: Array, value: Array, light_deg: float, log: bool) -> float:
    """The value that fills the picture: the largest, or before the curve shoots up towards grazing viewers where it does.

    0 where no value is a number above 0. A logarithm has room for everything.
    """
    known = np.isfinite(value)
    outermost = np.abs(viewer_deg) > max(80.0, 0.5 * (90.0 + light_deg))
    inside, outside = (float(np.max(value[known & part], initial=0.0)) for part in (~outermost, outermost))
    return inside if 0.0 < inside < outside / SHOOTING and not log else max(inside, outside)
