"""Lines of a grid that are kept, and how far the others are from straight between them."""

import numpy as np
import pytest

from blender_addon.model.thinning import by_bend, by_error


def worst(places, values, kept) -> float:
    straight = [np.interp(places, places[kept], line[kept]) for line in values.T]
    return float(np.abs(np.array(straight).T - values).max())


@pytest.mark.parametrize("seed", range(3))
def test_errors_are_within_the_tolerance(seed):
    random = np.random.default_rng(seed)
    places = np.cumsum(random.integers(1, 5, 300))
    values = np.cumsum(random.normal(size=(300, 4)), axis=0) * (random.random(4) < 0.7)
    kept = by_error(places, values, 300, 1.5)
    assert worst(places, values, kept) <= 1.5 * (1.0 + 1e-12)
    assert kept[0] == 0 and kept[-1] == 299 and 2 < len(kept) < 250
    few = by_error(places, values, 20)
    assert len(few) == 20 and np.all(np.diff(few) > 0)


def test_both_sides_of_a_jump_are_kept():
    places = np.arange(1025)
    values = np.where(places < 317, 0.0, 1.0)[:, None]
    assert {316, 317} <= set(by_error(places, values, 16, 0.01).tolist())


def test_straight_lines_need_their_ends_alone():
    places = np.array([0, 1, 4, 9])
    values = np.stack([2.0 * places, -places], axis=1)
    assert by_error(places, values, 4, 1e-9).tolist() == [0, 3]
    assert by_error(places, values, 3, 1e-9, even=2).tolist() == [0, 2, 3]
    assert by_error(places, 0.0 * values, 4).tolist() == [0, 3]
    assert by_error(places[:1], values[:1], 4).tolist() == [0]


def test_lines_are_dense_where_numbers_bend():
    places = np.arange(500)
    values = np.exp(-places / 20.0)[:, None]
    kept = by_bend(places, values, 40)
    assert kept[0] == 0 and kept[-1] == 499 and 30 <= len(kept) <= 40
    even = np.linspace(0, 499, 40).astype(int)
    assert worst(places, values, kept) < 0.15 * worst(places, values, even)
    assert by_bend(places, 0.0 * values, 40).size == 40
    assert by_bend(places[:5], values[:5], 40).tolist() == [0, 1, 2, 3, 4]
