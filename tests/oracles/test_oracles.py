"""The oracle against closed forms, Monte Carlo with literal formulas, 50-digit arithmetic, and its stored table."""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.integrate import quad

from tests.oracles.albedo import HALF_PI, MODELS, albedo, albedo_plain, check_parameters
from tests.oracles.mean import mean_albedo, mean_closed_form, mean_reduced, wallis
from tests.oracles.quadrature import chain, graded_rule
from tests.oracles.supremum import supremum

REFERENCE = json.loads((Path(__file__).parent / "reference.json").read_text())
PI = math.pi
Vectors = NDArray[np.float64]


def agrees(result: tuple[float, float], exact: float) -> None:
    """The value is the exact one within the oracle's own error bound, and the bound is small."""
    value, error = result
    assert error <= 1e-10 * abs(exact)
    assert abs(value - exact) <= error + 4e-16 * abs(exact)


def quick(model: str, mu: float, order: str = "wi", **par: float) -> tuple[float, float]:
    """The oracle, with the shorter mesh where the lobe is wide."""
    return albedo(model, mu, 0.0, order, effort=2 if par.get("n", 0.0) > 100.0 else 1, **par)


@pytest.mark.parametrize("n", [0.0, 7.3])
def test_normal_incidence_of_phong_family(n: float) -> None:
    """At mu = 1 the lobe is cos^n(theta) and the integral is one power of the cosine."""
    agrees(quick("phong", 1.0, n=n), 2 * PI / (n + 2))
    agrees(quick("stretched_phong", 1.0, n=n), 2 * PI / (n + 2))
    agrees(quick("product_phong", 1.0, n=n), 2 * PI / (n + 1))
    agrees(quick("sqrt_phong", 1.0, n=n), 2 * PI / (n + 1.5))
    agrees(quick("phong_original", 1.0, n=n), 2 * PI / (n + 1))
    agrees(quick("phong_original", 1.0, "wo", n=n), 2 * PI / (n + 2))


def test_normal_incidence_of_a_narrow_lobe() -> None:
    """The same for n = 1e8."""
    agrees(quick("stretched_phong", 1.0, n=1e8), 2 * PI / (1e8 + 2))


@pytest.mark.parametrize("n", [0.0, 20.0])
def test_grazing_limit(n: float) -> None:
    """At mu -> 0 the lobe's axis lies in the surface, half of it is above, and c_L/max(c_L, c_V) -> 1."""
    agrees(quick("stretched_phong", 0.0, n=n), PI / (n + 1))
    agrees(quick("retro_phong", 0.0, n=n), PI / (n + 1))
    agrees(quick("plus_phong", 0.0, n=n), 2 * PI / (n + 1))
    agrees(quick("phong_original", 0.0, n=n), PI / (n + 1))
    assert quick("phong_original", 0.0, "wo", n=n)[0] == math.inf
    assert quick("sqrt_phong", 0.0, n=n)[0] == math.inf


@pytest.mark.parametrize("n", [0.0, 20.0])
def test_grazing_limit_of_half_vector_models(n: float) -> None:
    """At mu = 0, V.H = sin(delta) cos(beta) and c_L = 2 (V.H) cos(delta), |beta| < pi/2: products of powers."""
    agrees(quick("blinn", 0.0, n=n), 8 * PI / ((n + 2) * (n + 4)))
    agrees(quick("stretched_blinn", 0.0, n=n), 8 * wallis(n) / (n + 2))
    agrees(quick("plus_blinn", 0.0, n=n), 16 * wallis(n) / (n + 2))


def test_divergence_of_ward() -> None:
    """sqrt(mu) a(mu) tends to a constant K as mu -> 0: Ward's albedo is unbounded, with the exponent -1/2.

    f c_L = exp(-tan^2/m^2)/(4 pi m^2) sqrt(c_L/mu), V.H and c_L as above; K = m^{3/2} Gamma(5/4)/sqrt(2 pi) (1 + ...).
    """
    m = 0.1

    def over_delta(d: float) -> float:
        return math.exp(-((math.tan(d) / m) ** 2)) * math.sin(d) ** 2.5 * math.sqrt(math.cos(d))

    over_beta = math.sqrt(PI) * math.gamma(1.25) / math.gamma(1.75)
    k = math.sqrt(2) / (PI * m**2) * over_beta * quad(over_delta, 0, 1.5, epsabs=1e-16, epsrel=1e-12, points=[m, 3 * m])[0]
    assert quick("ward", 1e-9, m=m)[0] * math.sqrt(1e-9) == pytest.approx(k, rel=1e-7)
    assert k == pytest.approx(m**1.5 * math.gamma(1.25) / math.sqrt(2 * PI), rel=0.05)


@pytest.mark.parametrize("mu", [0.9, 1e-9])
def test_small_powers_at_any_angle(mu: float) -> None:
    """n = 0 and 1: integrals of (N.L)^+ over a lune (Lambert) and of (R.L)^+ (N.L)^+ over the sphere."""
    theta = math.acos(mu)
    agrees(quick("phong", mu, n=0.0), PI / 2 * (1 + mu))
    agrees(quick("phong", mu, n=1.0), 2 / 3 * (math.sin(theta) + (PI - theta) * mu))
    agrees(quick("phong_original", mu, n=0.0), 2 * (PI - theta))
    agrees(quick("phong_original", mu, n=1.0), PI / 2 * (1 + mu))
    agrees(quick("phong_original", mu, "wo", n=0.0), PI / 2 * (1 + mu) / mu)


@pytest.mark.parametrize("n", [0.0, 20.0, 1e8])
def test_normal_incidence_of_blinn(n: float) -> None:
    """N.H = cos(theta/2) = c: 8 pi times the integral of c^{n+1} (2 c^2 - 1) over c in [1/sqrt 2, 1]."""
    near, far = -math.expm1(-0.5 * (n + 4) * math.log(2)), -math.expm1(-0.5 * (n + 2) * math.log(2))
    exact = 8 * PI * (2 * near / (n + 4) - far / (n + 2))
    if n < 1e8:  # to save time
        agrees(quick("blinn", 1.0, n=n), exact)
    agrees(quick("stretched_blinn", 1.0, n=n), exact)


def test_n_dot_h_models_at_normal_incidence() -> None:
    """One-dimensional integrals over u = tan^2(delta) by another integrator; r = 1 is the constant 1/(4 pi)."""
    m = 0.4

    def ward(u: float, power: float) -> float:
        # 4 (V.H) c_L^{1 - power} d omega_H with V.H = cos(delta) and c_L = cos(2 delta) = (1 - u)/(1 + u)
        return math.exp(-u / m**2) / m**2 * ((1 - u) / (1 + u)) ** (1 - power) / (1 + u) ** 2

    assert quick("modified_ward", 1.0, m=m)[0] == pytest.approx(quad(ward, 0, 1, (0.0,))[0], rel=1e-12)
    assert quick("ward", 1.0, m=m)[0] == pytest.approx(quad(ward, 0, 1, (0.5,), epsabs=1e-12)[0], rel=1e-10)
    for mu in (1.0, 0.4, 1e-9):
        agrees(quick("schlick_isotropic", mu, r=1.0), 0.25)
        agrees(quick("lambert", mu, albedo=0.7), 0.7)
        agrees(quick("blinn", mu, n=0.0), PI)


def literal_shape(model: str, light: Vectors, view: Vectors, par: dict[str, float]) -> Vectors:
    """The shape from the vectors as the papers print it; last axis x, y, z."""
    c_l, c_v = light[..., 2], view[..., 2]
    l_dot_v = np.sum(light * view, axis=-1)
    half = light + view
    half /= np.linalg.norm(half, axis=-1, keepdims=True)
    n_dot_h = half[..., 2]
    larger = np.maximum(c_l, c_v)
    if model == "lambert":
        return np.full(c_l.shape, par["albedo"] / PI)
    if model == "schlick_isotropic":
        r = par["r"]
        smith = 1 / (r + (1 - r) * c_l) / (r + (1 - r) * c_v)
        return r / (1 - (1 - r) * n_dot_h**2) ** 2 * smith / (4 * PI)
    if model in ("ward", "modified_ward"):
        m_x, m_y = par["m_x"], par["m_y"]
        exponent = ((half[..., 0] / m_x) ** 2 + (half[..., 1] / m_y) ** 2) / n_dot_h**2
        front = np.exp(-exponent) / (4 * PI * m_x * m_y)
        return front / (larger if model == "modified_ward" else np.sqrt(c_l * c_v))
    if model.endswith("blinn"):
        lobe = n_dot_h ** par["n"]
    else:
        base = l_dot_v if model == "retro_phong" else 2 * c_l * c_v - l_dot_v
        lobe = np.where(base > 0, np.maximum(base, 0.0) ** par["n"], 0.0)
    factors = {
        "plus": 2 / (c_l + c_v),
        "product": 1 / (c_l * c_v),
        "sqrt": 1 / np.sqrt(c_l * c_v),
        "stretched": 1 / larger,
        "retro": 1 / larger,
        "p": larger ** -par.get("p", 1.0),
    }
    if model == "phong_original":
        return lobe / c_l
    return lobe * factors.get(model.split("_")[0], 1.0)


MONTE_CARLO: list[tuple[str, dict[str, float], str]] = [
    ("lambert", {"albedo": 0.5}, "wi"),
    ("phong", {"n": 20.0}, "wi"),
    ("stretched_phong", {"n": 20.0}, "wi"),
    ("plus_phong", {"n": 1.0}, "wi"),
    ("product_phong", {"n": 20.0}, "wi"),
    ("sqrt_phong", {"n": 3.0}, "wi"),
    ("p_phong", {"n": 20.0, "p": 0.25}, "wi"),
    ("retro_phong", {"n": 20.0}, "wi"),
    ("phong_original", {"n": 5.0}, "wi"),
    ("phong_original", {"n": 5.0}, "wo"),
    ("blinn", {"n": 20.0}, "wi"),
    ("stretched_blinn", {"n": 20.0}, "wi"),
    ("plus_blinn", {"n": 20.0}, "wi"),
    ("ward", {"m_x": 0.3, "m_y": 0.6}, "wi"),
    ("modified_ward", {"m_x": 0.3, "m_y": 0.6}, "wi"),
    ("schlick_isotropic", {"r": 0.2}, "wi"),
]


@pytest.mark.parametrize(("model", "par", "order"), MONTE_CARLO)
def test_monte_carlo_with_literal_formulas(model: str, par: dict[str, float], order: str) -> None:
    """Cosine-distributed directions, the formula as printed: 5 standard errors; also reciprocity of that formula."""
    rng = np.random.default_rng(1999)
    mu, phi = 0.35, 0.5
    radius2, azimuth = rng.random(200_000), 2 * PI * rng.random(200_000)
    radius = np.sqrt(radius2)
    moving = np.stack([radius * np.cos(azimuth), radius * np.sin(azimuth), np.sqrt(1 - radius2)], axis=-1)
    s = math.sqrt(1 - mu**2)
    fixed = np.broadcast_to(np.array([s * math.cos(phi), s * math.sin(phi), mu]), moving.shape)
    light, view = (moving, fixed) if order == "wi" else (fixed, moving)
    shape = literal_shape(model, light, view, par)
    samples = PI * shape
    deviation = float(np.std(samples)) / math.sqrt(samples.size)
    value, error = albedo(model, mu, phi, order, effort=1, **par)
    assert error < 1e-10 * value
    assert abs(float(np.mean(samples)) - value) <= 5 * deviation + 1e-12
    if model != "phong_original":
        np.testing.assert_allclose(shape, literal_shape(model, view, light, par), rtol=1e-11)
    else:
        assert not np.allclose(shape, literal_shape(model, view, light, par))


@pytest.mark.parametrize("n", [1.0, 2.5, 20.0, 512.0])
def test_closed_forms_of_the_mean(n: float) -> None:
    """Closed forms against the one-dimensional integrals they come from."""
    for model in (
        "phong",
        "stretched_phong",
        "retro_phong",
        "product_phong",
        "phong_original",
        "blinn",
        "stretched_blinn",
        "plus_blinn",
    ):
        value, error = mean_reduced(model, n=n)
        assert mean_closed_form(model, n=n) == pytest.approx(value, rel=1e-12, abs=error)
    assert mean_reduced("p_phong", n=n, p=0.0)[0] == pytest.approx(mean_reduced("phong", n=n)[0], rel=1e-12)
    assert mean_reduced("p_phong", n=n, p=1.0)[0] == pytest.approx(mean_reduced("stretched_phong", n=n)[0], rel=1e-12)
    assert mean_closed_form("ward", m=1 / n) == pytest.approx(mean_reduced("ward", m=1 / n)[0], rel=1e-12)


@pytest.mark.parametrize(
    ("model", "par", "order"),
    [
        ("stretched_phong", {"n": 20.0}, "wi"),
        ("phong_original", {"n": 3.0}, "wi"),
        ("phong_original", {"n": 3.0}, "wo"),
        ("plus_blinn", {"n": 20.0}, "wi"),
        ("ward", {"m_x": 0.2, "m_y": 0.2}, "wi"),
    ],
)
def test_mean_from_directional_albedo(model: str, par: dict[str, float], order: str) -> None:
    """A short version of the triple quadrature against the reduction."""
    outer = chain([0.0, HALF_PI], graded_rule(6, 8))
    inner = graded_rule(12, 9)
    mu, sine = np.sin(outer.value), np.sin(-outer.offset(HALF_PI))
    values = np.array([albedo_plain(model, float(c), 0.0, order, inner, par) for c in mu])
    direct = 2 * float(np.sum(outer.weight * mu * sine * values))
    assert direct == pytest.approx(mean_reduced(model, **par)[0], rel=2e-6)


def test_suprema() -> None:
    """Where the supremum is known: blinn (normal), unbounded models, and the stored overshoot of stretched n = 1."""
    value, error, theta = supremum("blinn", n=3.0)
    assert theta == 0.0
    agrees((value, error), albedo("blinn", 1.0, n=3.0)[0])
    assert supremum("ward", m=0.1)[0] == math.inf
    assert supremum("product_phong", n=2.0)[0] == math.inf
    stored = next(e for e in REFERENCE["supremum"] if e["model"] == "stretched_phong" and e["parameters"]["n"] == 1.0)
    assert 2 * PI / 3 < stored["supremum"] < 2 * PI / 3 * 1.001
    assert albedo("stretched_phong", math.cos(stored["theta_peak"]), n=1.0)[0] == pytest.approx(stored["supremum"])


def sample(section: str, count: int) -> list[dict[str, Any]]:
    """A fixed random sample of a section."""
    rng = np.random.default_rng(36)
    rows = REFERENCE[section]
    return [rows[int(i)] for i in rng.choice(len(rows), count, replace=False)]


@pytest.mark.parametrize("row", [*sample("albedo", 6), *sample("extreme", 2)])
def test_reference_is_reproduced(row: dict[str, Any]) -> None:
    """The stored value comes back, on the shorter mesh if the parameters are not extreme."""
    phi = math.radians(row.get("phi_deg", 0.0))
    effort = 1 if "theta_deg" in row else 2
    value, error = albedo(row["model"], row["mu"], phi, row["order"], effort, **row["parameters"])
    assert abs(value - row["value"]) <= error + row["error"]
    assert error <= 1e-7 * abs(value)


def test_reference_is_complete_and_tight() -> None:
    """All models are there, the errors are small, mean and supremum are consistent."""
    assert {row["model"] for row in REFERENCE["albedo"]} == set(MODELS)
    for row in REFERENCE["albedo"] + REFERENCE["extreme"]:
        assert row["error"] <= 1e-11 * row["value"]
        assert check_parameters(row["model"], row["parameters"])
    for row in REFERENCE["supremum"]:
        assert row["error"] <= 1e-10 * row["supremum"]
    for row in REFERENCE["mean"]:
        assert row["error"] <= 1e-8 * row["value"]
        for other in (row["reduced"], row["closed_form"]):
            assert other is None or abs(other - row["value"]) <= row["error"] + 1e-12 * other
    for row in REFERENCE["witness"]:
        assert abs(row["witness"] - row["value"]) <= row["error"] + 1e-12 * row["value"]


@pytest.mark.slow
def test_mean_albedo_directly() -> None:
    """The full triple quadrature, once."""
    value, error = mean_albedo("stretched_phong", n=20.0)
    assert abs(value - mean_reduced("stretched_phong", n=20.0)[0]) <= error
