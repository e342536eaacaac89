"""Where the values of a table of unknown origin may stand: every run of nodes that people use, and how two of them differ."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from albedo_lab.lookup.axes import MAPPINGS, SAMPLINGS, Axis, Floats
from albedo_lab.lookup.source import F0, MU

SHIFTS = (0.0, -0.5, 0.5)
"""In texels. Of texel centres these are t = i/N and (i+1)/N, of endpoints (i -+ 1/2)/(N-1), held within the axis."""
WHOLE = (1.0, -1.0)
"""Of texel centres, and of what is no direction: Filament's cmgen writes the rows of (i + 1.5)/N, and 1 in the last."""
COMMON = {
    MU: ("x", "acos(x)", "sqrt(1-x)", "x^2", "sqrt(x)"),
    F0: ("x", "sqrt(x)"),
    "alpha": ("x", "sqrt(x)", "x^2", "sqrt(sqrt(x))"),
}
OTHER = ("x", "sqrt(x)", "x^2", "log(x)")
"""Tried for what else may run along an axis."""


@dataclass(frozen=True)
class Run:
    """What runs along an axis, between which values, and the mappings to try, the likeliest first."""

    name: str
    low: float
    high: float
    mappings: tuple[str, ...]

    def axes(self, size: int, shifts: tuple[float, ...] = SHIFTS) -> tuple[Axis, ...]:
        """Every way in which it may run along so many nodes, the plainest first."""
        ends = ((self.low, self.high), (self.high, self.low))
        whole = WHOLE if self.name != MU and len(shifts) > 1 else ()
        ways = [(sampling, shift) for shift in shifts for sampling in SAMPLINGS] + [("centres", shift) for shift in whole]
        return tuple(
            Axis(self.name, mapping, size, *between, sampling, shift)
            for sampling, shift in ways
            for mapping in self.mappings
            for between in ends
        )


def run_of(name: str) -> Run:
    """A variable of which nothing is said: it fills [0, 1]."""
    return Run(name, 0.0, 1.0, COMMON.get(name, OTHER[:3]))


def run_along(axis: Axis) -> Run:
    """The variable of an axis, between the axis' ends; its own mapping first."""
    own = plain(axis).mapping
    low, high = sorted((axis.first, axis.last))
    others = [name for name in COMMON.get(axis.name, OTHER) if name != own]
    with np.errstate(invalid="ignore", divide="ignore"):
        known = [name for name in others if np.all(np.isfinite(MAPPINGS[name].forward(np.array([low, high]))))]
    return Run(axis.name, low, high, (own, *known))


def plain(axis: Axis) -> Axis:
    """The same axis without a mapping that another one runs backwards: 1-x is x."""
    return replace(axis, mapping="x") if axis.mapping == "1-x" else axis


def nodes(axis: Axis) -> Floats:
    """The values of the variable at the nodes; those that a shift moves out of the axis stand at its end."""
    return axis.values(np.clip(axis.coordinates, 0.0, 1.0))


def usual_shift(axis: Axis) -> bool:
    """Whether an axis is not shifted, or as Filament's cmgen shifts roughness: by a texel towards the rough end."""
    return axis.shift == 0.0 or (abs(axis.shift) == 1.0 and (axis.shift > 0.0) == (axis.first < axis.last))


def formula(axis: Axis) -> str:
    """The texture coordinate of node i in symbols.

    >>> formula(Axis("mu", "x", 32, sampling="centres", shift=-0.5))
    't = i / 32'
    """
    shift = axis.shift + (0.5 if axis.sampling == "centres" else 0.0)
    over = axis.size if axis.sampling == "centres" else axis.size - 1
    return f"t = i / {over}" if shift == 0.0 else f"t = (i {'+' if shift > 0 else '-'} {abs(shift):g}) / {over}"


def in_words(axis: Axis) -> str:
    """An axis in a few words.

    >>> in_words(Axis("alpha", "sqrt(x)", 32))
    'sqrt(alpha) from 0 to 1, endpoints'
    """
    shift = f" {'+' if axis.shift > 0 else '-'} {_texels(axis)}" if axis.shift else ""
    ends = MAPPINGS[axis.mapping].forward(np.array([axis.first, axis.last]))
    return f"{axis.label} from {ends[0]:.4g} to {ends[1]:.4g}, {axis.sampling}{shift}"


def departures(found: Axis, expected: Axis) -> Iterator[tuple[str, str]]:
    """In what an axis differs from the one that was expected to be there: the names of the defects, and sentences."""
    name = found.name
    if found.mapping != expected.mapping:
        yield _mapping(found, expected)
    opposite = (found.first < found.last) != (expected.first < expected.last)
    if opposite and not (found.mapping != expected.mapping and _upwards(found) and _upwards(expected)):
        yield (
            "axis flipped",
            f"{name} runs from {found.first:g} to {found.last:g}, not from {expected.first:g} to {expected.last:g}",
        )
    where = f"({formula(found)}, not {formula(expected)})"
    if found.shift != expected.shift:
        towards = "smaller" if found.shift < 0.0 else "larger"
        shifted = "half-texel shift" if abs(found.shift) == 0.5 else "texel shift"
        also = "" if abs(found.shift) == 0.5 else ", as Filament's cmgen writes its rows"
        yield shifted, f"along {name} every value is that of {_texels(found)} further towards {towards} indices {where}{also}"
    elif found.sampling != expected.sampling:
        yield "sampling", f"along {name} the values stand at {found.sampling}, not at {expected.sampling} {where}"


def _texels(axis: Axis) -> str:
    """The size of a shift in words."""
    return "half a texel" if abs(axis.shift) == 0.5 else "a texel"


def _upwards(axis: Axis) -> bool:
    """Whether the mapping grows along the axis, as is natural, though the variable may fall."""
    ends = MAPPINGS[axis.mapping].forward(np.array([axis.first, axis.last]))
    return bool(ends[0] < ends[1])


def _mapping(found: Axis, expected: Axis) -> tuple[str, str]:
    """A mapping that is not the one expected, by the name that people have for the mistake."""
    powers = {"x": 1.0, "sqrt(x)": 0.5, "x^2": 2.0, "sqrt(sqrt(x))": 0.25}
    sentence = f"the axis is linear in {found.label}, not in {expected.label}"
    if {found.mapping, expected.mapping} <= set(powers):
        if found.name == "alpha" and {found.mapping, expected.mapping} == {"x", "sqrt(x)"}:
            here, there = ("alpha", "roughness") if found.mapping == "x" else ("roughness", "alpha")
            return f"{here} for {there}", f"{sentence} (roughness = sqrt(alpha))"
        ratio = powers[expected.mapping] / powers[found.mapping]
        word = {2.0: "is squared", 4.0: "is squared twice", 0.5: "is a square root", 0.25: "is a fourth root"}
        what = word.get(ratio, f"is raised to the power {ratio:g}")
        return "axis squared" if ratio > 1.0 else "axis rooted", f"{sentence}: {expected.label} {what} where it should not be"
    return "axis mapping", sentence
