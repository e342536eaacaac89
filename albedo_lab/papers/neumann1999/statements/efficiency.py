"""Statements of sections 4.1 to 4.3 on how well samples suit the integrand, and on the albedo at grazing angles."""

from __future__ import annotations

import math

import numpy as np

from albedo_lab.papers.neumann1999.equations import (
    hemisphere,
    lobe,
    phong,
    stretched,
)
from albedo_lab.papers.neumann1999.statements.sampling import drawn, n, viewer
from albedo_lab.papers.neumann1999.statements.stretched import c_n
from albedo_lab.papers.neumann1999.tried import CODE, MANY, PRINTED, SAME, cosine, in_section, sampled, variance
from albedo_lab.papers.recipes import Means
from albedo_lab.papers.record import Statement, Trial
from albedo_lab.papers.trials import CLOSED, Found, apart, measured, trial, undecided
from albedo_lab.pictures.evaluation import in_plane

VIEWERS = (0.0, 30.0, 60.0, 80.0, 89.0, 89.99)


def average_cosine(means: Means) -> Found:
    """The mean of cos Theta over the hemisphere, and over the samples of a grazing viewer."""
    z = hemisphere(means.seed, 1_000_000)[:, 2]
    ours = f"{np.mean(z):.4f} over directions of the hemisphere"
    means_at = ", ".join(f"{np.mean(np.maximum(lobe(n, angle)[0], 0.0)):.4f}" for angle in (0.0, 60.0, 89.0))
    again = f"1/2 ({CLOSED}); over the samples of eq. 20 {means_at} for viewers at 0°, 60°, 89°"
    return Found(abs(float(np.mean(z)) - 0.5) < 2e-3, ours, "1000000 directions", again)


def arbitrarily_small(means: Means) -> Found:
    """The cosine of the light at grazing angles."""
    shares = [float(np.quantile(np.maximum(lobe(n, angle)[0], 0.0), 0.6)) for angle in (80.0, 89.0, 89.99)]
    again = ", ".join(f"{variance('phong', angle, means, n=n):.3f}" for angle in (80.0, 89.0, 89.99))
    ours = "6 of 10 samples have cos Θ_L below " + ", ".join(f"{s:.3f}" for s in shares) + " for viewers at 80°, 89°, 89.99°"
    return Found(
        shares[-1] < 0.1, ours, "midpoints of eq. 20", f"variance of the weight, of its square mean: {again} (Monte Carlo)"
    )


def cases_of_25(means: Means) -> Found:
    """The integrand in two cases."""
    L, V = hemisphere(means.seed, MANY), hemisphere(means.seed + 1, MANY)
    whole = stretched(n)(L, V) * L[:, 2]
    cases = phong(n)(L, V) * np.where(L[:, 2] >= V[:, 2], 1.0, L[:, 2] / V[:, 2])
    code = in_section("stretched_phong", 40.0, [30.0, 50.0], n=n) * cosine(40.0) / c_n(n)
    expected = math.cos(math.radians(10.0)) ** n * np.array([cosine(40.0) / cosine(30.0), 1.0])
    told = f"{code[0]:.6f}, {code[1]:.6f} against {expected[0]:.6f}, {expected[1]:.6f}"
    worst = apart(whole, cases)
    return Found(
        worst < SAME, f"largest relative difference {worst:.1g}", PRINTED, f"light at 40°, viewers at 30°, 50°: {told} ({CODE})"
    )


def in_the_first_sum(means: Means) -> Found:
    """Which samples count in the first sum of eq. 25 as the viewer goes to the horizon."""
    shares = []
    for angle in VIEWERS:
        z = lobe(n, angle)[0]
        shares.append(float(np.mean(z >= cosine(angle)) / np.mean(z >= 0.0)))
    R, *_ = drawn(viewer(89.99), means.seed, 200_000)
    z = R[:, 2]
    again = f"{np.mean(z >= cosine(89.99)) / np.mean(z >= 0.0):.4f} at 89.99° (200000 samples)"
    ours = ", ".join(f"{s:.3f}" for s in shares) + " of the samples above the horizon, viewers at 0°, 30°, 60°, 80°, 89°, 89.99°"
    return Found(shares[-1] > 0.99, ours, "midpoints of eq. 20", again)


def efficiency(theta_deg: float, accepted: bool = False, model: str = "stretched_phong", exponent: float = n) -> float:
    """(mean weight)² / mean squared weight: 1 where every sample counts the same; of the accepted samples only, if asked."""
    z, _ = lobe(exponent, theta_deg)
    up, mu = z > 0.0, cosine(theta_deg)
    w = np.where(up, z / np.maximum(z, mu) if model == "stretched_phong" else z, 0.0)
    w = w[up] if accepted else w
    return float(np.mean(w) ** 2 / np.mean(w * w))


def grows_with_the_angle(means: Means) -> Found:
    """Efficiency of eq. 25 against the viewer's angle, with the rejected samples and without."""
    every = [efficiency(angle) for angle in VIEWERS]
    accepted = [efficiency(angle, accepted=True) for angle in VIEWERS]
    code = ", ".join(f"{1.0 / (1.0 + variance('stretched_phong', angle, means, n=n)):.3f}" for angle in VIEWERS)
    ours = "(mean)²/(mean square) of the weights: " + ", ".join(f"{e:.3f}" for e in every) + " at 0°, 30°, 60°, 80°, 89°, 89.99°"
    again = f"{code} (Monte Carlo); of accepted samples only: " + ", ".join(f"{e:.3f}" for e in accepted)
    return Found(every[-1] >= every[0] and every[-1] >= every[2], ours, "midpoints of eq. 20", again)


def worst_at_normal(means: Means) -> Found:
    """Whether normal incidence is the worst case."""
    every = {angle: efficiency(angle) for angle in VIEWERS}
    worst = min(every, key=every.__getitem__)
    closed = (n + 1.0) * (n + 3.0) / (n + 2.0) ** 2
    ours = f"{every[0.0]:.5f} at 0°, least {every[worst]:.3f} at {worst:g}°"
    again = f"(n+1)(n+3)/(n+2)² = {closed:.5f} at 0°, 1/2 as Θ_V → 90° ({CLOSED})"
    return Found(worst == 0.0, ours, "midpoints of eq. 20", again)


def as_phong_at_normal(means: Means) -> Found:
    """At normal incidence both weights are the same."""
    a, b = efficiency(0.0), efficiency(0.0, model="phong")
    code = [1.0 / (1.0 + variance(model, 0.0, means, n=n)) for model in ("stretched_phong", "phong")]
    best = max((efficiency(angle, model="phong"), -angle) for angle in VIEWERS)
    condition = abs(a - b) < 1e-12 and best[1] == 0.0
    ours = f"{a:.5f} (stretched), {b:.5f} (Phong) at 0°; Phong's best of all angles is at {-best[1]:g}°"
    return Found(condition, ours, "midpoints of eq. 20", f"{code[0]:.5f}, {code[1]:.5f} (Monte Carlo)")


def better_than_phong(means: Means) -> Found:
    """Efficiency of both models at every angle."""
    pairs = [(efficiency(angle), efficiency(angle, model="phong")) for angle in VIEWERS]
    code = [1.0 / (1.0 + variance(model, 89.0, means, n=n)) for model in ("stretched_phong", "phong")]
    ours = "; ".join(f"{a:.3f} against {b:.3f}" for a, b in pairs) + " at 0°, 30°, 60°, 80°, 89°, 89.99°"
    again = f"{code[0]:.3f} against {code[1]:.3f} at 89° (Monte Carlo); 1/2 against 1/π = 0.318 as Θ_V → 90°, n → ∞ ({CLOSED})"
    return Found(all(a >= b - 1e-9 for a, b in pairs), ours, "midpoints of eq. 20", again)


def half_rejected(means: Means) -> Found:
    """The share of rejected samples as the viewer goes to the horizon."""
    shares = [float(np.mean(lobe(n, angle)[0] < 0.0)) for angle in (80.0, 89.0, 89.99)]
    R, *_ = drawn(viewer(89.999999), means.seed, 200_000)
    ours = ", ".join(f"{s:.4f}" for s in shares) + " at 80°, 89°, 89.99°"
    return Found(
        abs(shares[-1] - 0.5) < 2e-3, ours, "midpoints of eq. 20", f"{np.mean(R[:, 2] < 0.0):.4f} at 90° - 1e-6° (200000 samples)"
    )


def weight_at_ninety(means: Means) -> Found:
    """Weights of accepted samples at 90 degrees."""
    z = lobe(n, 90.0 - 1e-6)[0]
    w = (n + 2.0) / (n + 1.0) * z[z > 0.0] / np.maximum(z[z > 0.0], cosine(90.0 - 1e-6))
    ours = f"between {np.quantile(w, 1e-3):.9f} and {w.max():.9f}; (n+2)/(n+1) = {(n + 2) / (n + 1):.9f}"
    again = (
        f"albedo {sampled('stretched_phong', 90.0 - 1e-6, means, n=n)} (rqmc), half of the weight {(n + 2) / (2 * (n + 1)):.6f}"
    )
    return Found(abs(float(np.quantile(w, 1e-3)) - (n + 2.0) / (n + 1.0)) < 1e-9, ours, "midpoints of eq. 20", again)


def symmetric_about_mirror(model: str) -> Trial:
    """Whether viewers at the same distance from R see the same."""

    def find(means: Means) -> Found:
        f = in_section(model, 60.0, [50.0, 70.0], n=n)
        shape = {"phong": phong(n), "stretched_phong": stretched(n)}[model]
        L = in_plane(np.full(2, -60.0))
        g = shape(L, in_plane(np.array([50.0, 70.0])))
        ours = f"f(R - 10°)/f(R + 10°) = {f[0] / f[1]:.4f} for light from 60°, n = 100"
        return Found(
            abs(float(f[0] / f[1]) - 1.0) < SAME,
            ours,
            CODE,
            f"{g[0] / g[1]:.4f} ({PRINTED}); cos 60°/cos 50° = {cosine(60.0) / cosine(50.0):.4f}",
        )

    return measured(
        find,
        "the density of eq. 19, of which the sentence makes use, is symmetric about R, and eq. 26 is right; the BRDF itself, "
        "with its 1/cos Θ_min, is not",
    )


STATEMENTS = (
    Statement(
        "ignored_cosine_small",
        "§4.1, after eq. 24",
        "the ignored cos Θ_L can be arbitrarily small at grazing angles",
        "For a viewer at 89.99° most samples have a cosine below 0.1.",
        trial(arbitrarily_small),
        ("phong",),
    ),
    Statement(
        "ignored_cosine_average",
        "§4.1, after eq. 24",
        "and its average is only 1/2",
        "The mean of cos Θ over the hemisphere is 1/2.",
        trial(average_cosine),
        ("phong",),
    ),
    Statement(
        "better_density_complicated",
        "§4.1, after eq. 24",
        "It would be better to find a density that is proportional to cosⁿα · cos Θ_L, but it would be quite "
        "complicated to implement",
        "No simple sampler of cosⁿα cos Θ_L exists.",
        undecided("what is complicated is not said"),
    ),
    Statement(
        "cases_of_the_integrand",
        "§4.2, before eq. 25",
        "I(L, V) = L^in c_n cosⁿα if Θ_L ≤ Θ_V, … · cos Θ_L / cos Θ_V if Θ_L > Θ_V",
        "Both cases are f_r cos Θ_L of eq. 7.",
        trial(cases_of_25),
        ("stretched_phong",),
    ),
    Statement(
        "samples_in_first_sum",
        "§4.2",
        "For large viewing angles the samples will be in the first sum of equation 25.",
        "Their share, of those above the horizon, tends to 1.",
        trial(in_the_first_sum),
        ("stretched_phong",),
    ),
    Statement(
        "better_than_phong",
        "§4.2",
        "The efficiency of the importance sampling gets higher for the new model, and it will be particularly good at "
        "grazing angles.",
        "At every angle the weights vary no more than Phong's.",
        trial(better_than_phong),
        ("stretched_phong", "phong"),
    ),
    Statement(
        "efficiency_grows",
        "§4.2",
        "The larger the viewing angle, the greater the efficiency (even if the probability of the rejected samples "
        "approaches 0.5).",
        "(mean weight)²/(mean squared weight), rejected samples counted as 0, is not lower at 89.99° than at 0° and "
        "60°; n = 100.",
        trial(
            grows_with_the_angle,
            "a rejected sample is a sample of weight 0: they cost the grazing viewer half the efficiency; even among "
            "accepted ones it falls first and then grows again",
        ),
        ("stretched_phong",),
    ),
    Statement(
        "worst_at_zero",
        "§4.2",
        "The worst case of the importance sampling of the new model is at zero degree viewing angle",
        "The efficiency is least at normal incidence, rejected samples counted.",
        trial(worst_at_normal, "it is nearly 1 there, and least at grazing angles, where half of the samples are lost"),
        ("stretched_phong",),
    ),
    Statement(
        "as_phong_at_zero",
        "§4.2",
        "where the efficiency degrades to that of the sampling of the Phong model, which is fortunately the best here",
        "At normal incidence both are the same, and Phong's is best there.",
        trial(as_phong_at_normal),
        ("stretched_phong", "phong"),
    ),
    Statement(
        "half_rejected",
        "§4.3",
        "half of the samples point into the object, and are thus rejected",
        "The rejected share tends to 1/2 at 90°.",
        trial(half_rejected),
        ("stretched_phong",),
    ),
    Statement(
        "weight_at_ninety",
        "§4.3",
        "At 90 degree viewing direction, the weight of sample rays is (n+2)/(n+1).",
        "All but a thousandth of the accepted samples have that weight.",
        trial(weight_at_ninety),
        ("stretched_phong",),
    ),
    Statement(
        "brdf_symmetric_about_mirror",
        "§4.3",
        "Since the BRDF is symmetric around R",
        "Viewers 10° from R on both sides see the same; light from 60°.",
        symmetric_about_mirror("stretched_phong"),
        ("stretched_phong",),
    ),
)
