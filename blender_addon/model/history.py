"""Where a skin stands by day and by share of the dose, as images of coordinates.

The coordinates are logarithms of ratios to the skin without sun: u of the whole melanin, v of the
thickness, b of the blood. They know nothing of the skin's optics (`look` does).

A state changes fast on some days and jumps at some shares, and hardly at all elsewhere. So the
image has uneven rows and columns, and a second one, of one row, says where a day and a share lie
in it.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from hylios.sun.doses import Doses
from hylios.tanning import Burns, ErythemaDynamics, Exposures, Kinetics
from hylios.tanning.shares import Energies, responses_of_shares, retained

from .darkening import Uva
from .days import (
    STEPS,
    WEIGHTS,
    darkened_coordinates,
    hours_to_simulate,
    states_seen,
    texel_places,
)
from .thinning import by_error

EVEN_STEPS = 64
"""A share is simulated after so many steps at the latest."""

MOST_ROWS, MOST_COLUMNS = 160, 128
"""Of an image that stays in a file."""

LONG_QUICK_ROWS = 320
"""Most rows of more than two months of skin that reddens or darkens for days again and again."""

TOLERANCE = 0.0045
"""Largest error of u, v and weighted b between rows or columns; .01 is about .07 CIEDE2000."""

FEW_SHARES = 6
"""Shares whose tans decide which hours are simulated."""

SHOWN, HOURS_TO_PEAK = 8, 60
"""Most hours at which the response decides which shares are simulated; how long after an
exposure."""

THICKENING = 0.1
"""What a change of the response means for v, over what it means for u."""

REDDENING, HOURS_TO_REDNESS = 0.05, 16
"""What b means over the response to light; how long after an exposure skin is red."""

LONG = 24 * 61
"""Hours beyond which a precision takes its rows for a long time."""


@dataclass(frozen=True)
class Precision:
    """How closely a history is simulated.

    Attributes
    ----------
    columns : int
        Most shares.
    response : float
        Error of the response to light between two of them at which no more are needed.
    rows, long_rows : int
        Most hours, of two months and of more.
    candidates : int
        Even hours, over the number of rows, among which rows are picked.
    dtype : data-type
    thinned : bool
        Whether the image is made small, for a file. Else it has `columns` and `rows` or
        `long_rows` whatever the doses, so that its pixels can be written in place.
    """

    columns: int
    response: float
    rows: int
    long_rows: int
    candidates: int
    dtype: Any
    thinned: bool

    def rows_within(self, first: int, last: int) -> int:
        """Most rows from one hour to another."""
        return self.rows if last - first <= LONG else self.long_rows


FULL = Precision(256, 0.0005, 320, 640, 4, np.float64, thinned=True)
"""For what stays in a file."""

DRAG = Precision(96, 0.001, 160, 384, 3, np.float32, thinned=False)
"""For a picture while somebody changes a setting."""


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

    @property
    def lines(self) -> NDArray[np.float32]:
        """`places` as (2, STEPS + 1, 3): the red alone below, the green above, so that a sum of
        both rows is a place in `coordinates`."""
        return np.concatenate([self.places * (1, 0, 0), self.places * (0, 1, 0)]).astype(np.float32)


def history(
    received: Doses,
    melanin: Kinetics,
    *,
    mmd: float,
    med: float,
    first_day: float,
    last_day: float,
    precision: Precision = FULL,
    erythema: ErythemaDynamics | None = None,
    darkens: bool = False,
) -> tuple[History, NDArray[np.floating]]:
    """Simulate doses from day 0; the history, and states (..., 4 or 5) that it leads through.

    Parameters
    ----------
    received : Doses
        On bare skin.
    melanin, mmd, med
        How the skin makes melanin; its minimal melanogenesis and erythema dose in SED.
    first_day, last_day : float
        Range of days to tell, within 0 to LAST_DAY_LIMIT. An exposure after the last has no
        effect.
    precision : Precision
        `FULL` for what stays, `DRAG` for a picture at once.
    erythema : ErythemaDynamics, optional
        How the skin reddens; without it, it does not.
    darkens : bool
        Whether melanin darkens at once, where the UVA is known; the states do not tell it.

    Raises
    ------
    InputError
        If a minimal dose or a day is out of range.
    """
    first, end = int(24.0 * first_day), int(np.ceil(24.0 * last_day))
    exposures = received.exposures()
    energies = retained(exposures, melanin, mmd=mmd, med=med, hours=end)
    burns = None if erythema is None else Burns.of(exposures, erythema, med)
    uva = Uva.of([received]) if darkens else None
    steps = _steps(energies, _shown(exposures, end, HOURS_TO_PEAK), precision, burns)
    few = steps[np.linspace(0, len(steps) - 1, FEW_SHARES + 1).astype(int)[1:]] / STEPS
    rows = precision.rows_within(first, end)
    hours = hours_to_simulate(
        energies, few, exposures, (first, end), rows, precision.candidates, burns, uva
    )
    states = states_seen(energies, steps / STEPS, hours, precision.dtype, burns)
    states, hours = states[hours >= first], hours[hours >= first]
    values = darkened_coordinates(states, uva, steps / STEPS, hours)
    if precision.thinned:
        is_quick = burns is not None or uva is not None
        most = LONG_QUICK_ROWS if is_quick and end - first > LONG else MOST_ROWS
        kept, columns = _thinned(hours, steps, values, most)
        hours, steps = hours[kept], steps[columns]
        values, states = (lines[kept[:, None], columns] for lines in (values, states))
    else:
        values = _filled(values, rows, precision.columns)
    places = _places(24.0 * np.linspace(first_day, last_day, STEPS + 1), hours, steps, values.shape)
    return History(values, places, first_day, last_day), states


def _places(
    even: NDArray, hours: NDArray[np.int_], steps: NDArray[np.int_], shape: tuple[int, ...]
) -> NDArray[np.float32]:
    """Where even steps of the shares and even hours lie in an image of a shape."""
    places = np.zeros((1, STEPS + 1, 3), np.float32)
    places[0, :, 0] = texel_places(np.arange(STEPS + 1), steps, shape[1])
    places[0, :, 1] = texel_places(even, hours, shape[0])
    return places


def _steps(
    energies: Energies, shown: NDArray[np.int_], precision: Precision, burns: Burns | None
) -> NDArray[np.int_]:
    """Steps of the share to simulate: on both sides of all jumps that matter.

    The response jumps at a share with which the energy retained in some hour just reaches the
    threshold (5.7, 5.23). So the response to every step is told, exactly, in some hours.
    """
    steps = np.arange(STEPS + 1)
    melanin, thickness = (responses_of_shares(own, steps / STEPS, shown) for own in energies)
    responses = np.concatenate([melanin, THICKENING * thickness], axis=1)
    if burns is not None:
        red = REDDENING * _redness(burns, steps / STEPS, int(shown[-1]))
        responses = np.concatenate([responses, red.astype(np.float32)], axis=1)
    return by_error(steps, responses, precision.columns, precision.response, EVEN_STEPS)


def _redness(burns: Burns, shares: NDArray, end: int) -> NDArray[np.floating]:
    """b (S, T) of shares in some hours, were the skin as it is without sun."""
    hours = _shown(burns, end, HOURS_TO_REDNESS)
    own = burns.dynamics
    energies = own.retained_energies(burns.hours, burns.doses.T, hours)
    return np.log(own.blood(energies * shares)).T


def _shown(exposed: Exposures | Burns, end: int, later: int) -> NDArray[np.int_]:
    """Some hours, so much later than exposures, at which skin responds strongly."""
    peaks = np.unique(np.minimum(np.append(exposed.hours + later, end), end))
    return peaks[np.linspace(0, len(peaks) - 1, min(SHOWN, len(peaks))).astype(int)]


def _thinned(
    hours: NDArray[np.int_], steps: NDArray[np.int_], values: NDArray[np.float32], most: int
) -> tuple[NDArray[np.int_], NDArray[np.int_]]:
    """Rows and columns of an image that is small, and within the tolerance of this one."""
    told = WEIGHTS * values
    rows = by_error(hours, told.reshape(len(hours), -1), most, TOLERANCE)
    lines = np.swapaxes(told[rows], 0, 1).reshape(len(steps), -1)
    return rows, by_error(steps, lines, MOST_COLUMNS, TOLERANCE)


def _filled(values: NDArray[np.float32], rows: int, columns: int) -> NDArray[np.float32]:
    """Values (T, S, 3) in an image of a fixed size, whose last row and column are repeated."""
    more = ((0, rows - len(values)), (0, columns - values.shape[1]), (0, 0))
    return np.pad(values, more, mode="edge")
