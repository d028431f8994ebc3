"""How much the images of a time basis hold, so that other numbers go into the same ones.

Images of a power of two of rows have room for other knots, and shapes that are not needed are 0.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .basis import ROWS, Basis
from .grid import CHANNELS, COLUMNS, images_of, places_among

GRID = "grid_{}"
"""Names of the images over shares."""


@dataclass(frozen=True)
class Room:
    """How much the images of a basis hold, whatever they show now.

    Attributes
    ----------
    points : int
        Combinations of the masks' knots: texels of one part of the days in an image over shares.
    parts : int
        Parts of the days (`basis`).
    rank : int
        Shapes over time, and so coefficients of a point.
    """

    points: int
    parts: int
    rank: int

    def holds(self, basis: Basis) -> bool:
        """Whether a basis can be shown in these images."""
        parts, points, rank = basis.coefficients.shape
        return parts == self.parts and points <= self.points and rank <= self.rank


def room_for(basis: Basis) -> Room:
    """Room for a basis, and for some more points."""
    parts, points, rank = basis.coefficients.shape
    rows = -(-points // COLUMNS)
    return Room(COLUMNS * (1 << (rows - 1).bit_length()), parts, rank)


def room_in(rows: Sequence[int], grid: Sequence[int]) -> Room:
    """The room in images that are there.

    Parameters
    ----------
    rows, grid : pair of int
        Width and height of the image of the rows, and of one over shares.
    """
    parts = rows[1] // (ROWS + 1)
    return Room(grid[0] * grid[1] // max(parts, 1), parts, rows[0] - 1)


def images_in(basis: Basis, room: Room) -> dict[str, NDArray[np.float32]]:
    """The images (rows, columns, 3) of a basis, by name; those of shapes that are 0 come last.

    Parameters
    ----------
    room : Room
        That holds the basis.
    """
    over_shares = images_of(basis.coefficients, room.points)
    over_shares += [np.zeros_like(over_shares[0])] * blocks_of(room.rank - basis.rank)
    return {
        "rows": np.pad(basis.rows, ((0, 0), (0, room.rank - basis.rank), (0, 0))),
        "days": basis.places,
        "places": places_among(basis.knots, basis.weights),
        **{GRID.format(block): own for block, own in enumerate(over_shares)},
    }


def blocks_of(rank: int) -> int:
    """How many images over shares a rank takes."""
    return rank // CHANNELS
