"""Whole spectra of skin from their values at a few wavelengths.

Spectra of skin are nearly a sum of a few components, so a few values tell the rest. The components
are those of spectra of 300 random skins, each divided by its mean, in which dark skins count as
much as light ones; they come from `python -m examples.simplifications.quadrature`.
"""

from functools import cache

import numpy as np

from hylios.errors import InputError
from hylios.packaged import numbers_of

TABLE = "skin_spectra.csv"

COMPONENTS = 20
"""More than the most wavelengths of a quadrature."""

NOISE = 3e-6
"""Of a value's square, what is error: it keeps weights small where values tell the same."""


def components(reflectances: np.ndarray, count: int = COMPONENTS) -> np.ndarray:
    """Principal components (N, count) of spectra (S, N), each spectrum over its mean.

    They are scaled such that the matrix of the spectra's second moments is nearly the product of
    the components and their transpose.
    """
    relative = reflectances / reflectances.mean(axis=1, keepdims=True)
    _, sizes, directions = np.linalg.svd(relative / np.sqrt(len(relative)), full_matrices=False)
    return directions[:count].T * sizes[:count]


@cache
def shipped_components() -> tuple[np.ndarray, np.ndarray]:
    """Wavelengths (N,) in nm, 360 to 780 in steps of 5, and the shipped components (N, K)."""
    _, table = numbers_of("hylios.lab", TABLE)
    return table[:, 0], table[:, 1:]


def reconstruction(wavelengths: np.ndarray) -> np.ndarray:
    """Matrix (N, W) that makes of a skin's reflectance at W wavelengths that at all N.

    Of the linear ones it has the least mean square error over skins of all colours; what reflects
    all wavelengths alike stays as it is. For the N wavelengths see `shipped_components`.

    Raises
    ------
    InputError
        If the wavelengths in nm do not ascend, or lie outside 360 to 780 nm.
    """
    grid, parts = shipped_components()
    wavelengths = np.asarray(wavelengths, dtype=float)
    if not wavelengths.size or wavelengths.ndim != 1 or not np.all(np.diff(wavelengths) > 0.0):
        raise InputError("wavelengths of a colour must be a list of ascending numbers, in nm.")
    if wavelengths[0] < grid[0] or wavelengths[-1] > grid[-1]:
        raise InputError(
            f"wavelengths of a colour are {wavelengths[0]:g} to {wavelengths[-1]:g} nm; allowed "
            f"is {grid[0]:g} to {grid[-1]:g} nm."
        )
    own = np.array([np.interp(wavelengths, grid, part) for part in parts.T]).T
    count = wavelengths.size
    # least squares with Lagrange's multipliers for the sums of rows, which are 1
    matrix = np.zeros((count + 1, count + 1))
    matrix[:count, :count] = own @ own.T
    matrix[np.arange(count), np.arange(count)] *= 1.0 + NOISE
    matrix[:count, count] = matrix[count, :count] = 1.0
    pull = np.concatenate([own @ parts.T, np.ones((1, grid.size))])
    return np.linalg.solve(matrix, pull)[:count].T


def unseen(wavelengths: np.ndarray) -> np.ndarray:
    """What `reconstruction` from W wavelengths misses of the components (N, K).

    Parameters and errors as there.
    """
    grid, parts = shipped_components()
    matrix = reconstruction(wavelengths)
    own = np.array([np.interp(wavelengths, grid, part) for part in parts.T]).T
    return parts - matrix @ own
