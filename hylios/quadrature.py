"""Colour of skin from a few wavelengths: which ones, and with what weights.

numpy only. Skin's reflectance is no polynomial (haemoglobin has bands 30 nm wide), so Gauss's
nodes for daylight and the colour matching functions are a poor choice: with the weights that
make them exact for polynomials, 8 miss the colour of skin by 1.2 CIEDE2000, 16 still by .7. Chosen
here are wavelengths and weights that give the right colour for spectra like those of skin: 8 miss
it by .02, 20 by .001.
"""

from dataclasses import dataclass
from functools import cache

import numpy as np

from hylios.errors import require_whole
from hylios.packaged import numbers_of

FEWEST, MOST = 4, 20
"""Numbers of wavelengths that are to be had."""

COLUMNS = ("count", "wavelength_nm", "red", "green", "blue")
TABLE = "quadrature.csv"


@dataclass(frozen=True)
class Quadrature:
    """Wavelengths and weights that turn reflectance into a colour.

    Attributes
    ----------
    wavelengths : (n,) ascending array, nm
    weights : (3, n) array
        Linear Rec.709 under D65 is `weights @ reflectance`. Each row's sum is 1: what reflects
        all wavelengths alike is that grey.
    """

    wavelengths: np.ndarray
    weights: np.ndarray


def skin_quadrature(count: int) -> Quadrature:
    """The shipped quadrature of 4 to 20 wavelengths between 400 and 700 nm.

    Chosen by `hylios.lab.quadrature_choice` (`python -m examples.simplifications.quadrature`) for
    skins of all colours: up to 16 such that they add little to the noise of a random walk, more for
    the solver, which has none. What they cost stands in docs/simplifications.md. They are not meant
    for other things than skin: a colour that melanin and blood do not make may come out wrong.
    (Skin without melanin or blood, or with far too much of either, is within .3 at 8 wavelengths;
    blood that is sulfhemoglobin to 6 %, .7.)

    Raises
    ------
    InputError
        If there is none of that many wavelengths.
    """
    return _shipped()[require_whole("number of wavelengths", count, FEWEST, MOST)]


@cache
def _shipped() -> dict[int, Quadrature]:
    _, table = numbers_of("hylios", TABLE)
    made = {}
    for count in range(FEWEST, MOST + 1):
        rows = table[table[:, 0] == count]
        weights = rows[:, 2:].T
        made[count] = Quadrature(rows[:, 1], weights / weights.sum(axis=1, keepdims=True))
    return made
