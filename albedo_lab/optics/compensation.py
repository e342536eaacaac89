"""Light that facets reflect more than once, in the terms of Kulla and Conty and of Turquin; scalars or arrays.

`lost` is 1 - E, what a model loses whose facets reflect all light, from one direction; `lost_mean` its mean, 2 int lost mu dmu.
"""

from __future__ import annotations

from math import pi
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

Numbers = TypeVar("Numbers", float, NDArray[np.float64])


def schlick_mean(F0: Numbers) -> Numbers:
    """2 int F mu dmu of Schlick's reflectance: F0 + (1 - F0) / 21."""
    return F0 + (1.0 - F0) / 21.0


def colour(F_mean: Numbers, lost_mean: Numbers) -> Numbers:
    """F^2 E / (1 - F (1 - E)): of what is reflected more than once, the share that facets of mean reflectance F leave."""
    return F_mean * F_mean * (1.0 - lost_mean) / (1.0 - F_mean * lost_mean)


def kulla_conty(lost_i: Numbers, lost_o: Numbers, lost_mean: Numbers) -> Numbers:
    """(1 - E_i) (1 - E_o) / (pi (1 - E_mean)): its albedo is what is lost."""
    return lost_i * lost_o / (pi * lost_mean)


def turquin(F0: Numbers, lost_o: Numbers) -> Numbers:
    """1 + F0 (1 - E_o) / E_o, a factor of the model itself."""
    return 1.0 + F0 * lost_o / (1.0 - lost_o)
