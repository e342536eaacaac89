"""Lafortune (neumann1999 eq. 14, and its sums, eq. 16 with p = 0); and what the stretched lobes have in common with it."""

from __future__ import annotations

import math
from collections.abc import Callable
from itertools import pairwise
from typing import Any

import pytest
from scipy.special import beta

from albedo_lab.errors import BadInput
from albedo_lab.model import Model
from albedo_lab.models.lafortune import MODEL, Lafortune, cosine_power, evaluate, lobe_axis, upper_lobe
from albedo_lab.models.phong import MODEL as PHONG
from albedo_lab.models.phong import Phong
from albedo_lab.models.retro_phong import MODEL as RETRO
from albedo_lab.models.stretched_lafortune import MODEL as STRETCHED
from albedo_lab.optics.coordinates import Axis
from albedo_lab.optics.frame import Direction, dot
from tests.models import trial

LOBES = (
    (1.0, 1.0, 1.0, 20.0),
    (-1.0, -1.0, 1.0, 2.5),
    (0.9, 0.5, 1.1, 30.0),
    (0.9, -0.5, 0.2, 5.0),
    (1.0, 1.0, -0.4, 3.0),
    (0.0, 0.0, 1.0, 1.0),
    (1.0, 0.0, 0.0, 4.0),
    (1.0, 1.0, 1.0, 0.0),
)
"""C_x, C_y, C_z, n: mirror, retro, off-specular, saddle, below the horizon, about the normal, in one plane, and a step."""
THREE = {"C_z": 0.8, "C_x_2": -0.9, "C_y_2": -0.7, "n_2": 40.0, "C_2": 0.5, "C_x_3": 0.7, "C_z_3": -1.0, "n_3": 5.0, "C_3": 2.0}
every_lobe = pytest.mark.parametrize("lobe", LOBES, ids=str)
both_models = pytest.mark.parametrize("model", [MODEL, STRETCHED], ids=lambda model: model.name)


def of(model: Model, lobe: tuple[float, ...], **others: float) -> Any:
    """Parameters from C_x, C_y, C_z, n."""
    return model.bind({**dict(zip(("C_x", "C_y", "C_z", "n"), lobe, strict=True)), **others})


def several(model: Model, **values: float) -> tuple[Model, Any]:
    """The member with three lobes, and its parameters."""
    member, rest = model.member({"lobes": 3, **THREE, **values})
    return member, member.bind(rest)


def about_axis(axis: Direction, mu: float, g: Callable[[Direction], float], turns: int = 16) -> float:
    """The integral of g over what lies above the horizon and within a quarter turn of any axis, itself above it or not.

    Along each azimuth it is split at the horizon and where the cosine is mu, the points crowding at both ends of each piece.
    Good to 1e-6, but only to 1e-3 near grazing where g has a kink at mu, as nothing splits the azimuths.
    """
    across = math.hypot(axis.x, axis.y)
    cos_a, sin_a = (axis.x / across, axis.y / across) if across > 0.0 else (1.0, 0.0)
    total = 0.0
    for psi, d_psi in trial.panels(0.0, 2.0 * trial.PI, trial.HALF_PI, turns):
        rise, aside = across * math.cos(psi), math.sin(psi)
        steepest, reach = math.atan2(rise, axis.z), math.hypot(axis.z, rise)  # the cosine is reach cos(alpha - steepest)
        low, high = max(0.0, steepest - trial.HALF_PI), min(trial.HALF_PI, steepest + trial.HALF_PI)
        away = math.acos(mu / reach) if mu < reach else 0.0
        breaks = sorted({low, high, *(x for x in (steepest - away, steepest + away) if low < x < high)})
        for a, b in pairwise(breaks):
            for x, dx in trial.panels(0.0, 1.0, 0.125, 8):
                alpha = a + (b - a) * x * x * (3.0 - 2.0 * x)
                c, s = math.cos(alpha), math.sin(alpha)
                along = across * c - axis.z * s * math.cos(psi)
                z = reach * math.cos(alpha - steepest)
                w = Direction(along * cos_a - s * aside * sin_a, along * sin_a + s * aside * cos_a, z)
                total += g(w) * s * (b - a) * 6.0 * x * (1.0 - x) * dx * d_psi if z > 0.0 else 0.0
    return total


def albedo(model: Model, p: Any, mu: float, phi: float = 0.0) -> float:
    """The directional albedo from the plain formula, each lobe about its own axis."""
    wo = trial.at(mu, phi)
    return math.fsum(
        about_axis(lobe_axis(q, wo), mu, lambda wi, one=one, q=q: one.evaluate(q, wi, wo) * wi.z)  # type: ignore[misc]
        for one, q in (model.parts(p) if model.parts else ((model, p),))
    )


# The formula


@every_lobe
def test_formula(lobe: tuple[float, ...]) -> None:
    """Eq. 14 in angles: R is the light turned by half a turn about the normal."""
    c_x, c_y, c_z, n = lobe
    q = of(MODEL, lobe, C=0.7)
    for light, viewer, turn in trial.GEOMETRIES:
        for phi in (0.0, 1.0, 4.0):
            level, height = math.sin(light) * math.sin(viewer), math.cos(light) * math.cos(viewer)
            x = math.cos(phi + turn + math.pi) * math.cos(phi)
            y = math.sin(phi + turn + math.pi) * math.sin(phi)
            r_v = c_x * level * x + c_y * level * y + c_z * height
            f = evaluate(q, trial.direction(light, phi + turn), trial.direction(viewer, phi))
            assert math.isclose(f, 0.7 * r_v**n if r_v > 1e-15 else 0.0, rel_tol=1e-11, abs_tol=1e-15)


def test_reciprocal() -> None:
    trial.assert_reciprocal(MODEL, *(of(MODEL, lobe) for lobe in LOBES))
    trial.assert_reciprocal(*several(MODEL))


@pytest.mark.parametrize("n", [0.0, 1.0, 20.0, 1000.0])
def test_equal_factors_are_phong_and_its_mirror_image(n: float) -> None:
    """Up to n roundings of R.V, which lies beyond all digits where f is not visible any more."""
    for wi, wo in trial.random_pairs():
        phong = PHONG.evaluate(Phong(n), wi, wo)
        retro = RETRO.evaluate(Phong(n), wi, wo) * max(wi.z, wo.z)
        assert math.isclose(evaluate(of(MODEL, (1.0, 1.0, 1.0, n)), wi, wo), phong, rel_tol=1e-10, abs_tol=1e-30)
        assert math.isclose(evaluate(of(MODEL, (-1.0, -1.0, 1.0, n)), wi, wo), retro, rel_tol=1e-10, abs_tol=1e-30)


@every_lobe
def test_a_lobe_turns_about_its_axis(lobe: tuple[float, ...]) -> None:
    """However anisotropic, it is |M R|^n cos^n of the angle from M R; and above the horizon less than the upper lobe's."""
    q = of(MODEL, lobe)
    for wi, wo in trial.random_pairs(100):
        size = math.sqrt((q.C_x * wo.x) ** 2 + (q.C_y * wo.y) ** 2 + (q.C_z * wo.z) ** 2)
        cosine = dot(lobe_axis(q, wo), wi)
        expected = size**q.n * cosine**q.n if cosine > 1e-12 and size > 0.0 else 0.0
        assert math.isclose(cosine_power(q, wi, wo), expected, rel_tol=1e-9, abs_tol=1e-12)
        axis, bound = upper_lobe(q, wo)
        assert axis.z >= 0.0
        assert cosine_power(q, wi, wo) <= (bound * max(dot(axis, wi), 0.0)) ** q.n * (1 + 1e-12)


def test_a_lobe_that_vanishes_is_finite() -> None:
    """M R = 0: nothing is reflected, not even where n = 0."""
    for n in (0.0, 0.5, 1000.0):
        for q, wo in ((of(MODEL, (0.0, 0.0, 0.0, n)), trial.at(0.5)), (of(MODEL, (0.0, 1.0, 0.0, n)), trial.at(1.0))):
            assert evaluate(q, trial.at(0.3, 1.0), wo) == 0.0
            assert math.isclose(dot(lobe_axis(q, wo), lobe_axis(q, wo)), 1.0)
            wi = MODEL.sample(q, wo, 0.5, 0.5)  # type: ignore[misc]
            assert MODEL.pdf(q, wi, wo) > 0.0  # type: ignore[misc]


# Albedos


@pytest.mark.parametrize("n", [0.0, 1.0, 20.0])
def test_about_the_normal_in_closed_form(n: float) -> None:
    """C_x = C_y = 0 is (N.L N.V)^n: 2 pi mu^n / (n + 2), and for n = 0 Lambert's pi."""
    for mu in (1.0, 0.5, 1e-4, 1e-9):
        trial.assert_close(albedo(MODEL, of(MODEL, (0.0, 0.0, 1.0, n)), mu), 2.0 * math.pi * mu**n / (n + 2.0), 1e-5)


@pytest.mark.parametrize("height", [1.0, 0.3, -1.0])
@pytest.mark.parametrize("n", [0.5, 1.0, 20.0, 1000.0])
def test_grazing_limit_does_not_depend_on_the_height_factor(n: float, height: float) -> None:
    """M R lies in the surface: B((n+1)/2, 3/2), as for Phong."""
    trial.assert_close(albedo(MODEL, of(MODEL, (1.0, 1.0, height, n)), 1e-9), float(beta((n + 1) / 2, 1.5)), 1e-5)


def test_nothing_is_reflected_of_normal_light_below_the_horizon() -> None:
    assert albedo(MODEL, of(MODEL, (1.0, 1.0, -1.0, 3.0)), 1.0) == 0.0


def test_the_sharpest_lobe_reflects_its_peak() -> None:
    """At normal incidence 2 pi / (n + 2) C_z^n."""
    trial.assert_close(albedo(MODEL, of(MODEL, (0.5, 1.4, 0.99, 1000.0)), 1.0), 2.0 * math.pi / 1002.0 * 0.99**1000, 1e-5)


@both_models
def test_albedos_add(model: Model) -> None:
    """The integral of the whole sum, about the normal, is the sum of its lobes', each about its axis."""
    member, p = several(model)
    wo = trial.at(0.6, 0.4)
    whole = trial.over_hemisphere(Axis.NORMAL, wo, lambda wi: member.evaluate(p, wi, wo) * wi.z, turns=24)
    trial.assert_close(whole, albedo(member, p, 0.6, 0.4), 1e-5)


@both_models
def test_albedo_turns_with_the_surface(model: Model) -> None:
    """Swapping C_x and C_y is a quarter turn; mirroring the azimuth is nothing; and the two axes do differ."""
    for mu in (0.7, 0.1):
        along, across = (albedo(model, of(model, (a, b, 0.6, 8.0)), mu, 0.3) for a, b in ((0.9, 0.4), (0.4, 0.9)))
        trial.assert_close(along, albedo(model, of(model, (0.4, 0.9, 0.6, 8.0)), mu, math.pi / 2 - 0.3), 1e-9)
        trial.assert_close(along, albedo(model, of(model, (0.9, 0.4, 0.6, 8.0)), mu, -0.3), 1e-9)
        assert along > 2.0 * across


@both_models
def test_scaling(model: Model) -> None:
    """C scales f, and so does a common factor of C_x, C_y and C_z, to the power of n."""
    once, thrice = of(model, (0.4, 0.2, 0.5, 3.0)), of(model, (0.4, 0.2, 0.5, 3.0), C=3.0)
    large = of(model, (0.8, 0.4, 1.0, 3.0))
    for wi, wo in trial.random_pairs(50):
        f = model.evaluate(once, wi, wo)
        assert math.isclose(model.evaluate(thrice, wi, wo), 3.0 * f, rel_tol=1e-12)
        assert math.isclose(model.evaluate(large, wi, wo), 8.0 * f, rel_tol=1e-12)


# Several lobes


@both_models
def test_a_sum_is_the_sum_of_its_parts(model: Model) -> None:
    member, p = several(model)
    assert member.parts is not None
    parts = member.parts(p)
    assert [one for one, _ in parts] == [model] * 3
    assert [(q.C_x, q.C_z, q.n, q.C) for _, q in parts] == [(1, 0.8, 20, 1), (-0.9, 1, 40, 0.5), (0.7, -1, 5, 2)]
    for wi, wo in trial.random_pairs():
        expected = sum(one.evaluate(q, wi, wo) for one, q in parts)
        assert math.isclose(member.evaluate(p, wi, wo), expected, rel_tol=1e-12)


@both_models
def test_names_of_parameters(model: Model) -> None:
    member, p = several(model)
    own = [q.name for q in model.parameters]
    assert [q.name for q in member.parameters] == [*own, *(f"{name}_{i}" for i in (2, 3) for name in own)]
    assert member.columns(p) == {"lobes": 3} | {q.name: THREE.get(q.name, q.default) for q in member.parameters}
    assert several(model)[1] == p
    assert several(model, n_3=6.0)[1] != p
    assert model.make is not None
    assert model.make(lobes=1) is model
    assert member.summary == model.summary
    assert not any(hasattr(p, unknown) for unknown in ("C_x_4", "C_x_0", "C_x_", "q_2", "_2"))
    with pytest.raises(BadInput):
        model.bind({"C_x_2": 1.0})


@pytest.mark.parametrize("count", [0, 101, 1.5, "x", True])
def test_number_of_lobes(count: object) -> None:
    with pytest.raises(BadInput):
        MODEL.member({"lobes": count})


@both_models
def test_isotropic_when_every_lobe_is(model: Model) -> None:
    same = {f"C_y{i}": THREE.get(f"C_x{i}", 1.0) for i in ("", "_2", "_3")}
    member, p = several(model, **same)
    assert member.isotropic(p)
    assert not member.isotropic(several(model)[1])
    f = [member.evaluate(p, trial.at(0.8, 0.3 + turn), trial.at(0.6, 2.5 + turn)) for turn in (0.0, 1.0)]
    assert math.isclose(*f, rel_tol=1e-12)


@both_models
def test_a_hundred_lobes(model: Model) -> None:
    """As many like lobes are one that is as bright, for the sampler too."""
    member, rest = model.member({"lobes": 100})
    p, q = member.bind(rest), model.bind({"C": 100.0})
    assert member.sample is not None
    assert member.pdf is not None
    assert model.pdf is not None
    wo = trial.at(0.6, 0.4)
    for u1, u2 in ((0.001, 0.3), (0.501, 0.9), (0.999, 0.1)):
        wi = member.sample(p, wo, u1, u2)
        assert math.isclose(member.evaluate(p, wi, wo), model.evaluate(q, wi, wo), rel_tol=1e-12)
        assert math.isclose(member.pdf(p, wi, wo), model.pdf(q, wi, wo), rel_tol=1e-12)


# Samples


def test_samples_follow_the_density() -> None:
    """One lobe above the horizon and one below it; the other model shares all but the energies."""
    member, rest = STRETCHED.member({"lobes": 2, "C_y": 0.7, "C_x_2": 0.7, "C_z_2": -1.0, "n_2": 5.0, "C_2": 2.0})
    trial.assert_follows_density(member, member.bind(rest), 0.3, 1)


@both_models
def test_without_light_the_cosine_is_sampled(model: Model) -> None:
    member, p = several(model, C=0.0, C_2=0.0, C_3=0.0)
    assert member.sample is not None
    assert member.pdf is not None
    wo = trial.at(0.5)
    for u1, u2 in ((0.01, 0.2), (0.5, 0.7), (0.99, 0.4)):
        wi = member.sample(p, wo, u1, u2)
        assert math.isclose(member.pdf(p, wi, wo), wi.z / math.pi, rel_tol=1e-12)
        assert member.evaluate(p, wi, wo) == 0.0


@both_models
@pytest.mark.parametrize("lobe", [*LOBES, (0.9, 0.8, 1.0, 1000.0), (1.0, 0.9, -0.5, 200.0)], ids=str)
@pytest.mark.parametrize("mu", [1.0, 0.5, 0.02, 1e-9])
def test_the_density_of_the_sampler_covers_f(model: Model, lobe: tuple[float, ...], mu: float) -> None:
    """f cos / pdf at random samples is finite, and no larger than the energy that the samples are shared out by allows."""
    q, wo = of(model, lobe), trial.at(mu, 0.4)
    assert model.sample is not None
    assert model.pdf is not None
    for i in range(64):
        wi = model.sample(q, wo, (i + 0.5) / 64, trial.reversed_bits(i, 6))
        if wi.z > 0.0:
            _, bound = upper_lobe(q, wo)
            weight = model.evaluate(q, wi, wo) * wi.z / model.pdf(q, wi, wo)
            assert 0.0 <= weight <= 2.0 * math.pi / (q.n + 1.0) * bound**q.n * (1 + 1e-9)


@both_models
@pytest.mark.parametrize("lobe", LOBES[:6], ids=str)
@pytest.mark.parametrize("mu", [0.8, 0.05])
def test_average_of_weights_is_the_albedo(model: Model, lobe: tuple[float, ...], mu: float) -> None:
    """Over 2^12 Hammersley points, good to 1 % of the albedo, 3 % where half of them are rejected."""
    q = of(model, lobe)
    assert math.isclose(average_of_weights(model, q, mu), albedo(model, q, mu, 0.4), rel_tol=0.01 if mu > 0.5 else 0.03)


@both_models
@pytest.mark.parametrize("mu", [0.8, 0.05])
def test_average_of_weights_of_several_lobes(model: Model, mu: float) -> None:
    member, p = several(model)
    assert math.isclose(average_of_weights(member, p, mu), albedo(member, p, mu, 0.4), rel_tol=0.03)


def average_of_weights(model: Model, p: Any, mu: float) -> float:
    """The estimate of the albedo by 2^12 samples."""
    assert model.sample is not None
    assert model.pdf is not None
    wo, total = trial.at(mu, 0.4), 0.0
    for i in range(1 << 12):
        wi = model.sample(p, wo, (i + 0.5) / (1 << 12), trial.reversed_bits(i, 12))
        total += model.evaluate(p, wi, wo) * wi.z / model.pdf(p, wi, wo) if wi.z > 0.0 else 0.0
    return total / (1 << 12)


def test_lobe_is_the_tuple_of_its_parameters() -> None:
    assert MODEL.bind({}) == Lafortune(1.0, 1.0, 1.0, 20.0, 1.0)
