"""Curves as a mean and a few shapes, so that the worst curve too is met."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

HARDER = 0.5
"""Power of an error over the mean one by which a line weighs more in the next round."""

LEAST = 0.1
"""What is added to that, so that nothing loses all weight at once."""


@dataclass(frozen=True, eq=False)
class Shapes:
    """A mean (K,), shapes (R, K) and what gives a curve's coefficients, (K, R)."""

    mean: NDArray[np.float64]
    shapes: NDArray[np.float64]
    solve: NDArray[np.float64]

    def coefficients(self, curves: NDArray) -> NDArray:
        """Those (N, R) with which shapes come nearest to curves (N, K), in their dtype."""
        kind = curves.dtype
        return (curves - self.mean.astype(kind)) @ self.solve.astype(kind)

    def curves(self, coefficients: NDArray) -> NDArray:
        """Curves (N, K) of coefficients (N, R), in their dtype."""
        kind = coefficients.dtype
        return coefficients @ self.shapes.astype(kind) + self.mean.astype(kind)


def principal_shapes(
    curves: NDArray, rank: int, weights: NDArray[np.float64], rounds: int
) -> Shapes:
    """Shapes of curves (N, K): principal components, weighted anew by the errors they leave.

    Parameters
    ----------
    weights : (N,) array
        Of the curves.
    rounds : int
        How often curves and places with large errors get more weight, so that the largest error
        falls while the mean grows.
    """
    numbers = curves.astype(float)
    by_curve, by_place = weights / weights.mean(), np.ones(curves.shape[1])
    shapes = _weighted(numbers, rank, by_curve, by_place)
    for _ in range(rounds):
        errors = np.abs(shapes.curves(shapes.coefficients(numbers)) - numbers)
        by_curve = by_curve * _harder(errors.max(axis=1), HARDER)
        by_place = by_place * _harder(errors.max(axis=0), HARDER / 2.0)
        shapes = _weighted(numbers, rank, by_curve, by_place)
    return shapes


def _harder(errors: NDArray, power: float) -> NDArray:
    mean = errors.mean()
    return (errors / mean + LEAST) ** power if mean > 0.0 else np.ones_like(errors)


def _weighted(numbers: NDArray, rank: int, by_curve: NDArray, by_place: NDArray) -> Shapes:
    squares = by_curve**2
    mean = squares @ numbers / squares.sum()
    lines = (numbers - mean) * by_place
    lines *= by_curve[:, None]
    # Ascending eigenvalues; with fewer places than shapes the rest are 0.
    largest = np.linalg.eigh(lines.T @ lines)[1][:, ::-1][:, :rank]
    vectors = np.zeros((len(largest), rank))
    vectors[:, : largest.shape[1]] = largest
    return Shapes(mean, (vectors / by_place[:, None]).T, vectors * by_place[:, None])
