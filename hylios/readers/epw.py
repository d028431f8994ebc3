"""Hourly weather of a year at a place, in EnergyPlus's weather files (EPW).

The format is CSV with fixed columns (EnergyPlus, Auxiliary Programs: Weather Data Format
Description): a line LOCATION, further headings of which DATA PERIODS is the last, and a row for
every hour in the standard time of the place. Read are the radiation on level ground and the clouds.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from datetime import date
from pathlib import Path

import numpy as np

from hylios.errors import InputError, shown
from hylios.readers.text import lines_of, name_of

MONTH, DAY, HOUR, GLOBAL, COVER = 1, 2, 3, 13, 22
"""Columns, from 0."""

MOST_HEADINGS = 30
LEAP_YEAR = 2000


@dataclass(frozen=True, eq=False)
class Weather:
    """A year's weather at a place, or a part of one.

    Attributes
    ----------
    name : str
        Of its file, as sentences call it.
    latitude, longitude : float
        Degrees, north and east positive.
    utc_offset : float
        Of its clock, hours, without daylight saving.
    altitude : float
        m.
    rows : dict of (int, int, int) to int
        Rows by month, day and hour, 0 to 23, that begins it.
    radiation : (N,) array
        Global radiation on level ground in the hour, Wh/m^2; nan where it is missing.
    cover : (N,) array
        Share of the sky that is covered, 0 to 1; nan where it is missing.
    lines : (N,) int array
        Where each row stands in the file.
    """

    name: str
    latitude: float
    longitude: float
    utc_offset: float
    altitude: float
    rows: dict[tuple[int, int, int], int]
    radiation: np.ndarray
    cover: np.ndarray
    lines: np.ndarray


def is_epw(lines: Sequence[str]) -> bool:
    """Whether lines are such a file's."""
    return bool(lines) and lines[0].casefold().lstrip().startswith("location,")


def read_epw(path: Path) -> Weather:
    """Read such a file; the path `-` is standard input.

    Raises
    ------
    InputError
        If it cannot be read, has no LOCATION or DATA PERIODS, more than one row for an hour, or a
        value that is out of range.
    """
    return epw_of(lines_of(path), name_of(path))


def epw_of(lines: Sequence[str], name: str) -> Weather:
    """Weather from lines of text; the rest as in `read_epw`."""
    if not is_epw(lines):
        raise InputError(f"{name} cannot be read: its first line is not LOCATION of an EPW file.")
    place = _cells(lines[0])
    latitude, longitude, offset, altitude = (
        _number(name, what, place, column, 1, low, high)
        for what, column, low, high in (
            ("latitude", 6, -90.0, 90.0),
            ("longitude", 7, -180.0, 180.0),
            ("time zone", 8, -14.0, 14.0),
            ("elevation", 9, -500.0, 9000.0),
        )
    )
    first = _first_row(lines, name)
    rows: dict[tuple[int, int, int], int] = {}
    radiation, cover, numbers = [], [], []
    for number, line in enumerate(lines[first:], start=first + 1):
        if not line.strip():
            continue
        cells = _cells(line)
        hour = _hour(name, cells, number)
        if hour in rows:
            month, day, begin = hour
            raise InputError(
                f"{name} has the hour {begin + 1} of {month}/{day} in line {number} and in line "
                f"{numbers[rows[hour]]}; allowed is once."
            )
        rows[hour] = len(numbers)
        numbers.append(number)
        radiation.append(_or_missing(name, "global radiation", cells, GLOBAL, number, 2e3, 9999.0))
        cover.append(0.1 * _or_missing(name, "total sky cover", cells, COVER, number, 10.0, 99.0))
    if not numbers:
        raise InputError(f"{name} has no rows after DATA PERIODS; needed is one or more.")
    values = np.array(radiation), np.array(cover), np.array(numbers)
    return Weather(name, latitude, longitude, offset, altitude, rows, *values)


def _first_row(lines: Sequence[str], name: str) -> int:
    """Number of lines up to DATA PERIODS, which says that an hour has one row."""
    for number, line in enumerate(lines[:MOST_HEADINGS], start=1):
        cells = _cells(line)
        if cells[0].casefold() == "data periods":
            _number(name, "number of rows per hour", cells, 2, number, 1.0, 1.0)
            return number
    raise InputError(
        f"{name} cannot be read: it has no line DATA PERIODS in its first {MOST_HEADINGS} lines."
    )


def _hour(name: str, cells: Sequence[str], line: int) -> tuple[int, int, int]:
    """Month, day and the hour that a row begins with, 0 to 23."""
    month = _whole(name, "month", cells, MONTH, line, 12)
    day = _whole(name, "day", cells, DAY, line, 31)
    try:
        date(LEAP_YEAR, month, day)
    except ValueError as error:
        raise InputError(
            f"{name} has a day of {day} in line {line}; month {month} has none."
        ) from error
    return month, day, _whole(name, "clock hour", cells, HOUR, line, 24) - 1


def _cells(line: str) -> list[str]:
    return [cell.strip() for cell in line.split(",")]


def _number(
    name: str, what: str, cells: Sequence[str], column: int, line: int, low: float, high: float
) -> float:
    value = _read(name, what, cells, column, line)
    if not low <= value <= high:
        allowed = f"{low:g}" if low == high else f"{low:g} to {high:g}"
        raise InputError(f"{name} has a {what} of {value:g} in line {line}; allowed is {allowed}.")
    return value


def _read(name: str, what: str, cells: Sequence[str], column: int, line: int) -> float:
    if column >= len(cells):
        raise InputError(
            f"{name} has {len(cells)} cells in line {line}; the {what} is cell {column + 1}."
        )
    try:
        return float(cells[column])
    except ValueError as error:
        raise InputError(
            f"{name} has a {what} of {shown(cells[column][:60])!r} in line {line}; expected a "
            "number."
        ) from error


def _whole(name: str, what: str, cells: Sequence[str], column: int, line: int, most: int) -> int:
    value = _number(name, what, cells, column, line, 1.0, most)
    if value != int(value):
        raise InputError(
            f"{name} has a {what} of {value:g} in line {line}; allowed are whole numbers."
        )
    return int(value)


def _or_missing(
    name: str, what: str, cells: Sequence[str], column: int, line: int, most: float, missing: float
) -> float:
    """A number from 0 to `most`, or nan where it is `missing` or more, which stands for none."""
    if _read(name, what, cells, column, line) >= missing:
        return np.nan
    return _number(name, what, cells, column, line, 0.0, most)
