"""Draws pictures: one file a kind, named as the file in `pictures` that computes its data. Computes nothing."""

from __future__ import annotations

from collections.abc import Sequence
from importlib import import_module
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from albedo_lab.pictures import Data, Picture


def render(picture: Picture, data: Data, kinds: Sequence[str] = ("svg", "png")) -> dict[str, bytes]:
    """The picture from the data that it traced, as a file of every kind asked for: "svg", "png" or "pdf".

    The same data give the same bytes. Not for several threads at once: matplotlib's style is one for the process.
    """
    import matplotlib as mpl

    from albedo_lab.report.drawing.style import STYLE, saved

    drawing = import_module(f"{__name__}.{type(picture).__module__.rpartition('.')[2]}")
    with mpl.rc_context(STYLE):
        figure = drawing.draw(picture, data)
        return {kind: saved(figure, kind) for kind in kinds}
