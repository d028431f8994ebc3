"""Points of time against error of tables, in files and in words."""

import csv
import os
from collections.abc import Sequence
from dataclasses import asdict, dataclass, fields
from importlib.resources import files
from pathlib import Path

import numpy as np

from hylios.errors import InputError
from hylios.files import written_beside
from hylios.readers.quantities import Quantity
from hylios.readers.table import Table, read_table, table_of
from lut_builder.settings import PRESETS, Settings

SHIPPED = "front.csv"
CORES = 2
"""Cores for the seconds by which points are compared."""


@dataclass(frozen=True)
class Point:
    """Time and error of a table.

    Attributes
    ----------
    settings : Settings
    shared_seconds : float
        Of one core, for work that any number of cores share.
    serial_seconds : float
        For work that one core does.
    start_seconds : float
        Besides, for a table of one state.
    delta_e_mean, delta_e_largest : float
        CIEDE2000 from the fine solution, at reachable states that are no knots.
    band_rmse : float
        Of the reflectance in the single bands.
    profile_rms, profile_largest : float
        Of the difference of the light beyond the edge of a lit half plane, as a share, at the
        distance of .1 mm or more where it is largest; 0 without a profile.
    profile_lightness : float
        The most that such a share missing changes the lightness L* of what is lit from one side.
    """

    settings: Settings
    shared_seconds: float
    serial_seconds: float
    start_seconds: float
    delta_e_mean: float
    delta_e_largest: float
    band_rmse: float
    profile_rms: float = 0.0
    profile_largest: float = 0.0
    profile_lightness: float = 0.0

    def seconds(self, cores: int = CORES) -> float:
        """Seconds on so many cores of the machine that measured."""
        return self.start_seconds + self.serial_seconds + self.shared_seconds / cores

    @property
    def error(self) -> float:
        """Largest difference in CIEDE2000, of the colour and what the profile can do to it.

        Their errors are independent: the root of the sum of squares. Differences of L* count as
        they are, which is no less than CIEDE2000 makes of them.
        """
        return float(np.hypot(self.delta_e_largest, self.profile_lightness))


def named(point: Point) -> str:
    """The preset that a point is, or nothing."""
    return next((name for name, preset in PRESETS.items() if preset == point.settings), "")


def described(point: Point, cores: int = CORES) -> str:
    """One line on a point: its settings, time and error."""
    made = point.settings
    text = f"knots {','.join(map(str, made.knots))} {made.interpolation}"
    text += f", {made.colour_wavelengths} wavelengths, {made.nodes} nodes"
    if made.has_profile:
        text += f", profile {made.profile_error:g} at {made.profile_wavelengths} wavelengths"
        text += f" of {made.profile_states} states"
    text += f": {point.seconds(cores):.1f} s on {cores} core{'s' if cores > 1 else ''}"
    text += f", CIEDE2000 mean {point.delta_e_mean:.3f}, largest {point.delta_e_largest:.3f}"
    if made.has_profile:
        text += f"; light beyond an edge {point.profile_largest:.4f} at most off"
        text += f", which is {point.profile_lightness:.2f} of L*"
    name = named(point)
    return f"{text} ({name})" if name else text


TRADED = (
    "knots",
    "interpolation",
    "colour_wavelengths",
    "nodes",
    "profile_error",
    "profile_wavelengths",
    "profile_states",
)
"""Settings that a front's file tells; the others are the defaults."""

LARGEST = 1e9
"""Seconds or errors that a front may tell."""

NUMBERS = tuple(field.name for field in fields(Point))[1:]
"""Columns of a front's file besides the settings."""


def write_points(path: Path, points: Sequence[Point], notes: Sequence[str]) -> None:
    """Write points as CSV, after lines of notes that start with #.

    Raises
    ------
    InputError
        If the file cannot be written.
    """
    rows = []
    for point in points:
        made = asdict(point.settings)
        told = {name: made[name] for name in TRADED} | {"knots": " ".join(map(str, made["knots"]))}
        told |= {name: f"{getattr(point, name):.6g}" for name in NUMBERS}
        told |= {"seconds_2_cores": f"{point.seconds():.4g}", "preset": named(point)}
        rows.append(told)
    write_rows(path, rows, notes)


def write_rows(path: Path, rows: Sequence[dict], notes: Sequence[str]) -> None:
    """Write rows with the same columns as CSV, after lines of notes that start with #."""
    with written_beside(path) as beside, beside.open("w", encoding="utf-8", newline="") as file:
        file.writelines(f"# {note}\n" for note in notes)
        writer = csv.DictWriter(file, list(rows[0]), lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)


def read_points(path: Path) -> list[Point]:
    """Points that `write_points` wrote.

    Raises
    ------
    InputError
        If the file cannot be read or is no such.
    """
    return _points(read_table(path, COLUMNS))


def shipped_points() -> list[Point]:
    """The front that the package ships; its file says of which machine and skin."""
    text = (files("lut_builder.trade") / SHIPPED).read_text(encoding="utf-8")
    return _points(table_of(text.splitlines(), SHIPPED, COLUMNS))


COLUMNS = (
    *(Quantity(name, is_text=True) for name in TRADED),
    *(Quantity(name) for name in NUMBERS),
)


def _points(table: Table) -> list[Point]:
    numbers = {name: table.require_range(name, 0.0, LARGEST) for name in NUMBERS}
    points = []
    for row, line in enumerate(table.lines):
        try:
            made = _settings({name: table.texts[name][row] for name in TRADED})
        except ValueError as error:
            raise InputError(
                f"{table.name} is no front of lut-builder trade; in line {line} "
                f"{str(error).rstrip('.')}."
            ) from error
        points.append(Point(made, **{name: float(numbers[name][row]) for name in NUMBERS}))
    if not points:
        raise InputError(f"{table.name} has no table; a front needs at least one row.")
    return points


def _settings(row: dict[str, str]) -> Settings:
    return Settings(
        knots=tuple(int(count) for count in row["knots"].split()),
        interpolation=row["interpolation"],
        colour_wavelengths=int(row["colour_wavelengths"]),
        nodes=int(row["nodes"]),
        profile_error=float(row["profile_error"]),
        profile_wavelengths=int(row["profile_wavelengths"]),
        profile_states=int(row["profile_states"]),
    )


def usable_cores(threads: int | None) -> int:
    """Cores that work can be shared by: so many threads, but no more than there are."""
    there = os.cpu_count() or 1
    return min(threads or there, there)
