"""Elementary functions in float64 that LLVM inlines and vectorises: no tables, no calls, no branches.

numba has no vector libm, so a loop that calls `math.exp` stays scalar. These are straight lines of arithmetic, and a
loop over any of them compiles to packed instructions. At the borders they give what C gives: NaN goes through, zeros
and infinities have their limits, arguments and results may be subnormal. The sign of a zero is not kept.

    function     largest error, ulp    ns    ns of libm through numba    arguments
    exp                 1.01           0.7        4.3                    all
    expm1               1.80           0.8       11.1                    all
    log                 0.85           1.0        3.4                    all; NaN below 0
    log1p               1.40           1.0       10.6                    all; NaN below -1
    pow                 1.46           3.0       11.0                    x >= 0, any y; NaN for x < 0, unless y = 0
    sincos2pi           1.47           0.8       23.0                    |u| < 2^49, meaningless beyond

An ulp is a unit in the last place of the exact result, also next to a zero of log, sin or cos; the absolute error of
sincos2pi is below 1.7e-16. The errors are the worst of 25 million points in each of several ranges, compared with
80-bit libm; tests/kernels/test_vmath.py holds them against mpmath. The times are for one element of 1e5, one thread,
AVX-512 (Zen 4). Without a fused multiply-add in hardware `fma` calls libm: right, but slow.

What was decided by measuring, on that machine:

- No `nnan` and `ninf`: they speed up log and log1p by 3 %, the others by nothing, samples of GGX and Phong by 3 to 6 %,
  and make every NaN and infinity undefined. `reassoc` would cancel the rounding steps.
- No `contract` and `arcp`, though samples run 2 to 10 % faster with them: which products LLVM fuses and which quotients it
  turns into products depends on what else the process has compiled, and the last bits of a result with it. The polynomials
  here say themselves where they fuse.
- pow keeps the logarithm in two doubles. exp(y * log(x)) takes 2.3 ns and errs by up to 1 + 2.2 |y log x| ulp, which
  is 1300 at the ends of the range. In a Phong sample, which has other work, the difference is at most 6 %.
- Subnormal arguments cost log 0.15 and pow 0.3 ns, subnormal results cost exp 0.05 ns: not flushed.
"""

from __future__ import annotations

import math
from typing import Any

from llvmlite import ir
from numba import njit, types
from numba.extending import intrinsic

__all__ = ["FLAGS", "INLINE", "exp", "expm1", "fma", "from_bits", "log", "log1p", "pow", "sincos2pi", "to_bits"]

# A set, because numba takes no frozenset. forceinline: LLVM alone leaves calls, and a call ends vectorisation.
FLAGS = {"nsz"}
INLINE: dict[str, Any] = {"fastmath": FLAGS, "error_model": "numpy", "forceinline": True}

# Adding 1.5 * 2^52 rounds to an integer, ties to even, and leaves that integer in the low bits: for |x| < 2^51.
ROUND = 6755399441055744.0
ROUND_BITS = 0x4338000000000000
ONE_BITS = 0x3FF0000000000000
SQRT_HALF_BITS = 0x3FE6A09E667F3BCD
MANTISSA_BITS = 0x000FFFFFFFFFFFFF

INF = math.inf
NAN = math.nan
SMALLEST_NORMAL = 2.2250738585072014e-308
TWO_54 = 18014398509481984.0

# Constants in two parts, and the coefficients below, are derived by tests/kernels/vmath_coefficients.py.
LOG2_E = 1.4426950408889634
LN2_HIGH = 0.6931471803691238  # 32 bits: its product with an exponent is exact
LN2_LOW = 1.9082149292705877e-10
TWO_PI_HIGH = 6.283185307179586
TWO_PI_LOW = 2.4492935982947064e-16
TWO_THIRDS_HIGH = 0.6666666666666666
TWO_THIRDS_LOW = 3.700743415417188e-17


@intrinsic
def to_bits(typing_context, x):
    """The 64 bits of a double, as an integer."""

    def generate(context, builder, signature, arguments):
        return builder.bitcast(arguments[0], ir.IntType(64))

    return types.int64(types.float64), generate


@intrinsic
def from_bits(typing_context, i):
    """The double with these 64 bits."""

    def generate(context, builder, signature, arguments):
        return builder.bitcast(arguments[0], ir.DoubleType())

    return types.float64(types.int64), generate


@intrinsic
def fma(typing_context, x, y, z):
    """Return x y + z, rounded once."""

    def generate(context, builder, signature, arguments):
        return builder.fma(*arguments)

    return types.float64(types.float64, types.float64, types.float64), generate


@njit(**INLINE)
def _exp_tail(r):
    """(exp(r) - 1 - r) / r² on |r| <= log(2)/2; error 2.9e-19 of exp(r)."""
    r2 = r * r
    r4 = r2 * r2
    a = fma(r2, fma(0.008333333333326141, r, 0.04166666666666667), fma(0.1666666666666667, r, 0.5))
    b = fma(0.00019841269874800493, r, 0.0013888888888883752)
    c = fma(2.7557255425746435e-06, r, 2.4801587325533363e-05)
    d = fma(r2, 2.0914679376583935e-09, fma(2.510520637395701e-08, r, 2.7557273661348637e-07))
    return fma(r4, fma(r4, d, fma(r2, c, b)), a)


@njit(**INLINE)
def _scaled(q, t):
    """(1 + q) 2^n for t = ROUND + n, n in [-2044, 2046]."""
    i = to_bits(t)
    h = i >> 1
    # 2^n in two factors, because a single double ends at 2^1023 and 2^-1022; the shifts push ROUND_BITS out
    a = from_bits((h << 52) + ONE_BITS)
    b = from_bits(((i - h) << 52) + ONE_BITS)
    return fma(a, q, a) * b


@njit(**INLINE)
def exp(x):
    """e^x."""
    # Clamped from below before the reduction and from above after it: with both bounds on one value, and a NaN to let
    # through, LLVM finds no min and max. Above, r is large and positive, and so is its polynomial: the result is inf.
    x = -746.0 if x < -746.0 else x
    t = fma(x, LOG2_E, ROUND)
    t = ROUND + 1025.0 if t > ROUND + 1025.0 else t
    n = t - ROUND
    r = fma(-n, LN2_LOW, fma(-n, LN2_HIGH, x))
    return _scaled(fma(r * r, _exp_tail(r), r), t)


@njit(**INLINE)
def expm1(x):
    """e^x - 1, accurate where it is small."""
    x = 710.0 if x > 710.0 else x
    x = -100.0 if x < -100.0 else x
    t = fma(x, LOG2_E, ROUND)
    n = t - ROUND
    a = fma(-n, LN2_HIGH, x)
    r = fma(-n, LN2_LOW, a)
    r_low = fma(-n, LN2_LOW, a - r)  # half an ulp of r would be one of the result where 2^n r cancels much of 2^n - 1
    q = r + fma(r * r, _exp_tail(r), r_low)
    half = from_bits((to_bits(t) << 52) + (ONE_BITS - (1 << 52)))  # 2^(n-1), because 2^1024 is not a double
    return 2.0 * fma(half, q, half - 0.5)


@njit(**INLINE)
def _split(x):
    """(f, n) with x = (1 + f) 2^n and 1 + f in [sqrt(1/2), sqrt(2)), f exact; x positive and normal."""
    i = to_bits(x) + (ONE_BITS - SQRT_HALF_BITS)
    n = from_bits(((i >> 52) & 0xFFF) + ROUND_BITS) - (ROUND + 1023.0)
    return from_bits((i & MANTISSA_BITS) + SQRT_HALF_BITS) - 1.0, n


@njit(**INLINE)
def _split_any(x):
    """_split for every x, subnormal included; n alone carries what is infinite or not a number."""
    subnormal = x < SMALLEST_NORMAL
    f, n = _split(x * TWO_54 if subnormal else x)
    n = n - 54.0 if subnormal else n
    n = n if x < INF else x
    return f, n if x > 0.0 else (-INF if x == 0.0 else NAN)


@njit(**INLINE)
def _log_tail(z):
    """(log((1+s)/(1-s)) - 2s - 2/3 s³) / s⁵, z = s² <= 0.02944; error 1.0e-20 of the logarithm."""
    z2 = z * z
    a = fma(z2, fma(0.18181818335314404, z, 0.22222222221656232), fma(0.28571428571429364, z, 0.4))
    b = fma(z2, fma(0.11723051028097753, z, 0.11706248540922386), fma(0.13334804238225345, z, 0.15384594970895457))
    return fma(z2 * z2, b, a)


@njit(**INLINE)
def _log_reduced(f, n):
    """log((1 + f) 2^n), arranged as in fdlibm: f is exact, and what is added to it is small."""
    s = f / (2.0 + f)
    z = s * s
    half = 0.5 * f * f
    small = fma(s, fma(z, fma(z, _log_tail(z), TWO_THIRDS_HIGH), half), n * LN2_LOW)
    return fma(n, LN2_HIGH, f - (half - small))


@njit(**INLINE)
def log(x):
    """Natural logarithm; -inf at 0, NaN below."""
    f, n = _split_any(x)
    return _log_reduced(f, n)


@njit(**INLINE)
def log1p(x):
    """log(1 + x), accurate where it is small; -inf at -1, NaN below."""
    u = 1.0 + x
    lost = x - (u - 1.0)  # exact while u < 2^53
    f, n = _split(u)
    f = fma(lost, from_bits(ONE_BITS - (to_bits(n + ROUND) << 52)), f) if u < 1e15 else f  # lost 2^-n; f = x where n = 0
    n = n if x < INF else x
    n = n if x > -1.0 else (-INF if x == -1.0 else NAN)
    return _log_reduced(f, n)


@njit(**INLINE)
def _log_two(f, n):
    """log((1 + f) 2^n) as high + low, error 1.2e-19 of it; low is meaningless where high is not finite."""
    d = 2.0 + f
    d_low = (2.0 - d) + f
    s = f / d
    s_low = fma(-s, d_low, fma(-s, d, f)) * fma(-0.5, s, 0.5)  # the remainder times 1/d = (1 - s)/2
    z = s * s
    z_low = fma(s + s, s_low, fma(s, s, -z))
    s3 = s * z
    s3_low = fma(s, z, -s3) + fma(s, z_low, s_low * z)
    tail = _log_tail(z)
    c = fma(z, tail, TWO_THIRDS_HIGH)
    c_low = fma(z, tail, TWO_THIRDS_HIGH - c) + TWO_THIRDS_LOW
    v = s3 * c
    v_low = fma(s3, c, -v) + fma(s3, c_low, s3_low * c)
    # n log 2 + 2 s + v, each sum with its error; the larger first: |n| log 2 >= 0.69 > 2 |s|, or n = 0
    k = n * LN2_HIGH
    two_s = s + s
    total = k + two_s
    total_low = (k - total) + two_s
    high = total + v
    high_low = (total - high) + v
    return high, (total_low + high_low) + (v_low + fma(n, LN2_LOW, s_low + s_low))


@njit(**INLINE)
def _exp_two(x, x_low):
    """exp(x + x_low); as exp, with one addition more."""
    x = -746.0 if x < -746.0 else x
    t = fma(x, LOG2_E, ROUND)
    t = ROUND + 1025.0 if t > ROUND + 1025.0 else t
    n = t - ROUND
    r = fma(-n, LN2_LOW, fma(-n, LN2_HIGH, x)) + x_low
    return _scaled(fma(r * r, _exp_tail(r), r), t)


@njit(**INLINE)
def pow(x, y):
    """x^y for x >= 0; NaN for x < 0. x^0 = 1 and 1^y = 1 for any x and y, NaN included, as in C."""
    f, n = _split_any(x)
    high, low = _log_two(f, n)
    p = y * high
    p_low = fma(y, low, fma(y, high, -p))
    p_low = p_low if abs(p) < 1000.0 else 0.0  # inf - inf
    z = _exp_two(p, p_low)
    z = z if x != 1.0 else 1.0
    return z if y != 0.0 else 1.0


@njit(**INLINE)
def sincos2pi(u):
    """(sin 2πu, cos 2πu); u in turns, so that its reduction to an eighth is exact."""
    t = fma(u, 4.0, ROUND)
    r = fma(t - ROUND, -0.25, u)
    z = r * r
    z2 = z * z
    z4 = z2 * z2
    # sin(2πr) = r (2π + z S(z)), error 1.3e-17 of it; 2π in two parts, or its rounding would cost half an ulp
    s = fma(z2, fma(42.05868918088512, z, -76.70585973562093), fma(81.6052492760517, z, -41.341702240399755))
    s = fma(z4, fma(3.78643334956545, z, -15.094054182079999), s)
    s = fma(r, TWO_PI_HIGH, r * fma(z, s, TWO_PI_LOW))
    # cos(2πr) = 1 + z C(z), error 1.8e-17
    c = fma(z2, fma(60.24464135270201, z, -85.4568172066438), fma(64.93939402266824, z, -19.739208802178716))
    c = fma(z4, fma(z2, -1.6990343940660637, fma(7.903206911569678, z, -26.426253275854723)), c)
    c = fma(z, c, 1.0)
    quarter = to_bits(t)
    odd = (quarter & 1) != 0
    sine = c if odd else s
    cosine = s if odd else c
    return from_bits(to_bits(sine) ^ ((quarter & 2) << 62)), from_bits(to_bits(cosine) ^ (((quarter + 1) & 2) << 62))
