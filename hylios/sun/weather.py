"""Doses of the sun under the weather of a file: a year's hours, or a part of them."""

from collections.abc import Sequence
from dataclasses import replace
from datetime import date
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from hylios.errors import InputError, require_kind
from hylios.readers.epw import LEAP_YEAR, Weather, epw_of, is_epw
from hylios.readers.text import lines_of, name_of
from hylios.readers.uv_forecast import Forecast, forecast_of
from hylios.spectra import Spectra
from hylios.sun.action_spectra import USUAL_TANNING, Absorptance
from hylios.sun.doses import INSTANTS, Doses, of_sun
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
    light = {"start": start, "sky": sky, "protection": protection}
    light.update(spectra=spectra, tanning=tanning)
    doses, untold = _of_day(weather, day, first, last, absorptance, **light)
    if untold.size:
        row = weather.rows[day.month, day.day, int(untold[0]) % 24]
        raise InputError(
            f"{weather.name} says neither global radiation nor total sky cover in line "
            f"{weather.lines[row]}; needed is one of them."
        )
    return doses


def of_days(
    weather: Weather,
    days: Sequence[tuple[date, float, float]],
    absorptance: Absorptance,
    **light: Any,
) -> tuple[list[Doses], int]:
    """Hours of several days, and of how many of these the file says nothing while the sun is up.

    Those are dark.

    Parameters
    ----------
    days : sequence of (date, float, float)
        Days with their first and last hour.
    weather, absorptance, light
        As in `of_weather`.

    Raises
    ------
    InputError
        If one is out of range, the file has no such hour, or says neither radiation nor clouds of
        any of them while the sun is up.
    """
    told = [_of_day(weather, *day, absorptance, **light) for day in days]
    dark = sum(untold.size for _, untold in told)
    if dark and not any(np.any(doses.erythemal > 0.0) for doses, _ in told):
        raise InputError(
            f"{weather.name} says neither global radiation nor total sky cover of any hour with "
            "sun; needed is one of them."
        )
    return [doses for doses, _ in told], dark


def _of_day(
    weather: Weather,
    day: date,
    first: float,
    last: float,
    absorptance: Absorptance,
    *,
    sky: ClearSky | None = None,
    **light: Any,
) -> tuple[Doses, NDArray[np.float64]]:
    """Doses, and the hours among them of which the file says nothing while the sun is up."""
    require_kind(
        "the weather", weather, Weather, "that of a file, as hylios.readers.epw.read_epw gives it"
    )
    doses = of_sun(
        day,
        first,
        last,
        weather.latitude,
        absorptance,
        longitude=weather.longitude,
        utc_offset=weather.utc_offset,
        sky=ClearSky(altitude=weather.altitude) if sky is None else sky,
        **light,
    )
    lit = doses.erythemal > 0.0
    factor = np.zeros(lit.size)
    factor[lit] = ultraviolet_factor(weather, day, np.mod(doses.hours[lit], 24.0).astype(int))
    untold = np.isnan(factor)
    factor[untold] = 0.0
    under = replace(
        doses,
        erythemal=factor * doses.erythemal,
        melanogenesis=factor * doses.melanogenesis,
        thickening=factor * doses.thickening,
        uva=None if doses.uva is None else factor * doses.uva,
    )
    return under, doses.hours[untold]


def days_of(weather: Weather) -> list[tuple[date, float, float]]:
    """Days of a file with their first and last hour, in the file's order.

    From the year 2001 on; where the file has a 29 February, that is of the year 2000.
    """
    hours: dict[tuple[int, int], list[int]] = {}
    for month, day, hour in weather.rows:
        hours.setdefault((month, day), []).append(hour)
    days = list(hours)
    turns = [after < before for before, after in zip(days, days[1:], strict=False)]
    new_years = np.cumsum([False, *turns])
    passed = {day: int(count) for day, count in zip(days, new_years, strict=True)}
    year = LEAP_YEAR - passed[2, 29] if (2, 29) in passed else LEAP_YEAR + 1
    return [
        (date(year + passed[day], *day), float(min(hours[day])), max(hours[day]) + 1.0)
        for day in days
    ]


def ultraviolet_factor(weather: Weather, day: date, hours: ArrayLike) -> NDArray[np.float64]:
    """Share of the clear sky's ultraviolet in hours of a day; nan where the file says nothing.

    By the radiation on level ground over that of a clear sky, 1098 cos exp(-.057 / cos) W/m^2
    (Haurwitz, J. Meteorol. 2, 154, 1945); where there is none, by the clouds.

    Parameters
    ----------
    hours : (...) int array
        0 to 23.

    Raises
    ------
    InputError
        If the file has no such hour.
    """
    hours = np.asarray(hours, dtype=int)
    keys = [(require_day(day).month, day.day, int(hour)) for hour in hours.flat]
    for *_, hour in (key for key in keys if key not in weather.rows):
        raise InputError(
            f"{weather.name} has no row for the hour {hour + 1} of {day.month}/{day.day}."
        )
    rows = np.array([weather.rows[key] for key in keys], dtype=int).reshape(hours.shape)
    instants = hours[..., None] + (np.arange(INSTANTS) + 0.5) / INSTANTS
    zenith = sun(day, instants, weather.latitude, weather.longitude, weather.utc_offset).zenith
    cosine = np.maximum(np.cos(np.radians(zenith)), 1e-3)
    clear = np.mean(1098.0 * cosine * np.exp(-0.057 / cosine), axis=-1)
    radiation, cover = weather.radiation[rows], weather.cover[rows]
    by_cover = np.isfinite(cover) & ((clear < LEAST_CLEAR) | ~np.isfinite(radiation))
    clouds = cloud_factor(np.clip(np.where(by_cover, cover, 0.0), 0.0, 1.0))
    return np.where(by_cover, clouds, np.minimum(radiation / clear, MOST_RATIO) ** EXPONENT)
