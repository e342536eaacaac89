"""Directional albedo of every model of the catalogue by plain Gauss-Legendre quadrature, Dirac part included.

`albedo(model, parameters, mu, phi, order)` -> (value, error).  A model is a list of parts, each integrated where it is smooth:

* "half": spherical angles (delta, beta) of the half vector, beta from the azimuth of the fixed direction;
  d omega = 4 (F.H) sin(delta) d delta d beta, F the fixed direction.  Broken at the horizon (delta = eta/2), and, where the
  model has V-cavities, at their edges (delta = pi - eta and eta/3, see `half_pairs`) and at v = v' (delta = eta - pi/2).
* "plain": elevation of the moving direction and its azimuth from the mirror plane; "plain_at_60" is also broken at 60 degrees.
* "lobe": spherical angles about the axis of a cosine lobe.
* a constant: Lambert parts (their albedo is a_d by definition) and the Dirac part.

All meshes are graded to every break point (`quadrature`).  The error is the difference from a second, independent mesh (other
grading, other order), plus 1e-12 for rounding; `second_opinion` repeats "half" parts in "plain" coordinates and the reverse.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable, Iterator
from functools import lru_cache
from typing import Any, NamedTuple

import numpy as np

from tests.oracles.formulas import (
    compensated,
    descendants,
    diffuse,
    disney,
    lobes,
    microfacet,
    rough,
    schlick,
    sheen,
    volume,
)
from tests.oracles.formulas.fresnel import exact
from tests.oracles.formulas.pair import Array, Pair, pair_of_vectors
from tests.oracles.quadrature import Rule, chain, graded_rule

PI = math.pi
HALF_PI = 0.5 * math.pi
Parameters = dict[str, Any]


class Part(NamedTuple):
    """A part of a model: where it is integrated, and its f_r as a function of the pair of directions."""

    where: str
    f: Callable[[Pair, Parameters], Array]
    cavities: bool = False
    isotropic: bool = True
    depth: int = 0  # 0: chosen from mu
    nodes: int = 16  # of a panel


PLAIN: dict[str, Callable[[Pair, Parameters], Array]] = {
    "oren_nayar_fujii": diffuse.fujii,
    "eon": diffuse.eon,
    "disney_diffuse": diffuse.disney,
    "lommel_seeliger": volume.lommel_seeliger,
    "hapke": volume.hapke,
    "hanrahan_krueger": volume.hanrahan_krueger,
}
"""Models of one part, smooth but for the circle of equal cosines and the plane of both directions."""


def parts_of(model: str, p: Parameters) -> list[Part]:
    """The parts that need a two-dimensional quadrature about the normal."""
    if model == "schlick":
        isotropic = p["p"] == 1.0 and (p["layers"] == "single" or p["p_2"] == 1.0)
        return [Part("half", schlick.schlick, isotropic=isotropic)]
    if model == "phong_blend":
        return [Part("half", schlick.phong_blend)]
    if model == "cook_torrance":
        # eq. 7 of schlick1993 as printed is 1 - const theta near the normal: a cone, broken at the pole of "plain" only
        cone = p["geometry"] == "smith" and p["as_printed"] == "schlick1993"
        return [Part("plain" if cone else "half", microfacet.cook_torrance, cavities=p["geometry"] == "v_cavity")]
    if model == "blinn_trowbridge_reitz":
        return [Part("half", microfacet.blinn_trowbridge_reitz, cavities=True)]
    if model == "microfacet":
        return [Part("half", microfacet.microfacet, cavities=p["G"] == "v_cavity")]
    if model in ("ggx", "beckmann"):
        f = {"ggx": microfacet.ggx, "beckmann": microfacet.beckmann}[model]
        isotropic = p["alpha_x"] == p["alpha_y"]
        # graded down to a hundredth of the narrowest lobe
        depth = math.ceil(math.log(100.0 / min(p["alpha_x"], p["alpha_y"]), 4.0))
        return [Part("half", f, isotropic=isotropic, depth=max(9, depth))]
    if model == "disney":
        isotropic = p.get("anisotropic", 0.0) == 0.0
        parts = {"metallic": disney.specular, "specular": disney.specular, "clearcoat": disney.clearcoat}
        if p["lobe"] != "all":
            return [Part("half", parts.get(p["lobe"], disney.base), isotropic=isotropic, depth=12)]
        return [Part("half", f, isotropic=isotropic, depth=12) for f in (disney.base, disney.specular, disney.clearcoat)]
    if model == "ggx_multiscatter":
        if p["form"] == "turquin":
            return [Part("half", compensated.turquin)]
        return [Part("half", compensated.facets), Part("plain", compensated.lobe)]
    if model == "charlie":
        # the fitted Lambda has a kink where the cosine is 1/2
        return [Part("half" if p["visibility"] == "neubelt" else "plain_at_60", sheen.charlie)]
    if model == "ward":
        return [Part("half", rough.ward, isotropic=p["m_x"] == p["m_y"])]
    if model in ("ward_duer", "ward_bounded"):
        f = {"ward_duer": descendants.ward_duer, "ward_bounded": descendants.ward_bounded}[model]
        return [Part("half", f, isotropic=p["m_x"] == p["m_y"], depth=depth_of_width(min(p["m_x"], p["m_y"])))]
    if model == "ashikhmin_shirley":
        depth = depth_of_width((max(p["n_u"], p["n_v"]) + 1.0) ** -0.5)
        return [Part("half", descendants.ashikhmin_shirley, cavities=True, isotropic=p["n_u"] == p["n_v"], depth=depth)]
    if model == "kelemen":
        return [Part("half", descendants.kelemen, depth=depth_of_width(p["m"]))]
    if model == "oren_nayar":
        return [Part("plain", rough.oren_nayar)]
    if model in PLAIN:
        return [Part("plain", PLAIN[model])]
    if model == "minnaert":
        return [Part("plain", rough.minnaert, depth=18)]
    if model == "he_torrance":
        return [Part("plain", rough.he_directional_diffuse, depth=5, nodes=20)]
    if model in ("lafortune", "stretched_lafortune", "metal", "plastic", "mirror"):
        return []
    raise ValueError(f"unknown model {model!r}")


def depth_of_width(width: float) -> int:
    """Graded down to a hundredth of a lobe's width."""
    return max(9, math.ceil(math.log(100.0 / width, 4.0)))


def constant_of(model: str, p: Parameters, mu: float) -> float:
    """Lambert parts and Dirac parts."""
    if model == "mirror":
        return float(p["F"])
    if model == "plastic":
        return float(p["a_d"])
    if model == "hanrahan_krueger":
        return float(exact(mu, p["eta"]))
    if model == "he_torrance":
        return rough.he_mirror(mu, p) + float(p["a_d"])
    if model == "ashikhmin_shirley":
        return descendants.ashikhmin_shirley_diffuse(mu, p)
    if model == "kelemen":
        return float(p["r_m"])
    return 0.0


def sides(order: str, moving: Array, mu: float) -> tuple[Array | float, Array | float]:
    """(n.wi, n.wo)."""
    return (moving, mu) if order == "wi" else (mu, moving)


def segments(ends: list[Array], rule: Rule) -> Iterator[tuple[Array, Array, Array, Array]]:
    """Nodes on consecutive segments of every row: value, distance from ends[0], distance to ends[-1], weight."""
    for start, stop in itertools.pairwise(ends):
        length = stop - start
        if not np.any(length > 0.0):
            continue
        left, right = rule.left[None, :] * length, rule.right[None, :] * length
        x = np.where(rule.left <= rule.right, start + left, stop - right)
        yield x, (start - ends[0]) + left, (ends[-1] - stop) + right, rule.weight[None, :] * length


def half_pairs(mu: float, phi: float, cavities: bool, isotropic: bool, rule: Rule) -> list[tuple[Array, ...]]:
    """Blocks of the mesh in half-vector angles: (moving cosine, tan2, t, u, azimuth of h, weight with cosine and Jacobian).

    With a = s cos(beta), S = hypot(mu, a), eta = atan2(mu, -a):  F.H = mu cos(delta) + a sin(delta) = S sin(eta - delta), and
    the moving cosine 2 (F.H) cos(delta) - mu = S sin(eta - 2 delta).  Cavities: 2 t mu = u where tan(delta) = mu/a; 2 t z = u, z
    the moving cosine, where mu - 3 mu T^2 + 3 a T - a T^3 = 0, T = tan(delta), that is tan(3 delta) = -mu/a.
    """
    s = math.sqrt((1.0 - mu) * (1.0 + mu))
    breaks = [0.0, HALF_PI, PI]
    if cavities and mu < s:
        breaks.append(math.acos(mu / s))
    if not isotropic:
        breaks = [k * HALF_PI for k in range(-2, 3)] + [math.remainder(k * HALF_PI - phi, 2.0 * PI) for k in range(4)]
    outer = chain(sorted(set(breaks)), rule)
    offset = np.where(outer.value >= 0.0, -outer.offset(HALF_PI), outer.offset(-HALF_PI))
    cosine_all = np.sin(offset)
    blocks = []
    step = max(1, 100_000 // (2 * rule.left.size))
    for i in range(0, outer.value.size, step):
        rows = slice(i, i + step)
        a = s * cosine_all[rows, None]
        size = np.hypot(mu, a)
        eta = np.arctan2(mu, -a)
        horizon = 0.5 * eta
        inner = [np.zeros_like(eta), horizon]
        if cavities:
            inner += [np.clip(x, 0.0, horizon) for x in (PI - eta, eta / 3.0, eta - HALF_PI)]
        ends = list(np.sort(np.hstack(inner), axis=1).T[:, :, None])
        for delta, _, to_horizon, weight in segments(ends, rule):
            z = np.maximum(size * np.sin(2.0 * to_horizon), 1e-30)  # 0 only on segments of no length
            u = np.maximum(size * np.sin(horizon + to_horizon), 1e-30)
            full = 4.0 * u * np.sin(delta) * z * weight * outer.weight[rows, None] * (2.0 if isotropic else 1.0)
            t = np.cos(delta)
            blocks.append((z, np.tan(delta) ** 2, t, u, phi + outer.value[rows, None], full))
    return blocks


def plain_pairs(mu: float, phi: float, isotropic: bool, rule: Rule, at: tuple[float, ...] = ()) -> list[tuple[Array, ...]]:
    """The same blocks in the elevation e of the moving direction and its azimuth psi from the mirror plane.

    tan^2(delta) = tan^2((e - e_0)/2) + 4 s s_0 sin^2(psi/2)/(z + mu)^2;  1 - R.V = 2 sin^2((e - e_0)/2) + 2 s s_0 sin^2(psi/2);
    u^2 = (1 + wi.wo)/2 = z mu + (1 - R.V)/2.  Three more columns: the mirror cosine, -cos(psi) and 1 - z.
    """
    s0 = math.sqrt((1.0 - mu) * (1.0 + mu))
    e0 = math.atan2(mu, s0)
    outer = chain(sorted({0.0, e0, HALF_PI, *at}), rule)
    breaks = [0.0, HALF_PI, PI] if isotropic else [-PI, -HALF_PI, 0.0, HALF_PI, PI]
    azimuth = chain(breaks, rule)
    psi = azimuth.value[None, :]
    opening = np.where(np.abs(psi) < 1.0, -np.cos(psi), np.sin(azimuth.offset(HALF_PI))[None, :])
    opening = np.where(psi < -1.0, np.sin(-azimuth.offset(-HALF_PI))[None, :], opening)
    blocks = []
    step = max(1, 100_000 // psi.size)
    pole_all = 2.0 * np.sin(0.5 * outer.offset(HALF_PI)) ** 2  # 1 - z
    for i in range(0, outer.value.size, step):
        rows = slice(i, i + step)
        z, s = np.sin(outer.value[rows, None]), np.sin(-outer.offset(HALF_PI)[rows, None])
        half = 0.5 * outer.offset(e0)[rows, None]
        across = 2.0 * s * s0 * np.sin(0.5 * psi) ** 2
        short = 2.0 * np.sin(half) ** 2 + across
        tan2 = np.tan(half) ** 2 + 2.0 * across / (z + mu) ** 2
        u = np.sqrt(z * mu + 0.5 * short)
        along = (z + mu) * np.tan(half) + 2.0 * s * np.sin(0.5 * psi) ** 2  # s0 - s cos(psi)
        h_azimuth = phi + np.arctan2(-s * np.sin(psi), along)
        full = s * z * outer.weight[rows, None] * azimuth.weight[None, :] * (2.0 if isotropic else 1.0)
        blocks.append((z, tan2, 1.0 / np.sqrt(1.0 + tan2), u, h_azimuth, full, 1.0 - short, opening, pole_all[rows, None]))
    return blocks


@lru_cache(maxsize=4)
def cached_mesh(where: str, mu: float, phi: float, cavities: bool, isotropic: bool, rule_key: tuple[int, int, float]) -> Any:
    """One mesh serves all models of its kind."""
    rule = graded_rule(*rule_key)
    if where == "half":
        return half_pairs(mu, phi, cavities, isotropic, rule)
    return plain_pairs(mu, phi, isotropic, rule, (HALF_PI / 3.0,) if where == "plain_at_60" else ())


def integrate_part(
    part: Part, p: Parameters, mu: float, phi: float, order: str, rule_key: tuple[int, int, float], where: str | None = None
) -> float:
    """Integral of f cos over the hemisphere of the moving direction."""
    total = 0.0
    where = where or part.where
    angle = 0.0 if part.isotropic else phi
    for z, tan2, t, u, azimuth, weight, *rest in cached_mesh(where, mu, angle, part.cavities, part.isotropic, rule_key):
        light, view = sides(order, z, mu)
        pair = Pair(light, view, tan2, t, u, azimuth, *rest[:2])
        if rest:
            pair.one_minus_view = sides(order, rest[2], 1.0 - mu)[1]
        pair.view_azimuth = angle if order == "wi" else None
        total += float(np.sum(part.f(pair, p) * weight))
    return total


def lobe_integral(
    axis: tuple[float, float, float],
    n: float,
    power: float,
    mu: float,
    rule: Rule,
    factor: Callable[[Array, Array], Array] | None = None,
) -> float:
    """Integral over the hemisphere of [(axis.w)^+]^n z / max(z, mu)^power, or of [(axis.w)^+]^n z factor(z, 1 - cos alpha).

    alpha = angle of w from the axis, psi its azimuth about the axis, 0 towards the normal: z = d_z cos(alpha) + s_d cos(psi)
    sin(alpha) for the unit axis d.  z = S cos(alpha - kappa), S = hypot(d_z, s_d cos psi), kappa = atan2(s_d cos psi, d_z).
    """
    length = math.hypot(*axis)
    d_z, s_d = axis[2] / length, math.hypot(axis[0], axis[1]) / length
    breaks = [0.0, HALF_PI, PI] if d_z > 0.0 else [0.0, HALF_PI]
    if s_d > mu:
        breaks.append(math.acos(mu / s_d))  # the kink z = mu crosses alpha = pi/2
    if d_z * d_z < mu * mu < 1.0 and s_d > 0.0:
        x = math.sqrt((mu - d_z) * (mu + d_z)) / s_d
        if x < 1.0:
            breaks += [math.acos(x), math.acos(-x)]  # S = mu
    outer = chain(sorted({b for b in breaks if b <= max(breaks[:3])}), rule)
    side_all = s_d * np.sin(-outer.offset(HALF_PI))
    total = 0.0
    step = max(1, 100_000 // (2 * rule.left.size))
    for i in range(0, outer.value.size, step):
        rows = slice(i, i + step)
        side = side_all[rows, None]
        size = np.hypot(d_z, side)
        kappa = np.arctan2(side, d_z)
        low = np.clip(kappa - HALF_PI, 0.0, HALF_PI)
        high = np.clip(kappa + HALF_PI, low, HALF_PI)
        spread = np.arccos(np.minimum(mu / size, 1.0))
        inner = [low, high, np.clip(kappa - spread, low, high), np.clip(kappa + spread, low, high)]
        ends = list(np.sort(np.hstack(inner), axis=1).T[:, :, None])
        for alpha, from_low, to_high, weight in segments(ends, rule):
            # distance to the horizon: kappa + pi/2 - alpha, or alpha - (kappa - pi/2)
            z = size * np.where(kappa > HALF_PI, np.sin(from_low), np.sin(np.maximum(kappa + HALF_PI - high, 0.0) + to_high))
            cos_alpha = np.sin((HALF_PI - high) + to_high)
            value = cos_alpha**n * z * np.sin(alpha)
            if factor is not None:
                value = value * factor(z, 2.0 * np.sin(0.5 * alpha) ** 2)
            elif power != 0.0:
                value = value / np.maximum(z, mu) ** power
            total += 2.0 * float(np.sum(value * weight * outer.weight[rows, None]))
    return length**n * total


def lobe_part(model: str, p: Parameters, mu: float, phi: float, order: str, rule: Rule) -> float:
    """The cosine lobes of neumann1999."""
    s = math.sqrt((1.0 - mu) * (1.0 + mu))
    if model in ("lafortune", "stretched_lafortune"):
        total = 0.0
        for (c_x, c_y, c_z), n, c, power in lobes.lobe_parameters(p, model == "stretched_lafortune"):
            axis = (-c_x * s * math.cos(phi), -c_y * s * math.sin(phi), c_z * mu)
            total += c * lobe_integral(axis, n, power, mu, rule)
        return total
    if model not in ("metal", "plastic"):
        return 0.0
    formula = lobes.metal_factor if model == "metal" else lobes.plastic_factor

    def factor(z: Array, short: Array) -> Array:
        light, view = sides(order, z, mu)
        unused = np.zeros(1)
        return formula(Pair(light, view, unused, unused, np.sqrt(z * mu + 0.5 * short), unused), p)

    return lobe_integral((-s, 0.0, mu), p["n"], 0.0, mu, rule, factor)


def depth_for(mu: float) -> int:
    """Levels of grading: 4^-depth well below the smallest scale, mu for grazing directions."""
    return 9 if mu > 0.03 else 9 + math.ceil(0.6 * math.log(0.1 / mu, 4.0)) if mu > 0.0 else 16


def depth_of(part: Part, mu: float) -> int:
    """The costly He-Torrance series is smooth: a shallower mesh will do, but for the layer cos(theta) = mu of K_i + K_r."""
    return depth_for(mu) if part.depth == 0 else part.depth if mu > 0.03 else part.depth + 4


def albedo(model: str, p: Parameters, mu: float, phi: float = 0.0, order: str = "wi", effort: int = 2) -> tuple[float, float]:
    """(albedo of the shape, error); the fixed direction has cosine mu and azimuth phi.

    effort 2 is what is stored; 1 is two to three times cheaper, for tests.
    """
    values = []
    for fine in (True, False):
        total = constant_of(model, p, mu)
        for part in parts_of(model, p):
            depth = depth_of(part, mu) - (2 if effort == 1 else 0)
            nodes = part.nodes if effort == 2 else part.nodes - 4
            key = (nodes, depth, 0.25) if fine else (nodes - 4, depth + 1, 0.3)
            total += integrate_part(part, p, mu, phi, order, key)
        nodes = 18 if effort == 2 else 14
        key = (nodes, depth_for(mu) + 1, 0.25) if fine else (nodes - 4, depth_for(mu) + 3, 0.3)
        total += lobe_part(model, p, mu, phi, order, graded_rule(*key))
        values.append(total)
    read = compensated.ERROR if model == "ggx_multiscatter" else 0.0
    return values[0], abs(values[0] - values[1]) + 1e-12 * abs(values[0]) + read


def second_opinion(model: str, p: Parameters, mu: float, phi: float = 0.0, order: str = "wi") -> float:
    """The same albedo with every two-dimensional part in the other coordinate system."""
    total = constant_of(model, p, mu) + lobe_part(model, p, mu, phi, order, graded_rule(12, depth_for(mu), 0.25))
    for part in parts_of(model, p):
        other = "plain" if part.where == "half" else "half"
        depth = depth_for(mu) if other == "half" else depth_of(part, mu)
        total += integrate_part(part, p, mu, phi, order, (12, depth, 0.25), where=other)
    return total


def evaluate(model: str, p: Parameters, wi: Array, wo: Array) -> Array:
    """f_r from vectors (last axis x, y, z), without the Dirac part; literal angles, for Monte Carlo.

    Of ashikhmin_shirley the specular part; of kelemen what its parts make of it, see `constant_of`.
    """
    if model in ("lafortune", "stretched_lafortune"):
        return lobes.lafortune(wi, wo, p, model == "stretched_lafortune")
    pair = pair_of_vectors(wi, wo)
    value = np.zeros_like(pair.t)
    for part in parts_of(model, p):
        value = value + part.f(pair, p)
    if model in ("metal", "plastic"):
        factor = lobes.metal_factor if model == "metal" else lobes.plastic_factor
        value = factor(pair, p) * np.maximum(pair.mirror, 0.0) ** p["n"]
    if model in ("plastic", "he_torrance"):
        value = value + p["a_d"] / PI
    return value
