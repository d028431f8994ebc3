"""The curve of a tan: what it says is what the table and the tanning model say."""

from dataclasses import replace

import numpy as np
import pytest
from exposures import USUAL

from blender_addon.model import catalogue, curve
from blender_addon.model.settings import TanSettings
from hylios.colour_difference import lab
from hylios.skin.phototypes import phototype
from hylios.tanning import Exposures, states_at

EXPOSURE = replace(USUAL, dose=25.0)
SETTINGS = TanSettings(
    table=catalogue.shipped_path("III"),
    own_doses=None,
    exposures=(EXPOSURE,),
    first_day=0.0,
    last_day=60.0,
)


def test_lightness_is_that_of_the_table_at_the_simulated_state():
    made = curve.curve_of(SETTINGS)
    skin, table = phototype("III").skin, catalogue.table(SETTINGS.table)
    hours = np.round(24.0 * made.days).astype(int)
    states = states_at(
        Exposures([0], [25.0]), skin.dynamics, times=hours, mmd=skin.mmd, med=skin.med
    )
    expected = lab(table.lookup(states, ["total_colour"])["total_colour"])[..., 0]
    np.testing.assert_allclose(made.lightness, expected.ravel(), atol=0.15)


def test_words_name_the_darkest_day_and_the_day_by_which_half_is_gone():
    made = curve.curve_of(SETTINGS)
    half = 0.5 * (made.untanned + made.lightness[made.darkest])
    assert made.half_gone is not None and made.half_gone > made.days[made.darkest]
    assert np.interp(made.half_gone, made.days, made.lightness) == pytest.approx(half, abs=0.01)
    darkest, gone = curve.words(made)
    assert darkest == f"Darkest on day {made.darkest_day:.0f},"
    assert gone == f"half gone by day {made.half_gone:.0f}, all by {made.gone:.0f}"
    left = made.untanned - np.interp([made.gone, 60.0], made.days, made.lightness)
    assert left[0] == pytest.approx(curve.PLAIN, abs=0.01) and left[1] < curve.PLAIN
    longer = curve.curve_of(replace(SETTINGS, last_day=35.0))
    assert longer.gone is None and "all by 35" not in curve.words(longer)[1]
    short = curve.curve_of(replace(SETTINGS, last_day=12.0))
    assert curve.words(short)[1] == "not half gone by day 12"
    none = curve.curve_of(replace(SETTINGS, exposures=()))
    assert curve.words(none) == ("No tan that can be seen",)


def test_half_is_gone_for_good():
    """Not where a second exposure makes the skin darker again."""
    again = replace(EXPOSURE, day=33.0, dose=22.0)
    twice = curve.curve_of(replace(SETTINGS, exposures=(EXPOSURE, again), last_day=90.0))
    half = 0.5 * (twice.untanned + twice.lightness[twice.darkest])
    later = twice.lightness[twice.days > twice.half_gone]
    assert twice.half_gone > 43.0 and np.all(later > half)


def test_the_picture_shows_the_colours_and_the_line():
    made = curve.curve_of(SETTINGS)
    pixels = curve.picture(made, made.colours)
    assert pixels.shape == (curve.HEIGHT, curve.WIDTH, 4)
    assert pixels.min() >= 0.0 and pixels.max() <= 1.0
    np.testing.assert_allclose(pixels[0, 0, :3], made.colours[0], atol=1e-6)
    np.testing.assert_allclose(pixels[0, -1, :3], made.colours[-1], atol=1e-6)
    line = np.abs(pixels - curve.LINE.astype(np.float32)).sum(axis=-1).argmin(axis=0)
    darkest = int(made.darkest / (len(made.days) - 1) * (curve.WIDTH - 1))
    assert abs(int(line.argmin()) - darkest) < 0.1 * curve.WIDTH


@pytest.mark.parametrize(
    ("last_day", "lines", "name"), [(5.0, 5, "days"), (30.0, 5, "weeks"), (365.0, 14, "4 weeks")]
)
def test_upright_lines_are_few_enough_to_tell_apart(last_day, lines, name):
    made = curve.curve_of(replace(SETTINGS, last_day=last_day))
    assert curve.key(made)[-1] == f"Upright lines: {name}"
    row = curve.picture(made, made.colours)[curve.STRIP + curve.MARGIN + 1]
    assert np.isclose(row, curve.GRID).all(axis=1).sum() in (lines, lines - 1)  # one may be hidden


def test_lines_leave_the_colours_alone():
    """A steep one, as many burns over a year have, was drawn into them."""
    burns = tuple(replace(EXPOSURE, day=day, dose=30.0) for day in range(0, 300, 30))
    settings = replace(SETTINGS, exposures=burns, last_day=365.0, redness=True)
    made = curve.curve_of(settings)
    pixels = curve.picture(made, made.colours)
    np.testing.assert_array_equal(pixels[: curve.STRIP], pixels[:1].repeat(curve.STRIP, axis=0))
    assert not pixels[curve.HEIGHT - curve.MARGIN + 1 :].any()
