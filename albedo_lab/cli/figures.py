"""Commands whose answer is a table of figures, each with its error: albedos, constants, colours, exponents."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from albedo_lab.cli.options import LAYOUT, MODEL, PARAMETERS, SEED, THREADS, bound, given, real, reals, together
from albedo_lab.cli.output import emit, progress_bar
from albedo_lab.model import Model
from albedo_lab.report.formats import format_table

if TYPE_CHECKING:
    import pandas as pd

THETA_DEG = (0.0, 15.0, 30.0, 45.0, 60.0, 75.0, 85.0, 89.0)
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
    """Asks an analysis about a model and prints what it says."""
    bound(model, parameters)  # no option is a parameter
    with progress_bar() as progress:
        frame = question(model, progress=progress, **given(options), **parameters)
    emit(format_table(frame, kind), output)


@click.command()
@ESTIMATE
@ELEVATIONS
@click.option("--phi-deg", type=reals, metavar="A,B,..", help="Azimuths, in degrees, for anisotropic models. [default: 0]")
def albedo(mu: list[Any] | None, theta_deg: list[Any] | None, **options: Any) -> None:
    """Directional albedo. Which share of the light from one direction comes back."""
    from albedo_lab.analysis.albedo import albedo as question

    answer(question, mu=mu, theta_deg=theta_deg or (None if mu else list(THETA_DEG)), **options)


@click.command("mean-albedo")
@ESTIMATE
def mean_albedo(**options: Any) -> None:
    """Mean albedo. Which share of uniform light from the whole hemisphere comes back."""
    from albedo_lab.analysis.mean_albedo import mean_albedo as question

    answer(question, **options)


@click.command()
@ESTIMATE
def normalise(**options: Any) -> None:
    """The largest constant. What a model may carry before it creates energy."""
    from albedo_lab.analysis.normalise import normalise as question

    answer(question, **options)


@click.command()
@ESTIMATE
@ELEVATIONS
@click.option("--illuminant", type=click.Choice(["D65", "E"]), default="D65", show_default=True)
def colour(mu: list[Any] | None, theta_deg: list[Any] | None, **options: Any) -> None:
    """The albedo as a colour. XYZ and sRGB of what a metal reflects, from its albedo at several wavelengths."""
    from albedo_lab.analysis.colour import colour as question

    answer(question, mu=mu, theta_deg=theta_deg or (None if mu else list(THETA_DEG)), **options)


@click.command()
@MODEL
@PARAMETERS
@click.option("--phi-deg", type=reals, metavar="A,B,..", help="Azimuths, in degrees, for anisotropic models. [default: 0]")
@LAYOUT
def grazing(**options: Any) -> None:
    """Behaviour at grazing angles. Whether the albedo stays bounded, vanishes or diverges, and with which exponent."""
    from albedo_lab.analysis.grazing import grazing as question

    answer(question, **options)
