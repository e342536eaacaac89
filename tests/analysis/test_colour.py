"""The colour of a model: what is known of a metal and of tinted paper, the table, the errors, what is refused."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np
import pytest

from albedo_lab.analysis.albedo import albedo
from albedo_lab.analysis.colour import COMPONENTS, colour
from albedo_lab.errors import BadInput, Inconclusive
from albedo_lab.model import Model, Parameter, Reference
from albedo_lab.optics import colour as optics
from albedo_lab.optics.frame import Direction
from albedo_lab.optics.fresnel import normal_reflectance
from albedo_lab.optics.metals import PAPER_WAVELENGTHS, index


class Paper(NamedTuple):
    """Lambert's model with a reflectance that rises by `R` from 400 to 700 nm."""

    R: float
    wavelength: float
    reflectance: float


def reflectance(p: Paper, wi: Direction, wo: Direction) -> float:
    return p.reflectance / math.pi


def paper(unit: str = "nm") -> Model:
    return Model(
        "paper",
        "rho(wavelength) / pi",
        Paper,
        (Parameter("R", "rise", 0.0, -1.0, 1.0), Parameter("wavelength", "wavelength", 550.0, 300.0, 900.0, unit=unit)),
        reflectance,
        Reference("Nobody", "Tinted Paper", None, ""),
        scale=lambda p: 1.0,
        complete=lambda x: Paper(x["R"], x["wavelength"], 0.5 + x["R"] * (x["wavelength"] - 550.0) / 300.0),
    )


PAPER = paper()
QUADRATURE: dict[str, Any] = {"method": "quadrature", "theta_deg": 0.0}


def test_a_metal_seen_from_above_has_the_colour_of_its_reflectance() -> None:
    """Under theta_min F is that of normal incidence for every light, and the albedo of the lobe is 1."""
    expected = [normal_reflectance(*index("gold", wavelength)) for wavelength in PAPER_WAVELENGTHS]
    table = colour("metal", metal="gold", angle="theta_min", n=100.0, **QUADRATURE)
    xyz = optics.xyz(PAPER_WAVELENGTHS, expected)
    assert table[list(COMPONENTS)].to_numpy()[0] == pytest.approx([*xyz, *optics.linear_srgb(xyz)], abs=2e-5)
    assert (table.hex[0], table.in_gamut[0]) == ("#ffdca5", False)
    assert table.R[0] > 1.0


def test_tinted_paper() -> None:
    """Its spectrum is linear: two wavelengths are as good as eight. Rising it is warm, falling it is cool, level it is grey."""
    ends = (380.0, 780.0)
    table = colour(PAPER, R=[-0.5, 0.0, 0.5], wavelength=ends, **QUADRATURE)
    for row, rise in enumerate((-0.5, 0.0, 0.5)):
        xyz = optics.xyz(ends, [0.5 + rise * (end - 550.0) / 300.0 for end in ends])
        assert table[list(COMPONENTS)].to_numpy()[row] == pytest.approx([*xyz, *optics.linear_srgb(xyz)], abs=1e-5)
    assert table.hex[1] == "#bcbcbc"  # a half is 187.5 encoded, of 255
    assert table.R[0] < table.B[0]
    assert table.R[2] > table.B[2]


def test_the_table() -> None:
    table = colour(PAPER, R=[0.0, 0.2], theta_deg=[0, 60], scale=[1.0, 2.0], method="quadrature")
    errors = [f"{name}_standard_error" for name in COMPONENTS]
    assert list(table.columns) == [
        *("model", "R_parameter", "scale", "theta_deg", *COMPONENTS),
        *("encoded_r", "encoded_g", "encoded_b", "hex", "in_gamut", *errors, "half_width"),
        *("samples", "non_finite", "method", "seed", "order"),
    ]
    assert table.R_parameter.tolist() == [0.0] * 4 + [0.2] * 4
    assert table.scale.tolist() == [1.0, 1.0, 2.0, 2.0] * 2
    assert table.theta_deg.tolist() == [0.0, 60.0] * 4
    assert table.Y[2] == pytest.approx(2.0 * table.Y[0], abs=2e-5)
    encoded = table[["encoded_r", "encoded_g", "encoded_b"]].to_numpy()
    assert encoded == pytest.approx(optics.encode(table[["R", "G", "B"]].to_numpy()), abs=1e-15)


@pytest.mark.parametrize("illuminant", optics.ILLUMINANTS)
@pytest.mark.parametrize("method", ["quadrature", "rqmc"])
def test_white_paper_is_white_and_black_is_black(illuminant: str, method: str) -> None:
    """White to the tolerance, and in gamut whichever way the error goes."""
    table = colour(PAPER, scale=[2.0, 0.0], theta_deg=30, illuminant=illuminant, method=method, tolerance=1e-4)
    assert table[["R", "G", "B"]].to_numpy()[0] == pytest.approx([1.0] * 3, abs=1e-4)
    assert table.hex.tolist() == ["#ffffff", "#000000"]
    assert table.in_gamut.all()
    assert not colour(PAPER, scale=2.1, **QUADRATURE).in_gamut[0]


def test_errors_are_those_of_the_albedos_gone_the_worst_way() -> None:
    tolerance = 1e-3
    table = colour("metal", metal="copper", n=20.0, theta_deg=60, tolerance=tolerance, method="mc", seed=3)
    assert 0.0 < table.half_width[0] <= tolerance
    weights = np.abs(np.hstack([optics.xyz_weights(PAPER_WAVELENGTHS), optics.srgb_weights(PAPER_WAVELENGTHS)]))
    each = tolerance / weights.sum(axis=0).max()
    spectrum = albedo(
        "metal", metal="copper", n=20.0, theta_deg=60, wavelength=PAPER_WAVELENGTHS, tolerance=each, method="mc", seed=3
    )
    found = table[[f"{name}_standard_error" for name in COMPONENTS]].to_numpy()[0]
    assert found == pytest.approx(spectrum.standard_error.to_numpy() @ weights, rel=1e-12)
    assert table.samples[0] == spectrum.samples.sum()
    exact = colour("metal", metal="copper", n=20.0, theta_deg=60, method="quadrature")
    for name, error in zip(COMPONENTS, found, strict=True):
        assert abs(table[name][0] - exact[name][0]) < 5.0 * error


def test_progress_goes_through_all_wavelengths() -> None:
    told: list[tuple[int, int]] = []
    colour(PAPER, wavelength=[400, 500, 600], progress=lambda done, of: told.append((done, of)), **QUADRATURE)
    assert told[0] == (0, 3)
    assert told[-1] == (3, 3)
    assert [done for done, _ in told] == sorted(done for done, _ in told)


@pytest.mark.parametrize(
    ("model", "values", "message"),
    [
        ("lambert", {}, "model = 'lambert': must be one with a parameter `wavelength` in nm"),
        ("metal", {}, r"model = 'metal \(metal = custom.*must be one with a parameter `wavelength` in nm"),
        ("metal", {"metal": ["gold", "custom"]}, r"model = 'metal \(metal = custom"),
        (paper(unit=""), {}, "model = 'paper'"),
        (PAPER, {"wavelength": 550.0}, "wavelength = .*at least 2 different wavelengths"),
        (PAPER, {"wavelength": [550.0, 550.0]}, "wavelength = .*at least 2 different wavelengths"),
        ("metal", {"metal": "gold", "wavelength": [300.0, 550.0]}, r"wavelength = 300.0: must be a number in \[380, 780\]"),
        ("metal", {"metal": "tin"}, "metal = 'tin'"),
        (PAPER, {"wavelength": "all"}, "wavelength = 'all': must be a number"),
        (PAPER, {"wavelength": []}, "wavelength"),
        (PAPER, {"illuminant": "F2"}, "illuminant = 'F2': must be one of D65, E"),
        (PAPER, {"illuminant": ["D65"]}, "illuminant"),
        (PAPER, {"tolerance": 0.0}, "tolerance"),
        (PAPER, {"theta_deg": 90.0}, "theta_deg"),
    ],
)
def test_bad_input(model: Model | str, values: dict[str, Any], message: str) -> None:
    with pytest.raises(BadInput, match=message):
        colour(model, **{**QUADRATURE, **values})


def test_an_unreachable_tolerance_is_inconclusive() -> None:
    with pytest.raises(Inconclusive, match="tolerance"):
        colour(PAPER, tolerance=1e-18, method="mc", theta_deg=60)
