"""Counter-based uniforms on (0, 1): Philox2x32-10 for Monte Carlo, Owen-scrambled Sobol points for quasi-Monte Carlo.

Each is a scalar function of an index and keys, without state, so that any block of samples can be made anywhere in any order
and comes out bit by bit the same. Resolution 2^-32 (cell centres): no 0 and no 1, and a floor of about 1e-10 on what
a quasi-Monte Carlo mean can resolve.

Philox: Salmon, Moraes, Dror, Shaw, "Parallel random numbers: as easy as 1, 2, 3", 2011. Scrambling: nested uniform (Owen 1995)
by a hash on the bit-reversed index, Laine and Karras 2011 with the constants of Vegdahl 2021; Sobol direction numbers of Joe and
Kuo 2008.
"""

from __future__ import annotations

import numpy as np
from numba import njit

from albedo_lab.kernels.vmath import INLINE

SCALE = 2.0**-32
HALF_CELL = 2.0**-33


def _direction_numbers(degree: int, coefficients: int, m: list[int]) -> list[int]:
    """The 32 direction numbers of one Sobol dimension, bit-reversed, as the scramble wants them."""
    v = [m[i] << (31 - i) for i in range(degree)]
    for i in range(degree, 32):
        value = v[i - degree] ^ (v[i - degree] >> degree)
        for k in range(1, degree):
            if (coefficients >> (degree - 1 - k)) & 1:
                value ^= v[i - k]
        v.append(value)
    return [int(f"{value:032b}"[::-1], 2) for value in v]


@njit(**INLINE)
def to_unit(x):
    """Centre of the cell of a 32-bit integer."""
    return np.float64(np.int64(x)) * SCALE + HALF_CELL


@njit(**INLINE)
def philox(i, stream, key):
    """Two uniforms for the counter (i, stream) under a key."""
    x0 = np.uint32(i)
    x1 = np.uint32(stream)
    k = np.uint32(key)
    for _ in range(10):
        product = np.uint64(x0) * np.uint64(0xD256D193)
        x0 = np.uint32(np.uint32(product >> np.uint64(32)) ^ k ^ x1)
        x1 = np.uint32(product)
        k = np.uint32(k + np.uint32(0x9E3779B9))
    return to_unit(x0), to_unit(x1)


@njit(**INLINE)
def reverse_bits(x):
    """Bit 0 becomes bit 31."""
    x = np.uint32(((x >> np.uint32(1)) & np.uint32(0x55555555)) | ((x & np.uint32(0x55555555)) << np.uint32(1)))
    x = np.uint32(((x >> np.uint32(2)) & np.uint32(0x33333333)) | ((x & np.uint32(0x33333333)) << np.uint32(2)))
    x = np.uint32(((x >> np.uint32(4)) & np.uint32(0x0F0F0F0F)) | ((x & np.uint32(0x0F0F0F0F)) << np.uint32(4)))
    x = np.uint32(((x >> np.uint32(8)) & np.uint32(0x00FF00FF)) | ((x & np.uint32(0x00FF00FF)) << np.uint32(8)))
    return np.uint32((x >> np.uint32(16)) | (x << np.uint32(16)))


@njit(**INLINE)
def scramble(x, key):
    """Nested uniform scramble of a bit-reversed coordinate: every bit is flipped by a hash of the bits below it."""
    x = np.uint32(x ^ np.uint32(x * np.uint32(0x3D20ADEA)))
    x = np.uint32(x + key)
    x = np.uint32(x * np.uint32((key >> np.uint32(16)) | np.uint32(1)))
    x = np.uint32(x ^ np.uint32(x * np.uint32(0x05526C56)))
    return np.uint32(x ^ np.uint32(x * np.uint32(0x53A22864)))


@njit(**INLINE)
def sobol0(i, key):
    """First dimension: van der Corput, whose bit-reversed coordinate is the index itself."""
    return to_unit(reverse_bits(scramble(np.uint32(i), np.uint32(key))))


@njit(**INLINE)
def sobol1(i, key):
    """Second dimension: Pascal's matrix modulo 2, applied to the index in five steps."""
    y = np.uint32(i)
    y ^= (y >> np.uint32(1)) & np.uint32(0x55555555)
    y ^= (y >> np.uint32(2)) & np.uint32(0x33333333)
    y ^= (y >> np.uint32(4)) & np.uint32(0x0F0F0F0F)
    y ^= (y >> np.uint32(8)) & np.uint32(0x00FF00FF)
    y ^= y >> np.uint32(16)
    return to_unit(reverse_bits(scramble(np.uint32(y), np.uint32(key))))


def _by_matrix(columns):
    """A Sobol dimension given by the columns of its generator matrix.

    The index comes in two parts, a multiple of 512 and the rest: the work for the first is the same for a whole block, and LLVM
    lifts it out of the loop over the block.
    """

    @njit(**INLINE)
    def coordinate(base, j, key):
        block = np.uint32(0)
        for b in range(9, 32):
            block ^= columns[b] & np.uint32(-np.int32((np.uint32(base) >> np.uint32(b)) & np.uint32(1)))
        y = np.uint32(j)
        z = block
        z ^= columns[0] & (np.uint32(0) - (y & np.uint32(1)))
        z ^= columns[1] & (np.uint32(0) - ((y >> np.uint32(1)) & np.uint32(1)))
        z ^= columns[2] & (np.uint32(0) - ((y >> np.uint32(2)) & np.uint32(1)))
        z ^= columns[3] & (np.uint32(0) - ((y >> np.uint32(3)) & np.uint32(1)))
        z ^= columns[4] & (np.uint32(0) - ((y >> np.uint32(4)) & np.uint32(1)))
        z ^= columns[5] & (np.uint32(0) - ((y >> np.uint32(5)) & np.uint32(1)))
        z ^= columns[6] & (np.uint32(0) - ((y >> np.uint32(6)) & np.uint32(1)))
        z ^= columns[7] & (np.uint32(0) - ((y >> np.uint32(7)) & np.uint32(1)))
        z ^= columns[8] & (np.uint32(0) - ((y >> np.uint32(8)) & np.uint32(1)))
        return to_unit(reverse_bits(scramble(np.uint32(z), np.uint32(key))))

    return coordinate


sobol2 = _by_matrix(np.array(_direction_numbers(2, 1, [1, 3]), dtype=np.uint32))
sobol3 = _by_matrix(np.array(_direction_numbers(3, 1, [1, 3, 1]), dtype=np.uint32))
