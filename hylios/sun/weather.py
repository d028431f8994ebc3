"""Doses of the sun under the weather of a file: a year's hours, or forecasts of the UV index."""

from dataclasses import replace
from datetime import date
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from hylios.errors import InputError
from hylios.readers.epw import LEAP_YEAR, Weather, epw_of, is_epw
from hylios.readers.text import lines_of, name_of
from hylios.readers.uv_forecast import Forecast, forecast_of
from hylios.spectra import Spectra
from hylios.sun.action_spectra import SED, USUAL_TANNING, Absorptance
from hylios.sun.doses import INSTANTS, WATTS_PER_UV_INDEX, Doses, of_sun
from hylios.sun.position import require_day, sun
from hylios.sun.protection import BARE, Protection
from hylios.sun.sky import ClearSky
from hylios.sun.surroundings import cloud_factor

EXPONENT = 0.76
"""Of the ratio of all radiation to that of a clear sky, for the erythemal ratio: .75 to .78 at
three places (Anton et al., Ann. Geophys. 27, 1387, 2009). Clouds take less of the ultraviolet."""

MOST_RATIO = 1.2
"""Of all radiation to that of a clear sky; beyond, it is taken as this."""

LEAST_CLEAR = 50.0
"""W/m^2 of a clear sky, below which the ratio says nothing and the cover counts, where there is
one."""

LONGEST_GAP = 3.0
"""Hours between two UV indices, beyond which there is night between them."""


def read_weather(path: Path) -> Weather | Forecast:
    """Read an EPW file, or UV indices by time; the path `-` is standard input.

    Raises
    ------
    InputError
        As `hylios.readers.epw.read_epw` or `hylios.readers.uv_forecast.read_forecast`.
    """
    lines, name = lines_of(path), name_of(path)
    return epw_of(lines, name) if is_epw(lines) else forecast_of(lines, name)


def of_weather(
    weather: Weather,
    day: date,
    first: float,
    last: float,
    absorptance: Absorptance,
    *,
    start: date | None = None,
    sky: ClearSky | None = None,
    protection: Protection = BARE,
    spectra: Spectra | None = None,
    tanning: str = USUAL_TANNING,
) -> Doses:
    """Hours of a day under a file's weather, of its month and day in whatever year.

    Parameters
    ----------
    weather : Weather
        As `hylios.readers.epw.read_epw` has it.
    day : date
    first, last : float
        Hours of the day, 0 to 24, in the standard time of the place.
    sky : ClearSky, optional
        The air without clouds; at the weather's altitude by default.
    absorptance, start, protection, spectra, tanning
        As in `hylios.sun.doses.of_sun`.

    Raises
    ------
    InputError
        If one is out of range, or the file has no such hour or says neither radiation nor clouds
        of it while the sun is up.
    """
    doses = of_sun(
        day,
        first,
        last,
        weather.latitude,
        absorptance,
        start=start,
        longitude=weather.longitude,
        utc_offset=weather.utc_offset,
        sky=sky or ClearSky(altitude=weather.altitude),
        protection=protection,
        spectra=spectra,
        tanning=tanning,
    )
    hours = np.mod(doses.hours, 24.0).astype(int)
    factor = np.zeros(hours.size)
    for place in np.flatnonzero(doses.erythemal > 0.0):
        factor[place] = ultraviolet_factor(weather, day, int(hours[place]))
    return replace(
        doses,
        erythemal=factor * doses.erythemal,
        melanogenesis=factor * doses.melanogenesis,
        thickening=factor * doses.thickening,
        uva=None if doses.uva is None else factor * doses.uva,
    )


def days_of(weather: Weather) -> list[tuple[date, float, float]]:
    """Days of a file with their first and last hour, in the file's order from the year 2001 on.

    From 2000 on, a leap year, where the file has a 29 February.
    """
    hours: dict[tuple[int, int], list[int]] = {}
    for month, day, hour in weather.rows:
        hours.setdefault((month, day), []).append(hour)
    year = LEAP_YEAR if (2, 29) in hours else LEAP_YEAR + 1
    days, before = [], (1, 1)
    for month, day in hours:
        year += (month, day) < before
        before = month, day
        try:
            whole = date(year, month, day)
        except ValueError as error:
            raise InputError(
                f"{weather.name} has days of more than a year; {year} has no 29 February."
            ) from error
        days.append((whole, float(min(hours[before])), max(hours[before]) + 1.0))
    return days


def ultraviolet_factor(weather: Weather, day: date, hour: int) -> float:
    """Share of the clear sky's ultraviolet in an hour of a day, 0 to 23.

    By the radiation on level ground over that of a clear sky, 1098 cos exp(-.057 / cos) W/m^2
    (Haurwitz, J. Meteorol. 2, 154, 1945); where there is none, by the clouds.

    Raises
    ------
    InputError
        If the file has no such hour, or neither.
    """
    row = weather.rows.get((require_day(day).month, day.day, hour))
    if row is None:
        raise InputError(
            f"{weather.name} has no row for the hour {hour + 1} of {day.month}/{day.day}."
        )
    instants = hour + (np.arange(INSTANTS) + 0.5) / INSTANTS
    zenith = sun(day, instants, weather.latitude, weather.longitude, weather.utc_offset).zenith
    cosine = np.maximum(np.cos(np.radians(zenith)), 1e-3)
    clear = float(np.mean(1098.0 * cosine * np.exp(-0.057 / cosine)))
    radiation, cover = weather.radiation[row], weather.cover[row]
    if np.isfinite(cover) and (clear < LEAST_CLEAR or not np.isfinite(radiation)):
        return float(cloud_factor(min(cover, 1.0)))
    if np.isfinite(radiation):
        return float(min(radiation / clear, MOST_RATIO) ** EXPONENT)
    raise InputError(
        f"{weather.name} says neither global radiation nor total sky cover in line "
        f"{weather.lines[row]}; needed is one of them."
    )


def of_forecast(
    forecast: Forecast,
    begin: float = 0.0,
    end: float = np.inf,
    *,
    start: date | None = None,
    protection: Protection = BARE,
) -> Doses:
    """Doses by hour of UV indices over time, linear between them, taken as SED.

    Two that are more than three hours apart have night between them.

    Parameters
    ----------
    begin, end : float
        Hours since the midnight of the forecast's first day, between which the skin is outside.
    start : date, optional
        The day whose midnight is hour 0; the forecast's first by default.
    protection : Protection, optional

    Raises
    ------
    InputError
        If the start lies after the forecast's first day.
    """
    shift = 24.0 * (forecast.day - require_day(start or forecast.day)).days
    if shift < 0.0:
        raise InputError(
            f"the UV indices of {forecast.name} begin on {forecast.day}, before hour 0, midnight "
            f"of {start}."
        )
    times = forecast.hours
    first, last = max(times[0], begin), min(times[-1], end)
    if not first < last:
        return Doses(*(np.zeros(0) for _ in range(4)))
    edges = np.concatenate([times, np.arange(np.ceil(first), last), [first, last]])
    edges = np.unique(edges[(edges >= first) & (edges <= last)])
    index = np.interp(edges, times, forecast.indices)
    middle = 0.5 * (edges[1:] + edges[:-1])
    gap = np.diff(times)[np.searchsorted(times, middle) - 1] > LONGEST_GAP
    sums = np.where(gap, 0.0, 0.5 * (index[1:] + index[:-1]) * np.diff(edges))
    return _by_hour(np.floor(middle), sums, shift, protection)


def _by_hour(
    hours: NDArray[np.float64], sums: NDArray[np.float64], shift: float, protection: Protection
) -> Doses:
    """Doses from hours and the UV index times hours in each of their parts; none where it is 0."""
    whole, place = np.unique(hours, return_inverse=True)
    received = np.bincount(place.reshape(-1), sums) * WATTS_PER_UV_INDEX * 3600.0 / SED
    received = received * protection.of_sunlight()
    some = received > 0.0
    return Doses(whole[some] + shift, received[some], received[some], received[some])
