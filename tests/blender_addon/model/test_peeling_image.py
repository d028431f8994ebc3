"""The image of peeling, against the model that says how much has peeled and what goes with it."""

import numpy as np
import pytest

import hylios
from blender_addon.model.peeling import COLUMNS, peeling_image
from hylios.sun.doses import joined, of_sed
from hylios.tanning import peeled_shares, states_at, without_peeled

SKIN = hylios.skin_type("II", kinetics="measured")
DAYS = (0.0, 30.0)


def image(*doses: tuple[float, float], days=DAYS) -> np.ndarray:
    """Of doses, each of a day and MED."""
    received = joined([of_sed(24.0 * day, burn * SKIN.med) for day, burn in doses])
    how = SKIN.melanin_kinetics, hylios.erythema(SKIN)
    return peeling_image(received, *how, mmd=SKIN.mmd, med=SKIN.med, days=days)


@pytest.mark.parametrize("days", [DAYS, (5.0, 25.0)])
def test_what_the_patches_take_is_what_the_model_says(days):
    """On the mean of the skin, at rows and columns between the outer ones."""
    told = image((0.0, 5.0), (12.0, 5.0), days=days)
    rows, columns = told.shape[:2]
    at = np.arange(2, rows - 2, 7), np.array([1, 20, 40, 50, 62])
    hours = 24.0 * (days[0] + (days[1] - days[0]) * (at[0] + 0.5) / rows)
    given = np.outer((at[1] + 0.5) / columns, [5.0 * SKIN.med] * 2)
    exposures = hylios.Exposures(np.array([0, 288]), given)
    doses = {"times": hours, "mmd": SKIN.mmd, "med": SKIN.med}
    kinetics = SKIN.melanin_kinetics
    shares = peeled_shares(exposures, kinetics, hylios.erythema(SKIN), **doses)
    states = states_at(exposures, kinetics, **doses)
    mean = without_peeled(states, np.array(SKIN.untanned_melanin), shares)[..., :3].sum(axis=-1)
    whole = states[..., :3].sum(axis=-1)
    some = told[at[0]][:, at[1]].swapaxes(0, 1)
    taken = some[..., 1] * (whole - 1.0)
    assert taken.max() > 0.1
    assert taken == pytest.approx(whole - mean, abs=0.01)


def test_little_sun_peels_nowhere_and_edges_are_loose_while_it_peels():
    told = image((0.0, 5.0))
    day = np.linspace(*DAYS, len(told))
    little = int(COLUMNS * 2.9 / 5.0)  # burns below 3 MED
    assert not told[:, :little].any()
    bare = told[:, -1]
    assert not bare[day < 3.7, 2].any()
    assert bare[(day > 5.0) & (day < 8.0), 2].min() > 0.9
    assert bare[day > 16.0, 2].max() < 0.01
    # What has peeled heals where it is: its border stays.
    assert np.ptp(bare[(day > 9.0) & (day < 25.0), 0]) < 1e-6
    assert bare[day > 25.0, 1].max() < 0.6 * bare[:, 1].max()
    assert np.all(told[..., 1] <= told[..., 0] + 1e-6)
