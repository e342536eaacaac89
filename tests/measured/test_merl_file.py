"""Reading and writing of MERL files: every byte where it belongs, and one clear line for every file that is not sound."""

from __future__ import annotations

import os
import struct
from collections.abc import Callable, Iterator
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

from albedo_lab.errors import BadInput
from albedo_lab.measured.merl_file import CHANNELS, HEADER, PLANE, SIZE, centre_cosines, read, write

Floats = NDArray[np.float64]


@pytest.fixture(scope="module")
def stored() -> Floats:
    """Positive noise with -1 below the horizon."""
    values = np.random.default_rng(5).random((3, 90, 90, 180))
    values[:, centre_cosines() < 0.0] = -1.0
    return values


@pytest.fixture
def path(tmp_path: Path) -> Iterator[Path]:
    """A file of 35 MB is not left for pytest to keep."""
    path = tmp_path / "material.binary"
    yield path
    path.unlink(missing_ok=True)


def test_layout(path: Path, stored: Floats) -> None:
    """Header and values where the format has them, by plain arithmetic; and the factors of the channels."""
    write(path, stored)
    assert path.stat().st_size == SIZE == 12 + 3 * 8 * 90 * 90 * 180
    found = read(path)
    with path.open("rb") as stream:
        assert struct.unpack("<3i", stream.read(12)) == (90, 90, 180)
        for channel, factor, h, d, phi in ((0, 1.0, 0, 0, 0), (1, 1.15, 7, 30, 179), (2, 1.66, 89, 89, 91)):
            stream.seek(12 + 8 * (channel * PLANE + phi + 180 * (d + 90 * h)))
            (value,) = struct.unpack("<d", stream.read(8))
            assert value == stored[channel, h, d, phi]
            assert found.values(CHANNELS[channel])[h, d, phi] == pytest.approx(value * factor / 1500.0, rel=1e-15)


def test_bytes_survive(path: Path, stored: Floats) -> None:
    write(path, stored)
    before = path.read_bytes()
    write(path, read(path).stored)
    assert path.read_bytes() == before


def test_census(path: Path, stored: Floats) -> None:
    """A hole is a negative value above the horizon."""
    values = stored.copy()
    values[1, 10, 10, 10:13] = -0.5
    values[1, 20, 10, 10:15] = 0.0
    write(path, values)
    below = int(np.count_nonzero(centre_cosines() < 0.0))
    assert read(path).census("red") == (PLANE, below, 0, 0)
    assert read(path).census("green") == (PLANE, below + 3, 3, 5)


def test_values_are_a_copy(path: Path, stored: Floats) -> None:
    """Aligned for compiled code, and not pulled away when the file is cut short."""
    write(path, stored)
    values = read(path).values("red")
    os.truncate(path, 12)
    assert values.flags.aligned
    assert np.array_equal(values, stored[0] * (1.0 / 1500.0))


def cut_short(path: Path, stored: Floats) -> None:
    path.write_bytes(HEADER)
    os.truncate(path, SIZE - 8)


def too_long(path: Path, stored: Floats) -> None:
    path.write_bytes(HEADER)
    os.truncate(path, SIZE + 1)


def empty(path: Path, stored: Floats) -> None:
    path.touch()


def other_dimensions(path: Path, stored: Floats) -> None:
    path.write_bytes(struct.pack("<3i", 180, 90, 90))
    os.truncate(path, SIZE)


def big_endian(path: Path, stored: Floats) -> None:
    path.write_bytes(struct.pack(">3i", 90, 90, 180))
    os.truncate(path, SIZE)


def not_a_number(path: Path, stored: Floats) -> None:
    values = stored.copy()
    values[2, 89, 3, 5] = np.nan
    write(path, values)


def infinite(path: Path, stored: Floats) -> None:
    values = stored.copy()
    values[0, 0, 0, :2] = np.inf, -np.inf
    write(path, values)


def all_negative(path: Path, stored: Floats) -> None:
    write(path, np.stack([stored[0], np.full_like(stored[0], -1.0), stored[2]]))


def absent(path: Path, stored: Floats) -> None:
    pass


BAD: list[tuple[Callable[[Path, Floats], None], str]] = [
    (cut_short, "has 34992004 bytes; .* has 34992012"),
    (too_long, "has 34992013 bytes; .* has 34992012"),
    (empty, "has 0 bytes"),
    (other_dimensions, "180 x 90 x 90 cells by its header; must have 90 x 90 x 180"),
    (big_endian, "must have 90 x 90 x 180"),
    (not_a_number, "holds 1 values that are not finite in its blue plane"),
    (infinite, "holds 2 values that are not finite in its red plane"),
    (all_negative, "no measurement in its green plane"),
    (absent, "cannot be read .No such file"),
]


@pytest.mark.parametrize(("make", "message"), BAD, ids=[make.__name__ for make, _ in BAD])
def test_a_file_that_is_not_sound(path: Path, stored: Floats, make: Callable[[Path, Floats], None], message: str) -> None:
    make(path, stored)
    with pytest.raises(BadInput, match=message) as caught:
        read(path)
    assert caught.value.parameter == "file"
    assert str(path) in str(caught.value)
    assert "\n" not in str(caught.value)


def test_what_is_no_file(tmp_path: Path) -> None:
    os.mkfifo(tmp_path / "pipe")
    for path in (tmp_path, tmp_path / "pipe", Path(os.devnull)):
        with pytest.raises(BadInput, match="must be a file, not a folder or a device"):
            read(path)
    with pytest.raises(BadInput, match="cannot be read"):
        read("nul\0byte")


def test_a_file_that_may_not_be_read(path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path.write_bytes(HEADER)
    os.truncate(path, SIZE)

    def refuse(*arguments: object) -> None:
        raise PermissionError(13, "Permission denied")

    monkeypatch.setattr("builtins.open", refuse)  # mode bits do not stop a superuser
    with pytest.raises(BadInput, match="Permission denied"):
        read(path)


def test_a_changed_file_is_read_anew(path: Path, stored: Floats) -> None:
    write(path, stored)
    first = read(path)
    assert read(path) is first
    write(path, stored[::-1])
    assert np.array_equal(read(path).stored[0], stored[2])


def test_whole_or_not_at_all(tmp_path: Path, stored: Floats) -> None:
    with pytest.raises(ValueError, match="shape"):
        write(tmp_path / "x.binary", stored[:1])
    with pytest.raises(OSError, match="No such file"):
        write(tmp_path / "missing" / "x.binary", stored)
    assert list(tmp_path.iterdir()) == []
