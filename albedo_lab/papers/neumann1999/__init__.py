"""Neumann, Neumann, Szirmay-Kalos, "Compact Metallic Reflectance Models" (1999): what it prints, recomputed."""

from __future__ import annotations

from albedo_lab.papers.neumann1999.errata import ERRATA
from albedo_lab.papers.neumann1999.figures import FIGURES
from albedo_lab.papers.neumann1999.statements import STATEMENTS
from albedo_lab.papers.neumann1999.tables import TABLES
from albedo_lab.papers.record import Paper

FOUND = """\
Most of the print holds. Three figures do not: as n → ∞ the mean albedo of the Phong model tends to 2/3, not 0.5,
and that of the stretched Blinn model to 2/3, not 1 (so that, unlike the stretched Phong model, it does not tend to
the ideal mirror); and Schlick's model with r = 0.001 may carry a constant half as large again as the printed one.
The other deviations of figures are slips of the last digit.

Of the sentences, those about other people's models fare worst. Cook-Torrance does not diverge at grazing angles, with
either of its geometric factors; it is plausible. He-Torrance, which the paper calls plausible, returns more than
arrives at the surface of the paper's own figure 5. Ward's lobe has the off-specular peak that table 1 denies it. Of the
paper's own model the formulas hold, but not what is said of its sampling: counting rejected samples, it is at its best
at normal incidence and at its worst at grazing angles."""

PAPER = Paper(
    "neumann1999",
    "L. Neumann, A. Neumann, L. Szirmay-Kalos: Compact Metallic Reflectance Models. Computer Graphics Forum 18, 1999",
    FOUND,
    tables=TABLES,
    statements=STATEMENTS,
    errata=ERRATA,
    figures=FIGURES,
)
