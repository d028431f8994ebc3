"""Liquids that lie on skin as a film: water, oil and sunscreen.

How they change the reflection of the skin's surface is in `hylios.adding.film`; here is what they
are, and how much light they swallow. The numbers and their sources stand in `liquids.toml`.
"""

import tomllib
from collections.abc import Mapping
from dataclasses import dataclass
from importlib.resources import files
from types import MappingProxyType

import numpy as np
from numpy.typing import ArrayLike, NDArray

from hylios.spectra import published_spectra, require_wavelengths
from hylios.sun.protection import sunscreen

UVA_NM, VISIBLE_NM = 320.0, 400.0
"""Where the ultraviolet's A begins and where it ends, in nm."""


@dataclass(frozen=True)
class Liquid:
    """A liquid, and how thick it usually lies on skin.

    Attributes
    ----------
    index : float
        Of refraction.
    thickness : float
        mm.
    absorber : str
        Name of its spectrum among `hylios.spectra.published_spectra`, in 1/cm.
    index_source, thickness_source : str
        Where they come from, with ESTIMATE where a number is one.
    spf, uva_factor : float
        Protection factors on the bottle, of the ultraviolet up to 320 nm and up to 400 nm; 1 of
        what is no sunscreen. Beyond 400 nm a sunscreen lets all light through.
    uva_source : str
    amount : float
        Of sunscreen in mg/cm^2; its factors are for 2.
    """

    index: float
    thickness: float
    absorber: str
    index_source: str
    thickness_source: str
    spf: float = 1.0
    uva_factor: float = 1.0
    uva_source: str = ""
    amount: float = 0.0

    def twice_through(self, wavelengths: ArrayLike) -> NDArray[np.float64]:
        """Share (W,) of light that is left after the way through the film to the skin and back.

        Both straight across: exp(-2 a d), and the square of a sunscreen's transmittance.

        Parameters
        ----------
        wavelengths : (W,) array
            nm, 250 to 2500.

        Raises
        ------
        InputError
            If one is out of range.

        Examples
        --------
        >>> from hylios.tissue.liquids import LIQUIDS
        >>> for liquid in LIQUIDS.values():
        ...     print(*(f"{share:.3f}" for share in liquid.twice_through([365, 1100, 1650])))
        1.000 0.998 0.942
        1.000 1.000 0.999
        0.100 1.000 0.999
        """
        spectrum = published_spectra()[self.absorber]
        row = require_wavelengths(np.atleast_1d(wavelengths), {self.absorber: spectrum})
        passed = np.exp(-spectrum.at(row) * 0.1 * self.thickness)
        burning, tanning = (
            sunscreen(factor, self.amount).at(row) for factor in (self.spf, self.uva_factor)
        )
        passed *= np.select([row < UVA_NM, row <= VISIBLE_NM], [burning, tanning], 1.0)
        return passed**2


def _read() -> Mapping[str, Liquid]:
    text = files("hylios.tissue").joinpath("liquids.toml").read_text(encoding="utf-8")
    return MappingProxyType({name: Liquid(**told) for name, told in tomllib.loads(text).items()})


LIQUIDS: Mapping[str, Liquid] = _read()
"""Liquids by name: water, oil and sunscreen."""
