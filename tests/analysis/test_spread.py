"""How wide models are: against closed forms, and against scipy's quadrature of their formulas in plain Python."""

import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import quad

from albedo_lab import find
from albedo_lab.analysis import spread
from albedo_lab.analysis.spread import COMPARED, comparable, median_angle, share_within
from albedo_lab.model import Parameter
from albedo_lab.optics.frame import Direction

CONE = math.sin(COMPARED) ** 2
"""What Lambert's surface sends into the cone."""


def slow(model, p, angle):
    """The share within a cone, by scipy from the formula as Python runs it, for a model that is isotropic."""
    up = Direction(0.0, 0.0, 1.0)

    def ring(theta):
        return model.evaluate(p, up, Direction(math.sin(theta), 0.0, math.cos(theta))) * math.cos(theta) * math.sin(theta)

    near, far = (quad(ring, *ends, epsabs=0.0, epsrel=1e-11, limit=400)[0] for ends in ((0.0, angle), (angle, math.pi / 2)))
    return near / (near + far)


def holds(e, value):
    return abs(e.value - value) <= e.half_width + 1e-13 * abs(value)


def test_lambert_in_closed_form():
    model = find("lambert")
    p = model.bind({})
    for degrees in (1e-3, 20.0, 60.0, 89.0):
        assert holds(share_within(model, p, math.radians(degrees)), math.sin(math.radians(degrees)) ** 2)
    assert holds(median_angle(model, p), 45.0)
    assert comparable(model) is None


@pytest.mark.parametrize("n", [0.0, 3.0, 100.0, 1e5, 1e8])
def test_phong_in_closed_form(n):
    """f ~ cos^n theta: the share within theta is 1 - cos^(n + 2) theta."""
    model = find("phong")
    p = model.bind({"n": n})
    half = math.degrees(math.acos(0.5 ** (1.0 / (n + 2.0))))
    found = median_angle(model, p)
    assert found.value == pytest.approx(half, rel=1e-7)
    assert found.half_width < 1e-6 * half
    angle = 1.3 * math.radians(half)
    assert share_within(model, p, angle).value == pytest.approx(-math.expm1((n + 2.0) * math.log(math.cos(angle))), abs=1e-7)


def test_the_parameter_of_phong_in_closed_form():
    found = comparable(find("phong"))
    assert found.parameter == "n"
    assert found.value == float(f"{math.log(0.5) / math.log(math.cos(COMPARED)) - 2.0:.6g}")
    assert found.p.n == found.value
    assert abs(found.angle.value - 20.0) < 1e-4


@pytest.mark.parametrize("name", ["ward", "phong_original"])
def test_against_scipy(name):
    model = find(name)
    p = model.bind({})
    for degrees in (5.0, 20.0):
        assert share_within(model, p, math.radians(degrees)).value == pytest.approx(
            slow(model, p, math.radians(degrees)), abs=1e-10
        )
    found = comparable(model)
    assert slow(model, found.p, COMPARED) == pytest.approx(0.5, abs=1e-5)
    assert found.parameter in ("m", "n"), "of a shorthand and what it sets, the shorthand"


def test_a_dirac_part_lies_at_the_mirror_direction():
    mirror = find("mirror")
    assert median_angle(mirror, mirror.bind({})).value == 0.0
    assert comparable(mirror) is None
    half = replace(find("lambert"), name="half", mirror=lambda p, mu: 0.25)  # lambert's shape sends 1 in all
    assert holds(share_within(half, half.bind({}), COMPARED), (0.25 + CONE) / 1.25)


def test_an_anisotropic_lobe_is_averaged_over_the_azimuth():
    model = find("ward")
    p = model.bind({"m_x": 0.1, "m_y": 0.3})
    found = share_within(model, p, COMPARED)
    up = Direction(0.0, 0.0, 1.0)
    theta, weights = np.polynomial.legendre.leggauss(400)
    total = []
    for low, high in ((0.0, COMPARED), (COMPARED, math.pi / 2)):
        at = 0.5 * (high - low) * theta + 0.5 * (high + low)
        rings = [
            np.mean(
                [
                    model.evaluate(p, up, Direction(math.sin(t) * math.cos(a), math.sin(t) * math.sin(a), math.cos(t)))
                    for a in np.linspace(0.0, math.pi / 2, 33)[:-1] + math.pi / 128
                ]
            )
            for t in at
        ]
        total.append(0.5 * (high - low) * float(weights @ (rings * np.sin(at) * np.cos(at))))
    assert found.value == pytest.approx(total[0] / sum(total), abs=1e-7)
    assert found.half_width < 1e-4


def test_the_record_may_name_the_width():
    """A linear parameter is no width unless the record says so; a model without light has no median angle."""
    model = find("phong")
    linear = replace(model, parameters=(Parameter("n", "exponent", 100.0, 0.0, 500.0),))
    assert comparable(linear) is None
    assert comparable(replace(linear, width="n")).value == comparable(model).value
    dark = find("phong_blend")
    nothing = dark.bind({"d": 1.0, "D": 0.0})
    assert math.isnan(median_angle(dark, nothing).value)


def test_a_broken_twin_is_told_from_the_model(monkeypatch):
    """Without the sine of the ring, or with the light moved off the normal, the closed form is missed."""
    model = find("lambert")
    rings = spread._rings

    def flat(*of):
        inner = rings(*of)
        return lambda theta: tuple(part / np.sin(theta) for part in inner(theta))

    monkeypatch.setattr(spread, "_rings", flat)
    assert not holds(share_within(model, model.bind({}), COMPARED), CONE)
