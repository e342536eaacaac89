"""Plastic (neumann1999 eq. 29, 30): formula, parts, the sampler of a sum, energy balance."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

from albedo_lab.model import Model
from albedo_lab.models.plastic import MODEL, Plain, Refracting, make
from albedo_lab.optics.coordinates import Axis
from tests.models import trial

ONE = make(fresnel="one")
PLAIN = (Plain(0.5, 0.5, 20.0), Plain(0.3, 0.7, 1.0), Plain(0.9, 0.04, 169.0), Plain(0.0, 1.0, 5.0), Plain(1.0, 0.0, 5.0))
MEMBERS = [(ONE, p) for p in PLAIN] + [(MODEL, Refracting(*p, 1.5)) for p in PLAIN] + [(MODEL, Refracting(0.2, 0.8, 10.0, 2.4))]
BLACK = Plain(0.0, 0.0, 20.0)
every_member = pytest.mark.parametrize(("model", "p"), MEMBERS, ids=[str(tuple(p)) for _, p in MEMBERS])
HISTOGRAMS = 4


def glass(eta: float, theta: float) -> float:
    """Unpolarised reflectance by Fresnel's sine and tangent laws."""
    if theta < 1e-9:
        return ((eta - 1) / (eta + 1)) ** 2
    inside = math.asin(math.sin(theta) / eta)
    s = math.sin(theta - inside) / math.sin(theta + inside)
    p = math.tan(theta - inside) / math.tan(theta + inside)
    return 0.5 * (s * s + p * p)


def albedo(model: Model, p: Any, mu: float) -> float:
    """Of both parts, each about its own axis."""
    assert model.parts is not None
    return sum(trial.narrow_albedo(part, values, mu) for part, values in model.parts(p))


def reflectance(p: Any, theta: float) -> float:
    return glass(p.eta, theta) if isinstance(p, Refracting) else 1.0


# Formula


@every_member
def test_formula(model: Model, p: Any) -> None:
    def printed(light: float, viewer: float, turn: float) -> float:
        lobe = trial.mirror_lobe(light, viewer, turn, p.n) / trial.larger_cosine(light, viewer)
        return p.a_d / math.pi + p.a_s * (p.n + 2) / (2 * math.pi) * lobe * reflectance(p, min(light, viewer))

    trial.assert_formula(model, p, printed)


@every_member
def test_reciprocal(model: Model, p: Any) -> None:
    trial.assert_reciprocal(model, p)


@every_member
def test_the_parts_make_the_whole(model: Model, p: Any) -> None:
    assert model.parts is not None
    for wi, wo in trial.random_pairs():
        whole = sum(part.evaluate(values, wi, wo) for part, values in model.parts(p))
        assert whole == pytest.approx(model.evaluate(p, wi, wo), rel=1e-14)


def test_the_index_of_air_leaves_the_body() -> None:
    for wi, wo in trial.random_pairs():
        assert MODEL.evaluate(Refracting(0.5, 1.0, 20.0, 1.0), wi, wo) == pytest.approx(0.5 / math.pi, rel=1e-15)


# Energy


@every_member
def test_normal_incidence(model: Model, p: Any) -> None:
    """The larger cosine is 1 there, so F is that of the normal, and c_n the constant that makes the lobe's albedo 1."""
    trial.assert_close(albedo(model, p, 1.0), p.a_d + p.a_s * reflectance(p, 0.0))


@every_member
def test_grazing_limit(model: Model, p: Any) -> None:
    """Of the lobe (n+2) / (2 (n+1)) is left (eq. 26) where F is 1; a lobe with F is darker, by the light that is bent up."""
    found = albedo(model, p, 1e-9)
    limit = p.a_d + p.a_s * (p.n + 2) / (2 * (p.n + 1))
    if isinstance(p, Plain):
        trial.assert_close(found, limit)
    elif p.a_s > 0.0:
        assert p.a_d < found < limit


@pytest.mark.parametrize("mu", [1.0, 0.5, 0.1])
def test_a_sharp_lobe_is_a_pane_of_glass(mu: float) -> None:
    """Up to the width of the lobe, 1e-4."""
    p = Refracting(0.0, 0.8, 1e8, 1.5)
    trial.assert_close(albedo(MODEL, p, mu), 0.8 * glass(1.5, math.acos(mu)), 1e-3)


@pytest.mark.parametrize("mu", [0.9, 0.5, 0.1, 1e-3])
@pytest.mark.parametrize(("a_s", "n"), [(0.04, 169.0), (0.065, 64.0), (0.09, 9.0), (0.13, 3.0)])
def test_the_spheres_of_figure_9_conserve_energy(a_s: float, n: float, mu: float) -> None:
    """With the brightest body that a_s <= 1 - max(r, g, b) allows; the integral is good to 1e-3 of the lobe's share."""
    assert albedo(ONE, Plain(1.0 - a_s, a_s, n), mu) < 1.0 + 1e-4


def test_at_n_1_the_bound_on_a_s_and_a_d_does_not_conserve_energy() -> None:
    """Section 2.2 says of the lobe that it overshoots there, most at 13 degrees."""
    assert trial.wide_albedo(ONE, Plain(0.0, 1.0, 1.0), math.cos(math.radians(13.0))) > 1.0002


# Sampler


@pytest.mark.parametrize(
    ("model", "p", "mu"),
    [
        (ONE, Plain(0.5, 0.5, 20.0), 0.5),
        (ONE, Plain(0.0, 1.0, 5.0), 0.2),
        (MODEL, Refracting(0.5, 0.5, 20.0, 1.5), 0.05),
        (MODEL, Refracting(0.02, 1.0, 100.0, 1.5), 0.5),
        (MODEL, Refracting(1.0, 0.0, 5.0, 1.5), 0.3),
    ],
    ids=["half", "lobe", "grazing", "narrow", "body"],
)
def test_the_density_is_normalised(model: Model, p: Any, mu: float) -> None:
    """About the normal, since the body fills the hemisphere; the sampler's points know the rejected share to 3e-3."""
    assert model.sample is not None
    assert model.pdf is not None
    integral = trial.accepted_by_density(model.pdf, Axis.NORMAL, p, mu)
    assert integral == pytest.approx(trial.accepted_by_sampler(model.sample, p, mu), abs=4e-3)


@pytest.mark.parametrize(
    ("model", "p", "mu"),
    [
        (ONE, Plain(0.3, 0.7, 5.0), 0.5),
        (ONE, Plain(0.0, 1.0, 5.0), 0.2),
        (MODEL, Refracting(0.1, 0.9, 20.0, 1.5), 0.2),
        (MODEL, Refracting(1.0, 0.0, 5.0, 1.5), 0.5),
    ],
    ids=["both", "lobe", "grazing", "body"],
)
def test_samples_follow_the_density(model: Model, p: Any, mu: float) -> None:
    trial.assert_follows_density(model, p, mu, HISTOGRAMS)


@every_member
def test_no_sample_weighs_more_than_the_whole(model: Model, p: Any) -> None:
    """F falls with the cosine, so f cos <= (n+2)/(n+1) (a_d + a_s F(mu)) pdf: no rare sample carries the sum."""
    assert model.sample is not None
    assert model.pdf is not None
    rng = np.random.default_rng(6)
    for mu in (1.0, 0.5, 0.01, 1e-9):
        wo = trial.at(mu, 0.4)
        most = (p.n + 2) / (p.n + 1) * (p.a_d + p.a_s * reflectance(p, math.acos(mu)))
        for u1, u2 in rng.random((200, 2)).tolist():
            wi = model.sample(p, wo, u1, u2)
            if wi.z > 0.0:
                assert 0.0 < model.evaluate(p, wi, wo) * wi.z <= most * model.pdf(p, wi, wo) * (1 + 1e-9)


def test_black_plastic_can_be_sampled() -> None:
    """Nothing is reflected; the sampler still yields directions, and its density is theirs."""
    assert ONE.sample is not None
    assert ONE.pdf is not None
    wo = trial.at(0.5)
    for u1, u2 in np.random.default_rng(7).random((20, 2)).tolist():
        wi = ONE.sample(BLACK, wo, u1, u2)
        assert wi.z > 0.0
        assert ONE.pdf(BLACK, wi, wo) == pytest.approx(wi.z / math.pi)
        assert ONE.evaluate(BLACK, wi, wo) == 0.0


def test_a_density_with_another_share_is_caught() -> None:
    """Negative control: the shares that a_d and a_s alone would give, without F."""
    p, other = Refracting(0.3, 0.7, 5.0, 1.5), Plain(0.3, 0.7, 5.0)
    assert MODEL.sample is not None
    assert ONE.pdf is not None
    assert trial.histogram_p_value(MODEL.sample, lambda _, wi, wo: ONE.pdf(other, wi, wo), p, 0.5) < 1e-9  # type: ignore[misc]
