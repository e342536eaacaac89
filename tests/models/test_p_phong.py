"""The p-model (neumann1999 eq. 12): from Phong to stretched Phong."""

from __future__ import annotations

import math

import pytest
from scipy.special import beta

from albedo_lab.models.p_phong import MODEL, PPhong, evaluate
from albedo_lab.models.phong import MODEL as PHONG
from albedo_lab.models.phong import Phong
from albedo_lab.models.stretched_phong import MODEL as STRETCHED
from tests.models import trial

EXPONENTS = (0.0, 1.0, 2.5, 20.0)
every_exponent = pytest.mark.parametrize("n", EXPONENTS)


@every_exponent
@pytest.mark.parametrize("p", [0.0, 0.3, 1.0])
def test_formula(n: float, p: float) -> None:
    def printed(light: float, viewer: float, turn: float) -> float:
        return trial.mirror_lobe(light, viewer, turn, n) / trial.larger_cosine(light, viewer) ** p

    trial.assert_formula(MODEL, PPhong(n, p), printed)


def test_reciprocal() -> None:
    trial.assert_reciprocal(MODEL, *(PPhong(n, p) for n in EXPONENTS for p in (0.0, 0.3, 1.0)))


@every_exponent
def test_ends_are_phong_and_stretched_phong(n: float) -> None:
    for wi, wo in trial.random_pairs():
        assert evaluate(PPhong(n, 0.0), wi, wo) == PHONG.evaluate(Phong(n), wi, wo)
        assert math.isclose(evaluate(PPhong(n, 1.0), wi, wo), STRETCHED.evaluate(Phong(n), wi, wo), rel_tol=1e-12)


@every_exponent
def test_grows_with_p(n: float) -> None:
    for wi, wo in trial.random_pairs():
        values = [evaluate(PPhong(n, p), wi, wo) for p in (0.0, 0.2, 0.7, 1.0)]
        assert values == sorted(values)


@every_exponent
@pytest.mark.parametrize("p", [0.0, 0.3, 1.0])
def test_normal_incidence_does_not_depend_on_p(n: float, p: float) -> None:
    trial.assert_close(trial.narrow_albedo(MODEL, PPhong(n, p), 1.0), 2 * math.pi / (n + 2))


@pytest.mark.parametrize("n", [1.0, 20.0])
@pytest.mark.parametrize("p", [0.0, 0.3, 1.0])
def test_grazing_limit(n: float, p: float) -> None:
    """Over half a lobe that lies in the surface: cos^n sin^(2-p) dalpha cos^(1-p)(psi) dpsi."""
    limit = 0.5 * beta((n + 1) / 2, (3 - p) / 2) * beta((2 - p) / 2, 0.5)
    trial.assert_close(trial.narrow_albedo(MODEL, PPhong(n, p), 1e-9), limit, 1e-3)
