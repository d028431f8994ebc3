"""Colour of a reflectance spectrum: CIE 1931 2 degree observer, D65, with colour-science."""

import warnings
from dataclasses import dataclass
from functools import cache
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from hylios.errors import InputError
from hylios.pseudo_colour import TINTS

# It warns that it cannot plot without matplotlib, and has numpy print as it did in 2017.
with warnings.catch_warnings(), np.printoptions():
    warnings.simplefilter("ignore")
    import colour

STEP_NM = 5.0

BANDS = {"uv": (250.0, 400.0), "visible": (400.0, 700.0), "ir": (700.0, 2500.0)}
"""First and last wavelength in nm of the regions of section 6.1.3."""


@cache
def _observer_under_daylight() -> tuple[np.ndarray, np.ndarray]:
    """Wavelengths (N,) in nm and the weights of XYZ (3, N), summing to 1 for Y."""
    shape = colour.SpectralShape(360.0, 780.0, STEP_NM)
    observer = colour.MSDS_CMFS["CIE 1931 2 Degree Standard Observer"].copy().align(shape)
    daylight = colour.SDS_ILLUMINANTS["D65"].copy().align(shape)
    weights = np.asarray(observer.values).T * np.asarray(daylight.values)
    return np.asarray(observer.wavelengths), weights / weights[1].sum()


def xyz_weights(wavelengths: np.ndarray) -> NDArray[np.float64]:
    """Weights (3, W) that turn reflectance at the given wavelengths into XYZ under D65.

    Reflectance is taken as linear between the wavelengths and constant beyond them; a white
    diffuser has Y = 1.

    Raises
    ------
    InputError
        If the wavelengths do not ascend.
    """
    grid, weights = _observer_under_daylight()
    return weights @ hats(grid, wavelengths).T


def hats(grid: np.ndarray, wavelengths: np.ndarray) -> NDArray[np.float64]:
    """Values (W, N) on a grid (N,) of what is 1 at one of the wavelengths (W,), 0 at the others.

    They are linear between the wavelengths and constant beyond them.

    Raises
    ------
    InputError
        If the wavelengths do not ascend.
    """
    wavelengths = np.asarray(wavelengths, dtype=float)
    _require_ascending(wavelengths)
    return np.array([np.interp(grid, wavelengths, row) for row in np.eye(wavelengths.size)])


def _require_ascending(wavelengths: np.ndarray) -> None:
    if wavelengths.ndim != 1 or not np.all(np.diff(wavelengths) > 0) or not wavelengths.size:
        raise InputError("wavelengths of a colour must be a list of ascending numbers, in nm.")


def rec709_weights(wavelengths: np.ndarray) -> NDArray[np.float64]:
    """Weights (3, W) that turn reflectance into linear Rec.709 under D65."""
    matrix = np.asarray(colour.RGB_COLOURSPACES["ITU-R BT.709"].matrix_XYZ_to_RGB)
    weights = matrix @ xyz_weights(wavelengths)
    # The observer's white and the colour space's differ in the fourth digit: white is white.
    return weights / weights.sum(axis=1, keepdims=True)


def linear_rec709(wavelengths: np.ndarray, reflectance: np.ndarray) -> NDArray[np.float64]:
    """Linear Rec.709 (..., 3) of reflectance (..., W) under D65."""
    return np.asarray(reflectance) @ rec709_weights(wavelengths).T


def band_reflectance(wavelengths: np.ndarray, reflectance: np.ndarray, band: str) -> float:
    """Mean reflectance over one of `BANDS`, linear between the wavelengths (W,) in nm.

    Raises
    ------
    InputError
        If the wavelengths do not ascend or do not span the band.
    """
    wavelengths = np.asarray(wavelengths, dtype=float)
    first, last = BANDS[band]
    _require_span(wavelengths, band, f"a swatch of the band {band}")
    between = wavelengths[(wavelengths > first) & (wavelengths < last)]
    grid = np.concatenate([[first], between, [last]])
    values = np.interp(grid, wavelengths, reflectance)
    return float(np.sum(0.5 * (values[1:] + values[:-1]) * np.diff(grid)) / (last - first))


def swatch(wavelengths: np.ndarray, reflectance: np.ndarray, band: str) -> NDArray[np.float64]:
    """Linear Rec.709 (3,) of a swatch of a spectrum (W,) in one of `BANDS` (section 6.1.3).

    Visible: the colour under D65, of the reflectance in the band only, held beyond its ends.
    Ultraviolet and infrared: the mean reflectance over the band as a grey, tinted by `TINTS`.

    Raises
    ------
    InputError
        If the wavelengths do not ascend or do not span the band.
    """
    mean = band_reflectance(wavelengths, reflectance, band)
    if band in TINTS:
        return mean * np.array(TINTS[band])
    first, last = BANDS[band]
    grid = np.arange(first, last + STEP_NM, STEP_NM)
    return linear_rec709(grid, np.interp(grid, wavelengths, reflectance))


def _require_span(wavelengths: np.ndarray, band: str, what: str) -> None:
    """Raise InputError where wavelengths do not ascend or do not span one of `BANDS`."""
    _require_ascending(wavelengths)
    first, last = BANDS[band]
    if wavelengths[0] > first or wavelengths[-1] < last:
        raise InputError(
            f"the spectrum spans {wavelengths[0]:g} to {wavelengths[-1]:g} nm; {what} needs "
            f"{first:g} to {last:g} nm."
        )


def srgb(linear: np.ndarray) -> NDArray[np.float64]:
    """sRGB (..., 3), 0 to 1, of linear Rec.709; what lies outside is cut."""
    return np.asarray(colour.models.eotf_inverse_sRGB(np.clip(linear, 0.0, 1.0)), dtype=np.float64)


def linear_of_srgb(encoded: np.ndarray) -> NDArray[np.float64]:
    """Linear Rec.709 (..., 3) of sRGB (..., 3), 0 to 1."""
    return np.asarray(colour.models.eotf_sRGB(encoded), dtype=np.float64)


def lab(linear: np.ndarray) -> NDArray[np.float64]:
    """CIE L*a*b* (..., 3) under D65 of linear Rec.709."""
    space = colour.RGB_COLOURSPACES["ITU-R BT.709"]
    xyz = np.asarray(linear) @ np.asarray(space.matrix_RGB_to_XYZ).T
    return np.asarray(colour.XYZ_to_Lab(xyz, np.asarray(space.whitepoint)), dtype=np.float64)


def difference(first: np.ndarray, second: np.ndarray) -> NDArray[np.float64]:
    """CIEDE2000 (...) between two arrays of linear Rec.709 (..., 3)."""
    return np.asarray(colour.delta_E(lab(first), lab(second), method="CIE 2000"), dtype=np.float64)


class Reflecting(Protocol):
    """What has a reflectance over wavelengths: a spectrum solved, walked or measured."""

    @property
    def wavelengths(self) -> NDArray[np.float64]: ...

    @property
    def total(self) -> NDArray[np.float64]: ...


@dataclass(frozen=True)
class Colour:
    """Colours under D65, to the CIE 1931 2 degree observer.

    Attributes
    ----------
    linear : (..., 3) array
        Linear Rec.709; a white diffuser is 1, 1, 1.

    Examples
    --------
    >>> import hylios
    >>> light, dark = (
    ...     hylios.Colour.of(hylios.solve_spectrum(hylios.specimen(name), range(400, 701, 20)))
    ...     for name in ("II", "VI")
    ... )
    >>> print(*(f"{number:.0f}" for number in light.lab))
    66 6 15
    >>> print(f"{light.difference(dark):.0f} CIEDE2000 apart")
    26 CIEDE2000 apart
    """

    linear: NDArray[np.float64]

    @classmethod
    def of(cls, spectrum: Reflecting) -> "Colour":
        """The colour of a spectrum's total reflectance.

        Parameters
        ----------
        spectrum
            With `wavelengths` (W,) in nm, ascending, from 400 or less to 700 or more, and `total`
            (..., W). Reflectance is taken as linear between the wavelengths and constant beyond
            them.

        Raises
        ------
        InputError
            If that is no spectrum, or its wavelengths do not ascend or do not span 400 to 700 nm.
        """
        try:
            wavelengths, total = spectrum.wavelengths, spectrum.total
        except AttributeError as error:
            raise InputError(
                f"the spectrum is {str(spectrum)[:60]!r}; expected one with wavelengths and total, "
                "as hylios.solve_spectrum gives it."
            ) from error
        _require_span(wavelengths, "visible", "a colour")
        return cls(linear_rec709(wavelengths, total))

    @property
    def srgb(self) -> NDArray[np.float64]:
        """sRGB (..., 3), 0 to 1; what lies outside is cut."""
        return srgb(self.linear)

    @property
    def lab(self) -> NDArray[np.float64]:
        """CIE L*a*b* (..., 3)."""
        return lab(self.linear)

    def difference(self, other: "Colour") -> NDArray[np.float64]:
        """CIEDE2000 (...) to other colours."""
        return difference(self.linear, other.linear)
