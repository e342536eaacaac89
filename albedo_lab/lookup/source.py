"""What fills a table: a quantity of a model as a function of the variables of its axes, each value with its error."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from functools import lru_cache
from typing import Any

import numpy as np

from albedo_lab.analysis.albedo import SMALLEST_MU, shape_estimate
from albedo_lab.analysis.constant import constant, largest_constant
from albedo_lab.analysis.grazing import law
from albedo_lab.analysis.request import SCALE, Effort
from albedo_lab.analysis.rows import conclude, label
from albedo_lab.analysis.supremum import supremum
from albedo_lab.analysis.verdict import Subject
from albedo_lab.errors import BadInput
from albedo_lab.estimate.record import Estimate, Question, bounded, exact
from albedo_lab.model import Model

Found = tuple[Estimate, ...]
"""One figure a channel."""
MU = "mu"
F0 = "F0"
GAUSS_X, GAUSS_W = np.polynomial.legendre.leggauss(64)


@dataclass(frozen=True)
class Quantity:
    """What a table may hold: the names of its channels, whether it depends on the direction, its meaning, and its mean's name."""

    channels: tuple[str, ...]
    directional: bool
    meaning: str
    mean: str | None = None


QUANTITIES = {
    "albedo": Quantity(("albedo",), True, "directional albedo E(mu)", "mean-albedo"),
    "mean-albedo": Quantity(("mean_albedo",), False, "mean albedo 2 ∫ E(mu) mu dmu"),
    "constant": Quantity(("constant",), False, "the largest constant that keeps the albedo at or below 1"),
    "split-sum": Quantity(("scale", "bias"), True, "E = scale F0 + bias, for Schlick's Fresnel reflectance"),
    "split-sum-total": Quantity(("bias", "total"), True, "E = (1 - F0) bias + F0 total, for Schlick's Fresnel reflectance"),
    "energy-loss": Quantity(("energy_loss",), True, "1 - E(mu)", "mean-energy-loss"),
    "mean-energy-loss": Quantity(("mean_energy_loss",), False, "1 - 2 ∫ E(mu) mu dmu"),
}
LOSSES = ("energy-loss", "mean-energy-loss")


@dataclass(frozen=True)
class Source:
    """A quantity of a model, its other parameters `fixed`, to the precision that `want` asks for.

    `order` is that of the integration, `phi` the azimuth of incidence in radians (of anisotropic models).
    """

    model: Model
    quantity: str
    want: Effort
    fixed: tuple[tuple[str, object], ...] = ()
    order: str = "wi"
    phi: float = 0.0

    @property
    def channels(self) -> tuple[str, ...]:
        """The names of what `at` gives."""
        return QUANTITIES[self.quantity].channels

    @property
    def member(self) -> Model:
        """The member of the model's family that the fixed choices select."""
        return self.model.member({name: value for name, value in self.fixed if name != SCALE.name})[0]

    def checked(self, variables: tuple[str, ...]) -> Source:
        """This source, if it has just these variables beside its fixed parameters. Raises BadInput."""
        if self.quantity not in QUANTITIES:
            raise BadInput("quantity", self.quantity, f"must be one of {', '.join(QUANTITIES)}")
        what = QUANTITIES[self.quantity]
        member = self.member
        known = [*([MU] if what.directional else []), *(parameter.name for parameter in member.parameters), SCALE.name]
        known = [name for name in known if name != F0 or not self._split]
        for name in variables:
            if name not in known:
                raise BadInput("axis", name, f"{self.quantity} of {member.title} depends on {', '.join(known)}")
            if name in dict(self.fixed):
                raise BadInput(name, dict(self.fixed)[name], "is an axis of the table; it takes no fixed value")
        if what.directional and MU not in variables:
            raise BadInput("axis", list(variables), f"{self.quantity} needs one along mu")
        if self._split and (F0 not in {parameter.name for parameter in member.parameters} or F0 in dict(self.fixed)):
            raise BadInput("quantity", self.quantity, f"needs a model whose F0 is left free; of {member.title} it is not")
        if self.quantity == "constant" and SCALE.name in {*dict(self.fixed), *variables}:
            raise BadInput("scale", dict(self.fixed).get(SCALE.name, SCALE.name), "is what the constant is; leave it out")
        if self.order not in ("wi", "wo"):
            raise BadInput("order", self.order, "must be wi or wo")
        return self

    @property
    def _split(self) -> bool:
        return self.quantity.startswith("split-sum")

    def at(self, point: Mapping[str, float]) -> Found:
        """The quantity at values of all variables, one figure a channel.

        mu = 0, and a parameter at 0 for which the model knows its limit (`mirror_limit`), are limits; where both are asked for,
        the parameter goes first: the table holds a mirror there. Raises BadInput, also where a limit is infinite, and
        Inconclusive.
        """
        mu = float(point[MU]) if MU in point else None
        if mu is not None and not 0.0 <= mu <= 1.0:
            raise BadInput(MU, mu, "must be in [0, 1]")
        named = tuple((name, float(value)) for name, value in point.items() if name != MU)
        if not self._split:
            found = self._figure(mu, named)
            if self.quantity in LOSSES:
                found = replace(found, value=1.0 - found.value, low=1.0 - found.high, high=1.0 - found.low)
            return (found,)
        dark, white = (self._figure(mu, (*named, (F0, f0))) for f0 in (0.0, 1.0))
        if self.quantity == "split-sum-total":
            return dark, white
        width = dark.half_width + white.half_width
        scale = white.value - dark.value
        error = math.hypot(dark.standard_error, white.standard_error)
        split = replace(white, value=scale, standard_error=error, low=scale - width, high=scale + width)
        return split, dark

    def _figure(self, mu: float | None, named: tuple[tuple[str, float], ...]) -> Estimate:
        """Albedo, mean albedo or constant, proven to the tolerance."""
        member, p, scale, mirror = _bound(self.model, (*self.fixed, *named), self.quantity == "constant")
        if mirror is not None:
            found = _mirror(mirror, p, mu, self.quantity).scaled(scale)
        elif self.quantity == "constant":
            found = largest_constant(supremum(member, p, self.order).value)
        elif mu == 0.0:
            found = self._grazing(member, p, scale)
        else:
            question = Question(member, p, None if mu is None else max(mu, SMALLEST_MU), self.phi, self.order)
            found = shape_estimate(question, scale, self.want).scaled(scale)
        where = dict(named) | ({} if mu is None else {MU: mu})
        return conclude(found, self.want.tolerance, label(member, where))

    def _grazing(self, member: Model, p: Any, scale: Estimate) -> Estimate:
        """The limit for mu -> 0."""
        seen = law(Subject(member, p, scale), self.order, self.phi)
        if seen.behaviour in ("bounded", "vanishes"):
            return bounded(seen.limit, seen.limit_error, seen.exponent.samples, "limit")
        where = "let the axis begin above 0, or put the nodes at the centres of texels"
        raise BadInput(MU, 0.0, f"the albedo of {member.title} {seen.behaviour} there; {where}")


@lru_cache(maxsize=4096)
def _bound(
    model: Model, named: tuple[tuple[str, object], ...], of_shape: bool
) -> tuple[Model, Any, Estimate, Callable[[Any, float], float] | None]:
    """The member, its parameters, its constant, and its reflectance where a parameter stands at the limit of a mirror."""
    values = dict(named)
    given = SCALE.parse(values.pop(SCALE.name)) if SCALE.name in values else None
    member, numbers = model.member(values)
    mirror = None
    if member.mirror_limit is not None and numbers.get(member.mirror_limit[0]) == 0.0:
        name, mirror = member.mirror_limit
        numbers[name] = next(parameter.low for parameter in member.parameters if parameter.name == name)
    p = member.bind(numbers)
    return member, p, exact(1.0) if of_shape else constant(member, p, given), mirror


def _mirror(F: Callable[[Any, float], float], p: Any, mu: float | None, quantity: str) -> Estimate:
    """What an ideal mirror of that reflectance has of a quantity."""
    if mu is not None:
        return exact(float(F(p, max(mu, SMALLEST_MU))))  # at mu = 0 itself a surface with eta = 1 has 0 / 0
    if quantity == "constant":
        return largest_constant(exact(float(F(p, 0.0))))  # no reflectance of facets exceeds that of grazing incidence, 1
    # 2 ∫ F mu dmu with mu = x², whose root at grazing incidence is smooth; the bound from half as many panels
    fine, coarse = (_mean(F, p, panels) for panels in (8, 4))
    return bounded(fine, abs(fine - coarse) + 1e-15, 12 * GAUSS_X.size, "quadrature")


def _mean(F: Callable[[Any, float], float], p: Any, panels: int) -> float:
    """2 ∫ F(x²) x² 2 x dx by Gauss's rule in so many panels."""
    ends = np.arange(panels) / panels
    x = (ends[:, None] + (0.5 + 0.5 * GAUSS_X) / panels).ravel()
    weights = np.tile(0.5 * GAUSS_W / panels, panels)
    return math.fsum(4.0 * w * t**3 * float(F(p, t * t)) for t, w in zip(x, weights, strict=True))
