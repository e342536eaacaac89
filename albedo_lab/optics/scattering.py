"""The sum over the orders of scattering by a rough surface (Beckmann's series), at a bounded price for any roughness."""

from __future__ import annotations

from math import pi, sqrt

from albedo_lab.optics.maths import exp, expm1, log, log1p

DIRECT = 40.0
"""Up to this order of the largest term the terms are added one by one."""
ASYMPTOTIC = 1e6
"""From this order on Laplace's formula with its first correction errs by less than 3e-12."""
NEGLIGIBLE = 1e-13
"""What a term must not exceed, as a share of the sum, to be the last: what follows falls at least as fast as powers of 1/2."""
STEP = 0.65
"""Step of the trapezoidal rule in deviations: it errs by 2 exp(-2 pi^2 / STEP^2) for a Gaussian, by 1e-12 at order 40."""


def lambert_w(z: float) -> float:
    """The w >= 0 with w e^w = z >= 0, to the last bits: Winitzki's formula, then Fritsch's iteration of fourth order, twice."""
    if z < 1e-8:
        return z * (1.0 - z)
    lg = log1p(z)
    w = lg * (1.0 - log1p(lg) / (2.0 + lg))  # within 2 %
    for _ in range(2):
        residual = log(z / w) - w
        u = 1.0 + w
        q = 2.0 * u * (u + 2.0 / 3.0 * residual)
        w += w * residual * (q - residual) / (u * (q - 2.0 * residual))
    return w


def scattering_orders(g: float, x: float) -> float:
    """Sum over m >= 1 of e^-g g^(m-1) / (m! m) exp(-x/m), g >= 0 and x >= 0, to 1e-11; 0 where it is below 1e-300.

    Between factorials, log(term g) = E(m) - 3/2 log m - log(2 pi)/2 - ..., E = -g + m - m log(m/g) - x/m. E is largest where
    m^2 log(m/g) = x: at M = g e^w, 2w = W(2 x / g^2). About there, with m = M (1 + d),
    E(m) = E(M) - M ((1+d) log(1+d) - d + w d^2 / (1+d)): a bell, of variance 1 / (M (1 + 2w)) in d.
    """
    if g + x / DIRECT < DIRECT:  # which implies M < DIRECT
        return _one_by_one(g, x)
    w = 0.5 * lambert_w(2.0 * x / max(g * g, 1e-290))
    growth = exp(w)
    order = g * growth
    largest = g * (expm1(w) - 2.0 * w * growth)
    if largest < log(g) - 700.0:
        return 0.0
    if order < DIRECT:
        return _one_by_one(g, x)
    bell = _laplace(order, w) if order > ASYMPTOTIC else _in_steps(order, w)
    return exp(largest) * bell / g


def _one_by_one(g: float, x: float) -> float:
    """The terms as they come; their logarithms are concave in m, so that they only fall once they fall."""
    weight, total, m = exp(-g), 0.0, 1.0
    while m < 200.0:
        r = 1.0 / m
        term = weight * r * exp(-x * r)
        total += term
        if m > 2.0 * g and term < NEGLIGIBLE * total:
            break
        m += 1.0
        weight *= g / m
    return total


def _relative_term(t: float, em: float, en: float, order: float, w: float) -> float:
    """m times the term m = M e^t over exp(E(M)) and sqrt(M / (2 pi)), by Stirling's series; em = e^t - 1, en = 1 - e^-t."""
    r = (1.0 - en) / order
    rr = r * r
    stirling = r * (1.0 / 12.0 - rr * (1.0 / 360.0 - rr * (1.0 / 1260.0)))
    return exp(-order * (t * em - (em - t) + w * em * en) - 0.5 * t - stirling)


def _in_steps(order: float, w: float) -> float:
    """The sum of so smooth a bell over the integers is its integral, and so is a sum over log m in wide steps.

    e^t - 1 and 1 - e^-t go from step to step without cancellation, and exchange their roles, with a minus, for -t.
    """
    step = STEP / sqrt(order * (1.0 + 2.0 * w))
    grow, fade = expm1(step), -expm1(-step)
    total, t, em, en = _relative_term(0.0, 0.0, 0.0, order, w), 0.0, 0.0, 0.0
    for _ in range(40):
        t += step
        em += grow * (1.0 + em)
        en += fade * (1.0 - en)
        pair = _relative_term(t, em, en, order, w) + _relative_term(-t, -en, -em, order, w)
        total += pair
        if pair < NEGLIGIBLE * total:
            break
    return step * total / sqrt(2.0 * pi * order)


def _laplace(order: float, w: float) -> float:
    """Laplace's formula for the same sum: E = E(M) + M (-s d^2/2 + a d^3 - b d^4 + ..) under the factor m^-3/2."""
    s, a, b = 1.0 + 2.0 * w, 1.0 / 6.0 + w, 1.0 / 12.0 + w
    correction = ((7.5 * a * a / s - 3.0 * b - 4.5 * a) / s + 1.875) / s - 1.0 / 12.0
    return (1.0 + correction / order) / (order * sqrt(s))
