"""Fresnel reflectance of unpolarised light: exact for dielectrics and for conductors, and Schlick's approximation.

`eta` and `k` are the real and the imaginary part of the refractive index relative to the medium of the light; `c` is the cosine
of the angle between the light and the normal of the facet.
"""

from __future__ import annotations

from math import sqrt


def one(c: float) -> float:
    """The perfect reflector."""
    return 1.0


def schlick(F0: float, c: float) -> float:
    """F0 + (1 - F0) (1 - c)^5 (schlick1993 eq. 11, nuaj_models eq. 5); F0 is the reflectance at normal incidence."""
    x = max(1.0 - c, 0.0)
    x2 = x * x
    return F0 + (1.0 - F0) * x2 * x2 * x


def dielectric(eta: float, c: float) -> float:
    """Half the sum of both polarisations, for a real index; 1 beyond the critical angle, which exists for eta < 1."""
    gg = (eta - 1.0) * (eta + 1.0) + c * c
    g = sqrt(max(gg, 0.0))
    s = (c - g) / (c + g)
    e = eta * eta * c
    p = (e - g) / (e + g)
    return 0.5 * (s * s + p * p) if gg > 0.0 else 1.0


def conductor(eta: float, k: float, c: float) -> float:
    """The same for a complex index eta + i k (Born and Wolf, Principles of Optics, section 14.2).

    sqrt((eta + i k)^2 - sin^2) = a + i b; of a^2 and b^2 the smaller is had from their product, eta^2 k^2.
    """
    ss = (1.0 - c) * (1.0 + c)
    real = (eta - 1.0) * (eta + 1.0) + c * c - k * k
    modulus = sqrt(real * real + 4.0 * eta * eta * k * k)
    larger = 0.5 * (modulus + abs(real))
    smaller = eta * eta * k * k / max(larger, 1e-300)
    aa, bb = (larger, smaller) if real > 0.0 else (smaller, larger)
    a = sqrt(aa)
    s = ((c - a) * (c - a) + bb) / ((c + a) * (c + a) + bb)
    difference, sum_ = a * c - ss, a * c + ss
    p_over_s = (difference * difference + bb * c * c) / max(sum_ * sum_ + bb * c * c, 1e-300)
    return 0.5 * s * (1.0 + p_over_s)


def normal_reflectance(eta: float, k: float) -> float:
    """The reflectance at normal incidence."""
    return ((eta - 1.0) * (eta - 1.0) + k * k) / ((eta + 1.0) * (eta + 1.0) + k * k)
