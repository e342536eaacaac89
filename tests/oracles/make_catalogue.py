"""Write catalogue.json: directional albedos of the shapes of the catalogue's models, one cell a line, each with its error.

Run `python tests/oracles/make_catalogue.py [processes] [model ...]` from anywhere; with models named, only their cells are
recomputed and the others are kept.  Every cell: the parameters and choices as a user gives them, the order ("wi": integral
over the light for a fixed viewer at (mu, phi); "wo": the other way round, for models that are not reciprocal), mu, phi in
radians, the albedo of the shape (scale = 1, Dirac part included) and its absolute error.
"""

from __future__ import annotations

import itertools
import json
import math
import sys
import time
from multiprocessing import Pool
from pathlib import Path
from typing import Any

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1]))

from tests.oracles.catalogue_albedo import albedo  # noqa: E402

TARGET = HERE / "catalogue.json"
COS30, COS60, COS85 = (math.cos(math.radians(x)) for x in (30.0, 60.0, 85.0))
MUS = (1.0, COS30, COS60, COS85, 1e-4)
GRAZING = (*MUS, 1e-6)
AZIMUTHS = (0.3, 1.2)
Cell = dict[str, Any]
Parameters = dict[str, Any]


def cells(model: str, p: Parameters, mus: tuple[float, ...] = MUS, anisotropic: bool = False, both: bool = False) -> list[Cell]:
    """The cells of one parameter set."""
    return [
        {"model": model, "parameters": p, "order": order, "mu": mu, "phi": phi}
        for order in (("wi", "wo") if both else ("wi",))
        for phi in (AZIMUTHS if anisotropic else (0.0,))
        for mu in mus
    ]


def schlick_cells() -> list[Cell]:
    """All directional factors, isotropic and anisotropic; Fresnel; two layers."""
    out = []
    layer = {"layers": "single", "spectral": "constant"}
    for directional in ("eq12", "eq15", "eq17", "eq18"):
        for as_printed in ("no", "yes"):
            choice = {**layer, "directional": directional, "as_printed": as_printed}
            mus = MUS if as_printed == "no" else (COS30, COS85)
            out += cells("schlick", {**choice, "C": 0.8, "r": 0.05, "p": 0.5}, mus, anisotropic=True)
            if as_printed == "no":
                out += cells("schlick", {**choice, "C": 1.0, "r": 0.5, "p": 1.0}, GRAZING)
                out += cells("schlick", {**choice, "C": 0.6, "r": 0.005, "p": 0.05}, anisotropic=True)
                fresnel = {**choice, "spectral": "fresnel"}
                out += cells("schlick", {**fresnel, "C": 0.04, "r": 0.3, "p": 1.0})
                double = {**choice, "layers": "double"}
                out += cells("schlick", {**double, "C": 0.1, "r": 0.05, "p": 1.0, "C_2": 0.7, "r_2": 0.8, "p_2": 1.0})
        double = {**layer, "layers": "double", "spectral": "fresnel", "directional": directional, "as_printed": "no"}
        out += cells("schlick", {**double, "C": 0.04, "r": 0.1, "p": 0.3, "C_2": 0.5, "r_2": 0.9, "p_2": 0.8}, anisotropic=True)
    double |= {"as_printed": "yes", "C": 0.04, "r": 0.1, "p": 0.3, "C_2": 0.5, "r_2": 0.9, "p_2": 0.8}
    out += cells("schlick", double, (COS30, COS85), anisotropic=True)  # eq. 18
    lambert = {**layer, "directional": "eq17", "as_printed": "no", "C": 0.7, "r": 1.0, "p": 1.0}
    return out + cells("schlick", lambert)


def cook_torrance_cells() -> list[Cell]:
    """All geometries and Fresnel factors, and the two prints."""
    out = []
    gold, glass = {"eta": 0.2, "k": 3.4}, {"eta": 1.5, "k": 0.0}
    for geometry in ("v_cavity", "smith", "none"):
        plain = {"geometry": geometry, "fresnel": "one", "as_printed": "no"}
        for m in (0.4, 0.1, 0.02):
            out += cells("cook_torrance", {**plain, "m": m}, GRAZING if m == 0.1 else MUS)
        out += cells("cook_torrance", {**plain, "m": 1.0})
        for m in (0.3, 0.03):
            out += cells("cook_torrance", {**plain, "fresnel": "schlick", "m": m, "F0": 0.04})
        out += cells("cook_torrance", {**plain, "fresnel": "exact", "m": 0.3, **glass})
        out += cells("cook_torrance", {**plain, "fresnel": "exact", "m": 0.05, **gold})
    losasso = {"geometry": "v_cavity", "as_printed": "losasso"}
    out += cells("cook_torrance", {**losasso, "fresnel": "one", "m": 0.1}, (COS30, COS85))  # the 4 of D makes it right
    for m in (0.4, 0.1, 0.02):
        out += cells("cook_torrance", {**losasso, "fresnel": "schlick", "m": m, "F0": 0.3}, both=True)
        out += cells("cook_torrance", {**losasso, "fresnel": "exact", "m": m, **glass})
    for geometry in ("smith", "none"):
        out += cells("cook_torrance", {**losasso, "geometry": geometry, "fresnel": "schlick", "m": 0.3, "F0": 0.3}, both=True)
    eurographics = {"geometry": "smith", "as_printed": "schlick1993"}
    for m in (0.4, 0.1, 0.02):
        out += cells("cook_torrance", {**eurographics, "fresnel": "one", "m": m}, GRAZING if m == 0.1 else MUS)
    out += cells("cook_torrance", {**eurographics, "fresnel": "schlick", "m": 0.3, "F0": 0.04})
    out += cells("cook_torrance", {**eurographics, "fresnel": "exact", "m": 0.05, **gold})
    return out + cells("cook_torrance", {**eurographics, "geometry": "v_cavity", "fresnel": "one", "m": 0.2})


def he_torrance_cells() -> list[Cell]:
    """Nearly smooth, gold, rough; F = 1 and exact."""
    one, exact = {"fresnel": "one"}, {"fresnel": "exact"}
    out = cells("he_torrance", {**one, "sigma0": 0.1, "tau": 1.7, "wavelength": 0.5, "a_d": 0.0}, GRAZING)
    gold = {"sigma0": 0.05, "tau": 3.0, "wavelength": 0.6, "eta": 0.2, "k": 3.4, "a_d": 0.1}
    out += cells("he_torrance", {**exact, **gold}, GRAZING)
    out += cells("he_torrance", {**one, "sigma0": 2.0, "tau": 10.0, "wavelength": 0.5, "a_d": 0.0})
    out += cells("he_torrance", {**exact, "sigma0": 2.0, "tau": 10.0, "wavelength": 0.5, "eta": 1.5, "k": 0.0, "a_d": 0.3})
    out += cells("he_torrance", {**one, "sigma0": 0.4, "tau": 2.5, "wavelength": 0.55, "a_d": 0.0})
    return out + cells("he_torrance", {**one, "sigma0": 0.01, "tau": 20.0, "wavelength": 0.5, "a_d": 0.0})


def rough_cells() -> list[Cell]:
    """Oren-Nayar, Minnaert, Ward."""
    out = []
    for form in ("qualitative", "full"):
        for rho, sigma in ((0.8, 0.3), (0.5, 0.05), (1.0, 1.2)):
            out += cells("oren_nayar", {"form": form, "rho": rho, "sigma": sigma}, GRAZING if sigma == 1.2 else MUS)
        out += cells("oren_nayar", {"form": form, "rho": 0.6, "sigma": 0.0}, (1.0, COS60))
    for k in (0.5, 1.0, 1.6):
        out += cells("minnaert", {"as_printed": "no", "k": k})
        if k <= 1.0:  # beyond, (1 - n.wo)^{1-k} is infinite at the normal
            out += cells("minnaert", {"as_printed": "yes", "k": k})
            out += [c | {"order": "wo"} for c in cells("minnaert", {"as_printed": "yes", "k": k})]
    choice = {"form": "half_vector", "as_printed": "no"}
    out += cells("ward", {**choice, "m_x": 0.3, "m_y": 0.3})
    out += cells("ward", {**choice, "m_x": 0.1, "m_y": 0.4}, GRAZING, anisotropic=True)
    out += cells("ward", {**choice, "m_x": 0.05, "m_y": 0.02}, anisotropic=True)
    return out + cells("ward", {**choice, "as_printed": "yes", "m_x": 0.1, "m_y": 0.4}, (COS30, COS85), anisotropic=True)


def simple_cells() -> list[Cell]:
    """Blinn with Trowbridge-Reitz, Phong blend, mirror."""
    out = []
    for as_printed in ("no", "yes"):
        choice = {"fresnel": "one", "as_printed": as_printed}
        for c in (0.5, 0.1, 0.02) if as_printed == "no" else (0.1,):
            out += cells("blinn_trowbridge_reitz", {**choice, "c": c}, GRAZING if c == 0.1 else MUS)
        out += cells("blinn_trowbridge_reitz", {**choice, "c": 1.0}, (1.0, COS60, 1e-4))
        out += cells("blinn_trowbridge_reitz", {**choice, "fresnel": "schlick", "c": 0.3, "F0": 0.04})
        out += cells("blinn_trowbridge_reitz", {**choice, "fresnel": "exact", "c": 0.3, "eta": 1.5, "k": 0.0})
        out += cells("blinn_trowbridge_reitz", {**choice, "fresnel": "exact", "c": 0.05, "eta": 0.2, "k": 3.4})
        for d, n in ((0.5, 20.0), (0.1, 1000.0), (0.0, 1.0)):
            out += cells("phong_blend", {"as_printed": as_printed, "d": d, "D": 0.8, "S": 0.9, "n": n})
    return out + cells("mirror", {"F": 0.93}, (1.0, COS60, 1e-4))


def lobe_cells() -> list[Cell]:
    """Lafortune, stretched Lafortune, metal, plastic."""
    out = []
    first = {"C_x": 1.0, "C_y": 1.0, "C_z": 1.0, "n": 20.0, "C": 1.0}
    across = {"C_x": 0.9, "C_y": 0.6, "C_z": 0.95, "n": 12.0, "C": 1.5}
    retro = {"C_x_2": -0.9, "C_y_2": -0.9, "C_z_2": 0.9, "n_2": 30.0, "C_2": 0.8}
    below = {"C_x": 0.8, "C_y": 0.8, "C_z": -0.4, "n": 3.0, "C": 1.0}
    narrow = {"C_x": 1.0, "C_y": 0.99, "C_z": 1.0, "n": 1000.0, "C": 100.0}
    for one, power in ((first, 1.0), (below, 0.5)):
        out += cells("lafortune", {"lobes": 1, **one}, GRAZING)
        out += cells("stretched_lafortune", {"lobes": 1, **one, "p": power}, GRAZING)
    for one, power in ((across, 0.5), (narrow, 1.0)):
        out += cells("lafortune", {"lobes": 1, **one}, anisotropic=True)
        out += cells("stretched_lafortune", {"lobes": 1, **one, "p": power}, anisotropic=True)
    out += cells("lafortune", {"lobes": 2, **across, **retro}, anisotropic=True)
    out += cells("stretched_lafortune", {"lobes": 2, **across, "p": 1.0, **retro, "p_2": 0.3}, anisotropic=True)
    metals = ((4.0, 0.2, 3.4), (150.0, 1.4, 7.6), (5000.0, 0.05, 3.0))
    for angle, (n, eta, k) in itertools.product(("half_vector", "theta_min"), metals):
        out += cells("metal", {"metal": "custom", "angle": angle, "n": n, "eta": eta, "k": k}, GRAZING if n == 150.0 else MUS)
    for a_d, a_s, n, eta in ((0.5, 0.3, 20.0, 1.5), (0.2, 0.8, 1000.0, 1.33), (0.9, 0.1, 1.0, 2.4)):
        out += cells("plastic", {"fresnel": "exact", "a_d": a_d, "a_s": a_s, "n": n, "eta": eta})
        out += cells("plastic", {"fresnel": "one", "a_d": a_d, "a_s": a_s, "n": n})
    return out


WIDE: dict[str, Parameters] = {
    "blinn_phong": {"n": 10.0},
    "beckmann": {"m": 0.5},
    "trowbridge_reitz": {"alpha": 0.5},
    "ggx": {"alpha": 0.5},
    "gtr": {"alpha": 0.5, "gamma": 1.5},
}
NARROW: dict[str, Parameters] = {
    "blinn_phong": {"n": 400.0},
    "beckmann": {"m": 0.05},
    "trowbridge_reitz": {"alpha": 0.05},
    "ggx": {"alpha": 0.05},
    "gtr": {"alpha": 0.05, "gamma": 3.0},
}


def microfacet_cells() -> list[Cell]:
    """Every D with every G at F = 1; then Fresnel factors, diffuse parts, and the printed constants of D."""
    out = []
    choice = {"F": "one", "diffuse": "none", "as_printed": "no"}
    for d, g in itertools.product(WIDE, ("none", "v_cavity", "smith", "smith_correlated", "schlick")):
        out += cells("microfacet", {"D": d, "G": g, **choice, **WIDE[d]}, GRAZING if g == "smith" else MUS)
        out += cells("microfacet", {"D": d, "G": g, **choice, **NARROW[d]}, GRAZING if g == "smith_correlated" else MUS)
    for g in ("smith", "smith_correlated"):
        out += cells("microfacet", {"D": "ggx", "G": g, **choice, "alpha": 1.0})
        out += cells("microfacet", {"D": "gtr", "G": g, **choice, "alpha": 0.1, "gamma": 2.0}, (1.0, COS60, 1e-4))
    schlick, water = {"F0": 0.04}, {"eta": 1.33}
    gold, absorber = {"eta": 0.2, "k": 3.4}, {"eta": 1.5, "k": 0.5}
    for d, g, f, diffuse, optics in (
        ("ggx", "smith", "schlick", "none", schlick),
        ("ggx", "smith", "schlick", "lambert", schlick),
        ("ggx", "smith", "schlick", "one_minus_fresnel", schlick),
        ("ggx", "smith", "schlick", "refracted", schlick),
        ("ggx", "smith_correlated", "dielectric", "none", water),
        ("beckmann", "v_cavity", "dielectric", "one_minus_fresnel", water),
        ("beckmann", "smith", "dielectric", "refracted", water),
        ("trowbridge_reitz", "smith", "conductor", "none", gold),
        ("beckmann", "v_cavity", "conductor", "lambert", gold),
        ("blinn_phong", "schlick", "conductor", "refracted", absorber),
        ("gtr", "schlick", "schlick", "one_minus_fresnel", schlick),
        ("blinn_phong", "smith", "one", "lambert", {}),
        ("ggx", "none", "one", "refracted", {}),
    ):
        names = {"D": d, "G": g, "F": f, "diffuse": diffuse, "as_printed": "no"}
        albedo_d = {} if diffuse == "none" else {"a_d": 0.5}
        out += cells("microfacet", {**names, **WIDE[d], **optics, **albedo_d})
        if diffuse in ("none", "refracted"):
            out += cells("microfacet", {**names, **NARROW[d], **optics, **albedo_d}, (COS30, COS85))
    for d, g in itertools.product(("trowbridge_reitz", "gtr"), ("none", "v_cavity", "schlick")):
        names = {"D": d, "G": g, "F": "one", "diffuse": "none", "as_printed": "yes"}
        out += cells("microfacet", {**names, **WIDE[d]}, MUS[1:])
    return out


def ggx_cells() -> list[Cell]:
    """Both ends of the domain, both maskings, round and elliptic; then Fresnel factors."""
    out = []
    for g in ("smith", "smith_correlated"):
        choice = {"G": g, "F": "one"}
        for a in (1e-5, 0.05, 0.5, 1.0):
            out += cells("ggx", {**choice, "alpha_x": a, "alpha_y": a}, GRAZING if a == 1e-5 else MUS)
        out += cells("ggx", {**choice, "alpha_x": 0.1, "alpha_y": 0.4}, anisotropic=True)
    out += cells("ggx", {**choice, "alpha_x": 0.3, "alpha_y": 1e-5}, GRAZING, anisotropic=True)
    for f, optics in (("schlick", {"F0": 0.04}), ("dielectric", {"eta": 1.33}), ("conductor", {"eta": 0.2, "k": 3.4})):
        out += cells("ggx", {"G": "smith", "F": f, "alpha_x": 0.3, "alpha_y": 0.3, **optics})
        out += cells("ggx", {"G": "smith_correlated", "F": f, "alpha_x": 0.02, "alpha_y": 0.1, **optics}, anisotropic=True)
    return out


def beckmann_cells() -> list[Cell]:
    """Few, as a sample takes a microsecond; tests/models/test_beckmann.py asks the oracle for others."""
    one = {"G": "smith_correlated", "F": "one"}
    out = cells("beckmann", {"G": "smith", "F": "one", "alpha_x": 0.5, "alpha_y": 0.5}, (COS60, 1e-4))
    out += cells("beckmann", {**one, "alpha_x": 1e-5, "alpha_y": 1e-5}, (COS60, 1e-6))
    return out + cells("beckmann", {**one, "alpha_x": 0.1, "alpha_y": 0.4}, (COS30, COS85), anisotropic=True)


def descendant_cells() -> list[Cell]:
    """Ward-Dür, bounded Ward, Ashikhmin-Shirley and Kelemen: both ends of their domains, round and elliptic."""
    out = []
    for model in ("ward_duer", "ward_bounded"):
        for m in (1e-4, 0.1, 1.0):
            out += cells(model, {"m_x": m, "m_y": m}, GRAZING)
        out += cells(model, {"m_x": 0.1, "m_y": 0.4}, anisotropic=True)
    for n, optics in ((0.0, {"R_s": 0.0, "R_d": 1.0}), (20.0, {"R_s": 0.05, "R_d": 0.5}), (1e4, {"R_s": 1.0, "R_d": 1.0})):
        out += cells("ashikhmin_shirley", {"n_u": n, "n_v": n, **optics}, GRAZING)
    out += cells("ashikhmin_shirley", {"n_u": 5.0, "n_v": 400.0, "R_s": 0.3, "R_d": 0.5}, anisotropic=True)
    for m, f0, r_m in ((1e-4, 1.0, 0.5), (0.2, 0.04, 0.5), (0.05, 0.5, 0.9), (1.0, 1.0, 0.3), (0.6, 0.0, 0.0)):
        out += cells("kelemen", {"m": m, "F0": f0, "r_m": r_m}, GRAZING)
    return out


def diffuse_cells() -> list[Cell]:
    """Fujii, EON, Disney's and Frostbite's diffuse terms."""
    out = []
    for form, rho, sigma in (("mixing", 0.8, 0.4), ("mixing", 1.0, 1.0), ("matched", 0.7, 0.3), ("matched", 1.0, 1.2)):
        out += cells("oren_nayar_fujii", {"form": form, "rho": rho, "sigma": sigma}, GRAZING if rho == 1.0 else MUS)
    for kind in ("exact", "fitted"):
        for rho, r in ((1.0, 1.0), (0.5, 0.3), (0.9, 1e-3)):
            out += cells("eon", {"albedo": kind, "rho": rho, "r": r}, GRAZING if r == 1.0 else MUS)
    out += cells("eon", {"albedo": "exact", "rho": 0.7, "r": 0.0}, (1.0, COS60))
    for form, roughness in itertools.product(("burley", "frostbite"), (0.0, 0.4, 1.0)):
        out += cells("disney_diffuse", {"form": form, "rho": 0.9, "roughness": roughness})
    return out


def volume_cells() -> list[Cell]:
    """Lommel-Seeliger, Hapke, Hanrahan-Krueger: wide and narrow phase functions and surges, layers thin and deep."""
    out = cells("lommel_seeliger", {"w": 0.8}, GRAZING)
    plain, moon = {"b": 0.0, "c": 0.0, "B0": 0.0, "h": 1.0}, {"w": 0.35, "b": 0.3, "c": 0.4, "B0": 1.0, "h": 0.05}
    for H in ("hapke1981", "hapke2002"):
        out += cells("hapke", {"H": H, "w": 0.9, **plain}, GRAZING)
        out += cells("hapke", {"H": H, "w": 1.0, **plain})
        out += cells("hapke", {"H": H, **moon}, GRAZING)
    out += cells("hapke", {"H": "hapke2002", "w": 0.99, "b": 0.8, "c": -0.7, "B0": 0.6, "h": 0.5})
    out += cells("hapke", {"H": "hapke2002", "w": 0.2, "b": 0.7, "c": 1.0, "B0": 1.0, "h": 0.005})
    for g, tau, eta in ((0.0, 1000.0, 1.0), (-0.3, 1000.0, 1.5), (0.8, 0.5, 1.0), (-0.7, 1.0, 1.33), (0.5, 1e-3, 1.5)):
        out += cells("hanrahan_krueger", {"w": 0.9, "g": g, "tau": tau, "eta": eta}, GRAZING if g == -0.3 else MUS)
    return out


def charlie_cells() -> list[Cell]:
    """Each visibility; the softened one in both orders."""
    out = []
    for visibility in ("softened", "smith", "neubelt"):
        for r in (0.05, 0.3, 1.0):
            mus = GRAZING if r == 0.3 else (COS30, COS85)
            out += cells("charlie", {"visibility": visibility, "r": r}, mus, both=visibility == "softened")
    return out


def ggx_multiscatter_cells() -> list[Cell]:
    """Both forms, both maskings, white and coloured; of Turquin's both orders."""
    out = []
    for form, g in itertools.product(("kulla_conty", "turquin"), ("smith_correlated", "smith")):
        choice, both = {"form": form, "G": g}, form == "turquin"
        out += cells("ggx_multiscatter", {**choice, "F": "one", "alpha": 0.6}, GRAZING if g == "smith" else MUS, both=both)
        out += cells("ggx_multiscatter", {**choice, "F": "schlick", "alpha": 1.0, "F0": 0.5}, (1.0, COS60, COS85), both=both)
        out += cells("ggx_multiscatter", {**choice, "F": "schlick", "alpha": 0.1, "F0": 0.9}, (COS30, COS85, 1e-4), both=both)
    return out


def disney_cells() -> list[Cell]:
    """Each lobe alone, and all together."""
    out = []
    for lobe in ("diffuse", "subsurface"):
        for roughness in (0.0, 1.0):
            out += cells("disney", {"lobe": lobe, "baseColor": 1.0, "roughness": roughness}, (1.0, COS60, 1e-4))
    out += cells("disney", {"lobe": "sheen", "sheen": 1.0}, GRAZING)
    for gloss in (0.0, 1.0):
        out += cells("disney", {"lobe": "clearcoat", "clearcoat": 1.0, "clearcoatGloss": gloss}, (1.0, COS60, COS85, 1e-4))
    for lobe, amount in (("specular", {"specular": 0.5}), ("metallic", {"baseColor": 0.9})):
        one = {"lobe": lobe, **amount}
        out += cells("disney", {**one, "roughness": 0.3, "anisotropic": 0.0}, (1.0, COS60, COS85, 1e-4))
        out += cells("disney", {**one, "roughness": 0.6, "anisotropic": 1.0}, (COS30, COS85), anisotropic=True)
    full = {"baseColor": 0.8, "metallic": 0.2, "subsurface": 0.3, "specular": 0.5, "sheen": 0.5, "clearcoat": 1.0}
    for roughness, anisotropic, gloss in ((0.4, 0.5, 0.7), (1.0, 0.0, 0.0)):
        last = {"roughness": roughness, "anisotropic": anisotropic, "clearcoatGloss": gloss}
        out += cells("disney", {"lobe": "all", **full, **last}, (1.0, COS60, COS85, 1e-4), anisotropic=anisotropic > 0.0)
    return out


def all_cells() -> list[Cell]:
    """The whole catalogue."""
    makers = (
        schlick_cells,
        cook_torrance_cells,
        he_torrance_cells,
        rough_cells,
        simple_cells,
        lobe_cells,
        microfacet_cells,
        ggx_cells,
        beckmann_cells,
        descendant_cells,
        diffuse_cells,
        volume_cells,
        charlie_cells,
        ggx_multiscatter_cells,
        disney_cells,
    )
    return [cell for maker in makers for cell in maker()]


def computed(job: tuple[int, Cell]) -> tuple[int, Cell]:
    """One cell with its value and error."""
    index, cell = job
    value, error = albedo(cell["model"], cell["parameters"], cell["mu"], cell["phi"], cell["order"])
    if not (math.isfinite(value) and math.isfinite(error)):
        raise ArithmeticError(f"{cell}: {value} {error}")
    return index, {**cell, "value": value, "error": error}


def write(results: list[Cell]) -> None:
    """One cell a line."""
    TARGET.write_text("[\n" + ",\n".join(json.dumps(cell) for cell in results) + "\n]\n")


def main(arguments: list[str]) -> None:
    """Compute the cells and save them."""
    start = time.time()
    processes = int(arguments[0]) if arguments else 2
    wanted = arguments[1:]
    todo = all_cells()
    keys = [json.dumps([cell[k] for k in ("model", "parameters", "order", "mu", "phi")], sort_keys=True) for cell in todo]
    if len(set(keys)) != len(keys):
        raise ValueError("a cell occurs twice")
    old = {}
    if wanted and TARGET.exists():
        for cell in json.loads(TARGET.read_text()):
            old[json.dumps([cell[k] for k in ("model", "parameters", "order", "mu", "phi")], sort_keys=True)] = cell
    done: dict[int, Cell] = {}
    jobs = []
    for i, (cell, key) in enumerate(zip(todo, keys, strict=True)):
        if wanted and cell["model"] not in wanted and key in old:
            done[i] = old[key]
        else:
            jobs.append((i, cell))
    # neighbours share a mesh: the same mu and azimuth
    jobs.sort(key=lambda job: (job[1]["mu"], job[1]["phi"], job[0]))
    with Pool(processes) as pool:
        done.update(pool.imap_unordered(computed, jobs, chunksize=8))
    write([done[i] for i in sorted(done)])
    print(f"{len(done)} cells, {len(jobs)} computed, {time.time() - start:.0f} s", file=sys.stderr)


if __name__ == "__main__":
    main(sys.argv[1:])
