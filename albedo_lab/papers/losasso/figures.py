"""The screenshot and the diagrams of each model, with its parameters of our own choice: the document prints none."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from albedo_lab.papers.losasso.blinn import BLINN
from albedo_lab.papers.losasso.cook_torrance import COOK_TORRANCE
from albedo_lab.papers.losasso.diffuse import LAMBERT, MINNAERT, OREN_NAYAR
from albedo_lab.papers.losasso.phong import PHONG
from albedo_lab.papers.losasso.ward import WARD
from albedo_lab.papers.record import Figure
from albedo_lab.pictures.base import Curve
from albedo_lab.pictures.lobes import Lobes
from albedo_lab.pictures.previews import Previews

SIZE = 128
"""Pixels of a preview's side: there are many of them."""


@dataclass(frozen=True)
class Shown:
    """What is shown of a model: `curves` as lobes and as previews, and what the document says of its own figures."""

    name: str
    title: str
    place: str
    curves: tuple[Curve, ...]
    caption: str
    scratches: str = "length"


MODELS = (
    Shown(
        "lambert",
        "Lambert",
        LAMBERT,
        (Curve("Lambert", "lambert", {}),),
        "k_d = 1. The lobe is the same ball from everywhere, and smaller the lower the light stands.",
    ),
    Shown(
        "phong",
        "Phong",
        PHONG,
        (Curve("n = 10", "phong_original", {"n": 10.0}), Curve("n = 50", "phong_original", {"n": 50.0})),
        "The specular term alone, with the constant that makes it reflect all light at normal incidence; the document's "
        "figures have a diffuse part besides. The highlight stands in R and is as high from every angle.",
    ),
    Shown(
        "cook_torrance",
        "Cook-Torrance",
        COOK_TORRANCE,
        (
            Curve("m = 0.2, n = 1.5", "cook_torrance", {"m": 0.2, "fresnel": "exact", "eta": 1.5, "k": 0.0}),
            Curve("m = 0.2, F = 1", "cook_torrance", {"m": 0.2}),
        ),
        "The specular term alone, with Fresnel's equations as corrected. For a light at 75° the lobe has left R, and for n "
        "= 1.5 it "
        "is many times as strong as at 15°: the “complete change in behavior” of the text.",
    ),
    Shown(
        "blinn",
        "Blinn",
        BLINN,
        (
            Curve("c = 0.2, n = 1.5", "blinn_trowbridge_reitz", {"c": 0.2, "fresnel": "exact", "eta": 1.5, "k": 0.0}),
            Curve("c = 0.2, F = 1", "blinn_trowbridge_reitz", {"c": 0.2}),
        ),
        "The specular term alone, D normalised. Similar to Cook-Torrance, with longer tails.",
    ),
    Shown(
        "oren_nayar",
        "Oren-Nayar",
        OREN_NAYAR,
        (Curve("σ = 0", "oren_nayar", {"sigma": 0.0}), Curve("σ = 0.5", "oren_nayar", {"sigma": 0.5})),
        "ρ = 1. σ = 0 is Lambert's law; a rough surface sends more back towards the light, and is flatter under a light at "
        "the eye.",
    ),
    Shown(
        "minnaert",
        "Minnaert",
        MINNAERT,
        (
            Curve("as printed, k = 0.5", "minnaert", {"as_printed": "yes", "k": 0.5}),
            Curve("Minnaert's, k = 1.5", "minnaert", {"k": 1.5}),
        ),
        "The printed equation is dark where the eye faces the surface and brightest at the limb; Minnaert's own law, with k > 1, "
        "darkens the limb.",
    ),
    Shown(
        "ward",
        "Ward",
        WARD,
        (
            Curve("α = 0.2", "ward", {"form": "half_vector", "m": 0.2}),
            Curve("αx = 0.1, αy = 0.4", "ward", {"form": "half_vector", "m_x": 0.1, "m_y": 0.4}),
        ),
        "The specular term alone. Grooves along x: the lobe is wider across them. The thin spikes along the surface are the "
        "model's 1/√(N·E), which has no bound where the eye grazes.",
        scratches="around",
    ),
)


def figures() -> Iterator[Figure]:
    """A preview for each screenshot, lobes for each diagram."""
    for shown in MODELS:
        yield Figure(
            f"{shown.name}_preview",
            f"{shown.title}: previews",
            f"{shown.place}, screenshot",
            f"{shown.caption} In place of the document's object, which is lost, a ball and a cylinder.",
            Previews(shown.curves, size=SIZE, scratches=shown.scratches),
        )
        yield Figure(
            f"{shown.name}_lobe",
            f"{shown.title}: lobes",
            f"{shown.place}, diagrams",
            f"{shown.caption} f cos θ_i for lights at 15°, 45° and 75°, as in the document's wireframes.",
            Lobes(shown.curves),
        )


FIGURES = tuple(figures())
