"""The bibliography: each source once, cited by its equation."""

from __future__ import annotations

from albedo_lab.model import Reference


def neumann1999(equation: str, *deviations: str) -> Reference:
    """The paper that most of the catalogue comes from."""
    return Reference("Neumann, Neumann, Szirmay-Kalos", "Compact Metallic Reflectance Models", 1999, equation, deviations)


def schlick1993(equation: str, *deviations: str) -> Reference:
    """Fourth Eurographics Workshop on Rendering, 73-83."""
    return Reference("Schlick", "A Customizable Reflectance Model for Everyday Rendering", 1993, equation, deviations)


def losasso(equation: str, *deviations: str) -> Reference:
    """An undated white paper of NVIDIA."""
    return Reference("Losasso", "Surface Reflection Models", None, equation, deviations)
