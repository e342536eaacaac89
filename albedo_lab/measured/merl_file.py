"""The binary format of the MERL BRDF database: read by mapping, written whole or not at all.

Three little-endian 32-bit integers (90, 90, 180) head three planes of doubles: red, green and blue, each
[theta_h][theta_d][phi_d]. A plane's values times its factor are 1/sr. A negative value says that nothing was measured, below the
horizon for instance.
"""

from __future__ import annotations

import os
import stat
from dataclasses import dataclass
from functools import cache, lru_cache
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from albedo_lab.errors import BadInput
from albedo_lab.files import write_whole
from albedo_lab.measured.cells import SHAPE

Floats = NDArray[np.float64]

FACTORS = {"red": 1.0 / 1500.0, "green": 1.15 / 1500.0, "blue": 1.66 / 1500.0}
CHANNELS = tuple(FACTORS)
MISSING = -1.0
"""What is written for a cell below the horizon."""
HEADER = np.array(SHAPE, "<i4").tobytes()
PLANE = SHAPE[0] * SHAPE[1] * SHAPE[2]
SIZE = len(HEADER) + 8 * len(CHANNELS) * PLANE


@dataclass(frozen=True, eq=False)
class MerlFile:
    """A file that was found sound; `stored` is the mapped file, [channel][theta_h][theta_d][phi_d], without the factors."""

    path: str
    stored: Floats

    def values(self, channel: str) -> Floats:
        """One channel in 1/sr, copied: in the file doubles begin at byte 12, where compiled code must not expect any."""
        values: Floats = self.stored[CHANNELS.index(channel)] * FACTORS[channel]
        return values

    def census(self, channel: str) -> Census:
        """How many cells of one channel hold what."""
        plane = self.stored[CHANNELS.index(channel)]
        negative = plane < 0.0
        return Census(
            cells=PLANE,
            negative=int(np.count_nonzero(negative)),
            holes=int(np.count_nonzero(negative & (centre_cosines() > 0.0))),
            zero=int(np.count_nonzero(plane == 0.0)),
        )


class Census(NamedTuple):
    """Counts of cells: all, without a value, of these the ones whose centre is above the horizon, and zeros."""

    cells: int
    negative: int
    holes: int
    zero: int


def read(path: str | os.PathLike[str]) -> MerlFile:
    """Maps a file after looking at every value of it.

    Raises BadInput for one that cannot be read, has another size or other dimensions, holds a value that is not finite, or no
    value at all in one of its planes.
    """
    name = os.fspath(path)
    return _read(name, identity(name))


def identity(name: str) -> tuple[int, ...]:
    """What tells one state of a file from any other. Raises BadInput where there is no file."""
    try:
        found = os.stat(name)
    except (OSError, ValueError) as error:  # ValueError: a null byte in the name
        raise BadInput("file", name, f"cannot be read ({getattr(error, 'strerror', None) or error})") from None
    if not stat.S_ISREG(found.st_mode):
        raise BadInput("file", name, "must be a file, not a folder or a device")
    return found.st_dev, found.st_ino, found.st_size, found.st_mtime_ns


@lru_cache(maxsize=4)
def _read(name: str, state: tuple[int, ...]) -> MerlFile:
    size = state[2]
    if size != SIZE:
        raise BadInput("file", name, f"has {size} bytes; a MERL file of 90 x 90 x 180 cells has {SIZE}")
    try:
        with open(name, "rb") as stream:
            header = stream.read(len(HEADER))
        stored = np.asarray(np.memmap(name, "<f8", "r", len(HEADER), (len(CHANNELS), *SHAPE)))
    except OSError as error:
        raise BadInput("file", name, f"cannot be read ({error.strerror})") from None
    if header != HEADER:
        found = " x ".join(map(str, np.frombuffer(header, "<i4")))
        raise BadInput("file", name, f"has {found} cells by its header; must have 90 x 90 x 180")
    for channel, plane in zip(CHANNELS, stored, strict=True):
        wrong = PLANE - int(np.count_nonzero(np.isfinite(plane)))
        if wrong:
            raise BadInput("file", name, f"holds {wrong} values that are not finite in its {channel} plane")
        if not np.max(plane) >= 0.0:
            raise BadInput("file", name, f"holds no measurement in its {channel} plane: all values are negative")
    return MerlFile(name, stored)


def write(path: str | os.PathLike[str], stored: Floats) -> None:
    """Writes three planes, [channel][theta_h][theta_d][phi_d], without the factors.

    Raises OSError where that is not possible.
    """
    if stored.shape != (len(CHANNELS), *SHAPE):
        raise ValueError(f"shape {stored.shape}: must be {(len(CHANNELS), *SHAPE)}")
    write_whole(Path(path), HEADER + np.ascontiguousarray(stored, "<f8").tobytes())


@cache
def centres() -> tuple[Floats, Floats, Floats]:
    """theta_h, theta_d and phi_d of the cells' centres, shaped so that they broadcast over a plane."""
    i, j, k = np.ogrid[: SHAPE[0], : SHAPE[1], : SHAPE[2]]
    return 0.5 * np.pi * ((i + 0.5) / 90.0) ** 2, np.radians(j + 0.5), np.radians(k + 0.5)


@cache
def centre_cosines() -> Floats:
    """The smaller of both directions' cosines at every cell's centre."""
    theta_h, theta_d, phi_d = centres()
    cosines: Floats = np.cos(theta_h) * np.cos(theta_d) - np.sin(theta_h) * np.sin(theta_d) * np.abs(np.cos(phi_d))
    return cosines


def share_below() -> float:
    """The share of a table's cells whose centre lies below the horizon."""
    return float(np.count_nonzero(centre_cosines() <= 0.0)) / PLANE
