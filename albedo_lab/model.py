"""What a model is: its formula as plain functions, and the record from which everything else derives. Imports no numba."""

from __future__ import annotations

import math
import sys
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

from albedo_lab.errors import BadInput
from albedo_lab.optics.coordinates import PLAIN, Coordinates


@dataclass(frozen=True)
class Parameter:
    """A parameter and its closed domain [low, high].

    `scale` ("linear" or "log") says how a sweep should step through it; `unit` is empty for pure numbers. A parameter that
    `sets` others is a shorthand: it gives its value to those of them that are not given themselves.
    """

    name: str
    meaning: str
    default: float
    low: float
    high: float
    scale: str = "linear"
    unit: str = ""
    sets: tuple[str, ...] = ()

    @property
    def domain(self) -> str:
        """The domain as people write it."""
        return f"[{self.low:g}, {self.high:g}]"

    def parse(self, value: object) -> float:
        """The value as a number of the domain.

        Raises BadInput for anything that is not a finite number inside the domain.
        """
        try:
            number = float(value)  # type: ignore[arg-type]
        except (TypeError, ValueError):
            number = math.nan
        if isinstance(value, bool) or not self.low <= number <= self.high or math.isinf(number):
            raise BadInput(self.name, value, f"must be a number in {self.domain} ({self.meaning})")
        return number


@dataclass(frozen=True)
class Reference:
    """Where a formula stands, and how the implementation departs from it."""

    authors: str
    title: str
    year: int | None
    equation: str
    deviations: tuple[str, ...] = ()


@dataclass(frozen=True)
class Claim:
    """Something that the authors say of their model: where they say it, and for which parameters."""

    place: str
    where: str = ""


class Reciprocal(Claim):
    """f(wi, wo) = f(wo, wi)."""


class EnergyConserving(Claim):
    """The albedo of the model with its default constant is nowhere above 1."""


class DivergesAtGrazing(Claim):
    """The albedo grows without bound as mu -> 0."""


@dataclass(frozen=True)
class GrazingAlbedo(Claim):
    """The albedo with the default constant tends to `value(p)` as mu -> 0."""

    value: Callable[[Any], float] = lambda p: math.nan


class Maximum:
    """The scale of a model whose source prescribes the largest constant that energy balance allows."""

    def __repr__(self) -> str:
        return "computed maximum"


MAXIMUM = Maximum()


@dataclass(frozen=True)
class Model:
    """A reflectance model: f_r = scale * evaluate, in 1/sr, without the cosine.

    parameters_type
        NamedTuple class of the parameters, in the order of `parameters`.
    evaluate(p, wi, wo) -> float
        The shape, without the constant that the printed equation names.
    sample(p, wo, u1, u2) -> Direction
        wi for uniforms in (0, 1); below the horizon means rejected.
    pdf(p, wi, wo) -> float
        Density of `sample` per solid angle of wi above the horizon; integrates to 1 minus the rejected share.
    weight(p, wo, u1, u2) -> float
        Optional: evaluate * cos / pdf at the sample, reduced by hand; 0 for a rejected one. For an isotropic model it may
        count the azimuth from another axis than `sample` does.
    scale
        The constant's default: a function of p, or MAXIMUM where the source prescribes the maximum.
    paper_constant
        The maximum that the source prints for p, NaN where it prints none.
    """

    name: str
    formula: str
    parameters_type: Any
    parameters: tuple[Parameter, ...]
    evaluate: Callable[..., Any]
    source: Reference
    sample: Callable[..., Any] | None = None
    pdf: Callable[..., Any] | None = None
    weight: Callable[..., Any] | None = None
    scale: Callable[[Any], float] | Maximum = MAXIMUM
    scale_symbol: str = "scale"
    paper_constant: Callable[[Any], float] = lambda p: math.nan
    smooth_in: Coordinates = PLAIN
    isotropic: Callable[[Any], bool] = lambda p: True
    reciprocal: bool = True
    claims: tuple[Claim, ...] = ()
    also: tuple[Reference, ...] = ()

    @property
    def summary(self) -> str:
        """The first line of the module in which the formula stands."""
        return (sys.modules[self.evaluate.__module__].__doc__ or "").strip().partition("\n")[0]

    def bind(self, values: Mapping[str, object]) -> Any:
        """The parameters as the model's named tuple, defaults filled in.

        Raises BadInput for an unknown name or a value outside its domain.
        """
        known = {parameter.name: parameter for parameter in self.parameters}
        for name, value in values.items():
            if name not in known:
                raise BadInput(name, value, f"{self.name} has no such parameter; it takes {', '.join([*known, 'scale'])}")
        numbers = {name: known[name].parse(value) for name, value in values.items()}
        for parameter in self.parameters:
            for name in parameter.sets:
                numbers.setdefault(name, numbers.get(parameter.name, known[name].default))
        return self.parameters_type(**{name: numbers.get(name, known[name].default) for name in self.parameters_type._fields})

    def columns(self, p: Any) -> dict[str, float]:
        """A value for every parameter, for a table; a shorthand is NaN where what it sets differs."""
        row = {}
        for parameter in self.parameters:
            values = {getattr(p, name) for name in parameter.sets or (parameter.name,)}
            row[parameter.name] = values.pop() if len(values) == 1 else math.nan
        return row
