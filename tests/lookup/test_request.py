"""What is asked of a table: the user's words go before a preset's, and these before the defaults."""

from __future__ import annotations

import math

import pytest

from albedo_lab.errors import BadInput
from albedo_lab.lookup.presets import PRESETS, preset
from albedo_lab.lookup.request import refuse_nodes, refuse_values, requested


def test_defaults() -> None:
    source, axes = requested("ggx", {"alpha": 0.5}, ["mu=4"], phi_deg=90)
    assert (source.quantity, source.want.tolerance.absolute, source.fixed) == ("albedo", 1e-6, (("alpha", 0.5),))
    assert source.phi == pytest.approx(math.pi / 2)
    assert [(axis.size, axis.sampling) for axis in axes] == [(4, "endpoints")]
    assert requested("ggx", {"alpha": 0.5}, "mu=4")[1] == axes


@pytest.mark.parametrize("name", PRESETS)
def test_presets(name: str) -> None:
    known = preset(name)
    source, axes = requested(None, {}, preset=name)
    assert (source.model.name, source.quantity, dict(source.fixed)) == (known.model, known.quantity, dict(known.fixed))
    assert len(axes) == len(known.axes)
    assert {axis.sampling for axis in axes} == {known.sampling}
    refuse_nodes(source, axes)


def test_what_is_said_goes_before_a_preset() -> None:
    source, axes = requested("ggx", {"G": "smith"}, ["mu=2"], "energy-loss", "centres", "cycles")
    assert dict(source.fixed) == {"G": "smith", "F": "one"}
    assert (source.quantity, [axis.sampling for axis in axes]) == ("energy-loss", ["centres"])


def test_another_model_takes_the_choices_that_it_has() -> None:
    assert dict(requested("lambert", {}, ["mu=2"], preset="cycles")[0].fixed) == {}
    assert dict(requested("beckmann", {}, preset="cycles")[0].fixed) == dict(preset("cycles").fixed)


def test_nodes_may_stand_at_a_limit_and_nowhere_else_outside() -> None:
    source, axes = requested("ggx", {}, ["alpha=3", "mu=3"])
    refuse_nodes(source, axes)
    for name, value in (("alpha", -0.0), ("alpha", 0.5), ("mu", 0.0), ("scale", 2.0)):
        refuse_values(source, name, [value])
    for name, bad in (("alpha", 1e-6), ("alpha", math.nan), ("alpha", "wide"), ("alpha_x", 0.0), ("mu", 1.1), ("scale", -1.0)):
        with pytest.raises(BadInput) as told:
            refuse_values(source, name, [bad])
        assert told.value.parameter == name
    with pytest.raises(BadInput, match=r"mu = 1\.5"):
        refuse_nodes(source, requested("ggx", {}, ["alpha=3", "mu=3@0:1.5"])[1])
