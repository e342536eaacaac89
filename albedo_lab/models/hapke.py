"""Hapke: regolith, whose grains scatter once with an opposition surge, and any more times as if isotropically (IMSA)."""

from __future__ import annotations

from functools import cache
from math import pi, sqrt
from typing import NamedTuple

from albedo_lab.model import Choice, Model, Parameter
from albedo_lab.optics.coordinates import PLAIN
from albedo_lab.optics.frame import Direction, bisector, dot, mirror_of
from albedo_lab.optics.lobes import limb_pdf, sample_limb
from albedo_lab.optics.maths import log1p
from albedo_lab.optics.phase import chord, folded_pdf, henyey_greenstein, sample_folded
from albedo_lab.sources import hapke1981, hapke2002, henyey_greenstein1941


class Hapke(NamedTuple):
    w: float
    b: float
    c: float
    B0: float
    h: float


def H_1981(w: float, x: float) -> float:
    """Chandrasekhar's H, to 4 %."""
    return (1.0 + 2.0 * x) / (1.0 + 2.0 * x * sqrt(1.0 - w))


def H_2002(w: float, x: float) -> float:
    """Chandrasekhar's H, to 1 %."""
    gamma = sqrt(1.0 - w)
    r0 = (1.0 - gamma) / (1.0 + gamma)
    return 1.0 / (1.0 - w * x * (r0 + (0.5 - r0 * x) * log1p(1.0 / x)))


def phase(p: Hapke, towards: float, away: float) -> float:
    """(1 + B) P from the squared lengths of L - V, which is 0 at opposition, and of L + V: tan(g / 2) is their ratio's root."""
    P = 0.5 * (1.0 + p.c) * henyey_greenstein(p.b, towards) + 0.5 * (1.0 - p.c) * henyey_greenstein(p.b, away)
    near = p.h * sqrt(away)
    return P * (1.0 + p.B0 * near / (near + sqrt(towards)))


def once(p: Hapke, wi: Direction, wo: Direction) -> float:
    """(1 + B) P."""
    v = bisector(wi, wo)
    return phase(p, chord(wi, wo), dot(v, v))


def evaluate_1981(p: Hapke, wi: Direction, wo: Direction) -> float:
    more = H_1981(p.w, wi.z) * H_1981(p.w, wo.z) - 1.0
    return p.w / (4.0 * pi) / (wi.z + wo.z) * (once(p, wi, wo) + more)


def evaluate_2002(p: Hapke, wi: Direction, wo: Direction) -> float:
    more = H_2002(p.w, wi.z) * H_2002(p.w, wo.z) - 1.0
    return p.w / (4.0 * pi) / (wi.z + wo.z) * (once(p, wi, wo) + more)


# Half of the samples follow the limb, half the lobes of the grains, those that these throw below the surface mirrored up


def sample(p: Hapke, wo: Direction, u1: float, u2: float) -> Direction:
    if u1 < 0.5:
        return sample_limb(wo.z, 2.0 * u1, u2)
    u, back = 2.0 * u1 - 1.0, 0.5 * (1.0 + p.c)
    if u < back:
        return sample_folded(wo, p.b, u / back, u2)
    return sample_folded(mirror_of(wo), p.b, (u - back) / (1.0 - back), u2)


def pdf(p: Hapke, wi: Direction, wo: Direction) -> float:
    back = 0.5 * (1.0 + p.c)
    grains = back * folded_pdf(wo, p.b, wi) + (1.0 - back) * folded_pdf(mirror_of(wo), p.b, wi)
    return 0.5 * limb_pdf(wo.z, wi) + 0.5 * grains


PARAMETERS = (
    Parameter("w", "single-scattering albedo", default=0.5, low=0.0, high=1.0),
    Parameter("b", "width of the grains' two lobes: the mean cosine of each", default=0.3, low=0.0, high=0.95),
    Parameter("c", "1: all of the backward lobe, -1: all of the forward lobe", default=0.0, low=-1.0, high=1.0),
    Parameter("B0", "height of the opposition surge", default=1.0, low=0.0, high=1.0),
    Parameter("h", "width of the opposition surge", default=0.06, low=1e-3, high=10.0, scale="log"),
)
PHASE = "P: both lobes of Henyey and Greenstein, of weights (1 + c) / 2 and (1 - c) / 2; no macroscopic roughness, no porosity"
SURGE = "B = B0 / (1 + tan(g / 2) / h) as of 1986; 1981 has it with another function of g"
FORMS = {
    "hapke1981": (
        evaluate_1981,
        "H = (1 + 2 x) / (1 + 2 x gamma)",
        hapke1981("the bidirectional reflectance and its H", PHASE, SURGE),
    ),
    "hapke2002": (
        evaluate_2002,
        "H = 1 / (1 - w x (r0 + (1 - 2 r0 x) / 2 log((1 + x) / x)))",
        hapke2002("the better H, in the model of 1981", PHASE, SURGE, "isotropic multiple scattering, no coherent backscatter"),
    ),
}
CHOICES = (Choice("H", "which of his approximations of Chandrasekhar's function", tuple(FORMS), "hapke2002"),)


@cache
def make(*, H: str = "hapke2002") -> Model:
    """The model with one approximation of H."""
    evaluate, formula, source = FORMS[H]
    return Model(
        "hapke",
        f"w / (4 pi) / (N.L + N.V) ((1 + B(g)) P(g) + H(N.L) H(N.V) - 1), {formula}",
        Hapke,
        PARAMETERS,
        evaluate,
        sample=sample,
        pdf=pdf,
        scale=lambda p: 1.0,
        smooth_in=PLAIN,  # the surge has its cusp where azimuths and cosines are equal: at a corner of the pieces
        source=source,
        also=(henyey_greenstein1941("eq. 2"),),
        choices=CHOICES,
        make=make,
        chosen={"H": H},
    )


MODEL = make(H="hapke2002")
