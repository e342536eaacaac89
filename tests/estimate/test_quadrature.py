"""Quadrature against the slow oracle: every cell within its own bound, and the rule itself against polynomials."""

import json
import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from albedo_lab.catalogue import find
from albedo_lab.estimate.methods import estimate
from albedo_lab.estimate.quadrature import quadrature
from albedo_lab.estimate.record import Question, Tolerance
from albedo_lab.kernels.kronrod import GAUSS, KRONROD, NODES

REFERENCE = json.loads((Path(__file__).parents[1] / "oracles" / "reference.json").read_text())
CELLS = REFERENCE["albedo"] + REFERENCE["extreme"]
MODELS = sorted({cell["model"] for cell in CELLS})


def question(cell: dict[str, Any]) -> Question:
    """A cell of the reference as a question."""
    model = find(cell["model"])
    phi = math.radians(cell.get("phi_deg", 0.0))
    return Question(model, model.bind(cell["parameters"]), cell["mu"], phi, cell["order"])


@pytest.mark.parametrize("relative", [1e-4, 1e-6, 1e-10])
@pytest.mark.parametrize("name", MODELS)
def test_every_cell_lies_within_its_bound(name: str, relative: float) -> None:
    for cell in CELLS:
        if cell["model"] == name:
            found = quadrature(question(cell), Tolerance(0.0, relative))
            assert abs(found.value - cell["value"]) <= found.half_width + cell["error"], cell
            if relative >= 1e-6:
                assert found.reaches(Tolerance(0.0, relative)), cell


def test_the_pair_of_rules_is_exact_for_the_polynomials_it_promises() -> None:
    """Degree 46 for K31 and 29 for G15; degree 48 and 30 are not, which tells that the test can fail."""
    for degree in range(0, 48, 2):
        exact = 2.0 / (degree + 1)
        assert KRONROD @ NODES**degree == pytest.approx(exact, rel=1e-14)
        if degree < 30:
            assert GAUSS @ NODES**degree == pytest.approx(exact, rel=1e-14)
    assert abs(GAUSS @ NODES**30 - 2 / 31) > 1e-10
    assert np.all(np.diff(NODES[:-1]) > 0)
    assert KRONROD[-1] == GAUSS[-1] == 0.0


def test_a_wrong_jacobian_is_caught() -> None:
    """Negative control: one percent off is far outside any bound."""
    cell = next(cell for cell in CELLS if cell["model"] == "blinn")
    found = quadrature(question(cell), Tolerance(0.0, 1e-6))
    assert abs(1.01 * found.value - cell["value"]) > 100.0 * found.half_width


@pytest.mark.parametrize("name", sorted({cell["model"] for cell in REFERENCE["mean"]}))
def test_every_mean_lies_within_its_bound(name: str) -> None:
    for cell in REFERENCE["mean"]:
        if cell["model"] == name:
            model = find(name)
            asked = Question(model, model.bind(cell["parameters"]), None, order=cell["order"])
            found = estimate(asked, Tolerance(0.0, 1e-6), "quadrature", 0, 1)
            assert found.reaches(Tolerance(0.0, 1e-6)), cell
            assert abs(found.value - cell["value"]) <= found.half_width + cell["error"], cell


def test_a_lobe_whose_axis_lies_far_below_the_horizon_is_not_lost() -> None:
    """All that is seen of it is its rim; found by plain integration of the formula in tests/models/trial.py's angles."""
    model = find("lafortune")
    p = model.bind({"C_z": -1.0, "n": 200.0})
    found = quadrature(Question(model, p, 0.7), Tolerance(0.0, 1e-6))

    def along(z: float) -> float:
        s = math.sqrt((1.0 - z * z) * (1.0 - 0.49))
        phi = 2.0 * np.pi * (np.arange(4096) + 0.5) / 4096
        return float(np.mean(np.maximum(s * np.cos(phi) - 0.7 * z, 0.0) ** 200.0)) * 2.0 * np.pi * z

    z = np.linspace(0.0, 0.2, 20001)
    expected = float(np.sum([along(x) for x in z])) * (z[1] - z[0])
    assert 0.0 < expected < 1e-20
    assert found.value == pytest.approx(expected, rel=1e-4)


def test_the_mean_of_an_anisotropic_model_runs_over_all_azimuths() -> None:
    model = find("modified_ward")
    question = Question(model, model.bind({"m_x": 0.1, "m_y": 0.4}), None)
    found = estimate(question, Tolerance(1e-6), "quadrature", 0, 1)
    sampled = estimate(question, Tolerance(1e-4), "rqmc", 0, 2)
    assert abs(found.value - sampled.value) < 4.0 * sampled.standard_error + found.half_width
