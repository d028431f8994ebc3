"""UV indices by time, as services forecast them and meters keep them: CSV or JSON.

CSV has columns of a time and of an index. JSON is a list of objects with both, or an object of two
lists, itself or under a key: as Open-Meteo (`hourly`), OpenUV (`result`), OpenWeather (`hourly`, in
seconds since 1970) and the US Environmental Protection Agency have them.

Times are on the clock of the place: those that say no offset from universal time or one other than
0, and universal times where the file says the place's offset. Otherwise they are universal. Where
offsets change, to daylight saving or from it, all are on the clock of the first time.
"""

import json
import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from datetime import UTC, date, datetime, timedelta, timezone
from pathlib import Path
from typing import Any

import numpy as np

from hylios.errors import InputError, require_range, shown
from hylios.readers.quantities import Quantity
from hylios.readers.table import table_of
from hylios.readers.text import lines_of, name_of
from hylios.tanning import LONGEST_HOURS

MOST_INDEX = 50.0
TIMES = ("time", "date_time", "datetime", "uv_time", "timestamp", "valid_time", "dt", "hour")
INDICES = ("uv_index", "uvi", "uv", "uv index", "uv_value", "uvindex")
UNDER = ("hourly", "result", "data", "forecast", "list")
"""Names, in small letters, of times, of indices, and of what holds them."""

OFFSETS = ("timezone_offset", "utc_offset_seconds")
UNIVERSAL = ("gmt", "utc", "etc/gmt", "etc/utc")
LONGITUDES = ("longitude", "lon")
"""Names of a place's offset from universal time in seconds, of a time zone that is none of a place
but what services take for want of one, and of a longitude."""

MOST_OFFSET = 14.0
FIRST_YEAR, LAST_YEAR = 1900, 2100

TIME = Quantity("time", TIMES, is_text=True)
INDEX = Quantity("uv_index", INDICES, may_lack=True)


@dataclass(frozen=True, eq=False)
class Forecast:
    """UV indices over time.

    Attributes
    ----------
    name : str
        Of its file, as sentences call it.
    day : date
        The first day.
    hours : (N,) ascending array
        Since that day's midnight, of the file's own clock.
    indices : (N,) array
        0 to 50.
    utc_offset : float or None
        Of that clock from universal time, hours, east positive; None where the file doesn't say it.
    is_local : bool
        Whether it is the clock of the place. If not it is universal time.
    longitude : float or None
        Degrees, east positive, where the file says it.
    missing : int
        Times without an index, which were left out.
    has_changes : bool
        Whether the place's clock changed between the times, all of which are on the first's.
    """

    name: str
    day: date
    hours: np.ndarray
    indices: np.ndarray
    utc_offset: float | None = None
    is_local: bool = True
    longitude: float | None = None
    missing: int = 0
    has_changes: bool = False

    def on_clock(self, utc_offset: float) -> "Forecast":
        """The same in the time of a place, if this is in universal time.

        Parameters
        ----------
        utc_offset : float
            Of the place's clock, hours, east positive, daylight saving included.

        Raises
        ------
        InputError
            If it is out of range, or this is on a place's clock already.
        """
        require_range("offset from UTC", utc_offset, -MOST_OFFSET, MOST_OFFSET, "hours")
        if self.is_local:
            raise InputError(
                f"an offset from UTC is given for {self.name}, whose times are on a place's clock; "
                "needed are times in UTC, such as 2025-06-21T10:00Z."
            )
        hours = self.hours + utc_offset
        days = int(np.floor(hours[0] / 24.0))
        return replace(
            self,
            day=self.day + timedelta(days=days),
            hours=hours - 24.0 * days,
            utc_offset=utc_offset,
            is_local=True,
        )


@dataclass(frozen=True)
class _Place:
    """What a file says of the place of its times; None for what it doesn't."""

    utc_offset: float | None = None
    time_zone: str = ""
    longitude: float | None = None


def read_forecast(path: Path) -> Forecast:
    """Read such a file; the path `-` is standard input.

    A time without an index is left out (`Forecast.missing`).

    Raises
    ------
    InputError
        If it cannot be read, has no times or indices, times that do not ascend or of which only
        some have an offset from universal time, or an index that is out of range.
    """
    return forecast_of(lines_of(path), name_of(path))


def forecast_of(lines: Sequence[str], name: str) -> Forecast:
    """A forecast from lines of text; the rest as in `read_forecast`."""
    text, place = "\n".join(lines), _Place()
    if text.lstrip()[:1] in ("{", "["):
        content = _json(text, name)
        place = _place(content, name)
        times, indices = _of_json(content, name)
        entries = [f"entry {number}" for number in range(1, len(times) + 1)]
    else:
        table = table_of(lines, name, (TIME, INDEX))
        times, numbers = table.texts[TIME.name], table.numbers[INDEX.name].tolist()
        indices = [None if math.isnan(number) else number for number in numbers]
        entries = [f"line {line}" for line in table.lines]
    present = [number for number, index in enumerate(indices) if index is not None]
    if indices and not present:
        raise InputError(f"{name} has no UV index: all {len(indices)} are missing; needed are two.")
    if len(present) < 2:
        raise InputError(f"{name} has {len(present)} UV indices; needed are two or more.")
    moments = [_moment(name, *both) for both in zip(times, entries, strict=True)]
    values = [_index(name, indices[number], entries[number]) for number in present]
    _require_order(name, moments, entries)
    moments, offset, is_local, has_changes = _on_the_places_clock(moments, place)
    day = moments[0].date()
    midnight = datetime(day.year, day.month, day.day, tzinfo=moments[0].tzinfo)
    hours = [(moments[number] - midnight) / timedelta(hours=1) for number in present]
    return Forecast(
        name,
        day,
        np.array(hours),
        np.array(values),
        offset,
        is_local,
        place.longitude,
        len(indices) - len(present),
        has_changes,
    )


def _on_the_places_clock(
    moments: list[datetime], place: _Place
) -> tuple[list[datetime], float | None, bool, bool]:
    """Times, hours of their offset from universal time, whether it is the place's, and changed."""
    own, offset = moments[0].utcoffset(), place.utc_offset
    is_usual = offset == 0.0 and place.time_zone.casefold() in UNIVERSAL
    if own is None:
        return moments, offset, not is_usual, False
    hours = own / timedelta(hours=1)
    if offset is not None and not is_usual:
        zone = timezone(timedelta(hours=offset))
        return [moment.astimezone(zone) for moment in moments], offset, True, False
    has_changes = any(moment.utcoffset() != own for moment in moments)
    first = [moment.astimezone(moments[0].tzinfo) for moment in moments]
    return first, hours, hours != 0.0 or has_changes, has_changes


def _json(text: str, name: str) -> Any:
    try:
        return json.loads(text)
    except json.JSONDecodeError as error:
        raise InputError(
            f"{name} cannot be read: it is no JSON in line {error.lineno}, {error.msg}."
        ) from error
    except (RecursionError, ValueError) as error:
        raise InputError(f"{name} cannot be read: its JSON is too deep or too large.") from error


def _place(content: Any, name: str) -> _Place:
    """What JSON says of the place.

    Raises
    ------
    InputError
        If its offset from universal time is out of range.
    """
    told = _named(content, OFFSETS)
    if told is None:
        return _Place(longitude=_degrees(content))
    seconds = 3600.0 * MOST_OFFSET
    if isinstance(told, bool) or not isinstance(told, int | float) or not abs(told) <= seconds:
        raise InputError(
            f"{name} has an offset from UTC of {_written(told)}; allowed is -{seconds:g} to "
            f"{seconds:g} seconds."
        )
    zone = _named(content, ("timezone",))
    return _Place(told / 3600.0, zone if isinstance(zone, str) else "", _degrees(content))


def _degrees(content: Any) -> float | None:
    told = _named(content, LONGITUDES)
    is_number = isinstance(told, int | float) and not isinstance(told, bool)
    return float(told) if is_number and -180.0 <= told <= 180.0 else None


def _written(given: Any) -> str:
    """A value as JSON writes it, words in quotes, and at most 60 letters of it."""
    if given is None or isinstance(given, bool):
        return json.dumps(given)
    return repr(shown(str(given)[:60]))


def _of_json(content: Any, name: str) -> tuple[list[Any], list[Any]]:
    """Times and indices, of equal length; None for an index that is missing."""
    for held in (content, *(_named(content, (key,)) for key in UNDER)):
        times, indices = _named(held, TIMES), _named(held, INDICES)
        if isinstance(times, list) and isinstance(indices, list):
            if len(times) != len(indices):
                raise InputError(
                    f"{name} has {len(times)} times and {len(indices)} UV indices; allowed are as "
                    "many."
                )
            return times, indices
        if isinstance(held, list) and held and all(isinstance(entry, dict) for entry in held):
            return [_named(entry, TIMES) for entry in held], [
                _named(entry, INDICES) for entry in held
            ]
    if _named(content, ("daily",)) is not None:
        raise InputError(
            f"{name} has UV indices of whole days; needed are those of hours, since a day's "
            "greatest index alone says no dose."
        )
    raise InputError(
        f"{name} has no times and UV indices; expected are lists called time and uv_index, or a "
        "list of objects with both."
    )


def _named(held: Any, names: Sequence[str]) -> Any:
    """What an object holds under the first of some names that it has; None for none."""
    if not isinstance(held, dict):
        return None
    small = {key.casefold(): value for key, value in held.items()}
    return next((small[name] for name in names if name in small), None)


def _moment(name: str, given: Any, place: str) -> datetime:
    """A time of the years 1900 to 2100."""
    told = _time(given)
    if told is None:
        raise InputError(
            f"{name} has a time of {_written(given)} in {place}; expected one such as "
            "2025-06-21T10:00."
        )
    if not FIRST_YEAR <= told.year <= LAST_YEAR:
        raise InputError(
            f"{name} has a time of {_written(given)} in {place}; allowed are the years "
            f"{FIRST_YEAR} to {LAST_YEAR}."
        )
    return told


def _time(given: Any) -> datetime | None:
    """A time as ISO 8601 has it, as `Jun/21/2025 06 AM`, or seconds since 1970; None if none."""
    if isinstance(given, int | float) and not isinstance(given, bool):
        try:
            return datetime.fromtimestamp(given, UTC)
        except (ValueError, OverflowError, OSError):
            return None
    if isinstance(given, str):
        for read in (datetime.fromisoformat, lambda text: datetime.strptime(text, EPA)):  # noqa: DTZ007
            try:
                return read(given.strip())
            except ValueError:
                continue
    return None


EPA = "%b/%d/%Y %I %p"


def _index(name: str, given: Any, place: str) -> float:
    if isinstance(given, bool) or not isinstance(given, int | float):
        raise InputError(
            f"{name} has a UV index of {_written(given)} in {place}; expected a number."
        )
    if not 0.0 <= given <= MOST_INDEX:
        raise InputError(
            f"{name} has a UV index of {str(given)[:60]} in {place}; allowed is 0 to "
            f"{MOST_INDEX:g}."
        )
    return float(given)


def _require_order(name: str, moments: Sequence[datetime], places: Sequence[str]) -> None:
    """Raise InputError where some times lack an offset, or they do not ascend, or too far."""
    for before, after, place in zip(moments[:-1], moments[1:], places[1:], strict=True):
        if (before.tzinfo is None) != (after.tzinfo is None):
            raise InputError(
                f"{name} has a time of {after.isoformat()} in {place} after "
                f"{before.isoformat()}; allowed is an offset from UTC in all times or in none."
            )
        if after <= before:
            raise InputError(
                f"{name} has a time of {after.isoformat()} in {place} after "
                f"{before.isoformat()}; allowed are times that ascend."
            )
    if moments[-1] - moments[0] > timedelta(hours=LONGEST_HOURS):
        raise InputError(
            f"{name} has times from {moments[0].isoformat()} to {moments[-1].isoformat()}; allowed "
            "is a century."
        )
