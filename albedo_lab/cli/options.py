"""What goes in: the arguments and options that several commands share, and how their texts are read."""

from __future__ import annotations

import inspect
import os
import re
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

import click

from albedo_lab import catalogue
from albedo_lab.errors import BadInput
from albedo_lab.files import try_out
from albedo_lab.model import Model
from albedo_lab.report.formats import KINDS


def parsed(kind: Callable[[str], float]) -> Callable[[Any], Any]:
    """A converter that leaves what is no number as it is: the analysis knows the domain, and says so."""

    def convert(text: Any) -> Any:
        try:
            return kind(text)
        except ValueError:
            return text

    return convert


real, whole = parsed(float), parsed(int)


def reals(text: str) -> list[Any]:
    """A comma-separated list; an empty element stays, and is refused as a value outside its domain."""
    return [real(item) for item in text.split(",")]


def sizes(text: str) -> list[Any]:
    """How many nodes each axis has, as in 32x32; what is no number stays, and is refused by what knows the shape."""
    return [whole(item) for item in re.split("[x,]", text)]


def model_named(context: click.Context, option: click.Parameter, name: str | None) -> Model | None:
    """The model behind the argument; None where it may be left out, and is."""
    return None if name is None else catalogue.find(name)


def table_or_model(context: click.Context, option: click.Parameter, text: str | None) -> Path | Model | None:
    """The file of a table, where the name is that of a file or looks like one, else the model behind it."""
    if text is None or text.endswith(".binary") or not (path := Path(text)).suffix or (":" in text and not path.is_file()):
        return model_named(context, option, text)
    return path


def assigned(context: click.Context, option: click.Parameter, assignments: Sequence[str]) -> dict[str, list[Any]]:
    """The values of every parameter, in the order given."""
    values: dict[str, list[Any]] = {}
    for assignment in assignments:
        name, equals, several = assignment.partition("=")
        if not (name and equals):
            raise BadInput("parameter", assignment, "must be NAME=VALUE[,VALUE...]")
        if name in values:
            raise BadInput(name, several, "is given twice; several values make one list, NAME=VALUE,VALUE")
        values[name] = reals(several)
    return values


def single(context: click.Context, option: click.Parameter, assignments: Sequence[str]) -> dict[str, Any]:
    """The one value of every parameter."""
    values = assigned(context, option, assignments)
    for name, several in values.items():
        if len(several) != 1:
            raise BadInput(name, several, "takes one value here; what varies in a table runs along an --axis")
    return {name: value for name, (value,) in values.items()}


def writable(context: click.Context, option: click.Parameter, text: str | None) -> Path | None:
    """The file to write, tried out before anything is computed; links are followed, devices and folders refused."""
    if text is None or text == "-":
        return None
    try:
        path = Path(os.path.realpath(text))
        if not os.path.basename(text):
            raise IsADirectoryError(0, "a folder or a device")
        try_out(path)
    except (OSError, ValueError) as error:  # the latter for a null character
        reason = error.strerror if isinstance(error, OSError) else error
        raise BadInput(option.name or "output", text, f"must be a file that can be written ({reason})") from None
    return path


def report_file(context: click.Context, option: click.Parameter, text: str | None) -> Path | None:
    """A file beside the result: standard output is taken."""
    if text == "-":
        raise BadInput(option.name or "output", text, "must be a file; standard output carries the result")
    return writable(context, option, text)


def picture_file(context: click.Context, option: click.Parameter, text: str | None) -> Path | None:
    """A file for a picture, whose suffix says in which form."""
    path = writable(context, option, text)
    if text is not None and (path is None or suffix(path) not in ("svg", "png", "pdf")):
        raise BadInput(option.name or "output", text, "must be a file that ends in .svg, .png or .pdf")
    return path


def suffix(path: Path) -> str:
    """What a file's name ends in, without the dot, in small letters."""
    return path.suffix.lower().lstrip(".")


def words(context: click.Context, option: click.Parameter, text: str | None) -> list[str]:
    """A comma-separated list of names; none where the option is not given."""
    return [] if text is None else [word.strip() for word in text.split(",")]


def probability(context: click.Context, option: click.Parameter, value: Any) -> float:
    """A level, which the analysis knows by another name than the command line."""
    if not isinstance(value, float) or not 0.0 < value < 1.0:
        raise BadInput(option.opts[0].lstrip("-"), value, "must be a probability above 0 and below 1")
    return value


def together(*options: Callable[[Any], Any]) -> Callable[[Any], Any]:
    """Several options as one decorator, in the order of the help text."""

    def decorate(command: Any) -> Any:
        for option in reversed(options):
            command = option(command)
        return command

    return decorate


MODEL = click.argument("model", callback=model_named)
PARAMETERS = click.option(
    "-p",
    "--parameter",
    "parameters",
    multiple=True,
    callback=assigned,
    metavar="NAME=VALUE[,VALUE...]",
    help="Of the model, or its scale. Several values make a grid, the first parameter varying slowest.",
)
SEED = click.option("--seed", type=whole, default=0, show_default=True, metavar="N", help="Of the random numbers.")
THREADS = click.option("--threads", type=whole, metavar="N", help="[default: as many as there are processors at hand]")
LAYOUT = together(
    click.option("--format", "kind", type=click.Choice(list(KINDS)), default="table", show_default=True),
    click.option("-o", "--output", metavar="FILE", callback=writable, help="Written whole, or not at all; - is standard output."),
)
QUANTITIES = ("albedo", "mean-albedo", "constant", "split-sum", "split-sum-total", "energy-loss", "mean-energy-loss")
FORMATS = ("npz", "npy", "csv", "json", "c", "glsl", "exr", "u16", "png")
PRESETS = ("cycles", "kulla-conty", "filament-dfg", "filament-dfg-multiscatter", "materialx", "openpbr")
TABLE = together(
    click.option(
        "-p",
        "--parameter",
        "parameters",
        multiple=True,
        callback=single,
        metavar="NAME=VALUE",
        help="Of the model, or its scale: what runs along no axis.",
    ),
    click.option("--preset", type=click.Choice(PRESETS), help="A layout that a renderer reads; what else is given goes first."),
    click.option(
        "--axis",
        "axes",
        multiple=True,
        metavar="MAPPING=SIZE[@FIRST:LAST]",
        help="As in roughness=32, sqrt(1-mu)=16 or n=8@1:100. One to three, the first varying slowest.",
    ),
    click.option("--sampling", type=click.Choice(["endpoints", "centres"]), help="Where the nodes stand. [default: endpoints]"),
)
CELLS = together(
    click.option("--tolerance", type=real, metavar="T", help="Half-width of the interval of every cell. [default: 1e-6]"),
    click.option("--method", type=click.Choice(["rqmc", "mc", "quadrature"]), help="[default: quadrature]"),
    click.option("--phi-deg", type=real, metavar="A", help="Azimuth, in degrees, for anisotropic models. [default: 0]"),
    SEED,
    THREADS,
)
QUANTITY = click.option("--quantity", type=click.Choice(QUANTITIES), help="[default: albedo; for audit what fits]")
FILE_FORMAT = click.option("--format", type=click.Choice(FORMATS), help="Of the file. [default: by its suffix]")


def given(options: Mapping[str, Any]) -> dict[str, Any]:
    """The options that were given; any other has the analysis' own default."""
    return {name: value for name, value in options.items() if value is not None}


def unmistaken(question: Callable[..., Any], parameters: Mapping[str, Any]) -> Mapping[str, Any]:
    """The parameters, if none of them has the name of an option of what is asked."""
    for name, value in parameters.items():
        if name in inspect.signature(question).parameters:
            raise BadInput(name, value, "is the name of an option; no parameter of a model can be given under it here")
    return parameters


def bound(model: Model, parameters: dict[str, list[Any]]) -> tuple[Model, Any]:
    """The member of the model's family, and its parameters, that the first of all values stand for."""
    member, rest = model.member({name: values[0] for name, values in parameters.items() if name != "scale"})
    return member, member.bind(rest)
