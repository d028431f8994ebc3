"""The sun as the commands `tan` and `dose` take it: hours of days, place, air, and weather."""

import argparse
from dataclasses import dataclass
from datetime import date, datetime, timedelta
from pathlib import Path
from typing import Any

from hylios.commands import dose_notes
from hylios.commands.texts import number
from hylios.errors import InputError, require_range
from hylios.readers.epw import Weather
from hylios.readers.uv_forecast import Forecast
from hylios.sun.doses import Doses, of_sun
from hylios.sun.forecast import of_forecast
from hylios.sun.protection import Protection
from hylios.sun.sky import ClearSky
from hylios.sun.surroundings import GROUNDS, ground_albedo
from hylios.sun.weather import days_of, of_days, read_weather

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
        action="append",
        default=[],
        metavar="FILE",
        help="an EPW file or UV indices by time (CSV or JSON; - for standard input), one file; "
        "without --sun all that is in it",
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
        (
            "--utc-offset",
            "HOURS",
            "of that clock, daylight saving included (default: 0); with --weather of a file whose "
            "times are in UTC",
        ),
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

    def doses(self, protection: Protection, **light: Any) -> tuple[list[Doses], list[str]]:
        """The doses, and what is to be said of them.

        `light` is absorptance, spectra and tanning as in `of_sun`.
        """
        arguments, weather = self.arguments, self.weather
        start = _date(arguments.start) if arguments.start else None
        if isinstance(weather, Forecast):
            parts = _of_forecast(weather, self.days, start, protection)
            return parts, dose_notes.of_forecast(weather, self.days, parts)
        if not self.has_spectrum:
            return [], []
        days = self.days or days_of(weather) if weather is not None else self.days
        start = start or min(day for day, *_ in days)
        light.update(start=start, protection=protection)
        if weather is not None:
            sky = _sky(arguments, weather.altitude)
            parts, dark = of_days(weather, days, sky=sky, **light)
            return parts, dose_notes.of_weather(weather, dark)
        light.update(sky=_sky(arguments, USUAL_SKY.altitude), cloud=arguments.cloud or 0.0)
        offset = arguments.utc_offset or 0.0
        light.update(longitude=arguments.longitude, utc_offset=offset)
        return [of_sun(*day, latitude=arguments.latitude, **light) for day in days], []


def asked_sun(arguments: argparse.Namespace) -> AskedSun:
    """What the arguments say of the sun.

    Raises
    ------
    InputError
        If one cannot be used, is missing, or is there without what it belongs to.
    """
    weather = None
    if arguments.weather:
        weather = _weather(arguments)
    elif not arguments.sun:
        _require_none(arguments, ("start", *PLACE, *SKY, "ground"), "without --sun")
    elif arguments.latitude is None:
        raise InputError("--sun needs --latitude, in degrees, north positive.")
    elif arguments.utc_offset is not None and arguments.longitude is None:
        raise InputError("--utc-offset is given without --longitude.")
    return AskedSun(arguments, weather, [_sun(text) for text in arguments.sun])


def _weather(arguments: argparse.Namespace) -> Weather | Forecast:
    """What the weather file holds, on the clock that `--sun` is in."""
    if len(arguments.weather) > 1:
        raise InputError(
            f"--weather is given {len(arguments.weather)} times; allowed is once, and doses that "
            "`hylios dose` printed of others go into --schedule."
        )
    (path,) = arguments.weather
    weather = read_weather(path)
    if isinstance(weather, Weather):
        _require_none(arguments, PLACE, "with --weather, whose file says it")
        return weather
    forecast = weather
    needless = (*(option for option in PLACE if option != "utc_offset"), *SKY, "ground")
    _require_none(arguments, needless, "with --weather, whose UV indices have all of it")
    if arguments.utc_offset is None:
        if arguments.sun and not forecast.is_local:
            raise InputError(
                f"{forecast.name} has times in UTC and does not say the place's clock, which --sun "
                "is in; needed is --utc-offset, in hours, east positive, or 0 for UTC."
            )
        return forecast
    if forecast.is_local and forecast.utc_offset is not None:
        _require_none(arguments, ("utc_offset",), "with --weather, whose file says it")
    return forecast.on_clock(arguments.utc_offset)


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
    spans = dose_notes.spans_of(forecast, days)
    for (day, first, last), (begin, end) in zip(days, spans, strict=True):
        for hour in (first, last):
            require_range("hour of sun", hour, 0.0, 24.0)
        if first >= last:
            raise InputError(f"sun is given from {first:g} to {last:g} h; the first must be less.")
        if not (begin < forecast.hours[-1] and end > forecast.hours[0]):
            raise InputError(
                f"sun on {day} from {first:g} to {last:g} h lies outside {forecast.name}, which "
                f"has UV indices from {_moment(forecast, 0)} to {_moment(forecast, -1)}."
            )
        parts.append(of_forecast(forecast, begin, end, start=start, protection=protection))
    return parts


def _moment(forecast: Forecast, number: int) -> str:
    midnight = datetime(forecast.day.year, forecast.day.month, forecast.day.day)  # noqa: DTZ001
    moment = midnight + timedelta(hours=float(forecast.hours[number]))
    return moment.isoformat(" ", "minutes")


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
