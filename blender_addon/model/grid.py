"""Coefficients of a time basis over the shares of a few masks, as images that a shader reads.

A shader that reads the shares themselves has them right everywhere: inside faces, and at every
texel of a mask that is an image. The coefficients are given at even steps of every share, and run
straight between them.

An image holds three coefficients. What a shader computes from shares s_1 to s_3 of which each has L
steps, for b = 0 to a third of the rank:

1. of two masks: coefficients 3 b + 1 to 3 b + 3 are red, green and blue of image b, sampled
   linearly at x = (.5 + s_1 (L - 1)) / L and y = (.5 + s_2 (L - 1)) / L.
2. of three masks: the slice z = floor(s_3 (L - 1)), L - 2 at most, and what is left of it, f.
   Slices lie above one another, each second one upside down. So the image is sampled at
   y = (z + (.5 + t (L - 1)) / L) / L, where t is s_2, or 1 - s_2 if z is odd; then in slice z + 1;
   and the two are mixed by f.

Where shares change fast from pixel to pixel EEVEE takes the mean of neighbouring texels. So they
are those of neighbouring shares everywhere in an image.

`coefficients_at` is the same in numpy.
"""

import itertools
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from .basis import DRAG, FULL, BasisPrecision

CHANNELS = 3
"""Coefficients of a texel."""

ENDS = 16
"""How often a share of 0 or 1 counts where one between counts once."""

SLICED = 2
"""With more masks an image has slices."""

RANKS = (6, 9, 12, 15)


@dataclass(frozen=True, eq=False)
class GridPrecision:
    """How closely coefficients over shares are computed.

    Attributes
    ----------
    steps : mapping
        Steps of a share, by the number of masks.
    basis : BasisPrecision
    """

    steps: Mapping[int, int]
    basis: BasisPrecision


EVERY_STEP = 1_000_000
"""No points of a grid are taken together."""

FULL_GRID = GridPrecision({2: 128, 3: 33}, replace(FULL, most=EVERY_STEP, ranks=RANKS))
"""For what stays in a file."""

DRAG_GRID = GridPrecision({2: 64, 3: 21}, replace(DRAG, levels=FULL.levels, most=EVERY_STEP))
"""For a picture while somebody changes a setting."""

MOST_MASKS_READ = max(FULL_GRID.steps)
"""With more masks there would be too many steps."""


def shares_of_grid(masks: int, steps: int) -> NDArray[np.float64]:
    """Shares (steps^masks, masks) at all steps; the first mask's change fastest."""
    axes = np.meshgrid(*[np.linspace(0.0, 1.0, steps)] * masks, indexing="ij")
    return np.stack(axes[::-1], axis=-1).reshape(-1, masks)


def counts_of_grid(shares: NDArray[np.float64]) -> NDArray[np.int_]:
    """How often shares (N, M) of a grid count, (N,): most of a body is bare or covered."""
    return ENDS ** np.count_nonzero((shares == 0.0) | (shares == 1.0), axis=1)


def images_of(coefficients: NDArray, masks: int, steps: int) -> list[NDArray[np.float32]]:
    """Images (rows, steps, 3) of coefficients (steps^masks, rank), the rank a multiple of 3."""
    table = np.array(coefficients, np.float32).reshape(-1, steps, steps, coefficients.shape[1])
    if masks > SLICED:
        table[1::2] = table[1::2, ::-1]
    rows = table.reshape(-1, *table.shape[2:])
    return by_texels(rows)


def by_texels(values: NDArray[np.float32]) -> list[NDArray[np.float32]]:
    """Images (rows, columns, 3) of values (rows, columns, K), K a multiple of 3."""
    return [values[..., b : b + CHANNELS] for b in range(0, values.shape[-1], CHANNELS)]


def coefficients_at(images: Sequence[NDArray], shares: NDArray) -> NDArray[np.float64]:
    """Coefficients (N, rank) that a shader has at shares (N, masks)."""
    masks, steps = shares.shape[1], images[0].shape[1]
    table = np.concatenate(images, axis=-1).reshape(-1, steps, steps, len(images) * CHANNELS)
    if masks > SLICED:
        table[1::2] = table[1::2, ::-1]
    table = table.reshape(*[steps] * masks, -1)
    place = shares[:, ::-1] * (steps - 1.0)
    low = np.clip(place.astype(int), 0, steps - 2)
    part = place - low
    total = np.zeros((len(shares), table.shape[-1]))
    for corner in itertools.product((0, 1), repeat=masks):
        weight = np.where(corner, part, 1.0 - part).prod(axis=1)
        total += weight[:, None] * table[tuple((low + corner).T)]
    return total
