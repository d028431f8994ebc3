"""Which skin type, and which biology of it, comes nearest to a colour."""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from hylios.adding import spectra
from hylios.colour_difference import ciede2000, lab
from hylios.errors import InputError
from hylios.quadrature import skin_quadrature
from hylios.skin import Skin
from hylios.skin.biology import RANGES, Biology
from hylios.table import skin_of

from . import catalogue
from .fitting import nearest_type

STEPS = 8
"""Steps of Gauss and Newton's method towards a colour."""

CHANGE = 0.05
"""Change of a factor's logarithm by which slopes are measured, and the least that is worth it."""


@dataclass(frozen=True)
class Match:
    """The skin nearest to a colour.

    Attributes
    ----------
    skin : str
        A type, I to VI.
    distance : float
        CIEDE2000 between the colour and the type's without sun.
    biology : Biology
        Melanin and blood of the type that come nearer still.
    left : float
        CIEDE2000 that is left with these.
    """

    skin: str
    distance: float
    biology: Biology
    left: float


def nearest(colour: NDArray[np.float64]) -> Match:
    """The skin nearest to a linear Rec.709 colour (3,), as painted: without the surface's gloss.

    Raises
    ------
    InputError
        If the colour has a channel that is not from 0 to 1, or no skin type is shipped.
    """
    colour = np.asarray(colour, dtype=float)
    if not np.all((colour >= 0.0) & (colour <= 1.0)):
        raise InputError(f"the colour is {colour.round(3).tolist()}; allowed is 0 to 1 in each.")
    fitting = nearest_type(colour)
    if fitting is None:
        raise InputError("this add-on comes with no skin type; install it anew.")
    skin, distance = fitting
    biology, left = _towards(colour, skin_of(catalogue.provenance(catalogue.shipped_path(skin))))
    if left >= distance:
        biology, left = Biology(), distance
    return Match(skin, distance, biology, left)


def _towards(colour: NDArray[np.float64], skin: Skin) -> tuple[Biology, float]:
    """Melanin and blood with which a skin comes near a colour, and how near."""
    wanted, place = lab(colour), np.zeros(2)
    low, high = np.log([RANGES["melanin"], RANGES["blood"]]).T
    for _ in range(STEPS):
        tried = place + CHANGE * np.array([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]])
        told = lab(_colours(skin, np.clip(tried, low, high)))
        slopes = (told[1:] - told[0]).T / CHANGE
        step = np.linalg.lstsq(slopes, wanted - told[0], rcond=None)[0]
        place = np.clip(place + np.clip(step, -1.0, 1.0), low, high)
    biology = _biology(place)
    last = _colours(skin, np.log([[biology.melanin, biology.blood]]))[0]
    return biology, float(ciede2000(lab(last), wanted))


def _biology(place: np.ndarray) -> Biology:
    melanin, blood = (float(f"{factor:.3g}") for factor in np.exp(place))
    return Biology(melanin=melanin, blood=blood)


def _colours(skin: Skin, places: np.ndarray) -> NDArray[np.float64]:
    """Colours (N, 3) of a skin without sun, with logarithms (N, 2) of melanin and blood."""
    quadrature = skin_quadrature(8)
    changed = [
        replace(skin, specimen=Biology(melanin=float(m), blood=float(b)).of(skin.specimen))
        for m, b in np.exp(places)
    ]
    light = spectra([one.at(one.untanned_state) for one in changed], quadrature.wavelengths)
    return light.subsurface @ quadrature.weights.T
