"""Where the sun stands, after Meeus.

J. Meeus, Astronomical Algorithms, 2nd edition, chapter 25 (low accuracy, 0.01 degrees), with his
sidereal time (12.4) and change to altitude and azimuth (13.5, 13.6). Left out are parallax (.0024
degrees), the difference of dynamical and universal time (.001 degrees), and refraction, which lifts
the sun by .5 degrees on the horizon and .02 degrees at 40 degrees.
"""

from dataclasses import dataclass
from datetime import date, datetime

import numpy as np
from numpy.typing import ArrayLike

from hylios.errors import InputError, as_numbers, require_range

FIRST_YEAR, LAST_YEAR = 1900, 2100


@dataclass(frozen=True)
class Sun:
    """Place of the sun in the sky.

    Attributes
    ----------
    zenith : (...) array
        Angle from straight up, degrees; beyond 90 it has set.
    azimuth : (...) array
        Degrees from north towards east, 0 to 360.
    distance : (...) array
        In astronomical units.
    """

    zenith: np.ndarray
    azimuth: np.ndarray
    distance: np.ndarray


def require_day(day: date) -> date:
    """The day, if it is a date without a time.

    Raises
    ------
    InputError
        If it is anything else.
    """
    if not isinstance(day, date) or isinstance(day, datetime):
        raise InputError(
            f"the day is {str(day)[:60]!r}; expected a datetime.date, such as date(2025, 6, 21)."
        )
    return day


def sun(
    day: date,
    hours: ArrayLike,
    latitude: float,
    longitude: float | None = None,
    utc_offset: float = 0.0,
) -> Sun:
    """The sun over a place at hours of a day.

    Parameters
    ----------
    day : date
        1900 to 2100.
    hours : (...) array
        Of the day. Without a longitude they are local solar time: the sun is highest at 12. The
        date is then taken as Greenwich's, which is wrong by at most half a day: .2 degrees of
        declination at the equinoxes. With one they are a clock's.
    latitude, longitude : float
        Degrees, north and east positive.
    utc_offset : float
        Of the clock from universal time, hours, east positive, daylight saving included. Without
        a longitude there is no clock, and it must be 0.

    Raises
    ------
    InputError
        If one is out of range.
    """
    require_range("year of the sun", require_day(day).year, FIRST_YEAR, LAST_YEAR)
    require_range("latitude", latitude, -90.0, 90.0, "degrees")
    hours = as_numbers("hours of the day", hours)
    if not np.all(np.isfinite(hours)):
        raise InputError("an hour of the day is not a number; allowed are 0 to 24.")
    universal = hours
    if longitude is not None:
        require_range("longitude", longitude, -180.0, 180.0, "degrees")
        require_range("offset from UTC", utc_offset, -14.0, 14.0, "hours")
        universal = hours - utc_offset
    elif utc_offset != 0.0:
        raise InputError(
            f"offset from UTC is {str(utc_offset)[:60]} without a longitude; needed is both or "
            "neither."
        )
    days = (day - date(2000, 1, 1)).days - 0.5 + universal / 24.0
    ascension, declination, distance = _of_the_earth(days)
    if longitude is None:
        hour_angle = np.radians(15.0 * (hours - 12.0))
    else:
        sidereal = 280.46061837 + 360.98564736629 * days + 0.000387933 * (days / 36525.0) ** 2
        hour_angle = np.radians(sidereal + longitude) - ascension
    zenith, azimuth = _in_the_sky(hour_angle, declination, np.radians(latitude))
    return Sun(zenith, azimuth, distance)


def _of_the_earth(days: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Right ascension and declination, radians, and distance; days are since J2000.0."""
    centuries = days / 36525.0
    mean_longitude = 280.46646 + centuries * (36000.76983 + 0.0003032 * centuries)
    anomaly = np.radians(357.52911 + centuries * (35999.05029 - 0.0001537 * centuries))
    eccentricity = 0.016708634 - centuries * (0.000042037 + 0.0000001267 * centuries)
    centre = (
        (1.914602 - centuries * (0.004817 + 0.000014 * centuries)) * np.sin(anomaly)
        + (0.019993 - 0.000101 * centuries) * np.sin(2.0 * anomaly)
        + 0.000289 * np.sin(3.0 * anomaly)
    )
    node = np.radians(125.04 - 1934.136 * centuries)
    longitude = np.radians(mean_longitude + centre - 0.00569 - 0.00478 * np.sin(node))
    obliquity = np.radians(23.439291 - 0.0130042 * centuries + 0.00256 * np.cos(node))
    ascension = np.arctan2(np.cos(obliquity) * np.sin(longitude), np.cos(longitude))
    declination = np.arcsin(np.sin(obliquity) * np.sin(longitude))
    true_anomaly = anomaly + np.radians(centre)
    distance = 1.000001018 * (1.0 - eccentricity**2) / (1.0 + eccentricity * np.cos(true_anomaly))
    return ascension, declination, distance


def _in_the_sky(
    hour_angle: np.ndarray, declination: np.ndarray, latitude: float
) -> tuple[np.ndarray, np.ndarray]:
    """Zenith angle and azimuth in degrees, from angles in radians."""
    up = np.sin(latitude) * np.sin(declination)
    up = up + np.cos(latitude) * np.cos(declination) * np.cos(hour_angle)
    west = np.cos(declination) * np.sin(hour_angle)
    south = np.sin(latitude) * np.cos(declination) * np.cos(hour_angle)
    south = south - np.cos(latitude) * np.sin(declination)
    zenith = np.degrees(np.arctan2(np.hypot(west, south), up))
    return zenith, np.degrees(np.arctan2(west, south) + np.pi) % 360.0
