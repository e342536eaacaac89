import math

import numpy as np
import pytest

from albedo_lab.errors import BadInput
from albedo_lab.pictures.functions import Function, Functions


def traced(f, x, **options):
    return Functions((Function("f", f),), x, "x", "f", **options).trace()[""]


def test_values_at_even_steps():
    table = traced(np.cos, (0.0, math.pi), points=5)
    assert table.x.tolist() == pytest.approx([0.0, math.pi / 4, math.pi / 2, 3 * math.pi / 4, math.pi])
    assert table.value.tolist() == pytest.approx(np.cos(table.x).tolist())
    assert table.columns.tolist() == ["function", "x", "value"]


def test_even_steps_of_the_logarithm():
    assert traced(np.sqrt, (1e-4, 1.0), log_x=True, points=5).x.tolist() == pytest.approx([1e-4, 1e-3, 1e-2, 0.1, 1.0])


def test_a_constant_is_a_function():
    assert traced(lambda x: 0.5, (0.0, 1.0), points=3).value.tolist() == [0.5, 0.5, 0.5]


def test_functions_keep_their_order():
    several = tuple(Function(name, np.abs) for name in "cab")
    table = Functions(several, (0.0, 1.0), "x", "f", points=2).trace()[""]
    assert table.function.tolist() == ["c", "c", "a", "a", "b", "b"]


@pytest.mark.parametrize(
    ("x", "log_x"), [((1.0, 1.0), False), ((1.0, math.nan), False), ((0.0, math.inf), False), ((0.0, 1.0), True)]
)
def test_an_x_without_extent_is_bad_input(x, log_x):
    with pytest.raises(BadInput, match="x = "):
        traced(np.cos, x, log_x=log_x)
