"""States of many places that receive shares of the same doses: as `states_at`, and faster.

The energy retained from a share of the doses is that share of the energy retained from all. So it
is followed once, not for every place. Times may be uneven: dense where a skin changes fast.
"""

from dataclasses import dataclass
from typing import Generic, TypeVar

import numpy as np
from numpy.typing import ArrayLike, DTypeLike, NDArray

from hylios.errors import InputError, as_numbers, require_range
from hylios.tanning.departures import melanin_departures, thickness_departure
from hylios.tanning.dynamics import ThicknessDynamics
from hylios.tanning.erythema import Burns
from hylios.tanning.exposures import LONGEST_HOURS, Exposures, require_exposures
from hylios.tanning.kinetics import Kinetics
from hylios.tanning.recurrence import accumulated, in_a_row, in_blocks, previous
from hylios.tanning.simulation import by_hour, hill, make_relative

Dynamics = TypeVar("Dynamics", bound=Kinetics | ThicknessDynamics)


@dataclass(frozen=True, eq=False)
class Retained(Generic[Dynamics]):
    """Energy that whole doses leave in the skin, hour by hour, and what responds to it.

    Attributes
    ----------
    energy : (M, H) array
        Of doses of M kinds, in multiples of the threshold (5.5, 5.21), from hour 0 on.
    dynamics : MelaninDynamics, MeasuredDynamics or ThicknessDynamics
    """

    energy: NDArray[np.float64]
    dynamics: Dynamics

    def signals(self) -> NDArray[np.float64]:
        """The signal (M, H) where no threshold acts: a share's is that share of it (5.6, 5.8)."""
        hours = self.energy.shape[1]
        rate = accumulated(self.dynamics.signal_rate_decay, in_blocks(self.energy.T))
        return in_a_row(accumulated(self.dynamics.signal_decay, rate), hours).T

    def acting(self) -> NDArray[np.int_]:
        """Hours whose energy can reach the threshold in a place (5.7, 5.23)."""
        return np.flatnonzero(self.energy.sum(axis=0) >= self.dynamics.threshold)


Energies = tuple[Retained[Kinetics], Retained[ThicknessDynamics]]
"""For melanin and for thickness."""


def retained(
    exposures: Exposures, melanin: Kinetics, *, mmd: float, med: float, hours: int
) -> Energies:
    """Energy for melanin and energy for thickness, from hour 0 up to and with hour `hours`.

    Parameters
    ----------
    exposures : Exposures
        With doses (E,), or (M, E) of M kinds, of which a place gets shares of its own.
    mmd, med : float
        Minimal melanogenesis and erythema dose in SED.

    Raises
    ------
    InputError
        If a minimal dose or the last hour is out of range.
    """
    require_exposures(exposures)
    require_range("MMD", mmd, 1e-6, 1e6, "SED")
    require_range("MED", med, 1e-6, 1e6, "SED")
    require_range("last hour", hours, 0, LONGEST_HOURS)

    def followed(doses: NDArray[np.float64], dynamics: Dynamics) -> Retained[Dynamics]:
        received = by_hour(exposures.hours, doses, slice(None), hours + 1)
        energy = accumulated(dynamics.energy_decay, received)
        return Retained(in_a_row(energy, hours + 1).T, dynamics)

    return (
        followed(exposures.doses / mmd, melanin),
        followed(exposures.thickening_doses / med, ThicknessDynamics()),
    )


def states_of_shares(
    energies: Energies,
    shares: ArrayLike,
    marks: NDArray[np.int_],
    dtype: DTypeLike = float,
    burns: Burns | None = None,
    first: int = 0,
) -> NDArray[np.floating]:
    """States (T, S, 4) of places at uneven hours, or (T, S, 5), as `states_at` gives them.

    Energy and signals are exact. The responses run straight from one mark to the next, and so a
    tan does whose marks lie too far apart; with marks at every hour this is the model itself.
    Blood is exact at every mark, but for the tan that an exposure between two marks meets.

    Parameters
    ----------
    energies : pair of Retained
        Of all the doses, for melanin and for thickness.
    shares : (S,) or (S, M) array
        0 to 1, of the doses of every kind.
    marks : (T,) ascending int array
        Hours, the first of them 0; none beyond those of the energies.
    dtype : data-type
        float32 is twice as fast, and leaves 1e-5 of a state.
    burns : Burns, optional
        How all the doses redden the skin (`Burns.of`), of as many kinds; not at all by default.
    first : int
        Hour before which marks are simulated and not told.

    Raises
    ------
    InputError
        If a share is out of range, or the marks don't ascend from 0 within the energies' hours.
    """
    parts = as_numbers("shares", shares)
    parts = parts[:, None] if parts.ndim == 1 else parts
    melanin, thickness = energies
    kinds, hours = melanin.energy.shape
    if parts.ndim != 2 or parts.shape[1] != kinds or not np.all((parts >= 0.0) & (parts <= 1.0)):
        raise InputError(
            f"shares have shape {parts.shape}; allowed are 0 to 1 of {kinds} kinds of doses."
        )
    if not (len(marks) and marks[0] == 0 and marks[-1] < hours and np.all(np.diff(marks) > 0)):
        raise InputError(
            f"marks are {str(marks)[:60]}; allowed are ascending hours from 0 to {hours - 1}."
        )
    since = in_blocks(np.diff(marks, prepend=-1).astype(dtype)[:, None])
    since[since == 0.0] = 1.0
    curves = (
        *melanin_departures(_response(melanin, parts, marks, dtype), melanin.dynamics, since),
        thickness_departure(_response(thickness, parts, marks, dtype), thickness.dynamics, since),
    )
    states = np.stack([in_a_row(curve, len(marks)) for curve in curves], axis=-1)
    make_relative(states, melanin.dynamics, thickness.dynamics)
    start = int(np.searchsorted(marks, first))
    if burns is None:
        return states[start:]
    blood = _blood(burns.until(int(marks[-1])), parts.astype(dtype), states, marks, marks[start:])
    return np.concatenate([states[start:], blood[..., None]], axis=-1)


def _blood(
    burns: Burns,
    shares: NDArray[np.floating],
    states: np.ndarray,
    marks: np.ndarray,
    hours: np.ndarray,
) -> NDArray[np.floating]:
    """Blood (T, S) at hours, of places with shares (S, M) and states (K, S, 4) at the marks."""
    doses = np.matmul(burns.doses.T.astype(shares.dtype), shares.T)
    after = np.searchsorted(marks, burns.hours)
    before = np.maximum(after - 1, 0)
    since = np.maximum(marks[after] - marks[before], 1)
    fraction = ((burns.hours - marks[before]) / since)[:, None].astype(shares.dtype)
    fraction[after == before] = 0.0
    melanin, thickness = (
        told[before] * (1.0 - fraction) + told[after] * fraction
        for told in (states[..., :3].sum(axis=-1), states[..., 3])
    )
    return burns.blood(doses, melanin, thickness, hours)


def responses_of_shares(
    retained: Retained[Kinetics] | Retained[ThicknessDynamics],
    shares: NDArray[np.float64],
    hours: NDArray[np.int_],
) -> NDArray[np.floating]:
    """The Hill factors (S, T) of shares (S,) of doses of one kind at some hours (T,).

    Quick for many shares: the more a place gets, the more hours act, those of most energy first.
    """
    dynamics, energy = retained.dynamics, retained.energy[0]
    if dynamics.threshold == 0.0:
        signal = np.multiply.outer(shares, retained.signals()[0, hours]).astype(np.float32)
        return hill(signal, dynamics.hill_constant, dynamics.hill_exponent)
    acting = retained.acting()
    acting = acting[np.argsort(-energy[acting], kind="stable")]
    _, left = _left(dynamics, int(hours.max(initial=0)) + 1)
    since = hours - acting[:, None]
    signals = np.zeros((len(acting) + 1, len(hours)), np.float32)
    amounts = energy[acting, None] * np.where(since >= 0, left[np.maximum(since, 0)], 0.0)
    np.cumsum(amounts, axis=0, out=signals[1:])
    with np.errstate(divide="ignore"):
        count = np.searchsorted(-energy[acting], -1.0 / shares, side="right")
    signal = shares.astype(np.float32)[:, None] * signals[count]
    return hill(signal, dynamics.hill_constant, dynamics.hill_exponent)


def _response(
    retained: Retained[Dynamics], shares: np.ndarray, marks: np.ndarray, dtype: DTypeLike
) -> np.ndarray:
    """The Hill factor at marks, laid out in blocks (5.5 to 5.8 and 5.11, 5.21 to 5.26)."""
    dynamics = retained.dynamics
    if dynamics.threshold == 0.0:
        signal = in_blocks((shares @ retained.signals()[:, marks]).T.astype(dtype))
        return hill(signal, dynamics.hill_constant, dynamics.hill_exponent)
    acting = retained.acting()
    acting = acting[acting <= marks[-1]]
    ends = np.searchsorted(marks, acting)
    since = np.diff(marks, prepend=0)
    rate_left, signal_left = _left(dynamics, int(since.max()) + 1)
    produced = np.zeros((2, len(marks), len(shares)), dtype)
    if acting.size:
        energy = retained.energy[:, acting].T.astype(dtype) @ shares.T.astype(dtype)
        energy *= energy >= dynamics.threshold
        after = marks[ends] - acting
        steps, starts = np.unique(ends, return_index=True)
        for amount, left in zip(produced, (rate_left, signal_left), strict=True):
            weighted = energy * left[after, None].astype(dtype)
            amount[steps] = np.add.reduceat(weighted, starts, axis=0)
    rate, signal = (in_blocks(amount) for amount in produced)
    by_step = _decays(dynamics.signal_rate_decay, since, dtype)
    handed_on = dynamics.signal_rate_decay * signal_left[np.maximum(since - 1, 0)]
    signal += in_blocks(handed_on[:, None].astype(dtype)) * previous(accumulated(by_step, rate))
    signal = accumulated(_decays(dynamics.signal_decay, since, dtype), signal)
    return hill(signal, dynamics.hill_constant, dynamics.hill_exponent)


def _left(
    dynamics: Kinetics | ThicknessDynamics, hours: int
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Signal rate and signal (hours,) left of a unit of energy of hour 0."""
    rate = np.asarray(dynamics.signal_rate_decay ** np.arange(hours), float)
    signal = accumulated(dynamics.signal_decay, in_blocks(rate[:, None]))
    return rate, in_a_row(signal, hours)[:, 0]


def _decays(decay: float, since: np.ndarray, dtype: DTypeLike) -> np.ndarray:
    return in_blocks((decay**since)[:, None].astype(dtype))
