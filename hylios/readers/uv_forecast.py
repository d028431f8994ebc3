"""UV indices by time, as services forecast them and meters keep them: CSV or JSON.

CSV has columns of a time and of an index. JSON is a list of objects with both, or an object of two
lists, itself or under a key: as Open-Meteo (`hourly`), OpenUV (`result`), OpenWeather (`hourly`, in
seconds since 1970) and the US Environmental Protection Agency have them.
"""

import json
from collections.abc import Sequence
from dataclasses import dataclass
from datetime import UTC, date, datetime, timedelta
from pathlib import Path
from typing import Any

import numpy as np

from hylios.errors import InputError, shown
from hylios.readers.quantities import Quantity
from hylios.readers.table import table_of
from hylios.readers.text import lines_of, name_of
from hylios.tanning import LONGEST_HOURS

MOST_INDEX = 50.0
TIMES = ("time", "date_time", "datetime", "uv_time", "timestamp", "valid_time", "dt", "hour")
INDICES = ("uv_index", "uvi", "uv", "uv index", "uv_value", "uvindex")
UNDER = ("hourly", "result", "data", "forecast", "list")
"""Names, in small letters, of times, of indices, and of what holds them."""

TIME = Quantity("time", TIMES, is_text=True)
INDEX = Quantity("uv_index", INDICES)


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
    """

    name: str
    day: date
    hours: np.ndarray
    indices: np.ndarray


def read_forecast(path: Path) -> Forecast:
    """Read such a file; the path `-` is standard input.

    Raises
    ------
    InputError
        If it cannot be read, has no times or indices, times that do not ascend or are of different
        clocks, or an index that is out of range.
    """
    return forecast_of(lines_of(path), name_of(path))


def forecast_of(lines: Sequence[str], name: str) -> Forecast:
    """A forecast from lines of text; the rest as in `read_forecast`."""
    text = "\n".join(lines)
    if text.lstrip()[:1] in ("{", "["):
        times, indices = _of_json(text, name)
        places = [f"entry {number}" for number in range(1, len(times) + 1)]
    else:
        table = table_of(lines, name, (TIME, INDEX))
        times, indices = table.texts[TIME.name], table.numbers[INDEX.name].tolist()
        places = [f"line {line}" for line in table.lines]
    if len(times) < 2:
        raise InputError(f"{name} has {len(times)} UV indices; needed are two or more.")
    moments = [_moment(name, *both) for both in zip(times, places, strict=True)]
    values = [_index(name, *both) for both in zip(indices, places, strict=True)]
    _require_order(name, moments, places)
    day = moments[0].date()
    midnight = datetime(day.year, day.month, day.day, tzinfo=moments[0].tzinfo)
    hours = [(moment - midnight) / timedelta(hours=1) for moment in moments]
    return Forecast(name, day, np.array(hours), np.array(values))


def _of_json(text: str, name: str) -> tuple[list[Any], list[Any]]:
    """Times and indices, of equal length."""
    try:
        content = json.loads(text)
    except json.JSONDecodeError as error:
        raise InputError(
            f"{name} cannot be read: it is no JSON in line {error.lineno}, {error.msg}."
        ) from error
    except (RecursionError, ValueError) as error:
        raise InputError(f"{name} cannot be read: its JSON is too deep or too large.") from error
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
    """A time as ISO 8601 has it, as `Jun/21/2025 06 AM`, or seconds since 1970."""
    if isinstance(given, int | float) and not isinstance(given, bool):
        try:
            return datetime.fromtimestamp(given, UTC)
        except (ValueError, OverflowError, OSError):
            pass
    if isinstance(given, str):
        for read in (datetime.fromisoformat, lambda text: datetime.strptime(text, EPA)):  # noqa: DTZ007
            try:
                return read(given.strip())
            except ValueError:
                continue
    raise InputError(
        f"{name} has a time of {shown(str(given)[:60])!r} in {place}; expected one such as "
        "2025-06-21T10:00."
    )


EPA = "%b/%d/%Y %I %p"


def _index(name: str, given: Any, place: str) -> float:
    if isinstance(given, bool) or not isinstance(given, int | float):
        raise InputError(
            f"{name} has a UV index of {shown(str(given)[:60])!r} in {place}; expected a number."
        )
    if not 0.0 <= given <= MOST_INDEX:
        raise InputError(
            f"{name} has a UV index of {str(given)[:60]} in {place}; allowed is 0 to "
            f"{MOST_INDEX:g}."
        )
    return float(given)


def _require_order(name: str, moments: Sequence[datetime], places: Sequence[str]) -> None:
    """Raise InputError where times are of different clocks or do not ascend, or too far."""
    for before, after, place in zip(moments[:-1], moments[1:], places[1:], strict=True):
        if (before.tzinfo is None) != (after.tzinfo is None) or (
            before.utcoffset() != after.utcoffset()
        ):
            raise InputError(
                f"{name} has a time of {after.isoformat()} in {place} after "
                f"{before.isoformat()}; allowed is one offset from UTC."
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
