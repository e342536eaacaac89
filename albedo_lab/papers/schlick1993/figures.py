"""The figures of the document, and its factors beside what they stand for."""

from __future__ import annotations

from collections.abc import Callable
from math import pi
from typing import Any

import numpy as np

from albedo_lab.optics.metals import index
from albedo_lab.papers.record import Figure
from albedo_lab.papers.schlick1993.approximations import best_p, best_r, best_rho, ward_azimuths
from albedo_lab.papers.schlick1993.factors import ISOTROPIES, ROUGHNESSES
from albedo_lab.papers.schlick1993.formulas import A, Array, G, S, Z, exact_fresnel, smith
from albedo_lab.papers.schlick1993.parameters import FIGURE_7, FIGURE_8
from albedo_lab.pictures import Curve
from albedo_lab.pictures.albedos import Albedos
from albedo_lab.pictures.functions import Function, Functions
from albedo_lab.pictures.previews import Previews

QUARTER = 0.5 * pi
SLOPES = (0.1, 0.3, 0.5)
INDICES: dict[str, complex] = {
    "n = 1.1": 1.1,
    "n = 1.5": 1.5,
    "n = 2.5": 2.5,
    "aluminium": complex(*index("aluminium", 550.0)),
    "gold": complex(*index("gold", 550.0)),
}
"""What eq. 11 is shown beside; the sign of k does not count."""


def family(f: Callable[[float, Array], Array], name: str, values: tuple[float, ...]) -> tuple[Function, ...]:
    """A function for each value of its parameter."""
    return tuple(Function(f"{name} = {value:g}", lambda x, value=value: f(value, x)) for value in values)  # type: ignore[misc]


def pair(label: str, f: Callable[[Array], Array], of: str, exact: Callable[[Array], Array]) -> tuple[Function, Function]:
    """A function and what it stands for."""
    return Function(label, f), Function(of, exact, reference=True)


def fresnel_pair(name: str, n: complex) -> tuple[Function, Function]:
    """Eq. 11 and Fresnel against the angle in degrees."""
    C = abs((n - 1.0) / (n + 1.0)) ** 2
    return pair(
        name, lambda a: S(C, np.cos(np.radians(a))), f"Fresnel, {name}", lambda a: exact_fresnel(n, np.cos(np.radians(a)))
    )


def smith_pair(m: float) -> tuple[Function, Function]:
    """Eq. 16 with the r that fits eq. 7 as printed, and that equation, against the angle in degrees."""

    def v(angle: Array) -> Array:
        return np.asarray(np.sin(np.radians(90.0 - angle)))

    return pair(
        f"eq. 16, m = {m:g}",
        lambda a: G(best_r(m, remainder=False)[0], v(a)),
        f"eq. 7, m = {m:g}",
        lambda a: smith(m, v(a)),
    )


def schlick(label: str, **parameters: Any) -> Curve:
    """A curve of the document's model."""
    return Curve(label, "schlick", parameters)


def by_formulation(r: float) -> tuple[Curve, ...]:
    """SINGLE, C = 1, by each directional factor."""
    return tuple(schlick(f"eq. {k}", directional=f"eq{k}", r=r) for k in (12, 15, 17, 18))


FIGURES = (
    Figure(
        "figure_6a",
        "The zenith factor Z",
        "figure 6a",
        "Eq. 14 for the r of the document's figure, in logarithmic polar coordinates as there.",
        Functions(
            family(lambda r, a: Z(r, np.cos(a)), "r", ROUGHNESSES),
            (0.0, QUARTER),
            "α, of H from N",
            "Z",
            polar=True,
            log_radius=True,
            symmetric=True,
            points=721,
            y=(1e-2, 1e2),
        ),
    ),
    Figure(
        "figure_6b",
        "The azimuth factor A",
        "figure 6b",
        "Eq. 14 for the p of the document's figure; the scratch runs up and down. As printed, A is less than 1 on average.",
        Functions(
            family(lambda p, a: A(p, np.cos(a)), "p", ISOTROPIES),
            (0.0, pi),
            "φ, of H's azimuth from the scratch",
            "A",
            polar=True,
            log_radius=True,
            symmetric=True,
            points=1441,
            y=(1e-1, 1e1),
        ),
    ),
    Figure(
        "figure_6c",
        "The obstruction factor G",
        "figure 6c",
        "Eq. 16 for the r of the document's figure.",
        Functions(
            family(lambda r, a: G(r, np.sin(QUARTER - a)), "r", ROUGHNESSES),
            (0.0, QUARTER),
            "θ, of V from N",
            "G",
            polar=True,
            log_radius=True,
            symmetric=True,
            points=721,
            y=(1e-2, 1.0),
        ),
    ),
    Figure(
        "z_and_beckmann",
        "Z beside Beckmann's distribution",
        "eq. 6, 14",
        "The share of normals steeper than a slope, r/(r+tan²α) for Z and exp(-tan²α/m²) for eq. 6. In units of m one picture "
        "shows "
        "every m. Even with the r that fits best Z has far too many flat and far too many steep facets.",
        Functions(
            (
                Function("eq. 6 (Beckmann)", lambda x: np.exp(-(x**2)), reference=True),
                Function("Z with the best r", lambda x: best_rho()[0] / (best_rho()[0] + x**2)),
                Function("Z with r = m²", lambda x: 1.0 / (1.0 + x**2)),
            ),
            (0.02, 50.0),
            "slope tan α over m",
            "share of steeper normals",
            log_x=True,
        ),
    ),
    Figure(
        "a_and_ward",
        "A beside Ward's ellipse",
        "eq. 8, 14",
        "The density of the azimuth of normals over its mean. Dashed: Ward's elliptical Gaussian with m/n = 0.2, which is A² "
        "of the "
        "same p, that is, eq. 14 without its root.",
        Functions(
            (
                Function("eq. 8 (Ward), m/n = 0.2", lambda a: ward_azimuths(0.2, np.cos(np.radians(a))), reference=True),
                Function("A, p = 0.2", lambda a: A(0.2, np.cos(np.radians(a)))),
                Function("A, best p", lambda a: A(best_p(0.2)[0], np.cos(np.radians(a)))),
            ),
            (0.0, 180.0),
            "φ, of H's azimuth from the scratch (degrees)",
            "A, or density over its mean",
        ),
    ),
    Figure(
        "g_and_smith",
        "G beside eq. 7",
        "eq. 7, 16",
        "Eq. 16 with the r that fits best, beside eq. 7 as it is printed: close to it, though eq. 7 is not Smith's factor.",
        Functions(
            tuple(f for m in SLOPES for f in smith_pair(m)),
            (0.0, 90.0),
            "θ, of V from N (degrees)",
            "G",
        ),
    ),
    Figure(
        "smith_and_eq_7",
        "Eq. 7 as printed beside Smith's factor",
        "eq. 7",
        "Dashed: Smith's g/(g + exp(-h)), for which the document prints g/(g + 1).",
        Functions(
            tuple(
                f
                for m in SLOPES
                for f in pair(
                    f"eq. 7, m = {m:g}",
                    lambda a, m=m: smith(m, np.sin(np.radians(90.0 - a))),  # type: ignore[misc]
                    f"Smith, m = {m:g}",
                    lambda a, m=m: smith(m, np.sin(np.radians(90.0 - a)), remainder=True),  # type: ignore[misc]
                )
            ),
            (0.0, 90.0),
            "θ, of V from N (degrees)",
            "G",
        ),
    ),
    Figure(
        "s_and_fresnel",
        "Eq. 11 beside Fresnel",
        "eq. 11",
        "Full lines: eq. 11 with C the reflectance at normal incidence; dashed: Fresnel's reflectance of unpolarised light. The "
        "metals are at 550 nm.",
        Functions(
            tuple(f for name, n in INDICES.items() for f in fresnel_pair(name, n)),
            (0.0, 90.0),
            "angle between the light and the facet's normal (degrees)",
            "reflectance",
        ),
    ),
    Figure(
        "energy",
        "Albedo of the four directional factors",
        "§7; eq. 12, 15, 17, 18",
        "C = 1, p = 1, r = 0.2. “Every proposed formulation obeys to reciprocity and energy conservation laws”: eq. 12 and 17 "
        "diverge, "
        "eq. 18 sends back nearly twice the light.",
        Albedos(by_formulation(0.2), to_grazing=True),
    ),
    Figure(
        "energy_eq15",
        "Albedo of eq. 15",
        "§7; eq. 15",
        "C = 1, p = 1. Its largest albedo, at grazing incidence, is above 1 for r < 0.17.",
        Albedos(
            tuple(schlick(f"r = {r:g}", directional="eq15", r=r) for r in (0.05, 0.1, 0.2, 0.5, 1.0)),
            to_grazing=True,
        ),
    ),
    Figure(
        "earlier_models",
        "Albedo of the models that the document starts from",
        "eq. 4, 5, 8",
        "Eq. 4 with both terms normalised (d = 0, n = 100), eq. 5 with Smith's G as it should be and as eq. 7 prints it (m = "
        "0.2, F = 1), "
        "eq. 8 (m = n = 0.2).",
        Albedos(
            (
                Curve("eq. 4, n = 100", "phong_blend", {"d": 0.0, "n": 100.0}),
                Curve("eq. 5, Smith", "cook_torrance", {"geometry": "smith", "m": 0.2}),
                Curve("eq. 5, eq. 7 as printed", "cook_torrance", {"geometry": "smith", "as_printed": "schlick1993", "m": 0.2}),
                Curve("eq. 8", "ward", {"m": 0.2}),
            ),
            to_grazing=True,
        ),
    ),
    Figure(
        "figure_7",
        "From diffuse to specular",
        "figure 7",
        "Cylinders lit from the eye, C = 1, p = 1 and the r of the document's figure. It does not say by which formulation: "
        "here eq. 17, "
        "the only one that is Lambert's for r = 1.",
        Previews(tuple(schlick(f"r = {r:g}", directional="eq17", r=r) for r in FIGURE_7), lights=("eye",), shapes=("cylinder",)),
    ),
    Figure(
        "figure_8",
        "From isotropic to anisotropic",
        "figure 8",
        "Cylinders lit from the eye, scratched around, as the document says, with its r = 1 and its p, A as printed, exposure "
        "0.6. Eq. 17 is then A/π, which alone makes the surface look brushed, though r = 1 is said to be perfect diffuse.",
        Previews(
            tuple(schlick(f"p = {p:g}", directional="eq17", r=1.0, p=p, as_printed="yes") for p in FIGURE_8),
            lights=("eye",),
            shapes=("cylinder",),
            scratches="around",
            exposure=0.6,
        ),
    ),
    Figure(
        "figure_8_smoother",
        "The same for r = 0.2",
        "figure 8",
        "As figure 8, with r = 0.2 in place of the printed 1.0.",
        Previews(
            tuple(schlick(f"p = {p:g}", directional="eq17", r=0.2, p=p, as_printed="yes") for p in FIGURE_8),
            lights=("eye",),
            shapes=("cylinder",),
            scratches="around",
            exposure=0.6,
        ),
    ),
)
