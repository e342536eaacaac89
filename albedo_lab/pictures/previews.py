"""Previews: a sphere and a cylinder of each material, in linear light, under a lamp, a light at the eye, and a uniform sky."""

from __future__ import annotations

import math
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, replace

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from albedo_lab.analysis.request import effort, model_of, values_of
from albedo_lab.analysis.verdict import Subject
from albedo_lab.errors import BadInput
from albedo_lab.model import no_mirror
from albedo_lab.optics.colour import encode, srgb_weights
from albedo_lab.optics.metals import PAPER_WAVELENGTHS
from albedo_lab.pictures.base import Curve, Data
from albedo_lab.pictures.evaluation import Array, subject, values
from albedo_lab.pictures.samples import drawn, weights
from albedo_lab.pictures.scene import LAMP, SCRATCHES, SHAPES, VIEWER, ZENITH, Seen, seen

DIRECTIONS, TURN = 233, 144
"""Into the sky, from the same lattice of Fibonacci numbers for every pixel: what error it leaves has no grain."""
HAZE = 0.08
"""The sky fades over so much of its zenith's component to either side of the horizon, or its directions would set one by one."""
LAMPS = {"directional": LAMP, "eye": VIEWER}
LIGHTS = (*LAMPS, "sky")
PIXELS = 256
"""As many are looked at together, so that what they need stays in the processor's cache."""
HALF_A_STEP = 0.5 / 255.0
COSINES = np.concatenate([np.geomspace(1e-4, 1e-2, 32, endpoint=False), np.linspace(1e-2, 1.0, 100)])
"""Where the reflectance of a Dirac part is taken; linear between."""


@dataclass(frozen=True)
class Previews:
    """A column for each curve, a row for each shape under each light, `size` x `size` pixels each.

    `lights` are "directional" (from the upper left), "eye" (in the direction of the viewer), both of irradiance pi across the
    beam, and "sky" (of radiance 1 above the horizon of the upright shapes, nothing below, and 9 degrees of haze between). So a
    white Lambert surface that faces a light, or the whole sky, has radiance 1, which `exposure` multiplies. A Dirac part shows
    the sky and no light: the mirror image of a light from afar is a point. The material's x axis, its scratches, runs along the
    "length" of the shapes, from the top down, or "around" them.

    A curve may give three values of one parameter, or of `scale`, for red, green and blue; a measurement's channels are that
    by themselves. Several values of `wavelength` make a spectrum and its colour under D65; a metal that is given by its name
    has those of PAPER_WAVELENGTHS.
    """

    curves: tuple[Curve, ...]
    lights: tuple[str, ...] = ("directional", "eye", "sky")
    shapes: tuple[str, ...] = ("sphere", "cylinder")
    size: int = 192
    scratches: str = "length"
    exposure: float = 1.0

    def __post_init__(self) -> None:
        for name, given, known in (("lights", self.lights, LIGHTS), ("shapes", self.shapes, SHAPES)):
            for word in given:
                if word not in known:
                    raise BadInput(name, word, f"must be of {', '.join(known)}")
        if self.scratches not in SCRATCHES:
            raise BadInput("scratches", self.scratches, f"must be one of {', '.join(SCRATCHES)}")
        if not 8 <= self.size <= 4096:
            raise BadInput("size", self.size, "must be in [8, 4096] pixels")
        if not 0.0 < self.exposure < math.inf:
            raise BadInput("exposure", self.exposure, "must be a finite number above 0")

    def trace(self, threads: int | None = None) -> Data:
        """Columns curve, shape, light, covered (pixels), clipped, negative, not_finite (shares of these), largest (radiance).

        "radiance" (curves, shapes, lights, size, size, 3) is linear sRGB, times the exposure, 0 beside a shape; "coverage"
        (shapes, size, size) tells how much of each pixel the shape covers. Nothing is clamped: a pixel is clipped when
        a channel of it lies above what the brightest of a screen's 256 steps stands for, negative when one lies as far below 0.
        Raises BadInput for a curve with several values that make no colour.
        """
        shapes = [seen(shape, self.size, self.scratches) for shape in self.shapes]
        radiance = np.zeros((len(self.curves), len(self.shapes), len(self.lights), self.size, self.size, 3))
        rows = []
        with ThreadPoolExecutor(effort(None, "quadrature", 0, threads).threads) as pool:
            for i, curve in enumerate(self.curves):
                layers, mix = layers_of(curve)
                for j, shape in enumerate(shapes):
                    for k, light in enumerate(self.lights):
                        lit = shaded(layers, shape, light, pool) @ mix
                        radiance[i, j, k][shape.coverage > 0.0] = lit * self.exposure
                        head = {"curve": curve.label, "shape": self.shapes[j], "light": light}
                        rows.append({**head, **_counted(lit * self.exposure)})
        return {"": pd.DataFrame(rows), "radiance": radiance, "coverage": np.stack([shape.coverage for shape in shapes])}


def layers_of(curve: Curve) -> tuple[list[Subject], Array]:
    """The materials of a curve, and what each contributes to R, G and B, (layers, 3). Raises BadInput."""
    given = values_of(model_of(curve.model), curve.parameters)
    if given.get("metal", ["custom"]) != ["custom"]:
        given.setdefault("wavelength", list(PAPER_WAVELENGTHS))
    several = {name: found for name, found in given.items() if len(found) > 1}
    if not several:
        return [subject(curve)], np.ones((1, 3))
    (name, found), *others = several.items()
    if others or (len(found) != 3 and name != "wavelength"):
        told = ", ".join(f"{name} = {found}" for name, found in several.items())
        raise BadInput("curve", curve.label, f"must be one material, or have three values of one parameter, and has {told}")
    layers = [subject(replace(curve, parameters={**given, name: value})) for value in found]
    return layers, srgb_weights(found) if name == "wavelength" else np.eye(3)


def shaded(layers: Sequence[Subject], shape: Seen, light: str, pool: ThreadPoolExecutor) -> Array:
    """The radiance of every covered pixel in every layer, (n, layers), the same whatever the number of threads."""
    viewer = shape.local(VIEWER)
    if light in LAMPS:
        lamp = shape.local(LAMPS[light])
        return np.stack([under_lamp(layer, viewer, lamp) for layer in layers], axis=-1)
    zenith = shape.local(ZENITH)

    def work(first: int) -> Array:
        part = slice(first, first + PIXELS)
        return under_sky(layers, viewer[part], zenith[part])

    return np.concatenate(list(pool.map(work, range(0, len(viewer), PIXELS))))


def under_lamp(of: Subject, viewer: Array, lamp: Array) -> Array:
    """pi f cos(theta_light) for directions (n, 3) in frames of the surface; 0 where the lamp is below its horizon."""
    radiance = np.zeros(len(viewer))
    lit = lamp[:, 2] > 0.0
    radiance[lit] = math.pi * values(of, lamp[lit], viewer[lit]) * lamp[lit, 2]
    return radiance


def under_sky(layers: Sequence[Subject], viewer: Array, zenith: Array) -> Array:
    """The integral of f cos(theta) over the directions above the horizon of the scene, (n, layers), Dirac parts included.

    Both (n, 3) in frames of the surface. Layers that sample alike share their samples, so that the wavelengths of a metal cost
    little more than one.
    """
    uniforms = np.tile(lattice(DIRECTIONS, TURN), (len(viewer), 1))
    viewers = np.repeat(viewer, DIRECTIONS, axis=0)
    sees_sky = np.sum(viewer * [-1.0, -1.0, 1.0] * zenith, axis=1) > 0.0
    radiance = np.empty((len(viewer), len(layers)))
    sampled: Subject | None = None
    for k, layer in enumerate(layers):
        if sampled is None or not alike(sampled, layer):
            sampled, (wi, density) = layer, drawn(layer, viewers, uniforms)
            up = np.sum(wi.reshape(-1, DIRECTIONS, 3) * zenith[:, None, :], axis=-1).ravel()
            lit = np.flatnonzero((up > -HAZE) & (wi[:, 2] > 0.0))
            wi, wo, density, pixel = wi[lit], viewers[lit], density[lit], lit // DIRECTIONS
            sky = np.minimum(0.5 * (1.0 + up[lit] / HAZE), 1.0)
        weight = sky * weights(layer, wi, wo, density)
        radiance[:, k] = np.bincount(pixel, weight, len(viewer)) / DIRECTIONS
        if layer.model.mirror is not no_mirror:
            radiance[:, k] += np.where(sees_sky, mirrored(layer, viewer[:, 2]), 0.0)
    return radiance


def lattice(count: int, turn: int) -> Array:
    """Points that fill the unit square evenly, (count, 2), for two Fibonacci numbers that follow each other."""
    i = np.arange(count)
    return np.stack([i + 0.5, i * turn % count + 0.5], axis=-1) / count


def alike(one: Subject, other: Subject) -> bool:
    """Whether two materials draw the same samples with the same densities, as a few of them show."""
    uniforms = lattice(21, 13)
    viewers = np.broadcast_to(np.array([0.6, 0.0, 0.8]), (21, 3))
    return all(map(np.array_equal, drawn(one, viewers, uniforms), drawn(other, viewers, uniforms)))


def mirrored(of: Subject, mu: Array) -> Array:
    """The reflectance of the Dirac part."""
    reflectance = np.array([of.model.mirror(of.p, float(c)) for c in COSINES])
    found: Array = np.interp(mu, COSINES, reflectance) * of.scale.value
    return found


def _counted(radiance: Array) -> dict[str, float]:
    """What cannot be shown of the colours (n, 3) of one image, as shares of its pixels."""
    shares = {name: float(np.mean(mask)) for name, mask in faults(radiance).items()}
    return {"covered": len(radiance), **shares, "largest": float(np.max(radiance, where=np.isfinite(radiance), initial=0.0))}


def faults(radiance: Array) -> dict[str, NDArray[np.bool_]]:
    """Which colours (.., 3) cannot be shown: half of a screen's 255 steps and more beyond its ends, or not finite."""
    finite, shown = np.isfinite(radiance), encode(radiance)
    wrong = {"clipped": finite & (shown > 1.0 + HALF_A_STEP), "negative": finite & (shown < -HALF_A_STEP), "not_finite": ~finite}
    return {name: np.any(channels, axis=-1) for name, channels in wrong.items()}
