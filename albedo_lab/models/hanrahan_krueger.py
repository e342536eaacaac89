"""Hanrahan-Krueger: light that enters a layer by a smooth surface, is scattered once in it, and leaves again."""

from __future__ import annotations

from math import pi, sqrt
from typing import NamedTuple

from albedo_lab.model import Model, Parameter
from albedo_lab.optics.coordinates import PLAIN
from albedo_lab.optics.frame import Direction
from albedo_lab.optics.fresnel import dielectric
from albedo_lab.optics.lobes import limb_pdf, sample_limb
from albedo_lab.optics.maths import expm1
from albedo_lab.optics.phase import folded_pdf, henyey_greenstein, sample_folded
from albedo_lab.sources import hanrahan_krueger1993, henyey_greenstein1941


class HanrahanKrueger(NamedTuple):
    w: float
    g: float
    tau: float
    eta: float


def refracted(eta: float, z: float) -> float:
    """Cosine inside, for the cosine z outside."""
    return sqrt((eta - 1.0) * (eta + 1.0) + z * z) / eta


def evaluate(p: HanrahanKrueger, wi: Direction, wo: Direction) -> float:
    zi, zo = refracted(p.eta, wi.z), refracted(p.eta, wo.z)
    both = zi + zo
    x, y = (wi.x + wo.x) / p.eta, (wi.y + wo.y) / p.eta
    # light travels along -wi, then along wo: their distance squared, inside, is |wi + wo|^2
    P = henyey_greenstein(p.g, x * x + y * y + both * both) / (4.0 * pi)
    transmitted = (1.0 - dielectric(p.eta, wi.z)) * (1.0 - dielectric(p.eta, wo.z)) / (p.eta * p.eta)
    # W T12 T21 p / (cos + cos'), T12 = n^2 T and T21 = T / n^2 of radiance, and the solid angle shrinks by n^2 cos / cos'
    return -p.w * transmitted * P / both * expm1(-p.tau * both / (zi * zo))


def mirror(p: HanrahanKrueger, mu: float) -> float:
    return dielectric(p.eta, mu)


# Half of the samples follow the limb, half the phase function as it is without refraction


def axis(p: HanrahanKrueger, wo: Direction) -> Direction:
    """The lobe's axis: backwards, or forwards and mirrored up."""
    back = p.g < 0.0
    return Direction(wo.x if back else -wo.x, wo.y if back else -wo.y, wo.z)


def sample(p: HanrahanKrueger, wo: Direction, u1: float, u2: float) -> Direction:
    if u1 < 0.5:
        return sample_limb(wo.z, 2.0 * u1, u2)
    return sample_folded(axis(p, wo), abs(p.g), 2.0 * u1 - 1.0, u2)


def pdf(p: HanrahanKrueger, wi: Direction, wo: Direction) -> float:
    return 0.5 * limb_pdf(wo.z, wi) + 0.5 * folded_pdf(axis(p, wo), abs(p.g), wi)


MODEL = Model(
    "hanrahan_krueger",
    "W T12 T21 p(g) / (cos_i + cos_r) (1 - exp(-tau (1 / cos_i + 1 / cos_r))), the angles inside, and the mirror's R",
    HanrahanKrueger,
    (
        Parameter("w", "single-scattering albedo W of the layer", default=0.9, low=0.0, high=1.0),
        Parameter("g", "mean cosine of the phase function: below 0 light is scattered back", default=-0.3, low=-0.95, high=0.95),
        Parameter("tau", "optical depth of the layer; from 20 on it is a half-space", default=1000.0, low=0.0, high=1000.0),
        Parameter("eta", "refractive index of the layer; 1: no surface", default=1.5, low=1.0, high=10.0),
    ),
    evaluate,
    sample=sample,
    pdf=pdf,
    mirror=mirror,
    scale=lambda p: 1.0,
    smooth_in=PLAIN,
    source=hanrahan_krueger1993(
        "the first-order solution of the volume, and the reflection of a smooth surface",
        "as a BRDF: over the irradiance outside, so that the powers of n of both transmissions leave 1 / n^2",
        "no layer below, no internal reflection of what comes out",
    ),
    also=(henyey_greenstein1941("eq. 2"),),
)
