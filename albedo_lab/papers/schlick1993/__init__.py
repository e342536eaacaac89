"""Schlick, "A Customizable Reflectance Model for Everyday Rendering" (1993): what it prints, recomputed."""

from __future__ import annotations

from albedo_lab.papers.record import Paper
from albedo_lab.papers.schlick1993.approximations import APPROXIMATIONS
from albedo_lab.papers.schlick1993.definitions import DEFINITIONS
from albedo_lab.papers.schlick1993.earlier import EARLIER
from albedo_lab.papers.schlick1993.errata import ERRATA
from albedo_lab.papers.schlick1993.factors import FACTORS
from albedo_lab.papers.schlick1993.figures import FIGURES
from albedo_lab.papers.schlick1993.laws import LAWS
from albedo_lab.papers.schlick1993.parameters import PARAMETERS
from albedo_lab.papers.schlick1993.tables import TABLES

FOUND = """\
Reciprocity holds for every formulation; energy balance for none: the albedo of eq. 12 and 17 grows like 1/v towards
grazing incidence, that of eq. 18 is above 1 for every r, that of eq. 15 for r < 0.17, and two layers that conserve
energy one by one do not do so together. Z is normalised; A is not, unless p = 1, and would be without its root. The
root of eq. 13 belongs in the denominator. Eq. 7 is not Smith's factor, and eq. 16 comes closer to eq. 7 as printed than
to Smith's. r and p are not quite the quantities that they are said to be."""

PAPER = Paper(
    "schlick1993",
    "C. Schlick: A Customizable Reflectance Model for Everyday Rendering. Fourth Eurographics Workshop on Rendering, 1993",
    FOUND,
    tables=TABLES,
    statements=(*DEFINITIONS, *EARLIER, *PARAMETERS, *FACTORS, *APPROXIMATIONS, *LAWS),
    errata=ERRATA,
    figures=FIGURES,
)
