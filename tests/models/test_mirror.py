"""Ideal mirror (neumann1999 §2.1, §2.4.1), and which of the lobes tend to it."""

from __future__ import annotations

import math

import pytest

from albedo_lab.errors import BadInput
from albedo_lab.model import Model
from albedo_lab.models.mirror import MODEL, Mirror
from albedo_lab.models.phong import MODEL as PHONG
from albedo_lab.models.phong import Phong, largest_constant
from albedo_lab.models.stretched_phong import MODEL as STRETCHED
from albedo_lab.optics.coordinates import Axis
from albedo_lab.optics.frame import Direction, mirror_of
from tests.models import trial

SHARPER = (1e2, 1e4, 1e6, 1e8)
every_angle = pytest.mark.parametrize("theta_deg", [0.0, 30.0, 60.0, 80.0])


@pytest.mark.parametrize("F", [0.0, 0.3, 1.0])
def test_everything_leaves_in_the_mirror_direction(F: float) -> None:
    for wi, wo in trial.random_pairs():
        assert MODEL.evaluate(Mirror(F), wi, wo) == 0.0
        assert MODEL.evaluate(Mirror(F), mirror_of(wo), wo) == 0.0
        assert MODEL.mirror(Mirror(F), wo.z) == F


def test_reflects_all_by_default_and_never_more() -> None:
    assert MODEL.mirror(MODEL.bind({}), 0.5) == 1.0
    with pytest.raises(BadInput):
        MODEL.bind({"F": 1.01})


def scene(w: Direction) -> float:
    """Some light that differs from place to place, its gradient nowhere steeper than 3."""
    return 2.0 + w.x - 0.5 * w.y + w.z * w.z


def seen(model: Model, n: float, theta_deg: float) -> tuple[float, float]:
    """The albedo, and the image of the scene, with the constant of ineq. 6."""
    p, wo = Phong(n), trial.direction(math.radians(theta_deg), 0.4)
    constant = largest_constant(p)

    def image(wi: Direction) -> float:
        return constant * float(model.evaluate(p, wi, wo)) * wi.z * scene(wi)

    return constant * trial.narrow_albedo(model, p, wo.z, 0.4), trial.over_hemisphere(Axis.MIRROR, wo, image)


def deficit(n: float, theta_deg: float) -> float:
    """What a sharp stretched lobe falls short of 1 by, to first order in its width.

    Only directions lower than the axis count less: by wi.z / wo.z = 1 - tan(theta) alpha cos(psi), where alpha has the mean
    sqrt(pi / (2 n)) and cos(psi) over half a turn, the other half counting nothing, the mean 1 / pi.
    """
    return math.tan(math.radians(theta_deg)) * math.sqrt(0.5 * math.pi / n) / math.pi


@every_angle
def test_stretched_phong_tends_to_it(theta_deg: float) -> None:
    """Albedo 1 and the very image of the scene, which a blur of two mean angles may change by 3 apiece.

    The plain integral errs by 2e-5; the next order of the deficit is 3 % of it at n = 1e4.
    """
    expected = scene(mirror_of(trial.direction(math.radians(theta_deg), 0.4)))
    for n in SHARPER:
        albedo, image = seen(STRETCHED, n, theta_deg)
        short = deficit(n, theta_deg)
        assert math.isclose(1.0 - albedo, short, rel_tol=0.3 if n < 1e4 else 0.05, abs_tol=2e-5)
        assert abs(image - expected * albedo) < 2.0 * 3.0 * math.sqrt(0.5 * math.pi / n) + 1e-4


@every_angle
def test_phong_does_not(theta_deg: float) -> None:
    """Its lobe is as bright at every angle, so a sharp one reflects cos(theta): half at 60 degrees."""
    theta = math.radians(theta_deg)
    albedo, image = seen(PHONG, 1e8, theta_deg)
    trial.assert_close(albedo, math.cos(theta))
    trial.assert_close(image, math.cos(theta) * scene(mirror_of(trial.direction(theta, 0.4))))
