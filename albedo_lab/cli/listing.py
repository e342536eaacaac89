"""Commands that say what there is: the catalogue, and the record of one model."""

from __future__ import annotations

import inspect
import textwrap
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import click

from albedo_lab import catalogue
from albedo_lab.cli.options import LAYOUT, MODEL, PARAMETERS, bound
from albedo_lab.cli.output import emit
from albedo_lab.errors import BadInput
from albedo_lab.model import Choice, Claim, Count, File, GrazingAlbedo, Maximum, Model, Parameter
from albedo_lab.report.formats import format_rows


@click.command("list")
@LAYOUT
def list_models(kind: str, output: Path | None) -> None:
    """The catalogue. Every model with its summary, and what installed packages offer."""
    rows = [(name, catalogue.find(name).summary) for name in catalogue.names()]
    rows += [(name, f"offered by {entry.value}") for name, entry in catalogue.offered().items()]
    emit(format_rows(["name", "summary"], rows, kind), output)


@click.command()
@MODEL
@PARAMETERS
def show(model: Model, parameters: dict[str, list[Any]]) -> None:
    """One model. Its formula, parameters with domains, source and claims; of a family the member that -p chooses."""
    member = model.member({name: values[0] for name, values in parameters.items()})[0]
    if parameters:
        bound(model, parameters)
    emit("\n".join(description(member)) + "\n", None)


def description(model: Model) -> Iterator[str]:
    """A model's record, as lines for a person."""
    references = (model.source, *model.also)
    scale = "the largest constant that energy balance allows, computed"
    if not isinstance(model.scale, Maximum):
        scale = f"{defaults(model, model.scale)} for the default parameters"
    yield from (model.name, model.summary, "")
    yield from entries(
        ("f_r", model.formula),
        ("scale", f"{model.scale_symbol}; default: {scale}"),
        ("reciprocal", "yes" if model.reciprocal else "no: albedos are given for both orders of integration"),
        ("smooth", "term by term" if model.parts else f"in polar angles about the {model.smooth_in.axis.name.lower()} vector"),
        *(("source", str(reference)) for reference in references),
        *(("deviation", deviation) for reference in references for deviation in reference.deviations),
    )
    if model.choices:
        yield from ("", "choices")
        yield from entries(*((choice.name, selection(choice, model.chosen.get(choice.name))) for choice in model.choices))
    yield from ("", "parameters") if model.parameters else ()
    yield from entries(*((parameter.name, meaning(parameter)) for parameter in model.parameters))
    yield from ("", "claims") if model.claims else ()
    yield from entries(*((claim.place, statement(claim, model)) for claim in model.claims))


def defaults(model: Model, figure: Callable[[Any], float]) -> str:
    """A figure for the default parameters; of a measurement nothing is known without its file."""
    try:
        return f"{figure(model.bind({})):g}"
    except BadInput:
        return "unknown"


def selection(choice: Choice | Count | File, chosen: object) -> str:
    """What a choice selects, its options, and what is chosen here."""
    default = f", default {choice.default}" if choice.default else ""
    every = "; all of them unless one is given" if choice.swept else ""
    other = f"; here {chosen}" if chosen != choice.default else ""
    return f"{choice.meaning}; {choice.domain}{default}{every}{other}"


def meaning(parameter: Parameter) -> str:
    """What a parameter is, and which values it takes."""
    unit = f" {parameter.unit}" if parameter.unit else ""
    sets = f"; sets {' and '.join(parameter.sets)}" if parameter.sets else ""
    return f"{parameter.meaning}; in {parameter.domain}{unit}, default {parameter.default:g}{unit}{sets}"


def statement(claim: Claim, model: Model) -> str:
    """What the authors say of their model."""
    where = f"where {claim.where}: " if claim.where else ""
    value = f" value(p) = {defaults(model, claim.value)} for the default parameters." if isinstance(claim, GrazingAlbedo) else ""
    return f"{where}{inspect.getdoc(claim)}{value}"


def entries(*pairs: tuple[str, str]) -> Iterator[str]:
    """Names, and their texts wrapped beside them."""
    width = max((len(name) for name, _ in pairs), default=0) + 4
    for name, text in pairs:
        yield from textwrap.wrap(text, 110, initial_indent=f"  {name}".ljust(width), subsequent_indent=" " * width)
