"""Which lines of a grid to keep, so that the others lie nearly straight between them."""

import numpy as np
from numpy.typing import NDArray

AT_ONCE = 0.2
"""Of the largest error, above which others are mended in the same round."""

EVEN_PART = 0.15
"""Part of the lines that is spread evenly, however straight the numbers run."""


def by_error(
    places: NDArray, values: NDArray, most: int, tolerance: float = 0.0, even: int = 0
) -> NDArray[np.int_]:
    """Indices of lines between which the others lie straight, most of them at most.

    Splits where the error is largest (Ramer, Douglas and Peucker), in all gaps at once, until none
    is above the tolerance.

    Parameters
    ----------
    places : (N,) ascending array
        Of the lines.
    values : (N, K) array
        Their numbers.
    even : int
        Every so many-th line is kept whatever its numbers; 0 for the first and last alone.
    """
    kept = np.zeros(len(places), bool)
    kept[[0, -1]] = True
    kept[:: even or len(places)] = True
    numbers = np.ascontiguousarray(values.T)
    where = places.astype(values.dtype)
    while True:
        ends = np.flatnonzero(kept)
        room = most - len(ends)
        if room <= 0 or len(ends) == len(places):
            return ends
        errors = _errors(where, numbers, ends)
        worst = np.maximum.reduceat(errors, ends[:-1])
        limit = max(tolerance, AT_ONCE * worst.max())
        if not worst.max() > tolerance:
            return ends
        if np.count_nonzero(worst > limit) > room:
            limit = np.partition(worst, -room - 1)[-room - 1]
        gaps = np.where(worst > limit, worst, np.inf)
        hits = np.flatnonzero(errors == np.repeat(gaps, np.diff(ends)))
        # Of equal errors in a gap the first.
        gap = np.searchsorted(ends, hits)
        kept[hits[np.diff(gap, prepend=-1) > 0]] = True


def _errors(places: NDArray, numbers: NDArray, ends: NDArray[np.int_]) -> NDArray:
    """How far lines are from straight between the ends: (N - 1,), without the last line."""
    gaps = np.diff(ends)
    at_ends = numbers[:, ends]
    slopes = np.diff(at_ends) / np.diff(places[ends])
    errors = places[:-1] - np.repeat(places[ends[:-1]], gaps)
    straight = np.repeat(slopes, gaps, axis=1) * errors
    straight += np.repeat(at_ends[:, :-1], gaps, axis=1)
    straight -= numbers[:, :-1]
    return np.abs(straight, out=straight).max(axis=0)


def by_bend(places: NDArray, values: NDArray, most: int) -> NDArray[np.int_]:
    """Indices of some lines, as dense as the root of how sharply the numbers bend there.

    So the errors between them are alike. Quicker than `by_error`, for numbers that run smoothly;
    the parameters are the same.
    """
    if len(places) <= most:
        return np.arange(len(places))
    gaps = np.diff(places).astype(values.dtype)
    bends = np.abs(np.diff(np.diff(values, axis=0) / gaps[:, None], axis=0)).max(axis=1)
    density = np.zeros(len(places))
    density[1:-1] = np.sqrt(bends * (gaps[1:] + gaps[:-1]))
    density += EVEN_PART * density.mean() + 1e-9
    passed = np.cumsum(density)
    wanted = np.linspace(passed[0], passed[-1], most)
    return np.unique(np.clip(np.searchsorted(passed, wanted), 0, len(places) - 1))
