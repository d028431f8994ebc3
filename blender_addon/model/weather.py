"""Times in the sun from a file of weather: a year's hours of a place, or UV indices by time."""

from datetime import timedelta
from pathlib import Path
from typing import Any

import numpy as np

from hylios.errors import InputError, require_whole
from hylios.readers.epw import Weather
from hylios.readers.uv_forecast import Forecast
from hylios.sun import file_notes
from hylios.sun.action_spectra import Absorptance
from hylios.sun.forecast import of_forecast
from hylios.sun.weather import of_days, read_weather

from .doses import require_date, require_hours
from .exposures_csv import ReadSchedule
from .settings import LAST_DAY_LIMIT

ANY_SKIN = Absorptance(np.array([280.0, 400.0]), np.array([1.0, 1.0]))
"""What a meter shows does not depend on it."""


def weather_exposures(
    path: Path, *, month: int, day_of_month: int, days: int, first: float, last: float
) -> ReadSchedule:
    """What a file says of some hours of days in a row, as settings of an exposure a day, in SED.

    The remarks say what the file leaves out.

    Parameters
    ----------
    path : Path
        Of an EPW file, or of UV indices by time (CSV or JSON).
    month, day_of_month : int
        Of the first day, in an EPW file; UV indices count from their first day on.
    days : int
        At most so many.
    first, last : float
        Hours of the day, in the standard time of the place, or by the clock of the UV indices.

    Raises
    ------
    InputError
        If the file cannot be read, has not such a day, or no sun in these hours.
    """
    require_whole("number of days", days, 1, int(LAST_DAY_LIMIT))
    require_hours(first, last)
    weather = read_weather(path)
    if isinstance(weather, Forecast):
        told, notes = _of_forecast(weather, days, first, last)
    else:
        told, notes = _of_year(weather, month, day_of_month, days, first, last)
    if not told:
        raise InputError(
            f"{weather.name} has no sun from {first:g} to {last:g} h on these days; allowed are "
            "hours with some."
        )
    return ReadSchedule(tuple(told), tuple(f"{note[0].upper()}{note[1:]}." for note in notes))


def _of_year(
    weather: Weather, month: int, day_of_month: int, days: int, first: float, last: float
) -> tuple[list[dict[str, Any]], list[str]]:
    begin = require_date(month, day_of_month)
    dates = [begin + timedelta(days=number) for number in range(days)]
    hours = [(day, first, last) for day in dates]
    parts, dark = of_days(weather, hours, ANY_SKIN)
    doses = [float(told.erythemal.sum()) for told in parts]
    names = [f"{day:%m-%d}" for day in dates]
    return _with_sun(doses, names, first), file_notes.of_weather(weather, dark)


def _of_forecast(
    forecast: Forecast, days: int, first: float, last: float
) -> tuple[list[dict[str, Any]], list[str]]:
    count = min(days, int(forecast.hours[-1] // 24.0) + 1)
    spans = [(24.0 * number + first, 24.0 * number + last) for number in range(count)]
    doses = [float(of_forecast(forecast, *span).erythemal.sum()) for span in spans]
    names = [(forecast.day + timedelta(days=number)).isoformat() for number in range(count)]
    notes = file_notes.of_forecast(forecast, spans)
    if count < days:
        notes.insert(0, f"{forecast.name} holds {count} of the {days} days")
    return _with_sun(doses, names, first), notes


def _with_sun(doses: list[float], names: list[str], first: float) -> list[dict[str, Any]]:
    """Settings of the days that have some sun."""
    return [
        {"day": number + first / 24.0, "unit": "SED", "dose": float(dose), "name": name}
        for number, (dose, name) in enumerate(zip(doses, names, strict=True))
        if dose > 0.0
    ]
