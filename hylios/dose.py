"""Doses of light of any spectrum, weighed by what it does to skin (chapter 5, dose evaluation).

The thesis integrates the exposure over an action spectrum and the skin's absorptance (5.3, 5.19)
and divides by the same for the minimal dose, given at 298 nm (5.2, 5.18). With minimal doses in
SED that ratio is a dose in SED: the one of 298 nm light that does as much.
"""

import numpy as np
from numpy.typing import ArrayLike

from hylios.errors import InputError

SED = 100.0
"""Joule per square metre at 298 nm in one standard erythema dose."""

REFERENCE_NM = 298.0


def effective_signal(
    wavelengths: np.ndarray,
    exposure: ArrayLike,
    action: np.ndarray,
    absorptance: np.ndarray,
) -> np.ndarray:
    """Melanogenesis or thickening signal of an exposure (5.3 or 5.19), in J/m^2.

    Parameters
    ----------
    wavelengths : (W,) ascending array, nm
    exposure : (..., W) array
        Radiant exposure per wavelength, J/m^2/nm.
    action : (W,) array
        Action spectrum of melanogenesis (5.3) or erythema (5.19).
    absorptance : (W,) array
        Of the skin, 0 to 1.

    Raises
    ------
    InputError
        If the wavelengths do not ascend or a value is negative or not a number.
    """
    wavelengths = np.asarray(wavelengths, dtype=float)
    weighed = np.asarray(exposure, dtype=float) * action * absorptance
    if wavelengths.size < 2 or not np.all(np.diff(wavelengths) > 0):
        raise InputError("a spectral dose needs at least two wavelengths, ascending, in nm.")
    if not (np.all(weighed >= 0) and np.all(np.isfinite(weighed))):
        raise InputError("a spectral dose, action or absorptance is negative or not a number.")
    return np.sum(0.5 * (weighed[..., 1:] + weighed[..., :-1]) * np.diff(wavelengths), axis=-1)


def equivalent_dose(
    wavelengths: np.ndarray,
    exposure: ArrayLike,
    action: np.ndarray,
    absorptance: np.ndarray,
) -> np.ndarray:
    """Dose in SED of 298 nm light that gives the same signal: 5.4 or 5.20 times the minimal dose.

    Parameters and errors as in `effective_signal`; the wavelengths must enclose 298 nm.
    """
    signal = effective_signal(wavelengths, exposure, action, absorptance)
    if not wavelengths[0] <= REFERENCE_NM <= wavelengths[-1]:
        raise InputError(
            f"a spectral dose spans {wavelengths[0]:g} to {wavelengths[-1]:g} nm; it must "
            f"enclose {REFERENCE_NM:g} nm, where minimal doses are given."
        )
    one = SED * np.interp(REFERENCE_NM, wavelengths, action)
    one *= np.interp(REFERENCE_NM, wavelengths, absorptance)
    if not one > 0:
        raise InputError(f"the skin absorbs nothing at {REFERENCE_NM:g} nm: no dose has an effect.")
    return signal / one
