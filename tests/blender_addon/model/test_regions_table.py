"""How regions differ from the skin around them: their table, and what they do to a state."""

import numpy as np
import pytest

from blender_addon.model.regions import Spots, kinds


def test_the_table_has_what_was_measured_and_marks_what_was_not():
    told = kinds()
    assert told["flush"].blood == pytest.approx(0.83 / 0.24, abs=0.05)
    assert told["palms"].blood == pytest.approx(0.66 / 0.24, abs=0.05)
    assert (told["vitiligo"].melanin, told["palms"].tan, told["moles"].tan) == (0.0, 0.0, 0.0)
    estimates = {name for name, kind in told.items() if kind.is_estimate}
    assert estimates == {"freckles", "moles", "palms", "lips"}


def test_a_freckle_has_half_as_much_again_and_up_to_four_times_the_melanin():
    freckles = kinds()["freckles"]
    melanin, _ = freckles.of_state([0.0, 1.0, 2.0], 0.0, 1.0)
    assert melanin / np.exp([0.0, 1.0, 2.0]) == pytest.approx([1.5, 2.5, 4.1], abs=0.05)


@pytest.mark.parametrize("name", kinds())
def test_nothing_changes_where_a_region_is_not(name):
    melanin, blood = kinds()[name].of_state([0.0, 1.3], [0.0, 0.7], 0.0)
    assert melanin == pytest.approx(np.exp([0.0, 1.3]))
    assert blood == pytest.approx([0.0, 0.7])


@pytest.mark.parametrize("name", ["moles", "palms", "vitiligo"])
def test_what_does_not_tan_keeps_its_melanin(name):
    melanin, _ = kinds()[name].of_state([0.0, 1.8], 0.0, [1.0, 1.0])
    assert melanin[0] == pytest.approx(melanin[1])


def test_spots_cover_the_share_that_balls_fill():
    """Of balls of one size it is the volume of a ball over that of the place that it has."""
    spots = Spots(least=1.0, largest=1.0, edge=0.2, apart=2.0, held=0.5)
    assert spots.share_of_area(1.0) == pytest.approx(0.5 * np.pi / 6.0 / 8.0)
    assert spots.share_of_area(4.0) == pytest.approx(np.pi / 6.0 / 8.0)
    mixed = Spots(least=1.0, largest=3.0, edge=0.2, apart=5.0, held=1.0)
    diameters = 1.0 + 2.0 * np.linspace(0.0, 1.0, 100001) ** 2
    assert mixed.share_of_area(1.0) == pytest.approx(
        np.pi / 6.0 * (diameters**3).mean() / 125.0, rel=1e-4
    )
