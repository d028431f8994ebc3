"""Colours of a skin in its tanning states, without random numbers."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from hylios.adding.solver import NODES
from hylios.adding.spectrum import spectra
from hylios.errors import InputError
from hylios.quadrature import skin_quadrature
from hylios.skin import Skin
from hylios.spectra import require_wavelengths
from hylios.tissue import Model

TOGETHER = 16
"""States solved at once; progress is told after every batch."""


@dataclass(frozen=True)
class StateColours:
    """What N tanning states look like.

    Attributes
    ----------
    subsurface, total : (N, 3) arrays
        Linear Rec.709 under D65: of light that has been inside the skin, and of all that is
        reflected.
    bands : (N, B) array
        Reflectance at single wavelengths.
    """

    subsurface: np.ndarray
    total: np.ndarray
    bands: np.ndarray


def colours(
    skin: Skin,
    states: np.ndarray,
    *,
    count: int = 8,
    bands: Sequence[float] = (),
    angle: float = 8.0,
    nodes: int = NODES,
    model: Model | None = None,
    progress: Callable[[int], object] | None = None,
) -> StateColours:
    """Colours of tanning states by `hylios.adding.solve` at a few wavelengths.

    Parameters
    ----------
    states : (N, 4) or (N, 5) array
        As `hylios.Skin.at` takes them.
    count : int
        Wavelengths that make the colour, 4 to 20 (`hylios.quadrature.skin_quadrature`).
    bands : sequence of float
        Other wavelengths in nm, 250 to 2500.
    angle, nodes
        As in `solve`; one angle.
    model
        As in `hylios.tissue.Stack.of`.
    progress : callable, optional
        Told, as each piece of work ends, how many states it had.

    Raises
    ------
    InputError
        If the states' shape or one of them, a wavelength or another argument is out of range, or
        a state cannot be solved (`solve`).
    """
    states = np.asarray(states, dtype=float)
    if states.ndim != 2 or states.shape[1] not in {4, 5}:
        raise InputError(f"tanning states have shape {states.shape}; expected (N, 4) or (N, 5).")
    colour = skin_quadrature(count)
    if len(bands):
        bands = require_wavelengths(bands, (model or Model()).spectra).tolist()
    wavelengths = [*colour.wavelengths, *bands]
    pieces = []
    for first in range(0, len(states), TOGETHER):
        some = states[first : first + TOGETHER]
        tanned = [skin.at(state) for state in some]
        pieces.append(spectra(tanned, wavelengths, angle=angle, nodes=nodes, model=model))
        if progress:
            progress(len(some))
    empty = np.empty((0, len(wavelengths)))
    subsurface = np.concatenate([empty, *(piece.subsurface for piece in pieces)])
    total = np.concatenate([empty, *(piece.total for piece in pieces)])
    return StateColours(
        subsurface[:, :count] @ colour.weights.T,
        total[:, :count] @ colour.weights.T,
        total[:, count:],
    )
