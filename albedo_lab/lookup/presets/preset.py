"""What a preset is: the table that a renderer reads, from the model to the name of the array."""

from __future__ import annotations

from dataclasses import dataclass

from albedo_lab.lookup.formats import Layout


@dataclass(frozen=True)
class Preset:
    """A table in the layout of a renderer.

    model, fixed, quantity
        What is tabulated, and the choices and parameters that the renderer has.
    axes, sampling
        As `parse_axes` takes them, the first varying slowest.
    format, layout
        How its file stores numbers, where the output's suffix says nothing else.
    name, mean
        Of the array, and of that of the means beside it; None where the renderer reads none.
    reader
        What reads it, and by which index.
    differences
        Where the renderer's own table differs from this one.
    """

    name: str
    mean: str | None
    model: str
    quantity: str
    axes: tuple[str, ...]
    sampling: str
    fixed: tuple[tuple[str, object], ...]
    format: str
    layout: Layout
    reader: str
    differences: tuple[str, ...] = ()
