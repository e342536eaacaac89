"""The command line: a thin door that parses, asks an analysis and prints.

Analyses are imported inside the commands: --help and list must not wait for numpy, numba and pandas.
"""

from __future__ import annotations

import inspect
import os
import shutil
import signal
import sys
import tempfile
import textwrap
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any, NoReturn

import click

from albedo_lab import __version__, catalogue
from albedo_lab.errors import BadInput, Inconclusive
from albedo_lab.files import write_whole
from albedo_lab.model import Choice, Claim, Count, File, GrazingAlbedo, Maximum, Model, Parameter
from albedo_lab.report.formats import KINDS, format_rows, format_table

if TYPE_CHECKING:
    import pandas as pd

THETA_DEG = (0.0, 15.0, 30.0, 45.0, 60.0, 75.0, 85.0, 89.0)
INTERRUPTED = 128 + signal.SIGINT
TRACEBACK = "ALBEDO_LAB_TRACEBACK"
"""Of the environment: whether an error that nobody foresaw is shown with its traceback."""
PICTURES = ("polar", "log-polar", "lobe", "albedo", "slice", "preview", "sampling")
UNREAD = 128 + 13
"""The status of a program whose reader went away (SIGPIPE): nothing failed, but not all was said."""


class OneLine(click.Group):
    """Turns whatever goes wrong into one line on standard error and the exit status that stands for it."""

    def main(self, *args: Any, **kwargs: Any) -> NoReturn:
        """Runs the command line and exits: 0 done, 1 a check failed, 2 bad input, 3 inconclusive, 130 interrupted."""
        try:
            status = super().main(*args, **(kwargs | {"standalone_mode": False}))
        except click.ClickException as error:
            status = fail(2, error.format_message())
        except (BadInput, OSError) as error:
            status = fail(2, str(error))
        except Inconclusive as error:
            status = fail(3, str(error))
        except (click.Abort, KeyboardInterrupt):
            status = INTERRUPTED
        except Exception as error:  # of somebody's own model far from its defaults, or a defect of ours
            if os.environ.get(TRACEBACK):
                raise
            status = fail(2, f"{type(error).__name__}: {error} ({TRACEBACK}=1 shows where)")
        sys.exit(status or 0)


def fail(status: int, message: str) -> int:
    """Says in one line what is wrong; hands the status on."""
    click.echo(f"albedo-lab: {' '.join(message.split())}", err=True)
    return status


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


def model_named(context: click.Context, option: click.Parameter, name: str) -> Model:
    """The model behind the argument."""
    return catalogue.find(name)


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


def writable(context: click.Context, option: click.Parameter, text: str | None) -> Path | None:
    """The file to write, tried out before anything is computed; links are followed, devices and folders refused."""
    if text is None or text == "-":
        return None
    path = Path(os.path.realpath(text))
    try:
        if not os.path.basename(text) or (path.exists() and not path.is_file()):
            raise IsADirectoryError(0, "a folder or a device")
        tempfile.NamedTemporaryFile(dir=path.parent, prefix=f".{path.name}.").close()
    except OSError as error:
        raise BadInput(option.name or "output", text, f"must be a file that can be written ({error.strerror})") from None
    return path


def report_file(context: click.Context, option: click.Parameter, text: str | None) -> Path | None:
    """A file beside the result: standard output is taken."""
    if text == "-":
        raise BadInput(option.name or "output", text, "must be a file; standard output carries the result")
    return writable(context, option, text)


def words(context: click.Context, option: click.Parameter, text: str | None) -> list[str]:
    """A comma-separated list of names; none where the option is not given."""
    return [] if text is None else [word.strip() for word in text.split(",")]


def probability(context: click.Context, option: click.Parameter, value: Any) -> float:
    """A level, which the analysis knows by another name than the command line."""
    if not isinstance(value, float) or not 0.0 < value < 1.0:
        raise BadInput(option.opts[0].lstrip("-"), value, "must be a probability above 0 and below 1")
    return value


def emit(text: str, output: Path | None) -> None:
    """The result, in UTF-8 whatever the terminal, to the file or to standard output."""
    if output is not None:
        write_whole(output, text)
        return
    try:
        click.echo(text.encode(), nl=False)
    except OSError as error:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())  # or the rest of the buffer fails again at exit
        if isinstance(error, BrokenPipeError):
            sys.exit(UNREAD)
        raise


@contextmanager
def progress_bar() -> Iterator[Callable[[int, int], None] | None]:
    """A bar on standard error; None where that is no terminal."""
    if not sys.stderr.isatty():
        yield None
        return
    with click.progressbar(length=1, file=sys.stderr) as bar:

        def advance(done: int, total: int) -> None:
            bar.length = total
            bar.update(done - bar.pos)

        yield advance


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
ESTIMATE = together(
    MODEL,
    PARAMETERS,
    click.option(
        "--tolerance",
        type=real,
        metavar="T",
        help="Half-width of the 95 % interval that every cell must reach. [default: 1e-5, relative for figures above 1]",
    ),
    click.option("--method", type=click.Choice(["rqmc", "mc", "quadrature"]), help="[default: rqmc; for normalise quadrature]"),
    SEED,
    THREADS,
    LAYOUT,
)


def bound(model: Model, parameters: dict[str, list[Any]]) -> tuple[Model, Any]:
    """The member of the model's family, and its parameters, that the first of all values stand for."""
    member, rest = model.member({name: values[0] for name, values in parameters.items() if name != "scale"})
    return member, member.bind(rest)


ELEVATIONS = together(
    click.option(
        "--theta-deg",
        type=reals,
        metavar="A,B,..",
        help=f"Angles from the normal, in degrees. [default: {','.join(f'{theta:g}' for theta in THETA_DEG)}]",
    ),
    click.option("--mu", type=reals, metavar="A,B,..", help="Their cosines instead: near grazing only these keep their digits."),
)


def answer(
    question: Callable[..., pd.DataFrame],
    model: Model,
    parameters: dict[str, list[Any]],
    kind: str,
    output: Path | None,
    **options: Any,
) -> None:
    """Asks an analysis about a model and prints what it says; an option that was not given has the analysis' own default."""
    bound(model, parameters)  # no option is a parameter
    with progress_bar() as progress:
        given = {name: value for name, value in options.items() if value is not None}
        frame = question(model, progress=progress, **given, **parameters)
    emit(format_table(frame, kind), output)


@click.group(cls=OneLine, no_args_is_help=False, context_settings={"help_option_names": ["-h", "--help"]})
@click.version_option(__version__, prog_name="albedo-lab")
def main() -> None:
    """Puts reflectance models (BRDFs) on trial, each figure with an honest error bar.

    Exit status: 0 done, 1 a check failed, 2 bad input, 3 inconclusive within the budget.
    """


@main.command("list")
@LAYOUT
def list_models(kind: str, output: Path | None) -> None:
    """The catalogue. Every model with its summary, and what installed packages offer."""
    rows = [(name, catalogue.find(name).summary) for name in catalogue.names()]
    rows += [(name, f"offered by {entry.value}") for name, entry in catalogue.offered().items()]
    emit(format_rows(["name", "summary"], rows, kind), output)


@main.command()
@MODEL
@PARAMETERS
def show(model: Model, parameters: dict[str, list[Any]]) -> None:
    """One model. Its formula, parameters with domains, source and claims; of a family the member that -p chooses."""
    member = model.member({name: values[0] for name, values in parameters.items()})[0]
    if parameters:
        bound(model, parameters)
    emit("\n".join(description(member)) + "\n", None)


@main.command()
@ESTIMATE
@ELEVATIONS
@click.option("--phi-deg", type=reals, metavar="A,B,..", help="Azimuths, in degrees, for anisotropic models. [default: 0]")
def albedo(mu: list[Any] | None, theta_deg: list[Any] | None, **options: Any) -> None:
    """Directional albedo. Which share of the light from one direction comes back."""
    from albedo_lab.analysis.albedo import albedo as question

    answer(question, mu=mu, theta_deg=theta_deg or (None if mu else list(THETA_DEG)), **options)


@main.command("mean-albedo")
@ESTIMATE
def mean_albedo(**options: Any) -> None:
    """Mean albedo. Which share of uniform light from the whole hemisphere comes back."""
    from albedo_lab.analysis.mean_albedo import mean_albedo as question

    answer(question, **options)


@main.command()
@ESTIMATE
def normalise(**options: Any) -> None:
    """The largest constant. What a model may carry before it creates energy."""
    from albedo_lab.analysis.normalise import normalise as question

    answer(question, **options)


@main.command()
@ESTIMATE
@ELEVATIONS
@click.option("--illuminant", type=click.Choice(["D65", "E"]), default="D65", show_default=True)
def colour(mu: list[Any] | None, theta_deg: list[Any] | None, **options: Any) -> None:
    """The albedo as a colour. XYZ and sRGB of what a metal reflects, from its albedo at several wavelengths."""
    from albedo_lab.analysis.colour import colour as question

    answer(question, mu=mu, theta_deg=theta_deg or (None if mu else list(THETA_DEG)), **options)


@main.command()
@MODEL
@PARAMETERS
@click.option("--phi-deg", type=reals, metavar="A,B,..", help="Azimuths, in degrees, for anisotropic models. [default: 0]")
@LAYOUT
def grazing(**options: Any) -> None:
    """Behaviour at grazing angles. Whether the albedo stays bounded, vanishes or diverges, and with which exponent."""
    from albedo_lab.analysis.grazing import grazing as question

    answer(question, **options)


@main.command()
@click.argument("models", nargs=-1, metavar="[MODEL]...")
@click.option("--all", "whole_catalogue", is_flag=True, help="Every model of the catalogue that needs no file.")
@PARAMETERS
@click.option(
    "--only",
    callback=words,
    metavar="A,B,..",
    help="Of finiteness, positivity, energy, reciprocity, grazing, sampler, claims, quality.",
)
@click.option("--skip", callback=words, metavar="A,B,..", help="Of the same.")
@click.option(
    "--alpha",
    "level",
    type=real,
    default=0.01,
    show_default=True,
    callback=probability,
    metavar="P",
    help="Probability that the run accuses a sound model.",
)
@click.option("--budget", type=whole, metavar="N", help="Evaluations that one check may cost. [default: 2^24]")
@click.option("--excess", type=real, default=1e-5, show_default=True, metavar="E", help="Forgiven above an albedo of 1.")
@SEED
@THREADS
@click.option("--json", "as_json", is_flag=True, help="A list of records instead of the table.")
@click.option("--junit", metavar="FILE", callback=report_file, help="JUnit XML as well, for a build server.")
@click.option("-o", "--output", metavar="FILE", callback=writable, help="Written whole, or not at all; - is standard output.")
def check(
    models: tuple[str, ...],
    whole_catalogue: bool,
    parameters: dict[str, list[Any]],
    as_json: bool,
    junit: Path | None,
    output: Path | None,
    **options: Any,
) -> int:
    """Plausibility. Energy, reciprocity, sampler and the rest, each with a verdict, and a witness where it convicts.

    Exit status: 0 plausible, 1 a check failed, 2 bad input, 3 inconclusive within the budget.
    """
    if bool(models) == whole_catalogue:
        raise BadInput("model", " ".join(models), "give the names of models, or --all")
    if junit is not None and junit == output:
        raise BadInput("junit", str(junit), "must be another file than the output")
    from albedo_lab.analysis.check import everyone, findings_table, run, short, status
    from albedo_lab.report.findings import findings_text
    from albedo_lab.report.junit import Case, junit_xml

    with progress_bar() as progress:
        told = run(models or everyone(), parameters, progress=progress, **options)
    cases = [Case(subject.model.name, short(subject, parameters), finding) for subject, finding in told]
    terminal = output is None and sys.stdout.isatty()
    if as_json:
        text = format_table(findings_table(told), "json")
    else:
        columns = shutil.get_terminal_size().columns if terminal else None
        text = findings_text(cases, terminal and not os.environ.get("NO_COLOR"), columns)
    if junit is not None:
        write_whole(junit, junit_xml(cases))
    emit(text, output)
    return status([finding for _, finding in told])


@main.command()
@MODEL
@PARAMETERS
@click.option(
    "-o", "--output", required=True, metavar="FILE", callback=writable, help="A .binary file; written whole or not at all."
)
def tabulate(model: Model, parameters: dict[str, list[Any]], output: Path | None) -> None:
    """A model as a table. Writes a file of the MERL format, for whatever reads measured surfaces.

    Three values of one parameter stand for red, green and blue.
    """
    from albedo_lab.analysis.tabulate import tabulate as write_table

    if output is None:
        raise BadInput("output", "-", "must be a file: a table is 35 MB of binary numbers")
    bound(model, parameters)
    with progress_bar() as progress:
        frame = write_table(model, output, progress=progress, **parameters)
    emit(format_table(frame, "table"), None)


@main.command()
@MODEL
@PARAMETERS
@click.option("--kind", type=click.Choice(PICTURES), default="polar", show_default=True)
@click.option("--theta-deg", type=reals, metavar="A,B,..", help="Where the light is, in degrees from the normal; for some kinds.")
@click.option("--quantity", type=click.Choice(["brdf", "radiance", "normalised"]), help="Of the polar kinds. [default: brdf]")
@click.option("--seed", type=whole, metavar="N", help="Of the kind sampling. [default: 0]")
@THREADS
@click.option("-o", "--output", required=True, metavar="FILE", callback=writable, help="Ends in .svg, .png or .pdf.")
def plot(
    model: Model,
    parameters: dict[str, list[Any]],
    kind: str,
    theta_deg: list[Any] | None,
    threads: int | None,
    output: Path | None,
    **options: Any,
) -> None:
    """A picture. Sections, lobes, albedo curves, slices, previews or samples, of all of a grid of parameters together."""
    form = output.suffix.lower().lstrip(".") if output is not None else "-"
    if output is None or form not in ("svg", "png", "pdf"):
        raise BadInput("output", str(output or "-"), "must be a file that ends in .svg, .png or .pdf")
    from albedo_lab.analysis.request import effort
    from albedo_lab.pictures.kinds import asked
    from albedo_lab.report.drawing import render

    bound(model, parameters)
    options |= {"theta_deg": theta_deg and tuple(theta_deg)}
    given = {name: value for name, value in options.items() if value is not None}
    effort(None, "rqmc", given.get("seed", 0), threads)  # refuses what is no seed and no number of threads
    picture = asked(kind, model, parameters, **given)
    write_whole(output, render(picture, picture.trace(threads), (form,))[form])


@main.command()
@click.argument("papers", nargs=-1, metavar="[PAPER]...")
@click.option("-o", "--output", type=click.Path(path_type=Path), default="reports", show_default=True, metavar="FOLDER")
@click.option("--timings", is_flag=True, help="Measure the times anew; without, those of the folder stay, if there are any.")
@SEED
@THREADS
def report(papers: tuple[str, ...], output: Path, timings: bool, seed: int, threads: int | None) -> None:
    """The audit of the papers. Recomputes what they print, in all of them by default, and judges each figure."""
    from albedo_lab.analysis.request import effort
    from albedo_lab.report.build import write_reports

    if timings and papers:
        raise BadInput("timings", " ".join(papers), "times are measured for all documents together: give none")
    processes = effort(None, "rqmc", seed, threads).threads
    with progress_bar() as progress:
        write_reports(output, papers, seed, threads, progress, timings, processes)


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
