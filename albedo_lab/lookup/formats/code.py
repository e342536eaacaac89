"""What the languages of programs share: numbers as literals, and a table in the words of a comment."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import numpy as np

from albedo_lab import __version__
from albedo_lab.digits import justified
from albedo_lab.errors import BadInput
from albedo_lab.lookup.axes import MAPPINGS, Axis
from albedo_lab.lookup.formats.stored import Array, Layout, typed
from albedo_lab.lookup.source import QUANTITIES
from albedo_lab.lookup.table import Table

PER_LINE = 8
INDICES = "ijk"
RESERVED = frozenset(
    re.findall(
        r"\w+",
        """
        alignas alignof and and_eq asm atomic attribute auto bitand bitor bool break buffer case catch cbrt centroid
        char class coherent compl concept const consteval constexpr constinit const_cast continue decltype default
        delete discard do double dynamic_cast else enum explicit export extern false flat float for friend goto half
        highp if in inline inout input int invariant layout long lowp main mat2 mat3 mat4 mediump mutable namespace
        new noexcept noperspective not not_eq nullptr operator or or_eq out output patch precise precision private
        protected public readonly register reinterpret_cast requires resource restrict return sample sampler2D
        sampler3D shared short signed sizeof smooth static static_assert static_cast struct subroutine switch template
        texture this thread_local throw true try typedef typeid typename uint uniform union unsigned using varying
        vec2 vec3 vec4 virtual void volatile wchar_t while writeonly xor xor_eq
        """,
    )
)
"""What C, C++ or GLSL keep for themselves."""


def identifier(name: str) -> str:
    """The name, if programs may call an array so. Raises BadInput."""
    sound = (
        re.fullmatch(r"[A-Za-z][A-Za-z0-9]*(_[A-Za-z0-9]+)*_?", name) is not None
    )  # two underscores are reserved in GLSL and C++
    if not sound or name in RESERVED or name.startswith("gl_"):
        raise BadInput(
            "name", name, "must be a name that C and GLSL take: letters, digits, single underscores, no word of theirs"
        )
    return name


def literals(table: Table, layout: Layout, kind: str, finite: bool = True) -> Array:
    """The values as text, shape (*sizes, channels): with fixed decimals, or the shortest that reads back to the same bits.

    Raises BadInput where a value is too large for the layout's type, or not finite though it has to be.
    """
    values = typed(table, layout.dtype, kind, finite)
    if layout.decimals is None:
        texts = [str(x) for x in values.ravel()]
    else:
        texts = [f"{x:.{layout.decimals}f}" for x in table.values.ravel().tolist()]
    return np.array(texts, dtype=object).reshape(values.shape)


def lines_of(texts: Sequence[str], each: int = PER_LINE) -> Iterator[str]:
    """Elements of an initialiser, `each` a line, without a comma behind the last: GLSL allows none."""
    for start in range(0, len(texts), each):
        last = start + each >= len(texts)
        yield "    " + ", ".join(texts[start : start + each]) + ("" if last else ",")


def extent(table: Table) -> str:
    """How many nodes, as a product.

    >>> from types import SimpleNamespace
    >>> extent(SimpleNamespace(sizes=(16, 32)))
    '16 * 32'
    """
    return " * ".join(map(str, table.sizes))


def described(table: Table, layout: Layout, record: Mapping[str, Any], interleaved: bool = False) -> list[str]:
    """What the array is, in lines of plain characters: quantity, model, index, error; channels may be `interleaved`."""
    told: Mapping[str, Any] = next((entry for entry in record.get("tables", ()) if entry["name"] == table.name), {})
    source, member = table.source, table.source.member
    fixed = dict(member.chosen) | dict(source.fixed)
    chosen = ", ".join(f"{name} = {value}" for name, value in fixed.items())
    named = list(zip(INDICES, table.axes, strict=False))
    strides = [math.prod(table.sizes[n + 1 :]) for n in range(len(named))]
    index = " + ".join(letter if step == 1 else f"{letter} * {step}" for (letter, _), step in zip(named, strides, strict=True))
    channels = source.channels
    if interleaved and len(channels) > 1:
        index = f"({index}) * {len(channels)} + c"
    lines = [
        f"{table.name}[{index}]: {QUANTITIES[source.quantity].meaning}",
        f"of {member.name}{f' ({chosen})' if chosen else ''}",
        f"[{member.source}].",
        *(f"{letter} = {position(axis)}: {axis.title}." for letter, axis in named),
    ]
    if len(channels) > 1:
        which = ", ".join(f"c = {n}: {channel}" for n, channel in enumerate(channels))
        lines.append(f"{which}." if interleaved else f"Components: {', '.join(channels)}.")
    lines.append(
        f"Half of the 95 % interval of a value, before rounding: at most {rounded_up(float(np.max(table.half_widths)))}."
    )
    if told.get("interpolation"):
        largest, rms = (rounded_up(float(told["interpolation"][what])) for what in ("largest", "rms"))
        lines.append(f"Error of linear interpolation between the nodes: largest found {largest}, RMS {rms}.")
    if layout.decimals is not None:
        lines.append(f"Rounded to {layout.decimals} decimals.")
    if layout.dtype == "uint16":
        lines.append("A value is the number here divided by 65535.")
    lines.append(f"Made by albedo_lab {__version__}.")
    return [plain(line) for line in lines]


def position(axis: Axis) -> str:
    """Where a value of the axis' variable stands among its nodes, as a formula.

    >>> position(Axis("mu", "x", 32))
    '31 * mu'
    >>> position(Axis("alpha", "sqrt(x)", 16, 1.0, 0.0, "centres"))
    '16 * (1 - sqrt(alpha)) - 0.5'
    """
    with np.errstate(divide="ignore", invalid="ignore"):
        first, last = MAPPINGS[axis.mapping].forward(np.array([axis.first, axis.last])).tolist()
    label = f"acos({axis.name}) * 2 / pi" if axis.mapping.startswith("acos") else axis.label
    if (first, last) == (0.0, 1.0):
        t = label if re.fullmatch(r"\w+|\w+\([^+-]*\)", label) else f"({label})"
    elif (first, last) == (1.0, 0.0):
        t = f"(1 - {label if '-' not in axis.mapping[:2] else f'({label})'})"
    else:
        t = f"({label} - {first!r}) / ({last - first!r})"
    return f"{axis.size - 1} * {t}" if axis.sampling == "endpoints" else f"{axis.size} * {t} - 0.5"


def rounded_up(error: float) -> str:
    """An error to two digits, never less than it is.

    >>> rounded_up(1.234e-7)
    '1.3e-07'
    """
    return justified(0.0, -error, error)[1]


def plain(text: str) -> str:
    """Text that can stand in any comment: one line of ASCII that neither opens nor ends one."""
    text = " ".join(text.replace("∫", "integral of").split())
    return text.encode("ascii", "replace").decode().replace("/*", "/ *").replace("*/", "* /").rstrip("\\")
