"""Kinetics as measured in people: against the equations by the hour, and what was measured."""

from dataclasses import replace

import numpy as np
import pytest

from hylios.errors import InputError
from hylios.lab.kinetics_fit import ROWS, numbers, of_numbers, residuals, tans, text
from hylios.tanning import Exposures, MeasuredDynamics, simulate, states_at
from hylios.tanning.shares import responses_of_shares, retained, states_of_shares

PEOPLE = MeasuredDynamics((0.5, 0.3, 0.2), (1.3, -0.2, -0.1), gain=0.1, most=1.5)
SKIN = {"mmd": 5.0, "med": 3.0}


def by_the_hour(doses):
    """New melanin (H,) by the equations as they are printed."""
    energy = signal = formed = fast = slow = 0.0
    made, result = PEOPLE.production * PEOPLE.gain, []
    for hour, dose in enumerate(doses):
        energy = dose + PEOPLE.energy_decay * energy
        signal = energy + PEOPLE.signal_decay * signal
        raised, constant = signal**PEOPLE.hill_exponent, PEOPLE.hill_constant**PEOPLE.hill_exponent
        before = formed
        if hour:
            formed = PEOPLE.forming_decay * before
            formed += (1.0 - PEOPLE.forming_decay) * raised / (raised + constant)
        full = made * before / PEOPLE.most
        fast = fast * (PEOPLE.fast_decay - full) + made * (1.0 - PEOPLE.slow_share) * formed
        slow = slow * (PEOPLE.slow_decay - full) + made * PEOPLE.slow_share * formed
        result.append(fast + slow)
    return np.array(result)


def test_it_is_the_equations_hour_by_hour():
    doses = np.zeros(600)
    doses[[0, 20, 30, 300]] = 1.5, 0.4, 3.0, 12.0
    history = simulate(Exposures(np.arange(600), 5.0 * doses), PEOPLE, hours=599, **SKIN)
    expected = by_the_hour(doses)
    layers = np.array(PEOPLE.untanned) + expected[:, None] * np.array(PEOPLE.places)
    assert history.total == pytest.approx(1.0 + expected, abs=1e-12)
    assert history.melanin == pytest.approx(layers, abs=1e-12)
    assert history.total.max() > 1.2


@pytest.mark.parametrize("dtype", [np.float64, np.float32])
def test_places_with_shares_of_the_doses_at_every_hour_and_at_few(dtype):
    exposures = Exposures([0, 30, 200], [[3.0, 5.0, 20.0], [6.0, 0.0, 2.0]])
    shares = np.array([[0.0, 0.0], [0.3, 0.0], [0.5, 1.0], [1.0, 1.0]])
    energies = retained(exposures, PEOPLE, hours=700, **SKIN)
    expected = states_at(
        Exposures(exposures.hours, shares @ exposures.doses),
        PEOPLE,
        times=np.arange(701),
        **SKIN,
    )
    few = np.unique(
        np.concatenate([[199], np.arange(60), np.arange(200, 260), np.arange(60, 700, 8)])
    )
    for marks, bound in ((np.arange(701), 1e-12 if dtype is np.float64 else 1e-5), (few, 0.003)):
        states = states_of_shares(energies, shares, marks, dtype)
        apart = np.abs(np.swapaxes(states, 0, 1) - expected[:, marks])[..., :3]
        assert states.dtype == dtype and apart.max() < bound


def test_the_response_to_a_share_is_that_to_its_doses():
    exposures = Exposures([0, 30], [[10.0, 5.0]])
    energies = retained(exposures, PEOPLE, hours=100, **SKIN)
    part = retained(Exposures([0, 30], [[3.0, 1.5]]), PEOPLE, hours=100, **SKIN)
    hours = np.array([0, 10, 40, 100])
    told = responses_of_shares(energies[0], np.array([0.0, 0.3]), hours)
    assert np.all(told[0] == 0.0)
    assert told[1] == pytest.approx(responses_of_shares(part[0], np.ones(1), hours)[0], rel=1e-6)


@pytest.mark.parametrize(("step", "bound"), [(3, 0.0015), (6, 0.006)])
def test_other_steps_than_an_hour(step, bound):
    exposures, times = Exposures([5, 60], [15.0, 8.0]), np.arange(0, 960, 24)
    hourly = states_at(exposures, PEOPLE, times=times, **SKIN)
    coarse = states_at(exposures, PEOPLE, times=times, step=step, **SKIN)
    assert np.abs(coarse - hourly)[..., :3].max() < bound


def test_what_was_measured_of_tans_is_met():
    """Small doses that add, the peak's day, months of fading, and a graded response."""
    shown = text(PEOPLE)
    off = residuals(PEOPLE)
    assert off.shape == (len(ROWS),) and np.abs(off).max() < 0.8
    for row in ROWS:
        assert row.case in shown


def test_a_graded_response_without_a_jump():
    doses = np.array([0.25, 0.5, 0.9, 1.0, 1.1, 1.25, 2.0, 3.0, 5.0, 10.0])
    series = np.zeros((doses.size, 24 * 20))
    series[:, 0] = doses
    peaks = tans(PEOPLE, series).max(axis=1)
    assert peaks[3] == pytest.approx(1.0, abs=0.01)
    slopes = np.diff(np.log(peaks)) / np.diff(np.log(doses))
    assert np.all(slopes > 0.0) and np.all(np.diff(slopes) < 0.0) and slopes[0] < 2.3
    assert peaks[6] < 0.5 * peaks[-1] < peaks[8]


def test_constants_there_and_back():
    again = of_numbers(numbers(PEOPLE))
    usual = {name: getattr(PEOPLE, name) for name in ("hill_constant", "fast_decay", "production")}
    assert {name: getattr(again, name) for name in usual} == pytest.approx(usual, rel=2e-3)


@pytest.mark.parametrize(
    ("change", "said"),
    [
        ({"places": (1.0, 1.0, 0.0)}, "the sum of places is 2"),
        ({"untanned": (1.1, -0.1, 0.0)}, "share of melanin without sun"),
        ({"gain": -1.0}, "gain of melanin"),
        ({"slow_decay": 1.0}, "slow_decay"),
    ],
)
def test_what_cannot_be_used_is_said(change, said):
    with pytest.raises(InputError, match=said):
        replace(PEOPLE, **change)
