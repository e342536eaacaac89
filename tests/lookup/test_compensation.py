"""Compensation, against double integrals of the whole compensated BRDF, written out here, over the hemisphere with SciPy."""

from __future__ import annotations

import math
from functools import lru_cache
from itertools import pairwise

import numpy as np
import pandas as pd
import pytest
from scipy.integrate import dblquad, quad
from scipy.interpolate import RegularGridInterpolator

from albedo_lab.analysis.request import effort
from albedo_lab.catalogue import find
from albedo_lab.errors import BadInput
from albedo_lab.lookup import compensation as compensating
from albedo_lab.lookup.axes import Axis, parse_axes
from albedo_lab.lookup.compensation import (
    compensation,
    compensation_of,
    kulla_conty,
    largest_residuals,
    row_mean,
    turquin,
)
from albedo_lab.lookup.source import Source
from albedo_lab.lookup.table import Table, mean_beside, tabulated
from albedo_lab.optics import compensation as terms

WANT = effort(1e-7, "quadrature", 0, None)
ALPHA = 0.55
AXES = ("alpha=3@0.4:0.8", "mu=6")
"""Coarse, so that what is read is far from the truth; ALPHA lies between nodes."""


def source(quantity: str = "albedo", **words: object) -> Source:
    return Source(find("ggx"), quantity, WANT, tuple(words.items()))


@lru_cache(maxsize=1)
def table() -> Table:
    return tabulated("E", source(), parse_axes(AXES))


@lru_cache(maxsize=1)
def means() -> Table:
    found = mean_beside(table(), "E_avg")
    assert found is not None
    return found


def ggx(mu_i: float, mu_o: float, phi: float, alpha: float, F0: float) -> float:
    """F D G2 / (4 mu_i mu_o), correlated Smith and Schlick's reflectance, plain."""
    s_i, s_o = math.sqrt(1.0 - mu_i**2), math.sqrt(1.0 - mu_o**2)
    cos_between = mu_i * mu_o + s_i * s_o * math.cos(phi)
    h = math.sqrt(max(2.0 + 2.0 * cos_between, 1e-30))
    nh, oh = (mu_i + mu_o) / h, 0.5 * h
    d = alpha**2 / (math.pi * (nh**2 * (alpha**2 - 1.0) + 1.0) ** 2)
    lam_i, lam_o = (0.5 * (math.sqrt(1.0 + alpha**2 * (1.0 / mu**2 - 1.0)) - 1.0) for mu in (mu_i, mu_o))
    f = F0 + (1.0 - F0) * (1.0 - oh) ** 5
    return f * d / (1.0 + lam_i + lam_o) / (4.0 * mu_i * mu_o)


def hemisphere(f: object, tolerance: float = 1e-8) -> float:
    """∫ f(mu_i, phi) mu_i dmu_i dphi, twice the half with phi from 0 to pi."""
    found, _ = dblquad(lambda phi, mu: f(mu, phi) * mu, 0.0, 1.0, 0.0, math.pi, epsabs=tolerance, epsrel=tolerance)  # type: ignore[operator]
    return 2.0 * float(found)


def read(mu: float) -> float:
    """The table at ALPHA by SciPy."""
    grid = [axis.nodes for axis in table().axes]
    return float(RegularGridInterpolator(grid, table().values[..., 0])((ALPHA, mu)))


@pytest.mark.parametrize("F0", [1.0, 0.3])
def test_residuals_are_those_of_the_whole_brdf_over_the_hemisphere(F0: float) -> None:
    """f + f_ms and f (1 + F0 (1 - E)/E), with everything read from coarse tables, integrated in plain coordinates.

    The kinks of f_ms at the nodes of mu limit SciPy to 1e-6 or so.
    """
    mu_o = 0.37
    E_avg = float(np.interp(ALPHA, means().axes[0].nodes, means().values[:, 0]))
    F_avg = F0 + (1.0 - F0) / 21.0
    colour = F_avg**2 * E_avg / (1.0 - F_avg * (1.0 - E_avg))
    E_o = read(mu_o)
    grid = np.linspace(0.0, 1.0, 6)
    E_of = [read(float(x)) for x in grid]

    def added(mu: float) -> float:
        return colour * (1.0 - float(np.interp(mu, grid, E_of))) * (1.0 - E_o) / (math.pi * (1.0 - E_avg))

    once = hemisphere(lambda mu, phi: ggx(mu, mu_o, phi, ALPHA, F0))
    more = 2.0 * math.pi * quad(lambda mu: added(mu) * mu, 0.0, 1.0, points=grid[1:-1].tolist(), epsabs=1e-12)[0]
    scaled = hemisphere(lambda mu, phi: ggx(mu, mu_o, phi, ALPHA, F0) * (1.0 + F0 * (1.0 - E_o) / E_o))
    found = compensation(table(), means(), mu=mu_o, F0=F0, values={"alpha": ALPHA}).iloc[0]
    assert found.residual_none == pytest.approx(1.0 - once, abs=1e-6)
    assert found.residual_kulla_conty == pytest.approx(1.0 - once - more, abs=1e-6)
    assert found.residual_turquin == pytest.approx(1.0 - scaled, abs=1e-6)
    assert abs(found.residual_kulla_conty) > 1e-4  # the tables are coarse: something is to be seen
    assert found.E_read == pytest.approx(E_o, abs=1e-14)
    assert found.fresnel == "schlick"


def test_kulla_conty_is_exact_for_white_and_any_albedo() -> None:
    """E + ∫ f_ms cos = 1, for an albedo that no model has: 1 - mu^3 (2 - mu) / 2 with its mean by SciPy."""

    def E(mu: float) -> float:
        return 1.0 - 0.5 * mu**3 * (2.0 - mu)

    E_avg = 2.0 * quad(lambda mu: E(mu) * mu, 0.0, 1.0)[0]
    for mu_o in (1.0, 0.4, 0.05):
        added = hemisphere(lambda mu, phi, mu_o=mu_o: float(kulla_conty(E(mu), E(mu_o), E_avg)))
        assert E(mu_o) + added == pytest.approx(1.0, abs=1e-9)


def test_the_colour_is_the_sum_of_all_reflections_after_the_first() -> None:
    """F^2 E Σ (F (1 - E))^k, in shares of what is lost the first time, for F below 1; 1 for white."""
    F, E_avg = 0.6, 0.7
    series = math.fsum(F**2 * E_avg * (F * (1.0 - E_avg)) ** k for k in range(60))
    coloured, white = kulla_conty(0.2, 0.3, E_avg, F), kulla_conty(0.2, 0.3, E_avg)
    assert coloured / white == pytest.approx(series, rel=1e-14)
    assert white == pytest.approx(0.8 * 0.7 / (math.pi * 0.3), rel=1e-14)


def test_nothing_is_added_where_nothing_is_lost() -> None:
    assert kulla_conty(1.0, 1.0, 1.0) == 0.0
    assert turquin(1.0, 0.5) == 1.0
    assert turquin(0.0, 0.5) == math.inf
    assert turquin(0.5, [0.0, 1.0]).tolist() == [1.0, 2.0]


def test_the_mean_of_schlick() -> None:
    mean = 2.0 * quad(lambda mu: (0.2 + 0.8 * (1.0 - mu) ** 5) * mu, 0.0, 1.0)[0]
    assert terms.schlick_mean(0.2) == pytest.approx(mean, rel=1e-12)


def test_with_exact_albedos_white_is_white_and_colours_are_not() -> None:
    found = compensation(table(), means(), mu=[1.0, 0.1], F0=[1.0, 0.5], values={"alpha": [0.5, 0.7]})
    assert len(found) == 8
    white, coloured = found[found.F0 == 1.0], found[found.F0 == 0.5]
    assert max(abs(white.residual_kulla_conty_exact).max(), abs(white.residual_turquin_exact).max()) < 1e-15
    assert min(coloured.residual_kulla_conty_exact.min(), coloured.residual_turquin_exact.min()) > 0.3
    assert list(found.columns[:5]) == ["model", "alpha", "F0", "fresnel", "mu"]


def test_rough_ggx_at_the_normal_loses_ln_2() -> None:
    """For alpha = 1, mu = 1: E = 1 - ln 2, in closed form."""
    wide = tabulated("E", source(), parse_axes(["alpha=2@0.9:1", "mu=2@0.9:1"]))
    found = compensation(wide, mu=1.0, F0=1.0, values={"alpha": 1.0})
    assert found.residual_none[0] == pytest.approx(math.log(2.0), abs=1e-7)


def test_what_turquin_costs_in_reciprocity() -> None:
    """The asymmetry of the compensated f itself, at every pair, and that Kulla and Conty's lobe has none."""
    mu = [1.0, 0.7, 0.4, 0.1]
    found = compensation(table(), means(), mu=mu, F0=0.6, values={"alpha": ALPHA})
    for i, x in enumerate(mu):
        seen = []
        for y in mu:
            a = ggx(x, y, 1.0, ALPHA, 0.6) * float(turquin(read(y), 0.6))
            b = ggx(y, x, 1.0, ALPHA, 0.6) * float(turquin(read(x), 0.6))
            seen.append(abs(a - b) / (0.5 * (a + b)))
        assert found.asymmetry_turquin[i] == pytest.approx(max(seen), rel=1e-12)
        assert found.asymmetry_turquin_mu[i] == mu[int(np.argmax(seen))]
    assert found.asymmetry_turquin.max() > 0.1
    assert (found.asymmetry_kulla_conty == 0.0).all()


@pytest.mark.parametrize("mapping", ["x", "1-x", "x^2", "sqrt(x)", "sqrt(sqrt(x))", "sqrt(1-x)", "acos(x)"])
@pytest.mark.parametrize("sampling", ["endpoints", "centres"])
def test_the_mean_of_a_row_is_that_of_what_is_read(mapping: str, sampling: str) -> None:
    """2 ∫ E mu dmu of the interpolant, clamped to its edge, piece by piece with SciPy."""
    axis = Axis.parse(mapping.replace("x", "mu") + "=5@0.1:0.9", sampling)
    values = np.array([[0.9], [0.3], [0.7], [0.2], [0.5]])
    row = Table("E", source(alpha=0.5), (axis,), values, 0.0 * values, 0.0 * values, 0)
    order = np.argsort(axis.nodes)
    pieces = [0.0, *axis.nodes[order], 1.0]

    def E(mu: float) -> float:
        t = float(axis.texture(np.array(mu)))
        return float(np.interp(t, axis.coordinates, values[:, 0]))

    mean = math.fsum(2.0 * quad(lambda mu: E(mu) * mu, a, b, epsabs=1e-13)[0] for a, b in pairwise(pieces))
    assert row_mean(row, {}) == pytest.approx(mean, abs=1e-11)


def test_a_table_of_losses_says_the_same() -> None:
    lost = tabulated("L", source("energy-loss"), parse_axes(AXES))
    mean_lost = mean_beside(lost, "L_avg")
    asked = {"mu": [0.9, 0.2], "values": {"alpha": ALPHA}}
    one, other = (compensation(*pair, **asked) for pair in ((table(), means()), (lost, mean_lost)))  # type: ignore[arg-type]
    numbers = one.columns[4:]
    assert np.max(np.abs((one[numbers] - other[numbers]).to_numpy())) < 1e-12


def test_a_table_over_mu_alone_takes_the_exact_mean_and_a_model_without_reflectance_a_constant_one() -> None:
    single = tabulated("E", Source(find("lambert"), "albedo", WANT, (("albedo", 0.8),)), parse_axes(["mu=3"]))
    found = compensation(single, mu=[0.5], F0=[1.0, 0.5])
    assert abs(found.residual_kulla_conty[0]) < 1e-12
    # facets that reflect F = 1/2, E = 0.8: once 0.4, then F^2 E / (1 - F (1 - E)) of the lost 0.2
    assert found.residual_kulla_conty[1] == pytest.approx(1.0 - 0.4 - 0.2 * 0.25 * 0.8 / 0.9, abs=1e-12)
    assert found.residual_turquin[1] == pytest.approx(1.0 - 0.4 * (1.0 + 0.5 * 0.2 / 0.8), abs=1e-12)
    assert found.fresnel[1] == "constant"


def test_the_largest_residuals() -> None:
    found = compensation(table(), means(), values={"alpha": [0.5, ALPHA]})
    worst = largest_residuals(found)
    assert len(worst) == 4
    for row in worst.itertuples():
        group = found[(found.alpha == row.alpha) & (found.F0 == row.F0)]
        assert abs(row.residual_kulla_conty) == abs(group.residual_kulla_conty).max()
        assert group[group.mu == row.residual_kulla_conty_mu].residual_kulla_conty.tolist() == [row.residual_kulla_conty]
        assert row.asymmetry_turquin == group.asymmetry_turquin.max()


def test_nothing_is_computed_before_what_is_asked_is_checked(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(compensating, "tabulated", lambda *_: pytest.fail("computed"))
    axes = parse_axes(AXES)
    for bad, options, named in (
        (source("energy-loss", F="schlick", F0=0.5), {}, "F"),
        (source("split-sum", F="schlick"), {}, "quantity"),
        (source(), {"mu": 0.0}, "mu"),
        (source(), {"F0": 2.0}, "F0"),
        (source(), {"values": {"beta": 1.0}}, "values"),
        (source(), {"values": {"alpha": [0.5, math.nan]}}, "alpha"),
        (source(), {"values": {"alpha": "wide"}}, "alpha"),
    ):
        with pytest.raises(BadInput) as told:
            compensation_of(bad, axes, **options)  # type: ignore[arg-type]
        assert told.value.parameter == named


def test_from_a_source_as_from_its_table() -> None:
    asked = {"mu": [0.9, 0.2], "values": {"alpha": ALPHA}}
    pd.testing.assert_frame_equal(compensation_of(source(), parse_axes(AXES), **asked), compensation(table(), **asked))  # type: ignore[arg-type]


def test_a_mirror_needs_no_compensation() -> None:
    flat = tabulated("E", source(), parse_axes(["alpha=2@0:0.5", "mu=2"]))
    found = compensation(flat, mu=0.5, F0=1.0, values={"alpha": 0.0})
    assert found.residual_none[0] == found.residual_kulla_conty[0] == found.residual_turquin[0] == 0.0


def test_what_cannot_be_compensated_is_refused() -> None:
    def tiny(name: str, quantity: str = "albedo", **words: object) -> Table:
        made = Source(find(name), quantity, effort(1e-3, "quadrature", 0, None), tuple(words.items()))
        return tabulated("E", made, parse_axes(["mu=2@0.5:1"]))

    for wrong, named in (
        (tiny("ggx", "split-sum", alpha=0.5, F="schlick"), "quantity"),
        (tiny("ggx", alpha=0.5, F="schlick", F0=0.5), "F"),
        (tiny("phong_original", n=2), "model"),
    ):
        with pytest.raises(BadInput) as told:
            compensation(wrong)
        assert told.value.parameter == named
    right = tiny("ggx", alpha=0.5)
    for options, named in (
        ({"mu": 0.0}, "mu"),
        ({"mu": [0.5, 1.5]}, "mu"),
        ({"mu": "0.5"}, "mu"),
        ({"F0": -0.1}, "F0"),
        ({"F0": math.nan}, "F0"),
        ({"values": {"alpha": 0.5}}, "values"),
        ({"mean": means()}, "mean"),
    ):
        with pytest.raises(BadInput) as told:
            compensation(right, **options)  # type: ignore[arg-type]
        assert told.value.parameter == named
