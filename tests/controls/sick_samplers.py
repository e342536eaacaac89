"""Sick models whose sampler, density or weight is wrong; their f is healthy."""

from __future__ import annotations

from dataclasses import replace
from math import nan, pi, sqrt
from typing import Any

import numpy as np

from albedo_lab.models.blinn import MODEL as BLINN
from albedo_lab.models.lambert import MODEL as LAMBERT
from albedo_lab.models.microfacet import MODEL as GGX
from albedo_lab.models.oren_nayar import MODEL as OREN_NAYAR
from albedo_lab.models.oren_nayar import pdf as oren_nayar_pdf
from albedo_lab.models.phong import MODEL as PHONG
from albedo_lab.models.phong import pdf as phong_pdf
from albedo_lab.models.phong import sample as phong_sample
from albedo_lab.models.phong_blend import MODEL as PHONG_BLEND
from albedo_lab.models.stretched_phong import MODEL as STRETCHED_PHONG
from albedo_lab.models.stretched_phong import evaluate as stretched_phong
from albedo_lab.models.ward import MODEL as WARD
from albedo_lab.models.ward import Ward, sample_normal
from albedo_lab.models.ward import pdf as ward_pdf
from albedo_lab.models.ward import sample as ward_sample
from albedo_lab.optics.frame import Direction, about_axis, bisector, dot, length, mirror_of, reflect
from albedo_lab.optics.lobes import lobe_pdf, power_normal_pdf, sample_cosine, sample_lobe, sample_power_normal
from albedo_lab.optics.maths import log, pow, sincos2pi
from albedo_lab.optics.microfacet import ggx_visible
from albedo_lab.optics.profiles import power_lobe
from tests.controls.record import Sick

N20 = {"n": 20.0}
ggx_pdf: Any = GGX.pdf


# Densities


def half_vector_density(p: Any, wi: Direction, wo: Direction) -> float:
    """That of the half-vector itself: the Jacobian of reflection, 1 / (4 wo.h), is missing."""
    v = bisector(wi, wo)
    return power_normal_pdf(v, p.n) * 2.0 * length(v)


def jacobian_of_normal(p: Any, wi: Direction, wo: Direction) -> float:
    """4 n.h for 4 wo.h."""
    v = bisector(wi, wo)
    return power_normal_pdf(v, p.n) * dot(v, v) / (2.0 * v.z)


def jacobian_of_two(p: Any, wi: Direction, wo: Direction) -> float:
    return 2.0 * power_normal_pdf(bisector(wi, wo), p.n)


def ggx_pdf_swapped(p: Any, wi: Direction, wo: Direction) -> float:
    return float(ggx_pdf(p, wo, wi))


def oren_nayar_pdf_swapped(p: Any, wi: Direction, wo: Direction) -> float:
    return oren_nayar_pdf(p, wo, wi)


def density_of_next_exponent(p: Any, wi: Direction, wo: Direction) -> float:
    return lobe_pdf(mirror_of(wo), wi, p.n + 1.0)


def unnormalised_density(p: Any, wi: Direction, wo: Direction) -> float:
    """n / (2 pi) for (n+1) / (2 pi)."""
    return float(phong_pdf(p, wi, wo) * p.n / (p.n + 1.0))


def density_of_phong(p: Any, wi: Direction, wo: Direction) -> float:
    return lobe_pdf(mirror_of(wo), wi, p.n)


def density_of_blinn(p: Any, wi: Direction, wo: Direction) -> float:
    return power_normal_pdf(bisector(wi, wo), p.n)


def density_101(p: Any, wi: Direction, wo: Direction) -> float:
    return 1.01 * phong_pdf(p, wi, wo)


def cosine_density_1001(p: Any, wi: Direction, wo: Direction) -> float:
    return 1.001 * wi.z / pi


def density_101_at_grazing(p: Any, wi: Direction, wo: Direction) -> float:
    return phong_pdf(p, wi, wo) * (1.1 if wo.z < 0.05 else 1.0)


def renormalised_density(p: Any, wi: Direction, wo: Direction) -> float:
    """Of n = 1, over the share (1 + mu) / 2 that is not rejected, though rejected samples still count."""
    return lobe_pdf(mirror_of(wo), wi, 1.0) * 2.0 / (1.0 + wo.z)


def density_with_a_hole(p: Any, wi: Direction, wo: Direction) -> float:
    return wi.z / pi if wi.z > 0.1 else 0.0


def half_and_half(p: Any, wi: Direction, wo: Direction) -> float:
    return 0.5 * power_normal_pdf(bisector(wi, wo), p.n) + 0.5 * wi.z / pi


def lobe_alone(p: Any, wi: Direction, wo: Direction) -> float:
    return float(p.branch) * power_normal_pdf(bisector(wi, wo), p.n)


def density_of_one_width(p: Ward, wi: Direction, wo: Direction) -> float:
    return ward_pdf(Ward(p.m_x, p.m_x), wi, wo)


def no_density(p: Any, wi: Direction, wo: Direction) -> float:
    return nan if wi.z < 0.01 else wi.z / pi


ANISOTROPIC = {"m_x": 0.2, "m_y": 0.6}
DENSITIES = (
    Sick("blinn_no_jacobian", "Jacobian of reflection missing", replace(BLINN, pdf=half_vector_density), ("sampler",), N20),
    Sick("blinn_n_h", "4 n.h for 4 wo.h in the Jacobian", replace(BLINN, pdf=jacobian_of_normal), ("sampler",), N20),
    Sick("blinn_2_h", "2 wo.h for 4 wo.h in the Jacobian", replace(BLINN, pdf=jacobian_of_two), ("sampler",), N20),
    Sick("ggx_pdf_swapped", "wi and wo swapped in pdf", replace(GGX, pdf=ggx_pdf_swapped), ("sampler",), {"alpha": 0.3}),
    Sick("oren_nayar_pdf_swapped", "wi and wo swapped in pdf", replace(OREN_NAYAR, pdf=oren_nayar_pdf_swapped), ("sampler",)),
    Sick("phong_pdf_n_1", "density of exponent n + 1", replace(PHONG, pdf=density_of_next_exponent), ("sampler",), N20),
    Sick("phong_pdf_n", "n for n + 1 before the density", replace(PHONG, pdf=unnormalised_density), ("sampler",), N20),
    Sick("blinn_pdf_phong", "density of Phong's lobe", replace(BLINN, pdf=density_of_phong), ("sampler",), N20),
    Sick("phong_pdf_blinn", "density of Blinn's lobe", replace(PHONG, pdf=density_of_blinn), ("sampler",), N20),
    Sick("phong_pdf_1.01", "density scaled by 1.01", replace(PHONG, pdf=density_101), ("sampler",), N20),
    Sick("lambert_pdf_1.001", "density scaled by 1.001", replace(LAMBERT, pdf=cosine_density_1001), ("sampler",)),
    Sick(
        "phong_pdf_at_grazing",
        "density scaled by 1.1 where N.V < 0.05",
        replace(PHONG, pdf=density_101_at_grazing),
        ("sampler",),
        N20,
    ),
    Sick(
        "phong_renormalised",
        "density over the share that is not rejected",
        replace(PHONG, pdf=renormalised_density),
        ("sampler",),
        {"n": 1.0},
    ),
    Sick("pdf_zero", "density 0 where N.L < 0.1", replace(LAMBERT, pdf=density_with_a_hole), ("sampler",)),
    Sick("pdf_nan", "density NaN where N.L < 0.01", replace(LAMBERT, pdf=no_density), ("sampler",)),
    Sick("blend_half", "1/2 for the branch's share in pdf", replace(PHONG_BLEND, pdf=half_and_half), ("sampler",), {"d": 0.2}),
    Sick("blend_one_branch", "density of one branch only", replace(PHONG_BLEND, pdf=lobe_alone), ("sampler",)),
    Sick("ward_m_x", "m_x for m_y in pdf", replace(WARD, pdf=density_of_one_width, weight=None), ("sampler",), ANISOTROPIC),
)


# Samplers


def sample_of_squared_width(p: Any, wo: Direction, u1: float, u2: float) -> Direction:
    return reflect(wo, ggx_visible(p.alpha * p.alpha, wo, u1, u2))


def sample_of_root_width(p: Any, wo: Direction, u1: float, u2: float) -> Direction:
    return reflect(wo, ggx_visible(sqrt(p.alpha), wo, u1, u2))


def half_the_azimuth(p: Any, wo: Direction, u1: float, u2: float) -> Direction:
    return ward_sample(p, wo, u1, 0.5 * u2)


def retro_for_mirror(p: Any, wo: Direction, u1: float, u2: float) -> Direction:
    return sample_lobe(wo, p.n, u1, u2)


def in_the_plane(p: Any, wo: Direction, u1: float, u2: float) -> Direction:
    """As if wo lay in the plane y = 0."""
    return sample_lobe(Direction(-sqrt(wo.x * wo.x + wo.y * wo.y), 0.0, wo.z), p.n, u1, u2)


def one_uniform(p: Any, wo: Direction, u1: float, u2: float) -> Direction:
    return sample_lobe(mirror_of(wo), p.n, u1, u1)


def lifted_above_the_horizon(p: Any, wo: Direction, u1: float, u2: float) -> Direction:
    w = phong_sample(p, wo, u1, u2)
    return Direction(w.x, w.y, abs(w.z))


def power_of_n(p: Any, wo: Direction, u1: float, u2: float) -> Direction:
    """u^(1/n) for u^(1/(n+1))."""
    return sample_lobe(mirror_of(wo), p.n - 1.0, u1, u2)


def uniform_hemisphere(p: Any, wo: Direction, u1: float, u2: float) -> Direction:
    s, (sp, cp) = sqrt((1.0 - u1) * (1.0 + u1)), sincos2pi(u2)
    return Direction(s * cp, s * sp, u1)


def half_the_hemisphere(p: Any, wo: Direction, u1: float, u2: float) -> Direction:
    return sample_cosine(u1, 0.5 * u2)


def half_the_hemisphere_pdf(p: Any, wi: Direction, wo: Direction) -> float:
    return 2.0 * wi.z / pi if wi.y > 0.0 else 0.0


def not_rescaled(p: Any, wo: Direction, u1: float, u2: float) -> Direction:
    if u1 < p.branch:
        return reflect(wo, sample_power_normal(p.n, u1, u2))
    return sample_cosine(u1, u2)


def lobe_in_float32(p: Any, wo: Direction, u1: float, u2: float) -> Direction:
    """The cosine in single precision, in steps of 6e-8, where the lobe is 1e-6 wide; its sine from that cosine."""
    c = float(np.float32(pow(u1, 1.0 / (p.n + 1.0))))
    return about_axis(mirror_of(wo), sqrt(max((1.0 - c) * (1.0 + c), 0.0)), c, sincos2pi(u2))


def not_a_number(p: Any, wo: Direction, u1: float, u2: float) -> Direction:
    w = sample_cosine(u1, u2)
    return w if u1 < 0.999 else Direction(nan, nan, nan)


def not_unit(p: Any, wo: Direction, u1: float, u2: float) -> Direction:
    """The half-vector from its slopes, never normalised."""
    h = sample_normal(p, u1, u2)
    return reflect(wo, Direction(h.x / h.z, h.y / h.z, 1.0))


def sine_for_cosine(p: Any, wo: Direction, u1: float, u2: float) -> Direction:
    s, c = power_lobe(log(u1), p.n)
    return about_axis(mirror_of(wo), c, s, sincos2pi(u2))


SAMPLERS = (
    Sick(
        "ggx_alpha_2", "alpha^2 for alpha in sample", replace(GGX, sample=sample_of_squared_width), ("sampler",), {"alpha": 0.3}
    ),
    Sick(
        "ggx_root_alpha", "alpha for alpha^2 in sample", replace(GGX, sample=sample_of_root_width), ("sampler",), {"alpha": 0.3}
    ),
    Sick("ward_half_azimuth", "azimuth halved in sample", replace(WARD, sample=half_the_azimuth), ("sampler",), {"m": 0.3}),
    Sick("phong_retro", "retro for mirror direction in sample", replace(PHONG, sample=retro_for_mirror), ("sampler",), N20),
    Sick("phong_in_plane", "sample takes wo.y for 0", replace(PHONG, sample=in_the_plane), ("sampler",), N20),
    Sick("phong_one_uniform", "u2 ignored, u1 taken twice", replace(PHONG, sample=one_uniform), ("sampler",), N20),
    Sick(
        "phong_lifted",
        "samples below the horizon turned up",
        replace(PHONG, sample=lifted_above_the_horizon),
        ("sampler",),
        {"n": 1.0},
    ),
    Sick("phong_root_n", "u^(1/n) for u^(1/(n+1)) in sample", replace(PHONG, sample=power_of_n), ("sampler",), N20),
    Sick("phong_sine", "sine and cosine swapped in sample", replace(PHONG, sample=sine_for_cosine), ("sampler",), N20),
    Sick("lambert_uniform", "uniform samples under a cosine density", replace(LAMBERT, sample=uniform_hemisphere), ("sampler",)),
    Sick(
        "half_the_light",
        "sample and pdf agree, and never reach half of f",
        replace(LAMBERT, sample=half_the_hemisphere, pdf=half_the_hemisphere_pdf),
        ("sampler",),
    ),
    Sick("blend_not_rescaled", "u1 not rescaled in a branch", replace(PHONG_BLEND, sample=not_rescaled), ("sampler",)),
    Sick("phong_float32", "cosine of the lobe in float32", replace(PHONG, sample=lobe_in_float32), ("sampler",), {"n": 1e6}),
    Sick("sample_nan", "one sample in a thousand is NaN", replace(LAMBERT, sample=not_a_number), ("sampler",)),
    Sick("ward_not_unit", "half-vector not normalised", replace(WARD, sample=not_unit, weight=None), ("sampler",), {"m": 0.3}),
)


# Weights


def weight_without_pdf(p: Any, wo: Direction, u1: float, u2: float) -> float:
    wi = phong_sample(p, wo, u1, u2)
    return stretched_phong(p, wi, wo) * wi.z if wi.z > 0.0 else 0.0


def weight_without_cosine(p: Any, wo: Direction, u1: float, u2: float) -> float:
    wi = phong_sample(p, wo, u1, u2)
    return stretched_phong(p, wi, wo) / phong_pdf(p, wi, wo) if wi.z > 0.0 else 0.0


def weight_by_wrong_cosine(p: Any, wo: Direction, u1: float, u2: float) -> float:
    wi = phong_sample(p, wo, u1, u2)
    return stretched_phong(p, wi, wo) / phong_pdf(p, wi, wo) * wo.z if wi.z > 0.0 else 0.0


WEIGHTS = (
    Sick("weight_no_pdf", "1/pdf missing in weight", replace(STRETCHED_PHONG, weight=weight_without_pdf), ("sampler",), N20),
    Sick("weight_no_cos", "cosine missing in weight", replace(STRETCHED_PHONG, weight=weight_without_cosine), ("sampler",), N20),
    Sick("weight_wo_z", "N.V for N.L in weight", replace(STRETCHED_PHONG, weight=weight_by_wrong_cosine), ("sampler",), N20),
)

SAMPLING = (*DENSITIES, *SAMPLERS, *WEIGHTS)
