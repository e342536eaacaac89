"""Metal (neumann1999 eq. 27, 28): formula, table, named metals."""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from albedo_lab.errors import BadInput
from albedo_lab.model import Model
from albedo_lab.models import phong, stretched_phong
from albedo_lab.models.metal import (
    ANGLES,
    CELLS,
    MODEL,
    Custom,
    CustomTable,
    g,
    half_vector,
    make,
    reciprocal_reflectance,
    theta_min,
)
from albedo_lab.optics.frame import mirror_of
from albedo_lab.optics.fresnel import conductor
from albedo_lab.optics.metals import METALS, index
from tests.models import trial

EXACT = {"half_vector": half_vector, "theta_min": theta_min}
SURFACES = (Custom(0.0, 0.79, 5.85), Custom(2.5, 1.47, 1.95), Custom(20.0, 0.05, 3.6), Custom(1.0, 1.5, 0.0))
every_surface = pytest.mark.parametrize("p", SURFACES)
every_angle = pytest.mark.parametrize("angle", ANGLES)


def fresnel(index: complex, cosine: float) -> float:
    """Unpolarised reflectance by Snell's law, in complex numbers."""
    inside = cmath.sqrt(1 - (1 - cosine**2) / index**2)
    s = (cosine - index * inside) / (cosine + index * inside)
    p = (index * cosine - inside) / (index * cosine + inside)
    return 0.5 * (abs(s) ** 2 + abs(p) ** 2)


def half_vector_angle(light: float, viewer: float, turn: float) -> float:
    """Half the angle between both directions."""
    l_v = math.cos(light) * math.cos(viewer) + math.sin(light) * math.sin(viewer) * math.cos(turn)
    return 0.5 * math.acos(min(l_v, 1.0))


def with_table(p: Custom) -> CustomTable:
    return CustomTable(p.n, p.eta, p.k, reciprocal_reflectance(p.eta, p.k))


# Formula


@every_surface
@pytest.mark.parametrize("angle", EXACT)
def test_formula(p: Custom, angle: str) -> None:
    def printed(light: float, viewer: float, turn: float) -> float:
        theta = half_vector_angle(light, viewer, turn) if angle == "half_vector" else min(light, viewer)
        lobe = trial.mirror_lobe(light, viewer, turn, p.n) / trial.larger_cosine(light, viewer)
        return lobe * fresnel(complex(p.eta, p.k), math.cos(theta))

    trial.assert_formula(make(metal="custom", angle=angle), p, printed)


@every_angle
def test_reciprocal(angle: str) -> None:
    surfaces = [with_table(p) if angle == "tabulated" else p for p in SURFACES[:3]]
    trial.assert_reciprocal(make(metal="custom", angle=angle), *surfaces)


@every_surface
def test_both_angles_are_the_same_in_the_mirror_direction(p: Custom) -> None:
    for _, wo in trial.random_pairs():
        assert half_vector(p, mirror_of(wo), wo) == pytest.approx(theta_min(p, mirror_of(wo), wo), rel=1e-12)


def test_where_the_two_angles_differ_most() -> None:
    """Section 5.1: Theta_min is the smaller one, by 45 degrees at most, where the light is perpendicular and the viewer grazing.

    By that much at most it is; but towards the light it is the larger one, by as much within the lobe (R.V > 0), by 90 without.
    """
    above, below, behind = 0.0, 0.0, 0.0
    for light, viewer, turn in np.random.default_rng(5).random((4000, 3)).tolist():
        geometry = light * trial.HALF_PI, viewer * trial.HALF_PI, turn * trial.PI
        difference = math.degrees(half_vector_angle(*geometry) - min(geometry[:2]))
        above = max(above, difference)
        if trial.mirror_cosine(*geometry) > 0.0:
            below = min(below, difference)
        behind = min(behind, difference)
    assert above <= 45.0
    assert math.degrees(half_vector_angle(0.0, trial.HALF_PI, 0.0)) == pytest.approx(45.0)
    assert -45.0 <= below < -35.0
    assert behind < -70.0
    p, toward = Custom(1.0, 1.47, 1.95), trial.direction(math.radians(40.0))
    assert half_vector(p, toward, toward) < theta_min(p, toward, toward)


@pytest.mark.parametrize("model", [make(metal="custom", angle=angle) for angle in EXACT], ids=EXACT)
@pytest.mark.parametrize("mu", [1.0, 0.5, 0.1])
def test_a_sharp_lobe_reflects_as_a_mirror_of_the_metal_does(model: Model, mu: float) -> None:
    """Up to the width of the lobe, 1e-4."""
    p = Custom(1e8, 1.47, 1.95)
    albedo = phong.largest_constant(p) * trial.narrow_albedo(model, p, mu)  # type: ignore[arg-type]
    trial.assert_close(albedo, fresnel(complex(p.eta, p.k), mu), 1e-3)


@every_surface
@pytest.mark.parametrize("evaluate", EXACT.values(), ids=EXACT)
def test_no_brighter_than_the_lobe_of_a_perfect_reflector(p: Custom, evaluate: Callable[..., float]) -> None:
    """So it conserves energy wherever the stretched Phong model does."""
    perfect = phong.Phong(p.n)
    trial.assert_between(
        lambda wi, wo: 0.0, lambda wi, wo: evaluate(p, wi, wo), lambda wi, wo: stretched_phong.evaluate(perfect, wi, wo)
    )


def test_samples_are_those_of_phong() -> None:
    assert (MODEL.sample, MODEL.pdf) == (phong.sample, phong.pdf)


# The table of eq. 28


def table_error(eta: float, k: float) -> float:
    """The largest relative error of the highlight, within every cell and near its ends."""
    p = with_table(Custom(1.0, eta, k))
    places = [(i + part) / CELLS for i in range(CELLS) for part in (1e-6, 0.1, 0.3, 0.5, 0.8)]
    return max(abs(x * x / g(p, x * x) / conductor(eta, k, x * x) - 1) for x in places)


@pytest.mark.parametrize("metal", METALS)
def test_the_table_is_right_to_2_millionths_for_metals(metal: str) -> None:
    worst = max(table_error(*index(metal, float(wavelength))) for wavelength in (380, 460, 540, 620, 700, 780))
    assert 2e-8 < worst < 2e-6


@pytest.mark.parametrize(
    ("eta", "k"), [(0.01, 0.1), (0.1, 0.1), (1.0, 0.1), (1.0, 20.0), (10.0, 0.1), (10.0, 20.0), (0.01, 20.0)]
)
def test_the_table_is_right_to_a_thousandth_over_the_domain(eta: float, k: float) -> None:
    assert table_error(eta, k) < 1e-3


def test_a_table_of_g_itself_would_be_wrong_at_grazing_angles() -> None:
    """Linear from g(90 deg) = 0, as many cells over the cosine; aluminium at 780 nm. There F is 1 and g is the cosine."""
    first = 1.0 / CELLS
    slope = 1.0 / conductor(*index("aluminium", 780.0), first)
    assert 0.003 < abs(1.0 / slope - 1.0) < 0.006


@pytest.mark.parametrize("p", [p for p in SURFACES if p.k > 0.0])
def test_the_table_stands_for_the_exact_formula(p: Custom) -> None:
    tabulated = make(metal="custom", angle="tabulated").evaluate
    for wi, wo in trial.random_pairs():
        assert tabulated(with_table(p), wi, wo) == pytest.approx(theta_min(p, wi, wo), rel=2e-6)
    grazing = trial.at(1e-12)
    assert tabulated(with_table(p), mirror_of(grazing), grazing) == pytest.approx(1e12, rel=2e-6)


# The family


@every_angle
@pytest.mark.parametrize("metal", METALS)
def test_a_named_metal_has_the_index_of_its_wavelength(metal: str, angle: str) -> None:
    named, rest = MODEL.member({"metal": metal, "angle": angle, "n": 20.0, "wavelength": 520.0})
    p = named.bind(rest)
    assert (p.eta, p.k) == index(metal, 520.0)
    assert named.columns(p) == {"metal": metal, "angle": angle, "n": 20.0, "wavelength": 520.0}
    custom, rest = MODEL.member({"angle": angle, "n": 20.0, "eta": p.eta, "k": p.k})
    for wi, wo in trial.random_pairs(20):
        assert named.evaluate(p, wi, wo) == custom.evaluate(custom.bind(rest), wi, wo)


def test_members_and_tables_are_made_once() -> None:
    gold, rest = MODEL.member({"metal": "gold", "angle": "tabulated"})
    assert MODEL.member({"angle": "tabulated", "metal": "gold"})[0] is gold
    assert gold.bind(rest) == gold.bind(rest)


def test_the_constant_is_that_of_the_lobe() -> None:
    p: Any = MODEL.bind({"n": 20.0})
    assert callable(MODEL.scale)
    assert MODEL.scale(p) == pytest.approx(11 / math.pi)


@pytest.mark.parametrize(
    ("values", "message"),
    [
        ({"metal": "tin"}, "metal = 'tin': must be one of custom, gold, silver, copper, aluminium"),
        ({"metal": "gold", "eta": 1.0}, "eta = 1.0: .*no such parameter"),
        ({"metal": "gold", "wavelength": 0.55}, r"wavelength = 0.55: must be a number in \[380, 780\]"),
        ({"wavelength": 550.0}, "wavelength = 550.0: .*no such parameter"),
        ({"angle": "tabulated", "k": 0.0}, r"k = 0.0: must be a number in \[0.1, 20\]"),
    ],
)
def test_bad_input(values: dict[str, Any], message: str) -> None:
    with pytest.raises(BadInput, match=message):
        trial.member(MODEL, values)
