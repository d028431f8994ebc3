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
    place = _Row.of(name, 1, lines[0])
    latitude = place.number("latitude", 6, -90.0, 90.0)
    longitude = place.number("longitude", 7, -180.0, 180.0)
    offset = place.number("time zone", 8, -14.0, 14.0)
    altitude = place.number("elevation", 9, -500.0, 9000.0)
    first = _headings(lines, name)
    rows: dict[tuple[int, int, int], int] = {}
    radiation, cover, numbers = [], [], []
    for number, line in enumerate(lines[first:], start=first + 1):
        if not line.strip():
            continue
        row = _Row.of(name, number, line)
        hour = _hour(row)
        if hour in rows:
            month, day, begin = hour
            raise InputError(
                f"{name} has the hour {begin + 1} of {month}/{day} in line {number} and in line "
                f"{numbers[rows[hour]]}; allowed is once."
            )
        rows[hour] = len(numbers)
        numbers.append(number)
        radiation.append(row.number_or_nan("global radiation", GLOBAL, 2e3, missing=9999.0))
        cover.append(0.1 * row.number_or_nan("total sky cover", COVER, 10.0, missing=99.0))
    if not numbers:
        raise InputError(f"{name} has no rows after DATA PERIODS; needed is one or more.")
    values = np.array(radiation), np.array(cover), np.array(numbers)
    return Weather(name, latitude, longitude, offset, altitude, rows, *values)


def _headings(lines: Sequence[str], name: str) -> int:
    """Number of lines up to DATA PERIODS, which says that an hour has one row."""
    for number, line in enumerate(lines[:MOST_HEADINGS], start=1):
        row = _Row.of(name, number, line)
        if row.cells[0].casefold() == "data periods":
            row.number("number of rows per hour", 2, 1.0, 1.0)
            return number
    raise InputError(
        f"{name} cannot be read: it has no line DATA PERIODS in its first {MOST_HEADINGS} lines."
    )


def _hour(row: "_Row") -> tuple[int, int, int]:
    """Month, day and the hour that a row begins with, 0 to 23."""
    month, day = row.whole("month", MONTH, 12), row.whole("day", DAY, 31)
    try:
        date(LEAP_YEAR, month, day)
    except ValueError as error:
        raise InputError(
            f"{row.name} has a day of {day} in line {row.line}; month {month} has none."
        ) from error
    return month, day, row.whole("clock hour", HOUR, 24) - 1


@dataclass(frozen=True)
class _Row:
    """Cells of a line of a file; what they hold is named in the sentences that refuse it."""

    name: str
    line: int
    cells: list[str]

    @classmethod
    def of(cls, name: str, line: int, text: str) -> "_Row":
        return cls(name, line, [cell.strip() for cell in text.split(",")])

    def number(self, what: str, column: int, low: float, high: float) -> float:
        value = self._read(what, column)
        if not low <= value <= high:
            allowed = f"{low:g}" if low == high else f"{low:g} to {high:g}"
            raise self._refused(what, f"{value:g}", f"allowed is {allowed}.")
        return value

    def number_or_nan(self, what: str, column: int, most: float, *, missing: float) -> float:
        """A number from 0 to `most`, or nan where it is `missing` or more: there is none."""
        if self._read(what, column) >= missing:
            return np.nan
        return self.number(what, column, 0.0, most)

    def whole(self, what: str, column: int, most: int) -> int:
        """A whole number from 1 to `most`."""
        value = self.number(what, column, 1.0, most)
        if value != int(value):
            raise self._refused(what, f"{value:g}", "allowed are whole numbers.")
        return int(value)

    def _read(self, what: str, column: int) -> float:
        if column >= len(self.cells):
            raise InputError(
                f"{self.name} has {len(self.cells)} cells in line {self.line}; the {what} is cell "
                f"{column + 1}."
            )
        cell = self.cells[column]
        try:
            return float(cell)
        except ValueError as error:
            raise self._refused(what, repr(shown(cell[:60])), "expected a number.") from error

    def _refused(self, what: str, value: str, allowed: str) -> InputError:
        return InputError(f"{self.name} has a {what} of {value} in line {self.line}; {allowed}")
