"""What a weather file leaves out or contradicts, as short sentences without a full stop."""

from collections.abc import Sequence
from datetime import timedelta

from hylios.readers.epw import Weather
from hylios.readers.uv_forecast import Forecast
from hylios.sun.forecast import LONGEST_GAP, hours_without_index

FARTHEST_CLOCK = 3.0
"""Hours that a clock is from the sun's, beyond which the place or the clock is doubtful. Western
China's is 2.9."""

LEAST_GAP = 0.05
"""Hours by day without an index that are worth a word."""


def of_weather(weather: Weather, dark: int) -> list[str]:
    """Of an EPW file which says nothing of so many hours of day (`hylios.sun.weather.of_days`)."""
    notes = []
    if dark:
        hours = "1 hour of day counts" if dark == 1 else f"{dark} hours of day count"
        notes.append(
            f"{hours} as dark: {weather.name} has neither radiation nor clouds of "
            f"{'it' if dark == 1 else 'them'}"
        )
    return notes + _of_clock(weather.name, weather.utc_offset, weather.longitude)


def of_forecast(forecast: Forecast, spans: Sequence[tuple[float, float]]) -> list[str]:
    """Of UV indices in some spans, in hours since the midnight of the forecast's first day."""
    notes, name = [], forecast.name
    if forecast.missing:
        total = forecast.hours.size + forecast.missing
        are = "is" if forecast.missing == 1 else "are"
        notes.append(f"{forecast.missing} of {total} UV indices of {name} {are} missing")
    if not forecast.is_local:
        notes.append(f"hours are in UTC: {name} does not say the place's clock")
    if forecast.has_changes:
        notes.append(f"hours are on the clock of the first time in {name}, which changes later")
    without = sum(hours_without_index(forecast, *span) for span in spans)
    if without >= LEAST_GAP:
        notes.append(
            f"{without:.3g} hours of day count as dark: {name} has no UV indices there within "
            f"{LONGEST_GAP:g} hours of each other"
        )
    if forecast.is_local and forecast.utc_offset is not None and forecast.longitude is not None:
        notes += _of_clock(name, forecast.utc_offset, forecast.longitude)
    return notes


def _of_clock(name: str, utc_offset: float, longitude: float) -> list[str]:
    ahead = utc_offset - longitude / 15.0
    if abs((ahead + 12.0) % 24.0 - 12.0) <= FARTHEST_CLOCK:
        return []
    noon = timedelta(minutes=round(60.0 * ((12.0 + ahead) % 24.0)))
    return [
        f"{name} has a time zone of {utc_offset:g} hours and a longitude of {longitude:g} degrees, "
        f"which puts noon at {str(noon)[:-3]}"
    ]
