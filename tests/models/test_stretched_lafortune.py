"""Stretched Lafortune (neumann1999 eq. 15, 16); what it has in common with Lafortune's lobes stands in their tests."""

from __future__ import annotations

import math

import pytest
from scipy.special import beta

from albedo_lab.models.lafortune import MODEL as LAFORTUNE
from albedo_lab.models.p_phong import MODEL as P_PHONG
from albedo_lab.models.p_phong import PPhong
from albedo_lab.models.phong import Phong, largest_constant
from albedo_lab.models.retro_phong import MODEL as RETRO
from albedo_lab.models.stretched_lafortune import MODEL, evaluate
from albedo_lab.models.stretched_phong import MODEL as STRETCHED_PHONG
from tests.models import trial
from tests.models.test_lafortune import LOBES, albedo, of, several

STRETCHES = (0.0, 0.3, 1.0)
every_stretch = pytest.mark.parametrize("p", STRETCHES)


@every_stretch
@pytest.mark.parametrize("lobe", LOBES, ids=str)
def test_formula(lobe: tuple[float, ...], p: float) -> None:
    """Eq. 15 is eq. 14 over a power of the larger cosine."""
    for light, viewer, turn in trial.GEOMETRIES:
        wi, wo = trial.direction(light, turn + 1.0), trial.direction(viewer, 1.0)
        expected = LAFORTUNE.evaluate(of(LAFORTUNE, lobe, C=0.7), wi, wo) / trial.larger_cosine(light, viewer) ** p
        assert math.isclose(evaluate(of(MODEL, lobe, C=0.7, p=p), wi, wo), expected, rel_tol=1e-12)


def test_reciprocal() -> None:
    trial.assert_reciprocal(MODEL, *(of(MODEL, lobe, p=p) for lobe in LOBES for p in STRETCHES))
    trial.assert_reciprocal(*several(MODEL, p_2=0.3))


@pytest.mark.parametrize("n", [0.0, 1.0, 20.0, 1000.0])
def test_equal_factors_are_the_stretched_phong_models(n: float) -> None:
    """Mirror, retro and the transition between; up to n roundings of R.V, beyond all digits where f is not visible any more."""
    for wi, wo in trial.random_pairs():
        whole, back = evaluate(of(MODEL, (1.0, 1.0, 1.0, n)), wi, wo), evaluate(of(MODEL, (-1.0, -1.0, 1.0, n)), wi, wo)
        assert math.isclose(whole, STRETCHED_PHONG.evaluate(Phong(n), wi, wo), rel_tol=1e-10, abs_tol=1e-30)
        assert math.isclose(back, RETRO.evaluate(Phong(n), wi, wo), rel_tol=1e-10, abs_tol=1e-30)
        for p in STRETCHES:
            f = evaluate(of(MODEL, (1.0, 1.0, 1.0, n), p=p), wi, wo)
            assert math.isclose(f, P_PHONG.evaluate(PPhong(n, p), wi, wo), rel_tol=1e-10, abs_tol=1e-30)


def test_every_lobe_has_its_own_stretch() -> None:
    """Eq. 16."""
    model, p = several(MODEL, p=0.0, p_2=0.5, p_3=1.0)
    plain, q = several(LAFORTUNE)
    assert plain.parts is not None
    for wi, wo in trial.random_pairs(50):
        larger = max(wi.z, wo.z)
        terms = (one.evaluate(lobe, wi, wo) for one, lobe in plain.parts(q))
        expected = sum(term / larger**stretch for term, stretch in zip(terms, (0.0, 0.5, 1.0), strict=True))
        assert math.isclose(model.evaluate(p, wi, wo), expected, rel_tol=1e-12)


@pytest.mark.parametrize("height", [1.0, 0.3, -1.0])
@pytest.mark.parametrize("n", [1.0, 20.0, 1000.0])
@every_stretch
def test_grazing_limit_does_not_depend_on_the_height_factor(n: float, height: float, p: float) -> None:
    """M R lies in the surface: as for the p-model over half a lobe, cos^n sin^(2-p) dalpha cos^(1-p)(psi) dpsi."""
    limit = float(0.5 * beta((n + 1) / 2, (3 - p) / 2) * beta((2 - p) / 2, 0.5))
    trial.assert_close(albedo(MODEL, of(MODEL, (1.0, 1.0, height, n), p=p), 1e-9), limit, 1e-4)


@pytest.mark.parametrize("lobe", [(1.0, 1.0, 1.0, 0.0), (1.0, 1.0, 1.0, 5.0), (0.7, 0.9, 0.8, 20.0)], ids=str)
def test_grows_with_the_stretch(lobe: tuple[float, ...]) -> None:
    """And not at all at normal incidence, where the larger cosine is 1."""
    for mu in (1.0, 0.5, 0.01):
        albedos = [albedo(MODEL, of(MODEL, lobe, p=p), mu) for p in STRETCHES]
        assert albedos == sorted(albedos)
        assert (albedos[0] < albedos[-1]) == (mu < 1.0)


@pytest.mark.parametrize("theta_deg", [30.0, 60.0])
def test_a_single_stretched_lobe_is_nearly_a_mirror(theta_deg: float) -> None:
    """Section 3.2: metals with a single lobe. At n = 1000 it falls short by tan(theta) sqrt(pi / (2 n)) / pi, up to 3 %."""
    theta, n = math.radians(theta_deg), 1000.0
    short = 1.0 - largest_constant(Phong(n)) * albedo(MODEL, of(MODEL, (1.0, 1.0, 1.0, n)), math.cos(theta))
    trial.assert_close(short, math.tan(theta) * math.sqrt(0.5 * math.pi / n) / math.pi, 0.1)
