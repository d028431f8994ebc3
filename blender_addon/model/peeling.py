"""What peels by day and by share of the dose, as an image. ESTIMATE, as the model's peeling is.

The model says how much of the skin has peeled; which places these are, a pattern says
(`scene.peeling_nodes`).
"""

import numpy as np
from numpy.typing import NDArray

from hylios.sun.doses import Doses
from hylios.tanning import Burns, ErythemaDynamics, Exposures, Kinetics, Peeling, without_peeled
from hylios.tanning.shares import retained, states_of_shares

COLUMNS, ROWS_A_DAY, MOST_ROWS = 64, 4, 256
"""Shares of the image; rows of a day, and of all days at most."""

STEP = 6.0
"""Hours between two times at which peeling is followed."""

HOURS_BETWEEN = 12
"""At most between two times at which the tan is simulated."""

LEAST_SHARE = 0.0005
"""Less of the skin than this has not peeled."""

HEALED = 0.05
"""Of what had peeled, what is left when the next burn begins with whole skin."""

HANGING = 30.0
"""Hours in which of loose flakes 1/e are left."""

LOOSE = 5.0
"""A fifth of the peeled skin that has come off in a day has all edges loose."""

FEW = 0.03
"""With less of the skin peeled, edges are less loose, so that none follow the hem of a mask."""


def peeling_image(
    received: Doses,
    melanin: Kinetics,
    erythema: ErythemaDynamics,
    *,
    mmd: float,
    med: float,
    days: tuple[float, float],
) -> NDArray[np.float32]:
    """Peeling of places by days and shares of doses, (rows, columns, 3).

    In red the share of the skin that patches cover, in green what of the new melanin they take on
    the mean of the skin, in blue how many of their edges are loose. Rows and columns are even; the
    outer ones tell the ends of the days and of the shares.

    Parameters
    ----------
    received : Doses
        On bare skin.
    melanin, mmd, med
        As in `history.history`.
    erythema : ErythemaDynamics
        How the skin burns.
    days : pair of float
        First and last.
    """
    rows = int(np.clip(np.ceil(ROWS_A_DAY * (days[1] - days[0])), 2, MOST_ROWS))
    hours = 24.0 * (days[0] + (days[1] - days[0]) * _centres(rows))
    whole = received.exposures()
    parts = _centres(COLUMNS)[:, None]
    shares = Exposures(whole.hours, parts * whole.doses, parts * whole.thickening_doses)
    end = int(np.ceil(hours[-1]))
    burns = Burns.of(shares, erythema, med).until(end)
    marks = np.unique(np.concatenate([np.arange(0, end + 1, HOURS_BETWEEN), [end], burns.hours]))
    energies = retained(whole, melanin, mmd=mmd, med=med, hours=end)
    states = states_of_shares(energies, parts[:, 0], marks, np.float32)
    met = states[np.searchsorted(marks, burns.hours)]
    acting = burns.acting(burns.doses.T, met[..., :3].sum(axis=-1), met[..., 3])
    times = np.arange(0.0, hours[-1] + STEP, STEP)
    followed = _followed(Peeling().shares(burns, acting, times).T)
    cover, peeled, loose = (_at(hours, times, told) for told in followed)
    taken = _at(hours, marks, _taken(states, melanin))
    return np.stack([cover, peeled * taken, loose], axis=-1).astype(np.float32)


def _centres(count: int) -> NDArray[np.float64]:
    """Places of texels from 0 to 1; the outer ones stand for the ends."""
    places = (np.arange(count) + 0.5) / count
    places[0], places[-1] = 0.0, 1.0
    return places


def _at(hours: NDArray, times: NDArray, told: NDArray) -> NDArray[np.float64]:
    """What is told at times (T, S), at hours (H, S)."""
    return np.stack([np.interp(hours, times, column) for column in told.T], axis=1)


def _followed(peeled: NDArray[np.float64]) -> tuple[NDArray, NDArray, NDArray]:
    """Of peeled shares (T, S) at even times: what patches cover, the share, how loose edges are.

    What has peeled heals everywhere at once, not from its edges.
    """
    day = round(24.0 / STEP)
    risen = np.maximum(peeled - np.pad(peeled, ((day, 0), (0, 0)))[: len(peeled)], 0.0)
    cover, loose = np.zeros_like(peeled), np.zeros_like(peeled)
    where, hanging = np.zeros(peeled.shape[1]), np.zeros(peeled.shape[1])
    for time, share in enumerate(peeled):
        where = np.where(share > HEALED * where, np.maximum(where, share), share)
        some = np.maximum(where, LEAST_SHARE)
        fresh = np.minimum(LOOSE * risen[time] / some, 1.0) * np.minimum(where / FEW, 1.0)
        hanging = np.maximum(hanging * np.exp(-STEP / HANGING), fresh)
        cover[time], loose[time] = where, hanging
    return cover, peeled, loose


def _taken(states: NDArray[np.floating], melanin: Kinetics) -> NDArray[np.float64]:
    """Part of the new melanin that a peeled place loses, of states (..., 4)."""
    steady = melanin.steady_state()
    untanned = steady / steady.sum()
    total = states[..., :3].sum(axis=-1)
    lost = total - without_peeled(states, untanned, 1.0)[..., :3].sum(axis=-1)
    return np.clip(lost / np.maximum(total - 1.0, 1e-6), 0.0, 1.0)
