"""Coefficients of a time basis by the texels of an image: a palette, and what of it each has.

A texel that has number n of the palette holds n modulo 256 as red and the rest, over 256, as green,
so that these are its place in images of the palette with 256 columns. The last value of the palette
is the share of all doses.
"""

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from hylios.errors import InputError

from .basis import DRAG, FULL, Basis
from .grid import by_texels

COLUMNS, MOST = 256, 65_536

RANKS = (5, 8, 11, 14)
"""With the share they are whole texels."""

FULL_PALETTE = replace(FULL, ranks=RANKS)
"""For what stays in a file."""

DRAG_PALETTE = replace(DRAG, ranks=(11,))
"""For a picture while somebody changes a setting."""


def palette_images(
    basis: Basis, shares: NDArray, counts: NDArray[np.int_]
) -> list[NDArray[np.float32]]:
    """The palette, images (rows, COLUMNS, 3), of a basis at points with shares (N, M).

    Parameters
    ----------
    counts : (N,) int array
        How often the points are there.

    Raises
    ------
    InputError
        If it has more than `MOST` colours.
    """
    size = len(basis.differing)
    if size > MOST:
        raise InputError(f"The masks lead to {size} different tans; allowed are {MOST}.")
    whole = np.bincount(basis.point, weights=counts * (shares @ basis.weights))
    share = whole / np.bincount(basis.point, weights=counts)
    values = np.concatenate([basis.differing, share[:, None]], axis=1, dtype=np.float32)
    rows = -(-size // COLUMNS)
    padded = np.pad(values, ((0, rows * COLUMNS - size), (0, 0)), mode="edge")
    table = padded.reshape(rows, COLUMNS, -1)
    return by_texels(table)


def places_in_palette(number: NDArray[np.int_]) -> NDArray[np.uint8]:
    """Colours (..., 3) of texels with numbers (...) of a palette."""
    return np.stack([number % COLUMNS, number // COLUMNS, 0 * number], axis=-1).astype(np.uint8)
