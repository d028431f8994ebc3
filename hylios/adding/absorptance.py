"""A specimen's absorptance in the ultraviolet, computed once by the light model and kept."""

from functools import lru_cache

import numpy as np

from hylios.adding.spectrum import spectrum
from hylios.errors import require_range
from hylios.skin.specimen import Specimen, require_specimen
from hylios.sun.action_spectra import FIRST_NM, LAST_NM, Absorptance
from hylios.tissue import Model

STEP_NM = 2.0  # that of the spectra


def tabulated(
    specimen: Specimen, model: Model | None = None, *, step_nm: float = STEP_NM
) -> Absorptance:
    """Absorptance of a specimen from 280 to 400 nm, for light 8 degrees from the normal.

    The thesis names no angle for the A of 5.1 to 5.3 and 5.17 to 5.19; this is that of its
    reflectance spectra. What counts is only A over A(298).

    Parameters
    ----------
    model
        As in `hylios.tissue.Stack.of`.
    step_nm : float
        Between wavelengths, 1 to 20 nm. With 6 nm doses of sunlight change by less than .1 %.

    Raises
    ------
    InputError
        If it is no specimen or has no spectrum (`hylios.adding.spectrum.spectrum`), or the step is
        out of range.

    Examples
    --------
    >>> import hylios
    >>> absorptance = hylios.ultraviolet_absorptance(hylios.specimen("S3"))
    >>> print(f"{absorptance.values[0]:.2f} at {absorptance.wavelengths[0]:.0f} nm")
    0.94 at 280 nm
    """
    require_range("step between wavelengths", step_nm, 1.0, 20.0, "nm")
    return _absorptance(require_specimen(specimen), model or Model(), step_nm)


@lru_cache(maxsize=64)
def _absorptance(specimen: Specimen, model: Model, step_nm: float) -> Absorptance:
    steps = round((LAST_NM - FIRST_NM) / step_nm)
    wavelengths = np.linspace(FIRST_NM, LAST_NM, 1 + steps)
    absorbed = spectrum(specimen, wavelengths, model=model).absorptance
    return Absorptance(wavelengths, absorbed)
