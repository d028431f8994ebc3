"""What a place does to the sun's ultraviolet besides the air: the ground, and clouds."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from hylios.errors import InputError, as_numbers

COVERS = (0.0, 0.375, 0.75, 1.0)
CLOUD_FACTORS = (1.0, 0.89, 0.73, 0.31)
"""Clear, scattered, broken and overcast, as the US Environmental Protection Agency computes the UV
index (Calculating the UV Index), at the middle of each class of sky cover."""


@dataclass(frozen=True)
class Ground:
    """Share of the ultraviolet that a ground reflects.

    Attributes
    ----------
    albedo : float
        What is taken.
    low, high : float
        Range of what was measured.
    """

    albedo: float
    low: float
    high: float


GROUNDS = {
    "grass": Ground(0.03, 0.02, 0.10),
    "water": Ground(0.15, 0.15, 0.17),
    "sand": Ground(0.18, 0.12, 0.25),
    "foam": Ground(0.25, 0.25, 0.30),
    "snow": Ground(0.80, 0.60, 0.90),
}
"""Grass, open water, dry sand, sea foam and snow. Ranges are of reviews and of pages of UV services
(WHO, Global Solar UV Index, 2002: snow up to .8, sand .15, foam .25; uwagaslonce.pl: sand .12,
water .15 to .17, plants .03 to .10). How old the snow is and where the sun stands makes the range.
"""


def ground_albedo(name: str) -> float:
    """Albedo of a ground of `GROUNDS`.

    Raises
    ------
    InputError
        If there is no such ground.
    """
    if not isinstance(name, str) or name not in GROUNDS:
        raise InputError(f"the ground is {str(name)[:60]!r}; allowed are {', '.join(GROUNDS)}.")
    return GROUNDS[name].albedo


def cloud_factor(cover: ArrayLike) -> NDArray[np.float64]:
    """Share of the clear sky's ultraviolet under clouds, linear between `COVERS`.

    An average of all clouds. Thin ones let far more through than thick ones, broken ones beside a
    bare sun can give more than a clear sky (Calbo et al., Rev. Geophys. 43, RG2002, 2005), and by
    eye alone a factor is off by half and more (Schwander et al., J. Geophys. Res. 107, 2002).

    Parameters
    ----------
    cover : (...) array
        Share of the sky that is covered, 0 to 1.

    Raises
    ------
    InputError
        If one is out of range.

    Examples
    --------
    >>> from hylios.sun.surroundings import cloud_factor
    >>> cloud_factor([0, 0.5, 1]).round(2).tolist()
    [1.0, 0.84, 0.31]
    """
    cover = as_numbers("cloud covers", cover)
    outside = cover[~((cover >= 0.0) & (cover <= 1.0))]
    if outside.size:
        raise InputError(f"cloud cover is {outside.flat[0]:g}; allowed is 0 to 1.")
    return np.interp(cover, COVERS, CLOUD_FACTORS)
