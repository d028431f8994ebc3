"""Exposures of the tanning model from what people know: SED, UV index, a lamp's spectrum, the sun.

A function here gives one dose for every hour of the model that an exposure touches, on level skin
or on skin that faces the lamp. A mask says what share of it reaches a place on a body.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from datetime import date

import numpy as np
from numpy.typing import ArrayLike, NDArray

from hylios.errors import InputError, as_numbers, require_kind, require_range
from hylios.spectra import Spectra
from hylios.sun.action_spectra import (
    LAST_NM,
    SED,
    USUAL_TANNING,
    Absorptance,
    erythemal_dose,
    melanogenesis_dose,
    resampled,
    thickening_dose,
)
from hylios.sun.position import Sun, require_day, sun
from hylios.sun.protection import BARE, Protection, require_protection
from hylios.sun.sky import ClearSky, sunlight
from hylios.sun.surroundings import cloud_factor
from hylios.tanning import LARGEST_DOSE, LONGEST_HOURS, Exposures

WATTS_PER_UV_INDEX = 0.025
"""Erythemal irradiance of one unit, W/m^2 (ISO/CIE 17166): .9 SED in an hour."""

LONGEST = 240.0
"""Most hours of one exposure to a lamp or a UV index."""

FIRST_UVA_NM = 320.0
"""Where UVA begins, as the thresholds of darkening have it."""

INSTANTS = 12
"""Instants in an hour, or a share of one, at which the sun's light is computed."""


@dataclass(frozen=True, eq=False)
class Doses:
    """Doses by hour, in SED.

    Attributes
    ----------
    hours : (E,) array
        Whole hours in which the doses lie, for the tan: a part of one counts from its beginning.
    erythemal : (E,) array
        As a meter under the same protection would show it.
    melanogenesis, thickening : (E,) arrays
        As they count for melanin and for thickness.
    uva : (E,) array or None
        J/cm^2 of 320 to 400 nm, by which melanin darkens at once
        (`hylios.tanning.ImmediateDarkening`); None where no spectrum is given.
    """

    hours: NDArray[np.float64]
    erythemal: NDArray[np.float64]
    melanogenesis: NDArray[np.float64]
    thickening: NDArray[np.float64]
    uva: NDArray[np.float64] | None = None

    def exposures(self) -> Exposures:
        """The doses as `hylios.tanning.simulate` takes them.

        Raises
        ------
        InputError
            If an hour or a dose is out of range.
        """
        return Exposures(self.hours, self.melanogenesis, self.thickening)


def joined(parts: Sequence[Doses]) -> Doses:
    """All doses of several, in their order; of UVA, none where it is not known of any."""
    names = ("hours", "erythemal", "melanogenesis", "thickening")
    none = [np.zeros(0)]
    uva = None
    if any(part.uva is not None for part in parts):
        given = [np.zeros(part.hours.size) if part.uva is None else part.uva for part in parts]
        uva = np.concatenate(given)
    return Doses(
        *(np.concatenate(none + [getattr(part, name) for part in parts]) for name in names),
        uva=uva,
    )


def of_sed(hour: float, sed: float, protection: Protection = BARE) -> Doses:
    """A dose in SED at an hour, taken as it is for melanin and thickness alike.

    A protection's spectrum counts as it does for the sun (`Protection.of_sunlight`).

    Raises
    ------
    InputError
        If the hour or the dose is out of range, or the protection is none.
    """
    passed = require_protection(protection).of_sunlight()
    received = np.array([require_range("dose", sed, 0.0, LARGEST_DOSE, "SED") * passed])
    return Doses(np.array([_hour(hour)]), received, received, received)


def of_uv_index(hour: float, index: float, duration: float, protection: Protection = BARE) -> Doses:
    """Hours at a UV index, 25 mW/m^2 of erythemal irradiance a unit, taken as SED.

    Parameters
    ----------
    hour : float
        Of the beginning.
    index : float
        0 to 50.
    duration : float
        Hours, 0 to 240.

    Raises
    ------
    InputError
        If one is out of range.

    Examples
    --------
    >>> import hylios
    >>> doses = hylios.uv_index_doses(hour=10, index=8, duration=1.5)
    >>> print(f"{doses.erythemal.sum():.1f} SED")
    10.8 SED
    >>> state = hylios.skin_type("III").states(doses.exposures(), times=[240])
    """
    require_range("UV index", index, 0.0, 50.0)
    hours, shares = _spread(hour, duration)
    passed = require_protection(protection).of_sunlight()
    received = index * WATTS_PER_UV_INDEX * 3600.0 / SED * shares * passed
    return Doses(hours, received, received, received)


def of_spectrum(
    hour: float,
    wavelengths: ArrayLike,
    irradiance: ArrayLike,
    seconds: float,
    absorptance: Absorptance,
    protection: Protection = BARE,
    spectra: Spectra | None = None,
    tanning: str = USUAL_TANNING,
) -> Doses:
    """Time under light of a spectrum (5.1 to 5.4, 5.17 to 5.20).

    Parameters
    ----------
    hour : float
        Of the beginning.
    wavelengths, irradiance : (W,) arrays, nm and W/m^2/nm
        `melanogenesis_dose` says which part of it counts.
    seconds : float
        0 to 864000.
    absorptance : Absorptance
        Of the skin.
    spectra : mapping of str to Spectrum, optional
        Other action spectra.
    tanning : str
        How light counts for melanin, of `hylios.sun.action_spectra.TANNING_ACTIONS`: `erythema`,
        or `parrish` for a lamp of UVA.

    Raises
    ------
    InputError
        If the time is out of range or the spectrum cannot be used.
    """
    require_range("time of exposure", seconds, 0.0, 3600.0 * LONGEST, "s")
    hours, shares = _spread(hour, seconds / 3600.0)
    with np.errstate(over="ignore", invalid="ignore"):  # what is too large is refused below
        exposure = 3600.0 * shares[:, None] * as_numbers("values of a spectral dose", irradiance)
    return _of_light(hours, wavelengths, exposure, absorptance, protection, spectra, tanning)


def of_sun(
    day: date,
    first: float,
    last: float,
    latitude: float,
    absorptance: Absorptance,
    *,
    start: date | None = None,
    longitude: float | None = None,
    utc_offset: float = 0.0,
    sky: ClearSky | None = None,
    cloud: float = 0.0,
    protection: Protection = BARE,
    spectra: Spectra | None = None,
    tanning: str = USUAL_TANNING,
) -> Doses:
    """Hours of a day in the sun, one dose for each (5.1 to 5.4, 5.17 to 5.20).

    Parameters
    ----------
    day : date
    first, last : float
        Hours of the day, 0 to 24: local solar time, or a clock's where a longitude is given.
    latitude, longitude, utc_offset
        As in `hylios.sun.position.sun`.
    absorptance, protection, spectra, tanning
        As in `of_spectrum`.
    start : date, optional
        The day whose midnight is hour 0; `day` by default.
    sky : ClearSky, optional
    cloud : float
        Share of the sky that clouds cover, 0 to 1 (`hylios.sun.surroundings.cloud_factor`).

    Raises
    ------
    InputError
        If one is out of range, the hours do not ascend, or the day lies before the start.

    Examples
    --------
    A June day at 40 degrees north, as a meter shows it and as it counts for the tan:

    >>> from datetime import date
    >>> import hylios
    >>> absorptance = hylios.ultraviolet_absorptance(hylios.specimen("S3"))
    >>> sun = hylios.sun_doses(date(2025, 6, 21), 10, 16, 40.0, absorptance)
    >>> print(f"{sun.erythemal.sum():.0f} SED, counts as {sun.melanogenesis.sum():.0f}")
    43 SED, counts as 42
    """
    begins, lengths, instants = _hours_of_sun(first, last)
    start = require_day(start or require_day(day))
    if day < start:
        raise InputError(f"sun on {day} lies before hour 0, midnight of {start}.")
    sky = ClearSky() if sky is None else sky
    require_kind("the sky", sky, ClearSky, "a hylios.sun.sky.ClearSky, such as ClearSky(ozone=320)")
    place = sun(day, instants, latitude, longitude, utc_offset)
    wavelengths, level = _level(place, sky)
    exposure = 3600.0 * lengths[:, None] * cloud_factor(cloud) * level
    hours = 24.0 * (day - start).days + np.floor(begins)
    return _of_light(hours, wavelengths, exposure, absorptance, protection, spectra, tanning)


def _level(place: Sun, sky: ClearSky) -> tuple[np.ndarray, np.ndarray]:
    """Wavelengths, and means (E, W) of the light on level ground over instants (E, T)."""
    is_day = (place.zenith < 90.0).any(axis=1)
    light = sunlight(place.zenith[is_day], sky, place.distance[is_day])
    level = np.zeros((is_day.size, light.wavelengths.size))
    level[is_day] = light.level.mean(axis=1)
    return light.wavelengths, level


def _hours_of_sun(first: float, last: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """When hours of a day begin, how long they are (E,), and instants in them (E, INSTANTS)."""
    for hour in (first, last):
        require_range("hour of sun", hour, 0.0, 24.0)
    if first >= last:
        raise InputError(f"sun is given from {first:g} to {last:g} h; the first must be less.")
    edges = np.unique([first, *np.arange(np.ceil(first), np.floor(last) + 1.0), last])
    lengths = np.diff(edges)
    instants = edges[:-1, None] + lengths[:, None] * (np.arange(INSTANTS) + 0.5) / INSTANTS
    return edges[:-1], lengths, instants


def _of_light(
    hours, wavelengths, exposure, absorptance, protection: Protection, spectra, tanning: str
) -> Doses:
    """Doses of radiant exposures (E, W), J/m^2/nm."""
    require_kind(
        "the absorptance",
        absorptance,
        Absorptance,
        "a skin's, as hylios.ultraviolet_absorptance(specimen) gives it",
    )
    require_protection(protection)
    grid, light = resampled(wavelengths, exposure)
    received = light * protection.at(grid)
    return Doses(
        hours,
        erythemal_dose(grid, received, spectra),
        melanogenesis_dose(grid, received, absorptance, spectra, tanning),
        thickening_dose(grid, received, absorptance, spectra),
        _uva(grid, received),
    )


def _uva(wavelengths: np.ndarray, exposure: np.ndarray) -> np.ndarray:
    """J/cm^2 of 320 to 400 nm in radiant exposures (E, W), J/m^2/nm."""
    inside = (wavelengths >= FIRST_UVA_NM) & (wavelengths <= LAST_NM)
    light, steps = exposure[..., inside], np.diff(wavelengths[inside])
    return 1e-4 * (0.5 * (light[..., 1:] + light[..., :-1]) * steps).sum(axis=-1)


def _hour(hour: float) -> float:
    return require_range("an hour of exposure", hour, 0.0, LONGEST_HOURS)


def _spread(hour: float, duration: float) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Hours of the model that a time from the beginning of one touches, and how much of each."""
    _hour(hour)
    require_range("duration", duration, 0.0, LONGEST, "hours")
    passed = np.arange(max(1.0, np.ceil(duration)))
    return hour + passed, np.clip(duration - passed, 0.0, 1.0)
