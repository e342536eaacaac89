"""Statements on what Z, A, G and S stand for: Beckmann, Ward's ellipse, Smith and Fresnel, with the parameter that fits best.

"Close" has no number in the document; it is taken as 5 % of the light everywhere (see `CLOSE`). The best parameter is the one
whose largest error is smallest.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from math import pi

import numpy as np
from scipy.optimize import minimize_scalar

from albedo_lab.optics import fresnel
from albedo_lab.optics.metals import PAPER_WAVELENGTHS, index
from albedo_lab.papers.recipes import Means
from albedo_lab.papers.record import Statement
from albedo_lab.papers.schlick1993.formulas import A, Array, G, S, exact_fresnel, smith
from albedo_lab.papers.schlick1993.tried import CLOSE, EQUATIONS, over, row
from albedo_lab.papers.trials import Found, measured, trial

SLOPES = (0.1, 0.2, 0.3, 0.5)
"""The m that are tried: eq. 8 has m in [0, 0.5]."""
COSINES = np.linspace(1e-6, 1.0, 20_001)
Function = Callable[[Array], Array]


def largest_error(f: Array, g: Array) -> float:
    """Between two functions on one grid."""
    return float(np.max(np.abs(f - g)))


def best(error: Callable[[float], float], low: float, high: float) -> tuple[float, float]:
    """The parameter with the smallest error between low and high, and that error: on a grid, then by Brent's method."""
    x = np.linspace(low, high, 101)
    i = int(np.argmin([error(float(k)) for k in x]))
    found = minimize_scalar(error, bounds=(x[max(i - 1, 0)], x[min(i + 1, 100)]), method="bounded", options={"xatol": 1e-9})
    return float(found.x), float(found.fun)


def best_C(n: complex) -> tuple[float, float]:
    """The C of eq. 11 that fits Fresnel's reflectance of the index n best, and the largest error."""
    exact = exact_fresnel(n, COSINES)
    return best(lambda C: largest_error(S(C, COSINES), exact), 0.0, 1.0)


def best_r(m: float, remainder: bool) -> tuple[float, float]:
    """The r of eq. 16 that fits eq. 7 best, as printed or with Smith's `remainder`, and the largest error."""
    exact = smith(m, COSINES, remainder)
    return best(lambda r: largest_error(G(r, COSINES), exact), 1e-3, 1.0)


def survival_error(rho: float) -> float:
    """Of r / (r + x) against exp(-x / m^2), the shares of normals steeper than sqrt(x), r = rho m^2: the same for every m."""
    y = np.geomspace(1e-3, 1e3, 6001)
    return largest_error(rho / (rho + y), np.exp(-y))


def best_rho() -> tuple[float, float]:
    """The r of Z, over m^2, that fits Beckmann's normals best, and the largest error of the share steeper than any slope."""
    return best(survival_error, 0.05, 3.0)


def ward_azimuths(p: float, w: Array) -> Array:
    """The azimuths of normals of eq. 8's Gaussian, m = p n: their density over its mean, p / (w^2 + p^2 (1 - w^2))."""
    return p / (w**2 + p**2 * (1.0 - w**2))


def best_p(p: float) -> tuple[float, float]:
    """The p of A that fits Ward's ellipse of that p best, and the largest error over Ward's peak, 1/p."""
    w = np.sin(np.linspace(0.0, 0.5 * pi, 20_001))
    exact = ward_azimuths(p, w)
    return best(lambda q: largest_error(A(q, w), exact) * p, 1e-3, 1.0)


def fresnel_of(indices: Iterable[complex]) -> tuple[list[float], list[float]]:
    """The largest error of eq. 11 for every index, with C the normal reflectance, and with the best C."""
    normal, fitted = [], []
    for n in indices:
        C = abs((n - 1.0) / (n + 1.0)) ** 2
        normal.append(largest_error(S(C, COSINES), exact_fresnel(n, COSINES)))
        fitted.append(best_C(n)[1])
    return normal, fitted


def of_dielectrics(*indices: float) -> Callable[[Means], Found]:
    """A finder: eq. 11 against Fresnel."""

    def find(means: Means) -> Found:
        normal, fitted = fresnel_of(indices)
        ours = f"largest error {row('n =', zip(indices, normal, strict=True), 3)}"
        again = []
        for n in indices:
            C = fresnel.normal_reflectance(n, 0.0)
            again.append(max(abs(fresnel.schlick(C, u) - fresnel.dielectric(n, u)) for u in np.linspace(0.0, 1.0, 2001).tolist()))
        refitted = ", ".join(f"{e:.3g}" for e in fitted)
        second = f"{row('n =', zip(indices, again, strict=True), 3)} (module fresnel); with the best C {refitted}"
        return Found(max(normal) <= CLOSE, ours, "complex amplitudes, 20 001 angles", second)

    return find


def of_metals(*metals: str) -> Callable[[Means], Found]:
    """A finder: eq. 11 against Fresnel at the wavelengths of the visible range."""

    def find(means: Means) -> Found:
        errors, fitted, again = [], [], []
        for metal in metals:
            indices = [index(metal, wavelength) for wavelength in PAPER_WAVELENGTHS]
            normal, best_ones = fresnel_of(complex(eta, -k) for eta, k in indices)
            worst = int(np.argmax(normal))
            eta, k = indices[worst]
            C = fresnel.normal_reflectance(eta, k)
            errors.append(normal[worst])
            fitted.append(best_ones[worst])
            again.append(
                max(abs(fresnel.schlick(C, u) - fresnel.conductor(eta, k, u)) for u in np.linspace(0.0, 1.0, 2001).tolist())
            )
        ours = f"largest error {', '.join(f'{metal} {e:.3g}' for metal, e in zip(metals, errors, strict=True))}"
        second = (
            f"{', '.join(f'{e:.3g}' for e in again)} (module fresnel); with the best C {', '.join(f'{e:.3g}' for e in fitted)}"
        )
        return Found(max(errors) <= CLOSE, ours, "complex amplitudes, eight wavelengths", second)

    return find


def of_smith(remainder: bool) -> Callable[[Means], Found]:
    """A finder: eq. 16 with the best r against eq. 7, as printed or as Smith has it."""

    def find(means: Means) -> Found:
        fits = [best_r(m, remainder) for m in SLOPES]
        ours = f"largest error {row('m =', zip(SLOPES, (e for _, e in fits), strict=True), 3)}"
        grid = np.linspace(1e-3, 1.0, 2000)
        exact = {m: smith(m, COSINES[::20], remainder) for m in SLOPES}
        again = over(SLOPES, lambda m: min(largest_error(G(float(r), COSINES[::20]), exact[m]) for r in grid))
        second = f"{row('m =', again, 3)} (grid of r)"
        return Found(
            max(e for _, e in fits) <= CLOSE, f"{ours}; r = {', '.join(f'{r:.3f}' for r, _ in fits)}", "best r by Brent", second
        )

    return find


def one_r_for_both(means: Means) -> Found:
    """G with the r that makes Z fit Beckmann's normals best, against Smith's factor for the same normals."""
    rho, _ = best_rho()

    def error(m: float) -> float:
        # the m of eq. 6 is sqrt(2) times that of eq. 7
        return largest_error(G(rho * m * m, COSINES), smith(m / np.sqrt(2.0), COSINES, remainder=True))

    ours = over(SLOPES, error)
    again = over(SLOPES, lambda m: best_r(m / np.sqrt(2.0), remainder=True)[0] / (rho * m * m))
    told_of = f"G off by up to {row('m =', ours, 3)}, with r = {rho:.3f} m²"
    return Found(
        max(e for _, e in ours) <= CLOSE, told_of, "best r by Brent", f"best r of G over best r of Z: {row('m =', again, 3)}"
    )


def of_beckmann(means: Means) -> Found:
    """Z against Beckmann's D, by the share of normals steeper than any slope."""
    rho, error = best_rho()
    grid = np.linspace(0.4, 0.7, 301)
    errors = [survival_error(float(k)) for k in grid]
    nearest = f"{min(errors):.4f} at r = {grid[int(np.argmin(errors))]:.3f} m² (grid)"
    again = f"{nearest}; {survival_error(1.0):.3f} with r = m², equal peaks"
    return Found(error <= CLOSE, f"off by up to {error:.4f} with the best r = {rho:.4f} m²", "best r by Brent", again)


def of_ellipse(means: Means) -> Found:
    """A against the azimuths of Ward's normals."""
    chosen = (0.1, 0.2, 0.5)
    fits = [best_p(p) for p in chosen]
    w = np.linspace(0.0, 1.0, 10_001)
    same_p = over(chosen, lambda p: largest_error(A(p, w), ward_azimuths(p, w)) * p)
    squared = max(float(np.max(np.abs(A(p, w) ** 2 / ward_azimuths(p, w) - 1.0))) for p in chosen)
    ours = f"off by up to {row('p =', zip(chosen, (e for _, e in fits), strict=True), 3)} of the peak, with the best p of A"
    again = f"{row('p =', same_p, 3)} with the same p; without its root A is Ward's within {squared:.1g}"
    return Found(max(e for _, e in fits) <= CLOSE, ours, EQUATIONS, again)


APPROXIMATIONS = (
    Statement(
        "eq_11_glass",
        "eq. 11",
        "Equation 11 which is a close approximation [of the Fresnel factor]",
        "for glass, n = 1.5, C = ((n-1)/(n+1))²: within 0.05 at every angle",
        trial(of_dielectrics(1.5)),
        ("schlick",),
    ),
    Statement(
        "eq_11_dielectrics",
        "eq. 11",
        "Equation 11 which is a close approximation",
        "for other dielectrics, n = 1.1, 1.33, 2, 2.5: within 0.05 at every angle",
        measured(
            of_dielectrics(1.1, 1.33, 2.0, 2.5),
            "“Close” has no number in the document. The fifth power fits indices between 1.4 and 2 best; beyond them Fresnel's "
            "factor rises later.",
        ),
        ("schlick",),
    ),
    Statement(
        "eq_11_metals",
        "eq. 11",
        "Equation 11 which is a close approximation",
        "for gold, silver and copper at eight wavelengths, C the reflectance at normal incidence: within 0.05",
        trial(of_metals("gold", "silver", "copper")),
        ("schlick", "metal"),
    ),
    Statement(
        "eq_11_aluminium",
        "eq. 11",
        "Equation 11 which is a close approximation",
        "for aluminium at eight wavelengths, C the reflectance at normal incidence: within 0.05",
        measured(
            of_metals("aluminium"),
            "“Close” has no number in the document. Aluminium's factor dips before it rises to 1, which eq. 11 cannot follow "
            "with any C.",
        ),
        ("schlick", "metal"),
    ),
    Statement(
        "eq_16_printed",
        "eq. 16",
        "Equation 16 which is a close approximation [of the Smith factor]",
        "of eq. 7 as printed: for every m of 0.1, 0.2, 0.3, 0.5 some r brings G(v) within 0.05 at every angle",
        trial(of_smith(remainder=False)),
        ("schlick", "cook_torrance"),
    ),
    Statement(
        "eq_16_smith",
        "eq. 16",
        "Rather than using the true formulation of the Smith factor, we propose Equation 16 which is a close approximation",
        "of Smith's own, g/(g + exp(-h)): for every m of 0.1, 0.2, 0.3, 0.5 some r brings G(v) within 0.05 at every angle",
        measured(
            of_smith(remainder=True),
            "“Close” has no number in the document, whose Smith factor is eq. 7 as printed: that one eq. 16 approximates within "
            "0.04. Smith's own reaches 1 far sooner.",
        ),
        ("schlick", "cook_torrance"),
    ),
    Statement(
        "one_r_for_both",
        "§5.1; eq. 14, 16",
        "r: Roughness factor",
        "the r with which Z fits Beckmann's normals best makes G fit Smith's factor of the same normals within 0.05",
        measured(
            one_r_for_both,
            "The document gives Z and G one r and does not say that it suits both. Z wants one that goes like m², G one that "
            "goes like m: with one r the surface hides far too little.",
        ),
        ("schlick", "cook_torrance"),
    ),
    Statement(
        "Z_beckmann",
        "§5.4, before eq. 14",
        "Z and A can be mixed in a gaussian elliptical function as in [WARD92]. We propose a separable expression",
        "how far Z is from the Gaussian that it stands for: the largest error of the share of normals steeper than any slope",
        measured(of_beckmann, "The document does not say that Z is close to Beckmann's D; its tail is not (see r_rms_slope)."),
        ("schlick", "cook_torrance"),
    ),
    Statement(
        "A_ellipse",
        "§5.4, before eq. 14",
        "Z and A can be mixed in a gaussian elliptical function as in [WARD92]. We propose a separable expression",
        "how far A is from the azimuths of Ward's elliptical Gaussian with p = m/n, over their peak",
        measured(of_ellipse, "The document does not say that A is close to Ward's; without its root, A is his exactly."),
        ("schlick", "ward"),
    ),
)
