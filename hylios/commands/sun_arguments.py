"""The sun as the commands `tan` and `dose` take it: hours of days, place, air, and weather."""

import argparse
from dataclasses import dataclass
from datetime import date, timedelta
from pathlib import Path
from typing import Any

from hylios.commands.texts import number
from hylios.errors import InputError, require_range
from hylios.readers.epw import Weather
from hylios.readers.uv_forecast import Forecast
from hylios.sun.doses import Doses, of_sun
from hylios.sun.protection import Protection
from hylios.sun.sky import ClearSky
from hylios.sun.surroundings import GROUNDS, ground_albedo
from hylios.sun.weather import days_of, of_forecast, of_weather, read_weather

USUAL_SKY = ClearSky()
SKY = {
    "ozone": ("DU", "ozone column in Dobson units"),
    "altitude": ("M", "metres above the sea"),
    "aerosol": ("DEPTH", "optical depth of the aerosol at 500 nm"),
    "albedo": ("SHARE", "share of ultraviolet that the ground reflects; snow 0.8"),
}
"""Options that say what the air is like: `ClearSky`'s names, with their units and meaning."""

PLACE = ("latitude", "longitude", "utc_offset", "cloud")
"""Options that a weather file takes the place of."""


def add_sun_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of the sun."""
    sun = parser.add_argument_group("sun")
    sun.add_argument(
        "--sun",
        action="append",
        default=[],
        metavar="DATE:FROM-TO",
        help="hours of a day such as 2025-06-21:10-16:30; needs --latitude or --weather",
    )
    sun.add_argument(
        "--weather",
        type=Path,
        metavar="FILE",
        help="an EPW file or UV indices by time (CSV or JSON; - for standard input); without --sun "
        "all that is in it",
    )
    sun.add_argument(
        "--start",
        metavar="DATE",
        help="day whose midnight is hour 0 (default: the first --sun, or of the weather)",
    )
    for option, metavar, help_text in (
        ("--latitude", "DEGREES", "latitude, north positive; --sun is in solar time, noon at 12"),
        (
            "--longitude",
            "DEGREES",
            "longitude, east positive; --sun is then in the time of a clock",
        ),
        ("--utc-offset", "HOURS", "of that clock, daylight saving included (default: 0)"),
    ):
        sun.add_argument(option, type=float, metavar=metavar, help=help_text)
    for name, (metavar, help_text) in SKY.items():
        usual = f"{help_text} ({getattr(USUAL_SKY, name):g})"
        sun.add_argument(f"--{name}", type=float, metavar=metavar, help=usual)
    grounds = ", ".join(f"{name} {ground.albedo:g}" for name, ground in GROUNDS.items())
    sun.add_argument("--ground", choices=GROUNDS, help=f"in place of --albedo: {grounds}")
    sun.add_argument(
        "--cloud",
        type=float,
        metavar="SHARE",
        help="of the sky that clouds cover (0); half of it leaves 0.84, all of it 0.31",
    )


@dataclass(frozen=True)
class AskedSun:
    """What the arguments say of the sun.

    Attributes
    ----------
    weather : Weather or Forecast or None
        Of a file.
    days : list of (date, float, float)
        Days and hours of `--sun`.
    """

    arguments: argparse.Namespace
    weather: Weather | Forecast | None
    days: list[tuple[date, float, float]]

    @property
    def has_spectrum(self) -> bool:
        """Whether some dose is of light of known spectrum, which a UV index is not."""
        return not isinstance(self.weather, Forecast) and bool(self.days or self.weather)

    def doses(self, protection: Protection, **light: Any) -> list[Doses]:
        """The doses; `light` is absorptance, spectra and tanning as in `of_sun`."""
        arguments, weather = self.arguments, self.weather
        start = _date(arguments.start) if arguments.start else None
        if isinstance(weather, Forecast):
            return _of_forecast(weather, self.days, start, protection)
        if not self.has_spectrum:
            return []
        days = self.days or days_of(weather) if weather is not None else self.days
        start = start or min(day for day, *_ in days)
        light.update(start=start, protection=protection)
        if weather is not None:
            sky = _sky(arguments, weather.altitude)
            return [of_weather(weather, *day, sky=sky, **light) for day in days]
        light.update(sky=_sky(arguments, USUAL_SKY.altitude), cloud=arguments.cloud or 0.0)
        offset = arguments.utc_offset or 0.0
        light.update(longitude=arguments.longitude, utc_offset=offset)
        return [of_sun(*day, latitude=arguments.latitude, **light) for day in days]


def asked_sun(arguments: argparse.Namespace) -> AskedSun:
    """What the arguments say of the sun.

    Raises
    ------
    InputError
        If one cannot be used, is missing, or is there without what it belongs to.
    """
    weather = None
    if arguments.weather is not None:
        weather = read_weather(arguments.weather)
        of_the_file = PLACE if isinstance(weather, Weather) else (*PLACE, *SKY, "ground")
        _require_none(arguments, of_the_file, "with --weather, whose file says it")
    elif not arguments.sun:
        _require_none(arguments, ("start", *PLACE, *SKY, "ground"), "without --sun")
    elif arguments.latitude is None:
        raise InputError("--sun needs --latitude, in degrees, north positive.")
    elif arguments.utc_offset is not None and arguments.longitude is None:
        raise InputError("--utc-offset is given without --longitude.")
    return AskedSun(arguments, weather, [_sun(text) for text in arguments.sun])


def _require_none(arguments: argparse.Namespace, options: tuple[str, ...], why: str) -> None:
    for option in options:
        if getattr(arguments, option) is not None:
            raise InputError(f"--{option.replace('_', '-')} is given {why}.")


def _sky(arguments: argparse.Namespace, altitude: float) -> ClearSky:
    air = {name: getattr(arguments, name) for name in SKY}
    if arguments.ground is not None:
        if arguments.albedo is not None:
            raise InputError("the ground is given as --ground and as --albedo; give only one.")
        air["albedo"] = ground_albedo(arguments.ground)
    usual = {"altitude": altitude}
    return ClearSky(**usual | {name: value for name, value in air.items() if value is not None})


def _of_forecast(
    forecast: Forecast,
    days: list[tuple[date, float, float]],
    start: date | None,
    protection: Protection,
) -> list[Doses]:
    """Doses of a forecast, on all its days or in hours of some."""
    if not days:
        return [of_forecast(forecast, start=start, protection=protection)]
    parts = []
    for day, first, last in days:
        for hour in (first, last):
            require_range("hour of sun", hour, 0.0, 24.0)
        midnight = 24.0 * (day - forecast.day).days
        if not (midnight + first < forecast.hours[-1] and midnight + last > forecast.hours[0]):
            final = forecast.day + timedelta(hours=float(forecast.hours[-1]))
            raise InputError(
                f"sun on {day} lies outside {forecast.name}, which has UV indices of "
                f"{forecast.day} to {final}."
            )
        begin, end = midnight + first, midnight + last
        parts.append(of_forecast(forecast, begin, end, start=start, protection=protection))
    return parts


def _sun(text: str) -> tuple[date, float, float]:
    """Day and hours of DATE:FROM-TO."""
    day, _, hours = text.partition(":")
    first, separator, last = hours.partition("-")
    if not (day and separator):
        raise InputError(f"sun is {text!r}; expected DATE:FROM-TO, such as 2025-06-21:10-16.")
    return _date(day), _clock(first), _clock(last)


def _date(text: str) -> date:
    try:
        return date.fromisoformat(text)
    except ValueError as error:
        raise InputError(f"a date is {text!r}; expected YEAR-MONTH-DAY, as 2025-06-21.") from error


def _clock(text: str) -> float:
    """Hours of a text such as 10, 10.5 or 10:30."""
    hour, separator, minute = text.partition(":")
    minutes = number(minute, "minute of sun") if separator else 0.0
    require_range("minute of sun", minutes, 0.0, 59.999)
    return number(hour, "hour of sun") + minutes / 60.0
