"""Coefficients of a time basis over the shares of masks, as images that a shader reads.

A shader that reads the shares themselves has them right everywhere: inside faces, and at every
texel of a mask that is an image. Coefficients are given at knots of the share of every mask, dense
where the tan bends. Between knots a point lies in a simplex of as many corners as there are masks,
and one more: from the lowest knots to the highest ones, by one mask after another, that whose share
has gone farthest to its next knot first (Kuhn's division of a cube). So eight masks take nine
texels, not 256.

An image holds three coefficients, of knots in `COLUMNS` columns: those of the last mask change
fastest. Parts of the days (`basis`) lie above one another, R rows of texels to a part. What a
shader computes from shares s_1 to s_M, all without interpolation of texels; W is the number of rows
of `places`:

1. for every mask m: N_m, f_m and d_m are the red, green and blue of `places` at
   x = (.5 + STEPS s_m) / (STEPS + 1) and y = (.5 + m - 1) / W: the knot times the mask's stride,
   the part of the way to the next one, and minus the stride, which is the number of knots of all
   later masks together.
2. n_0 = sum of N_m.
3. F_1 to F_M: f in descending order. n_k = n_0 - the sum of d_m where f_m >= F_k.
4. the sum over k = 0 to M of (F_k - F_(k + 1)) times the texel of n_k, where F_0 = 1 and
   F_(M + 1) = 0: in row p R + floor(n_k / COLUMNS) from the bottom for part p, and column n_k
   modulo COLUMNS.
5. the share of all doses: the sum of w_m s_m, where w_1 to w_3 are the channels of row M, w_4 to
   w_6 those of row M + 1, and so on.

So other knots, doses or days are other pixels; no node knows of them. `coefficients_at` is the same
in numpy.
"""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from .thinning import by_error

CHANNELS = 3
"""Coefficients of a texel."""

COLUMNS = 256

STEPS = 1024
"""Even steps of a share that are told apart; 0 and 1 are exact."""

ENDS = 16
"""How often a share of 0 or 1 counts where one between counts once."""

LARGEST, HALVINGS = 4.0, 16
"""An error of u above which no knots are needed; how often what is allowed below it is halved."""


def knots_within(
    across: NDArray[np.float64], lines: Sequence[NDArray], points: int, tolerance: float
) -> tuple[NDArray[np.float64], ...]:
    """Knots of the shares of masks between which all runs straight alike, as closely as there is
    room.

    Parameters
    ----------
    across : (S,) array
        Steps of a share from 0 to 1.
    lines : sequence of (S, K) arrays
        Numbers over the steps, by mask.
    points : int
        Most points that all knots together may lead to.
    tolerance : float
        An error that needs no more knots.
    """

    def within(allowed: float) -> list[NDArray[np.int_]]:
        return [by_error(across, own, len(across), allowed) for own in lines]

    def count(knots: list[NDArray[np.int_]]) -> int:
        return int(np.prod([len(own) for own in knots]))

    best = within(tolerance)
    if count(best) > points:
        low, high = np.log((tolerance, LARGEST))
        best = within(LARGEST)
        for _ in range(HALVINGS):
            middle = 0.5 * (low + high)
            knots = within(float(np.exp(middle)))
            if count(knots) > points:
                low = middle
            else:
                high, best = middle, knots
    return tuple(across[own] for own in best)


def shares_of_grid(knots: Sequence[NDArray[np.float64]]) -> NDArray[np.float64]:
    """Shares (N, masks) at all knots; those of the last mask change fastest."""
    axes = np.meshgrid(*knots, indexing="ij")
    return np.stack(axes, axis=-1).reshape(-1, len(knots))


def counts_of_grid(shares: NDArray[np.float64]) -> NDArray[np.float64]:
    """How often shares (N, M) of a grid count, (N,): most of a body is bare or covered."""
    return float(ENDS) ** np.count_nonzero((shares == 0.0) | (shares == 1.0), axis=1)


def strides_of(knots: Sequence[NDArray[np.float64]]) -> tuple[int, ...]:
    """How far apart points of neighbouring knots are, by mask."""
    counts = [len(own) for own in knots]
    return tuple(int(np.prod(counts[mask + 1 :])) for mask in range(len(counts)))


def places_among(
    knots: Sequence[NDArray[np.float64]], weights: NDArray[np.float64]
) -> NDArray[np.float32]:
    """The image (rows, STEPS + 1, 3) of the places of shares among the masks' knots.

    Parameters
    ----------
    weights : (masks,) array
        Of the masks' shares in the share of all doses: in the last rows.
    """
    steps, apart = np.linspace(0.0, 1.0, STEPS + 1), strides_of(knots)
    image = np.zeros((len(knots) + rows_of_weights(len(knots)), STEPS + 1, 3), np.float32)
    for row, own, stride in zip(image, knots, apart, strict=False):
        place = np.interp(steps, own, np.arange(len(own)))
        knot = np.minimum(np.floor(place), len(own) - 2)
        row[:, 0], row[:, 1], row[:, 2] = knot * stride, place - knot, -stride
    told = np.zeros((len(image) - len(knots), 3))
    told.flat[: len(knots)] = weights
    image[len(knots) :] = told[:, None]
    return image


def rows_of_weights(masks: int) -> int:
    """Rows of `places_among` with the weights of so many masks."""
    return -(-masks // CHANNELS)


def images_of(coefficients: NDArray, points: int = 0) -> list[NDArray[np.float32]]:
    """Images (rows, COLUMNS, 3) of coefficients (parts, N, rank), the rank a multiple of 3.

    Parameters
    ----------
    points : int
        Texels of a part, if more than the coefficients need.
    """
    parts, count, rank = coefficients.shape
    wanted = max(points, count)
    wanted += -wanted % COLUMNS
    padded = np.zeros((parts, wanted, rank), np.float32)
    padded[:, :count] = coefficients
    table = padded.reshape(-1, COLUMNS, rank)
    return [table[..., b : b + CHANNELS] for b in range(0, rank, CHANNELS)]


def coefficients_at(
    images: Sequence[NDArray],
    places: NDArray,
    shares: NDArray,
    part: NDArray[np.int_],
    parts: int,
) -> NDArray[np.float64]:
    """Coefficients (N, rank) that a shader has at shares (N, masks), in a part (N,) of so many."""
    column = np.floor(shares * STEPS + 0.5).astype(int)
    told = places[np.arange(shares.shape[1]), column].astype(float)
    table = np.concatenate(images, axis=-1).reshape(-1, len(images) * CHANNELS)
    start = part * (len(table) // parts)
    first, along, apart = start + told[..., 0].sum(axis=1), told[..., 1], told[..., 2]
    ordered = np.pad(-np.sort(-along, axis=1), ((0, 0), (1, 1)), constant_values=(1.0, 0.0))
    weights = -np.diff(ordered, axis=1)
    total = np.zeros((len(shares), table.shape[1]))
    for k in range(weights.shape[1]):
        passed = along >= ordered[:, k : k + 1]
        point = first - (passed * apart).sum(axis=1) if k else first
        total += weights[:, k : k + 1] * table[point.astype(int)]
    return total
