"""Ward (neumann1999 eq. 34), and its anisotropic form; and what the modified model has in common with it."""

from __future__ import annotations

import math

import pytest
from scipy.integrate import quad

from albedo_lab.model import Model
from albedo_lab.models.modified_ward import MODEL as MODIFIED
from albedo_lab.models.ward import MODEL, Ward, evaluate, evaluate_by_chord, make, pdf, sample, sample_chord_normal, weight
from albedo_lab.optics.frame import Direction
from tests.models import trial

WIDTHS = (0.05, 0.3, 1.0)
every_width = pytest.mark.parametrize("m", WIDTHS)
both_models = pytest.mark.parametrize("model", [MODEL, MODIFIED], ids=lambda model: model.name)
ANISOTROPIC = Ward(0.1, 0.4)


@every_width
def test_formula(m: float) -> None:
    def printed(light: float, viewer: float, turn: float) -> float:
        tan_delta = math.tan(math.acos(min(trial.half_cosine(light, viewer, turn), 1.0)))
        return math.exp(-((tan_delta / m) ** 2)) / (4 * math.pi * m * m) / math.sqrt(math.cos(light) * math.cos(viewer))

    trial.assert_formula(MODEL, Ward(m, m), printed)


@pytest.mark.parametrize("phi", [0.0, 0.5, math.pi / 2])
def test_anisotropic_formula_for_a_viewer_at_the_normal(phi: float) -> None:
    """The half-vector then has the light's azimuth and half its angle."""
    theta = 0.6
    width = (math.cos(phi) / 0.1) ** 2 + (math.sin(phi) / 0.4) ** 2
    expected = math.exp(-(math.tan(theta / 2) ** 2) * width) / (4 * math.pi * 0.1 * 0.4) / math.sqrt(math.cos(theta))
    assert math.isclose(evaluate(ANISOTROPIC, trial.direction(theta, phi), trial.at(1.0)), expected, rel_tol=1e-12)


@both_models
def test_a_quarter_turn_swaps_the_widths(model: Model) -> None:
    for wi, wo in trial.random_pairs():
        turned = Direction(-wi.y, wi.x, wi.z), Direction(-wo.y, wo.x, wo.z)
        expected = model.evaluate(Ward(0.4, 0.1), *turned)
        assert math.isclose(model.evaluate(ANISOTROPIC, wi, wo), expected, rel_tol=1e-12)


@both_models
def test_m_sets_both_widths(model: Model) -> None:
    assert model.bind({"m": 0.3}) == Ward(0.3, 0.3)
    assert model.bind({"m": 0.3, "m_y": 0.2}) == Ward(0.3, 0.2)
    assert model.isotropic(Ward(0.3, 0.3))
    assert not model.isotropic(ANISOTROPIC)


@both_models
def test_reciprocal(model: Model) -> None:
    trial.assert_reciprocal(model, ANISOTROPIC, *(Ward(m, m) for m in WIDTHS))


@both_models
def test_weight(model: Model) -> None:
    trial.assert_weight_is_contract(model, ANISOTROPIC, *(Ward(m, m) for m in (*WIDTHS, 1e-4)))


@every_width
def test_normal_incidence(m: float) -> None:
    """With t = tan^2(theta/2), c = (1-t)/(1+t) and dc = 2 dt / (1+t)^2."""

    def integrand(t: float) -> float:
        return math.exp(-t / (m * m)) / (m * m) * math.sqrt((1 - t) / (1 + t)) / (1 + t) ** 2

    trial.assert_close(trial.wide_albedo(MODEL, Ward(m, m), 1.0), quad(integrand, 0.0, 1.0)[0])


@pytest.mark.parametrize("mu", [1.0, 0.5, 0.1])
def test_a_smooth_surface_darkens_like_the_cosine(mu: float) -> None:
    """Of (wo.h) cos^3(delta) sqrt(z/mu) there stays mu: the constant 1 / (4 pi m^2) is one for normal incidence."""
    trial.assert_close(trial.narrow_albedo(MODEL, Ward(1e-4, 1e-4), mu), mu)


@pytest.mark.parametrize("p", [Ward(0.1, 0.1), Ward(1.0, 1.0), ANISOTROPIC])
def test_diverges_like_the_root_of_one_over_the_cosine(p: Ward) -> None:
    rise = trial.narrow_albedo(MODEL, p, 1e-8, 0.3) / trial.narrow_albedo(MODEL, p, 1e-6, 0.3)
    trial.assert_close(rise, 10.0, 1e-3)


@every_width
def test_at_least_the_modified_model(m: float) -> None:
    """The geometric mean of the cosines is not above the larger one."""
    for wi, wo in trial.random_pairs():
        assert evaluate(Ward(m, m), wi, wo) >= MODIFIED.evaluate(Ward(m, m), wi, wo) * (1 - 1e-12)


# The half-vector form


CHORD = make(form="half_vector", as_printed="no")
CHORD_AS_PRINTED = make(form="half_vector", as_printed="yes")
SETS = (ANISOTROPIC, *(Ward(m, m) for m in (*WIDTHS, 1e-4)))


def test_the_tangent_form_is_printed_right() -> None:
    """The default, and as_printed changes nothing."""
    assert MODEL is make(form="tangent", as_printed="no")
    for model in (MODEL, make(form="tangent", as_printed="yes")):
        assert (model.evaluate, model.sample, model.pdf, model.weight) == (evaluate, sample, pdf, weight)
    assert MODEL.member({"form": "half_vector", "as_printed": True})[0] is CHORD_AS_PRINTED


def test_the_half_vector_form_is_losassos() -> None:
    """1 / (4 pi m_x m_y) exp(-2 ((H.X / m_x)^2 + (H.Y / m_y)^2) / (1 + H.N)) / sqrt(N.L N.V); without the pi as printed."""
    for p in (ANISOTROPIC, Ward(0.3, 0.3), Ward(1.0, 0.2)):
        for wi, wo in trial.random_pairs():
            x, y, z = wi.x + wo.x, wi.y + wo.y, wi.z + wo.z
            norm = math.sqrt(x * x + y * y + z * z)
            exponent = -2 * ((x / norm / p.m_x) ** 2 + (y / norm / p.m_y) ** 2) / (1 + z / norm)
            printed = math.exp(exponent) / (4 * p.m_x * p.m_y) / math.sqrt(wi.z * wo.z)
            assert math.isclose(CHORD_AS_PRINTED.evaluate(p, wi, wo), printed, rel_tol=1e-12, abs_tol=1e-300)
            assert math.isclose(CHORD.evaluate(p, wi, wo), printed / math.pi, rel_tol=1e-12, abs_tol=1e-300)


@every_width
def test_both_forms_agree_for_a_small_angle(m: float) -> None:
    """tan^2 a - (2 sin(a/2))^2 = 3/4 a^4 + O(a^6): the chord's Gaussian is the larger one, everywhere."""
    p, wo, a = Ward(m, m), trial.direction(0.6), 1e-2
    wi = trial.direction(0.6 - 2 * a, math.pi)
    ratio = evaluate_by_chord(p, wi, wo) / evaluate(p, wi, wo)
    assert math.isclose(math.log(ratio), 0.75 * a**4 / (m * m), rel_tol=1e-3)
    for pair in trial.random_pairs():
        assert evaluate_by_chord(p, *pair) >= evaluate(p, *pair) * (1 - 1e-12)


def test_the_half_vector_form_is_reciprocal() -> None:
    trial.assert_reciprocal(CHORD, *SETS)
    trial.assert_reciprocal(CHORD_AS_PRINTED, *SETS)


@every_width
def test_normal_incidence_of_the_half_vector_form(m: float) -> None:
    """f cos dw' = u sqrt(v') exp(-2 (1-u) / m^2) 2 du / m^2, with u = N.H = wo.h and v' = 2 u^2 - 1."""

    def integrand(u: float) -> float:
        return 2.0 * u * math.sqrt(2 * u * u - 1) * math.exp(-2 * (1 - u) / (m * m)) / (m * m)

    expected = quad(integrand, math.sqrt(0.5), 1.0, points=[1.0 - 5 * m * m] if m < 0.2 else None)[0]
    trial.assert_close(trial.wide_albedo(CHORD, Ward(m, m), 1.0), expected)


@pytest.mark.parametrize("mu", [1.0, 0.5, 0.1])
def test_the_smooth_half_vector_form_darkens_like_the_cosine_too(mu: float) -> None:
    p = Ward(1e-4, 1e-4)
    trial.assert_close(trial.narrow_albedo(CHORD, p, mu), mu)
    trial.assert_close(trial.narrow_albedo(CHORD_AS_PRINTED, p, mu), math.pi * mu)


@pytest.mark.parametrize("p", [Ward(0.1, 0.1), Ward(1.0, 1.0), ANISOTROPIC])
def test_the_half_vector_form_diverges_as_well(p: Ward) -> None:
    rise = trial.narrow_albedo(CHORD, p, 1e-8, 0.3) / trial.narrow_albedo(CHORD, p, 1e-6, 0.3)
    trial.assert_close(rise, 10.0, 1e-3)


def test_chords_are_gaussian() -> None:
    """1 - cos of the normal is exponential with rate 2 ((cos / m_x)^2 + (sin / m_y)^2), given its azimuth, in every quadrant."""
    p = Ward(0.2, 0.7)
    for u1, u2 in ((0.9, 0.1), (0.3, 0.3), (0.5, 0.6), (0.1, 0.95)):
        h = sample_chord_normal(p, u1, u2)
        phi = math.atan2(h.y, h.x)
        rate = 2 * ((math.cos(phi) / p.m_x) ** 2 + (math.sin(phi) / p.m_y) ** 2)
        assert math.isclose(math.exp(-rate * (1 - h.z)), u1, rel_tol=1e-12)
        assert math.isclose(h.x**2 + h.y**2 + h.z**2, 1.0, rel_tol=1e-12)
        assert math.isclose(math.tan(phi) * p.m_x / p.m_y, math.tan(2 * math.pi * u2), rel_tol=1e-9)
        assert h.x * math.cos(2 * math.pi * u2) > 0.0


def test_normals_below_the_horizon_are_rejected() -> None:
    """Those longer than a diameter as well: a unit vector below the horizon, and no weight."""
    p, wo = Ward(1.0, 1.0), trial.at(0.5)
    for u1 in (0.5, 0.2, math.exp(-2.0), 0.1, 0.017, 1e-9):
        wi = CHORD.sample(p, wo, u1, 0.5)  # type: ignore[misc]
        assert math.isclose(wi.x**2 + wi.y**2 + wi.z**2, 1.0, rel_tol=1e-12)
        if u1 < math.exp(-2.0):
            assert wi.z <= 0.0
            assert CHORD.weight(p, wo, u1, 0.5) == 0.0  # type: ignore[misc]


def test_weight_of_the_half_vector_form() -> None:
    trial.assert_weight_is_contract(CHORD, *SETS)
    trial.assert_weight_is_contract(CHORD_AS_PRINTED, ANISOTROPIC)


@pytest.mark.parametrize("p", SETS)
def test_density_of_the_half_vector_form(p: Ward) -> None:
    for mu in (1.0, 0.3, 1e-6):
        trial.assert_normalised(CHORD, p, mu)


@pytest.mark.parametrize(("p", "mu"), [(Ward(1.0, 1.0), 0.2), (Ward(0.3, 0.6), 0.7)])
def test_samples_of_the_half_vector_form_follow_their_density(p: Ward, mu: float) -> None:
    trial.assert_follows_density(CHORD, p, mu, 2)
