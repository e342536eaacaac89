"""Each defect named, sound tables clean. Truth is shared: small tables of GGX, separable and height-correlated."""

import json
from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from albedo_lab.analysis.request import effort
from albedo_lab.catalogue import find
from albedo_lab.errors import BadInput
from albedo_lab.lookup.audit import audit
from albedo_lab.lookup.audit.expectation import Expectation
from albedo_lab.lookup.audit.hypotheses import Observed
from albedo_lab.lookup.audit.judge import shapes
from albedo_lab.lookup.audit.layouts import departures, nodes, run_of
from albedo_lab.lookup.audit.storage import grain
from albedo_lab.lookup.audit.truth import Lab, grid, mean_weights, weights
from albedo_lab.lookup.audit.variants import usual
from albedo_lab.lookup.axes import Axis, parse_axes
from albedo_lab.lookup.source import Source
from albedo_lab.lookup.table import tabulated

WANT = effort(1e-5, "quadrature", 0, 1)
PLAIN = ("sqrt(alpha)=12", "mu=12")
SAID = {"model": "ggx", "G": "smith_correlated", "quantity": "albedo", "axes": PLAIN, "threads": 1}


@cache
def table(axes=PLAIN, sampling="endpoints", G="smith_correlated", quantity="albedo", F="one"):
    parsed = tuple(axis if isinstance(axis, Axis) else parse_axes([axis], sampling)[0] for axis in axes)
    source = Source(find("ggx"), quantity, WANT, (("G", G), ("F", F)))
    found = tabulated("E", source, parsed).stored
    found.flags.writeable = False
    return found


def audited(tmp_path, values, **said):
    np.save(tmp_path / "table.npy", values)
    return audit(tmp_path / "table.npy", **said)


def names(found):
    return [defect.name for defect in found.defects]


def changed(place, value):
    values = table().copy()
    values[place] = value
    return values


def shifted(mu=0.0, alpha=0.0):
    return table((Axis("alpha", "sqrt(x)", 12, 0.0, 1.0, "centres", alpha), Axis("mu", "x", 12, 0.0, 1.0, "centres", mu)))


NOISE = np.random.default_rng(7).normal(0.0, 1.0, (12, 12))
DEFECTS = {
    "axes swapped": (lambda: table().T, ["axes swapped"]),
    "roughness flipped": (lambda: table()[::-1], ["axis flipped"]),
    "mu flipped": (lambda: table()[:, ::-1], ["axis flipped"]),
    "both flipped and swapped": (lambda: table()[::-1, ::-1].T, ["axes swapped", "axis flipped", "axis flipped"]),
    "alpha for roughness": (lambda: table(("alpha=12", "mu=12")), ["alpha for roughness"]),
    "roughness squared twice": (lambda: table(("sqrt(sqrt(alpha))=12", "mu=12")), ["axis squared"]),
    "angle for cosine": (lambda: table(("sqrt(alpha)=12", "acos(mu)=12")), ["axis mapping"]),
    "centres": (lambda: table(sampling="centres"), ["sampling", "sampling"]),
    "i / N": (lambda: shifted(mu=-0.5, alpha=-0.5), ["half-texel shift", "half-texel shift"]),
    "separable for correlated": (lambda: table(G="smith"), ["other model"]),
    "1 - E": (lambda: 1.0 - table(), ["stored as 1 - E"]),
    "clamped": (lambda: np.minimum(table(), 0.9), ["clamped"]),
    "8 bits": (lambda: np.rint(table() * 255.0) / 255.0, ["8 bits"]),
    "8 bits, cut off": (lambda: np.floor(table() * 255.0) / 255.0, ["8 bits", "biased"]),
    "half floats": (lambda: table().astype(np.float16).astype(np.float64), ["coarse storage"]),
    "a cell": (lambda: changed((7, 5), table()[7, 5] + 1e-3), ["cells wrong"]),
    "a cell beside the corner": (lambda: changed((1, 1), table()[1, 1] - 1e-3), ["cells wrong"]),
    "not a number": (lambda: changed((3, 4), np.nan), ["not finite"]),
    "a factor": (lambda: 1.01 * table(), ["biased"]),
    "half as bright": (lambda: 0.5 * table(), ["biased"]),
    "an offset": (lambda: table() - 3e-3, ["biased"]),
    "noise": (lambda: table() + 1e-3 * NOISE, ["noise"]),
    "smallest alpha": (lambda: changed(np.s_[:4], table()[4]), ["alpha clamped"]),
    "no limit at mu = 0": (lambda: changed(np.s_[:, 0], 0.0), ["line wrong"]),
    "flipped and shifted": (lambda: shifted(mu=0.5)[::-1], ["axis flipped", "sampling", "half-texel shift"]),
    "swapped, of the wrong variant": (lambda: table(G="smith").T, ["other model", "axes swapped"]),
    "swapped, 1 - E, of alpha for roughness": (
        lambda: 1.0 - table(("alpha=12", "mu=12")).T,
        ["stored as 1 - E", "axes swapped", "alpha for roughness"],
    ),
    "noisy and flipped": (lambda: table()[::-1] + 1e-3 * NOISE, ["axis flipped", "noise"]),
    "a cell of a swapped table": (lambda: changed((7, 5), table()[7, 5] + 1e-3).T, ["axes swapped", "cells wrong"]),
}


TOLD = [True, pytest.param(False, marks=pytest.mark.slow)]
QUICK = {
    "clamped",
    "8 bits",
    "half floats",
    "a cell",
    "a cell beside the corner",
    "not a number",
    "a factor",
    "an offset",
    "smallest alpha",
    "no limit at mu = 0",
}
"""All others look among all layouts of all models, of which quick runs have enough with these."""


def some(names, quick):
    return [pytest.param(name, marks=[pytest.mark.slow] * (name not in quick)) for name in names]


@pytest.mark.parametrize("name", some(DEFECTS, QUICK))
def test_a_defect_is_named_and_nothing_else_is(tmp_path, name):
    make, expected = DEFECTS[name]
    found = audited(tmp_path, make(), **SAID)
    assert names(found) == expected
    assert (found.verdict, found.status) == ("defects", 1)


LAYOUTS = ["separable for correlated", "roughness flipped", "alpha for roughness", "centres", "1 - E"]


@pytest.mark.parametrize("name", some(LAYOUTS, set()))
def test_without_an_expectation_the_layout_is_a_fact(tmp_path, name):
    found = audited(tmp_path, DEFECTS[name][0]())
    assert (found.verdict, found.status, names(found)) == ("sound", 0, [])
    assert found.candidates.rms[0] < 1e-9 < 1e-3 < found.candidates.rms[1]


@pytest.mark.parametrize("name", some(["a cell", "i / N", "clamped", "8 bits", "a factor", "noise"], set()))
def test_without_an_expectation_what_no_convention_has_is_a_defect(tmp_path, name):
    make, expected = DEFECTS[name]
    found = audited(tmp_path, make())
    assert (found.verdict, names(found)) == ("defects", expected)
    assert found.found.variant == usual()[0]


def test_the_evidence_names_the_cell_and_the_size(tmp_path):
    found = audited(tmp_path, changed((7, 5), table()[7, 5] + 1e-3), **SAID)
    (defect,) = found.defects
    assert defect.cells == ((7, 5, 0),)
    assert f"[7][5] (alpha = {(7 / 11) ** 2:.5g}, mu = {5 / 11:.5g})" in defect.evidence
    assert found.deviations[7, 5, 0] == pytest.approx(1e-3, abs=1e-5)
    assert np.argmax(np.abs(found.deviations)) == 7 * 12 + 5


@pytest.mark.parametrize(("factor", "offset"), [(1.01, 0.0), (1.0, -3e-3), (0.9, 0.02)])
def test_a_bias_has_its_interval(tmp_path, factor, offset):
    noisy = factor * table() + offset + 1e-5 * NOISE
    found = next(d for d in audited(tmp_path, noisy, **SAID).defects if d.name == "biased")
    words = found.sentence.replace("minus ", "plus -").split()
    told = {"times": 1.0, "plus": 0.0}
    for i, word in enumerate(words):
        if word in told:
            told[word] = float(words[i + 1])
            assert abs(told[word] - (factor if word == "times" else offset)) <= 2.0 * float(words[i + 3])
    assert told["times"] == pytest.approx(factor, abs=3e-3)


def test_clamped_cells_are_counted(tmp_path):
    (defect,) = audited(tmp_path, np.minimum(table(), 0.9), **SAID).defects
    assert len(defect.cells) == np.count_nonzero(table() > 0.9 + 1e-4)


SOUND = {
    "six decimals": (lambda: np.round(table(), 6), {}),
    "float32": (lambda: table().astype(np.float32), {}),
    "16 bits": (lambda: np.rint(table() * 65535.0).astype(np.uint16), {}),
    "centres": (lambda: table(sampling="centres"), {"sampling": "centres"}),
    "1 - E": (lambda: 1.0 - table(), {"quantity": "energy-loss"}),
    "separable": (lambda: table(G="smith"), {"G": "smith"}),
    "noise within the tolerance": (lambda: table() + 2e-5 * NOISE, {}),
}


@pytest.mark.parametrize("name", SOUND)
def test_a_sound_table_has_no_defect(tmp_path, name):
    make, said = SOUND[name]
    found = audited(tmp_path, make(), **(SAID | said))
    assert (found.verdict, names(found)) == ("sound", [])


@pytest.mark.slow
@pytest.mark.parametrize("name", [*SOUND, *LAYOUTS])
def test_a_sound_table_has_no_defect_where_nothing_is_said(tmp_path, name):
    make, _ = SOUND[name] if name in SOUND else DEFECTS[name]
    found = audited(tmp_path, make())
    assert (found.verdict, names(found)) == ("sound", [])


SPLIT_AXES = ("mu=8", "sqrt(alpha)=8")
SPLIT = {"model": "ggx", "F": "schlick", "quantity": "split-sum", "axes": SPLIT_AXES, "sampling": "centres"}


@pytest.mark.parametrize("told", TOLD)
def test_the_split_sum(tmp_path, told):
    pair = table(SPLIT_AXES, "centres", quantity="split-sum", F="schlick")
    assert audited(tmp_path, pair, **(SPLIT if told else {})).verdict == "sound"


@pytest.mark.slow
@pytest.mark.parametrize("told", [True, False])
def test_its_channels_swapped(tmp_path, told):
    pair = table(SPLIT_AXES, "centres", quantity="split-sum", F="schlick")
    swapped = audited(tmp_path, pair[..., ::-1], **(SPLIT if told else {}))
    assert names(swapped) == (["channels swapped"] if told else [])
    assert swapped.found.form.swapped


@pytest.mark.parametrize("told", TOLD)
def test_a_table_of_means(tmp_path, told):
    means = table(("sqrt(alpha)=12",), quantity="mean-albedo")
    said = {"model": "ggx", "quantity": "mean-albedo", "axes": ("sqrt(alpha)=12",)} if told else {}
    assert audited(tmp_path, means, **said).verdict == "sound"


@pytest.mark.slow
@pytest.mark.parametrize("values", [NOISE**2, np.full((12, 12), 0.7), np.ones((12, 12))], ids=["noise", "constant", "ones"])
def test_what_nothing_explains_is_unknown(tmp_path, values):
    found = audited(tmp_path, values)
    assert (found.verdict, found.status, names(found), found.found) == ("unknown", 3, [], None)
    assert "no finding" in found.text()


@pytest.mark.slow
def test_what_is_not_as_said_is_a_defect_even_where_nothing_explains_it(tmp_path):
    assert names(audited(tmp_path, NOISE**2, **SAID)) == ["not as said"]


@pytest.mark.slow
def test_layouts_that_a_table_cannot_tell_apart_are_undecided(tmp_path):
    means = table(("sqrt(alpha)=12",), quantity="mean-albedo")
    found = audited(tmp_path, np.round(means, 1) + 0.0)
    assert found.verdict != "sound"


def test_a_displaced_edge_is_a_fact_without_and_a_defect_with_an_expectation(tmp_path):
    values = table().copy()
    edge = tabulated("E", Source(find("ggx"), "albedo", WANT), (Axis("alpha", "sqrt(x)", 12), Axis("mu", "x", 2, 1e-3, 1.0)))
    values[:, 0] = edge.values[:, 0, 0]
    found = audited(tmp_path, values)
    assert (found.verdict, [fact.name for fact in found.facts]) == ("sound", ["edge displaced"])
    assert "mu = 0.001" in found.facts[0].sentence
    assert names(audited(tmp_path, values, **SAID)) == ["edge displaced"]


def test_what_is_said_beside_the_file_is_expected(tmp_path):
    from albedo_lab.lookup.export import export

    path = tmp_path / "e.csv"
    export("ggx", path, axes=("sqrt(alpha)=6", "mu=6"), mean=False, points=16)
    sound = audit(path)
    assert sound.verdict == "sound"
    assert "by the record" in sound.text()
    known = json.loads((tmp_path / "e.csv.meta.json").read_text())
    known["choices"]["G"] = "smith"
    (tmp_path / "e.csv.meta.json").write_text(json.dumps(known))
    assert names(audit(path)) == ["other model"]


def test_all_arrays_that_a_record_names_are_audited(tmp_path):
    from albedo_lab.lookup.export import export

    path = tmp_path / "e.npz"
    export("ggx", path, axes=("sqrt(alpha)=4", "mu=4"), points=0)
    both = audit(path)
    assert (both.status, [each.verdict for each in both.more], both.others) == (0, ["sound"], ())
    assert both.text().count("sound: every cell") == 2
    arrays = dict(np.load(path))
    (mean,) = (each.array for each in both.more)
    arrays[mean][2] += 0.01
    np.savez(path, **arrays)
    worse = audit(path)
    assert (worse.verdict, worse.status, names(worse.more[0])) == ("sound", 1, ["cells wrong"])
    assert [fact.name for fact in worse.facts] == ["changed"]
    assert json.loads(json.dumps(worse.as_dict(), allow_nan=False))["more"][0]["verdict"] == "defects"
    alone = audit(path, array=both.array)
    assert (alone.status, mean in alone.others, f"--array NAME): {mean}" in alone.text()) == (0, True, True)


def test_what_a_preset_loses_on_average(tmp_path):
    """OpenPBR has 1 - E and its mean 1 - E_avg, both for the separable masking."""
    loss = table(("sqrt(alpha)=32",), G="smith", quantity="mean-energy-loss")
    sound = audited(tmp_path, np.rint(loss * 65535.0).astype(np.uint16), preset="openpbr")
    assert (sound.verdict, sound.found.form.quantity) == ("sound", "mean-energy-loss")
    assert "mean-energy-loss" in sound.text()


@pytest.mark.slow
def test_a_mean_for_what_is_lost_on_average(tmp_path):
    mean = table(("sqrt(alpha)=32",), G="smith", quantity="mean-albedo")
    assert names(audited(tmp_path, mean, preset="openpbr")) == ["stored as E"]


@pytest.mark.slow
def test_the_rows_of_cmgen(tmp_path):
    """A whole texel further, the last held: a fact where nothing is said and with the preset, a defect beside other axes."""
    axes = (Axis("alpha", "sqrt(x)", 16, 0.0, 1.0, "centres", 1.0), Axis("mu", "x", 16, 0.0, 1.0, "centres"))
    held = replace(axes[0], shift=0.0), axes[1]
    values = np.concatenate([table(held)[1:], table((Axis("alpha", "sqrt(x)", 2), axes[1]))[1:]])
    found = audited(tmp_path, values)
    assert (found.verdict, [fact.name for fact in found.facts]) == ("sound", ["texel shift"])
    assert found.found.axes == axes
    said = {"model": "ggx", "quantity": "albedo", "axes": ("roughness=16", "mu=16"), "sampling": "centres"}
    assert names(audited(tmp_path, values, **said)) == ["texel shift"]


def test_every_file_can_be_told_as_json(tmp_path):
    values = table().copy()
    values[3, 4], values[5, 6] = np.inf, -np.inf
    found = audited(tmp_path, values, **SAID)
    assert names(found) == ["not finite"]
    assert "Infinity" not in json.dumps(found.as_dict(), allow_nan=False)


@pytest.mark.slow
@pytest.mark.parametrize("said", [{}, SAID])
def test_a_table_of_no_numbers_is_not_sound(tmp_path, said):
    found = audited(tmp_path, np.full((12, 12), np.nan), **said)
    assert found.status != 0
    assert json.dumps(found.as_dict(), allow_nan=False)
    assert found.text()


@pytest.mark.parametrize(
    ("shape", "said", "expected"),
    [
        ((64,), {}, [(8, 8, 1), (64, 1)]),
        ((128,), {}, [(8, 8, 2), (8, 8, 2), (128, 1)]),
        ((192,), {"quantity": "split-sum"}, []),
        ((4096,), {}, [(64, 64, 1)]),
        ((8, 8, 4), {}, [(8, 8, 2)]),
        ((8, 8, 8), {}, [(8, 8, 8, 1)]),
        ((8, 9), {}, [(8, 9, 1)]),
    ],
)
def test_shapes_that_numbers_may_have(shape, said, expected):
    values = np.arange(float(np.prod(shape))).reshape(shape)
    if expected:
        assert [found.shape for found, _ in shapes(values, Expectation(**said))] == expected
    else:
        with pytest.raises(BadInput, match="--shape"):
            list(shapes(values, Expectation(**said)))


def test_planes_and_pixels():
    """Two channels stand in turn, or one plane after the other."""
    turns, planes, _ = (found for found, _ in shapes(np.arange(128.0), Expectation()))
    assert turns[0, 0].tolist() == [0.0, 1.0]
    assert planes[0, 0].tolist() == [0.0, 64.0]


def test_prose_is_no_table(tmp_path):
    (tmp_path / "README.md").write_text("Call it so:\n\n    audit(theta = (0.1, 0.2, 0.3))\n")
    with pytest.raises(BadInput, match="no table of 8 or more numbers"):
        audit(tmp_path / "README.md")


VALUES = {
    "a cell": (lambda v, rng: added(v, tuple(rng.integers(v.shape)), 2e-3), ["cells wrong"]),
    "clamped": (lambda v, rng: np.minimum(v, np.quantile(v, 0.6)), ["clamped"]),
    "8 bits": (lambda v, rng: np.rint(v * 255.0) / 255.0, ["8 bits"]),
    "a factor": (lambda v, rng: v * rng.uniform(0.85, 0.99), ["biased"]),
    "noise": (lambda v, rng: v + rng.normal(0.0, 2e-3, v.shape), ["noise"]),
}
STRUCTURES = {
    "as said": ({}, lambda v: v, []),
    "swapped": ({}, lambda v: v.T, ["axes swapped"]),
    "flipped": ({}, lambda v: v[::-1], ["axis flipped"]),
    "alpha": ({"roughness": "alpha"}, lambda v: v, ["alpha for roughness"]),
    "separable": ({"G": "smith"}, lambda v: v, ["other model"]),
    "lost": ({}, lambda v: 1.0 - v, ["stored as 1 - E"]),
}


def added(values, place, by):
    values = values.copy()
    values[place] += by if values[place] < 0.5 else -by
    return values


@pytest.mark.slow
@pytest.mark.parametrize("structure", STRUCTURES)
@pytest.mark.parametrize("what", [None, *VALUES])
def test_defects_of_random_tables_and_pairs_of_them(tmp_path, structure, what):
    rng = np.random.default_rng([list(STRUCTURES).index(structure), [None, *VALUES].index(what)])
    sizes = rng.integers(9, 20, 2)
    changes, rearranged, expected = STRUCTURES[structure]
    made = (f"{changes.get('roughness', 'roughness')}={sizes[0]}", f"mu={sizes[1]}")
    values = rearranged(table(made, G=changes.get("G", "smith_correlated")))
    if what is not None:
        damage, also = VALUES[what]
        values, expected = damage(values, rng), expected + also
    found = audited(tmp_path, values, **SAID | {"axes": (f"roughness={sizes[0]}", f"mu={sizes[1]}")})
    assert set(names(found)) - {"negative"} == set(expected)
    assert found.verdict == ("defects" if expected else "sound")


def test_the_text_and_the_record(tmp_path):
    make, expected = DEFECTS["swapped, 1 - E, of alpha for roughness"]
    found = audited(tmp_path, make(), **SAID)
    assert names(found) == expected
    text = found.text()
    for words in ("12 x 12", "expected: albedo, ggx", "axes swapped: the axes are mu, alpha", "largest", "not sound"):
        assert words in text
    record = json.loads(json.dumps(found.as_dict(), allow_nan=False))
    assert (record["verdict"], record["defects"][1]["name"]) == ("defects", "axes swapped")
    assert list(found.candidates.columns) == ["model", "variant", "quantity", "layout", "largest", "rms", "where"]


@pytest.mark.parametrize(
    ("said", "parameter"),
    [
        ({"preset": "nobody"}, "preset"),
        ({"model": "nothing"}, "model"),
        ({"model": "ggx", "G": "v"}, "G"),
        ({"model": "ggx", "axes": ("n=12", "mu=12")}, "axis"),
        ({"model": "ggx", "axes": ("sqrt(alpha)=11", "mu=12")}, "shape"),
        ({"quantity": "brightness"}, "quantity"),
        ({"sampling": "corners"}, "sampling"),
        ({"tolerance": -1.0}, "tolerance"),
        ({"array": "other"}, "array"),
        ({"shape": (12, 11)}, "shape"),
        ({"alpha": 0.1}, "alpha"),
    ],
)
def test_bad_input_is_one_line_that_names_it(tmp_path, said, parameter):
    with pytest.raises(BadInput) as told:
        audited(tmp_path, table(), **said)
    assert told.value.parameter == parameter
    assert "\n" not in str(told.value)


def test_shifts_that_leave_the_axis_stand_at_its_end():
    assert nodes(Axis("alpha", "x", 4, 0.0, 1.0, "centres", 1.0)).tolist() == [0.375, 0.625, 0.875, 1.0]
    assert nodes(Axis("mu", "x", 3, 0.0, 1.0, "endpoints", -0.5)).tolist() == [0.0, 0.25, 0.75]


def test_departures_are_told_in_the_words_of_the_expectation():
    found, said = Axis("mu", "x", 8, 1.0, 0.0, "centres"), Axis("mu", "x", 8)
    assert [name for name, _ in departures(found, said)] == ["axis flipped", "sampling"]
    assert not list(departures(said, said))


@pytest.mark.parametrize(
    ("values", "rounding", "expected"),
    [
        (np.arange(256) / 255.0, 1e-7, "8 bits"),
        (np.arange(1024) / 1023.0, 1e-8, "10 bits"),
        (np.arange(1001) / 1000.0, 0.0, "3 decimals"),
        (np.sqrt(np.arange(200) / 199.0).astype(np.float16).astype(float), 1e-9, "half floats"),
        (np.sqrt(np.arange(200) / 199.0), 0.0, None),
        (np.round(np.sqrt(np.arange(200) / 199.0), 6), 5e-7, None),
        (np.array([0.0, 1.0, 1.0]), 0.0, None),
    ],
)
def test_the_grain_of_numbers(values, rounding, expected):
    found = grain(values, rounding)
    assert (found and found.name) == expected


def test_plateaus_are_what_many_cells_share_but_not_all():
    values = np.minimum(np.linspace(0.0, 1.0, 64).reshape(8, 8, 1), 0.8)
    assert Observed(values, 0.0, 1e-4).ends().tolist() == [[-np.inf], [0.8]]
    assert not np.any(np.isfinite(Observed(np.ones((8, 8, 1)), 0.0, 1e-4).ends()))


def test_surfaces_are_splines_through_their_nodes():
    run = run_of("alpha")
    x = np.array([0.03, 0.2, 0.77])
    assert weights(run, 2, x) @ np.sqrt(grid(run, 2)) == pytest.approx(np.sqrt(x), abs=1e-12)
    mu = run_of("mu")
    assert mean_weights(mu, 2) @ grid(mu, 2) == pytest.approx(2.0 / 3.0, abs=1e-6)


def test_a_surface_is_near_the_exact_cells():
    lab = Lab(WANT)
    runs = (run_of("alpha"), run_of("mu"))
    surface = lab.surface(usual()[0], "white", runs)
    at = parse_axes(PLAIN)
    near = weights(runs[0], 2, at[0].nodes) @ surface @ weights(runs[1], 2, at[1].nodes).T
    assert np.mean(np.abs(near - table())[1:, 1:]) < 1e-3
