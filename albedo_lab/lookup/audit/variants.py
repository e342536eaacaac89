"""What a table of unknown origin may hold: models with one roughness, and the quantities that people tabulate of them."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field

from albedo_lab import catalogue
from albedo_lab.analysis.request import Effort
from albedo_lab.errors import BadInput
from albedo_lab.lookup.source import F0, QUANTITIES, Source
from albedo_lab.model import Choice, Model

Fixed = tuple[tuple[str, object], ...]
SPLIT = ("split-sum", "split-sum-total")


@dataclass(frozen=True)
class Variant:
    """A model whose parameters are fixed but for those that run along axes.

    `white` fixes what makes its facets reflect all, `dark` what makes Schlick's reflectance 0 at normal incidence; None where the
    model has no such.
    """

    model: Model
    white: Fixed
    dark: Fixed | None
    title: str = field(compare=False)

    def source(self, field: str, want: Effort, order: str, phi: float) -> Source | None:
        """What a field of a form is computed from; None where there is no such."""
        fixed = self.dark if field == "dark" else self.white
        quantity = {"white": "albedo", "dark": "albedo", "mean": "mean-albedo"}.get(field, field)
        return None if fixed is None else Source(self.model, quantity, want, fixed, order, phi)


@dataclass(frozen=True)
class Form:
    """A quantity as sums of fields: for each channel a constant, and a factor for every field."""

    quantity: str
    title: str
    channels: tuple[tuple[str, float, tuple[tuple[str, float], ...]], ...]
    swapped: bool = False

    @property
    def fields(self) -> set[str]:
        """What has to be computed."""
        return {field for _, _, factors in self.channels for field, _ in factors}


ALBEDO = ("albedo", 0.0, (("white", 1.0),))
LOSS = ("1 - E", 1.0, (("white", -1.0),))
SCALE = ("scale", 0.0, (("white", 1.0), ("dark", -1.0)))
BIAS = ("bias", 0.0, (("dark", 1.0),))
MEAN = ("mean albedo", 0.0, (("mean", 1.0),))
MEAN_LOSS = ("1 - mean albedo", 1.0, (("mean", -1.0),))
CONSTANT = ("constant", 0.0, (("constant", 1.0),))
DIRECTIONAL = (Form("albedo", "albedo E", (ALBEDO,)), Form("energy-loss", "1 - E", (LOSS,)))
ALONE = (Form("scale", "scale of the split sum alone", (SCALE,)), Form("bias", "bias of the split sum alone", (BIAS,)))
PAIRS = (
    Form("split-sum", "split sum (scale, bias)", (SCALE, BIAS)),
    Form("split-sum", "split sum (bias, scale)", (BIAS, SCALE), swapped=True),
    Form("split-sum-total", "split sum (bias, total)", (BIAS, ALBEDO)),
    Form("split-sum-total", "split sum (total, bias)", (ALBEDO, BIAS), swapped=True),
)
MEANS = (Form("mean-albedo", "mean albedo", (MEAN,)), Form("mean-energy-loss", "1 - mean albedo", (MEAN_LOSS,)))
CONSTANTS = (Form("constant", "largest constant", (CONSTANT,)),)


def forms(channels: int, directional: bool, quantity: str | None) -> tuple[Form, ...]:
    """The forms that a table with so many channels may have; `quantity` is what it is expected to hold, where that is known."""
    if quantity == "constant":
        return CONSTANTS
    if not directional:
        return MEANS if channels == 1 else ()
    return {1: DIRECTIONAL, 2: PAIRS}.get(channels, ())


def usual() -> tuple[Variant, ...]:
    """The models that tables are made of, before those that few people use."""
    return (
        *(_facets(name, G) for name in ("ggx", "beckmann") if name in catalogue.names() for G in ("smith_correlated", "smith")),
    )


def unusual() -> tuple[Variant, ...]:
    """Those that few people use."""
    model = catalogue.find("microfacet")
    words = {"none": "no masking", "v_cavity": "V-cavities", "schlick": "Schlick's masking"}
    return tuple(_of_facets(model, (("D", "ggx"), ("G", G)), f"ggx, {word}") for G, word in words.items())


def _facets(name: str, G: str) -> Variant:
    word = {"smith": "separable Smith", "smith_correlated": "height-correlated Smith"}[G]
    return _of_facets(catalogue.find(name), (("G", G),), f"{name}, {word}")


def _of_facets(model: Model, fixed: Fixed, title: str) -> Variant:
    return Variant(model, fixed, (*fixed, ("F", "schlick"), (F0, 0.0)), title)


def variant_of(model: Model, fixed: Mapping[str, object], quantity: str) -> Variant:
    """The variant that somebody named; of the usual ones, the one that it is."""
    given = tuple(fixed.items())
    member = model.member({name: value for name, value in fixed.items() if name != "scale"})[0]
    words = member.chosen
    for known in usual():
        same = known.model.name == model.name and dict(known.white).get("G") == words.get("G")
        white = words.get("F") == "one" or (words.get("F") == "schlick" and (quantity in SPLIT or fixed.get(F0) == 1.0))
        if same and white and set(fixed) <= {"G", "F", F0, "sampling"} and fixed.get(F0, 1.0) == 1.0:
            return known
    title = ", ".join([model.name, *(f"{name} = {value}" for name, value in given)])
    if quantity in SPLIT:
        return Variant(model, (*given, (F0, 1.0)), (*given, (F0, 0.0)), title)
    return Variant(model, given, None, title)


def siblings(variant: Variant) -> Iterator[Variant]:
    """The variants of a named model that differ in one word."""
    member = variant.model.member({name: value for name, value in variant.white if name != "scale"})[0]
    for choice in member.choices:
        if not isinstance(choice, Choice) or choice.name in ("F", "sampling"):
            continue
        for word in choice.options:
            if word == member.chosen.get(choice.name):
                continue
            white, dark = (None if f is None else _with(f, choice.name, word) for f in (variant.white, variant.dark))
            assert white is not None
            if _binds(variant.model, white):
                yield Variant(variant.model, white, dark, f"{variant.model.name}, {choice.name} = {word}")


def _with(fixed: Fixed, name: str, word: str) -> Fixed:
    held = tuple((other, word if other == name else value) for other, value in fixed)
    return held if name in dict(fixed) else (*held, (name, word))


def _binds(model: Model, fixed: Fixed) -> bool:
    """Whether a member takes these parameters."""
    try:
        member, numbers = model.member({name: value for name, value in fixed if name != "scale"})
        member.bind(numbers)
    except BadInput:
        return False
    return True


def directional(quantity: str) -> bool:
    """Whether a quantity depends on the direction."""
    return quantity in QUANTITIES and QUANTITIES[quantity].directional
