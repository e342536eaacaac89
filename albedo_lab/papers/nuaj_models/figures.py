"""The page's figures, which are not in its text, drawn from what they show; and what the trial found beside them."""

from __future__ import annotations

from functools import partial

import numpy as np

from albedo_lab.optics.metals import index
from albedo_lab.papers.nuaj_models.diffuse import first_escape
from albedo_lab.papers.nuaj_models.formulas import (
    GLASS,
    WATER,
    Array,
    beckmann,
    excess,
    fresnel,
    generalised,
    phong,
    schlick,
    white_sky,
)
from albedo_lab.papers.nuaj_models.reflectance import media
from albedo_lab.papers.nuaj_models.variables import share_at
from albedo_lab.papers.record import Figure
from albedo_lab.pictures import Curve
from albedo_lab.pictures.albedos import Albedos
from albedo_lab.pictures.functions import Function, Functions
from albedo_lab.pictures.slices import Slices

WIDTH, EXPONENT = 0.1, 198.0
"""Of the distributions compared; a Blinn-Phong lobe with n = 2 / m² − 2 has Beckmann's curvature."""
RED = 650.0
"""The wavelength in nm at which aluminium is farthest from eq. 5."""


def normal(gamma: float, degrees: Array) -> Array:
    """Generalised Trowbridge-Reitz with the constant that normalises it."""
    return generalised(WIDTH, gamma, np.radians(degrees)) / excess(WIDTH, gamma)


def steeper(gamma: float, slope: Array) -> Array:
    """The share of its facets that are steeper than a slope; there is q = alpha^2 cos^2 + sin^2, which ends at 1."""
    q = (WIDTH**2 + slope**2) / (1.0 + slope**2)
    most = WIDTH**2
    share: Array = np.log(q) / np.log(most) if gamma == 1.0 else (q ** (1.0 - gamma) - 1.0) / (most ** (1.0 - gamma) - 1.0)
    return share


def areas(alpha: float, gammas: Array) -> Array:
    """The area of all facets of the printed distribution seen from above."""
    return np.array([excess(alpha, float(gamma)) for gamma in gammas])


def reflected(n: complex, degrees: Array) -> Array:
    """Fresnel's reflectance."""
    return fresnel(n, np.cos(np.radians(degrees)))


def simplified(n: complex, degrees: Array) -> Array:
    """Eq. 5 from the exact F0."""
    return schlick(float(fresnel(n, np.ones(1))[0]), np.cos(np.radians(degrees)))


def strayed(n: complex, degrees: Array) -> Array:
    """How far that is from it."""
    return simplified(n, degrees) - reflected(n, degrees)


def below(spacing: str, degrees: Array) -> Array:
    """The share of a slice below the surface, in per cent."""
    return 100.0 * share_at(np.radians(degrees), spacing)


PAIRED = {
    "glass": GLASS,
    "diamond": media()["diamond"],
    "gold": media()["gold"],
    f"aluminium, {RED:g} nm": complex(*index("aluminium", RED)),
}
DEGREES = (0.0, 90.0)
PLASTIC = Curve("plastic", "microfacet", {"F": "dielectric", "diffuse": "one_minus_fresnel", "alpha": 0.2})
GLOSSY = Curve("GGX, α = 0.1", "microfacet", {"alpha": 0.1})
SURFACES = (
    Curve("Lambert", "lambert"),
    Curve("Oren-Nayar", "oren_nayar", {"form": "full", "sigma": 0.5}),
    PLASTIC,
    Curve("Blinn, n = 50", "blinn", {"n": 50}),
    GLOSSY,
    Curve("GGX, α = 0.5", "microfacet", {"alpha": 0.5}),
    Curve("γ = 1, α = 0.1", "microfacet", {"D": "trowbridge_reitz", "alpha": 0.1}),
    Curve("Beckmann, m = 0.3", "microfacet", {"D": "beckmann", "m": 0.3}),
)

FIGURES = (
    Figure(
        "horizon",
        "What a slice of the MERL table loses below the surface",
        "BRDF from Actual Materials",
        "Share of a slice for which a direction lies below the surface. The file's spacing, θh = 90° (i/90)², loses a third at "
        "φd = 0 and a quarter over all; the page's “almost half” and “40 %” are those of an even spacing.",
        Functions(
            (
                Function("as the file is spaced", partial(below, "root")),
                Function("θh spaced evenly", partial(below, "even")),
                Function("printed for φd = 0: “almost half”", lambda x: 50.0 + 0.0 * x, reference=True),
            ),
            DEGREES,
            "φd in degrees",
            "below the surface in %",
            points=181,
        ),
    ),
    Figure(
        "slices",
        "Characteristic slices",
        "BRDF from Actual Materials",
        "f at φd = 90°, at the centres of the cells that a MERL file has. At the left the specular peak (θh = 0), at the top "
        "grazing incidence (θd = 90°), at the right both directions near the horizon, at the bottom the light straight back to "
        "itself (θd = 0). Oren-Nayar with σ = 0.5; plastic: GGX, α = 0.2, n = 1.5, over a diffuse part; the last four are facets "
        "with F = 1 and Smith's G. The darkest colour also stands for less, 0 among it.",
        Slices(SURFACES),
    ),
    Figure(
        "stack",
        "The stack of slices",
        "BRDF from Actual Materials",
        "The same surface from φd = 90° to 0. What is hatched lies below the surface. In eq. 4 the slices differ by G / (cos "
        "θi cos θo) alone.",
        Slices((GLOSSY, PLASTIC), (90.0, 60.0, 30.0, 0.0)),
    ),
    Figure(
        "normals",
        "Distributions of normals",
        "Specularity",
        "D of width 0.1 (Blinn-Phong n = 198), each with the constant that normalises it. γ = 2 is GGX, which is Trowbridge "
        "and Reitz's; γ = 1 is what the page calls so. The first two nearly coincide.",
        Functions(
            (
                Function("Blinn-Phong", lambda x: phong(EXPONENT, np.radians(x))),
                Function("Beckmann", lambda x: beckmann(WIDTH, np.radians(x))),
                Function("γ = 2 (GGX)", partial(normal, 2.0)),
                Function("γ = 1.5", partial(normal, 1.5)),
                Function("γ = 1", partial(normal, 1.0)),
            ),
            (0.0, 89.0),
            "θh in degrees",
            "D in 1/sr",
            log_y=True,
            y=(1e-6, 100.0),
        ),
    ),
    Figure(
        "tails",
        "How many facets are steep",
        "Specularity",
        "Share of the facets, by their area seen from above, that are steeper than a slope. Beckmann's and Blinn-Phong's end; "
        "those of the others go like a power of the slope. The first two nearly coincide.",
        Functions(
            (
                Function("Blinn-Phong", lambda x: (1.0 + x * x) ** (-0.5 * (EXPONENT + 2.0))),
                Function("Beckmann", lambda x: np.exp(-((x / WIDTH) ** 2))),
                Function("γ = 2 (GGX)", partial(steeper, 2.0)),
                Function("γ = 1.5", partial(steeper, 1.5)),
                Function("γ = 1", partial(steeper, 1.0)),
            ),
            (0.01, 10.0),
            "slope, tan θh",
            "share of facets",
            log_x=True,
            log_y=True,
            y=(1e-6, 2.0),
        ),
    ),
    Figure(
        "normalisation",
        "What the printed constant of the generalised distribution makes of it",
        "Specularity",
        "∫ D cos dω with the printed constant α²/π. It is 1 at γ = 2 and nowhere else; at γ = 1 the page prints it once more.",
        Functions(
            (
                *(Function(f"α = {alpha:g}", partial(areas, alpha)) for alpha in (0.1, 0.3, 0.6)),
                Function("normalised", np.ones_like, reference=True),
            ),
            (0.5, 3.0),
            "γ",
            "∫ D cos dω",
            log_y=True,
            points=251,
        ),
    ),
    Figure(
        "fresnel",
        "Fresnel's reflectance and eq. 5",
        "Fresnel",
        "Dashed: exact, unpolarised, at 550 nm where nothing else is said. Solid: eq. 5 from the exact F0. Aluminium dips "
        "before grazing; eq. 5 cannot.",
        Functions(
            (
                *(Function(f"{name}, eq. 5", partial(simplified, n)) for name, n in PAIRED.items()),
                *(Function(f"{name}, exact", partial(reflected, n), reference=True) for name, n in PAIRED.items()),
            ),
            DEGREES,
            "θd in degrees",
            "F",
            y=(0.0, 1.02),
        ),
    ),
    Figure(
        "schlick_error",
        "How far eq. 5 is off",
        "eq. 5",
        "Eq. 5 less the exact reflectance; metals at 550 nm (silver, not drawn, stays below 0.01).",
        Functions(
            tuple(Function(name, partial(strayed, n)) for name, n in media().items() if name != "silver"),
            DEGREES,
            "θd in degrees",
            "eq. 5 − exact",
        ),
    ),
    Figure(
        "diffuse_weights",
        "Weights of the diffuse part",
        "Diffuse Part",
        "Both weights that the page names, for water and glass.",
        Functions(
            (
                Function("1 − F, water", lambda x: 1.0 - reflected(WATER, x)),
                Function("1 − F, glass", lambda x: 1.0 - reflected(GLASS, x)),
                Function("(ni/nt)² (1 − F), water", lambda x: (1.0 - reflected(WATER, x)) / WATER**2),
                Function("(ni/nt)² (1 − F), glass", lambda x: (1.0 - reflected(GLASS, x)) / GLASS**2),
            ),
            DEGREES,
            "θd in degrees",
            "weight",
            y=(0.0, 1.02),
        ),
    ),
    Figure(
        "white_diffuse",
        "A white diffuse part under facets of glass",
        "Diffuse Part",
        "Albedo of eq. 4 with GGX, Smith's G, n = 1.5 and a diffuse part of albedo 1. None of the page's weights keeps the "
        "balance towards grazing incidence on a smooth surface.",
        Albedos(
            tuple(
                Curve(
                    f"{words}, α = {alpha:g}",
                    "microfacet",
                    {"F": "dielectric", "diffuse": choice, "a_d": 1.0, "alpha": alpha},
                )
                for choice, words in (("one_minus_fresnel", "1 − F"), ("refracted", "(ni/nt)² (1 − F)"))
                for alpha in (0.1, 0.03)
            ),
            to_grazing=True,
        ),
    ),
    Figure(
        "subsurface",
        "The bound on what comes back from below a surface",
        "Diffuse Part, the note",
        "Light comes up to the surface equally bright from everywhere. The printed bound is what lies outside the cone and is "
        "reflected; what gets out at once exceeds it up to n = 1.4 or so, and without absorption all that enters gets out at "
        "last.",
        Functions(
            (
                Function("printed bound, 1 − (ni/nt)²", lambda n: 1.0 - 1.0 / n**2),
                Function("in the cone, (ni/nt)²", lambda n: 1.0 / n**2),
                Function("gets out at once", lambda n: np.array([first_escape(float(x)).value for x in n])),
                Function("gets out at last", lambda n: np.array([1.0 - white_sky(float(x)).value for x in n])),
            ),
            (1.001, 2.5),
            "refractive index nt/ni",
            "share of the light",
            points=101,
            y=(0.0, 1.02),
        ),
    ),
    Figure(
        "masking",
        "Eq. 4 with and without G",
        "Shadowing / Masking",
        "Albedo of perfect facets (F = 1, GGX, α = 0.3). Without G it grows without bound towards grazing incidence.",
        Albedos(
            tuple(
                Curve(words, "microfacet", {"alpha": 0.3, "G": G})
                for G, words in (
                    ("none", "without G"),
                    ("v_cavity", "V-cavities"),
                    ("smith_correlated", "Smith, correlated"),
                    ("smith", "Smith"),
                )
            ),
            to_grazing=True,
        ),
    ),
)
