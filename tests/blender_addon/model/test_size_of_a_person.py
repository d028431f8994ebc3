"""Which sizes a person has, and how many times life-size a model is."""

import pytest

from blender_addon.model.size import is_a_person_s, lines_on, times_life_size
from blender_addon.model.summary import LINE


@pytest.mark.parametrize(
    "metres",
    [
        1.7,  # a body
        2.72,  # the tallest
        2.9,  # a tall one who stretches his arms
        0.5,  # a baby
        0.19,  # a hand
        0.06,  # an ear
        0.025,  # the last joint of a finger
        0.0,  # a mesh without vertices
    ],
)
def test_a_person_and_its_parts_are_right(metres):
    assert is_a_person_s(metres) and lines_on(metres) == ()
    assert times_life_size(metres) == 1.0


@pytest.mark.parametrize(
    ("metres", "factor"),
    [
        (17.0, 10.0),  # of MPFB, in decimetres
        (11.0, 10.0),  # a child
        (170.0, 100.0),  # centimetres
        (1700.0, 1000.0),  # millimetres
        (66.9, 39.37),  # inches
        (5.6, 3.2808),  # feet
        (0.017, 0.01),  # metres in a scene of centimetres
        (0.0017, 0.001),
        (500.0, 500.0 / 1.7),  # no unit fits
    ],
)
def test_others_are_mended_by_the_unit_that_fits(metres, factor):
    assert not is_a_person_s(metres)
    assert times_life_size(metres) == pytest.approx(factor)
    assert is_a_person_s(metres / factor)


@pytest.mark.parametrize("metres", [3.1, 17.0, 1234.5, 0.0249, 1e-5])
def test_lines_fit_into_the_panel(metres):
    lines = lines_on(metres)
    assert len(lines) == 2 and all(len(line) <= LINE for line in lines)
