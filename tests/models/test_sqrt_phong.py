"""Phong over the geometric mean of both cosines (neumann1999 section 2.2): rejected, for it diverges like mu^-1/2."""

from __future__ import annotations

import math

import pytest
from scipy.special import beta

from albedo_lab.models.phong import MODEL as PHONG
from albedo_lab.models.product_phong import MODEL as PRODUCT
from albedo_lab.models.sqrt_phong import MODEL, Phong, evaluate
from tests.models import trial

EXPONENTS = (0.0, 1.0, 2.5, 20.0)
every_exponent = pytest.mark.parametrize("n", EXPONENTS)


@every_exponent
def test_formula(n: float) -> None:
    def printed(light: float, viewer: float, turn: float) -> float:
        return trial.mirror_lobe(light, viewer, turn, n) / math.sqrt(math.cos(light) * math.cos(viewer))

    trial.assert_formula(MODEL, Phong(n), printed)


def test_reciprocal() -> None:
    trial.assert_reciprocal(MODEL, *map(Phong, EXPONENTS))


@every_exponent
def test_normal_incidence(n: float) -> None:
    trial.assert_close(trial.narrow_albedo(MODEL, Phong(n), 1.0), 2 * math.pi / (n + 1.5))


@every_exponent
def test_geometric_mean_of_phong_and_its_product_correction(n: float) -> None:
    p = Phong(n)
    for wi, wo in trial.random_pairs():
        mean = math.sqrt(PHONG.evaluate(p, wi, wo) * PRODUCT.evaluate(p, wi, wo))
        assert math.isclose(evaluate(p, wi, wo), mean, rel_tol=1e-12)


@every_exponent
@pytest.mark.parametrize("mu", [1e-7, 1e-9])
def test_diverges_like_the_root_of_one_over_the_cosine(n: float, mu: float) -> None:
    """Over half a lobe that lies in the surface: cos^n sin^(3/2) dalpha cos^(1/2)(psi) dpsi."""
    limit = 0.5 * beta((n + 1) / 2, 1.25) * beta(0.75, 0.5)
    trial.assert_close(math.sqrt(mu) * trial.narrow_albedo(MODEL, Phong(n), mu), limit, 1e-3)


def test_no_constant_conserves_energy() -> None:
    assert MODEL.paper_constant(Phong(5.0)) == 0.0
