"""He-Torrance (He et al. 1991), against a literal transcription with vectors and sums, its limits, and plain integrals."""

from __future__ import annotations

import math
from collections.abc import Callable
from itertools import product
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.optimize import brentq
from scipy.special import erfc, gammaln

from albedo_lab.models import he_torrance
from albedo_lab.models.he_torrance import MODEL, make
from albedo_lab.optics.coordinates import Axis
from albedo_lab.optics.frame import Direction
from albedo_lab.optics.fresnel import normal_reflectance
from tests.models import trial

PERFECT = make(fresnel="one")
SURFACES: dict[str, dict[str, float]] = {
    "figure 5": {},
    "smooth": {"sigma0": 0.01, "tau": 3.0},
    "short bumps": {"sigma0": 0.02, "tau": 0.2},
    "rough": {"sigma0": 1.0, "tau": 6.0},
    "steep": {"sigma0": 0.5, "tau": 0.5, "a_d": 0.2},
}
every_surface = pytest.mark.parametrize("values", SURFACES.values(), ids=SURFACES.keys())
Vector = NDArray[np.float64]
NORMAL = np.array([0.0, 0.0, 1.0])


# The paper, word for word: no identity of the implementation's is used


def exact_fresnel(eta: float, k: float, cosine: float) -> float:
    """Fresnel's amplitudes with a complex index."""
    index = complex(eta, k)
    inside = np.sqrt(1 - (1 - cosine**2) / index**2 + 0j)
    s = (cosine - index * inside) / (cosine + index * inside)
    p = (index * cosine - inside) / (index * cosine + inside)
    return 0.5 * float(abs(s) ** 2 + abs(p) ** 2)


def shadowing(p: Any, theta: float) -> float:
    """Eq. 24, 25."""
    if theta == 0.0:
        return 1.0
    cot = 1 / math.tan(theta)
    q = p.tau * cot / (2 * p.sigma0)
    lam = 0.5 * (2 / math.sqrt(math.pi) * p.sigma0 / (p.tau * cot) * math.exp(-q * q) - erfc(q))
    return float((1 - 0.5 * erfc(q)) / (lam + 1))


def effective_roughness(p: Any, theta_i: float, theta_r: float) -> float:
    """Eq. 80 to 83, solved by bisection."""
    k = sum(math.tan(t) * erfc(p.tau / (2 * p.sigma0 * math.tan(t))) for t in (theta_i, theta_r) if t > 0)

    def balance(z0: float) -> float:
        return float(math.sqrt(math.pi / 2) * z0 - p.sigma0 / 4 * k * math.exp(-(z0**2) / (2 * p.sigma0**2)))

    z0 = brentq(balance, 0.0, 50.0 * p.sigma0, xtol=1e-300, rtol=1e-15) if k > 0 else 0.0
    return float(p.sigma0 / math.sqrt(1 + (z0 / p.sigma0) ** 2))


def geometry(k_i: Vector, k_r: Vector) -> float:
    """Eq. 76, with s = k x n / |k x n| and p = s x k; k_i runs towards the surface."""
    v = k_r - k_i

    def basis(k: Vector) -> tuple[Vector, Vector]:
        s = np.cross(k, NORMAL)
        s = s / np.linalg.norm(s) if np.linalg.norm(s) > 0 else np.array([1.0, 0.0, 0.0])
        return s, np.cross(s, k)

    s_i, p_i = basis(k_i)
    s_r, p_r = basis(k_r)
    both = ((s_r @ k_i) ** 2 + (p_r @ k_i) ** 2) * ((s_i @ k_r) ** 2 + (p_i @ k_r) ** 2)
    return float((v @ v / v[2]) ** 2 / np.linalg.norm(np.cross(k_r, k_i)) ** 4 * both)


def vector(theta: float, phi: float) -> Vector:
    return np.array([math.sin(theta) * math.cos(phi), math.sin(theta) * math.sin(phi), math.cos(theta)])


def distribution(p: Any, v: Vector, g: float) -> float:
    """Eq. 78, 84 with wave vectors: every term up to far beyond the largest."""
    xy = (2 * math.pi / p.wavelength) ** 2 * (v[0] ** 2 + v[1] ** 2)
    m = np.arange(1.0, 400.0 + 3.0 * g)
    terms = np.exp(m * math.log(g) - g - gammaln(m + 1) - np.log(m) - xy * p.tau**2 / (4 * m))
    return float(math.pi**2 * p.tau**2 / (4 * p.wavelength**2) * np.sum(terms))


def printed(p: Any, reflectance: Callable[[float], float]) -> trial.Formula:
    def formula(light: float, viewer: float, turn: float) -> float:
        k_i, k_r = -vector(light, turn), vector(viewer, 0.0)
        v = k_r - k_i
        sigma = effective_roughness(p, light, viewer)
        g = (2 * math.pi * sigma / p.wavelength * (math.cos(light) + math.cos(viewer))) ** 2
        shadow = shadowing(p, light) * shadowing(p, viewer)
        half = math.sqrt(0.5 - 0.5 * float(k_i @ k_r))
        # backscattering, k_i = -k_r, has no plane and no cross product; there G is its limit
        g_factor = geometry(k_i, k_r) if half < 1 - 1e-9 else (4 / v[2]) ** 2
        lobe = g_factor * shadow * distribution(p, v, g) / (math.cos(light) * math.cos(viewer))
        return reflectance(half) / math.pi * lobe + float(p.a_d) / math.pi

    return formula


# 1e-11: the series is good to 2e-12, scipy's gammaln to 1e-15 of some hundreds


@every_surface
def test_formula_of_a_conductor(values: dict[str, float]) -> None:
    p = MODEL.bind(values)
    trial.assert_formula(MODEL, p, printed(p, lambda c: exact_fresnel(p.eta, p.k, c)))


@every_surface
def test_formula_of_a_perfect_reflector(values: dict[str, float]) -> None:
    p = PERFECT.bind(values)
    trial.assert_formula(PERFECT, p, printed(p, lambda c: 1.0))


@every_surface
def test_mirror_part(values: dict[str, float]) -> None:
    """|F|^2 e^-g S, both directions at the same angle."""
    p = MODEL.bind(values)
    for theta in (0.0, 0.3, 1.0, 1.4, 1.55):
        g = (4 * math.pi * effective_roughness(p, theta, theta) / p.wavelength * math.cos(theta)) ** 2
        expected = exact_fresnel(p.eta, p.k, math.cos(theta)) * math.exp(-g) * shadowing(p, theta) ** 2
        assert math.isclose(MODEL.mirror(p, math.cos(theta)), expected, rel_tol=1e-10)


def test_geometry_factor_reduces() -> None:
    """s, p and k are orthonormal: each bracket is the squared sine between the directions."""
    for wi, wo in trial.random_pairs(50):
        k_i, k_r = -np.array(wi), np.array(wo)
        v = k_r - k_i
        if np.linalg.norm(np.cross(k_i, k_r)) > 0.1:
            assert math.isclose(geometry(k_i, k_r), (float(v @ v) / v[2]) ** 2, rel_tol=1e-9)


# Its parts


@pytest.mark.parametrize("ratio", [1e-3, 0.05, 0.5, 100.0])
def test_effective_roughness_solves_its_equation(ratio: float) -> None:
    """Up to tan = 1e12: with y = z0 / sigma0, log of eq. 81 to the last bits."""
    p = PERFECT.bind({"sigma0": ratio, "tau": 1.0, "wavelength": 0.5})
    full = he_torrance.roughness(p, 0.0)
    for mu in (0.99, 0.6, 0.1, 1e-3, 1e-6, 1e-12):
        k = 2.0 * he_torrance.seen(he_torrance.slope(p), mu, math.sqrt(1.0 - mu * mu))[1]
        yy = full / he_torrance.roughness(p, k) - 1.0
        if yy > 1e-6:
            residual = 0.5 * math.log(math.pi / 2 * yy) - math.log(k / 4) + 0.5 * yy
            assert abs(residual) < 1e-9
        else:
            assert k < 0.01


def test_effective_roughness_is_the_full_one_where_nothing_is_hidden() -> None:
    p = PERFECT.bind({})
    assert he_torrance.roughness(p, 0.0) == pytest.approx((2 * math.pi * 0.1 / 0.5) ** 2, rel=1e-15)
    # W(1e24 / (8 pi)) = 48.2
    assert he_torrance.roughness(p, 1e12) == pytest.approx(he_torrance.roughness(p, 0.0) / 49.2, rel=1e-3)


@pytest.mark.parametrize("m", [1e-6, 0.1, 2.0, 1e4])
def test_shadowing_at_both_ends(m: float) -> None:
    """S is 1 along the normal; at grazing angles S / cos = sqrt(pi) / m (1 + O(cos / m))."""
    assert he_torrance.seen(m, 1.0, 0.0) == (1.0, 0.0)
    z = 1e-9 * min(m, 1.0)
    s, k = he_torrance.seen(m, z, math.sqrt(1.0 - z * z))
    assert math.isclose(s, math.sqrt(math.pi) / m, rel_tol=1e-8)
    assert math.isclose(k, 1.0 / z, rel_tol=1e-8)


# Limits


@pytest.mark.parametrize("sigma0", [0.001, 0.01, 0.03, 0.06])
def test_smooth_and_gentle_loses_nothing(sigma0: float) -> None:
    """e^-g in the mirror direction and 1 - e^-g about it: of long bumps, whose lobe is narrower than G and cos vary (1e-4)."""
    p = PERFECT.bind({"sigma0": sigma0, "tau": 200.0})
    g = (4 * math.pi * sigma0 / 0.5) ** 2
    assert math.isclose(PERFECT.mirror(p, 1.0), math.exp(-g), rel_tol=1e-12)
    trial.assert_close(trial.narrow_albedo(PERFECT, p, 1.0), -math.expm1(-g))
    oblique = PERFECT.mirror(p, 0.5) + trial.narrow_albedo(PERFECT, p, 0.5)
    trial.assert_close(oblique, 1.0)


def test_a_smooth_conductor_is_its_mirror() -> None:
    p = MODEL.bind({"sigma0": 1e-4})
    assert math.isclose(MODEL.mirror(p, 1.0), normal_reflectance(p.eta, p.k), rel_tol=1e-5)
    for mu in (0.2, 0.7):
        assert math.isclose(MODEL.mirror(p, mu), exact_fresnel(p.eta, p.k, mu), rel_tol=1e-5)


def test_very_rough_is_beckmanns_microfacets() -> None:
    """D S S / (4 cos cos), D = exp(-tan^2/m^2) / (pi m^2 cos^4), m = 2 sigma/tau; g = 4e4 changes it by some 1/g."""
    p = PERFECT.bind({"sigma0": 10.0, "tau": 100.0})
    checked = 0
    for light, viewer, turn in product((0.1, 0.5, 0.9), (0.2, 0.8), (2.6, 3.0, math.pi)):
        cosine = trial.half_cosine(light, viewer, turn)
        tan2 = 1 / cosine**2 - 1
        m = 2 * effective_roughness(p, light, viewer) / p.tau
        beckmann = math.exp(-tan2 / m**2) / (math.pi * m**2 * cosine**4)
        expected = beckmann * shadowing(p, light) * shadowing(p, viewer) / (4 * math.cos(light) * math.cos(viewer))
        if tan2 < 9 * m**2:
            checked += 1
            f = PERFECT.evaluate(p, trial.direction(light, turn), trial.direction(viewer))
            assert math.isclose(f, expected, rel_tol=5e-4)
    assert checked >= 8


def test_darkens_towards_grazing_light() -> None:
    """neumann1999 after fig. 5: "badly decreases for greater incident angles"."""
    p = PERFECT.bind({})
    albedos = [PERFECT.mirror(p, mu) + trial.narrow_albedo(PERFECT, p, mu) for mu in (1.0, 0.5, 0.1, 0.01)]
    assert 1.0 < albedos[0] < 1.0001
    assert albedos[0] > albedos[1] > 0.95 > albedos[2] > 0.8 > 0.05 > albedos[3]


# Symmetries, and what every model owes


def test_reciprocal() -> None:
    trial.assert_reciprocal(MODEL, *map(MODEL.bind, SURFACES.values()))


@pytest.mark.parametrize("unit", [7.0, 1 / 7.0])
def test_only_ratios_of_lengths_matter(unit: float) -> None:
    p = MODEL.bind({})
    q = p._replace(sigma0=p.sigma0 * unit, tau=p.tau * unit, wavelength=p.wavelength * unit)
    for wi, wo in trial.random_pairs(50):
        f = MODEL.evaluate(p, wi, wo)
        assert math.isclose(MODEL.evaluate(q, wi, wo), f, rel_tol=1e-11, abs_tol=1e-250)
        assert math.isclose(MODEL.pdf(q, wi, wo), MODEL.pdf(p, wi, wo), rel_tol=1e-12)  # type: ignore[misc]
    assert math.isclose(MODEL.mirror(q, 0.3), MODEL.mirror(p, 0.3), rel_tol=1e-12)


def test_parts_add_up() -> None:
    assert MODEL.parts is not None
    assert len(MODEL.parts(MODEL.bind({}))) == 1
    p = MODEL.bind({"a_d": 0.3})
    parts = MODEL.parts(p)
    assert len(parts) == 2
    for wi, wo in trial.random_pairs(20):
        total = math.fsum(part.evaluate(q, wi, wo) for part, q in parts)
        assert math.isclose(MODEL.evaluate(p, wi, wo), total, rel_tol=1e-14)


def test_the_family() -> None:
    assert MODEL.member({"fresnel": "one"})[0] is PERFECT
    assert PERFECT.member({"fresnel": "exact"})[0] is MODEL
    assert [q.name for q in PERFECT.parameters] == ["sigma0", "tau", "wavelength", "a_d"]
    assert [q.name for q in MODEL.parameters] == ["sigma0", "tau", "wavelength", "eta", "k", "a_d"]


@every_surface
def test_density_is_normalised(values: dict[str, float]) -> None:
    for mu in (0.9, 0.2):
        trial.assert_normalised(PERFECT, PERFECT.bind(values), mu)


@pytest.mark.parametrize(("values", "mu"), [({}, 0.7), ({"sigma0": 0.02, "tau": 0.2}, 0.3), ({"sigma0": 0.5, "tau": 0.5}, 0.2)])
def test_samples_follow_the_density(values: dict[str, float], mu: float) -> None:
    trial.assert_follows_density(PERFECT, PERFECT.bind(values), mu, 3)


CORNERS = [
    dict(zip(("sigma0", "tau", "wavelength"), ends, strict=True))
    for ends in product(*((q.low, q.high) for q in PERFECT.parameters[:3]))
]


def test_corners_of_the_domain_are_finite() -> None:
    for values in CORNERS:
        p = MODEL.bind(values)
        for mu, nu, phi in product((1.0, 0.3, 1e-4, 1e-12, 1e-20), (1.0, 0.2, 1e-9, 1e-20), (0.0, 1.0, math.pi)):
            wi, wo = trial.at(mu, phi), trial.at(nu)
            f, density = MODEL.evaluate(p, wi, wo), MODEL.pdf(p, wi, wo)  # type: ignore[misc]
            assert 0.0 <= f < math.inf
            assert 0.0 < density < math.inf
            assert 0.0 <= MODEL.mirror(p, mu) <= 1.0


@every_surface
def test_no_sample_weighs_much(values: dict[str, float]) -> None:
    """f cos / pdf stays within 30 times its mean (250 for bumps shorter than the wave, which look the same from everywhere)."""
    p = PERFECT.bind({**values, "a_d": 0.0})
    rng = np.random.default_rng(3)
    for mu in (1.0, 0.3, 0.01, 1e-9):
        wo: Direction = trial.at(mu)
        weights = []
        for u1, u2 in rng.random((600, 2)).tolist():
            wi = PERFECT.sample(p, wo, u1, u2)  # type: ignore[misc]
            weights.append(PERFECT.evaluate(p, wi, wo) * wi.z / PERFECT.pdf(p, wi, wo) if wi.z > 0 else 0.0)  # type: ignore[misc]
        limit = 30.0 if p.tau > p.wavelength else 250.0
        assert max(weights) < limit * float(np.mean(weights))


@pytest.mark.parametrize("mu", [0.8, 0.1])
def test_albedo_is_that_of_the_samples(mu: float) -> None:
    """The density's own mean against plain quadrature about the half-vector, within 5 standard errors."""
    p = PERFECT.bind({})
    rng = np.random.default_rng(4)
    wo = trial.at(mu)
    weights = []
    for u1, u2 in rng.random((8000, 2)).tolist():
        wi = PERFECT.sample(p, wo, u1, u2)  # type: ignore[misc]
        weights.append(PERFECT.evaluate(p, wi, wo) * wi.z / PERFECT.pdf(p, wi, wo) if wi.z > 0 else 0.0)  # type: ignore[misc]
    error = float(np.std(weights)) / math.sqrt(len(weights))
    assert abs(float(np.mean(weights)) - trial.narrow_albedo(PERFECT, p, mu)) < 5 * error
    assert PERFECT.smooth_in.axis == Axis.HALF
