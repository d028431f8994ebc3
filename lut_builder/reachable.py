"""Which tanning states a skin can reach, and the axes and knots that span them.

In the logarithm of (melanin of three layers, thickness) relative to the untanned skin, the states
that sunshine can bring about lie near a curved sheet; its principal axes are the table's.
"""

import numpy as np

from hylios.errors import InputError
from hylios.history import history_of_shares, require_last_day
from hylios.skin import Skin
from hylios.table import StateAxes
from hylios.tanning import Exposures

DAYS = 60
MOST_EXPOSURES = 11
LEAST_DOSE, MOST_DOSE = 0.35, 10.5
"""Limits of the random schedules: days, exposures, and doses as multiples of the MMD."""

HOURS_BETWEEN = 2.0
"""Hours between two states of a scene."""

MARGIN = 0.05
"""How far the outermost knots lie beyond the states seen, as a share of their span."""

LEAST_SPAN = 1e-6
"""Least span of the states along an axis, in the logarithm. A narrower axis comes from rounding and
gets one knot, like all but the first in skin that makes no melanin in the sun."""


def reachable_states(skin: Skin, schedules: int, seed: int) -> np.ndarray:
    """States (N, 4) that random schedules of sunshine lead through, every six hours of 60 days.

    Each schedule has 1 to 11 exposures at random hours, each of 0.35 to 10.5 MMD.
    """
    random = np.random.default_rng(seed)
    hours = 24 * DAYS
    doses = np.zeros((schedules, hours))
    for schedule in doses:
        exposures = random.integers(1, MOST_EXPOSURES + 1)
        when = random.choice(hours, exposures, replace=False)
        schedule[when] = skin.mmd * random.uniform(LEAST_DOSE, MOST_DOSE, exposures)
    history = skin.history(Exposures(np.arange(hours), doses), hours)
    return history.states[:, ::6].reshape(-1, 4)


def reached_states(skin: Skin, exposures: Exposures, days: float) -> np.ndarray:
    """States (N, 4) of a skin anywhere on a body, from day 0 to a last one.

    Raises
    ------
    InputError
        If the last day is out of range.
    """
    last = 24.0 * require_last_day(days)
    history = history_of_shares(
        exposures,
        skin.dynamics,
        hours=np.append(np.arange(0.0, last, HOURS_BETWEEN), last),
        mmd=skin.mmd,
        med=skin.med,
    )
    return history.states.reshape(-1, 4)


def untanned_state(skin: Skin) -> np.ndarray:
    """The state (4,) without sun.

    Raises
    ------
    InputError
        If the way the skin tans leaves a layer without melanin: no ratio to nothing is a state.
    """
    if not np.all(skin.untanned_melanin > 0.0):
        raise InputError(
            f"melanin without sun is {skin.untanned_melanin.tolist()} of basale, spinosum, "
            "granulosum; a table needs more than 0 in each."
        )
    return skin.untanned_state


def choose_axes(skin: Skin, knots: tuple[int, ...], seed: int = 0) -> StateAxes:
    """Principal axes of the reachable states with the given numbers of knots.

    Knots lie evenly from the smallest to the largest coordinate seen, moved so that the untanned
    skin, at 0 on every axis, is one of them. An axis along which nothing changes gets one knot.

    Raises
    ------
    InputError
        As `untanned_state`.
    """
    untanned = untanned_state(skin)
    states = reachable_states(skin, 400, seed)
    _, _, directions = np.linalg.svd(np.log(states / untanned), full_matrices=False)
    basis = directions[: len(knots)].T
    basis = basis * np.sign(basis.sum(axis=0))
    coordinates = np.log(states / untanned) @ basis
    return StateAxes(
        untanned=untanned,
        basis=basis,
        knots=tuple(
            _knots(coordinates[:, axis].min(), coordinates[:, axis].max(), count)
            for axis, count in enumerate(knots)
        ),
    )


def _knots(lowest: float, highest: float, count: int) -> np.ndarray:
    """Knots over [lowest, highest], evenly spaced on either side of 0, with one at 0.

    A side that is hardly reached at all, such as less melanin than the untanned skin's, gets none.
    """
    if highest - lowest < LEAST_SPAN:
        return np.zeros(1)
    margin = MARGIN * (highest - lowest)
    low = lowest - margin if lowest < -margin else 0.0
    high = highest + margin if highest > margin else 0.0
    if count < 3:
        return np.sort([0.0, high if high >= -low else low][:count])
    below = round((count - 1) * -low / (high - low))
    if low < 0.0 < high:
        below = min(max(below, 1), count - 2)
    parts = [np.linspace(low, 0.0, below + 1), np.linspace(0.0, high, count - below)[1:]]
    return np.concatenate(parts)


def needed_knots(axes: StateAxes, states: np.ndarray, interpolation: str) -> np.ndarray:
    """Which knots a lookup at states (N, 4) reads, bool of shape `axes.shape`.

    Those at the corners of the states' cells; with PCHIP their neighbours too, which its slopes
    need.
    """
    needed = np.zeros(axes.shape, bool)
    reach = 1 if interpolation == "pchip" else 0
    lows = [
        np.clip(np.searchsorted(knots, place, side="right") - 1, 0, max(len(knots) - 2, 0))
        for knots, place in zip(axes.knots, axes.coordinates(states).T, strict=True)
    ]
    for cell in np.unique(np.stack(lows, axis=1), axis=0):
        needed[tuple(slice(max(low - reach, 0), low + 2 + reach) for low in cell)] = True
    return needed
