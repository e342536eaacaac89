"""The wiki page "Models" (nuaj): what it says, put on trial."""

from __future__ import annotations

from albedo_lab.papers.nuaj_models.errata import ERRATA
from albedo_lab.papers.nuaj_models.figures import FIGURES
from albedo_lab.papers.nuaj_models.statements import STATEMENTS
from albedo_lab.papers.record import Paper

FOUND = """\
The geometry, eq. 4, Blinn-Phong's and Beckmann's distributions, eq. 5 and the critical angle are right. Three groups of
errors are not harmless. The constant α²/π normalises the generalised Trowbridge-Reitz distribution for γ = 2 alone (for
γ = 1 and α = 0.1 it leaves a twentieth of the facets), and the formula that the page calls Trowbridge-Reitz's is Berry's.
Neither weight of the diffuse part keeps the energy balance that it is there for: under smooth facets a white one returns
up to 1.9 times the light. And the “upper bound” of 0.44 on what comes back from below water is the share that is
reflected on its way out: half of the light gets out at the first attempt, and without absorption all that enters does.

Of the MERL table 25 % lies below the surface, not 40 %: the page forgets that the file crowds its cells at small θh. At
θh = 90° half of the hemisphere about the half-vector lies below the surface, as the page says; the other half is of no
use either, for there the viewer is below. The page's figures are not in its text: ours show what they must have shown."""

PAPER = Paper(
    "nuaj_models",
    "Nuaj: Models. A page of a wiki on the shading of materials, undated",
    FOUND,
    statements=STATEMENTS,
    errata=ERRATA,
    figures=FIGURES,
)
