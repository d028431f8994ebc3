"""Which of the shipped skins comes nearest to a painted colour."""

import functools
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike, NDArray

from hylios.colour_difference import ciede2000, lab
from hylios.errors import InputError
from hylios.table import melanin_dynamics

from . import catalogue
from .look_grid import COLOUR


def type_colours() -> dict[str, NDArray[np.float64]]:
    """Colours (3,) of the shipped skin types without sun, by name, from very light to dark."""
    types = [table for table in catalogue.SHIPPED if table.name in catalogue.TYPES]
    colours = {table.name: _untanned(table.path, *catalogue.stamp(table.path)) for table in types}
    return {name: np.array(own) for name, own in colours.items() if own}


def nearest_type(colour: ArrayLike) -> tuple[str, float] | None:
    """The shipped skin type that comes nearest to a linear colour (3,), and its CIEDE2000 to it.

    None where no type is shipped.
    """
    wanted = lab(np.asarray(colour, dtype=float))
    away = {name: float(ciede2000(lab(own), wanted)) for name, own in type_colours().items()}
    nearest = min(away, key=away.__getitem__, default=None)
    return None if nearest is None else (nearest, away[nearest])


@functools.lru_cache(maxsize=16)
def _untanned(path: Path, modified: int, size: int) -> tuple[float, ...] | None:
    try:
        table = catalogue.table(path)
        steady = melanin_dynamics(table.provenance).steady_state()
    except InputError:
        return None
    return tuple(table.plane(COLOUR, np.append(steady / steady.sum(), 1.0)).tolist())
