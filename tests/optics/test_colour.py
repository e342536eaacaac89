"""Colour of spectra: against colour-science, at white, there and back, and for a metal that everybody knows."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from albedo_lab.errors import BadInput
from albedo_lab.optics import colour, metals
from albedo_lab.optics.fresnel import normal_reflectance

VISIBLE = np.arange(380.0, 781.0, 5.0)
RAMP = ((380.0, 780.0), (0.1, 0.9))
BUMP = ((400.0, 450.0, 500.0, 550.0, 600.0, 650.0, 700.0, 750.0), (0.05, 0.1, 0.6, 0.8, 0.3, 0.1, 0.05, 0.05))
NARROW = (VISIBLE, np.exp(-(((VISIBLE - 520.0) / 15.0) ** 2)))

# colour-science 0.4.7: sd_to_XYZ(method="Integration") over 380 to 780 nm in steps of 5 nm, XYZ_to_RGB("sRGB", Bradford)
OTHERS = [
    (RAMP, "D65", (0.4500509257481482, 0.4535567495020337, 0.27351855036779965), (0.62483106, 0.42607336, 0.22171895)),
    (RAMP, "E", (0.48353883566583006, 0.46038373612910666, 0.24818404836389438), (0.63504851, 0.42896279, 0.21764714)),
    (BUMP, "D65", (0.34221999228024885, 0.5593245886749998, 0.2280159773368939), (0.13550225, 0.72705898, 0.14602550)),
    (BUMP, "E", (0.351587542770617, 0.546660711178021, 0.20333679026632903), (0.09766445, 0.72722106, 0.13911402)),
    (NARROW, "D65", (0.023491942168703116, 0.18347153313128517, 0.026953772629083807), (-0.21934315, 0.32250996, -0.00762527)),
    (NARROW, "E", (0.021910239083306096, 0.17063298030237903, 0.024863476799411047), (-0.22732629, 0.31287040, -0.00660350)),
]
ENCODED = [(-0.01, -0.1292), (0.0, 0.0), (0.002, 0.02584), (0.0031308, 0.040449936), (0.004, 0.05070871397734795)]
ENCODED += [(0.18, 0.46135612950044164), (0.5, 0.7353569830524495), (1.0, 1.0), (1.2, 1.0832683112047328)]


@pytest.mark.parametrize(("spectrum", "illuminant", "xyz", "rgb"), OTHERS)
def test_colour_science_finds_the_same(
    spectrum: tuple[list[float], list[float]], illuminant: str, xyz: tuple[float, ...], rgb: tuple[float, ...]
) -> None:
    """XYZ to all digits; linear sRGB to 2e-4, since colour-science takes the inverse matrix as printed, in four digits."""
    found = colour.xyz(*spectrum, illuminant)
    assert found == pytest.approx(xyz, abs=1e-12)
    assert colour.linear_srgb(found, illuminant) == pytest.approx(rgb, abs=2e-4)


def test_colour_science_encodes_alike() -> None:
    for linear, encoded in ENCODED:
        assert colour.encode(linear) == pytest.approx(encoded, abs=1e-14)


@pytest.mark.parametrize("illuminant", colour.ILLUMINANTS)
@pytest.mark.parametrize("wavelengths", [(550.0, 551.0), metals.PAPER_WAVELENGTHS, VISIBLE, (900.0, 300.0, 500.0)])
def test_the_perfect_reflector_is_white(illuminant: str, wavelengths: tuple[float, ...]) -> None:
    xyz = colour.xyz(wavelengths, np.ones(len(wavelengths)), illuminant)
    assert xyz == pytest.approx(colour.white(illuminant), abs=1e-14)
    assert xyz[1] == pytest.approx(1.0, abs=1e-14)
    rgb = colour.linear_srgb(xyz, illuminant)
    assert rgb == pytest.approx([1.0, 1.0, 1.0], abs=1e-13)
    assert colour.in_gamut(rgb)
    assert colour.hexadecimal(colour.encode(rgb)) == "#ffffff"


def test_whites() -> None:
    """CIE 015 tables D65 as x = 0.31272, y = 0.32903 and E as 1/3, 1/3; 5 nm and the ends at 380 and 780 nm leave 1e-5."""
    for illuminant, x, y in (("D65", 0.31272, 0.32903), ("E", 1 / 3, 1 / 3)):
        white = colour.white(illuminant)
        assert white[:2] / white.sum() == pytest.approx([x, y], abs=1e-5)


def test_adaptation_to_d65_undoes_rounding_only() -> None:
    """Without it the white would be off by 2e-4, and no more."""
    plain = np.linalg.inv(colour.XYZ_OF_SRGB) @ colour.white("D65")
    assert 1e-4 < np.abs(plain - 1.0).max() < 3e-4
    printed = [[3.2406, -1.5372, -0.4986], [-0.9689, 1.8758, 0.0415], [0.0557, -0.2040, 1.0570]]
    assert np.linalg.inv(colour.XYZ_OF_SRGB) == pytest.approx(np.array(printed), abs=2e-4)


@given(st.lists(st.floats(-2.0, 2.0), min_size=3, max_size=3), st.sampled_from(colour.ILLUMINANTS))
def test_there_and_back(rgb: list[float], illuminant: str) -> None:
    assert colour.linear_srgb(colour.xyz_of_srgb(rgb, illuminant), illuminant) == pytest.approx(rgb, abs=1e-13)
    # where the two pieces of the transfer function meet, the standard's rounded constants leave a step of 3e-8
    assert colour.decode(colour.encode(rgb)) == pytest.approx(rgb, abs=1e-8)
    assert colour.encode(colour.decode(rgb)) == pytest.approx(rgb, abs=1e-7)


@given(
    st.lists(st.tuples(st.floats(380.0, 780.0), st.floats(0.0, 1.0)), min_size=2, max_size=9, unique_by=lambda point: point[0])
)
def test_weights_are_the_colour_and_the_order_does_not_matter(points: list[tuple[float, float]]) -> None:
    wavelengths, reflectances = zip(*points, strict=True)
    xyz = colour.xyz(wavelengths, reflectances)
    assert xyz == pytest.approx(colour.xyz(wavelengths[::-1], reflectances[::-1]), abs=1e-13)
    grid = np.interp(VISIBLE, *map(np.array, zip(*sorted(points), strict=True)))
    assert xyz == pytest.approx(colour.xyz(VISIBLE, grid), abs=1e-13)
    assert colour.linear_srgb(xyz) == pytest.approx(np.array(reflectances) @ colour.srgb_weights(wavelengths), abs=1e-12)


def test_many_spectra_at_once() -> None:
    spectra = np.random.default_rng(3).random((4, 5, 8))
    xyz = colour.xyz(metals.PAPER_WAVELENGTHS, spectra)
    assert xyz.shape == (4, 5, 3)
    assert xyz[2, 3] == pytest.approx(colour.xyz(metals.PAPER_WAVELENGTHS, spectra[2, 3]), abs=1e-15)
    assert colour.encode(colour.linear_srgb(xyz)).shape == (4, 5, 3)
    assert colour.in_gamut(colour.linear_srgb(xyz)).shape == (4, 5)


def test_nothing_is_clamped_and_what_cannot_be_shown_is_told() -> None:
    """A spectrum as narrow as a laser's is a green that no screen has."""
    rgb = colour.linear_srgb(colour.xyz(*NARROW))
    assert rgb.min() < -0.2
    assert not colour.in_gamut(rgb)
    assert colour.encode(rgb).min() < -2.0
    assert colour.in_gamut([0.0, 0.5, 1.0 + 1e-12])
    assert not colour.in_gamut([0.0, 0.5, 1.01])
    assert colour.in_gamut([0.0, 0.5, 1.01], 0.02)
    assert not colour.in_gamut([0.0, math.nan, 1.0])
    assert colour.hexadecimal([-1.0, 2.0, 0.5]) == "#00ff80"
    assert colour.hexadecimal([0.0, math.nan, 1.0]) == ""


def reflected(metal: str, wavelengths: tuple[float, ...] | list[float]) -> list[float]:
    return [normal_reflectance(*metals.index(metal, wavelength)) for wavelength in wavelengths]


@pytest.mark.parametrize(
    ("metal", "usual"),
    [
        ("gold", (1.0, 0.77, 0.34)),
        ("silver", (0.97, 0.96, 0.92)),
        ("copper", (0.95, 0.64, 0.54)),
        ("aluminium", (0.91, 0.92, 0.92)),
    ],
)
def test_metals_have_the_colours_that_renderers_give_them(metal: str, usual: tuple[float, ...]) -> None:
    """Linear sRGB at normal incidence, within the 0.07 that gold films differ by; 8 wavelengths are within 0.015 of all."""
    dense = colour.linear_srgb(colour.xyz(VISIBLE, reflected(metal, VISIBLE.tolist())))
    assert dense == pytest.approx(usual, abs=0.07)
    eight = colour.linear_srgb(colour.xyz(metals.PAPER_WAVELENGTHS, reflected(metal, metals.PAPER_WAVELENGTHS)))
    assert eight == pytest.approx(dense, abs=0.015)


@pytest.mark.parametrize(
    "wavelengths", [(550.0,), (), (400.0, 400.0), (400.0, math.nan), (400.0, math.inf), (0.0, 400.0), ((1.0, 2.0),)]
)
def test_wavelengths_that_make_no_spectrum_are_refused(wavelengths: tuple[float, ...]) -> None:
    with pytest.raises(BadInput, match=r"wavelength = .*at least 2 different wavelengths in nm"):
        colour.xyz_weights(wavelengths)


def test_unknown_illuminants_are_refused() -> None:
    with pytest.raises(BadInput, match="illuminant = 'F2': must be one of D65, E"):
        colour.white("F2")
