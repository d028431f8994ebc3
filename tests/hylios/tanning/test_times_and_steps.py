"""States at any times, in steps of any length, of many histories at once."""

import tracemalloc

import numpy as np
import pytest

from hylios.errors import InputError
from hylios.tanning import (
    PIGMENTATIONS,
    Exposures,
    simulate,
    simulation,
    states_at,
)

MELANIN_ERROR = {2: 0.002, 3: 0.0033, 6: 0.011, 12: 0.032, 24: 0.09}
TOTAL_ERROR = {2: 0.001, 3: 0.0014, 6: 0.0046, 12: 0.015, 24: 0.052}
THICKNESS_ERROR = {2: 0.0085, 3: 0.0142, 6: 0.030, 12: 0.063, 24: 0.105}


def test_states_at_any_times():
    """In any order, interpolated between two hours, whatever else is asked for."""
    dynamics, exposures = PIGMENTATIONS["low"], Exposures([0, 30], [[10.0, 5.0], [3.0, 20.0]])
    hourly = simulate(exposures, dynamics, mmd=2.89, med=1.7, hours=200).states
    times = np.array([200.0, 0.0, 17.25, 17.0, 99.5])
    states = states_at(exposures, dynamics, times=times, mmd=2.89, med=1.7)
    between = 0.75 * hourly[:, 17] + 0.25 * hourly[:, 18]
    expected = [hourly[:, 200], hourly[:, 0], between, hourly[:, 17]]
    expected.append(0.5 * hourly[:, 99] + 0.5 * hourly[:, 100])
    assert np.allclose(states, np.stack(expected, axis=1), rtol=1e-15)
    alone = states_at(exposures, dynamics, times=[17.25], mmd=2.89, med=1.7)
    assert np.array_equal(alone[:, 0], states[:, 2])
    nothing = states_at(exposures, dynamics, times=[], mmd=2.89, med=1.7)
    assert nothing.shape == (2, 0, 4)


def most_memory(exposures, times):
    """States at times, and the most bytes that they took while they were computed."""
    tracemalloc.start()
    try:
        states = states_at(exposures, PIGMENTATIONS["low"], times=times, mmd=2.89, med=1.7)
        return states, tracemalloc.get_traced_memory()[1]
    finally:
        tracemalloc.stop()


def test_nothing_is_simulated_past_the_last_time():
    """An exposure in 91 years costs no memory, and changes nothing by day 2."""
    times = [5.5, 47.5]
    early, usual = most_memory(Exposures([0], [10.0]), times)
    late, peak = most_memory(Exposures([0, 800_000], [10.0, 10.0]), times)
    assert np.array_equal(late, early)
    assert peak < usual + 10_000


@pytest.mark.parametrize("step", list(MELANIN_ERROR))
def test_longer_steps_give_the_same_curve(step):
    """Within the error that `states_at` states, at the steps and between them."""
    random = np.random.default_rng(step)
    when = random.choice(1440, 11, replace=False)
    exposures = Exposures(when, random.uniform(0.35, 10.5, (8, 11)))
    arguments = {"times": np.arange(0.0, 1441.0), "mmd": 1.0, "med": 0.6}
    for dynamics in PIGMENTATIONS.values():
        hourly = states_at(exposures, dynamics, **arguments)
        apart = states_at(exposures, dynamics, step=step, **arguments) - hourly
        assert np.abs(apart[..., :3]).max() < MELANIN_ERROR[step]
        assert np.abs(apart[..., :3].sum(axis=-1)).max() < TOTAL_ERROR[step]
        assert np.abs(apart[..., 3]).max() < THICKNESS_ERROR[step]


def test_a_step_may_be_a_float():
    dynamics, exposures = PIGMENTATIONS["low"], Exposures([0], [10.0])
    arguments = {"times": [7.0, 48.0], "mmd": 2.89, "med": 1.7}
    whole = states_at(exposures, dynamics, step=3, **arguments)
    assert np.array_equal(states_at(exposures, dynamics, step=3.0, **arguments), whole)


@pytest.mark.parametrize("step", [1 / 2, 1 / 3, 1 / 60])
def test_shorter_steps_meet_the_curve_at_every_hour(step):
    dynamics, exposures = PIGMENTATIONS["high"], Exposures([0, 7], [10.0, 20.0])
    hourly = simulate(exposures, dynamics, mmd=2.89, med=1.7, hours=50)
    finer = simulate(exposures, dynamics, mmd=2.89, med=1.7, hours=50, step=step)
    assert finer.hours[-1] == pytest.approx(50.0)
    parts = round(1.0 / step)
    assert np.allclose(finer.states[::parts], hourly.states, rtol=1e-13)
    low = np.minimum(hourly.states[:-1], hourly.states[1:])
    high = np.maximum(hourly.states[:-1], hourly.states[1:])
    inside = finer.states[parts // 2 : -1 : parts]
    assert np.all((inside >= low - 1e-12) & (inside <= high + 1e-12))


@pytest.mark.parametrize("step", [0, -1, 1.5, 0.4, 25, 1e-3, float("nan"), "1", True])
def test_a_bad_step_is_named(step):
    with pytest.raises(InputError, match="step is .* allowed is 1 to 24 in whole numbers"):
        simulate(Exposures(), PIGMENTATIONS["low"], mmd=1.0, med=1.0, hours=10, step=step)


@pytest.mark.parametrize("times", [[-1.0], [np.nan], [1e9], 5.0, [[1.0]], "noon", [[1.0], 2.0]])
def test_bad_times_are_named(times):
    with pytest.raises(InputError, match="times are .* (allowed is|expected an)"):
        states_at(Exposures(), PIGMENTATIONS["low"], times=times, mmd=1.0, med=1.0)


def test_many_histories_at_once_equal_each_alone(monkeypatch):
    random = np.random.default_rng(3)
    hours = np.sort(random.choice(400, 6, replace=False))
    doses = random.uniform(0.0, 30.0, (7, 6))
    dynamics = PIGMENTATIONS["high"]
    together = simulate(Exposures(hours, doses), dynamics, mmd=5.0, med=3.0, hours=500)
    monkeypatch.setattr(simulation, "CELLS_TOGETHER", 1500)  # two or three of them at once
    parted = simulate(Exposures(hours, doses), dynamics, mmd=5.0, med=3.0, hours=500)
    assert np.array_equal(parted.states, together.states)
    for index in range(7):
        alone = simulate(Exposures(hours, doses[index]), dynamics, mmd=5.0, med=3.0, hours=500)
        assert np.array_equal(together.melanin[index], alone.melanin)
        assert np.array_equal(together.thickness[index], alone.thickness)


@pytest.mark.parametrize("shape", [(), (3,), (2, 3), (0,), (2, 0)])
@pytest.mark.parametrize("count", [0, 1, 5])
@pytest.mark.parametrize("step", [1, 3, 24])
def test_histories_of_any_shape_and_times_in_any_order(shape, count, step):
    """Each as alone, and each time as alone, to the last bit; doses out of order and doubled."""
    random = np.random.default_rng(7)
    when = np.array([600, 3, 3, 150, 24])[:count]
    doses = random.uniform(0.0, 30.0, (*shape, count))
    arguments = {"mmd": 2.89, "med": 1.7, "step": step}
    times = [700.25, 0.0, 3.0, 577.0, 577.0]
    states = states_at(Exposures(when, doses), PIGMENTATIONS["low"], times=times, **arguments)
    assert states.shape == (*shape, 5, 4)
    for place in np.ndindex(shape):
        one = Exposures(when, doses[place])
        once = [
            states_at(one, PIGMENTATIONS["low"], times=[time], **arguments)[0] for time in times
        ]
        assert np.array_equal(states[place], once)
