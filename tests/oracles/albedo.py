"""Directional albedo of the Neumann-Neumann-Szirmay-Kalos models by two independent plain quadratures.

What is computed: a = integral over the hemisphere of f cos, f the SHAPE of the model (no constant c_n, C_n, C_max), the
cosine and the integration belonging to the moving direction.  The fixed direction has cosine `mu` (and azimuth `phi`,
which matters for the anisotropic Ward models only).

How: every albedo is computed twice, in two coordinate systems which share only the formula of the shape.

* `albedo_plain`: spherical angles of the moving direction: elevation e above the surface (cosine = sin e) and azimuth.
* `albedo_lobe`: spherical angles about the axis of the lobe.  For (R.V)^n: the angle alpha from the mirror image of the
  fixed direction.  For N.H models: the angle delta of the half vector from the normal, d omega_L = 4 (V.H) d omega_H.

Both use Gauss-Legendre panels graded to every kink, horizon and peak.  The reported error is the sum of the difference
between the two systems, the difference between two orders of one of them, and a rounding floor.  mu = 0 gives the limit
mu -> 0+ (dominated convergence: put mu = 0 in the integrand), inf where the albedo is unbounded.

Half angles instead of dot products.  With elevations e_L, e_V, s = cos e, and phi the azimuth from the mirror plane,

    1 - R.V  = 2 sin^2((e_L - e_V)/2) + 2 s_L s_V sin^2(phi/2)
    tan^2(delta) = tan^2((e_L - e_V)/2) + 4 s_L s_V sin^2(phi/2) / (c_L + c_V)^2

are sums of positive terms and lose nothing for n = 1e8 or m = 1e-4.  The first is R.V = c_L c_V + s_L s_V cos(phi), the
second is |(L + V)_xy|^2 / (c_L + c_V)^2 with |(L + V)_xy|^2 = (s_L - s_V)^2 + 4 s_L s_V sin^2(phi/2).
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable

import numpy as np

from tests.oracles.quadrature import Array, Nodes, Rule, chain, graded_rule

PHONG_MODELS = (
    "phong",
    "stretched_phong",
    "plus_phong",
    "product_phong",
    "sqrt_phong",
    "p_phong",
    "retro_phong",
    "phong_original",
)
HALF_VECTOR_MODELS = ("blinn", "stretched_blinn", "plus_blinn", "ward", "modified_ward", "schlick_isotropic")
MODELS = ("lambert", *PHONG_MODELS, *HALF_VECTOR_MODELS)
HALF_PI = 0.5 * math.pi
ROUNDING = 1e-13
"""Relative rounding floor of every reported error: |n log cos| <= 40 times a few ulp, plus summation."""


def unbounded_at_grazing(model: str, order: str = "wi") -> bool:
    """True where the albedo tends to infinity as mu -> 0 (f cos -> infinity on a set of positive measure)."""
    return model in ("product_phong", "sqrt_phong", "ward") or (model == "phong_original" and order == "wo")


def correction(model: str, c_light: Array | float, c_view: Array | float, p: float = 1.0) -> Array | float:
    """The factor of the shape that depends on the two cosines only (Schlick's is in `schlick_shape`)."""
    if model in ("phong", "blinn"):
        return 1.0
    if model in ("stretched_phong", "retro_phong", "stretched_blinn", "modified_ward"):
        return 1.0 / np.maximum(c_light, c_view)
    if model in ("plus_phong", "plus_blinn"):
        return 2.0 / (c_light + c_view)
    if model == "product_phong":
        return 1.0 / (c_light * c_view)
    if model in ("sqrt_phong", "ward"):
        return 1.0 / (np.sqrt(c_light) * np.sqrt(c_view))
    if model == "p_phong":
        return np.maximum(c_light, c_view) ** -p
    if model == "phong_original":
        return 1.0 / c_light
    raise ValueError(f"unknown model {model!r}")


def cosines(order: str, moving: Array, mu: float) -> tuple[Array | float, Array | float]:
    """(light cosine, view cosine) when the moving direction is the light ("wi") or the viewer ("wo")."""
    if order == "wi":
        return moving, mu
    if order == "wo":
        return mu, moving
    raise ValueError(f"order must be 'wi' or 'wo', not {order!r}")


def phong_power(one_minus_cos: Array, n: float) -> Array:
    """[(cos)^+]^n from 1 - cos; n = 0 is the indicator cos > 0."""
    cosine_positive = one_minus_cos < 1.0
    if n == 0.0:
        return cosine_positive.astype(float)
    return np.where(cosine_positive, np.exp(n * np.log1p(-np.minimum(one_minus_cos, 1.0 - 1e-16))), 0.0)


def half_vector_shape(
    model: str, slope2: Array, weighted2: Array | None, c_light: Array | float, c_view: Array | float, **par: float
) -> Array:
    """Shape f of an N.H model.

    slope2 = tan^2(delta); weighted2 = tan^2(delta) (cos^2(phi_h)/m_x^2 + sin^2(phi_h)/m_y^2), Ward only.
    """
    if model in ("blinn", "stretched_blinn", "plus_blinn"):
        return np.exp(-0.5 * par["n"] * np.log1p(slope2)) * correction(model, c_light, c_view)
    if model in ("ward", "modified_ward"):
        front = 1.0 / (4.0 * math.pi * par["m_x"] * par["m_y"])
        return front * np.exp(-weighted2) * correction(model, c_light, c_view)
    r = par["r"]
    # 1 - (1 - r)(N.H)^2 with (N.H)^2 = 1/(1 + slope2) is (slope2 + r)/(1 + slope2)
    zonal = r * ((1.0 + slope2) / (slope2 + r)) ** 2
    return zonal / (4.0 * math.pi) / ((r + (1.0 - r) * c_light) * (r + (1.0 - r) * c_view))


def _row_blocks(outer: Nodes, inner_size: int) -> list[slice]:
    """Slices of the outer nodes, so that one block of the tensor grid (60 000 points) stays in the cache."""
    step = max(1, 60_000 // inner_size)
    return [slice(i, i + step) for i in range(0, outer.value.size, step)]


def albedo_plain(model: str, mu: float, phi: float, order: str, rule: Rule, par: dict[str, float]) -> float:
    """Albedo in the spherical angles of the moving direction."""
    s_v = math.sqrt((1.0 - mu) * (1.0 + mu))
    e_v = math.atan2(mu, s_v)
    theta_v = math.atan2(s_v, mu)
    # theta_v = pi/2 - e_v: there the region R.V > 0 begins to cover all azimuths
    breaks = [0.0, e_v, theta_v, HALF_PI]
    anisotropic = model in ("ward", "modified_ward") and par["m_x"] != par["m_y"]
    if anisotropic:  # where L + V ceases to be able to have no x or no y component
        breaks += [math.acos(s_v * abs(math.cos(phi))), math.acos(s_v * abs(math.sin(phi)))]
    outer = chain(breaks, rule)
    z_all, sine_all = np.sin(outer.offset(0.0)), np.sin(-outer.offset(HALF_PI))
    delta_all = outer.offset(e_v)
    total = 0.0
    for block in _row_blocks(outer, 2 * rule.left.size):
        z, s_l, half = z_all[block, None], sine_all[block, None], 0.5 * delta_all[block, None]
        c_light, c_view = cosines(order, z, mu)
        if model == "lambert":
            inner = np.full(z.size, 2.0 * par["albedo"])  # albedo/pi integrated over the azimuth
        elif model in PHONG_MODELS:
            # R.V > 0 (L.V > 0 for the retro model, phi then being measured from V): cos(phi) > -c_L c_V / (s_L s_V)
            limit = np.arccos(np.clip(-(z * mu) / np.maximum(s_l * s_v, 1e-300), -1.0, 1.0))
            azimuth = rule.left[None, :] * limit
            power = phong_power(2.0 * np.sin(half) ** 2 + 2.0 * s_l * s_v * np.sin(0.5 * azimuth) ** 2, par["n"])
            inner = 2.0 * np.sum(power * rule.weight, axis=1) * limit[:, 0]
            inner = inner * np.ravel(correction(model, c_light, c_view, par.get("p", 1.0)) * np.ones_like(z))
        elif not anisotropic:
            azimuth = rule.left[None, :] * math.pi
            slope2 = np.tan(half) ** 2 + 4.0 * s_l * s_v * (np.sin(0.5 * azimuth) / (z + mu)) ** 2
            weighted2 = slope2 / par["m_x"] ** 2 if "m_x" in par else None
            shape = half_vector_shape(model, slope2, weighted2, c_light, c_view, **par)
            inner = 2.0 * math.pi * np.sum(shape * rule.weight, axis=1)
        else:
            inner = _anisotropic_azimuth_integral(model, mu, s_v, phi, z, s_l, half, order, rule, par)
        total += float(np.sum(outer.weight[block] * sine_all[block] * z[:, 0] * inner))
    return total


def _anisotropic_azimuth_integral(
    model: str,
    mu: float,
    s_v: float,
    phi: float,
    z: Array,
    s_l: Array,
    half: Array,
    order: str,
    rule: Rule,
    par: dict[str, float],
) -> Array:
    """Inner integral of the anisotropic Ward shapes over the azimuth t of L measured from the mirror plane.

    (L + V)_xy has the radial component u = s_V - s_L cos t and the tangential one v = -s_L sin t in the frame of V.
    """
    c0, s0 = math.cos(phi), math.sin(phi)
    wx, wy = 1.0 / par["m_x"] ** 2, 1.0 / par["m_y"] ** 2
    # s_V - s_L = cos e_V - cos e_L = 2 sin((e_L + e_V)/2) sin((e_L - e_V)/2) = (c_L + c_V) tan((e_L - e_V)/2)
    difference = (z + mu) * np.tan(half)

    def components(t: Array) -> tuple[Array, Array]:
        return difference + 2.0 * s_l * np.sin(0.5 * t) ** 2, -s_l * np.sin(t)

    def exponent(t: Array) -> Array:
        u, v = components(t)
        return (wx * (u * c0 - v * s0) ** 2 + wy * (u * s0 + v * c0) ** 2) / (z + mu) ** 2

    def slope(t: Array) -> Array:
        u, v = components(t)
        du, dv = s_l * np.sin(t), -s_l * np.cos(t)
        return wx * (u * c0 - v * s0) * (du * c0 - dv * s0) + wy * (u * s0 + v * c0) * (du * s0 + dv * c0)

    # Break points: the mirror plane; the azimuth of the smallest exponent (bisection on its derivative between -pi/2
    # and pi/2); the azimuths where L + V has no x or no y component (or comes nearest to that), ridges of the exponent
    # when m_x and m_y differ much.  A poor choice costs accuracy, which the comparison with albedo_lobe reveals, never
    # correctness.
    low, high = np.full_like(z, -HALF_PI), np.full_like(z, HALF_PI)
    for _ in range(60):
        middle = 0.5 * (low + high)
        rising = slope(middle) > 0.0
        low, high = np.where(rising, low, middle), np.where(rising, middle, high)
    points = [0.5 * (low + high), np.full_like(z, -math.pi), np.zeros_like(z), np.full_like(z, math.pi)]
    no_x = np.arccos(np.clip(s_v * c0 / s_l, -1.0, 1.0))  # s_V cos(phi) = s_L cos(phi + t)
    no_y = np.arcsin(np.clip(s_v * s0 / s_l, -1.0, 1.0))  # s_V sin(phi) = s_L sin(phi + t)
    ridges = (no_x, -no_x, no_y, math.pi - no_y)
    points += [np.remainder(azimuth - phi + math.pi, 2.0 * math.pi) - math.pi for azimuth in ridges]
    breaks = np.sort(np.hstack(points), axis=1)
    c_light, c_view = cosines(order, z, mu)
    total = np.zeros(z.size)
    for start, stop in itertools.pairwise(breaks.T[:, :, None]):
        from_start = rule.left[None, :] * (stop - start)
        from_stop = rule.right[None, :] * (stop - start)
        t = np.where(from_start <= from_stop, start + from_start, stop - from_stop)
        shape = half_vector_shape(model, np.zeros(1), exponent(t), c_light, c_view, **par)
        total += np.sum(shape * rule.weight, axis=1) * (stop - start)[:, 0]
    return total


def _segments(ends: list[Array], rule: Rule, integrand: Callable[[Array, Array, Array], Array]) -> Array:
    """Row-wise integral over the consecutive segments ends[0] <= ends[1] <= ...

    integrand(x, distance from ends[0], distance to ends[-1]); the distances are exact near their ends.
    """
    total = np.zeros(ends[0].shape[0])
    for start, stop in itertools.pairwise(ends):
        length = stop - start
        if not np.any(length > 0.0):
            continue
        from_start, from_stop = rule.left[None, :] * length, rule.right[None, :] * length
        x = np.where(rule.left <= rule.right, start + from_start, stop - from_stop)
        values = integrand(x, (start - ends[0]) + from_start, (ends[-1] - stop) + from_stop)
        total += np.sum(values * rule.weight, axis=1) * length[:, 0]
    return total


def albedo_lobe(model: str, mu: float, phi: float, order: str, rule: Rule, par: dict[str, float]) -> float:
    """Albedo in spherical angles about the axis of the lobe."""
    s_v = math.sqrt((1.0 - mu) * (1.0 + mu))
    if model == "lambert":
        x = rule.left
        return float(2.0 * par["albedo"] * np.sum(rule.weight * x))  # albedo/pi * 2 pi * integral of c dc
    if model in PHONG_MODELS:
        return _albedo_about_mirror(model, mu, s_v, order, rule, par)
    return _albedo_about_normal(model, mu, s_v, phi, order, rule, par)


def _albedo_about_mirror(model: str, mu: float, s_v: float, order: str, rule: Rule, par: dict[str, float]) -> float:
    """(R.V)^n models; alpha = angle of the moving direction from the mirror image of the fixed one, psi about it.

    Moving cosine z = mu cos(alpha) + s_v cos(psi) sin(alpha) = S sin(eta - alpha), S = hypot(mu, s_v cos psi),
    eta = atan2(mu, -s_v cos psi): the horizon is alpha = eta.  The kink z = mu is alpha = 2 eta - pi.  The retro model
    is the same with "the fixed direction itself" in place of "its mirror image".
    """
    breaks = [0.0, HALF_PI, math.pi] if mu > 0.0 else [0.0, HALF_PI]  # mu = 0: nothing of the rest is above the surface
    if s_v > mu:
        breaks.append(math.acos(mu / s_v))  # here the kink leaves alpha <= pi/2
    outer = chain(breaks, rule)
    cosine_all = -np.sin(outer.offset(HALF_PI))
    n, p = par["n"], par.get("p", 1.0)
    total = 0.0
    for block in _row_blocks(outer, 2 * rule.left.size):
        side = s_v * cosine_all[block, None]
        amplitude = np.hypot(mu, side)
        eta = np.arctan2(mu, -side)
        kappa = np.arctan2(side, mu)  # eta - pi/2
        end = np.minimum(eta, HALF_PI)
        kink = np.clip(2.0 * kappa, 0.0, end)

        def integrand(
            alpha: Array,
            from_axis: Array,
            to_end: Array,
            amplitude: Array = amplitude,
            eta: Array = eta,
            kappa: Array = kappa,
            end: Array = end,
        ) -> Array:
            z = amplitude * np.where(kappa < 0.0, np.sin(to_end), np.sin((eta - end) + to_end))
            if n == 0.0:
                power = np.ones_like(alpha)
            else:
                near_axis = n * np.log1p(-2.0 * np.sin(0.5 * from_axis) ** 2)
                near_end = n * np.log(np.maximum(np.sin((HALF_PI - end) + to_end), 1e-300))
                power = np.exp(np.where(alpha < 0.5, near_axis, near_end))
            c_light, c_view = cosines(order, z, mu)
            return power * z * correction(model, c_light, c_view, p) * np.sin(alpha)

        inner = _segments([np.zeros_like(end), kink, end], rule, integrand)
        total += 2.0 * float(np.sum(outer.weight[block] * inner))
    return total


def _albedo_about_normal(model: str, mu: float, s_v: float, phi: float, order: str, rule: Rule, par: dict[str, float]) -> float:
    """N.H models; delta = angle of the half vector from the normal, beta = its azimuth from the fixed direction.

    F.H = mu cos(delta) + s_v cos(beta) sin(delta) = S sin(eta - delta), F the fixed direction, S and eta as above with
    beta for psi.  Moving cosine z = 2 (F.H) cos(delta) - mu = S sin(eta - 2 delta): the horizon is delta = eta/2, the
    kink z = mu is delta = eta - pi/2.  d omega_moving = 4 (F.H) sin(delta) d delta d beta.
    """
    anisotropic = model in ("ward", "modified_ward") and par["m_x"] != par["m_y"]
    if anisotropic:
        reduced = math.remainder(phi, HALF_PI)
        wanted = [k * HALF_PI for k in range(-2, 3)] + [k * HALF_PI - reduced for k in range(-3, 4)]
        breaks = [b for b in wanted if -math.pi <= b <= math.pi]
    else:
        breaks = [0.0, HALF_PI, math.pi]
    if mu == 0.0:
        breaks = [b for b in breaks if abs(b) <= HALF_PI]
    outer = chain(breaks, rule)
    symmetry = 1.0 if anisotropic else 2.0
    # cos(beta) = sin(pi/2 - |beta|), exact near |beta| = pi/2
    offsets = np.where(outer.value >= 0.0, -outer.offset(HALF_PI), outer.offset(-HALF_PI))
    cosine_all = np.sin(offsets)
    total = 0.0
    for block in _row_blocks(outer, 2 * rule.left.size):
        side = s_v * cosine_all[block, None]
        amplitude = np.hypot(mu, side)
        eta = np.arctan2(mu, -side)
        horizon = 0.5 * eta
        kink = np.clip(np.arctan2(side, mu), 0.0, horizon)
        if model in ("ward", "modified_ward"):
            azimuth = phi + outer.value[block, None]
            stretch = (np.cos(azimuth) / par["m_x"]) ** 2 + (np.sin(azimuth) / par["m_y"]) ** 2
        else:
            stretch = None

        def integrand(
            delta: Array,
            from_axis: Array,
            to_horizon: Array,
            amplitude: Array = amplitude,
            horizon: Array = horizon,
            stretch: Array | None = stretch,
        ) -> Array:
            z = amplitude * np.sin(2.0 * to_horizon)
            fixed_dot_half = amplitude * np.sin(horizon + to_horizon)
            slope2 = np.tan(from_axis) ** 2
            weighted2 = None if stretch is None else slope2 * stretch
            c_light, c_view = cosines(order, z, mu)
            shape = half_vector_shape(model, slope2, weighted2, c_light, c_view, **par)
            return shape * z * 4.0 * fixed_dot_half * np.sin(delta)

        inner = _segments([np.zeros_like(horizon), kink, horizon], rule, integrand)
        total += symmetry * float(np.sum(outer.weight[block] * inner))
    return total


def check_parameters(model: str, parameters: dict[str, float]) -> dict[str, float]:
    """The parameters as floats; the isotropic Ward spelling m = m_x = m_y is accepted."""
    if model not in MODELS:
        raise ValueError(f"unknown model {model!r}")
    par = {name: float(value) for name, value in parameters.items()}
    if model in ("ward", "modified_ward") and "m" in par:
        par["m_x"] = par["m_y"] = par.pop("m")
    wanted = {
        "lambert": {"albedo"},
        "p_phong": {"n", "p"},
        "ward": {"m_x", "m_y"},
        "modified_ward": {"m_x", "m_y"},
        "schlick_isotropic": {"r"},
    }.get(model, {"n"})
    if set(par) != wanted:
        raise ValueError(f"{model} takes {sorted(wanted)}, not {sorted(par)}")
    return par


def albedo(
    model: str,
    mu: float,
    phi: float = 0.0,
    order: str = "wi",
    effort: int = 2,
    **parameters: float,
) -> tuple[float, float]:
    """(albedo of the shape, error bound) for the fixed direction of cosine mu and azimuth phi.

    order "wi": the viewer is fixed, the light moves (hemisphere of L, cosine c_L); "wo": the other way round.
    effort 2 is the reference (graded down to 4^-27 of every interval); 1 is about five times cheaper, for tests with wide
    lobes (its error bound is as honest, but larger).
    """
    par = check_parameters(model, parameters)
    if not 0.0 <= mu <= 1.0:
        raise ValueError(f"mu must lie in [0, 1], not {mu}")
    if mu == 0.0 and unbounded_at_grazing(model, order):
        return math.inf, 0.0
    depth = {1: 15, 2: 27}[effort]
    nodes = {1: 18, 2: 24}[effort]
    fine = albedo_lobe(model, mu, phi, order, graded_rule(nodes, depth), par)
    coarse = albedo_lobe(model, mu, phi, order, graded_rule(nodes - 6, depth), par)
    plain = albedo_plain(model, mu, phi, order, graded_rule(nodes, depth), par)
    if not all(map(math.isfinite, (fine, coarse, plain))):
        raise ArithmeticError(f"{model} {par} mu={mu}: {fine}, {coarse}, {plain}")
    error = abs(fine - plain) + abs(fine - coarse) + ROUNDING * abs(fine)
    return fine, error
