"""Modified Ward (neumann1999 eq. 35), and its anisotropic form; what it shares with Ward stands in test_ward."""

from __future__ import annotations

import math

import pytest
from scipy.integrate import quad

from albedo_lab.models.modified_ward import MODEL, evaluate
from albedo_lab.models.ward import MODEL as WARD
from albedo_lab.models.ward import Ward
from tests.models import trial

WIDTHS = (0.05, 0.3, 1.0)
every_width = pytest.mark.parametrize("m", WIDTHS)
ANISOTROPIC = Ward(0.1, 0.4)


@every_width
def test_formula(m: float) -> None:
    def printed(light: float, viewer: float, turn: float) -> float:
        tan_delta = math.tan(math.acos(min(trial.half_cosine(light, viewer, turn), 1.0)))
        return math.exp(-((tan_delta / m) ** 2)) / (4 * math.pi * m * m) / trial.larger_cosine(light, viewer)

    trial.assert_formula(MODEL, Ward(m, m), printed)


@pytest.mark.parametrize("phi", [0.0, 0.5, math.pi / 2])
def test_anisotropic_formula_for_a_viewer_at_the_normal(phi: float) -> None:
    """The half-vector then has the light's azimuth and half its angle."""
    theta = 0.6
    width = (math.cos(phi) / 0.1) ** 2 + (math.sin(phi) / 0.4) ** 2
    expected = math.exp(-(math.tan(theta / 2) ** 2) * width) / (4 * math.pi * 0.1 * 0.4)
    assert math.isclose(evaluate(ANISOTROPIC, trial.direction(theta, phi), trial.at(1.0)), expected, rel_tol=1e-12)


@every_width
def test_normal_incidence(m: float) -> None:
    """With t = tan^2(theta/2), c = (1-t)/(1+t) and dc = 2 dt / (1+t)^2."""

    def integrand(t: float) -> float:
        return math.exp(-t / (m * m)) / (m * m) * (1 - t) / (1 + t) ** 3

    trial.assert_close(trial.wide_albedo(MODEL, Ward(m, m), 1.0), quad(integrand, 0.0, 1.0)[0])


@pytest.mark.parametrize("m", [0.1, 0.03, 1e-4])
def test_the_constant_tends_to_one_as_the_surface_gets_smooth(m: float) -> None:
    """The integral above is 1 - 4 m^2 + O(m^4), so that C_max = 1 + 4 m^2: 1.04 for m = 0.1, as table 4 prints."""
    assert abs(1.0 / trial.narrow_albedo(MODEL, Ward(m, m), 1.0) - (1 + 4 * m * m)) < 20 * m**4 + 1e-5


@pytest.mark.parametrize("mu", [0.5, 0.1])
def test_a_smooth_surface_darkens_like_the_cosine(mu: float) -> None:
    """Of (wo.h) cos^3(delta) z/max(z, mu) there stays mu, up to the width of the lobe."""
    trial.assert_close(trial.narrow_albedo(MODEL, Ward(1e-4, 1e-4), mu), mu, 1e-3)


@pytest.mark.parametrize("p", [Ward(0.1, 0.1), Ward(1.0, 1.0), ANISOTROPIC])
def test_bounded_at_grazing_angles(p: Ward) -> None:
    """Unlike Ward's: it tends to a limit."""
    near, nearer = (trial.narrow_albedo(MODEL, p, mu, 0.3) for mu in (1e-7, 1e-9))
    trial.assert_close(near, nearer, 1e-3)
    assert near < 1.0


def test_equal_to_ward_where_both_cosines_are() -> None:
    for _, wo in trial.random_pairs():
        wi = trial.at(wo.z, 1.0)
        assert math.isclose(evaluate(ANISOTROPIC, wi, wo), WARD.evaluate(ANISOTROPIC, wi, wo), rel_tol=1e-12)
