"""Curves of a few shapes."""

import numpy as np

from blender_addon.model.principal import principal_shapes


def curves(count: int = 200, rank: int = 5) -> np.ndarray:
    random = np.random.default_rng(1)
    return random.normal(size=(count, rank)) @ random.normal(size=(rank, 40)) + 3.0


def worst(numbers, shapes) -> float:
    return float(np.abs(shapes.curves(shapes.coefficients(numbers)) - numbers).max())


def test_curves_of_so_many_shapes_are_met():
    numbers = curves()
    for rounds in (0, 3):
        assert worst(numbers, principal_shapes(numbers, 5, np.ones(200), rounds)) < 1e-9
    assert worst(numbers, principal_shapes(numbers, 3, np.ones(200), 0)) > 0.1


def test_rounds_lower_the_largest_error():
    numbers = np.concatenate([curves(200, 8), 3.0 + 4.0 * np.eye(40)[:1]])
    first = worst(numbers, principal_shapes(numbers, 8, np.ones(201), 0))
    assert worst(numbers, principal_shapes(numbers, 8, np.ones(201), 4)) < 0.7 * first


def test_weights_decide_which_curves_are_met():
    numbers = curves(200, 8)
    weights = np.where(np.arange(200) < 4, 1e6, 1.0)
    shapes = principal_shapes(numbers, 4, weights, 0)
    assert worst(numbers[:4], shapes) < 1e-3 < worst(numbers, shapes)


def test_one_curve_and_more_shapes_than_places():
    for numbers in (np.ones((1, 6)), np.ones((3, 2))):
        shapes = principal_shapes(numbers.astype(np.float32), 4, np.ones(len(numbers)), 2)
        assert shapes.shapes.shape == (4, numbers.shape[1])
        assert worst(numbers, shapes) == 0.0
