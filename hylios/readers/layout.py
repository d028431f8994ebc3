"""How a text is laid out: what separates its cells, where its header is, which rows are data."""

import csv
import math
import re
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace

from hylios.errors import InputError, shown
from hylios.readers.quantities import KNOWN_UNITS, Quantity, named, place, unit

SEPARATORS = ("\t", ";", ",", " ")
"""What may part cells; blanks may be several, and part cells only where nothing else does."""

MARKS = {">>>>>End": ">>>>>Begin", "END_DATA": "BEGIN_DATA"}
"""How lines begin with which instruments end their rows, and those with which they begin them."""

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
    is_comment: bool = False

    @property
    def width(self) -> int:
        """Number of cells without the empty ones at the end."""
        return max((at for at, cell in enumerate(self.cells, start=1) if cell), default=0)

    @property
    def is_empty(self) -> bool:
        """Whether it holds nothing, as the rows with which spreadsheets fill up."""
        return not any(self.cells)


@dataclass(frozen=True)
class Layout:
    """A header's titles and the rows below it, each with as many cells."""

    titles: tuple[str, ...]
    rows: tuple[Row, ...]
    separator: str
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
    needed; a second row of units below it is added to it. Where there is none, a line that starts
    with # above the numbers may be the header. Without one, two columns of numbers will do where
    they can be a pair and nothing above them can be titles of something else.

    Raises
    ------
    NoHeaderError
        If there is none and there are not two columns of numbers.
    InputError
        If a row has more or fewer cells than the header, a header is not understood, or a quoted
        cell does not end.
    """
    every = list(_rows(lines, separator))
    rows = [row for row in every if not row.is_comment]
    for number, row in enumerate(rows):
        if row.width > 1 and not _missing(row, needed):
            _require_no_data(rows[:number], row.width)
            return _with_units(row, every[every.index(row) + 1 :], separator)
    first = next((number for number, row in enumerate(every) if _is_data(row)), len(every))
    above, below = every[:first], every[first:]
    titles = _commented_header(above, below, needed)
    if titles is not None:
        return _with_units(titles, every[every.index(titles) + 1 :], separator)
    rows_above = _filled(row for row in above if not row.is_comment)
    _require_no_header(rows_above, needed)
    if as_pair is None or not below or len(below[0].cells) != 2:
        raise NoHeaderError(_without(_filled(rows), needed))
    _require_no_data(rows_above, 2)
    _require_no_titles(above, lines, as_pair)
    pair = Row(0, tuple(quantity.name for quantity in as_pair))
    return replace(_fitting(pair, _without_text_below(below), separator), has_header=False)


def _rows(lines: Sequence[str], separator: str) -> Iterator[Row]:
    """Rows of lines, comments marked as such, up to a mark of their end."""
    last = _end(lines)
    comments: list[Row] = []
    begin = here = 0

    def kept() -> Iterator[str]:
        nonlocal begin, here
        for here, text in enumerate(lines[:last], start=1):
            line = text if separator != " " else " ".join(text.split())
            if line.lstrip().startswith("#"):
                cells = next(csv.reader([line.lstrip("# \t")], delimiter=separator), [])
                comments.append(Row(here, tuple(cell.strip() for cell in cells), is_comment=True))
                continue
            begin = begin or here
            yield line

    reader = csv.reader(kept(), delimiter=separator, strict=True, skipinitialspace=True)
    while True:
        begin = 0
        try:
            cells = next(reader)
        except StopIteration:
            yield from comments
            return
        except csv.Error as error:
            if "unexpected end" in str(error):
                raise InputError(f"line {begin} has a quote that does not end") from error
            raise InputError(f"line {here}: {error}") from error
        yield from comments
        comments.clear()
        yield Row(here, tuple(cell.strip() for cell in cells))


def _end(lines: Sequence[str]) -> int:
    """How many lines stand above a mark of the rows' end.

    Such a mark counts where one of their beginning is above it, or nothing below.
    """
    begun = set()
    for number, line in enumerate(lines):
        for end, begin in MARKS.items():
            if line.startswith(begin):
                begun.add(begin)
            elif line.startswith(end) and (begin in begun or not any(lines[number + 1 :])):
                return number
    return len(lines)


def _commented_header(
    above: Sequence[Row], below: Sequence[Row], needed: Sequence[Quantity]
) -> Row | None:
    """The comment above numbers that names what is needed and has as many cells.

    Raises
    ------
    InputError
        If the comment directly above has as many cells as they, and they are other titles.
    """
    width = below[0].width if below else 0
    comments: list[Row] = []
    for row in reversed(above):
        if row.is_comment:
            comments.insert(0, row)
        elif not row.is_empty:
            break
    fitting = [row for row in comments if row.width == width > 1]
    for row in fitting:
        if not _missing(row, needed):
            return row
    if fitting and fitting[-1] is comments[-1] and not _starts_with_number(fitting[-1]):
        raise InputError(_not_understood(fitting[-1], needed))
    return None


def _require_no_titles(
    above: Sequence[Row], lines: Sequence[str], pair: tuple[Quantity, Quantity]
) -> None:
    """Raise InputError where what is above two columns of numbers may be other titles for them.

    These are rows of two cells, what stands directly above them in two or more, whatever parts
    them there, and lines that speak of what the second column may be mistaken for.
    """
    rows = _filled(above)
    begins = [at for at, row in enumerate(rows) if row.cells[0].startswith(tuple(MARKS.values()))]
    inside = rows[begins[-1] + 1 :] if begins else rows
    words = [row for row in inside if not row.is_comment]
    for row in words:
        here = [cell for mark in "\t;," for cell in lines[row.line - 1].split(mark) if cell.strip()]
        if row.width == 2 or row is words[-1] and (row.width > 2 or len(here) > 3):
            raise InputError(_not_understood(row, pair))
    text = [(row.line, lines[row.line - 1].casefold()) for row in rows]
    own = [alias for alias in (pair[1].name, *pair[1].aliases) if len(alias) > 3]
    if any(alias in line for _, line in text for alias in own):
        return
    for number, line in text:
        if any(other in line for other in pair[1].others):
            raise InputError(
                f"line {number} says {shown(line.strip()[:60])!r}, and there is no header; needed "
                f"is a line {','.join(quantity.name for quantity in pair)} above the numbers"
            )


def _not_understood(row: Row, needed: Sequence[Quantity]) -> str:
    there = ", ".join(shown(repr(title[:40])) for title in row.cells[:TITLES_SHOWN])
    understood = "; ".join(
        f"{quantity.name} ({', '.join(quantity.aliases)})" if quantity.aliases else quantity.name
        for quantity in needed
    )
    return f"line {row.line} has the titles {there}; understood are {understood}"


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


def _filled(rows: Iterable[Row]) -> list[Row]:
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
    filled = not (row.is_comment or row.is_empty)
    return filled and len(row.cells) > 1 and all(map(is_number, filter(None, row.cells)))


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


def _with_units(header: Row, below: Sequence[Row], separator: str) -> Layout:
    """The layout below a header, whose next row may hold the units of its titles."""
    rows = _filled(below)
    cells = [cell.strip("()[] ") for cell in rows[0].cells] if rows else []
    if any(cells) and all(unit(cell) in KNOWN_UNITS for cell in cells if cell):
        units = [*cells, *[""] * len(header.cells)]
        titles = tuple(
            _with_unit(title, given, rows[0].line)
            for title, given in zip(header.cells, units, strict=False)
        )
        header = replace(header, cells=titles)
        below = below[below.index(rows[0]) + 1 :]
    kept = [row for row in below if not row.is_comment]
    return _fitting(header, _without_text_below(kept), separator)


def _with_unit(title: str, given: str, line: int) -> str:
    if not given:
        return title
    own = named(title)[1]
    if not own:
        return f"{title} ({given})"
    if own != unit(given):
        raise InputError(
            f"line {line} has the unit {shown(given[:40])!r} below {shown(title[:60])!r}; allowed "
            "is one unit"
        )
    return title


def _fitting(header: Row, rows: Sequence[Row], separator: str) -> Layout:
    """A layout, if every row has as many cells as the header; empty ones at the end are let go."""
    count = header.width
    fitted = []
    other = "the header" if header.line else f"line {rows[0].line}"
    for row in rows:
        cells = row.cells[:count]
        if len(cells) < count or any(row.cells[count:]):
            raise InputError(
                f"line {row.line} has {len(row.cells)} cells and {other} has {count}; a comma "
                "in a number needs semicolons or tabs between the cells"
            )
        fitted.append(Row(row.line, cells))
    return Layout(header.cells[:count], tuple(fitted), separator)
