"""Losasso, "Surface Reflection Models" (undated): what it prints, on trial."""

from __future__ import annotations

from albedo_lab.papers.losasso.errata import ERRATA
from albedo_lab.papers.losasso.figures import FIGURES
from albedo_lab.papers.losasso.statements import STATEMENTS
from albedo_lab.papers.record import Paper

FOUND = """\
A guide for programmers, whose equations are mostly right one by one and do not fit together. Lambert's, Phong's and
Ward's terms want a light π times as strong as Cook and Torrance's and Oren and Nayar's. Both equations of the Fresnel
term are wrong: glass would reflect 1.2 % in place of 4 %, and the cheap one has its factor at the wrong term. Minnaert's
law is not his: it is not reciprocal, no k makes it Lambert's, and it darkens the middle instead of the limb. The
Cook-Torrance equation has the specular term where the diffuse one should be; its facets are mirrors, not Lambertian
reflectors; its D falls short of a distribution by the factor that the equation makes good. The document prints hardly a
number, and its only table, the costs of appendix B, is missing from the text beyond its caption: the costs are measured
anew in the pages of the timings."""

PAPER = Paper(
    "losasso",
    "F. Losasso: Surface Reflection Models. White paper, NVIDIA, undated",
    FOUND,
    statements=STATEMENTS,
    errata=ERRATA,
    figures=FIGURES,
)
