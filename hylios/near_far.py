"""Light that leaves skin near where it came in, and the rest: a spike and one Burley profile.

In skin's epidermis light turns back within a few hundredths of a millimetre, and what passes it
comes back from the dermis and the hypodermis millimetres away. One width cannot be both. Here a
near share N leaves where it comes in, and the rest by Burley's profile (`hylios.burley`) of width
d. Both are fitted to what is seen of a profile: the edge spread, the light at distance x beyond the
edge of a lit half plane,

    D(x) = integral over r > x of light(r) arccos(x / r) / pi,

where all light is 1, so D(0) = 1/2. For Burley's profile D has a closed form,
(Ki(t) + 3 Ki(t / 3)) / (4 pi) with t = x / d and Ki the first integral of the Bessel function K0
(W. G. Bickley and J. Nayler, "A short table of the functions Ki_n(x)", 1935).
"""

import numpy as np
from numpy.polynomial.legendre import leggauss

from hylios.errors import InputError

NEAREST, FARTHEST = 0.1, 20.0
"""Distances in mm from the edge between which the fit is made, on a logarithmic scale."""

DISTANCES = 54
"""Distances of the fit."""

LEAST_WIDTH, LARGEST_WIDTH = 0.05, 10.0
"""Widths in mm to choose from; of less, hardly any light leaves beyond `NEAREST`."""

WIDTHS = 160
"""Widths tried; between them the minimum is that of a parabola, to 1e-3 of itself."""

UNKNOWN_WIDTH = 1.0
"""Width in mm where no light comes out, of which any would do."""


def burley_edge_spread(ratio: np.ndarray) -> np.ndarray:
    """Edge spread (...) of Burley's profile at x / d (...), 0 or more; 1/2 at 0."""
    ratio = np.asarray(ratio, dtype=float)
    return (_bickley(ratio) + 3.0 * _bickley(ratio / 3.0)) / (4.0 * np.pi)


def model_edge_spread(
    distances: np.ndarray, near_share: np.ndarray, far_width: np.ndarray
) -> np.ndarray:
    """Edge spread (..., X) of a near share (...) and the rest with a width (...) in mm.

    Parameters
    ----------
    distances : (X,) array
        mm from the edge, above 0: the near share does not reach them.
    """
    share, width = np.asarray(near_share, dtype=float), np.asarray(far_width, dtype=float)
    return (1.0 - share)[..., None] * burley_edge_spread(distances / width[..., None])


def edge_spread(edges: np.ndarray, light: np.ndarray, distances: np.ndarray) -> np.ndarray:
    """Edge spread (..., X) of light counted by distance from where it came in.

    Parameters
    ----------
    edges : (B,) ascending array
        Where each bin of distances starts in mm, the first at 0; within a bin light is taken as
        even over the distance, in the last, which is open, as at its start.
    light : (..., B) array
        Light in each bin.
    distances : (X,) array
        mm from the edge, above 0.

    Returns
    -------
    (..., X) array
        Of the share of all light; 0 where none comes out.

    Raises
    ------
    InputError
        If the edges do not ascend from 0, or the bins are others than those of the light.
    """
    edges, light = _checked(edges, light)
    whole = light.sum(axis=-1, keepdims=True)
    spread = light @ _beyond(edges, np.asarray(distances, dtype=float)).T
    return np.divide(spread, whole, out=np.zeros_like(spread), where=whole > 0.0)


def near_share_and_far_width(edges: np.ndarray, light: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Near share and width d of the rest, nearest to a profile's edge spread.

    The fit is by least squares over the logarithm of the distance, from `NEAREST` to `FARTHEST`.

    Parameters
    ----------
    edges, light
        As in `edge_spread`. Bins may hold less than nothing, as those of a colour's channel can.

    Returns
    -------
    near_share : (...) array
        0 to 1; 1 where no light comes out.
    far_width : (...) array
        mm, `LEAST_WIDTH` to `LARGEST_WIDTH`; `UNKNOWN_WIDTH` where no light comes out, or none
        beyond `NEAREST`.

    Raises
    ------
    InputError
        As in `edge_spread`.
    """
    distances = _fitted_distances()
    spread = edge_spread(edges, light, distances)
    grid = np.linspace(np.log(LEAST_WIDTH), np.log(LARGEST_WIDTH), WIDTHS)
    shapes = burley_edge_spread(distances / np.exp(grid)[:, None])
    squares, products = np.sum(shapes**2, axis=-1), spread @ shapes.T
    free = np.maximum(products, 0.0)
    width = np.exp(_least(grid, -free * free / squares))
    far = _far_share(distances, spread, width)
    # more than all of the light: the width is the best for all of it then
    whole = np.exp(_least(grid, squares - 2.0 * products))
    width, far = np.where(far > 1.0, whole, width), np.clip(far, 0.0, 1.0)
    return 1.0 - far, np.where(far > 0.0, width, UNKNOWN_WIDTH)


def _far_share(distances: np.ndarray, spread: np.ndarray, width: np.ndarray) -> np.ndarray:
    """Share of the light that Burley's profile has, by least squares for given widths."""
    shape = burley_edge_spread(distances / width[..., None])
    return np.sum(shape * spread, axis=-1) / np.sum(shape**2, axis=-1)


def near_far_errors(
    edges: np.ndarray, light: np.ndarray, squares: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Standard errors of `near_share_and_far_width` from the noise of the bins, to first order.

    Parameters
    ----------
    edges, light
        As in `edge_spread`.
    squares : (..., B) array
        Variance of the light in each bin; bins are taken as independent.

    Returns
    -------
    near_share : (...) array
        1 at most, and where no light comes out.
    far_width : (...) array
        mm; infinite where no light comes out, or none beyond `NEAREST`.

    Raises
    ------
    InputError
        As in `edge_spread`.
    """
    edges, light = _checked(edges, light)
    share, width = near_share_and_far_width(edges, light)
    distances = _fitted_distances()
    shape = burley_edge_spread(distances / width[..., None])
    step = 1e-4
    slope = (burley_edge_spread(distances / (width * (1.0 + step))[..., None]) - shape) / step
    # of the model by the share of the rest and by the logarithm of the width
    gradient = np.stack([shape, (1.0 - share)[..., None] * slope], axis=-1)
    normal = gradient.swapaxes(-1, -2) @ gradient
    whole = light.sum(axis=-1)
    lit = (whole > 0.0) & (share < 1.0)
    normal[~lit] = np.eye(2)
    pull = np.linalg.solve(normal, gradient.swapaxes(-1, -2))
    spread = edge_spread(edges, light, distances)
    # a bin's light moves the spread by what of it lies beyond, less the spread, for all is 1
    moved = (
        pull @ _beyond(edges, distances) - np.sum(pull * spread[..., None, :], axis=-1)[..., None]
    )
    variance = np.sum(moved**2 * np.asarray(squares, dtype=float)[..., None, :], axis=-1)
    error = np.sqrt(variance) / np.where(lit, whole, 1.0)[..., None]
    return (
        np.where(lit, np.minimum(error[..., 0], 1.0), 1.0),
        np.where(lit, width * error[..., 1], np.inf),
    )


def _checked(edges: np.ndarray, light: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    edges, light = np.asarray(edges, dtype=float), np.asarray(light, dtype=float)
    if edges.ndim != 1 or edges.size < 2 or edges[0] != 0.0 or not np.all(np.diff(edges) > 0.0):
        raise InputError("edges of a profile's bins must be ascending distances, the first 0.")
    if light.shape[-1:] != edges.shape:
        raise InputError(
            f"a profile's light has shape {light.shape}; expected (..., {edges.size}), by its bins."
        )
    return edges, light


def _fitted_distances() -> np.ndarray:
    return np.geomspace(NEAREST, FARTHEST, DISTANCES)


def _beyond(edges: np.ndarray, distances: np.ndarray) -> np.ndarray:
    """Share of the light in each bin that leaves farther from the edge than a distance, (X, B)."""
    place, weight = leggauss(8)
    half = 0.5 * (1.0 + place)
    low, high = edges[:-1], edges[1:]
    start = np.clip(distances[:, None], low, high)
    # a root where the distance is reached, which a square makes smooth
    radius = start[..., None] + (high - start)[..., None] * half**2
    angle = np.arccos(np.minimum(distances[:, None, None] / radius, 1.0))
    share = np.sum(angle * weight * half, axis=-1) * (high - start) / (high - low)
    last = np.arccos(np.minimum(distances / edges[-1], 1.0))
    return np.concatenate([share, last[:, None]], axis=1) / np.pi


def _bickley(ratio: np.ndarray) -> np.ndarray:
    """Ki(t), the integral of exp(-t cosh u) / cosh u over u > 0, to 1e-10 (trapezium rule)."""
    step = 0.3
    growth = np.cosh(step * np.arange(81))
    weight = step / growth
    weight[0] *= 0.5
    return np.exp(-ratio[..., None] * growth) @ weight


def _least(grid: np.ndarray, values: np.ndarray) -> np.ndarray:
    """Where functions (..., G) on an even grid (G,) have their minimum, by a parabola."""
    best = np.argmin(values, axis=-1)
    inner = np.clip(best, 1, grid.size - 2)
    before, here, after = (
        np.take_along_axis(values, (inner + shift)[..., None], axis=-1)[..., 0]
        for shift in (-1, 0, 1)
    )
    curved = before - 2.0 * here + after
    shift = np.divide(0.5 * (before - after), curved, out=np.zeros_like(curved), where=curved > 0.0)
    between = grid[inner] + np.clip(shift, -1.0, 1.0) * (grid[1] - grid[0])
    return np.where(best == inner, between, grid[best])
