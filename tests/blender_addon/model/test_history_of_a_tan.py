"""Images of a skin's coordinates against simulating every place by the hour."""

import numpy as np
import pytest
from sampled import coordinates

from blender_addon.model.history import DRAG, FULL, history
from hylios.sun.doses import joined, of_sed
from hylios.tanning import PIGMENTATIONS, Exposures, states_at

SKIN = {"mmd": 4.9, "med": 2.9}
MELANIN = PIGMENTATIONS["intermediate"]


def random_schedule(random, days: float, count: int) -> list[tuple[int, float]]:
    hours = np.sort(random.integers(0, int(20 * days), count))
    return [(int(hour), float(random.uniform(1.0, 15.0))) for hour in hours]


def of(schedule, days: float, first_day: float = 0.0, precision=FULL):
    received = joined([of_sed(hour, dose) for hour, dose in schedule])
    span = {"first_day": first_day, "last_day": days}
    return history(received, MELANIN, precision=precision, **span, **SKIN)[0]


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


@pytest.mark.parametrize("seed", range(4))
@pytest.mark.parametrize("days", [7.0, 30.0, 60.0, 365.0])
def test_dragging_is_as_near_as_it_says(seed, days):
    """CIEDE2000 .15 at 99 % of places is .02 of u."""
    random = np.random.default_rng(seed)
    schedule = random_schedule(random, days, 20)[: int(random.integers(1, 21))]
    shares, hours = random.random(300), random.integers(0, int(24 * days), 300)
    seen = coordinates(of(schedule, days, precision=DRAG), shares, hours / 24.0)
    error = np.abs(seen[:, :2] - simulated(schedule, shares, hours))
    assert error.mean() < 0.003
    assert np.quantile(error, 0.99) < 0.02


@pytest.mark.parametrize("first_day", [0.0, 3.4, 280.0])
def test_images_while_dragging_have_one_size(first_day):
    """So that pixels can be written in place; what no place refers to is empty."""
    shapes = {
        of(schedule, first_day + 30.5, first_day, DRAG).coordinates.shape
        for schedule in ([], [(0, 30.0)], random_schedule(np.random.default_rng(1), 30.0, 20))
    }
    assert shapes == {(DRAG.rows, DRAG.columns, 3)}


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
@pytest.mark.parametrize(("first_day", "last_day"), [(3.0, 11.0), (3.3, 11.07), (200.0, 201.0)])
@pytest.mark.parametrize("precision", [FULL, DRAG])
def test_a_later_first_day(share, first_day, last_day, precision):
    """The image begins with it, and is exact at its ends, also within an hour."""
    schedule = [(5, 20.0), (4790, 9.0)]
    image = of(schedule, last_day, first_day, precision)
    for day in (first_day, last_day):
        seen = coordinates(image, np.array([share]), np.array([day]))[0, :2]
        expected = simulated(schedule, np.array([share]), np.array([24.0 * day]))[0]
        assert seen == pytest.approx(expected, abs=2e-4)


def test_a_jump_is_as_narrow_as_a_step():
    """Just above and below the share that gets one minimal dose."""
    share = SKIN["mmd"] / 30.0
    below, above = share - 1.0 / 1024.0, share + 1.0 / 1024.0
    shares, day = np.array([below, above]), np.array([7.0, 7.0])
    seen = coordinates(of([(0, 30.0)], 30.0), shares, day)[:, 0]
    expected = simulated([(0, 30.0)], shares, 24.0 * day)[:, 0]
    assert expected[1] - expected[0] > 0.09
    assert seen == pytest.approx(expected, abs=0.005)
