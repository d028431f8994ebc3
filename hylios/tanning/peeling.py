"""Peeling after a burn: how much of the skin has peeled, and what tan goes with it. ESTIMATE

Of people it is told that skin peels 3 to 7 days after a sunburn, for 3 to 7 days. How large a burn
must be, what share of the skin peels and how deep are guesses. numpy only.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from hylios.errors import InputError, as_numbers, require_range
from hylios.tanning.erythema import Burns, ErythemaDynamics, between_hours
from hylios.tanning.exposures import Exposures
from hylios.tanning.kinetics import Kinetics
from hylios.tanning.simulation import CELLS_TOGETHER, require_times, states_at

TAKEN = (0.0, 0.5, 1.0)
"""Shares of the new melanin of basale, spinosum and granulosum that peel off. ESTIMATE"""


BLISTERING = 4.0
"""MED of a day with more of which skin blisters in life, which the model does not show."""


def first_blistering_day(hours: NDArray[np.float64], burns: NDArray[np.float64]) -> float | None:
    """The first day, from 0, with more than `BLISTERING`; None where there is none.

    Parameters
    ----------
    hours, burns : (E,) arrays
        Hours of exposures and their doses in MED.
    """
    days, place = np.unique(np.floor_divide(hours, 24.0), return_inverse=True)
    sums = np.bincount(place.reshape(-1), burns, minlength=days.size)
    over = days[sums > BLISTERING * (1.0 + 1e-9)]
    return float(over[0]) if over.size else None


@dataclass(frozen=True)
class Peeling:
    """When and how widely burnt skin peels. ESTIMATE

    Attributes
    ----------
    least, full : float
        Burns, as energy retained (5.21) in MED of the skin as it is by then, from which skin begins
        to peel, and with which all of it does.
    delay, duration : float
        Hours from the burn to the first peeling, and until all has peeled that will. People peel
        from day 3 to 7 on, for 3 to 7 days.
    healing : float
        Of what has peeled, what is still to be seen an hour later: new skin moves up in weeks.

    Raises
    ------
    InputError
        If a number is out of range.
    """

    least: float = 3.0
    full: float = 6.0
    delay: int = 96
    duration: int = 96
    healing: float = 0.998

    def __post_init__(self):
        require_range("least burn that peels", self.least, 0.0, 1e6, "MED")
        require_range("burn that peels fully", self.full, self.least + 1e-6, 1e9, "MED")
        require_range("delay of peeling", self.delay, 0.0, 1e4, "hours")
        require_range("duration of peeling", self.duration, 1.0, 1e4, "hours")
        require_range("healing of peeling", self.healing, 1e-6, 1.0)

    def shares(
        self, burns: Burns, acting: NDArray[np.floating], times: NDArray[np.float64]
    ) -> NDArray[np.float64]:
        """Share of the skin that has peeled (H, T), 0 to 1, at times (T,) in hours.

        Parameters
        ----------
        acting : (E, H) array
            Doses in MED of the skin as it is by then (`Burns.acting`).
        """
        grid = np.arange(int(np.ceil(times.max(initial=0.0))) + 1)
        size = np.zeros((len(grid), acting.shape[1]))
        told = burns.hours < len(grid)
        if np.any(told):
            own = np.unique(burns.hours[told])
            energy = burns.dynamics.retained_energies(burns.hours[told], acting[told], own)[:, 0]
            size[own] = np.clip((energy - self.least) / (self.full - self.least), 0.0, 1.0)
        # The largest burn so far, less what has healed of it; in the logarithm, over a century.
        healed = (grid * np.log(self.healing))[:, None]
        with np.errstate(divide="ignore"):
            left = np.exp(np.maximum.accumulate(np.log(size) - healed) + healed)
        passed = np.concatenate([np.zeros((1, left.shape[1])), np.cumsum(left, axis=0)])
        first, last = (np.maximum(grid + 1 - self.delay - late, 0) for late in (self.duration, 0))
        peeled = np.maximum(passed[last] - passed[first], 0.0) / self.duration
        return between_hours(grid, peeled, times)


def peeled_shares(
    exposures: Exposures,
    melanin: Kinetics,
    erythema: ErythemaDynamics,
    *,
    times: ArrayLike,
    mmd: float,
    med: float,
    peeling: Peeling | None = None,
) -> NDArray[np.float64]:
    """Share of the skin that has peeled (..., T) after exposures, 0 to 1.

    Parameters
    ----------
    exposures, melanin, erythema, times, mmd, med
        As in `hylios.tanning.states_at`.

    Raises
    ------
    InputError
        As there.
    """
    if not isinstance(peeling, Peeling | None):
        raise InputError(f"peeling is {str(peeling)[:60]!r}; expected a Peeling.")
    hours = require_times(times)
    burns = Burns.of(exposures, erythema, med).until(int(hours.max(initial=0.0)))
    shape = exposures.doses.shape[:-1]
    tan = states_at(exposures, melanin, times=burns.hours, mmd=mmd, med=med)
    tan = tan.reshape(len(burns.doses), burns.hours.size, 4)
    acting = burns.acting(burns.doses.T, tan[..., :3].sum(axis=-1).T, tan[..., 3].T)
    result = np.empty((len(burns.doses), hours.size))
    together = max(CELLS_TOGETHER // (1 + int(hours.max(initial=0.0))), 1)
    for first in range(0, len(result), together):
        some = slice(first, first + together)
        result[some] = (peeling or Peeling()).shares(burns, acting[:, some], hours)
    return result.reshape(*shape, hours.size)


def without_peeled(
    states: NDArray[np.floating], untanned: NDArray[np.float64], shares: ArrayLike
) -> NDArray[np.floating]:
    """States (..., 4 or 5) less the new melanin that has peeled off; shares (...) are 0 to 1.

    A share of 1 is a place that has peeled: `peeled_shares` says how many of all places are. With
    that share itself it is the mean of the skin. No place has less melanin in all than without sun.

    Parameters
    ----------
    untanned : (3,) array
        Melanin of basale, spinosum, granulosum without sun (`Skin.untanned_melanin`).

    Raises
    ------
    InputError
        If shares are none of 0 to 1, or not as many as the states.
    """
    left, peeled = np.array(states), as_numbers("shares that have peeled", shares)
    if not np.all((peeled >= 0.0) & (peeled <= 1.0)):
        raise InputError(f"shares that have peeled are {str(shares)[:60]}; allowed is 0 to 1.")
    if peeled.shape not in {(), left.shape[:-1]}:
        raise InputError(
            f"shares that have peeled have shape {peeled.shape}; expected {left.shape[:-1]}."
        )
    taken = np.maximum(left[..., :3] - untanned, 0.0) * np.array(TAKEN)
    total = taken.sum(axis=-1)
    new = np.maximum(left[..., :3].sum(axis=-1) - untanned.sum(), 0.0)
    held = np.minimum(new / np.maximum(total, 1e-30), 1.0) * peeled
    left[..., :3] -= held[..., None] * taken
    return left
