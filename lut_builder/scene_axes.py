"""The axes of a table for one scene, and the states at its knots.

However the sun shines in a scene, its states lie on a curved sheet (time, and how much of the dose
reached the skin) within the box that the axes of the skin's whole table span. A scene's table has
the first of these axes, and the states at its knots lie on the sheet: a lookup along the axes then
finds what lies off them too.
"""

import math

import numpy as np
from scipy.sparse import csr_array, dia_array, kron, vstack
from scipy.sparse.linalg import spsolve

from hylios.table import StateAxes
from hylios.table.interpolation import interpolate

NEAR = 0.01
"""Distance in the logarithm within which states count as one. Along an axis it is .09 CIEDE2000 at
most."""

LONGER = 0.25
"""How much longer a scene's step on an axis may be for one knot less, as a share of the whole
table's step. A table is as near the model with a quarter to a half of the states
(`docs/choosing.md`)."""

BENDING, RIDGE = 1e-2, 1e-6
"""Weights of the sheet's bends, and of its distance from the plane of the axes, per knot, against
its distance from the states."""


def laid_over(whole: StateAxes, reached: np.ndarray) -> tuple[StateAxes, np.ndarray]:
    """Axes over the states (N, 4) that a scene reaches, and the states (*shape, 4) at the knots.

    The axes are the first of the whole table's, as many as leave the scene's states near the
    sheet, and their steps about as long. The untanned skin is a knot.
    """
    basis = _all_directions(whole)
    coordinates = np.log(reached / whole.untanned) @ basis
    ends = coordinates.min(axis=0), coordinates.max(axis=0)
    places = coordinates[_representatives(coordinates)]
    own = sorted(whole.knots, key=lambda knots: len(knots) == 1)  # as `_all_directions`
    several = sum(len(knots) > 1 for knots in own)
    knots, off = (np.zeros(1),), np.zeros((1, 3))
    for count in range(1, max(several, 1) + 1):
        knots = tuple(
            _knots_over(whole_knots, -low, high)
            for whole_knots, low, high in zip(own[:count], *ends, strict=False)
        )
        off, left = _sheet(knots, places[:, :count], places[:, count:])
        if np.all(left[: several - count] <= NEAR):
            break
    axes = StateAxes(whole.untanned, basis[:, : len(knots)], knots)
    off = off @ basis[:, len(knots) :].T
    return axes, axes.knot_states() * np.exp(off.reshape(*axes.shape, 4))


def farthest(
    axes: StateAxes, knot_states: np.ndarray, reached: np.ndarray, interpolation: str
) -> float:
    """How far the states (N, 4) lie at most from what a lookup between the knots makes of them.

    In the logarithm of one of the four numbers; `NEAR` is added for the states not looked at.
    """
    ratios = np.log(reached / axes.untanned)
    ratios = ratios[_representatives(ratios)]
    looked_up = interpolate(
        interpolation, axes.knots, np.log(knot_states / axes.untanned), ratios @ axes.basis
    )
    return float(np.abs(looked_up - ratios).max()) + NEAR


def _all_directions(whole: StateAxes) -> np.ndarray:
    """Four orthonormal columns: the axes with several knots, those with one, and the rest."""
    order = np.argsort([len(knots) == 1 for knots in whole.knots], kind="stable")
    directions, _, _ = np.linalg.svd(whole.basis)
    return np.concatenate([whole.basis[:, order], directions[:, len(order) :]], axis=1)


def _representatives(places: np.ndarray) -> np.ndarray:
    """Numbers of some of the places (N, 4), from one of which none lies farther than `NEAR`."""
    cells = np.round(places / NEAR).astype(int)
    cells -= cells.min(axis=0)
    _, first = np.unique(np.ravel_multi_index(cells.T, cells.max(axis=0) + 1), return_index=True)
    return first


def _knots_over(own: np.ndarray, below: float, above: float) -> np.ndarray:
    """Knots at 0 and evenly so far below and above, at about an axis's own steps.

    Three knots at least where the axis has them, without which PCHIP is but linear.
    """
    sides = _intervals(-own[own < 0.0], below), _intervals(own[own > 0.0], above)
    if sum(sides) == 1 and len(own) > 2:
        sides = 2 * sides[0], 2 * sides[1]
    return np.concatenate(
        [np.linspace(-below, 0.0, sides[0] + 1)[:-1], np.linspace(0.0, above, sides[1] + 1)]
    )


def _intervals(own: np.ndarray, reach: float) -> int:
    """How many steps there are from 0 to where a scene reaches, beside an axis's own knots."""
    if own.size == 0 or reach < NEAR:
        return 0
    return max(int(np.ceil(reach * own.size / own.max() - LONGER)), 1)


def _sheet(
    knots: tuple[np.ndarray, ...], places: np.ndarray, off: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """The sheet through places (N, K) on the axes and (N, L) off them.

    Where it lies at the knots, (knots, L), for the multilinear interpolation to come closest to
    the places, with few bends where there are none; and how far the farthest is, (L,).
    """
    weights = _weights(knots, places)
    bends = _bends(knots)
    count, size = len(places), math.prod(len(own) for own in knots)
    normal = weights.T @ weights + count / size * (
        BENDING * (bends.T @ bends) + RIDGE * _identity(size)
    )
    free = np.flatnonzero(np.any(np.stack(np.meshgrid(*knots, indexing="ij")), axis=0))
    sheet = np.zeros((size, off.shape[1]))
    if free.size and off.shape[1]:
        wanted = (weights.T @ off)[free]
        solved = spsolve(normal.tocsc()[free][:, free], wanted)
        sheet[free] = np.reshape(np.asarray(solved), wanted.shape)
    return sheet, np.abs(weights @ sheet - off).max(axis=0)


def _weights(knots: tuple[np.ndarray, ...], places: np.ndarray) -> csr_array:
    """Weights (N, knots) of multilinear interpolation at places (N, K)."""
    count = len(places)
    numbers, weights = np.zeros((count, 1), int), np.ones((count, 1))
    for own, place in zip(knots, places.T, strict=True):
        low = np.clip(np.searchsorted(own, place) - 1, 0, max(len(own) - 2, 0))
        corners = low[:, None] + np.arange(min(len(own), 2))
        share = np.interp(place, own, np.arange(len(own))) - low
        parts = np.stack([1.0 - share, share], axis=1)[:, : corners.shape[1]]
        numbers = (numbers[:, :, None] * len(own) + corners[:, None]).reshape(count, -1)
        weights = (weights[:, :, None] * parts[:, None]).reshape(count, -1)
    rows = np.repeat(np.arange(count), weights.shape[1])
    size = math.prod(len(own) for own in knots)
    return csr_array((weights.ravel(), (rows, numbers.ravel())), shape=(count, size))


def _bends(knots: tuple[np.ndarray, ...]) -> csr_array:
    """From numbers at the knots, how far each lies from the line of its neighbours on an axis."""
    shape = [len(own) for own in knots]
    parts = []
    for axis, own in enumerate(knots):
        inner = np.arange(max(len(own) - 2, 0))
        share = (own[2:] - own[1:-1]) / (own[2:] - own[:-2])
        bend = np.zeros((inner.size, len(own)))
        bend[inner, inner], bend[inner, inner + 2] = share, 1.0 - share
        bend[inner, inner + 1] = -1.0
        before, after = math.prod(shape[:axis]), math.prod(shape[axis + 1 :])
        parts.append(kron(kron(_identity(before), csr_array(bend)), _identity(after)))
    return csr_array(vstack(parts))


def _identity(size: int) -> dia_array:
    return dia_array((np.ones((1, size)), [0]), shape=(size, size))
