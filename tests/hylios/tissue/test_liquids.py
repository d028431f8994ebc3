"""Liquids on skin: what they let through."""

import numpy as np
import pytest

from hylios.errors import InputError
from hylios.spectra import published_spectra
from hylios.sun.protection import sunscreen
from hylios.tissue.liquids import LIQUIDS


def test_water_absorbs_along_the_way_in_and_out():
    """Half a tenth of a millimetre, twice: exp(-2 a d)."""
    absorption = published_spectra()["water"].at(np.array([1100.0, 1650.0]))
    through = LIQUIDS["water"].twice_through([1100.0, 1650.0])
    assert through == pytest.approx(np.exp(-absorption * 0.01))
    assert through[1] == pytest.approx(0.942, abs=2e-3)


def test_sunscreen_is_black_in_the_ultraviolet_and_clear_elsewhere():
    """Of half the amount of the test a factor is its root, and both ways make it whole again."""
    through = LIQUIDS["sunscreen"].twice_through([300.0, 365.0, 450.0, 1100.0])
    assert through[:2] == pytest.approx([1 / 30, 1 / 10], rel=2e-3)
    assert through[2:] == pytest.approx(1.0, abs=2e-3)
    assert sunscreen(30.0, 1.0).of_sunlight() ** 2 == pytest.approx(1 / 30)


@pytest.mark.parametrize("name", ["water", "oil"])
def test_other_liquids_are_clear_in_the_ultraviolet(name):
    assert LIQUIDS[name].twice_through([365.0]) == pytest.approx(1.0, abs=2e-3)


def test_every_liquid_says_where_its_numbers_come_from():
    for liquid in LIQUIDS.values():
        assert liquid.index_source and liquid.thickness_source
        assert 1.3 < liquid.index < 1.5526


def test_wavelengths_have_a_range():
    with pytest.raises(InputError, match="250 to 2500"):
        LIQUIDS["water"].twice_through([200.0])
