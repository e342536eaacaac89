"""The page's trials against closed forms that share no code with them, and against distributions and surfaces that must fail."""

import math
from functools import partial

import numpy as np
import pytest
from scipy.integrate import dblquad, quad

from albedo_lab.papers.examine import hear
from albedo_lab.papers.nuaj_models import PAPER, variables
from albedo_lab.papers.nuaj_models.diffuse import bound_value, first_escape, returning
from albedo_lab.papers.nuaj_models.figures import steeper
from albedo_lab.papers.nuaj_models.formulas import beckmann, excess, fresnel, generalised, integral, phong, projected, white_sky
from albedo_lab.papers.nuaj_models.geometry import closest_lobe, facing, masking
from albedo_lab.papers.nuaj_models.normals import ellipsoid, normalised, on_disc, white_furnace
from albedo_lab.papers.nuaj_models.variables import lune, misfit, paired, share_at, share_of_all
from albedo_lab.papers.recipes import Means
from albedo_lab.papers.verdict import Kind
from albedo_lab.pictures.functions import Functions
from albedo_lab.report.drawing import render

QUADRATURE = Means(1e-8, "quadrature")
STATEMENTS = {statement.name: statement for statement in PAPER.statements}
ENGINE = ("importance_sampling", "masked_energy", "isotropic", "equation_4_reciprocal", "too_bright", "rough_at_grazing")
"""Statements whose trials are the library's own checks, which have tests of their own."""
REFUTED = {
    "almost_half",
    "useless_share",
    "d_phong_argument",
    "d_tr",
    "tr_exponent",
    "d_gtr",
    "smooth_below_half",
    "complex_for_polarity",
    "one_minus_fresnel",
    "refracted",
    "transmitted",
    "upper_bound",
}


@pytest.fixture(scope="module")
def heard():
    return {s.name: e for s, e in hear([s for s in PAPER.statements if s.name not in ENGINE], threads=1)}


def test_names_are_unique():
    for several in (PAPER.statements, PAPER.errata, PAPER.figures):
        names = [getattr(one, "name", None) or one.statement for one in several]
        assert len(set(names)) == len(names)


def test_what_is_refuted(heard):
    assert {name for name, e in heard.items() if e.verdict.kind in (Kind.REFUTED, Kind.OFF)} == REFUTED


def test_every_refuted_statement_is_an_erratum_and_nothing_else_is():
    assert {erratum.statement for erratum in PAPER.errata} == REFUTED


def test_evidence_says_why_and_has_a_second_method(heard):
    for name, e in heard.items():
        assert bool(e.why) == (e.verdict.kind in (Kind.REFUTED, Kind.OFF, Kind.UNDECIDED)), name
        if e.verdict.kind is not Kind.UNDECIDED:
            assert e.again not in ("", "—"), name
            assert "nan" not in e.ours + e.again, name


@pytest.mark.parametrize("name", ["half_below", "four_angles", "texels_below", "mirror_level", "transmitted", "rms_slope"])
def test_verdicts_do_not_hang_on_the_seed(name, heard):
    for seed in (1, 2):
        ((_, e),) = hear([STATEMENTS[name]], seed=seed)
        assert e.verdict == heard[name].verdict


def test_the_same_seed_says_the_same(heard):
    ((_, again),) = hear([STATEMENTS["theta_d"]], threads=2)
    assert again == heard["theta_d"]


# Geometry


def test_share_below_in_closed_form():
    assert share_at(np.zeros(1), "root")[0] == pytest.approx(1 / 3, abs=1e-4)
    assert share_at(np.zeros(1), "even")[0] == pytest.approx(1 / 2, abs=1e-4)
    at = 0.7
    inner = quad(lambda t: math.atan2(1.0, math.tan(0.5 * math.pi * t * t) * math.cos(at)), 0, 1)[0]
    assert share_at(np.array([at]), "root")[0] == pytest.approx(1 - inner / (0.5 * math.pi), abs=1e-4)


@pytest.mark.parametrize(("spacing", "expected"), [("root", 24.8), ("even", 38.3)])
def test_share_of_the_table_by_samples(spacing, expected):
    u = np.random.default_rng(5).random((1 << 20, 3))
    theta_h = 0.5 * math.pi * (u[:, 0] ** 2 if spacing == "root" else u[:, 0])
    wi, wo = paired(theta_h, 0.5 * math.pi * u[:, 1], math.pi * u[:, 2])
    sampled = 100 * np.mean(np.minimum(wi[:, 2], wo[:, 2]) < 0)
    assert sampled == pytest.approx(expected, abs=0.2)
    assert 100 * share_of_all(spacing) == pytest.approx(sampled, abs=0.2)


def test_lune_by_quadrature():
    tilt = 0.6
    share = dblquad(
        lambda phi, theta: (
            math.sin(theta) * (math.cos(theta) * math.cos(tilt) < math.sin(theta) * math.cos(phi) * math.sin(tilt))
        ),
        0,
        math.pi / 2,
        0,
        2 * math.pi,
        epsabs=1e-3,
    )[0]
    assert share / (2 * math.pi) == pytest.approx(lune(tilt), abs=1e-3)


def test_a_surface_alone_is_warped_without_a_misfit(monkeypatch):
    monkeypatch.setattr(variables, "SURFACES", ({"alpha": 0.3},))
    assert misfit(30.0, 55.0, (1.0, 0.1, 0.01)) < 1e-3


# Distributions of normals


@pytest.mark.parametrize(
    "D", [partial(phong, 100.0), partial(beckmann, 0.3), partial(generalised, 0.2, 2.0)], ids=["phong", "beckmann", "ggx"]
)
def test_normalised_can_tell(D):
    assert normalised({"right": D})(QUADRATURE).verdict.kind is Kind.HOLDS
    assert normalised({"wrong": lambda t: 1.00001 * D(t)}, "why")(QUADRATURE).verdict.kind is Kind.REFUTED
    assert on_disc(D) == pytest.approx(1.0, abs=1e-4)


@pytest.mark.parametrize("gamma", [0.5, 1.0, 1.5, 2.0, 3.0])
def test_excess_is_the_area_of_the_print(gamma):
    alpha = 0.2
    area = quad(lambda z: math.pi * alpha**2 / math.pi / (alpha**2 * z + 1 - z) ** gamma, 0, 1, epsabs=1e-12)[0]
    assert excess(alpha, gamma) == pytest.approx(area, rel=1e-9)
    assert projected(partial(generalised, alpha, gamma)).value == pytest.approx(area, rel=1e-9)
    limit = math.radians(40.0)
    steep = integral(lambda t: 2 * math.pi * generalised(0.1, gamma, t) * np.cos(t) * np.sin(t), limit, math.pi / 2)
    assert steeper(gamma, np.array([math.tan(limit)]))[0] == pytest.approx(steep.value / excess(0.1, gamma), rel=1e-9)


def test_the_ellipsoid_is_counted_right():
    theta, D = ellipsoid(0.4, np.linspace(0.01, 1.55, 20_000))
    area = np.trapezoid(2 * np.pi * D * np.cos(theta) * np.sin(theta), theta)
    assert area == pytest.approx(1.0, abs=1e-3)  # all of the disc below


def test_the_white_furnace_can_tell():
    assert white_furnace(0.5, 0.3).value == pytest.approx(1.0, abs=1e-6)
    assert abs(white_furnace(0.5, 0.3).value * 4 / math.pi - 1) > 0.2  # with pi for 4


@pytest.mark.parametrize("mu", [0.9, 0.2, 0.05])
def test_facing_area_is_that_of_smith(mu):
    assert facing(mu) == pytest.approx(1 + masking(mu), rel=1e-6)


# Fresnel and what is below the surface


def walsh(n):
    """The share of a white sky that a dielectric reflects (Walsh 1926)."""
    nn = n * n
    return (
        0.5
        + (n - 1) * (3 * n + 1) / (6 * (n + 1) ** 2)
        + nn * (nn - 1) ** 2 / (nn + 1) ** 3 * math.log((n - 1) / (n + 1))
        - 2 * n**3 * (nn + 2 * n - 1) / ((nn + 1) * (nn * nn - 1))
        + 8 * nn * nn * (nn * nn + 1) / ((nn + 1) * (nn * nn - 1) ** 2) * math.log(n)
    )


@pytest.mark.parametrize("n", [1.333, 1.5, 2.417])
def test_white_sky_in_closed_form(n):
    assert white_sky(n).value == pytest.approx(walsh(n), abs=1e-10)
    _, out = returning(n, 3)
    assert first_escape(n).value == pytest.approx(out, abs=1e-4)


def test_the_bound_is_none():
    bound = bound_value(QUADRATURE).value
    assert bound == pytest.approx(0.437, abs=1e-3)
    assert bound < first_escape(1.333).value < 1 - walsh(1.333)


def test_real_indices_dip_above_two_and_the_root_of_three():
    c = np.linspace(0.2, 1.0, 801)
    edge = 2 + math.sqrt(3)
    for n, dips in ((edge - 0.02, False), (edge + 0.02, True)):
        assert (fresnel(n, c).min() < fresnel(n, np.ones(1))[0] - 1e-7) == dips


def test_one_lobe_is_matched_by_one_lobe():
    assert closest_lobe(100.0, 100.0)[1] < 0.01 < closest_lobe(10.0, 1000.0)[1]


# Pictures


FUNCTIONS = [figure for figure in PAPER.figures if isinstance(figure.picture, Functions)]


@pytest.mark.parametrize("figure", FUNCTIONS, ids=[figure.name for figure in FUNCTIONS])
def test_functions_are_defined_everywhere(figure):
    assert np.isfinite(figure.picture.trace(1)[""]["value"]).all()


def test_a_figure_is_drawn():
    picture = FUNCTIONS[0].picture
    assert render(picture, picture.trace(1), kinds=("svg",))["svg"].startswith(b"<?xml")
