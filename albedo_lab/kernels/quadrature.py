"""The template that integrates a BRDF by adaptive quadrature in the coordinates in which it is smooth.

A direction is written by its slope rho (tangent of its angle from the declared axis) and its azimuth psi from the plane of the
normal and that axis, which for half-vectors is the plane of incidence. The horizon and the kinks that a model declares are known
in closed form along every azimuth, so each radial integral runs over smooth pieces only. In azimuth, a quarter turn on both sides
of the plane normal to that of psi = 0 is stretched by a hyperbolic sine, since near grazing the integrand changes within an
azimuth of the order of mu, and the circle of equal cosines crosses a lobe within one of the order of mu times its width.

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
from math import asinh, atan2, cos, cosh, pi, sin, sinh, sqrt, tan
from typing import Any, NamedTuple

import numpy as np

from albedo_lab.kernels.jit import Placeholder, specialise
from albedo_lab.kernels.kronrod import GAUSS, KRONROD, LANES, NODES
from albedo_lab.model import Model
from albedo_lab.optics.coordinates import Axis, Kink
from albedo_lab.optics.frame import Direction

INNER_PANELS = 64
OUTER_PANELS = 128
NOISE = 2.0**-50
EPSILON = 2.0**-52
NARROW = 50.0
"""From this exponent on, nothing of a lobe (2^-50 at 60 degrees) is left where the circle of equal cosines enters it."""
FAR = 1e15
"""A slope that is a right angle."""
SAFETY = 2.0
OUTER_SHARE = 0.3
INNER_SHARE = 0.1
NORMAL, MIRROR, RETRO, HALF, LOBE = (int(axis) for axis in Axis)
NONE, EQUAL_COSINES, V_CAVITY = (int(kink) for kink in Kink)

Parameters = Placeholder("Parameters")
evaluate = Placeholder("evaluate")
f = Placeholder("f")
slope = Placeholder("slope")
coordinate = Placeholder("coordinate")
exponent = Placeholder("exponent")
ellipse = Placeholder("ellipse")
lobe = Placeholder("lobe")
AXIS = Placeholder("AXIS")
END = Placeholder("END")
KINK = Placeholder("KINK")
PIECES = Placeholder("PIECES")


class Frame(NamedTuple):
    """The fixed direction, and the axis: its sine `si` and cosine `co` with the normal, the cosine and sine of its azimuth.

    For normals and half-vectors the azimuth is that of the fixed direction, and si and co are its own, too.
    """

    wo: Direction
    mu: float
    si: float
    co: float
    ca: float
    sa: float


class Ray(NamedTuple):
    """One azimuth: its direction (ux, uy) in the surface's frame, its cosine and sine from the plane of psi = 0.

    `d` is the width of the profile along it, `area` the Jacobian of the ellipse.
    """

    ux: float
    uy: float
    c: float
    s: float
    d: float
    area: float


def f_for_viewer(p, moving, fixed):
    """Integrated over the light."""
    return evaluate(p, moving, fixed)


def f_for_light(p, moving, fixed):
    """Integrated over the viewer."""
    return evaluate(p, fixed, moving)


def frame_of(p, mu, phi):
    """Where the axis stands for a fixed direction of cosine mu and azimuth phi."""
    si = sqrt((1.0 - mu) * (1.0 + mu))
    ca, sa = cos(phi), sin(phi)
    wo = Direction(si * ca, si * sa, mu)
    if AXIS == MIRROR:
        return Frame(wo, mu, si, mu, -ca, -sa)
    if AXIS == LOBE:
        axis = lobe(p, wo)
        across = sqrt(axis.x * axis.x + axis.y * axis.y)
        if across > 0.0:
            ca, sa = axis.x / across, axis.y / across
        return Frame(wo, mu, across, axis.z, ca, sa)
    return Frame(wo, mu, si, mu, ca, sa)


def horizon(c, frame):
    """Slopes between which the moving direction stands above the horizon, along an azimuth whose cosine is c."""
    if AXIS == NORMAL:
        return 0.0, np.inf
    a = frame.si * c
    if AXIS == HALF:
        reach = sqrt(frame.co * frame.co + a * a)
        if a < 0.0:
            return 0.0, frame.co / (reach - a)
        return 0.0, (reach + a) / frame.co if frame.co > 0.0 else np.inf
    if frame.co < 0.0:
        return -frame.co / a if a > 0.0 else np.inf, np.inf
    return 0.0, frame.co / -a if a < 0.0 else np.inf


def kinks(c, frame):
    """Slopes at which the integrand has its kinks along an azimuth, in ascending order; 0 where there is none."""
    a = frame.si * c
    mu = frame.mu
    if KINK == V_CAVITY:
        if a <= mu:
            return 0.0, tan((pi - atan2(mu, a)) / 3.0)  # the light is shadowed from here on
        return mu / a, a / mu if mu > 0.0 else np.inf  # the viewer is masked between both, then the light shadowed more
    if AXIS == NORMAL:
        return 0.0, frame.si / mu if mu > 0.0 else 0.0
    if AXIS == LOBE:
        # co + a rho = mu sqrt(1 + rho^2), squared
        discriminant = a * a + (frame.co - mu) * (frame.co + mu)
        if discriminant <= 0.0:
            return 0.0, 0.0
        q = mu * sqrt(discriminant)
        b = -frame.co * a
        leading = (a - mu) * (a + mu)
        big = b - q if b < 0.0 else b + q
        constant = (frame.co - mu) * (frame.co + mu)
        one = big / leading if leading != 0.0 else 0.0
        two = constant / big if big != 0.0 else 0.0
        one = one if one > 0.0 and frame.co + a * one > 0.0 else 0.0
        two = two if two > 0.0 and frame.co + a * two > 0.0 else 0.0
        return min(one, two), max(one, two)
    if a <= 0.0 or mu == 0.0:
        return 0.0, 0.0
    t = a / mu
    if AXIS == HALF:
        return 0.0, t
    return 0.0, 2.0 * t / (1.0 - t * t) if t < 1.0 else 0.0


def integrand(y, p, n, frame, ray):
    """f cos per dy dpsi."""
    rho, measure = slope(y, n)
    rho *= ray.d
    root = 1.0 / sqrt(1.0 + rho * rho)
    jacobian = measure * ray.area * root * root * root
    a = frame.si * ray.c
    wo = frame.wo
    if AXIS == HALF:
        mu = frame.mu
        reach = sqrt(mu * mu + a * a)
        if a < 0.0:
            b = reach - a
            z = (mu / b - rho) * (mu * rho + b)
        else:
            b = reach + a
            z = (b - mu * rho) * (rho + mu / b) if b > 0.0 else 0.0
        z *= root * root
        oh = (a * rho + mu) * root
        k = 2.0 * oh * rho * root
        wi = Direction(k * ray.ux - wo.x, k * ray.uy - wo.y, z)
        jacobian *= 4.0 * oh
    elif AXIS == NORMAL:
        z = root
        wi = Direction(rho * root * ray.ux, rho * root * ray.uy, z)
    else:
        # azimuth 0 turns towards the normal, away from the axis' horizontal part
        z = root * (frame.co + a * rho)
        along = frame.si * root - frame.co * ray.c * rho * root
        across = ray.s * rho * root
        wi = Direction(along * frame.ca - across * frame.sa, along * frame.sa + across * frame.ca, z)
    value = f(p, wi, wo) * z * jacobian
    return value if z > 0.0 else 0.0


def panel(a, b, low, high, lanes, p, n, frame, ray):
    """K31 and |K31 - G15| over x in [a, b], where y = high - (high - low)(1 - x)^2 crowds the points at the horizon's end."""
    middle, half = 0.5 * (a + b), 0.5 * (b - a)
    for i in range(LANES):
        far = 1.0 - (middle + half * NODES[i])
        y = high - (high - low) * far * far
        lanes[i] = integrand(y, p, n, frame, ray) * far
    kronrod = 0.0
    gauss = 0.0
    for i in range(LANES - 1):
        kronrod += KRONROD[i] * lanes[i]
        gauss += GAUSS[i] * lanes[i]
    scale = 2.0 * (high - low) * half
    return kronrod * scale, abs(kronrod - gauss) * scale


def radial(tolerance, work, lanes, p, n, frame, ray):
    """Integral over the slope along one azimuth: value, bound, panels used.

    `work` holds the panels: a, b, low, high, value, error.
    """
    near, far = horizon(ray.c, frame)
    # of a lobe about an axis below the horizon only the far side is seen, and what counts of it ends END beyond its rim
    near = coordinate(near / ray.d, n) if near < FAR else np.inf
    far = min(coordinate(far / ray.d, n), sqrt(END * END + near * near))
    if not near < far:
        return 0.0, 0.0, 0
    count = 0
    if KINK != NONE:
        for rho in kinks(ray.c, frame):
            y = min(max(coordinate(rho / ray.d, n), near), far)
            if near < y < far:
                work[count, 0], work[count, 1], work[count, 2], work[count, 3] = 0.0, 1.0, near, y
                count += 1
                near = y
    work[count, 0], work[count, 1], work[count, 2], work[count, 3] = 0.0, 1.0, near, far
    count += 1
    fresh = 0
    used = 0
    worst = 0
    while True:
        for i in range(fresh, count):
            work[i, 4], work[i, 5] = panel(work[i, 0], work[i, 1], work[i, 2], work[i, 3], lanes, p, n, frame, ray)
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


def azimuth(x, stretch, scale, tolerance, work, lanes, p, frame, symmetric):
    """The radial integrals at one distance from the plane normal to that of psi = 0, on both sides: value, bound, panels."""
    q = scale * sinh(stretch * x)
    dq = scale * stretch * cosh(stretch * x)
    ex, ey = ellipse(p)
    n = exponent(p)
    # azimuths turn in the plane where the ellipse is a circle; there the plane of psi = 0 lies at (c0, s0)
    c0, s0 = ex * frame.ca, ey * frame.sa
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
        ray = Ray(ux, uy, c * width / d, uy * frame.ca - ux * frame.sa, d, ex * ey)
        v, e, u = radial(tolerance / dq, work, lanes, p, n, frame, ray)
        value += v
        error += e
        used += u
    factor = 2.0 * dq if symmetric else dq
    return value * factor, error * factor, used


def outer_panel(a, b, stretch, scale, tolerance, work, lanes, p, frame, symmetric):
    """K31, |K31 - G15|, the inner bounds integrated along, and panels used, over [a, b] of the stretched azimuth."""
    middle, half = 0.5 * (a + b), 0.5 * (b - a)
    kronrod = 0.0
    gauss = 0.0
    inner = 0.0
    used = 0
    for i in range(LANES - 1):
        v, e, u = azimuth(middle + half * NODES[i], stretch, scale, tolerance, work, lanes, p, frame, symmetric)
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
    frame = frame_of(p, mu, phi)
    si, co = frame.si, abs(frame.co)
    scale = max(co / si * (lobe_width(p) if KINK != NONE else 1.0), 1e-12) if si > 0.0 else 1e6
    stretch = asinh(0.5 * pi / scale)
    work = np.empty((INNER_PANELS, 6))
    lanes = np.empty(LANES)
    panels = np.empty((OUTER_PANELS, 5))
    for i in range(PIECES):
        panels[i, 0], panels[i, 1] = i / PIECES, (i + 1.0) / PIECES
    count = PIECES
    entering = KINK == EQUAL_COSINES and (AXIS == MIRROR or AXIS == RETRO) and exponent(p) < NARROW
    if (entering or KINK == V_CAVITY) and mu < si:
        # where the azimuth's cosine is mu / si, equal cosines enter the lobe's hemisphere, or V-cavities begin to mask
        enters = asinh(atan2(mu, sqrt((si - mu) * (si + mu))) / scale) / stretch
        panels[0, 1], panels[1, 0], panels[1, 1] = enters, enters, 1.0
        count = 2
    fresh = 0
    used = 0
    inner_aim = INNER_SHARE * tolerance if relative == 0.0 else np.inf
    while True:
        for i in range(fresh, count):
            panels[i, 2], panels[i, 3], panels[i, 4], u = outer_panel(
                panels[i, 0], panels[i, 1], stretch, scale, inner_aim, work, lanes, p, frame, symmetric
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
        lobe=coordinates.lobe,
        AXIS=int(coordinates.axis),
        END=coordinates.profile.end,
        KINK=int(coordinates.kink),
        PIECES=coordinates.pieces,
    )
