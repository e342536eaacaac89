"""Albedo curves of several metals at several wavelengths, and the colours that they make together."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from albedo_lab.analysis.albedo import albedo
from albedo_lab.analysis.colour import colour
from albedo_lab.pictures.base import Data

TOLERANCE = 1e-6


@dataclass(frozen=True)
class Spectra:
    """Wavelengths in nm; `parameters` are those of the model `metal`."""

    metals: tuple[str, ...]
    wavelengths: tuple[float, ...]
    parameters: Mapping[str, float] = field(default_factory=dict)

    def trace(self, threads: int | None = None) -> Data:
        """The points of the albedo curves, and "colours" along them, each with the columns of the analysis of that name."""
        theta_deg = [*np.arange(0.0, 89.0, 2.0).tolist(), 89.0, 89.5, 89.9]
        asked: dict[str, Any] = {"metal": list(self.metals), **self.parameters, "theta_deg": theta_deg}
        means: dict[str, Any] = {"tolerance": TOLERANCE, "method": "quadrature", "threads": threads}
        wavelengths = list(self.wavelengths)
        return {
            "": albedo("metal", wavelength=wavelengths, **asked, **means),
            "colours": colour("metal", wavelength=wavelengths, **asked, **means),
        }
