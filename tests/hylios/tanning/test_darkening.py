"""Immediate darkening against what was measured on people (PMID 31206816, 458186; Rosen 1990)."""

from datetime import date

import numpy as np
import pytest

import hylios
from hylios.adding import colours
from hylios.colour_difference import lab
from hylios.errors import InputError
from hylios.sun.action_spectra import Absorptance
from hylios.sun.doses import joined, of_sed
from hylios.tanning import ImmediateDarkening

USUAL = ImmediateDarkening()
SECONDS_10 = 10.0 / 3600.0


def darkened(uva, *minutes):
    """Logarithm of the factor, in what is just seen, some minutes after a flash of J/cm^2."""
    times = SECONDS_10 + np.array(minutes) / 60.0
    return np.log(USUAL.factor([0], [uva], times, SECONDS_10)) / USUAL.just_seen


def test_thresholds():
    """1 J/cm2 is just seen at once; 11 J/cm2 is after the first darkening has gone."""
    assert darkened(1.0, 0.0)[0] == pytest.approx(1.0, abs=0.1)
    assert darkened(11.0, 30.0)[0] == pytest.approx(1.0, abs=0.02)


def test_just_seen_is_a_fall_of_lightness_of_eight_tenths():
    skin = hylios.skin_type("III")
    states = np.array([skin.untanned_state] * 2)
    states[1, :3] *= np.exp(USUAL.just_seen)
    lightness = lab(colours(skin, states).total)[:, 0]
    assert lightness[0] - lightness[1] == pytest.approx(0.8, abs=0.1)


def test_the_first_part_fades_in_minutes():
    at_once, after, later = darkened(0.1, 0.0, 1.4, 15.0)
    assert (after - later) / (at_once - later) == pytest.approx(np.exp(-1.0), abs=0.02)


def test_small_doses_fade_and_large_ones_stay():
    """4 J/cm2 fades fast; 18 J/cm2 passes into the delayed tan without fading."""
    assert darkened(4.0, 0.0)[0] > 2.0 and darkened(4.0, 30.0)[0] < 0.5
    assert darkened(18.0, 120.0)[0] > 1.2 and darkened(18.0, 24.0 * 60.0)[0] > 0.7


def test_it_rises_as_a_first_order_reaction_and_saturates():
    first = darkened(1e9, 0.0)[0]
    assert first == pytest.approx(USUAL.most)
    left = [USUAL.most - darkened(dose, 0.0)[0] for dose in (0.0, 2.0, 4.0)]
    assert left[1] / left[0] == pytest.approx(left[2] / left[1], rel=1e-9)


def test_hours_of_sun_know_their_uva():
    """Noon in June is about 20 J/cm2 an hour; doses in SED know none."""
    absorptance = Absorptance(np.array([280.0, 400.0]), np.array([0.9, 0.6]))
    sun = hylios.sun_doses(date(2025, 6, 21), 11, 13, 40.0, absorptance)
    assert sun.uva == pytest.approx([20.0, 20.0], abs=2.0)
    together = joined([of_sed(0, 3.0), sun])
    assert of_sed(0, 3.0).uva is None and joined([of_sed(0, 3.0)]).uva is None
    assert (
        together.uva is not None
        and np.array_equal(together.uva[1:], sun.uva)
        and together.uva[0] == 0.0
    )
    factor = USUAL.factor(together.hours, together.uva, [5, 11, 13, 37])
    assert factor[0] == factor[1] == 1.0 and factor[2] > 1.2 and 1.0 < factor[3] < factor[2]


def test_histories_and_what_is_no_dose():
    many = USUAL.factor([0, 9], [[20.0, 0.0], [20.0, 5.0]], [3.5, 12.0])
    assert many.shape == (2, 2) and many[0, 0] == many[1, 0] and many[1, 1] > many[0, 1]
    assert np.all(USUAL.factor([], [], [1.0]) == 1.0)
    for given, said in (
        (([0], [1.0, 2.0], [1.0]), r"doses of UVA have shape \(2,\) at 1 hours"),
        (([0], [-1.0], [1.0]), "dose of UVA is -1; allowed is 0 to"),
        (([0], [1.0], [-1.0]), "time is -1; allowed is 0 to"),
        (([0], None, [1.0]), "doses of UVA are None; needed are those of the sun or of a spectrum"),
        (([0], [1.0], [1.0], 0.0), "duration is 0; allowed is 1e-06 to"),
    ):
        with pytest.raises(InputError, match=said):
            USUAL.factor(*given)
    with pytest.raises(InputError, match="most darkening is 1"):
        ImmediateDarkening(most=1.0)
