"""Melanin and thickness from the response to light: 5.9 to 5.12, 5.25 and 5.27.

Both are departures from the state without sun. Arrays are (BLOCK, blocks, histories), as
`recurrence` lays time out. Between two marks may lie more hours than one; the response then runs
straight from the one to the other.
"""

from typing import NamedTuple

import numpy as np

from hylios.tanning.dynamics import MelaninDynamics, ThicknessDynamics
from hylios.tanning.measured import MeasuredDynamics
from hylios.tanning.recurrence import accumulated, previous

Hours = np.ndarray | None
"""Hours from the mark before to a mark: one number, or one for every mark; None where all are 1."""


def melanin_departures(
    response: np.ndarray, dynamics: MelaninDynamics | MeasuredDynamics, hours: Hours = None
) -> list[np.ndarray]:
    """Melanin of basale, spinosum, granulosum beyond that without sun, at the marks.

    Production follows the response of the hour, transfer that of the hour before. Of the hours
    between two marks transfer has its mean there.

    Parameters
    ----------
    response : (BLOCK, blocks, H) array
        The Hill factor of 5.11.
    hours : (1, 1, 1) or (BLOCK, blocks, 1) array, or None
        From the mark before, of the response's dtype; 1 or more.
    """
    if isinstance(dynamics, MeasuredDynamics):
        new = _new_melanin(response, dynamics, hours)
        return [share * new for share in dynamics.places]
    steady = dynamics.steady_state().tolist()
    start, leaving, leaving_mean = _hours_before(response, hours)
    departures: list[np.ndarray] = []
    for layer in range(3):
        production, transfer = dynamics.extra_production[layer], dynamics.extra_transfer[layer]
        lost = transfer * dynamics.melanin_decay * steady[layer]
        usual = dynamics.transfer[layer - 1] if layer else 0.0
        more = dynamics.extra_transfer[layer - 1] if layer else 0.0
        balance = more * steady[layer - 1] - lost
        first, last = None, production * response + balance * leaving
        if start is not None:
            first = production * start.at + balance * start.before
        if layer:
            start_below, below, _ = _hours_before(departures[-1], hours)
            last += (usual + more * leaving) * below
            if first is not None and start is not None and start_below is not None:
                first += (usual + more * start.before) * start_below.before
        # 1 less the decay, which float32 holds where the decay is nearly 1.
        fading = (1.0 - dynamics.melanin_decay * (1.0 - dynamics.transfer[layer])) + (
            dynamics.melanin_decay * transfer
        ) * leaving_mean
        departures.append(_departure(fading, first, last, hours))
    return departures


def _new_melanin(response: np.ndarray, dynamics: MeasuredDynamics, hours: Hours) -> np.ndarray:
    """Melanin that people's skin adds, at the marks (`MeasuredDynamics`)."""
    made = dynamics.production * dynamics.gain
    forming = _followed(response, 1.0 - dynamics.forming_decay, 1.0 - dynamics.forming_decay, hours)
    _, _, before = _hours_before(forming, hours)
    held_off = (made / dynamics.most) * before
    pools = (
        ((1.0 - dynamics.slow_share) * made, 1.0 - dynamics.fast_decay),
        (dynamics.slow_share * made, 1.0 - dynamics.slow_decay),
    )
    fast, slow = (_followed(forming, share, lost + held_off, hours) for share, lost in pools)
    return fast + slow


def _followed(
    values: np.ndarray, share: float, fading: np.ndarray | float, hours: Hours
) -> np.ndarray:
    """What an hour adds a share of `values` to, and loses by `fading`; from 0 at the first mark."""
    start, _, _ = _hours_before(values, hours)
    first = None if start is None else share * start.at
    rates = np.full((1, 1, 1), fading, values.dtype) if np.ndim(fading) == 0 else fading
    return _departure(np.asarray(rates), first, share * values, hours)


def thickness_departure(
    response: np.ndarray, dynamics: ThicknessDynamics, hours: Hours = None
) -> np.ndarray:
    """Thickness beyond that without sun at the marks; parameters as in `melanin_departures`."""
    last = dynamics.extra_production * response
    first = None if hours is None else dynamics.extra_production * previous(response)
    fading = np.full((1, 1, 1), 1.0 - dynamics.cell_decay, response.dtype)
    return _departure(fading, first, last, hours)


class _Start(NamedTuple):
    """What runs straight from mark to mark: at a step's start, and in the hour before."""

    at: np.ndarray
    before: np.ndarray


def _hours_before(values: np.ndarray, hours: Hours) -> tuple[_Start | None, np.ndarray, np.ndarray]:
    """A step's start; values in the hour before its end, and their mean in the hours before all.

    Where steps are single hours there is no start.
    """
    before = previous(values)
    if hours is None:
        return None, before, before
    by_hour = (values - before) / hours
    last = values - by_hour
    return _Start(before, before - by_hour), last, 0.5 * (before + last)


def _departure(
    fading: np.ndarray, first: np.ndarray | None, last: np.ndarray, hours: Hours
) -> np.ndarray:
    """What is added by the hour and fades, from 0 at the first mark.

    What an hour adds runs straight from `first` at the mark before to `last`.
    """
    if first is None or hours is None:
        last[0, 0] = 0.0
        return accumulated(_one_or_all(1.0 - fading), last)
    # Sums over a step's n hours i of decay^(n - i), and of decay^(n - i) i / n.
    faded = np.expm1(hours * np.log1p(-fading))
    total = -faded / fading
    late = (hours - (1.0 - fading) * total) / (hours * fading)
    slow = np.sqrt(np.finfo(fading.dtype).eps)
    if fading.min() < slow:
        # Else the numerator is rounding alone.
        late = np.where(fading < slow, total * (hours + 1.0) / (2.0 * hours), late)
    added = (total - late) * first
    added += late * last
    added[0, 0] = 0.0
    return accumulated(_one_or_all(1.0 + faded), added)


def _one_or_all(decay: np.ndarray) -> np.ndarray | float:
    return float(decay.item()) if decay.size == 1 else decay
