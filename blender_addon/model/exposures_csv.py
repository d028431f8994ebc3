"""A schedule of exposures as CSV, for people and spreadsheets: written, and read in any layout.

What is read and written is by the names of an exposure's settings (`Exposure`, and `name` and
`enabled`). Masks belong to an object and are not in the file.
"""

import csv
import io
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from hylios.errors import InputError, shown
from hylios.history import COLUMNS
from hylios.readers.layout import laid_out
from hylios.readers.quantities import Quantity
from hylios.readers.table import Table, columns_of, table_of
from hylios.readers.text import lines_of, name_of
from hylios.sun.protection import DEEPEST_WATER, GLASS
from hylios.sun.surroundings import GROUNDS

from .doses import require_date, require_hours
from .settings import (
    DOSE_LIMIT,
    DURATION_LIMIT,
    FACTOR_LIMIT,
    LAST_DAY_LIMIT,
    MULTIPLE_LIMIT,
    USUAL_DATE,
    USUAL_HOURS,
    WATER,
)

TITLES = {
    "hours": ("duration", 0.0, DURATION_LIMIT),
    "latitude": ("latitude", -90.0, 90.0),
    "month": ("month", 1, 12),
    "day_of_month": ("day_of_month", 1, 31),
    "from_hour": ("from_hour", 0.0, 24.0),
    "to_hour": ("to_hour", 0.0, 24.0),
    "spf": ("spf", 1.0, FACTOR_LIMIT),
    "mg_cm2": ("sunscreen_amount", 0.0, 20.0),
    "altitude_m": ("altitude", -500.0, 9000.0),
    "cloud_percent": ("cloud", 0.0, 100.0),
    "depth_m": ("depth", 0.0, DEEPEST_WATER),
}
"""Columns of numbers that a row may leave empty: setting, least and largest value."""

AMOUNTS = {
    "SED": ("dose", DOSE_LIMIT),
    "MMD": ("multiple", MULTIPLE_LIMIT),
    "UV_INDEX": ("uv_index", 50.0),
}
"""Settings that hold the amount, and its largest value, by unit; sun of a date has none."""

CHOICES = {
    "ground": {name: name.upper() for name in ("usual", *GROUNDS)},
    "through": {name: name.upper() for name in ("air", *GLASS, "water")},
}
"""Columns of one of some words that a row may leave empty, which are settings too."""

SETTINGS_OF_UNIT = {
    "UV_INDEX": ("hours",),
    "SUN": (
        *("latitude", "month", "day_of_month", "from_hour", "to_hour"),
        *("altitude_m", "cloud_percent"),
    ),
}
"""Columns that count for a unit only."""

UNITS = {
    "": "SED",
    "sed": "SED",
    "mmd": "MMD",
    "tanning doses": "MMD",
    "uv index": "UV_INDEX",
    "uvi": "UV_INDEX",
    "uv": "UV_INDEX",
    "sun": "SUN",
}

ON = {"": True, "yes": True, "on": True, "true": True, "1": True, "x": True}
OFF = {"no": False, "off": False, "false": False, "0": False}

HEADER = ("day", "amount", "unit", *TITLES, *CHOICES, "on", "name")
LATER = ("altitude_m", "cloud_percent", "depth_m", *CHOICES)
FORMER = tuple(title for title in HEADER if title not in LATER)
"""Columns of a file, and those of a version that knew fewer."""

DAY = Quantity("day", ("day",), is_exact=True)
OPTIONAL = tuple(Quantity(title, is_text=True, is_exact=True) for title in HEADER[1:])
SED = Quantity("SED", ("sed", "dose", "dose_sed", "dose (sed)"))

WHOLE = ("month", "day_of_month")


@dataclass(frozen=True)
class ReadSchedule:
    """What a file says.

    Attributes
    ----------
    exposures : tuple of dict
        Of every exposure those settings that the file gives, by their names.
    remarks : tuple of str
        What of the file could not be taken as it is, a sentence each.
    """

    exposures: tuple[dict[str, Any], ...]
    remarks: tuple[str, ...] = ()


def exposures_text(exposures: Iterable[Any]) -> str:
    """The text of a file, which `read_exposures` reads back.

    Parameters
    ----------
    exposures : iterable
        Of anything with an exposure's settings as attributes, and `name` and `enabled`. Settings
        that do not count in an exposure's unit are left empty.
    """
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(HEADER)
    writer.writerows(map(_row, exposures))
    return text.getvalue()


def read_exposures(path: Path) -> ReadSchedule:
    """The exposures of a file.

    Three kinds are taken: as `exposures_text` writes it, where day and amount are enough; two
    columns, day and SED; and what Export for lut-builder writes, whose doses by the hour count as
    SED.

    Raises
    ------
    InputError
        If the file cannot be read or has no row, or a cell has no such value, in a sentence with
        its line.
    """
    lines, name = lines_of(path), name_of(path)
    if all(any(title in line for line in lines) for title in COLUMNS[:2]):
        return _of_doses(table_of(lines, name, [Quantity(title) for title in COLUMNS]))
    table = _own_table(lines, name) or table_of(lines, name, [DAY], (SED, *OPTIONAL))
    days = table.require_range("day", 0.0, LAST_DAY_LIMIT).tolist()
    if "SED" in table.numbers:
        doses = table.require_range("SED", 0.0, DOSE_LIMIT).tolist()
        given = [{"unit": "SED", "dose": dose} for dose in doses]
    elif "amount" in table.texts:
        given = [{} for _ in days]
    else:
        raise InputError(f"{name} has no column amount or SED; needed is one of them.")
    if not days:
        raise InputError(f"{name} holds no time in the sun, only names of columns.")
    read = [
        {"day": day, **more, **_settings(table, row, more)}
        for row, (day, more) in enumerate(zip(days, given, strict=True))
    ]
    return ReadSchedule(tuple(read))


def _own_table(lines: Sequence[str], name: str) -> Table | None:
    """The table of lines that `exposures_text` wrote; None of others.

    A name in it may hold what separates cells elsewhere, so its separator is not searched for.
    """
    if not lines or lines[0].strip() not in (",".join(FORMER), ",".join(HEADER)):
        return None
    try:
        return columns_of(laid_out(lines, ",", [DAY], None), name, (DAY, *OPTIONAL))
    except InputError as error:
        raise InputError(f"{name} cannot be read: {error}.") from error


def _of_doses(table: Table) -> ReadSchedule:
    """Exposures of Export for lut-builder's columns."""
    hours = table.require_range(COLUMNS[0], 0.0, 24.0 * LAST_DAY_LIMIT)
    doses, thickening = (table.require_range(name, 0.0, DOSE_LIMIT) for name in COLUMNS[1:])
    remarks = ()
    if not np.allclose(doses, thickening, rtol=1e-6, atol=0.0):
        remarks = (
            "Doses of sun by date count less for thickness than for melanin; as SED they count "
            "alike, so the skin thickens more.",
        )
    read = ({"day": hour / 24.0, "unit": "SED"} for hour in hours.tolist())
    return ReadSchedule(
        tuple({**own, "dose": dose} for own, dose in zip(read, doses.tolist(), strict=True)),
        remarks,
    )


def _settings(table: Table, row: int, given: Mapping[str, Any]) -> dict[str, Any]:
    """What a row says besides its day, by the names of settings."""
    cells = {title: texts[row].strip() for title, texts in table.texts.items()}
    where = f"{table.name} has in line {table.lines[row]}"
    read: dict[str, Any] = {}
    for title, (setting, least, largest) in TITLES.items():
        if cells.get(title):
            value = _number(where, title, cells[title], least, largest)
            read[setting] = round(value) if title in WHOLE else value
    for title, allowed in CHOICES.items():
        if cells.get(title):
            read[title] = _one_of(where, title, cells[title], allowed)
    if "spf" in read:
        read["sunscreen"] = True
    if not given:
        unit = _one_of(where, "unit", cells.get("unit", ""), UNITS)
        read["unit"] = unit
        if unit in AMOUNTS:
            setting, largest = AMOUNTS[unit]
            read[setting] = _number(where, "amount", cells["amount"], 0.0, largest)
        elif unit == "SUN":
            _require_sun(where, read)
    if "on" in cells:
        read["enabled"] = _one_of(where, "on", cells["on"], ON | OFF)
    if cells.get("name"):
        read["name"] = cells["name"]
    return read


def _require_sun(where: str, read: Mapping[str, Any]) -> None:
    month, day = USUAL_DATE
    first, last = USUAL_HOURS
    try:
        require_date(read.get("month", month), read.get("day_of_month", day))
        require_hours(read.get("from_hour", first), read.get("to_hour", last))
    except InputError as error:
        raise InputError(f"{where} no such sun: {error}") from error


def _number(where: str, title: str, cell: str, least: float, largest: float) -> float:
    try:
        value = float(cell.replace(",", "."))
    except ValueError:
        value = float("nan")
    if not least <= value <= largest or (title in WHOLE and value != round(value)):
        said = f"{shown(cell[:60])!r} as {title}" if cell else f"no {title}"
        kind = "whole numbers from " if title in WHOLE else ""
        raise InputError(f"{where} {said}; allowed is {kind}{least:g} to {largest:g}.")
    return value


def _one_of(where: str, title: str, cell: str, allowed: Mapping[str, Any]) -> Any:
    plain = " ".join(cell.lower().replace("_", " ").split())
    if plain not in allowed:
        names = ", ".join(name for name in allowed if name)
        raise InputError(f"{where} {shown(cell[:60])!r} as {title}; allowed are {names}.")
    return allowed[plain]


def _row(exposure: Any) -> list[str]:
    unit = exposure.unit
    wanted = SETTINGS_OF_UNIT.get(unit, ())
    if exposure.sunscreen:
        wanted = (*wanted, "spf", "mg_cm2")
    cells = {"day": _told(exposure.day), "unit": unit}
    if unit == "SUN":
        cells |= {title: getattr(exposure, title).lower() for title in CHOICES}
        wanted = (*wanted, "depth_m") if exposure.through == WATER else wanted
    if unit in AMOUNTS:
        cells["amount"] = _told(getattr(exposure, AMOUNTS[unit][0]))
    for title in wanted:
        cells[title] = _told(getattr(exposure, TITLES[title][0]))
    cells["on"] = "yes" if exposure.enabled else "no"
    cells["name"] = _line(exposure.name)
    return [cells.get(title, "") for title in HEADER]


def _told(value: float) -> str:
    """A number in the fewest digits: Blender holds single precision."""
    single = np.float32(value)
    return str(single) if float(single) == value else repr(value)


def _line(text: str) -> str:
    printable = (character if character.isprintable() else " " for character in text)
    return " ".join("".join(printable).split())
