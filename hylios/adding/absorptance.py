"""A specimen's absorptance in the ultraviolet, from the light model, once for each specimen."""

from collections.abc import Mapping
from functools import lru_cache

import numpy as np

from hylios.adding.spectrum import spectrum
from hylios.skin.specimen import Specimen
from hylios.spectra import Figures
from hylios.sun.action_spectra import FIRST_NM, LAST_NM, Absorptance

STEP_NM = 2.0  # that of the spectral figures


def tabulated(
    specimen: Specimen,
    *,
    known: Figures | None = None,
    chosen: Mapping[str, str] | None = None,
) -> Absorptance:
    """Absorptance of a specimen, 280 to 400 nm every 2 nm, for light 8 degrees from the normal.

    The thesis names no angle for the A of 5.1 to 5.3 and 5.17 to 5.19; this is that of its
    reflectance spectra. What counts is only A over A(298).

    Parameters
    ----------
    known, chosen
        As in `hylios.tissue.stack`. Without them the result is kept for the next call.

    Raises
    ------
    InputError
        If the specimen has no spectrum (`hylios.adding.spectrum.spectrum`).
    """
    if known is None and chosen is None:
        return _usual(specimen)
    return _absorptance(specimen, known, chosen)


@lru_cache(maxsize=64)
def _usual(specimen: Specimen) -> Absorptance:
    return _absorptance(specimen, None, None)


def _absorptance(
    specimen: Specimen, known: Figures | None, chosen: Mapping[str, str] | None
) -> Absorptance:
    wavelengths = np.arange(FIRST_NM, LAST_NM + STEP_NM, STEP_NM)
    found = spectrum(specimen, wavelengths, known=known, chosen=chosen)
    return Absorptance(wavelengths, found.absorptance)
