"""The light under which a table's colours are, and who sees them."""

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from hylios.quadrature import skin_quadrature
from hylios.readers.spectrum import read_values

DAYLIGHT, STANDARD_OBSERVER = "D65", "CIE 1931 2 degree"

MOST_POWER = 1e12


@dataclass(frozen=True, eq=False)
class Lighting:
    """An illuminant and an observer (`hylios.lab.illuminants`).

    Attributes
    ----------
    name : str
        The illuminant's, or the name of a file that holds its spectrum.
    observer : str
    wavelengths, power : (N,) arrays or None
        Of an illuminant of the user's own, in nm and in any unit.
    """

    name: str = DAYLIGHT
    observer: str = STANDARD_OBSERVER
    wavelengths: np.ndarray | None = None
    power: np.ndarray | None = None

    @property
    def is_standard(self) -> bool:
        """Whether that is D65 and CIE 1931 2 degree, as where nothing is said."""
        return self.power is None and (self.name, self.observer) == (DAYLIGHT, STANDARD_OBSERVER)

    def weights(self, count: int) -> np.ndarray:
        """Weights (3, count) of the wavelengths of `skin_quadrature`.

        Raises
        ------
        InputError
            If there is no such illuminant or observer (`hylios.lab.illuminants`).
        """
        if self.is_standard:
            return skin_quadrature(count).weights
        from hylios.lab.illuminants import illuminant_weights  # colour-science

        return illuminant_weights(count, self._illuminant, self.observer)

    def enough(self, count: int) -> int:
        """How many wavelengths make colours as right as so many do under daylight, 16 at most.

        Errors as `weights`.
        """
        if self.is_standard:
            return count
        from hylios.lab.illuminants import enough_wavelengths  # colour-science

        return enough_wavelengths(count, self._illuminant, self.observer)

    def fine_weights(self, wavelengths: np.ndarray) -> np.ndarray:
        """Weights (3, W) of a whole spectrum at wavelengths (W,) in nm; errors as `weights`."""
        from hylios.lab.colour import rec709_weights  # colour-science

        if self.is_standard:
            return rec709_weights(wavelengths)
        from hylios.lab.illuminants import rec709_weights_under

        return rec709_weights_under(wavelengths, self._illuminant, self.observer)

    def described(self) -> dict[str, Any]:
        """What a table's provenance says of it."""
        told: dict[str, Any] = {
            "colour": f"linear Rec.709, {self.name}, {self.observer}",
            "illuminant": self.name,
            "observer": self.observer,
        }
        if self.wavelengths is not None and self.power is not None:
            told["illuminant_power"] = {
                "wavelengths_nm": self.wavelengths.tolist(),
                "values": self.power.tolist(),
            }
        return told

    @property
    def _illuminant(self) -> Any:
        return self.name if self.power is None else (self.wavelengths, self.power)


def lighting(name: str = DAYLIGHT, observer: str = STANDARD_OBSERVER) -> Lighting:
    """The lighting of a name, or of a CSV file with wavelengths and power.

    Raises
    ------
    InputError
        If there is no such illuminant or observer, or the file cannot be read or used.
    """
    path = Path(name)
    if path.suffix.casefold() in {".csv", ".txt", ".tsv"}:
        made = Lighting(path.name, observer, *read_values(path, "power", 0.0, MOST_POWER))
    else:
        made = Lighting(_written(name, DAYLIGHT), _written(observer, STANDARD_OBSERVER))
    made.weights(8)
    return made


def lighting_of(provenance: Mapping[str, Any]) -> Lighting:
    """The lighting that a table was made for; D65 and CIE 1931 2 degree where it names none."""
    power = provenance.get("illuminant_power")
    return Lighting(
        provenance.get("illuminant", DAYLIGHT),
        provenance.get("observer", STANDARD_OBSERVER),
        None if power is None else np.array(power["wavelengths_nm"]),
        None if power is None else np.array(power["values"]),
    )


def _written(name: str, usual: str) -> str:
    """A name as the usual one is written, if it is that in other letters."""
    return usual if name.casefold() == usual.casefold() else name
