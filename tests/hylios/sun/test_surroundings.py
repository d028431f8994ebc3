"""The ground and clouds."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from hylios.errors import InputError
from hylios.sun.surroundings import GROUNDS, cloud_factor, ground_albedo


def test_grounds_lie_in_what_was_measured():
    for ground in GROUNDS.values():
        assert 0.0 < ground.low <= ground.albedo <= ground.high < 1.0
    assert ground_albedo("snow") > ground_albedo("sand") > ground_albedo("grass")


def test_clouds_by_class():
    """Clear, scattered, broken, overcast, and half of the sky between two of them."""
    covers = [0.0, 0.375, 0.5, 0.75, 1.0]
    expected = [1.0, 0.89, 0.89 - 0.16 / 3.0, 0.73, 0.31]
    assert cloud_factor(covers) == pytest.approx(expected)
    assert cloud_factor(np.ones((2, 3))).shape == (2, 3)


@given(st.floats(0.0, 1.0), st.floats(0.0, 1.0))
def test_more_clouds_are_never_more_light(cover, other):
    assert cloud_factor(max(cover, other)) <= cloud_factor(min(cover, other))


@pytest.mark.parametrize("cover", [-0.1, 1.5, np.nan])
def test_a_cover_out_of_range_is_named(cover):
    with pytest.raises(InputError, match=f"cloud cover is {cover:g}; allowed is 0 to 1"):
        cloud_factor([0.5, cover])


def test_a_ground_that_there_is_not_is_named():
    with pytest.raises(InputError, match="the ground is 'lava'; allowed are grass, water, sand"):
        ground_albedo("lava")
