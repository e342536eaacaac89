"""GGX that gives back the light which its facets reflect more than once: the lobe of Kulla and Conty, or the factor of Turquin.

Both need the albedo E of the same facets for F = 1, which has no closed form. What it lacks of 1 is tabulated instead, so that it
keeps its digits where it is small, over s = (1 + alpha) sigma / (1 + sigma), sigma = mu / alpha, in a form that has its limits:

    1 - E = (1 + mu^2) / (1 + sigma^2) P(s)                                                       independent masking
    1 - E = (1 + mu^2) / (1 + sigma^2) (alpha^2 sigma log(1 + 1/sigma) + sigma / (1 + sigma) P(s))  correlated masking

For mu far above alpha 1 - E = alpha^2 (1 + 1/mu^2) / 2. Towards mu = 0 it goes to a limit with independent masking. With
correlated masking it vanishes like mu log(1/mu): light at cosine z is masked by alpha mu / z more than mu alone tells, and all
half-vectors of two grazing directions have D = alpha^2 / pi. For alpha = 1 P is 0 and 1 - E is mu log(1 + 1/mu). P is a
polynomial through Chebyshev's nodes; it leaves less than 5e-8 of E for any alpha (tests/models/test_ggx_multiscatter.py).
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import cache, lru_cache
from math import asinh, cosh, pi, sinh, sqrt
from typing import Any, NamedTuple

import numpy as np

from albedo_lab.model import Choice, Claim, EnergyConserving, GrazingAlbedo, Model, Parameter, Reciprocal
from albedo_lab.models import ggx
from albedo_lab.models.microfacet import DISTRIBUTIONS, FRESNEL
from albedo_lab.optics.compensation import colour, kulla_conty, schlick_mean, turquin
from albedo_lab.optics.coordinates import Axis, Coordinates
from albedo_lab.optics.frame import Direction
from albedo_lab.optics.maths import expm1, log1p, sincos2pi
from albedo_lab.optics.microfacet import GEOMETRIES, reflection, smith_sampling, smith_weight
from albedo_lab.optics.profiles import TAIL, TANGENT
from albedo_lab.sources import kulla2017, turquin2019, walter2007
from albedo_lab.tables import Table, table


class Compensated(NamedTuple):
    alpha: float
    F0: float
    colour: float
    """Of the lobe: see optics.compensation."""
    lost_mean: float
    P: Table
    """Chebyshev coefficients of P over 2 s - 1."""


Lost = Callable[[Any, float], float]
NODES = 32
TOLERANCE = 1e-9
"""Of each albedo at a node."""


def P(p: Compensated, sigma: float) -> float:
    """Clenshaw's sum."""
    x = 2.0 * (1.0 + p.alpha) * sigma / (1.0 + sigma) - 1.0
    a, b = 0.0, 0.0
    for k in range(NODES - 1, 0, -1):
        a, b = 2.0 * x * a - b + p.P[k], a
    total: float = x * a - b + p.P[0]
    return total


def terms(alpha: float, mu: float, correlated: bool) -> tuple[float, float]:
    """What stands beside P in 1 - E, and the factor of P."""
    sigma = mu / alpha
    front = (1.0 + mu * mu) / (1.0 + sigma * sigma)
    if not correlated:
        return 0.0, front
    return front * alpha * alpha * sigma * log1p(1.0 / sigma), front * sigma / (1.0 + sigma)


def lost_independent(p: Compensated, mu: float) -> float:
    """1 - E."""
    return terms(p.alpha, mu, False)[1] * P(p, mu / p.alpha)


def lost_correlated(p: Compensated, mu: float) -> float:
    """1 - E."""
    known, factor = terms(p.alpha, mu, True)
    return known + factor * P(p, mu / p.alpha)


LOST: dict[str, Lost] = {"smith": lost_independent, "smith_correlated": lost_correlated}


@lru_cache(maxsize=1024)
def coefficients(alpha: float, G: str) -> Table:
    """P from albedos at Chebyshev's nodes, by quadrature."""
    from albedo_lab.estimate.quadrature import quadrature
    from albedo_lab.estimate.record import Question, Tolerance

    white, p = ggx.make(G=G, F="one", sampling="caps"), ggx.GGX(alpha, alpha)
    angles = pi * (np.arange(NODES) + 0.5) / NODES
    values = []
    for s in np.sin(0.5 * angles) ** 2:
        mu = float(alpha * s / (1.0 + alpha - s))
        known, factor = terms(alpha, mu, G == "smith_correlated")
        values.append((1.0 - quadrature(Question(white, p, mu), Tolerance(TOLERANCE)).value - known) / factor)
    # the nodes run from s = 0 up: over 2 s - 1 = -cos(angle)
    found = np.cos(np.outer(np.arange(NODES), pi - angles)) @ np.array(values) * (2.0 / NODES)
    found[0] *= 0.5
    return table(found)


GAUSS_X, GAUSS_W = np.polynomial.legendre.leggauss(128)


@lru_cache(maxsize=1024)
def mean_of_lost(alpha: float, G: str) -> float:
    """2 int (1 - E) mu dmu of the tabulated E, so that the lobe returns all that is lost: over asinh(mu / alpha)."""
    p, end = Compensated(alpha, 1.0, 1.0, 1.0, coefficients(alpha, G)), asinh(1.0 / alpha)
    total = 0.0
    for x, w in zip(GAUSS_X.tolist(), GAUSS_W.tolist(), strict=True):
        t = 0.5 * end * (1.0 + x)
        mu = min(alpha * sinh(t), 1.0)
        total += w * LOST[G](p, mu) * mu * cosh(t)
    return end * alpha * total


def completion(G: str, F: str) -> Callable[[Mapping[str, float]], Compensated]:
    """The parameters with the table of the albedo and its mean."""

    def complete(numbers: Mapping[str, float]) -> Compensated:
        alpha, F0 = numbers["alpha"], numbers.get("F0", 1.0)
        mean = mean_of_lost(alpha, G)
        share = colour(schlick_mean(F0), mean) if F == "schlick" else 1.0
        return Compensated(alpha, F0, share, mean, coefficients(alpha, G))

    return complete


# Directions of the lobe: 1 - E goes like 1 / (mu^2 + alpha^2), and so does what is drawn over the cosine's density


def sample_lobe(p: Compensated, u1: float, u2: float) -> Direction:
    z = min(p.alpha * sqrt(expm1(u1 * log1p(1.0 / (p.alpha * p.alpha)))), 1.0)
    s, (sp, cp) = sqrt((1.0 - z) * (1.0 + z)), sincos2pi(u2)
    return Direction(s * cp, s * sp, z)


def lobe_pdf(p: Compensated, wi: Direction) -> float:
    aa = p.alpha * p.alpha
    return wi.z / (pi * (wi.z * wi.z + aa) * log1p(1.0 / aa))


def widths(p: Compensated) -> tuple[float, float]:
    return p.alpha, p.alpha


NORMALS = DISTRIBUTIONS["ggx"].normals
FACETS = Coordinates(Axis.HALF, TAIL, ellipse=widths)
ALPHA = Parameter("alpha", "roughness", 0.3, 1e-4, 1.0, scale="log")
FORMS = {
    "kulla_conty": "F G D / (4 N.L N.V) + F_ms (1 - E(N.L)) (1 - E(N.V)) / (pi (1 - E_mean))",
    "turquin": "F G D / (4 N.L N.V) (1 + F0 (1 - E(N.V)) / E(N.V))",
}
TABLE = "E is that of this very alpha, by quadrature, and read from a table with an error below 5e-8"
CHOICES = (
    Choice("form", "how light is given back: by a lobe of its own, or by a factor of the facets'", tuple(FORMS), "kulla_conty"),
    Choice("F", "reflectance of the facets: 1, or Schlick's", ("one", "schlick"), "one"),
    ggx.MASKING,
)


@cache
def make(*, form: str, F: str, G: str) -> Model:
    """One form of compensation, one reflectance, one masking."""
    masking, (reflectance, indices) = GEOMETRIES[G](NORMALS), FRESNEL[F]
    facets, lost = reflection(NORMALS, masking, reflectance), LOST[G]
    assert NORMALS.visible is not None
    see, seen = smith_sampling(NORMALS, NORMALS.visible)
    common: dict[str, Any] = {
        "scale": lambda p: 1.0,
        "complete": completion(G, F),
        "smooth_in": FACETS,
        "mirror_limit": ("alpha", reflectance),
        "also": (walter2007("eq. 20, 33, 34"),),
        "choices": CHOICES,
        "make": make,
        "chosen": {"form": form, "F": F, "G": G},
    }
    if form == "turquin":
        plain = smith_weight(NORMALS, masking, reflectance, see)

        def scaled(p: Compensated, wi: Direction, wo: Direction) -> float:
            return facets(p, wi, wo) * turquin(p.F0, lost(p, wo.z))

        def weight(p: Compensated, wo: Direction, u1: float, u2: float) -> float:
            return plain(p, wo, u1, u2) * turquin(p.F0, lost(p, wo.z))

        return Model(
            "ggx_multiscatter",
            FORMS[form],
            Compensated,
            (ALPHA, *indices),
            scaled,
            sample=see,
            pdf=seen,
            weight=weight,
            reciprocal=False,
            source=turquin2019("the factor of a single-scattering lobe", TABLE),
            **common,
        )

    def lobe(p: Compensated, wi: Direction, wo: Direction) -> float:
        return p.colour * kulla_conty(lost(p, wi.z), lost(p, wo.z), p.lost_mean)

    def evaluate(p: Compensated, wi: Direction, wo: Direction) -> float:
        return facets(p, wi, wo) + lobe(p, wi, wo)

    def sample(p: Compensated, wo: Direction, u1: float, u2: float) -> Direction:
        share = lost(p, wo.z)
        if u1 < share:
            return sample_lobe(p, u1 / share, u2)
        return see(p, wo, (u1 - share) / (1.0 - share), u2)

    def pdf(p: Compensated, wi: Direction, wo: Direction) -> float:
        share = lost(p, wo.z)
        return share * lobe_pdf(p, wi) + (1.0 - share) * seen(p, wi, wo)

    source = kulla2017("the multiple-scattering lobe", TABLE)
    parts = (
        Model("ggx_multiscatter", "the facets", Compensated, (), facets, source, smooth_in=FACETS),
        Model("ggx_multiscatter", "the lobe", Compensated, (), lobe, source, smooth_in=Coordinates(Axis.NORMAL, TANGENT)),
    )
    claims: tuple[Claim, ...] = (Reciprocal("Kulla and Conty 2017"), EnergyConserving("Kulla and Conty 2017"))
    if F == "one":
        claims += (GrazingAlbedo("Kulla and Conty 2017: with F = 1 the albedo is 1 in every direction", value=lambda p: 1.0),)
    return Model(
        "ggx_multiscatter",
        FORMS[form],
        Compensated,
        (ALPHA, *indices),
        evaluate,
        sample=sample,
        pdf=pdf,
        parts=lambda p: tuple((part, p) for part in parts),
        source=source,
        claims=claims,
        **common,
    )


MODEL = make(form="kulla_conty", F="one", G="smith_correlated")
