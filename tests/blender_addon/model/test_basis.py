"""Points of several masks against simulating every point by the hour."""

from dataclasses import replace

import numpy as np
import pytest

from blender_addon.model.basis import DRAG, FULL, MOST_MASKS, RANKS, basis, shown
from hylios.errors import InputError
from hylios.sun.doses import joined, of_sed
from hylios.tanning import PIGMENTATIONS, Exposures, states_at

SKIN = {"mmd": 4.9, "med": 2.9}
MELANIN = PIGMENTATIONS["intermediate"]
ERRORS = {"mean": 0.0035, "at 99 %": 0.017, "most": 0.045}
"""Of u; .05, .3 and .7 CIEDE2000 where it is seen best."""


def doses(random, masks: int, days: float, count: int = 4):
    return [
        joined(
            [
                of_sed(int(hour), float(random.uniform(2.0, 50.0)))
                for hour in random.integers(0, int(20 * days), count)
            ]
        )
        for _ in range(masks)
    ]


def points(random, count: int, masks: int) -> np.ndarray:
    """Bare or covered by any mask; a third are in the soft edge of one."""
    shares = (random.random((count, masks)) < 0.5).astype(float)
    soft = np.flatnonzero(random.random(count) < 0.33)
    shares[soft, random.integers(0, masks, soft.size)] = random.random(soft.size)
    return shares


def simulated(received, shares, hours) -> np.ndarray:
    """u and v (N, 2), of one point after another."""
    when = np.concatenate([own.hours for own in received])
    mask = np.repeat(np.arange(len(received)), [own.hours.size for own in received])
    whole = np.concatenate([own.melanogenesis for own in received])
    times, which = np.unique(hours, return_inverse=True)
    exposures = Exposures(when, shares[:, mask] * whole)
    states = states_at(exposures, MELANIN, times=times, mmd=SKIN["mmd"], med=SKIN["med"])
    states = states[np.arange(len(shares)), which]
    return np.log(np.stack([states[:, :3].sum(axis=1), states[:, 3]], axis=1))


def of(received, shares, days=30.0, first_day=0.0, precision=FULL):
    span = {"first_day": first_day, "last_day": days}
    return basis(received, shares, MELANIN, precision=precision, **span, **SKIN)[0]


@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize("masks", [2, 5, 8])
def test_points_against_the_simulation_by_the_hour(masks, seed):
    random = np.random.default_rng(10 * masks + seed)
    received, shares = doses(random, masks, 30.0), points(random, 3000, masks)
    made = of(received, shares)
    some, hours = random.integers(0, 3000, 400), random.integers(0, 720, 400)
    seen = shown(made, made.coefficients[some], hours / 24.0)
    error = np.abs(seen[:, :2] - simulated(received, shares[some], hours))[:, 0]
    assert error.mean() < ERRORS["mean"]
    assert np.quantile(error, 0.99) < ERRORS["at 99 %"]
    assert error.max() < ERRORS["most"]
    assert made.rank in RANKS and not seen[:, 2].any()


def test_points_inside_faces_of_a_soft_edge():
    """Shares, and coefficients, are interpolated across a face."""
    random = np.random.default_rng(3)
    received = doses(random, 3, 30.0)
    across = np.linspace(0.0, 1.0, 11)
    rows = np.stack([across, np.roll(across, 3), np.ones(11)], axis=1)
    soft = np.concatenate([rows, rows[:, ::-1], np.eye(3), 1.0 - np.eye(3)])
    made = of(received, soft)
    edge, part = random.integers(0, 10, 300), random.random((300, 1))
    hours = random.integers(0, 720, 300)
    between = soft[edge] * (1.0 - part) + soft[edge + 1] * part
    held = made.coefficients[edge] * (1.0 - part) + made.coefficients[edge + 1] * part
    error = np.abs(shown(made, held, hours / 24.0)[:, :2] - simulated(received, between, hours))
    assert np.quantile(error[:, 0], 0.8) < ERRORS["at 99 %"]


def test_dragging_is_coarser():
    random = np.random.default_rng(4)
    received, shares = doses(random, 4, 30.0), points(random, 3000, 4)
    made = of(received, shares, precision=DRAG)
    hours, some = random.integers(0, 720, 400), random.integers(0, 3000, 400)
    seen = shown(made, made.coefficients[some], hours / 24.0)
    error = np.abs(seen[:, 0] - simulated(received, shares[some], hours)[:, 0])
    assert (made.rank,) == DRAG.ranks
    assert error.mean() < 0.005 and np.quantile(error, 0.99) < 0.02


def test_points_on_two_sides_of_a_jump_differ_while_dragging():
    """A share more or less of the dose that just tans; others as near to each other are one."""
    received = [of_sed(10, 2.0 * SKIN["mmd"]), of_sed(200, 30.0)]
    just = 0.5 + np.array([-0.004, -0.002, 0.002, 0.004])
    shares = np.concatenate([np.stack([just, np.ones(4)], axis=1), np.eye(2), np.ones((1, 2))])
    made = of(received, shares, 20.0, precision=DRAG)
    first = made.coefficients[:4]
    assert np.array_equal(first[0], first[1]) and np.array_equal(first[2], first[3])
    seen = shown(made, first, np.full(4, 6.0))[:, 0]
    exact = simulated(received, shares[:4], np.full(4, 144))[:, 0]
    assert seen[2] - seen[1] == pytest.approx(exact[2] - exact[1], abs=0.01)
    assert exact[2] - exact[1] > 0.05


def test_too_many_points_that_differ_are_taken_together():
    random = np.random.default_rng(5)
    received, shares = doses(random, 2, 20.0), random.random((4000, 2))
    made = of(received, shares, 20.0, precision=replace(DRAG, most=300))
    assert len(np.unique(made.coefficients, axis=0)) <= 300
    hours, some = random.integers(0, 480, 300), random.integers(0, 4000, 300)
    seen = shown(made, made.coefficients[some], hours / 24.0)[:, 0]
    assert np.abs(seen - simulated(received, shares[some], hours)[:, 0]).mean() < 0.02


@pytest.mark.parametrize(("first_day", "last_day"), [(0.0, 12.0), (3.3, 11.07)])
def test_first_and_last_day_within_an_hour(first_day, last_day):
    received = [joined([of_sed(5, 20.0), of_sed(100, 9.0)]), of_sed(50, 20.0)]
    shares = points(np.random.default_rng(7), 40, 2)
    made = of(received, shares, last_day, first_day)
    for day in (first_day, 7.0, last_day):
        seen = shown(made, made.coefficients, np.full(40, day))[:, :2]
        expected = simulated(received, shares, np.full(40, 24.0 * day))
        assert np.abs(seen - expected)[:, 0].max() < ERRORS["at 99 %"]


def test_the_share_is_that_of_all_doses():
    received = [of_sed(0, 30.0), of_sed(24, 10.0)]
    made = of(received, np.eye(2), 5.0)
    assert made.weights == pytest.approx([0.75, 0.25])


def test_without_sun_nothing_changes():
    made = of([joined([]), joined([])], np.eye(2), 5.0)
    seen = shown(made, made.coefficients, np.array([0.0, 3.0]))
    assert seen == pytest.approx(np.zeros((2, 3)), abs=1e-6)
    assert not made.weights.any() and made.rank == RANKS[0] and made.error < 1e-6


def test_points_with_equal_shares_have_equal_coefficients():
    random = np.random.default_rng(6)
    shares = points(random, 200, 3)
    made = of(doses(random, 3, 10.0), np.concatenate([shares, shares[::-1]]), 10.0)
    assert np.array_equal(made.coefficients[:200], made.coefficients[200:][::-1])


@pytest.mark.parametrize(
    ("masks", "shares", "sentence"),
    [
        (
            MOST_MASKS + 1,
            np.ones((3, 9)),
            "times in the sun have 9 masks; allowed are 1 to 8 different",
        ),
        (0, np.ones((3, 0)), "times in the sun have 0 masks"),
        (2, np.ones((3, 3)), r"shares have shape \(3, 3\); expected \(points, 2 masks\)"),
        (2, np.ones((0, 2)), r"shares have shape \(0, 2\)"),
        (2, [[0.0, 1.5]], "a share is out of range; allowed is 0 to 1"),
        (2, [[0.0, float("nan")]], "a share is out of range"),
    ],
)
def test_bad_masks_are_named(masks, shares, sentence):
    with pytest.raises(InputError, match=sentence):
        of([of_sed(0, 9.0)] * masks, shares)
