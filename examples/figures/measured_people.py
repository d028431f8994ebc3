"""Measured reflectance of people's skin, from a file that the user gives."""

import csv
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from hylios.errors import InputError

FIRST, LAST = 250.0, 2500.0
"""nm that a file has to span."""

BAND = (0.1, 0.5, 0.9)
"""Quantiles that the figures show of people."""


@dataclass(frozen=True)
class People:
    """Directional-hemispherical reflectance of N people.

    Attributes
    ----------
    names : tuple of str, (N,)
    wavelengths : (W,) ascending array, nm
    reflectance : (N, W) array, 0 to 1
    """

    names: tuple[str, ...]
    wavelengths: np.ndarray
    reflectance: np.ndarray

    def at(self, wavelengths: np.ndarray) -> np.ndarray:
        """Reflectance at other wavelengths (M,) in nm, linear between those measured, (N, M)."""
        return np.array([np.interp(wavelengths, self.wavelengths, row) for row in self.reflectance])

    def band(self, wavelengths: np.ndarray) -> np.ndarray:
        """Quantiles `BAND` of the people at wavelengths (M,) in nm, (3, M)."""
        return np.quantile(self.at(wavelengths), BAND, axis=0)


def read_people(path: Path) -> People:
    """Read people from CSV: `wavelength_nm`, then a column for each person.

    Lines that start with # are comments. So is the reference data set of C. C. Cooksey, D. W.
    Allen and B. K. Tsai 2017 (Journal of Research of NIST 122, 26; doi 10.18434/M38597), 100
    inner forearms at 8 degrees of incidence, once its averages stand in columns.

    Raises
    ------
    InputError
        If the file cannot be read or is no such table of reflectances from 250 to 2500 nm.
    """
    header, values = _table(path)
    if len(header) < 2 or header[0] != "wavelength_nm" or not len(values):
        raise InputError(f"{path} is no table of people; it needs wavelength_nm and a column each.")
    wavelengths, reflectance = values[:, 0], values[:, 1:].T
    if not np.all(np.diff(wavelengths) > 0) or wavelengths[0] > FIRST or wavelengths[-1] < LAST:
        raise InputError(
            f"{path} has wavelengths from {wavelengths[0]:g} to {wavelengths[-1]:g} nm; needed are "
            f"{FIRST:g} to {LAST:g} nm, ascending."
        )
    outside = reflectance[(reflectance < 0.0) | (reflectance > 1.0)]
    if outside.size:
        raise InputError(f"{path} has a reflectance of {outside[0]:g}; allowed is 0 to 1.")
    return People(tuple(header[1:]), wavelengths, reflectance)


def _table(path: Path) -> tuple[list[str], np.ndarray]:
    """Header and finite numbers (R, C) of a CSV file without its comments."""
    try:
        text = path.read_text(encoding="utf-8-sig")
        rows = list(csv.reader(line for line in text.splitlines() if not line.startswith("#")))
        header, *filled = [row for row in rows if row]
        values = np.array(filled, dtype=float)
    except (OSError, ValueError, csv.Error) as error:
        raise InputError(f"the people in {path} cannot be read: {error}.") from error
    if values.ndim != 2 or values.shape[1] != len(header) or not np.all(np.isfinite(values)):
        raise InputError(f"the people in {path} are no full table of finite numbers.")
    return [title.strip() for title in header], values
