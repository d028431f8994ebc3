"""Coefficients of a time basis over the shares of a few masks, as an image that a shader reads.

A shader that reads the shares themselves has them right everywhere: inside faces, and at every
texel of a mask that is an image. The coefficients are given at even steps of every share, and run
straight between them.

What a shader computes from shares s_1 to s_M, with L = `steps` and B = a third of the rank:

1. the slice z_m = floor(s_m (L - 1)), L - 2 at most, of every share from the third on, and what is
   left of it, f_m.
2. y = sum of z_m L^(m - 3) / L^(M - 2) + (.5 + s_2 (L - 1)) / L^(M - 1).
3. for b = 0 to B - 1: coefficients 3 b + 1 to 3 b + 3 are red, green and blue of the image sampled
   linearly at x = (b + (.5 + s_1 (L - 1)) / L) / B and y, and of the next slices too, which are
   mixed by the f_m.

`coefficients_at` is the same in numpy.
"""

import itertools
from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from .basis import DRAG, FULL, BasisPrecision

CHANNELS = 3
"""Coefficients of a texel."""

RANKS = (12, 15)


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


def image_of(coefficients: NDArray, masks: int, steps: int) -> NDArray[np.float32]:
    """The image (rows, columns, 3) of coefficients (steps^masks, rank)."""
    blocks = coefficients.shape[1] // CHANNELS
    texels = np.asarray(coefficients, np.float32).reshape(-1, steps, blocks, CHANNELS)
    return np.swapaxes(texels, 1, 2).reshape(steps ** (masks - 1), -1, CHANNELS)


def coefficients_at(image: NDArray, shares: NDArray) -> NDArray[np.float64]:
    """Coefficients (N, rank) that a shader has at shares (N, masks)."""
    masks = shares.shape[1]
    steps = round(len(image) ** (1.0 / (masks - 1)))
    blocks = image.shape[1] // steps
    table = image.reshape(*[steps] * (masks - 1), blocks, steps, CHANNELS)
    table = np.moveaxis(table, -2, masks - 1).reshape(*[steps] * masks, -1)
    place = shares[:, ::-1] * (steps - 1.0)
    low = np.clip(place.astype(int), 0, steps - 2)
    part = place - low
    total = np.zeros((len(shares), table.shape[-1]))
    for corner in itertools.product((0, 1), repeat=masks):
        weight = np.where(corner, part, 1.0 - part).prod(axis=1)
        total += weight[:, None] * table[tuple((low + corner).T)]
    return total
