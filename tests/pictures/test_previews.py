import math

import numpy as np
import pytest

from albedo_lab.analysis.albedo import albedo
from albedo_lab.analysis.colour import colour
from albedo_lab.errors import BadInput
from albedo_lab.pictures.base import Curve
from albedo_lab.pictures.evaluation import subject
from albedo_lab.pictures.previews import DIRECTIONS, Previews, alike, faults
from albedo_lab.pictures.scene import ELEVATION, LAMP, VIEWER, ZENITH, seen

SIZE = 48
TOP_DEG = 90.0 - math.degrees(ELEVATION)
"""The angle under which a cylinder's top is seen."""
NOISE = 0.25 / math.sqrt(DIRECTIONS)
"""What a pixel's plain Monte Carlo estimate of the lit half of a sky would be off by, halved; a lattice does better."""


def shown(model, light, shape="sphere", scratches="length", **parameters):
    """The colours of all covered pixels, and the shape."""
    data = Previews((Curve("it", model, parameters),), (light,), (shape,), SIZE, scratches).trace()
    view = seen(shape, SIZE, scratches)
    return data["radiance"][0, 0, 0][view.coverage > 0.0], view


def of_top(view):
    """Pixels of the flat top."""
    return view.frames[:, 2] @ np.array(ZENITH) > 1.0 - 1e-12


def test_a_white_surface_under_each_light_in_closed_form():
    normal = seen("cylinder", SIZE, "length").frames[:, 2]
    for light, expected in (
        ("directional", np.maximum(normal @ np.array(LAMP), 0.0)),
        ("eye", normal @ np.array(VIEWER)),
        ("sky", 0.5 * (1.0 + normal @ np.array(ZENITH))),
    ):
        found, _ = shown("lambert", light, "cylinder")
        assert np.ptp(found, axis=1).max() == 0.0
        within = {"atol": NOISE} if light == "sky" else {"rtol": 1e-12, "atol": 1e-14}
        np.testing.assert_allclose(found[:, 0], expected, **within)
        assert np.mean(found[:, 0] - expected) == pytest.approx(0.0, abs=2e-3)


@pytest.mark.parametrize(("model", "parameters"), [("stretched_phong", {"n": 300.0}), ("schlick_isotropic", {"r": 0.5})])
def test_the_top_reflects_nothing_but_sky_which_is_the_albedo(model, parameters):
    found, view = shown(model, "sky", "cylinder", **parameters)
    top = found[of_top(view), 0]
    expected = albedo(model, theta_deg=TOP_DEG, method="quadrature", **parameters).albedo[0]
    assert np.mean(top) == pytest.approx(expected, abs=5.0 * np.std(top) / math.sqrt(len(top)) + 1e-3)


def test_a_lamp_is_the_formula():
    found, view = shown("phong", "directional", n=5.0, scale=1.0)
    normal = view.frames[:, 2]
    mirror = 2.0 * (normal @ np.array(LAMP))[:, None] * normal - np.array(LAMP)
    lit = np.maximum(normal @ np.array(LAMP), 0.0)
    expected = math.pi * lit * np.maximum(mirror @ np.array(VIEWER), 0.0) ** 5
    np.testing.assert_allclose(found[:, 0], expected, rtol=1e-9, atol=1e-12)


def test_a_mirror_shows_the_sky_and_no_lamp():
    found, view = shown("mirror", "sky")
    mirrored = 2.0 * view.frames[:, 2, 2:] * view.frames[:, 2] - np.array(VIEWER)
    np.testing.assert_array_equal(found[:, 0], mirrored @ np.array(ZENITH) > 0.0)
    assert not shown("mirror", "eye")[0].any()


def test_three_values_are_red_green_and_blue():
    for name, values in (("albedo", (0.8, 0.4, 0.1)), ("scale", (0.9, 0.2, 0.5))):
        found, _ = shown("lambert", "eye", **{name: list(values)})
        for channel, value in enumerate(values):
            alone, _ = shown("lambert", "eye", **{name: value})
            np.testing.assert_allclose(found[:, channel], alone[:, 0], rtol=1e-14)


def test_a_metal_has_its_colour():
    found, view = shown("metal", "sky", "cylinder", metal="gold", n=1000.0)
    (row,) = colour("metal", metal="gold", n=1000.0, theta_deg=TOP_DEG, method="quadrature").to_dict("records")
    np.testing.assert_allclose(found[of_top(view)].mean(axis=0), [row["R"], row["G"], row["B"]], atol=2e-3)
    dearer, _ = shown("metal", "sky", "cylinder", metal="gold", n=1000.0, wavelength=list(range(400, 751, 50)))
    np.testing.assert_array_equal(found, dearer)


def test_layers_share_samples_only_where_they_sample_alike():
    n20, n40, scaled = (subject(Curve("it", "phong", p)) for p in ({"n": 20.0}, {"n": 40.0}, {"n": 20.0, "scale": 0.5}))
    assert alike(n20, scaled)
    assert not alike(n20, n40)
    together, _ = shown("phong", "sky", n=[20.0, 40.0, 80.0])
    for channel, n in enumerate((20.0, 40.0, 80.0)):
        np.testing.assert_array_equal(together[:, channel], shown("phong", "sky", n=n)[0][:, 0])


def test_scratches_turn_an_anisotropic_surface_and_no_other():
    for model, differ in (("ward", True), ("phong", False)):
        parameters = {"m_x": 0.1, "m_y": 0.5} if differ else {"n": 10.0}
        along, around = (shown(model, "directional", scratches=scratches, **parameters)[0] for scratches in ("length", "around"))
        assert (np.abs(along - around).max() > 0.1) == differ


def test_around_a_cylinder_the_highlight_runs_along_it():
    """Scratches around a face spread light across themselves: up and down, in the plane of axis and viewer."""
    found, view = shown("ward", "eye", "cylinder", "around", m_x=0.05, m_y=0.6)
    face = np.abs(view.frames[:, 2] @ np.array(ZENITH)) < 1e-12
    middle = np.abs(view.frames[:, 2, 0]) < 0.05
    beside = np.abs(view.frames[:, 2, 0]) > 0.4
    assert found[face & middle, 0].min() > 100.0 * found[face & beside, 0].max()


def test_what_cannot_be_shown_is_counted():
    step = 1.0 / 255.0
    colours = np.array(
        [[1.0, 0.5, 0.0], [1.0 + 2.0 * step, 0.0, 0.0], [0.0, -step, 0.0], [math.nan, 2.0, 0.0], [0.0, math.inf, 0.0]]
    )
    found = faults(colours)
    assert found["clipped"].tolist() == [False, True, False, True, False]
    assert found["negative"].tolist() == [False, False, True, False, False]
    assert found["not_finite"].tolist() == [False, False, False, True, True]
    told = Previews((Curve("it", "lambert", {"scale": 2.0}),), ("eye",), ("sphere",), SIZE).trace()[""].iloc[0]
    normal = seen("sphere", SIZE, "length").frames[:, 2, 2]
    assert told.clipped == pytest.approx(np.mean(normal > 0.5), abs=0.01)
    assert told.largest == pytest.approx(2.0, rel=0.01)


def test_exposure_multiplies_linear_light():
    curves = (Curve("it", "lambert"),)
    once, twice = (Previews(curves, ("eye",), ("sphere",), SIZE, exposure=e).trace()["radiance"] for e in (1.0, 2.0))
    np.testing.assert_array_equal(2.0 * once, twice)


def test_threads_change_nothing():
    picture = Previews((Curve("it", "ward"), Curve("rgb", "lambert", {"albedo": [0.1, 0.2, 0.3]})), size=SIZE)
    one, two = picture.trace(1), picture.trace(2)
    assert one["radiance"].tobytes() == two["radiance"].tobytes()
    assert one[""].equals(two[""])
    assert list(zip(one[""].curve, one[""]["shape"], one[""].light, strict=True))[3] == ("it", "cylinder", "directional")


@pytest.mark.parametrize(
    ("options", "name"),
    [
        ({"lights": ("moon",)}, "lights"),
        ({"shapes": ("cube",)}, "shapes"),
        ({"scratches": "across"}, "scratches"),
        ({"size": 7}, "size"),
        ({"exposure": 0.0}, "exposure"),
        ({"exposure": math.nan}, "exposure"),
    ],
)
def test_bad_input(options, name):
    with pytest.raises(BadInput, match=f"^{name} = "):
        Previews((), **options)


@pytest.mark.parametrize("parameters", [{"n": [1.0, 2.0]}, {"n": [1.0, 2.0, 3.0], "scale": [0.1, 0.2, 0.3]}])
def test_no_colour(parameters):
    with pytest.raises(BadInput, match=r"curve = 'it': must be one material, or have three values"):
        shown("phong", "eye", **parameters)


def test_the_directions_into_the_sky_do_not_set_one_by_one():
    found, view = shown("lambert", "sky")
    expected = 0.5 * (1.0 + view.frames[:, 2] @ np.array(ZENITH))
    assert np.abs(found[:, 0] - expected).max() < 1.5 / DIRECTIONS
