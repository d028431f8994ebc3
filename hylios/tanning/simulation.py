"""Melanin and thickness over time after doses: equations 5.4 to 5.14 and 5.20 to 5.29.

Everything is computed as a departure from the state without sun, which is exactly 0 until a dose
acts. Arrays inside are (BLOCK, blocks, histories), as `recurrence` lays time out.
"""

from collections.abc import Iterator
from numbers import Real
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from hylios.errors import InputError, as_numbers, require_range, require_whole
from hylios.tanning.departures import melanin_departures, thickness_departure
from hylios.tanning.dynamics import ThicknessDynamics
from hylios.tanning.erythema import Burns, ErythemaDynamics, between_hours, whole_hours
from hylios.tanning.exposures import LONGEST_HOURS, Exposures, require_exposures
from hylios.tanning.kinetics import Kinetics
from hylios.tanning.recurrence import (
    accumulated,
    in_a_row,
    in_blocks,
    no_steps,
    previous,
    where,
)
from hylios.tanning.tanning_history import TanningHistory

LONGEST_STEP = 24
FINEST_STEP = 1.0 / 60.0
"""Longest and shortest time step, in hours.

Over 1200 random schedules of up to 11 doses of .35 to 10.5 MMD in 60 days, a state in steps of 3, 6
and 24 hours was within .0014, .0046 and .047 of that by the hour in the total of melanin, .0035,
.0125 and .101 in one layer's, .0147, .033 and .111 in thickness, which rises fastest.
"""

CELLS_TOGETHER = 2**18
"""Hours times histories that are computed at once, for memory and for the processor's cache."""


def simulate(
    exposures: Exposures,
    melanin: Kinetics,
    *,
    mmd: float,
    med: float,
    hours: int,
    thickness: ThicknessDynamics | None = None,
    erythema: ErythemaDynamics | None = None,
    step: float = 1,
) -> TanningHistory:
    """Simulate melanin and thickness from hour 0 to hour `hours`, at every step.

    Parameters
    ----------
    hours : int
        Last hour, 0 to a century.
    step : float
        Of time in hours: 1 to 24 in whole numbers, or 1 divided by a whole number up to 60.
    exposures, melanin, mmd, med, thickness, erythema
        As in `states_at`, which also says what other steps than an hour cost.

    Returns
    -------
    TanningHistory
        With shapes (T,), (..., T, 3) and (..., T). A dose acts from its own hour on; only hour 0
        is the state without sun whatever falls on it.

    Raises
    ------
    InputError
        If a minimal dose is not positive, or `hours` or `step` is out of range.
    """
    hours = require_whole("number of hours", hours, 0, LONGEST_HOURS)
    _check_step(step)
    times = step * np.arange(_count(hours, step))
    states = states_at(
        exposures,
        melanin,
        times=times,
        mmd=mmd,
        med=med,
        thickness=thickness,
        erythema=erythema,
        step=max(int(step), 1),
    )
    return TanningHistory.of(times, states)


def states_at(
    exposures: Exposures,
    melanin: Kinetics,
    *,
    times: ArrayLike,
    mmd: float,
    med: float,
    thickness: ThicknessDynamics | None = None,
    erythema: ErythemaDynamics | None = None,
    step: int = 1,
) -> NDArray[np.float64]:
    """States of the skin at some times, simulated up to the last of them and no further.

    Parameters
    ----------
    exposures : Exposures
        Doses with leading shape (...); those after the last time, rounded up to a step, don't act.
    melanin, thickness, erythema
        Parameters of the skin (`PIGMENTATIONS`, `ThicknessDynamics`, `hylios.erythema`). As in the
        thesis, it reddens only if told how; blood is followed by the hour.
    times : (T,) array
        Hours, 0 to a century, in any order; between two steps a state is interpolated.
    mmd, med : float
        Minimal melanogenesis and erythema dose in SED. Melanogenesis is measured against the MMD
        (5.4 with 5.2 as the text has it; its footnote prints MED), the rest against the MED (5.20).
    step : int
        Of time in hours, 1 to 24. The thesis's is 1, and so are the rates of its tables: they are
        converted. Retained energy is followed by the hour whatever the step, as the thresholds
        of 5.7 and 5.23 count hours begun; so an hour is the model's finest step, and finer times
        are interpolated. Signals are exact at every step, responses run straight between two;
        `LONGEST_STEP` says what that costs.

    Returns
    -------
    (..., T, 4) array, or (..., T, 5) with erythema
        Melanin of basale, spinosum, granulosum over the total without sun, relative thickness, and
        the blood relative to the skin's own.

    Raises
    ------
    InputError
        If exposures, a minimal dose, a time or the step cannot be used.
    """
    require_exposures(exposures)
    _require_minimal_doses(mmd, med)
    step, hours = require_whole("step in hours", step, 1, LONGEST_STEP), require_times(times)
    thickness = thickness or ThicknessDynamics()
    marks = _marks(hours, step)
    numbers = 4 if erythema is None else 5
    states = np.empty((int(np.prod(exposures.doses.shape[:-1])), hours.size, numbers))
    together = max(CELLS_TOGETHER // (1 + marks * step), 1)
    for first in range(0, len(states), together):
        some = slice(first, first + together)
        course = _course(exposures, some, melanin, thickness, mmd, med, marks, step)
        states[some, :, :4] = course.at(hours)
        if erythema is not None:
            told = whole_hours(hours)
            burns = Burns.of(exposures, erythema, med)
            states[some, :, 4] = between_hours(told, course.blood(burns, some, told), hours)
    return states.reshape(*exposures.doses.shape[:-1], hours.size, numbers)


def simulate_in_parts(
    exposures: Exposures,
    melanin: Kinetics,
    *,
    mmd: float,
    med: float,
    hours: int,
    thickness: ThicknessDynamics | None = None,
    erythema: ErythemaDynamics | None = None,
    step: float = 1,
    rows: int = 2**14,
) -> Iterator[TanningHistory]:
    """What `simulate` gives, a part of so many rows after the other, to the last bit.

    Memory is needed by the hour and by the part, however fine the step.

    Parameters
    ----------
    exposures : Exposures
        Of one history: doses (E,).
    rows : int
        Of a part, 1 or more; the last has fewer.
    melanin, mmd, med, hours, thickness, erythema, step
        As in `simulate`.

    Raises
    ------
    InputError
        As `simulate`, at the first part.
    """
    hours = require_whole("number of hours", hours, 0, LONGEST_HOURS)
    _check_step(step)
    require_exposures(exposures)
    _require_minimal_doses(mmd, med)
    thickness = thickness or ThicknessDynamics()
    count, whole = _count(hours, step), max(int(step), 1)
    marks = _marks(step * np.array([count - 1]), whole)
    every = slice(None)
    course = _course(exposures, every, melanin, thickness, mmd, med, marks, whole)
    told, blood = whole * np.arange(marks + 1), None
    if erythema is not None:
        blood = course.blood(Burns.of(exposures, erythema, med), every, told)
    for first in range(0, count, rows):
        times = np.asarray(step * np.arange(first, min(first + rows, count)), float)
        states = course.at(times)
        if blood is not None:
            reddened = between_hours(told, blood, times)
            states = np.concatenate([states, reddened[..., None]], axis=-1)
        states = states.reshape(*exposures.doses.shape[:-1], *states.shape[1:])
        yield TanningHistory.of(times, states)


def _require_minimal_doses(mmd: float, med: float) -> None:
    require_range("MMD", mmd, 1e-6, 1e6, "SED")
    require_range("MED", med, 1e-6, 1e6, "SED")


def _count(hours: int, step: float) -> int:
    """Number of the steps from hour 0 to the last, both counted."""
    return int(hours / step + 1e-9) + 1


def _marks(times: np.ndarray, step: int) -> int:
    """Steps that are simulated for some times."""
    return int(np.ceil(times.max(initial=0.0) / step))


class _Course(NamedTuple):
    """Some histories as they were simulated.

    `curves` are melanin of the layers and thickness beyond those without sun at the steps' ends,
    laid out in blocks, in 5.12's units.
    """

    curves: tuple[np.ndarray, ...]
    melanin: Kinetics
    thickness: ThicknessDynamics
    marks: int
    step: int

    def at(self, times: np.ndarray) -> NDArray[np.float64]:
        """States (H, T, 4) at some times, straight between the steps' ends."""
        before = np.minimum((times / self.step).astype(int), max(self.marks - 1, 0))
        after = np.minimum(before + 1, self.marks)
        fraction = (times / self.step - before)[:, None]
        ends = where(before), where(after)
        result = np.empty((self.curves[0].shape[2], times.size, 4))
        for part, curve in enumerate(self.curves):
            there = curve[ends[0]] * (1.0 - fraction) + curve[ends[1]] * fraction
            result[..., part] = there.T
        make_relative(result, self.melanin, self.thickness)
        return result

    def blood(self, burns: Burns, some: slice, hours: np.ndarray) -> NDArray[np.float64]:
        """Blood (T, H) at ascending hours; the histories are some of those of the burns."""
        burns = burns.until(self.marks * self.step)
        return burns.on(self.at(burns.hours), some, hours)


def _course(
    exposures: Exposures,
    some: slice,
    melanin: Kinetics,
    thickness: ThicknessDynamics,
    mmd: float,
    med: float,
    marks: int,
    step: int,
) -> _Course:
    """Some histories, simulated."""
    hours = 1 + marks * step
    received = by_hour(exposures.hours, exposures.doses, some, hours)
    thickening = by_hour(exposures.hours, exposures.thickening_doses, some, hours)
    since = None if step == 1 else np.full((1, 1, 1), float(step))
    curves = (
        *melanin_departures(_response(received / mmd, melanin, step), melanin, since),
        thickness_departure(_response(thickening / med, thickness, step), thickness, since),
    )
    return _Course(curves, melanin, thickness, marks, step)


def make_relative(states: np.ndarray, melanin: Kinetics, thickness: ThicknessDynamics) -> None:
    """Make states of departures (..., 4), in place."""
    without_sun = np.append(melanin.steady_state(), thickness.steady_state()).astype(states.dtype)
    # What is left of a layer's melanin may round to less than none.
    np.maximum(states + without_sun, 0.0, out=states)
    states /= np.append(np.full(3, without_sun[:3].sum()), without_sun[3])


def hill(signal: np.ndarray, constant: float, exponent: float) -> NDArray[np.float64]:
    """Response s^k / (s^k + w^k), without overflow for any signal from 0 on (5.11, 5.26)."""
    with np.errstate(divide="ignore", over="ignore"):
        return 1.0 / (1.0 + (constant / signal) ** exponent)


def _check_step(step: float) -> None:
    if isinstance(step, Real) and step > 0 and not isinstance(step, bool):
        inverse = step if step >= 1 else 1.0 / step
        if FINEST_STEP <= step * (1.0 + 1e-9) and step <= LONGEST_STEP:
            if abs(inverse - round(inverse)) < 1e-9:
                return
    raise InputError(
        f"step is {step!r} hours; allowed is 1 to {LONGEST_STEP} in whole numbers, or 1 divided "
        "by a whole number up to 60."
    )


def require_times(times: ArrayLike) -> NDArray[np.float64]:
    """Times (T,) in hours.

    Raises
    ------
    InputError
        If they are no list of numbers, or one is out of range.
    """
    hours = as_numbers("times", times)
    if hours.ndim != 1 or not np.all((hours >= 0.0) & (hours <= LONGEST_HOURS)):
        raise InputError(
            f"times are {str(times)[:60]}; allowed is a list of 0 to {LONGEST_HOURS} hours."
        )
    return hours


def by_hour(when: np.ndarray, doses: np.ndarray, some: slice, hours: int) -> np.ndarray:
    """Doses (..., E) of some histories by the hour, those before the given one, in blocks."""
    inside = when < hours
    flat = doses.reshape(int(np.prod(doses.shape[:-1])), when.size)[some, inside]
    received = no_steps(hours, len(flat))
    np.add.at(received, where(when[inside]), flat.T)
    return received


def _response(
    received: np.ndarray, dynamics: Kinetics | ThicknessDynamics, step: int
) -> NDArray[np.float64]:
    """The Hill factor at the steps' ends (5.5 to 5.8 and 5.11, 5.21 to 5.26).

    From doses by the hour in multiples of the threshold.
    """
    energy = accumulated(dynamics.energy_decay, received)
    energy[energy < dynamics.threshold] = 0.0
    if step == 1:
        rate = accumulated(dynamics.signal_rate_decay, energy)
        signal = accumulated(dynamics.signal_decay, rate)
    else:
        signal = _signal_by_step(in_a_row(energy, energy[..., 0].size), dynamics, step)
    return hill(signal, dynamics.hill_constant, dynamics.hill_exponent)


def _signal_by_step(
    energy: np.ndarray, dynamics: Kinetics | ThicknessDynamics, step: int
) -> NDArray[np.float64]:
    """The signal substance at the steps' ends, from effective energy (hours, H): exact.

    It is what each hour's energy still amounts to, summed (the thesis's footnote to 5.5).
    """
    marks = 1 + (len(energy) - 1) // step
    by_step = np.zeros((marks, step, energy.shape[1]))
    # The first hour ends the first step; what would precede it is nothing.
    by_step.reshape(-1, energy.shape[1])[step - 1 :] = energy[: 1 + (marks - 1) * step]
    rate_left = dynamics.signal_rate_decay ** np.arange(step)
    signal_left = np.convolve(rate_left, dynamics.signal_decay ** np.arange(step))[:step]
    rate = accumulated(dynamics.signal_rate_decay**step, _weighted(by_step, rate_left))
    produced = _weighted(by_step, signal_left)
    produced += dynamics.signal_rate_decay * signal_left[-1] * previous(rate)
    return accumulated(dynamics.signal_decay**step, produced)


def _weighted(by_step: np.ndarray, weights: np.ndarray) -> np.ndarray:
    """Sums over the hours of each step, the last of which has the first weight, in blocks."""
    total = by_step[:, -1] * weights[0]
    for back in range(1, len(weights)):
        total += by_step[:, -1 - back] * weights[back]
    return in_blocks(total)
