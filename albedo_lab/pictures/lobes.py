"""The light that one direction of incidence sends to every viewer, as the surface that it makes about the point: the 3D lobe."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import pandas as pd

from albedo_lab.errors import BadInput
from albedo_lab.pictures.base import Curve, Data
from albedo_lab.pictures.evaluation import Array, subject, values

EVERYWHERE = np.arange(0.0, 90.0, 3.0)
GRAZING = np.array([88.5, 89.5, 89.9])
AROUND = np.arange(0.0, 361.0, 4.0)
BESIDE = np.array([0.0, 0.06, 0.15, 0.3, 0.5, 0.75, 1.0, 1.4, 1.9, 2.5, 3.3, 4.3, 5.5, 7.0])
"""Degrees from the mirror and the retro direction at which viewers crowd, so that a lobe of n = 1e5 keeps its shape."""


@dataclass(frozen=True)
class Lobes:
    """Curves by their labels, one after the other, each for lights at the polar angles `theta_deg` and the azimuth `phi_deg`.

    What is drawn towards a viewer is f cos(theta_light), the radiance under a light of unit irradiance across its beam; without
    `cosine`, f itself. The angles are in degrees, 0 <= theta_deg < 90.
    """

    curves: tuple[Curve, ...]
    theta_deg: tuple[float, ...] = (15.0, 45.0, 75.0)
    phi_deg: float = 0.0
    cosine: bool = True

    def trace(self, threads: int | None = None) -> Data:
        """Columns curve, light_deg, viewer_deg, viewer_phi_deg, value (1/sr), and "mirrors": what the Dirac parts reflect.

        The viewers of one light make a grid, the azimuth varying fastest, from 0 to 360 degrees, both included. "mirrors" has the
        columns curve, light_deg, reflectance (a share of the light); "axes" tells of each curve whether it is isotropic. Raises
        BadInput for an angle outside its domain.
        """
        tables, mirrors, axes = [], [], []
        for curve in self.curves:
            of = subject(curve)
            axes.append({"curve": curve.label, "isotropic": bool(of.model.isotropic(of.p))})
            for theta_deg in self.theta_deg:
                light = direction(np.array([theta_deg]), np.array([self.phi_deg]))
                theta, phi = viewers(theta_deg, self.phi_deg)
                viewer = direction(theta, phi)
                value = values(of, np.broadcast_to(light, viewer.shape), viewer)
                if self.cosine:
                    value *= light[0, 2]
                tables.append(
                    pd.DataFrame(
                        {
                            "curve": curve.label,
                            "light_deg": theta_deg,
                            "viewer_deg": theta,
                            "viewer_phi_deg": phi,
                            "value": value,
                        }
                    )
                )
                reflectance = float(of.model.mirror(of.p, float(light[0, 2]))) * of.scale.value
                mirrors.append({"curve": curve.label, "light_deg": theta_deg, "reflectance": reflectance})
        return {
            "": pd.concat(tables, ignore_index=True),
            "mirrors": pd.DataFrame(mirrors),
            "axes": pd.DataFrame(axes),
        }


def direction(theta_deg: Array, phi_deg: Array) -> Array:
    """Unit vectors (n, 3) at polar angles and azimuths in degrees. Raises BadInput for a light at or below the horizon."""
    if not np.all(np.isfinite(phi_deg)):
        raise BadInput("phi_deg", float(phi_deg[0]), "must be a finite number of degrees")
    for angle in theta_deg:
        if not 0.0 <= angle < 90.0:
            raise BadInput("theta_deg", float(angle), "must be in [0, 90) degrees")
    theta, phi = np.radians(theta_deg), np.radians(phi_deg)
    z = np.sin(np.radians(90.0 - theta_deg))
    return np.stack([np.sin(theta) * np.cos(phi), np.sin(theta) * np.sin(phi), z], axis=-1)


def viewers(theta_deg: float, phi_deg: float) -> tuple[Array, Array]:
    """Polar angles and azimuths of a grid over the hemisphere, closer together about a light's mirror and retro directions."""
    theta = np.concatenate([EVERYWHERE, GRAZING, theta_deg + BESIDE, theta_deg - BESIDE])
    theta = np.unique(theta[(theta >= 0.0) & (theta < 90.0)])
    aside = np.minimum(BESIDE / max(math.sin(math.radians(theta_deg)), 0.05), 60.0)
    turns = np.concatenate([AROUND, aside, 360.0 - aside, 180.0 + aside, 180.0 - aside])
    first, second = np.meshgrid(theta, phi_deg + np.unique(turns), indexing="ij")
    return first.ravel(), second.ravel()
