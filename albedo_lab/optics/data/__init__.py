"""Measured and standardised data, as published; `provenance.json` says of each file where it comes from.

`tests/optics/make_optical_data.py` made the files and makes them again, byte for byte.
"""

from __future__ import annotations

from functools import cache
from pathlib import Path

import numpy as np
from numpy.typing import NDArray


@cache
def columns(name: str) -> NDArray[np.float64]:
    """The columns of `<name>.csv`, read-only, the wavelength in nm first; shape (columns, rows)."""
    read = np.loadtxt(Path(__file__).parent / f"{name}.csv", delimiter=",", skiprows=1, unpack=True)
    read.flags.writeable = False
    return read
