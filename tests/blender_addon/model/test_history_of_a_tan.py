"""Images of a skin's coordinates against simulating every place by the hour."""

import numpy as np
import pytest
from sampled import coordinates

from blender_addon.model.history import history
from hylios.sun.doses import joined, of_sed
from hylios.tanning import PIGMENTATIONS, Exposures, states_at

SKIN = {"mmd": 4.9, "med": 2.9}
MELANIN = PIGMENTATIONS["intermediate"]


def random_schedule(random, days: float, count: int) -> list[tuple[int, float]]:
    hours = np.sort(random.integers(0, int(20 * days), count))
    return [(int(hour), float(random.uniform(1.0, 15.0))) for hour in hours]


def of(schedule, days: float, first_day: float = 0.0):
    received = joined([of_sed(hour, dose) for hour, dose in schedule])
    return history(received, MELANIN, first_day=first_day, last_day=days, **SKIN)[0]


def simulated(schedule, shares, hours) -> np.ndarray:
    """u and v (N, 2), of one place after another."""
    doses = np.array([dose for _, dose in schedule])
    exposures = Exposures([hour for hour, _ in schedule], shares[:, None] * doses)
    times, which = np.unique(hours, return_inverse=True)
    states = states_at(exposures, MELANIN, times=times, **SKIN)[np.arange(len(shares)), which]
    return np.log(np.stack([states[:, :3].sum(axis=1), states[:, 3]], axis=1))


@pytest.mark.parametrize(("days", "count"), [(30.0, 1), (30.0, 20), (60.0, 10), (365.0, 20)])
def test_against_the_simulation_by_the_hour(days, count):
    """u of .01 is .07 CIEDE2000. In the image of a year a row is 8 hours at least."""
    random = np.random.default_rng(count)
    schedule = random_schedule(random, days, count) if count > 1 else [(0, 30.0)]
    shares, hours = random.random(500), random.integers(0, int(24 * days), 500)
    seen = coordinates(of(schedule, days), shares, hours / 24.0)
    error = np.abs(seen[:, :2] - simulated(schedule, shares, hours))
    assert error.mean() < 0.0015
    assert np.quantile(error, 0.99) < 0.012
    assert np.array_equal(seen[:, 2], np.zeros(500))


def test_the_size_is_that_of_a_thumbnail():
    random = np.random.default_rng(2)
    for days, count, most in ((30.0, 1, 5_000), (30.0, 20, 15_000), (365.0, 60, 21_000)):
        rows, columns, _ = of(random_schedule(random, days, count), days).coordinates.shape
        assert rows * columns < most


def test_without_sun_nothing_changes():
    without = of([], 30.0)
    assert without.coordinates.shape == (2, 2, 3)
    assert not without.coordinates.any()


@pytest.mark.parametrize("share", [0.0, 0.25, 1.0])
def test_a_later_first_day(share):
    """The image begins with it, and is exact at its ends."""
    image = of([(5, 20.0)], 11.0, first_day=3.0)
    for day in (3.0, 11.0):
        seen = coordinates(image, np.array([share]), np.array([day]))[0, :2]
        expected = simulated([(5, 20.0)], np.array([share]), np.array([24.0 * day]))[0]
        assert seen == pytest.approx(expected, abs=1e-5)


def test_a_jump_is_as_narrow_as_a_step():
    """Just above and below the share that gets one minimal dose."""
    share = SKIN["mmd"] / 30.0
    below, above = share - 1.0 / 1024.0, share + 1.0 / 1024.0
    shares, day = np.array([below, above]), np.array([7.0, 7.0])
    seen = coordinates(of([(0, 30.0)], 30.0), shares, day)[:, 0]
    expected = simulated([(0, 30.0)], shares, 24.0 * day)[:, 0]
    assert expected[1] - expected[0] > 0.09
    assert seen == pytest.approx(expected, abs=0.005)
