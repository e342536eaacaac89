"""What a table is said to be: by options, by a preset, or by the record beside the file; whatever is not said is left open."""

from __future__ import annotations

from dataclasses import dataclass

from albedo_lab.lookup.audit.layouts import plain
from albedo_lab.lookup.audit.variants import Form, Variant
from albedo_lab.lookup.axes import Axis


@dataclass(frozen=True)
class Expectation:
    """What is said of a table; None where nothing is."""

    variant: Variant | None = None
    quantity: str | None = None
    axes: tuple[Axis, ...] | None = None
    sampling: str | None = None
    source: str = "nothing is said of it"
    """Who says so."""
    limits: bool = True
    """Whether nodes at the end of an axis are said to stand just there: presets say nothing of it, as renderers' own tables hold
    there what is 1e-6 to 1e-3 away."""
    texel: bool = False
    """Whether roughness may stand a whole texel further, where the renderer's own tool writes it."""

    @property
    def nothing(self) -> bool:
        """Whether nothing at all is said."""
        return self.variant is None and self.quantity is None and self.axes is None and self.sampling is None

    def allows(self, variant: Variant, form: Form, axes: tuple[Axis, ...]) -> bool:
        """Whether a hypothesis is as was said."""
        return self.allows_form(variant, form) and all(self.allows_axis(axis, place) for place, axis in enumerate(axes))

    def allows_form(self, variant: Variant, form: Form) -> bool:
        """Whether what it says of the model and the quantity is as was said, if anything was."""
        if self.nothing or (self.variant is not None and variant != self.variant):
            return False
        return self.quantity is None or (form.quantity == self.quantity and not form.swapped)

    def allows_axis(self, axis: Axis, place: int) -> bool:
        """Whether an axis is as was said of the one in that place."""
        if self.axes is not None:
            return axis == plain(self.axes[place])
        return axis.shift == 0.0 and axis.sampling == (self.sampling or axis.sampling)
