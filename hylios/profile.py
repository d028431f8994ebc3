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


def burley_width(edges: np.ndarray, weights: np.ndarray) -> float:
    """Width d of the Burley profile nearest to light counted by distance.

    The fit minimises the area between the two cumulative distributions over the logarithm of the
    distance, squared: every scale of a scene counts alike.

    Parameters
    ----------
    edges : (N,) ascending array
        Where each bin of distances starts, the first at 0; the last bin is open. d has its unit.
    weights : (N,) array
        Light in each bin, not negative.

    Returns
    -------
    float
        The width, to 1e-4 of itself.

    Raises
    ------
    InputError
        If a weight is negative or all are 0.
    """
    weights = np.asarray(weights, dtype=float)
    if np.any(weights < 0) or not weights.sum() > 0:
        raise InputError("a profile needs light: weights of 0 or more, not all 0.")
    ends = np.asarray(edges[1:], dtype=float)
    measured = np.cumsum(weights)[:-1] / weights.sum()
    spacing = np.gradient(np.log(ends))

    def misfit(logarithm: float) -> float:
        difference = burley_share_within(ends, np.exp(logarithm)) - measured
        return float(np.sum(spacing * difference**2))

    grid = np.linspace(np.log(ends[0] / 3.0), np.log(ends[-1]), 200)
    best = int(np.argmin([misfit(each) for each in grid]))
    low, high = grid[max(best - 1, 0)], grid[min(best + 1, grid.size - 1)]
    return float(np.exp(_golden_minimum(misfit, low, high)))


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
    return float(np.std([burley_width(edges, each) for each in drawn], ddof=1))


def _golden_minimum(function, low: float, high: float) -> float:
    """Where a function of one minimum in [low, high] has it, to 1e-4 (golden section)."""
    ratio = 0.5 * (np.sqrt(5.0) - 1.0)
    while high - low > 1e-4:
        left, right = high - ratio * (high - low), low + ratio * (high - low)
        if function(left) < function(right):
            high = right
        else:
            low = left
    return 0.5 * (low + high)
