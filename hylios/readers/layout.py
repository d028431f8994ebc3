"""How a text is laid out: what separates its cells, where its header is, which rows are data."""

import csv
import math
import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

from hylios.errors import InputError, shown
from hylios.readers.quantities import KNOWN_UNITS, Quantity, place, unit

SEPARATORS = ("\t", ";", ",", " ")
"""What may part cells; blanks may be several, and part cells only where nothing else does."""

END_MARKS = (">>>>>End", "END_DATA")
"""Lines with which instruments end their rows begin so."""

TITLES_SHOWN = 12

NUMBER = re.compile(r"[+-]?(\d+(\.\d*|,\d+)?|\.\d+)(e[+-]?\d+)?", re.ASCII | re.IGNORECASE)
NUMBERS_START = re.compile(r"[<>~±]?\s*[+-]?[.,]?\d")
NOT_FINITE = re.compile(r"[+-]?(nan|inf|infinity)", re.IGNORECASE)


class NoHeaderError(InputError):
    """With a separator no header can be seen; with another one there may be."""


@dataclass(frozen=True)
class Row:
    """The cells of one row, without blanks around them, and the number of its last line."""

    line: int
    cells: tuple[str, ...]

    @property
    def is_empty(self) -> bool:
        """Whether it holds nothing, as the rows with which spreadsheets fill up."""
        return not any(self.cells)


@dataclass(frozen=True)
class Layout:
    """A header's titles and the rows below it, each with as many cells."""

    titles: tuple[str, ...]
    rows: tuple[Row, ...]
    has_header: bool = True


def is_number(cell: str) -> bool:
    """Whether a cell is a number, be its decimal mark a point or a comma, or is meant as one."""
    return bool(NUMBER.fullmatch(cell) or NOT_FINITE.fullmatch(cell))


def finite_number(cell: str, line: int) -> float:
    """A number with a decimal point; InputError where a cell is none."""
    if not NUMBER.fullmatch(cell) or "," in cell or not math.isfinite(float(cell)):
        raise InputError(f"line {line} has {shown(cell[:60])!r}; expected a number")
    return float(cell)


def laid_out(
    lines: Sequence[str],
    separator: str,
    needed: Sequence[Quantity],
    as_pair: tuple[Quantity, Quantity] | None,
) -> Layout:
    """Header and rows of some lines with one separator.

    Lines before the header, empty rows and lines that start with # are passed over, and so is text
    below the rows (`_without_text_below`). The header is the first row with titles for all that is
    needed; a second row of units below it is added to it. Without such a row, two columns of
    numbers will do where they can be a pair.

    Raises
    ------
    NoHeaderError
        If there is none and there are not two columns of numbers.
    InputError
        If a row has more or fewer cells than the header, or a quoted cell does not end.
    """
    rows = list(_rows(lines, separator))
    for number, row in enumerate(rows):
        if not row.is_empty and len(row.cells) > 1 and not _missing(row, needed):
            _require_no_data(rows[:number], len(row.cells))
            return _with_units(row.cells, _without_text_below(rows[number + 1 :]))
    first = next((number for number, row in enumerate(rows) if _is_data(row)), len(rows))
    _require_no_header(_filled(rows[:first]), needed)
    if as_pair is None or first == len(rows) or len(rows[first].cells) != 2:
        raise NoHeaderError(_without(_filled(rows), needed))
    _require_no_data(rows[:first], 2)
    pair = tuple(quantity.name for quantity in as_pair)
    return replace(_fitting(pair, _without_text_below(rows[first:])), has_header=False)


def _rows(lines: Sequence[str], separator: str) -> Iterator[Row]:
    """Rows of lines that are no comments, up to a mark of their end."""
    here = 0

    def kept() -> Iterator[str]:
        nonlocal here
        for number, text in enumerate(lines, start=1):
            here = number
            if text.startswith(END_MARKS):
                return
            if not text.lstrip().startswith("#"):
                yield text if separator != " " else " ".join(text.split())

    reader = csv.reader(kept(), delimiter=separator, strict=True, skipinitialspace=True)
    while True:
        try:
            cells = next(reader)
        except StopIteration:
            return
        except csv.Error as error:
            raise InputError(f"line {here}: {error}") from error
        yield Row(here, tuple(cell.strip() for cell in cells))


def _without_text_below(rows: Sequence[Row]) -> list[Row]:
    """Rows that are not empty, up to where text begins below numbers.

    An empty row parts it from them, and no cell of it starts as a number does: the logs below the
    spectra of Cary's and other instruments are such. Text with a number in it stays, and so is
    refused as a row that does not fit.
    """
    last = max((at for at, row in enumerate(rows) if _starts_with_number(row)), default=None)
    if last is not None and last + 1 < len(rows) and rows[last + 1].is_empty:
        rows = rows[: last + 1]
    return _filled(rows)


def _filled(rows: Sequence[Row]) -> list[Row]:
    return [row for row in rows if not row.is_empty]


def _starts_with_number(row: Row) -> bool:
    return any(NUMBERS_START.match(cell) or NOT_FINITE.fullmatch(cell) for cell in row.cells)


def _missing(row: Row, needed: Sequence[Quantity]) -> list[Quantity]:
    """What is needed and not named in a row; a column that is there twice is there."""
    missing = []
    for quantity in needed:
        try:
            if place(row.cells, quantity) is None:
                missing.append(quantity)
        except InputError:
            pass
    return missing


def _is_data(row: Row) -> bool:
    return not row.is_empty and len(row.cells) > 1 and all(map(is_number, filter(None, row.cells)))


def _require_no_data(above: Sequence[Row], count: int) -> None:
    """Raise InputError where what would be passed over looks like a row of so many cells."""
    for row in above:
        if len(row.cells) == count and is_number(row.cells[0]):
            raise InputError(f"line {row.line} is neither a header nor a row of numbers")


def _require_no_header(above: Sequence[Row], needed: Sequence[Quantity]) -> None:
    """Raise InputError where the row above numbers is a header that lacks something."""
    if above and len(_missing(above[-1], needed)) < max(len(needed), 1):
        raise InputError(_without(above[-1:], needed))


def _without(rows: Sequence[Row], needed: Sequence[Quantity]) -> str:
    """Which column a header lacks, or the first row where none is to be seen."""
    if not rows:
        return "it is empty"
    titles = rows[0].cells
    missing = (_missing(rows[0], needed) or needed)[0].name
    there = ", ".join(shown(repr(title[:40])) for title in titles[:TITLES_SHOWN])
    names = ",".join(quantity.name for quantity in needed)
    return f"it has no column {missing}; needed is {names}, and there is {there}"


def _with_units(titles: tuple[str, ...], rows: Sequence[Row]) -> Layout:
    """The layout below a header, whose next row may hold the units of its titles."""
    below = [cell.strip("()[] ") for cell in rows[0].cells] if rows else []
    if any(below) and all(unit(cell) in KNOWN_UNITS for cell in below if cell):
        units = [*below, *[""] * len(titles)]
        titles = tuple(
            f"{title} ({given})" if given else title
            for title, given in zip(titles, units, strict=False)
        )
        rows = rows[1:]
    return _fitting(titles, rows)


def _fitting(titles: tuple[str, ...], rows: Sequence[Row]) -> Layout:
    """A layout, if every row has as many cells as the header; empty ones at the end are let go."""
    count = len(titles)
    fitted = []
    for row in rows:
        cells = row.cells[:count]
        if len(cells) < count or any(row.cells[count:]):
            raise InputError(
                f"line {row.line} has {len(row.cells)} cells and the header has {count}; a comma "
                "in a number needs semicolons or tabs between the cells"
            )
        fitted.append(Row(row.line, cells))
    return Layout(titles, tuple(fitted))
