"""What a model is: its formula as plain functions, and the record from which everything else derives. Imports no numba."""

from __future__ import annotations

import math
import os
import sys
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
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
class Choice:
    """A parameter that is a word: it selects formulas, and with them which further parameters there are.

    One that is `swept` stands for all its options unless one is given, as the three channels of a measurement do.
    """

    name: str
    meaning: str
    options: tuple[str, ...]
    default: str
    swept: bool = False

    @property
    def domain(self) -> str:
        """The options as people write them."""
        return ", ".join(self.options)

    def parse(self, value: object) -> str:
        """The value as one of the options; True and False are yes and no. Raises BadInput."""
        word = {True: "yes", False: "no"}[value] if isinstance(value, bool) else value
        if word not in self.options:
            raise BadInput(self.name, value, f"must be one of {self.domain} ({self.meaning})")
        return str(word)


@dataclass(frozen=True)
class Count:
    """A parameter that counts the like parts of a formula, each with parameters of its own."""

    name: str
    meaning: str
    default: int
    low: int
    high: int
    swept = False

    @property
    def domain(self) -> str:
        """The domain as people write it."""
        return f"{self.low} to {self.high}"

    def parse(self, value: object) -> int:
        """The value as an integer of the domain. Raises BadInput."""
        number = value if isinstance(value, int | float) and not isinstance(value, bool) else math.nan
        if not self.low <= number <= self.high or number != int(number):
            raise BadInput(self.name, value, f"must be an integer in [{self.low}, {self.high}] ({self.meaning})")
        return int(number)


@dataclass(frozen=True)
class File:
    """A parameter that names a file of measurements; it has no default."""

    name: str
    meaning: str
    default: str = ""
    swept = False
    domain = "a path"

    def parse(self, value: object) -> str:
        """The path as text. Raises BadInput where none is given."""
        if not isinstance(value, str | os.PathLike) or not os.fspath(value):
            raise BadInput(self.name, value, f"must be the path of a file ({self.meaning})")
        return str(os.fspath(value))


@dataclass(frozen=True)
class Reference:
    """Where a formula stands, and how the implementation departs from it."""

    authors: str
    title: str
    year: int | None
    equation: str
    deviations: tuple[str, ...] = ()

    def __str__(self) -> str:
        year = f" ({self.year})" if self.year else ""
        return f"{self.authors}: {self.title}{year}, {self.equation}"


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


def no_mirror(p: Any, mu: float) -> float:
    """The Dirac part of a model that has none."""
    return 0.0


@dataclass(frozen=True, eq=False)
class Model:
    """A reflectance model: f_r = scale * evaluate, in 1/sr, without the cosine, and scale * mirror in the mirror direction.

    parameters_type
        NamedTuple class of what the functions below take as p: floats, and tables (`albedo_lab.tables`).
    `parameters`
        What a user gives, in the order of the table's columns.
    evaluate(p, wi, wo) -> float
        The shape, without the constant that the printed equation names.
    sample(p, wo, u1, u2) -> Direction
        wi for uniforms in (0, 1); below the horizon means rejected.
    pdf(p, wi, wo) -> float
        Density of `sample` per solid angle of wi above the horizon; integrates to 1 minus the rejected share.
    weight(p, wo, u1, u2) -> float
        Optional: evaluate * cos / pdf at the sample, reduced by hand; 0 for a rejected one. For an isotropic model it may
        count the azimuth from another axis than `sample` does.
    mirror(p, mu) -> float
        Reflectance of the Dirac part for light from that cosine: it comes on top of the integral of evaluate * cos.
    scale
        The constant's default: a function of p, or MAXIMUM where the source prescribes the maximum.
    paper_constant
        The maximum that the source prints for p, NaN where it prints none.
    complete(numbers) -> p
        Optional: p from the values of all parameters by name, where it holds constants derived from them. Without, a shorthand
        is left out, and a field of which no parameter bears the name keeps its default.
    parts(p) -> ((model, p), ...)
        Optional: the terms whose sum `evaluate` is, where no single set of coordinates makes all of them smooth. Quadrature
        integrates each in its own; of a part only parameters_type, evaluate and smooth_in count.
    mirror_limit
        (parameter, reflectance(p, mu)): as that parameter tends to 0 with mu fixed, the shape's lobe tends to an ideal mirror of
        this reflectance.
    width
        The parameter that says how wide the lobe is, where it is another than the first logarithmic one (see `analysis.spread`).
    positive
        Whether f is promised to be finite and not negative; measured data promise nothing.
    choices, make, chosen
        A model with choices is one of a family: make(**choices) gives the member, whose own choices are `chosen`.
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
    mirror: Callable[..., Any] = no_mirror
    scale: Callable[[Any], float] | Maximum = MAXIMUM
    scale_symbol: str = "scale"
    paper_constant: Callable[[Any], float] = lambda p: math.nan
    complete: Callable[[Mapping[str, float]], Any] | None = None
    smooth_in: Coordinates = PLAIN
    parts: Callable[[Any], tuple[tuple[Model, Any], ...]] | None = None
    isotropic: Callable[[Any], bool] = lambda p: True
    reciprocal: bool = True
    positive: bool = True
    mirror_limit: tuple[str, Callable[[Any, float], float]] | None = None
    width: str = ""
    claims: tuple[Claim, ...] = ()
    also: tuple[Reference, ...] = ()
    choices: tuple[Choice | Count | File, ...] = ()
    make: Callable[..., Model] | None = None
    chosen: Mapping[str, Any] = field(default_factory=dict)

    def __reduce__(self) -> tuple[Callable[..., Model], tuple[str, dict[str, Any]]]:
        """Pickled by its name and what was chosen, as lambdas cannot be: only a model of the catalogue can."""
        words = dict(self.chosen)
        if _of_catalogue(self.name, words) is not self:
            raise TypeError(f"{self.title} is not the model of that name in the catalogue: it cannot be pickled")
        return _of_catalogue, (self.name, words)

    @property
    def summary(self) -> str:
        """The first line of the module in which the formula stands."""
        return (sys.modules[(self.make or self.evaluate).__module__].__doc__ or "").strip().partition("\n")[0]

    def member(self, values: Mapping[str, object]) -> tuple[Model, dict[str, object]]:
        """The member of the family that the choices among the values select, and the values that are left.

        Raises BadInput for a choice outside its options.
        """
        known = {choice.name: choice for choice in self.choices}
        words = {name: known[name].parse(value) for name, value in values.items() if name in known}
        rest = {name: value for name, value in values.items() if name not in known}
        if self.make is None or all(self.chosen.get(name) == word for name, word in words.items()):
            return self, rest
        return self.make(**{**self.chosen, **words}), rest

    def bind(self, values: Mapping[str, object]) -> Any:
        """The parameters (no choices) as the named tuple that the model's functions take, defaults filled in.

        Raises BadInput for an unknown name or a value outside its domain.
        """
        known = {parameter.name: parameter for parameter in self.parameters}
        for name, value in values.items():
            if name not in known:
                names = [*(choice.name for choice in self.choices), *known, "scale"]
                raise BadInput(name, value, f"{self.title} has no such parameter; it takes {', '.join(names)}")
        numbers = {name: known[name].parse(value) for name, value in values.items()}
        for parameter in self.parameters:
            for name in parameter.sets:
                numbers.setdefault(name, numbers.get(parameter.name, known[name].default))
        numbers = {name: numbers.get(name, parameter.default) for name, parameter in known.items()}
        if self.complete is not None:
            return self.complete(numbers)
        return self.parameters_type(**{name: numbers[name] for name in self.parameters_type._fields if name in numbers})

    @property
    def title(self) -> str:
        """The name, and what was chosen, for messages."""
        words = ", ".join(f"{name} = {word}" for name, word in self.chosen.items())
        return f"{self.name} ({words})" if words else self.name

    def columns(self, p: Any) -> dict[str, Any]:
        """A value for every choice and every parameter, for a table; a shorthand is NaN where what it sets differs."""
        row: dict[str, Any] = dict(self.chosen)
        for parameter in self.parameters:
            values = {getattr(p, name) for name in parameter.sets or (parameter.name,)}
            row[parameter.name] = values.pop() if len(values) == 1 else math.nan
        return row


def _of_catalogue(name: str, chosen: Mapping[str, Any]) -> Model:
    from albedo_lab.catalogue import find

    return find(name).member(chosen)[0]
