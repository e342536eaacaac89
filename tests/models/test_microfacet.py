"""The microfacet model: every choice against the formula in angles, its limits, its samplers at the ends of their domains."""

from __future__ import annotations

import math
from collections.abc import Callable
from itertools import product
from typing import Any

import pytest

from albedo_lab.model import Model
from albedo_lab.models.microfacet import CHOICES, MODEL
from albedo_lab.optics import fresnel
from albedo_lab.optics.coordinates import Axis
from tests.models import trial
from tests.models.test_cook_torrance import cavities, half_angle_cosine
from tests.models.test_cook_torrance import masking as beckmann_masking
from tests.models.trial import PI

OPTIONS = {choice.name: choice.options for choice in CHOICES}
NUMBERS: dict[str, dict[str, float]] = {
    "blinn_phong": {"n": 20.0},
    "beckmann": {"m": 0.3},
    "trowbridge_reitz": {"alpha": 0.3},
    "ggx": {"alpha": 0.3},
    "gtr": {"alpha": 0.3, "gamma": 1.5},
}
ENDS: dict[str, tuple[dict[str, float], ...]] = {
    "blinn_phong": ({"n": 0.0}, {"n": 1e8}),
    "beckmann": ({"m": 1e-4}, {"m": 1.0}),
    "trowbridge_reitz": ({"alpha": 1e-4}, {"alpha": 1.0}),
    "ggx": ({"alpha": 1e-4}, {"alpha": 1.0}),
    "gtr": tuple({"alpha": a, "gamma": g} for a, g in product((1e-4, 1.0), (0.0, 1.0, 10.0))),
}


def member(**choices: str) -> Model:
    return MODEL.member(choices)[0]


def D(name: str, t: float, as_printed: bool = False) -> float:
    """The page's distributions, with constants that normalise them unless as printed."""
    a = 0.3
    q = a * a * t * t + 1 - t * t
    constant = a * a / PI
    if name == "blinn_phong":
        return 11 / PI * math.pow(t, 20)
    if name == "beckmann":
        return math.exp((1 - 1 / (t * t)) / (a * a)) / (PI * a * a * t**4)
    if name == "ggx":
        return a * a / (PI * q * q)
    if name == "trowbridge_reitz":
        return (constant if as_printed else (1 - a * a) / (PI * math.log(1 / (a * a)))) / q
    return (constant if as_printed else 0.5 * (1 - a * a) / (PI * (1 / a - 1))) / math.pow(q, 1.5)


def printed(name: str, G: Callable[..., float], F: Callable[[float], float], as_printed: bool = False) -> trial.Formula:
    def formula(light: float, viewer: float, turn: float) -> float:
        t = min(trial.half_cosine(light, viewer, turn), 1.0)
        d = D(name, t, as_printed) * F(half_angle_cosine(light, viewer, turn))
        return d * G(light, viewer, turn) / (4 * math.cos(light) * math.cos(viewer))

    return formula


def one(*_: float) -> float:
    return 1.0


@pytest.mark.parametrize("name", OPTIONS["D"])
def test_distributions(name: str) -> None:
    for as_printed in ("no", "yes"):
        model = member(D=name, G="none", as_printed=as_printed)
        trial.assert_formula(model, model.bind(NUMBERS[name]), printed(name, one, one, as_printed == "yes"))


def ggx_masking(theta: float) -> float:
    return 2 / (1 + math.sqrt(1 + (0.3 * math.tan(theta)) ** 2))


def correlated(g: float, h: float) -> float:
    """1 / (1 + Lambda + Lambda') from both G1 = 1 / (1 + Lambda)."""
    return 1 / (1 / g + 1 / h - 1)


def schlick(theta: float, width: float) -> float:
    k = math.sqrt(2 / PI) * width
    return math.cos(theta) / (math.cos(theta) * (1 - k) + k)


@pytest.mark.parametrize(
    ("name", "geometry", "G"),
    [
        ("ggx", "v_cavity", cavities),
        ("ggx", "smith", lambda light, viewer, turn: ggx_masking(light) * ggx_masking(viewer)),
        ("ggx", "smith_correlated", lambda light, viewer, turn: correlated(ggx_masking(light), ggx_masking(viewer))),
        ("beckmann", "smith", lambda light, viewer, turn: beckmann_masking(0.3, light) * beckmann_masking(0.3, viewer)),
        ("gtr", "schlick", lambda light, viewer, turn: schlick(light, 0.3) * schlick(viewer, 0.3)),
        ("blinn_phong", "schlick", lambda light, viewer, turn: schlick(light, 11**-0.5) * schlick(viewer, 11**-0.5)),
    ],
)
def test_geometric_factors(name: str, geometry: str, G: Callable[..., float]) -> None:
    model = member(D=name, G=geometry)
    trial.assert_formula(model, model.bind(NUMBERS[name]), printed(name, G, one))


FRESNEL: dict[str, tuple[dict[str, float], Callable[[float], float], float]] = {
    "one": ({}, one, 0.0),
    "schlick": ({"F0": 0.04}, lambda u: 0.04 + 0.96 * (1 - u) ** 5, 1 / 1.5**2),
    "dielectric": ({"eta": 1.5}, lambda u: fresnel.dielectric(1.5, u), 1 / 1.5**2),
    "conductor": ({"eta": 0.2, "k": 3.9}, lambda u: fresnel.conductor(0.2, 3.9, u), 25.0),
}
"""Parameters, F, and (n_i / n_t)^2."""


@pytest.mark.parametrize("name", OPTIONS["F"])
def test_reflectances_and_diffuse_parts(name: str) -> None:
    numbers, F, refracted = FRESNEL[name]
    base: dict[str, Callable[[float], float]] = {
        "none": lambda u: 0.0,
        "lambert": lambda u: 0.7 / PI,
        "one_minus_fresnel": lambda u: 0.7 / PI * (1 - F(u)),
        "refracted": lambda u: 0.7 / PI * refracted * (1 - F(u)),
    }
    for diffuse in OPTIONS["diffuse"]:
        model = member(F=name, G="none", diffuse=diffuse)
        p = model.bind({**NUMBERS["ggx"], **numbers, **({"a_d": 0.7} if diffuse != "none" else {})})
        facets = printed("ggx", one, F)
        trial.assert_formula(model, p, lambda *a, facets=facets, base=base[diffuse]: facets(*a) + base(half_angle_cosine(*a)))
        if model.parts is not None:
            for wi, wo in trial.random_pairs(20):
                terms = sum(part.evaluate(q, wi, wo) for part, q in model.parts(p))
                assert math.isclose(terms, model.evaluate(p, wi, wo), rel_tol=1e-14)


def test_refraction_of_a_perfect_reflector_lets_nothing_in() -> None:
    model = member(F="schlick", diffuse="refracted")
    assert model.bind({"F0": 1.0}).refracted == 0.0
    assert math.isclose(model.bind({"F0": 0.0}).refracted, 1.0)


@pytest.mark.parametrize("name", OPTIONS["D"])
def test_reciprocal(name: str) -> None:
    for geometry in OPTIONS["G"]:
        model = member(D=name, G=geometry, F="dielectric", diffuse="one_minus_fresnel")
        trial.assert_reciprocal(model, model.bind(NUMBERS[name]))


# Limits


@pytest.mark.parametrize("mu", [1.0, 0.5, 0.1, 1e-3])
@pytest.mark.parametrize("name", ["ggx", "trowbridge_reitz", "gtr", "blinn_phong"])
def test_uniform_normals(name: str, mu: float) -> None:
    """D = 1/pi hides 1 - G1 = (1 - v) / (1 + v). Independently, a = 2 (1 - log 2) / (1 + mu); correlated, 1 - mu log(1 + 1/mu).

    Both are 1 - log 2 head on; at grazing angles they are 0.61 and 1.
    """
    numbers = {"n": 0.0} if name == "blinn_phong" else {"alpha": 1.0}
    for geometry, expected in (
        ("smith", 2 * (1 - math.log(2)) / (1 + mu)),
        ("smith_correlated", 1 - mu * math.log1p(1 / mu)),
    ):
        model = member(D=name, G=geometry)
        trial.assert_close(trial.narrow_albedo(model, model.bind(numbers), mu), expected, 1e-4)


@pytest.mark.parametrize("degrees", [30.0, 60.0, 80.0])
@pytest.mark.parametrize(("name", "geometry"), [*product(("ggx", "beckmann"), ("smith", "v_cavity")), ("gtr", "none")])
def test_a_smooth_surface_is_a_mirror(name: str, geometry: str, degrees: float) -> None:
    """What ggx loses in cavities, of order alpha, is its tail's; gtr with gamma = 10 has none."""
    model = member(D=name, G=geometry)
    p = model.bind(ENDS[name][0] if name != "gtr" else {"alpha": 1e-4, "gamma": 10.0})
    trial.assert_close(trial.narrow_albedo(model, p, math.cos(math.radians(degrees))), 1.0, 1e-3)


@pytest.mark.parametrize("name", OPTIONS["D"])
def test_hidden_facets_keep_the_albedo_below_1(name: str) -> None:
    """Without G it grows like 1 / mu."""
    p = member(D=name).bind(NUMBERS[name])
    for geometry in ("smith", "smith_correlated", "v_cavity"):
        for mu in (0.3, 1e-4):
            assert trial.narrow_albedo(member(D=name, G=geometry), p, mu) < 1.0 + 2e-3
    assert trial.narrow_albedo(member(D=name, G="none"), p, 1e-4) > 100.0


# Samples


SAMPLERS = [
    ("ggx", "smith", "none"),
    ("beckmann", "smith_correlated", "none"),
    ("blinn_phong", "v_cavity", "none"),
    ("trowbridge_reitz", "smith", "none"),
    ("gtr", "v_cavity", "lambert"),
]
every_sampler = pytest.mark.parametrize(("name", "geometry", "diffuse"), SAMPLERS)


@every_sampler
def test_density_is_normalised(name: str, geometry: str, diffuse: str) -> None:
    """The mixture: its facets, and half of the cosine's share, all of which lies above the horizon."""
    model = member(D=name, G=geometry, diffuse=diffuse)
    for mu in (0.9, 0.1):
        if diffuse == "none":
            trial.assert_normalised(model, model.bind(NUMBERS[name]), mu)
        else:
            assert model.sample is not None
            assert model.pdf is not None
            density = trial.accepted_by_density(model.pdf, Axis.HALF, model.bind(NUMBERS[name]), mu)
            assert abs(density - trial.accepted_by_sampler(model.sample, model.bind(NUMBERS[name]), mu)) < 4e-3


@pytest.mark.parametrize(("name", "geometry", "diffuse"), [SAMPLERS[0], SAMPLERS[3], SAMPLERS[4]])
def test_samples_follow_the_density(monkeypatch: pytest.MonkeyPatch, name: str, geometry: str, diffuse: str) -> None:
    monkeypatch.setattr(trial, "SAMPLES", 20_000)
    model = member(D=name, G=geometry, diffuse=diffuse)
    trial.assert_follows_density(model, model.bind({**NUMBERS[name], **({"alpha": 0.5})}), 0.3, 3)


def members() -> list[tuple[Model, Any]]:
    """Every distribution and geometry at the ends of their domains; diffuse parts and reflectances in turn."""
    found = []
    for i, (name, geometry) in enumerate(product(OPTIONS["D"], OPTIONS["G"])):
        F, diffuse = OPTIONS["F"][i % 4], OPTIONS["diffuse"][i % 3]
        for as_printed in OPTIONS["as_printed"]:
            model = member(D=name, G=geometry, F=F, diffuse=diffuse, as_printed=as_printed)
            found += [(model, model.bind(numbers)) for numbers in ENDS[name]]
    return found


@pytest.mark.parametrize("mu", [1.0, 0.3, 1e-4, 1e-12])
def test_all_is_finite(mu: float) -> None:
    wo = trial.at(mu, 0.4)
    for model, p in members():
        assert model.sample is not None
        assert model.pdf is not None
        for u1, u2 in product((2.0**-50, 0.3, 0.5, 0.9, 1 - 2.0**-33), (2.0**-50, 0.3, 1 - 2.0**-33)):
            wi = model.sample(p, wo, u1, u2)
            assert math.isclose(wi.x**2 + wi.y**2 + wi.z**2, 1.0, rel_tol=1e-12), (model.title, p)
            if wi.z > 0.0:
                f, density = model.evaluate(p, wi, wo), model.pdf(p, wi, wo)
                assert density > 0.0, (model.title, p)
                assert 0.0 <= f * wi.z / density < math.inf, (model.title, p)
        for wi, other in trial.random_pairs(20):
            assert 0.0 <= model.evaluate(p, wi, other) < math.inf
            assert 0.0 <= model.evaluate(p, wi, wo) < math.inf
            assert 0.0 <= model.pdf(p, wi, wo) < math.inf


@pytest.mark.parametrize("name", ["ggx", "beckmann"])
def test_visible_normals_leave_only_the_masking_of_the_light(name: str) -> None:
    """f cos / pdf is G1 of the light, or G / G1(wo)."""
    for numbers, mu in product(ENDS[name], (1.0, 0.5, 1e-4, 1e-9)):
        for geometry in ("smith", "smith_correlated"):
            model = member(D=name, G=geometry)
            assert model.sample is not None
            assert model.pdf is not None
            p, wo = model.bind(numbers), trial.at(mu, 0.4)
            for u1, u2 in product((1e-9, 0.3, 0.8), (0.1, 0.6)):
                wi = model.sample(p, wo, u1, u2)
                assert wi.z <= 0.0 or 0.0 < model.evaluate(p, wi, wo) * wi.z / model.pdf(p, wi, wo) <= 1.0 + 1e-9
