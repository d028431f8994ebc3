"""What a comparison found: readings one by one, and rows of the table with what is allowed."""

import csv
import dataclasses
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from hylios.files import written_beside

CIEDE2000 = "CIEDE2000"


@dataclass(frozen=True)
class Reading:
    """What one case shows beside what the model says of it.

    Attributes
    ----------
    row : str
        Name of the comparison.
    case : str
    shown, said : (N, 3) arrays
        Linear Rec.709 where nothing else is said; one place or many.
    distance : (N,) array
        Between the two.
    places : (N,) array
        Where: mm from an edge, say; not a number where there is one place.
    """

    row: str
    case: str
    shown: np.ndarray
    said: np.ndarray
    distance: np.ndarray
    places: np.ndarray = field(default_factory=lambda: np.full(1, np.nan))

    @property
    def mean(self) -> float:
        """Mean distance over the places."""
        return float(self.distance.mean())


@dataclass(frozen=True)
class Row:
    """A line of the table.

    Attributes
    ----------
    name : str
        Of the comparison that it belongs to.
    what, unit : str
    mean, largest : float
        Over the cases.
    allowed_mean, allowed_largest : float or None
        None where nothing is asked.
    remark : str
    """

    name: str
    what: str
    unit: str
    mean: float
    largest: float
    allowed_mean: float | None = None
    allowed_largest: float | None = None
    remark: str = ""

    @classmethod
    def of(
        cls,
        readings: Sequence[Reading],
        what: str,
        allowed: tuple[float | None, float | None] = (None, None),
        unit: str = CIEDE2000,
        remark: str = "",
    ) -> "Row":
        """The row of readings; where one has many places, its mean counts."""
        means = [reading.mean for reading in readings]
        mean, largest = float(np.mean(means)), float(np.max(means))
        return cls(readings[0].row, what, unit, mean, largest, *allowed, remark)

    @property
    def met(self) -> bool | None:
        """Whether the row is within what is allowed; None where nothing is asked."""
        pairs = ((self.mean, self.allowed_mean), (self.largest, self.allowed_largest))
        within = [value <= allowed for value, allowed in pairs if allowed is not None]
        return all(within) if within else None


@dataclass(frozen=True)
class Outcome:
    """Rows and readings of a comparison."""

    rows: Sequence[Row]
    readings: Sequence[Reading] = ()


DESCRIBED = ("blender", "machine", "date", "seconds")
"""Columns of `write_rows` before those of a row."""

HEAD = ("what", "unit", "allowed", "mean", "largest", "met")


def cells(row: Row) -> tuple[str, ...]:
    """A row as texts, one to each of `HEAD`."""
    limits = (row.allowed_mean, row.allowed_largest)
    allowed = " / ".join("-" if value is None else f"{value:g}" for value in limits)
    met = {None: "stated", True: "yes", False: "**no**"}[row.met]
    what = f"{row.what} ({row.remark})" if row.remark else row.what
    return what, row.unit, allowed, f"{row.mean:.3f}", f"{row.largest:.3f}", met


def table(rows: Iterable[Row]) -> str:
    """All rows to print."""
    lines = [HEAD, *(cells(row) for row in rows)]
    widths = [max(len(line[column]) for line in lines) for column in range(len(HEAD))]
    return "\n".join(
        "  ".join(cell.ljust(width) for cell, width in zip(line, widths, strict=True)).rstrip()
        for line in lines
    )


def markdown(columns: Mapping[str, Sequence[Row]]) -> str:
    """Rows as a table of Markdown; each run by its heading has columns, the first all rows."""
    first, *others = columns.values()
    runs = [{row.what: cells(row)[3:] for row in rows} for rows in others]
    head = [*HEAD[:3], *(f"{HEAD[3]} / {HEAD[4]}, {name} | {HEAD[5]}" for name in columns)]
    lines = [head, ["---"] * (3 + 2 * len(columns))]
    for row in first:
        line, *numbers = [*cells(row)[:3]], cells(row)[3:]
        numbers += [run.get(row.what, ("", "", "")) for run in runs]
        lines.append([*line, *(f"{mean} / {most} | {met}" for mean, most, met in numbers)])
    return "\n".join(f"| {' | '.join(line)} |" for line in lines) + "\n"


def read_rows(path: Path) -> tuple[dict[str, str], list[Row]]:
    """What a run's rows share, and the rows, from the file of `write_rows`."""
    with path.open(newline="") as file:
        lines = list(csv.DictReader(file))
    numbers = ("mean", "largest", "allowed_mean", "allowed_largest")
    rows = [
        Row(
            **{name: line[name] for name in ("name", "what", "unit", "remark")},
            **{name: float(line[name]) if line[name] else None for name in numbers},
        )
        for line in lines
    ]
    return {name: lines[0][name] for name in DESCRIBED}, rows


def write_rows(path: Path, rows: Iterable[Row], described: Mapping[str, str]) -> None:
    """Write the table as CSV; `described` has what all rows share, by `DESCRIBED`."""
    fields = [field.name for field in dataclasses.fields(Row)] + ["met"]
    with written_beside(path) as beside, beside.open("w", newline="") as file:
        writer = csv.writer(file)
        writer.writerow([*described, *fields])
        for row in rows:
            values = (getattr(row, name) for name in fields)
            writer.writerow([*described.values(), *map(_written, values)])


def write_readings(path: Path, readings: Iterable[Reading]) -> None:
    """Write every reading as CSV, a line for each place."""
    channels = [f"{source}_{name}" for source in ("shown", "said") for name in "rgb"]
    with written_beside(path) as beside, beside.open("w", newline="") as file:
        writer = csv.writer(file)
        writer.writerow(["name", "case", "place", *channels, "distance"])
        for reading in readings:
            lines = zip(reading.places, reading.shown, reading.said, reading.distance, strict=True)
            for place, shown, said, distance in lines:
                numbers = [place, *shown, *said, distance]
                writer.writerow([reading.row, reading.case, *map(_written, numbers)])


def _written(value) -> str:
    if value is None or value != value:
        return ""
    return str(value) if isinstance(value, str | bool) else f"{value:.6g}"
