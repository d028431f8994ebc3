"""Which hours of a tan are simulated, and where a day lies among them."""

import numpy as np
from numpy.typing import ArrayLike, DTypeLike, NDArray

from hylios.skin import whole_thickening
from hylios.tanning import Burns, Exposures
from hylios.tanning.shares import Energies, states_of_shares

from .darkening import Uva
from .thinning import by_bend

STEPS = 1024
"""Even steps of the days, and of the shares. A jump is spread over one step of the share."""

AFTER = (1, 2, 4, 6, 9, 12, 16, 20, 26, 36, 48)
"""Hours after an exposure that are candidates too where skin reddens or darkens at once."""

WEIGHTS = np.array([1.0, 1.0, 0.7], np.float32)
"""What errors of u, v and b mean for what is seen."""

REMEMBERED = 120
"""Hours before the first day that are candidates, all of them: what has just begun goes on."""


def states_seen(
    energies: Energies,
    shares: ArrayLike,
    marks: NDArray[np.int_],
    dtype: DTypeLike = float,
    burns: Burns | None = None,
    first: int = 0,
) -> NDArray[np.floating]:
    """States (T, S, 4), or (T, S, 5) of skin that reddens, by which a table tells how it looks.

    Parameters and errors as of `states_of_shares`. Tables have skin all of which thickens; where
    it reddens only the epidermis does (`whole_thickening`).
    """
    states = states_of_shares(energies, shares, marks, dtype, burns, first)
    return states if burns is None else whole_thickening(states)


def coordinates_of(states: NDArray[np.floating]) -> NDArray[np.float32]:
    """Coordinates (..., 3) of states (..., 4), or (..., 5) with the blood."""
    result = np.zeros((*states.shape[:-1], 3), np.float32)
    result[..., 0] = np.log(states[..., :3].sum(axis=-1))
    result[..., 1] = np.log(states[..., 3])
    if states.shape[-1] > 4:
        result[..., 2] = np.log(states[..., 4])
    return result


def darkened_coordinates(
    states: NDArray[np.floating], uva: Uva | None, shares: ArrayLike, hours: NDArray[np.int_]
) -> NDArray[np.float32]:
    """Coordinates of states (T, S, ...) at hours (T,), with melanin that has darkened at once.

    Parameters
    ----------
    uva : Uva or None
        Without it none has.
    shares : (S,) or (S, M) array
    """
    result = coordinates_of(states)
    if uva is not None:
        result[..., 0] += uva.logarithms(shares, hours)
    return result


def hours_to_simulate(
    energies: Energies,
    few: ArrayLike,
    exposures: Exposures,
    span: tuple[int, int],
    rows: int,
    candidates: int,
    burns: Burns | None = None,
    uva: Uva | None = None,
) -> NDArray[np.int_]:
    """Hours from 0 to the end of a span: dense where some tans bend.

    Parameters
    ----------
    few : (F,) or (F, M) array
        Shares of the doses of those tans.
    exposures : Exposures
        In the hour in which one begins a tan has a kink.
    span : pair of int
        First and last hour to tell.
    rows : int
        Most hours in the span, and before it.
    candidates : int
        Even hours, over the number of rows, among which rows are picked.
    burns : Burns, optional
        Of skin that reddens.
    uva : Uva, optional
        Of skin that darkens at once.
    """
    first, end = span
    begun = _begun(exposures)
    begun = begun[begun <= end]
    kinks = np.unique(np.append(begun, np.maximum(begun - 1, 0)))
    if len(kinks) > rows // 2:
        begun, kinks = begun[:0], kinks[:0]
    even = candidates * rows
    closely = np.arange(max(first - REMEMBERED, 0), first)
    is_quick = burns is not None or uva is not None
    quick = np.unique(np.add.outer(begun, AFTER)) if is_quick else kinks[:0]
    hours = np.unique(
        np.concatenate(
            [_even(0, first, even), closely, _even(first, end, even), kinks, quick[quick <= end]]
        )
    )
    states = states_seen(energies, few, hours, np.float32, burns)
    lines = (WEIGHTS * darkened_coordinates(states, uva, few, hours)).reshape(len(hours), -1)
    start = int(np.searchsorted(hours, first))
    before = by_bend(hours[: start + 1], lines[: start + 1], rows)
    most = rows - int(np.count_nonzero(kinks >= first))
    told = start + by_bend(hours[start:], lines[start:], most)
    return np.unique(np.concatenate([hours[before], hours[told], kinks]))


def texel_places(wanted: NDArray, lines: NDArray[np.int_], texels: int) -> NDArray[np.float64]:
    """Texture coordinates of places, where lines are the first texels' centres."""
    return (np.interp(wanted, lines, np.arange(len(lines))) + 0.5) / texels


def _begun(exposures: Exposures) -> NDArray[np.int_]:
    """Hours in which exposures begin."""
    hours = np.unique(exposures.hours)
    return hours[np.diff(hours, prepend=-2) > 1]


def _even(first: int, last: int, most: int) -> NDArray[np.int_]:
    return np.linspace(first, last, min(most, last - first + 1)).round().astype(int)
