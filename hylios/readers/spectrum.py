"""Reflectance spectra in CSV files, as `hylios reflectance` prints them."""

import csv
import sys
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from hylios.errors import InputError


@dataclass(frozen=True)
class NamedSpectrum:
    """A reflectance spectrum, simulated or measured.

    Attributes
    ----------
    name : str
    wavelengths : (W,) ascending array, nm
    reflectance : (W,) array, 0 to 1
    standard_error : (W,) array or None
        None where it is not known.
    """

    name: str
    wavelengths: np.ndarray
    reflectance: np.ndarray
    standard_error: np.ndarray | None


def read_spectra(paths: Sequence[Path]) -> list[NamedSpectrum]:
    """Read several spectra with `read_spectrum`; files of the same name are named by their paths.

    Raises
    ------
    InputError
        If a file cannot be read or is no spectrum, or standard input is asked for twice.
    """
    if list(paths).count(Path("-")) > 1:
        raise InputError("standard input is given twice; allowed is once.")
    spectra = [read_spectrum(path) for path in paths]
    names = [each.name for each in spectra]
    return [
        each if names.count(each.name) == 1 else replace(each, name=str(path))
        for each, path in zip(spectra, paths, strict=True)
    ]


def read_spectrum(path: Path, column: str = "total") -> NamedSpectrum:
    """Read a spectrum from CSV with a header.

    Needed are the columns `wavelength_nm`, ascending, and `column`, the reflectance;
    `standard_error` is read where there is one, other columns and lines that start with # are
    ignored. Two columns of numbers without a header will do as well. The path `-` is standard
    input. The spectrum is named as the file without its ending.

    Raises
    ------
    InputError
        If the file cannot be read or is no spectrum.
    """
    name = "standard input" if path == Path("-") else path.stem
    table = read_columns(path, (column,), ("standard_error",))
    reflectance, error = table[column], table.get("standard_error")
    outside = reflectance[(reflectance < 0.0) | (reflectance > 1.0)]
    if outside.size:
        raise InputError(f"{path} has a {column} of {outside[0]:g}; allowed is 0 to 1.")
    if error is not None and np.any(error < 0.0):
        raise InputError(f"{path} has a standard_error of {error.min():g}; allowed is 0 or more.")
    return NamedSpectrum(name, table["wavelength_nm"], reflectance, error)


def read_columns(
    path: Path, needed: Sequence[str], welcome: Sequence[str] = ()
) -> dict[str, np.ndarray]:
    """The columns `wavelength_nm`, ascending, and some others of a CSV file, as finite numbers.

    Parameters
    ----------
    needed, welcome : sequence of str
        Columns that must be there and that may. A file of two columns of numbers without a header
        has the first that is needed.

    Raises
    ------
    InputError
        If the file cannot be read, lacks a column or its wavelengths do not ascend.
    """
    required = ("wavelength_nm", *needed)
    table = _columns(path, (*required, *welcome))
    for column in required:
        if column not in table:
            raise InputError(
                f"{path} has no column {column}; a spectrum needs {','.join(required)}."
            )
    if not table["wavelength_nm"].size or not np.all(np.diff(table["wavelength_nm"]) > 0):
        raise InputError(f"{path} needs one or more wavelengths, in ascending order.")
    return table


def _columns(path: Path, wanted: Sequence[str]) -> dict[str, np.ndarray]:
    """Those of some columns that a CSV file has, as finite numbers."""
    try:
        text = sys.stdin.read() if path == Path("-") else path.read_text(encoding="utf-8-sig")
        lines = [line for line in text.splitlines() if not line.startswith("#")]
        rows = [row for row in csv.reader(lines) if row]
        if not rows:
            raise ValueError("it is empty")
        header, *rows = rows if _is_header(rows[0]) else [list(wanted[:2]), *rows]
        if any(len(row) != len(header) for row in rows):
            raise ValueError("not every row has as many values as the header")
        columns = {
            title.strip(): np.array([row[place] for row in rows], dtype=float)
            for place, title in enumerate(header)
            if title.strip() in wanted
        }
    except (OSError, ValueError, csv.Error) as error:
        raise InputError(f"the spectrum in {path} cannot be read: {error}.") from error
    if not all(np.all(np.isfinite(column)) for column in columns.values()):
        raise InputError(f"the spectrum in {path} has values that are not finite numbers.")
    return columns


def _is_header(row: Sequence[str]) -> bool:
    """Whether a file's first row is something else than two numbers."""
    try:
        return len([float(each) for each in row]) != 2
    except ValueError:
        return True
