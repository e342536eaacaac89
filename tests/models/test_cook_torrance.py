"""Cook-Torrance: the print of losasso and of schlick1993, their misprints, and what becomes of light at grazing angles."""

from __future__ import annotations

import math
from collections.abc import Callable
from itertools import product

import pytest
from scipy.special import erfc

from albedo_lab.model import DivergesAtGrazing, EnergyConserving, Model
from albedo_lab.models.cook_torrance import MODEL, CookTorrance, misprinted_exact, misprinted_schlick, misprinted_smith
from albedo_lab.optics.fresnel import dielectric
from albedo_lab.optics.masking import beckmann_lambda
from tests.models import trial
from tests.models.trial import PI

SLOPES = (0.05, 0.3, 1.0)
every_slope = pytest.mark.parametrize("m", SLOPES)
GEOMETRIES = ("v_cavity", "smith", "none")


def member(**choices: str) -> Model:
    return MODEL.member(choices)[0]


def half_angle_cosine(light: float, viewer: float, turn: float) -> float:
    """L.H."""
    l_v = math.cos(light) * math.cos(viewer) + math.sin(light) * math.sin(viewer) * math.cos(turn)
    return math.sqrt(0.5 + 0.5 * l_v)


def beckmann(m: float, t: float) -> float:
    """The D of losasso: exp(-(tan beta / m)^2) / (4 m^2 cos^4 beta)."""
    return math.exp(-((math.tan(math.acos(min(t, 1.0))) / m) ** 2)) / (4 * m * m * t**4)


def cavities(light: float, viewer: float, turn: float) -> float:
    """The G of losasso, appendix A."""
    t, u = trial.half_cosine(light, viewer, turn), half_angle_cosine(light, viewer, turn)
    return min(1.0, 2 * t * math.cos(viewer) / u, 2 * t * math.cos(light) / u)


def masking(m: float, theta: float) -> float:
    """Smith's G1 of facets that face the direction, the slope's variance along one direction being m^2 / 2."""
    if theta == 0.0:
        return 1.0
    root = 1 / (m * math.tan(theta))
    return 2 / (2 - erfc(root) + math.exp(-root * root) / (math.sqrt(PI) * root))


def printed(m: float, geometry: str, F: Callable[[float, float], float]) -> trial.Formula:
    """D G F / (pi (L.N) (E.N)), F of N.E and L.H."""

    def formula(light: float, viewer: float, turn: float) -> float:
        G = {"v_cavity": cavities(light, viewer, turn), "smith": masking(m, light) * masking(m, viewer), "none": 1.0}[geometry]
        D = beckmann(m, trial.half_cosine(light, viewer, turn))
        f = F(math.cos(viewer), half_angle_cosine(light, viewer, turn))
        return D * G * f / (PI * math.cos(light) * math.cos(viewer))

    return formula


@every_slope
@pytest.mark.parametrize("geometry", GEOMETRIES)
def test_formula(geometry: str, m: float) -> None:
    """The print of losasso is normalised: its D over pi v v' is Beckmann's over 4 v v'."""
    trial.assert_formula(member(geometry=geometry), CookTorrance(m), printed(m, geometry, lambda n_e, l_h: 1.0))


def test_fresnel_factors() -> None:
    p = CookTorrance(0.3, F0=0.04, eta=1.5, k=0.0)
    schlick = printed(0.3, "v_cavity", lambda n_e, l_h: 0.04 + 0.96 * (1 - l_h) ** 5)
    trial.assert_formula(member(fresnel="schlick"), p, schlick)
    trial.assert_formula(member(fresnel="exact"), p, printed(0.3, "v_cavity", lambda n_e, l_h: dielectric(1.5, l_h)))


@pytest.mark.parametrize("geometry", GEOMETRIES)
def test_misprints_of_losasso(geometry: str) -> None:
    p = CookTorrance(0.3, F0=0.04, eta=1.5, k=0.0)

    def exact(n_e: float, c: float) -> float:
        g = math.sqrt(1.5**2 + c**2) - 1
        return 0.5 * (g - c) ** 2 / (g + c) ** 2 * (1 + (c * (g + c) - 1) ** 2 / (c * (g - c) + 1) ** 2)

    def cheap(n_e: float, l_h: float) -> float:
        return (1 - (1 - n_e) ** 5) + 0.04 * (1 - n_e) ** 5

    of = {"geometry": geometry, "as_printed": "losasso"}
    trial.assert_formula(member(fresnel="exact", **of), p, printed(0.3, geometry, exact))
    trial.assert_formula(member(fresnel="schlick", **of), p, printed(0.3, geometry, cheap))
    trial.assert_formula(member(fresnel="one", **of), p, printed(0.3, geometry, lambda n_e, l_h: 1.0))


def test_the_root_of_losasso_is_misprinted() -> None:
    """Glass reflects 4 % at normal incidence; as printed 1.2 %, and without an interface (n = 1) still something."""
    assert math.isclose(dielectric(1.5, 1.0), 0.04, rel_tol=1e-12)
    assert math.isclose(misprinted_exact(1.5, 1.0), 0.01197, abs_tol=1e-5)
    assert dielectric(1.0, 0.5) < 1e-30
    assert misprinted_exact(1.0, 0.5) > 0.3
    # with the 1 under the root it is the known formula
    for n, c in product((1.1, 1.5, 3.0), (0.1, 0.5, 1.0)):
        g = math.sqrt(n * n + c * c - 1)
        known = 0.5 * (g - c) ** 2 / (g + c) ** 2 * (1 + (c * (g + c) - 1) ** 2 / (c * (g - c) + 1) ** 2)
        assert math.isclose(dielectric(n, c), known, rel_tol=1e-12)


def test_the_cheap_fresnel_of_losasso_is_misprinted() -> None:
    """It is 1 head on and n at grazing angles, the wrong way round; and it tells the viewer from the light."""
    assert misprinted_schlick(0.04, 1.0) == 1.0
    assert math.isclose(misprinted_schlick(0.04, 0.0), 0.04, rel_tol=1e-15)
    swapped = member(fresnel="schlick", as_printed="losasso")
    assert not swapped.reciprocal
    wi, wo = trial.direction(1.2), trial.direction(0.3, PI)
    p = CookTorrance(0.3, F0=0.04)
    assert swapped.evaluate(p, wi, wo) > 1.1 * swapped.evaluate(p, wo, wi)


def test_the_smith_factor_of_schlick1993_is_misprinted() -> None:
    """Eq. 7 prints g / (g + 1); Smith's is g / (g + exp(-h)): the share of facets that face the viewer, times that seen of them.

    With the slope's variance s^2 along one direction, 1 - erfc(sqrt h) / 2 of the facets have a slope above -v / sqrt(1 - v^2),
    h = v^2 / (2 s^2 (1 - v^2)); they are seen with G1. Eq. 6 has exp(-tan^2 / m^2), that is s^2 = m^2 / 2.
    """
    m = 0.4
    for theta in (0.2, 0.8, 1.2, 1.5):
        h = 1 / (m * m * math.tan(theta) ** 2)
        g = math.sqrt(PI * h) * (2 - erfc(math.sqrt(h)))
        facing = 1 - 0.5 * erfc(math.sqrt(h))
        assert math.isclose(g / (g + math.exp(-h)), facing * masking(m, theta), rel_tol=1e-13)
        assert math.isclose(masking(m, theta), 1 / (1 + beckmann_lambda(m, trial.direction(theta))), rel_tol=1e-13)
        h_printed = 0.5 * h
        g = math.sqrt(PI * h_printed) * (2 - erfc(math.sqrt(h_printed)))
        assert math.isclose(misprinted_smith(m, trial.direction(theta)), g / (g + 1), rel_tol=1e-13)
    # nothing hides facets of slopes that are all below 0.2 from a direction of slope 1, but the print hides 2 %
    assert masking(0.05, PI / 4) > 1 - 1e-12
    assert misprinted_smith(0.05, trial.direction(PI / 4)) < 0.985


def test_the_print_of_schlick1993() -> None:
    m = 0.3

    def G(theta: float) -> float:
        if theta == 0.0:
            return 1.0
        v = math.cos(theta)
        h = v * v / (2 * m * m * (1 - v * v))
        g = math.sqrt(h * PI) * (2 - erfc(math.sqrt(h)))
        return g / (g + 1)

    def formula(light: float, viewer: float, turn: float) -> float:
        t = trial.half_cosine(light, viewer, turn)
        D = math.exp(min((t * t - 1) / (m * m * t * t), 0.0)) / (m * m * t**4)
        return D * G(light) * G(viewer) / (4 * PI * math.cos(light) * math.cos(viewer))

    trial.assert_formula(member(geometry="smith", as_printed="schlick1993"), CookTorrance(m), formula)


@pytest.mark.parametrize("geometry", GEOMETRIES)
def test_reciprocal(geometry: str) -> None:
    for fresnel, as_printed in product(("one", "schlick", "exact"), ("no", "losasso", "schlick1993")):
        model = member(geometry=geometry, fresnel=fresnel, as_printed=as_printed)
        if model.reciprocal:
            trial.assert_reciprocal(model, CookTorrance(0.3, 0.04, 1.5, 0.0))


@pytest.mark.parametrize("geometry", GEOMETRIES)
@pytest.mark.parametrize("degrees", [0.0, 30.0, 60.0, 80.0])
def test_a_smooth_surface_is_a_mirror(geometry: str, degrees: float) -> None:
    trial.assert_close(trial.narrow_albedo(member(geometry=geometry), CookTorrance(1e-4), math.cos(math.radians(degrees))), 1.0)


@every_slope
def test_cavities_and_masking_keep_the_albedo_bounded_at_grazing_angles(m: float) -> None:
    """neumann1999 has it diverge (section 2.4, figure 5); that takes G = 1.

    With V-cavities f cos is at most D t / (2 u) per facet, whose integral stays below that over the facets, which is 1.
    """
    for geometry, mu in product(("v_cavity", "smith"), (0.1, 1e-3, 1e-6)):
        assert trial.narrow_albedo(member(geometry=geometry), CookTorrance(m), mu) < 1.0 + 2e-3
    bare = [trial.narrow_albedo(member(geometry="none"), CookTorrance(m), mu) for mu in (1e-4, 1e-6)]
    trial.assert_close(bare[1] / bare[0], 100.0, 5e-2)


@pytest.mark.parametrize("geometry", GEOMETRIES)
@pytest.mark.parametrize(("m", "mu"), [(0.3, 1.0), (0.3, 0.3), (1.0, 0.05)])
def test_density_is_normalised(geometry: str, m: float, mu: float) -> None:
    trial.assert_normalised(member(geometry=geometry), CookTorrance(m), mu)


@pytest.mark.parametrize(("geometry", "m", "mu"), [("smith", 0.6, 0.2), ("v_cavity", 0.6, 0.3)])
def test_samples_follow_the_density(monkeypatch: pytest.MonkeyPatch, geometry: str, m: float, mu: float) -> None:
    monkeypatch.setattr(trial, "SAMPLES", 20_000)
    trial.assert_follows_density(member(geometry=geometry), CookTorrance(m), mu, 2)


@pytest.mark.parametrize("geometry", ["v_cavity", "smith"])
def test_weights_of_facets_that_are_seen_are_at_most_1(geometry: str) -> None:
    """Where the density has the factor of the viewer, only that of the light is left."""
    model = member(geometry=geometry)
    assert model.sample is not None
    assert model.pdf is not None
    for m, mu in product((1e-4, 0.1, 1.0), (1.0, 0.5, 1e-3, 1e-9, 1e-12)):
        p, wo = CookTorrance(m), trial.at(mu, 0.4)
        for u1, u2 in product((1e-12, 0.2, 0.6, 0.999999), (1e-9, 0.3, 0.8)):
            wi = model.sample(p, wo, u1, u2)
            if wi.z > 0.0:
                weight = model.evaluate(p, wi, wo) * wi.z / model.pdf(p, wi, wo)
                assert 0.0 <= weight <= 1.0 + 1e-9, (m, mu, u1, u2)


def test_claims() -> None:
    assert any(isinstance(claim, EnergyConserving) for claim in MODEL.claims)
    assert any(isinstance(claim, DivergesAtGrazing) for claim in MODEL.claims)
