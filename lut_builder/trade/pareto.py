"""Points of time against error, the front among them, and choosing one."""

import csv
import os
from collections.abc import Sequence
from dataclasses import asdict, dataclass, fields
from importlib.resources import files
from pathlib import Path

import numpy as np

from hylios.errors import InputError, require_range
from hylios.files import written_beside
from hylios.readers.quantities import Quantity
from hylios.readers.table import Table, read_table, table_of
from lut_builder.settings import PRESETS, Settings

SHIPPED = "front.csv"
CORES = 2
"""Of the seconds by which points are compared."""

LEAST_GAIN = 0.02
"""Share by which a point of the front has less error than the one before it."""

PRESET_LIMITS = {
    "preview": (0.6, 0.5, 1.5),
    "standard": (30.0, 0.1, 0.3),
    "reference": (600.0, 0.1, 0.3),
}
"""Of presets: seconds on two cores besides the start, and mean and largest CIEDE2000.

What presets may take is 3, 60 and 1200 s with the start; but for the preview, most of which is the
start, half of it is left to slower machines."""


@dataclass(frozen=True)
class Point:
    """What a table costs and is worth.

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
        Of the difference of the share of light that leaves within a distance, at the distance
        where it is largest; 0 without a profile.
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
        """On so many cores of the machine that measured."""
        return self.start_seconds + self.serial_seconds + self.shared_seconds / cores

    @property
    def error(self) -> float:
        """Largest difference in CIEDE2000, of the colour and what the profile can do to it.

        Their errors are independent: the root of the sum of squares. Differences of L* count as
        they are, which is no less than CIEDE2000 makes of them.
        """
        return float(np.hypot(self.delta_e_largest, self.profile_lightness))


def nondominated(seconds: np.ndarray, errors: np.ndarray, gain: float = LEAST_GAIN) -> np.ndarray:
    """Numbers of the points of the front, the fastest first.

    Each has an error smaller by the share `gain` than every faster point's.

    Parameters
    ----------
    seconds, errors : (N,) arrays
    """
    chosen, least = [], np.inf
    for number in np.lexsort((errors, seconds)):
        if errors[number] < (1.0 - gain) * least:
            chosen.append(number)
            least = errors[number]
    return np.array(chosen, dtype=int)


def worst(skins: Sequence[Sequence[Point]]) -> list[Point]:
    """Points that hold for all of some skins: of each table the most time and the largest errors.

    Parameters
    ----------
    skins : sequence of sequence of Point
        The same tables of each skin, in the same order.
    """
    return [
        Point(
            alike[0].settings,
            **{name: max(getattr(each, name) for each in alike) for name in FIGURES},
        )
        for alike in zip(*skins, strict=True)
    ]


def front(points: Sequence[Point]) -> list[Point]:
    """The front of tables with a profile, then that of tables without, each the fastest first."""
    kept = []
    for has_profile in (True, False):
        some = [each for each in points if each.settings.has_profile is has_profile]
        seconds = np.array([each.seconds() for each in some])
        errors = np.array([each.error for each in some])
        kept += [some[number] for number in nondominated(seconds, errors)]
    return kept


def cheapest(points: Sequence[Point], max_delta_e: float, *, cores: int, profile: bool) -> Point:
    """The point that takes the fewest seconds of those with no larger error.

    Raises
    ------
    InputError
        If there is none.
    """
    limit = require_range("largest difference", max_delta_e, 1e-3, 100.0, "CIEDE2000")
    some = _alike(points, profile)
    good = [each for each in some if each.error <= limit]
    if not good:
        least = min(each.error for each in some)
        raise InputError(
            f"largest difference is {limit:g} CIEDE2000; the best table measured has {least:.3g}."
        )
    return min(good, key=lambda each: each.seconds(cores))


def best(points: Sequence[Point], max_seconds: float, *, cores: int, profile: bool) -> Point:
    """The point of least error of those that take no more seconds.

    Raises
    ------
    InputError
        If there is none.
    """
    limit = require_range("time", max_seconds, 1e-3, 1e7, "s")
    some = _alike(points, profile)
    quick = [each for each in some if each.seconds(cores) <= limit]
    if not quick:
        least = min(each.seconds(cores) for each in some)
        raise InputError(
            f"time is {limit:g} s; the fastest table measured takes {least:.2g} s on {cores} cores."
        )
    return min(quick, key=lambda each: each.error)


def presets(points: Sequence[Point]) -> dict[str, Point]:
    """The points that the presets are to be: the best within `PRESET_LIMITS`."""
    start = max(each.start_seconds for each in points)
    chosen = {}
    for name, (seconds, mean, largest) in PRESET_LIMITS.items():
        good = [
            each for each in points if each.delta_e_mean <= mean and each.delta_e_largest <= largest
        ]
        chosen[name] = best(good, start + seconds, cores=CORES, profile=True)
    return chosen


def named(point: Point) -> str:
    """The preset that a point is, or nothing."""
    return next((name for name, each in PRESETS.items() if each == point.settings), "")


def described(point: Point, cores: int = CORES) -> str:
    """One line: what is chosen, its time and its error."""
    made = point.settings
    text = f"knots {','.join(map(str, made.knots))} {made.interpolation}"
    text += f", {made.colour_wavelengths} wavelengths, {made.nodes} nodes"
    if made.has_profile:
        text += f", profile {made.profile_error:g} at {made.profile_wavelengths} wavelengths"
    text += f": {point.seconds(cores):.1f} s on {cores} core{'s' if cores > 1 else ''}"
    text += f", CIEDE2000 mean {point.delta_e_mean:.3f}, largest {point.delta_e_largest:.3f}"
    if made.has_profile:
        text += f"; share within a distance {point.profile_largest:.4f} at most off"
        text += f", which is {point.profile_lightness:.2f} of L*"
    name = named(point)
    return f"{text} ({name})" if name else text


def _alike(points: Sequence[Point], profile: bool) -> list[Point]:
    some = [each for each in points if each.settings.has_profile is profile]
    if not some:
        raise InputError(f"the front has no table with{'' if profile else 'out'} a profile.")
    return some


TRADED = (
    "knots",
    "interpolation",
    "colour_wavelengths",
    "nodes",
    "profile_error",
    "profile_wavelengths",
)
"""Settings that a front's file tells; the others are the defaults."""

LARGEST = 1e9
"""Seconds or errors that a front may tell."""

FIGURES = tuple(each.name for each in fields(Point))[1:]


def write_points(path: Path, points: Sequence[Point], notes: Sequence[str]) -> None:
    """Write points as CSV, after lines of notes that start with #.

    Raises
    ------
    InputError
        If the file cannot be written.
    """
    rows = []
    for each in points:
        made = asdict(each.settings)
        told = {name: made[name] for name in TRADED} | {"knots": " ".join(map(str, made["knots"]))}
        told |= {name: f"{getattr(each, name):.6g}" for name in FIGURES}
        told |= {"seconds_2_cores": f"{each.seconds():.4g}", "preset": named(each)}
        rows.append(told)
    write_rows(path, rows, notes)


def write_rows(path: Path, rows: Sequence[dict], notes: Sequence[str]) -> None:
    """Write rows with the same columns as CSV, after lines of notes that start with #."""
    with written_beside(path) as beside, beside.open("w", encoding="utf-8", newline="") as file:
        file.writelines(f"# {each}\n" for each in notes)
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
    *(Quantity(name) for name in FIGURES),
)


def _points(table: Table) -> list[Point]:
    figures = {name: table.require_range(name, 0.0, LARGEST) for name in FIGURES}
    points = []
    for row, line in enumerate(table.lines):
        try:
            made = _settings({name: table.texts[name][row] for name in TRADED})
        except ValueError as error:
            raise InputError(
                f"{table.name} is no front of lut-builder trade; in line {line} "
                f"{str(error).rstrip('.')}."
            ) from error
        points.append(Point(made, **{name: float(figures[name][row]) for name in FIGURES}))
    return points


def _settings(row: dict[str, str]) -> Settings:
    return Settings(
        knots=tuple(int(count) for count in row["knots"].split()),
        interpolation=row["interpolation"],
        colour_wavelengths=int(row["colour_wavelengths"]),
        nodes=int(row["nodes"]),
        profile_error=float(row["profile_error"]),
        profile_wavelengths=int(row["profile_wavelengths"]),
    )


def usable_cores(threads: int | None) -> int:
    """Cores that work can be shared by: those asked for, but no more than there are."""
    there = os.cpu_count() or 1
    return min(threads or there, there)
