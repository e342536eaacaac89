"""The template that integrates a BRDF by adaptive quadrature in the coordinates in which it is smooth.

A direction is written by its slope rho (tangent of its angle from the declared axis) and its azimuth psi from the plane of
incidence. The horizon and the circle of equal cosines are known in closed form along every azimuth, so each radial integral
runs over smooth pieces only. In azimuth, a quarter turn on both sides of the plane normal to the plane of incidence is
stretched by a hyperbolic sine, since near grazing the integrand changes within an azimuth of the order of mu, and the circle of
equal cosines crosses a lobe within one of the order of mu times its width.

Both integrals are adaptive Gauss-Kronrod (15, 31), worst panel first. The bound is the sum of |K31 - G15| over the panels of the
outer integral plus the same of every inner one, integrated along, taken twice: that is G15's error, far above the K31 value's own
unless both rules miss the same feature. To it comes a rounding term: a direction's components err by 2^-53, which a narrow lobe
divides by its width, and a half-vector near grazing by (wo.h) once more. The rule is a long one because most pieces are smooth
enough to be done with it at once, and because its nodes fill SIMD lanes. (QUADPACK's sharper estimate, (200 d)^1.5, was tried: it
left 4 of 540 reference cells outside their bound, one by 140 times.)
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from math import asinh, atan2, cos, cosh, pi, sin, sinh, sqrt
from typing import Any

import numpy as np

from albedo_lab.kernels.jit import Placeholder, specialise
from albedo_lab.kernels.kronrod import GAUSS, KRONROD, LANES, NODES
from albedo_lab.model import Model
from albedo_lab.optics.coordinates import Axis
from albedo_lab.optics.frame import Direction

INNER_PANELS = 64
OUTER_PANELS = 128
NOISE = 2.0**-50
EPSILON = 2.0**-52
NARROW = 50.0
"""From this exponent on, nothing of a lobe (2^-50 at 60 degrees) is left where the circle of equal cosines enters it."""
SAFETY = 2.0
OUTER_SHARE = 0.3
INNER_SHARE = 0.1
NORMAL, MIRROR, RETRO, HALF = (int(axis) for axis in Axis)

Parameters = Placeholder("Parameters")
evaluate = Placeholder("evaluate")
f = Placeholder("f")
slope = Placeholder("slope")
coordinate = Placeholder("coordinate")
exponent = Placeholder("exponent")
ellipse = Placeholder("ellipse")
AXIS = Placeholder("AXIS")
END = Placeholder("END")
KINK = Placeholder("KINK")


def f_for_viewer(p, moving, fixed):
    """Integrated over the light."""
    return evaluate(p, moving, fixed)


def f_for_light(p, moving, fixed):
    """Integrated over the viewer."""
    return evaluate(p, fixed, moving)


def horizon(c, mu, si):
    """Slope at which the moving direction meets the horizon, along an azimuth whose cosine is c; infinite where it never does."""
    if AXIS == NORMAL:
        return np.inf
    if AXIS == HALF:
        reach = sqrt(mu * mu + si * si * c * c)
        if c < 0.0:
            return mu / (reach - si * c)
        return (reach + si * c) / mu if mu > 0.0 else np.inf
    return mu / (-si * c) if c < 0.0 else np.inf


def equal_cosines(c, mu, si):
    """Slope at which both cosines are equal; 0 where they never are."""
    if AXIS == NORMAL:
        return si / mu if mu > 0.0 else 0.0
    if c <= 0.0 or mu == 0.0:
        return 0.0
    t = si * c / mu
    if AXIS == HALF:
        return t
    return 2.0 * t / (1.0 - t * t) if t < 1.0 else 0.0


def integrand(y, p, n, wo, mu, si, cpo, spo, ux, uy, c, s, d, area):
    """f cos per dy dpsi.

    (ux, uy) is the azimuth of the half-vector in the surface's frame, c and s its cosine and sine from the plane of incidence.
    """
    rho, measure = slope(y, n)
    rho *= d
    root = 1.0 / sqrt(1.0 + rho * rho)
    jacobian = measure * area * root * root * root
    if AXIS == HALF:
        reach = sqrt(mu * mu + si * si * c * c)
        if c < 0.0:
            b = reach - si * c
            z = (mu / b - rho) * (mu * rho + b)
        else:
            a = reach + si * c
            z = (a - mu * rho) * (rho + mu / a) if a > 0.0 else 0.0
        z *= root * root
        oh = (si * c * rho + mu) * root
        k = 2.0 * oh * rho * root
        wi = Direction(k * ux - wo.x, k * uy - wo.y, z)
        jacobian *= 4.0 * oh
    elif AXIS == NORMAL:
        z = root
        wi = Direction(rho * root * ux, rho * root * uy, z)
    else:
        sign = -1.0 if AXIS == MIRROR else 1.0
        z = root * (mu + si * c * rho)
        # azimuth 0 turns towards the normal, away from the axis' horizontal part
        along = sign * (si * root - mu * c * rho * root)
        across = s * rho * root
        wi = Direction(along * cpo - across * spo, along * spo + across * cpo, z)
    value = f(p, wi, wo) * z * jacobian
    return value if z > 0.0 else 0.0


def panel(a, b, low, high, lanes, p, n, wo, mu, si, cpo, spo, ux, uy, c, s, d, area):
    """K31 and |K31 - G15| over x in [a, b], where y = high - (high - low)(1 - x)^2 crowds the points at the horizon's end."""
    middle, half = 0.5 * (a + b), 0.5 * (b - a)
    for i in range(LANES):
        far = 1.0 - (middle + half * NODES[i])
        y = high - (high - low) * far * far
        lanes[i] = integrand(y, p, n, wo, mu, si, cpo, spo, ux, uy, c, s, d, area) * far
    kronrod = 0.0
    gauss = 0.0
    for i in range(LANES - 1):
        kronrod += KRONROD[i] * lanes[i]
        gauss += GAUSS[i] * lanes[i]
    scale = 2.0 * (high - low) * half
    return kronrod * scale, abs(kronrod - gauss) * scale


def radial(tolerance, work, lanes, p, n, wo, mu, si, cpo, spo, ux, uy, c, s, d, area):
    """Integral over the slope along one azimuth: value, bound, panels used.

    `work` holds the panels: a, b, low, high, value, error.
    """
    far = min(coordinate(horizon(c, mu, si) / d, n), END)
    near = min(coordinate(equal_cosines(c, mu, si) / d, n), END) if KINK else 0.0
    if far <= 0.0:
        return 0.0, 0.0, 0
    split = 0.0 < near < far
    work[0, 0], work[0, 1], work[0, 2], work[0, 3] = 0.0, 1.0, near if split else 0.0, far
    count = 1
    if split:
        work[1, 0], work[1, 1], work[1, 2], work[1, 3] = 0.0, 1.0, 0.0, near
        count = 2
    fresh = 0
    used = 0
    worst = 0
    while True:
        for i in range(fresh, count):
            work[i, 4], work[i, 5] = panel(
                work[i, 0], work[i, 1], work[i, 2], work[i, 3], lanes, p, n, wo, mu, si, cpo, spo, ux, uy, c, s, d, area
            )
            used += 1
        value = 0.0
        error = 0.0
        size = 0.0
        worst = 0
        for i in range(count):
            value += work[i, 4]
            error += work[i, 5]
            size += abs(work[i, 4])
            if work[i, 5] > work[worst, 5]:
                worst = i
        if not error > max(tolerance, NOISE * size) or count + 1 >= INNER_PANELS:
            return value, error, used
        # the worst panel makes way for its halves at the end of the list
        a, b, low, high = work[worst, 0], work[worst, 1], work[worst, 2], work[worst, 3]
        for k in range(6):
            work[worst, k] = work[count - 1, k]
        middle = 0.5 * (a + b)
        work[count - 1, 0], work[count - 1, 1], work[count - 1, 2], work[count - 1, 3] = a, middle, low, high
        work[count, 0], work[count, 1], work[count, 2], work[count, 3] = middle, b, low, high
        fresh = count - 1
        count += 1


def azimuth(x, stretch, scale, tolerance, work, lanes, p, wo, mu, si, cpo, spo, symmetric):
    """The radial integrals at one distance from the plane normal to that of incidence, on both sides: value, bound, panels."""
    q = scale * sinh(stretch * x)
    dq = scale * stretch * cosh(stretch * x)
    ex, ey = ellipse(p)
    n = exponent(p)
    area = ex * ey
    # azimuths turn in the plane where the ellipse is a circle; there the plane of incidence lies at (c0, s0)
    c0, s0 = ex * cpo, ey * spo
    width = sqrt(c0 * c0 + s0 * s0)
    c0, s0 = c0 / width, s0 / width
    value = 0.0
    error = 0.0
    used = 0
    for quadrant in range(2 if symmetric else 4):
        c = sin(q) if quadrant % 2 == 0 else -sin(q)
        s = cos(q) if quadrant < 2 else -cos(q)
        dx, dy = ex * (c * c0 - s * s0), ey * (s * c0 + c * s0)
        d = sqrt(dx * dx + dy * dy)
        ux, uy = dx / d, dy / d
        c = c * width / d
        s = uy * cpo - ux * spo
        v, e, u = radial(tolerance / dq, work, lanes, p, n, wo, mu, si, cpo, spo, ux, uy, c, s, d, area)
        value += v
        error += e
        used += u
    factor = 2.0 * dq if symmetric else dq
    return value * factor, error * factor, used


def outer_panel(a, b, stretch, scale, tolerance, work, lanes, p, wo, mu, si, cpo, spo, symmetric):
    """K31, |K31 - G15|, the inner bounds integrated along, and panels used, over [a, b] of the stretched azimuth."""
    middle, half = 0.5 * (a + b), 0.5 * (b - a)
    kronrod = 0.0
    gauss = 0.0
    inner = 0.0
    used = 0
    for i in range(LANES - 1):
        x = middle + half * NODES[i]
        v, e, u = azimuth(x, stretch, scale, tolerance, work, lanes, p, wo, mu, si, cpo, spo, symmetric)
        kronrod += KRONROD[i] * v
        gauss += GAUSS[i] * v
        inner += KRONROD[i] * e
        used += u
    return kronrod * half, abs(kronrod - gauss) * half, inner * half, used


def lobe_width(p):
    """The slope at which a lobe has fallen off to 1/e, at most 1."""
    ex, ey = ellipse(p)
    return min(1.0, slope(1.0, exponent(p))[0] * min(ex, ey))


def rounding(p, mu):
    """Relative error that the rounding of directions leaves in a lobe of this width."""
    if AXIS == NORMAL:
        return EPSILON
    width = lobe_width(p)
    return EPSILON / width / (max(mu, width) if AXIS == HALF else 1.0)


def integrate(values, mu, phi, symmetric, tolerance, relative, answer):
    """The albedo of the shape at (mu, phi) into answer: value, bound, evaluations.

    Stops when the bound is under max(tolerance, relative * value), when it drowns in rounding, or when it runs out of panels.
    """
    p = Parameters(*values)
    si = sqrt((1.0 - mu) * (1.0 + mu))
    cpo, spo = cos(phi), sin(phi)
    wo = Direction(si * cpo, si * spo, mu)
    scale = max(mu / si * (lobe_width(p) if KINK else 1.0), 1e-12) if si > 0.0 else 1e6
    stretch = asinh(0.5 * pi / scale)
    work = np.empty((INNER_PANELS, 6))
    lanes = np.empty(LANES)
    panels = np.empty((OUTER_PANELS, 5))
    panels[0, 0], panels[0, 1] = 0.0, 1.0
    count = 1
    if KINK and (AXIS == MIRROR or AXIS == RETRO) and mu < si and exponent(p) < NARROW:
        # the circle of equal cosines enters the lobe's hemisphere where the azimuth's cosine is mu / si
        enters = asinh(atan2(mu, sqrt((si - mu) * (si + mu))) / scale) / stretch
        panels[0, 1], panels[1, 0], panels[1, 1] = enters, enters, 1.0
        count = 2
    fresh = 0
    used = 0
    inner_aim = INNER_SHARE * tolerance if relative == 0.0 else np.inf
    while True:
        for i in range(fresh, count):
            panels[i, 2], panels[i, 3], panels[i, 4], u = outer_panel(
                panels[i, 0], panels[i, 1], stretch, scale, inner_aim, work, lanes, p, wo, mu, si, cpo, spo, symmetric
            )
            used += u
        value = 0.0
        outer = 0.0
        inner = 0.0
        size = 0.0
        worst = 0
        for i in range(count):
            value += panels[i, 2]
            outer += panels[i, 3]
            inner += panels[i, 4]
            size += abs(panels[i, 2])
            if panels[i, 3] > panels[worst, 3]:
                worst = i
        aim = max(tolerance, relative * abs(value))
        if inner_aim == np.inf:
            # the first look has told how large the answer is; radial integrals that miss their share are done again
            inner_aim = INNER_SHARE * aim
            fresh = 0 if inner > inner_aim else count
            if fresh == 0:
                continue
        if not outer > max(OUTER_SHARE * aim, NOISE * size) or count + 1 >= OUTER_PANELS:
            break
        a, b = panels[worst, 0], panels[worst, 1]
        for k in range(5):
            panels[worst, k] = panels[count - 1, k]
        middle = 0.5 * (a + b)
        panels[count - 1, 0], panels[count - 1, 1] = a, middle
        panels[count, 0], panels[count, 1] = middle, b
        fresh = count - 1
        count += 1
    answer[0] = value
    answer[1] = SAFETY * (outer + inner) + (NOISE + rounding(p, mu)) * size
    answer[2] = 1.0 * (LANES - 1) * used


@cache
def quadrature_kernel(model: Model, order: str = "wi") -> Callable[..., Any]:
    """The kernel for one model and one order of integration."""
    coordinates = model.smooth_in
    return specialise(
        integrate,
        Parameters=model.parameters_type,
        f=f_for_light if order == "wo" else f_for_viewer,
        evaluate=model.evaluate,
        slope=coordinates.profile.slope,
        coordinate=coordinates.profile.coordinate,
        exponent=coordinates.exponent,
        ellipse=coordinates.ellipse,
        AXIS=int(coordinates.axis),
        END=coordinates.profile.end,
        KINK=coordinates.kink,
    )
