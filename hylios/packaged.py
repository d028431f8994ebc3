"""Tables that a package carries: CSV with a header, in which lines with # are comments."""

import csv
from collections.abc import Iterator
from importlib.resources import files

import numpy as np
from numpy.typing import NDArray


def texts_of(package: str, name: str) -> Iterator[dict[str, str]]:
    """The rows of a package's table, by column."""
    return csv.DictReader(_lines(package, name))


def numbers_of(package: str, name: str) -> tuple[list[str], NDArray[np.float64]]:
    """Names (C,) of the columns of a package's table, and its numbers (N, C)."""
    names, *rows = csv.reader(_lines(package, name))
    return names, np.array(rows, dtype=float)


def _lines(package: str, name: str) -> list[str]:
    text = (files(package) / name).read_text(encoding="utf-8")
    return [line for line in text.splitlines() if not line.startswith("#")]
