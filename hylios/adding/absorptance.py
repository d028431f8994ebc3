"""A specimen's absorptance in the ultraviolet, computed once by the light model and kept."""

from functools import lru_cache

import numpy as np

from hylios.adding.spectrum import spectrum
from hylios.skin.specimen import Specimen, require_specimen
from hylios.sun.action_spectra import FIRST_NM, LAST_NM, Absorptance
from hylios.tissue import Model

STEP_NM = 2.0  # that of the spectra


def tabulated(
    specimen: Specimen,
    model: Model | None = None,
) -> Absorptance:
    """Absorptance of a specimen, 280 to 400 nm every 2 nm, for light 8 degrees from the normal.

    The thesis names no angle for the A of 5.1 to 5.3 and 5.17 to 5.19; this is that of its
    reflectance spectra. What counts is only A over A(298).

    Parameters
    ----------
    model
        As in `hylios.tissue.Stack.of`.

    Raises
    ------
    InputError
        If it is no specimen or has no spectrum (`hylios.adding.spectrum.spectrum`).

    Examples
    --------
    >>> import hylios
    >>> absorptance = hylios.ultraviolet_absorptance(hylios.specimen("S3"))
    >>> print(f"{absorptance.values[0]:.2f} at {absorptance.wavelengths[0]:.0f} nm")
    0.94 at 280 nm
    """
    return _absorptance(require_specimen(specimen), model or Model())


@lru_cache(maxsize=64)
def _absorptance(specimen: Specimen, model: Model) -> Absorptance:
    wavelengths = np.arange(FIRST_NM, LAST_NM + STEP_NM, STEP_NM)
    absorbed = spectrum(specimen, wavelengths, model=model).absorptance
    return Absorptance(wavelengths, absorbed)
