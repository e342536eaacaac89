"""Directions and profiles: the geometry that every model stands on, against plain trigonometry."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from albedo_lab.optics.frame import Direction, about_axis, bisector, cosine_power, dot, length, mirror_of, normal_power, reflect
from albedo_lab.optics.profiles import GAUSS, POWER, TANGENT, Profile, normal_from_slopes, power_lobe

angles = st.floats(0.0, math.pi / 2)
azimuths = st.floats(0.0, 2.0 * math.pi)


def at(theta: float, phi: float) -> Direction:
    """A direction by its angles."""
    return Direction(math.sin(theta) * math.cos(phi), math.sin(theta) * math.sin(phi), math.cos(theta))


@given(angles, azimuths, angles, azimuths)
def test_about_axis_keeps_angle_and_length(theta: float, phi: float, off: float, turn: float) -> None:
    axis = at(theta, phi)
    w = about_axis(axis, math.sin(off), math.cos(off), (math.sin(turn), math.cos(turn)))
    assert length(w) == pytest.approx(1.0, abs=1e-14)
    assert dot(axis, w) == pytest.approx(math.cos(off), abs=1e-14)


@given(angles, angles)
def test_azimuth_0_leads_towards_the_normal(theta: float, off: float) -> None:
    """For an axis in the plane y = 0 on the negative side, as the mirror direction is."""
    axis = mirror_of(at(theta, 0.0))
    w = about_axis(axis, math.sin(off), math.cos(off), (0.0, 1.0))
    assert w.z == pytest.approx(math.cos(theta - off), abs=1e-14)


@given(angles, azimuths, angles, azimuths)
def test_reflection_has_the_half_vector_for_its_bisector(theta: float, phi: float, tilt: float, turn: float) -> None:
    w, h = at(theta, phi), at(tilt, turn)
    r = reflect(w, h)
    v = bisector(w, r)
    assert length(r) == pytest.approx(1.0, abs=1e-14)
    assert dot(v, h) == pytest.approx(2.0 * dot(w, h), abs=1e-14)
    assert length(v) == pytest.approx(2.0 * abs(dot(w, h)), abs=1e-14)


@pytest.mark.parametrize("n", [0.0, 1.0, 20.0, 1e4])
@given(off=st.floats(0.0, math.pi), tilt=st.floats(0.0, 1.5))
def test_cosine_powers(n: float, off: float, tilt: float) -> None:
    expected = math.cos(off) ** n if math.cos(off) > 1e-9 else 0.0
    if not -1e-9 < math.cos(off) < 1e-9:
        assert cosine_power(at(0.0, 0.0), at(off, 1.0), n) == pytest.approx(expected, rel=1e-10, abs=1e-300)
    assert normal_power(at(tilt, 0.3), n) == pytest.approx(math.cos(tilt) ** n, rel=1e-10, abs=1e-300)


def test_narrow_lobes_keep_their_digits() -> None:
    """cos^n at n = 1e8 and 1e-4 from the axis is exp(-0.5) to 11 digits; from the dot product only to 8."""
    off, n = 1e-4, 1e8
    expected = math.exp(n * math.log1p(-2.0 * math.sin(off / 2) ** 2))
    assert cosine_power(at(0.5, 0.0), at(0.5 + off, 0.0), n) == pytest.approx(expected, rel=1e-10)
    assert abs(dot(at(0.5, 0.0), at(0.5 + off, 0.0)) ** n / expected - 1.0) > 1e-10


@pytest.mark.parametrize("profile", [POWER, GAUSS, TANGENT])
@pytest.mark.parametrize("n", [0.0, 1.0, 1e4, 1e8])
def test_profiles_invert_and_their_measure_is_rho_drho(profile: Profile, n: float) -> None:
    for y in np.linspace(0.05, min(profile.end, 4.0) * 0.9, 9):
        rho, measure = profile.slope(float(y), n)
        assert profile.coordinate(rho, n) == pytest.approx(y, rel=1e-12)
        step = 1e-5
        derivative = (profile.slope(y + step, n)[0] - profile.slope(y - step, n)[0]) / (2.0 * step)
        assert measure == pytest.approx(rho * derivative, rel=1e-6)


def test_samples_of_a_lobe_follow_their_survival() -> None:
    """cos^(n+1) is uniform."""
    for n in (0.0, 3.0, 1e8):
        for u in (1e-6, 0.3, 0.999):
            s, c = power_lobe(math.log(u), n)
            assert s * s + c * c == pytest.approx(1.0, abs=1e-15)
            log_cosine = math.log(c) if c < 0.9 else 0.5 * math.log1p(-s * s)
            assert (n + 1.0) * log_cosine == pytest.approx(math.log(u), rel=1e-9)


def test_normals_from_slopes() -> None:
    h = normal_from_slopes(0.3, -0.4)
    assert (h.x / h.z, h.y / h.z) == pytest.approx((0.3, -0.4))
    assert length(h) == pytest.approx(1.0)
