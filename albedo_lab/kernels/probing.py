"""Templates that try out whether somebody else's functions compile, and what they return."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from numba import types

from albedo_lab.kernels.jit import Placeholder, specialise
from albedo_lab.model import Model
from albedo_lab.optics.frame import Direction

Pair = tuple[tuple[float, ...], tuple[float, ...]]

Parameters = Placeholder("Parameters")
evaluate = Placeholder("evaluate")
sample = Placeholder("sample")
pdf = Placeholder("pdf")


def probe_evaluate(values, a, b):
    """f of one pair (wi, wo)."""
    return evaluate(Parameters(*values), Direction(a[0], a[1], a[2]), Direction(b[0], b[1], b[2]))


def probe_sampler(values, a, b):
    """The density of one sample for wo = b."""
    p = Parameters(*values)
    wo = Direction(b[0], b[1], b[2])
    wi = sample(p, wo, 0.4, 0.7)
    return pdf(p, Direction(wi.x, wi.y, wi.z), wo)


def probed(model: Model, values: tuple[Any, ...], pairs: Iterable[Pair]) -> list[float]:
    """f of every pair, by compiled code. Raises what numba raises, for the sampler as well, and TypeError for no numbers."""
    several = [(tuple(wi), tuple(wo)) for wi, wo in pairs]
    if model.sample is not None and model.pdf is not None:
        density = specialise(probe_sampler, Parameters=model.parameters_type, sample=model.sample, pdf=model.pdf)
        _run(density, values, several[:1])
    return _run(specialise(probe_evaluate, Parameters=model.parameters_type, evaluate=model.evaluate), values, several)


def _run(kernel: Any, values: tuple[Any, ...], pairs: list[Pair]) -> list[float]:
    found = [kernel(values, wi, wo) for wi, wo in pairs]
    for signature in kernel.nopython_signatures:
        if not isinstance(signature.return_type, types.Float | types.Integer):
            raise TypeError(f"it may return another thing than a number, compiled as {signature.return_type}")
    return found
