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


def minnaert1941(equation: str, *deviations: str) -> Reference:
    """Astrophysical Journal 93, 403-410; reference 15 of neumann1999."""
    return Reference("Minnaert", "The Reciprocity Principle in Lunar Photometry", 1941, equation, deviations)


def oren_nayar1994(equation: str, *deviations: str) -> Reference:
    """SIGGRAPH '94, 239-246; reference 17 of neumann1999."""
    return Reference("Oren, Nayar", "Generalization of Lambert's Reflectance Model", 1994, equation, deviations)


def nuaj_models(equation: str, *deviations: str) -> Reference:
    """A page of a wiki, undated."""
    return Reference("Nuaj", "Models", None, equation, deviations)


def matusik2003(equation: str, *deviations: str) -> Reference:
    """ACM Transactions on Graphics 22 (3), 759-769."""
    return Reference("Matusik, Pfister, Brand, McMillan", "A Data-Driven Reflectance Model", 2003, equation, deviations)


def rusinkiewicz1998(equation: str, *deviations: str) -> Reference:
    """Ninth Eurographics Workshop on Rendering, 11-22."""
    return Reference("Rusinkiewicz", "A New Change of Variables for Efficient BRDF Representation", 1998, equation, deviations)


def he1991(equation: str, *deviations: str) -> Reference:
    """Computer Graphics 25(4) (SIGGRAPH '91), 175-186."""
    return Reference(
        "He, Torrance, Sillion, Greenberg", "A Comprehensive Physical Model for Light Reflection", 1991, equation, deviations
    )


def johnson1972(equation: str, *deviations: str) -> Reference:
    """Physical Review B 6(12), 4370-4379."""
    return Reference("Johnson, Christy", "Optical Constants of the Noble Metals", 1972, equation, deviations)


def mcpeak2015(equation: str, *deviations: str) -> Reference:
    """ACS Photonics 2(3), 326-333."""
    return Reference("McPeak et al.", "Plasmonic Films Can Easily Be Better: Rules and Recipes", 2015, equation, deviations)


def smith1967(equation: str, *deviations: str) -> Reference:
    """IEEE Transactions on Antennas and Propagation 15(5), 668-671; reference SMIT67 of schlick1993."""
    return Reference("Smith", "Geometrical Shadowing of a Random Rough Surface", 1967, equation, deviations)


def schlick1994(equation: str, *deviations: str) -> Reference:
    """Computer Graphics Forum 13(3), 233-246."""
    return Reference("Schlick", "An Inexpensive BRDF Model for Physically-based Rendering", 1994, equation, deviations)


def walter2007(equation: str, *deviations: str) -> Reference:
    """Eurographics Symposium on Rendering 2007, 195-206."""
    return Reference(
        "Walter, Marschner, Li, Torrance", "Microfacet Models for Refraction through Rough Surfaces", 2007, equation, deviations
    )


def heitz2014(equation: str, *deviations: str) -> Reference:
    """Journal of Computer Graphics Techniques 3(2), 48-107."""
    title = "Understanding the Masking-Shadowing Function in Microfacet-Based BRDFs"
    return Reference("Heitz", title, 2014, equation, deviations)


def heitz2018(equation: str, *deviations: str) -> Reference:
    """Journal of Computer Graphics Techniques 7(4), 1-13."""
    return Reference("Heitz", "Sampling the GGX Distribution of Visible Normals", 2018, equation, deviations)


def dupuy2023(equation: str, *deviations: str) -> Reference:
    """Computer Graphics Forum 42(8) (High-Performance Graphics 2023)."""
    return Reference("Dupuy, Benyoub", "Sampling Visible GGX Normals with Spherical Caps", 2023, equation, deviations)
