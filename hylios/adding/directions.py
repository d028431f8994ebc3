"""Directions of light in plane layers, by q = refractive index times sine, which refraction keeps.

The squares of q are cut into segments at the refractive indices of the stack, where reflection
becomes total. Just below such a q cosines are square roots, and light that grazes may be absorbed
within a small range of angles, so nodes crowd there: within a segment, functions of direction
are polynomials of a coordinate x from -1 to 1 with

    q^2 = upper - (upper - lower) root(x)^2,

root = h in the first segment and h (h + CROWDING) / (1 + CROWDING) in the others, h = (1 + x) / 2.
A layer holds the directions with q below its refractive index: a leading part of all.
"""

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.polynomial.legendre import leggauss

from hylios.lagrange import lagrange

LEAST_NODES = 3
"""Nodes of a segment, however narrow."""

CROWDING = 0.04
"""Smaller is more nodes at grazing angles, of which cosines down to a few thousandths matter."""


@dataclass(frozen=True)
class Directions:
    """K segments with N nodes in all.

    Attributes
    ----------
    bounds : (K + 1,) array
        Squares of q between segments, ascending from 0.
    counts : tuple of int
        Nodes of each segment.
    """

    bounds: np.ndarray
    counts: tuple[int, ...]

    def within(self, segments: int) -> int:
        """Number of nodes in the first segments."""
        return sum(self.counts[:segments])

    def cosines(self, segments: int) -> tuple[np.ndarray, np.ndarray]:
        """Cosines in a layer that ends with a segment, and weights of the integral over them.

        Returns
        -------
        cosine, weight : (M,) arrays
        """
        parts = [self.points(segments, part, self.counts[part]) for part in range(segments)]
        _, cosine, weight = (np.concatenate(values) for values in zip(*parts, strict=True))
        return cosine, weight

    def points(self, segments: int, part: int, count: int):
        """x, cosine and weight of an integral over the cosine, in one segment of such a layer."""
        place, root, weight = _roots(count, part > 0)
        squared, upper = self.bounds[segments], self.bounds[part + 1]
        width = upper - self.bounds[part]
        cosine = np.sqrt(((squared - upper) + width * root * root) / squared)
        return place, cosine, width * root * weight / (squared * cosine)


def node_counts(bounds: np.ndarray, nodes: int) -> tuple[int, ...]:
    """Nodes of each segment, about `nodes` in all but for the least that narrow ones have.

    There are only three classes of width, so that for all that skin's refractive indices can be
    at any wavelength counts are the same: a change of them is a step, if a small one, in the
    result.
    """
    widths = np.sqrt(np.diff(bounds))
    shares = np.select([widths > 0.75, widths > 0.35], [7.0, 5.0], 2.0)
    counts = np.round(nodes * shares / shares.sum())
    return tuple(max(LEAST_NODES, int(count)) for count in counts)


def interpolation(
    made: Directions, squared: np.ndarray, weight: np.ndarray, row: np.ndarray, rows: int
) -> np.ndarray:
    """Weighted sums of a function at some squares of q, as rows over its values at the nodes.

    Parameters
    ----------
    squared, weight : (K, P) arrays
    row : (K,) array of int
        Which of the R rows these belong to, ascending.
    rows : int
        R.

    Returns
    -------
    (R, N) array
    """
    part = np.searchsorted(made.bounds[1:-1], squared, side="right")
    part[weight <= 0.0] = -1
    result = np.zeros((rows, made.within(len(made.counts))))
    for segment, count in enumerate(made.counts):
        some = part == segment
        targets = np.repeat(row, np.count_nonzero(some, axis=1))
        if not targets.size:
            continue
        upper = made.bounds[segment + 1]
        width = max(upper - made.bounds[segment], 1e-300)
        depth = np.clip((upper - squared[some]) / width, 0.0, 1.0)
        values = lagrange(_roots(count, segment > 0)[0], _place(np.sqrt(depth), segment > 0))
        values *= weight[some][:, None]
        first = np.flatnonzero(np.diff(targets, prepend=-1))
        left = made.within(segment)
        result[targets[first], left : left + count] = np.add.reduceat(values, first, axis=0)
    return result


@dataclass(frozen=True)
class Integrals:
    """Integrals over the cosine, 0 to 1, of the functions that belong to M nodes of a layer.

    A node's function is the polynomial that is 1 there and 0 at the segment's other nodes, and 0
    in other segments.

    Attributes
    ----------
    legendre : (order + 1, M) array
        Of Legendre polynomials times each function.
    mass, slanted : (M, M) arrays
        Of products of two functions, and of the cosine times that.
    """

    legendre: np.ndarray
    mass: np.ndarray
    slanted: np.ndarray


def integrals(made: Directions, segments: int, order: int) -> Integrals:
    """The integrals for a layer that ends with a segment, up to an order of Legendre's."""
    squared = made.bounds[segments]
    shapes, cosines, weights = [], [], []
    for part, count in enumerate(made.counts[:segments]):
        # enough points for the polynomials' waves within the segment
        turn = np.arcsin(min(1.0, np.sqrt((made.bounds[part + 1] - made.bounds[part]) / squared)))
        points = int(count + 24 + 0.6 * order * turn)
        place, cosine, weight = made.points(segments, part, points)
        shapes.append(lagrange(_roots(count, part > 0)[0], place))
        cosines.append(cosine)
        weights.append(weight)
    shape = np.zeros((sum(map(len, cosines)), made.within(segments)))
    row, column = 0, 0
    for block in shapes:
        shape[row : row + block.shape[0], column : column + block.shape[1]] = block
        row, column = row + block.shape[0], column + block.shape[1]
    cosine, weight = np.concatenate(cosines), np.concatenate(weights)
    polynomials = np.empty((order + 1, cosine.size))
    polynomials[0] = 1.0
    polynomials[1:2] = cosine
    for degree in range(1, order):
        polynomials[degree + 1] = (
            (2 * degree + 1) * cosine * polynomials[degree] - degree * polynomials[degree - 1]
        ) / (degree + 1)
    weighted = shape.T * weight
    return Integrals(polynomials @ weighted.T, weighted @ shape, (weighted * cosine) @ shape)


@lru_cache(maxsize=1024)
def legendre_roots(count: int) -> tuple[np.ndarray, np.ndarray]:
    """Points and weights of Gauss's integral from -1 to 1, (count,) each."""
    return leggauss(count)


@lru_cache(maxsize=1024)
def _roots(count: int, crowded: bool) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """x, root, and weights of an integral over root of the points of a segment, (count,)."""
    place, weight = legendre_roots(count)
    half = 0.5 * (1.0 + place)
    if not crowded:
        return place, half, 0.5 * weight
    slope = (2.0 * half + CROWDING) / (1.0 + CROWDING)
    return place, half * (half + CROWDING) / (1.0 + CROWDING), 0.5 * weight * slope


def _place(root: np.ndarray, crowded: bool) -> np.ndarray:
    """x of a root."""
    if crowded:
        root = np.sqrt(0.25 * CROWDING**2 + (1.0 + CROWDING) * root) - 0.5 * CROWDING
    return 2.0 * root - 1.0
