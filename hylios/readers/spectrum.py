"""Spectra from files, as `hylios reflectance` prints them or instruments write them."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from hylios.errors import InputError, shown
from hylios.readers.cgats import cgats_table, is_cgats
from hylios.readers.cxf import cxf_table, is_cxf
from hylios.readers.quantities import (
    ABSORBANCE,
    IRRADIANCE,
    REFLECTANCE,
    SHARE,
    STANDARD_ERROR,
    TRANSMITTANCE,
    WAVELENGTH,
    Quantity,
)
from hylios.readers.table import Table, read_table, table_of
from hylios.readers.text import STANDARD_INPUT, lines_of, name_of

SHORTEST_NM, LONGEST_NM = 100.0, 1e5
"""Wavelengths that may be meant: micrometres lie below."""

LARGEST_IRRADIANCE = 1e12
"""In W/m^2/nm, far beyond any lamp."""

LARGEST_ERROR = 0.5
"""Standard deviation that numbers from 0 to 1 can have at most."""

OF_SAMPLES = ((is_cgats, cgats_table), (is_cxf, cxf_table))
"""Files of several samples: whether lines are such a file, and how its table is read."""

OTHER_UNITS = "; other units are read where the column is called wavelength (um) or (angstrom)"
PERCENT = ", or percent where the column is called as {column} (%)"


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
    notes : tuple of str
        What of its file was left out, a line each.
    """

    name: str
    wavelengths: np.ndarray
    reflectance: np.ndarray
    standard_error: np.ndarray | None
    notes: tuple[str, ...] = ()


def read_spectra(paths: Sequence[Path]) -> list[NamedSpectrum]:
    """Read several spectra with `read_spectrum`; files of the same name are named by their paths.

    Raises
    ------
    InputError
        If a file cannot be read or is no spectrum, or standard input is asked for twice.
    """
    if list(paths).count(STANDARD_INPUT) > 1:
        raise InputError("standard input is given twice; allowed is once.")
    spectra = [read_spectrum(path) for path in paths]
    names = [spectrum.name for spectrum in spectra]
    return [
        spectrum if names.count(spectrum.name) == 1 else replace(spectrum, name=name_of(path))
        for spectrum, path in zip(spectra, paths, strict=True)
    ]


def read_spectrum(path: Path, column: str | None = None) -> NamedSpectrum:
    """Read a spectrum from a table of text in whatever layout `hylios.readers` knows.

    Needed are columns of wavelengths and of reflectance, `wavelength_nm` and `total` or as
    instruments call them; `standard_error` is read where there is one. Two columns of numbers
    without a header will do as well. The path `-` is standard input. The spectrum is named as the
    file without its ending.

    Parameters
    ----------
    column : str, optional
        Title of the one that holds the reflectance, where others may too; of a CGATS or CxF file
        the sample.

    Raises
    ------
    InputError
        If the file cannot be read or is no spectrum.
    """
    reflectance, sample = REFLECTANCE, None
    if column == REFLECTANCE.name:
        reflectance = replace(REFLECTANCE, is_exact=True)
    elif column is not None:
        reflectance = Quantity(column, (column.casefold(),), SHARE, is_exact=True)
        sample = column
    lines, name = lines_of(path), name_of(path)
    of_samples = next((read for fits, read in OF_SAMPLES if fits(lines)), None)
    if of_samples is not None:
        table = of_samples(lines, name, sample)
        reflectance = REFLECTANCE
    else:
        table = table_of(
            lines, name, (WAVELENGTH, reflectance), (STANDARD_ERROR,), (WAVELENGTH, reflectance)
        )
    table = _by_wavelength(table)
    percent = PERCENT.format(column=reflectance.name)
    values = table.require_range(reflectance.name, 0.0, 1.0, percent)
    error = None
    if STANDARD_ERROR.name in table.numbers:
        error = table.require_range(STANDARD_ERROR.name, 0.0, LARGEST_ERROR)
    stem = name if path == STANDARD_INPUT else shown(path.stem)
    return NamedSpectrum(stem, table.numbers[WAVELENGTH.name], values, error, table.notes)


def read_irradiance(path: Path) -> tuple[np.ndarray, np.ndarray]:
    """Wavelengths (W,) in nm and spectral irradiance (W,) in W/m^2/nm of a lamp's file.

    Raises
    ------
    InputError
        If the file cannot be read or has no such columns, or an irradiance is negative or
        above `LARGEST_IRRADIANCE`.
    """
    columns = (WAVELENGTH, IRRADIANCE)
    table = _by_wavelength(read_table(path, columns, as_pair=columns))
    irradiance = table.require_range(IRRADIANCE.name, 0.0, LARGEST_IRRADIANCE, " W/m^2/nm")
    return table.numbers[WAVELENGTH.name], irradiance


def read_transmittance(path: Path) -> tuple[np.ndarray, np.ndarray]:
    """Wavelengths (W,) in nm and transmittance (W,), 0 to 1, of a film of sunscreen or of cloth.

    An absorbance will do as well, decadic as photometers show it.

    Raises
    ------
    InputError
        If the file cannot be read or has neither column.
    """
    either = (TRANSMITTANCE, ABSORBANCE)
    table = _by_wavelength(
        read_table(path, (WAVELENGTH,), either, as_pair=(WAVELENGTH, TRANSMITTANCE))
    )
    wavelengths = table.numbers[WAVELENGTH.name]
    if TRANSMITTANCE.name in table.numbers:
        percent = PERCENT.format(column=TRANSMITTANCE.name)
        return wavelengths, table.require_range(TRANSMITTANCE.name, 0.0, 1.0, percent)
    if ABSORBANCE.name in table.numbers:
        with np.errstate(over="ignore"):
            return wavelengths, 10.0 ** -table.numbers[ABSORBANCE.name]
    raise InputError(
        f"{table.name} has no column transmittance; a sunscreen needs it, or absorbance."
    )


def read_values(
    path: Path, title: str, least: float, largest: float
) -> tuple[np.ndarray, np.ndarray]:
    """Wavelengths (W,) in nm and values (W,) of two columns.

    The second column is called `value` or as `title` says, or there is no header.

    Raises
    ------
    InputError
        If the file cannot be read, has no such columns, or a value is not from `least` to
        `largest`.
    """
    value = Quantity("value", ("value", title.casefold()))
    table = _by_wavelength(read_table(path, (WAVELENGTH, value), as_pair=(WAVELENGTH, value)))
    return table.numbers[WAVELENGTH.name], table.require_range(value.name, least, largest)


def _by_wavelength(table: Table) -> Table:
    table = table.in_order(WAVELENGTH.name)
    table.require_range(WAVELENGTH.name, SHORTEST_NM, LONGEST_NM, f" nm{OTHER_UNITS}")
    return table
