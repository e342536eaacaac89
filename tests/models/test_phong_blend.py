"""Phong blend (schlick1993 eq. 4), normalised and as printed."""

from __future__ import annotations

import math
from itertools import pairwise
from typing import Any

import pytest

from albedo_lab.model import Model
from albedo_lab.models.phong_blend import MODEL, PhongBlend, largest_constant, make
from albedo_lab.papers.neumann1999.tables import TABLE_2
from albedo_lab.papers.verdict import Printed
from tests.models import trial

PRINTED = make(as_printed="yes")
VALUES: tuple[dict[str, float], ...] = (
    {"d": 0.5, "D": 1.0, "S": 1.0, "n": 20.0},
    {"d": 0.3, "D": 0.8, "S": 0.4, "n": 2.5},
    {"d": 0.9, "D": 0.2, "S": 1.0, "n": 1.0},
)
PURE: tuple[dict[str, float], ...] = ({"d": 0.0}, {"d": 1.0}, {"D": 0.0}, {"S": 0.0}, {"D": 0.0, "S": 0.0})
every_blend = pytest.mark.parametrize("values", VALUES)
both_members = pytest.mark.parametrize("model", [MODEL, PRINTED], ids=["normalised", "printed"])


@every_blend
def test_printed_formula(values: dict[str, float]) -> None:
    def printed(light: float, viewer: float, turn: float) -> float:
        d, D, S, n = values.values()
        return d * D + (1 - d) * S * trial.half_cosine(light, viewer, turn) ** n

    trial.assert_formula(PRINTED, PRINTED.bind(values), printed)


@every_blend
def test_normalised_formula(values: dict[str, float]) -> None:
    def normalised(light: float, viewer: float, turn: float) -> float:
        d, D, S, n = values.values()
        constant = (n + 2) * (n + 4) / (8 * math.pi * (2 ** (-n / 2) + n))
        return d * D / math.pi + (1 - d) * S * constant * trial.half_cosine(light, viewer, turn) ** n

    trial.assert_formula(MODEL, MODEL.bind(values), normalised)


@both_members
def test_reciprocal(model: Model) -> None:
    trial.assert_reciprocal(model, *map(model.bind, VALUES))


@both_members
def test_the_parts_are_the_whole(model: Model) -> None:
    assert model.parts is not None
    p = model.bind(VALUES[1])
    for wi, wo in trial.random_pairs():
        whole = sum(part.evaluate(q, wi, wo) for part, q in model.parts(p))
        assert math.isclose(model.evaluate(p, wi, wo), whole, rel_tol=1e-15)


# The constant


def test_the_constant_is_table_2_of_neumann1999() -> None:
    """To a unit of the last printed digit: n = 128 is 5.334, printed 5.34."""
    for line in TABLE_2.strip().split("\n")[1:]:
        n, text, _ = line.split()
        printed = Printed(text)
        assert abs(largest_constant(float(n)) - printed.value) <= printed.unit


@pytest.mark.parametrize("n", [1.0, 2.5, 20.0, 1e4])
def test_the_lobe_is_white_at_normal_incidence(n: float) -> None:
    """With x = cos(theta/2): 8 pi times the integral of x^(n+1) (2 x^2 - 1) from sqrt(1/2) to 1."""
    trial.assert_close(trial.narrow_albedo(MODEL, MODEL.bind({"d": 0.0, "n": n}), 1.0), 1.0)


@pytest.mark.parametrize("n", [1.0, 2.0, 5.0, 100.0])
def test_the_lobe_is_nowhere_brighter_than_at_normal_incidence(n: float) -> None:
    """A walk of angles; the plain integrals are good to 1e-5 here."""
    p = MODEL.bind({"d": 0.0, "n": n})
    albedos = [trial.narrow_albedo(MODEL, p, mu) for mu in (1.0, 0.999, 0.99, 0.95, 0.8, 0.6, 0.4, 0.2, 0.05, 1e-6)]
    assert all(later <= earlier + 1e-5 for earlier, later in pairwise(albedos))
    assert albedos[0] <= 1.0 + 1e-5


# Albedos


@pytest.mark.parametrize("n", [1.0, 20.0, 1e4])
def test_the_shares_are_albedos_at_normal_incidence(n: float) -> None:
    p = MODEL.bind({"d": 0.3, "D": 0.8, "S": 0.4, "n": n})
    trial.assert_close(trial.narrow_albedo(MODEL, p, 1.0), 0.3 * 0.8 + 0.7 * 0.4)


def test_the_printed_model_is_brighter_than_the_light() -> None:
    """A diffuse reflector of share 1 has the albedo pi, a specular one 8 pi (2^(-n/2) + n) / ((n+2) (n+4)): above 1 to n = 18."""
    diffuse, lobe = ({"d": 1.0}, {"d": 0.0, "n": 1.0})
    trial.assert_close(trial.wide_albedo(PRINTED, PRINTED.bind(diffuse), 0.5), math.pi)
    trial.assert_close(trial.narrow_albedo(PRINTED, PRINTED.bind(lobe), 1.0), 8 * math.pi * (1 + math.sqrt(0.5)) / 15)
    assert 1 / largest_constant(18.0) > 1 > 1 / largest_constant(19.0)


# Sampler


def test_black_and_pure_surfaces_have_one_branch() -> None:
    branches = [MODEL.bind(values).branch for values in PURE]
    assert branches == [1.0, 0.0, 1.0, 0.0, 0.0]


@pytest.mark.parametrize("values", [*VALUES, *PURE])
@pytest.mark.parametrize("mu", [1.0, 0.5, 1e-4])
def test_density_integrates_to_one_less_the_rejected_share(values: dict[str, float], mu: float) -> None:
    """Of one member: both have the same sampler, and only their shares differ."""
    trial.assert_normalised(MODEL, MODEL.bind(values), mu)


@pytest.mark.parametrize(("values", "mu"), [(VALUES[0], 0.2), (VALUES[1], 0.8), ({"d": 0.0, "n": 5.0}, 0.5)])
def test_samples_follow_the_density(values: dict[str, float], mu: float) -> None:
    trial.assert_follows_density(MODEL, MODEL.bind(values), mu, 3)


def heaviest_weight(model: Model, p: Any) -> float:
    heaviest = 0.0
    for mu in (1.0, 0.3, 1e-9):
        wo = trial.at(mu)
        for u1 in (2.0**-50, 1e-9, 0.2, p.branch, min(p.branch + 1e-17, 1 - 2.0**-53), 0.7, 1 - 2.0**-33):
            for u2 in (0.0, 0.2, 0.5):
                wi = model.sample(p, wo, min(max(u1, 2.0**-50), 1 - 2.0**-53), u2)
                assert math.isclose(wi.x**2 + wi.y**2 + wi.z**2, 1.0, rel_tol=1e-12)
                if wi.z > 0.0:
                    heaviest = max(heaviest, model.evaluate(p, wi, wo) * wi.z / model.pdf(p, wi, wo))
    return heaviest


@both_members
@pytest.mark.parametrize("n", [1.0, 100.0, 1e8])
@pytest.mark.parametrize("values", [*PURE, {"d": 0.5}, {"d": 1e-300}, {"d": 1e-12}, {"d": 1 - 1e-16}, {"S": 1e-300}])
def test_weights_are_bounded(model: Model, values: dict[str, float], n: float) -> None:
    """By the albedo at normal incidence, which the branches share, times (n+2) (n+4) / ((n+1) (n + 2^(-n/2))) <= 4.4."""
    p: PhongBlend = model.bind({**values, "n": n})
    albedo = math.pi * p.diffuse + p.specular / largest_constant(n)
    assert heaviest_weight(model, p) <= 4.4 * albedo * (1 + 1e-9)


def test_members() -> None:
    assert MODEL is make(as_printed="no")
    assert MODEL.member({"as_printed": "yes"}) == (PRINTED, {})
    p = MODEL.bind({"d": 0.25})
    assert MODEL.columns(p) == {"as_printed": "no", "d": 0.25, "D": 1.0, "S": 1.0, "n": 100.0}
