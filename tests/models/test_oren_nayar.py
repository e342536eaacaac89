"""Oren-Nayar (losasso; Oren and Nayar 1994), both forms."""

from __future__ import annotations

import math

import mpmath
import pytest
from scipy.integrate import quad

from albedo_lab.model import Model
from albedo_lab.models.oren_nayar import MODEL, OrenNayar, make
from albedo_lab.optics.frame import Direction
from tests.models import trial

FULL = make(form="full")
SURFACES = (OrenNayar(1.0, 0.0), OrenNayar(0.7, 0.2), OrenNayar(1.0, 0.5), OrenNayar(0.4, math.pi / 2))
every_surface = pytest.mark.parametrize("p", SURFACES)
both_forms = pytest.mark.parametrize("model", [MODEL, FULL], ids=lambda model: model.chosen["form"])


def coefficients(sigma: float) -> tuple[float, float]:
    """A and B."""
    return 1 - 0.5 * sigma**2 / (sigma**2 + 0.33), 0.45 * sigma**2 / (sigma**2 + 0.09)


def interreflection(p: OrenNayar) -> float:
    """L2 less its last factor, times pi."""
    return 0.17 * p.rho**2 * p.sigma**2 / (p.sigma**2 + 0.13)


# Formulas


@every_surface
def test_qualitative_formula(p: OrenNayar) -> None:
    A, B = coefficients(p.sigma)

    def printed(light: float, viewer: float, turn: float) -> float:
        alpha, beta = max(light, viewer), min(light, viewer)
        return p.rho / math.pi * (A + B * max(0, math.cos(turn)) * math.sin(alpha) * math.tan(beta))

    trial.assert_formula(MODEL, p, printed)


def full_in_angles(p: OrenNayar, light: float, viewer: float, turn: float) -> float:
    """L1 + L2 for light of irradiance 1, as the paper defines C1, C2 and C3."""
    A, B = coefficients(p.sigma)
    alpha, beta, c = max(light, viewer), min(light, viewer), math.cos(turn)
    C2 = B * (math.sin(alpha) if c >= 0 else math.sin(alpha) - (2 * beta / math.pi) ** 3)
    C3 = 0.125 * p.sigma**2 / (p.sigma**2 + 0.09) * (4 * alpha * beta / math.pi**2) ** 2
    L1 = p.rho / math.pi * (A + c * C2 * math.tan(beta) + (1 - abs(c)) * C3 * math.tan((alpha + beta) / 2))
    return L1 + interreflection(p) / math.pi * (1 - c * (2 * beta / math.pi) ** 2)


@every_surface
def test_full_formula(p: OrenNayar) -> None:
    trial.assert_formula(FULL, p, lambda light, viewer, turn: full_in_angles(p, light, viewer, turn))


def full_to_fifty_digits(p: OrenNayar, wi: Direction, wo: Direction) -> float:
    """The same from the components of both directions, as they are rounded."""
    with mpmath.workdps(50):
        si, so = (mpmath.hypot(w.x, w.y) for w in (wi, wo))
        beta, alpha = sorted((mpmath.atan2(si, wi.z), mpmath.atan2(so, wo.z)))
        c = (mpmath.mpf(wi.x) * wo.x + mpmath.mpf(wi.y) * wo.y) / (si * so)
        A, B = coefficients(p.sigma)
        C2 = B * (mpmath.sin(alpha) - (0 if c >= 0 else (2 * beta / mpmath.pi) ** 3))
        C3 = B * (0.125 / 0.45) * (4 * alpha * beta / mpmath.pi**2) ** 2
        L1 = p.rho * (A + c * C2 * mpmath.tan(beta) + (1 - abs(c)) * C3 * mpmath.tan((alpha + beta) / 2))
        return float((L1 + interreflection(p) * (1 - c * (2 * beta / mpmath.pi) ** 2)) / mpmath.pi)


@pytest.mark.parametrize("mu", [1.0 - 1e-15, 0.5, 1e-6, 1e-12])
@pytest.mark.parametrize("turn", [0.0, 1.5, math.pi / 2, 1.7, 3.1, math.pi])
def test_no_digits_are_lost(mu: float, turn: float) -> None:
    """Where both directions graze, tan(beta) is 1e12, and at opposite azimuths what it multiplies is next to nothing.

    14 digits, but for the cosine of an azimuth next to 90 degrees, a sum that may cancel: 2e-16 of 1, times tan(beta).
    """
    p = OrenNayar(1.0, 0.5)
    for other in (0.9, 0.3 * mu, mu, 1e-12):
        wi, wo = trial.at(mu, 0.3 + turn), trial.at(other, 0.3)
        exact = full_to_fifty_digits(p, wi, wo)
        lost = 2e-16 / max(mu, other) if abs(math.cos(turn)) < 0.01 else 0.0
        assert math.isclose(FULL.evaluate(p, wi, wo), exact, rel_tol=1e-14, abs_tol=lost)


@both_forms
def test_reciprocal(model: Model) -> None:
    trial.assert_reciprocal(model, *SURFACES)


@both_forms
def test_smooth_facets_are_lamberts_law(model: Model) -> None:
    for wi, wo in trial.random_pairs():
        assert math.isclose(model.evaluate(OrenNayar(0.7, 0.0), wi, wo), 0.7 / math.pi, rel_tol=1e-15)


def test_both_forms_are_the_same_where_the_light_is_at_the_normal_and_nothing_is_interreflected() -> None:
    """beta = 0 leaves A or C1; rho^2 of a millionth leaves 1e-7 of it."""
    for _, wo in trial.random_pairs():
        p = OrenNayar(1e-6, 0.5)
        assert math.isclose(MODEL.evaluate(p, trial.at(1.0), wo), FULL.evaluate(p, trial.at(1.0), wo), rel_tol=1e-6)


@both_forms
def test_continuous(model: Model) -> None:
    """At 90 degrees of azimuth, at equal cosines and at the normal, where the formula turns over."""
    p, e = OrenNayar(0.8, 0.7), 1e-9
    quarter = math.pi / 2
    for light, viewer, turn in ((1.0, 0.6, quarter), (0.9, 0.9, 2.0), (0.9, 0.9, 0.3), (0.0, 1.2, 0.0)):
        sides = [
            model.evaluate(p, trial.direction(light + a * e, turn + b * e), trial.direction(viewer))
            for a in (-1, 1)
            for b in (-1, 1)
        ]
        assert max(sides) - min(sides) < 10 * e


# Signs


def test_the_qualitative_form_is_nowhere_below_its_first_term() -> None:
    for p in SURFACES:
        for wi, wo in trial.random_pairs():
            assert MODEL.evaluate(p, wi, wo) >= p.rho / math.pi * coefficients(p.sigma)[0]


@pytest.mark.parametrize(("rho", "sigma"), [(1.0, 0.5), (0.1, 1.0), (1.0, 1.5), (0.8, 1.5)])
def test_the_full_form_towards_the_mirror_direction_at_grazing_angles(rho: float, sigma: float) -> None:
    """With both elevations e, tan(beta) = 1/e meets sin(alpha) - (1 - 2 e/pi)^3 = 6 e/pi: f tends to its least value."""
    p, (A, B) = OrenNayar(rho, sigma), coefficients(sigma)
    limit = (rho * (A - 6 / math.pi * B) + 2 * interreflection(p)) / math.pi
    assert math.isclose(FULL.evaluate(p, trial.at(1e-12, 0.4), trial.at(1e-12, 0.4 + math.pi)), limit, abs_tol=1e-11)
    assert all(FULL.evaluate(p, wi, wo) > limit for wi, wo in trial.random_pairs())


def test_the_full_form_is_below_zero_for_rough_and_dark_surfaces() -> None:
    grazing = trial.at(1e-6), trial.at(1e-6, math.pi)
    assert FULL.evaluate(OrenNayar(0.3, 0.9), *grazing) < 0 < FULL.evaluate(OrenNayar(1.0, 0.9), *grazing)
    assert FULL.evaluate(OrenNayar(1e-3, 0.66), *grazing) > 0 > FULL.evaluate(OrenNayar(1e-3, 0.67), *grazing)
    assert FULL.evaluate(OrenNayar(0.83, math.pi / 2), *grazing) < 0 < FULL.evaluate(OrenNayar(0.84, math.pi / 2), *grazing)
    assert MODEL.positive
    assert not FULL.positive


# Albedos


def qualitative_albedo(p: OrenNayar, mu: float) -> float:
    """The azimuths integrate to 2; sin(alpha) tan(beta) z' is s s' where z' > mu, and s s' z' / mu below."""
    A, B = coefficients(p.sigma)
    theta, s = math.acos(mu), math.sqrt(1 - mu * mu)
    above, below = s * (theta - mu * s) / 2, s * (1 - s**3) / (3 * mu)
    return p.rho * (A + 2 * B / math.pi * (above + below))


def full_albedo(p: OrenNayar, mu: float) -> float:
    """Of cos dphi and its sign there stays 2 (2 beta/pi)^3 tan(beta), of 1 - |cos dphi| 2 pi - 4, and of L2 its constant."""
    A, B = coefficients(p.sigma)
    viewer = math.acos(mu)

    def integrand(light: float) -> float:
        alpha, beta = max(light, viewer), min(light, viewer)
        facing = 2 * B * (2 * beta / math.pi) ** 3 * math.tan(beta)
        across = (2 * math.pi - 4) * B * 0.125 / 0.45 * (4 * alpha * beta / math.pi**2) ** 2 * math.tan((alpha + beta) / 2)
        return (facing + across) * math.sin(light) * math.cos(light)

    integral = quad(integrand, 0, viewer)[0] + quad(integrand, viewer, math.pi / 2)[0]
    return p.rho * (A + integral / math.pi) + interreflection(p)


@pytest.mark.parametrize("mu", [1.0, 0.7, 0.2, 1e-6])
@pytest.mark.parametrize("p", SURFACES[1:])
def test_albedo(p: OrenNayar, mu: float) -> None:
    trial.assert_close(trial.wide_albedo(MODEL, p, mu), qualitative_albedo(p, mu), 1e-6)
    trial.assert_close(trial.wide_albedo(FULL, p, mu), full_albedo(p, mu), 1e-6)


def test_grazing_albedo_of_the_qualitative_form_exceeds_one() -> None:
    """rho (A + B / 2), which is largest where sigma^2 + 0.33 = (sigma^2 + 0.09) sqrt(0.165 / 0.02025)."""
    root = math.sqrt(0.165 / 0.02025)
    p = OrenNayar(1.0, math.sqrt((0.33 - 0.09 * root) / (root - 1)))
    A, B = coefficients(p.sigma)
    albedo = trial.wide_albedo(MODEL, p, 1e-9)
    trial.assert_close(albedo, A + B / 2, 1e-6)
    assert 1.0150 < albedo < 1.0153


def test_grazing_albedo_of_the_full_form_exceeds_one() -> None:
    assert 1.0505 < trial.wide_albedo(FULL, OrenNayar(1.0, 0.29), 1e-9) < 1.0512


# Sampler


def weight(model: Model, p: OrenNayar, wo: Direction, u1: float, u2: float) -> float:
    wi: Direction = model.sample(p, wo, u1, u2)
    return float(model.evaluate(p, wi, wo) * wi.z / model.pdf(p, wi, wo))


@pytest.mark.parametrize("mu", trial.GRAZING)
@every_surface
def test_density_integrates_to_one(p: OrenNayar, mu: float) -> None:
    trial.assert_normalised(MODEL, p, mu)


@pytest.mark.parametrize("p", SURFACES[::2])
def test_samples_follow_the_density(p: OrenNayar) -> None:
    trial.assert_follows_density(MODEL, p, 0.3, 2)


@both_forms
def test_weights_are_bounded_where_both_directions_graze(model: Model) -> None:
    """f z' <= rho/pi (2 z' + B + 0.25 B / 0.45) and A + 2B/pi <= 1, over a density with A z' + B/pi: 2/A + 1.6 pi < 9 of rho."""
    for p in SURFACES:
        for mu in (1e-12, 1e-6, 0.1):
            for u1 in (2.0**-50, 1e-12, 1e-6, 0.1, 1 - 1e-9):
                for u2 in (0.0, 0.2, 0.5):
                    assert abs(weight(model, p, trial.at(mu), u1, u2)) <= 9 * p.rho


def test_smooth_facets_weigh_every_sample_the_same() -> None:
    for u1 in (1e-12, 0.3, 0.9):
        assert math.isclose(weight(MODEL, OrenNayar(0.7, 0.0), trial.at(0.2), u1, 0.4), 0.7, rel_tol=1e-14)


def test_members() -> None:
    assert MODEL is make(form="qualitative")
    assert MODEL.member({"form": "full", "rho": 0.5}) == (FULL, {"rho": 0.5})
    assert FULL.bind({}) == OrenNayar(1.0, 0.5)
