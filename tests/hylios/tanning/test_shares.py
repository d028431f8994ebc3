"""Places with shares of the same doses, at uneven hours, against the simulation by the hour."""

import numpy as np
import pytest

from hylios.errors import InputError
from hylios.tanning import (
    PIGMENTATIONS,
    Burns,
    ErythemaDynamics,
    Exposures,
    MelaninDynamics,
    hill,
    states_at,
)
from hylios.tanning.shares import responses_of_shares, retained, states_of_shares

SKIN = {"mmd": 4.9, "med": 2.9}
DAYS = 20


def schedule(random, kinds: int, count: int = 6) -> Exposures:
    hours = random.integers(0, 24 * DAYS - 100, count)
    doses = random.uniform(1.0, 20.0, (kinds, count)) * (random.random((kinds, count)) < 0.6)
    return Exposures(hours, doses, 0.8 * doses)


@pytest.mark.parametrize("kinds", [1, 2, 5])
@pytest.mark.parametrize("pigmentation", PIGMENTATIONS)
def test_at_every_hour_it_is_the_simulation(kinds, pigmentation):
    random = np.random.default_rng(kinds)
    exposures, shares = schedule(random, kinds), random.random((9, kinds))
    shares[0] = 0.0
    energies = retained(exposures, PIGMENTATIONS[pigmentation], hours=24 * DAYS, **SKIN)
    hours = np.arange(24 * DAYS + 1)
    states = states_of_shares(energies, shares, hours)
    received = Exposures(
        exposures.hours, shares @ exposures.doses, shares @ exposures.thickening_doses
    )
    expected = states_at(received, PIGMENTATIONS[pigmentation], times=hours, **SKIN)
    assert np.abs(np.swapaxes(states, 0, 1) - expected).max() < 1e-12
    assert np.all(states[:, 0] == states[0, 0])


@pytest.mark.parametrize(("dtype", "bound"), [(np.float64, 0.003), (np.float32, 0.00301)])
def test_uneven_hours_meet_the_hourly_curve(dtype, bound):
    """Every hour for a day after an exposure, then ever longer steps, up to two days."""
    exposures = Exposures([0, 200], [30.0, 12.0])
    since = np.unique(np.cumsum(np.maximum(1, np.arange(60) // 2)))
    marks = np.unique(np.concatenate([[0, 199], since[since < 199], 200 + since]))
    shares = np.array([0.0, 0.2, 0.6, 1.0])
    for dynamics in PIGMENTATIONS.values():
        energies = retained(exposures, dynamics, hours=int(marks[-1]), **SKIN)
        states = states_of_shares(energies, shares, marks, dtype)
        assert states.dtype == dtype and states.shape == (len(marks), 4, 4)
        received = Exposures(exposures.hours, shares[:, None] * exposures.doses)
        expected = states_at(received, dynamics, times=marks, **SKIN)
        assert np.abs(np.swapaxes(states, 0, 1) - expected).max() < bound


@pytest.mark.parametrize("first", [0, 190, 474])
def test_hours_before_the_first_are_simulated_and_not_told(first):
    random = np.random.default_rng(3)
    exposures, shares = schedule(random, 2), random.random((9, 2))
    energies = retained(exposures, PIGMENTATIONS["low"], hours=24 * DAYS, **SKIN)
    burns = Burns.of(exposures, ErythemaDynamics(), SKIN["med"])
    marks = np.arange(0, 24 * DAYS, 6)
    for own in (None, burns):
        whole = states_of_shares(energies, shares, marks, burns=own)
        told = states_of_shares(energies, shares, marks, burns=own, first=first)
        assert told == pytest.approx(whole[marks >= first], abs=1e-12)


def test_decays_of_nearly_1_in_single_precision():
    """Melanin that hardly fades; the sums over a step must not be rounding alone."""
    usual = PIGMENTATIONS["intermediate"]
    for decay in (1.0 - 1e-9, 1.0 - 1e-5, 0.9999):
        slow = MelaninDynamics(
            production=(1e-9, 0.0, 0.0),
            transfer=(0.0, 0.0, 0.0),
            extra_production=usual.extra_production,
            extra_transfer=(0.0, 0.0, 0.0),
            melanin_decay=decay,
        )
        energies = retained(Exposures([0], [30.0]), slow, hours=480, **SKIN)
        marks = np.arange(0, 481, 8)
        rough = states_of_shares(energies, [0.5], marks, np.float32)
        fine = states_of_shares(energies, [0.5], marks)
        assert rough[-1, 0, :2] == pytest.approx(fine[-1, 0, :2], rel=0.002)


def test_responses_to_all_shares_are_those_of_the_signal():
    exposures = schedule(np.random.default_rng(3), 1)
    dynamics = PIGMENTATIONS["low"]
    melanin, _ = retained(exposures, dynamics, hours=24 * DAYS, **SKIN)
    shares, hours = np.linspace(0.0, 1.0, 33), np.array([0, 50, 317, 24 * DAYS])
    energy = shares[:, None] * melanin.energy
    energy[energy < 1.0] = 0.0
    signal = rate = np.zeros(len(shares))
    signals = []
    for arriving in energy.T:
        rate = dynamics.signal_rate_decay * rate + arriving
        signal = dynamics.signal_decay * signal + rate
        signals.append(signal)
    expected = hill(np.array(signals)[hours].T, dynamics.hill_constant, dynamics.hill_exponent)
    assert responses_of_shares(melanin, shares, hours) == pytest.approx(expected, abs=1e-6)


def test_without_doses():
    energies = retained(Exposures(), PIGMENTATIONS["low"], hours=48, **SKIN)
    states = states_of_shares(energies, [0.0, 1.0], np.array([0, 7, 48]))
    assert np.array_equal(states, np.broadcast_to(states[0, 0], (3, 2, 4)))
    assert not responses_of_shares(energies[0], np.array([0.0, 1.0]), np.array([3])).any()


@pytest.mark.parametrize(
    ("shares", "marks", "sentence"),
    [
        ([0.5, 1.1], [0, 5], r"shares have shape \(2, 1\); allowed are 0 to 1 of 1 kinds"),
        ([[0.5, 0.5]], [0, 5], r"shares have shape \(1, 2\)"),
        ([np.nan], [0, 5], "shares"),
        ([0.5], [1, 5], r"marks are \[1 5\]; allowed are ascending hours from 0 to 48"),
        ([0.5], [0, 5, 5], "marks are"),
        ([0.5], [0, 49], "marks are"),
        ([0.5], [], "marks are"),
    ],
)
def test_bad_shares_and_marks_are_named(shares, marks, sentence):
    energies = retained(Exposures([0], [9.0]), PIGMENTATIONS["low"], hours=48, **SKIN)
    with pytest.raises(InputError, match=sentence):
        states_of_shares(energies, shares, np.array(marks, dtype=int))


def test_bad_minimal_doses_and_hours_are_named():
    with pytest.raises(InputError, match="MMD is 0"):
        retained(Exposures(), PIGMENTATIONS["low"], mmd=0.0, med=1.0, hours=5)
    with pytest.raises(InputError, match="last hour is -1"):
        retained(Exposures(), PIGMENTATIONS["low"], hours=-1, **SKIN)
