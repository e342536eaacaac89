"""The supremum of the albedo: found, bounded, and checked against suprema that an independent method found."""

import json
import math
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
from scipy.special import beta

from albedo_lab import normalise
from albedo_lab.analysis.supremum import grazing_limit, supremum
from albedo_lab.catalogue import find

REFERENCE = json.loads((Path(__file__).parents[1] / "oracles" / "reference.json").read_text())
SUPREMA = REFERENCE["supremum"]


@pytest.mark.parametrize("cell", SUPREMA, ids=lambda cell: f"{cell['model']}-{cell['parameters']}")
def test_the_constant_lies_within_its_interval_of_the_oracle(cell: dict[str, Any]) -> None:
    table = normalise(cell["model"], method="quadrature", **cell["parameters"])
    true = 1.0 / cell["supremum"]
    error = cell["error"] / cell["supremum"] ** 2
    assert table.ci95_low[0] - error <= true <= table.ci95_high[0] + error
    assert abs(table.constant[0] / true - 1.0) < 1e-8


@pytest.mark.parametrize(
    ("name", "values"), [("blinn", {"n": 2}), ("stretched_blinn", {"n": 1}), ("schlick_isotropic", {"r": 0.5})]
)
def test_rqmc_measures_what_quadrature_finds(name: str, values: dict[str, float]) -> None:
    """5 standard errors; the place of the peak comes from the same search."""
    exact = normalise(name, method="quadrature", **values)
    found = normalise(name, tolerance=1e-5, method="rqmc", **values)
    assert abs(found.constant[0] - exact.constant[0]) <= 5.0 * found.standard_error[0]
    assert found.ci95_high[0] - found.ci95_low[0] <= 2e-5
    assert found.peak_theta_deg[0] == exact.peak_theta_deg[0]


@pytest.mark.parametrize("name", ["product_phong", "sqrt_phong", "ward"])
def test_an_unbounded_albedo_gives_constant_0_and_says_so(name: str) -> None:
    table = normalise(name)
    assert (table.constant[0], table.behaviour[0], table.peak_theta_deg[0]) == (0.0, "diverges", 90.0)


def test_the_two_orders_of_a_model_that_is_not_reciprocal() -> None:
    """Over the light the peak is at the normal, (n+1)/2pi; over the viewer, the order of the energy balance, it diverges."""
    table = normalise("phong_original", n=20)
    assert table.order.tolist() == ["wi", "wo"]
    assert table.constant[0] == pytest.approx(21 / (2 * math.pi), rel=1e-5)
    assert (table.constant[1], table.behaviour[1]) == (0.0, "diverges")


def test_a_peak_at_grazing_is_found_as_a_limit() -> None:
    """plus_phong: 2/(cosL + cosV) tends to 2/cosL, half the lobe is above the horizon, so a(0) = 2 pi / (n+1)."""
    table = normalise("plus_phong", n=20, method="quadrature")
    assert table.peak_theta_deg[0] == 90.0
    assert table.constant[0] == pytest.approx(21 / (2 * math.pi), rel=1e-8)


def test_an_inner_peak_is_located() -> None:
    """neumann1999 §2.2: for n = 1 the stretched model overshoots most at 13 degrees."""
    found = supremum(find("stretched_phong"), find("stretched_phong").bind({"n": 1}))
    assert math.degrees(math.acos(found.mu)) == pytest.approx(13.0, abs=1.0)


def test_an_anisotropic_peak_is_searched_over_both_angles() -> None:
    """The supremum over (theta, phi) is no less than along either axis, and its place has that albedo."""
    table = normalise("modified_ward", m_x=0.05, m_y=0.6, method="quadrature")
    assert "peak_phi_deg" in table
    rough = replace(find("modified_ward"), isotropic=lambda p: True)
    along_axis = normalise(rough, m_x=0.05, m_y=0.6, method="quadrature")
    assert table.constant[0] <= along_axis.constant[0] * (1.0 + 1e-9)


def test_a_black_model_may_carry_any_constant() -> None:
    assert normalise("lambert", albedo=0).constant[0] == math.inf


def test_a_model_that_is_nan_somewhere_has_no_constant_and_says_so() -> None:
    lambert = find("lambert")
    table = normalise(replace(lambert, evaluate=lambda p, wi, wo: math.nan if wo.z < 0.5 and wi.x > 0.9 else 1.0))
    assert math.isnan(table.constant[0])
    assert table.behaviour[0] == "undefined"


def test_grazing_limits() -> None:
    """Closed forms: eq. 26 for the stretched model, B((n+1)/2, 3/2) for the plain one."""
    for n in (1.0, 20.0, 1000.0):
        stretched, plain = find("stretched_phong"), find("phong")
        limit = grazing_limit(stretched, stretched.bind({"n": n}), 0.0, "wi")
        assert abs(limit.value - math.pi / (n + 1)) <= limit.half_width
        limit = grazing_limit(plain, plain.bind({"n": n}), 0.0, "wi")
        assert abs(limit.value - beta((n + 1) / 2, 1.5)) <= limit.half_width


def test_a_scaled_model_is_caught() -> None:
    """Negative control: one percent more light is a constant one percent lower, far outside the interval."""
    blinn = find("blinn")
    original = blinn.evaluate
    louder = replace(blinn, evaluate=lambda p, wi, wo: 1.01 * original(p, wi, wo))
    true, off = normalise(blinn, n=4), normalise(louder, n=4)
    assert off.ci95_high[0] < true.ci95_low[0]
