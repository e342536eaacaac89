"""Compensated GGX: its table of albedos, the formula given that, albedos of 1, and what Turquin's form costs in reciprocity."""

from __future__ import annotations

import math
from itertools import product

import numpy as np
import pytest

from albedo_lab.estimate.methods import estimate
from albedo_lab.estimate.record import Question, Tolerance
from albedo_lab.models import ggx
from albedo_lab.models.ggx_multiscatter import LOST, MODEL, mean_of_lost
from albedo_lab.tables import table
from tests.models import trial
from tests.models.trial import PI, member
from tests.oracles import catalogue_albedo as oracle

MASKINGS = tuple(LOST)
ALPHAS = (1e-4, 0.003, 0.05, 0.4, 0.8, 1.0)
BOTH = [{"form": "kulla_conty"}, {"form": "turquin"}]


def albedo(values, mu, order="wi", tolerance=1e-9):
    return estimate(Question(*member(MODEL, values), mu, 0.0, order), Tolerance(tolerance, tolerance), "quadrature", 0, 1)


# The table


@pytest.mark.parametrize("G", MASKINGS)
def test_the_table_against_the_oracle(G: str) -> None:
    """Between the nodes, where the boundary layer is and far beyond it; and never a gain."""
    rng = np.random.default_rng(4)
    for alpha in ALPHAS:
        p = MODEL.member({"G": G})[0].bind({"alpha": alpha})
        for mu in (1.0, 1e-3 * alpha, *(alpha / rng.random(3) - alpha + 1e-6 * alpha).clip(0.0, 1.0).tolist()):
            value, error = oracle.albedo("ggx", {"G": G, "F": "one", "alpha_x": alpha, "alpha_y": alpha}, mu, effort=1)
            assert abs(1 - LOST[G](p, mu) - value) <= 5e-8 + error, (alpha, mu)
        assert all(LOST[G](p, mu) > 0.0 for mu in np.geomspace(1e-15, 1.0, 60).tolist())


@pytest.mark.parametrize("G", MASKINGS)
def test_between_the_nodes_quadrature_says_the_same(G: str) -> None:
    """At as many places as it has nodes, each in the middle of two: 5e-8 of E, at an alpha per decade."""
    for alpha in (1e-4, 1e-3, 1e-2, 0.1, 0.5, 1.0):
        p = MODEL.member({"G": G})[0].bind({"alpha": alpha})
        white, q = ggx.make(G=G, F="one", sampling="caps"), ggx.GGX(alpha, alpha)
        for s in np.sin(0.5 * PI * np.arange(1, 32) / 32) ** 2:
            mu = float(alpha * s / (1.0 + alpha - s))
            found = estimate(Question(white, q, mu), Tolerance(1e-8), "quadrature", 0, 1)
            assert abs(1 - found.value - LOST[G](p, mu)) < 5e-8


def test_closed_forms() -> None:
    """alpha = 1: 1 - E is 1 - 2 (1 - log 2) / (1 + mu), or mu log(1 + 1/mu); for a small alpha alpha^2 (1 + 1/mu^2) / 2."""
    for mu in (1.0, 0.3, 1e-3, 1e-9):
        exact = {"smith": 1 - 2 * (1 - math.log(2)) / (1 + mu), "smith_correlated": mu * math.log1p(1 / mu)}
        for G in MASKINGS:
            p = MODEL.member({"G": G})[0].bind({"alpha": 1.0})
            assert math.isclose(LOST[G](p, mu), exact[G], rel_tol=1e-9)
            small = MODEL.member({"G": G})[0].bind({"alpha": 1e-4})
            if mu >= 0.3:
                assert math.isclose(LOST[G](small, mu), 0.5e-8 * (1 + 1 / mu**2), rel_tol=2e-3)
    assert math.isclose(mean_of_lost(1.0, "smith"), 1 - 4 * (1 - math.log(2)) ** 2, rel_tol=1e-9)
    # 2 int mu^2 log(1 + 1/mu) dmu, by parts
    assert math.isclose(mean_of_lost(1.0, "smith_correlated"), 2 / 3 * (2 * math.log(2) - 0.5), rel_tol=1e-9)


# The formula


@pytest.mark.parametrize(("G", "words", "F0"), [*product(MASKINGS, BOTH, (None, 0.3))])
def test_formula(G: str, words: dict[str, str], F0: float | None) -> None:
    """In angles, with E as it is tabulated."""
    colour = {"F": "one"} if F0 is None else {"F": "schlick", "F0": F0}
    model, p = member(MODEL, {**words, **colour, "G": G, "alpha": 0.4})
    alpha, f0 = 0.4, 1.0 if F0 is None else F0
    lost_mean = mean_of_lost(alpha, G)
    f = f0 + (1 - f0) / 21
    share = f * f * (1 - lost_mean) / (1 - f * lost_mean)

    def formula(light: float, viewer: float, turn: float) -> float:
        l_v = math.cos(light) * math.cos(viewer) + math.sin(light) * math.sin(viewer) * math.cos(turn)
        t, u = trial.half_cosine(light, viewer, turn), math.sqrt(0.5 + 0.5 * l_v)
        D = alpha**2 / (PI * (t * t * (alpha**2 - 1) + 1) ** 2)
        hidden = [(math.sqrt(1 + (alpha * math.tan(theta)) ** 2) - 1) / 2 for theta in (light, viewer)]
        shade = 1 + sum(hidden) if G == "smith_correlated" else (1 + hidden[0]) * (1 + hidden[1])
        once = (f0 + (1 - f0) * (1 - u) ** 5) * D / shade / (4 * math.cos(light) * math.cos(viewer))
        E_i, E_o = (1 - LOST[G](p, math.cos(theta)) for theta in (light, viewer))
        if words["form"] == "turquin":
            return once * (1 + f0 * (1 - E_o) / E_o)
        return once + share * (1 - E_i) * (1 - E_o) / (PI * lost_mean)

    trial.assert_formula(model, p, formula)


# Energy, and the price


@pytest.mark.parametrize("words", [BOTH[0], *(pytest.param(words, marks=pytest.mark.slow) for words in BOTH[1:])])
def test_white_facets_give_everything_back(words: dict[str, str]) -> None:
    """For every viewer, up to what the table leaves."""
    for alpha, mu in product(ALPHAS, (1.0, 0.6, 0.1, 1e-3, 1e-9)):
        found = albedo({**words, "alpha": alpha}, mu)
        assert abs(found.value - 1.0) <= found.half_width + 5e-8, (alpha, mu)


def test_the_price_of_turquins_form() -> None:
    """alpha = 1, correlated: f(wi, wo) / f(wo, wi) = E(wi) / E(wo), up to 1 / (1 - log 2) = 3.26. Of grazing light
    f = 1 / (2 pi (mu_i + mu_o)) makes int dmu / E(mu), 2.2 times what fell in."""
    model, p = member(MODEL, {"form": "turquin", "alpha": 1.0})
    normal, grazing = trial.at(1.0), trial.at(1e-9)
    ratio = model.evaluate(p, grazing, normal) / model.evaluate(p, normal, grazing)
    assert math.isclose(ratio, 1 / (1 - math.log(2)), rel_tol=1e-6)
    x, w = trial.gauss_legendre(60)
    expected = sum(b / (1 - a * math.log1p(1 / a)) for a, b in zip(x, w, strict=True))
    assert math.isclose(albedo({"form": "turquin", "alpha": 1.0}, 1e-9, "wo").value, expected, rel_tol=1e-5)
    assert math.isclose(expected, 2.2002, rel_tol=1e-4)


def test_a_table_that_is_off_is_caught() -> None:
    """A coefficient by a ten-thousandth."""
    p = MODEL.bind({"alpha": 0.4})
    bent = np.array(p.P)
    bent[3] += 1e-4
    lost = LOST["smith_correlated"]
    assert abs(lost(p._replace(P=table(bent)), 0.3) - lost(p, 0.3)) > 1e-6


def test_weight() -> None:
    """Turquin's form has one, that of the facets times the factor."""
    for F in ("one", "schlick"):
        model = MODEL.member({"form": "turquin", "F": F})[0]
        trial.assert_weight_is_contract(model, model.bind({"alpha": 0.4}), model.bind({"alpha": 1e-3}))
