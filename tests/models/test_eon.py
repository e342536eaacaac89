"""EON: the formula and the albedos that its paper states, its fit, and its clipped sampler."""

from __future__ import annotations

import math

import mpmath
import numpy as np
import pytest

from albedo_lab.model import Model
from albedo_lab.models.eon import MEAN, MODEL, Eon, clipped, make, missing, missing_fitted, uniform_share
from albedo_lab.models.oren_nayar_fujii import GRAZING
from tests.models import trial

FITTED = make(albedo="fitted")
SURFACES = (Eon(1.0, 1.0), Eon(0.6, 0.4), Eon(0.9, 1e-3))
both = pytest.mark.parametrize("model", [MODEL, FITTED], ids=lambda model: model.chosen["albedo"])


def fujii_albedo(mu: float, r: float, exact: bool) -> float:
    """E_F, as the listing has it."""
    A = 1 / (1 + (0.5 - 2 / (3 * math.pi)) * r)
    if not exact:
        x = 1 - mu
        return A * (1 + r * (0.0571085289 * x + 0.491881867 * x**2 - 0.332181442 * x**3 + 0.0714429953 * x**4))
    theta, s = math.acos(mu), math.sqrt(1 - mu * mu)
    G = s * (theta - s * mu) + 2 / 3 * (s / mu * (1 - s**3) - s)
    return A * (1 + r / math.pi * G)


def mean_albedo(r: float) -> float:
    """<E_F>."""
    return (1 + (2 / 3 - 28 / (15 * math.pi)) * r) / (1 + (0.5 - 2 / (3 * math.pi)) * r)


def rho_ms(p: Eon) -> float:
    """The colour of what is scattered more than once."""
    mean = mean_albedo(p.r)
    return p.rho**2 * mean / (1 - p.rho * (1 - mean))


@both
@pytest.mark.parametrize("p", SURFACES)
def test_formula(model: Model, p: Eon) -> None:
    def printed(light: float, viewer: float, turn: float) -> float:
        mu_i, mu_o = math.cos(light), math.cos(viewer)
        s = math.sin(light) * math.sin(viewer) * math.cos(turn)
        single = 1 + p.r * (s / max(mu_i, mu_o) if s > 0 else s)
        f_ss = p.rho / math.pi / (1 + (0.5 - 2 / (3 * math.pi)) * p.r) * single
        lost = [1 - fujii_albedo(mu, p.r, model is MODEL) for mu in (mu_i, mu_o)]
        return f_ss + rho_ms(p) / math.pi * lost[0] * lost[1] / (1 - mean_albedo(p.r))

    trial.assert_formula(model, p, printed)


@pytest.mark.parametrize("mu", [1.0, 0.999999, 0.5, 1e-3, 1e-9])
def test_missing_energy_keeps_its_digits(mu: float) -> None:
    with mpmath.workdps(50):
        z = mpmath.mpf(mu)
        s = mpmath.sqrt(1 - z * z)
        G = s * (mpmath.acos(z) - s * z) + mpmath.mpf(2) / 3 * (s / z * (1 - s**3) - s)
        expected = float(mpmath.mpf(1) / 2 - 2 / (3 * mpmath.pi) - G / mpmath.pi)
    assert math.isclose(missing(trial.at(mu, 0.3)), expected, rel_tol=1e-14)


@pytest.mark.parametrize("mu", [1.0, 0.4, 1e-6])
def test_albedo_of_the_paper(mu: float) -> None:
    """E_EON = rho E_F + rho_ms (1 - E_F); of a white surface it is 1 from everywhere, whatever the roughness."""
    for p in SURFACES:
        E = fujii_albedo(max(mu, 1e-5), p.r, True) if mu < 1e-5 else fujii_albedo(mu, p.r, True)
        expected = p.rho * E + rho_ms(p) * (1 - E)
        trial.assert_close(trial.wide_albedo(MODEL, p, mu), expected, 1e-5)
    trial.assert_close(trial.wide_albedo(MODEL, Eon(1.0, 0.3), mu), 1.0, 1e-7)


def test_mean_of_the_missing_energy() -> None:
    """<E_F> is claimed in closed form: 2 * integral of missing * mu is GRAZING - MEAN."""
    x, w = np.polynomial.legendre.leggauss(60)
    mean = sum(2 * missing(trial.at(0.5 + 0.5 * a)) * (0.5 + 0.5 * a) * 0.5 * b for a, b in zip(x, w, strict=True))
    assert mean == pytest.approx(GRAZING - MEAN, rel=1e-8)


def test_the_fit() -> None:
    """Off by 6.02e-4 at most, and negative within 1.4e-3 of grazing, where the listing guards it."""
    off = [missing_fitted(trial.at(mu)) - missing(trial.at(mu)) for mu in np.linspace(1e-6, 1.0, 500)]
    assert max(map(abs, off)) == pytest.approx(6.02e-4, rel=1e-3)
    assert missing_fitted(trial.at(1.3e-3)) == 0.0 < missing_fitted(trial.at(1.5e-3))


def test_a_white_surface_of_the_fitted_albedo_is_within_3e_4_of_white() -> None:
    albedos = [trial.wide_albedo(FITTED, Eon(1.0, 1.0), mu) for mu in (1.0, 0.6, 0.1338, 0.01, 1e-6)]
    assert max(albedos) == pytest.approx(1.000146, abs=2e-6)
    assert min(albedos) == pytest.approx(0.999730, abs=2e-6)


@both
def test_smooth_is_lamberts_law(model: Model) -> None:
    for wi, wo in trial.random_pairs():
        assert math.isclose(model.evaluate(Eon(0.7, 0.0), wi, wo), 0.7 / math.pi, rel_tol=1e-15)
        assert math.isclose(MODEL.pdf(Eon(0.7, 0.0), wi, wo), wi.z / math.pi, rel_tol=1e-12)  # type: ignore[misc]
    trial.assert_reciprocal(model, *SURFACES)


# Sampler


@pytest.mark.parametrize("mu", [1.0, 0.99995, 0.5, 1e-6])
@pytest.mark.parametrize("r", [1e-6, 0.5, 1.0])
def test_no_sample_is_rejected_and_the_density_is_whole(mu: float, r: float) -> None:
    p = Eon(1.0, r)
    for u1, u2 in np.random.default_rng(3).random((300, 2)).tolist():
        wi = MODEL.sample(p, trial.at(mu, 0.4), u1, u2)  # type: ignore[misc]
        assert wi.z > 0.0
        assert MODEL.evaluate(p, wi, trial.at(mu, 0.4)) * wi.z / MODEL.pdf(p, wi, trial.at(mu, 0.4)) < 3.0  # type: ignore[misc]
    trial.assert_normalised(MODEL, p, mu)


def test_the_clipping_is_on_the_right_side() -> None:
    """The printed d is above 0 next to the normal, where its clipping would throw samples below the horizon."""
    printed = (0.540852 - 1.01625 + 0.475392) / (-1.0743 + 0.0725628 + 1.0)
    assert 0.003 < printed < 0.004
    assert clipped(1.0, 1.0).d == clipped(1.0, 0.99992).d == 0.0
    assert clipped(1.0, 0.9999).d < 0.0


def test_shares_are_probabilities() -> None:
    for mu in np.linspace(0.0, 1.0, 50):
        assert 0.03 < uniform_share(Eon(1.0, 1.0), mu) < 0.17


def test_samples_at_the_normal_follow_the_density() -> None:
    """Elsewhere those of the specimens do, as of every model."""
    trial.assert_follows_density(MODEL, SURFACES[0], 1.0, 1)
