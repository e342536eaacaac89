"""The figures of Neumann, Neumann and Szirmay-Kalos (1999), drawn from computed values."""

from __future__ import annotations

from math import cos, radians

import numpy as np

from albedo_lab.optics.metals import METALS, PAPER_WAVELENGTHS
from albedo_lab.papers.neumann1999.tables import WARD_AT_GRAZING, equation_26
from albedo_lab.papers.record import Figure
from albedo_lab.pictures import Curve
from albedo_lab.pictures.albedos import Albedos
from albedo_lab.pictures.functions import Function, Functions
from albedo_lab.pictures.polar import Polar
from albedo_lab.pictures.previews import Previews
from albedo_lab.pictures.spectra import Spectra

CAPTION_3 = """\
Albedo of the stretched Phong model with cₙ = (n+2)/(2π). Dots: its limit at 90°, eq. 26. Dashed: the ideal mirror,
to which it tends for every angle below 90° as n → ∞."""

CAPTION_5 = """\
Albedo of the Phong (n = 150), stretched Phong (n = 150), Cook-Torrance (m = 0.1, V-cavities), Ward (m = 0.1, C_max = 1)
and He-Torrance (σ₀ = 0.1, τ = 1.7) models under a Fresnel term of 1. Dot: the limit of eq. 26. Right: the last degrees before
grazing; circles: the albedos of Ward's model that §6.2 prints. He-Torrance needs a wavelength, which the paper does not print;
here it is 0.5, in the unit of σ₀ and τ, and the Dirac part is included."""

CAPTION_METALS = """\
Eq. 27 with n = 40, as some of the spheres of the paper's figure 8, for measured refractive indices at eight wavelengths; the
paper prints neither its indices nor its wavelengths. The band above each panel is the colour of what comes back of daylight
(D65), as the CIE 1931 observer sees it, in sRGB; gold's at small angles is outside the gamut and shown as the nearest. Towards 90
degrees Fresnel's reflectance goes to 1 and takes the colour away, and half of the lobe falls below the horizon."""


CAPTION_1 = """\
Sections through the plane of incidence for light from 0, 40 and 80 degrees; the paper prints no angles. Both grow
with the angle. Plus-Blinn carries the largest constant, plus-Phong c_n of ineq. 6, above which it creates energy at
grazing incidence. Each panel has its own scale."""

CAPTION_2 = """\
f cos Θ_L, under a point light whose irradiance is 1 at normal incidence. In the mirror direction it is the same for
every light; beside it, towards the horizon, it rises to twice as much as the light approaches grazing incidence.
Each panel has its own scale."""

CAPTION_4 = """\
Eq. 12 over eq. 5: 1 / cos^p Θ_min, the same for every n. Beyond the angle of the viewer it no longer grows. The paper
prints neither its angles nor its p."""

CAPTION_6 = """\
Each BRDF over its own value at normal incidence. Phong's summit stays at 1, the stretched one's is 1 / cos Θ_L."""

CAPTION_7 = """\
f cos Θ_L under a point light whose irradiance is 1 at normal incidence: Phong's mirror gets darker as cos Θ_L, the
stretched one does not."""

CAPTION_8 = """\
The materials of the image, whose objects the paper does not give: eq. 27 for measured refractive indices at eight
wavelengths, on a sphere and a cylinder under a light from the upper left, a light at the eye, and a uniform sky.
Clipped pixels are marked."""

CAPTION_9 = """\
Eq. 30 with the four printed pairs of a_s and n, which head the columns. The diffuse colours are ours, of one hue; the
paper prints none."""

CAPTION_10 = """\
Eq. 30 with the printed exponents. Diffuse colour and a_s = 0.05 are ours; the paper prints neither."""

PIXELS = 128
IS = "\N{NO-BREAK SPACE}=\N{NO-BREAK SPACE}"
"""Titles of narrow columns break between parameters, not within one."""
EXPONENTS = (1, 4, 16, 64, 256, 1024)
METALS_LEFT = (("gold", 4), ("copper", 40), ("copper", 150), ("silver", 5000))
METALS_RIGHT = (("silver", 20), ("aluminium", 40), ("silver", 50), ("copper", 50), ("gold", 40))
SPHERES = (
    (0.04, 169, (0.55, 0.05, 0.04)),
    (0.065, 64, (0.70, 0.17, 0.14)),
    (0.09, 9, (0.78, 0.36, 0.32)),
    (0.13, 3, (0.82, 0.58, 0.55)),
)
CERAMIC = (0.72, 0.68, 0.60)


def phong_pair(n: int) -> tuple[Curve, Curve]:
    """Both models that figures 6 and 7 compare."""
    return Curve(f"Phong, n = {n}", "phong", {"n": n}), Curve(f"stretched Phong, n = {n}", "stretched_phong", {"n": n})


def plus_pair(n: int) -> tuple[Curve, Curve]:
    """The plus-models of figures 1 and 2."""
    return Curve(f"plus-Phong, n = {n}", "plus_phong", {"n": n}), Curve(f"plus-Blinn, n = {n}", "plus_blinn", {"n": n})


def of_metals(materials: tuple[tuple[str, int], ...]) -> Previews:
    """Metals by their names and exponents."""
    return Previews(
        tuple(Curve(f"{metal}, n{IS}{n}", "metal", {"metal": metal, "n": n}) for metal, n in materials),
        size=PIXELS,
    )


def plastic(a_s: float, n: int, colour: tuple[float, float, float]) -> Curve:
    """Eq. 30 with its three diffuse albedos."""
    return Curve(f"aₛ{IS}{a_s:g}, n{IS}{n}", "plastic", {"fresnel": "one", "a_s": a_s, "n": n, "a_d": list(colour)})


def ratio(viewer_deg: float, p: float) -> Function:
    """Figure 4's ratio against the light's angle in degrees."""
    return Function(
        f"p = {p:g}, viewer at {viewer_deg:g}°", lambda light: np.cos(np.radians(np.minimum(light, viewer_deg))) ** -p
    )


FIGURES = (
    Figure("figure_1", "BRDFs of the plus-models", "figure 1", CAPTION_1, Polar(plus_pair(100), panels="curve", alike=False)),
    Figure(
        "figure_2",
        "Output radiance of the plus-models",
        "figure 2",
        CAPTION_2,
        Polar(plus_pair(20), quantity="radiance", panels="curve", alike=False),
    ),
    Figure(
        "figure_3",
        "Albedo of the stretched Phong model",
        "figure 3",
        CAPTION_3,
        Albedos(
            tuple(Curve(f"n = {n}", "stretched_phong", {"n": n}) for n in EXPONENTS),
            limits={f"n = {n}": float(equation_26(n)) for n in EXPONENTS},
            constants={"n → ∞": 1.0},
        ),
    ),
    Figure(
        "figure_4",
        "Ratio of the p-model to the Phong BRDF",
        "figure 4",
        CAPTION_4,
        Functions(
            tuple(ratio(viewer, p) for p in (0.5, 1.0) for viewer in (30.0, 60.0, 80.0)),
            (0.0, 90.0),
            "angle of the light (degrees)",
            "f(p-model) / f(Phong)",
            y=(0.8, 6.0),
        ),
    ),
    Figure(
        "figure_5",
        "Albedo of the Phong, stretched Phong, Cook-Torrance, Ward and He-Torrance models",
        "figure 5",
        CAPTION_5,
        Albedos(
            (
                Curve("Phong, n = 150", "phong", {"n": 150}),
                Curve("stretched Phong, n = 150", "stretched_phong", {"n": 150}),
                Curve("Cook-Torrance, m = 0.1", "cook_torrance", {"m": 0.1}),
                Curve("Ward, m = 0.1", "ward", {"m": 0.1}),
                Curve(
                    "He-Torrance, σ₀ = 0.1, τ = 1.7",
                    "he_torrance",
                    {"fresnel": "one", "sigma0": 0.1, "tau": 1.7, "wavelength": 0.5},
                ),
            ),
            limits={"stretched Phong, n = 150": float(equation_26(150))},
            points=tuple((cos(radians(angle)), float(text)) for angle, text in WARD_AT_GRAZING.items()),
            to_grazing=True,
        ),
    ),
    Figure(
        "figure_6",
        "Phong and stretched Phong, normalised",
        "figure 6",
        CAPTION_6,
        Polar(phong_pair(100), quantity="normalised", panels="curve"),
    ),
    Figure(
        "figure_7",
        "Output radiance of Phong and stretched Phong",
        "figure 7",
        CAPTION_7,
        Polar(phong_pair(100), quantity="radiance", panels="curve"),
    ),
    Figure("figure_8_left", "Metals of the left image", "figure 8, left", CAPTION_8, of_metals(METALS_LEFT)),
    Figure("figure_8_right", "Metals of the right image", "figure 8, right", CAPTION_8, of_metals(METALS_RIGHT)),
    Figure("figure_9", "Plastic", "figure 9", CAPTION_9, Previews(tuple(plastic(*sphere) for sphere in SPHERES), size=PIXELS)),
    Figure(
        "figure_10",
        "Ceramics",
        "figure 10",
        CAPTION_10,
        Previews(tuple(plastic(0.05, n, CERAMIC) for n in (100, 20)), size=PIXELS),
    ),
    Figure(
        "metals",
        "Albedo and colour of gold, silver, copper and aluminium",
        "section 5.1, four metals",
        CAPTION_METALS,
        Spectra(METALS, PAPER_WAVELENGTHS, {"n": 40}),
    ),
)
