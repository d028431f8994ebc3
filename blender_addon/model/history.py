"""Where a skin stands by day and by share of the dose, as images of coordinates.

The coordinates are logarithms of ratios to the skin without sun: u of the whole melanin, v of the
thickness, b of the blood. They know nothing of the skin's optics (`look` does).

A state changes fast on some days and jumps at some shares, and hardly at all elsewhere. So the
image has uneven rows and columns, and a second one, of one row, says where a day and a share lie
in it.
"""

import heapq
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from hylios.history import history_of_shares
from hylios.sun.doses import Doses
from hylios.tanning import Exposures, MelaninDynamics, ThicknessDynamics

STEPS = 1024
"""Even steps of the shares from none to all, and of the days, between which rows and columns are
picked. A jump is spread over one step of the share."""

HOURS_PER_STEP = 4.0
"""Candidates for a row are no closer than this, where the steps are finer."""

EVEN_SHARES = 64
"""Even steps of the shares that are simulated whatever the doses."""

MOST_SHARES = 512
"""Where it takes more shares than that, only the jumps of an exposure's first hour are kept."""

MOST_ROWS, MOST_COLUMNS = 160, 128

TOLERANCE = 0.0045
"""Largest error of u and v between rows or columns; u of .01 is about .07 CIEDE2000."""


@dataclass(frozen=True, eq=False)
class History:
    """Coordinates of a skin over days and shares of the dose.

    Attributes
    ----------
    coordinates : (rows, columns, 3) float32 array
        u, v and b; the first row is that of the first day.
    places : (1, STEPS + 1, 3) float32 array
        Over even steps from none to all: in red the place of a share among the columns, in green
        that of a day among the rows, as texture coordinates from 0 to 1. Blue is 0.
    first_day, last_day : float
    """

    coordinates: NDArray[np.float32]
    places: NDArray[np.float32]
    first_day: float
    last_day: float


def history(
    received: Doses,
    melanin: MelaninDynamics,
    *,
    mmd: float,
    med: float,
    first_day: float,
    last_day: float,
) -> tuple[History, NDArray[np.float64]]:
    """Simulate doses from day 0; the history, and states (..., 4) that it leads through.

    Parameters
    ----------
    received : Doses
        On bare skin.
    melanin, mmd, med
        How the skin makes melanin; its minimal melanogenesis and erythema dose in SED.
    first_day, last_day : float
        Range of days to tell, within 0 to LAST_DAY_LIMIT. An exposure after the last has no
        effect.

    Raises
    ------
    InputError
        If a minimal dose or a day is out of range.
    """
    exposures = received.exposures()
    steps = _candidate_steps(exposures, melanin, mmd, med)
    apart = _steps_apart(last_day - first_day)
    days = first_day + (last_day - first_day) * np.arange(0, STEPS + 1, apart) / STEPS
    simulated = history_of_shares(
        exposures, melanin, hours=24.0 * days, mmd=mmd, med=med, shares=steps / STEPS
    )
    values = coordinates_of(simulated.image)
    lines = values.reshape(len(days), -1)
    rows = _picked(np.arange(len(days)), lines, MOST_ROWS)
    values = values[rows]
    lines = np.swapaxes(values, 0, 1).reshape(len(steps), -1)
    columns = _picked(steps, lines, MOST_COLUMNS)
    places = np.zeros((1, STEPS + 1, 3), np.float32)
    places[0, :, 0] = _texel_places(steps[columns])
    places[0, :, 1] = _texel_places(rows * apart)
    kept = History(values[:, columns], places, first_day, last_day)
    return kept, simulated.states[columns][:, rows]


def coordinates_of(states: NDArray[np.float64]) -> NDArray[np.float32]:
    """Coordinates (..., 3) of states (..., 4), or (..., 5) with the blood."""
    result = np.zeros((*states.shape[:-1], 3), np.float32)
    result[..., 0] = np.log(states[..., :3].sum(axis=-1))
    result[..., 1] = np.log(states[..., 3])
    if states.shape[-1] > 4:
        result[..., 2] = np.log(states[..., 4])
    return result


def _steps_apart(days: float) -> int:
    """The number of steps from one candidate for a row to the next, a power of 2."""
    apart = 1
    while 24.0 * days / STEPS * apart * 2 <= HOURS_PER_STEP:
        apart *= 2
    return min(apart, STEPS // EVEN_SHARES)


def _candidate_steps(
    exposures: Exposures, melanin: MelaninDynamics, mmd: float, med: float
) -> NDArray[np.int_]:
    """Steps of the share to simulate: some even ones, and those on both sides of all jumps.

    The response jumps at a share with which the energy retained in some hour just reaches the
    threshold (5.7, 5.23).
    """
    thickness = ThicknessDynamics()
    runs = [
        *_retained(exposures.hours, exposures.doses / mmd, melanin.energy_decay),
        *_retained(exposures.hours, exposures.thickening_doses / med, thickness.energy_decay),
    ]
    even = np.arange(0, STEPS + 1, STEPS // EVEN_SHARES)
    steps = _beside_jumps(np.concatenate([*runs, even[:0]]), even)
    if len(steps) <= MOST_SHARES:
        return steps
    # The first hour of an exposure makes the largest jump by far.
    even = np.arange(0, STEPS + 1, STEPS // EVEN_SHARES // 4)
    return _beside_jumps(np.array([run[0] for run in runs]), even)


def _beside_jumps(energy: NDArray, even: NDArray[np.int_]) -> NDArray[np.int_]:
    below = (STEPS / energy[energy > 1.0]).astype(int)
    return np.unique(np.concatenate([even, below, below + 1]))


def _retained(hours: NDArray, doses: NDArray, decay: float) -> list[NDArray[np.float64]]:
    """Energy retained from an exposure's hour on while it may exceed 1, up to the next exposure.

    Doses are in multiples of what is just enough.
    """
    order = np.argsort(hours, kind="stable")
    runs, energy, last = [], 0.0, 0
    until = np.append(hours[order][1:], np.iinfo(np.int32).max)[: hours.size]
    for hour, dose, after in zip(hours[order], doses[order], until, strict=True):
        energy = energy * decay ** (hour - last) + dose
        last = hour
        lasting = 1
        if energy > 1.0 and decay > 0.0:
            lasting += int(np.log(energy) / -np.log(decay))
        runs.append(energy * decay ** np.arange(max(min(lasting, after - hour), 1)))
    return runs


def _picked(places: NDArray, values: NDArray, most: int) -> NDArray[np.int_]:
    """Indices of lines (N, numbers) between which the others lie straight, most of them at most.

    The places (N,) of the lines ascend. Splits where the error is largest (Ramer, Douglas and
    Peucker), until none is above the tolerance.
    """
    picked = {0, len(places) - 1}
    waiting = [_widest(places, values, 0, len(places) - 1)]
    while waiting and len(picked) < most:
        error, first, middle, last = heapq.heappop(waiting)
        if -error <= TOLERANCE:
            break
        picked.add(middle)
        for ends in ((first, middle), (middle, last)):
            heapq.heappush(waiting, _widest(places, values, *ends))
    return np.array(sorted(picked))


def _widest(places: NDArray, values: NDArray, first: int, last: int) -> tuple[float, int, int, int]:
    """Largest error, negative, of what lies between two lines: it, and first, its and last line."""
    if last - first < 2:
        return 0.0, first, first, last
    inner = slice(first + 1, last)
    part = (places[inner] - places[first]) / (places[last] - places[first])
    straight = np.multiply.outer(part.astype(values.dtype), values[last] - values[first])
    straight += values[first] - values[inner]
    errors = np.maximum(straight.max(axis=1), -straight.min(axis=1))
    worst = int(errors.argmax())
    return -float(errors[worst]), first, first + 1 + worst, last


def _texel_places(steps: NDArray) -> NDArray[np.float64]:
    """Over all steps: texture coordinates where lines are the texels' centres."""
    count = len(steps)
    return (np.interp(np.arange(STEPS + 1), steps, np.arange(count)) + 0.5) / count
