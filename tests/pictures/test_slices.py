import math

import numpy as np
import pytest

from albedo_lab.errors import BadInput
from albedo_lab.measured.cells import LOWEST, SHAPE
from albedo_lab.pictures.base import Curve
from albedo_lab.pictures.slices import Slices


def traced(model, *phi_d_deg, **parameters):
    return Slices((Curve("it", model, parameters),), phi_d_deg or (90.0,)).trace()[""]


def test_a_model_of_the_half_vector_alone_is_a_function_of_theta_h():
    table = traced("blinn", 30.0, n=7.0, scale=1.0)
    seen = table[table.above]
    np.testing.assert_allclose(seen.value, np.cos(np.radians(seen.theta_h_deg)) ** 7, rtol=1e-9)
    assert table.value[~table.above].isna().all()


def test_a_model_of_the_difference_angle_alone_is_a_function_of_theta_d():
    """cos of the angle between light and viewer, to a power: retro-reflection, before the larger cosine."""
    table = traced("retro_phong", 90.0, n=3.0, scale=1.0)
    theta_h, theta_d = np.radians(table.theta_h_deg), np.radians(table.theta_d_deg)
    along = np.maximum(np.cos(2.0 * theta_d), 0.0) ** 3  # at phi_d = 90 both cosines are cos(theta_h) cos(theta_d)
    np.testing.assert_allclose(table.value, along / (np.cos(theta_h) * np.cos(theta_d)), rtol=1e-7, atol=1e-12)


def test_the_angles_are_the_centres_of_the_cells_of_a_table():
    table = traced("lambert")
    theta_h, theta_d = (table[name].to_numpy().reshape(SHAPE[:2]) for name in ("theta_h_deg", "theta_d_deg"))
    np.testing.assert_allclose(theta_d[0], np.arange(90) + 0.5)
    np.testing.assert_allclose(theta_h[:, 0], (np.arange(90) + 0.5) ** 2 / 90.0)
    assert np.ptp(theta_h, axis=1).max() < 1e-12
    np.testing.assert_allclose(table.value, 1.0 / math.pi)


def test_what_lies_below_the_horizon():
    table = traced("lambert", 0.0, 90.0)
    flat, upright = (table[table.phi_d_deg == phi] for phi in (0.0, 90.0))
    np.testing.assert_array_equal(flat.above, flat.theta_h_deg + flat.theta_d_deg < 90.0)
    assert upright.above.all()
    assert math.cos(math.radians(float(upright.theta_h_deg.max()))) > LOWEST


def test_a_curve_after_the_other_and_a_slice_after_the_other():
    table = Slices((Curve("a", "lambert"), Curve("b", "lambert", {"albedo": 0.5})), (90.0, 10.0)).trace()[""]
    blocks = table.iloc[:: SHAPE[0] * SHAPE[1]]
    assert list(zip(blocks.curve, blocks.phi_d_deg, strict=True)) == [("a", 90.0), ("a", 10.0), ("b", 90.0), ("b", 10.0)]
    assert table[table.curve == "b"].value.dropna().max() == pytest.approx(0.5 / math.pi)


@pytest.mark.parametrize("phi_d", [-1.0, 180.0, math.nan])
def test_no_other_slices(phi_d):
    with pytest.raises(BadInput, match=r"phi_d_deg = .*: must be in \[0, 180\)"):
        traced("lambert", phi_d)
