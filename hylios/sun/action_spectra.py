"""Doses of light of any spectrum, weighed by what it does to skin (chapter 5, dose evaluation).

The thesis integrates the exposure over an action spectrum and the skin's absorptance (5.3, 5.19)
and divides by the same for the minimal dose, given at 298 nm (5.2, 5.18). With minimal doses in
SED that ratio is a dose in SED: the one of 298 nm light that does as much.

How much of other light tans, two action spectra say (`TANNING_ACTIONS`):

- `erythema`, the usual one: light tans as it burns. For the sun this follows from how minimal doses
  were measured: under solar simulators and narrowband UVB, in SED, with the same ratio of MMD to
  MED under both (Ravnbak et al., Photodermatol. 26, 133, 2010: 1.9 in light skin to 1). At 295 and
  305 nm the two have one mechanism, in the UVA not (Photodermatol. 12, 1996, doi
  10.1111/j.1600-0781.1996.tb00197.x).
- `parrish`, the thesis's figure 3.4 after Parrish et al. 1982: it falls more slowly than erythema
  beyond 298 nm, so that a June day counts three times what a meter shows. The curve that stands
  here is PROVISIONAL, a rough shape. For lamps of UVA it is the nearer one: they tan from 18 J/cm^2
  (PubMed 31206816), which are 10 SED by `parrish` and 1.6 by `erythema` if even from 320 to 400 nm.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from hylios.errors import InputError, as_numbers
from hylios.spectra import Spectra, published_spectra

SED = 100.0
"""Joule per square metre at 298 nm in one standard erythema dose."""

REFERENCE_NM = 298.0

FIRST_NM, LAST_NM = 280.0, 400.0
"""Range of light that counts: nothing acts beyond it, and skin is not tabulated below."""

LARGEST_EXPOSURE = 1e15
"""Largest exposure in J/m^2/nm: far beyond any real one, and its sums stay finite."""

MELANOGENESIS, ERYTHEMA = "melanogenesis_action", "erythema_action"

TANNING_ACTIONS = {"erythema": ERYTHEMA, "parrish": MELANOGENESIS}
"""Names of what light does to melanin, and the spectra they stand for."""

USUAL_TANNING = "erythema"


@dataclass(frozen=True, eq=False)
class Absorptance:
    """Spectral absorptance of skin, the A of 5.1 to 5.3 (`hylios.adding.absorptance`).

    Attributes
    ----------
    wavelengths : (W,) ascending array, nm
        From 280 to 400, or beyond.
    values : (W,) array
        0 to 1, linear between the wavelengths.

    Raises
    ------
    InputError
        If the wavelengths do not ascend from 280 to 400 nm, or a value is not 0 to 1.
    """

    wavelengths: NDArray[np.float64]
    values: NDArray[np.float64]

    def __post_init__(self):
        wavelengths, values = require_curve("absorptance", self.wavelengths, self.values)
        if not (wavelengths[0] <= FIRST_NM and wavelengths[-1] >= LAST_NM):
            raise InputError(
                f"absorptance is given at {wavelengths[0]:g} to {wavelengths[-1]:g} nm; "
                f"needed is {FIRST_NM:g} to {LAST_NM:g} nm."
            )
        object.__setattr__(self, "wavelengths", wavelengths)
        object.__setattr__(self, "values", values)

    def at(self, wavelengths: np.ndarray) -> NDArray[np.float64]:
        """Values at wavelengths in nm."""
        return np.interp(wavelengths, self.wavelengths, self.values)


def require_curve(
    name: str, wavelengths: ArrayLike, values: ArrayLike
) -> tuple[np.ndarray, np.ndarray]:
    """Wavelengths and values of 0 to 1 as arrays (W,) of two or more.

    Raises
    ------
    InputError
        If they are not two rows of one length, the wavelengths do not ascend, or a value is out of
        range.
    """
    wavelengths = as_numbers(f"wavelengths of {name}", wavelengths)
    values = as_numbers(f"values of {name}", values)
    if wavelengths.ndim != 1 or values.shape != wavelengths.shape:
        raise InputError(
            f"{name} has shape {values.shape} at wavelengths of shape {wavelengths.shape}; "
            "expected two rows of one length."
        )
    if wavelengths.size < 2 or not np.all(np.diff(wavelengths) > 0):
        raise InputError(f"{name} needs at least two wavelengths, ascending, in nm.")
    outside = values[~((values >= 0.0) & (values <= 1.0))]
    if outside.size:
        raise InputError(f"{name} has a value of {outside[0]:g}; allowed is 0 to 1.")
    return wavelengths, values


def melanogenesis_dose(
    wavelengths: ArrayLike,
    exposure: ArrayLike,
    absorptance: Absorptance,
    spectra: Spectra | None = None,
    tanning: str = USUAL_TANNING,
) -> NDArray[np.float64]:
    """Dose in SED as it counts for melanin: 5.4 times the MMD.

    Parameters
    ----------
    wavelengths : (W,) ascending array, nm
        What lies beyond 400 nm has no action and is not looked at.
    exposure : (..., W) array
        Radiant exposure per wavelength, J/m^2/nm, linear between the wavelengths.
    absorptance : Absorptance
    spectra : mapping of str to Spectrum, optional
        Other action spectra.
    tanning : str
        `erythema` or `parrish`, of `TANNING_ACTIONS`.

    Returns
    -------
    (...) array

    Raises
    ------
    InputError
        If the wavelengths do not ascend, the exposure is negative or not a number, or not 0 below
        280 nm, or there is no such tanning.
    """
    if not isinstance(tanning, str) or tanning not in TANNING_ACTIONS:
        raise InputError(
            f"action spectrum of tanning is {str(tanning)[:60]!r}; allowed are "
            f"{' and '.join(TANNING_ACTIONS)}."
        )
    return _dose(TANNING_ACTIONS[tanning], wavelengths, exposure, absorptance, spectra)


def thickening_dose(
    wavelengths: ArrayLike,
    exposure: ArrayLike,
    absorptance: Absorptance,
    spectra: Spectra | None = None,
) -> NDArray[np.float64]:
    """Dose in SED as it counts for the thickness: 5.20 times the MED.

    Parameters, result and errors as in `melanogenesis_dose`.
    """
    return _dose(ERYTHEMA, wavelengths, exposure, absorptance, spectra)


def erythemal_dose(
    wavelengths: ArrayLike, exposure: ArrayLike, spectra: Spectra | None = None
) -> NDArray[np.float64]:
    """Dose in SED as meters show it (ISO/CIE 17166): without the skin's absorptance.

    Parameters, result and errors as in `melanogenesis_dose`.
    """
    return _dose(ERYTHEMA, wavelengths, exposure, _ALIKE, spectra)


_ALIKE = Absorptance(np.array([FIRST_NM, LAST_NM]), np.ones(2))


def action(
    name: str, wavelengths: np.ndarray, spectra: Spectra | None = None
) -> NDArray[np.float64]:
    """An action spectrum of `hylios.spectra` at wavelengths in nm.

    Between its own wavelengths its logarithm is linear, as CIE's erythema is; straight lines would
    lie up to 2 % higher.

    Raises
    ------
    InputError
        If a wavelength lies outside the spectrum.
    """
    spectrum = (spectra or published_spectra())[name]
    linear = spectrum.at(np.asarray(wavelengths, dtype=float))
    after = np.searchsorted(spectrum.wavelengths, wavelengths).clip(
        1, spectrum.wavelengths.size - 1
    )
    left, right = spectrum.wavelengths[after - 1], spectrum.wavelengths[after]
    low, high = spectrum.values[after - 1], spectrum.values[after]
    share = (wavelengths - left) / (right - left)
    return np.where((low > 0) & (high > 0), low ** (1.0 - share) * high**share, linear)


def _dose(name, wavelengths, exposure, absorptance: Absorptance, spectra) -> np.ndarray:
    grid, light = resampled(wavelengths, exposure)
    return equivalent_dose(grid, light, action(name, grid, spectra), absorptance.at(grid))


def resampled(wavelengths: ArrayLike, exposure: ArrayLike) -> tuple[np.ndarray, np.ndarray]:
    """Light from 280 to 400 nm at its own wavelengths and at every nm; 0 where it is not given.

    Parameters and errors as in `melanogenesis_dose`.

    Returns
    -------
    (V,) array, (..., V) array
        Wavelengths in nm and the exposure there.
    """
    wavelengths = as_numbers("wavelengths of a spectral dose", wavelengths)
    exposure = as_numbers("values of a spectral dose", exposure)
    if wavelengths.ndim != 1 or wavelengths.size < 2 or not np.all(np.diff(wavelengths) > 0):
        raise InputError("a spectral dose needs at least two wavelengths, ascending, in nm.")
    if exposure.ndim < 1 or exposure.shape[-1] != wavelengths.size:
        raise InputError(
            f"a spectral dose has shape {exposure.shape}; its last axis must match the "
            f"{wavelengths.size} wavelengths."
        )
    early = np.any(exposure[..., wavelengths < FIRST_NM] != 0, axis=tuple(range(exposure.ndim - 1)))
    if np.any(early):
        raise InputError(
            f"a spectral dose has light at {wavelengths[: early.size][early][-1]:g} nm; "
            f"allowed is {FIRST_NM:g} nm and more."
        )
    first, last = wavelengths[[0, -1]]
    ends = [np.nextafter(first, 0.0), np.nextafter(last, np.inf)]
    grid = np.unique(np.concatenate([np.arange(FIRST_NM, LAST_NM + 1.0), wavelengths, ends]))
    grid = grid[(grid >= FIRST_NM) & (grid <= LAST_NM)]
    light = np.empty((*exposure.shape[:-1], grid.size))
    for place in np.ndindex(exposure.shape[:-1]):
        light[place] = np.interp(grid, wavelengths, exposure[place], left=0.0, right=0.0)
    if not np.all((light >= 0.0) & (light <= LARGEST_EXPOSURE)):
        raise InputError(
            f"a spectral dose is negative or not a number or too large; allowed is 0 to "
            f"{LARGEST_EXPOSURE:g} J/m^2/nm."
        )
    return grid, light


def effective_signal(
    wavelengths: np.ndarray,
    exposure: ArrayLike,
    action: np.ndarray,
    absorptance: np.ndarray,
) -> NDArray[np.float64]:
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
) -> NDArray[np.float64]:
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
