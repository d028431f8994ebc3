"""Reflectance and absorptance of plane layers without random numbers.

The model is that of the random walk in `hylios.transport`, averaged instead of drawn. numpy only.
"""

from hylios.adding.colours import StateColours, colours
from hylios.adding.solver import NODES, Reflectance, solve
from hylios.adding.spectrum import Spectrum, spectra, spectrum

__all__ = [
    "NODES",
    "Reflectance",
    "Spectrum",
    "StateColours",
    "colours",
    "solve",
    "spectra",
    "spectrum",
]
