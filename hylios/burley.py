"""Burley's diffusion profile, fitted to where light leaves the skin.

P. Christensen and B. Burley, "Approximate reflectance profiles for efficient subsurface
scattering" (Pixar technical memo 15-04, 2015): at distance r from where light comes in, light
leaves with density R(r) = (exp(-r / d) + exp(-r / 3d)) / (8 pi d r), which has the integral 1
over the plane. This is the profile of Blender's Cycles, whose radius is 4 pi 1.04 d.
"""

import numpy as np

from hylios.errors import InputError


def burley_share_within(distance: np.ndarray, width: float | np.ndarray) -> np.ndarray:
    """Share of the light that leaves within a distance, for a profile of width d."""
    ratio = np.asarray(distance) / width
    return 1.0 - 0.25 * np.exp(-ratio) - 0.75 * np.exp(-ratio / 3.0)


def burley_width(edges: np.ndarray, weights: np.ndarray) -> float | np.ndarray:
    """Width d of the Burley profile nearest to light counted by distance.

    The fit minimises the area between the two cumulative distributions over the logarithm of the
    distance, squared: every scale of a scene counts alike.

    Parameters
    ----------
    edges : (N,) ascending array
        Where each bin of distances starts, the first at 0; the last bin is open. d has its unit.
    weights : (..., N) array
        Light in each bin, not negative.

    Returns
    -------
    float, or (...) array
        The width, to 1e-4 of itself.

    Raises
    ------
    InputError
        If a weight is negative or all of a profile are 0.
    """
    weights = np.asarray(weights, dtype=float)
    whole = weights.sum(axis=-1, keepdims=True)
    if np.any(weights < 0) or not np.all(whole > 0):
        raise InputError("a profile needs light: weights of 0 or more, not all 0.")
    ends = np.asarray(edges[1:], dtype=float)
    measured = np.cumsum(weights, axis=-1)[..., :-1] / whole
    spacing = np.gradient(np.log(ends))

    def misfit(logarithms: np.ndarray) -> np.ndarray:
        within = burley_share_within(ends, np.exp(logarithms)[..., None])
        return np.sum(spacing * (within - measured) ** 2, axis=-1)

    grid = np.linspace(np.log(ends[0] / 3.0), np.log(ends[-1]), GRID)
    shape = measured.shape[:-1]
    best = np.argmin([misfit(np.full(shape, width)) for width in grid], axis=0)
    low, high = grid[np.maximum(best - 1, 0)], grid[np.minimum(best + 1, GRID - 1)]
    width = np.exp(_golden_minimum(misfit, low, high, grid[2] - grid[0]))
    return width if shape else float(width)


GRID = 200
"""Widths tried first."""

RESAMPLINGS = 40


def burley_width_error(edges: np.ndarray, counts: np.ndarray) -> float:
    """Standard error of `burley_width` where the light was counted ray by ray.

    The standard deviation over 40 drawings of as many rays from the counted distribution
    (bootstrap); itself known to some 11 %. It says nothing of how well Burley's profile fits.

    Parameters
    ----------
    edges : (N,) ascending array
        As in `burley_width`.
    counts : (N,) int array
        Rays in each bin.

    Raises
    ------
    InputError
        If a count is negative or all are 0.
    """
    counts = np.asarray(counts)
    if np.any(counts < 0) or not counts.sum() > 0:
        raise InputError("a profile needs light: weights of 0 or more, not all 0.")
    random = np.random.default_rng(1)
    drawn = random.multinomial(counts.sum(), counts / counts.sum(), size=RESAMPLINGS)
    return float(np.std(burley_width(edges, drawn), ddof=1))


def _golden_minimum(function, low: np.ndarray, high: np.ndarray, widest: float) -> np.ndarray:
    """Where functions of one minimum each in [low, high] have it, to 1e-4 (golden section).

    `widest` is the most that high - low can be.
    """
    ratio = 0.5 * (np.sqrt(5.0) - 1.0)
    for _ in range(int(np.ceil(np.log(1e-4 / widest) / np.log(ratio)))):
        left, right = high - ratio * (high - low), low + ratio * (high - low)
        falls = function(left) >= function(right)
        low, high = np.where(falls, left, low), np.where(falls, high, right)
    return 0.5 * (low + high)
