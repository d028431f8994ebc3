"""Spectral figures from the literature: what absorbs in skin, 250 to 2500 nm.

`figures.csv` holds the numbers, `sources.toml` says what each column is, where it comes from and
where it is an estimate. Any figure can be replaced by a file of the user's own.
"""

import csv
import tomllib
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from functools import cache, lru_cache
from importlib.resources import files
from pathlib import Path
from types import MappingProxyType

import numpy as np

from hylios.errors import InputError


@dataclass(frozen=True)
class Estimate:
    """A part of a figure that was not measured, from `first` to `last` nm."""

    first: float
    last: float
    what: str


@dataclass(frozen=True, eq=False)
class Figure:
    """One spectrum with its unit, its source and what of it is an estimate.

    Attributes
    ----------
    wavelengths : (N,) ascending array, nm
    values : (N,) array, in `unit`
    """

    name: str
    unit: str
    source: str
    estimates: tuple[Estimate, ...]
    wavelengths: np.ndarray
    values: np.ndarray

    def at(self, wavelengths: np.ndarray | float) -> np.ndarray:
        """Values at wavelengths in nm, linear between the figure's own.

        Raises
        ------
        InputError
            If a wavelength lies outside the figure.
        """
        if isinstance(wavelengths, float):
            return _value(self, wavelengths)
        asked = np.asarray(wavelengths, dtype=float)
        first, last = self.wavelengths[0], self.wavelengths[-1]
        outside = asked[~((asked >= first) & (asked <= last))]
        if outside.size:
            raise InputError(
                f"wavelength {outside.flat[0]:g} nm is outside the figure for {self.name}; "
                f"allowed is {first:g} to {last:g} nm."
            )
        return np.interp(asked, self.wavelengths, self.values)


@lru_cache(maxsize=100_000)
def _value(figure: Figure, wavelength: float) -> np.ndarray:
    """A single value, kept: fits ask for the same few wavelengths thousands of times."""
    return figure.at(np.array(wavelength))


Figures = Mapping[str, Figure]


@cache
def figures() -> Figures:
    """All figures of the project by name."""
    folder = files(__name__)
    sources = tomllib.loads((folder / "sources.toml").read_text(encoding="utf-8"))
    rows = list(csv.reader((folder / "figures.csv").read_text(encoding="utf-8").splitlines()))
    columns = dict(zip(rows[0], np.array(rows[1:], dtype=float).T, strict=True))
    wavelengths = columns.pop("wavelength_nm")
    return MappingProxyType(
        {
            name: Figure(
                name=name,
                unit=sources[name]["unit"],
                source=sources[name]["source"],
                estimates=tuple(Estimate(*part) for part in sources[name].get("estimates", ())),
                wavelengths=wavelengths,
                values=values,
            )
            for name, values in columns.items()
        }
    )


def replaced(known: Figures, name: str, path: Path) -> Figures:
    """The figures with one taken from a CSV file of two columns, nm and value, without a header.

    Raises
    ------
    InputError
        If there is no such figure, or the file is not two columns of ascending, usable numbers.
    """
    if name not in known:
        raise InputError(f"there is no figure {name!r}; there are {', '.join(known)}.")
    try:
        rows = path.read_text(encoding="utf-8").splitlines()
        wavelengths, values = np.array([row.split(",") for row in rows if row], dtype=float).T
    except (OSError, ValueError) as error:
        raise InputError(f"the figure in {path} cannot be read: {error}.") from error
    usable = np.all(np.isfinite(values)) and np.all(values >= 0)
    if not (usable and np.all(np.diff(wavelengths) > 0)):
        raise InputError(f"{path} needs ascending wavelengths in nm and values of 0 or more.")
    own = Figure(name, known[name].unit, str(path), (), wavelengths, values)
    return MappingProxyType({**known, name: own})


def require_wavelengths(wavelengths: Iterable[float] | float, known: Figures) -> np.ndarray:
    """The wavelengths in nm as an array (W,), if every figure has them.

    Raises
    ------
    InputError
        If they are no list of numbers, there is none, or one lies outside a figure.
    """
    listed = [wavelengths] if np.isscalar(wavelengths) else wavelengths
    try:
        asked = np.array(list(listed), dtype=float)  # type: ignore[arg-type]
    except (TypeError, ValueError):
        asked = np.empty(0)
    if asked.ndim != 1 or asked.size == 0:
        raise InputError("wavelengths are no list of numbers; at least one is needed, in nm.")
    for each in known.values():
        each.at(asked)
    return asked


def estimates_within(known: Figures, names: Iterable[str], wavelengths: np.ndarray) -> list[str]:
    """One line for each part of the named figures that is an estimate at some wavelength, nm."""
    return [
        f"{name}, {part.first:g} to {part.last:g} nm: {part.what}"
        for name in names
        for part in known[name].estimates
        if np.any((wavelengths >= part.first) & (wavelengths <= part.last))
    ]
