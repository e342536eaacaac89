"""Schlick's customizable model (schlick1993 eq. 9 to 18): all 32 members, their limits, and what becomes of energy balance."""

from __future__ import annotations

import math
from itertools import product
from typing import Any

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.special import ellipkm1

from albedo_lab.model import Model
from albedo_lab.models.schlick import CHOICES, MODEL, make
from albedo_lab.models.schlick_isotropic import MODEL as ISOTROPIC
from albedo_lab.optics.coordinates import Axis
from albedo_lab.optics.frame import Direction, bisector, dot, length, mirror_of
from tests.models import trial

PI = math.pi
EQUATIONS = ("eq12", "eq15", "eq17", "eq18")
every_equation = pytest.mark.parametrize("equation", EQUATIONS)
every_member = pytest.mark.parametrize("words", list(product(*(choice.options for choice in CHOICES))), ids="-".join)
BRUSHED = {"C": 0.3, "r": 0.1, "p": 0.05}
TWO_LAYERS = {"C": 0.2, "r": 0.01, "p": 0.5, "C_2": 0.8, "r_2": 0.4, "p_2": 0.1}


def member(equation: str = "eq15", layers: str = "single", spectral: str = "constant", as_printed: str = "no") -> Model:
    return make(layers=layers, spectral=spectral, directional=equation, as_printed=as_printed)


def sets(model: Model) -> list[Any]:
    """The ends of the domain and what lies between."""
    if model.chosen["layers"] == "double":
        return [model.bind(TWO_LAYERS), model.bind({"r": 1e-6, "p": 1e-3, "r_2": 1.0}), model.bind({"r": 1.0, "p_2": 1e-3})]
    return [model.bind(values) for values in (BRUSHED, {"r": 1e-6, "p": 1e-3}, {"r": 1.0}, {"C": 0.0}, {"r": 1.0, "p": 0.01})]


# The formula


def printed_D(equation: str, r: float, p: float, t: float, v: float, v_: float, w: float) -> float:
    """As section 5.4 prints it."""
    Z = r / (1 + r * t**2 - t**2) ** 2
    A = math.sqrt(p / (p**2 - p**2 * w**2 + w**2))
    GG = v / (r - r * v + v) * (v_ / (r - r * v_ + v_))
    return {
        "eq12": 1 / (4 * PI * v * v_) * Z * A,
        "eq15": GG / (4 * PI * v * v_) * Z * A,
        "eq17": r / PI * A + (1 - r) / (4 * PI * v * v_) * Z * A,
        "eq18": (1 - GG) / PI * A + GG / (4 * PI * v * v_) * Z * A,
    }[equation]


def printed_S(spectral: str, C: float, u: float) -> float:
    return C if spectral == "constant" else C + (1 - C) * (1 - u) ** 5


def mean_of_A(p: float) -> float:
    return 2 / PI * math.sqrt(p) * float(ellipkm1(p * p))


@every_member
def test_formula(words: tuple[str, str, str, str]) -> None:
    layers, spectral, equation, as_printed = words
    model = member(equation, layers, spectral, as_printed)
    values = BRUSHED if layers == "single" else TWO_LAYERS
    p = model.bind(values)

    def D(suffix: str, *geometry: float) -> float:
        isotropy = values["p" + suffix]
        norm = 1.0 if as_printed == "yes" else mean_of_A(isotropy)
        return printed_D(equation, values["r" + suffix], isotropy, *geometry) / norm

    for wi, wo in trial.random_pairs(50):
        h = np.add(wi, wo) / np.linalg.norm(np.add(wi, wo))
        geometry = float(h[2]), wo.z, wi.z, float(h[0] / math.hypot(h[0], h[1]))
        u = float(np.dot(h, wo))
        S = printed_S(spectral, values["C"], u)
        expected = S * D("", *geometry)
        if layers == "double":
            expected += (1 - S) * printed_S(spectral, values["C_2"], u) * D("_2", *geometry)
        assert math.isclose(model.evaluate(p, wi, wo), expected, rel_tol=1e-10)


def test_there_are_32_members_and_each_is_made_once() -> None:
    assert MODEL is member()
    made = {
        MODEL.member(dict(zip((c.name for c in CHOICES), words, strict=True)))[0]
        for words in product(*(c.options for c in CHOICES))
    }
    assert len(made) == 32
    assert [q.name for q in MODEL.member({"layers": "double"})[0].parameters] == ["C", "r", "p", "C_2", "r_2", "p_2"]


@every_equation
@pytest.mark.parametrize("p", [1e-3, 0.1, 1.0])
def test_printing_costs_the_mean_of_A(equation: str, p: float) -> None:
    right, printed = member(equation), member(equation, as_printed="yes")
    for wi, wo in trial.random_pairs(20):
        ratio = printed.evaluate(printed.bind({"p": p}), wi, wo) / right.evaluate(right.bind({"p": p}), wi, wo)
        assert math.isclose(ratio, mean_of_A(p), rel_tol=1e-12)


@every_equation
def test_the_albedo_of_a_viewer_at_the_normal_knows_no_p(equation: str) -> None:
    """There only the mean of A counts, which is why it must be 1."""
    model = member(equation)
    albedos = [trial.narrow_albedo(model, model.bind({"r": 0.1, "p": p}), 1.0) for p in (0.1, 0.4, 1.0)]
    trial.assert_close(albedos[0], albedos[2], 2e-4)
    trial.assert_close(albedos[1], albedos[2])


@every_equation
@pytest.mark.parametrize("spectral", ["constant", "fresnel"])
def test_two_layers_are_one_where_the_upper_is_white_or_missing(equation: str, spectral: str) -> None:
    """S = 1 leaves nothing for the lower layer; a constant S = 0 leaves it all."""
    model, single = member(equation, "double", spectral), member(equation, spectral=spectral)
    white = model.bind({**TWO_LAYERS, "C": 1.0})
    over = single.bind({"C": 1.0, "r": TWO_LAYERS["r"], "p": TWO_LAYERS["p"]})
    under = single.bind({"C": TWO_LAYERS["C_2"], "r": TWO_LAYERS["r_2"], "p": TWO_LAYERS["p_2"]})
    for wi, wo in trial.random_pairs(50):
        assert math.isclose(model.evaluate(white, wi, wo), single.evaluate(over, wi, wo), rel_tol=1e-12)
        if spectral == "constant":
            missing = model.bind({**TWO_LAYERS, "C": 0.0})
            assert math.isclose(model.evaluate(missing, wi, wo), single.evaluate(under, wi, wo), rel_tol=1e-12)


@every_member
def test_reciprocal(words: tuple[str, str, str, str]) -> None:
    layers, spectral, equation, as_printed = words
    model = member(equation, layers, spectral, as_printed)
    assert model.reciprocal
    trial.assert_reciprocal(model, *sets(model))


@every_equation
@pytest.mark.parametrize("layers", ["single", "double"])
def test_the_parts_add_up(equation: str, layers: str) -> None:
    model = member(equation, layers, "fresnel")
    for p in sets(model):
        parts = model.parts(p) if model.parts else ((model, p),)
        assert len(parts) == (2 if layers == "double" else 1) * (2 if equation in ("eq17", "eq18") else 1)
        for wi, wo in trial.random_pairs(20):
            total = sum(part.evaluate(values, wi, wo) for part, values in parts)
            assert math.isclose(model.evaluate(p, wi, wo), total, rel_tol=1e-12, abs_tol=1e-300)


def test_isotropic_where_every_layer_is() -> None:
    double = member(layers="double")
    assert MODEL.isotropic(MODEL.bind({}))
    assert not MODEL.isotropic(MODEL.bind({"p": 0.9}))
    assert double.isotropic(double.bind({}))
    assert not double.isotropic(double.bind({"p_2": 0.9}))
    assert not double.isotropic(double.bind({"p": 0.9}))
    for model, values in ((MODEL, {}), (double, {}), (MODEL, {"p": 0.9}), (double, {"p_2": 0.9})):
        p = model.bind(values)
        f = [model.evaluate(p, trial.at(0.8, 0.3 + turn), trial.at(0.6, 2.5 + turn)) for turn in (0.0, 1.0)]
        assert math.isclose(*f, rel_tol=1e-9) == model.isotropic(p)


# Accuracy


@every_equation
@pytest.mark.parametrize("mu", [1.0, 0.5, 1e-6, 1e-12])
def test_the_mirror_direction_at_the_smoothest(equation: str, mu: float) -> None:
    """1 / (4 pi r) over the cosines, finite where h has no azimuth and next to it."""
    model, r = member(equation), 1e-6
    p, wo = model.bind({"r": r}), trial.at(mu, 0.7)
    g = mu / (r + (1 - r) * mu)
    peak = {"eq12": 1.0, "eq15": g * g, "eq17": 1 - r, "eq18": g * g}[equation] / (4 * PI * r * mu * mu)
    rest = {"eq12": 0.0, "eq15": 0.0, "eq17": r, "eq18": 1 - g * g}[equation] / PI
    assert math.isclose(model.evaluate(p, mirror_of(wo), wo), peak + rest, rel_tol=1e-9)
    brushed = model.bind({"r": r, "p": 1e-3})
    assert 0.0 < model.evaluate(brushed, mirror_of(wo), wo) < math.inf


def test_a_narrow_lobe_keeps_its_digits() -> None:
    """Beside the mirror direction by a slope s the zenith factor is r / (r + s^2)^2 to the order s^2."""
    r, s, wo = 1e-6, 1e-3, trial.at(0.6)
    tilt = math.atan(s)
    h = Direction(0.0, math.sin(tilt), math.cos(tilt))
    k = 2.0 * dot(h, wo)
    wi = Direction(k * h.x - wo.x, k * h.y - wo.y, k * h.z - wo.z)
    model = member("eq12")
    expected = r * (1 + s * s) ** 2 / (r + s * s) ** 2 / (4 * PI * wi.z * wo.z)
    assert math.isclose(model.evaluate(model.bind({"r": r}), wi, wo), expected, rel_tol=1e-11)
    p = model.bind({"r": r, "p": 0.01})
    assert math.isclose(model.evaluate(p, wi, wo), expected * 10.0 / mean_of_A(0.01), rel_tol=1e-9)


# Limits and albedos; for C = 1 the claim of section 7 is that none of them is above 1


def test_without_anisotropy_and_spectrum_eq_15_is_schlick_isotropic() -> None:
    for r in (1e-6, 0.1, 1.0):
        for wi, wo in trial.random_pairs(50):
            f = MODEL.evaluate(MODEL.bind({"C": 1.0, "r": r}), wi, wo)
            assert math.isclose(f, ISOTROPIC.evaluate(ISOTROPIC.bind({"r": r}), wi, wo), rel_tol=1e-12)


def test_the_roughest() -> None:
    """r = 1: Z is 1 and G(v) is v, so that eq. 12 is 1 / (4 pi v v'), eq. 15 1 / (4 pi), and eq. 17 the Lambertian surface."""
    for wi, wo in trial.random_pairs(50):
        v, v_ = wo.z, wi.z
        expected = {
            "eq12": 1 / (4 * PI * v * v_),
            "eq15": 1 / (4 * PI),
            "eq17": 1 / PI,
            "eq18": (1 - v * v_) / PI + 1 / (4 * PI),
        }
        for equation in EQUATIONS:
            model = member(equation)
            p = model.bind({"C": 0.7, "r": 1.0})
            assert math.isclose(model.evaluate(p, wi, wo), 0.7 * expected[equation], rel_tol=1e-12)


@pytest.mark.parametrize("mu", [1.0, 0.5, 0.01])
def test_albedos_of_the_roughest(mu: float) -> None:
    """2 v' dv' over [0, 1] of the above: 1/(2 v), 1/4, 1, and 5/4 - 2 v/3, which is above 1 for v < 3/8."""
    expected = {"eq12": 0.5 / mu, "eq15": 0.25, "eq17": 1.0, "eq18": 1.25 - 2.0 * mu / 3.0}
    for equation in EQUATIONS:
        model = member(equation)
        trial.assert_close(trial.wide_albedo(model, model.bind({"r": 1.0}), mu), expected[equation])


@pytest.mark.parametrize("r", [0.03, 0.3, 1.0])
@pytest.mark.parametrize("p", [0.2, 1.0])
def test_normal_incidence_of_eq_12(r: float, p: float) -> None:
    """u = t there, so that the albedo is the share of normals up to 45 degrees: 1 / (1 + r), below 1; eq. 17 mixes it with 1."""
    lobe, mixed = member("eq12"), member("eq17")
    trial.assert_close(trial.narrow_albedo(lobe, lobe.bind({"r": r, "p": p}), 1.0), 1 / (1 + r))
    trial.assert_close(trial.narrow_albedo(mixed, mixed.bind({"r": r, "p": p}), 1.0), r + (1 - r) / (1 + r))


@pytest.mark.parametrize("equation", ["eq15", "eq18"])
def test_normal_incidence_with_obstruction(equation: str) -> None:
    """2 t^2 = 1 + v', so that 2 t dt = dv'/2 and f cos dw' = Z G' dv'/2; and (1 - G') 2 v' dv' comes on top in eq. 18."""
    r = 0.2
    model = member(equation)

    def integrand(c: float) -> float:
        G = c / (r + (1 - r) * c)
        lobe = 0.5 * G * r / (1 - (1 - r) * (1 + c) / 2) ** 2
        return lobe + (2 * c * (1 - G) if equation == "eq18" else 0.0)

    trial.assert_close(trial.narrow_albedo(model, model.bind({"r": r}), 1.0), quad(integrand, 0.0, 1.0)[0])


@pytest.mark.parametrize("equation", EQUATIONS)
@pytest.mark.parametrize("mu", [1.0, 0.3])
def test_the_smoothest_is_a_white_mirror(equation: str, mu: float) -> None:
    """Less a tail of order r / mu^2."""
    model = member(equation)
    trial.assert_close(trial.narrow_albedo(model, model.bind({"r": 1e-6}), mu), 1.0)


@pytest.mark.parametrize("equation", ["eq12", "eq17"])
@pytest.mark.parametrize("r", [0.01, 0.1, 0.5])
def test_without_obstruction_the_albedo_diverges(equation: str, r: float) -> None:
    """v a -> the mean of (u/t)^+ = (tan alpha cos phi)^+, that is sqrt(r) pi/2 / pi: condition 13 is not enough."""
    model, mu = member(equation), 1e-7
    limit = (1.0 if equation == "eq12" else 1.0 - r) * 0.5 * math.sqrt(r)
    trial.assert_close(mu * trial.narrow_albedo(model, model.bind({"r": r}), mu), limit, 3e-4)


@pytest.mark.parametrize("r", [0.01, 0.1, 0.5])
def test_obstruction_bounds_the_albedo_but_not_by_1(r: float) -> None:
    """At grazing angles G(v)/v -> 1/r. Eq. 18 adds to eq. 15 a diffuse term that tends to 1: it always creates energy there."""
    eq15, eq18 = (trial.narrow_albedo(model, model.bind({"r": r}), 1e-8) for model in (member("eq15"), member("eq18")))
    expected = {0.01: 4.799, 0.1: 1.3775, 0.5: 0.46544}[r]
    trial.assert_close(eq15, expected, 3e-4)
    trial.assert_close(eq18, 1.0 + expected, 3e-4)


# Sampling


SAMPLED = [  # a histogram does not resolve the turn of a smaller p about the mirror direction
    (member("eq15"), {"r": 0.1, "p": 0.3}, 0.7),
    (member("eq12"), {"r": 1.0, "p": 0.4}, 0.5),
    (member("eq18"), {"r": 0.3, "p": 0.2}, 0.3),
    (member("eq18", "double"), {"r": 0.1, "p": 0.4, "r_2": 0.8, "p_2": 0.7}, 0.6),
]


@every_equation
@pytest.mark.parametrize("layers", ["single", "double"])
def test_density_integrates_to_one_less_the_rejected_share(equation: str, layers: str) -> None:
    model = member(equation, layers)
    values = [{"r": 0.1, "p": 0.2}, {"r": 1.0}, {"r": 1e-6}]
    if layers == "double":
        values = [TWO_LAYERS]
    for value, mu in zip(values, (0.5, 1e-4, 1.0), strict=False):
        trial.assert_normalised(model, model.bind(value), mu)


@pytest.mark.parametrize(("model", "values", "mu"), SAMPLED)
def test_samples_follow_the_density(model: Model, values: dict[str, float], mu: float) -> None:
    trial.assert_follows_density(model, model.bind(values), mu, len(SAMPLED))


@pytest.mark.parametrize(("model", "values", "mu"), SAMPLED)
def test_a_density_with_the_scratch_turned_is_caught(model: Model, values: dict[str, float], mu: float) -> None:
    """Control: across is not along."""

    def turned(p: Any, wi: Direction, wo: Direction) -> float:
        return float(model.pdf(p, Direction(wi.y, wi.x, wi.z), Direction(wo.y, wo.x, wo.z)))  # type: ignore[misc]

    assert model.sample is not None
    assert trial.histogram_p_value(model.sample, turned, model.bind(values), mu) < trial.sidak(len(SAMPLED))


def bound(equation: str, r: float, v: float, w: Direction, h: Direction) -> float:
    """f cos / pdf of one layer with S = 1, from A <= 2 pi times the azimuth's density, without the mean of A.

    The lobe weighs u / (t v), times its factor in D; A / pi weighs 4 u v' / (Z t), and at most 4 u v' / t / r of it by r. Eq. 18
    has evenly spread normals as well, (1-r) G(v) lobe and the rest of those, so that the larger of both weights bounds each term.
    """
    t, u, v_ = h.z / length(h), 0.5 * length(h), w.z
    G, G_ = v / (r + (1 - r) * v), v_ / (r + (1 - r) * v_)
    lobe = u / (t * v)
    if equation == "eq12":
        return lobe
    if equation == "eq15":
        return G * G_ * lobe
    if equation == "eq17":
        return (1 - r) * lobe + 8.0
    return G_ * lobe / max(1 - r, 1e-300) + 8.0 * (1 - G * G_) * u * v_ / (1 - (1 - r) * G)


@every_equation
@pytest.mark.parametrize("r", [1e-6, 0.1, 0.9])
@pytest.mark.parametrize("p", [1e-3, 0.2, 1.0])
def test_weights_are_bounded(equation: str, r: float, p: float) -> None:
    """Between a point of the sampler and the formula nothing but u / (t v) can grow, whatever r and p."""
    model = member(equation, as_printed="yes")
    q = model.bind({"r": r, "p": p})
    assert model.sample is not None
    assert model.pdf is not None
    accepted = 0
    for mu in (1.0, 0.3, 1e-3, 1e-9):
        wo = trial.at(mu, 0.4)
        for i in range(300):
            u1 = (i + 0.5) / 300
            wi = model.sample(q, wo, u1**3, trial.reversed_bits(i % 256, 8))
            assert math.isclose(dot(wi, wi), 1.0, rel_tol=1e-12)
            if wi.z > 1e-9:
                accepted += 1
                weight = model.evaluate(q, wi, wo) * wi.z / model.pdf(q, wi, wo)
                assert 0.0 < weight <= bound(equation, r, mu, wi, bisector(wi, wo)) * (1.0 + 1e-6)
    assert accepted > 300


@every_equation
@pytest.mark.parametrize("layers", ["single", "double"])
def test_the_rarest_samples_are_sound(equation: str, layers: str) -> None:
    model = member(equation, layers, "fresnel")
    ends = (2.0**-50, 2.0**-33, 0.3, 0.5, 1.0 - 2.0**-33)
    assert model.sample is not None
    assert model.pdf is not None
    for p, mu, u1, u2 in product(sets(model), trial.GRAZING, ends, ends):
        wo = trial.at(mu)
        wi = model.sample(p, wo, u1, u2)
        assert math.isclose(dot(wi, wi), 1.0, rel_tol=1e-12)
        if wi.z > 0.0:
            assert model.pdf(p, wi, wo) > 0.0
            assert 0.0 <= model.evaluate(p, wi, wo) * wi.z / model.pdf(p, wi, wo) < math.inf


@every_equation
def test_the_albedo_by_samples_and_by_angles(equation: str) -> None:
    """Two layers, brushed: 2^13 Hammersley points know a smooth integral to 1 %."""
    model = member(equation, "double", "fresnel")
    p, wo, count = model.bind({**TWO_LAYERS, "r": 0.1}), trial.at(0.5, 0.4), 1 << 13
    assert model.sample is not None
    assert model.pdf is not None
    total = 0.0
    for i in range(count):
        wi = model.sample(p, wo, (i + 0.5) / count, trial.reversed_bits(i, 13))
        if wi.z > 0.0:
            total += model.evaluate(p, wi, wo) * wi.z / model.pdf(p, wi, wo)
    expected = trial.over_hemisphere(Axis.HALF, wo, lambda wi: model.evaluate(p, wi, wo) * wi.z)
    trial.assert_close(total / count, expected, 0.01)
