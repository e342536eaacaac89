"""Statements of sections 7 and 8: the images and the conclusions."""

from __future__ import annotations

import math

import numpy as np

from albedo_lab.optics.fresnel import conductor, normal_reflectance
from albedo_lab.optics.metals import PAPER_WAVELENGTHS, index
from albedo_lab.papers.neumann1999.equations import fresnel
from albedo_lab.papers.neumann1999.statements.introduction import efficient
from albedo_lab.papers.neumann1999.tried import CODE, albedo, in_section, sampled
from albedo_lab.papers.recipes import Means
from albedo_lab.papers.record import Statement
from albedo_lab.papers.trials import Found, trial, undecided


def close_to_one(means: Means) -> Found:
    """Silver's reflectance at normal incidence."""
    indices = [index("silver", wavelength) for wavelength in PAPER_WAVELENGTHS]
    ours = [normal_reflectance(eta, k) for eta, k in indices]
    again = [float(fresnel(complex(eta, k), np.array(1.0))) for eta, k in indices]
    least = min(conductor(eta, k, c) for eta, k in indices for c in (1.0, 0.7, 0.4, 0.1))
    told = f"F(0°) = {min(ours):.4f} to {max(ours):.4f} over 400 to 750 nm, not below {least:.4f} at other angles"
    return Found(least > 0.95, told, "Fresnel, measured indices", f"{min(again):.4f} to {max(again):.4f} (complex amplitudes)")


def slightly_blurred(means: Means) -> Found:
    """The width of the lobe with n = 5000."""
    half = math.degrees(math.acos(0.5 ** (1.0 / 5000.0)))
    viewers = np.linspace(45.0, 48.0, 3001)
    f = in_section("stretched_phong", 45.0, viewers, n=5000)
    at = float(viewers[np.argmax(f < 0.5 * f[0])] - 45.0)
    return Found(
        half < 1.0,
        f"half of the summit at {half:.3f}° from R",
        "closed form",
        f"{at:.3f}° in the plane of incidence at 45° ({CODE})",
    )


def plastic_sequence(means: Means) -> Found:
    """The specular parts of figure 9's spheres under a white sky."""
    spheres = ((0.04, 169.0), (0.065, 64.0), (0.09, 9.0), (0.13, 3.0))
    a = [albedo("plastic", 45.0, fresnel="one", a_d=0.0, a_s=a_s, n=n) for a_s, n in spheres]
    again = sampled("plastic", 45.0, means, fresnel="one", a_d=0.0, a_s=0.13, n=3.0)
    ours = ", ".join(f"{x:.4f}" for x in a) + " of the light at 45° by the specular part alone"
    return Found(
        max(a) < 0.5 and all(b > c for b, c in zip(a[1:], a, strict=False)), ours, "quadrature", f"{again} for the last (rqmc)"
    )


NEW = {"stretched_phong": {"n": 100.0}, "stretched_blinn": {"n": 100.0}, "modified_ward": {"m": 0.1}}

STATEMENTS = (
    Statement(
        "silver_close_to_one",
        "§7",
        "the Fresnel function of the silver is close to 1",
        "Above 0.95 over 400 to 750 nm.",
        trial(close_to_one),
        ("metal",),
    ),
    Statement(
        "slightly_blurred",
        "§7",
        "it has very high n value (5000) … thus the mirror images of the other objects are just slightly blurred",
        "The lobe falls to a half within 1°.",
        trial(slightly_blurred),
        ("stretched_phong",),
    ),
    Statement(
        "large_diffuse_component",
        "§7, figure 9",
        "All spheres have a large diffuse component … (a_s, n) … (0.04, 169), (0.065, 64), (0.09, 9), (0.13, 3)",
        "The specular parts reflect less than half of the light, more from sphere to sphere.",
        trial(plastic_sequence),
        ("plastic",),
    ),
    Statement(
        "suitable_for_sampling",
        "§8",
        "The new models are particularly suitable for importance sampling in Monte-Carlo ray-tracing algorithms.",
        "Stretched Phong, stretched Blinn (n = 100) and modified Ward (m = 0.1) have samplers ten times as efficient "
        "as the cosine.",
        efficient(NEW, True, 10.0),
        tuple(NEW),
    ),
    Statement(
        "simpler_sampling",
        "§8",
        "Importance sampling of the new models is simpler than that of the original Blinn and Ward models",
        "Whether eq. 20 to 25 are simpler than drawing a half-vector.",
        undecided("what is simple is not said; either takes one power or logarithm, one sine and cosine and one reflection"),
        ("stretched_phong", "blinn", "ward"),
    ),
    Statement(
        "metallic_impression",
        "§8",
        "its metallic impression is comparable to that of the physically based models",
        "Whether it looks like metal.",
        undecided("depends on who looks"),
        ("stretched_phong",),
    ),
)
