"""What sunscreen, clothing, window panes and water let through."""

from dataclasses import dataclass
from functools import cache, reduce

import numpy as np
from numpy.typing import ArrayLike, NDArray

from hylios.errors import InputError, require_kind, require_range
from hylios.sun.action_spectra import FIRST_NM, LAST_NM, erythemal_dose, require_curve
from hylios.sun.sky import ClearSky, Sunlight, sunlight

NOMINAL_AMOUNT = 2.0
"""Sunscreen in mg/cm^2 at which its SPF is measured (ISO 24444). People apply .5, a quarter of it
(Faurschou and Wulf, Br. J. Dermatol. 156, 716, 2007), to 1 (Stenberg and Larkoe, Arch. Dermatol.
121, 1400, 1985)."""

LARGEST_FACTOR = 1e4


@dataclass(frozen=True, eq=False)
class Protection:
    """Spectral transmittance of what lies over the skin.

    Attributes
    ----------
    wavelengths : (W,) ascending array, nm
    transmittance : (W,) array
        0 to 1, linear between the wavelengths and held beyond them.

    Raises
    ------
    InputError
        If the wavelengths do not ascend or a transmittance is out of range.
    """

    wavelengths: NDArray[np.float64]
    transmittance: NDArray[np.float64]

    def __post_init__(self):
        curve = require_curve("transmittance", self.wavelengths, self.transmittance)
        object.__setattr__(self, "wavelengths", curve[0])
        object.__setattr__(self, "transmittance", curve[1])

    def at(self, wavelengths: NDArray[np.float64]) -> NDArray[np.float64]:
        """Transmittance at wavelengths in nm."""
        return np.interp(wavelengths, self.wavelengths, self.transmittance)

    def of_sunlight(self) -> float:
        """Share of the sun's erythemal irradiance that passes; 1 over it is an SPF.

        The sun stands 20 degrees from the zenith over 305 Dobson units of ozone in a clear sky:
        midsummer noon at 40 degrees of latitude, this project's choice. What is grey needs none.
        """
        if np.all(self.transmittance == self.transmittance[0]):
            return float(self.transmittance[0])
        light, bare = _standard_sun()
        passed = erythemal_dose(light.wavelengths, light.level * self.at(light.wavelengths))
        return float(passed / bare)


def require_protection(protection: Protection) -> Protection:
    """The protection, if it is one and not its factor or name.

    Raises
    ------
    InputError
        If it is anything else.
    """
    require_kind("the protection", protection, Protection, "one such as hylios.sunscreen(30) makes")
    return protection


@cache
def _standard_sun() -> tuple[Sunlight, float]:
    light = sunlight(20.0, ClearSky(ozone=305.0))
    return light, float(erythemal_dose(light.wavelengths, light.level))


def _grey(share: float) -> Protection:
    return Protection(np.array([FIRST_NM, LAST_NM]), np.array([share, share]))


BARE = _grey(1.0)
"""Nothing over the skin."""


def sunscreen(spf: float, amount: float = NOMINAL_AMOUNT) -> Protection:
    """A sunscreen of which only the SPF is known: grey, SPF^-(amount / 2).

    That an SPF grows exponentially with the amount is what Beer and Lambert have for an even film.
    Measurements on people disagree: Schalka et al. (2009, SPF 15 and 30) found it; Liu et al.
    (2012, doi 10.1111/j.1600-0781.2012.00650.x) found it for SPF 30 and 55, but growth in
    proportion for 4 and 15; Ou-Yang et al. (2012, SPF 30 to 100) found proportion, with which a
    thin film protects more. An SPF says little of the UVA, where real sunscreens differ.

    Parameters
    ----------
    spf : float
        At 2 mg/cm^2, 1 to 1e4.
    amount : float
        mg/cm^2, 0 to 20.

    Raises
    ------
    InputError
        If one is out of range.

    Examples
    --------
    A factor of 30 as people put it on, a quarter of what the test has:

    >>> import hylios
    >>> thin = hylios.sunscreen(30, amount=0.5)
    >>> print(f"lets {thin.of_sunlight():.2f} through")
    lets 0.43 through
    """
    require_range("SPF", spf, 1.0, LARGEST_FACTOR)
    return _grey(spf ** -(_thickness(amount)))


def sunscreen_film(
    wavelengths: ArrayLike, transmittance: ArrayLike, amount: float = NOMINAL_AMOUNT
) -> Protection:
    """A sunscreen of known transmittance at 2 mg/cm^2, in another amount by Beer and Lambert.

    Parameters
    ----------
    wavelengths : (W,) ascending array, nm
        From 290 or less to 400 or more; the transmittance is held below.
    transmittance : (W,) array
    amount : float
        mg/cm^2, 0 to 20.

    Raises
    ------
    InputError
        If the amount or a transmittance is out of range, or wavelengths are missing.
    """
    wavelengths, transmittance = require_curve("transmittance", wavelengths, transmittance)
    if not (wavelengths[0] <= 290.0 and wavelengths[-1] >= LAST_NM):
        raise InputError(
            f"transmittance of a sunscreen is given at {wavelengths[0]:g} to {wavelengths[-1]:g} "
            f"nm; needed is 290 to {LAST_NM:g} nm."
        )
    return Protection(wavelengths, transmittance ** _thickness(amount))


def clothing(upf: float) -> Protection:
    """Cloth of a UPF (AS/NZS 4399), 1 to 1e4: grey, 1 / UPF.

    Raises
    ------
    InputError
        If the UPF is out of range.
    """
    require_range("UPF", upf, 1.0, LARGEST_FACTOR)
    return _grey(1.0 / upf)


GLASS = {"window": 0.743, "car": 0.79, "laminated": 0.02}
"""Mean transmittance of panes in the UVA: smooth window glass (Duarte et al., Photodermatol. 2009,
measured; all glasses stopped the UVB), tempered side glass of cars (up to that), windscreens (both
Moehrle et al. and Tuchinda et al., as summaries have them)."""


def window(glass: str = "window") -> Protection:
    """A pane of `GLASS`: nothing below 320 nm, then rising to all it lets through at 345 nm.

    The rise is an ESTIMATE; the mean from 320 to 400 nm is the measured one.

    Raises
    ------
    InputError
        If there is no such glass.
    """
    if not isinstance(glass, str) or glass not in GLASS:
        raise InputError(f"the glass is {str(glass)[:60]!r}; allowed are {', '.join(GLASS)}.")
    most = GLASS[glass] / (1.0 - 0.5 * 25.0 / 80.0)
    return Protection(np.array([FIRST_NM, 320.0, 345.0, LAST_NM]), np.array([0, 0, most, most]))


DEEPEST_WATER = 100.0


def water(depth: float) -> Protection:
    """Water over the skin, 0 to 100 m: after 1 m .46 of the UVB and .72 of the UVA are left.

    Those two (uwagaslonce.pl, which does not say what water) are taken for 305 and 360 nm, and
    attenuation falls exponentially between and beyond them. An ESTIMATE: clear ocean lets three
    times as deep, a lake less. What the surface reflects, 3 to 6 %, is left out.

    Parameters
    ----------
    depth : float
        m.

    Raises
    ------
    InputError
        If it is out of range.
    """
    require_range("depth of water", depth, 0.0, DEEPEST_WATER, "m")
    wavelengths = np.linspace(FIRST_NM, LAST_NM, 61)
    uvb, uva = -np.log([0.46, 0.72])
    attenuation = uvb * (uva / uvb) ** ((wavelengths - 305.0) / (360.0 - 305.0))
    return Protection(wavelengths, np.exp(-attenuation * depth))


def layered(layers: list[Protection]) -> Protection:
    """Several on top of each other; `BARE` for none."""
    return reduce(_over, layers, BARE)


def _over(upper: Protection, lower: Protection) -> Protection:
    wavelengths = np.union1d(upper.wavelengths, lower.wavelengths)
    return Protection(wavelengths, upper.at(wavelengths) * lower.at(wavelengths))


def _thickness(amount: float) -> float:
    return require_range("amount of sunscreen", amount, 0.0, 20.0, "mg/cm^2") / NOMINAL_AMOUNT
