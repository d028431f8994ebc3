"""The sheet near which one kinetics' states lie: its colours against those of exact states."""

from dataclasses import replace

import numpy as np
import pytest

from hylios.adding import colours
from hylios.errors import InputError
from hylios.lab.colour import difference
from hylios.skin.biology import Biology
from hylios.skin.phototypes import phototype
from hylios.tanning import Exposures, MelaninDynamics, spread_of, states_at, usual_thickness

MEAN, LARGEST = {"II": 0.004, "III": 0.004, "V": 0.012, "VI": 0.03}, 0.2
"""CIEDE2000 allowed in the mean, and anywhere; the untanned spread would be .5 and 1.2 off."""


def spread(name):
    skin = phototype(name).skin
    return skin, spread_of(skin.dynamics, mmd=skin.mmd, med=skin.med)


def reached(skin, count):
    """States (count, 4) of other schedules than the sheet's."""
    random = np.random.default_rng(5)
    hours = random.integers(0, 960, (12, 8))
    doses = skin.mmd * random.uniform(0.4, 8.0, (12, 8))
    states = np.concatenate(
        [
            states_at(
                Exposures(*one),
                skin.dynamics,
                times=np.arange(24.0, 1200.0, 30.0),
                mmd=skin.mmd,
                med=skin.med,
            )
            for one in zip(hours, doses, strict=True)
        ]
    )
    return states[random.choice(len(states), count, replace=False)]


def on_sheet(sheet, states):
    return sheet.states(np.log(states[:, :3].sum(axis=1)), np.log(states[:, 3]))


@pytest.mark.parametrize("name", list(MEAN))
def test_states_on_the_sheet_look_like_those_reached(name):
    skin, sheet = spread(name)
    states = reached(skin, 24)
    seen = colours(skin, on_sheet(sheet, states)[:, :4], count=5).total
    apart = difference(colours(skin, states, count=5).total, seen)
    assert apart.mean() < MEAN[name] and apart.max() < LARGEST


@pytest.mark.parametrize(("name", "mean", "largest"), [("III", 0.004, 0.03), ("VI", 0.045, 0.22)])
def test_tans_of_one_exposure_look_like_those_on_the_sheet(name, mean, largest):
    """The most usual tan, while it rises and fades: .08 and .31 off in VI by a sheet of schedules
    with several exposures alone."""
    skin, sheet = spread(name)
    days = np.array([1.0, 2.0, 3.0, 5.0, 7.0, 10.0, 15.0, 20.0, 30.0])
    states = np.concatenate(
        [
            skin.states(Exposures([0], [multiple * skin.mmd]), 24.0 * days)[:, :4]
            for multiple in (1.2, 1.7, 2.0, 3.0, 5.0, 9.0)
        ]
    )
    seen = colours(skin, on_sheet(sheet, states)[:, :4], count=4).total
    apart = difference(colours(skin, states, count=4).total, seen)
    assert apart.mean() < mean and apart.max() < largest


@pytest.mark.parametrize(("name", "melanin"), [("I", 1.0), ("III", 1.0), ("III", 1.8), ("VI", 1.2)])
def test_the_measured_kinetics_reaches_the_ends_of_its_sheet(name, melanin):
    """Simulated alone: sheets of skins share what leads to their melanin. VI has room for less."""
    usual = phototype(name).skin
    skin = replace(usual, kinetics="measured", specimen=Biology(melanin).of(usual.specimen))
    kinetics = skin.melanin_kinetics
    sheet = spread_of(kinetics, mmd=skin.mmd, med=skin.med)
    doses = skin.mmd * np.geomspace(1.05, 10.5, 24)[:, None]
    times = np.arange(0.0, 1440.0, 12.0)
    alone = states_at(Exposures([0], doses), kinetics, times=times, mmd=skin.mmd, med=skin.med)
    u, v = np.log(alone[..., :3].sum(axis=-1)), np.log(alone[..., 3])
    assert u.min() == pytest.approx(sheet.least.min(), abs=1e-12)
    assert u.max() <= sheet.most.max() + 1e-12 and v.max() <= sheet.thicknesses[-1] + 1e-12
    shares = alone[..., :3] / alone[..., :3].sum(axis=-1, keepdims=True)
    told = sheet.states(u, v)[..., :3] / np.exp(u)[..., None]
    np.testing.assert_allclose(told, shares, atol=0.004)


@pytest.mark.parametrize("name", ["I", "III", "VI"])
def test_a_state_keeps_melanin_thickness_and_blood_and_is_untanned_at_0(name):
    skin, sheet = spread(name)
    assert sheet.states(0.0, 0.0) == pytest.approx([*skin.untanned_state, 1.0], abs=1e-12)
    melanin, thickness, blood = np.array([[-6.0, 0.3, 2.5], [0.0, 0.1, 0.4], [0.0, 1.0, 2.0]])
    states = sheet.states(melanin[:, None, None], thickness[:, None], blood)
    assert states.shape == (3, 3, 3, 5)
    assert np.log(states[..., :3].sum(axis=-1)) == pytest.approx(
        np.broadcast_to(melanin[:, None, None], (3, 3, 3)), abs=1e-12
    )
    assert np.log(states[..., 3]) == pytest.approx(
        np.broadcast_to(thickness[:, None], (3, 3, 3)), abs=1e-12
    )
    assert np.log(states[..., 4]) == pytest.approx(np.broadcast_to(blood, (3, 3, 3)), abs=1e-12)


def test_beyond_what_is_reached_the_spread_is_that_of_the_nearest_reached():
    skin, sheet = spread("V")
    states = reached(skin, 400)
    own = np.log(states[:, :3] / sheet.untanned) @ sheet.directions
    far = np.meshgrid(np.linspace(-9.0, 4.0, 40), np.linspace(-1.0, 2.0, 40))
    there = sheet.log_ratios(*far)
    margin = 0.6 * np.ptp(own, axis=0)
    assert np.all(there >= own.min(axis=0) - margin) and np.all(there <= own.max(axis=0) + margin)
    assert sheet.log_ratios(-6.0, 0.0) == pytest.approx(sheet.log_ratios(-9.0, -1.0))


def test_skin_that_makes_no_melanin_spreads_it_as_without_sun():
    skin, sheet = spread("I")
    shares = sheet.states([-3.0, 0.0, 2.0], [0.0, 0.2, 0.1])[:, :3]
    shares = shares / shares.sum(axis=1, keepdims=True)
    assert shares == pytest.approx(np.tile(skin.untanned_melanin, (3, 1)), abs=1e-9)


def test_the_sheet_is_made_once_and_its_directions_leave_the_total_out():
    skin, sheet = spread("III")
    assert spread_of(skin.dynamics, mmd=skin.mmd, med=skin.med) is sheet
    assert sheet.directions.sum(axis=0) == pytest.approx(0.0, abs=1e-12)
    assert sheet.directions.T @ sheet.directions == pytest.approx(np.eye(2), abs=1e-12)


def test_a_layer_without_melanin_has_no_spread():
    bare = MelaninDynamics((0.01, 0.0, 0.0), (0.0, 0.0, 0.0), (0.01, 0.0, 0.0), (0.04, 0.0, 0.0))
    with pytest.raises(InputError, match="allowed is more than 0 in each"):
        spread_of(bare, mmd=4.0, med=3.0)
    with pytest.raises(InputError, match="melanin are dark"):
        spread("III")[1].states("dark", 0.0)


def test_an_even_sheet_holds_a_light_tan_that_still_comes():
    """Of VI: few schedules lead through so little melanin in skin that is thicker already."""
    skin, sheet = spread("VI")
    even = spread_of(skin.dynamics, mmd=skin.mmd, med=skin.med, evenly=True)
    states = skin.states(Exposures([0], [1.1 * skin.mmd]), [72.0, 96.0, 120.0, 144.0])[:, :4]
    shares = states[:, :3] / states[:, :3].sum(axis=1, keepdims=True)
    usual, evenly = (
        np.abs(np.log(told / told.sum(axis=1, keepdims=True) / shares)).max(axis=1)
        for told in (on_sheet(one, states)[:, :3] for one in (sheet, even))
    )
    assert evenly.max() < 0.1 < usual.min()


def test_skin_that_gets_no_darker_has_one_usual_thickness():
    """The mean over the schedules' times, most of which are days without sun."""
    skin = phototype("I").skin
    melanin, thickness = usual_thickness(skin.dynamics, mmd=skin.mmd, med=skin.med)
    assert melanin == pytest.approx([0.0]) and 0.02 < thickness[0] < 0.15


def test_the_darkest_tans_are_of_thick_skin_and_faded_ones_of_thin():
    skin = phototype("VI").skin
    melanin, thickness = usual_thickness(skin.dynamics, mmd=skin.mmd, med=skin.med)
    most = spread("VI")[1].thicknesses[-1]
    assert np.all(np.diff(melanin) > 0.0) and melanin[0] == 0.0
    assert thickness[0] < 0.2 * most and np.all(thickness < most)
    assert thickness[-1] > 0.7 * most
