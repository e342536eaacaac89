"""The angles of a pair of directions, in the notation of schlick1993 (t = n.h, u = wo.h, v = n.wo, v' = n.wi)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


@dataclass
class Pair:
    """Light wi and viewer wo.  Scalars and arrays that broadcast against each other."""

    light: Array | float
    """v' = n.wi"""
    view: Array | float
    """v = n.wo"""
    tan2: Array
    """tan^2 of the angle between n and h"""
    t: Array
    """n.h"""
    u: Array
    """wo.h = wi.h"""
    azimuth: Array
    """azimuth of h from the x axis"""
    mirror: Array | None = None
    """R.V, R the mirror image of wi"""
    opening: Array | None = None
    """cosine of the azimuth between wi and wo (1: the same side)"""
    one_minus_view: Array | float | None = None
    """1 - v without cancellation"""
    view_azimuth: Array | float | None = None
    """azimuth of wo from the x axis"""

    @property
    def cos_phi(self) -> Array:
        """`opening`, or from wi.wo = 2 u^2 - 1 where it is not given."""
        if self.opening is not None:
            return self.opening
        sines = np.sqrt((1.0 - np.square(self.light)) * (1.0 - np.square(self.view)))
        across = 2.0 * self.u**2 - 1.0 - self.light * self.view
        return np.clip(across / np.where(sines > 0.0, sines, 1.0), -1.0, 1.0)

    @property
    def h_x(self) -> Array:
        """x component of the half vector."""
        return self.t * np.sqrt(self.tan2) * np.cos(self.azimuth)

    def horizontal(self) -> tuple[tuple[Array, Array], tuple[Array, Array]]:
        """x and y of wi = 2 u h - wo, and of wo."""
        sine = np.sqrt((1.0 - np.asarray(self.view)) * (1.0 + np.asarray(self.view)))
        x, y = sine * np.cos(self.view_azimuth), sine * np.sin(self.view_azimuth)
        return (2.0 * self.u * self.h_x - x, 2.0 * self.u * self.h_y - y), (x, y)

    @property
    def h_y(self) -> Array:
        """y component of the half vector."""
        return self.t * np.sqrt(self.tan2) * np.sin(self.azimuth)


def pair_of_vectors(wi: Array, wo: Array) -> Pair:
    """The literal angles of two arrays of unit vectors (last axis x, y, z); for Monte Carlo and spot checks."""
    h = wi + wo
    h = h / np.linalg.norm(h, axis=-1, keepdims=True)
    t = h[..., 2]
    across = np.hypot(wi[..., 0], wi[..., 1]) * np.hypot(wo[..., 0], wo[..., 1])
    in_plane = wi[..., 0] * wo[..., 0] + wi[..., 1] * wo[..., 1]
    return Pair(
        light=wi[..., 2],
        view=wo[..., 2],
        tan2=(h[..., 0] ** 2 + h[..., 1] ** 2) / t**2,
        t=t,
        u=np.sum(wo * h, axis=-1),
        azimuth=np.arctan2(h[..., 1], h[..., 0]),
        mirror=wi[..., 2] * wo[..., 2] - in_plane,
        opening=np.where(across > 0.0, in_plane / np.where(across > 0.0, across, 1.0), 1.0),
        one_minus_view=1.0 - wo[..., 2],
        view_azimuth=np.arctan2(wo[..., 1], wo[..., 0]),
    )
