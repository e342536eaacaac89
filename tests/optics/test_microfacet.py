"""Distributions of normals, masking, and visible normals, against mpmath, scipy and their definitions."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from functools import partial
from itertools import pairwise, product

import mpmath
import pytest
from scipy.integrate import quad
from scipy.special import erfc, erfcinv

from albedo_lab.optics import masking, normals
from albedo_lab.optics.frame import Direction, dot, length, reflect
from albedo_lab.optics.microfacet import beckmann_visible, ggx_visible, v_cavity_azimuth, v_cavity_visible, visible_gaussian

Density = Callable[[Direction], float]
ALPHAS = (1e-4, 0.01, 0.3, 1.0 - 1e-9, 1.0)
GAMMAS = (0.0, 0.5, 1.0, 1.0 + 1e-7, 1.5, 2.0, 5.0, 10.0)
EXPONENTS = (0.0, 0.3, 1.0, 20.0, 3e3, 1e8)
COTANGENTS = (1e-12, 1e-6, 1e-4, 1e-3, 0.03, 0.3, 1.0, 3.0, 1e3, 1e9)
PI = math.pi


def gtr(alpha: float, gamma: float) -> Density:
    norm = normals.tails(alpha, gamma).norm
    return lambda v: normals.gtr(alpha, gamma, norm, v)


def distributions() -> Iterator[tuple[str, Density, Callable[[float], float]]]:
    """Name, D, and the slope of a survival."""
    for n in EXPONENTS:
        yield f"blinn_phong {n}", partial(normals.blinn_phong, n), partial(normals.blinn_phong_slope, n)
    for a in ALPHAS:
        yield f"beckmann {a}", partial(normals.beckmann, a), partial(normals.beckmann_slope, a)
        yield f"ggx {a}", partial(normals.ggx, a), partial(normals.ggx_slope, a)
        for gamma in GAMMAS:
            t = normals.tails(a, gamma)
            yield f"gtr {a} {gamma}", gtr(a, gamma), partial(normals.gtr_slope, t.L, t.g, t.E)


def share_of_slopes(D: Density, low: float, high: float) -> float:
    """The integral of D cos over normals with slopes in the interval, over the logarithm of the slope."""

    def integrand(y: float) -> float:
        x = math.exp(y)
        return 2.0 * PI * D(Direction(x, 0.0, 1.0)) * x * x / (1.0 + x * x) ** 2

    ends = [math.log(low) + (math.log(high) - math.log(low)) * i / 12 for i in range(13)]
    return sum(quad(integrand, a, b, epsrel=1e-10)[0] for a, b in pairwise(ends))


@pytest.mark.parametrize(("name", "D", "slope"), list(distributions()), ids=lambda x: x if isinstance(x, str) else "")
def test_normalised_and_sampled(name: str, D: Density, slope: Callable[[float], float]) -> None:
    """Slopes below 1e-9 hold at most 1e-10, those above 1e7 at most 1e-14 of any distribution of these."""
    assert math.isclose(share_of_slopes(D, 1e-9, 1e7), 1.0, rel_tol=1e-8)
    for u in (1e-6, 0.2, 0.9):
        assert math.isclose(share_of_slopes(D, slope(u), 1e8), u, rel_tol=1e-6), u


@pytest.mark.parametrize(("alpha", "gamma"), list(product((1e-4, 0.3, 1.0 - 1e-12), (0.3, 1.0, 1.0 + 1e-12, 1.5, 10.0))))
def test_constant_of_gtr(alpha: float, gamma: float) -> None:
    """No digit is lost towards gamma = 1 or alpha = 1: 1e-13 is what the logarithm of alpha^-18 leaves of 16 digits."""
    with mpmath.workdps(60):
        a, c = mpmath.mpf(alpha), mpmath.mpf(gamma)
        if gamma == 1.0:
            expected = (1 - a**2) / (mpmath.pi * mpmath.log(1 / a**2))
        else:
            expected = (c - 1) * (1 - a**2) / (mpmath.pi * (a ** (2 * (1 - c)) - 1))
    assert math.isclose(normals.tails(alpha, gamma).norm, float(expected), rel_tol=1e-13)


def test_limits_of_gtr() -> None:
    for x, alpha in product((1e-6, 0.1, 3.0, 1e9), ALPHAS):
        v = Direction(0.6 * x, 0.8 * x, 1.0)
        assert math.isclose(gtr(alpha, 2.0)(v), normals.ggx(alpha, v), rel_tol=1e-12)
        assert math.isclose(gtr(alpha, 0.0)(v), 1 / PI, rel_tol=1e-12)
        assert math.isclose(gtr(1.0, 3.0)(v), 1 / PI, rel_tol=1e-12)
    t = normals.tails(0.01, 2.0)
    assert math.isclose(normals.gtr_median(t.L, t.g, t.E), 0.01, rel_tol=1e-12)
    t = normals.tails(0.01, 1.0)
    assert math.isclose(normals.gtr_median(t.L, t.g, t.E), 0.1, rel_tol=1e-12)


# Smith's masking


def direction(t: float) -> Direction:
    """The direction whose angle has cotangent t."""
    return Direction(1.0 / math.hypot(1.0, t), 0.0, t / math.hypot(1.0, t))


def facing_away(D: Callable[[mpmath.mpf], mpmath.mpf], widths: tuple[float, ...], t: float) -> mpmath.mpf:
    """Lambda by its definition: the projected area of the facets that face away from a direction of cotangent t, over its cosine.

    wo.m < 0 where the slope x is above t and the azimuth within phi0 of the far side, cos(phi0) = t / x; over the azimuth the
    integral is closed, x^2 = t^2 + w^2, and w runs over its logarithm. D is a function of x^2.
    """
    t = mpmath.mpf(t)

    def integrand(y: mpmath.mpf) -> mpmath.mpf:
        w = mpmath.exp(y)
        xx = t * t + w * w
        return 2 * (w / t - mpmath.atan(w / t)) * D(xx) / (1 + xx) ** 2 * w * w

    middle = sorted({float(mpmath.log(mpmath.hypot(s, t))) for s in (*widths, 1.0)} | {float(mpmath.log(t))})
    ends = [middle[0] - 40, middle[0] - 10, *middle, middle[-1] + 3, middle[-1] + 10, middle[-1] + 45]
    return mpmath.quad(integrand, ends)


def exact_gtr(alpha: float, gamma: float) -> Callable[[mpmath.mpf], mpmath.mpf]:
    a, c = mpmath.mpf(alpha), mpmath.mpf(gamma)
    norm = 1 / mpmath.pi
    if alpha < 1:
        norm *= (1 - a**2) * (c - 1) / (a ** (2 - 2 * c) - 1) if gamma != 1 else (1 - a**2) / (-2 * mpmath.log(a))
    return lambda xx: norm * ((1 + xx) / (a * a + xx)) ** c


@pytest.mark.parametrize("t", COTANGENTS)
@pytest.mark.parametrize(
    ("alpha", "gamma"), [(1e-4, 0.5), (1e-4, 1.0), (1e-4, 2.0), (1e-4, 10.0), (0.1, 5.0), (0.5, 10.0), (0.3, 1.0), (1.0, 3.0)]
)
def test_masking_of_gtr(alpha: float, gamma: float, t: float) -> None:
    """4e-12 where the facets' slopes fall off fastest (gamma = 10 and the smallest alpha), else 5e-14."""
    with mpmath.workdps(20):
        expected = float(1 + facing_away(exact_gtr(alpha, gamma), (alpha,), t))
    tails = normals.tails(alpha, gamma)
    tolerance = 4e-12 if gamma == 10.0 else 5e-14
    assert math.isclose(1 + masking.gtr_lambda(alpha, tails.L, tails.g, tails.E, direction(t)), expected, rel_tol=tolerance)
    if gamma == 1.0:
        assert math.isclose(1 + masking.trowbridge_reitz_lambda(alpha, tails.L, direction(t)), expected, rel_tol=2e-15)
    if gamma == 2.0:
        assert math.isclose(1 + masking.ggx_lambda(alpha, direction(t)), expected, rel_tol=2e-15)


@pytest.mark.parametrize("t", COTANGENTS)
@pytest.mark.parametrize("n", EXPONENTS)
def test_masking_of_blinn_phong(n: float, t: float) -> None:
    with mpmath.workdps(20):
        exact = facing_away(
            lambda xx: (n + 2) / (2 * mpmath.pi) * mpmath.exp(-mpmath.mpf(n) / 2 * mpmath.log1p(xx)), (math.sqrt(1 / (n + 2)),), t
        )
    value = 1 + masking.blinn_phong_lambda(n, masking.student_peak(n), direction(t))
    assert math.isclose(value, float(1 + exact), rel_tol=5e-13)


@pytest.mark.parametrize("t", COTANGENTS)
@pytest.mark.parametrize("m", [1e-4, 0.1, 1.0])
def test_masking_of_beckmann(m: float, t: float) -> None:
    with mpmath.workdps(20):
        exact = facing_away(
            lambda xx: mpmath.exp(-xx / mpmath.mpf(m) ** 2) * (1 + xx) ** 2 / (mpmath.pi * mpmath.mpf(m) ** 2), (m,), t
        )
    assert math.isclose(1 + masking.beckmann_lambda(m, direction(t)), float(1 + exact), rel_tol=2e-15)


def test_the_normal_hides_nothing() -> None:
    up = Direction(0.0, 0.0, 1.0)
    t = normals.tails(0.3, 3.0)
    for hidden in (
        masking.beckmann_lambda(0.3, up),
        masking.ggx_lambda(0.3, up),
        masking.blinn_phong_lambda(20.0, masking.student_peak(20.0), up),
        masking.trowbridge_reitz_lambda(0.3, t.L, up),
        masking.gtr_lambda(0.3, t.L, t.g, t.E, up),
    ):
        assert abs(hidden) < 1e-13


@pytest.mark.parametrize("m", [0.05, 0.1, 0.3])
def test_schlicks_fit_is_that_of_the_misprinted_masking(m: float) -> None:
    """It is within 0.12 of g / (g + 1), schlick1993 eq. 7, and 0.3 and more below the masking that is meant.

    At grazing angles it is a half for the facets that face away, counted as hidden, times sqrt(1/2) for the other meaning of m.
    """
    k = math.sqrt(2 / PI) * m
    from_print, from_smith = 0.0, 0.0
    for t in (m * 10 ** (i / 20) for i in range(-80, 80)):
        v = direction(t)
        root = t / (m * math.sqrt(2))
        g = math.sqrt(PI) * root * (2 - erfc(root))
        fit = masking.schlick_factor(k, v)
        from_print = max(from_print, abs(fit - g / (g + 1)))
        from_smith = max(from_smith, 1 / (1 + masking.beckmann_lambda(m, v)) - fit)
    assert from_print < 0.12
    assert from_smith > 0.3
    grazing = direction(1e-9)
    ratio = masking.schlick_factor(k, grazing) * (1 + masking.beckmann_lambda(m, grazing))
    assert math.isclose(ratio, 0.5 * math.sqrt(0.5), rel_tol=1e-6)


@pytest.mark.parametrize("tau", [0.1, 0.999, 1.5, 40.0])
def test_cavities_show_their_projected_area(tau: float) -> None:
    """Facets of one slope at every azimuth, each by min(1, 2 t v/u) u: together v t, as if there were no cavities."""
    wo = direction(0.4)
    slope = tau * 0.4

    def seen(phi: float) -> float:
        h = Direction(slope * math.cos(phi), slope * math.sin(phi), 1.0)
        scale = 1 / length(h)
        h = Direction(h.x * scale, h.y * scale, h.z * scale)
        u = max(dot(wo, h), 0.0)
        v = Direction(2 * u * h.x, 2 * u * h.y, 2 * u * h.z)
        return u * masking.v_cavity_seen(v, wo) / h.z if u > 0.0 else 0.0

    edge = math.acos(1 / tau) if tau > 1 else 0.0
    ends = (0.0, edge, PI - edge) if tau > 1 else (0.0, PI)
    mean = sum(quad(seen, a, b, epsabs=1e-11)[0] for a, b in pairwise(ends)) / PI
    assert math.isclose(mean, 1.0, rel_tol=1e-9)


# Visible normals


@pytest.mark.parametrize("a", [0.0, 1e-12, 1e-3, 0.1, 0.3, 0.7, 1.0, 1.5, 2.0, 3.0, 4.0, 6.0, 10.0, 1e4, 1e30])
def test_visible_gaussian_is_the_inverse_of_its_survival(a: float) -> None:
    """To 2e-14 of the probability, from the smallest uniforms to the largest."""
    for u in (2.0**-50, 1e-9, 1e-4, 0.01, 0.1, 0.3, 0.4999, 0.5, 0.6, 0.9, 0.99, 0.999, 1 - 1e-4, 1 - 1e-6, 1 - 1e-9, 1 - 1e-12):
        x = visible_gaussian(a, u)
        assert x > -a
        whole = a * erfc(-a) + math.exp(-a * a) / math.sqrt(PI)
        above = a * erfc(x) + math.exp(-x * x) / math.sqrt(PI)
        assert abs(above / whole - u) < 2e-14 * min(1.0, max(u, 0.02) * 50)
        if a > 1e20:
            assert math.isclose(x, float(erfcinv(2 * u)), rel_tol=1e-6, abs_tol=1e-12)


@pytest.mark.parametrize("tau", [0.0, 1e-9, 0.3, 0.9, 1 - 1e-9, 1.0, 1 + 1e-9, 1.3, 5.0, 1e4, 1e18])
def test_v_cavity_azimuth(tau: float) -> None:
    """The share of a half turn up to the azimuth, from its density; and the other half turn mirrors it."""
    for share in (1e-15, 1e-9, 1e-3, 0.1, 0.5, 0.8, 0.999):
        s, c = v_cavity_azimuth(tau, 0.5 * share)
        assert math.isclose(s * s + c * c, 1.0, rel_tol=1e-14)
        if share >= 1e-3:  # below, 1 - share / 2 is rounded
            assert v_cavity_azimuth(tau, 1 - 0.5 * share) == pytest.approx((-s, c), abs=1e-9)
        with mpmath.workdps(40):
            e = mpmath.pi - mpmath.atan2(mpmath.mpf(s), mpmath.mpf(c))
            edge = mpmath.acos(1 / mpmath.mpf(tau)) if tau > 1 else mpmath.mpf(0)
            if e < mpmath.pi - edge:
                got = ((e - edge) - tau * (mpmath.sin(e) - mpmath.sin(edge))) / mpmath.pi
            else:
                got = (2 * e - mpmath.pi) / mpmath.pi
        # the azimuth itself is known to 1e-16, and the density of its share is at most 2 / pi
        assert abs(float(got) - share) < 1e-15, share


def facets_seen(wo: Direction) -> Iterator[tuple[Direction, float]]:
    """Normals that samplers return at extreme uniforms."""
    for u1, u2 in product((2.0**-50, 0.3, 1 - 2.0**-33), repeat=2):
        for width in (1e-4, 0.1, 1.0):
            yield ggx_visible(width, wo, u1, u2), width
            yield beckmann_visible(width, wo, u1, u2), width
            yield v_cavity_visible(normals.beckmann_slope(width, u1), wo, u2), width


@pytest.mark.parametrize("mu", [1.0, 0.5, 1e-4, 1e-9, 1e-12])
@pytest.mark.parametrize("phi", [0.0, 2.0])
def test_visible_normals_are_units_and_face_the_viewer(mu: float, phi: float) -> None:
    s = math.sqrt((1 - mu) * (1 + mu))
    wo = Direction(s * math.cos(phi), s * math.sin(phi), mu)
    for h, width in facets_seen(wo):
        assert math.isclose(length(h), 1.0, rel_tol=1e-14), width
        assert h.z >= 0.0
        assert dot(wo, h) > -1e-16
        assert math.isclose(length(reflect(wo, h)), 1.0, rel_tol=1e-12)
