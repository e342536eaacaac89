"""The change of variables, and the MERL table that is spaced in it: what the page says of both, on trial."""

from __future__ import annotations

import math
from functools import cache

import numpy as np

from albedo_lab.analysis.verdict import Subject
from albedo_lab.estimate.record import Estimate, bounded, exact
from albedo_lab.measured.cells import SHAPE
from albedo_lab.measured.merl_file import HEADER, PLANE, SIZE, centre_cosines, share_below
from albedo_lab.measured.rusinkiewicz import half_difference, light_and_viewer
from albedo_lab.optics.frame import Direction
from albedo_lab.papers.nuaj_models.formulas import Array, directions
from albedo_lab.papers.recipes import Means
from albedo_lab.papers.record import Evidence, Statement
from albedo_lab.papers.trials import number, ruled, subject_of, unclaimed, undecided
from albedo_lab.pictures.evaluation import values

VARIABLES, MERL = "Change of Variable", "BRDF from Actual Materials"
PAIRS = 1000
ISOTROPIC = ("microfacet", "oren_nayar", "phong_original")
SURFACES = ({"alpha": 0.1}, {"alpha": 0.3}, {"alpha": 0.6}, {"alpha": 0.3, "eta": 3.0})
"""Four of GGX's, dielectrics: they share a formula, so a warping that fits them all should be easy to have."""


def paired(theta_h: Array | float, theta_d: Array | float, phi_d: Array | float) -> tuple[Array, Array]:
    """Light and viewer (n, 3) at Rusinkiewicz' angles in radians: the light about the half-vector, both tilted by theta_h."""
    h, d, phi = (x.ravel() for x in np.broadcast_arrays(theta_h, theta_d, phi_d))
    light = np.stack([np.sin(d) * np.cos(phi), np.sin(d) * np.sin(phi), np.cos(d)])
    viewer = light * np.array([[-1.0], [-1.0], [1.0]])
    s, c = np.sin(h), np.cos(h)

    def tilted(w: Array) -> Array:
        return np.stack([c * w[0] + s * w[2], w[1], c * w[2] - s * w[0]], axis=-1)

    return tilted(light), tilted(viewer)


def turned(w: Array, phi: Array) -> Array:
    """Directions (n, 3) turned about the normal by angles (n,)."""
    c, s = np.cos(phi), np.sin(phi)
    return np.stack([c * w[:, 0] - s * w[:, 1], s * w[:, 0] + c * w[:, 1], w[:, 2]], axis=-1)


def angles_of(wi: Array, wo: Array) -> Array:
    """theta_h, theta_d and phi_d of pairs, (n, 3)."""
    return np.array([half_difference(Direction(*a), Direction(*b)) for a, b in zip(wi.tolist(), wo.tolist(), strict=True)])


def _half_vector(means: Means) -> Evidence:
    wi, wo = directions(PAIRS, means.seed), directions(PAIRS + 1, means.seed)[1:]
    h = wi + wo
    h /= np.linalg.norm(h, axis=1, keepdims=True)
    to_light, to_viewer = np.sum(h * wi, axis=1), np.sum(h * wo, axis=1)
    apart = float(np.max(np.abs(to_light - to_viewer)))
    mirrored = float(np.max(np.abs(2.0 * to_light[:, None] * h - wi - wo)))
    return ruled(
        max(apart, mirrored) < 1e-14,
        f"cos(h, ωi) − cos(h, ωo) at most {apart:.1g} over {PAIRS} pairs",
        "evaluation in double precision",
        f"ωi mirrored at h misses ωo by at most {mirrored:.1g}",
    )


def four_angles(means: Means) -> Evidence:
    """There by rotations, back by the library's formulas, which know none."""
    wi, wo = directions(PAIRS, means.seed), directions(PAIRS + 1, means.seed)[1:]
    phi_h = np.arctan2(wi[:, 1] + wo[:, 1], wi[:, 0] + wo[:, 0])
    angles = angles_of(wi, wo)
    made = [turned(w, phi_h) for w in paired(*angles.T)]
    # phi_d is told up to half a turn, which exchanges both directions
    missed = np.minimum(np.abs(made[0] - wi).max(axis=1), np.abs(made[0] - wo).max(axis=1))
    again = max(
        min(math.dist(light_and_viewer(half_difference(Direction(*a), Direction(*b)), turn)[0], w) for w in (a, b))
        for a, b, turn in zip(wi.tolist(), wo.tolist(), phi_h.tolist(), strict=True)
    )
    return ruled(
        float(missed.max()) < 1e-13,
        f"there and back by rotations: at most {missed.max():.1g} off over {PAIRS} pairs",
        "rotations, double precision",
        f"by closed formulas at most {again:.1g} off",
    )


def below(theta_h: float, seed: int, count: int = 1 << 17) -> tuple[float, float]:
    """The share of directions about h, at an angle from the normal, that lie below the surface, and its standard error."""
    w = directions(count, seed)
    share = float(np.mean(w[:, 2] * math.cos(theta_h) < w[:, 0] * math.sin(theta_h)))
    return share, math.sqrt(share * (1.0 - share) / count)


def lune(theta_h: float) -> float:
    """The same in closed form: between two planes through the hemisphere's centre lies the share of their angle."""
    return theta_h / math.pi


def half_below(means: Means) -> Estimate:
    """At 90 degrees."""
    return exact(lune(0.5 * math.pi))


def half_below_sampled(means: Means) -> Estimate:
    """The same from directions drawn; in blocks of their own, so that the interval is narrow enough to judge."""
    shares, errors = zip(*(below(0.5 * math.pi, means.seed + block) for block in range(4)), strict=True)
    return bounded(float(np.mean(shares)), 2.0 * float(np.mean(errors)), 4 << 17, "samples")


def _part_below(means: Means) -> Evidence:
    told, right = [], True
    for degrees in (1.0, 10.0, 45.0, 89.0):
        share, error = below(math.radians(degrees), means.seed)
        expected = lune(math.radians(degrees))
        right = right and expected > 0.0 and abs(share - expected) <= 5.0 * error
        told.append(f"{100.0 * share:.2f} % ({100.0 * expected:.2f} %)")
    ours = f"θh/π of the directions about h: {', '.join(f'{100 * lune(math.radians(d)):.2f} %' for d in (1, 10, 45, 89))}"
    return ruled(right, f"{ours} at 1, 10, 45, 89°", "closed form", f"samples (closed form): {', '.join(told)}")


def _isotropic(means: Means) -> Evidence:
    wi, wo = directions(PAIRS, means.seed), directions(PAIRS + 1, means.seed)[1:]
    phi = 2.0 * math.pi * np.random.default_rng(means.seed).random(PAIRS)

    def change(of: Subject) -> float:
        before, after = values(of, wi, wo), values(of, turned(wi, phi), turned(wo, phi))
        return float(np.max(np.abs(after - before) / np.maximum(before, after).clip(1e-300)))

    worst = max(change(subject_of(name)) for name in ISOTROPIC)
    other = change(subject_of("ward", m_x=0.1, m_y=0.4))
    return ruled(
        worst < 1e-6 < other,
        f"f of {', '.join(ISOTROPIC)} changes by at most {worst:.1g} of itself when a pair is turned about the normal",
        f"evaluation at {PAIRS} pairs",
        f"an anisotropic surface (ward, m_x = 0.1, m_y = 0.4) changes by up to {other:.2g}, so the test can fail",
    )


def _domain(means: Means) -> Evidence:
    wi, wo = directions(PAIRS, means.seed), directions(PAIRS + 1, means.seed)[1:]
    angles = angles_of(wi, wo)
    highest = angles.max(axis=0)
    inside = bool(np.all(angles >= 0.0) and np.all(highest[:2] <= 0.5 * math.pi) and highest[2] < math.pi)
    unequal = []
    for name in ("microfacet", "phong_original"):
        there, back = values(subject_of(name), wi, wo), values(subject_of(name), wo, wi)
        unequal.append(float(np.max(np.abs(there - back) / np.maximum(there, back).clip(1e-300))))
    return ruled(
        inside and unequal[0] < 1e-12,
        f"every one of {PAIRS} pairs has its angles there, up to {np.degrees(highest).round(1).tolist()}°",
        "evaluation of the change of variables",
        f"φd and φd + π exchange light and viewer, which changes a reciprocal f by {unequal[0]:.1g}; one that is not "
        f"(phong_original) changes by up to {unequal[1]:.2g} and has no place in half a turn",
    )


@cache
def share_of_slices() -> Array:
    """The share of each slice of phi_d whose cells have their centre below the horizon."""
    found: Array = (centre_cosines() <= 0.0).mean(axis=(0, 1))
    return found


def share_at(phi_d: Array, spacing: str) -> Array:
    """The same without cells, for theta_h spaced as the table's ("root") or evenly ("even"): where tan tan |cos phi_d| > 1."""
    t = (np.arange(20_000) + 0.5) / 20_000
    theta_h = 0.5 * np.pi * (t * t if spacing == "root" else t)
    edge = np.arctan2(1.0, np.tan(theta_h)[:, None] * np.abs(np.cos(phi_d))[None, :])
    found: Array = np.maximum(1.0 - edge.mean(axis=0) / (0.5 * np.pi), 0.0)
    return found


@cache
def share_of_all(spacing: str) -> float:
    """The same of the whole table."""
    phi_d = np.radians((np.arange(400) + 0.5) * 0.225)
    return float(share_at(phi_d, spacing).mean())


def _characteristic(means: Means) -> Evidence:
    theta = np.radians(np.arange(90) + 0.5)[:, None]
    least = {}
    for degrees in (90.0, 89.9, 89.0, 45.0, 0.0):
        wi, wo = paired(theta, theta.T, math.radians(degrees))
        least[degrees] = float(np.minimum(wi[:, 2], wo[:, 2]).min())
    whole = [degrees for degrees, cosine in least.items() if cosine > 0.0]
    shares = share_at(np.radians(np.array([90.0, 89.9])), "root")
    return ruled(
        whole == [90.0] and shares[1] > 0.0,
        f"lowest cosine of a slice at a grid of 90 x 90: {', '.join(f'{c:.2g} at {d:g}°' for d, c in least.items())}",
        "rotations",
        f"closed form: a share of {shares[0]:.1g} lies below at 90°, {shares[1]:.2g} at 89.9°",
    )


def _black_texels(means: Means) -> Evidence:
    shares = share_of_slices()
    smooth = share_at(np.radians(np.arange(180) + 0.5), "root")
    return ruled(
        bool(np.all(shares > 0.0)),
        f"every stored slice has cells below: {100 * shares.min():.2f} % of those next to 90°, {100 * shares.max():.1f} % at 0°",
        "count of the cells' centres",
        f"without cells {100 * smooth.min():.2f} to {100 * smooth.max():.1f} %. No stored slice lies at φd = 90°: the centres "
        "of the two nearest are at 89.5 and 90.5°",
    )


def _texels_below(means: Means) -> Evidence:
    angles = np.random.default_rng(means.seed).random((PAIRS, 3)) * [0.5 * math.pi, 0.5 * math.pi, math.pi]
    theta_h, theta_d, phi_d = angles.T
    wi, wo = paired(theta_h, theta_d, phi_d)
    lowest = np.minimum(wi[:, 2], wo[:, 2])
    formula = np.cos(theta_h) * np.cos(theta_d) - np.sin(theta_h) * np.sin(theta_d) * np.abs(np.cos(phi_d))
    apart = float(np.max(np.abs(lowest - formula)))
    return ruled(
        apart < 1e-12,
        f"the lower cosine is cos θh cos θd − sin θh sin θd |cos φd|, to {apart:.1g}: negative where tan θh tan θd |cos φd| > 1",
        "closed form",
        f"rotations of {PAIRS} pairs, of which {100 * np.mean(lowest < 0):.1f} % have a direction below",
    )


def _worse_at_zero(means: Means) -> Evidence:
    shares = share_of_slices()[:90]
    smooth = share_at(np.radians(np.arange(0.0, 90.5, 1.0)), "root")
    return ruled(
        bool(np.all(np.diff(shares) <= 0.0) and np.all(np.diff(smooth) <= 0.0)),
        f"the share falls all the way, from {100 * shares[0]:.1f} % at 0.5° to {100 * shares[-1]:.2f} % at 89.5°",
        "count of the cells' centres",
        f"without cells from {100 * smooth[0]:.2f} % at 0° to {100 * smooth[-1]:.1g} % at 90°",
    )


def _almost_half(means: Means) -> Evidence:
    counted = float(share_of_slices()[0])
    smooth, even = (float(share_at(np.zeros(1), spacing)[0]) for spacing in ("root", "even"))
    return ruled(
        0.4 <= counted <= 0.5,
        f"{100 * counted:.2f} % of the slice's cells",
        "count of the cells' centres",
        f"without cells {100 * smooth:.3f} %; {100 * even:.3f} % if θh were evenly spaced",
        "At φd = 0 a pair is lost where θh + θd > 90°. The file's θh = 90° (i/90)² crowds the cells at small angles, and a "
        "third of them is lost: ∫ t² dt = 1/3. Almost half is what a table with evenly spaced θh would lose.",
    )


def useless(means: Means) -> Estimate:
    """In per cent, by the cells' centres."""
    return exact(100.0 * share_below(), "count of the cells' centres")


def useless_smooth(means: Means) -> Estimate:
    """The same without cells, by a fine midpoint rule: what a table of ever finer cells would lose."""
    return bounded(100.0 * share_of_all("root"), 0.05, 8_000_000, "quadrature")


def _useless_share(means: Means) -> Evidence:
    return number(
        "40",
        useless,
        useless_smooth,
        why="A quarter: the file crowds its cells at small θh. A table with evenly spaced θh would lose "
        f"{100.0 * share_of_all('even'):.1f} %. (But of what is left half says nothing new, unless a surface is chiral: φd and "
        "π − φd are mirror images.)",
    )(means)


def whole_file(means: Means) -> Estimate:
    """Cells times three colours times 8 bytes."""
    return exact(float(math.prod(SHAPE) * 3 * np.dtype(np.float64).itemsize), "count")


def without_header(means: Means) -> Estimate:
    """What the reader of such files expects, less the three integers at their beginning."""
    return exact(float(SIZE - len(HEADER)), "size of the file without its header")


def megabytes(means: Means) -> Estimate:
    """Of 2^20 bytes."""
    return exact(whole_file(means).value / 2.0**20, "count")


def megabytes_of_file(means: Means) -> Estimate:
    """The same of a file, its header with it."""
    return exact(SIZE / 2.0**20, "size of the file")


def misfit(theta_h: float, theta_d: float, steps: tuple[float, ...]) -> float:
    """How far, in logarithms, the best place of the characteristic slice is from a place (degrees) of the slice phi_d = 0.

    The best place is the one at which the worst of SURFACES is missed by least; it is searched over a grid, and then over finer
    ones around the best so far.
    """
    subjects = [subject_of("microfacet", F="dielectric", **surface) for surface in SURFACES]
    at = paired(math.radians(theta_h), math.radians(theta_d), 0.0)
    wanted = [float(values(subject, *at)[0]) for subject in subjects]
    low, high = np.array([0.0, 0.0]), np.array([90.0, 90.0])
    for step in steps:
        h, d = (np.arange(a + 0.5 * step, b, step) for a, b in zip(low, high, strict=True))
        grid = np.stack([x.ravel() for x in np.meshgrid(h, d, indexing="ij")], axis=-1)
        pairs = paired(np.radians(grid[:, 0]), np.radians(grid[:, 1]), 0.5 * math.pi)
        gaps = [np.abs(np.log(values(s, *pairs) / f)) for s, f in zip(subjects, wanted, strict=True)]
        worst = np.max(gaps, axis=0)
        best = grid[int(np.argmin(worst))]
        low, high = np.maximum(best - 2.0 * step, 0.0), np.minimum(best + 2.0 * step, 90.0)
    return float(worst.min())


def _warping(means: Means) -> Evidence:
    places = ((30.0, 55.0), (40.0, 40.0), (60.0, 20.0))
    found = [misfit(*place, (1.0, 0.1, 0.01)) for place in places]
    coarse = [misfit(*place, (0.5,)) for place in places]
    told = ", ".join(f"{100 * math.expm1(x):.1f} % at ({h:g}°, {d:g}°)" for x, (h, d) in zip(found, places, strict=True))
    return ruled(
        max(found) < 0.01,
        f"the best place common to four GGX dielectrics misses one of them by {told}",
        "search over the characteristic slice, refined to 0.01°",
        f"one grid of 0.5°: {', '.join(f'{100 * math.expm1(x):.1f} %' for x in coarse)}",
        "Two coordinates of a place cannot fit what four surfaces show.",
    )


STATEMENTS = (
    Statement(
        "half_vector",
        VARIABLES,
        "h = (ωi + ωo) / ‖ωi + ωo‖",
        "Is h as far from the light as from the viewer, and does a facet with that normal mirror one into the other?",
        _half_vector,
    ),
    Statement(
        "four_angles",
        VARIABLES,
        "2 angles tell us how to rotate the original hemisphere …; the direction of the incoming vector is given by 2 more "
        "angles",
        "Do (φh, θh, φd, θd) determine the pair, up to the order of light and viewer?",
        four_angles,
    ),
    Statement(
        "part_below",
        VARIABLES,
        "as soon as we get away from the normal direction, a part of the new hemisphere stands below the material's surface",
        "Is the share of directions about h that lie below the surface above 0 for every θh > 0?",
        _part_below,
    ),
    Statement(
        "half_below",
        VARIABLES,
        "when h is at 90° off of the n axis: half of the hemisphere stands below the surface",
        "The share of directions about h that lie below the surface, at θh = 90° (the other half is of no use either: there "
        "cos θi = −cos θo, and where the light is above the viewer is not)",
        number("1/2", half_below, half_below_sampled),
    ),
    Statement(
        "isotropic",
        VARIABLES,
        "when the materials are isotropic then φh has no significance …, so we need only account for 3 dimensions instead of 4",
        "Is f of isotropic models the same for every φh?",
        _isotropic,
        ISOTROPIC,
    ),
    Statement(
        "hundred_materials",
        MERL,
        "100 materials … 50 of these are considered “smooth” (e.g. metals and plastics) while the remaining 50 are considered "
        "“rough”",
        "The number of files of the database, and of smooth ones among them",
        undecided("The measurements are no part of the text, and it does not say by what a material is smooth."),
        ("merl",),
    ),
    Statement(
        "csail",
        MERL,
        "the MIT CSAIL database containing a few anisotropic BRDF files",
        "Whether the files of that database are anisotropic",
        undecided("The measurements are no part of the text."),
    ),
    Statement(
        "file_bytes",
        MERL,
        "90*90*180*3*sizeof(double) = 34992000",
        "The product, with 8 bytes a double (a file has 12 bytes more: its header)",
        number("34992000", whole_file, without_header, exact=True),
        ("merl",),
    ),
    Statement(
        "file_megabytes",
        MERL,
        "= 33MB",
        "The same in units of 2^20 bytes (in units of 10^6 bytes it is 35.0)",
        number("33", megabytes, megabytes_of_file),
        ("merl",),
    ),
    Statement(
        "domain",
        MERL,
        "θh ∈ [0, π/2] …, θd ∈ [0, π/2] and φd ∈ [0, π]",
        "Has every pair of directions above the surface its place there? (For φd it takes reciprocity, of which the page is "
        "silent.)",
        _domain,
        ("merl", "phong_original"),
    ),
    Statement(
        "stack",
        MERL,
        "a stack of 180 slices (along φd), each slice being 90x90",
        "The cells of the table, over those of a slice",
        number("180", lambda means: exact(PLANE / 90.0**2), lambda means: exact(float(SHAPE[2]), "shape"), exact=True),
        ("merl",),
    ),
    Statement(
        "characteristic_slice",
        MERL,
        "the most interesting slice is the one at φd = π/2",
        "Is it the only one that is above the surface as a whole?",
        _characteristic,
        ("merl",),
    ),
    Statement(
        "warping",
        MERL,
        "We also can assume the other slices are just a warping of this unique, characteristic slice",
        "Is there one map of (θh, θd), the same for four microfacet surfaces, by which the slice φd = 0 can be read from that "
        "at π/2 to 1 %? Tried at three places.",
        unclaimed(
            _warping,
            "No one map serves four surfaces; a map of its own for each is not ruled out, and the page says neither which it "
            "means nor how close. It calls its attempt failed (“Next”). In eq. 4 the slices differ by G / (cos θi cos θo) alone: "
            "D and F do not know φd.",
        ),
        ("microfacet", "merl"),
    ),
    Statement(
        "black_texels",
        MERL,
        "slices with φd ≠ π/2 are the black texels",
        "Has every slice of a file cells that lie below the surface?",
        _black_texels,
        ("merl",),
    ),
    Statement(
        "texels_below",
        MERL,
        "these black texels represent directions that are below the surface",
        "By which formula does a cell lie below? Against directions made by rotations.",
        _texels_below,
        ("merl",),
    ),
    Statement(
        "worse_at_zero",
        MERL,
        "We see it gets worse for φd = 0",
        "Does the share of a slice that lies below fall from φd = 0 to 90°?",
        _worse_at_zero,
        ("merl",),
    ),
    Statement(
        "almost_half",
        MERL,
        "φd = 0 where almost half of the table contains invalid directions",
        "Do 40 to 50 % of the cells of the slice at φd = 0 lie below the surface?",
        _almost_half,
        ("merl",),
    ),
    Statement(
        "useless_share",
        MERL,
        "40% of the table is useless",
        "The share of all cells that lie below the surface, in per cent",
        _useless_share,
        ("merl",),
    ),
)
