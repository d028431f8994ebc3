"""Peeling after a burn: when it is told of people, what it takes, and its limits."""

import numpy as np
import pytest

import hylios
from hylios.adding import colours
from hylios.colour_difference import lab
from hylios.errors import InputError
from hylios.tanning import LARGEST_DOSE, Exposures
from hylios.tanning.peeling import Peeling, peeled_shares, without_peeled

SKIN = hylios.skin_type("III")
DOSES = {"mmd": SKIN.mmd, "med": SKIN.med}


def peeled(exposures, times, **more):
    reddening = hylios.erythema(SKIN)
    return peeled_shares(exposures, SKIN.dynamics, reddening, times=times, **DOSES, **more)


def burnt(*doses):
    return Exposures([0], SKIN.med * np.array(doses)[:, None])


def test_small_burns_do_not_peel_and_large_ones_do():
    shares = peeled(burnt(1.0, 2.9, 4.5, 6.0, 40.0), 24.0 * np.arange(30))
    most = shares.max(axis=1)
    assert np.all(most[:2] == 0.0) and 0.4 < most[2] < 0.5 and most[3] == most[4] > 0.85
    assert np.all((shares >= 0.0) & (shares <= 1.0))


def test_it_begins_on_day_3_to_7_and_lasts_3_to_7_days():
    times = np.arange(30 * 24.0)
    share = peeled(burnt(8.0), times)[0]
    first, last = times[share > 0.05][0] / 24.0, times[share.argmax()] / 24.0
    assert 3.0 <= first <= 7.0 and 3.0 <= last - first <= 7.0
    assert share[-1] < 0.5 * share.max()


def test_a_tan_saves_from_peeling():
    """The last of twelve days with rising doses peels less than the same dose alone."""
    days, doses = 24 * np.arange(14), SKIN.med * np.append(np.linspace(0.3, 1.5, 13), 8.0)
    tanned, alone = (
        peeled(one, [24.0 * 24])
        for one in (Exposures(days, doses), Exposures([days[-1]], doses[-1:]))
    )
    assert alone > 0.5 and tanned < 0.5 * alone


def test_it_takes_new_melanin_only():
    untanned = SKIN.untanned_melanin
    states = SKIN.states(Exposures([0], [6.0 * SKIN.med]), [0, 216])
    skin = without_peeled(states, untanned, [1.0, 1.0])
    assert skin[0] == pytest.approx(states[0], abs=1e-12)
    assert skin[1, 0] == states[1, 0] and skin[1, :3].sum() == pytest.approx(1.0)
    lightness = lab(colours(SKIN, np.stack([states[1], skin[1], SKIN.untanned_state])).total)[:, 0]
    assert lightness[0] + 3.0 < lightness[1] and lightness[1] == pytest.approx(
        lightness[2], abs=0.5
    )
    half = without_peeled(states, untanned, 0.5)
    assert half == pytest.approx(0.5 * (states + skin))
    measured = hylios.skin_type("III", kinetics="measured")
    tan = measured.states(Exposures([0], [6.0 * measured.med]), [216])
    left = without_peeled(tan, measured.untanned_melanin, 1.0)
    assert 1.0 < left[0, :3].sum() < tan[0, :3].sum()


def test_histories_times_and_limits():
    many = Exposures([0, 300], SKIN.med * np.array([[5.0, 0.0], [0.0, 8.0]]))
    times = [500.0, 170.25, 0.0]
    shares = peeled(many, times)
    assert shares.shape == (2, 3) and shares[1, 1] == 0.0 and shares[1, 0] > 0.5
    alone = peeled(Exposures([0, 300], many.doses[0]), times)
    assert np.array_equal(alone, shares[0])
    assert peeled(Exposures(), [5.0, 90000.0]).tolist() == [0.0, 0.0]
    assert peeled(many, []).shape == (2, 0)
    assert 0.0 < peeled(Exposures([0], [LARGEST_DOSE]), [200.0])[0] <= 1.0
    for change, said in (
        ({"full": 3.0}, "burn that peels fully is 3 MED"),
        ({"healing": 0.0}, "healing of peeling is 0"),
        ({"duration": 0}, "duration of peeling is 0 hours"),
    ):
        with pytest.raises(InputError, match=said):
            Peeling(**change)
    with pytest.raises(InputError, match="times are -1"):
        peeled(many, -1)


@pytest.mark.parametrize("shares", [5.0, np.nan, "a", [0.1, 0.2, 0.3]])
def test_shares_that_have_peeled_are_0_to_1_and_one_for_each_state(shares):
    untanned = hylios.skin_type("II").untanned_melanin
    states = np.ones((2, 4))
    with pytest.raises(InputError, match="shares that have peeled"):
        without_peeled(states, untanned, shares)
