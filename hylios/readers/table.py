"""Columns of numbers from a text table in any layout, or a sentence that says what is wrong."""

import re
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from hylios.errors import InputError, shown
from hylios.readers.instruments import without_instruments_words
from hylios.readers.layout import NOT_FINITE, NUMBER, SEPARATORS, Layout, NoHeaderError, laid_out
from hylios.readers.quantities import SHARE, STANDARD_ERROR, WAVELENGTH, Quantity, place
from hylios.readers.text import lines_of, name_of

THOUSANDS = re.compile(r"[+-]?[1-9]\d{0,2},\d{3}", re.ASCII)
"""Numbers with a comma that may mark decimals or thousands."""


NONE = ("", "na", "nan", "null")
"""What cells say, in small letters, that lack a number where they may."""


@dataclass(frozen=True, eq=False)
class Table:
    """Columns of a table that was read, of equal length.

    Attributes
    ----------
    name : str
        Of its file, as sentences call it.
    numbers : dict of str to (N,) array
        Finite numbers in this project's units by `Quantity.name`, nan in cells that lack one where
        they may; of what was welcome those that are there.
    texts : dict of str to list of N str
    lines : (N,) int array
        Where each row stands in the file.
    has_header : bool
        Whether its columns have names in the file.
    notes : tuple of str
        What of the file was left out, a line each.
    """

    name: str
    numbers: dict[str, np.ndarray]
    texts: dict[str, list[str]]
    lines: np.ndarray
    has_header: bool = True
    notes: tuple[str, ...] = ()

    def require_range(self, column: str, low: float, high: float, hint: str = "") -> np.ndarray:
        """A column whose values all lie in [low, high].

        Raises
        ------
        InputError
            If one does not.
        """
        values = self.numbers[column]
        outside = np.flatnonzero(~((values >= low) & (values <= high)))
        if outside.size:
            line, value = self.lines[outside[0]], values[outside[0]]
            raise InputError(
                f"{self.name} has a {column} of {value:g} in line {line}; allowed is {low:g} to "
                f"{high:g}{hint}."
            )
        return values

    def in_order(self, column: str) -> "Table":
        """The table with a column ascending; one that descends is turned round.

        Raises
        ------
        InputError
            If it does neither, or has no rows.
        """
        values = self.numbers[column]
        if not values.size:
            raise InputError(f"{self.name} has no rows; needed is one or more {column}.")
        steps = np.diff(values)
        descends = bool(steps.size) and bool(steps[0] < 0.0)
        wrong = np.flatnonzero((steps >= 0.0) if descends else (steps <= 0.0))
        if wrong.size:
            before, after = values[wrong[0]], values[wrong[0] + 1]
            raise InputError(
                f"{self.name} has a {column} of {after:g} after {before:g} in line "
                f"{self.lines[wrong[0] + 1]}; allowed are values in ascending or in descending "
                "order."
            )
        if not descends:
            return self
        return replace(
            self,
            numbers={name: numbers[::-1] for name, numbers in self.numbers.items()},
            texts={name: texts[::-1] for name, texts in self.texts.items()},
            lines=self.lines[::-1],
        )


def read_table(
    path: Path,
    needed: Sequence[Quantity],
    welcome: Sequence[Quantity] = (),
    as_pair: tuple[Quantity, Quantity] | None = None,
) -> Table:
    """A table from a file, or with the path `-` from standard input.

    Parameters
    ----------
    needed, welcome : sequences of Quantity
        Columns that must be there and that may; others are passed over.
    as_pair : two quantities, optional
        What two columns of numbers without a header are.

    Raises
    ------
    InputError
        If the file cannot be read (`text.lines_of`), lacks a column or has it twice, has a row
        that does not fit, a cell that is empty or no number, or can be read in two ways.
    """
    return table_of(lines_of(path), name_of(path), needed, welcome, as_pair)


def table_of(
    lines: Sequence[str],
    name: str,
    needed: Sequence[Quantity],
    welcome: Sequence[Quantity] = (),
    as_pair: tuple[Quantity, Quantity] | None = None,
) -> Table:
    """A table from lines of text; the rest as in `read_table`."""
    try:
        lines, notes = without_instruments_words(lines)
        return replace(_the_only(*_readings(lines, name, needed, welcome, as_pair)), notes=notes)
    except InputError as error:
        raise InputError(f"{name} cannot be read: {error}.") from error


def _readings(lines, name, needed, welcome, as_pair) -> tuple[list[Table], list[InputError]]:
    """Tables by every separator that occurs in the lines, and why other separators failed."""
    tables, failures = [], []
    occurring = [mark for mark in SEPARATORS if any(mark in line for line in lines)]
    for separator in occurring or [","]:
        try:
            layout = laid_out(lines, separator, needed, as_pair)
            tables.append(columns_of(layout, name, (*needed, *welcome)))
        except InputError as error:
            failures.append(error)
    return tables, failures


def _the_only(tables: Sequence[Table], failures: Sequence[InputError]) -> Table:
    """The table of several readings, if they agree.

    Where a separator shows a header but does not fit the rows, another without a header is no
    reading of the file.
    """
    with_header = [error for error in failures if not isinstance(error, NoHeaderError)]
    if with_header and not any(table.has_header for table in tables):
        raise with_header[0]
    if not tables:
        raise failures[0]
    first, *others = tables
    for other in others:
        alike = first.numbers.keys() == other.numbers.keys() and first.texts == other.texts
        if not alike or not all(
            np.array_equal(first.numbers[title], other.numbers[title], equal_nan=True)
            for title in first.numbers
        ):
            raise InputError("its cells can be separated in two ways; allowed is one separator")
    return first


def columns_of(layout: Layout, name: str, quantities: Sequence[Quantity]) -> Table:
    """The columns of some quantities; InputError says no file's name yet."""
    numbers, texts = {}, {}
    cells, factors = {}, {}
    lacking = {quantity.name for quantity in quantities if quantity.may_lack}
    for quantity in quantities:
        position = place(layout.titles, quantity)
        if position is None:
            continue
        number, unit = position
        column = [(row.line, row.cells[number]) for row in layout.rows]
        if quantity.is_text:
            texts[quantity.name] = [cell for _, cell in column]
        else:
            cells[quantity.name], factors[quantity.name] = column, quantity.units[unit]
    mark = _decimal_mark([cell for column in cells.values() for cell in column])
    for title, column in cells.items():
        times, over = factors[title]
        lacks = np.array([title in lacking and cell.casefold() in NONE for _, cell in column], bool)
        values = np.full(len(column), np.nan)
        values[~lacks] = [
            _number(title, line, cell, mark)
            for (line, cell), lack in zip(column, lacks, strict=True)
            if not lack
        ]
        with np.errstate(over="ignore"):
            numbers[title] = values * times / over
        beyond = np.flatnonzero(~np.isfinite(numbers[title]) & ~lacks)
        if beyond.size:
            line, cell = column[beyond[0]]
            raise InputError(f"{title} in line {line} is {cell[:60]}; allowed are finite numbers")
    if WAVELENGTH in quantities and layout.has_header:
        _require_no_parted_decimals(layout, quantities)
    lines = np.array([row.line for row in layout.rows], dtype=int)
    return Table(name, numbers, texts, lines, layout.has_header)


def _require_no_parted_decimals(layout: Layout, quantities: Sequence[Quantity]) -> None:
    """Raise InputError where a comma between cells may be the decimal one of a number.

    400,0,21 may be 400 and 0.21. So may it where wavelengths, shares of 0 or 1 and what stands
    behind them are whole numbers in all rows, and what is behind is not 0 throughout.
    """
    if layout.separator != "," or not layout.rows:
        return
    for quantity in quantities:
        position = place(layout.titles, quantity)
        if quantity.units is not SHARE or quantity is STANDARD_ERROR or position is None:
            continue
        behind = position[0] + 1
        wavelength = place(layout.titles, WAVELENGTH)
        if wavelength is None or behind in (len(layout.titles), wavelength[0]):
            continue
        rows = [row.cells for row in layout.rows]
        whole = all(
            cells[wavelength[0]].isdecimal()
            and cells[behind - 1] in ("0", "1")
            and cells[behind].isdecimal()
            for cells in rows
        )
        if whole and any(cell.strip("0") for cells in rows for cell in cells[behind:]):
            line = layout.rows[0].line
            raise InputError(
                f"line {line} may be numbers with a decimal comma or with none; write numbers "
                "with a point, or part cells by semicolons"
            )


def _decimal_mark(cells: Sequence[tuple[int, str]]) -> str:
    """The one decimal mark of all numbers; a point where there is none.

    A comma is taken as one only where some number shows that it does not mark thousands.
    """
    with_comma = [(line, cell) for line, cell in cells if "," in cell]
    if not with_comma:
        return "."
    line, cell = with_comma[0]
    if all(THOUSANDS.fullmatch(cell) for _, cell in with_comma):
        raise InputError(
            f"line {line} has the number {cell!r}, whose comma may mark decimals or "
            "thousands; write a point"
        )
    pointed = [(other, number) for other, number in cells if "." in number and "," not in number]
    if pointed:
        raise InputError(
            f"line {line} has the number {shown(cell[:60])!r} and line {pointed[0][0]} "
            f"{shown(pointed[0][1][:60])!r}; allowed is one decimal mark"
        )
    return ","


def _number(title: str, line: int, cell: str, mark: str) -> float:
    if NUMBER.fullmatch(cell):
        value = float(cell.replace(mark, "."))
        if np.isfinite(value):
            return value
    elif not NOT_FINITE.fullmatch(cell):
        text = f"is {shown(cell[:60])!r}" if cell else "is empty"
        raise InputError(f"{title} in line {line} {text}; expected a number")
    raise InputError(f"{title} in line {line} is {cell[:60]}; allowed are finite numbers")
