"""The spectrum of a specimen without random numbers."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from hylios.adding.solver import NODES, Film, Reflectance, solve_specimens
from hylios.skin.specimen import Specimen
from hylios.spectra import require_wavelengths
from hylios.tissue import Model


@dataclass(frozen=True)
class Spectrum(Reflectance):
    """Reflectance and absorptance of a specimen.

    Attributes
    ----------
    wavelengths : (W,) array, nm
        The other arrays are (W,) too, (A, W) for several angles, (F, ..., W) for several films.
    """

    wavelengths: NDArray[np.float64]

    @property
    def absorptance(self) -> NDArray[np.float64]:
        """Share of the light that is absorbed, also in the hypodermis: what is not reflected."""
        return 1.0 - self.total


def spectra(
    specimens: Sequence[Specimen],
    wavelengths: Iterable[float],
    *,
    angle: float | Sequence[float] = 8.0,
    nodes: int = NODES,
    film: Film = None,
    model: Model | None = None,
) -> Reflectance:
    """Reflectance of S specimens at W wavelengths in nm, solved together.

    Its arrays are (S, W), (A, S, W) for several angles, (F, ..., S, W) for several films.
    Parameters and errors as in `spectrum`.
    """
    row = np.array([float(wavelength) for wavelength in wavelengths])
    return solve_specimens(specimens, row, angle, nodes, film=film, model=model)


def spectrum(
    specimen: Specimen,
    wavelengths: Iterable[float],
    *,
    angle: float | Sequence[float] = 8.0,
    nodes: int = NODES,
    film: Film = None,
    model: Model | None = None,
) -> Spectrum:
    """A specimen's spectrum, as `hylios.transport.simulate.spectrum` without its noise.

    Parameters
    ----------
    wavelengths : iterable of float
        nm, 250 to 2500.
    angle, nodes, film
        As in `solve`.
    model
        As in `hylios.tissue.Stack.of`.

    Raises
    ------
    InputError
        If a wavelength, the angle or the number of nodes is out of range, or the melanosomes'
        shape or refractive index lies outside the table of survival.

    Examples
    --------
    >>> import hylios
    >>> spectrum = hylios.solve_spectrum(hylios.specimen("S3"), [450, 550, 650])
    >>> print(*(f"{share:.3f}" for share in spectrum.total))
    0.218 0.310 0.575
    """
    model = model or Model()
    row = require_wavelengths(wavelengths, model.spectra)
    solved = solve_specimens([specimen], row, angle, nodes, film=film, model=model)
    shares = (solved.surface, solved.subsurface, solved.transmittance)
    surface, subsurface, transmittance = (share[..., 0, :] for share in shares)
    return Spectrum(surface, subsurface, transmittance, row)
