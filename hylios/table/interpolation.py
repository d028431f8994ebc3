"""Interpolation between the knots of a grid: multilinear, or monotone cubic (PCHIP).

Both are sums over the corners of a cell, weighted by a product of one function to an axis. PCHIP
is the tensor product of Fritsch and Butland's piecewise cubic (SIAM J. Sci. Stat. Comput. 5, 300,
1984): on a line of knots it keeps the order of the numbers there and never overshoots them.
Between such lines, as any smooth tensor product, it need not.
"""

from functools import reduce

import numpy as np

from hylios.errors import InputError

INTERPOLATIONS = ("linear", "pchip")
CHUNK = 16_384
"""Positions at a time, so that a lookup's memory does not grow with their number."""


def interpolate(
    kind: str, knots: tuple[np.ndarray, ...], values: np.ndarray, positions: np.ndarray
) -> np.ndarray:
    """Values (N, C) at positions (N, K); beyond the outermost knots their value is held.

    Parameters
    ----------
    kind : str
        One of `INTERPOLATIONS`.
    knots : K ascending arrays
    values : (*numbers of knots, C) array

    Raises
    ------
    InputError
        If there is no such interpolation.
    """
    return between(knots, nodes(kind, knots, values), positions)


def between(knots: tuple[np.ndarray, ...], nodes: np.ndarray, positions: np.ndarray) -> np.ndarray:
    """As `interpolate`, with what `nodes` has made of the values."""
    result = np.empty((len(positions), nodes.shape[len(knots)]))
    for start in range(0, len(positions), CHUNK):
        part = slice(start, start + CHUNK)
        result[part] = _interpolated(knots, nodes, positions[part])
    return result


def sliced(
    knots: tuple[np.ndarray, ...], nodes: np.ndarray, positions: np.ndarray
) -> tuple[tuple[np.ndarray, ...], np.ndarray]:
    """Knots and nodes without the last axis, at B positions on it: components are (B, C) then.

    Parameters as of `between`.
    """
    count = len(knots)
    low, weights = _axis(knots[-1], positions, nodes.shape[-1])
    along = np.moveaxis(nodes, (count - 1, -1), (0, 1))
    size, kinds, *others = along.shape
    placed = np.zeros((len(positions), size, kinds))
    for number, first in enumerate(low):
        placed[number, first : first + 2] = weights[number].reshape(-1, kinds)
    at_positions = placed.reshape(len(positions), -1) @ along.reshape(size * kinds, -1)
    there = np.moveaxis(at_positions.reshape(-1, *others), 0, count - 1)
    return knots[:-1], there.reshape(*others[: count - 1], -1, *others[count:])


def slopes(knots: np.ndarray, values: np.ndarray) -> np.ndarray:
    """Slopes of the monotone cubic at its knots.

    Inside, the harmonic mean of the neighbouring secants, weighted by their lengths, or 0 where
    they differ in sign; at the ends, a parabola's slope cut to what keeps the order.

    Parameters
    ----------
    knots : (n,) array, n at least 2
    values : (n, ...) array
    """
    steps = np.diff(knots).reshape(-1, *(1,) * (values.ndim - 1))
    secants = np.diff(values, axis=0) / steps
    if len(knots) == 2:
        return np.concatenate([secants, secants])
    before, after = secants[:-1], secants[1:]
    near, far = 2.0 * steps[1:] + steps[:-1], steps[1:] + 2.0 * steps[:-1]
    inner = np.zeros_like(before)
    np.divide(
        (near + far) * before * after,
        near * after + far * before,
        out=inner,
        where=before * after > 0.0,
    )
    first = _end_slope(steps[0], steps[1], secants[0], secants[1])
    last = _end_slope(steps[-1], steps[-2], secants[-1], secants[-2])
    return np.concatenate([first[None], inner, last[None]])


def _end_slope(near, far, secant: np.ndarray, next_secant: np.ndarray) -> np.ndarray:
    parabola = ((2.0 * near + far) * secant - near * next_secant) / (near + far)
    turns = secant * next_secant <= 0.0
    steepest = np.where(turns, 3.0 * np.abs(secant), np.inf)
    cut = np.sign(secant) * np.minimum(np.abs(parabola), steepest)
    return np.where(parabola * secant > 0.0, cut, 0.0)


def nodes(kind: str, knots: tuple[np.ndarray, ...], values: np.ndarray) -> np.ndarray:
    """Values at the knots, and for cubics their slopes, shape (*knots, C, *kinds of number).

    An axis has the number alone, or the number and its slope along that axis. Parameters and
    errors as in `interpolate`.
    """
    if kind not in INTERPOLATIONS:
        raise InputError(f"interpolation is {kind!r}; allowed are {', '.join(INTERPOLATIONS)}.")
    result = values
    for axis, own in enumerate(knots):
        kinds = [result]
        if kind == "pchip" and len(own) > 1:
            along = np.moveaxis(result, axis, 0)
            kinds.append(np.moveaxis(slopes(own, along), 0, axis))
        result = np.stack(kinds, axis=-1)
    return result


def _interpolated(
    knots: tuple[np.ndarray, ...], nodes: np.ndarray, positions: np.ndarray
) -> np.ndarray:
    count = len(knots)
    kinds = nodes.shape[count + 1 :]
    axes = [_axis(own, positions[:, k], kinds[k]) for k, own in enumerate(knots)]
    lows = np.stack([low for low, _ in axes])
    cells = np.asarray(np.ravel_multi_index(tuple(lows), nodes.shape[:count]))
    order = np.argsort(cells, kind="stable")
    starts = np.flatnonzero(np.diff(cells[order], prepend=-1))
    # Corners and kinds of number of each axis side by side: the order of the weights.
    by_axis = [place for k in range(count) for place in (k, count + 1 + k)] + [count]
    *others, last = (weights for _, weights in axes)
    components = nodes.shape[count]
    result = np.empty((len(positions), components))
    for those in np.split(order, starts[1:]):
        corners = tuple(slice(low, low + 2) for low in lows[:, those[0]])
        block = nodes[corners].transpose(by_axis)
        # the last axis on its own: products with it too would be many more numbers
        block = block.reshape(-1, last.shape[1] * components)
        first = reduce(_products, (weights[those] for weights in others), np.ones((len(those), 1)))
        sums = (first @ block).reshape(-1, last.shape[1], components)
        result[those] = (last[those, None] @ sums)[:, 0]
    return result


def _axis(knots: np.ndarray, position: np.ndarray, kinds: int) -> tuple[np.ndarray, np.ndarray]:
    """Index of the knot below each position, and the weights (N, corners x kinds) around it."""
    if len(knots) == 1:
        return np.zeros(position.shape, int), np.ones((*position.shape, 1))
    low = np.clip(np.searchsorted(knots, position, side="right") - 1, 0, len(knots) - 2)
    step = knots[low + 1] - knots[low]
    t = np.clip((position - knots[low]) / step, 0.0, 1.0)
    if kinds == 1:
        return low, np.stack([1.0 - t, t], axis=-1)
    rest = 1.0 - t
    above = t * t * (3.0 - 2.0 * t)
    # Hermite's cubics: of the value and the slope at the knot below, then at the one above.
    return low, np.stack(
        [1.0 - above, step * t * rest * rest, above, -step * t * t * rest], axis=-1
    )


def _products(first: np.ndarray, second: np.ndarray) -> np.ndarray:
    """Products of all pairs in each row: (N, A) and (N, B) to (N, A B)."""
    return (first[:, :, None] * second[:, None, :]).reshape(len(first), -1)
