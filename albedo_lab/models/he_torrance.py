"""He-Torrance: physical optics of a rough surface, as a mirror part, a directional-diffuse and a uniform-diffuse part.

sigma0, tau and wavelength are in one unit, whichever it is: only their ratios matter. All corners of the domain are finite.
Where sigma0 is far below the wavelength there is hardly more than the mirror part; where 2 sigma0 / tau is far above 1 the
surface hides itself, S / cos falls like tau / sigma0, and what is left, albedos of 1e-7 and less, means little.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import cache
from math import erfc, inf, pi, sqrt
from typing import Any, NamedTuple

from albedo_lab.model import Choice, EnergyConserving, Model, Parameter, Reciprocal
from albedo_lab.models import lambert
from albedo_lab.optics.coordinates import Axis, Coordinates
from albedo_lab.optics.frame import Direction, bisector, reflect
from albedo_lab.optics.fresnel import conductor
from albedo_lab.optics.lobes import sample_cosine
from albedo_lab.optics.maths import exp, sincos2pi
from albedo_lab.optics.profiles import TANGENT, normal_from_slopes
from albedo_lab.optics.scattering import lambert_w, scattering_orders
from albedo_lab.sources import he1991, neumann1999


class Perfect(NamedTuple):
    sigma0: float
    tau: float
    wavelength: float
    a_d: float


class Conductor(NamedTuple):
    sigma0: float
    tau: float
    wavelength: float
    eta: float
    k: float
    a_d: float


Surface = Conductor | Perfect


def perfect(p: Perfect, c: float) -> float:
    return 1.0


def exact(p: Conductor, c: float) -> float:
    return conductor(p.eta, p.k, c)


FRESNEL: dict[str, tuple[type, Callable[[Any, float], float]]] = {"exact": (Conductor, exact), "one": (Perfect, perfect)}


def slope(p: Surface) -> float:
    """2 sigma0 / tau, sqrt(2) times the RMS slope of the surface: the m of Beckmann's distribution."""
    return 2.0 * p.sigma0 / p.tau


def seen(m: float, z: float, s: float) -> tuple[float, float]:
    """S / cos (eq. 24, 25) and K (eq. 82, 83) for a direction of cosine z and sine s; q = tau cot / (2 sigma0) = cot / m.

    S = (1 - erfc(q)/2) / (1 + Lambda), Lambda = (exp(-q^2) / (sqrt(pi) q) - erfc q) / 2, both multiplied by cos: S / cos is
    finite at grazing angles.
    """
    ms = m * s
    q = z / ms if ms > 0.0 else inf
    shade = erfc(q)
    unshaded = 1.0 - 0.5 * shade
    k = s * shade / max(z, 1e-150)
    return unshaded / (z * unshaded + ms * exp(-q * q) / (2.0 * sqrt(pi))), k


def roughness(p: Surface, k: float) -> float:
    """(2 pi sigma / wavelength)^2 with the effective roughness sigma (eq. 80), that of what is lit and seen.

    sigma = sigma0 / sqrt(1 + y^2), where sqrt(pi/2) y = K/4 exp(-y^2/2) (eq. 81): y^2 exp(y^2) = K^2 / (8 pi), K = K_i + K_r.
    """
    wave = 2.0 * pi * p.sigma0 / p.wavelength
    return wave * wave / (1.0 + lambert_w(k * k / (8.0 * pi)))


def directional(p: Surface, wi: Direction, wo: Direction) -> float:
    """S G D / (pi cos_i cos_r), the directional-diffuse part for |F|^2 = 1 (eq. 76, 78, 79, 84).

    s_r, p_r and k_r are orthonormal, so that (s_r.k_i)^2 + (p_r.k_i)^2 = 1 - (k_r.k_i)^2 = |k_r x k_i|^2, and likewise with i and
    r exchanged: G = (v.v / v_z)^2. The v_z^2 in g takes away that in G.
    """
    v = bisector(wi, wo)
    xy = v.x * v.x + v.y * v.y
    vv = xy + v.z * v.z
    m = slope(p)
    s_i, k_i = seen(m, wi.z, sqrt(wi.x * wi.x + wi.y * wi.y))
    s_r, k_r = seen(m, wo.z, sqrt(wo.x * wo.x + wo.y * wo.y))
    rough = roughness(p, k_i + k_r)
    wave = pi * p.tau / p.wavelength
    ww = wave * wave
    return vv * vv * rough * ww / (4.0 * pi) * s_i * s_r * scattering_orders(rough * v.z * v.z, ww * xy)


def widths(p: Surface) -> tuple[float, float]:
    """Slopes of the half-vector over which the lobe falls off: Beckmann's, or diffraction by bumps as wide as tau."""
    m, diffraction = slope(p), p.wavelength / (2.0 * pi * p.tau)
    w = min(sqrt(m * m + diffraction * diffraction), 1.0)
    return w, w


HALF_VECTORS, AROUND_MIRROR = 0.4, 0.4
"""Shares of the samples: half-vectors suit rough surfaces, directions projected on the surface smooth ones, a cosine the rest."""


def spread(p: Surface, wo: Direction) -> float:
    """Squared radius of the lobe in the plane of the surface: order m has m / (pi tau / wavelength)^2, and m is about 1 + g."""
    wave, rough = pi * p.tau / p.wavelength, 4.0 * pi * p.sigma0 / p.wavelength * wo.z
    return min((1.0 + rough * rough) / (wave * wave), 1.0)


def sample(p: Surface, wo: Direction, u1: float, u2: float) -> Direction:
    if u1 < HALF_VECTORS:
        u = u1 / HALF_VECTORS
        radius, (sp, cp) = widths(p)[0] * sqrt((1.0 - u) / u), sincos2pi(u2)
        return reflect(wo, normal_from_slopes(radius * cp, radius * sp))
    if u1 < HALF_VECTORS + AROUND_MIRROR:
        u = (u1 - HALF_VECTORS) / AROUND_MIRROR
        radius, (sp, cp) = sqrt(spread(p, wo) * (1.0 - u) / max(u, 1e-300)), sincos2pi(u2)
        x, y = radius * cp, radius * sp
        # 1 - |mirror + (x, y)|^2, the mirror direction's 1 - |..|^2 = cos^2 taken out
        zz = wo.z * wo.z + 2.0 * (wo.x * x + wo.y * y) - radius * radius
        return Direction(x - wo.x, y - wo.y, sqrt(zz)) if zz > 0.0 else Direction(0.0, 0.0, -1.0)
    return sample_cosine((u1 - HALF_VECTORS - AROUND_MIRROR) / (1.0 - HALF_VECTORS - AROUND_MIRROR), u2)


def pdf(p: Surface, wi: Direction, wo: Direction) -> float:
    v = bisector(wi, wo)
    xy, zz = v.x * v.x + v.y * v.y, v.z * v.z
    # slopes: 1 / (pi w^2 (1 + slope^2/w^2)^2); normals: that / cos^3, cos = v.z / |v|; reflection: 4 (wo.h) = 2 |v|
    w = widths(p)[0]
    r = w / (w * w * zz + xy)
    # projected: 1 / (pi s (1 + xy/s)^2), and dx dy = cos dw
    s = spread(p, wo)
    t = s + xy
    return (
        HALF_VECTORS * r * r * v.z * (xy + zz) / (2.0 * pi)
        + (AROUND_MIRROR * s / (t * t) + (1.0 - HALF_VECTORS - AROUND_MIRROR)) * wi.z / pi
    )


CHOICES = (
    Choice(
        "fresnel",
        "reflectance of the material: exact for a complex index, or one",
        ("exact", "one"),
        "exact",
    ),
)
LENGTHS = (
    Parameter("sigma0", "RMS height of the surface, in the unit of tau and wavelength", 0.1, 1e-4, 100.0, "log"),
    Parameter("tau", "autocorrelation length of the heights, in the unit of sigma0 and wavelength", 1.7, 1e-2, 1e3, "log"),
    Parameter("wavelength", "wavelength of the light, in the unit of sigma0 and tau", 0.5, 0.05, 100.0, "log"),
)
INDEX = (
    # about aluminium at 500 nm, see optics.metals
    Parameter("eta", "real part of the refractive index", 0.63, 0.01, 10.0, "log"),
    Parameter("k", "imaginary part of the refractive index", 5.32, 0.0, 20.0),
)
UNIFORM = (Parameter("a_d", "albedo of the uniform-diffuse part", 0.0, 0.0, 1.0),)


@cache
def make(*, fresnel: str) -> Model:
    parameters_type, reflectance = FRESNEL[fresnel]

    def lobe(p: Surface, wi: Direction, wo: Direction) -> float:
        v = bisector(wi, wo)
        return reflectance(p, 0.5 * sqrt(v.x * v.x + v.y * v.y + v.z * v.z)) * directional(p, wi, wo)

    def evaluate(p: Surface, wi: Direction, wo: Direction) -> float:
        return lobe(p, wi, wo) + p.a_d / pi

    def mirror(p: Surface, mu: float) -> float:
        s, k = seen(slope(p), mu, sqrt((1.0 - mu) * (1.0 + mu)))
        s *= mu
        return reflectance(p, mu) * exp(-roughness(p, 2.0 * k) * 4.0 * mu * mu) * s * s

    model = Model(
        "he_torrance",
        "|F|^2 e^-g S Dirac + |F|^2 G S D / (pi N.L N.V) + a_d / pi",
        parameters_type,
        LENGTHS + (INDEX if fresnel == "exact" else ()) + UNIFORM,
        evaluate,
        sample=sample,
        pdf=pdf,
        mirror=mirror,
        scale=lambda p: 1.0,
        smooth_in=Coordinates(Axis.HALF, TANGENT, ellipse=widths),
        source=he1991(
            "eq. 24, 25, 76 to 84",
            "the mirror part is a reflectance, in place of 1 / (cos dw) within the solid angle of the light",
            "unpolarised light, F at half the angle between the directions",
            "eq. 25 with the factor exp(-q^2), as Smith (1967) has it",
            "v is made of unit vectors in eq. 76 and of 2 pi / wavelength times these in eq. 78: so its terms add up to 1 - e^-g",
            "the uniform-diffuse part is a_d / pi, with a_d in place of the measured a(wavelength)",
        ),
        also=(neumann1999("fig. 5, table 1", "the figure takes |F|^2 = 1, here fresnel = one, and states no wavelength"),),
        claims=(Reciprocal("neumann1999 table 1"), EnergyConserving("neumann1999 table 1", where="a_d = 0")),
        choices=CHOICES,
        make=make,
        chosen={"fresnel": fresnel},
    )
    alone = replace(model, evaluate=lobe, parts=None)

    def parts(p: Surface) -> tuple[tuple[Model, Any], ...]:
        if p.a_d == 0.0:
            return ((alone, p),)
        return (alone, p), (lambert.MODEL, lambert.Lambert(p.a_d))

    return replace(model, parts=parts)


MODEL = make(fresnel="exact")
