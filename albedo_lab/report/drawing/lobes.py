"""Draws 3D lobes above the surface: a row for each curve, a column for each light, seen from the side and a little from above."""

from __future__ import annotations

import math
import textwrap
from bisect import bisect_right
from typing import Any, cast

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.collections import PolyCollection
from matplotlib.colors import to_rgb
from matplotlib.figure import Figure
from matplotlib.layout_engine import PlaceHolderLayoutEngine
from matplotlib.patches import Polygon
from numpy.typing import ArrayLike, NDArray

from albedo_lab.pictures.base import Data
from albedo_lab.pictures.lobes import Lobes
from albedo_lab.report.drawing.style import GRID, INK, WIDTH, line

Array = NDArray[np.float64]

TURN, ELEVATION = math.radians(24.0), math.radians(20.0)
"""The camera stands so far beside the plane of incidence's own side view, and so high."""
RIGHT = np.array([math.cos(TURN), math.sin(TURN), 0.0])
UP = np.array([-math.sin(TURN) * math.sin(ELEVATION), math.cos(TURN) * math.sin(ELEVATION), math.cos(ELEVATION)])
NEAR = np.cross(RIGHT, UP)
SUN = np.array([-0.36, -0.48, 0.80])
"""What shades the lobes, so that their form is seen; no light of the picture."""
DARKEST = 0.5
"""Share of its colour that the side away from it keeps."""
ACROSS, BELOW, ABOVE = 1.24, -0.46, 1.24
"""What a panel shows to either side, and from the bottom to the top; the surface is a disc of radius 1."""
TITLE, TEXT_LINE, LETTER = 0.42, 0.23, 0.095
"""Inches of a row's title, of a line of text, and of a letter in it."""
CUT = 1.12
"""Radius beyond which nothing is drawn of a lobe, and where lines of reference end."""
FLAT = 10.0
"""Times its cosine, where that is below 1, a viewer's value counts for the scale: a BRDF may shoot up along the surface."""
SPECK = 4e-3
"""Facets nearer to the point than that are not seen."""
ALIKE = 0.25
"""Of a row's largest radius; a smaller lobe is enlarged, and says so."""
FACTORS = tuple(m * 10.0**k for k in range(12) for m in (1.0, 2.0, 5.0))


def draw(picture: Lobes, data: Data) -> Figure:
    """The lobes of a row are drawn to one scale, but for those that say how much they are enlarged."""
    table, mirrors, axes_of = (cast(pd.DataFrame, data[name]) for name in ("", "mirrors", "axes"))
    columns = len(picture.theta_deg)
    wide = WIDTH / max(columns, 2)
    tall = wide * (ABOVE - BELOW) / (2.0 * ACROSS)
    rows = []
    for curve in picture.curves:
        lobes = [table[(table.curve == curve.label) & (table.light_deg == theta)] for theta in picture.theta_deg]
        tops = [height(lobe) for lobe in lobes]
        factors = [enlargement(top, max(tops)) for top in tops]
        scales = [factor / (max(tops) or 1.0) for factor in factors]
        reflected = mirrors[mirrors.curve == curve.label].reflectance.tolist()
        words = [said(*each) for each in zip(lobes, scales, factors, reflected, strict=True)]
        rows.append((curve, lobes, scales, reflected, words))
    foot = textwrap.wrap(legend(picture, any(any(reflected) for _, _, _, reflected, _ in rows)), int(wide * columns / LETTER))
    below = [TEXT_LINE * max(1 + text.count("\n") for text in words) for *_, words in rows]
    high = sum(below) + len(rows) * (TITLE + tall) + TEXT_LINE * (len(foot) + 1)
    figure = Figure(figsize=(wide * columns, high), layout=PlaceHolderLayoutEngine(True, True))
    top = high
    for i, (curve, lobes, scales, reflected, words) in enumerate(rows):
        top -= TITLE + tall
        isotropic = bool(axes_of[axes_of.curve == curve.label].isotropic.iloc[0])
        panels = [figure.add_axes((j / columns, top / high, 1.0 / columns, tall / high)) for j in range(columns)]
        for axes, lobe, scale, mirror, text in zip(panels, lobes, scales, reflected, words, strict=True):
            ground(axes, None if isotropic else picture.phi_deg)
            directions(axes, float(lobe.light_deg.iloc[0]), mirror)
            surface(axes, picture, lobe, scale, line(i)["color"])
            axes.text(0.0, BELOW, text, ha="center", va="top")
        panels[0].set_title(curve.label, x=0.02)
        top -= below[i]
    figure.supxlabel("\n".join(foot), fontsize=13, y=0.4 * TEXT_LINE / high, va="bottom")
    return figure


def legend(picture: Lobes, dirac: bool) -> str:
    """What stands below all panels."""
    quantity = "f cos θ, θ that of the light," if picture.cosine else "f"
    told = f"radius: {quantity} in 1/sr, one scale for a row; arrow in: the light; dashes: its mirror direction"
    return f"{told}; arrow out: the Dirac part" if dirac else told


def said(lobe: pd.DataFrame, scale: float, factor: float, mirror: float) -> str:
    """What stands below a panel."""
    told = [f"light at {float(lobe.light_deg.iloc[0]):g}°", described(lobe, CUT / scale, mirror)]
    return "\n".join([*told, *([f"enlarged {factor:g} times"] if factor > 1.0 else [])])


def enlargement(top: float, row: float) -> float:
    """How much larger than to the scale of its row a lobe is drawn: a round number, 1 for all that can be seen without."""
    if not 0.0 < top < ALIKE * row:
        return 1.0
    return FACTORS[bisect_right(FACTORS, row / top) - 1]


def height(lobe: pd.DataFrame) -> float:
    """The value that gives a lobe its scale; 0 where none is a number above 0."""
    share = np.minimum(FLAT * np.cos(np.radians(lobe.viewer_deg)), 1.0)
    return float(np.nanmax(np.where(np.isfinite(lobe.value), share * lobe.value, 0.0), initial=0.0))


def described(lobe: pd.DataFrame, cut: float, mirror: float) -> str:
    """The largest value in words, and what cannot be drawn, such as all above `cut`."""
    known = lobe.value[np.isfinite(lobe.value)]
    told = [f"up to {known.max():.3g}"] if known.max() > 0.0 or mirror == 0.0 else []
    told += [f"cut at {cut:.3g}"] if known.max() > cut else []
    told += [f"mirror {mirror:.3g}"] if mirror != 0.0 else []
    told += [f"down to {known.min():.3g}"] if known.min() < 0.0 else []
    told += ["not finite in places"] if len(known) < len(lobe) else []
    return ", ".join(told)


def ground(axes: Axes, phi_deg: float | None) -> None:
    """The surface; for a light at the azimuth `phi_deg` of an anisotropic one the lines of its x axis."""
    axes.set(xlim=(-ACROSS, ACROSS), ylim=(BELOW, ABOVE))
    axes.set_axis_off()
    turn = np.linspace(0.0, 2.0 * math.pi, 181)
    rim = np.stack([np.cos(turn), np.sin(turn), np.zeros_like(turn)], axis=-1)
    axes.add_patch(Polygon(np.stack(seen(rim), axis=-1), facecolor=GRID, alpha=0.35, edgecolor="none", zorder=0.5))
    axes.plot(*seen(rim), color=GRID, linewidth=1.2, zorder=0.6)
    for across in np.arange(-0.8, 0.81, 0.2) if phi_deg is not None else (0.0,):
        along = math.sqrt(1.0 - across**2)
        ends = np.array([[-along, across, 0.0], [along, across, 0.0]])
        # the light lies at the azimuth 180 degrees of the picture, and at phi_deg of the surface
        axes.plot(*seen(turned(ends, 180.0 - (phi_deg or 0.0))), color=GRID, linewidth=1.2, zorder=0.6)


def directions(axes: Axes, light_deg: float, mirror: float) -> None:
    """The normal, the light that comes in, and its mirror direction; a Dirac part is a spike there."""
    theta = math.radians(light_deg)
    light, mirrored = (np.array([side * math.sin(theta), 0.0, math.cos(theta)]) for side in (-1.0, 1.0))
    axes.plot(*seen(np.array([[0.0, 0.0, 0.0], [0.0, 0.0, CUT]])), color=INK, linewidth=1.0, zorder=1.0)
    axes.plot(*seen(np.outer([0.0, CUT], mirrored)), color=INK, linewidth=1.2, linestyle=(0, (5, 3)), zorder=1.0)
    axes.plot(*seen(np.outer([0.0, 1.1], light)), color=INK, linewidth=1.2, zorder=1.0)
    arrow(axes, 1.28 * light, light)
    if mirror != 0.0:
        arrow(axes, np.zeros(3), CUT * mirrored)


def arrow(axes: Axes, start: Array, end: Array) -> None:
    """From one point to another."""
    style: dict[str, Any] = {"arrowstyle": "-|>,head_width=0.28,head_length=0.5", "color": INK, "linewidth": 2.2}
    axes.annotate("", seen(end), seen(start), arrowprops=style | {"shrinkA": 0, "shrinkB": 0}, annotation_clip=False, zorder=3.0)


def surface(axes: Axes, picture: Lobes, lobe: pd.DataFrame, scale: float, color: str) -> None:
    """The lobe, from the farthest of its facets to the nearest, as pixels; what is negative or not finite is left out."""
    shape = (lobe.viewer_deg.nunique(), -1)
    theta, phi = np.radians(lobe.viewer_deg.to_numpy()), np.radians(180.0 + lobe.viewer_phi_deg.to_numpy() - picture.phi_deg)
    w = np.stack([np.sin(theta) * np.cos(phi), np.sin(theta) * np.sin(phi), np.cos(theta)], axis=-1)
    radius = np.clip(lobe.value.to_numpy() * scale, 0.0, CUT)
    at = (radius[:, None] * w).reshape(*shape, 3)
    facets = np.stack([at[:-1, :-1], at[1:, :-1], at[1:, 1:], at[:-1, 1:]], axis=2).reshape(-1, 4, 3)
    facets = facets[np.max(np.sum(facets * facets, axis=2), axis=1) > SPECK**2]
    normal = np.cross(facets[:, 2] - facets[:, 0], facets[:, 3] - facets[:, 1])
    normal /= np.maximum(np.sqrt(np.sum(normal * normal, axis=1)), 1e-300)[:, None]
    facing = normal @ NEAR > 0.0
    facets, normal = facets[facing], normal[facing]
    order = np.argsort(facets.mean(axis=1) @ NEAR, kind="stable")
    facets, normal = facets[order], normal[order]
    shade = DARKEST + (1.0 - DARKEST) * np.clip(0.5 + 0.5 * normal @ SUN, 0.0, 1.0)
    colours = shade[:, None] * np.array(to_rgb(color))
    corners: Any = np.stack(seen(facets), axis=-1)
    axes.add_collection(
        PolyCollection(corners, facecolors=colours, edgecolors=colours, linewidths=0.4, rasterized=True, zorder=2.0)
    )


def seen(points: ArrayLike) -> tuple[Array, Array]:
    """Where points (.., 3) lie in the picture: x towards the mirror direction's side, y away from the camera, z the normal."""
    at = np.asarray(points, dtype=np.float64)
    return at @ RIGHT, at @ UP


def turned(points: Array, by_deg: float) -> Array:
    """Points (n, 3) turned about the normal."""
    s, c = math.sin(math.radians(by_deg)), math.cos(math.radians(by_deg))
    found: Array = points @ np.array([[c, s, 0.0], [-s, c, 0.0], [0.0, 0.0, 1.0]])
    return found
