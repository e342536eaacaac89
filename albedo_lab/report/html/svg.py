"""Pictures inside a page: SVG that takes the page's colours and shares no name with its neighbours."""

from __future__ import annotations

import base64
import re
from collections.abc import Mapping
from html import escape
from xml.etree import ElementTree

from albedo_lab.report.drawing.style import GRID, INK

SVG = "{http://www.w3.org/2000/svg}"
HREF = "{http://www.w3.org/1999/xlink}href"
DROPPED = {f"{SVG}metadata", f"{SVG}style"}
"""Licences of the drawing's format, and rules for `*`, which in a page would be rules for all of it (`style.css` has them)."""
THEME = {INK: "var(--ink)", GRID: "var(--grid)"}
HEAVIEST = 2.0
"""How much heavier than its PNG an inline picture may be; one of thousands of facets is shown as PNG instead, on white."""
PIXELS_PER_POINT = 4.0 / 3.0
TALLEST = 1100.0
"""Pixels of height: at half their size the pictures are still readable."""
REFERENCE = re.compile(r"url\(#([^)]+)\)")
COMMAND = re.compile(r"\s*([A-Za-z])\s*")


def embedded(files: Mapping[str, bytes], name: str, label: str) -> str:
    """A picture of the kind svg, or svg and png, as HTML that needs no other file.

    `name` must be unique in the page, as the pictures' own names are made unique by it; `label` is what a screen reader says.
    The element has class `picture`, and `--width` is its natural width, or less for one that is taller than a window.
    """
    root = ElementTree.fromstring(files["svg"])
    width, height = (float(points) * PIXELS_PER_POINT for points in root.get("viewBox", "0 0 576 374").split()[2:])
    width *= min(1.0, TALLEST / height)
    drawn = inlined(root, name)
    if "png" in files and len(drawn) > HEAVIEST * len(files["png"]):
        drawn = f'<img src="data:image/png;base64,{base64.b64encode(files["png"]).decode("ascii")}" alt="">'
    return (
        f'<div class="picture" style="--width: {width:.0f}px" tabindex="0" role="img" aria-label="{escape(label)}">{drawn}</div>'
    )


def inlined(root: ElementTree.Element, name: str) -> str:
    """The drawing as an element of HTML: without what only a file needs, in the theme's colours."""
    wanted = {reference for element in root.iter() for reference in references(element)}
    for element in root.iter():
        for child in [child for child in element if child.tag in DROPPED]:
            element.remove(child)
        element.tag = element.tag.removeprefix(SVG)
        element.text = element.tail = None
        attributes = {key: adapted(key, value, name) for key, value in element.attrib.items() if key != "id"}
        if HREF in attributes:
            attributes["href"] = attributes.pop(HREF)
        if element.get("id") in wanted:
            attributes["id"] = f"{name}-{element.get('id')}"
        element.attrib = attributes
    for attribute in ("width", "height", "version"):
        root.attrib.pop(attribute, None)
    root.set("aria-hidden", "true")
    return ElementTree.tostring(root, encoding="unicode")


def references(element: ElementTree.Element) -> list[str]:
    """The names that an element refers to."""
    found = [name for value in element.attrib.values() for name in REFERENCE.findall(value)]
    href = element.get(HREF, "")
    return [*found, href[1:]] if href.startswith("#") else found


def adapted(key: str, value: str, name: str) -> str:
    """An attribute in the page: its references renamed, its colours the theme's."""
    if key == HREF:
        return f"#{name}-{value[1:]}" if value.startswith("#") else value
    if key == "d":
        return COMMAND.sub(r"\1", value).strip()
    value = REFERENCE.sub(lambda found: f"url(#{name}-{found[1]})", value)
    for colour, variable in THEME.items():
        value = re.sub(colour, variable, value, flags=re.IGNORECASE)
    return value
