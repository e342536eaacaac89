"""Reflection at microfacets: f = F D G / (4 v v'), and samples of the facets that the viewer sees.

v and v' are the cosines of wo and wi, t that of the half-vector h, u that of the angle between h and either; |wi + wo| = 2 u.
Reflection at h turns wo into wi with the Jacobian 4 u. Three ways to draw h:

    D cos           every facet, seen or not:           density of wi   D t / (4 u)
    Smith           those that Smith's G1 leaves:                       D G1(wo) / (4 v)        ggx, beckmann
    V-cavities      those that the opposite side leaves:                D min(1, 2 t v/u) / (4 v)
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from math import atan2, erfc, pi, sqrt
from typing import Any

from albedo_lab.optics.frame import Direction, bisector, dot, length, reflect
from albedo_lab.optics.masking import cot, schlick_factor, stretched, v_cavity_factor, v_cavity_seen
from albedo_lab.optics.maths import exp, log, pow, sincos2pi
from albedo_lab.optics.profiles import normal_from_slopes

Sample = Callable[[Any, Direction, float, float], Direction]
Pdf = Callable[[Any, Direction, Direction], float]


def forward(wo: Direction) -> tuple[float, float]:
    """The unit vector along the horizontal part of wo."""
    s = sqrt(wo.x * wo.x + wo.y * wo.y)
    return (wo.x / s, wo.y / s) if s > 0.0 else (1.0, 0.0)


def normal_about(wo: Direction, along: float, across: float) -> Direction:
    """The normal with these slopes along and across the plane of incidence."""
    c, s = forward(wo)
    return normal_from_slopes(c * along - s * across, s * along + c * across)


# Visible normals, Smith


def ggx_visible(alpha: float, wo: Direction, u1: float, u2: float) -> Direction:
    """Visible normals of ggx: seen from the stretched direction they are wo plus a uniform point of a spherical cap.

    Dupuy and Benyoub, Sampling Visible GGX Normals with Spherical Caps, 2023. The height of the sum is u1 (1 + z).
    """
    x, y = alpha * wo.x, alpha * wo.y
    unit = 1.0 / sqrt(x * x + y * y + wo.z * wo.z)
    x, y, z = x * unit, y * unit, wo.z * unit
    height = u1 * (1.0 + z)
    radius = sqrt((1.0 - u1) * (height * (1.0 + z) + x * x + y * y))
    s, c = sincos2pi(u2)
    x, y = alpha * (x + radius * c), alpha * (y + radius * s)
    unit = 1.0 / sqrt(x * x + y * y + height * height)
    return Direction(x * unit, y * unit, height * unit)


def ggx_visible_by_disk(alpha: float, wo: Direction, u1: float, u2: float) -> Direction:
    """The same normals from the disk into which the half sphere of those that face the stretched direction projects.

    Heitz, Sampling the GGX Distribution of Visible Normals, 2018. Half of the disk is what lies above the horizon; across it
    the other half shrinks by the stretched direction's cosine. u1 is the square of the radius.
    """
    x, y = alpha * wo.x, alpha * wo.y
    xy = x * x + y * y
    unit = 1.0 / sqrt(xy + wo.z * wo.z)
    z, sine = wo.z * unit, sqrt(xy) * unit
    c, s = forward(wo)
    sp, cp = sincos2pi(u2)
    radius = sqrt(u1)
    across, up = radius * cp, radius * sp
    seen = 1.0 - across * across
    # 1 - z without cancellation; then what is left along the direction, with up^2 <= seen
    share = 0.5 * sine * sine / (1.0 + z)
    up = share * sqrt(seen) + (1.0 - share) * up
    along = sqrt(max(seen - up * up, 0.0))
    # the plane of incidence: wo itself is (sine, z) in it, what stands across it upwards (-z, sine)
    front, height = along * sine - up * z, max(along * z + up * sine, 0.0)
    x, y = alpha * (c * front - s * across), alpha * (s * front + c * across)
    unit = 1.0 / sqrt(x * x + y * y + height * height)
    return Direction(x * unit, y * unit, height * unit)


NEWTON = 8


def visible_gaussian(a: float, u: float) -> float:
    """The x of survival u when its density goes like (a + x)^+ exp(-x^2); a >= 0.

    Newton on the logarithm of the smaller tail, a erfc(y) + s exp(-y^2) / sqrt(pi) - c with y = s x; it is concave, and 8 steps
    from the guess below leave 2e-14 of the probability (tests/optics/test_microfacet.py).
    """
    s, tail = (1.0, u) if u < 0.5 else (-1.0, 1.0 - u)
    root_pi = sqrt(pi)
    at_end = exp(-a * a) / root_pi
    c = 0.0 if s > 0.0 else a * erfc(a) - at_end
    target = tail * (a * erfc(-a) + at_end)
    # the guess: between a = 0 (Rayleigh) and a = inf (Gauss, Winitzki's inverse of erf)
    rayleigh = sqrt(-log(u))
    log_4uv = log(4.0 * u * (1.0 - u))
    h = 2.0 / (0.147 * pi) + 0.5 * log_4uv
    gauss = s * sqrt(max(sqrt(h * h - log_4uv / 0.147) - h, 0.0))
    mix = 1.0 / (1.0 + 0.3 * a * (1.0 + a))
    y = s * max(mix * rayleigh + (1.0 - mix) * gauss, 0.25 * rayleigh - a)
    for _ in range(NEWTON):
        e = exp(-y * y) / root_pi
        r = a + s * y
        f = max(a * erfc(y) + s * e - c, 1e-300)
        y += f * log(f / target) / (2.0 * r * e)
        if s < 0.0:
            y = min(y, a - 0.25 * r)
    return s * y


def beckmann_visible(m: float, wo: Direction, u1: float, u2: float) -> Direction:
    """Visible normals of beckmann: of Gaussian slopes, the one along wo weighs as the facet's projected area."""
    along = visible_gaussian(min(cot(wo) / m, 1e30), u1)
    across = visible_gaussian(1e30, u2)
    return normal_about(wo, m * along, m * across)


def elliptic_visible(
    visible: Callable[..., Direction], alpha_x: float, alpha_y: float, wo: Direction, u1: float, u2: float
) -> Direction:
    """Visible normals of a surface of both widths: those of width 1 seen from the stretched direction, stretched back.

    `visible` takes a width and a direction, which need not be normalised (Heitz 2014).
    """
    h = stretched(alpha_x, alpha_y, visible(1.0, stretched(alpha_x, alpha_y, wo), u1, u2))
    unit = 1.0 / length(h)
    return Direction(h.x * unit, h.y * unit, h.z * unit)


# Visible normals, V-cavities


KEPLER = 8


def v_cavity_azimuth(tau: float, u: float) -> tuple[float, float]:
    """Sine and cosine of the azimuth from wo at which a V-cavity's facet of slope tau cot(theta_o) is seen.

    Of two facets that mirror each other, each is seen in proportion to its projected area, one that faces away not at all. Per
    half turn the density of phi is (1 + tau cos phi) / pi where |tau cos phi| < 1, else 2 / pi in front and 0 behind. With e the
    angle from where it begins not to be 0, u the share of the half turn up to there, this is Kepler's equation

        (1 - tau) e + tau (e - sin e) + k (1 - cos e) = pi u

    with k = 0, or for tau > 1 with tau = 1 and k = sqrt(tau^2 - 1). It is convex, so that Newton's method comes down from
    a bound without a safeguard; 8 steps leave 1e-15 of the probability (tests/optics/test_microfacet.py).
    """
    share = 2.0 * min(u, 1.0 - u)
    t = min(tau, 1.0)
    k = sqrt(max((tau - 1.0) * (tau + 1.0), 0.0))
    end = 2.0 * atan2(1.0, k)
    m = pi * min(share, end / pi)
    # e - sin e >= e^3 / pi^2 and 1 - cos e >= 2 e^2 / pi^2
    e = min(end, m / max(1.0 - t, 1e-300), pow(pi * pi * m / max(t, 1e-300), 1.0 / 3.0), pi * sqrt(m / max(2.0 * k, 1e-300)))
    for _ in range(KEPLER):
        s, c = sincos2pi(e / (4.0 * pi))
        sine, versine = 2.0 * s * c, 2.0 * s * s
        f = (1.0 - t) * e + t * (e - sine) + k * versine - m
        e = max(e - f / max(1.0 - t + t * versine + k * sine, 1e-300), 0.25 * e)
    seen = 0.5 * (pi - end) + e if pi * share < end else 0.5 * pi * (1.0 + share)
    s, c = sincos2pi(seen / (2.0 * pi))
    return (s if u < 0.5 else -s), -c


def v_cavity_visible(slope: float, wo: Direction, u2: float) -> Direction:
    """The normal of that slope, at the azimuth at which it is seen."""
    s, c = v_cavity_azimuth(slope / cot(wo), u2)
    return normal_about(wo, slope * c, slope * s)


# The model: a distribution of normals, a factor G, a factor F


@dataclass(frozen=True)
class Normals:
    """What a distribution of normals is made of, for parameters p.

    density(p, v) is D for the bisector; slope(p, u) the slope of survival u; smith(p, w) is Lambda; width(p) that of
    Schlick's G; visible(p, wo, u1, u2) draws what Smith's G1 leaves, where that is known.
    """

    density: Callable[[Any, Direction], float]
    slope: Callable[[Any, float], float]
    smith: Callable[[Any, Direction], float]
    width: Callable[[Any], float]
    visible: Callable[[Any, Direction, float, float], Direction] | None = None


def none(normals: Normals) -> Callable[..., float]:
    """G = 1."""
    return lambda p, v, wi, wo: 1.0


def v_cavity(normals: Normals) -> Callable[..., float]:
    """Torrance and Sparrow's, whatever the normals."""
    return lambda p, v, wi, wo: v_cavity_factor(v, wi, wo)


def smith(normals: Normals) -> Callable[..., float]:
    """Both directions hidden independently."""
    hidden = normals.smith
    return lambda p, v, wi, wo: 1.0 / ((1.0 + hidden(p, wi)) * (1.0 + hidden(p, wo)))


def smith_correlated(normals: Normals) -> Callable[..., float]:
    """Both hidden by the same height of the facet."""
    hidden = normals.smith
    return lambda p, v, wi, wo: 1.0 / (1.0 + hidden(p, wi) + hidden(p, wo))


def schlick(normals: Normals) -> Callable[..., float]:
    """Schlick's fit for each direction."""
    width, factor = normals.width, sqrt(2.0 / pi)
    return lambda p, v, wi, wo: schlick_factor(factor * width(p), wi) * schlick_factor(factor * width(p), wo)


GEOMETRIES = {"none": none, "v_cavity": v_cavity, "smith": smith, "smith_correlated": smith_correlated, "schlick": schlick}


def reflection(
    normals: Normals, G: Callable[..., float], F: Callable[..., float]
) -> Callable[[Any, Direction, Direction], float]:
    """F(p, u) D G(p, v, wi, wo) / (4 v v')."""
    D = normals.density

    def evaluate(p: Any, wi: Direction, wo: Direction) -> float:
        v = bisector(wi, wo)
        return F(p, 0.5 * length(v)) * D(p, v) * G(p, v, wi, wo) / (4.0 * wi.z * wo.z)

    return evaluate


def sampling(normals: Normals, geometry: str) -> tuple[Sample, Pdf]:
    """Samples of wi, and their density: of the facets seen, where these are known for the geometry, else of all."""
    if geometry in ("smith", "smith_correlated") and normals.visible is not None:
        return smith_sampling(normals, normals.visible)
    return v_cavity_sampling(normals) if geometry == "v_cavity" else plain_sampling(normals)


def smith_sampling(normals: Normals, visible: Callable[..., Direction]) -> tuple[Sample, Pdf]:
    """The facets that Smith's G1 leaves."""
    D, hidden = normals.density, normals.smith

    def sample(p: Any, wo: Direction, u1: float, u2: float) -> Direction:
        return reflect(wo, visible(p, wo, u1, u2))

    def pdf(p: Any, wi: Direction, wo: Direction) -> float:
        return D(p, bisector(wi, wo)) / (4.0 * wo.z * (1.0 + hidden(p, wo)))

    return sample, pdf


def smith_weight(normals: Normals, G: Callable[..., float], F: Callable[..., float], sample: Sample) -> Callable[..., float]:
    """f cos / pdf of these samples, F G / G1(wo): D, both cosines and 4 cancelled."""
    hidden = normals.smith

    def weight(p: Any, wo: Direction, u1: float, u2: float) -> float:
        wi = sample(p, wo, u1, u2)
        v = bisector(wi, wo)
        return F(p, 0.5 * length(v)) * G(p, v, wi, wo) * (1.0 + hidden(p, wo)) if wi.z > 0.0 else 0.0

    return weight


def v_cavity_sampling(normals: Normals) -> tuple[Sample, Pdf]:
    """The facets that the opposite side of their cavity leaves (Heitz and d'Eon 2014, without their third random number)."""
    D, slope = normals.density, normals.slope

    def sample(p: Any, wo: Direction, u1: float, u2: float) -> Direction:
        return reflect(wo, v_cavity_visible(slope(p, u1), wo, u2))

    def pdf(p: Any, wi: Direction, wo: Direction) -> float:
        v = bisector(wi, wo)
        return 0.25 * D(p, v) * v_cavity_seen(v, wo)

    return sample, pdf


def plain_sampling(normals: Normals) -> tuple[Sample, Pdf]:
    """Every facet."""
    D, slope = normals.density, normals.slope

    def sample(p: Any, wo: Direction, u1: float, u2: float) -> Direction:
        x, (s, c) = slope(p, u1), sincos2pi(u2)
        return reflect(wo, normal_from_slopes(x * c, x * s))

    def pdf(p: Any, wi: Direction, wo: Direction) -> float:
        v = bisector(wi, wo)
        return 0.5 * D(p, v) * v.z / dot(v, v)

    return sample, pdf
