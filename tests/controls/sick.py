"""All negative controls: models of the catalogue, each with one thing made wrong."""

from __future__ import annotations

from dataclasses import replace

from albedo_lab.model import DivergesAtGrazing, EnergyConserving, GrazingAlbedo
from albedo_lab.models.phong import MODEL as PHONG
from albedo_lab.models.product_phong import MODEL as PRODUCT_PHONG
from albedo_lab.models.stretched_phong import MODEL as STRETCHED_PHONG
from tests.controls.record import Sick
from tests.controls.sick_samplers import SAMPLING
from tests.controls.sick_values import VALUES

N20 = {"n": 20.0}
CLAIMS = (
    Sick(
        "grazing_off_by_1_percent",
        "claims a grazing albedo 1 % too large",
        replace(STRETCHED_PHONG, claims=(GrazingAlbedo("nowhere", value=lambda p: 1.01 * (p.n + 2.0) / (2.0 * (p.n + 1.0))),)),
        ("claims",),
        N20,
    ),
    Sick(
        "claims_to_diverge",
        "a vanishing model that claims to diverge",
        replace(PHONG, claims=(DivergesAtGrazing("nowhere"),)),
        ("claims",),
        N20,
    ),
    Sick(
        "claims_to_conserve",
        "a divergent model that claims to conserve energy",
        replace(PRODUCT_PHONG, claims=(EnergyConserving("nowhere"),)),
        ("energy", "claims"),
        N20,
    ),
)
SICK = (*VALUES, *SAMPLING, *CLAIMS)
"""Every control."""
