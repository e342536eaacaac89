"""What an evaluation of a model costs: nanoseconds of compiled code, and the operations that it executes."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cache
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from albedo_lab.analysis.clock import Times, interleave, timed
from albedo_lab.analysis.operations import operations
from albedo_lab.analysis.request import grid, model_of
from albedo_lab.estimate.record import Question
from albedo_lab.estimate.sampling import incident
from albedo_lab.kernels.sampling import BLOCK, sampling_kernel
from albedo_lab.kernels.search import value_kernel
from albedo_lab.model import Model
from albedo_lab.optics.frame import Direction, bisector, length
from albedo_lab.optics.fresnel import conductor
from albedo_lab.optics.metals import PAPER_WAVELENGTHS, index

Array = NDArray[np.float64]
PAIRS = 4096
"""Directions that fit into the caches together with their values."""
ROUNDS = 21
METAL = "copper"
"""Whose index a reflectance at several wavelengths takes."""


@dataclass(frozen=True)
class Contender:
    """A model at its parameters (choices among them), and how it takes several wavelengths.

    `spectral` says what is done once for each wavelength: "nothing", where the shape is multiplied by as many reflectances;
    "fresnel", where a model without Fresnel term is multiplied by that of a metal; "all", where the model's own eta, k and
    wavelength (in units of the surface's lengths, which are micrometres) change.
    """

    model: str
    parameters: Mapping[str, Any]
    spectral: str = "nothing"

    @property
    def member(self) -> tuple[Model, Any]:
        """The member of the family, and its parameters."""
        ((member, p, _),) = grid(model_of(self.model), self.parameters)
        return member, p


class Pace(NamedTuple):
    """Nanoseconds of one evaluation of f and of one weighted sample: medians over the rounds, and the quartiles.

    NaN for the sample of a model that has no sampler.
    """

    evaluation: float
    evaluation_low: float
    evaluation_high: float
    sample: float
    sample_low: float
    sample_high: float


class Index(NamedTuple):
    """Refractive index of a metal."""

    eta: float
    k: float


def nanoseconds(times: Times, name: str) -> float:
    """Of one pair of directions: the median over the rounds."""
    return float(np.median(times[name])) / PAIRS * 1e9


@cache
def pairs() -> tuple[Array, Array]:
    """Lights and viewers, uniform over the hemisphere, none lower than a cosine of 0.05; (PAIRS, 3) each."""
    u = np.random.default_rng(0).random((2, 2, PAIRS))
    z, turn = 0.05 + 0.95 * u[0], 2.0 * np.pi * u[1]
    s = np.sqrt(1.0 - z * z)
    lights, viewers = np.stack([s * np.cos(turn), s * np.sin(turn), z], axis=-1)
    return np.ascontiguousarray(lights), np.ascontiguousarray(viewers)


def evaluation(contender: Contender) -> Callable[[], None]:
    """f of every pair at one wavelength."""
    return _filling(*contender.member)


def sampling(contender: Contender) -> Callable[[], None]:
    """PAIRS weighted samples for a viewer at 45 degrees: scrambled uniforms, a direction, f cos over its density, their mean."""
    member, p = contender.member
    kernel, values, moments = sampling_kernel(member, False, True), Question(member, p, None).values, np.zeros(3)
    keys = tuple(np.random.SeedSequence(0).generate_state(4))
    viewer = incident(np.sqrt(0.5), 0.0)
    return lambda: kernel(0, PAIRS // BLOCK, np.uint32(0), keys, values, viewer, moments)


def paces(names: Sequence[str], rounds: int = ROUNDS) -> dict[str, Pace]:
    """What models of the catalogue cost at their default parameters; all of them take turns."""
    models = {name: Contender(name, {}) for name in names}
    sampled = {name: contender for name, contender in models.items() if contender.member[0].sample is not None}
    evaluated = interleave({name: timed(evaluation(contender)) for name, contender in models.items()}, rounds)
    drawn = interleave({name: timed(sampling(contender)) for name, contender in sampled.items()}, rounds)
    return {name: Pace(*_quartiles(evaluated[name]), *_quartiles(drawn.get(name, [np.nan]))) for name in models}


def _quartiles(times: Sequence[float]) -> tuple[float, float, float]:
    """Median and both quartiles, in nanoseconds of one of PAIRS."""
    middle, low, high = np.quantile(times, (0.5, 0.25, 0.75)) / PAIRS * 1e9
    return float(middle), float(low), float(high)


def spectrum(contender: Contender) -> Callable[[], None]:
    """f of every pair at eight wavelengths, as cheaply as the model allows."""
    member, p = contender.member
    indices = [index(METAL, nm) for nm in PAPER_WAVELENGTHS]
    if contender.spectral == "all":
        waves = zip(PAPER_WAVELENGTHS, indices, strict=True)
        each = [_filling(member, p._replace(wavelength=nm * 1e-3, eta=eta, k=k)) for nm, (eta, k) in waves]
        return lambda: _all(each)
    shape = np.empty(PAIRS)
    values = np.empty((len(indices), PAIRS))
    once = _filling(member, p, shape)
    if contender.spectral == "fresnel":
        rows = [_filling(_reflectance(), Index(*at), values[i]) for i, at in enumerate(indices)]

        def reflected() -> None:
            once()
            _all(rows)
            np.multiply(values, shape, out=values)

        return reflected
    colours = np.linspace(0.1, 0.9, len(indices))

    def coloured() -> None:
        once()
        np.multiply.outer(colours, shape, out=values)

    return coloured


def _filling(model: Model, p: Any, f: Array | None = None) -> Callable[[], None]:
    kernel, values, filled = value_kernel(model), Question(model, p, None).values, np.empty(PAIRS) if f is None else f
    lights, viewers = pairs()
    return lambda: kernel(values, lights, viewers, filled)


def _all(works: Sequence[Callable[[], None]]) -> None:
    for work in works:
        work()


@cache
def _reflectance() -> Model:
    """Fresnel's factor alone, at the angle between the half-vector and either direction."""

    def evaluate(p: Index, wi: Direction, wo: Direction) -> float:
        return conductor(p.eta, p.k, 0.5 * length(bisector(wi, wo)))

    return replace(model_of("lambert"), name="reflectance", parameters_type=Index, evaluate=evaluate)


LIGHT, VIEWER = Direction(0.6, 0.0, 0.8), Direction(-0.48, 0.36, 0.8)
"""A pair off the mirror direction, where operations are counted."""


def operations_of(contender: Contender) -> Counter[str]:
    """Of one evaluation of a model, for one pair of directions."""
    member, p = contender.member
    return operations(member.evaluate, p, LIGHT, VIEWER)
