"""The tables that analyses return: columns, grids, options, defaults, errors."""

import math
from dataclasses import replace

import numpy as np
import pytest

from albedo_lab import BadInput, Inconclusive, albedo, mean_albedo, normalise
from albedo_lab.catalogue import find

FIGURES = ["standard_error", "ci95_low", "ci95_high", "samples", "method", "seed", "non_finite"]


def test_columns_of_albedo() -> None:
    table = albedo("stretched_phong", theta_deg=[0, 60], n=[1, 100], method="quadrature")
    assert list(table.columns) == ["model", "n", "scale", "theta_deg", "albedo", *FIGURES, "order"]
    assert table.n.tolist() == [1, 1, 100, 100]
    assert table.theta_deg.tolist() == [0, 60, 0, 60]
    assert ((table.ci95_low <= table.albedo) & (table.albedo <= table.ci95_high)).all()


def test_azimuth_is_reported_for_anisotropic_models_only() -> None:
    table = albedo("ward", theta_deg=60, phi_deg=[0, 90], m_x=0.1, m_y=0.3, method="quadrature")
    assert list(table.columns)[:9] == ["model", "form", "as_printed", "m", "m_x", "m_y", "scale", "theta_deg", "phi_deg"]
    assert table.phi_deg.tolist() == [0, 90]
    assert math.isnan(table.m[0])
    assert table.albedo[0] != table.albedo[1]
    assert "phi_deg" not in albedo("ward", theta_deg=60, phi_deg=[0, 90], m=0.1, method="quadrature")


def test_choices_are_columns_and_members_with_other_parameters_leave_cells_empty() -> None:
    table = albedo("lafortune", theta_deg=60, lobes=[1, 2], C_x=0.9, scale=1, method="quadrature")
    parameters = ["C_x", "C_y", "C_z", "n", "C", "C_x_2", "C_y_2", "C_z_2", "n_2", "C_2"]
    assert list(table.columns)[:15] == ["model", "lobes", *parameters, "scale", "theta_deg", "phi_deg"]
    assert table.n_2.tolist() == [pytest.approx(math.nan, nan_ok=True), 20.0]


def test_a_parameter_that_only_some_members_have_is_refused_by_the_others() -> None:
    with pytest.raises(BadInput, match=r"n_2 = 5.*lafortune \(lobes = 1\)"):
        albedo("lafortune", theta_deg=60, n_2=5)


def test_a_shape_without_light_has_no_largest_constant() -> None:
    assert normalise("lafortune", C=0.0).constant[0] == math.inf
    assert albedo("lafortune", theta_deg=60, C=0.0, scale=1).albedo[0] == 0.0
    with pytest.raises(BadInput, match=r"scale = inf: must be given.*reflects nothing"):
        albedo("lafortune", theta_deg=60, C=0.0)


def test_a_dirac_part_is_in_every_quantity() -> None:
    for method in ("quadrature", "rqmc", "mc"):
        assert albedo("mirror", mu=[1.0, 1e-9], F=0.25, method=method).albedo.tolist() == pytest.approx([0.25, 0.25], abs=1e-8)
        assert mean_albedo("mirror", F=0.25, method=method, tolerance=1e-3).mean_albedo[0] == pytest.approx(0.25, abs=1e-3)
    assert normalise("mirror", F=0.25).constant[0] == pytest.approx(4.0)


def test_columns_of_mean_albedo_and_normalise() -> None:
    assert list(mean_albedo("phong", n=1).columns) == ["model", "n", "scale", "mean_albedo", *FIGURES, "order"]
    assert list(normalise("phong", n=1).columns) == [
        *["model", "n", "constant", *FIGURES, "peak_theta_deg", "paper_constant", "behaviour", "order"]
    ]


def test_a_parameter_that_bears_the_name_of_the_quantity_keeps_a_column_of_its_own() -> None:
    table = albedo("lambert", theta_deg=60, albedo=0.25, method="quadrature")
    assert list(table.columns)[:5] == ["model", "albedo_parameter", "scale", "theta_deg", "albedo"]
    assert table.albedo[0] == pytest.approx(0.25)
    assert "albedo" in mean_albedo("lambert", albedo=0.25)


def test_directions_by_cosine_radians_and_degrees_are_the_same() -> None:
    by = [
        albedo("blinn", n=10, method="quadrature", **direction)
        for direction in ({"mu": 0.5}, {"theta": math.pi / 3}, {"theta_deg": 60})
    ]
    assert by[0].albedo[0] == pytest.approx(by[1].albedo[0], abs=1e-12)
    assert by[0].albedo[0] == pytest.approx(by[2].albedo[0], abs=1e-12)
    assert [table.theta_deg[0] for table in by] == pytest.approx([60, 60, 60])
    grazing = albedo("stretched_phong", n=1, theta_deg=90 - 1e-9, method="quadrature", scale=1)
    assert grazing.albedo[0] == pytest.approx(
        albedo("stretched_phong", n=1, mu=math.radians(1e-9), method="quadrature", scale=1).albedo[0]
    )


def test_a_model_that_is_not_reciprocal_has_a_row_for_each_order() -> None:
    table = albedo("phong_original", theta_deg=60, n=20, method="quadrature")
    assert table.order.tolist() == ["wi", "wo"]
    assert table.albedo[1] == pytest.approx(2.0 * albedo("phong", theta_deg=60, n=20, method="quadrature").albedo[0], abs=1e-5)


def test_scale_multiplies_and_defaults_to_what_the_source_prescribes() -> None:
    one = albedo("ward", theta_deg=30, method="quadrature")
    assert one.scale[0] == 1.0
    half = albedo("ward", theta_deg=30, scale=0.5, method="quadrature")
    assert half.albedo[0] == pytest.approx(0.5 * one.albedo[0], abs=1e-5)
    assert albedo("blinn", n=4, theta_deg=0).scale[0] == pytest.approx(normalise("blinn", n=4, method="quadrature").constant[0])
    assert albedo("ward", theta_deg=30, scale=0).albedo[0] == 0.0


def test_a_default_tolerance_is_relative_for_large_figures() -> None:
    table = normalise("stretched_phong", n=1e8)
    assert 1e7 < table.constant[0] < 2e7
    assert table.ci95_high[0] - table.ci95_low[0] < 2e-5 * table.constant[0]


def test_a_sick_model_is_shown_not_hidden() -> None:
    """A NaN passes as a finding, with its count."""
    lambert = find("lambert")
    sick = replace(lambert, evaluate=lambda p, wi, wo: math.nan if wi.x > 0.9 else 1.0)
    table = albedo(sick, mu=0.5)
    assert math.isnan(table.albedo[0])
    assert table.non_finite[0] > 0


@pytest.mark.parametrize(
    ("options", "named"),
    [
        ({"n": -1}, "n"),
        ({"n": math.nan}, "n"),
        ({"n": math.inf}, "n"),
        ({"n": "many"}, "n"),
        ({"n": True}, "n"),
        ({"n": []}, "n"),
        ({"m": 1}, "m"),
        ({"scale": -1}, "scale"),
        ({"theta_deg": 90}, "theta_deg"),
        ({"theta_deg": -1}, "theta_deg"),
        ({"theta_deg": math.nan}, "theta_deg"),
        ({"theta_deg": []}, "theta_deg"),
        ({"theta_deg": None, "mu": 0}, "mu"),
        ({"theta_deg": None, "mu": 1.5}, "mu"),
        ({"theta_deg": None, "theta": 1.6}, "theta"),
        ({"theta_deg": None}, "theta"),
        ({"mu": 0.5}, "theta"),
        ({"phi_deg": math.inf}, "phi_deg"),
        ({"phi": 0, "phi_deg": 0}, "phi"),
        ({"tolerance": 0}, "tolerance"),
        ({"tolerance": -1e-3}, "tolerance"),
        ({"tolerance": math.nan}, "tolerance"),
        ({"tolerance": "tight"}, "tolerance"),
        ({"method": "guess"}, "method"),
        ({"seed": -1}, "seed"),
        ({"seed": 0.5}, "seed"),
        ({"threads": 0}, "threads"),
    ],
)
def test_bad_input_names_the_parameter_the_value_and_the_domain(options: dict[str, object], named: str) -> None:
    with pytest.raises(BadInput) as error:
        albedo("phong", **({"theta_deg": 30.0} | options))  # type: ignore[arg-type]
    assert error.value.parameter == named
    assert "\n" not in str(error.value)


def test_unknown_models_get_the_nearest_names() -> None:
    with pytest.raises(BadInput, match="stretched_phong"):
        albedo("streched_phong", theta_deg=0)
    with pytest.raises(BadInput, match="leave it out"):
        normalise("phong", scale=1)


def test_an_unreachable_tolerance_is_inconclusive() -> None:
    for method in ("rqmc", "mc", "quadrature"):
        with pytest.raises(Inconclusive, match="tolerance"):
            albedo("ward", theta_deg=60, tolerance=1e-18, method=method)


def test_progress_is_told() -> None:
    told: list[tuple[int, int]] = []
    albedo("lambert", theta_deg=np.array([0, 30]), progress=lambda done, total: told.append((done, total)))
    assert told == [(0, 2), (1, 2), (2, 2)]
