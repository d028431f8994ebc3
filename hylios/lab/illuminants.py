"""Colour of reflectance under any illuminant, to any CIE observer, as linear Rec.709.

What is white under the illuminant is (1, 1, 1): the colour is that which an eye sees, or a camera
balanced for white, once it has adapted to the light. The adaptation is Bradford's, the one of ICC
profiles (Lindbloom's linear form), from the illuminant's white to that of D65. So a table made for
an illuminant is used under white lamps. Under D65 and CIE 1931 2 degree the weights are those of
`hylios.lab.colour`.
"""

from functools import cache

import numpy as np
from numpy.typing import NDArray

from hylios.errors import InputError, as_numbers
from hylios.lab.colour import colour, hats
from hylios.lab.skin_spectra import reconstruction, shipped_components, unseen
from hylios.quadrature import skin_quadrature

DAYLIGHT, STANDARD_OBSERVER = "D65", "CIE 1931 2 degree"

ENOUGH = 16
"""Most wavelengths that a lamp is given for its lines; the components tell no more apart."""

AS_RIGHT = 1.2
"""Error of colours that counts as no larger than another: by a fifth."""

OBSERVERS = {
    f"CIE {year} {degrees} degree": f"CIE {year} {degrees} Degree Standard Observer"
    for year, degrees in ((1931, 2), (1964, 10), (2015, 2), (2015, 10))
}
"""Observers that see XYZ, and colour-science's names of them."""

Illuminant = str | tuple[np.ndarray, np.ndarray]
"""A name of colour-science's, in capitals or not, or wavelengths in nm and power per wavelength."""


def illuminants() -> list[str]:
    """Names of the illuminants: CIE's A to E, D, FL, HP, LED and ID series, and those of ISO."""
    return list(colour.SDS_ILLUMINANTS)


def illuminant_weights(
    count: int, illuminant: Illuminant = DAYLIGHT, observer: str = STANDARD_OBSERVER
) -> NDArray[np.float64]:
    """Weights (3, count) of `hylios.quadrature.skin_quadrature`'s wavelengths for other light.

    From the values at these wavelengths the skin's spectrum is reconstructed
    (`hylios.lab.skin_spectra`), and weighted as a whole one. Linear Rec.709 is `weights @
    reflectance`, each row's sum is 1.

    Parameters
    ----------
    count : int
        4 to 20. Lamps of narrow lines need more than daylight does (`enough_wavelengths`).
    illuminant
        By name, or wavelengths (N,) in nm, ascending, and power (N,) per wavelength in any unit;
        it is linear between the wavelengths, and none beyond them.
    observer : str
        One of `OBSERVERS`, in capitals or not.

    Raises
    ------
    InputError
        If there is no such illuminant, observer or number of wavelengths, or a spectrum has no
        ascending wavelengths, negative power, or no light that eyes can see white by.
    """
    quadrature = skin_quadrature(count)
    if is_daylight(illuminant, observer):
        return quadrature.weights
    return _fine_weights(illuminant, observer) @ reconstruction(quadrature.wavelengths)


def enough_wavelengths(
    count: int, illuminant: Illuminant = DAYLIGHT, observer: str = STANDARD_OBSERVER
) -> int:
    """The fewest wavelengths that make colours as right as so many do under daylight.

    Right is by the skins from which spectra are reconstructed, in the channel that is farthest off.

    Returns
    -------
    int
        `count` to 16; 16 where no number is enough, as for light of few lines. More than 16 stay.

    Raises
    ------
    InputError
        As `illuminant_weights`.
    """
    allowed = AS_RIGHT * _missed(count, DAYLIGHT, STANDARD_OBSERVER)
    enough = (n for n in range(count, ENOUGH) if _missed(n, illuminant, observer) <= allowed)
    return next(enough, max(count, ENOUGH))


def _missed(count: int, illuminant: Illuminant, observer: str) -> float:
    """Rms over skins of what a channel misses, over the skin's mean reflectance."""
    missed = _fine_weights(illuminant, observer) @ unseen(skin_quadrature(count).wavelengths)
    return float(np.sqrt((missed**2).sum(axis=1)).max())


def rec709_weights_under(
    wavelengths: np.ndarray,
    illuminant: Illuminant = DAYLIGHT,
    observer: str = STANDARD_OBSERVER,
) -> NDArray[np.float64]:
    """Weights (3, W) that turn a whole spectrum into linear Rec.709 under an illuminant.

    Reflectance is linear between the wavelengths in nm and constant beyond them. Other parameters
    and errors as in `illuminant_weights`.

    Raises
    ------
    InputError
        If the wavelengths do not ascend, or as there.
    """
    return _fine_weights(illuminant, observer) @ hats(_grid(), wavelengths).T


def is_daylight(illuminant: Illuminant, observer: str) -> bool:
    """Whether that is the standard: D65, named so, and CIE 1931 2 degree."""
    named = isinstance(illuminant, str) and illuminant.casefold() == DAYLIGHT.casefold()
    return named and observer.casefold() == STANDARD_OBSERVER.casefold()


def _grid() -> np.ndarray:
    return shipped_components()[0]


def _fine_weights(illuminant: Illuminant, observer: str) -> NDArray[np.float64]:
    """Weights (3, N) on the grid, adapted to white."""
    matching = _matching(_listed("observer", observer, OBSERVERS))
    if isinstance(illuminant, str):
        power = _standard(_listed("illuminant", illuminant, illuminants()))
    else:
        power = _measured(illuminant)
    weights = matching * power
    white, daylight = weights.sum(axis=1), _white_of_daylight()
    cones = np.asarray(colour.adaptation.CHROMATIC_ADAPTATION_TRANSFORMS["Bradford"])
    seen = cones @ white
    if not np.all(seen > 1e-6 * np.abs(cones) @ np.abs(white)) or not white[1] > 0.0:
        raise InputError(
            "illuminant has no light that eyes can see white by; allowed is light of many colours."
        )
    adapted = np.linalg.inv(cones) @ np.diag(cones @ daylight / seen) @ cones
    to_rgb = np.asarray(colour.RGB_COLOURSPACES["ITU-R BT.709"].matrix_XYZ_to_RGB)
    weights = to_rgb @ adapted @ weights
    return weights / weights.sum(axis=1, keepdims=True)


def _listed(what: str, name: str, names) -> str:
    """The name as it is listed, of one in capitals or not."""
    for listed in names:
        if str(name).casefold() == listed.casefold():
            return listed
    raise InputError(f"{what} is {str(name)[:60]!r}; allowed are {', '.join(names)}.")


def _measured(spectrum: tuple[np.ndarray, np.ndarray]) -> np.ndarray:
    """Power of a spectrum on the grid."""
    wavelengths, power = (as_numbers("the illuminant's numbers", values) for values in spectrum)
    if wavelengths.ndim != 1 or wavelengths.shape != power.shape or wavelengths.size < 2:
        raise InputError(
            f"an illuminant's wavelengths and power have shapes {wavelengths.shape} and "
            f"{power.shape}; expected one row of at least 2 for either."
        )
    if not np.all(np.diff(wavelengths) > 0.0) or not np.all(np.isfinite(wavelengths)):
        raise InputError("an illuminant's wavelengths must ascend, in nm.")
    if not np.all((power >= 0.0) & np.isfinite(power)):
        raise InputError("an illuminant's power must be 0 or more at all wavelengths.")
    return np.interp(_grid(), wavelengths, power, left=0.0, right=0.0)


def _shape():
    grid = _grid()
    return colour.SpectralShape(grid[0], grid[-1], grid[1] - grid[0])


@cache
def _standard(name: str) -> np.ndarray:
    return np.asarray(colour.SDS_ILLUMINANTS[name].copy().align(_shape()).values)


@cache
def _matching(observer: str) -> np.ndarray:
    """Colour matching functions (3, N)."""
    return np.asarray(colour.MSDS_CMFS[OBSERVERS[observer]].copy().align(_shape()).values).T


@cache
def _white_of_daylight() -> np.ndarray:
    return (_matching(STANDARD_OBSERVER) * _standard(DAYLIGHT)).sum(axis=1)
