"""The axes of a table: which quantity runs along them, in which it is linear, and where in its cells the values stand."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from albedo_lab.errors import BadInput

Floats = NDArray[np.float64]
LARGEST = 1 << 14
"""Nodes along one axis: far more than any texture has."""
RIGHT = 0.5 * math.pi


@dataclass(frozen=True)
class Mapping:
    """A monotone function whose value is linear along an axis, and its inverse."""

    forward: Callable[[Floats], Floats]
    inverse: Callable[[Floats], Floats]


MAPPINGS = {
    "x": Mapping(lambda x: x, lambda y: y),
    "1-x": Mapping(lambda x: 1.0 - x, lambda y: 1.0 - y),
    "x^2": Mapping(np.square, np.sqrt),
    "sqrt(x)": Mapping(np.sqrt, np.square),
    "sqrt(sqrt(x))": Mapping(lambda x: np.sqrt(np.sqrt(x)), lambda y: np.square(np.square(y))),
    "sqrt(1-x)": Mapping(lambda x: np.sqrt(1.0 - x), lambda y: 1.0 - np.square(y)),
    "acos(x)": Mapping(lambda x: np.arccos(x) / RIGHT, lambda y: np.sin((1.0 - y) * RIGHT)),
    "log(x)": Mapping(np.log, np.exp),
}
"""By how people write them, with x for what runs along the axis; angles in right angles."""
ALIASES = {"theta": "acos(mu)", "roughness": "sqrt(alpha)"}
"""What has a name of its own. Roughness is what artists set: its square is the alpha of the lobe."""
UNIT = np.array([0.0, 1.0])
ASKED = re.compile(r"(?P<mapping>[^=@]+)=(?P<size>[^@]*)(@(?P<first>[^:]*):(?P<last>.*))?")
SAMPLINGS = ("endpoints", "centres")


@dataclass(frozen=True)
class Axis:
    """An axis of `size` nodes along which `mapping` of the variable `name` is linear, from its value `first` to `last`.

    With `sampling` "endpoints" the nodes divide the axis evenly and both ends are nodes; with "centres" they stand in the middle
    of as many equal texels. The texture coordinate t runs from 0 at `first` to 1 at `last`, whichever of the two is larger.
    `shift`, in texels, moves all nodes: 0 for every table that is as it says.
    """

    name: str
    mapping: str
    size: int
    first: float = 0.0
    last: float = 1.0
    sampling: str = "endpoints"
    shift: float = 0.0

    @classmethod
    def parse(cls, text: str, sampling: str = "endpoints") -> Axis:
        """An axis from MAPPING=SIZE[@FIRST:LAST], for instance "sqrt(alpha)=32" or "mu=16@1:0".

        Without ends, t is the mapping itself: it runs from 0 to 1. Raises BadInput.

        >>> Axis.parse("roughness=32").title
        'sqrt(alpha), 32 nodes from alpha = 0 to 1, both ends included'
        >>> Axis.parse("sqrt(1-mu)=8", "centres").first
        1.0
        """
        found = ASKED.fullmatch(text.replace(" ", ""))
        if found is None:
            raise BadInput("axis", text, "must be MAPPING=SIZE or MAPPING=SIZE@FIRST:LAST, as in sqrt(alpha)=32 or mu=16@1:0")
        name, mapping = _understood(found["mapping"])
        size = _integer(found["size"])
        if not 2 <= size <= LARGEST:
            raise BadInput("axis", text, f"must have 2 to {LARGEST} nodes")
        if sampling not in SAMPLINGS:
            raise BadInput("sampling", sampling, f"must be one of {', '.join(SAMPLINGS)}")
        if found["first"] is None:
            if not {0.0, 1.0} <= set(_images(mapping)):
                raise BadInput("axis", text, f"must say from where to where {name} runs, as in {found['mapping']}={size}@0.01:1")
            first, last = map(float, MAPPINGS[mapping].inverse(UNIT))
        else:
            first, last = _number(found["first"]), _number(found["last"])
        return cls(name, mapping, size, first, last, sampling).checked(text)

    def checked(self, text: str) -> Axis:
        """This axis, if its mapping takes finite and different values at both ends. Raises BadInput."""
        with np.errstate(invalid="ignore", divide="ignore"):
            ends = self._ends
        if not (np.all(np.isfinite(ends)) and ends[0] != ends[1]):
            raise BadInput("axis", text, f"must run between different ends at which {self.label} is finite")
        return self

    @property
    def label(self) -> str:
        """The mapping as people write it.

        >>> Axis("mu", "sqrt(1-x)", 8).label
        'sqrt(1-mu)'
        """
        return self.mapping.replace("x", self.name)

    @property
    def title(self) -> str:
        """The axis in words."""
        where = "both ends included" if self.sampling == "endpoints" else "at the centres of texels"
        return f"{self.label}, {self.size} nodes from {self.name} = {self.first:g} to {self.last:g}, {where}"

    @property
    def _ends(self) -> Floats:
        return MAPPINGS[self.mapping].forward(np.array([self.first, self.last]))

    @property
    def coordinates(self) -> Floats:
        """The texture coordinates t of the nodes, shape (size,)."""
        index = np.arange(self.size) + self.shift
        return index / (self.size - 1) if self.sampling == "endpoints" else (index + 0.5) / self.size

    @property
    def nodes(self) -> Floats:
        """The values of the variable at the nodes, shape (size,); those of both ends exactly."""
        return self.values(self.coordinates)

    def values(self, t: Floats) -> Floats:
        """The variable at the texture coordinates t in [0, 1], any shape."""
        g = self._ends
        x = MAPPINGS[self.mapping].inverse(g[0] + (g[1] - g[0]) * t)
        return np.where(t == 0.0, self.first, np.where(t == 1.0, self.last, x))

    def texture(self, x: Floats) -> Floats:
        """The texture coordinates of values of the variable, any shape: what `values` turns back."""
        g = self._ends
        t: Floats = (MAPPINGS[self.mapping].forward(x) - g[0]) / (g[1] - g[0])
        return t

    def index(self, x: Floats) -> Floats:
        """The values of the variable as places among the nodes, from 0 to size - 1 and beyond the outermost centres."""
        t = self.texture(x)
        return (t * (self.size - 1) if self.sampling == "endpoints" else t * self.size - 0.5) - self.shift


def parse_axes(texts: Sequence[str], sampling: str = "endpoints") -> tuple[Axis, ...]:
    """One to three axes of different variables, the first varying slowest. Raises BadInput."""
    axes = tuple(Axis.parse(text, sampling) for text in texts)
    if not 1 <= len(axes) <= 3:
        raise BadInput("axis", list(texts), "give one to three axes")
    if len({axis.name for axis in axes}) < len(axes):
        raise BadInput("axis", list(texts), "must be of different variables")
    return axes


def _understood(text: str) -> tuple[str, str]:
    """The variable and the mapping with x for it. Raises BadInput."""
    text = ALIASES.get(text, text)
    for mapping in MAPPINGS:
        before, _, after = mapping.partition("x")
        name = text.removeprefix(before).removesuffix(after)
        if f"{before}{name}{after}" == text and name.isidentifier():
            return name, mapping
    known = ", ".join(mapping.replace("x", "NAME") for mapping in MAPPINGS)
    raise BadInput("axis", text, f"must be one of {known}, {' or '.join(ALIASES)}")


def _images(mapping: str) -> tuple[float, ...]:
    """The values of a mapping at 0 and at 1, where it has any."""
    with np.errstate(invalid="ignore", divide="ignore"):
        return tuple(map(float, MAPPINGS[mapping].forward(UNIT)))


def _number(text: str) -> float:
    try:
        return float(text)
    except ValueError:
        return math.nan


def _integer(text: str) -> int:
    try:
        return int(text)
    except ValueError:
        return 0
