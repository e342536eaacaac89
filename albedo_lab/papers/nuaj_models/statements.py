"""Every statement of the page, in its order."""

from __future__ import annotations

from albedo_lab.papers.nuaj_models import diffuse, geometry, normals, reflectance, variables

STATEMENTS = (
    *variables.STATEMENTS,
    *normals.STATEMENTS,
    *reflectance.STATEMENTS,
    *diffuse.STATEMENTS,
    *geometry.STATEMENTS,
)
