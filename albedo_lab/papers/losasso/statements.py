"""Every statement of the document that can be tried, section by section."""

from __future__ import annotations

from albedo_lab.papers.losasso import blinn, cook_torrance, diffuse, phong, terms, ward

STATEMENTS = tuple(s for section in (diffuse, phong, cook_torrance, blinn, ward, terms) for s in section.STATEMENTS)
