"""Spectra from the literature: what absorbs in skin, 250 to 2500 nm, and action spectra.

`spectra.csv` holds the numbers, `sources.toml` says what each column is, where it comes from and
where it is an estimate. Any spectrum can be replaced by a file of the user's own.
"""

import tomllib
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from functools import cache, lru_cache
from importlib.resources import files
from pathlib import Path
from types import MappingProxyType

import numpy as np

from hylios.errors import InputError
from hylios.packaged import numbers_of
from hylios.readers.spectrum import read_values


@dataclass(frozen=True)
class Estimate:
    """A part of a spectrum that was not measured, from `first` to `last` nm."""

    first: float
    last: float
    what: str


@dataclass(frozen=True, eq=False)
class Spectrum:
    """One spectrum with its unit and source, and the parts that are estimates.

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
        """Values at wavelengths in nm, linear between the spectrum's own.

        Raises
        ------
        InputError
            If a wavelength lies outside the spectrum.
        """
        if isinstance(wavelengths, float):
            return _value(self, wavelengths)
        wavelengths = np.asarray(wavelengths, dtype=float)
        first, last = self.wavelengths[0], self.wavelengths[-1]
        outside = wavelengths[~((wavelengths >= first) & (wavelengths <= last))]
        if outside.size:
            raise InputError(
                f"wavelength {outside.flat[0]:g} nm is outside the spectrum of {self.name}; "
                f"allowed is {first:g} to {last:g} nm."
            )
        return np.interp(wavelengths, self.wavelengths, self.values)


@lru_cache(maxsize=100_000)
def _value(spectrum: Spectrum, wavelength: float) -> np.ndarray:
    """A single value, kept: fits need the same few wavelengths thousands of times."""
    return spectrum.at(np.array(wavelength))


Spectra = Mapping[str, Spectrum]
"""Spectra by name."""


@cache
def published_spectra() -> Spectra:
    """The project's own spectra by name, from the literature."""
    sources = tomllib.loads((files(__name__) / "sources.toml").read_text(encoding="utf-8"))
    names, table = numbers_of(__name__, "spectra.csv")
    columns = dict(zip(names, table.T, strict=True))
    wavelengths = columns.pop("wavelength_nm")
    return MappingProxyType(
        {
            name: Spectrum(
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


LARGEST = 1e9
"""Largest value of an absorber in its unit: two thousand times any that is published."""

REFRACTIVE_INDICES = (1.0, 3.0)


def with_own_spectrum(spectra: Spectra, name: str, path: Path) -> Spectra:
    """The spectra with one of them from a file: nm and value, two columns or so called.

    Parameters
    ----------
    path : Path
        Of a table as `hylios.readers` reads them; its values are in the unit of the one replaced.

    Raises
    ------
    InputError
        If there is no such spectrum, the file cannot be read, or a value is out of range.
    """
    if name not in spectra:
        raise InputError(f"there is no spectrum {name!r}; there are {', '.join(spectra)}.")
    limits = REFRACTIVE_INDICES if name.endswith("refractive_index") else (0.0, LARGEST)
    wavelengths, values = read_values(path, name, *limits)
    own = Spectrum(name, spectra[name].unit, str(path), (), wavelengths, values)
    return MappingProxyType({**spectra, name: own})


def require_wavelengths(wavelengths: Iterable[float] | float, spectra: Spectra) -> np.ndarray:
    """The wavelengths in nm as an array (W,), if every spectrum has them.

    Raises
    ------
    InputError
        If they are no list of numbers, there is none, or one lies outside a spectrum.
    """
    listed = [wavelengths] if np.isscalar(wavelengths) else wavelengths
    try:
        result = np.array(list(listed), dtype=float)  # type: ignore[arg-type]
    except (TypeError, ValueError):
        result = np.empty(0)
    if result.ndim != 1 or result.size == 0:
        raise InputError("wavelengths are no list of numbers; at least one is needed, in nm.")
    for spectrum in spectra.values():
        spectrum.at(result)
    return result


def estimates_within(spectra: Spectra, names: Iterable[str], wavelengths: np.ndarray) -> list[str]:
    """One line for each part of the named spectra that is an estimate at some wavelength, nm."""
    return [
        f"{name}, {part.first:g} to {part.last:g} nm: {part.what}"
        for name in names
        for part in spectra[name].estimates
        if np.any((wavelengths >= part.first) & (wavelengths <= part.last))
    ]
