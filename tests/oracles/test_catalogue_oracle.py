"""The catalogue's oracle against closed forms, literal formulas, Monte Carlo, and its stored table."""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Any

import mpmath
import numpy as np
import pytest
from scipy.integrate import dblquad, quad
from scipy.special import erfc

from tests.oracles.catalogue_albedo import albedo, evaluate, second_opinion
from tests.oracles.formulas import facets, fresnel, lobes, microfacet, rough, schlick
from tests.oracles.formulas.pair import pair_of_vectors
from tests.oracles.make_catalogue import NARROW, WIDE, all_cells

HERE = Path(__file__).parent
CATALOGUE: list[dict[str, Any]] = json.loads((HERE / "catalogue.json").read_text())
REFERENCE = json.loads((HERE / "reference.json").read_text())["albedo"]
PI = math.pi
MICROFACET = {"F": "one", "diffuse": "none", "as_printed": "no"}
SINGLE = {"layers": "single", "spectral": "constant", "as_printed": "no"}
COOK = {"geometry": "smith", "fresnel": "one", "as_printed": "no"}


def agrees(result: tuple[float, float], exact: float, small: float = 1e-8) -> None:
    """The value is the exact one within the oracle's own error bound, and the bound is small."""
    value, error = result
    assert error <= small * abs(exact)
    assert abs(value - exact) <= error + 1e-15 * abs(exact)


# closed forms


def test_ggx_of_width_one() -> None:
    """alpha = 1, mu = 1: D = 1/pi, G1 = 2 c/(1 + c), G1(1) = 1, f c = 1/(2 pi) c/(1 + c) -> 1 - ln 2; both G agree there."""
    for g in ("smith", "smith_correlated"):
        agrees(albedo("microfacet", {"D": "ggx", "G": g, **MICROFACET, "alpha": 1.0}, 1.0), 1.0 - math.log(2.0))
        # c = 1 is D = 1/pi also for Blinn's
    value = albedo("blinn_trowbridge_reitz", {"fresnel": "one", "as_printed": "no", "c": 1.0}, 1.0)
    printed = albedo("blinn_trowbridge_reitz", {"fresnel": "one", "as_printed": "yes", "c": 1.0}, 1.0)
    assert printed[0] == pytest.approx(4.0 * PI * value[0], rel=1e-12)


@pytest.mark.parametrize("mu", [1.0, 1e-4])
def test_lambert(mu: float) -> None:
    """Where the models become Lambert's."""
    for form in ("qualitative", "full"):
        agrees(albedo("oren_nayar", {"form": form, "rho": 0.7, "sigma": 0.0}, mu, effort=1), 0.7)
    agrees(albedo("schlick", {**SINGLE, "directional": "eq17", "C": 0.3, "r": 1.0, "p": 1.0}, mu, effort=1), 0.3)
    agrees(albedo("minnaert", {"as_printed": "no", "k": 1.0}, mu, effort=1), 1.0)
    agrees(albedo("phong_blend", {"as_printed": "no", "d": 1.0, "D": 0.4, "S": 1.0, "n": 5.0}, mu, effort=1), 0.4)
    agrees(albedo("phong_blend", {"as_printed": "yes", "d": 1.0, "D": 0.4, "S": 1.0, "n": 5.0}, mu, effort=1), 0.4 * PI)
    agrees(albedo("plastic", {"fresnel": "one", "a_d": 0.4, "a_s": 0.0, "n": 5.0}, mu, effort=1), 0.4)
    p = {"D": "beckmann", "G": "v_cavity", **MICROFACET, "m": 0.3}
    lambert = (
        albedo("microfacet", {**p, "diffuse": "lambert", "a_d": 0.4}, mu, effort=1)[0] - albedo("microfacet", p, mu, effort=1)[0]
    )
    assert lambert == pytest.approx(0.4, rel=1e-11)
    # F = 1 leaves nothing to 1 - F
    refracted = albedo("microfacet", {**p, "diffuse": "refracted", "a_d": 0.4}, mu, effort=1)
    assert refracted == albedo("microfacet", p, mu, effort=1)


@pytest.mark.parametrize("mu", [0.9, 0.1, 1e-4])
@pytest.mark.parametrize("k", [0.5, 1.6])
def test_minnaert(mu: float, k: float) -> None:
    """Powers: 2 (1 - mu)^{1-k}/(k + 2), 2 mu^k/((2 - k)(3 - k)), 2 mu^{k-1}/(k + 1)."""
    printed = {"as_printed": "yes", "k": k}
    agrees(albedo("minnaert", printed, mu), 2.0 * (1.0 - mu) ** (1.0 - k) / (k + 2.0))
    agrees(albedo("minnaert", printed, mu, order="wo"), 2.0 * mu**k / ((2.0 - k) * (3.0 - k)))
    agrees(albedo("minnaert", {"as_printed": "no", "k": k}, mu), 2.0 * mu ** (k - 1.0) / (k + 1.0))


@pytest.mark.parametrize("n", [3.0, 20.0])
def test_lobes_at_both_ends(n: float) -> None:
    """Normal incidence: 2 pi/(n + 2); grazing limit of the stretched lobe: (n + 2)/(2 (n + 1)), eq. 26."""
    plain = {"lobes": 1, "C_x": 1.0, "C_y": 1.0, "C_z": 1.0, "n": n, "C": (n + 2.0) / (2.0 * PI)}
    agrees(albedo("lafortune", plain, 1.0, effort=1), 1.0)
    stretched = albedo("stretched_lafortune", {**plain, "p": 1.0}, 1e-12, effort=1)
    assert stretched[0] == pytest.approx((n + 2.0) / (2.0 * (n + 1.0)), rel=1e-10)  # the next term is of the order mu
    # C scales, M scales by its n-th power
    double = {**plain, "C_x": 2.0, "C_y": 2.0, "C_z": 2.0}
    assert albedo("lafortune", double, 0.3, effort=1)[0] == pytest.approx(
        2.0**n * albedo("lafortune", plain, 0.3, effort=1)[0], rel=1e-10
    )


def test_against_the_other_oracle() -> None:
    """Models that the older oracle (other coordinates, other formulas) knows under another name."""
    checked = 0
    for row in REFERENCE:
        name, p = row["model"], row["parameters"]
        if row["theta_deg"] not in (0.0, 60.0, 89.999) or row["phi_deg"] != 0.0 or p.get("n") == 1000.0:
            continue
        one = {"lobes": 1, "C_x": 1.0, "C_y": 1.0, "C_z": 1.0, "n": p.get("n"), "C": 1.0}
        if name == "phong":
            new = albedo("lafortune", one, row["mu"], effort=1)
        elif name == "stretched_phong":
            new = albedo("stretched_lafortune", {**one, "p": 1.0}, row["mu"], effort=1)
        elif name == "p_phong":
            new = albedo("stretched_lafortune", {**one, "p": p["p"]}, row["mu"], effort=1)
        elif name == "retro_phong":
            new = albedo("stretched_lafortune", {**one, "C_x": -1.0, "C_y": -1.0, "p": 1.0}, row["mu"], effort=1)
        elif name == "blinn":
            blend = {"as_printed": "yes", "d": 0.0, "D": 0.0, "S": 1.0, "n": p["n"]}
            new = albedo("phong_blend", blend, row["mu"], effort=1)
        elif name == "schlick_isotropic":
            new = albedo("schlick", {**SINGLE, "directional": "eq15", "C": 1.0, "r": p["r"], "p": 1.0}, row["mu"], effort=1)
        else:
            continue
        checked += 1
        assert abs(new[0] - row["value"]) <= new[1] + row["error"]
        assert new[1] <= 1e-7 * new[0]
    assert checked >= 30


# terms


@pytest.mark.parametrize("kind", list(WIDE))
@pytest.mark.parametrize("sets", [WIDE, NARROW])
def test_distributions(kind: str, sets: dict[str, dict[str, Any]]) -> None:
    """D integrates to 1 with the weight t, and P(v), the projected area, is its definition (Smith's white furnace).

    The definition integrated by scipy in two dimensions, without the azimuth integral by hand: 1e-7 is dblquad's own limit
    at the kink where a facet turns away.
    """
    p = sets[kind]

    def density(d: float) -> float:
        t = np.array(math.cos(d))
        return float(facets.distribution(kind, p, t, np.array(math.tan(d) ** 2)))

    total = quad(lambda d: 2.0 * PI * density(d) * math.cos(d) * math.sin(d), 0.0, 0.5 * PI, points=[0.05, 0.2], limit=200)[0]
    assert total == pytest.approx(1.0, rel=1e-9)
    if sets is WIDE:
        v, s = 0.3, math.sqrt(1.0 - 0.09)

        def facing(b: float, d: float) -> float:
            return 2.0 * density(d) * math.sin(d) * max(v * math.cos(d) + s * math.sin(d) * math.cos(b), 0.0)

        area = dblquad(facing, 0.0, 0.5 * PI, 0.0, PI, epsabs=1e-5, epsrel=1e-5)[0]
        g1 = 1.0 / (1.0 + float(facets.smith_lambda(kind, p, v)))
        assert g1 * area == pytest.approx(v, rel=1e-5)


def test_smith_closed_forms() -> None:
    """Beckmann's and GGX's Lambda are the quadrature of the definition; the interpolation meets it everywhere."""
    for c in (1.0, 0.9, 0.3, 1e-3, 1e-7):
        for width in (0.5, 0.05):
            beckmann = c * (1.0 + float(facets.lambda_beckmann(c, width)))
            ggx = c * (1.0 + float(facets.lambda_ggx(c, width)))
            assert facets.projected_area("beckmann", c, m=width) == pytest.approx(beckmann, rel=1e-11)
            assert facets.projected_area("ggx", c, alpha=width) == pytest.approx(ggx, rel=1e-11)
            gtr = facets.projected_area("gtr", c, alpha=width, gamma=2.0)
            assert gtr == pytest.approx(ggx, rel=1e-11)
    p = {"alpha": 0.05, "gamma": 3.0}
    cosines = np.concatenate((np.geomspace(1e-9, 1.0, 20), 1.0 - np.geomspace(1e-9, 0.5, 20)))
    direct = [facets.projected_area("gtr", float(c), **p) for c in cosines]
    np.testing.assert_allclose(facets.interpolated_area("gtr", cosines, p), direct, rtol=1e-10)


def test_fresnel() -> None:
    """Normal incidence, grazing incidence, Brewster's angle, and the classical form of the dielectric."""
    assert fresnel.exact(1.0, 0.2, 3.4) == pytest.approx((0.8**2 + 3.4**2) / (1.2**2 + 3.4**2), rel=1e-14)
    assert fresnel.exact(0.0, 1.5) == pytest.approx(1.0)
    brewster = math.atan(1.5)
    r_s = math.sin(2.0 * brewster - 0.5 * PI)  # sin(theta_i - theta_t)/sin(theta_i + theta_t), the denominator 1
    assert fresnel.exact(math.cos(brewster), 1.5) == pytest.approx(0.5 * r_s**2, rel=1e-12)
    for c in (0.1, 0.7):
        g = math.sqrt(1.33**2 - 1.0 + c * c)
        cook = 0.5 * ((g - c) / (g + c)) ** 2 * (1.0 + ((c * (g + c) - 1.0) / (c * (g - c) + 1.0)) ** 2)
        assert fresnel.exact(c, 1.33) == pytest.approx(cook, rel=1e-13)


def test_azimuthal_factor_of_schlick() -> None:
    """Its mean over the azimuth is 1 after the correction; as printed it is not, and eq. 13 as printed fails even for p = 1."""
    for p in (1.0, 0.5, 0.05):
        points = [0.5 * PI, 1.5 * PI]
        mean = quad(lambda a, p=p: float(schlick.azimuthal(np.array(a), p, "no")), 0.0, 2.0 * PI, points=points)[0] / (2.0 * PI)
        assert mean == pytest.approx(1.0, rel=1e-10)
    mean = quad(lambda a: float(schlick.azimuthal(np.array(a), 0.2, "yes")), 0.0, PI, points=[0.5 * PI])[0] / PI
    assert mean == pytest.approx(0.8588, abs=1e-4)
    assert quad(lambda w: math.sqrt(1.0 - w * w), 0.0, 1.0)[0] == pytest.approx(0.25 * PI)  # printed: pi/2


def test_printed_smith_of_schlick1993() -> None:
    """Smith 1967 is g/(g + exp(-h)), h = cot^2/m^2 for the m of eq. 6; eq. 7 prints g/(g + 1) and cot^2/(2 m^2)."""
    m, c = 0.4, 0.3
    h = c * c / (m * m * (1.0 - c * c))
    g = math.sqrt(h * PI) * (2.0 - erfc(math.sqrt(h)))
    smith = rough.he_shadowing(np.array(c), {"tau": 2.0, "sigma0": m})  # 2 sigma0/tau = m
    assert g / (g + math.exp(-h)) == pytest.approx(float(smith), rel=1e-12)
    h *= 0.5
    g = math.sqrt(h * PI) * (2.0 - erfc(math.sqrt(h)))
    assert microfacet.schlick_smith(c, m) == pytest.approx(g / (g + 1.0), rel=1e-12)
    assert microfacet.schlick_smith(1.0, m) == 1.0


# literal formulas


def directions(count: int, seed: int) -> tuple[np.ndarray, np.ndarray]:
    """Random pairs above the surface."""
    rng = np.random.default_rng(seed)
    w = rng.normal(size=(2, count, 3))
    w /= np.linalg.norm(w, axis=-1, keepdims=True)
    w[..., 2] = np.abs(w[..., 2])
    return w[0], w[1]


def test_losasso_cook_torrance_is_the_correct_one() -> None:
    """The 4 of its D and the pi of its rho are the 4 pi of D F G/(4 v v'): only its Fresnel factors are misprinted."""
    wi, wo = directions(20, 1)
    correct = evaluate("cook_torrance", {**COOK, "geometry": "v_cavity", "m": 0.3}, wi, wo)
    losasso = evaluate("cook_torrance", {**COOK, "geometry": "v_cavity", "as_printed": "losasso", "m": 0.3}, wi, wo)
    np.testing.assert_allclose(losasso, correct, rtol=1e-12)


def test_he_torrance_literally() -> None:
    """Directional-diffuse part from vectors, with the polarisation brackets of He et al. and mpmath's series, z0 by a solver."""
    p = {"fresnel": "exact", "sigma0": 0.15, "tau": 1.2, "wavelength": 0.5, "eta": 0.2, "k": 3.4, "a_d": 0.0}
    wi, wo = directions(4, 2)
    computed = evaluate("he_torrance", p, wi, wo)
    z = np.array([0.0, 0.0, 1.0])
    for k_r, light, value in zip(wo, wi, computed, strict=True):
        k_i = -light
        s_r, s_i = np.cross(k_r, z), np.cross(k_i, z)
        s_r, s_i = s_r / np.linalg.norm(s_r), s_i / np.linalg.norm(s_i)
        p_r, p_i = np.cross(s_r, k_r), np.cross(s_i, k_i)
        brackets = ((s_r @ k_i) ** 2 + (p_r @ k_i) ** 2) * ((s_i @ k_r) ** 2 + (p_i @ k_r) ** 2)
        v = k_r - k_i
        geometrical = (v @ v / v[2]) ** 2 / np.linalg.norm(np.cross(k_r, k_i)) ** 4 * brackets
        theta = [math.acos(light[2]), math.acos(k_r[2])]
        kk = sum(math.tan(x) * erfc(p["tau"] / (2 * p["sigma0"] * math.tan(x))) for x in theta)
        z0 = float(
            mpmath.findroot(
                lambda x, kk=kk: (
                    mpmath.sqrt(mpmath.pi / 2) * x - p["sigma0"] / 4 * kk * mpmath.exp(-(x**2) / (2 * p["sigma0"] ** 2))
                ),
                p["sigma0"] * kk / 8,
            )
        )
        sigma = p["sigma0"] / math.sqrt(1 + (z0 / p["sigma0"]) ** 2)
        g = (2 * PI * sigma / p["wavelength"] * (light[2] + k_r[2])) ** 2
        b = (2 * PI / p["wavelength"]) ** 2 * (v[0] ** 2 + v[1] ** 2) * p["tau"] ** 2 / 4
        series = float(
            mpmath.nsum(lambda m, g=g, b=b: g**m * mpmath.exp(-g - b / m) / (mpmath.factorial(m) * m), [1, mpmath.inf])
        )
        d = PI**2 * p["tau"] ** 2 / (4 * p["wavelength"] ** 2) * series
        s = 1.0
        for x in theta:
            a = p["tau"] / (2 * p["sigma0"] * math.tan(x))
            s *= (1 - erfc(a) / 2) / ((math.exp(-a * a) / (math.sqrt(PI) * a) - erfc(a)) / 2 + 1)
        f = float(fresnel.exact(math.sqrt(0.5 * (1 + light @ k_r)), p["eta"], p["k"]))
        assert value == pytest.approx(f / PI * geometrical * s * d / (light[2] * k_r[2]), rel=1e-9)


def test_he_torrance_limits() -> None:
    """The series; little roughness reflects everything; much roughness is Beckmann's D with m = 2 sigma/tau."""
    for g, b in ((0.01, 3.0), (5.0, 400.0), (80.0, 10.0), (700.0, 5000.0), (2400.0, 100.0)):
        direct = rough.he_series_direct(np.array([g]), np.array([b]), 4000)
        np.testing.assert_allclose(rough.he_series(np.array([g]), np.array([b])), direct, rtol=1e-11)
    smooth = {"fresnel": "one", "sigma0": 0.01, "tau": 50.0, "wavelength": 0.5, "a_d": 0.0}
    assert albedo("he_torrance", smooth, 1.0, effort=1)[0] == pytest.approx(1.0, abs=2e-6)
    # E[1/m] of a Poisson number is 1/g (1 + 1/g + ...), g = 4e6 at v_z = 2
    p = {"fresnel": "one", "sigma0": 100.0, "tau": 600.0, "wavelength": 0.5, "a_d": 0.0}
    wi = np.array([[0.4, 0.0, math.sqrt(0.84)]])
    wo = np.array([[-0.3, 0.1, math.sqrt(0.9)]])
    pair = pair_of_vectors(wi, wo)
    m = 2.0 * float(rough.he_sigma(pair.light, pair.view, p)[0]) / p["tau"]
    beckmann = facets.distribution("beckmann", {"m": m}, pair.t, pair.tan2) / (4.0 * pair.light * pair.view)
    shadowing = rough.he_shadowing(pair.light, p) * rough.he_shadowing(pair.view, p)
    np.testing.assert_allclose(evaluate("he_torrance", p, wi, wo), beckmann * shadowing, rtol=1e-5)


def test_oren_nayar_literally() -> None:
    """The full model in Oren and Nayar's angles, the azimuths taken separately."""
    rho, sigma = 0.8, 0.6
    t_i, p_i, t_r, p_r = 0.9, 0.2, 0.5, 2.9
    wi = np.array([[math.sin(t_i) * math.cos(p_i), math.sin(t_i) * math.sin(p_i), math.cos(t_i)]])
    wo = np.array([[math.sin(t_r) * math.cos(p_r), math.sin(t_r) * math.sin(p_r), math.cos(t_r)]])
    s2, alpha, beta, cos_phi = sigma**2, 0.9, 0.5, math.cos(p_r - p_i)
    c1 = 1 - 0.5 * s2 / (s2 + 0.33)
    c2 = 0.45 * s2 / (s2 + 0.09) * (math.sin(alpha) - (2 * beta / PI) ** 3)  # cos_phi < 0
    c3 = 0.125 * s2 / (s2 + 0.09) * (4 * alpha * beta / PI**2) ** 2
    l1 = rho / PI * (c1 + cos_phi * c2 * math.tan(beta) + (1 - abs(cos_phi)) * c3 * math.tan((alpha + beta) / 2))
    l2 = 0.17 * rho**2 / PI * s2 / (s2 + 0.13) * (1 - cos_phi * (2 * beta / PI) ** 2)
    full = evaluate("oren_nayar", {"form": "full", "rho": rho, "sigma": sigma}, wi, wo)
    assert full[0] == pytest.approx(l1 + l2, rel=1e-12)
    qualitative = evaluate("oren_nayar", {"form": "qualitative", "rho": rho, "sigma": sigma}, wi, wo)
    assert qualitative[0] == pytest.approx(rho / PI * c1, rel=1e-12)


def test_reciprocity() -> None:
    """f(wi, wo) = f(wo, wi), but for the two printed exceptions of losasso and softened sheen."""
    wi, wo = directions(50, 3)
    seen = set()
    for cell in CATALOGUE:
        key = json.dumps([cell["model"], cell["parameters"]])
        if key in seen or cell["model"] in ("mirror", "ggx_multiscatter"):  # the latter's albedos take seconds
            continue
        seen.add(key)
        p = cell["parameters"]
        printed = p.get("as_printed") in ("yes", "losasso")
        exception = printed and (cell["model"] == "minnaert" or (p.get("as_printed") == "losasso" and p["fresnel"] == "schlick"))
        exception |= p.get("visibility") == "softened"
        there, back = (evaluate(cell["model"], p, *pair) for pair in ((wi, wo), (wo, wi)))
        assert np.all(there >= 0.0)
        same = np.allclose(there, back, rtol=1e-8, atol=1e-300)
        assert same != exception or (cell["model"] == "minnaert" and p["k"] == 0.0), key


# whole albedos by other means


MONTE_CARLO = [
    ("schlick", {**SINGLE, "directional": "eq18", "C": 0.8, "r": 0.3, "p": 0.4}),
    ("schlick", {"layers": "double", "spectral": "fresnel", "directional": "eq17", "as_printed": "yes"}
     | {"C": 0.1, "r": 0.4, "p": 0.5, "C_2": 0.6, "r_2": 0.9, "p_2": 0.7}),
    ("cook_torrance", {**COOK, "fresnel": "exact", "m": 0.4, "eta": 1.5, "k": 0.2}),
    ("cook_torrance", {**COOK, "geometry": "v_cavity", "as_printed": "losasso", "fresnel": "schlick", "m": 0.4, "F0": 0.3}),
    ("cook_torrance", {**COOK, "as_printed": "schlick1993", "m": 0.4}),
    ("blinn_trowbridge_reitz", {"fresnel": "schlick", "as_printed": "yes", "c": 0.4, "F0": 0.1}),
    ("oren_nayar", {"form": "full", "rho": 0.8, "sigma": 0.7}),
    ("oren_nayar", {"form": "qualitative", "rho": 0.8, "sigma": 0.7}),
    ("minnaert", {"as_printed": "yes", "k": 0.7}),
    ("phong_blend", {"as_printed": "no", "d": 0.3, "D": 0.8, "S": 0.9, "n": 9.0}),
    ("stretched_lafortune", {"lobes": 2, "C_x": 0.9, "C_y": 0.6, "C_z": 0.95, "n": 5.0, "C": 1.5, "p": 1.0}
     | {"C_x_2": 0.8, "C_y_2": 0.8, "C_z_2": -0.4, "n_2": 3.0, "C_2": 2.0, "p_2": 0.5}),
    ("metal", {"metal": "custom", "angle": "half_vector", "n": 6.0, "eta": 0.2, "k": 3.4}),
    ("plastic", {"fresnel": "exact", "a_d": 0.3, "a_s": 0.7, "n": 6.0, "eta": 1.5}),
    ("microfacet", {"D": "gtr", "G": "smith_correlated", "F": "schlick", "diffuse": "refracted", "as_printed": "no"}
     | {"alpha": 0.5, "gamma": 1.5, "F0": 0.04, "a_d": 0.5}),
    ("microfacet", {"D": "blinn_phong", "G": "v_cavity", "F": "conductor", "diffuse": "none", "as_printed": "no"}
     | {"n": 6.0, "eta": 0.2, "k": 3.4}),
    ("ward", {"form": "half_vector", "as_printed": "no", "m_x": 0.3, "m_y": 0.6}),
]  # fmt: skip


@pytest.mark.parametrize("case", range(len(MONTE_CARLO)))
def test_monte_carlo(case: int) -> None:
    """Literal vectors, cosine-distributed: 5 standard errors (about 1e-3), 1 in 2 million by chance."""
    model, p = MONTE_CARLO[case]
    mu, phi, order = (0.8, 1.2, "wi") if case % 2 else (0.45, 0.3, "wo")
    rng = np.random.default_rng(case)
    u, azimuth = rng.random(200_000), 2.0 * PI * rng.random(200_000)
    moving = np.stack((np.sqrt(u) * np.cos(azimuth), np.sqrt(u) * np.sin(azimuth), np.sqrt(1.0 - u)), axis=-1)
    s = math.sqrt(1.0 - mu * mu)
    fixed = np.array([s * math.cos(phi), s * math.sin(phi), mu])
    f = evaluate(model, p, moving, fixed) if order == "wi" else evaluate(model, p, fixed, moving)
    value, error = albedo(model, p, mu, phi, order, effort=1)
    assert error <= 1e-7 * value
    assert abs(PI * np.mean(f) - value) <= 5.0 * PI * np.std(f) / math.sqrt(u.size)


@pytest.mark.parametrize(
    ("model", "p"),
    [
        ("microfacet", {"D": "gtr", "G": "smith", **MICROFACET, "alpha": 0.2, "gamma": 1.5}),
        ("cook_torrance", {**COOK, "fresnel": "exact", "m": 0.1, "eta": 0.2, "k": 3.4}),
        ("ward", {"form": "half_vector", "as_printed": "no", "m_x": 0.2, "m_y": 0.4}),
    ],
)
@pytest.mark.parametrize("mu", [0.6, 1e-4])
def test_other_coordinates(model: str, p: dict[str, Any], mu: float) -> None:
    """Angles of the half vector against angles of the moving direction; smooth integrands, 1e-9 measured."""
    assert second_opinion(model, p, mu, 0.3) == pytest.approx(albedo(model, p, mu, 0.3)[0], rel=1e-8)


def test_mirror_limit() -> None:
    """Narrow lobes with their full constant become the mirror: F(theta) to within terms of the order of alpha^2, 1/n."""
    p = {"D": "beckmann", "G": "smith", "F": "dielectric", "diffuse": "none", "as_printed": "no", "m": 1e-3, "eta": 1.5}
    assert albedo("microfacet", p, 0.5)[0] == pytest.approx(float(fresnel.exact(0.5, 1.5)), rel=1e-4)
    p = {"metal": "custom", "angle": "theta_min", "n": 1e5, "eta": 0.2, "k": 3.4}
    assert albedo("metal", p, 1.0)[0] * (1e5 + 2.0) / (2.0 * PI) == pytest.approx(float(fresnel.exact(1.0, 0.2, 3.4)), rel=1e-4)
    assert albedo("mirror", {"F": 0.9}, 0.2)[0] == 0.9


# the stored table


def key_of(cell: dict[str, Any]) -> str:
    """What identifies a cell."""
    return json.dumps([cell[k] for k in ("model", "parameters", "order", "mu", "phi")], sort_keys=True)


def test_catalogue_is_complete_and_tight() -> None:
    """Exactly the cells of `make_catalogue`, each better than 1e-6 and nearly all better than 1e-7."""
    assert {key_of(cell) for cell in CATALOGUE} == {key_of(cell) for cell in all_cells()}
    relative = np.array([cell["error"] / cell["value"] if cell["value"] else cell["error"] for cell in CATALOGUE])
    assert np.all(relative < 1e-6)
    assert np.mean(relative < 1e-7) > 0.98
    for cell in CATALOGUE:
        p = cell["parameters"]
        if (
            cell["model"] == "microfacet"
            and p["diffuse"] == "none"
            and p["G"].startswith(("smith", "v_"))
            and p["as_printed"] == "no"
        ):
            assert 0.0 < cell["value"] < 1.0 + 1e-12  # rounding: V-cavities lose nothing of a narrow lobe


@pytest.mark.parametrize("index", np.random.default_rng(5).choice(len(CATALOGUE), 25, replace=False).tolist())
def test_catalogue_is_reproduced(index: int) -> None:
    """The stored value comes back on the shorter mesh."""
    cell = CATALOGUE[index]
    value, error = albedo(cell["model"], cell["parameters"], cell["mu"], cell["phi"], cell["order"], effort=1)
    assert abs(value - cell["value"]) <= error + cell["error"]
    assert error <= 1e-5 * abs(value)


def test_lobe_parameters() -> None:
    """The suffixes of the second lobe."""
    p = {"lobes": 2, "C_x": 1.0, "C_y": 2.0, "C_z": 3.0, "n": 4.0, "C": 5.0, "p": 6.0}
    p |= {f"{name}_2": value + 10.0 for name, value in p.items() if name != "lobes"}
    assert lobes.lobe_parameters(p, True) == [((1.0, 2.0, 3.0), 4.0, 5.0, 6.0), ((11.0, 12.0, 13.0), 14.0, 15.0, 16.0)]
