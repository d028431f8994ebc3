"""Text files as people have them: how they are opened and decoded."""

import codecs
import re
import sys
from pathlib import Path

from hylios.errors import InputError, shown
from hylios.files import regular_bytes

MOST_BYTES = 16 * 2**20
"""Most bytes of a file; a spectrum by hundredths of a nm or the doses of a century have less."""

MARKS = (
    (codecs.BOM_UTF8, "utf-8"),
    (codecs.BOM_UTF32_LE, "utf-32-le"),
    (codecs.BOM_UTF32_BE, "utf-32-be"),
    (codecs.BOM_UTF16_LE, "utf-16-le"),
    (codecs.BOM_UTF16_BE, "utf-16-be"),
)
"""Byte-order marks; that of UTF-16 is the beginning of one of UTF-32, which so comes first."""

STANDARD_INPUT = Path("-")


def name_of(path: Path) -> str:
    """What sentences call a file."""
    return "standard input" if path == STANDARD_INPUT else shown(path)


def lines_of(path: Path) -> list[str]:
    """The lines of a file, or with the path `-` of standard input, without their ends.

    UTF-8, UTF-16 and UTF-32 with a byte-order mark, UTF-8 and UTF-16 without; what is none of
    them is taken as Windows-1252, whose digits are the same.

    Raises
    ------
    InputError
        If it is no regular file or standard input, cannot be read, has more than `MOST_BYTES`, or
        is no text.
    """
    return re.split("\r\n|\r|\n", _decoded(_bytes_of(path), name_of(path)))


def _bytes_of(path: Path) -> bytes:
    if path != STANDARD_INPUT:
        return regular_bytes(path, MOST_BYTES)
    if sys.stdin is None:
        raise InputError("standard input cannot be read: it is closed.")
    try:
        data = sys.stdin.buffer.read(MOST_BYTES + 1)
    except OSError as error:
        raise InputError(f"standard input cannot be read: {error.strerror}.") from error
    if len(data) > MOST_BYTES:
        raise InputError(f"standard input cannot be read: it has more than {MOST_BYTES} bytes.")
    return data


def _decoded(data: bytes, name: str) -> str:
    for mark, encoding in MARKS:
        if data.startswith(mark):
            return _text(data[len(mark) :], encoding, name)
    zeros = [data[:1000:2].count(0), data[1:1000:2].count(0)]
    if any(zeros):
        return _text(data, "utf-16-le" if zeros[0] < zeros[1] else "utf-16-be", name)
    try:
        return _text(data, "utf-8", name)
    except InputError:
        return _text(data, "cp1252", name)


def _text(data: bytes, encoding: str, name: str) -> str:
    try:
        text = data.decode(encoding)
    except UnicodeDecodeError as error:
        raise InputError(f"{name} cannot be read: it is no text.") from error
    if "\0" in text:
        raise InputError(f"{name} cannot be read: it is no text.")
    return text
