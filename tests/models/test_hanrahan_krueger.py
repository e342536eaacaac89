"""Hanrahan-Krueger: the single scattering of a layer behind a smooth surface, its limits, and what it does with the energy."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.integrate import quad

from albedo_lab.models.hanrahan_krueger import MODEL, HanrahanKrueger
from albedo_lab.models.lommel_seeliger import MODEL as LOMMEL_SEELIGER
from albedo_lab.models.lommel_seeliger import LommelSeeliger
from tests.models import trial

SKIN, MIST = HanrahanKrueger(0.8, 0.7, 0.5, 1.37), HanrahanKrueger(1.0, -0.8, 2.0, 1.0)
PAINT = HanrahanKrueger(0.95, 0.0, 1000.0, 1.5)


def transmittance(eta: float, theta: float) -> float:
    """1 - R of a dielectric, by Fresnel's angles."""
    inside = math.asin(math.sin(theta) / eta)
    if eta == 1.0:
        return 1.0
    if theta < 1e-6:
        return 1 - ((eta - 1) / (eta + 1)) ** 2
    s = (math.sin(theta - inside) / math.sin(theta + inside)) ** 2
    p = (math.tan(theta - inside) / math.tan(theta + inside)) ** 2
    return 1 - (s + p) / 2


@pytest.mark.parametrize("p", [SKIN, MIST, PAINT])
def test_formula(p: HanrahanKrueger) -> None:
    """Snell's angles inside; W p / (cos + cos') (1 - e^..), T12 T21, and n^-2 of the solid angles."""

    def law(light: float, viewer: float, turn: float) -> float:
        i, r = (math.asin(math.sin(theta) / p.eta) for theta in (light, viewer))
        cosine = -(math.cos(i) * math.cos(r) + math.sin(i) * math.sin(r) * math.cos(turn))
        phase = (1 - p.g**2) / (4 * math.pi * (1 + p.g**2 - 2 * p.g * cosine) ** 1.5)
        depth = 1 - math.exp(-p.tau * (1 / math.cos(i) + 1 / math.cos(r)))
        through = transmittance(p.eta, light) * transmittance(p.eta, viewer) / p.eta**2
        return p.w * through * phase / (math.cos(i) + math.cos(r)) * depth

    trial.assert_formula(MODEL, p, law)
    trial.assert_reciprocal(MODEL, p)


def test_deep_isotropic_and_without_a_surface_it_is_lommel_seeligers() -> None:
    p = HanrahanKrueger(0.6, 0.0, 1000.0, 1.0)
    for wi, wo in trial.random_pairs():
        assert math.isclose(MODEL.evaluate(p, wi, wo), LOMMEL_SEELIGER.evaluate(LommelSeeliger(0.6), wi, wo), rel_tol=1e-12)
        assert MODEL.mirror(p, wo.z) == 0.0


def test_a_thin_layer_scatters_its_depth() -> None:
    """tau (1/cos + 1/cos') / (cos + cos') = tau / (cos cos')."""
    p = HanrahanKrueger(0.6, 0.0, 1e-12, 1.0)
    for wi, wo in ((trial.at(0.5), trial.at(0.8, 1.0)), (trial.at(1e-3), trial.at(0.2, 3.0))):
        assert math.isclose(MODEL.evaluate(p, wi, wo), 0.6e-12 / (4 * math.pi * wi.z * wo.z), rel_tol=1e-8)


@pytest.mark.parametrize("mu", [1.0, 0.4, 1e-3])
def test_energy_is_split(mu: float) -> None:
    """Mirrored, scattered out, or neither: what isotropic scattering sends through the surface is a plain integral inside."""
    eta, theta = PAINT.eta, math.acos(mu)
    inside = math.cos(math.asin(math.sin(theta) / eta))
    critical = math.sqrt(1 - 1 / eta**2)

    def leaving(z: float) -> float:
        return z / (z + inside) * transmittance(eta, math.asin(min(1.0, eta * math.sqrt(1 - z * z))))

    scattered = transmittance(eta, theta) * PAINT.w / 2 * quad(leaving, critical, 1, epsabs=1e-10)[0]
    trial.assert_close(trial.wide_albedo(MODEL, PAINT, mu), scattered, 1e-5)
    assert MODEL.mirror(PAINT, mu) == pytest.approx(1 - transmittance(eta, theta), rel=1e-9)
    assert MODEL.mirror(PAINT, mu) + scattered < 1


@pytest.mark.parametrize("g", [-0.9, 0.9])
@pytest.mark.parametrize("mu", [0.3, 1e-3])
def test_samples_are_where_the_light_is(g: float, mu: float) -> None:
    """The largest weight measured is 3.4 means; with the lobe on the other side it would be 35 and more."""
    p, wo = HanrahanKrueger(1.0, g, 1000.0, 1.0), trial.at(mu, 0.3)
    weights = []
    for u1, u2 in np.random.default_rng(6).random((2000, 2)).tolist():
        wi = MODEL.sample(p, wo, u1, u2)  # type: ignore[misc]
        weights.append(MODEL.evaluate(p, wi, wo) * wi.z / MODEL.pdf(p, wi, wo))  # type: ignore[misc]
    assert max(weights) < 5 * float(np.mean(weights))


@pytest.mark.parametrize("p", [SKIN, MIST, PAINT])
def test_the_density_is_whole(p: HanrahanKrueger) -> None:
    trial.assert_normalised(MODEL, p, 0.1)
