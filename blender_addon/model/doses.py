"""Hourly doses of ultraviolet for the tanning model, from the exposures that an artist sets."""

import calendar
import functools
from collections.abc import Iterable, Mapping
from dataclasses import replace
from datetime import date
from typing import Any

import numpy as np

from hylios.errors import InputError, require_range, require_whole
from hylios.sun.action_spectra import Absorptance
from hylios.sun.doses import Doses, joined, of_sed, of_sun, of_uv_index
from hylios.sun.protection import BARE, Protection, layered, sunscreen, water, window
from hylios.sun.sky import ClearSky
from hylios.sun.surroundings import ground_albedo
from hylios.table.provenance import absorptance

from .settings import (
    AIR,
    DOSE_LIMIT,
    DURATION_LIMIT,
    FACTOR_LIMIT,
    LAST_DAY_LIMIT,
    MULTIPLE_LIMIT,
    USUAL_GROUND,
    WATER,
    Exposure,
)

ANY_YEAR, LEAP_YEAR = 2025, 2024  # the sun stands nearly alike in all


def received(exposures: Iterable[Exposure], mmd: float, provenance: Mapping[str, Any]) -> Doses:
    """Doses on bare skin of all exposures.

    Parameters
    ----------
    mmd : float
        Minimal melanogenesis dose of the skin in SED.
    provenance : mapping
        Of the skin's table; only exposures to the sun need it.

    Raises
    ------
    InputError
        If an exposure has a value out of range or a day that no month has, or is to the sun and
        the table does not know what the skin absorbs.
    """
    return joined([of_exposure(exposure, mmd, provenance) for exposure in exposures])


def of_exposure(exposure: Exposure, mmd: float, provenance: Mapping[str, Any]) -> Doses:
    """Doses of one exposure; parameters and errors as in `received`."""
    over = BARE
    if exposure.sunscreen:
        factor = require_range("SPF", exposure.spf, 1.0, FACTOR_LIMIT)
        over = sunscreen(factor, exposure.sunscreen_amount)
    hour = begin(exposure)
    if exposure.unit == "SED":
        dose = require_range("dose of a time in the sun", exposure.dose, 0.0, DOSE_LIMIT, "SED")
        return of_sed(hour, dose, over)
    if exposure.unit == "MMD":
        multiple = require_range("number of tanning doses", exposure.multiple, 0.0, MULTIPLE_LIMIT)
        return of_sed(hour, multiple * mmd, over)
    if exposure.unit == "UV_INDEX":
        duration = require_range("duration", exposure.duration, 0.0, DURATION_LIMIT, "hours")
        return of_uv_index(hour, exposure.uv_index, duration, over)
    if exposure.unit == "SUN":
        absorbed = absorptance(provenance)
        over = _beneath(exposure, over)
        cloud = require_range("cloud cover", exposure.cloud, 0.0, 100.0, "percent")
        from_midnight = _of_a_day(
            require_date(exposure.month, exposure.day_of_month),
            exposure.from_hour,
            exposure.to_hour,
            exposure.latitude,
            _sky(exposure),
            0.01 * cloud,
            (absorbed.wavelengths.tobytes(), absorbed.values.tobytes()),
            (over.wavelengths.tobytes(), over.transmittance.tobytes()),
        )
        return replace(from_midnight, hours=from_midnight.hours + 24.0 * np.floor(exposure.day))
    raise InputError(
        f"unit of a time in the sun is {exposure.unit!r}; allowed are SED, MMD, UV_INDEX and SUN."
    )


@functools.lru_cache(maxsize=512)
def _of_a_day(
    day: date,
    first: float,
    last: float,
    latitude: float,
    sky: ClearSky,
    cloud: float,
    absorbed: tuple[bytes, bytes],
    over: tuple[bytes, bytes],
) -> Doses:
    """Doses of the sun from a day's midnight, kept: they take far longer than a tan.

    The curves of the absorptance and the protection are bytes, which a cache can compare.
    """
    skin = Absorptance(*map(np.frombuffer, absorbed))
    protection = Protection(*map(np.frombuffer, over))
    return of_sun(day, first, last, latitude, skin, sky=sky, cloud=cloud, protection=protection)


def _sky(exposure: Exposure) -> ClearSky:
    """The air over an exposure's place, and its ground."""
    sky = ClearSky(altitude=exposure.altitude)
    if exposure.ground == USUAL_GROUND:
        return sky
    return replace(sky, albedo=ground_albedo(exposure.ground.lower()))


def _beneath(exposure: Exposure, over: Protection) -> Protection:
    """What lies over the skin, with a pane or water that the sun goes through."""
    if exposure.through == AIR:
        return over
    if exposure.through == WATER:
        return layered([water(exposure.depth), over])
    return layered([window(exposure.through.lower()), over])


def begin(exposure: Exposure) -> int:
    """The hour of the tanning model in which an exposure begins.

    Raises
    ------
    InputError
        If its day or its hour is out of range.
    """
    require_range("day of a time in the sun", exposure.day, 0.0, LAST_DAY_LIMIT)
    if exposure.unit == "SUN":
        require_range("hour of sun", exposure.from_hour, 0.0, 24.0)
        return 24 * int(exposure.day) + int(exposure.from_hour)
    return int(np.floor(24.0 * exposure.day + 0.5))


def require_date(month: int, day: int) -> date:
    """A day of any year; 29 February is of a leap year.

    Raises
    ------
    InputError
        If there is none.
    """
    require_whole("month", month, 1, 12)
    require_whole("day of the month", day, 1, 31)
    last = calendar.monthrange(LEAP_YEAR, month)[1]
    if day > last:
        raise InputError(
            f"day of the month is {day}, which month {month} lacks; allowed is 1 to {last}."
        )
    return date(LEAP_YEAR if (month, day) == (2, 29) else ANY_YEAR, month, day)


def require_hours(first: float, last: float) -> None:
    """Raise InputError unless hours of sun, 0 to 24, ascend."""
    require_range("hour of sun", first, 0.0, 24.0)
    require_range("hour of sun", last, 0.0, 24.0)
    if not first < last:
        raise InputError(
            f"sun is given from {first:g} to {last:g} h; allowed is an end after its start, to 24."
        )
