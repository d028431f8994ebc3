"""The skin type nearest to a colour."""

import numpy as np
import pytest

from blender_addon.model import catalogue
from blender_addon.model.fitting import nearest_type, type_colours


@pytest.mark.parametrize("name", catalogue.TYPES)
def test_a_type_is_nearest_to_its_own_colour(name):
    colour = type_colours()[name]
    assert nearest_type(colour) == (name, pytest.approx(0.0, abs=1e-6))
    assert nearest_type(colour * 1.01)[0] == name


def test_ends_of_the_scale():
    assert nearest_type(np.full(3, 0.95))[0] == "I"
    assert nearest_type(np.full(3, 0.01))[0] == "VI"
