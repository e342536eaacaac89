"""How coarsely the numbers of a table were stored before they came into the file."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from albedo_lab.lookup.axes import Floats

FEWEST = 8
"""Different values without which nothing can be said."""
STEPS = {
    "8 bits": 1.0 / 255.0,
    "3 decimals": 1e-3,
    "10 bits": 1.0 / 1023.0,
    "12 bits": 1.0 / 4095.0,
    "4 decimals": 1e-4,
    "16 bits": 1.0 / 65535.0,
    "5 decimals": 1e-5,
    "6 decimals": 1e-6,
}
"""The coarsest first."""
FINEST_SHARE = 1.0 / 16.0
"""A file's own rounding must be so small beside a step that no value agrees by chance more often than one time in eight."""


@dataclass(frozen=True)
class Grain:
    """What all values are multiples of, and the largest error that rounding to it makes."""

    name: str
    rounding: float


def grain(values: Floats, rounding: float) -> Grain | None:
    """The coarsest storage whose numbers all values are, up to what the file's own `rounding` leaves; None where there is none.

    Eight different values agree by chance with a probability below 8^-8.
    """
    known = np.unique(np.abs(values[np.isfinite(values)]))
    if known.size < FEWEST:
        return None
    slack = rounding + 4.0 * np.finfo(np.float64).eps * float(known[-1])
    for name, step in STEPS.items():
        steps = np.rint(known / step)
        if slack < FINEST_SHARE * step and np.unique(steps).size >= FEWEST and np.all(np.abs(known - steps * step) <= slack):
            return Grain(name, 0.5 * step)
    if known[-1] < 6e4 and rounding < FINEST_SHARE * float(np.spacing(np.float16(known[-1]))):
        halves = known.astype(np.float16).astype(np.float64)
        finer = known > 2.0 * np.finfo(np.float16).tiny
        if np.count_nonzero(finer) >= FEWEST and np.all(np.abs(known - halves)[finer] <= slack + 1e-8 * known[finer]):
            return Grain("half floats", 0.5 * float(np.spacing(np.float16(known[-1]))))
    return None
