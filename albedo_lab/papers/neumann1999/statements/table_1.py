"""The properties of other people's models in table 1."""

from __future__ import annotations

from typing import Any

import numpy as np

from albedo_lab.papers.neumann1999.statements.introduction import (
    COOK_TORRANCE_BOUNDED,
    HE_TORRANCE,
    NAMES,
    PRINTED_SHAPES,
    SAMPLED_NOW,
    TABLE_1,
    efficient,
    off_specular,
    towards_grazing,
)
from albedo_lab.papers.neumann1999.tried import CODE, albedo, at_mirror, cosine
from albedo_lab.papers.recipes import Means
from albedo_lab.papers.record import Evidence, Statement, Trial
from albedo_lab.papers.trials import Found, holds, subject_of, trial, undecided, verdict_of
from albedo_lab.pictures.evaluation import in_plane


def mirror_part(model: str, theta_deg: float, **parameters: Any) -> float:
    """The reflectance of a model's Dirac part."""
    subject = subject_of(model, **parameters)
    return float(subject.model.mirror(subject.p, cosine(theta_deg))) * subject.scale.value


def metallic(model: str, expected: bool) -> Trial:
    """Section 2.1's criterion: what the mirror direction shows does not get darker towards grazing angles."""
    parameters = TABLE_1[model]

    def find(means: Means) -> Found:
        ratio = at_mirror(model, 80.0, **parameters) / at_mirror(model, 0.0, **parameters)
        if model == "he_torrance":
            near, far = (mirror_part(model, angle, **parameters) for angle in (0.0, 80.0))
            condition = far > near
            ours = f"reflectance of the mirror part {near:.4f} at 0°, {far:.4f} at 80°"
            again = f"the lobe alone has {ratio:.4f} of its radiance left at 80°, the rest is in the mirror part"
        else:
            condition = ratio >= 1.0 - 1e-9
            ours = f"radiance at the mirror direction, 80° over 0°: {ratio:.4f}"
            f = PRINTED_SHAPES[model]
            shape = [float(f(in_plane(np.array([-a])), in_plane(np.array([a])))[0]) * cosine(a) for a in (0.0, 80.0)]
            again = f"{shape[1] / shape[0]:.4f} (the formula alone)"
        return Found(condition is expected, ours, CODE, again)

    return trial(find)


def at_other_wavelengths() -> str:
    """The largest albedo of figure 5's He-Torrance surface, whose wavelength the paper does not print."""
    wavelengths = (0.3, 0.7, 2.0)
    largest = [
        max(albedo("he_torrance", angle, **HE_TORRANCE | {"wavelength": w}) for angle in (75.0, 81.0, 87.0)) for w in wavelengths
    ]
    return "at other wavelengths: " + ", ".join(f"{a:.4f} (λ = {w:g})" for w, a in zip(wavelengths, largest, strict=True))


def plausible(model: str, expected: bool, why: str) -> Trial:
    """Both conditions of §1: reciprocity and energy balance."""

    def trial_(means: Means) -> Evidence:
        found = {check: verdict_of(check, model, means.seed, **TABLE_1[model]) for check in ("reciprocity", "energy")}
        condition = all(f.verdict.value == "PASS" for f in found.values()) is expected
        ours = "; ".join(f"{check}: {f.verdict}, {f.statement}" for check, f in found.items())
        witness = found["energy"].witness or towards_grazing(model, **TABLE_1[model])(means)
        if model == "he_torrance":
            witness += f"; {at_other_wavelengths()}"
        return Evidence(holds(condition), ours, "checks: reciprocity, energy", witness, "" if condition else why)

    return trial_


HE_TORRANCE_EXCESS = "with |F|² = 1 He's own formulas return more than arrives at the surface of figure 5 (λ = 0.5)"


def row(place: str, prop: str, entries: str, models: str, maker: Any) -> tuple[Statement, ...]:
    """A row of table 1: a statement for each model."""
    told = dict(zip(TABLE_1, entries, strict=True))
    return tuple(
        Statement(
            f"table_1_{place}_{model}",
            "table 1",
            f"{NAMES[model]}, {prop}: {entry}",
            models,
            maker(model, entry == "Y"),
            (model,),
        )
        for model, entry in told.items()
    )


STATEMENTS = (
    *row("metallic", "metallic", "NNYYY", "The radiance at the mirror direction does not fall from 0° to 80° (§2.1).", metallic),
    *row(
        "plausible",
        "physically plausible",
        "YYNNY",
        "Reciprocity and energy balance (§1); n = 100, m = 0.1, σ₀ = 0.1, τ = 1.7, λ = 0.5, Fresnel term 1.",
        lambda model, yes: plausible(model, yes, HE_TORRANCE_EXCESS if model == "he_torrance" else COOK_TORRANCE_BOUNDED),
    ),
    Statement(
        "table_1_physically_based",
        "table 1",
        "physically based: N N Y N Y",
        "Whether a model is derived from a description of the surface.",
        undecided("a matter of the derivation, which the paper does not give"),
        tuple(TABLE_1),
    ),
    *row(
        "off_specular",
        "off-specular peak",
        "NNYNY",
        "For light from 75° the summit beside the mirror direction is beyond it.",
        off_specular,
    ),
    *row(
        "sampling",
        "importance sampling",
        "YYNYN",
        "A sampler ten times as efficient as the cosine is known, at 5°, 45° and 80°.",
        lambda model, yes: efficient({model: TABLE_1[model]}, yes, 10.0, SAMPLED_NOW),
    ),
)
